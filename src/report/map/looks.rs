//! How verdicts look: hatching over the colours of values, plain fills where
//! there is no value. Mechanism and computation never look alike.

use crate::studies::map::Verdict;

/// Fill of cells of a verdict under their hatching, when they have no value.
pub(super) fn ground(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::NumericalFailure => "#b3124f",
        Verdict::Stopped => "#7d8791",
        Verdict::Refused => "#eceff2",
        _ => "#c9cfd5",
    }
}

/// Colour of a verdict where there is no colour of values: in strips under
/// curves and in legends.
pub(super) fn plain(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::InWorkingOrder => "#2f8f5b",
        Verdict::LiftOffDiesAway => "#8db8d8",
        Verdict::LiftOff => "#2d6aa8",
        Verdict::LiftOffNotJudged => "#6f8396",
        Verdict::ThrownOff => "#16324f",
        Verdict::Resonance => "#d98a1c",
        other => ground(other),
    }
}

/// Name of the hatching of a verdict; empty: left plain.
pub(super) fn hatching(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::InWorkingOrder => "",
        Verdict::LiftOffDiesAway => "dam-dies",
        Verdict::LiftOff => "dam-lifts",
        Verdict::LiftOffNotJudged => "dam-unjudged",
        Verdict::ThrownOff => "dam-thrown",
        Verdict::Resonance => "dam-resonance",
        Verdict::Stopped => "dam-stopped",
        Verdict::NumericalFailure => "dam-failed",
        Verdict::Refused => "dam-refused",
    }
}
