//! Cams.

use super::{Asked, interrupted};
use crate::answer::{Columns, Told};
use crate::work::Watch;
use dam::ask::CamQuestion;
use dam::report::cam::{CamReport, curves, cycle_rows, dxf, findings, picture};
use dam::report::findings::Findings;
use dam::studies::law::LiftOff;
use dam::{Error, Mechanism, Scene};
use serde_json::Value;
use std::sync::Arc;

/// Rows of the cycle's table in a turn.
const ROWS: usize = 720;

/// The cam of an object: found anew for each form, which takes milliseconds.
pub(crate) struct Cam {
    asked: Asked,
    question: CamQuestion,
    drawn: Drawn,
    /// Speed of the cam at which an elastic follower leaves it.
    elastic: Option<LiftOff>,
}

/// How its curves are drawn, and whether runs are asked.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Drawn {
    /// How far they may stand off their chords (m).
    pub(crate) tolerance: f64,
    /// Radius of a cutter (m), whose path is wanted too.
    pub(crate) cutter: Option<f64>,
    /// Whether the speed at which an elastic follower leaves the cam is searched for by runs.
    pub(crate) lift_off: bool,
}

/// The cam of an object of a scene.
///
/// # Errors
/// Everything that is wrong with the scene; why there is no cam.
pub(crate) fn ask(
    scene: Arc<Scene>,
    question: CamQuestion,
    drawn: Drawn,
    watch: &Watch,
) -> Result<(Cam, Columns), Error> {
    let lengths = [drawn.tolerance, drawn.cutter.unwrap_or(1.0)];
    if !lengths
        .iter()
        .all(|length| length.is_finite() && *length > 0.0)
    {
        let message = "`tolerance` and `cutter` are positive lengths";
        return Err(vec![dam::fault::Fault::new("", message, "")].into());
    }
    let ready = Mechanism::of(scene.decode()?)?;
    let columns = ready.cam(&question, |found| {
        super::columns(&cycle_rows(
            found.cam,
            found.figures.unit,
            found.force,
            ROWS,
        ))
    })?;
    let elastic = match drawn.lift_off {
        false => None,
        true => match scene.cam_lift_off(&question, &watch.budget())? {
            None => return Err(interrupted("the search for the speed")),
            found => found,
        },
    };
    let asked = Asked { scene, ready };
    let cam = Cam {
        asked,
        question,
        drawn,
        elastic,
    };
    Ok((cam, columns))
}

impl Cam {
    fn report<T>(&self, look: impl FnOnce(&CamReport<'_>) -> T) -> Result<T, Error> {
        let Drawn {
            tolerance, cutter, ..
        } = self.drawn;
        self.asked.ready.cam(&self.question, |found| {
            let curves = curves(found.cam, tolerance, cutter);
            let curves = curves.map_err(|fault| Error::from(vec![fault]))?;
            let mut figures = found.figures.clone();
            if let Some(force) = &mut figures.force {
                force.elastic = self.elastic;
            }
            Ok(look(&CamReport {
                name: self.asked.name(),
                id: found.object,
                cam: found.cam,
                figures: &figures,
                force: found.force,
                curves: &curves,
                tolerance,
            }))
        })?
    }

    /// Profile, pitch curve and cutter path as DXF.
    pub(crate) fn dxf(&self) -> Result<String, Error> {
        self.report(|report| dxf(report.curves, report.cam.geometry().base_radius))
    }

    /// The cam with its follower as a drawing.
    pub(crate) fn svg(&self) -> Result<String, Error> {
        self.report(|report| picture(report.id, report.cam, report.cam.motion().range().0))
    }
}

impl Told for Cam {
    fn document(&self) -> Result<Value, Error> {
        self.report(|report| report.document(self.asked.hash()))
    }

    fn tell<T>(&self, to: impl FnOnce(&Findings<'_>) -> T) -> Result<T, Error> {
        self.report(|report| to(&findings(report, self.asked.source())))
    }
}
