//! Switches that no signal tells: functions of the state, looked at from place to
//! place of a step.

use super::Run;
use crate::integrate::locate::Located;
use crate::integrate::{Dynamics, Guard, Probe, Watch};

/// Bisections, down to the rounding of a place on the step.
const BISECTIONS: usize = 60;

impl<D: Dynamics> Run<'_, D> {
    /// The watch that was found; one made up for a probe.
    pub(super) fn watch(&self, found: Located) -> Watch {
        let watches = self.watches.len();
        if found.watch < watches {
            return self.watches[found.watch];
        }
        let probe = self.probes[found.watch - watches];
        Watch {
            guards: [Guard::default(); 2],
            rising: true,
            component: probe.component,
            target: probe.target,
        }
    }

    /// The earliest of a switch found and those that the probes tell.
    pub(super) fn probe_before(&mut self, found: Option<Located>) -> Option<Located> {
        if self.probes.is_empty() {
            return found;
        }
        let mut best = found;
        let mut y = std::mem::take(&mut self.probed);
        for index in 0..self.probes.len() {
            let end = best.map_or(1.0, |best| best.s);
            let probe = self.probes[index];
            let Some(s) = self.fires(&probe, end, &mut y) else {
                continue;
            };
            if best.is_none_or(|best| s < best.s) {
                let watch = self.watches.len() + index;
                best = Some(Located { s, watch });
            }
        }
        self.probed = y;
        best
    }

    /// Where a probe becomes positive first, up to `end`.
    fn fires(&self, probe: &Probe, end: f64, y: &mut [f64]) -> Option<f64> {
        let mut low = 0.0;
        // The start of a step is the end of the last one, unless something has
        // switched there.
        if self.fresh && self.is_positive(probe, 0.0, y) {
            return Some(0.0);
        }
        for look in 1..=probe.looks {
            let mut high = end * look as f64 / probe.looks as f64;
            if !self.is_positive(probe, high, y) {
                low = high;
                continue;
            }
            for _ in 0..BISECTIONS {
                let middle = 0.5 * (low + high);
                if middle <= low || middle >= high {
                    break;
                }
                match self.is_positive(probe, middle, y) {
                    true => high = middle,
                    false => low = middle,
                }
            }
            return Some(high);
        }
        None
    }

    fn is_positive(&self, probe: &Probe, s: f64, y: &mut [f64]) -> bool {
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
        self.evaluator.probe(probe, time, y) > 0.0
    }
}
