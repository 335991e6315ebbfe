//! What a signal may still do within a phase, from the sizes of its lanes alone.

use super::{Scene, Track};
use crate::exact::lanes::WIDTH;

/// A lane with less than this share of what a signal may come to does not tell how fast
/// it changes.
const SHARE: f64 = 1e-9;

/// What a signal does at most over some time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ahead {
    /// Its greatest magnitude.
    pub(crate) most: f64,
    /// Greatest rate |λ| of what matters in it (rad/s).
    pub(crate) rate: f64,
}

impl Ahead {
    /// Nothing.
    pub(crate) const NOTHING: Self = Self {
        most: 0.0,
        rate: 0.0,
    };

    /// Nothing is known of it.
    pub(crate) const UNKNOWN: Self = Self {
        most: f64::INFINITY,
        rate: f64::INFINITY,
    };
}

impl Track {
    /// What functional f of its panel does at most between two local times of the phase
    /// that was taken up last.
    pub(crate) fn ahead(&self, scene: Scene, f: usize, [from, to]: [f64; 2]) -> Ahead {
        let Scene { basis, panel, .. } = scene;
        let size = |k: usize| {
            let (b, i) = (k / WIDTH, k % WIDTH);
            let decay = (basis.re[b].0[i] * from).exp();
            panel.size(f, k) * self.state.size[b].0[i] * decay
        };
        let lanes = 0..basis.lanes.len();
        let most = self.state.range(f, from, to) + lanes.clone().map(size).sum::<f64>();
        let matters = |k: &usize| size(*k) > SHARE * most;
        let fastest = lanes.rev().find(matters);
        Ahead {
            most,
            rate: fastest.map_or(0.0, |k| basis.modulus[k]),
        }
    }
}
