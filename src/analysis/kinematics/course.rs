//! The motion of a linkage's input coordinate over time, from the drive's
//! prescribed motion through the laws in between.

use crate::jet::Jet;
use crate::model::{Law, Model, NodeIndex, NodeMotion};
use crate::motion::DriveMotion;

/// The way from a prescribed drive to a node: every mass on its law.
#[derive(Clone, Debug)]
pub(super) struct Course<'m> {
    motion: &'m DriveMotion,
    /// From the drive on.
    laws: Vec<&'m Law>,
}

impl<'m> Course<'m> {
    /// The course of a node; `None` behind a motor, whose motion follows from
    /// the forces.
    pub(super) fn of(model: &'m Model, mut node: NodeIndex) -> Option<Self> {
        let mut laws = Vec::new();
        loop {
            match &model.nodes[node].motion {
                NodeMotion::Prescribed { motion, .. } => {
                    laws.reverse();
                    return Some(Self { motion, laws });
                }
                NodeMotion::Rotor { .. } => return None,
                NodeMotion::Mass { law } | NodeMotion::Rigid { law } => {
                    laws.push(law);
                    node = law.driver;
                }
            }
        }
    }

    /// Displacement, speed, acceleration and jerk at `time`; just after a joint
    /// of the motion.
    pub(super) fn at(&self, time: f64) -> Jet {
        let segment = self.motion.breaks().locate(time, 1.0);
        let mut along = self.motion.jet(segment, time);
        for law in &self.laws {
            let segment = law
                .position
                .breaks()
                .locate(along.value, along.first.signum());
            let outer = law.position.jet(segment, along.value).scaled(law.lever);
            along = compose(outer, along);
        }
        along
    }

    /// The drive's constant speed times the constant ratios behind it, when it
    /// is that simple.
    pub(super) fn constant_speed(&self) -> Option<f64> {
        let DriveMotion::Constant { speed, .. } = self.motion else {
            return None;
        };
        let now = self.at(0.0);
        let later = self.at(1.0 / speed.abs().max(1e-300));
        let steady = now.second == 0.0 && now.first == later.first && now.first != 0.0;
        steady.then_some(now.first)
    }
}

/// Derivatives of f(x(t)) from those of f at x and of x at t.
pub(super) fn compose(f: Jet, x: Jet) -> Jet {
    Jet {
        value: f.value,
        first: f.first * x.first,
        second: f.second * x.first * x.first + f.first * x.second,
        third: f.third * x.first.powi(3) + 3.0 * f.second * x.first * x.second + f.first * x.third,
    }
}
