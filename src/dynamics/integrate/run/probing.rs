//! Switches that no signal tells: functions of the state, looked at from place to
//! place of a step.

use super::Run;
use crate::dynamics::integrate::locate::LocatedEvent;
use crate::dynamics::integrate::{Dynamics, EventFunction, Guard, Probe};
use crate::math::optimise::vertex;
use crate::math::roots::{BISECTIONS, bisect};

/// A probe may differ from a parabola by this part of its change.
const UNLIKE: f64 = 0.25;

/// Share by which parts of a step differ in length, and the ratio that spreads them.
const UNEVEN: f64 = 0.4;
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// Most halvings of a part in which a probe bends.
const CLOSEST: usize = 12;

/// A switch that changes nothing.
const NOTHING: EventFunction = EventFunction {
    guards: [Guard {
        signal: 0,
        offset: 0.0,
        displacement: 0.0,
        speed: 0.0,
    }; 2],
    rising: true,
    component: 0,
    target: 0,
};

impl<D: Dynamics> Run<'_, D> {
    /// The watch that was found; one made up for a probe.
    pub(super) fn watch(&self, found: LocatedEvent) -> EventFunction {
        let event_functions = self.event_functions.len();
        if found.watch < event_functions {
            return self.event_functions[found.watch];
        }
        let Some(probe) = self.probes.get(found.watch - event_functions) else {
            return self.crossed.unwrap_or(NOTHING);
        };
        EventFunction {
            guards: [Guard::default(); 2],
            rising: true,
            component: probe.component,
            target: probe.target,
        }
    }

    /// The earliest of a switch found and those that the probes tell.
    pub(super) fn probe_before(&mut self, found: Option<LocatedEvent>) -> Option<LocatedEvent> {
        let mut best = found;
        let mut y = std::mem::take(&mut self.probed);
        for index in 0..self.probes.len() {
            let end = best.map_or(1.0, |best| best.s);
            let probe = self.probes[index];
            let Some(s) = self.fires(&probe, end, &mut y) else {
                continue;
            };
            if best.is_none_or(|best| s < best.s) {
                let watch = self.event_functions.len() + index;
                best = Some(LocatedEvent { s, watch });
            }
        }
        self.probed = y;
        self.crossing_before(best)
    }

    /// The earliest of a switch found and what else the system tells.
    fn crossing_before(&mut self, found: Option<LocatedEvent>) -> Option<LocatedEvent> {
        let dynamics = self.evaluator.dynamics;
        if !dynamics.has_crossings() {
            return found;
        }
        let end = found.map_or(1.0, |found| found.s);
        let step = self.output.step(1.0);
        let modes = self.evaluator.modes.borrow();
        let Some((s, watch)) =
            dynamics.first_crossing(&step, &modes, end, self.fresh, &self.resting)
        else {
            return found;
        };
        if found.is_some_and(|found| found.s <= s) {
            return found;
        }
        drop(modes);
        self.crossed = Some(watch);
        let watch = self.event_functions.len() + self.probes.len();
        Some(LocatedEvent { s, watch })
    }

    /// Where a probe becomes positive first, up to `end`.
    fn fires(&self, probe: &Probe, end: f64, y: &mut [f64]) -> Option<f64> {
        // The start of a step is the end of the last one, unless something has
        // switched there.
        let turns = probe.looks > 1;
        let begin = match self.fresh || turns {
            true => self.value(probe, 0.0, y),
            false => f64::NEG_INFINITY,
        };
        if self.fresh && begin > 0.0 {
            return Some(0.0);
        }
        if probe.refined {
            return self.fires_within(probe, (begin, end), y);
        }
        let (mut before, mut low) = (None, (0.0, begin));
        for look in 1..=probe.looks {
            let s = end * look as f64 / probe.looks as f64;
            let high = (s, self.value(probe, s, y));
            // It may have been positive in between.
            if let Some([a, b]) = before.map(|before| [before, low])
                && let Some(s) = parabola_vertex([a, b, high])
                && self.value(probe, s, y) > 0.0
            {
                let low = if s > b.0 { b.0 } else { a.0 };
                return Some(self.bisect(probe, [low, s], y));
            }
            if high.1 > 0.0 {
                return Some(self.bisect(probe, [low.0, high.0], y));
            }
            before = turns.then_some(low);
            low = high;
        }
        None
    }

    /// The same of a function that the method does not resolve: in parts of unequal length, so
    /// that nothing periodic hides between them, and closer where it bends.
    fn fires_within(&self, probe: &Probe, (begin, end): (f64, f64), y: &mut [f64]) -> Option<f64> {
        let mut low = (0.0, begin);
        for look in 1..=probe.looks {
            let uneven = UNEVEN * ((look as f64 * GOLDEN).fract() - 0.5);
            let share = match look == probe.looks {
                true => 1.0,
                false => (look as f64 + uneven) / probe.looks as f64,
            };
            let s = end * share;
            let high = (s, self.value(probe, s, y));
            if let Some(found) = self.fires_between(probe, [low, high], CLOSEST, y) {
                return Some(found);
            }
            low = high;
        }
        None
    }

    /// Where a probe becomes positive first between two places, the first of which is not.
    fn fires_between(
        &self,
        probe: &Probe,
        [low, high]: [(f64, f64); 2],
        closer: usize,
        y: &mut [f64],
    ) -> Option<f64> {
        let mut at = |share: f64| {
            let s = low.0 + share * (high.0 - low.0);
            (s, self.value(probe, s, y))
        };
        let middle = at(0.5);
        let quarters = [at(0.25), at(0.75)];
        // Quarters by the parabola through the other three.
        let [a, b, c] = [low.1, middle.1, high.1];
        let expected = [
            0.375 * a + 0.75 * b - 0.125 * c,
            0.375 * c + 0.75 * b - 0.125 * a,
        ];
        let off = (quarters.iter().zip(expected))
            .map(|(quarter, expected)| (quarter.1 - expected).abs())
            .fold(0.0, f64::max);
        let points = [low, quarters[0], middle, quarters[1], high];
        let near = points
            .iter()
            .fold(f64::INFINITY, |near, p| near.min(p.1.abs()));
        if closer > 0 && !(off <= UNLIKE * near) {
            return self
                .fires_between(probe, [low, middle], closer - 1, y)
                .or_else(|| {
                    (middle.1 <= 0.0)
                        .then(|| self.fires_between(probe, [middle, high], closer - 1, y))
                        .flatten()
                });
        }
        for pair in points.windows(2) {
            if pair[1].1 > 0.0 {
                return Some(self.bisect(probe, [pair[0].0, pair[1].0], y));
            }
        }
        points.windows(3).find_map(|three| {
            let s = parabola_vertex([three[0], three[1], three[2]])?;
            let low = if s > three[1].0 {
                three[1].0
            } else {
                three[0].0
            };
            (self.value(probe, s, y) > 0.0).then(|| self.bisect(probe, [low, s], y))
        })
    }

    /// Where a probe becomes positive between two places; just before, where there are
    /// no forces beyond.
    fn bisect(&self, probe: &Probe, ends: [f64; 2], y: &mut [f64]) -> f64 {
        let [low, high] = bisect(ends, BISECTIONS, |s| !(self.value(probe, s, y) > 0.0));
        if self.value(probe, high, y) == Probe::NO_FORCES {
            low
        } else {
            high
        }
    }

    fn value(&self, probe: &Probe, s: f64, y: &mut [f64]) -> f64 {
        let step = self.output.step(1.0);
        let time = if s == 0.0 {
            y.copy_from_slice(&self.from.y);
            self.from.time
        } else if s == 1.0 {
            y.copy_from_slice(&self.to.y);
            self.to.time
        } else {
            step.state(s, y);
            step.time(s)
        };
        self.evaluator.probe(probe, time, y)
    }
}

/// Where a parabola through three places has its summit, if it lies between them and
/// may reach above zero while the first two are below.
fn parabola_vertex(points: [(f64, f64); 3]) -> Option<f64> {
    let [(_, fa), (b, fb), (_, fc)] = points;
    if !(fa <= 0.0 && fb <= 0.0) {
        return None;
    }
    let (s, top) = vertex(&points)?;
    let doubt = UNLIKE * (fa.max(fb).max(fc) - fa.min(fb).min(fc));
    // One beyond zero is found without it, unless it comes down before.
    (top + doubt > 0.0 && (fc <= 0.0 || s < b)).then_some(s)
}
