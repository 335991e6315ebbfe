//! A steady motion on samples, and its figures.

use super::law::find;
use super::law::{Family, Level, Question, SteadyFigures, warnings};
use super::motion::Row;
use super::refusal::Refusal;
use super::samples::extreme;
use super::table::Table;
use crate::kinematics::motion::Spline;
use serde::Serialize;

/// How closely the mean is met.
const FINEST: f64 = 1e-16;

/// A steady motion on samples.
#[derive(Clone, Debug, PartialEq)]
pub struct TableMotion {
    table: Table,
    level: f64,
    /// Figures of the motion.
    pub figures: TableFigures,
}

/// Figures of a motion on samples: the extremes are those of the samples.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TableFigures {
    /// The figures.
    #[serde(flatten)]
    pub steady: SteadyFigures,
    /// How far the figures move when every second sample is left out; `None`
    /// for an odd number of samples, or too few.
    pub halving: Option<SampleHalving>,
}

/// Figures with all samples less those with every second one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SampleHalving {
    /// Of T at φ = 0 (J).
    pub energy_at_start: f64,
    /// Of the period (s).
    pub period: f64,
    /// Of the least speed (rad/s).
    pub least_speed: f64,
    /// Of the greatest speed (rad/s).
    pub greatest_speed: f64,
}

impl Table {
    /// The steady motion with the mean speed asked for.
    ///
    /// # Errors
    /// There is none: see [`Refusal`].
    pub fn find_steady_motion(&self, question: &Question) -> Result<TableMotion, Refusal> {
        let mut motion = self.solve(question)?;
        let half = self.halved().and_then(|half| half.solve(question).ok());
        motion.figures.halving = half.map(|half| {
            let (all, half) = (&motion.figures.steady, &half.figures.steady);
            SampleHalving {
                energy_at_start: all.energy_at_start - half.energy_at_start,
                period: all.period - half.period,
                least_speed: all.least_speed.value - half.least_speed.value,
                greatest_speed: all.greatest_speed.value - half.greatest_speed.value,
            }
        });
        Ok(motion)
    }

    fn solve(&self, question: &Question) -> Result<TableMotion, Refusal> {
        question.check()?;
        let balance = question.balance(self.surplus, [self.range(), 0.0], self.cycle)?;
        let table = self.with_moment_and_inertia(balance.unwrap_or(0.0), 0.0);
        // Near stalling the figures amplify what the mean is off, and another mean of
        // samples costs next to nothing.
        let finest = Question {
            tolerance: question.tolerance.min(FINEST),
            ..*question
        };
        let level = find(&table, &finest)?;
        let motion = TableMotion::new(table, &level, question, self.surplus, balance);
        motion.figures.steady.check()?;
        Ok(motion)
    }
}

impl TableMotion {
    pub(super) fn new(
        table: Table,
        level: &Level,
        question: &Question,
        surplus: f64,
        balance: Option<f64>,
    ) -> Self {
        let speeds = table.speeds(level.level);
        let means = table.means(&speeds);
        let least_speed = extreme(&table.positions, &speeds, -1.0);
        let greatest_speed = extreme(&table.positions, &speeds, 1.0);
        let range = table.range();
        let ratio = level.level / (level.level + range);
        let place = table.least_work().at;
        let steady = SteadyFigures {
            mean_speed: question.mean_speed,
            mean: question.mean,
            means,
            period: table.cycle / means.time,
            energy_at_start: level.level - table.least_work().value,
            reference_energy: level.level + table.rise()[1],
            reference_position: extreme(&table.positions, &table.inertia, -1.0).at,
            least_speed,
            greatest_speed,
            fluctuation: (greatest_speed.value - least_speed.value) / question.mean_speed,
            energy_fluctuation: range,
            cycle_work: surplus,
            balance,
            iterations: level.iterations,
            bracket: level.bracket,
            first_bracket: level.first,
            miss: level.miss,
            tolerance: question.tolerance,
            met: level.miss <= question.tolerance,
            period_error: None,
            energy_ratio: ratio,
            warnings: warnings(ratio, place, level, question),
        };
        Self {
            level: level.level,
            figures: TableFigures {
                steady,
                halving: None,
            },
            table,
        }
    }

    /// The samples, the balancing moment included.
    pub fn table(&self) -> &Table {
        &self.table
    }

    /// The motion at every sample and at the end of the cycle. Times by the
    /// trapezoidal rule; derivatives in φ, for M and ε, are those of the
    /// periodic cubic splines through T and J.
    pub fn rows(&self) -> Vec<Row> {
        let table = &self.table;
        let closed = |values: &[f64]| {
            let mut points: Vec<(f64, f64)> = table
                .positions
                .iter()
                .copied()
                .zip(values.iter().copied())
                .collect();
            points.push((table.positions[0] + table.cycle, values[0]));
            Spline::periodic(&points)
        };
        let (work, inertia) = (closed(&table.work), closed(&table.inertia));
        let speeds = table.speeds(self.level);
        let count = speeds.len();
        let mut time = 0.0;
        let row = |i: usize| {
            let place = i % count;
            let position = table.positions[place] + if i == count { table.cycle } else { 0.0 };
            if i > 0 {
                let before = table.positions[i - 1];
                time += 0.5 * (position - before) * (1.0 / speeds[i - 1] + 1.0 / speeds[place]);
            }
            let speed = speeds[place];
            let own = table.inertia[place];
            let moment = work.jet(table.positions[place]).first;
            let slope = inertia.jet(table.positions[place]).first;
            Row {
                position,
                time,
                speed,
                acceleration: (moment - 0.5 * slope * speed * speed) / own,
                inertia: own,
                moment,
                work: table.work[place],
                energy: 0.5 * own * speed * speed,
            }
        };
        (0..=count).map(row).collect()
    }
}
