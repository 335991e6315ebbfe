//! Disc cams as findings, tables and drawings.

mod charts;
mod dxf;
mod figures;
mod findings;
mod picture;
mod remarks;
mod tables;
mod view;
mod words;

pub use dxf::dxf;
pub use findings::{CamReport, findings};
pub use picture::picture;
pub(in crate::report) use picture::{
    Follower, curves_to_draw, drawing, ends, marks, moving_bodies, style,
};
pub use tables::{cycle_rows, polygon_rows};
pub(in crate::report) use view::view_within;

use crate::fault::Fault;
use crate::kinematics::cam::{DiscCam, Polygon};
use crate::units::shown;

/// A curve of a cam, to be drawn or cut.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedCurve {
    /// `profile`, `inner_flank`, `outer_flank`, `pitch`, `cutter`, …
    pub name: String,
    /// Corners of the curve (m).
    pub polygon: Polygon,
}

/// Profile (both flanks of a groove) and pitch curve within a chord tolerance
/// (m), and the path of the centre of a cutter of that radius (m), if one is given.
///
/// # Errors
/// A tolerance that is none or too fine, a cutter that is none, does not fit
/// into the groove or does not reach into a hollow of the profile.
pub fn curves(
    cam: &DiscCam,
    tolerance: f64,
    cutter: Option<f64>,
) -> Result<Vec<NamedCurve>, Fault> {
    let geometry = cam.geometry();
    let flanks = geometry.flanks();
    let names: &[&str] = match flanks.len() {
        1 => &["profile"],
        _ => &["inner_flank", "outer_flank"],
    };
    let mut found = Vec::new();
    let mut add = |name: String, offset: f64| -> Result<(), Fault> {
        let polygon = cam.polygon(offset, tolerance)?;
        found.push(NamedCurve { name, polygon });
        Ok(())
    };
    for (name, &offset) in names.iter().zip(&flanks) {
        add((*name).to_owned(), offset)?;
    }
    if geometry.roller().is_some_and(|roller| roller > 0.0) {
        add("pitch".to_owned(), 0.0)?;
    }
    if let Some(cutter) = cutter {
        check_cutter(cam, cutter)?;
        let groove = flanks.len() > 1;
        for &offset in &flanks {
            // Outside a disc, inside a hollow cam, between the flanks of a groove.
            let inside = offset > 0.0;
            let name = match (groove, inside) {
                (false, _) => "cutter",
                (true, false) => "cutter_inner",
                (true, true) => "cutter_outer",
            };
            let path = if inside {
                offset - cutter
            } else {
                offset + cutter
            };
            add(name.to_owned(), path)?;
        }
    }
    Ok(found)
}

fn check_cutter(cam: &DiscCam, cutter: f64) -> Result<(), Fault> {
    let refuse = |message: String, hint: String| Err(Fault::new("cutter", message, hint));
    if !(cutter.is_finite() && cutter > 0.0) {
        return refuse(
            format!("{cutter} m is no radius of a cutter"),
            "give a length above zero".to_owned(),
        );
    }
    let limits = cam.roller_limits(1.0);
    if let Some(most) = limits.and_then(|limits| limits.cutter)
        && cutter > most.value * (1.0 + 1e-12)
    {
        return refuse(
            format!("a cutter of radius {cutter} m does not reach all of the profile"),
            format!("it may be up to {} m", shown(most.value, 6)),
        );
    }
    Ok(())
}
