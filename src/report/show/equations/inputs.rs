//! Objects with several inputs in the equations: what their inputs ask for together, and
//! what each of them receives.

use super::{Section, of_object};
use crate::dynamics::model::{Coordinate, Model, NodeMotion};
use crate::kinematics::constraint::Constraint;
use crate::report::math::{Expr, Index, Symbol, symbol};
use crate::report::quantity::significant;

/// Motion that the inputs of an object ask for, as formulas.
pub(super) struct InputFormulas {
    /// `sun and ring`, the ids of what drives it.
    pub(super) drivers: String,
    /// Σ i·φ.
    pub(super) place: Expr,
    /// Σ i·φ̇.
    pub(super) rate: Expr,
    /// Σ i·φ̈, and what else there is.
    pub(super) acceleration: Expr,
}

/// What the inputs of an object with several of them ask for; `None`: it has not.
pub(super) fn input_formulas(model: &Model, object: usize) -> Option<InputFormulas> {
    let part = &model.objects[object];
    let (_, constraint) = combination(model, object)?;
    let displacement = |driver: usize| of_object("φ", model, driver);
    let sum = |motion: &dyn Fn(Symbol) -> Expr| {
        let terms = part.inputs.iter();
        let terms = terms.map(|input| {
            let factor = ratio(model, object, &input.port).expr();
            factor.times(motion(displacement(input.driver)))
        });
        terms.collect::<Vec<Expr>>()
    };
    let mut place = sum(&|phi| phi.expr());
    let mut acceleration = sum(&|phi| phi.rate().rate().expr());
    match constraint {
        Constraint::Linear { offset, .. } if *offset != 0.0 => place.push(Expr::Number(*offset)),
        Constraint::Linear { .. } => {}
        Constraint::Custom(function) => {
            let names = part.inputs.iter();
            let names: Vec<String> = names
                .map(|input| displacement(input.driver).expr().unicode())
                .collect();
            place = vec![Expr::Words(function.formula(&names))];
            acceleration.push(Expr::Words("Σ ∂²φ/∂φᵢ∂φⱼ·φ̇ᵢ·φ̇ⱼ".to_owned()));
        }
    }
    let drivers = part.inputs.iter();
    let drivers: Vec<&str> = drivers
        .map(|input| model.objects[input.driver].id.as_str())
        .collect();
    Some(InputFormulas {
        drivers: drivers.join(" and "),
        place: Expr::sum(place),
        rate: Expr::sum(sum(&|phi| phi.rate().expr())),
        acceleration: Expr::sum(acceleration),
    })
}

/// What an object gives back to one of its drivers: F·i for each input that hangs on it.
pub(super) fn pulls(model: &Model, object: usize, driver: usize) -> Vec<Expr> {
    let inputs = model.objects[object].inputs.iter();
    let own = inputs.filter(|input| input.driver == driver);
    let pull = |port: &str| {
        let force = of_object("F", model, object).expr();
        force.times(ratio(model, object, port))
    };
    own.map(|input| pull(&input.port)).collect()
}

/// The ratios of the inputs, for the legend.
pub(super) fn legend(model: &Model, object: usize, section: &mut Section) {
    let part = &model.objects[object];
    let Some((_, Constraint::Linear { ratios, .. })) = combination(model, object) else {
        return;
    };
    for (input, &value) in part.inputs.iter().zip(ratios) {
        let driver = model.objects[input.driver].coordinate;
        let unit = match (part.coordinate, driver) {
            (Coordinate::Sliding, Coordinate::Turning) => "m/rad",
            (Coordinate::Turning, Coordinate::Sliding) => "rad/m",
            _ => "",
        };
        let letter = ratio(model, object, &input.port);
        section.add_entry(letter, value, unit, "ratio of the input");
    }
}

/// The sum that an object's inputs make, in one line: `0.25·sun + 0.75·ring`.
pub(crate) fn summary(model: &Model, object: usize) -> Option<String> {
    let part = &model.objects[object];
    let (_, constraint) = combination(model, object)?;
    let names = part.inputs.iter().map(|input| format!("φ_{}", input.port));
    Some(match constraint {
        Constraint::Linear { ratios, offset } => {
            let mut text = "U =".to_owned();
            for (index, (name, ratio)) in names.zip(ratios).enumerate() {
                let sign = match (index, *ratio < 0.0) {
                    (0, false) => " ",
                    (0, true) => " −",
                    (_, false) => " + ",
                    (_, true) => " − ",
                };
                let size = significant(ratio.abs(), 4);
                text.push_str(&match ratio.abs() {
                    1.0 => format!("{sign}{name}"),
                    _ => format!("{sign}{size}·{name}"),
                });
            }
            if *offset != 0.0 {
                let sign = if *offset < 0.0 { "−" } else { "+" };
                text.push_str(&format!(" {sign} {}", significant(offset.abs(), 4)));
            }
            text
        }
        Constraint::Custom(function) => {
            format!("U = {}", function.formula(&names.collect::<Vec<String>>()))
        }
    })
}

/// The node on which an object's inputs are combined, and how.
fn combination(model: &Model, object: usize) -> Option<(usize, &Constraint)> {
    let node = model.objects[object].combination?;
    match &model.nodes[node].motion {
        NodeMotion::Constrained { constraint, .. } => Some((node, constraint)),
        _ => None,
    }
}

/// The letter of an input's ratio.
fn ratio(model: &Model, object: usize, port: &str) -> Symbol {
    let id = &model.objects[object].id;
    symbol("i", Index::Word(format!("{id}.{port}")))
}
