//! What a signal may still do within a phase, from the sizes of its lanes alone.

use super::{Scene, Track};
use crate::exact::hermite::End;
use crate::exact::lanes::{Arith, V, WIDTH, exp};
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
    #[inline(always)]
    pub(crate) fn ahead<A: Arith>(&self, scene: Scene, f: usize, [from, to]: [f64; 2]) -> Ahead {
        let Scene { basis, panel, .. } = scene;
        let (h, slow) = (to - from, self.state.range(f, from, to));
        let mut ahead = Ahead {
            most: slow,
            middle: self.state.slow4.0[f] * (h * h * h * h) / 144.0,
            ..Ahead::default()
        };
        for (b, moduli) in basis.modulus.chunks(WIDTH).enumerate() {
            let faded = self.state.size[b] * exp::<A>(basis.re[b] * V::splat(from));
            for (i, &modulus) in moduli.iter().enumerate() {
                let size = panel.lane_weight(f, b * WIDTH + i) * faded.0[i];
                ahead.most += size;
                if size < LANE_ROUNDING * ahead.most {
                    continue;
                }
                let x = modulus * h;
                let (bent, level) = (x * x * x * x / 144.0, 2.0 + 0.25 * x);
                if bent < level {
                    ahead.middle += size * bent;
                } else {
                    ahead.flat += size * level;
                }
                // (Lanes come with rising rates.)
                if size > SHARE * slow {
                    ahead.rate = modulus;
                }
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
