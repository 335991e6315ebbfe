//! The verdict of a run: one of four, from its checks and from what its pairs did.

use super::check::Check;
use crate::dynamics::integrate::PhysicalStop;
use crate::dynamics::record::{EnergyAudit, Figures, ObjectFigures, PairFigures};
use serde::Serialize;

/// The verdict of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Judgement {
    /// The mechanism works: no pair opens in the steady window.
    InWorkingOrder,
    /// A pair opens, or the mechanism stops.
    NotInWorkingOrder,
    /// The run was too short, or was ended, before its working order could be judged; or an
    /// object creeps where dry friction would hold it.
    NotJudged,
    /// The computation failed, or failed a check of its own.
    NotToBeTrusted,
}

/// The figures of a run with its verdict and its checks: the document of a run.
#[derive(Clone, Debug, Serialize)]
pub struct RunDocument<'f> {
    /// The figures.
    #[serde(flatten)]
    pub figures: &'f Figures,
    /// One of four, from the checks and from what the pairs did.
    pub verdict: Judgement,
    /// The checks that the run made of itself.
    pub checks: Vec<Check>,
}

impl<'f> RunDocument<'f> {
    /// The figures of a run, judged.
    pub fn of(figures: &'f Figures) -> Self {
        Self {
            figures,
            verdict: Judgement::of(figures),
            checks: checks(figures),
        }
    }
}

impl Judgement {
    /// In words, with a capital.
    pub fn words(self) -> &'static str {
        match self {
            Self::InWorkingOrder => "In working order",
            Self::NotInWorkingOrder => "Not in working order",
            Self::NotJudged => "Not judged",
            Self::NotToBeTrusted => "Not to be trusted",
        }
    }

    /// The verdict of a run with these figures.
    pub fn of(figures: &Figures) -> Self {
        let made = Made {
            ending: ending(figures),
            time: figures.run.time,
            checks: &checks(figures),
        };
        Self::of_run(made, figures.objects.values())
    }

    /// The verdict on a run, be it one by itself or that of a cell of a map.
    pub fn of_run<'o>(made: Made<'_>, objects: impl Iterator<Item = &'o ObjectFigures>) -> Self {
        // What stops at its very start, as by self-locking, leaves nothing to check.
        let at_start = made.ending == RunEnd::OfMechanism && made.time <= 0.0;
        let checks = if at_start { &[] } else { made.checks };
        let judged = Self::judge_result(made.ending, checks, || Self::of_objects(objects));
        match say_nothing(checks) {
            true => judged.uncertified(),
            false => judged,
        }
    }

    /// The one rule by which every result is judged: how its computation ended and its checks
    /// come before what it says of the mechanism.
    pub fn judge_result(
        ending: RunEnd,
        checks: &[Check],
        mechanism: impl FnOnce() -> Self,
    ) -> Self {
        let checked = checks.iter().all(Check::passed);
        match ending {
            RunEnd::OfComputation => Self::NotToBeTrusted,
            RunEnd::Complete | RunEnd::FromOutside | RunEnd::OfScene | RunEnd::OfMechanism
                if !checked =>
            {
                Self::NotToBeTrusted
            }
            RunEnd::OfMechanism => Self::NotInWorkingOrder,
            RunEnd::FromOutside | RunEnd::OfScene => Self::NotJudged,
            RunEnd::Complete => mechanism(),
        }
    }

    /// What is left of a verdict of a study that leaves something out, as the elasticity of
    /// objects: it certifies nothing.
    #[must_use]
    pub fn uncertified(self) -> Self {
        match self {
            Self::InWorkingOrder | Self::NotJudged => Self::NotJudged,
            Self::NotInWorkingOrder => Self::NotInWorkingOrder,
            Self::NotToBeTrusted => Self::NotToBeTrusted,
        }
    }

    /// The verdict on the objects of a complete run that passed its checks.
    pub fn of_objects<'o>(objects: impl Iterator<Item = &'o ObjectFigures>) -> Self {
        let of_object = |object: &ObjectFigures| {
            let pair = object.pair.as_ref().map(Self::of_pair);
            let creep = object.creep.as_ref().map(|_| Self::NotJudged);
            [pair, creep]
        };
        let found: Vec<Self> = objects.flat_map(of_object).flatten().collect();
        [Self::NotInWorkingOrder, Self::NotJudged]
            .into_iter()
            .find(|one| found.contains(one))
            .unwrap_or(Self::InWorkingOrder)
    }

    /// The verdict on a pair of a run: none where the run itself has none.
    pub fn of_pair_in(figures: &Figures, pair: &PairFigures) -> Self {
        match (Self::of(figures), ending(figures)) {
            (Self::NotToBeTrusted, _) => Self::NotToBeTrusted,
            (_, RunEnd::FromOutside | RunEnd::OfScene) => Self::NotJudged,
            (_, RunEnd::Complete | RunEnd::OfMechanism | RunEnd::OfComputation) => {
                Self::of_pair(pair)
            }
        }
    }

    /// The verdict on a pair by itself.
    pub fn of_pair(pair: &PairFigures) -> Self {
        match (pair.margin, pair.in_working_order) {
            // The margin of a rigid object is that of the whole run.
            (Some(margin), _) if margin >= 0.0 => Self::InWorkingOrder,
            (Some(_), _) | (None, Some(false)) => Self::NotInWorkingOrder,
            (None, Some(true)) => Self::InWorkingOrder,
            (None, None) => Self::NotJudged,
        }
    }
}

/// Share of its terms that an equation of motion may leave open and still say something: with a
/// greater bound no motion would fail the check.
const TELLING: f64 = 0.5;

/// Tolerance from which on a bound that is too wide is the fault of the tolerance, and not of
/// rounding, which is told where it decides a figure.
const COARSE: f64 = 1e-3;

/// Whether the check of the equations says nothing, since the tolerance is too coarse.
fn say_nothing(checks: &[Check]) -> bool {
    let bound = |name: &str| {
        checks
            .iter()
            .find(|check| check.name == name)
            .map(|check| check.bound)
    };
    let [equations, energy] = [EQUATIONS, ENERGY].map(bound);
    equations.is_some_and(|bound| bound >= TELLING)
        && energy.is_some_and(|bound| bound >= EnergyAudit::bound(COARSE))
}

/// Whether the equations of motion of a run were not checked for want of a fine tolerance.
pub fn is_unchecked(figures: &Figures) -> bool {
    say_nothing(&checks(figures))
}

/// Names of the checks of the equations of motion and of the energies.
const EQUATIONS: &str = "equations of motion";
const ENERGY: &str = "energy balance";

/// How a run was made, for its verdict.
#[derive(Clone, Copy, Debug)]
pub struct Made<'c> {
    /// How it ended.
    pub ending: RunEnd,
    /// Time that it got to (s).
    pub time: f64,
    /// The checks that it made of itself.
    pub checks: &'c [Check],
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunEnd {
    /// At its end.
    Complete,
    /// By the user or a limit of the user's.
    FromOutside,
    /// By a failure of the computation.
    OfComputation,
    /// By a law of the scene that has no value from there on.
    OfScene,
    /// By the mechanism: a dead-centre position, the end of a range.
    OfMechanism,
}

impl RunEnd {
    /// How a run ended that stopped for a reason of this short name.
    pub(in crate::studies) fn end_of_stopped_run(stopped: &str) -> Self {
        match stopped {
            "complete" => Self::Complete,
            // A budget that is spent says nothing of what was computed until then.
            "interrupted" | "wall_clock" | "too_many_steps" | "too_many_switches"
            | "not_explored" => Self::FromOutside,
            PhysicalStop::NO_VALUE => Self::OfScene,
            "dead_position" | "end_of_travel" | "self_locking" | "several_solutions" | "jammed"
            | "held_at_jump" => Self::OfMechanism,
            // ("not_finite", "step_floor", "method", and what is not known: nothing is certified.)
            _ => Self::OfComputation,
        }
    }
}

/// How the run of these figures ended.
pub fn ending(figures: &Figures) -> RunEnd {
    match figures.run.complete {
        true => RunEnd::Complete,
        false => RunEnd::end_of_stopped_run(figures.run.stopped.as_deref().unwrap_or("")),
    }
}

/// What the checks of a run look at beside the figures of its objects.
#[derive(Clone, Copy, Debug)]
pub(in crate::studies) struct Errors {
    /// Error of the energy balance.
    pub(in crate::studies) energy: f64,
    /// Tolerance of the run.
    pub(in crate::studies) tolerance: f64,
    /// Greatest defect of the equations of motion, and its bound.
    pub(in crate::studies) equations: [f64; 2],
}

/// The checks that a run makes of itself, with their bounds.
pub fn checks(figures: &Figures) -> Vec<Check> {
    let run = &figures.run;
    let errors = Errors {
        energy: run.energy_error,
        tolerance: run.tolerance,
        equations: [run.equations.defect, run.equations.bound],
    };
    errors.checks(ending(figures), figures.objects.values())
}

impl Errors {
    /// The checks of a run that ended so, with the figures of these objects.
    pub(in crate::studies) fn checks<'o>(
        &self,
        ending: RunEnd,
        objects: impl Iterator<Item = &'o ObjectFigures>,
    ) -> Vec<Check> {
        // Accelerations grow without bound towards a dead-centre position, or a pole, that ends
        // a run.
        let unknown = match ending {
            RunEnd::OfMechanism | RunEnd::OfScene => 0,
            RunEnd::Complete | RunEnd::FromOutside | RunEnd::OfComputation => {
                objects.filter(|one| !is_finite(one)).count()
            }
        };
        vec![
            Check {
                name: "count of objects with a result that is not a finite number",
                value: unknown as f64,
                bound: 0.0,
            },
            Check {
                name: ENERGY,
                value: self.energy,
                bound: EnergyAudit::bound(self.tolerance),
            },
            Check {
                name: EQUATIONS,
                value: self.equations[0],
                bound: self.equations[1],
            },
        ]
    }
}

fn is_finite(object: &ObjectFigures) -> bool {
    [
        object.delta_abs,
        object.delta_max,
        object.delta_min,
        object.sigma,
        object.peak_speed,
        object.peak_acceleration,
        object.peak_reaction,
        object.end.displacement,
        object.end.speed,
    ]
    .iter()
    .all(|value| value.is_finite())
}

#[cfg(test)]
mod tests {
    use super::RunEnd;

    #[test]
    fn a_stop_of_an_unknown_name_certifies_nothing() {
        assert_eq!(
            RunEnd::end_of_stopped_run("dead_position"),
            RunEnd::OfMechanism
        );
        for unknown in ["", "method", "something_new"] {
            assert_eq!(
                RunEnd::end_of_stopped_run(unknown),
                RunEnd::OfComputation,
                "{unknown}"
            );
        }
    }
}
