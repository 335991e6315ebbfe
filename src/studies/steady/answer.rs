//! What the steady motion of a machine is, and how well independent ways to it agree.

use crate::dynamics::steady::cycle_map::Regime;
use crate::dynamics::steady::flywheel::Flywheel;
use crate::dynamics::steady::{Check, Extreme, Means, SteadyFigures, SteadyMotion};
use crate::studies::check::Check as Judged;
use crate::studies::judgement::{Judgement, RunEnd};
use serde::Serialize;
use std::collections::BTreeMap;

/// The steady motion of a machine with rigid objects.
#[derive(Clone, Debug, Serialize)]
pub struct RigidAnswer {
    /// Forces that move it.
    pub forces: Forces,
    /// Φ (rad).
    pub cycle: f64,
    /// The figures.
    pub figures: SteadyFigures,
    /// The fixed point of the cycle map, where a moment depends on speed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub regime: Option<Regime>,
    /// The flywheel, where one was asked for; the motion is the one with it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub flywheel: Option<Flywheel>,
    /// Agreement of independent ways.
    pub agreement: Agreement,
    /// The motion.
    #[serde(skip)]
    pub motion: SteadyMotion,
}

/// Agreement of independent ways to the same motion.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Agreement {
    /// The equation of motion, integrated over the cycle, against the energy theorem.
    pub equation: Option<Check>,
    /// Greatest relative difference of ω(φ) between the cycle map and the
    /// energy-mass method.
    pub cycle_map: Option<f64>,
    /// A simulation of the scene in time.
    pub simulation: Option<Simulation>,
    /// Why there is no simulation.
    pub simulation_missing: Option<String>,
    /// True when the simulation was begun and did not come to its end.
    #[serde(skip)]
    pub simulation_failed: bool,
}

/// Greatest relative difference between independent ways to the same motion.
const AGREED: f64 = 1e-6;

impl Agreement {
    /// What was compared, with its bounds.
    fn checks(&self) -> Vec<Judged> {
        // An integration that stands still confirms nothing.
        let equation = self.equation.map_or([f64::NAN; 2], |x| [x.speed, x.period]);
        let names = [
            "speed by the equation of motion over a cycle",
            "period by the equation of motion",
        ];
        let map = self
            .cycle_map
            .map(|apart| ("speed by the cycle map", apart));
        let simulation = self.simulation.map(|run| run.speed);
        let simulation = simulation.or(self.simulation_failed.then_some(f64::NAN));
        let simulation =
            simulation.map(|speed| ("speed by the simulation of the scene in time", speed));
        let found = names.into_iter().zip(equation).chain(map).chain(simulation);
        found.map(|(name, value)| agreed(name, value)).collect()
    }
}

fn agreed(name: &'static str, value: f64) -> Judged {
    let bound = AGREED;
    Judged { name, value, bound }
}

/// The checks of a steady motion of a machine with rigid objects.
pub fn rigid_checks(figures: &SteadyFigures, agreement: Option<&Agreement>) -> Vec<Judged> {
    let mut checks = agreement.map(Agreement::checks).unwrap_or_default();
    checks.push(Judged {
        name: "mean speed required",
        value: figures.miss,
        bound: figures.tolerance.max(AGREED),
    });
    let period = figures.period_error;
    checks.extend(period.map(|error| agreed("period by quadrature", error)));
    checks
}

/// The verdict on a steady motion of a machine with rigid objects: it holds its speed where
/// it does not come almost to rest, and where small disturbances die away.
pub fn rigid_judgement(
    figures: &SteadyFigures,
    regime: Option<&Regime>,
    checks: &[Judged],
) -> Judgement {
    let repels = regime.is_some_and(|regime| !regime.attracts);
    Judgement::judge_result(RunEnd::Complete, checks, || {
        match figures.warnings.is_empty() && !repels {
            true => Judgement::InWorkingOrder,
            false => Judgement::NotInWorkingOrder,
        }
    })
}

impl RigidAnswer {
    /// The checks of the answer, with their bounds.
    pub fn checks(&self) -> Vec<Judged> {
        rigid_checks(&self.figures, Some(&self.agreement))
    }

    /// True when all checks are passed.
    pub fn is_trusted(&self) -> bool {
        self.checks().iter().all(Judged::passed)
    }

    /// The verdict: see [`rigid_judgement`].
    pub fn judgement(&self) -> Judgement {
        rigid_judgement(&self.figures, self.regime.as_ref(), &self.checks())
    }

    /// Adds a warning for each check beyond its bound.
    pub fn with_check_warnings(mut self) -> Self {
        let checks = self.checks();
        let failures = checks.iter().filter_map(Judged::failure);
        self.figures.warnings.extend(failures);
        self
    }
}

/// Simulation of the scene in time, for comparison.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Simulation {
    /// Cycles simulated.
    pub cycles: u32,
    /// Relative difference of its start from the steady motion.
    pub disturbed: f64,
    /// Relative difference of its last speed from that of the steady motion at
    /// the same position.
    pub speed: f64,
}

/// Forces that move the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Forces {
    /// Forces depend on the position alone: the mean speed was asked for.
    Position,
    /// A moment depends on the speed: the mean speed is a result.
    Speed,
}

/// Figures of how a drive turns in a steady motion.
#[derive(Clone, Debug, Serialize)]
pub struct DriveFigures {
    /// The drive.
    pub id: String,
    /// Means of its speed (rad/s).
    pub means: Means,
    /// Least ω (rad/s) and where, φ counted from a whole cycle.
    pub least_speed: Extreme,
    /// Greatest ω (rad/s) and where.
    pub greatest_speed: Extreme,
    /// ω at φ = 0 (rad/s).
    pub speed_at_start: f64,
    /// δ = (ω_max − ω_min)/ω_av, the mean over time.
    pub fluctuation: f64,
    /// The constant moment beside the motor (N·m) that holds the mean speed asked for,
    /// where one is; the motion is the one with it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub balance: Option<f64>,
    /// The flywheel, where one was asked for; the motion is the one with it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub flywheel: Option<Flywheel>,
    /// The state at φ = 0 as `run.start` of a scene takes it.
    pub start: BTreeMap<String, StartOf>,
    /// The motion in equal steps of φ, both ends of the period included.
    #[serde(skip)]
    pub rows: Vec<DriveRow>,
}

/// The motion where the drive stands at an angle.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DriveRow {
    /// φ (rad).
    pub position: f64,
    /// t since φ = 0 (s).
    pub time: f64,
    /// ω (rad/s).
    pub speed: f64,
    /// ε (rad/s²).
    pub acceleration: f64,
    /// Deviations from the law, in the order of the coordinates of the orbit.
    pub deviations: Vec<f64>,
}

/// Absolute displacements and speeds of an object, mass by mass.
#[derive(Clone, Debug, Serialize)]
pub struct StartOf {
    /// φ (rad or m).
    pub displacement: Vec<f64>,
    /// φ̇ (rad/s or m/s).
    pub speed: Vec<f64>,
}

#[cfg(test)]
mod tests {
    use super::{Agreement, Simulation};
    use crate::dynamics::steady::Check;

    fn trusted(agreement: &Agreement) -> bool {
        agreement.checks().iter().all(super::Judged::passed)
    }

    #[test]
    fn ways_that_failed_are_not_agreement() {
        let fine = Agreement {
            equation: Some(Check {
                speed: 1e-12,
                period: -1e-12,
            }),
            ..Agreement::default()
        };
        assert!(trusted(&fine));
        // The integration of the equation stands still on the way.
        assert!(!trusted(&Agreement::default()));
        // The simulation is begun and does not come to its end.
        let failed = Agreement {
            simulation_failed: true,
            ..fine.clone()
        };
        assert!(!trusted(&failed));
        let simulation = Simulation {
            cycles: 5,
            disturbed: 0.0,
            speed: 1.7,
        };
        let off = Agreement {
            simulation: Some(simulation),
            ..fine
        };
        assert!(!trusted(&off));
    }
}
