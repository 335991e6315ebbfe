//! Forces on what a drive prescribes and trees hang on.
//!
//! The force that such an object needs is that of all that is beside the trees, A(t),
//! and for each tree a lever G(t), the slopes of the position functions on the way, times
//! the force F of the tree's first link. A and G change slowly: over a short stretch they
//! are polynomials. F is a sum of modes, of which value, slope and what a cubic misses
//! are known. Most often |A| + Σ|G|·|F| tells that nothing in the stretch can be greater
//! than what has been met. Where it could, A + ΣG·F is climbed to as the figures of a
//! tree are: cut at the summits of its cubics until nothing is left above.

use super::lever::Way;
use super::smooth::{NODES, Smooth};
use crate::dynamics::record::Tally;
use crate::dynamics::system::{ObjectState, System};
use crate::exact::walk::Branch;
use crate::exact::{Ahead, End, Piece};

/// Cuts of one stretch for one extreme; what is left is then believed.
const CUTS: usize = 256;

/// Differences below this share of the greatest value so far are not looked for.
const MARGIN: f64 = 1e-11;

/// How fast A and G change at most, in radians of a grid's stretch: that of the
/// fiftieth harmonic of what turns once in 64 stretches.
const RATE: f64 = 5.0;

/// An object that trees hang on.
#[derive(Clone, Debug)]
pub(super) struct Coupled {
    /// Index in the whole model.
    pub(super) object: usize,
    /// Figures of its forces.
    pub(super) tally: Tally,
    /// +1 where the force of a tree adds to its own, −1 of a drive.
    sign: f64,
    /// A.
    own: Smooth,
    /// G of each tree.
    levers: Vec<Smooth>,
    /// Bounds of |G| over the whole run, where they are known.
    caps: Option<Vec<f64>>,
}

/// Bounds of the forces of all trees over a stretch.
pub(super) struct Forces<'f> {
    pub(super) ahead: &'f [Ahead],
    pub(super) span: [f64; 2],
    /// Length of a stretch of the grid (s).
    pub(super) grid: f64,
}

impl Coupled {
    /// Every object that some tree hangs on.
    pub(super) fn all(system: &System, ways: &[Way], window: Option<[f64; 2]>) -> Vec<Self> {
        let parts = system.model().objects.iter().enumerate();
        let carries = |object: usize| ways.iter().any(|way| way.passes(object));
        parts
            .filter(|(object, _)| carries(*object))
            .map(|(object, part)| Self {
                object,
                tally: Tally::new(system, object, window),
                sign: if part.is_drive() { -1.0 } else { 1.0 },
                own: Smooth::default(),
                levers: vec![Smooth::default(); ways.len()],
                caps: None,
            })
            .collect()
    }

    /// Bounds of |G| of every tree in the stretch taken up last.
    pub(super) fn slopes(&self) -> impl Iterator<Item = f64> + '_ {
        self.levers.iter().map(Smooth::most)
    }

    /// Sets the bounds of |G| of every tree over the whole run.
    pub(super) fn cap(&mut self, caps: Vec<f64>) {
        self.caps = Some(caps);
    }

    /// True when, with what |G| never passes and an A that is always the same, it may meet
    /// what it has not met before; so it may where these are not known.
    pub(super) fn may_rise(&self, steady: Option<f64>, forces: &Forces<'_>) -> bool {
        let (Some(own), Some(caps)) = (steady, &self.caps) else {
            return true;
        };
        let coupled = caps.iter().zip(forces.ahead);
        let coupled: f64 = coupled.map(|(cap, force)| cap * force.most).sum();
        self.rises(own.abs() + coupled)
    }

    /// Takes what is beside the trees at the nodes of a stretch.
    pub(super) fn take(&mut self, states: &[Vec<ObjectState>; NODES], ways: &[Way]) {
        let at = |k: usize| &states[k][..];
        let own = std::array::from_fn(|k| at(k)[self.object].reaction);
        self.own = Smooth::new(own);
        for (lever, way) in self.levers.iter_mut().zip(ways) {
            let slope = |k: usize| self.sign * way.slope(self.object, at(k));
            *lever = Smooth::new(std::array::from_fn(slope));
        }
    }

    /// True when a force of this magnitude would be greater than what was met.
    fn rises(&self, most: f64) -> bool {
        let (reaction, slack) = self.tally.forces();
        !(most <= reaction * (1.0 + MARGIN) && most <= slack)
    }

    /// Instants at which it meets what it has not met before, in a stretch whose nodes
    /// were taken up.
    pub(super) fn climb(
        &self,
        branches: &mut [Branch<'_>],
        forces: &Forces<'_>,
        mut found: impl FnMut(f64),
    ) {
        let bounds = self.bounds(forces.ahead);
        if !self.rises(bounds) {
            return;
        }
        for (sign, level) in self.tally.goals() {
            let margin = MARGIN * level.abs();
            if bounds > level + margin
                && let Some(time) = self.summit(branches, forces, (sign, level, margin))
            {
                found(time);
            }
        }
    }

    fn bounds(&self, ahead: &[Ahead]) -> f64 {
        let levers = self.levers.iter().zip(ahead);
        let coupled = levers.filter(|(_, force)| force.most > 0.0);
        let coupled: f64 = coupled
            .map(|(lever, force)| lever.most() * force.most)
            .sum();
        self.own.most() + coupled
    }

    /// Where sign·(A + ΣG·F) is greatest, if that is above a level by more than a margin.
    fn summit(
        &self,
        branches: &mut [Branch<'_>],
        forces: &Forces<'_>,
        (sign, level, margin): (f64, f64, f64),
    ) -> Option<f64> {
        let [from, to] = forces.span;
        let (mut best, mut place) = (level, None);
        let mut see = |end: &End| {
            if end.f > best {
                (best, place) = (end.f, Some(end.s));
            }
            best
        };
        let [a, b] = [from, to].map(|time| self.at(branches, forces.span, time, sign));
        see(&a);
        let mut best_now = see(&b);
        let mut pieces = vec![Piece { a, b }];
        let mut cuts = 0;
        while let Some(piece) = pieces.pop() {
            let (middle, flat) = self.missed(branches, forces, &piece);
            let top = piece.range(middle, flat).1;
            if !(top > best_now + margin) || cuts >= CUTS {
                continue;
            }
            cuts += 1;
            let time = piece.a.s + piece.summit() * piece.length();
            if time <= piece.a.s || time >= piece.b.s {
                continue;
            }
            let cut = self.at(branches, forces.span, time, sign);
            best_now = see(&cut);
            pieces.push(Piece { a: cut, b: piece.b });
            pieces.push(Piece { a: piece.a, b: cut });
        }
        place
    }

    /// sign·(A + ΣG·F) and its slope at an instant of a stretch.
    fn at(&self, branches: &mut [Branch<'_>], span: [f64; 2], time: f64, sign: f64) -> End {
        let length = span[1] - span[0];
        let share = (time - span[0]) / length;
        let [mut value, mut slope] = self.own.at(share);
        slope /= length;
        for (lever, branch) in self.levers.iter().zip(branches) {
            if lever.most() == 0.0 {
                continue;
            }
            let [g, rate] = lever.at(share);
            let force = branch.force(time);
            value += g * force.f;
            slope += g * force.g + rate / length * force.f;
        }
        End {
            s: time,
            f: sign * value,
            g: sign * slope,
        }
    }

    /// What a cubic between the ends of a piece may miss: of a product of what changes
    /// slowly and a sum of modes, on the middle coefficient of a quartic and on all.
    fn missed(&self, branches: &[Branch<'_>], forces: &Forces<'_>, piece: &Piece) -> (f64, f64) {
        let slow = (RATE * piece.length() / forces.grid).powi(4) / 144.0;
        let (mut middle, mut flat) = (slow * self.own.most(), 0.0);
        for (lever, branch) in self.levers.iter().zip(branches) {
            let most = lever.most();
            if most > 0.0 {
                let ahead = branch.force_ahead([piece.a.s, piece.b.s]);
                // |(G·F)⁗| is at most the sum of |F|'s lanes times (|λ| + rate of G)⁴|G|,
                // and that is 8 times the sum of either fourth power.
                middle += 8.0 * most * (ahead.middle + slow * ahead.most);
                flat += most * ahead.flat;
            }
        }
        (middle, flat)
    }
}
