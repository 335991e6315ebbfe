//! A Geneva wheel: a kind of object that the library does not know.
//!
//! A crank pin enters one of n radial slots, turns the wheel by one division and leaves
//! it; the wheel then stands. With λ = sin(π/n), the crank's radius over the distance of
//! the axes, the wheel turns by β = atan(λ·sin θ/(1 − λ·cos θ)) while |θ| < π/2 − π/n, the
//! opposite way round.

use dam::breaks::Breaks;
use dam::jet::Jet;
use dam::model::Coordinate;
use dam::object::chain::{Rules, read_behind};
use dam::object::spec::ChainSpec;
use dam::object::{Context, INPUT, Inputs, Kind, ModelBuilder, Object, Place, Ports};
use dam::position::{CustomPosition, PositionFunction, PositionSpec};
use dam::read::Fields;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::Arc;

/// U(φ) of a wheel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Geneva {
    pub(crate) slots: u32,
}

impl Geneva {
    fn division(self) -> f64 {
        PI / f64::from(self.slots)
    }

    /// Crank angle at which the pin enters or leaves a slot.
    pub(crate) fn engagement(self) -> f64 {
        FRAC_PI_2 - self.division()
    }

    /// β and its derivatives.
    pub(crate) fn angle(self, theta: f64) -> Jet {
        let ratio = self.division().sin();
        let (sin, cos) = theta.sin_cos();
        let square = 1.0 - 2.0 * ratio * cos + ratio * ratio;
        let factor = -ratio * (1.0 - ratio * ratio);
        Jet {
            value: (ratio * sin).atan2(1.0 - ratio * cos),
            first: ratio * (cos - ratio) / square,
            second: factor * sin / (square * square),
            third: factor * (cos * square - 4.0 * ratio * sin * sin) / square.powi(3),
        }
    }
}

impl PositionFunction for Geneva {
    fn jet(&self, segment: i64, phi: f64) -> Jet {
        let (piece, turned) = self.breaks().piece(segment);
        let turns = (turned / TAU).round();
        let start = -turns * 2.0 * self.division();
        // Piece 0 begins where the pin enters.
        if piece == 0 {
            let angle = self.angle(phi - turned);
            return Jet {
                value: start - angle.value,
                first: -angle.first,
                second: -angle.second,
                third: -angle.third,
            };
        }
        Jet {
            value: start - self.division(),
            ..Jet::default()
        }
    }

    fn breaks(&self) -> Breaks {
        Breaks {
            points: vec![-self.engagement(), self.engagement()],
            period: Some(TAU),
        }
    }
}

#[derive(Debug)]
struct GenevaWheel {
    chain: ChainSpec,
}

impl Object for GenevaWheel {
    fn kind(&self) -> &'static str {
        KIND.name
    }

    fn ports(&self) -> Ports {
        Ports::with_one_driver(Coordinate::Turning)
    }

    fn lower(&self, at: &Place, into: &mut ModelBuilder) {
        into.chain(at, at.input(INPUT), &self.chain);
    }

    fn chain(&self) -> Option<&ChainSpec> {
        Some(&self.chain)
    }

    fn chain_mut(&mut self) -> Option<&mut ChainSpec> {
        Some(&mut self.chain)
    }
}

fn read(fields: &mut Fields<'_>, context: &Context<'_>) -> Option<Box<dyn Object>> {
    let slots = fields.need("slots", "Number of slots.", |slot| slot.count(3..=24));
    if context.driver == Some(Coordinate::Sliding) {
        let fault = fields.refuse(
            "input",
            "contradiction",
            "the crank of a Geneva wheel turns",
        );
        fault.hints.push("name something that turns".to_owned());
        return None;
    }
    let position = slots.map(|slots| {
        let slots = u32::try_from(slots).unwrap_or(24);
        PositionSpec::Custom(CustomPosition(Arc::new(Geneva { slots })))
    });
    let rules = Rules::of(Coordinate::Turning);
    let chain = read_behind(fields, context, context.driver, &rules, position)?;
    Some(Box::new(GenevaWheel { chain }))
}

/// The kind, for a registry.
pub(crate) const KIND: Kind = Kind {
    name: "geneva_wheel",
    doc: "A Geneva wheel: turns by one slot in a turn of its crank, and stands in between.",
    inputs: Inputs::One,
    outputs: Kind::no_outputs,
    coordinate: |_| Some(Coordinate::Turning),
    read,
};
