//! A kind of objects of one's own, with a position function of its own: elliptic gears.
//!
//! The kind is read from JSON and built in code alike; both have its checks, and the
//! motion is exact where that of the library's own kinds is.
//!
//! `cargo run --release --example own_object`

#![allow(clippy::print_stdout)] // an example says what it found

use dam::jet::Jet;
use dam::model::Coordinate;
use dam::object::chain::{Rules, read_behind};
use dam::object::{ChainObject, Context, Inputs, Kind, Object};
use dam::position::{PositionFunction, PositionSpec};
use dam::prelude::*;
use dam::read::{Bounds, Fields};

/// Two equal elliptic gears that turn about their foci, with the eccentricity e of the
/// ellipses: tan(U/2) = (1 + e)/(1 − e)·tan(φ/2), the ratio of their speeds
/// U′ = (1 − e²)/(1 + e² − 2e·cos φ). Angles of the driven gear are counted against the
/// sense of the driving one.
#[derive(Debug)]
pub(crate) struct EllipticGears {
    eccentricity: f64,
}

impl EllipticGears {
    pub(crate) fn new(eccentricity: f64) -> Self {
        Self { eccentricity }
    }
}

impl PositionFunction for EllipticGears {
    fn jet(&self, _: i64, phi: f64) -> Jet {
        let e = self.eccentricity;
        let ((sin, cos), (half_sin, half_cos)) = (phi.sin_cos(), (0.5 * phi).sin_cos());
        // U − φ repeats with every turn: atan of the difference of the half angles.
        let ahead = (2.0 * e * half_sin * half_cos).atan2(1.0 - e + 2.0 * e * half_sin * half_sin);
        let square = 1.0 + e * e - 2.0 * e * cos;
        let factor = 1.0 - e * e;
        Jet {
            value: phi + 2.0 * ahead,
            first: factor / square,
            second: -factor * 2.0 * e * sin / square.powi(2),
            third: -factor * 2.0 * e * (cos * square - 4.0 * e * sin * sin) / square.powi(3),
        }
    }
}

/// How elliptic gears are read: their `eccentricity`, and all that a chain of masses has.
pub(crate) const ELLIPTIC_GEARS: Kind = Kind {
    name: "elliptic_gears",
    doc: "Two equal elliptic gears: a ratio that goes up and down in every turn.",
    inputs: Inputs::One,
    outputs: Kind::no_outputs,
    coordinate: |_| Some(Coordinate::Turning),
    read,
};

fn read(fields: &mut Fields<'_>, context: &Context<'_>) -> Option<Box<dyn Object>> {
    let doc = "Eccentricity of the ellipses.";
    let eccentricity = fields.need("eccentricity", doc, |slot| {
        slot.number(Bounds::between(0.0, 0.9))
    });
    let position = eccentricity.map(|e| PositionSpec::own(EllipticGears::new(e)));
    let rules = Rules::of(Coordinate::Turning);
    let chain = read_behind(fields, context, context.driver, &rules, position)?;
    Some(Box::new(ChainObject::new(ELLIPTIC_GEARS.name, chain)))
}

/// A drum behind elliptic gears with backlash.
pub(crate) fn scene() -> Scene {
    let drum = AnyObject::of_kind(ELLIPTIC_GEARS.name)
        .input("motor")
        .set("eccentricity", 0.3)
        .set("inertia", "0.4 kg m^2")
        .set("stiffness", "6e4 N m/rad")
        .set("damping_capacity", 0.4)
        .set("pair", Pair::form("0.2 mrad"));
    Scene::new("Drum behind elliptic gears")
        .with_kind(ELLIPTIC_GEARS)
        .add("motor", Drive::speed("120 rpm"))
        .add("drum", drum)
        .duration(2)
}

pub(crate) fn main() -> Result<(), Error> {
    let run = scene().run()?;
    println!("method: {}", run.figures.run.method);
    println!(
        "greatest speed {:.4} rad/s, greatest contact moment {:.1} N m, {} separations",
        run.figure("drum", Figure::PeakSpeed)?,
        run.figure("drum", Figure::MaxContactForce)?,
        run.figure("drum", Figure::Separations)?
    );

    // The kind has JSON and its diagnostics too.
    let text = scene().json().replace("0.3", "1.3");
    let scene = Scene::from_json(&text)?.with_kind(ELLIPTIC_GEARS);
    let error = scene
        .run()
        .expect_err("an ellipse has an eccentricity below 1");
    println!("\n{error}");
    Ok(())
}
