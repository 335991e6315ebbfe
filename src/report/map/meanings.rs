//! What the verdicts of a map mean.

use crate::report::quantity::significant;
use crate::studies::map::{
    MOST_STEPS, NEAR_HARMONIC, RESONANCE, STEADY, Study, THROWN_OFF, Verdict,
};
use crate::studies::spread::CHANGE;

/// What a ring upon a cell means.
pub(super) fn not_determined(study: &Study<'_>) -> String {
    format!(
        "A ring on a cell: a change of the loads by one part in {} moves the result by more than \
         {} of its scale. (With a general method the bound is at least ten times its tolerance.) \
         It is not determined to {} digits. The verdict on the mechanism holds; how far every figure \
         moves is in map.csv.",
        significant(1.0 / CHANGE, 2),
        significant(10f64.powi(-i32::from(study.digits)), 2),
        study.digits
    )
}

/// Meaning of a verdict, with the bounds it rests on.
pub(super) fn meaning(verdict: Verdict) -> String {
    match verdict {
        Verdict::InWorkingOrder => "No loss of contact in the whole run.".to_owned(),
        Verdict::LiftOffDiesAway => {
            "A contact separates after the start, and not in the window of steady results."
                .to_owned()
        }
        Verdict::LiftOff => {
            "A contact separates in the window of steady results: the mechanism is not in working \
             order. For a rigid object: its motion needs a pull."
                .to_owned()
        }
        Verdict::LiftOffNotJudged => {
            "A contact separates, and the run has no window of steady results: give it three \
             turns of the drive or more."
                .to_owned()
        }
        Verdict::CreepNotJudged => {
            "No loss of contact, and an object creeps under regularised friction. Dry friction \
             would hold it: a smaller width makes the creep slower."
                .to_owned()
        }
        Verdict::NotJudged => {
            "No loss of contact, and the run has no window of steady results: give it three turns \
             of the drive or more."
                .to_owned()
        }
        Verdict::ThrownOff => format!(
            "A contact separates in the window of steady results, and the object deviates from \
             its law by more than {} the amplitude of the law.",
            match THROWN_OFF {
                1.0 => String::new(),
                times => format!("{times} times"),
            }
        )
        .replace("  ", " "),
        Verdict::Resonance => format!(
            "No loss of contact. Over the last cycle the deviation is at least {RESONANCE} times \
             the quasi-static one and does not die away (less than {} % a cycle). A natural \
             frequency is near a harmonic of the drive: one mode would magnify it at least \
             {NEAR_HARMONIC} times.",
            100.0 * STEADY
        ),
        Verdict::Stopped => "The mechanism comes to a dead-centre position.".to_owned(),
        Verdict::NotFinished => format!(
            "More than {MOST_STEPS} steps, or more events than `run.max_switches` allows, were \
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
