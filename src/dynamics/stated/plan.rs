//! Plans of motion as a scene states them.

use super::curve::{Sum, chebyshev_end_derivative, solve};
use super::law::StatedLaw;
use super::local::Local;
use crate::kinematics::motion::CycleSpec;
use crate::kinematics::motion::cycle::{Motion, Station};

/// Most coefficients of smooth motions that depend on each other.
const MOST_COEFFICIENTS: usize = 120;

/// A plan of motion.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct StatedPlan {
    /// Where each motion begins and ends, with the displacements there, and its shape.
    motions: Vec<Stretch>,
    period: Option<f64>,
    advance: f64,
    phase: f64,
}

#[derive(Clone, Debug, PartialEq)]
struct Stretch {
    from: (f64, f64),
    to: (f64, f64),
    shape: Shape,
}

#[derive(Clone, Debug, PartialEq)]
enum Shape {
    Dwell,
    Uniform,
    Law(StatedLaw),
    Smooth(Sum),
}

impl StatedPlan {
    /// A plan; `None` where its motions are not determined, or too many depend on each other.
    pub(crate) fn new(spec: &CycleSpec) -> Option<Self> {
        let mut places: Vec<(f64, f64)> = (spec.stations.iter())
            .map(|station| (station.at, station.displacement))
            .collect();
        if let Some(period) = spec.period {
            let (first, last) = (places[0], places[places.len() - 1]);
            if last.0 - first.0 >= period * (1.0 - 1e-9) {
                places.pop();
            }
            places.push((first.0 + period, first.1 + spec.advance));
        }
        let mut motions = Vec::with_capacity(places.len() - 1);
        for (index, ends) in places.windows(2).enumerate() {
            motions.push(Stretch {
                from: ends[0],
                to: ends[1],
                shape: match &spec.stations[index].motion {
                    Motion::Dwell => Shape::Dwell,
                    Motion::Uniform => Shape::Uniform,
                    Motion::Law(law) => Shape::Law(StatedLaw::stroke(law)?),
                    Motion::Smooth => Shape::Smooth(Sum(Vec::new())),
                },
            });
        }
        let mut plan = Self {
            motions,
            period: spec.period,
            advance: spec.advance,
            phase: spec.phase,
        };
        plan.smooth(&spec.stations)?;
        Some(plan)
    }

    /// Displacement and its derivatives at x.
    pub(crate) fn at(&self, x: f64) -> Local {
        let (first, last) = (&self.motions[0], &self.motions[self.motions.len() - 1]);
        let mut x = x + self.phase;
        let mut turns = 0.0;
        match self.period {
            Some(period) => {
                turns = ((x - first.from.0) / period).floor();
                x -= turns * period;
            }
            None if x < first.from.0 => return Local::new(first.from.1, 0.0, 0.0),
            None if x > last.to.0 => return Local::new(last.to.1, 0.0, 0.0),
            None => {}
        }
        let own = self.motions.iter().find(|motion| x < motion.to.0);
        own.unwrap_or(last).at(x).shift(turns * self.advance)
    }

    /// Finds the smooth motions: all their coefficients from one system.
    fn smooth(&mut self, stations: &[Station]) -> Option<()> {
        let count = self.motions.len();
        let is_smooth = |k: usize| matches!(self.motions[k].shape, Shape::Smooth(_));
        let sides = |station: usize| -> [Option<usize>; 2] {
            let before = match station {
                0 => self.period.map(|_| count - 1),
                other => Some(other - 1),
            };
            let at = if station == count && self.period.is_some() {
                0
            } else {
                station
            };
            [before, (at < count).then_some(at)]
        };
        let station_of = |k: usize| if self.period.is_some() { k % count } else { k };
        let orders = |station: usize| {
            let own = &stations[station_of(station)];
            own.order
                .max(if own.acceleration.is_some() { 2 } else { 1 })
        };
        // Where the coefficients of each smooth motion begin.
        let mut begin = vec![0; count + 1];
        for k in 0..count {
            let own = if is_smooth(k) {
                2 + orders(k) + orders(k + 1)
            } else {
                0
            };
            begin[k + 1] = begin[k] + own;
        }
        let all = begin[count];
        if all == 0 {
            return Some(());
        }
        if all > MOST_COEFFICIENTS {
            return None;
        }
        // The derivative of an order of motion k at an end as a row of the system.
        let row = |k: usize, order: usize, at_end: bool, factor: f64, row: &mut Vec<f64>| {
            let span = self.motions[k].to.0 - self.motions[k].from.0;
            for n in 0..begin[k + 1] - begin[k] {
                row[begin[k] + n] +=
                    factor * chebyshev_end_derivative(n, order, at_end) / span.powi(order as i32);
            }
        };
        let mut rows: Vec<Vec<f64>> = Vec::with_capacity(all);
        let mut add = |terms: &[(usize, usize, bool, f64)], value: f64| {
            let mut own = vec![0.0; all + 1];
            for &(k, order, at_end, factor) in terms {
                row(k, order, at_end, factor, &mut own);
            }
            own[all] = value;
            rows.push(own);
        };
        for k in (0..count).filter(|&k| is_smooth(k)) {
            add(&[(k, 0, false, 1.0)], self.motions[k].from.1);
            add(&[(k, 0, true, 1.0)], self.motions[k].to.1);
        }
        let last = if self.period.is_some() {
            count
        } else {
            count + 1
        };
        for station in 0..last {
            let [before, after] = sides(station);
            let smooth = |side: Option<usize>| side.filter(|&k| is_smooth(k));
            let own = &stations[station];
            let prescribed = [own.speed, own.acceleration, None];
            let mut open = 0;
            for order in 1..=orders(station) {
                let (left, right) = (smooth(before), smooth(after));
                let known = match (prescribed[order - 1], left, right) {
                    (Some(value), _, _) => value,
                    (None, Some(left), Some(right)) => {
                        add(
                            &[(left, order, true, 1.0), (right, order, false, -1.0)],
                            0.0,
                        );
                        open += 1;
                        continue;
                    }
                    (None, None, None) => continue,
                    (None, Some(_), None) => self.neighbour(after, order, false)?,
                    (None, None, Some(_)) => self.neighbour(before, order, true)?,
                };
                for (side, at_end) in [(left, true), (right, false)] {
                    if let Some(k) = side {
                        add(&[(k, order, at_end, 1.0)], known);
                    }
                }
            }
            if let (Some(left), Some(right)) = (smooth(before), smooth(after)) {
                for order in orders(station) + 1..=orders(station) + open {
                    add(
                        &[(left, order, true, 1.0), (right, order, false, -1.0)],
                        0.0,
                    );
                }
            }
        }
        let found = (rows.len() == all).then(|| solve(rows)).flatten()?;
        for k in 0..count {
            if let Shape::Smooth(sum) = &mut self.motions[k].shape {
                *sum = Sum(found[begin[k]..begin[k + 1]].to_vec());
            }
        }
        Some(())
    }

    /// A derivative of a motion that is not smooth, at one of its ends; beyond the plan is
    /// rest. `None`: of a law, the third.
    fn neighbour(&self, side: Option<usize>, order: usize, at_end: bool) -> Option<f64> {
        let Some(own) = side.map(|k| &self.motions[k]) else {
            return Some(0.0);
        };
        let there = own.at(if at_end { own.to.0 } else { own.from.0 });
        match (&own.shape, order) {
            (_, 1) => Some(there.first),
            (_, 2) => Some(there.second),
            (Shape::Law(_), _) => None,
            _ => Some(0.0),
        }
    }
}

impl Stretch {
    fn at(&self, x: f64) -> Local {
        let span = self.to.0 - self.from.0;
        let stroke = self.to.1 - self.from.1;
        let share = (x - self.from.0) / span;
        match &self.shape {
            Shape::Dwell => Local::new(self.from.1, 0.0, 0.0),
            Shape::Uniform => Local::new(self.from.1 + stroke * share, stroke / span, 0.0),
            Shape::Law(law) => {
                let law = law.at(share).scale(stroke).faster(1.0 / span);
                law.shift(self.from.1)
            }
            Shape::Smooth(sum) => sum.at(share).faster(1.0 / span),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::StatedPlan;
    use crate::kinematics::motion::cycle::{Motion, Station};
    use crate::kinematics::motion::{Cycle, CycleSpec, LawName};

    fn station(at: f64, displacement: f64, motion: Motion) -> Station {
        Station {
            at,
            displacement,
            speed: None,
            acceleration: None,
            order: 2,
            motion,
        }
    }

    fn agree(spec: &CycleSpec) {
        let (own, other) = (StatedPlan::new(spec).unwrap(), Cycle::new(spec).unwrap());
        for k in -30..60 {
            let x = 0.0137 + 0.1 * f64::from(k);
            let own = own.at(x);
            let other = other.jet(other.breaks().segment_at(x, 1.0), x);
            approx::assert_abs_diff_eq!(own.value, other.value, epsilon = 1e-11);
            approx::assert_abs_diff_eq!(own.first, other.first, epsilon = 1e-10);
            approx::assert_abs_diff_eq!(own.second, other.second, epsilon = 1e-8);
        }
    }

    #[test]
    fn plans_are_those_that_runs_are_computed_with() {
        let law = Motion::Law(LawName::ModifiedSine.into());
        let fast = Station {
            speed: Some(2.0),
            ..station(1.4, 0.9, Motion::Smooth)
        };
        for period in [Some(3.0), None] {
            agree(&CycleSpec {
                stations: vec![
                    station(0.1, 0.0, law.clone()),
                    station(0.5, 1.0, Motion::Smooth),
                    station(1.0, 0.5, Motion::Smooth),
                    fast.clone(),
                    station(2.0, 1.5, Motion::Uniform),
                    station(2.3, 1.7, Motion::Smooth),
                    station(2.7, 0.3, Motion::Smooth),
                ],
                period,
                advance: if period.is_some() { 0.4 } else { 0.0 },
                phase: 0.2,
            });
        }
    }
}
