//! Differentials: the displacement is a weighted sum of those of several inputs.
//!
//! ```text
//! sun  ──i₁──┐
//!            Σ──pair──○─/\/\─○      φ = i₁·φ₁ + i₂·φ₂ + …  (+ offset)
//! ring ──i₂──┘
//! ```
//!
//! Planetary gears, bevel differentials, summing levers. Parameters: `inputs` by name,
//! each with the `object` that drives it. How they combine, one of `ratio` at every
//! input, `planetary` (tooth numbers or the basic ratio; inputs named `sun`, `ring` or
//! `carrier`) and `lever` (positions of the inputs and the output along a lever).
//! `coordinate`, whether it turns or slides. Inertia (kg·m² or kg), stiffness and the rest of
//! a chain. Equation: the chain's, with U = Σ iₖ·φₖ; input k is loaded with F·iₖ, so that
//! no power is lost. Limits: no inertia of planets of their own, no losses of the mesh,
//! small angles of a lever.

mod combination;

use super::chain::{self, Rules};
use super::drive::COORDINATES;
use super::geometry::Beam;
use super::spec::{ChainSpec, InertiaSplit};
use super::{Context, Inputs, Kind, Measures, ModelBuilder, Object, Place, Port, Ports};
use crate::dynamics::model::Coordinate;
use crate::frontend::read::{Bounds, Fields, Node, Slot};
use crate::kinematics::constraint::{Constraint, ConstraintFunction};
use crate::kinematics::position::PositionSpec;
use crate::units::quantities as q;
use combination::{Combination, read_combination, read_combine};
use serde_json::json;
use std::sync::Arc;

/// A sum of several inputs with a chain of masses behind it, or rigid.
#[derive(Debug)]
pub struct Differential {
    inputs: Vec<Input>,
    offset: f64,
    /// A constraint of the library's user in place of the sum.
    own: Option<Arc<dyn ConstraintFunction>>,
    chain: ChainSpec,
}

/// An input, as it enters the sum.
#[derive(Clone, Debug, PartialEq)]
struct Input {
    name: String,
    /// ∂φ/∂φₖ.
    ratio: f64,
}

fn rules(coordinate: Option<Coordinate>) -> Rules {
    let turning = coordinate == Some(Coordinate::Turning);
    Rules {
        coordinate,
        split: InertiaSplit::Equal,
        beam: if turning { Beam::Shaft } else { Beam::Rod },
        positions: &[],
        geared: true,
        ..Rules::of(Coordinate::Turning)
    }
}

pub(super) const KIND: Kind = Kind {
    inputs: Inputs::Several,
    coordinate: |node| match node.get("coordinate").map(Node::text) {
        None => Some(Coordinate::Turning),
        Some(name) => COORDINATES
            .iter()
            .find(|known| Some(known.0) == name)
            .map(|known| known.1),
    },
    read,
    ..chain::turning(
        "differential",
        "A sum of several inputs: a planetary gear, a differential, a summing lever.",
    )
};

impl Object for Differential {
    fn kind(&self) -> &'static str {
        KIND.name
    }

    fn ports(&self) -> Ports {
        let inputs = self.inputs.iter();
        Ports {
            inputs: inputs
                .map(|input| Port::input(input.name.clone()))
                .collect(),
            ..Ports::source(self.chain.coordinate)
        }
    }

    fn lower(&self, at: &Place, into: &mut ModelBuilder) {
        let ratios = self.inputs.iter().map(|input| input.ratio).collect();
        let constraint = match &self.own {
            Some(own) => Ok(Constraint::Custom(own.clone())),
            None => Constraint::linear(ratios, self.offset),
        };
        let constraint = match constraint {
            Ok(constraint) => constraint,
            Err(faults) => return into.faults(at, "inputs", faults),
        };
        let connected = self.inputs.iter().map(|input| at.input(&input.name));
        let sum = connected.collect::<Option<Vec<_>>>();
        let sum = sum.map(|inputs| into.combine(at, &inputs, constraint));
        into.chain(at, sum.as_ref(), &self.chain);
    }

    fn chain(&self) -> Option<&ChainSpec> {
        Some(&self.chain)
    }

    fn chain_mut(&mut self) -> Option<&mut ChainSpec> {
        Some(&mut self.chain)
    }
}

/// An input as it is written: its name, what drives it, and the ratio given there.
struct InputStatement {
    name: String,
    driver: Option<Coordinate>,
    ratio: Option<f64>,
    at: Option<f64>,
}

fn read(fields: &mut Fields<'_>, context: &Context<'_>) -> Option<Box<dyn Object>> {
    let doc = "Whether it turns or slides.";
    let coordinate = fields.or("coordinate", doc, json!("turning"), |slot| {
        slot.choice(&COORDINATES)
    });
    let own = Measures(coordinate);
    let doc = "What it sums, by name: at least two.";
    let inputs = fields.need("inputs", doc, |slot| {
        slot.names(|name, slot| {
            slot.defined("differential_input", |slot| {
                read_input(slot, name, own, context)
            })
        })
    });
    let combination = read_combination(fields);
    let doc = "Output where every input is at zero; default 0";
    let offset = fields.maybe("offset", doc, |slot| {
        slot.quantity(own.displacement(), Bounds::ANY)
    });
    let position = Some(PositionSpec::Ratio {
        ratio: 1.0,
        offset: 0.0,
    });
    let chain = chain::read_behind(fields, context, coordinate, &rules(coordinate), position);
    let written: Vec<InputStatement> = inputs?;
    let (combination, offset) = (combination?, offset?);
    let inputs = read_combine(fields, &written, &combination, coordinate?)?;
    let own = match combination {
        Combination::Own(constraint) => Some(constraint),
        _ => None,
    };
    if own.is_some() && offset.is_some() {
        let message = "a constraint given in code has no `offset` besides";
        fields.refuse("offset", "contradiction", message);
        return None;
    }
    Some(Box::new(Differential {
        inputs,
        offset: offset.unwrap_or(0.0),
        own,
        chain: chain?,
    }))
}

fn read_input(
    slot: Slot<'_>,
    name: &str,
    own: Measures,
    context: &Context<'_>,
) -> Option<InputStatement> {
    slot.record(|fields| {
        let driver = context.connect(fields, "object", name);
        let of_driver = Measures(driver.flatten());
        let doc = "Factor with which the input enters the sum.";
        let ratio = fields.maybe("ratio", doc, |slot| {
            slot.quantity(own.per(of_driver), Bounds::NOT_ZERO)
        });
        let doc = "Place of the input along the lever, with `lever`";
        let at = fields.maybe("at", doc, |slot| slot.quantity(q::LENGTH, Bounds::ANY));
        Some(InputStatement {
            name: name.to_owned(),
            driver: driver?,
            ratio: ratio?,
            at: at?,
        })
    })
}
