//! Dry friction in the check of a run: it opposes what slides, holds what rests, and holds no
//! more than its limit.

use super::judge::Judge;
use super::sampler::DrawnInstant;
use crate::dynamics::integrate::Dynamics;
use crate::dynamics::model::NodeMotion;
use crate::dynamics::system::StickSlip;

/// Puts the dry contacts at a drawn instant to the test. (That their forces leave the
/// equations of motion balanced is looked at with these.)
pub(super) fn judge(judge: &mut Judge<'_>, look: &DrawnInstant) {
    let contacts = judge.mechanics.dry_contacts();
    let window = &look.windows[0];
    let middle = window.times.len() / 2;
    let (time, y) = (window.times[middle], &window.states[middle]);
    if contacts.is_empty() {
        return;
    }
    judge.mechanics.take_state(time, y, &look.modes.0);
    for (load, friction, component) in contacts {
        let node = judge.system.model().loads[load].node;
        let speed = judge.mechanics.nodes[node].motion[1];
        let greatest = speed_resolved(judge, node);
        let bound = judge.bound();
        let name = (time, judge.names[node].as_str());
        let state = component.map(|component| StickSlip::of(look.modes.0[component]));
        let back = match state {
            Some(StickSlip::Stuck) => speed.abs(),
            Some(StickSlip::Forward) => (-speed).max(0.0),
            Some(StickSlip::Backward) => speed.max(0.0),
            Some(StickSlip::Unset) => f64::NAN,
            None => continue,
        };
        // (What has no state yet is no number, and is kept as a defect.)
        if greatest > 0.0 || back != 0.0 {
            let what = "direction of dry friction";
            (judge.found).include(back / greatest, bound, name, what);
        }
        if state == Some(StickSlip::Stuck) {
            let [force, engaged] = judge.mechanics.held_force(load);
            let beyond = force.abs() / friction.static_limit - engaged;
            (judge.found).include(beyond.max(0.0), bound, name, "limit of dry friction");
        }
    }
}

/// What a sliding speed is measured by: the greatest one of its node, of what this is the sum
/// of, and what a run resolves of it.
fn speed_resolved(judge: &Judge<'_>, node: usize) -> f64 {
    let model = judge.system.model();
    let drivers = match &model.nodes[node].motion {
        NodeMotion::Constrained { drivers, .. } => drivers.clone(),
        NodeMotion::Prescribed { .. }
        | NodeMotion::Rotor { .. }
        | NodeMotion::Mass { .. }
        | NodeMotion::Rigid { .. } => Vec::new(),
    };
    let scales = judge.system.scales();
    let own = |node: usize| {
        let resolved = judge.mechanics.coordinate[node]
            .map_or(0.0, |own| scales[judge.system.coordinates() + own]);
        judge.scales.motion[node][1].max(resolved)
    };
    drivers
        .into_iter()
        .chain([node])
        .map(own)
        .fold(0.0, f64::max)
}
