//! Whether a motion is an object's own, or imposed by what drives it.

use super::mean;
use crate::dynamics::model::{Model, NodeIndex, NodeMotion};
use crate::dynamics::record::{Quantity, Record};
use std::ops::Range;

/// More than this share of the way is the object's own, not that of its law.
const OWN: f64 = 0.5;

/// A driver rests where it is slower than this share of its greatest speed.
const RESTS: f64 = 0.05;

/// A stretch of this share of the samples is the whole run.
const WHOLE: f64 = 0.95;

/// The samples of a model's nodes.
pub(super) struct Columns<'r> {
    pub(super) model: &'r Model,
    pub(super) record: &'r Record,
}

impl<'r> Columns<'r> {
    /// The samples of a node that is the last mass of an object.
    pub(super) fn of(&self, node: NodeIndex, quantity: Quantity) -> Option<&'r [f64]> {
        let mut objects = self.model.objects.iter();
        let part = objects.find(|part| part.nodes.last() == Some(&node))?;
        Some(self.record.column(&part.id, quantity)?.values.as_slice())
    }

    /// True where the way of a node over a stretch is its own.
    pub(super) fn is_own(&self, node: NodeIndex, stretch: &Range<usize>) -> bool {
        match &self.model.nodes[node].motion {
            NodeMotion::Rotor { .. } => true,
            NodeMotion::Prescribed { .. } => false,
            NodeMotion::Mass { law } => {
                self.deviates(node, stretch) || self.rests_behind(law.driver, stretch)
            }
            NodeMotion::Rigid { law } => self.rests_behind(law.driver, stretch),
            NodeMotion::Constrained { drivers, .. } => drivers
                .iter()
                .any(|&driver| self.rests_behind(driver, stretch)),
        }
    }

    /// True where a driver moves by itself as slowly as what it drives creeps.
    fn rests_behind(&self, driver: NodeIndex, stretch: &Range<usize>) -> bool {
        let rests = self.of(driver, Quantity::Speed).is_none_or(|speeds| {
            let greatest = speeds.iter().fold(0.0f64, |a, b| a.max(b.abs()));
            stretch.len() as f64 >= WHOLE * speeds.len() as f64
                || mean(&speeds[stretch.clone()]) <= RESTS * greatest
        });
        rests && self.is_own(driver, stretch)
    }

    /// True where a mass moves against its law rather than with it.
    fn deviates(&self, node: NodeIndex, stretch: &Range<usize>) -> bool {
        let columns = [Quantity::Displacement, Quantity::Delta].map(|own| self.of(node, own));
        let [Some(displacement), Some(delta)] = columns else {
            return false;
        };
        let [mut whole, mut of_law] = [0.0, 0.0];
        for k in stretch.start + 1..stretch.end {
            let [moved, deviated] = [displacement, delta].map(|own| own[k] - own[k - 1]);
            whole += moved.abs();
            of_law += (moved - deviated).abs();
        }
        of_law <= OWN * whole
    }
}
