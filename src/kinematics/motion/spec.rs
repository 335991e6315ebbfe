//! The motion of a drive as a scene states it: plain numbers in SI units (of a
//! drive that slides read m for rad).

use super::cycle::CycleSpec;
use super::law::RunLawSpec;
use crate::math::expression::Expression;

/// Prescribed motion of a drive.
#[derive(Clone, Debug, PartialEq)]
pub enum DriveMotionSpec {
    /// `{ "speed": ω, "angle" = 0 }`: φ = angle + ω·t.
    Constant {
        /// ω (rad/s).
        speed: f64,
        /// φ(0) (rad).
        angle: f64,
    },
    /// `{ "acceleration": ε, "start_speed" = 0, "angle" = 0 }`:
    /// φ = angle + ω₀·t + ε·t²/2.
    Accelerated {
        /// ε (rad/s²).
        acceleration: f64,
        /// ω₀ (rad/s).
        speed: f64,
        /// φ(0) (rad).
        angle: f64,
    },
    /// `{ "run_up": { "speed", "time", "angle" = 0, "law" } }`: the speed rises from
    /// rest to `speed` in `time` by ω(τ) = speed·(3τ² − 2τ³), or by a law, then stays.
    RunUp {
        /// Final speed (rad/s).
        speed: f64,
        /// Duration of the run-up (s), > 0.
        time: f64,
        /// φ(0) (rad).
        angle: f64,
        /// Law of the run-up in place of the polynomial.
        law: Option<RunLawSpec>,
    },
    /// `{ "plan": { "stations", "period", "advance" = 0, "phase" = 0 } }`:
    /// moves by laws of motion and dwells.
    Plan(CycleSpec),
    /// `{ "expression": "0.1*sin(2*pi*t)", "unit" }` of the time `t` in s.
    Written {
        /// The expression, of variable 0.
        expression: Expression,
        /// Factor on its value, which is then in rad or m.
        factor: f64,
    },
    /// `{ "table": [[t, φ], …] }`: a smooth spline through at least three points.
    Table {
        /// (t, φ), t strictly ascending.
        points: Vec<(f64, f64)>,
    },
}
