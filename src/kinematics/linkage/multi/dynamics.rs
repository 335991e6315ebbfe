//! The equations of motion of a linkage on its inputs: M(q)·q̈ = Q(q, q̇).
//!
//! M = Σ JₗᵀIₗJₗ over all links, Jₗ the velocities by the inputs. Q is the power of all forces
//! along these velocities, the inertia forces of the accelerations that no q̈ makes among
//! them (d'Alembert, Jourdain): they are what Christoffel's symbols of M would give, without
//! a derivative of M. What inputs alone place is summed from outside inwards: the inertia
//! and the forces of all that an input carries act on it as those of one body.
//!
//! Source: R. Featherstone, Rigid Body Dynamics Algorithms, Springer, 2008, chapters 5 and 6.

use super::columns::Columns;
use super::plan::{Massive, MultiPlan, TreeJoint};
use super::twist::{Twist, at, dot};
use crate::math::number::Number;

/// The equations of motion of a linkage at a position and rates of its inputs. m inputs.
#[derive(Clone, Debug)]
pub struct MultiReduced<N> {
    /// Mass matrix M, symmetric (m × m).
    pub mass: Vec<N>,
    /// Q: all forces on the inputs but those of their accelerations (m).
    pub force: Vec<N>,
    /// Mass, its first moments and its moment of inertia about the reference point of
    /// every body of the tree with all that hangs on it (b).
    pub(super) carried: Vec<[N; 4]>,
    /// Moment about the reference point and force on every body (b + 1).
    pub(super) wrenches: Vec<Twist<N>>,
}

/// Momentum of a body of a velocity: its moment about the reference point, and itself.
#[inline(always)]
fn momentum<N: Number>([m, x, y, i]: &[N; 4], v: &Twist<N>) -> Twist<N> {
    [
        *i * v[0] + *x * v[2] - *y * v[1],
        *m * v[1] - v[0] * *y,
        *m * v[2] + v[0] * *x,
    ]
}

impl<N: Number> MultiReduced<N> {
    pub(super) fn new(plan: &MultiPlan) -> Self {
        let zero = N::from(0.0);
        Self {
            mass: vec![zero; plan.inputs * plan.inputs],
            force: vec![zero; plan.inputs],
            carried: vec![[zero; 4]; plan.bodies],
            wrenches: vec![[zero; 3]; plan.bodies + 1],
        }
    }

    /// Wrenches of weights and inertia forces, and the mass matrix.
    pub(super) fn inertia(&mut self, plan: &MultiPlan, gravity: [f64; 2], columns: &Columns<N>) {
        let zero = N::from(0.0);
        self.mass.fill(zero);
        self.wrenches.fill([zero; 3]);
        self.carried.fill([zero; 4]);
        for link in &plan.massive {
            let own = self.add_inertia_and_weight(link, gravity, columns);
            match link.placed {
                true => self.carried[link.body] = own,
                false => self.add_link(plan, link, &own, columns),
            }
        }
        self.carry_attached(plan);
        for joint in plan.tree.iter().rev() {
            if plan.heavy[joint.body] {
                self.add_carried(plan, joint, columns);
            }
        }
        let count = plan.inputs;
        for one in 1..count {
            let (upper, row) = self.mass.split_at_mut(one * count);
            for (other, &entry) in row[..one].iter().enumerate() {
                upper[other * count + one] = entry;
            }
        }
    }

    /// Adds the inertia of a body of the tree with all that hangs on it, and hands it on.
    #[inline(always)]
    fn add_carried(&mut self, plan: &MultiPlan, joint: &TreeJoint, columns: &Columns<N>) {
        let carried = self.carried[joint.body];
        let own = momentum(&carried, &columns.screws[joint.input]);
        let mut outer = joint;
        loop {
            // The lower triangle.
            let (row, column) = match outer.input > joint.input {
                true => (outer.input, joint.input),
                false => (joint.input, outer.input),
            };
            self.mass[row * plan.inputs + column] += dot(&columns.screws[outer.input], &own);
            if outer.parent == plan.bodies {
                break;
            }
            outer = &plan.tree[plan.joint_of[outer.parent]];
        }
        if joint.parent < plan.bodies {
            let sum = &mut self.carried[joint.parent];
            for (sum, part) in sum.iter_mut().zip(carried) {
                *sum += part;
            }
        }
    }

    /// Inertia of a link about the reference point; its weight and inertia force are added
    /// to its wrench.
    #[inline(always)]
    fn add_inertia_and_weight(
        &mut self,
        link: &Massive,
        [gx, gy]: [f64; 2],
        columns: &Columns<N>,
    ) -> [N; 4] {
        let [x, y] = columns.poses[link.body].point_to_ground(link.centre);
        let velocity = &columns.velocity[link.body];
        let acceleration = &columns.acceleration[link.body];
        let [vx, vy] = at(velocity, [x, y]);
        let [ax, ay] = at(acceleration, [x, y]);
        // The acceleration of the point of the body is that of the place, turned on.
        let fx = (N::from(gx) - ax + velocity[0] * vy).scale(link.mass);
        let fy = (N::from(gy) - ay - velocity[0] * vx).scale(link.mass);
        let couple = acceleration[0].scale(link.moment);
        self.wrenches[link.body] = [x * fy - y * fx - couple, fx, fy];
        let square = (x * x + y * y).scale(link.mass) + N::from(link.moment);
        let first = [x.scale(link.mass), y.scale(link.mass)];
        [N::from(link.mass), first[0], first[1], square]
    }

    /// Adds a force at a place to the wrench of a body.
    #[inline(always)]
    pub(super) fn push(&mut self, body: usize, [x, y]: [N; 2], [fx, fy]: [N; 2]) {
        let wrench = &mut self.wrenches[body];
        wrench[0] += x * fy - y * fx;
        wrench[1] += fx;
        wrench[2] += fy;
    }

    /// Adds the inertia of a link that a group places, to the lower triangle.
    #[inline(always)]
    fn add_link(&mut self, plan: &MultiPlan, link: &Massive, own: &[N; 4], columns: &Columns<N>) {
        let count = plan.inputs;
        let by = &columns.columns[link.body * count..][..count];
        for (at, &one) in link.moved.iter().enumerate() {
            let momentum = momentum(own, &by[one]);
            let row = &mut self.mass[one * count..][..count];
            for &other in &link.moved[..=at] {
                row[other] += dot(&by[other], &momentum);
            }
        }
    }

    /// Q from the wrenches on all bodies, which are summed on the way.
    pub(super) fn generalise(&mut self, plan: &MultiPlan, columns: &Columns<N>) {
        self.force.fill(N::from(0.0));
        self.load_attached(plan);
        for group in &plan.groups {
            for &body in &group.links {
                let wrench = self.wrenches[body];
                let by = &columns.columns[body * plan.inputs..][..plan.inputs];
                for &input in &group.active {
                    self.force[input] += dot(&by[input], &wrench);
                }
            }
        }
        for joint in plan.tree.iter().rev() {
            let wrench = self.wrenches[joint.body];
            self.force[joint.input] += dot(&columns.screws[joint.input], &wrench);
            let before = &mut self.wrenches[joint.parent];
            for (sum, part) in before.iter_mut().zip(wrench) {
                *sum += part;
            }
        }
    }
}
