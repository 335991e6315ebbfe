//! What trees carry, looked at as parts of the whole system.
//!
//! These are rigid objects that a mass of a tree carries, the sums of modes, and the forces on
//! driven ends.

use crate::dynamics::integrate::Modes;
use crate::dynamics::record::{Log, SampledStretch, Tally};
use crate::dynamics::system::ObjectState;
use crate::exact::event_loop::{Motion, Schedule};

/// What is looked at in a tree: rigid objects that its masses carry, sums of modes, and
/// elastic objects with inertia at their driven end, for the force there; what presses on a
/// cam, for the pressure.
pub(super) fn sampled_in_tree(
    route: Schedule<'_>,
    window: Option<[f64; 2]>,
) -> Vec<(usize, usize, Tally)> {
    let Schedule { system, parts, .. } = route;
    let objects = 0..system.model().objects.len();
    let own = |object: usize| {
        let part = &system.model().objects[object];
        // What presses on its cam may be rigid, with trees behind it.
        let pressing = part.pressing.is_some();
        let behind = pressing && !parts.trees.is_empty();
        let tree = parts.tree_of(object).or(behind.then_some(0))?;
        let elastic = parts.trees[tree].objects.contains(&object);
        (!elastic || part.driven_end.is_some() || pressing)
            .then(|| (tree, object, Tally::new(system, object, window)))
    };
    objects.filter_map(own).collect()
}

/// The whole system observed over parts of a stretch.
pub(super) struct CarriedObserver<'l, 'm, 'a, 's> {
    pub(super) log: &'l mut Log<'s>,
    pub(super) y: &'l mut [f64],
    pub(super) seen: &'l mut [ObjectState],
    pub(super) motion: &'l mut Motion<'m, 'a>,
    pub(super) modes: &'l Modes,
}

impl CarriedObserver<'_, '_, '_, '_> {
    fn at(&mut self, time: f64) -> &[ObjectState] {
        self.motion.state(time, self.y);
        self.log.observe(time, self.y, self.modes)
    }

    /// Observes a part and hands it on.
    pub(super) fn observe_part(
        &mut self,
        part: [f64; 2],
        take: impl FnOnce(&mut SampledStretch<'_>),
    ) {
        let mut seen = std::mem::take(&mut self.seen);
        let objects = seen.len() / 7;
        for (place, time) in SampledStretch::instants(part).into_iter().enumerate() {
            let states = self.at(time);
            seen[place * objects..][..objects].copy_from_slice(states);
        }
        let mut look = |time, object: usize| self.at(time)[object];
        take(&mut SampledStretch::new(part, seen, &mut look));
        self.seen = std::mem::take(&mut seen);
    }
}
