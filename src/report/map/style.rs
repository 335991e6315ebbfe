//! How verdicts look: hatching over the colours of values, plain fills where
//! there is no value. Mechanism and computation never look alike.

use crate::report::plot::palette::map_verdicts as colours;
use crate::studies::map::Verdict;

/// Fill of cells of a verdict under their hatching, when they have no value.
pub(super) fn ground(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::NumericalFailure => colours::NUMERICAL_FAILURE,
        Verdict::Stopped => colours::STOPPED,
        Verdict::Refused => colours::REFUSED,
        Verdict::InWorkingOrder
        | Verdict::LiftOffDiesAway
        | Verdict::LiftOff
        | Verdict::LiftOffNotJudged
        | Verdict::CreepNotJudged
        | Verdict::NotJudged
        | Verdict::ThrownOff
        | Verdict::Resonance
        | Verdict::NotFinished => colours::WITHOUT_VALUE,
    }
}

/// Colour of a verdict where there is no colour of values: in strips under
/// curves and in legends.
pub(super) fn plain(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::InWorkingOrder => colours::IN_WORKING_ORDER,
        Verdict::LiftOffDiesAway => colours::LIFT_OFF_DIES_AWAY,
        Verdict::LiftOff => colours::LIFT_OFF,
        Verdict::LiftOffNotJudged
        | Verdict::NotJudged
        | Verdict::CreepNotJudged
        | Verdict::NotFinished => colours::LIFT_OFF_NOT_JUDGED,
        Verdict::ThrownOff => colours::THROWN_OFF,
        Verdict::Resonance => colours::RESONANCE,
        Verdict::Stopped | Verdict::NumericalFailure | Verdict::Refused => ground(verdict),
    }
}

/// Name of the hatching of a verdict; empty: left plain.
pub(super) fn hatching(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::InWorkingOrder => "",
        Verdict::LiftOffDiesAway => "dam-dies",
        Verdict::LiftOff => "dam-lifts",
        Verdict::LiftOffNotJudged
        | Verdict::NotJudged
        | Verdict::CreepNotJudged
        | Verdict::NotFinished => "dam-unjudged",
        Verdict::ThrownOff => "dam-thrown",
        Verdict::Resonance => "dam-resonance",
        Verdict::Stopped => "dam-stopped",
        Verdict::NumericalFailure => "dam-failed",
        Verdict::Refused => "dam-refused",
    }
}
