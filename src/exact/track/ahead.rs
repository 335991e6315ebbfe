//! What a signal may still do within a phase, from the sizes of its lanes alone.

use super::{Scene, Track};
use crate::exact::hermite::End;
use crate::exact::lanes::{Arith, WIDTH};
use crate::exact::phase::Exponentials;

/// A lane with less than this share of what a signal may come to does not tell how fast
/// it changes.
const SHARE: f64 = 1e-9;

/// A lane with less than this share of it is rounding.
const LANE_ROUNDING: f64 = 1e-15;

/// Bounds of a signal over some time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Ahead {
    /// Greatest magnitude of the signal.
    pub(crate) most: f64,
    /// Greatest rate |λ| of what matters in it (rad/s).
    pub(crate) rate: f64,
    /// What Hermite's cubic between the ends may miss, on the middle coefficient of a
    /// quartic that bounds it and on all.
    pub(crate) middle: f64,
    pub(crate) flat: f64,
}

impl Ahead {
    /// Nothing is known of it.
    pub(crate) const UNKNOWN: Self = Self {
        most: f64::INFINITY,
        rate: f64::INFINITY,
        middle: f64::INFINITY,
        flat: f64::INFINITY,
    };
}

impl Track {
    /// Bounds of functional f of its panel between two local times of the phase that was
    /// taken up last.
    pub(crate) fn ahead(&self, scene: Scene, f: usize, [from, to]: [f64; 2]) -> Ahead {
        let Scene { basis, panel, .. } = scene;
        let (h, slow) = (to - from, self.state.range(f, from, to));
        let mut ahead = Ahead {
            most: slow,
            middle: self.state.slow4.0[f] * (h * h * h * h) / 144.0,
            ..Ahead::default()
        };
        for k in 0..basis.lanes.len() {
            let (b, i) = (k / WIDTH, k % WIDTH);
            let size = panel.size(f, k) * self.state.size[b].0[i];
            if size < LANE_ROUNDING * slow {
                continue;
            }
            let size = size * (basis.re[b].0[i] * from).exp();
            ahead.most += size;
            if size < LANE_ROUNDING * ahead.most {
                continue;
            }
            let x = basis.modulus[k] * h;
            let (bent, level) = (x * x * x * x / 144.0, 2.0 + 0.25 * x);
            if bent < level {
                ahead.middle += size * bent;
            } else {
                ahead.flat += size * level;
            }
            // (Lanes come with rising rates.)
            if size > SHARE * slow {
                ahead.rate = basis.modulus[k];
            }
        }
        ahead
    }

    /// Value and slope of functional f of its panel at the instant of `e`, in the phase
    /// that was taken up last.
    #[inline(always)]
    pub(crate) fn value_at<A: Arith>(&mut self, scene: Scene, f: usize, e: &Exponentials) -> End {
        let Scene { panel, phase, .. } = scene;
        self.state.amplitudes::<A>(phase, e, &mut self.look);
        let lanes = (&self.look, phase.active);
        let ([value, slope, ..], _) = self.state.jet::<A>(panel, lanes, e, f);
        End {
            s: e.s,
            f: value,
            g: slope,
        }
    }
}
