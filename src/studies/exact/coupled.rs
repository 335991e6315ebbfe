//! Forces on what a drive prescribes and trees hang on.
//!
//! The force that such an object needs is that of all that is beside the trees, A(t),
//! and for each tree a lever G(t), the slopes of the position functions on the way, times
//! the force F of the tree's first link. A and G change slowly: over a short stretch they
//! are polynomials, or it is halved until they are. F is a sum of modes, of which value, slope and what a cubic misses
//! are known. Most often |A| + Σ|G|·|F| tells that nothing in the stretch can be greater
//! than what has been met. Where it could, A + ΣG·F is climbed to as the figures of a
//! tree are: cut at the summits of its cubics until nothing is left above.
//!
//! At the maximum the whole system is observed.

use super::forces::Forces;
use super::lever::Drivetrain;
use super::smooth::{NODES, Smooth};
use super::turn::Turn;
use crate::dynamics::record::Tally;
use crate::dynamics::system::{ObjectState, System};
use crate::exact::event_loop::Branch;
use crate::exact::{Ahead, End, Piece};

/// Cuts of one stretch for one extreme; what is left is then believed.
const CUTS: usize = 256;

/// Differences below this share of the greatest value so far are not looked for.
const MARGIN: f64 = 1e-11;

/// Share of the greatest force up to which A + ΣG·F has to be followed by its polynomials.
const FOLLOWED: f64 = 1e-9;

/// An object that trees hang on.
#[derive(Clone, Debug)]
pub(super) struct TreeBase {
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
    /// Bounds of |G| in every part of a turn, where they are known.
    caps: Option<Turn>,
}

/// What a cubic between the ends of a stretch may miss of A + ΣG·F.
#[derive(Clone, Copy, Debug, Default)]
struct Loss {
    /// On the middle coefficient of a quartic: it goes with the fourth power of the length.
    middle: f64,
    /// On all coefficients, in a part at most as much as in the whole.
    flat: f64,
}

impl Loss {
    /// That of A alone, over a share of the stretch.
    fn of_smooth_part(own: &Smooth, share: f64) -> Self {
        Self {
            middle: own.greatest_fourth_derivative() * share.powi(4) / 144.0,
            flat: 0.0,
        }
    }

    /// That over a part of this share of what it is the loss over.
    fn over_share(self, share: f64) -> Self {
        Self {
            middle: self.middle * share.powi(4),
            flat: self.flat,
        }
    }

    /// Adds G·F over a share of the stretch, of whose force the bounds there are known.
    ///
    /// With |G⁽ᵏ⁾| ≤ rᵏ·|G|, the fourth derivative is at most the sum of F's lanes times
    /// (|λ| + r)⁴·|G|, and that is 8 times the sum of either fourth power. A lane that
    /// cannot be followed is off by no more than its values and slopes at the ends.
    fn add(&mut self, lever: &Smooth, ahead: &Ahead, share: f64) {
        let (most, slow) = (lever.magnitude_bound(), lever.rate4() * share.powi(4));
        if most > 0.0 {
            self.middle += 8.0 * most * (ahead.middle + slow / 144.0 * ahead.most);
            self.flat += most * ahead.flat * (1.0 + slow.sqrt().sqrt() / 8.0);
        }
    }
}

impl TreeBase {
    /// Every object that some tree hangs on.
    pub(super) fn coupled_objects(
        system: &System,
        ways: &[Drivetrain],
        window: Option<[f64; 2]>,
    ) -> Vec<Self> {
        let parts = system.model().objects.iter().enumerate();
        let carries = |object: usize| ways.iter().any(|way| way.depends_on(object));
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
        self.levers.iter().map(Smooth::magnitude_bound)
    }

    /// Sets the bounds of |G| of every tree in a turn.
    pub(super) fn set_bounds(&mut self, caps: Turn) {
        self.caps = Some(caps);
    }

    /// True when, with what |G| never passes and an A that is always the same, it may meet
    /// what it has not met before; so it may where these are not known.
    pub(super) fn may_rise(&self, steady: Option<f64>, forces: &Forces) -> bool {
        let (Some(own), Some(caps)) = (steady, &self.caps) else {
            return true;
        };
        let forces_ahead = forces.ahead.iter().map(|force| force.most);
        self.rises(own.abs() + caps.greatest(forces.span, forces_ahead))
    }

    /// Takes what is beside the trees at the nodes of a stretch: the states of all
    /// objects, and by tree and node the slopes of the tree's way.
    pub(super) fn add_states(
        &mut self,
        states: &[Vec<ObjectState>; NODES],
        ways: &[Drivetrain],
        slopes: &[[Vec<f64>; NODES]],
    ) {
        let own = std::array::from_fn(|k| states[k][self.object].reaction);
        self.own = Smooth::new(own);
        let ways = ways.iter().zip(slopes);
        for (lever, (way, slopes)) in self.levers.iter_mut().zip(ways) {
            let slope = |k: usize| self.sign * way.slope(self.object, &slopes[k]);
            *lever = Smooth::new(std::array::from_fn(slope));
        }
    }

    /// True when it may meet what it has not met before in the stretch taken up last.
    pub(super) fn rises_within(&self, forces: &Forces) -> bool {
        self.rises(self.bounds(&forces.ahead))
    }

    /// True where A and every G are followed by their polynomials at a share of a stretch,
    /// of which the states of all objects and, by tree, the slopes of its way are known.
    pub(super) fn follows(
        &self,
        share: f64,
        states: &[ObjectState],
        (ways, slopes): (&[Drivetrain], &[Vec<f64>]),
        forces: &Forces,
    ) -> bool {
        let bounds = self.bounds(&forces.ahead);
        if !self.rises(bounds) {
            return true;
        }
        let mut missed = (states[self.object].reaction - self.own.at(share)[0]).abs();
        let ways = ways.iter().zip(slopes).zip(&self.levers);
        for (((way, slopes), lever), force) in ways.zip(&forces.ahead) {
            if force.most > 0.0 {
                let slope = self.sign * way.slope(self.object, slopes);
                missed += (slope - lever.at(share)[0]).abs() * force.most;
            }
        }
        // (What is no number is not looked at more closely.)
        !(missed > FOLLOWED * bounds)
    }

    /// True when a force of this magnitude would be greater than what was met.
    fn rises(&self, most: f64) -> bool {
        let (reaction, slack) = self.tally.force_thresholds();
        !(most <= reaction * (1.0 + MARGIN) && most <= slack)
    }

    /// Instants at which it meets what it has not met before, in a stretch whose nodes
    /// were taken up.
    pub(super) fn refine_force_extrema(
        &self,
        branches: &mut [Branch<'_>],
        forces: &mut Forces,
        mut found: impl FnMut(f64),
    ) {
        let bounds = self.bounds(&forces.ahead);
        if !self.rises(bounds) {
            return;
        }
        let loss = self.loss_over_stretch(forces);
        for (sign, level) in self.tally.force_extrema_sought() {
            let margin = MARGIN * level.abs();
            if bounds > level + margin
                && let Some(time) =
                    self.greatest_place(branches, forces, &loss, (sign, level, margin))
            {
                found(time);
            }
        }
    }

    fn bounds(&self, ahead: &[Ahead]) -> f64 {
        let levers = self.levers.iter().zip(ahead);
        let coupled = levers.filter(|(_, force)| force.most > 0.0);
        let coupled: f64 = coupled
            .map(|(lever, force)| lever.magnitude_bound() * force.most)
            .sum();
        self.own.magnitude_bound() + coupled
    }

    /// Where sign·(A + ΣG·F) is greatest, if that is above a level by more than a margin.
    fn greatest_place(
        &self,
        branches: &mut [Branch<'_>],
        forces: &mut Forces,
        whole: &Loss,
        (sign, level, margin): (f64, f64, f64),
    ) -> Option<f64> {
        let (mut best, mut place) = (level, None);
        let mut see = |end: &End| {
            if end.f > best {
                (best, place) = (end.f, Some(end.s));
            }
            best
        };
        let [a, b] = forces
            .span
            .map(|time| self.at(branches, forces, time, sign));
        see(&a);
        let mut best_now = see(&b);
        let mut pieces = vec![(Piece { a, b }, *whole)];
        let mut cuts = 0;
        while let Some((piece, loss)) = pieces.pop() {
            let goal = best_now + margin;
            if cuts >= CUTS {
                break;
            }
            let Some(loss) = self.passing(branches, forces, (&piece, &loss), goal) else {
                continue;
            };
            cuts += 1;
            let time = piece.a.s + piece.extremum_place() * piece.length();
            if time <= piece.a.s || time >= piece.b.s {
                continue;
            }
            let cut = self.at(branches, forces, time, sign);
            best_now = see(&cut);
            for part in [Piece { a: cut, b: piece.b }, Piece { a: piece.a, b: cut }] {
                let loss = loss.over_share(part.length() / piece.length());
                pieces.push((part, loss));
            }
        }
        place
    }

    /// sign·(A + ΣG·F) and its slope at an instant of a stretch.
    fn at(&self, branches: &mut [Branch<'_>], forces: &mut Forces, time: f64, sign: f64) -> End {
        let length = forces.span[1] - forces.span[0];
        let share = (time - forces.span[0]) / length;
        let [mut value, mut slope] = self.own.at(share);
        slope /= length;
        for (tree, (lever, branch)) in self.levers.iter().zip(branches).enumerate() {
            if lever.magnitude_bound() == 0.0 {
                continue;
            }
            let [g, rate] = lever.at(share);
            let force = forces.at(tree, branch, time);
            value += g * force.f;
            slope += g * force.g + rate / length * force.f;
        }
        End {
            s: time,
            f: sign * value,
            g: sign * slope,
        }
    }

    /// The loss over a piece that may pass a goal: what is known to be missed in it and, where
    /// that does not tell, what is missed in it alone. `None`: it cannot pass.
    fn passing(
        &self,
        branches: &[Branch<'_>],
        forces: &mut Forces,
        (piece, known): (&Piece, &Loss),
        goal: f64,
    ) -> Option<Loss> {
        let passes = |loss: &Loss| piece.range(loss.middle, loss.flat).1 > goal;
        let [from, to] = forces.span;
        let share = piece.length() / (to - from);
        if !passes(known) {
            return None;
        }
        if known.flat == 0.0 || share == 1.0 {
            return Some(*known);
        }
        let mut own = Loss::of_smooth_part(&self.own, share);
        for (lever, branch) in self.levers.iter().zip(branches) {
            if lever.magnitude_bound() > 0.0 {
                let ahead = forces.force_bounds(branch, [piece.a.s, piece.b.s]);
                own.add(lever, &ahead, share);
            }
        }
        passes(&own).then_some(own)
    }

    /// The loss over the whole stretch.
    fn loss_over_stretch(&self, forces: &Forces) -> Loss {
        let mut loss = Loss::of_smooth_part(&self.own, 1.0);
        for (lever, ahead) in self.levers.iter().zip(&forces.ahead) {
            loss.add(lever, ahead, 1.0);
        }
        loss
    }
}
