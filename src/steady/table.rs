//! The steady motion on samples.

use super::Mean;
use super::law::{Family, Level, Means, Question, SteadyFigures, find, warnings};
use super::motion::Row;
use super::profile::Extreme;
use super::refusal::{Field, Refusal};
use crate::motion::Spline;
use serde::Serialize;

/// J and the work as samples over one cycle.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    cycle: f64,
    /// Positions, the end of the cycle left out.
    positions: Vec<f64>,
    inertia: Vec<f64>,
    /// A since the first sample.
    work: Vec<f64>,
    /// A(Φ).
    surplus: f64,
}

/// A steady motion on samples.
#[derive(Clone, Debug, PartialEq)]
pub struct TableMotion {
    table: Table,
    level: f64,
    /// Its figures.
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
    pub halving: Option<Halving>,
}

/// Figures with all samples less those with every second one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Halving {
    /// Of T at φ = 0 (J).
    pub energy_at_start: f64,
    /// Of the period (s).
    pub period: f64,
    /// Of the least speed (rad/s).
    pub least_speed: f64,
    /// Of the greatest speed (rad/s).
    pub greatest_speed: f64,
}

/// Samples at least.
const LEAST: usize = 3;

/// Share of the cycle, and of J, by which a repeated end point may differ.
const SAME: f64 = 1e-9;

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
        table.close()?;
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
    fn close(&mut self) -> Result<(), Refusal> {
        if !repeats_end(self.cycle, &self.positions) {
            return Ok(());
        }
        let last = self.positions.len() - 1;
        let (first, end) = (self.inertia[0], self.inertia[last]);
        if (end - first).abs() > SAME * first.abs().max(end.abs()) {
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
    fn halved(&self) -> Option<Self> {
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

    /// The same with a moment, or a moment of inertia, added.
    fn with(&self, moment: f64, inertia: f64) -> Self {
        let mut table = self.clone();
        let first = self.positions[0];
        for (work, position) in table.work.iter_mut().zip(&self.positions) {
            *work += moment * (position - first);
        }
        table.surplus += moment * self.cycle;
        table.inertia.iter_mut().for_each(|own| *own += inertia);
        table
    }

    /// The same with a constant moment of inertia added.
    #[must_use]
    pub fn with_inertia(&self, inertia: f64) -> Self {
        self.with(0.0, inertia)
    }

    /// Φ (rad).
    pub fn cycle(&self) -> f64 {
        self.cycle
    }

    /// A(Φ) (J).
    pub fn surplus(&self) -> f64 {
        self.surplus
    }

    /// Greatest less least work (J).
    pub fn range(&self) -> f64 {
        extreme(&self.positions, &self.work, 1.0).value - self.least_work().value
    }

    fn least_work(&self) -> Extreme {
        extreme(&self.positions, &self.work, -1.0)
    }

    fn rises(&self) -> impl Iterator<Item = f64> + '_ {
        let least = self.least_work().value;
        self.work.iter().map(move |work| work - least)
    }

    fn speeds(&self, level: f64) -> Vec<f64> {
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

    fn means(&self, speeds: &[f64]) -> Means {
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

    /// The steady motion with the mean speed asked for.
    ///
    /// # Errors
    /// There is none: see [`Refusal`].
    pub fn steady(&self, question: &Question) -> Result<TableMotion, Refusal> {
        let mut motion = self.solve(question)?;
        let half = self.halved().and_then(|half| half.solve(question).ok());
        motion.figures.halving = half.map(|half| {
            let (all, half) = (&motion.figures.steady, &half.figures.steady);
            Halving {
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
        let balance = question.balance(self.surplus, self.range(), self.cycle)?;
        let table = self.with(balance.unwrap_or(0.0), 0.0);
        let level = find(&table, question)?;
        Ok(TableMotion::new(
            table,
            &level,
            question,
            self.surplus,
            balance,
        ))
    }
}

impl Family for Table {
    fn mean(&self, level: f64, mean: Mean) -> f64 {
        let means = self.means(&self.speeds(level));
        match mean {
            Mean::Time => means.time,
            Mean::Angle => means.angle,
            Mean::Midrange => means.midrange,
        }
    }

    fn lowest(&self, mean: Mean) -> f64 {
        Family::mean(self, 0.0, mean)
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

impl TableMotion {
    fn new(
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

/// The first least (`sense` −1) or greatest (1) of samples.
fn extreme(positions: &[f64], values: &[f64], sense: f64) -> Extreme {
    let first = Extreme {
        value: values[0],
        at: positions[0],
    };
    let pairs = positions.iter().zip(values);
    pairs.fold(first, |best, (&at, &value)| {
        if sense * value > sense * best.value {
            Extreme { value, at }
        } else {
            best
        }
    })
}

fn repeats_end(cycle: f64, positions: &[f64]) -> bool {
    let span = positions[positions.len() - 1] - positions[0];
    (span - cycle).abs() <= SAME * cycle
}

fn too_few(count: usize) -> Field {
    Field {
        field: "position".to_owned(),
        message: format!("{count} samples in a cycle are too few"),
        hint: format!("give at least {LEAST}"),
    }
}

fn check_inertia(positions: &[f64], inertia: &[f64]) -> Result<(), Refusal> {
    let bad = |pair: &(&f64, &f64)| !(*pair.1 > 0.0);
    match positions.iter().zip(inertia).find(bad) {
        Some((&position, &inertia)) => Err(Refusal::Inertia { position, inertia }),
        None => Ok(()),
    }
}

fn faults(
    cycle: f64,
    positions: &[f64],
    inertia: &[f64],
    other: [(&str, &[f64]); 1],
) -> Vec<Field> {
    let mut faults = Vec::new();
    let mut add = |field: &str, message: String, hint: &str| {
        faults.push(Field {
            field: field.to_owned(),
            message,
            hint: hint.to_owned(),
        });
    };
    let sound = cycle.is_finite() && cycle > 0.0;
    if !sound {
        add("cycle", format!("{cycle} is not a positive number"), "");
    }
    let count = positions.len();
    if count < LEAST {
        let fault = too_few(count);
        add(&fault.field, fault.message, &fault.hint);
    }
    let columns = [("position", positions), ("inertia", inertia), other[0]];
    for (name, values) in columns {
        if values.len() != count {
            let message = format!("{} values for {count} positions", values.len());
            add(name, message, "give one for each position");
        }
        if let Some(row) = values.iter().position(|value| !value.is_finite()) {
            let message = format!("sample {row} is {}, not a finite number", values[row]);
            add(name, message, "");
        }
    }
    if let Some(row) = (1..count).find(|&i| positions[i] <= positions[i - 1]) {
        let (before, after) = (positions[row - 1], positions[row]);
        let message = format!("{after} does not come after {before}");
        add("position", message, "put the positions in ascending order");
    } else if sound && count > 0 && positions[count - 1] - positions[0] > cycle * (1.0 + SAME) {
        let span = positions[count - 1] - positions[0];
        let message = format!("the positions span {span} rad, the cycle only {cycle} rad");
        add("position", message, "give one cycle");
    }
    faults
}
