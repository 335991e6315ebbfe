//! Equations of a contact element in front of an object.

use super::contact_force::{Force, Letters, Motion};
use super::{Section, of_mass};
use crate::dynamics::model::{Closure, ContactElement, ContactForm, Loss, Model, ObjectPart, Pair};
use crate::report::math::{Expr, Index, Relation, Symbol, symbol};
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
    match pair.form {
        _ if contact.point.is_some() => Shape::Point,
        ContactForm::Power { compliance, .. } if compliance > 0.0 => {
            Shape::Series(1.0 / compliance)
        }
        ContactForm::Proportional(Loss::Damper) if link.stiffness < contact.stiffness => {
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
    let magnitude = Expr::Absolute(Box::new(x.clone().expr()));
    let change = symbol("d", Index::None).expr().times(magnitude);
    let motion = Motion {
        size: Expr::Absolute(Box::new(depth.clone())),
        depth,
        rate: x.clone().rate().expr(),
        growth: change.over(symbol("dt", Index::None)),
    };
    match letters().force(&contact.law, motion) {
        Force::Plain(force) => force,
        Force::Dissipating(force, factor) => {
            let zero = Box::new(Expr::Number(0.0));
            force.times(Expr::Greater(zero, Box::new(factor)))
        }
        Force::Reaction => Expr::Words("what holds it on the flank".into()),
    }
}

fn letters() -> Letters {
    Letters {
        stiffness: symbol("k", Index::None),
        damping: symbol("b", Index::Word("contact".into())),
        factor: symbol("χ", Index::None),
        restitution: symbol("e", Index::None),
    }
}

/// What a rigid contact does in an impact; nothing of any other.
pub(super) fn impact(contact: &ContactElement, section: &mut Section) {
    if contact.law.is_rigid() {
        section.line(speed_after_impact(), rebound(), "at an impact");
    }
}

/// ẋ just after an impact.
fn speed_after_impact() -> Expr {
    let after = Index::Word("after".into());
    symbol("x", after).rate().expr()
}

/// −e·ẋ just before it.
fn rebound() -> Expr {
    let before = symbol("x", Index::Word("before".into())).rate();
    letters().restitution.expr().times(before).negative()
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
    let of_contact = (contact.law, contact.stiffness);
    letters().entries(of_contact, ("contact", part.coordinate), section);
    let unit = units(part.coordinate);
    if pair.closure == Closure::Form {
        section.add_entry(symbol("η", Index::None), pair.gap, unit.displacement, "gap");
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
