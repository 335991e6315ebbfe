//! What is shown of a sum of modes: it moves by the speed that is shown of it.

use super::judge::{Judge, ROUNDINGS, keep_smaller_defect};
use super::sampler::{DrawnInstant, WEIGHTS, Window};
use crate::dynamics::system::ObjectState;

impl Judge<'_> {
    /// The displacement of every sum of modes grows by the integral of its speed: no law of
    /// the scene states more of it.
    pub(super) fn judge_sums(&mut self, look: &DrawnInstant) {
        let model = self.system.model();
        if model.reduced.is_empty() || !self.asked.recorded {
            return;
        }
        let mut best: Vec<Option<(f64, f64)>> = vec![None; model.reduced.len()];
        for window in &look.windows {
            let gains = self.gains(look, window);
            for (best, (reduced, [gain, mean, size])) in
                best.iter_mut().zip(model.reduced.iter().zip(gains))
            {
                let part = &model.objects[reduced.object];
                let Some(&node) = part.nodes.last() else {
                    continue;
                };
                let greatest = self.scales.motion[node][1];
                let rate = gain / window.length();
                if !(greatest > 0.0) {
                    continue;
                }
                let rounding = ROUNDINGS * size / window.length() / greatest;
                let own = ((rate - mean).abs() / greatest, self.bound() + rounding);
                keep_smaller_defect(best, own);
            }
        }
        let time = look.windows[0].middle();
        for (reduced, best) in model.reduced.iter().zip(best) {
            if let Some((defect, bound)) = best {
                let place = (time, &*model.objects[reduced.object].id);
                self.found.include(defect, bound, place, "speed of the sum");
            }
        }
    }

    /// Of every sum of modes over a window: gain of displacement, mean speed, and the
    /// greatest displacement.
    fn gains(&mut self, look: &DrawnInstant, window: &Window) -> Vec<[f64; 3]> {
        let model = self.system.model();
        let mut found = vec![[0.0; 3]; model.reduced.len()];
        let mut states = vec![ObjectState::default(); model.objects.len()];
        let last = window.times.len() - 1;
        for (k, (&time, y)) in window.times.iter().zip(&window.states).enumerate() {
            (self.system).observe(time, y, &look.modes, &mut self.scratch, &mut states);
            for (reduced, found) in model.reduced.iter().zip(&mut found) {
                let state = &states[reduced.object];
                match k {
                    0 => found[0] -= state.displacement,
                    k if k == last => found[0] += state.displacement,
                    k => found[1] += WEIGHTS[k - 1] * state.speed,
                }
                found[2] = found[2].max(state.displacement.abs());
            }
        }
        found
    }
}
