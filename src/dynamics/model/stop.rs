//! One-sided stops against the ground: valve seats, end stops.

use super::{Closure, ContactLaw, Pair};

/// A one-sided stop of a node against the ground: a contact that presses where the node
/// passes a displacement, and never pulls. Its indentation is p = side·(φ − at), and it
/// pushes with −side·N. It is engaged while p > 0 and N > 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// Displacement at which it is touched (rad or m).
    pub at: f64,
    /// −1: it holds the node from going below `at`; +1: from going above.
    pub side: f64,
    /// k (N/m or N·m/rad), or K of a power of the indentation; 0 of a rigid one.
    pub stiffness: f64,
    /// Law of its contact.
    pub law: ContactLaw,
}

impl Stop {
    /// It as a pair of the deformation x = φ − at, with the damping of its link.
    pub fn pair(&self) -> (Pair, f64) {
        let (form, damping) = self.law.of_link(0.0);
        let pair = Pair {
            closure: Closure::Force,
            gap: 0.0,
            opens: -self.side,
            form,
        };
        (pair, damping)
    }
}

/// A stop of an object, which stands in the model as an inner part of it, `valve.seat`:
/// its displacement is that of the object's last mass, its contact force that of the stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StopPart {
    /// The object that it stops, index into [`objects`](super::Model::objects).
    pub object: usize,
    /// The stop itself, index into [`objects`](super::Model::objects).
    pub part: usize,
    /// Its load, a [`Stop`](super::LoadLaw::Stop), index into [`loads`](super::Model::loads).
    pub load: usize,
}
