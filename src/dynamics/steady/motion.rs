//! The steady motion on functions of the position.

use super::Mean;
use super::extrapolation::integrate_stretch;
use super::law::{Family, Level, Means, Question, SteadyFigures, find, warnings};
use super::panel::Panel;
use super::profile::{Extreme, Profile};
use super::refusal::Refusal;
use crate::math::quadrature::{Area, integrate};
use serde::Serialize;

/// A steady motion: the machine and the level of its kinetic energy.
#[derive(Clone, Debug)]
pub struct SteadyMotion {
    profile: Profile,
    level: f64,
    /// Figures of the motion.
    pub figures: SteadyFigures,
}

/// The motion at a position.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Row {
    /// φ (rad).
    pub position: f64,
    /// t since φ = 0 (s).
    pub time: f64,
    /// ω (rad/s).
    pub speed: f64,
    /// ε (rad/s²).
    pub acceleration: f64,
    /// J (kg·m²).
    pub inertia: f64,
    /// M (N·m), the balancing moment included.
    pub moment: f64,
    /// A since φ = 0 (J).
    pub work: f64,
    /// T (J).
    pub energy: f64,
}

/// Errors of closure of an integration of the equation of motion over a cycle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Check {
    /// Ratio of the greatest speeds that are found onward and back from the least, − 1.
    pub speed: f64,
    /// Time for the cycle over the period, − 1.
    pub period: f64,
}

/// The steady motion with the mean speed asked for.
///
/// # Errors
/// There is none: see [`Refusal`].
pub fn find_steady_motion(profile: &Profile, question: &Question) -> Result<SteadyMotion, Refusal> {
    question.check()?;
    let (surplus, range) = (profile.work_of_cycle(), profile.range());
    let balance = question.balance(surplus, [range, profile.rounding()], profile.cycle())?;
    let profile = match balance {
        Some(moment) => profile.with_moment(moment)?,
        None => profile.clone(),
    };
    let level = find(&profile, question)?;
    let mut motion = SteadyMotion::at(profile, level.level, question);
    motion.set_convergence_figures(&level, question, surplus, balance);
    motion.figures.check()?;
    Ok(motion)
}

/// ω at a distance from the start of a panel for a level of the kinetic energy.
fn speed(panel: &Panel, level: f64, distance: f64) -> f64 {
    let (inertia, rise) = panel.masses(distance);
    (2.0 * (level + rise) / inertia).sqrt()
}

/// Share of the whole that quadrature may miss in a panel.
const TOLERANCE: f64 = 1e-16;

impl Profile {
    /// ∫ of a function of ω over the cycle; `size` is that of the result.
    fn sum(&self, level: f64, size: f64, of: impl Fn(f64) -> f64) -> Area {
        let mut total = Area::default();
        for panel in self.panels() {
            let f = |distance: f64| of(speed(panel, level, distance));
            let area = integrate(&f, 0.0, panel.length(), TOLERANCE * size);
            total.value += area.value;
            total.error += area.error;
        }
        total
    }

    /// Upper bound of ω (rad/s) at a level of the kinetic energy (J): greatest energy over least
    /// inertia. Scales the tolerances of quadrature.
    fn speed_bound(&self, level: f64) -> f64 {
        (2.0 * (level + self.range()) / self.least_inertia().value).sqrt()
    }

    fn period(&self, level: f64) -> Area {
        let size = self.cycle() / self.speed_bound(level);
        self.sum(level, size, |speed| 1.0 / speed)
    }

    fn mean_over_angle(&self, level: f64) -> f64 {
        let size = self.cycle() * self.speed_bound(level);
        self.sum(level, size, |speed| speed).value / self.cycle()
    }

    /// Least and greatest ω.
    fn speeds(&self, level: f64) -> [Extreme; 2] {
        [-1.0, 1.0].map(|sense| {
            let square = self.extreme(sense, &|point| {
                let (energy, inertia) = (level + point.rise_signed, point.inertia);
                let slope = point.moment - energy / inertia * point.inertia_slope;
                [2.0 * energy / inertia, 2.0 * slope / inertia]
            });
            Extreme {
                value: square.value.max(0.0).sqrt(),
                at: square.at,
            }
        })
    }
}

impl Family for Profile {
    fn mean_speed(&self, level: f64, mean: Mean) -> f64 {
        match mean {
            Mean::Time => self.cycle() / self.period(level).value,
            Mean::Angle => self.mean_over_angle(level),
            Mean::Midrange => {
                let [least, greatest] = self.speeds(level);
                0.5 * (least.value + greatest.value)
            }
        }
    }

    fn mean_at_level_zero(&self, mean: Mean) -> f64 {
        if mean != Mean::Time {
            return Family::mean_speed(self, 0.0, mean);
        }
        if !self.is_pointed() {
            return 0.0;
        }
        // Two corners equally low differ by rounding alone.
        let period = self.period(1e-18 * self.range()).value;
        let lowest = self.cycle() / period;
        if lowest.is_finite() { lowest } else { 0.0 }
    }

    fn inertia(&self) -> [f64; 2] {
        [self.least_inertia().value, self.greatest_inertia().value]
    }

    fn rise(&self) -> [f64; 2] {
        [self.range(), self.at(self.least_inertia().at).rise]
    }

    fn lowest_position(&self) -> f64 {
        self.least_work().at
    }
}

impl Profile {
    /// True when the work is least at a corner: the moment jumps through zero
    /// there, and to stop in it takes a finite time.
    fn is_pointed(&self) -> bool {
        let place = self.least_work().at;
        let panels = self.panels();
        let greatest = panels.iter().fold(0.0, |size: f64, panel| {
            size.max(panel.at(panel.from).moment.abs())
        });
        let after = self.at(place).moment;
        let index = panels.partition_point(|panel| panel.to < place);
        let last = if place <= 0.0 {
            panels.len() - 1
        } else {
            index
        };
        let before = &panels[last.min(panels.len() - 1)];
        let end = if place <= 0.0 { self.cycle() } else { place };
        let before = before.at(end).moment;
        after > 1e-9 * greatest && before < -1e-9 * greatest
    }
}

impl SteadyMotion {
    fn at(profile: Profile, level: f64, question: &Question) -> Self {
        let period = profile.period(level);
        let [least_speed, greatest_speed] = profile.speeds(level);
        let reference = profile.least_inertia().at;
        let range = profile.range();
        let figures = SteadyFigures {
            mean_speed: question.mean_speed,
            mean: question.mean,
            means: Means {
                time: profile.cycle() / period.value,
                angle: profile.mean_over_angle(level),
                midrange: 0.5 * (least_speed.value + greatest_speed.value),
            },
            period: period.value,
            energy_at_start: level + profile.at(0.0).rise,
            reference_energy: level + profile.at(reference).rise,
            reference_position: reference,
            least_speed,
            greatest_speed,
            fluctuation: (greatest_speed.value - least_speed.value) / question.mean_speed,
            energy_fluctuation: range,
            cycle_work: profile.work_of_cycle(),
            balance: None,
            iterations: 0,
            bracket: [0.0; 2],
            first_bracket: [0.0; 2],
            miss: 0.0,
            tolerance: question.tolerance,
            met: true,
            period_error: Some(period.error / period.value),
            energy_ratio: level / (level + range),
            warnings: Vec::new(),
        };
        Self {
            profile,
            level,
            figures,
        }
    }

    fn set_convergence_figures(
        &mut self,
        level: &Level,
        question: &Question,
        surplus: f64,
        balance: Option<f64>,
    ) {
        let figures = &mut self.figures;
        figures.cycle_work = surplus;
        figures.balance = balance;
        figures.iterations = level.iterations;
        figures.bracket = level.bracket;
        figures.first_bracket = level.first;
        figures.miss = level.miss;
        figures.met = level.miss <= question.tolerance;
        let place = self.profile.least_work().at;
        figures.warnings = warnings(figures.energy_ratio, place, level, question);
    }

    /// The machine, with the balancing moment.
    pub fn profile(&self) -> &Profile {
        &self.profile
    }

    /// ω at a position of [0, Φ] (rad/s).
    pub fn speed(&self, position: f64) -> f64 {
        let panel = self.profile.panel(position);
        speed(panel, self.level, position - panel.from)
    }

    /// The motion at `count` equal steps over the cycle, both ends included.
    pub fn rows(&self, count: usize) -> Vec<Row> {
        let (count, cycle) = (count.max(1), self.profile.cycle());
        let (mut time, mut before) = (0.0, 0.0);
        let start = self.profile.at(0.0).rise;
        let row = |i: usize| {
            let position = cycle * i as f64 / count as f64;
            time += self.time(before, position);
            before = position;
            let point = self.profile.at(position);
            let energy = self.level + point.rise;
            let speed = (2.0 * energy / point.inertia).sqrt();
            Row {
                position,
                time,
                speed,
                acceleration: (point.moment - 0.5 * point.inertia_slope * speed * speed)
                    / point.inertia,
                inertia: point.inertia,
                moment: point.moment,
                work: point.rise - start,
                energy,
            }
        };
        (0..=count).map(row).collect()
    }

    /// Time from one position to a later one (s).
    fn time(&self, from: f64, to: f64) -> f64 {
        let size = self.figures.period;
        let panels = self.profile.panels().iter();
        let crossed = panels.filter(|panel| panel.to > from && panel.from < to);
        crossed
            .map(|panel| {
                let f = |distance: f64| 1.0 / speed(panel, self.level, distance);
                let (from, to) = (from.max(panel.from), to.min(panel.to));
                let ends = [from - panel.from, to - panel.from];
                integrate(&f, ends[0], ends[1], 1e-15 * size).value
            })
            .sum()
    }

    /// Integrates J·φ̈ + J′·φ̇²/2 = M over one cycle, from the least speed onward and back to
    /// the greatest; `None` when the integration stands still on the way.
    ///
    /// (Towards a speed near zero every error grows by the ratio of the speeds; away from it
    /// none does.)
    pub fn check(&self) -> Option<Check> {
        let [least, greatest] = [&self.figures.least_speed, &self.figures.greatest_speed];
        let cycle = self.profile.cycle();
        let onward = (greatest.at - least.at).rem_euclid(cycle);
        let before = self.speed_and_time_after(least.at, onward, 1.0)?;
        let behind = self.speed_and_time_after(greatest.at, cycle - onward, -1.0)?;
        Some(Check {
            speed: before[0] / behind[0] - 1.0,
            period: (before[1] + behind[1]) / self.figures.period - 1.0,
        })
    }

    /// Speed at the end of a way of `length` and time for it, by the equation of motion from
    /// its other end; `sense` −1: the way is gone from its end to `from`.
    fn speed_and_time_after(&self, from: f64, length: f64, sense: f64) -> Option<[f64; 2]> {
        let mut way = self.panels_between(from, length);
        if sense < 0.0 {
            way.reverse();
        }
        let mut state: Option<[f64; 2]> = None;
        for (panel, [low, high]) in way {
            let begin = if sense > 0.0 { low } else { high };
            let mut own = state.unwrap_or([speed(panel, self.level, begin - panel.from), 0.0]);
            let mut rates = |gone: f64, [speed, _]: &[f64; 2]| {
                let point = panel.at(begin + sense * gone);
                let braking = 0.5 * point.inertia_slope * speed * speed;
                let rate = (point.moment - braking) / (point.inertia * speed);
                (*speed > 0.0).then_some([sense * rate, 1.0 / speed])
            };
            integrate_stretch(&mut rates, [0.0, high - low], &mut own, 1e-13).ok()?;
            state = Some(own);
        }
        state.or_else(|| Some([self.speed(from), 0.0]))
    }

    /// The parts of panels on a way, which may lead over the end of the cycle.
    fn panels_between(&self, from: f64, length: f64) -> Vec<(&Panel, [f64; 2])> {
        let (cycle, panels) = (self.profile.cycle(), self.profile.panels());
        let turns = [0.0, cycle].into_iter();
        let parts = turns.flat_map(|turn| {
            panels.iter().map(move |panel| {
                let low = panel.from.max(from - turn);
                (panel, [low, panel.to.min(from + length - turn)])
            })
        });
        parts.filter(|(_, [low, high])| low < high).collect()
    }
}
