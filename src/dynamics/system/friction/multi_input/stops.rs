//! Named ends of runs whose motion the friction of a linkage of several inputs does not allow or
//! does not determine.

use super::super::Obstacle;
use super::super::stops::LOCKED;
use super::Several;
use crate::dynamics::integrate::PhysicalStop;
use crate::dynamics::system::System;
use crate::dynamics::system::passes::{Extent, Work};
use crate::units::shown;

impl System {
    fn id_of(&self, several: &Several) -> String {
        self.model.objects[several.object].id.clone()
    }

    /// The end of a run where the motion has no solution, or several.
    pub(super) fn multi_input_unsolved(
        &self,
        several: &Several,
        time: f64,
        y: &[f64],
        modes: &[i64],
    ) -> PhysicalStop {
        let mut work = Work::new(&self.frozen);
        let mut out = vec![0.0; self.frozen.coordinates];
        let extent = Extent::Full;
        self.frozen
            .evaluate(time, y, modes, extent, &mut work, &mut out);
        let own = work.several.as_deref_mut();
        let failure = own.and_then(|own| several.unsolved(own));
        self.stop_of_friction(self.id_of(several), false, failure.unwrap_or(LOCKED))
    }

    /// The end of a run where pairs at rest may go on in no way, or in several.
    pub(super) fn ambiguous_continuation(
        &self,
        several: &Several,
        time: f64,
        ways: usize,
    ) -> PhysicalStop {
        let object = self.id_of(several);
        let at = shown(time, 9);
        let (name, message) = match ways {
            0 => (
                "self_locking",
                format!(
                    "{object} locks: a joint of it comes to rest at t = {at} s. Its friction \
                     cannot hold it, and no sliding agrees with the friction that it causes"
                ),
            ),
            _ => (
                "several_solutions",
                format!(
                    "a joint of {object} is at rest at t = {at} s, and {ways} motions agree with \
                     the friction of its joints: the motion is not determined"
                ),
            ),
        };
        PhysicalStop {
            name,
            object,
            message,
        }
    }

    /// The end of a run where too many pairs start at once.
    pub(super) fn too_many_at_rest(
        &self,
        several: &Several,
        time: f64,
        count: usize,
    ) -> PhysicalStop {
        let object = self.id_of(several);
        PhysicalStop {
            name: "several_solutions",
            message: format!(
                "{count} joints of {object} with friction are at rest at t = {} s and do not stay \
                 so: which of the many motions follows was not searched for",
                shown(time, 9)
            ),
            object,
        }
    }

    /// Why the last evaluation gave no numbers, where friction of this linkage is the reason.
    pub(in crate::dynamics::system::friction) fn multi_input_obstacle(
        &self,
        work: &Work<f64>,
    ) -> Option<PhysicalStop> {
        let (several, own) = (self.frozen.several.as_ref()?, work.several.as_ref()?);
        let failure = super::super::stops::named_obstacle(own.failure)?;
        Some(self.stop_of_friction(self.id_of(several), false, failure))
    }

    /// Stops for what `Obstacle` says.
    fn stop_of_friction(&self, object: String, given: bool, failure: Obstacle) -> PhysicalStop {
        super::super::stops::stop_for(object, given, failure)
    }
}
