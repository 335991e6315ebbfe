//! The speed level that has a given mean.

use super::Mean;
use super::profile::Extreme;
use super::refusal::{Field, Refusal};
use crate::math::roots::bracketed;
use crate::units::shown;
use serde::Serialize;

/// Question which of all periodic motions is meant.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Question {
    /// The mean angular speed ω_av (rad/s), > 0.
    pub mean_speed: f64,
    /// Kind of mean.
    pub mean: Mean,
    /// Δ_ω: how far the mean may be off, relative; default 1e-12.
    pub tolerance: f64,
    /// |A(Φ)| up to this share of the range of A counts as none; default 1e-6.
    pub surplus: f64,
    /// True: a constant moment −A(Φ)/Φ is added, so that the cycle balances.
    pub balance: bool,
}

impl Question {
    /// The motion with a mean over time of `mean_speed` rad/s, nothing balanced.
    pub fn new(mean_speed: f64) -> Self {
        Self {
            mean_speed,
            mean: Mean::Time,
            tolerance: 1e-12,
            surplus: 1e-6,
            balance: false,
        }
    }

    /// Every bad number at once.
    pub(super) fn check(&self) -> Result<(), Refusal> {
        let fields = [
            ("mean_speed", self.mean_speed),
            ("tolerance", self.tolerance),
            ("surplus", self.surplus),
        ];
        let wrong = |&(field, value): &(&str, f64)| {
            (!(value.is_finite() && value > 0.0)).then(|| Field {
                field: field.to_owned(),
                message: format!("{value} is not a positive number"),
                hint: "give a number above zero".to_owned(),
            })
        };
        let faults: Vec<Field> = fields.iter().filter_map(wrong).collect();
        match faults.is_empty() {
            true => Ok(()),
            false => Err(Refusal::Input { faults }),
        }
    }

    /// The constant moment to add (N·m), or the refusal of an open balance; work up to
    /// `rounding` (J) is none, whatever its range.
    pub(super) fn balance(
        &self,
        surplus: f64,
        [range, rounding]: [f64; 2],
        cycle: f64,
    ) -> Result<Option<f64>, Refusal> {
        let moment = -surplus / cycle;
        if surplus.abs() <= (self.surplus * range).max(rounding) {
            return Ok(None);
        }
        match self.balance {
            true => Ok(Some(moment)),
            false => Err(Refusal::Surplus {
                work: surplus,
                range,
                moment,
            }),
        }
    }
}

/// The three means of a motion (rad/s).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Means {
    /// Φ / ∫dφ/ω.
    pub time: f64,
    /// (1/Φ)·∫ω dφ.
    pub angle: f64,
    /// (ω_max + ω_min)/2.
    pub midrange: f64,
}

/// The figures of a steady motion.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SteadyFigures {
    /// ω_av as asked for (rad/s).
    pub mean_speed: f64,
    /// Kind of mean that was asked for.
    pub mean: Mean,
    /// The three means (rad/s).
    pub means: Means,
    /// Duration of a cycle (s).
    pub period: f64,
    /// T at φ = 0 (J).
    pub energy_at_start: f64,
    /// E₀: T at the position of the least J (J).
    pub reference_energy: f64,
    /// Position of the least J, the first if there are several (rad).
    pub reference_position: f64,
    /// Least ω (rad/s) and where.
    pub least_speed: Extreme,
    /// Greatest ω (rad/s) and where.
    pub greatest_speed: Extreme,
    /// δ = (ω_max − ω_min)/ω_av.
    pub fluctuation: f64,
    /// Greatest less least kinetic energy (J).
    pub energy_fluctuation: f64,
    /// A(Φ), the work of the forces in a cycle before balancing (J).
    pub cycle_work: f64,
    /// The constant moment that was added to balance the cycle (N·m).
    pub balance: Option<f64>,
    /// Evaluations of the mean.
    pub iterations: u32,
    /// The bracket of E₀ that was left (J).
    pub bracket: [f64; 2],
    /// The bracket of E₀ at the outset, before T > 0 is required (J).
    pub first_bracket: [f64; 2],
    /// |mean − ω_av|/ω_av reached.
    pub miss: f64,
    /// Greatest miss that was asked for.
    pub tolerance: f64,
    /// True when the miss is within what was asked.
    pub met: bool,
    /// Estimated relative error of the period (by quadrature, or by leaving
    /// out every second sample of a table).
    pub period_error: Option<f64>,
    /// Least over greatest kinetic energy.
    pub energy_ratio: f64,
    /// Warnings to the user.
    pub warnings: Vec<String>,
}

impl SteadyFigures {
    /// Numbers that are none are no answer: energies go with the square of the speed.
    ///
    /// # Errors
    /// A figure is not finite.
    pub(super) fn check(&self) -> Result<(), Refusal> {
        let figures = [
            self.means.time,
            self.means.angle,
            self.means.midrange,
            self.period,
            self.energy_at_start,
            self.reference_energy,
            self.least_speed.value,
            self.greatest_speed.value,
            self.fluctuation,
            self.energy_fluctuation,
            self.energy_ratio,
            self.miss,
        ];
        let ends = self.bracket.iter().chain(&self.first_bracket);
        if figures.iter().chain(ends).all(|figure| figure.is_finite()) {
            return Ok(());
        }
        let message = format!(
            "at {} rad/s energies, times or speeds are beyond all numbers",
            shown(self.mean_speed, 6)
        );
        Err(Refusal::field(
            "mean_speed",
            message,
            "give a speed that a machine can have",
        ))
    }
}

/// All motions T(φ) = level + rise(φ), rise ≥ 0 being zero somewhere.
pub(super) trait Family {
    /// The mean at a level (J).
    fn mean_speed(&self, level: f64, mean: Mean) -> f64;
    /// The mean at level 0; 0 when the time for a cycle grows without limit.
    fn mean_at_level_zero(&self, mean: Mean) -> f64;
    /// Least and greatest J.
    fn inertia(&self) -> [f64; 2];
    /// Greatest rise, and the rise at the least J.
    fn rise(&self) -> [f64; 2];
    /// Position at which T is least (rad).
    fn lowest_position(&self) -> f64;
}

/// A level found.
#[derive(Clone, Copy, Debug)]
pub(super) struct Level {
    pub(super) level: f64,
    pub(super) iterations: u32,
    pub(super) miss: f64,
    /// Of E₀.
    pub(super) bracket: [f64; 2],
    /// Of E₀, as in the source.
    pub(super) first: [f64; 2],
}

/// Least level that is told from standing still, relative to the energies.
const FLOOR: f64 = 1e-20;

/// Finds the level whose mean is asked for.
///
/// The bracket is rigorous for all three means: at J_min·ω²/2 − rise_max no
/// speed exceeds ω, at J_max·ω²/2 none is below, and means grow with the level.
pub(super) fn find(family: &impl Family, question: &Question) -> Result<Level, Refusal> {
    let (wanted, mean) = (question.mean_speed, question.mean);
    let square = 0.5 * wanted * wanted;
    let [least, greatest] = family.inertia().map(|inertia| inertia * square);
    let [rise, reference] = family.rise();
    let high = greatest;
    let too_slow = |lowest: f64| Refusal::TooSlow {
        wanted,
        mean,
        lowest,
        position: family.lowest_position(),
    };
    let mut low = least - rise;
    let mut iterations = 0;
    if low <= 0.0 {
        let lowest = family.mean_at_level_zero(mean);
        if !(lowest < wanted) {
            return Err(too_slow(lowest));
        }
        let floor = FLOOR * (high + rise);
        low = high;
        loop {
            low *= 1e-2;
            let found = family.mean_speed(low.max(floor), mean);
            iterations += 1;
            if found <= wanted {
                break;
            }
            if low <= floor {
                return Err(too_slow(found));
            }
        }
        low = low.max(floor);
    }
    let mut miss = |logarithm: f64| family.mean_speed(logarithm.exp(), mean) - wanted;
    // A rounding wider, for a bracket that is a point.
    let ends = [low.ln() - 1e-14, high.ln() + 1e-14];
    let found = bracketed(&mut miss, ends, question.tolerance * wanted);
    Ok(Level {
        level: found.at.exp(),
        iterations: iterations + found.iterations,
        miss: (found.miss / wanted).abs(),
        bracket: found.bracket.map(|end| end.exp() + reference),
        first: [least - rise + reference, high + reference],
    })
}

/// Below this share of the greatest, the least kinetic energy is a warning.
const ALMOST_STOPS: f64 = 1e-9;

impl SteadyFigures {
    /// True where the machine almost stops: errors of an energy weigh there by what the
    /// greatest is above the least.
    pub fn almost_stops(&self) -> bool {
        self.energy_ratio < ALMOST_STOPS
    }
}

/// Warnings about a motion.
pub(super) fn warnings(
    ratio: f64,
    position: f64,
    level: &Level,
    question: &Question,
) -> Vec<String> {
    let mut warnings = Vec::new();
    if ratio < ALMOST_STOPS {
        warnings.push(format!(
            "the machine almost stops at φ = {} rad: its kinetic energy falls to {} of the \
             greatest",
            shown(position, 7),
            shown(ratio, 2)
        ));
    }
    if !(level.miss <= question.tolerance) {
        warnings.push(format!(
            "the mean was met to {} only: the bracket cannot shrink further",
            shown(level.miss, 2)
        ));
    }
    warnings
}
