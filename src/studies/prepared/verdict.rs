//! Verdicts: what became of the mechanism at one point of a map, or why nothing
//! can be said.

use crate::studies::judgement::Judgement;
use serde::{Deserialize, Serialize};

/// Share of the amplitude of its law beyond which an object counts as thrown
/// off: its greatest |δ| exceeds this many times half the stroke of its law. At
/// 1 it no longer follows: resting in the middle of the stroke it would be
/// nearer to where it should be.
pub const THROWN_OFF: f64 = 1.0;

/// Dynamic magnification from which on an engaged motion counts as resonance:
/// max|δ| over the last whole cycle against the quasi-static deflection
/// δ* = (Σ|loads| + J·max|U″φ̇² + U′φ̈|)/c. A load that is applied suddenly, or a
/// jump of the law's acceleration, deflects one undamped mode twice as far as
/// the same load at rest and never further; more than that is built up over
/// many cycles.
pub const RESONANCE: f64 = 2.5;

/// Magnification of one mode from which on a harmonic of the drive counts as
/// near: 1/|1 − (kΩ/ω)²| ≥ 2, so kΩ lies between 0.707 ω and 1.225 ω (steady
/// forced vibration of one mode, damping left out).
pub const NEAR_HARMONIC: f64 = 2.0;

/// Share by which the vibration may shrink from the last cycle but one to the
/// last and still count as periodic (or growing), not as the start dying away.
pub const STEADY: f64 = 0.01;

/// What became of the mechanism at one point of a map.
///
/// Loss of working order belongs to the mechanism, failure to the computation;
/// the two are never mixed: see [`Verdict::family`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Every pair stays engaged over the whole run.
    InWorkingOrder,
    /// Some pair opens, but none within the window of steady figures.
    LiftOffDiesAway,
    /// Some pair opens within the window of steady figures, in every cycle or
    /// in some; a rigid object's pair would.
    LiftOff,
    /// Some pair opens, and the run has no window of steady figures in which to
    /// see whether it goes on.
    LiftOffNotJudged,
    /// No pair opens, and an object creeps under regularised friction where dry friction
    /// would hold it.
    CreepNotJudged,
    /// No pair opens, and the run has no window of steady figures.
    NotJudged,
    /// Some pair opens within the window of steady figures, and the object leaves its law by
    /// more than [`THROWN_OFF`] times the amplitude of the law.
    ThrownOff,
    /// Engaged motion, periodic, [`RESONANCE`] times beyond the quasi-static
    /// deflection, with a natural frequency near a harmonic of the drive.
    Resonance,
    /// The mechanism cannot go on: a dead-centre position.
    Stopped,
    /// The budget of steps or switches was spent before the end of the run. Nothing
    /// wrong was found up to there.
    NotFinished,
    /// The computation failed: the method gave up, a number was not finite, the
    /// energies do not balance or the equations of motion are not kept. The energies
    /// of a cell that is propagated in closed form for its figure alone are not
    /// added up: `dam run` does it.
    NumericalFailure,
    /// There is no such mechanism: the scene is refused at these values.
    Refused,
}

/// Family of verdicts: what they speak of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Family {
    /// The mechanism.
    Mechanism,
    /// The computation.
    Computation,
    /// The scene.
    Scene,
}

impl Verdict {
    /// All verdicts, in the order of legends.
    pub const ALL: [Self; 12] = [
        Self::InWorkingOrder,
        Self::LiftOffDiesAway,
        Self::LiftOff,
        Self::LiftOffNotJudged,
        Self::CreepNotJudged,
        Self::NotJudged,
        Self::ThrownOff,
        Self::Resonance,
        Self::Stopped,
        Self::NotFinished,
        Self::NumericalFailure,
        Self::Refused,
    ];

    /// What is declared of a verdict: name, words, family, and what `dam run` says.
    #[rustfmt::skip]
    fn declared(self) -> (&'static str, &'static str, Family, Option<Judgement>) {
        match self {
            Self::InWorkingOrder => ("in_working_order", "in working order", Family::Mechanism, Some(Judgement::InWorkingOrder)),
            Self::LiftOffDiesAway => ("lift_off_dies_away", "lift-off that dies away", Family::Mechanism, Some(Judgement::InWorkingOrder)),
            Self::LiftOff => ("lift_off", "repeated lift-off", Family::Mechanism, Some(Judgement::NotInWorkingOrder)),
            Self::LiftOffNotJudged => ("lift_off_not_judged", "lift-off, run too short to judge", Family::Mechanism, Some(Judgement::NotJudged)),
            Self::CreepNotJudged => ("creep_not_judged", "creep, not judged", Family::Mechanism, Some(Judgement::NotJudged)),
            Self::NotJudged => ("not_judged", "run too short to judge", Family::Mechanism, Some(Judgement::NotJudged)),
            Self::ThrownOff => ("thrown_off", "far off its law", Family::Mechanism, Some(Judgement::NotInWorkingOrder)),
            Self::Resonance => ("resonance", "resonance", Family::Mechanism, Some(Judgement::InWorkingOrder)),
            Self::Stopped => ("stopped", "dead-centre position", Family::Mechanism, Some(Judgement::NotInWorkingOrder)),
            Self::NotFinished => ("not_finished", "run not finished", Family::Computation, Some(Judgement::NotJudged)),
            Self::NumericalFailure => ("numerical_failure", "computation failed", Family::Computation, Some(Judgement::NotToBeTrusted)),
            Self::Refused => ("refused", "no such mechanism", Family::Scene, None),
        }
    }

    /// Short stable name, as in files: `in_working_order`.
    pub fn name(self) -> &'static str {
        self.declared().0
    }

    /// The verdict of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|verdict| verdict.name() == name)
    }

    /// In words, for legends.
    pub fn words(self) -> &'static str {
        self.declared().1
    }

    /// Family of the verdict.
    pub fn family(self) -> Family {
        self.declared().2
    }

    /// The verdict that `dam run` gives; `None` where there is no such mechanism.
    pub fn judgement(self) -> Option<Judgement> {
        self.declared().3
    }
}

#[cfg(test)]
mod tests {
    use super::Verdict;

    #[test]
    fn names_are_those_of_the_files() {
        for verdict in Verdict::ALL {
            assert_eq!(Verdict::named(verdict.name()), Some(verdict));
            let json = serde_json::to_value(verdict).unwrap();
            assert_eq!(json, verdict.name());
        }
        assert_eq!(Verdict::named("liftoff"), None);
    }
}
