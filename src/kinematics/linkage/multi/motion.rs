//! Where everything is, and how it moves, under a motion of all inputs.

use super::place::NotAssembled;
use super::twist::{Twist, at, minus, plus, times};
use super::{MultiLinkage, MultiWorkspace};
use crate::kinematics::linkage::kinetostatics::{InputMotion, LinkPosition, Positions};
use crate::kinematics::linkage::spec::{LinkageSpec, OutputKind, PairKind, PointOf};
use crate::kinematics::linkage::workspace::Pose;
use crate::math::jet::Jet;

/// A linkage of several inputs at an instant of a motion of them: places, velocities and
/// accelerations, and what each input alone moves. Angles go on continuously from one instant
/// to the next. Jets over time; their third derivatives are not known.
#[derive(Clone, Debug)]
pub struct MultiMotion {
    space: MultiWorkspace<f64>,
    inputs: Vec<Jet>,
    at: Vec<f64>,
    rates: Vec<f64>,
    /// Accelerations of all bodies and of the ground, those of the inputs included.
    accelerations: Vec<Twist<f64>>,
}

impl MultiMotion {
    /// At rest, where the linkage is put together.
    pub fn new(linkage: &MultiLinkage) -> Self {
        let mut space = linkage.workspace::<f64>();
        space.follow_angles();
        let plan = &linkage.core.plan;
        let start = |input: &super::InputSpec| Jet {
            value: input.start,
            ..Jet::default()
        };
        let inputs: Vec<Jet> = linkage.inputs().iter().map(start).collect();
        Self {
            at: inputs.iter().map(|input| input.value).collect(),
            rates: vec![0.0; inputs.len()],
            accelerations: vec![[0.0; 3]; plan.bodies + 1],
            inputs,
            space,
        }
    }

    /// Goes to displacements, speeds and accelerations of the inputs.
    ///
    /// # Errors
    /// The inputs cannot be reached; everything stays where it was. Or a redundant constraint does not
    /// hold there, in an assembly that is reached through a singular position alone.
    pub fn set_inputs(&mut self, inputs: &[Jet]) -> Result<(), NotAssembled> {
        for (k, input) in inputs.iter().enumerate() {
            (self.at[k], self.rates[k]) = (input.value, input.first);
        }
        self.space.solve(&self.at, &self.rates)?;
        self.space.holds_redundant()?;
        self.inputs.copy_from_slice(inputs);
        let (plan, columns) = (&self.space.core.plan, &self.space.columns);
        for (body, own) in self.accelerations.iter_mut().enumerate() {
            *own = columns.acceleration[body];
            for (input, jet) in inputs.iter().enumerate() {
                *own = plus(*own, times(columns.column(plan, body, input), jet.second));
            }
        }
        Ok(())
    }

    /// The motion of the inputs last gone to.
    pub fn inputs(&self) -> &[Jet] {
        &self.inputs
    }

    /// The frame of a link.
    pub fn pose(&self, link: usize) -> Pose {
        self.space.pose(link)
    }

    /// The angles of all links, continuous (rad).
    pub fn angles(&self) -> &[f64] {
        &self.space.known.angles
    }

    /// Lets angles go on from those of an earlier instant.
    pub fn unwrap_angles(&mut self, angles: &[f64]) {
        self.space.known.angles.copy_from_slice(angles);
        self.space.known.state.near.copy_from_slice(angles);
    }

    /// The angle of a link over time.
    pub fn angle(&self, link: usize) -> Jet {
        Jet {
            value: self.space.known.angles[link],
            first: self.space.columns.velocity[link][0],
            second: self.accelerations[link][0],
            third: f64::NAN,
        }
    }

    /// A point over time (m).
    pub fn point(&self, point: PointOf) -> [Jet; 2] {
        let body = self.body_of_link(point.link);
        let columns = &self.space.columns;
        let place = columns.poses[body].point_to_ground(point.at);
        let velocity = columns.velocity[body];
        let [vx, vy] = at(&velocity, place);
        let [ax, ay] = at(&self.accelerations[body], place);
        let second = [ax - velocity[0] * vy, ay + velocity[0] * vx];
        [0, 1].map(|k| Jet {
            value: place[k] + columns.reference[k],
            first: [vx, vy][k],
            second: second[k],
            third: f64::NAN,
        })
    }

    /// The relative coordinate of a pair over time.
    pub fn pair(&self, pair: usize) -> Jet {
        self.output(&OutputKind::Pair { pair })
    }

    /// An output over time.
    pub fn output(&self, kind: &OutputKind) -> Jet {
        let mut first = vec![0.0; self.inputs.len()];
        let [value, bent] = self.space.output(kind, &mut first);
        let sum = |of: fn(&Jet) -> f64| -> f64 {
            let parts = first.iter().zip(&self.inputs);
            parts.map(|(first, input)| first * of(input)).sum()
        };
        Jet {
            value,
            first: sum(|input| input.first),
            second: bent + sum(|input| input.second),
            third: f64::NAN,
        }
    }

    /// d/dq of an output by every input: its row of the Jacobian.
    pub fn output_transfer(&self, kind: &OutputKind, first: &mut [f64]) {
        self.space.output(kind, first);
    }

    /// d/dq of a link's angle by an input.
    pub fn angle_transfer(&self, link: usize, input: usize) -> f64 {
        self.column(Some(link), input)[0]
    }

    /// d/dq of a point by an input.
    pub fn point_transfer(&self, point: PointOf, input: usize) -> [f64; 2] {
        let place =
            self.space.columns.poses[self.body_of_link(point.link)].point_to_ground(point.at);
        at(&self.column(point.link, input), place)
    }

    /// Kinetic energy and potential energy (J).
    pub fn energies(&self) -> [f64; 2] {
        self.space.energies()
    }

    /// What dampers and forces take and give.
    pub fn power(&self) -> super::MultiPower {
        self.space.power()
    }

    /// M(q)·q̈ − Q(q, q̇) on every input: the forces that drive the motion.
    #[cfg(test)]
    pub(super) fn required(&mut self) -> Vec<f64> {
        self.space.reduce(true);
        let (reduced, count) = (&self.space.reduced, self.inputs.len());
        let of = |input: usize| -> f64 {
            let row = &reduced.mass[input * count..(input + 1) * count];
            let inertia = row.iter().zip(&self.inputs);
            let inertia: f64 = inertia.map(|(m, q)| m * q.second).sum();
            inertia - reduced.force[input]
        };
        (0..count).map(of).collect()
    }

    fn column(&self, link: Option<usize>, input: usize) -> Twist<f64> {
        let plan = &self.space.core.plan;
        self.space
            .columns
            .column(plan, self.body_of_link(link), input)
    }

    fn body_of_link(&self, link: Option<usize>) -> usize {
        self.space.core.plan.body_of_link(link)
    }

    fn spec(&self) -> &LinkageSpec {
        &self.space.core.spec.linkage
    }
}

/// With time as the input coordinate.
impl Positions for MultiMotion {
    fn link(&self, index: usize) -> LinkPosition {
        let pose = self.pose(index);
        let [x, y] = self.point(PointOf {
            link: Some(index),
            at: [0.0; 2],
        });
        let angle = self.angle(index);
        LinkPosition {
            origin: [pose.x, pose.y],
            cos: pose.cos,
            sin: pose.sin,
            first: [x.first, y.first, angle.first],
            second: [x.second, y.second, angle.second],
        }
    }

    fn pair_rates(&self, index: usize) -> [f64; 3] {
        let pair = &self.spec().pairs[index];
        if let PairKind::Sliding { .. } = pair.kind {
            let jet = self.pair(index);
            return [jet.first, jet.second, 0.0];
        }
        let [on, link] = [pair.on.link, pair.link.link].map(|link| self.body_of_link(link));
        let turning = |of: &[Twist<f64>]| minus(of[link], of[on])[0];
        let velocity = turning(&self.space.columns.velocity);
        [velocity, turning(&self.accelerations), 0.0]
    }

    fn pair_coordinate(&self, index: usize) -> f64 {
        self.pair(index).value
    }

    fn inputs(&self) -> Vec<InputMotion> {
        let motion = |input: &Jet| InputMotion {
            coordinate: input.value,
            speed: input.first,
            acceleration: input.second,
        };
        self.inputs.iter().map(motion).collect()
    }
}
