//! Why there is no steady motion, in words and numbers.

use super::Mean;
use crate::fault::Fault;
use crate::units::shown;
use serde::Serialize;

/// Why a question for the steady motion has no answer. SI units, radians.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "reason", rename_all = "snake_case")]
pub enum Refusal {
    /// A number of the question is no good.
    Input {
        /// The field and what is wrong with it.
        faults: Vec<Field>,
    },
    /// The work of a cycle is not zero: no motion repeats.
    Surplus {
        /// A(Φ), J: positive when the machine gains speed.
        work: f64,
        /// Greatest less least of A over the cycle.
        range: f64,
        /// The constant moment that would balance the cycle, −A(Φ)/Φ.
        moment: f64,
    },
    /// The reduced moment of inertia is not above zero, or is no number.
    Inertia {
        /// Position (rad).
        position: f64,
        /// J there.
        inertia: f64,
    },
    /// The moment or the work is no number.
    Moment {
        /// Position (rad).
        position: f64,
    },
    /// J or M changes so roughly that no polynomials follow it.
    Rough {
        /// Position at which it is worst (rad).
        position: f64,
    },
    /// The mean asked for is below the lowest of all motions without a stop.
    TooSlow {
        /// The mean asked for.
        wanted: f64,
        /// Kind of mean.
        mean: Mean,
        /// The lowest mean.
        lowest: f64,
        /// Position at which the machine would stop (rad).
        position: f64,
    },
    /// The machine stops within a cycle.
    Stalls {
        /// Position at which its kinetic energy reaches zero (rad).
        position: f64,
        /// The speed at φ = 0 of the cycle in which it does.
        speed: f64,
    },
    /// No cycle was found that returns to its speed.
    NoCycle {
        /// Reason: what was tried and what came of it.
        why: String,
    },
    /// The required coefficient of fluctuation cannot be had.
    Fluctuation {
        /// δ asked for.
        wanted: f64,
        /// δ without a flywheel; `None` where the machine would stop.
        without: Option<f64>,
        /// Why.
        why: String,
    },
}

/// A field of the question and what is wrong with it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Field {
    /// Name of the field.
    pub field: String,
    /// Message: what is wrong.
    pub message: String,
    /// Hint: what would be right.
    pub hint: String,
}

impl Refusal {
    /// Refusal of one bad field.
    pub(crate) fn field(field: &str, message: impl Into<String>, hint: &str) -> Self {
        let field = Field {
            field: field.to_owned(),
            message: message.into(),
            hint: hint.to_owned(),
        };
        Self::Input {
            faults: vec![field],
        }
    }

    /// Message in a sentence: what is wrong.
    pub fn message(&self) -> String {
        match self {
            Self::Input { faults } => {
                let lines = faults.iter().map(|f| format!("{}: {}", f.field, f.message));
                lines.collect::<Vec<_>>().join("; ")
            }
            Self::Surplus { work, range, .. } => {
                let does = if *work > 0.0 { "gains" } else { "loses" };
                let share = work.abs() / range.max(f64::MIN_POSITIVE);
                format!(
                    "no steady motion: the forces do {} J of work in a cycle ({} of its range), \
                     so the machine {does} speed from cycle to cycle",
                    shown(*work, 7),
                    shown(share, 4)
                )
            }
            Self::Inertia { position, inertia } => format!(
                "the reduced moment of inertia is {inertia} kg·m² at φ = {} rad; it must be above \
                 zero",
                shown(*position, 7)
            ),
            Self::Moment { position } => {
                format!(
                    "the reduced moment is not a finite number at φ = {} rad",
                    shown(*position, 7)
                )
            }
            Self::Rough { position } => format!(
                "the reduced inertia or moment changes too roughly near φ = {} rad",
                shown(*position, 7)
            ),
            Self::TooSlow {
                wanted,
                mean,
                lowest,
                position,
            } => format!(
                "no motion without a stop has the mean speed {wanted} rad/s ({}): the lowest mean \
                 is {} rad/s, at which the machine stops at φ = {} rad",
                mean.words(),
                shown(*lowest, 7),
                shown(*position, 7)
            ),
            Self::Stalls { position, speed } => format!(
                "the machine stalls at φ = {} rad in a cycle that begins with {} rad/s",
                shown(*position, 7),
                shown(*speed, 7)
            ),
            Self::NoCycle { why } => format!("no cycle returns to its speed: {why}"),
            Self::Fluctuation {
                wanted,
                without,
                why,
            } => {
                let without = match without {
                    Some(found) => format!("it is {}", shown(*found, 7)),
                    None => "the machine would stop".to_owned(),
                };
                format!(
                    "no flywheel gives the coefficient of fluctuation {wanted} (without one \
                     {without}): {why}"
                )
            }
        }
    }

    /// Hint: what would be right; empty when there is nothing to say.
    pub fn hint(&self) -> String {
        match self {
            Self::Surplus { moment, .. } => format!(
                "`balance` adds the constant moment {} N·m that makes the work zero",
                shown(*moment, 7)
            ),
            Self::TooSlow { mean, .. } if *mean != Mean::Time => {
                "ask for a higher mean, or take the mean over time".to_owned()
            }
            Self::TooSlow { .. } => "ask for a higher mean, or add inertia".to_owned(),
            Self::Inertia { .. } => {
                "inertia on the drive itself: a motor's rotor, a flywheel".to_owned()
            }
            Self::Stalls { .. } => "a stronger motor, or more inertia".to_owned(),
            _ => String::new(),
        }
    }

    /// As faults of the properties under `path`.
    pub fn faults(&self, path: &str) -> Vec<Fault> {
        match self {
            Self::Input { faults } => faults
                .iter()
                .map(|f| Fault::new(format!("{path}.{}", f.field), &f.message, &f.hint))
                .collect(),
            Self::TooSlow { .. } => {
                let path = format!("{path}.mean_speed");
                vec![Fault::new(path, self.message(), self.hint())]
            }
            Self::Fluctuation { .. } => {
                let path = format!("{path}.fluctuation");
                vec![Fault::new(path, self.message(), self.hint())]
            }
            _ => vec![Fault::new(path, self.message(), self.hint())],
        }
    }
}
