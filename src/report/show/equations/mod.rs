//! The equations of motion of a scene, written out.
//!
//! One section an object, drivers first. Inside a section letters with a mass
//! number belong to that object; letters with a word belong to the object (or
//! the load) of that name: φ_shaft is the displacement of the last mass of
//! `shaft`. Long chains are abbreviated: first, generic and last mass.

mod chain;
mod closure;
mod contact;
mod contact_force;
mod inputs;
mod latex;
mod linkage;
mod loads;
#[cfg(feature = "live")]
mod mathml;
mod multi_input;
mod output;
mod sources;
mod text;

pub(crate) use inputs::summary as inputs_summary;
pub use latex::latex;
pub use loads::{stop_words, summary as load_summary};
#[cfg(feature = "live")]
pub(in crate::report) use mathml::mathml;
pub use text::text;

use crate::dynamics::model::{LinkageBody, Model, NodeIndex, NodeMotion, OUTPUT, STOP};
use crate::report::math::{Expr, Index, Symbol, symbol};
use crate::report::order::drivers_first;
use std::borrow::Cow;

/// Chains with more masses than this are abbreviated.
const LONGEST_WRITTEN_OUT: usize = 4;

/// Notation: how to read the letters, above the equations.
const NOTATION: &str = "Letters with a mass number belong to the object of their section. Letters \
                        with a word belong to the object or load of that name. φ_shaft is the \
                        displacement of the last mass of shaft. The section of rocker has F_rocker \
                        and U_rocker as F and U. Dots: derivatives with respect to time; primes: \
                        with respect to the driver's displacement.";

/// The equations of a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Equations {
    /// Sections, one an object, drivers first.
    pub sections: Vec<Section>,
}

/// The equations of one object.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Section {
    /// Id of the object.
    pub object: String,
    /// `rocker, 2 masses, driven by shaft`.
    pub heading: String,
    /// The equations.
    pub lines: Vec<Line>,
    /// Legend of the letters.
    pub legend: Vec<Entry>,
}

/// Line with one equation.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Left of the sign.
    pub left: Expr,
    /// Right of it.
    pub right: Expr,
    /// Remark: `m = 2 … 9`; may be empty.
    pub remark: String,
}

/// Entry of a legend.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// The letter, or the first and last of a row of them.
    pub symbol: Expr,
    /// The last of a row, if the entry stands for several.
    pub until: Option<Expr>,
    /// The values: one, or one each.
    pub values: Vec<f64>,
    /// Unit of the values.
    pub unit: Cow<'static, str>,
    /// Meaning of the letter.
    pub meaning: Cow<'static, str>,
}

impl Entry {
    /// True when the entry stands for just two letters, which are both named.
    fn adjacent(&self) -> bool {
        let mass = |expr: &Expr| match expr {
            Expr::Symbol(symbol) => match symbol.index {
                Index::Mass(number) => Some(number),
                _ => None,
            },
            _ => None,
        };
        mass(&self.symbol) == Some(1) && self.until.as_ref().and_then(mass) == Some(2)
    }
}

impl Section {
    fn line(&mut self, left: impl Into<Expr>, right: impl Into<Expr>, remark: impl Into<String>) {
        self.lines.push(Line {
            left: left.into(),
            right: right.into(),
            remark: remark.into(),
        });
    }

    fn add_entry(
        &mut self,
        letter: Symbol,
        value: f64,
        unit: impl Into<Cow<'static, str>>,
        meaning: impl Into<Cow<'static, str>>,
    ) {
        self.legend.push(Entry {
            symbol: letter.expr(),
            until: None,
            values: vec![value],
            unit: unit.into(),
            meaning: meaning.into(),
        });
    }
}

/// Writes out the equations of a model.
pub fn equations(model: &Model) -> Equations {
    let objects = drivers_first(model).into_iter();
    // (A stop is a load on the mass that it stops.)
    // (What is a linkage of several inputs stands in its own equations.)
    let shown = objects.filter(|&object| {
        let hidden = is_unconnected_output(model, object) || multi_input::is_part(model, object);
        !hidden && model.objects[object].kind != STOP
    });
    let sections = shown.map(|object| {
        if let Some(body) = multi_input::of(model, object) {
            return multi_input::section(model, object, body);
        }
        let first = model.objects[object].nodes.first();
        match first.map(|&node| &model.nodes[node].motion) {
            Some(NodeMotion::Mass { .. }) => chain::section(model, object),
            Some(NodeMotion::Rigid { law }) => sources::rigid(model, object, law),
            Some(NodeMotion::Rotor { .. }) => sources::rotor(model, object),
            Some(NodeMotion::Prescribed { motion, .. }) => {
                sources::section_of_prescribed(model, object, motion)
            }
            // The node on which inputs are combined is no object by itself.
            Some(NodeMotion::Constrained { .. }) | None => Section::default(),
        }
    });
    Equations {
        sections: sections.collect(),
    }
}

/// True for an output of a linkage on which nothing hangs.
fn is_unconnected_output(model: &Model, object: usize) -> bool {
    let part = &model.objects[object];
    let drives = |other: &crate::dynamics::model::ObjectPart| other.is_driven_by(object);
    part.kind == OUTPUT && !model.objects.iter().any(drives)
}

/// The letter with an object's id: φ_shaft.
fn of_object(letter: &'static str, model: &Model, object: usize) -> Symbol {
    let shown = output::owner(model, object);
    symbol(letter, Index::Word(model.objects[shown].id.clone()))
}

/// The letter with the number of a mass.
fn of_mass(letter: &'static str, mass: usize) -> Symbol {
    symbol(letter, Index::Mass(mass))
}

/// The linkage whose input is a node.
fn linkage_of(model: &Model, node: NodeIndex) -> Option<&LinkageBody> {
    model.linkages.iter().find(|body| body.node == node)
}

/// Terms that the followers of a node add to its equation, moved to the node by the
/// transfer functions of the rigid objects in between.
struct ReflectedTerms {
    /// Factors of φ̈ on the left: J·U′².
    inertia: Vec<Expr>,
    /// Factors of φ̇² on the left: J·U′·U″.
    bias: Vec<Expr>,
    /// Terms on the right: F·U′ of elastic followers, W·U′ of rigid ones.
    force: Vec<Expr>,
}

/// Gathers what the followers of `object` add.
fn reflected(model: &Model, object: usize) -> ReflectedTerms {
    let mut out = ReflectedTerms {
        inertia: Vec::new(),
        bias: Vec::new(),
        force: Vec::new(),
    };
    descend(model, object, None, &mut out);
    out
}

/// First and second transfer function from the node to a rigid object below it.
#[derive(Clone)]
struct Transfer {
    first: Expr,
    second: Expr,
}

fn descend(model: &Model, driver: usize, above: Option<&Transfer>, out: &mut ReflectedTerms) {
    let followers = (0..model.objects.len()).filter(|&o| {
        let part = &model.objects[o];
        part.is_driven_by(driver) && part.kind != STOP && part.is_reported()
    });
    for follower in followers {
        let object = &model.objects[follower];
        if object.inputs.len() > 1 {
            // It has a force of its own, however many coordinates its inertia couples.
            for pull in inputs::pulls(model, follower, driver) {
                out.force.push(match above {
                    Some(transfer) => pull.times(transfer.first.clone()),
                    None => pull,
                });
            }
            continue;
        }
        let function = of_object("U", model, follower);
        let (prime, double) = (function.clone().prime(), function.prime().prime());
        let Some(NodeMotion::Rigid { .. }) = object.nodes.first().map(|&n| &model.nodes[n].motion)
        else {
            let pull = of_object("F", model, follower).expr().times(prime);
            out.force.push(match above {
                Some(transfer) => pull.times(transfer.first.clone()),
                None => pull,
            });
            continue;
        };
        let transfer = match above {
            None => Transfer {
                first: prime.expr(),
                second: double.expr(),
            },
            // The chain rule: (U(V))′ = U′V′, (U(V))″ = U′V″ + U″V′².
            Some(above) => Transfer {
                first: prime.clone().expr().times(above.first.clone()),
                second: prime
                    .expr()
                    .times(above.second.clone())
                    .plus(double.expr().times(above.first.clone().squared())),
            },
        };
        let node = object.nodes[0];
        if model.nodes[node].inertia > 0.0 {
            let inertia = of_object("J", model, follower).expr();
            let (first, second) = (transfer.first.clone(), transfer.second.clone());
            out.inertia
                .push(inertia.clone().times(first.clone().squared()));
            out.bias.push(inertia.times(first).times(second));
        }
        let linkage = linkage_of(model, node);
        if linkage.is_some() {
            let inertia = of_object("J", model, follower);
            let (first, second) = (transfer.first.clone(), transfer.second.clone());
            let half_slope = Expr::Number(0.5).times(inertia.clone().prime());
            out.inertia
                .push(inertia.clone().expr().times(first.clone().squared()));
            out.bias
                .push(inertia.expr().times(first.clone()).times(second));
            out.bias
                .push(half_slope.times(Expr::Power(Box::new(first), 3)));
        }
        let forces = linkage.is_some_and(|body| linkage::Parts::of(body).has_force());
        if forces || model.loads.iter().any(|load| load.node == node) {
            let load = of_object("W", model, follower).expr();
            out.force.push(load.times(transfer.first.clone()));
        }
        descend(model, follower, Some(&transfer), out);
    }
}

/// The left side of a node's equation: (J + reflected)·φ̈ + bias·φ̇².
fn inertia_side(own: Expr, displacement: &Symbol, reflected: &ReflectedTerms) -> Expr {
    let rate = displacement.clone().rate();
    let mut inertia = vec![own];
    inertia.extend(reflected.inertia.iter().cloned());
    let mut terms = vec![Expr::sum(inertia).times(rate.clone().rate())];
    if !reflected.bias.is_empty() {
        terms.push(Expr::sum(reflected.bias.clone()).times(rate.expr().squared()));
    }
    Expr::sum(terms)
}

/// A line that says which name the object's output has.
fn output_name(model: &Model, object: usize, section: &mut Section, last: Symbol) {
    if model.objects.iter().any(|other| other.is_driven_by(object)) {
        section.line(
            of_object("φ", model, object),
            last,
            "what the followers see",
        );
    }
}

/// One entry for a letter's values: each by itself, or all in a row.
fn list(
    section: &mut Section,
    letter: &'static str,
    values: Vec<f64>,
    unit: &'static str,
    meaning: &'static str,
) {
    let count = values.len();
    let equal = values.windows(2).all(|pair| pair[0] == pair[1]);
    if count == 1 || (count <= LONGEST_WRITTEN_OUT && !equal) {
        for (place, value) in values.into_iter().enumerate() {
            section.add_entry(of_mass(letter, place + 1), value, unit, meaning);
        }
        return;
    }
    section.legend.push(Entry {
        symbol: of_mass(letter, 1).expr(),
        until: Some(of_mass(letter, count).expr()),
        values: if equal { values[..1].to_vec() } else { values },
        unit: unit.into(),
        meaning: meaning.into(),
    });
}

#[cfg(test)]
mod closure_tests;
#[cfg(test)]
mod tests;
