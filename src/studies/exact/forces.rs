//! Forces of the trees' first links over a stretch, found once for all that asks.
//!
//! Every prescribed object on the way from a tree to its drives asks for the tree's force,
//! in both directions, and the end of a stretch is mostly the start of the next.

use crate::exact::event_loop::Branch;
use crate::exact::{Ahead, End};

/// Number of no phase.
const NONE: u64 = u64::MAX;

/// Forces of all trees, with bounds over a stretch.
pub(super) struct Forces {
    /// Start and end of the stretch (s).
    pub(super) span: [f64; 2],
    /// Bounds over the stretch, one a tree.
    pub(super) ahead: Vec<Ahead>,
    /// Forces at both ends of the stretch, as far as somebody asked for them.
    ends: [InstantForces; 2],
    /// Evaluations of forces and of bounds so far.
    #[cfg(test)]
    pub(super) evaluations: [u64; 2],
}

/// Forces at an instant.
struct InstantForces {
    /// The instant (s).
    time: f64,
    /// The phase of each tree in which its force was found, or [`NONE`], and the force.
    forces: Vec<(u64, End)>,
}

impl InstantForces {
    /// Goes to an instant; what is known of another one is forgotten.
    fn set_time(&mut self, time: f64) {
        if self.time != time {
            self.time = time;
            self.forces.fill((NONE, End::default()));
        }
    }
}

impl Forces {
    /// Forces of so many trees, before the first stretch.
    pub(super) fn new(trees: usize) -> Self {
        let known = || InstantForces {
            time: f64::NAN,
            forces: vec![(NONE, End::default()); trees],
        };
        Self {
            span: [0.0; 2],
            ahead: vec![Ahead::default(); trees],
            ends: [known(), known()],
            #[cfg(test)]
            evaluations: [0; 2],
        }
    }

    /// Takes up a stretch.
    pub(super) fn add_stretch(&mut self, branches: &[Branch<'_>], span: [f64; 2]) {
        self.span = span;
        if self.ends[1].time == span[0] {
            self.ends.swap(0, 1);
        }
        for (end, time) in self.ends.iter_mut().zip(span) {
            end.set_time(time);
        }
        for (ahead, branch) in self.ahead.iter_mut().zip(branches) {
            *ahead = branch.force_ahead(span);
        }
        #[cfg(test)]
        {
            self.evaluations[1] += branches.len() as u64;
        }
    }

    /// Force of a tree, with its slope, at an instant of the stretch.
    pub(super) fn at(&mut self, tree: usize, branch: &mut Branch<'_>, time: f64) -> End {
        let phase = branch.cursor.counts().0;
        let end = self.ends.iter_mut().find(|end| end.time == time);
        let known = end.map(|end| &mut end.forces[tree]);
        if let Some((_, force)) = known.as_ref().filter(|known| known.0 == phase) {
            return *force;
        }
        #[cfg(test)]
        {
            self.evaluations[0] += 1;
        }
        let force = branch.force(time);
        if let Some(known) = known {
            *known = (phase, force);
        }
        force
    }

    /// Bounds of the force of a tree over a part of the stretch.
    pub(super) fn force_bounds(&mut self, branch: &Branch<'_>, part: [f64; 2]) -> Ahead {
        #[cfg(test)]
        {
            self.evaluations[1] += 1;
        }
        branch.force_ahead(part)
    }
}
