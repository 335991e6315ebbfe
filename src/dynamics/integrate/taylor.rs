//! Taylor series: the own method where accuracy limits the step.
//!
//! The system gives its motion as a power series (see [`Dynamics::expand`]); its
//! last coefficients tell for how long it is good, as M. Jorba and M. Zou have it
//! (A software package for the numerical integration of ODEs by means of
//! high-order Taylor methods, Experimental Mathematics 14, 2005). What they
//! promise is checked: at the end of a step the series must satisfy the equations
//! of motion. The series is the continuous output, and nothing has to be found
//! anew after a switch.

use super::run::{Run, StepInterpolant, Verdict};
use super::{Dynamics, Stop};
use crate::math::number::NOTHING;

/// Local error allowed per step, relative to the tolerance asked for.
const SAFETY: f64 = 0.1;
/// Degrees of the series.
const LEAST_DEGREE: f64 = 10.0;
const MOST_DEGREE: f64 = 24.0;
/// Share of the step that the last coefficients promise.
const CAUTION: f64 = 0.9;
/// Longest step against what the series was asked for, and the next against the last.
const LONGEST: f64 = 2.0;
/// What series of laws may miss, relative to what moves in a step, however fine the tolerance.
const OF_LAWS: f64 = 1e-10;
/// A signal that is the small difference of coordinates is known to this share of the greatest
/// of their scales, within what is allowed.
const UNMOVED: f64 = 1e-3;
/// A step that is refused is shortened at least to this share, at most to that.
const LEAST_CUT: f64 = 0.9;
const MOST_CUT: f64 = 0.25;

/// Degree for a tolerance: the work of a series grows with the square of its
/// degree, its reach with tolerance^(1/degree).
pub fn degree(tolerance: f64) -> usize {
    let digits = -tolerance.log10();
    (6.0 + 1.25 * digits)
        .round()
        .clamp(LEAST_DEGREE, MOST_DEGREE) as usize
}

/// The series of a step, kept between steps.
#[derive(Debug, Default)]
pub(super) struct Series {
    /// Coefficients over the time asked for, one signal after the other.
    coefficients: Vec<f64>,
    /// State and derivative at the end of the step.
    y: Vec<f64>,
    dy: Vec<f64>,
    /// (s, ṡ, s̈) of every signal there.
    signals: Vec<[f64; 3]>,
}

/// Takes the run as far towards its target as one leg goes: to the target or
/// to a switch.
pub(super) fn follow_leg<D: Dynamics>(run: &mut Run<'_, D>) {
    if !run.evaluator.dynamics.expands() {
        let reason = "the motion has no power series; use dop853, rodas5p or radau".to_owned();
        let method = run.settings.method;
        run.end(Stop::Method { method, reason });
        return;
    }
    let mut series = std::mem::take(&mut run.series);
    series.follow_leg(run);
    run.series = series;
}

impl Series {
    fn follow_leg<D: Dynamics>(&mut self, run: &mut Run<'_, D>) {
        let degree = degree(run.tolerance());
        let width = run.from.y.len();
        let signals = run.evaluator.dynamics.signals();
        self.coefficients.resize(signals * (degree + 1), 0.0);
        self.y.resize(width, 0.0);
        self.dy.resize(width, 0.0);
        self.signals.resize(signals, [0.0; 3]);
        let mut wanted = run.first_length(degree as i32);
        let longest = run.longest_step();
        loop {
            let (time, rest) = (run.from.time, run.target - run.from.time);
            let asked = wanted.min(longest).min(rest);
            let Some((length, asked, next)) = self.step(run, degree, asked, rest) else {
                return;
            };
            wanted = next;
            let lands = length >= rest;
            let share = length / asked;
            let end = if lands { run.target } else { time + length };
            let given = StepInterpolant::Series(&self.coefficients, degree, share);
            let verdict = run.accept_with(end, &self.y, &self.dy, given);
            if lands || verdict != Verdict::Continue {
                return;
            }
        }
    }

    /// A series from where the run stands and how far it is good: the length of
    /// the step, the time that the series was asked for in the end, and that to
    /// ask for next. `None`: the run has been ended.
    fn step<D: Dynamics>(
        &mut self,
        run: &mut Run<'_, D>,
        degree: usize,
        asked: f64,
        rest: f64,
    ) -> Option<(f64, f64, f64)> {
        let floor = 4.0 * f64::EPSILON * run.from.time.abs().max(run.target.abs());
        let mut asked = asked;
        loop {
            if asked <= floor {
                // Are there numbers at all beyond this instant?
                for ((y, from), rate) in self.y.iter_mut().zip(&run.from.y).zip(&run.from.dy) {
                    *y = from + 4.0 * floor * rate;
                }
                let beyond = run.from.time + 4.0 * floor;
                run.evaluator.derivatives(beyond, &self.y, &mut self.dy);
                run.end_at_floor(asked);
                return None;
            }
            let (from, out) = (&run.from, &mut self.coefficients);
            let span = [from.time, asked];
            let way = run.evaluator.expand(span, &from.y, &from.dy, degree, out);
            let promised = self.promise(run, degree, asked);
            let promised = if promised.is_nan() || way.is_nan() {
                f64::NAN
            } else {
                promised.min(1.0 / way)
            };
            if !(promised > 1e-3) {
                // Far too long, or not a number: what is left of it says little.
                run.rejected += 1;
                asked *= 0.1;
                continue;
            }
            let mut share = promised.min(1.0);
            // Not a bit less than all of the rest.
            let whole = rest / asked;
            if share >= (1.0 - 1e-9) * whole {
                share = whole;
            } else if 2.0 * share > whole {
                // No crumb is left over: within it rates would drown in the
                // rounding of great angles.
                share = 0.5 * whole;
            }
            loop {
                let error = self.defect(run, degree, asked, share);
                let error = self.signals_defect(run, degree, asked, share, error);
                if error <= 1.0 {
                    let length = if share == whole { rest } else { share * asked };
                    let grown = 0.95 * error.max(1e-9).powf(-1.0 / degree as f64);
                    let next = promised * asked * grown.min(1.1);
                    return Some((length, asked, next.min(LONGEST * length.max(asked))));
                }
                run.rejected += 1;
                let cut = 0.9 * error.powf(-1.0 / degree as f64);
                // Not a number counts as far too much.
                let cut = if cut > MOST_CUT {
                    cut.min(LEAST_CUT)
                } else {
                    MOST_CUT
                };
                share *= cut;
                if share < 0.05 {
                    asked *= share;
                    break;
                }
            }
        }
    }

    /// Share of the time asked for over which the last two coefficients of every
    /// coordinate, and of its rate, stay within what is allowed.
    fn promise<D: Dynamics>(&self, run: &Run<'_, D>, degree: usize, asked: f64) -> f64 {
        let allowed = SAFETY * run.tolerance();
        let scales = run.evaluator.dynamics.scales();
        let count = scales.len() / 2;
        let mut largest = [0.0f64; 2];
        let rows = self.coefficients.chunks_exact(degree + 1);
        for (k, row) in rows.take(count).enumerate() {
            // (Of a motion that is nothing yet no share is asked for.)
            let place = allowed * (scales[k] + run.from.y[k].abs()) + NOTHING;
            let speed = allowed * asked * (scales[count + k] + run.from.y[count + k].abs());
            let speed = speed + NOTHING;
            for (last, order) in largest.iter_mut().zip([degree - 1, degree]) {
                let size = row[order].abs();
                let error = (size / place).max(order as f64 * size / speed);
                // Not a number stays one.
                *last = if error > *last || error.is_nan() {
                    error
                } else {
                    *last
                };
            }
        }
        let share = |error: f64, order: usize| error.powf(-1.0 / order as f64);
        let (one, other) = (share(largest[0], degree - 1), share(largest[1], degree));
        if one.is_nan() || other.is_nan() {
            return f64::NAN;
        }
        CAUTION * one.min(other)
    }

    /// Puts the state after a share of the series into `y`, its derivative into
    /// `dy`; returns the error that the difference of its acceleration from the
    /// series' makes over the step, in units of what is allowed.
    fn defect<D: Dynamics>(
        &mut self,
        run: &Run<'_, D>,
        degree: usize,
        asked: f64,
        share: f64,
    ) -> f64 {
        let scales = run.evaluator.dynamics.scales();
        let count = scales.len() / 2;
        let rows = self.coefficients.chunks_exact(degree + 1);
        for (k, row) in rows.take(count).enumerate() {
            let (mut value, mut slope) = (row[degree], 0.0);
            for c in row[..degree].iter().rev() {
                slope = slope * share + value;
                value = value * share + c;
            }
            self.y[k] = value;
            self.y[count + k] = slope / asked;
        }
        let end = run.from.time + share * asked;
        run.evaluator.derivatives(end, &self.y, &mut self.dy);
        let length = share * asked;
        let allowed = SAFETY * run.tolerance();
        let mut greatest = 0.0f64;
        let rows = self.coefficients.chunks_exact(degree + 1);
        for (k, row) in rows.take(count).enumerate() {
            let mut bend = 0.0;
            for order in (2..=degree).rev() {
                bend = bend * share + (order * (order - 1)) as f64 * row[order];
            }
            let found = self.dy[count + k];
            let rounding = 16.0 * f64::EPSILON * found.abs();
            let defect = (found - bend / (asked * asked)).abs() - rounding;
            // It has grown with s^(degree − 1): its integrals are smaller.
            let speed = defect * length / degree as f64;
            let of_speed = allowed * (scales[count + k] + self.y[count + k].abs()) + NOTHING;
            let of_place = allowed * (scales[k] + self.y[k].abs()) + NOTHING;
            let place = speed * length / (degree + 1) as f64;
            let error = (speed / of_speed).max(place / of_place);
            if error > greatest || error.is_nan() {
                greatest = error;
            }
            if error.is_nan() {
                return f64::NAN;
            }
        }
        greatest
    }

    /// The greater of an error and that by which the series of the signals beyond the
    /// coordinates miss them at the end of the step, in units of what is allowed: guards
    /// and figures read them.
    fn signals_defect<D: Dynamics>(
        &mut self,
        run: &Run<'_, D>,
        degree: usize,
        asked: f64,
        share: f64,
        known: f64,
    ) -> f64 {
        let count = self.y.len() / 2;
        if self.signals.len() == count || known.is_nan() || known > 1.0 {
            return known;
        }
        let time = run.from.time + share * asked;
        run.evaluator
            .signals(time, &self.y, &self.dy, &mut self.signals);
        let allowed = (10.0 * run.tolerance()).max(OF_LAWS);
        let length = share * asked;
        let scales = &run.evaluator.dynamics.scales()[..count];
        let floor = UNMOVED * scales.iter().copied().fold(0.0, f64::max);
        let mut greatest = known;
        let rows = self.coefficients.chunks_exact(degree + 1);
        for (row, found) in rows.zip(&self.signals).skip(count) {
            let (mut value, mut slope, mut moved, mut power) = (row[degree], 0.0, floor, 1.0);
            for c in row[..degree].iter().rev() {
                slope = slope * share + value;
                value = value * share + c;
            }
            for c in &row[1..] {
                power *= share;
                moved += (c * power).abs();
            }
            let miss = |series: f64, exact: f64, size: f64| {
                (series - exact).abs() - 64.0 * f64::EPSILON * (exact.abs() + size)
            };
            let [place, speed, _] = *found;
            let off = miss(value, place, 0.0);
            let of_speed = miss(slope / asked, speed, place.abs() / length) * length;
            let error = off.max(of_speed) / (allowed * moved);
            if error.is_nan() || off.is_nan() || of_speed.is_nan() {
                return f64::NAN;
            }
            greatest = greatest.max(error);
        }
        greatest
    }
}

#[cfg(test)]
mod tests {
    use super::degree;

    #[test]
    fn the_degree_grows_with_the_digits_asked_for() {
        assert_eq!([1e-1, 1e-4, 1e-8, 1e-14].map(degree), [10, 11, 16, 24]);
    }
}
