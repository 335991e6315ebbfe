//! Equations of a contact element in front of an object.

use super::loads::unit_of;
use super::{Section, of_mass};
use crate::dynamics::laws::Measure;
use crate::dynamics::model::{
    Closure, ContactElement, ContactLaw, Coordinate, Elastic, Model, ObjectPart, Pair,
};
use crate::report::math::{Expr, Index, Relation, Symbol, symbol};
use crate::report::show::contact::unit_of_stiffness;
use crate::report::show::units;

/// Shape of the equations: how a contact stands in front of mass 1.
pub(super) enum Shape {
    /// Between law and a massless point, from which link 1 leads on.
    Point,
    /// The body's only link.
    Alone,
    /// In series with link 1, whose stiffness is given.
    Series(f64),
}

/// How the contact of an object stands in front of mass 1.
pub(super) fn shape(model: &Model, contact: &ContactElement, pair: &Pair) -> Shape {
    let link = &model.links[contact.link];
    match pair.form.elastic {
        _ if contact.point.is_some() => Shape::Point,
        Elastic::Power { compliance, .. } if compliance > 0.0 => Shape::Series(1.0 / compliance),
        Elastic::Proportional if link.stiffness < contact.stiffness => {
            Shape::Series(1.0 / (1.0 / link.stiffness - 1.0 / contact.stiffness))
        }
        _ => Shape::Alone,
    }
}

/// Displacement at the far end of the contact.
pub(super) fn far_end(contact: Option<&ContactElement>) -> Symbol {
    match contact.and_then(|contact| contact.point) {
        Some(_) => symbol("φ", Index::Word("contact".into())),
        None => of_mass("φ", 1),
    }
}

/// Meaning of x.
pub(super) fn deformation(contact: Option<&ContactElement>) -> &'static str {
    match contact {
        Some(_) => "deformation of the contact",
        None => "deformation of link 1",
    }
}

/// The pull of the contact at a depth d, of the sign of x.
pub(super) fn pull(contact: &ContactElement, shape: &Shape, depth: Expr, x: &Symbol) -> Expr {
    let depth = match shape {
        // Only its own share of the deformation.
        Shape::Series(_) => {
            let link = symbol("F", Index::None).expr().over(of_mass("c", 1).expr());
            Expr::sum(vec![depth, link.negative()])
        }
        _ => depth,
    };
    // On either flank the penetration grows as |x|: its rate is ẋ·sgn x.
    let size = Expr::Absolute(Box::new(x.clone().expr()));
    let change = symbol("d", Index::None).expr().times(size);
    let letters = Letters {
        stiffness: symbol("k", Index::None),
        damping: damping(),
        factor: symbol("χ", Index::None),
    };
    let size = Expr::Absolute(Box::new(depth.clone()));
    let motion = Motion {
        depth,
        size,
        rate: x.clone().rate().expr(),
        growth: change.over(symbol("dt", Index::None)),
    };
    let (force, factor) = force(&contact.law, &letters, motion);
    let zero = Expr::Number(0.0);
    match (force, factor) {
        (Some(force), Some(factor)) => force.times(Expr::Greater(Box::new(zero), Box::new(factor))),
        (Some(force), None) => force,
        (None, _) => Expr::Words("what holds it on the flank".into()),
    }
}

/// Letters of a contact's numbers.
pub(super) struct Letters {
    pub(super) stiffness: Symbol,
    pub(super) damping: Symbol,
    pub(super) factor: Symbol,
}

/// The motion in a contact: depth and its magnitude, its rate for a damper and for the factor.
pub(super) struct Motion {
    pub(super) depth: Expr,
    pub(super) size: Expr,
    pub(super) rate: Expr,
    pub(super) growth: Expr,
}

/// The force of a contact, and the factor 1 + χ·ṗ of a form that has one; no force of a rigid
/// contact.
pub(super) fn force(
    law: &ContactLaw,
    letters: &Letters,
    motion: Motion,
) -> (Option<Expr>, Option<Expr>) {
    let (form, damping) = law.of_link(0.0);
    let linear = letters.stiffness.clone().expr().times(motion.depth);
    let elastic = match form.elastic {
        Elastic::Proportional => linear,
        Elastic::Power { exponent, .. } => linear.times(power_below(motion.size, exponent)),
        Elastic::Rigid { .. } => return (None, None),
    };
    match form.factor() {
        None if damping == 0.0 => (Some(elastic), None),
        None => {
            let damped = letters.damping.clone().expr().times(motion.rate);
            (Some(elastic.plus(damped)), None)
        }
        Some(0.0) => (Some(elastic), None),
        Some(_) => {
            let growth = letters.factor.clone().expr().times(motion.growth);
            (Some(elastic), Some(Expr::Number(1.0).plus(growth)))
        }
    }
}

/// d^(n − 1).
fn power_below(depth: Expr, exponent: f64) -> Expr {
    match exponent - 1.0 {
        0.5 => Expr::Root(Box::new(depth)),
        other => {
            let logarithm = Expr::Function("ln", Box::new(depth));
            Expr::Function("exp", Box::new(Expr::Number(other).times(logarithm)))
        }
    }
}

fn damping() -> Symbol {
    symbol("b", Index::Word("contact".into()))
}

/// What a rigid contact does in an impact; nothing of any other.
pub(super) fn impact(contact: &ContactElement, section: &mut Section) {
    if contact.law.is_rigid() {
        section.line(after(), rebound(), "at an impact");
    }
}

/// ẋ just after an impact.
fn after() -> Expr {
    let after = Index::Word("after".into());
    symbol("x", after).rate().expr()
}

/// −e·ẋ just before it.
fn rebound() -> Expr {
    let before = symbol("x", Index::Word("before".into())).rate();
    let e = symbol("e", Index::None).expr();
    e.times(before).negative()
}

/// The balance of the massless point.
pub(super) fn balance(contact: &ContactElement, section: &mut Section) {
    let point = far_end(Some(contact));
    let mass = of_mass("φ", 1);
    let stretch = mass.clone().expr().minus(point.clone());
    let rate = mass.rate().expr().minus(point.rate());
    let link = Expr::Sum(vec![
        of_mass("c", 1).expr().times(stretch),
        of_mass("b", 1).expr().times(rate),
    ]);
    let remark = "the point between contact and link 1 is massless";
    section.line(symbol("F", Index::None), link, remark);
}

/// The contact's numbers.
pub(super) fn legend(part: &ObjectPart, pair: &Pair, section: &mut Section) {
    let Some(contact) = part.contact else {
        return;
    };
    let letters = Letters {
        stiffness: symbol("k", Index::None),
        damping: damping(),
        factor: symbol("χ", Index::None),
    };
    let e = symbol("e", Index::None);
    let of_contact = (contact.law, contact.stiffness);
    entries(
        of_contact,
        (letters, e),
        ("contact", part.coordinate),
        section,
    );
    let unit = units(part.coordinate);
    if pair.closure == Closure::Form {
        section.entry(symbol("η", Index::None), pair.gap, unit.displacement, "gap");
    }
}

/// What the letters of a contact stand for, as far as its force has them.
pub(super) fn entries(
    (law, stiffness): (ContactLaw, f64),
    (letters, e): (Letters, Symbol),
    (of, coordinate): (&str, Coordinate),
    section: &mut Section,
) {
    let (form, damping) = law.of_link(0.0);
    if let Some(restitution) = form.restitution() {
        return section.entry(e, restitution, "", "coefficient of restitution");
    }
    let unit = unit_of_stiffness(form, coordinate);
    section.entry(
        letters.stiffness,
        stiffness,
        unit,
        format!("stiffness of the {of}"),
    );
    if damping > 0.0 {
        let unit = unit_of(Measure::Damping, coordinate);
        section.entry(
            letters.damping,
            damping,
            unit,
            format!("damping of the {of}"),
        );
    }
    if let Some(chi) = form.factor().filter(|chi| *chi > 0.0) {
        let unit = unit_of(Measure::TimePerDisplacement, coordinate);
        section.entry(
            letters.factor,
            chi,
            unit,
            format!("dissipation of the {of}"),
        );
    }
}

/// The sign that x has where the only flank of a force closure presses.
pub(super) fn pressing_side(pair: &Pair) -> Relation {
    if pair.opens >= 0.0 {
        Relation::Less
    } else {
        Relation::Greater
    }
}
