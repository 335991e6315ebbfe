//! A kind of objects of one's own, with a position function of its own: a Geneva wheel.
//!
//! The kind is read from JSON and built in code alike; both have its checks, and the
//! motion is exact where that of the library's own kinds is.
//!
//! `cargo run --release --example own_object`

use dam::breaks::Breaks;
use dam::jet::Jet;
use dam::model::Coordinate;
use dam::object::chain::{Rules, read_behind};
use dam::object::{ChainObject, Context, Inputs, Kind, Object};
use dam::position::{PositionFunction, PositionSpec};
use dam::prelude::*;
use dam::read::Fields;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// An external Geneva wheel with n slots, angles counted against the crank's sense.
///
/// The pin enters and leaves a slot without impact: crank radius and centre distance
/// have the ratio λ = sin(π/n). The pin is in a slot while the crank is within
/// ±(π/2 − π/n) of the line of centres, where tan U = λ·sin φ/(1 − λ·cos φ); then the
/// wheel rests until the next turn.
#[derive(Debug)]
pub(crate) struct GenevaWheel {
    slots: f64,
}

impl GenevaWheel {
    pub(crate) fn new(slots: u64) -> Self {
        Self {
            slots: slots as f64,
        }
    }

    /// Crank angle from the line of centres at which the pin enters and leaves.
    fn engagement(&self) -> f64 {
        FRAC_PI_2 - PI / self.slots
    }
}

impl PositionFunction for GenevaWheel {
    fn jet(&self, segment: i64, phi: f64) -> Jet {
        let (piece, turned) = self.breaks().piece(segment);
        let step = TAU / self.slots;
        let turns = (turned / TAU).round();
        if piece == 1 {
            let value = (turns + 0.5) * step;
            return Jet {
                value,
                ..Jet::default()
            };
        }
        let ratio = (PI / self.slots).sin();
        let (sin, cos) = (phi - turned).sin_cos();
        let square = 1.0 - 2.0 * ratio * cos + ratio * ratio;
        let factor = ratio * (1.0 - ratio * ratio);
        Jet {
            value: turns * step + (ratio * sin).atan2(1.0 - ratio * cos),
            first: ratio * (cos - ratio) / square,
            second: -factor * sin / square.powi(2),
            third: -factor * (cos * square - 4.0 * ratio * sin * sin) / square.powi(3),
        }
    }

    fn breaks(&self) -> Breaks {
        Breaks {
            points: vec![-self.engagement(), self.engagement()],
            period: Some(TAU),
        }
    }
}

/// How a Geneva wheel is read: its `slots`, and all that a chain of masses has.
pub(crate) const GENEVA: Kind = Kind {
    name: "geneva_wheel",
    doc: "A Geneva wheel: turns by one slot with every turn of its crank.",
    inputs: Inputs::One,
    outputs: Kind::no_outputs,
    coordinate: |_| Some(Coordinate::Turning),
    read,
};

fn read(fields: &mut Fields<'_>, context: &Context<'_>) -> Option<Box<dyn Object>> {
    let slots = fields.need("slots", "Number of slots.", |slot| slot.count(3..=24));
    let position = slots.map(|slots| PositionSpec::own(GenevaWheel::new(slots)));
    let rules = Rules::of(Coordinate::Turning);
    let chain = read_behind(fields, context.driver, &rules, position)?;
    Some(Box::new(ChainObject::new(GENEVA.name, chain)))
}

/// A turret that a Geneva wheel indexes.
pub(crate) fn scene() -> Scene {
    let turret = AnyObject::of_kind(GENEVA.name)
        .input("crank")
        .set("slots", 6)
        .set("inertia", "0.4 kg m^2")
        .set("stiffness", "6e4 N m/rad")
        .set("damping_capacity", 0.2)
        .set("pair", Pair::form("0.2 mrad"));
    Scene::new("Turret on a Geneva wheel")
        .with_kind(GENEVA)
        .add("crank", Drive::speed("60 rpm").angle("180 deg"))
        .add("turret", turret)
        .duration(3)
}

pub(crate) fn main() -> Result<(), Error> {
    let run = scene().run()?;
    let places = run.displacement("turret")?;
    let end = places[places.len() - 1].to_degrees();
    println!("by {}: {end:.4}° after three turns", run.figures.run.method);
    println!(
        "greatest deviation {:.3e} rad, greatest contact moment {:.1} N m",
        run.figure("turret", Figure::DeltaMax)?,
        run.figure("turret", Figure::MaxContactForce)?
    );

    // The kind has JSON and its diagnostics too.
    let text = scene().json().replace("\"slots\": 6", "\"slots\": 2");
    let error = Scene::from_json(&text)?
        .with_kind(GENEVA)
        .run()
        .unwrap_err();
    println!("\n{error}");
    Ok(())
}
