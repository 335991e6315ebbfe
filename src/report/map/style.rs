//! How verdicts look: a colour each, and a hatching where the computation or the scene is meant and
//! not the mechanism.

use crate::report::plot::palette::map_verdicts as colours;
use crate::studies::map::Verdict;

/// Colour of a verdict: of cells, of strips under curves, in legends.
pub(super) fn colour(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::InWorkingOrder => colours::IN_WORKING_ORDER,
        Verdict::LiftOffDiesAway => colours::LIFT_OFF_DIES_AWAY,
        Verdict::LiftOff => colours::LIFT_OFF,
        Verdict::ThrownOff => colours::THROWN_OFF,
        Verdict::Resonance => colours::RESONANCE,
        Verdict::Stopped => colours::STOPPED,
        Verdict::LiftOffNotJudged
        | Verdict::NotJudged
        | Verdict::CreepNotJudged
        | Verdict::NotFinished => colours::NOT_JUDGED,
        Verdict::NumericalFailure => colours::NUMERICAL_FAILURE,
        Verdict::Refused => colours::REFUSED,
    }
}

/// Name of the hatching of a verdict; empty: left plain.
pub(super) fn hatching(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::InWorkingOrder
        | Verdict::LiftOffDiesAway
        | Verdict::LiftOff
        | Verdict::ThrownOff
        | Verdict::Resonance
        | Verdict::Stopped
        | Verdict::NotJudged => "",
        // (Of the grey ones those that leave more open.)
        Verdict::LiftOffNotJudged | Verdict::CreepNotJudged | Verdict::NotFinished => {
            "dam-unjudged"
        }
        Verdict::NumericalFailure => "dam-failed",
        Verdict::Refused => "dam-refused",
    }
}
