//! Friction on a mass: dry, which sticks, or regularised, which creeps.

use super::read_number;
use crate::dynamics::builder::written::Names;
use crate::dynamics::laws::{FRICTION, LawInstance};
use crate::dynamics::model::DryFriction;
use crate::frontend::object::measures::Measures;
use crate::frontend::object::spec::LoadLawSpec;
use crate::frontend::object::written;
use crate::frontend::read::{Bounds, Fields, Slot};
use crate::math::expression::Expression;

/// Which law it is, with the force of sliding.
enum Kind {
    Dry(f64),
    Regularised(f64),
}

/// Properties that only one of the laws has.
struct Others {
    most: Option<f64>,
    stribeck_speed: Option<f64>,
    width: Option<f64>,
    engagement: Option<Expression>,
}

/// Reads either law: `sliding` stands for friction that sticks, `force` for the regularised one.
pub(super) fn read(slot: Slot<'_>, own: Measures, names: &Names) -> Option<LoadLawSpec> {
    slot.record(|fields| {
        let [force, width] = FRICTION.parameters else {
            return None;
        };
        let mut kind = fields.one_of("its force");
        let doc = "Friction while it slides; at rest it sticks, up to `static`";
        kind.case("sliding", doc, |slot| {
            let force = slot.quantity(own.force(), Bounds::NOT_NEGATIVE)?;
            Some(Kind::Dry(force))
        });
        let doc = "Force of friction that is regularised over a `width`: it creeps";
        kind.case(force.key, doc, |slot| {
            Some(Kind::Regularised(read_number(slot, force, own)?))
        });
        let kind = kind.finish();
        let doc = "With `sliding`: greatest force that holds it at rest; default `sliding`";
        let most = fields.maybe("static", doc, |slot| {
            slot.quantity(own.force(), Bounds::NOT_NEGATIVE)
        });
        let doc = "With `static`: speed over which friction falls from `static` towards \
                   `sliding`, F = sliding + (static − sliding)·exp(−|φ̇|/stribeck_speed); without \
                   it at once";
        let stribeck_speed = fields.maybe("stribeck_speed", doc, |slot| {
            slot.quantity(own.speed(), Bounds::POSITIVE)
        });
        let doc = "With `force`: speed at which 76 % of the force is reached";
        let width = fields.maybe(width.key, doc, |slot| read_number(slot, width, own));
        let doc = "With `sliding`: factor by which a clutch or a brake is pressed, 0 where it is \
                   below. An expression as of a load, \"t < 0.2 ? 0 : 1\"";
        let engagement = fields.maybe("engagement", doc, |slot| {
            written::read_expression(slot, names)
        });
        let others = Others {
            engagement: engagement?,
            most: most?,
            stribeck_speed: stribeck_speed?,
            width: width?,
        };
        match kind? {
            Kind::Dry(sliding) => dry(fields, sliding, others),
            Kind::Regularised(force) => regularised(fields, force, &others),
        }
    })
}

fn dry(fields: &mut Fields<'_>, sliding: f64, others: Others) -> Option<LoadLawSpec> {
    if others.width.is_some() {
        let message = "friction that sticks has no `width`";
        let hint = "remove `width`, or give `force` in place of `sliding`: regularised friction, \
                    which creeps";
        fields.forbid("width", message, hint);
        return None;
    }
    if others.stribeck_speed.is_some() && others.most.is_none() {
        let hint = "give the friction at rest as `static`, or remove `stribeck_speed`";
        fields.forbid("stribeck_speed", "`stribeck_speed` without `static`", hint);
        return None;
    }
    if others.most.is_some_and(|most| most < sliding) {
        let message = "`static` is less than `sliding`";
        let refused = fields.refuse("static", "out-of-range", message);
        refused.hints.push(
            "friction at rest is at least that of sliding; remove `static` where they are equal"
                .to_owned(),
        );
        return None;
    }
    let friction = DryFriction {
        sliding,
        static_limit: others.most.unwrap_or(sliding),
        stribeck_speed: others.stribeck_speed,
    };
    Some(LoadLawSpec::Dry {
        friction,
        engagement: others.engagement,
        over: None,
    })
}

fn regularised(fields: &mut Fields<'_>, force: f64, others: &Others) -> Option<LoadLawSpec> {
    let dry = [
        ("static", others.most.is_some()),
        ("stribeck_speed", others.stribeck_speed.is_some()),
        ("engagement", others.engagement.is_some()),
    ];
    if let Some((key, _)) = dry.into_iter().find(|(_, given)| *given) {
        let message = format!("regularised friction has no `{key}`");
        let hint = "give `sliding` in place of `force` and `width`";
        fields.forbid(key, &message, hint);
        return None;
    }
    let Some(width) = others.width else {
        let hint = "`width`, over which it is regularised; or `sliding` in place of `force`, which \
                    sticks";
        fields.note_missing("width", Some(hint.to_owned()));
        return None;
    };
    let values = [force, width];
    Some(LoadLawSpec::Declared(LawInstance::new(&FRICTION, values)))
}
