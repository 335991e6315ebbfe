//! The ways in which the inputs of a differential combine: ratios at the inputs, a planetary
//! gear, a lever, or a constraint given in code.

use super::{Input, InputStatement};
use crate::dynamics::model::Coordinate;
use crate::frontend::read::{Bounds, Fields, OWN};
use crate::kinematics::constraint::ConstraintFunction;
use crate::units::quantities as q;
use std::sync::Arc;

/// The way in which the inputs combine.
pub(super) enum Combination {
    /// By the ratio at each input.
    Ratios,
    /// A planetary gear with its basic ratio (ring held: φ_sun/φ_carrier = 1 − i₀).
    Planetary(f64),
    /// A lever whose output is at this place.
    Lever(f64),
    /// By a constraint given in code.
    Own(Arc<dyn ConstraintFunction>),
}

/// `planetary` or `lever`; without them the ratios stand at the inputs.
pub(super) fn read_combination(fields: &mut Fields<'_>) -> Option<Combination> {
    let doc = "A planetary gear: two of its inputs `sun`, `ring` and `carrier` drive the third.";
    let planetary = fields.maybe("planetary", doc, |slot| {
        slot.record(|fields| {
            let mut ratio = fields.one_of("the gear");
            ratio.case(
                "basic_ratio",
                "φ_sun/φ_ring with the carrier held: negative where a ring gear turns the other way.",
                |slot| slot.number(Bounds::NOT_ZERO),
            );
            ratio.case(
                "teeth",
                "Tooth numbers of sun and ring gear.",
                |slot| {
                    slot.record(|fields| {
                        let doc = "Teeth of the sun gear.";
                        let sun = fields.need("sun", doc, |slot| slot.count(1..=100_000));
                        let doc = "Teeth of the ring gear.";
                        let ring = fields.need("ring", doc, |slot| slot.count(1..=100_000));
                        Some(-(ring? as f64) / sun? as f64)
                    })
                },
            );
            let ratio = ratio.finish()?;
            if ratio == 1.0 {
                let message = "with a basic ratio of 1 sun and ring turn as one";
                fields.refuse("basic_ratio", "out-of-range", message);
                return None;
            }
            Some(ratio)
        })
    });
    let doc = "A lever that sums by its arms: each input acts `at` a place along it.";
    let lever = fields.maybe("lever", doc, |slot| {
        slot.record(|fields| {
            let doc = "Place of the output along the lever";
            fields.need("output", doc, |slot| slot.quantity(q::LENGTH, Bounds::ANY))
        })
    });
    let own = fields.own("A constraint given in code.");
    let why = "the inputs are summed in one way";
    let ways = [("planetary", "lever"), (OWN, "planetary"), (OWN, "lever")];
    let clashes = ways.map(|(one, other)| fields.clash(one, other, why));
    let (planetary, lever) = (planetary?, lever?);
    if clashes.contains(&true) {
        return None;
    }
    if let Some(own) = own {
        return Some(Combination::Own(own));
    }
    Some(match (planetary, lever) {
        (Some(ratio), _) => Combination::Planetary(ratio),
        (None, Some(output)) => Combination::Lever(output),
        (None, None) => Combination::Ratios,
    })
}

/// The ratios of all inputs.
pub(super) fn read_combine(
    fields: &mut Fields<'_>,
    written: &[InputStatement],
    combination: &Combination,
    own: Coordinate,
) -> Option<Vec<Input>> {
    let before = fields.faults();
    if written.len() < 2 {
        let message = "one input is nothing to sum";
        let fault = fields.refuse("inputs", "contradiction", message);
        let hint =
            "name at least two inputs; one driver is enough for `shaft`, `crank` and the like";
        fault.hints.push(hint.to_owned());
        return None;
    }
    let inputs: Vec<Option<f64>> = match combination {
        Combination::Ratios => (written.iter())
            .map(|input| read_own_ratio(fields, input))
            .collect(),
        Combination::Planetary(ratio) => read_planetary(fields, written, *ratio, own)?,
        Combination::Lever(output) => read_lever(fields, written, *output, own)?,
        Combination::Own(constraint) => {
            read_coded_constraint_ratios(fields, written, constraint.drivers())?
        }
    };
    let named = written.iter().zip(inputs);
    let inputs = named.map(|(input, ratio)| {
        let name = input.name.clone();
        ratio.map(|ratio| Input { name, ratio })
    });
    let inputs: Option<Vec<Input>> = inputs.collect();
    inputs.filter(|_| fields.faults() == before)
}

/// A constraint given in code knows its gradient itself.
fn read_coded_constraint_ratios(
    fields: &mut Fields<'_>,
    written: &[InputStatement],
    drivers: usize,
) -> Option<Vec<Option<f64>>> {
    if drivers != written.len() {
        let message = format!(
            "the constraint has {drivers} drivers, not {}",
            written.len()
        );
        fields.refuse("inputs", "contradiction", message);
        return None;
    }
    for input in written {
        if input.ratio.is_some() {
            refuse_property(
                fields,
                input,
                "ratio",
                "the ratio follows from the constraint",
            );
        }
        if input.at.is_some() {
            refuse_property(fields, input, "at", "`at` goes with `lever` only");
        }
    }
    Some(vec![Some(1.0); drivers])
}

fn read_own_ratio(fields: &mut Fields<'_>, input: &InputStatement) -> Option<f64> {
    if input.at.is_some() {
        refuse_property(fields, input, "at", "`at` goes with `lever` only");
        return None;
    }
    if input.ratio.is_none() {
        let message = format!("input `{}` has no ratio", input.name);
        let fault = fields.refuse("inputs", "missing", message);
        let hint = "give every input a `ratio`, or describe a `planetary` gear or a `lever`";
        fault.hints.push(hint.to_owned());
    }
    input.ratio
}

/// φ_sun − i₀·φ_ring = (1 − i₀)·φ_carrier, solved for the member that is no input.
fn read_planetary(
    fields: &mut Fields<'_>,
    written: &[InputStatement],
    ratio: f64,
    own: Coordinate,
) -> Option<Vec<Option<f64>>> {
    const MEMBERS: [&str; 3] = ["sun", "ring", "carrier"];
    let coefficient = |name: &str| match name {
        "sun" => 1.0,
        "ring" => -ratio,
        _ => ratio - 1.0,
    };
    for input in written {
        if !MEMBERS.contains(&input.name.as_str()) {
            let message = format!("a planetary gear has no `{}`", input.name);
            let fault = fields.refuse("inputs", "unknown-choice", message);
            let hint = "its inputs are two of `sun`, `ring` and `carrier`: the third is the output";
            fault.hints.push(hint.to_owned());
            return None;
        }
        if input.ratio.is_some() {
            refuse_property(fields, input, "ratio", "the ratio follows from `planetary`");
        }
        if input.at.is_some() {
            refuse_property(fields, input, "at", "`at` goes with `lever` only");
        }
        if input.driver == Some(Coordinate::Sliding) {
            refuse_property(
                fields,
                input,
                "object",
                "it slides, and the members of a gear turn",
            );
        }
    }
    if written.len() != 2 || own == Coordinate::Sliding {
        let message = match own {
            Coordinate::Sliding => "the members of a planetary gear turn",
            Coordinate::Turning => {
                "of a planetary gear two members are inputs, the third is the output"
            }
        };
        fields.refuse("planetary", "contradiction", message);
        return None;
    }
    let output = MEMBERS
        .into_iter()
        .find(|name| written.iter().all(|one| one.name != *name));
    let own = coefficient(output?);
    Some(
        written
            .iter()
            .map(|one| Some(-coefficient(&one.name) / own))
            .collect(),
    )
}

/// A stiff lever through two points: the output's displacement is the linear function
/// through those of the inputs.
fn read_lever(
    fields: &mut Fields<'_>,
    written: &[InputStatement],
    output: f64,
    own: Coordinate,
) -> Option<Vec<Option<f64>>> {
    for input in written {
        if input.ratio.is_some() {
            refuse_property(fields, input, "ratio", "the ratio follows from `lever`");
        }
        if input.driver == Some(Coordinate::Turning) {
            refuse_property(
                fields,
                input,
                "object",
                "it turns, and the points of a lever slide",
            );
        }
    }
    let places = written
        .iter()
        .map(|input| input.at)
        .collect::<Option<Vec<f64>>>();
    let (Some(&[one, other]), Coordinate::Sliding) = (places.as_deref(), own) else {
        let message = match own {
            Coordinate::Turning => {
                "the points of a lever slide: give `\"coordinate\": \"sliding\"`"
            }
            Coordinate::Sliding => "a lever has two inputs, each `at` a place along it",
        };
        fields.refuse("lever", "contradiction", message);
        return None;
    };
    let ratios = [
        (other - output) / (other - one),
        (output - one) / (other - one),
    ];
    if ratios
        .iter()
        .any(|ratio| !ratio.is_finite() || *ratio == 0.0)
    {
        let message = "both inputs and the output are at three different places of a lever";
        fields.refuse("lever", "contradiction", message);
        return None;
    }
    Some(ratios.map(Some).to_vec())
}

fn refuse_property(fields: &mut Fields<'_>, input: &InputStatement, property: &str, message: &str) {
    let inputs = fields.member("inputs").map(|member| &member.value);
    let own = inputs.and_then(|inputs| inputs.get(&input.name)?.get(property));
    let place = own.map(|value| value.place.clone());
    let path = format!("{}.inputs.{}.{property}", fields.path(), input.name);
    let fault = fields.refuse("inputs", "contradiction", message);
    fault.path = path;
    if let Some(place) = place {
        fault.place = Some(place);
    }
}
