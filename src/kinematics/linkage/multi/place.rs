//! Where the links are: the inputs one after the other outwards, then group by group.

use super::plan::MultiPlan;
use crate::kinematics::linkage::assemble::angles_of;
use crate::kinematics::linkage::dyad::Dyad;
use crate::kinematics::linkage::elements::{Frame, inverse};
use crate::kinematics::linkage::examine::tolerance;
use crate::kinematics::linkage::newton::NewtonGroup;
use crate::kinematics::linkage::plan::Step;
use crate::kinematics::linkage::solve::surroundings_of_dyad;
use crate::kinematics::linkage::state::State;
use crate::kinematics::linkage::vector::nearest_turn;

/// Most that an input goes at once where couplings count turns: rad, or sizes of the linkage.
const MOST_TURNED: f64 = 0.5;
/// Parts into which the way to a far position may be cut.
const MOST_PARTS: f64 = 4096.0;

/// The inputs cannot be reached: the group (counted after the driver's) that cannot be
/// assembled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotAssembled {
    /// Index into the groups of the structure.
    pub group: usize,
}

/// Places what inputs alone place.
pub(super) fn outwards(plan: &MultiPlan, inputs: &[f64], state: &mut State) {
    for joint in &plan.tree {
        let relative = joint
            .driver
            .relative_frame::<1>(joint.coordinate_between_bodies(inputs));
        let relative = match joint.reversed {
            false => relative,
            true => inverse(&relative),
        };
        let frame = match joint.parent == plan.bodies {
            true => relative,
            false => {
                let parent = state.frame::<1>(Some(joint.parent));
                Frame {
                    at: parent.at + parent.direction.complex_product(relative.at),
                    direction: parent.direction.complex_product(relative.direction),
                }
            }
        };
        state.links[joint.body].set(&frame);
    }
}

/// Sets the frame of the link that an input moves inside a group.
pub(super) fn place_moved_link(plan: &MultiPlan, group: usize, inputs: &[f64], state: &mut State) {
    if let Some(inner) = &plan.groups[group].inner {
        let between = inner.coordinate_between_bodies(inputs);
        let relative = inner.driver.relative_frame::<1>(between);
        state.relative.set(&relative);
        (state.reduced, state.turned) = (between, inner.driver.sliding.is_none());
    }
}

/// Places all links at given inputs; larger groups from the position that `state` holds,
/// on the side of their singular positions that `signs` tell.
pub(super) fn place_links(
    plan: &MultiPlan,
    signs: &[f64],
    inputs: &[f64],
    state: &mut State,
) -> Result<(), NotAssembled> {
    outwards(plan, inputs, state);
    if plan.geared {
        whole_turn_angles(plan, inputs, &mut state.near);
    }
    for (index, step) in plan.plan.steps.iter().enumerate() {
        place_moved_link(plan, index, inputs, state);
        let placed = match step {
            Step::Dyad(dyad) => dyad_on(plan, dyad, signs[index], state, index),
            Step::Newton(group) => place_by_iteration(plan, group, signs[index], state, index),
        };
        if !placed {
            return Err(NotAssembled { group: index + 1 });
        }
        if plan.geared {
            angles_of(step, state);
        }
    }
    plan.attach(state);
    if plan.geared {
        plan.turn_attached(&mut state.near);
    }
    Ok(())
}

/// The angles over whole turns of all that inputs alone place.
pub(super) fn whole_turn_angles(plan: &MultiPlan, inputs: &[f64], angles: &mut [f64]) {
    for joint in &plan.tree {
        let parent = match joint.parent == plan.bodies {
            true => 0.0,
            false => angles[joint.parent],
        };
        let own = match joint.driver.sliding {
            None => joint.coordinate_between_bodies(inputs),
            Some([cos, sin]) => sin.atan2(cos),
        };
        angles[joint.body] = if joint.reversed {
            parent - own
        } else {
            parent + own
        };
    }
}

#[inline]
fn dyad_on(plan: &MultiPlan, dyad: &Dyad, sign: f64, state: &mut State, index: usize) -> bool {
    let around = surroundings_of_dyad::<1>(dyad, state);
    let found = dyad.directions(&around, sign, plan.plan.size);
    state.margins[index] = found.margin;
    if !(found.margin.value > 0.0) {
        return false;
    }
    let [one, other] = dyad.frames_of_bodies(&around, found.of);
    state.place_body(&dyad.bodies[0], &one);
    state.place_body(&dyad.bodies[1], &other);
    true
}

fn place_by_iteration(
    plan: &MultiPlan,
    group: &NewtonGroup,
    sign: f64,
    state: &mut State,
    index: usize,
) -> bool {
    let mut scratch = std::mem::take(&mut state.scratch);
    for (body, unknowns) in (group.bodies.iter()).zip(scratch.unknowns.chunks_exact_mut(3)) {
        let motion = &state.links[body.base];
        let angle = nearest_turn(motion.angle(), state.near[body.base]);
        let values = [motion.at[0][0], motion.at[1][0], angle];
        for (unknown, value) in unknowns.iter_mut().zip(values) {
            unknown[0] = value;
        }
    }
    let found = group.place_by_newton::<1>(state, &mut scratch, plan.plan.size);
    let placed = match found {
        // Beyond a singular position the determinant has the other sign.
        Ok(margin) => {
            let value = sign * margin.value;
            state.margins[index] = margin;
            state.margins[index].value = value;
            value > 0.0
        }
        Err(_) => false,
    };
    if placed {
        for (index, body) in group.bodies.iter().enumerate() {
            state.place_body(body, &NewtonGroup::frame::<1>(&scratch, index));
            state.near[body.base] = scratch.unknowns[3 * index + 2][0];
        }
    }
    state.scratch = scratch;
    placed
}

/// A position with its inputs, kept to start from.
#[derive(Clone, Debug)]
pub(super) struct StartPosition {
    pub(super) state: State,
    pub(super) inputs: Vec<f64>,
    /// The angles of all bodies, continuous.
    pub(super) angles: Vec<f64>,
    /// Whether they are asked for.
    pub(super) turning: bool,
    /// Memory for the way to another position.
    between: Vec<f64>,
    kept: State,
    /// Where a way began of which parts are gone.
    before: State,
}

impl StartPosition {
    pub(super) fn new(state: State, inputs: Vec<f64>, turning: bool) -> Self {
        Self {
            turning,
            angles: state.links.iter().map(|motion| motion.angle()).collect(),
            between: inputs.clone(),
            kept: state.clone(),
            before: state.clone(),
            state,
            inputs,
        }
    }

    /// Goes to other inputs: at once, or along the straight way in parts where a larger
    /// group does not find its position so. Where they cannot be reached, everything stays
    /// where it was, but for the margins.
    pub(super) fn solve_at(
        &mut self,
        plan: &MultiPlan,
        signs: &[f64],
        inputs: &[f64],
    ) -> Result<(), NotAssembled> {
        let closed = plan.groups.iter().all(|group| group.dyad);
        if closed {
            place_links(plan, signs, inputs, &mut self.state)?;
            self.arrive(plan, inputs);
            return Ok(());
        }
        copy_places(&self.state, &mut self.kept);
        let (mut done, mut part) = (0.0, self.first_part(plan, inputs));
        while done < 1.0 {
            let share = f64::min(1.0, done + part);
            for ((between, from), to) in self.between.iter_mut().zip(&self.inputs).zip(inputs) {
                *between = if share == 1.0 {
                    *to
                } else {
                    from + share * (to - from)
                };
            }
            match place_links(plan, signs, &self.between, &mut self.state) {
                Ok(()) => {
                    if done == 0.0 {
                        std::mem::swap(&mut self.kept, &mut self.before);
                    }
                    copy_places(&self.state, &mut self.kept);
                    done = share;
                }
                Err(group) => {
                    let margins = std::mem::take(&mut self.state.margins);
                    copy_places(&self.kept, &mut self.state);
                    self.state.margins = margins;
                    part *= 0.25;
                    if part * MOST_PARTS < 1.0 {
                        // What was reached lies on the brink: nothing else is found from there.
                        if done > 0.0 {
                            copy_places(&self.before, &mut self.state);
                        }
                        return Err(group);
                    }
                }
            }
        }
        self.arrive(plan, inputs);
        Ok(())
    }

    /// The share of the way to other inputs that is gone at once: couplings need to know how often
    /// something has turned.
    fn first_part(&self, plan: &MultiPlan, inputs: &[f64]) -> f64 {
        if !plan.geared {
            return 1.0;
        }
        let ways = inputs.iter().zip(&self.inputs).enumerate();
        let far = ways.map(|(input, (to, from))| {
            let unit = if plan.slides(input) {
                plan.plan.size
            } else {
                1.0
            };
            (to - from).abs() / (unit * MOST_TURNED)
        });
        far.fold(1.0, f64::max).min(MOST_PARTS).recip()
    }

    /// Notes inputs of a position found, and where something asks for them the angles.
    fn arrive(&mut self, plan: &MultiPlan, inputs: &[f64]) {
        self.inputs.copy_from_slice(inputs);
        if plan.geared {
            self.angles.copy_from_slice(&self.state.near);
            return;
        }
        if !self.turning {
            return;
        }
        for group in &plan.groups {
            let driven = group.inner.as_ref().map(|inner| inner.driven);
            for &body in group.bases.iter().chain(&driven) {
                let angle = self.state.links[body].angle();
                self.angles[body] = nearest_turn(angle, self.angles[body]);
            }
        }
        whole_turn_angles(plan, inputs, &mut self.angles);
        plan.turn_attached(&mut self.angles);
    }

    /// The least margin of all groups, over its rounding: where it is not above zero,
    /// nothing can be said.
    pub(super) fn margin(&self) -> Option<(usize, f64)> {
        let margins = self.state.margins.iter().enumerate();
        let margins = margins.map(|(group, margin)| (group + 1, margin.value - tolerance(margin)));
        margins.min_by(|one, other| one.1.total_cmp(&other.1))
    }
}

/// Copies places alone, without allocating.
fn copy_places(from: &State, to: &mut State) {
    to.links.copy_from_slice(&from.links);
    to.near.copy_from_slice(&from.near);
    to.relative = from.relative;
}
