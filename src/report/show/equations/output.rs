//! Objects whose output is a sum of their masses: those that are reduced to modes behind a
//! contact element. What acts on the output is shared out to the masses as their motions are
//! to it.

use super::{LONGEST_WRITTEN_OUT, Section, list, loads, of_mass, of_object, reflected};
use crate::dynamics::model::{ModalReduction, Model};
use crate::report::math::{Expr, Index, Symbol, symbol};

/// How an object is reduced whose output is a sum of its masses.
pub(super) fn of(model: &Model, object: usize) -> Option<&ModalReduction> {
    model
        .reduction_of(object)
        .filter(|own| own.output.is_some())
}

/// The object that shows a part: of a sum the one whose output it is.
pub(super) fn owner(model: &Model, part: usize) -> usize {
    let object = &model.objects[part];
    match object.driver() {
        Some(driver) if !object.is_reported() => driver,
        _ => part,
    }
}

/// The part that is the sum.
fn sum_of(model: &Model, object: usize) -> Option<usize> {
    let output = of(model, object)?.output?;
    let mut parts = model.objects.iter();
    parts.position(|part| part.nodes.contains(&output))
}

/// What acts on the output: what hangs on it, and the loads that depend on its motion.
fn forces_on_output(model: &Model, object: usize) -> Vec<Expr> {
    let Some(sum) = sum_of(model, object) else {
        return Vec::new();
    };
    let hangs = reflected(model, object);
    let phi = of_object("φ", model, object);
    let mut terms = loads::terms(model, &model.objects[sum], 1);
    terms.extend(hangs.force);
    if !hangs.inertia.is_empty() {
        let acceleration = phi.clone().rate().rate();
        terms.push(Expr::sum(hangs.inertia).times(acceleration).negative());
    }
    if !hangs.bias.is_empty() {
        let square = phi.rate().expr().squared();
        terms.push(Expr::sum(hangs.bias).times(square).negative());
    }
    terms
}

fn reaction_symbol() -> Symbol {
    symbol("R", Index::None)
}

/// The share w·R of a mass in what acts on the output; `None` where nothing does.
pub(super) fn share_of_mass(model: &Model, object: usize, letter: Symbol) -> Option<Expr> {
    let acts = !forces_on_output(model, object).is_empty();
    acts.then(|| letter.expr().times(reaction_symbol()))
}

/// The same of one mass, counted from 1.
pub(super) fn share_of_reaction(model: &Model, object: usize, mass: usize) -> Option<Expr> {
    share_of_mass(model, object, of_mass("w", mass))
}

/// φ of the output, and R where anything acts on it. False where the output is a mass.
pub(super) fn lines(model: &Model, object: usize, section: &mut Section) -> bool {
    let Some(reduced) = of(model, object) else {
        return false;
    };
    let count = reduced.modes.len();
    let term = |mass: usize| of_mass("w", mass).expr().times(of_mass("φ", mass));
    let terms = match count {
        0..=LONGEST_WRITTEN_OUT => (1..=count).map(term).collect(),
        _ => vec![term(1), Expr::Words("…".to_owned()), term(count)],
    };
    let phi = of_object("φ", model, object);
    section.line(phi, Expr::sum(terms), "the output, which followers see");
    let acting = forces_on_output(model, object);
    if !acting.is_empty() {
        section.line(
            reaction_symbol(),
            Expr::sum(acting),
            "what acts on the output",
        );
    }
    true
}

/// The shares w, and the loads on the output.
pub(super) fn legend(model: &Model, object: usize, section: &mut Section) {
    let Some((reduced, sum)) = of(model, object).zip(sum_of(model, object)) else {
        return;
    };
    let shares = reduced.modes.iter().map(|mode| mode.1).collect();
    list(section, "w", shares, "", "share of the output");
    loads::write(model, sum, section);
}
