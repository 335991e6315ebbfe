//! What the verdicts of a map mean.

use crate::report::quantity::significant;
use crate::studies::map::{
    MOST_STEPS, NEAR_HARMONIC, RESONANCE, STEADY, Study, THROWN_OFF, Verdict,
};
use crate::studies::spread::CHANGE;

/// What a ring upon a cell means.
pub(super) fn not_determined(study: &Study<'_>) -> String {
    format!(
        "A ring upon a cell: the loads changed by one part in {} move the figure by more than \
         {} of its scale (ten times the tolerance of a general method, where that is more), so \
         that nobody knows it to the {} digits asked for. The verdict on the mechanism holds; how \
         far every figure moves is in map.csv.",
        significant(1.0 / CHANGE, 2),
        significant(10f64.powi(-i32::from(study.digits)), 2),
        study.digits
    )
}

/// Meaning of a verdict, with the bounds it rests on.
pub(super) fn meaning(verdict: Verdict) -> String {
    match verdict {
        Verdict::InWorkingOrder => "No pair opens in the whole run.".to_owned(),
        Verdict::LiftOffDiesAway => {
            "A pair opens after the start, and not in the window of steady figures.".to_owned()
        }
        Verdict::LiftOff => {
            "A pair opens in the window of steady figures: the mechanism is not in \
             working order. Of a rigid object: its motion needs a pull."
                .to_owned()
        }
        Verdict::LiftOffNotJudged => {
            "A pair opens, and the run has no window of steady figures: give it three turns of \
             the drive or more."
                .to_owned()
        }
        Verdict::CreepNotJudged => {
            "No pair opens, and an object creeps under regularised friction. Dry friction would \
             hold it: a smaller width makes the creep slower."
                .to_owned()
        }
        Verdict::NotJudged => {
            "No pair opens, and the run has no window of steady figures: give it three turns of \
             the drive or more."
                .to_owned()
        }
        Verdict::ThrownOff => format!(
            "A pair opens in the window of steady figures and the object leaves its law by more \
             than {THROWN_OFF} times the amplitude of the law."
        ),
        Verdict::Resonance => format!(
            "No pair opens, and over the last cycle the deviation is at least {RESONANCE} times \
             the quasi-static one, is not dying away (less than {} % a cycle), and a natural \
             frequency lies near a harmonic of the drive: one mode would magnify it at least \
             {NEAR_HARMONIC} times.",
            100.0 * STEADY
        ),
        Verdict::Stopped => "The mechanism reaches a dead position.".to_owned(),
        Verdict::NotFinished => format!(
            "More than {MOST_STEPS} steps, or more switches than `run.max_switches` allows, were \
             needed. Nothing wrong was found up to there, and the cell has no value."
        ),
        Verdict::NumericalFailure => "The computation failed: the method gave up, a number was \
             not finite, the energies do not balance or the equations of motion are not kept. It \
             says nothing about the mechanism. Cells whose motion between switches is known in \
             closed form, and whose figure needs no record, are not audited: dam run audits such \
             a scene."
            .to_owned(),
        Verdict::Refused => "The scene is refused at these values.".to_owned(),
    }
}
