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
use super::plan::MultiPlan;
use super::twist::{Twist, at, dot};
use crate::kinematics::linkage::spec::{LinkSpec, LinkageSpec};
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
    pub(super) fn inertia(&mut self, plan: &MultiPlan, spec: &LinkageSpec, columns: &Columns<N>) {
        let zero = N::from(0.0);
        self.mass.fill(zero);
        self.wrenches.fill([zero; 3]);
        self.carried.fill([zero; 4]);
        for (body, link) in spec.links.iter().enumerate() {
            if link.mass == 0.0 && link.moment == 0.0 {
                continue;
            }
            let own = self.weigh(body, link, spec.gravity, columns);
            match plan.placed[body] {
                true => self.carried[body] = own,
                false => self.add_link(plan, body, &own, columns),
            }
        }
        self.carry_attached(plan);
        for joint in plan.tree.iter().rev() {
            if !plan.heavy[joint.body] {
                continue;
            }
            let carried = self.carried[joint.body];
            let own = momentum(&carried, &columns.screws[joint.input]);
            let mut outer = joint;
            loop {
                let entry = dot(&columns.screws[outer.input], &own);
                self.add(plan, joint.input, outer.input, entry);
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
    }

    /// Inertia of a link about the reference point; its weight and inertia force are added
    /// to its wrench.
    #[inline]
    fn weigh(
        &mut self,
        body: usize,
        link: &LinkSpec,
        [gx, gy]: [f64; 2],
        columns: &Columns<N>,
    ) -> [N; 4] {
        let [x, y] = columns.poses[body].place(link.centre);
        let (velocity, acceleration) = (&columns.velocity[body], &columns.acceleration[body]);
        let [vx, vy] = at(velocity, [x, y]);
        let [ax, ay] = at(acceleration, [x, y]);
        // The acceleration of the point of the body is that of the place, turned on.
        let force = [
            (N::from(gx) - ax + velocity[0] * vy).scale(link.mass),
            (N::from(gy) - ay - velocity[0] * vx).scale(link.mass),
        ];
        self.push(body, [x, y], force);
        self.wrenches[body][0] -= acceleration[0].scale(link.moment);
        let square = (x * x + y * y).scale(link.mass) + N::from(link.moment);
        [
            N::from(link.mass),
            x.scale(link.mass),
            y.scale(link.mass),
            square,
        ]
    }

    /// Adds a force at a place to the wrench of a body.
    #[inline(always)]
    pub(super) fn push(&mut self, body: usize, [x, y]: [N; 2], [fx, fy]: [N; 2]) {
        let wrench = &mut self.wrenches[body];
        wrench[0] += x * fy - y * fx;
        wrench[1] += fx;
        wrench[2] += fy;
    }

    /// Adds the inertia of a link that a group places.
    #[inline]
    fn add_link(&mut self, plan: &MultiPlan, body: usize, own: &[N; 4], columns: &Columns<N>) {
        for one in 0..plan.inputs {
            if !plan.is_moved(body, one) {
                continue;
            }
            let momentum = momentum(own, &columns.moved_column(plan, body, one));
            for other in 0..=one {
                if plan.is_moved(body, other) {
                    let column = columns.moved_column(plan, body, other);
                    self.add(plan, one, other, dot(&column, &momentum));
                }
            }
        }
    }

    /// Adds to an entry of the mass matrix, and to its mirror image.
    #[inline(always)]
    fn add(&mut self, plan: &MultiPlan, one: usize, other: usize, entry: N) {
        self.mass[one * plan.inputs + other] += entry;
        if one != other {
            self.mass[other * plan.inputs + one] += entry;
        }
    }

    /// Q from the wrenches on all bodies, which are summed on the way.
    pub(super) fn generalise(&mut self, plan: &MultiPlan, columns: &Columns<N>) {
        self.force.fill(N::from(0.0));
        self.load_attached(plan);
        for group in &plan.groups {
            let driven = group.inner.as_ref().map(|inner| inner.driven);
            for &body in group.bases.iter().chain(&driven) {
                let wrench = self.wrenches[body];
                for &input in &group.active {
                    let column = columns.moved_column(plan, body, input);
                    self.force[input] += dot(&column, &wrench);
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
