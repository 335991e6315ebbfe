//! Whether the numbers of a body overflow once they are combined.

use crate::frontend::object::spec::{BodySpec, Level};
use crate::frontend::read::Fields;

/// True when its numbers do not overflow once they are combined.
pub(in crate::frontend::object) fn is_sound(body: &BodySpec) -> bool {
    match body {
        BodySpec::Open(uniform) => is_sound(&uniform.at(Level::Modes { count: 1 })),
        BodySpec::Rigid { inertia } => inertia.is_finite(),
        BodySpec::Uniform {
            inertia,
            stiffness,
            damping_capacity,
            masses,
            ..
        } => {
            let chain = stiffness * *masses as f64;
            let frequency = (chain * *masses as f64 / inertia).sqrt();
            let damping = damping_capacity * chain / frequency;
            frequency.is_finite() && frequency > 0.0 && damping.is_finite()
        }
        BodySpec::Modes {
            inertia,
            stiffness,
            damping_capacity,
            modes,
            ..
        } => {
            let frequency = (stiffness / inertia).sqrt();
            let fastest = 8.0 * *modes as f64 * frequency;
            let damping = damping_capacity * stiffness / frequency;
            (fastest * fastest).is_finite() && frequency > 0.0 && damping.is_finite()
        }
        BodySpec::Lists {
            inertias,
            stiffnesses,
            dampings,
        } => {
            let all = [inertias, stiffnesses, dampings];
            all.into_iter().flatten().all(|value| value.is_finite())
                && inertias.iter().chain(stiffnesses).all(|value| *value > 0.0)
        }
    }
}

/// Refuses numbers that overflow once they are combined.
pub(super) fn check_overflow(fields: &mut Fields<'_>, body: BodySpec) -> Option<BodySpec> {
    if is_sound(&body) {
        return Some(body);
    }
    let name = if fields.has("stiffness") {
        "stiffness"
    } else {
        "inertia"
    };
    fields
        .refuse(
            name,
            "out-of-range",
            "these numbers give no finite natural frequency and damping",
        )
        .hints
        .push("inertia, stiffness and damping are in SI units".to_owned());
    None
}
