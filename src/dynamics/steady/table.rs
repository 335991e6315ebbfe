//! The steady motion on samples.

use super::Mean;
use super::law::{Family, Means};
use super::profile::Extreme;
use super::refusal::Refusal;
use super::samples::{LEAST, SAME_END, check_inertia, extreme, faults, repeats_end, too_few};
use crate::kinematics::motion::Spline;

/// J and the work as samples over one cycle.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    pub(super) cycle: f64,
    /// Positions, the end of the cycle left out.
    pub(super) positions: Vec<f64>,
    pub(super) inertia: Vec<f64>,
    /// A since the first sample.
    pub(super) work: Vec<f64>,
    /// A(Φ).
    pub(super) surplus: f64,
}

impl Table {
    /// Samples of J and of the work A over a cycle. A sample at the end of the
    /// cycle is dropped; its A gives the work of a cycle, which is otherwise
    /// taken as zero.
    ///
    /// # Errors
    /// Every bad field at once: too few samples, unequal lengths, positions
    /// that do not ascend within the cycle, numbers that are none; or J that is
    /// not above zero.
    pub fn new(
        cycle: f64,
        positions: &[f64],
        inertia: &[f64],
        work: &[f64],
    ) -> Result<Self, Refusal> {
        let faults = faults(cycle, positions, inertia, [("work", work)]);
        if !faults.is_empty() {
            return Err(Refusal::Input { faults });
        }
        check_inertia(positions, inertia)?;
        let mut table = Self {
            cycle,
            positions: positions.to_vec(),
            inertia: inertia.to_vec(),
            work: work.iter().map(|one| one - work[0]).collect(),
            surplus: 0.0,
        };
        table.drop_repeated_end()?;
        Ok(table)
    }

    /// The same from samples of the moment: its work is that of the periodic
    /// cubic spline through them.
    ///
    /// # Errors
    /// As [`Table::new`].
    pub fn of_moments(
        cycle: f64,
        positions: &[f64],
        inertia: &[f64],
        moment: &[f64],
    ) -> Result<Self, Refusal> {
        let faults = faults(cycle, positions, inertia, [("moment", moment)]);
        if !faults.is_empty() {
            return Err(Refusal::Input { faults });
        }
        let count = positions.len();
        let repeats = repeats_end(cycle, positions);
        let mut points: Vec<(f64, f64)> = positions
            .iter()
            .copied()
            .zip(moment.iter().copied())
            .collect();
        if !repeats {
            points.push((positions[0] + cycle, moment[0]));
        }
        let spline = Spline::periodic(&points);
        let mut work = vec![0.0; count];
        let mut sum = 0.0;
        for (i, &[y, b, c, d]) in spline.coefficients().iter().enumerate() {
            let h = points[i + 1].0 - points[i].0;
            sum += h * (y + h * (b / 2.0 + h * (c / 3.0 + h * d / 4.0)));
            if let Some(next) = work.get_mut(i + 1) {
                *next = sum;
            }
        }
        let mut table = Self::new(cycle, positions, inertia, &work)?;
        table.surplus = sum;
        Ok(table)
    }

    /// Drops a repeated end point.
    fn drop_repeated_end(&mut self) -> Result<(), Refusal> {
        if !repeats_end(self.cycle, &self.positions) {
            return Ok(());
        }
        let last = self.positions.len() - 1;
        let (first, end) = (self.inertia[0], self.inertia[last]);
        if (end - first).abs() > SAME_END * first.abs().max(end.abs()) {
            let message = format!("J ends the cycle with {end} and began with {first}");
            return Err(Refusal::field("inertia", message, "J repeats every cycle"));
        }
        self.surplus = self.work[last];
        self.positions.truncate(last);
        self.inertia.truncate(last);
        self.work.truncate(last);
        if last < LEAST {
            let faults = vec![too_few(last)];
            return Err(Refusal::Input { faults });
        }
        Ok(())
    }

    /// Every second sample.
    pub(super) fn halved(&self) -> Option<Self> {
        let count = self.positions.len();
        if count % 2 == 1 || count / 2 < LEAST {
            return None;
        }
        let half = |list: &[f64]| list.iter().copied().step_by(2).collect::<Vec<f64>>();
        Some(Self {
            cycle: self.cycle,
            positions: half(&self.positions),
            inertia: half(&self.inertia),
            work: half(&self.work),
            surplus: self.surplus,
        })
    }

    /// The table with a moment, or a moment of inertia, added.
    pub(super) fn with_moment_and_inertia(&self, moment: f64, inertia: f64) -> Self {
        let mut table = self.clone();
        let first = self.positions[0];
        for (work, position) in table.work.iter_mut().zip(&self.positions) {
            *work += moment * (position - first);
        }
        table.surplus += moment * self.cycle;
        table.inertia.iter_mut().for_each(|own| *own += inertia);
        table
    }

    /// The table with a constant moment of inertia added.
    #[must_use]
    pub fn with_inertia(&self, inertia: f64) -> Self {
        self.with_moment_and_inertia(0.0, inertia)
    }

    /// Φ (rad).
    pub fn cycle(&self) -> f64 {
        self.cycle
    }

    /// A(Φ) (J).
    pub fn work_of_cycle(&self) -> f64 {
        self.surplus
    }

    /// Greatest less least work (J).
    pub fn range(&self) -> f64 {
        extreme(&self.positions, &self.work, 1.0).value - self.least_work().value
    }

    /// Least J (kg·m²).
    pub fn least_inertia(&self) -> f64 {
        extreme(&self.positions, &self.inertia, -1.0).value
    }

    /// Flywheel by Wittenbauer's tangents to the samples of the energy-mass curve, at
    /// the slopes ω_max²/2 and ω_min²/2.
    pub(super) fn by_tangents(&self, fluctuation: f64, mean_speed: f64) -> f64 {
        let height = |sense: f64| {
            let speed = mean_speed * (1.0 + sense * 0.5 * fluctuation);
            let above = self.rises().zip(&self.inertia);
            let above = above.map(|(rise, inertia)| sense * (rise - 0.5 * speed * speed * inertia));
            sense * above.fold(f64::NEG_INFINITY, f64::max)
        };
        (height(1.0) - height(-1.0)) / (fluctuation * mean_speed * mean_speed)
    }

    pub(super) fn least_work(&self) -> Extreme {
        extreme(&self.positions, &self.work, -1.0)
    }

    fn rises(&self) -> impl Iterator<Item = f64> + '_ {
        let least = self.least_work().value;
        self.work.iter().map(move |work| work - least)
    }

    pub(super) fn speeds(&self, level: f64) -> Vec<f64> {
        let speed = |(rise, inertia): (f64, &f64)| (2.0 * (level + rise) / inertia).sqrt();
        self.rises().zip(&self.inertia).map(speed).collect()
    }

    /// Share of the cycle that belongs to each sample.
    fn weights(&self) -> Vec<f64> {
        let count = self.positions.len();
        let place = |i: usize| match i {
            0 => self.positions[count - 1] - self.cycle,
            i if i <= count => self.positions[i - 1],
            _ => self.positions[0] + self.cycle,
        };
        (0..count)
            .map(|i| (place(i + 2) - place(i)) / (2.0 * self.cycle))
            .collect()
    }

    pub(super) fn means(&self, speeds: &[f64]) -> Means {
        let weights = self.weights();
        let slowness: f64 = weights.iter().zip(speeds).map(|(w, v)| w / v).sum();
        let least = extreme(&self.positions, speeds, -1.0).value;
        let greatest = extreme(&self.positions, speeds, 1.0).value;
        Means {
            time: 1.0 / slowness,
            angle: weights.iter().zip(speeds).map(|(w, v)| w * v).sum(),
            midrange: 0.5 * (least + greatest),
        }
    }
}

impl Family for Table {
    fn mean_speed(&self, level: f64, mean: Mean) -> f64 {
        let means = self.means(&self.speeds(level));
        match mean {
            Mean::Time => means.time,
            Mean::Angle => means.angle,
            Mean::Midrange => means.midrange,
        }
    }

    fn mean_at_level_zero(&self, mean: Mean) -> f64 {
        Family::mean_speed(self, 0.0, mean)
    }

    fn inertia(&self) -> [f64; 2] {
        [-1.0, 1.0].map(|sense| extreme(&self.positions, &self.inertia, sense).value)
    }

    fn rise(&self) -> [f64; 2] {
        let place = extreme(&self.positions, &self.inertia, -1.0).at;
        let index = self.positions.iter().position(|&at| at == place);
        let rise = index.and_then(|index| self.rises().nth(index));
        [self.range(), rise.unwrap_or(0.0)]
    }

    fn lowest_position(&self) -> f64 {
        self.least_work().at
    }
}
