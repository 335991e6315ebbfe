//! Objects that are reduced to modes, as they are read off.

use super::frozen::{Frozen, PrescribedNode, Step, segment};
use super::passes::Work;
use super::{ObjectState, System};
use crate::dynamics::model::{ModalReduction, Model};

/// Place of an object that is reduced to modes in the frozen layout.
#[derive(Clone, Debug)]
pub(super) struct Modal {
    /// For each mode its chain, its coordinate and its share of the output.
    modes: Vec<(usize, usize, f64)>,
    /// Node of the output, of a chain of which it is the sum.
    output: Option<usize>,
    /// See [`ModalReduction`].
    under_acceleration: f64,
    offset: f64,
    /// The drive and the laws from it to the driven end, where that moves by a prescribed
    /// law: its jerk moves the output too.
    course: Option<(PrescribedNode, Vec<usize>)>,
}

impl Modal {
    pub(super) fn of(frozen: &Frozen, model: &Model, reduced: &ModalReduction) -> Self {
        let place = |&(node, share): &(usize, f64)| {
            let node = frozen.internal[node];
            let chain = frozen
                .chains
                .iter()
                .position(|one| one.nodes().contains(&node));
            Some((chain?, frozen.coordinate[node]?, share))
        };
        let still = reduced.under_acceleration != 0.0;
        let end = model.objects[reduced.object].driven_end;
        let end = end.filter(|_| still).map(|node| frozen.internal[node]);
        Self {
            modes: reduced.modes.iter().filter_map(place).collect(),
            output: reduced.output.map(|node| frozen.internal[node]),
            under_acceleration: reduced.under_acceleration,
            offset: reduced.offset,
            course: end.and_then(|node| drive_and_laws(frozen, node)),
        }
    }
}

/// The drive that prescribes a node's motion, and the laws on the way to the node.
fn drive_and_laws(frozen: &Frozen, mut node: usize) -> Option<(PrescribedNode, Vec<usize>)> {
    let mut laws = Vec::new();
    loop {
        let drive = frozen.steps.iter().find_map(|step| match step {
            Step::Prescribed(drive) if drive.node == node => Some(drive.clone()),
            _ => None,
        });
        if let Some(drive) = drive {
            laws.reverse();
            return Some((drive, laws));
        }
        let rigid = frozen.rigids.iter().find(|rigid| rigid.node == node)?;
        laws.push(rigid.law);
        node = frozen.laws[rigid.law].driver;
    }
}

impl System {
    /// True when an object has a deviation δ from its law.
    pub(crate) fn deviates(&self, object: usize) -> bool {
        self.places[object].modal.is_some()
            || (self.last_coordinate(object).is_some()
                && !self.is_rotor(object)
                && !self.model.objects[object].is_drive()
                && self.stop_of(object).is_none())
    }

    /// Coordinate (in y) that is the deviation δ of an object; `None`: it has none, or one that
    /// is a sum.
    pub(crate) fn deviation(&self, object: usize) -> Option<usize> {
        let sum = self.places[object].modal.is_some();
        let own = self.last_coordinate(object).filter(|_| !sum);
        own.filter(|_| self.deviates(object))
    }

    /// Motion of the output of a chain to which an object is reduced.
    pub(super) fn observe_sum(
        &self,
        modal: &Modal,
        y: &[f64],
        work: &Work<f64>,
        out: &mut ObjectState,
    ) {
        let Some(output) = modal.output else {
            return;
        };
        out.displacement = work.displacement[output];
        out.speed = work.speed[output];
        out.acceleration = work.acceleration[output];
        let (u, v) = y.split_at(self.frozen.coordinates);
        [out.delta, out.delta_speed] = [u, v].map(|of| {
            let shares = modal.modes.iter();
            shares
                .map(|&(_, coordinate, share)| share * of[coordinate])
                .sum()
        });
    }

    /// Completes the state of an object that is reduced to modes, of which the sum of its
    /// modes' motions is known. `end`: node of its driven end.
    pub(super) fn observe_modal(
        &self,
        modal: &Modal,
        end: usize,
        (time, y): (f64, &[f64]),
        modes: &[i64],
        work: &Work<f64>,
        out: &mut ObjectState,
    ) {
        let (u, v) = y.split_at(self.frozen.coordinates);
        let mut deviation = [modal.offset, 0.0];
        if let Some((drive, laws)) = &modal.course {
            let jerk = self.frozen.jerk(drive, laws, time, modes, work);
            deviation[0] -= modal.under_acceleration * work.acceleration[end];
            deviation[1] -= modal.under_acceleration * jerk;
        }
        out.displacement += deviation[0];
        out.speed += deviation[1];
        out.reaction = 0.0;
        for &(chain, coordinate, share) in &modal.modes {
            deviation[0] += share * u[coordinate];
            deviation[1] += share * v[coordinate];
            out.reaction += work.reaction[chain];
        }
        [out.delta, out.delta_speed] = deviation;
    }
}

impl Frozen {
    /// The third derivative of a prescribed motion behind laws.
    fn jerk(
        &self,
        drive: &PrescribedNode,
        laws: &[usize],
        time: f64,
        modes: &[i64],
        work: &Work<f64>,
    ) -> f64 {
        let jet = drive.motion.jet(segment(modes, drive.component), time);
        let [mut speed, mut acceleration, mut jerk] = [jet.first, jet.second, jet.third];
        for &law in laws {
            let law = &self.laws[law];
            let u = law.jet(modes, work.displacement[law.driver]);
            jerk = u.first * jerk
                + 3.0 * u.second * speed * acceleration
                + u.third * speed * speed * speed;
            acceleration = u.first * acceleration + u.second * speed * speed;
            speed *= u.first;
        }
        jerk
    }
}
