//! Velocities of all bodies by each input, and their accelerations without those of the
//! inputs, as screws about one point.
//!
//! A velocity is (ω, vₓ, v_y): the angular velocity and the velocity of the point of the
//! body that lies at the reference point. All velocities of a body chain add up, and a pair
//! contributes its rate times its screw: of a pin at P (1, P_y, −Pₓ), of a guide along u
//! (0, u). A dyad is one linear system of three equations for the rates of its pairs, the
//! closing of the loop through it; a larger group has two equations a pair. Nothing here
//! looks at angles. The screw of a pair that a body carries changes by t × S with the velocity
//! t of that body, which gives the accelerations that no acceleration of an input makes.
//!
//! Source: R. Featherstone, Rigid Body Dynamics Algorithms, Springer, 2008, chapters 2 and
//! 3, in the plane.

use super::plan::{Group, InnerJoint, MultiPlan, Screw, Source};
use super::twist::{Parts, Pose, Twist, at, cross_product, dot, minus, plus, times};
use crate::kinematics::linkage::state::State;
use crate::math::number::Number;

/// Velocities of a linkage at a position. b bodies, m inputs.
#[derive(Clone, Debug)]
pub(super) struct Columns<N> {
    /// The reference point (m).
    pub(super) reference: [f64; 2],
    /// Frames of the bodies and of the ground, seen from the reference point (b + 1).
    pub(super) poses: Vec<Pose<N>>,
    /// Screw of each input's pair, from what comes before to what comes after (m).
    pub(super) screws: Vec<Twist<N>>,
    /// Velocity of every body that a group places by every input (b·m).
    pub(super) columns: Vec<Twist<N>>,
    /// Velocities (b + 1).
    pub(super) velocity: Vec<Twist<N>>,
    /// Accelerations while those of all inputs are zero (b + 1).
    pub(super) acceleration: Vec<Twist<N>>,
    /// Of each dyad the screws of its pairs, and the inverse of its closing equations.
    pub(super) dyads: Vec<[[Twist<N>; 3]; 2]>,
    /// Factors of the equations of larger groups.
    pub(super) matrices: Vec<N>,
    pub(super) exchanged: Vec<usize>,
    /// Of each larger group its equations.
    pub(super) rows: Vec<Vec<Parts<N>>>,
    /// Determinants of the equations of larger groups.
    pub(super) determinants: Vec<f64>,
    /// Right sides.
    pub(super) right: Vec<N>,
}

impl<N: Number> Columns<N> {
    pub(super) fn new(plan: &MultiPlan) -> Self {
        let zero = N::from(0.0);
        let none = [zero; 3];
        let pose = Pose {
            x: zero,
            y: zero,
            cos: N::from(1.0),
            sin: zero,
        };
        let most = plan.groups.iter().map(|group| 3 * group.bases.len()).max();
        Self {
            reference: [0.0; 2],
            poses: vec![pose; plan.bodies + 1],
            screws: vec![none; plan.inputs],
            columns: vec![none; plan.bodies * plan.inputs],
            velocity: vec![none; plan.bodies + 1],
            acceleration: vec![none; plan.bodies + 1],
            dyads: vec![[[none; 3]; 2]; plan.groups.len()],
            matrices: vec![zero; plan.matrices[0]],
            exchanged: vec![0; plan.matrices[1]],
            rows: {
                let rows = |group: &Group| group.ties.iter().map(|tie| tie.rows()).sum();
                let own = |group: &Group| vec![[none; 3]; rows(group)];
                plan.groups.iter().map(own).collect()
            },
            determinants: vec![0.0; plan.groups.len()],
            right: vec![zero; most.unwrap_or(0) * plan.inputs.max(1)],
        }
    }

    /// Takes over positions, as numbers without derivatives.
    pub(super) fn load(&mut self, plan: &MultiPlan, state: &State) {
        let first = &state.links[0].at;
        let [x, y] = [first[0][0], first[1][0]];
        self.reference = [x, y];
        for (pose, motion) in self.poses.iter_mut().zip(&state.links) {
            *pose = Pose {
                x: N::from(motion.at[0][0] - x),
                y: N::from(motion.at[1][0] - y),
                cos: N::from(motion.direction[0][0]),
                sin: N::from(motion.direction[1][0]),
            };
        }
        let ground = &mut self.poses[plan.bodies];
        (ground.x, ground.y) = (N::from(-x), N::from(-y));
    }

    /// Takes over positions with the derivatives that follow from those of the inputs:
    /// those of the values are `known`.
    pub(super) fn lift(&mut self, plan: &MultiPlan, known: &Columns<f64>, inputs: &[N]) {
        self.reference = known.reference;
        for body in 0..plan.bodies {
            let pose = &known.poses[body];
            let mut moved = [N::from(0.0); 3];
            for (input, &q) in inputs.iter().enumerate() {
                if plan.is_moved(body, input) {
                    let change = q - N::from(q.value());
                    let column = known.column(plan, body, input);
                    let [x, y] = at(&column, [pose.x, pose.y]);
                    moved[0] += change.scale(column[0]);
                    moved[1] += change.scale(x);
                    moved[2] += change.scale(y);
                }
            }
            self.poses[body] = Pose {
                x: N::from(pose.x) + moved[1],
                y: N::from(pose.y) + moved[2],
                cos: N::from(pose.cos) - moved[0].scale(pose.sin),
                sin: N::from(pose.sin) + moved[0].scale(pose.cos),
            };
        }
        let ground = known.poses[plan.bodies];
        self.poses[plan.bodies].x = N::from(ground.x);
        self.poses[plan.bodies].y = N::from(ground.y);
    }

    /// Velocity of a body by an input that moves it.
    #[inline(always)]
    pub(super) fn moved_column(&self, plan: &MultiPlan, body: usize, input: usize) -> Twist<N> {
        match plan.placed[body] {
            true => self.screws[input],
            false => self.columns[body * plan.inputs + input],
        }
    }

    /// Velocity of a body, or of the ground, by an input.
    #[inline(always)]
    pub(super) fn column(&self, plan: &MultiPlan, body: usize, input: usize) -> Twist<N> {
        match plan.is_moved(body, input) {
            true => self.moved_column(plan, body, input),
            false => [N::from(0.0); 3],
        }
    }

    /// A pair as a screw at the present position.
    #[inline(always)]
    fn screw(&self, slides: bool, owner: usize, point: [f64; 2], along: [f64; 2]) -> Twist<N> {
        let pose = &self.poses[owner];
        if slides {
            let [x, y] = pose.direction_to_ground(along);
            return [N::from(0.0), x, y];
        }
        let [x, y] = pose.point_to_ground(point);
        [N::from(1.0), y, -x]
    }

    pub(super) fn screw_of(&self, screw: &Screw) -> Twist<N> {
        self.screw(screw.slides, screw.owner, screw.point, screw.along)
    }

    /// Screws of the inputs and the velocities of all bodies by each of them.
    ///
    /// False where a group is in a singular position.
    pub(super) fn find(&mut self, plan: &MultiPlan) -> bool {
        for joint in &plan.tree {
            let element = &joint.driver.on;
            let slides = joint.driver.sliding.is_some();
            let screw = self.screw(slides, joint.owner(), element.point, element.along);
            self.screws[joint.input] = match joint.reversed {
                false => screw,
                true => screw.map(|part| -part),
            };
        }
        let mut regular = true;
        for (index, group) in plan.groups.iter().enumerate() {
            if let Some(inner) = &group.inner {
                let element = &inner.driver.on;
                let slides = inner.driver.sliding.is_some();
                self.screws[inner.input] =
                    self.screw(slides, inner.base, element.point, element.along);
            }
            regular &= match group.dyad {
                true => self.find_dyad(plan, index, group),
                false => self.find_group(plan, index, group),
            };
        }
        self.find_attached(plan);
        regular
    }

    fn find_dyad(&mut self, plan: &MultiPlan, index: usize, group: &Group) -> bool {
        let [a, b, c] = [0, 1, 2].map(|k| self.screw_of(&group.screws[k]));
        // Rows of the inverse of the matrix with the columns a, b, −c.
        let cross = |p: &Twist<N>, q: &Twist<N>| -> Twist<N> {
            [
                p[1] * q[2] - p[2] * q[1],
                p[2] * q[0] - p[0] * q[2],
                p[0] * q[1] - p[1] * q[0],
            ]
        };
        let (bc, ca, ab) = (cross(&b, &c), cross(&c, &a), cross(&a, &b));
        let determinant = dot(&a, &bc);
        let inverse = N::from(1.0) / determinant;
        let rows = [times(bc, inverse), times(ca, inverse), times(ab, -inverse)];
        self.dyads[index] = [[a, b, c], rows];
        for (&input, known) in group.active.iter().zip(&group.known) {
            let known = known.map(|source| self.taken_from(source));
            let inner = group.inner.as_ref().filter(|inner| inner.input == input);
            let own = inner.map(|inner| (inner, self.screws[input]));
            let found = self.dyad_velocities(index, group, known, own);
            self.set_columns(plan, group, input, &found, own.map(|(_, own)| own));
        }
        determinant.value() != 0.0 && determinant.value().is_finite()
    }

    #[inline(always)]
    fn taken_from(&self, source: Source) -> Twist<N> {
        match source {
            Source::Rest => [N::from(0.0); 3],
            Source::Screw(input) => self.screws[input],
            Source::Column(index) => self.columns[index],
        }
    }

    /// Velocities of the two bodies of a dyad: those of what it hangs on known, and that of
    /// the driven link against the one that carries its body's frame.
    #[inline(always)]
    fn dyad_velocities(
        &self,
        index: usize,
        group: &Group,
        [one, other]: [Twist<N>; 2],
        inner: Option<(&InnerJoint, Twist<N>)>,
    ) -> [Twist<N>; 2] {
        let [[a, _, c], rows] = &self.dyads[index];
        let mut right = minus(other, one);
        let (mut first, mut second) = (one, other);
        if let Some((inner, own)) = inner {
            let is = |screw: usize, side: usize| group.screws[screw].sides[side] == inner.driven;
            // Sides of a, b and c that are on the driven link.
            if is(0, 1) {
                right = plus(right, own);
                first = minus(first, own);
            }
            if is(1, 0) {
                right = minus(right, own);
            }
            if is(1, 1) {
                right = plus(right, own);
            }
            if is(2, 1) {
                right = minus(right, own);
                second = minus(second, own);
            }
        }
        let (alpha, gamma) = (dot(&rows[0], &right), dot(&rows[2], &right));
        [
            plus(first, times(*a, alpha)),
            plus(second, times(*c, gamma)),
        ]
    }

    /// Notes the velocities of a group's bodies by an input.
    pub(super) fn set_columns(
        &mut self,
        plan: &MultiPlan,
        group: &Group,
        input: usize,
        found: &[Twist<N>],
        own: Option<Twist<N>>,
    ) {
        for (&body, twist) in group.bases.iter().zip(found) {
            self.columns[body * plan.inputs + input] = *twist;
        }
        if let Some(inner) = &group.inner {
            let base = self.columns[inner.base * plan.inputs + input];
            let driven = own.map_or(base, |own| plus(base, own));
            self.columns[inner.driven * plan.inputs + input] = driven;
        }
    }

    /// Velocities of all bodies, and their accelerations while those of the inputs are
    /// zero, at given rates of the inputs; needs [`Self::find`].
    pub(super) fn set_rates(&mut self, plan: &MultiPlan, rates: &[N]) {
        for joint in &plan.tree {
            let (screw, rate) = (self.screws[joint.input], rates[joint.input]);
            let before = self.velocity[joint.parent];
            let own = plus(before, times(screw, rate));
            // A pin is fixed in both links; a guide goes with its own.
            let owner = match joint.reversed && joint.driver.sliding.is_some() {
                true => own,
                false => before,
            };
            let change = times(cross_product(&owner, &screw), rate);
            self.velocity[joint.body] = own;
            self.acceleration[joint.body] = plus(self.acceleration[joint.parent], change);
        }
        for (index, group) in plan.groups.iter().enumerate() {
            for &body in &group.links {
                let by = &self.columns[body * plan.inputs..][..plan.inputs];
                let mut sum = [N::from(0.0); 3];
                for &input in &group.active {
                    sum = plus(sum, times(by[input], rates[input]));
                }
                self.velocity[body] = sum;
            }
            let inner = group.inner.as_ref().map(|inner| {
                let (screw, rate) = (self.screws[inner.input], rates[inner.input]);
                times(cross_product(&self.velocity[inner.base], &screw), rate)
            });
            match group.dyad {
                true => self.accelerate_dyad(index, group, inner),
                false => self.accelerate_group(plan, index, group, inner),
            }
            if let (Some(own), Some(change)) = (&group.inner, inner) {
                self.acceleration[own.driven] = plus(self.acceleration[own.base], change);
            }
        }
        self.set_attached_rates(plan);
    }

    /// The change of a pair's screw times the pair's rate.
    #[inline(always)]
    pub(super) fn change(&self, screw: &Screw, at: &Twist<N>) -> Twist<N> {
        let [near, far] = screw.sides;
        let relative = minus(self.velocity[far], self.velocity[near]);
        let rate = match screw.slides {
            true => at[1] * relative[1] + at[2] * relative[2],
            false => relative[0],
        };
        times(cross_product(&self.velocity[screw.owner], at), rate)
    }

    fn accelerate_dyad(&mut self, index: usize, group: &Group, inner: Option<Twist<N>>) {
        let [screws, _] = self.dyads[index];
        let [a, b, c] = [0, 1, 2].map(|k| self.change(&group.screws[k], &screws[k]));
        let known = [0, 2].map(|k| self.acceleration[group.screws[k].sides[0]]);
        // What the rates make is taken for accelerations of what the dyad hangs on; that
        // of the pair between the bodies is left to both sides of the loop.
        let one = plus(plus(known[0], a), b);
        let other = plus(known[1], c);
        let inner = group.inner.as_ref().zip(inner);
        let [first, second] = self.dyad_velocities(index, group, [one, other], inner);
        self.acceleration[group.bases[0]] = minus(first, b);
        self.acceleration[group.bases[1]] = second;
    }
}
