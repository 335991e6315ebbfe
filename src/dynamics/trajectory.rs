//! Trajectories: the motion of nodes over time from the prescribed motions of the drives,
//! through position functions and constraints, as long as every mass follows its law.

use crate::dynamics::model::{Law, Model, NodeIndex, NodeMotion};
use crate::kinematics::constraint::{Constraint, ConstraintJet};
use crate::kinematics::motion::DriveMotion;
use crate::math::jet::Jet;

/// The trajectory of a node behind drives whose motions are prescribed.
#[derive(Clone, Debug)]
pub(crate) struct Trajectory<'m> {
    model: &'m Model,
    node: NodeIndex,
    /// The drives that the motion comes from.
    drives: Vec<&'m DriveMotion>,
    /// Number of laws and of inputs of constraints on the way.
    steps: usize,
    /// True where every constraint on the way is linear.
    linear: bool,
}

impl<'m> Trajectory<'m> {
    /// The trajectory of a node; `None` behind a motor, whose motion follows from the
    /// forces.
    pub(crate) fn of(model: &'m Model, node: NodeIndex) -> Option<Self> {
        let (mut drives, mut steps, mut linear) = (Vec::new(), 0, true);
        let mut open = vec![node];
        while let Some(node) = open.pop() {
            match &model.nodes[node].motion {
                NodeMotion::Prescribed { motion, .. } => drives.push(motion),
                NodeMotion::Rotor { .. } => return None,
                NodeMotion::Mass { law } | NodeMotion::Rigid { law } => {
                    steps += 1;
                    open.push(law.driver);
                }
                NodeMotion::Constrained {
                    drivers,
                    constraint,
                } => {
                    steps += drivers.len();
                    linear &= constraint.is_linear();
                    open.extend(drivers);
                }
            }
        }
        Some(Self {
            model,
            node,
            drives,
            steps,
            linear,
        })
    }

    /// Displacement, speed, acceleration and jerk at `time` (s); just after a joint of
    /// the motion. Not numbers beyond a dead-centre position on the way.
    pub(crate) fn at(&self, time: f64) -> Jet {
        at(self.model, self.node, time)
    }

    /// True when no segment of a law or of a drive's motion is passed over between two of
    /// the samples 0, `interval`, …
    pub(crate) fn resolved(&self, interval: f64, intervals: usize) -> bool {
        let mut open = vec![self.node];
        while let Some(node) = open.pop() {
            let time = |i| interval * i as f64;
            let neighbours = |segment: &dyn Fn(f64) -> i64| {
                let mut segments = (0..=intervals).map(|i| segment(time(i)));
                let mut last = segments.next().unwrap_or(0);
                segments.all(|next| (next - std::mem::replace(&mut last, next)).abs() <= 1)
            };
            let resolved = match &self.model.nodes[node].motion {
                NodeMotion::Prescribed { motion, .. } => {
                    let breaks = motion.breaks();
                    breaks.is_empty() || neighbours(&|time| breaks.segment_at(time, 1.0))
                }
                NodeMotion::Mass { law } | NodeMotion::Rigid { law } => {
                    open.push(law.driver);
                    let breaks = law.position.breaks();
                    let place = |time| at(self.model, law.driver, time).value;
                    breaks.is_empty() || neighbours(&|time| breaks.segment_at(place(time), 1.0))
                }
                NodeMotion::Constrained { drivers, .. } => {
                    open.extend(drivers);
                    true
                }
                NodeMotion::Rotor { .. } => false,
            };
            if !resolved {
                return false;
            }
        }
        true
    }

    /// Greatest speed of a drive at `time`.
    pub(crate) fn fastest_drive(&self, time: f64) -> f64 {
        let speeds = self.drives.iter().map(|drive| instant(drive, time).first);
        speeds.fold(0.0, |most, speed| speed.abs().max(most))
    }

    /// The one drive that is the node itself.
    pub(crate) fn as_drive(&self) -> Option<&'m DriveMotion> {
        match (&self.drives[..], self.steps) {
            (&[drive], 0) => Some(drive),
            _ => None,
        }
    }

    /// Number of laws and of inputs of constraints on the way: the cost of [`Self::at`].
    pub(crate) fn count_of_laws(&self) -> usize {
        self.steps
    }

    /// The constant speed of the drives times the constant ratios behind them, when it
    /// is that simple.
    pub(crate) fn constant_speed(&self) -> Option<f64> {
        let speeds = self.drives.iter().map(|drive| match drive {
            DriveMotion::Constant { speed, .. } => Some(speed.abs()),
            _ => None,
        });
        let speeds: Vec<f64> = speeds.collect::<Option<_>>()?;
        let moving = speeds.into_iter().filter(|&speed| speed > 0.0);
        let slowest = moving.fold(f64::INFINITY, f64::min);
        let now = self.at(0.0);
        let later = self.at(1.0 / slowest.max(1e-300));
        let steady = now.second == 0.0 && now.first == later.first && now.first != 0.0;
        (self.linear && steady).then_some(now.first)
    }
}

/// A drive's motion at `time`.
pub(crate) fn instant(motion: &DriveMotion, time: f64) -> Jet {
    motion.jet(motion.breaks().segment_at(time, 1.0), time)
}

/// lever·U and its derivatives over the driver's displacement φ; the sign of `sense` is
/// that in which the driver moves, and chooses the side of a break point.
pub(crate) fn transfer(model: &Model, law: &Law, phi: f64, sense: f64) -> Jet {
    let segment = match law.track {
        Some(track) => model.tracks[track].breaks.segment_at(phi, sense.signum()),
        None => 0,
    };
    law.position.jet(segment, phi).scaled(law.lever)
}

fn at(model: &Model, node: NodeIndex, time: f64) -> Jet {
    match &model.nodes[node].motion {
        NodeMotion::Prescribed { motion, .. } => instant(motion, time),
        NodeMotion::Rotor { .. } => Jet {
            value: f64::NAN,
            first: f64::NAN,
            second: f64::NAN,
            third: f64::NAN,
        },
        NodeMotion::Mass { law } | NodeMotion::Rigid { law } => {
            let driver = at(model, law.driver, time);
            transfer(model, law, driver.value, driver.first).composed_with(driver)
        }
        NodeMotion::Constrained {
            drivers,
            constraint,
        } => {
            let motions: Vec<Jet> = drivers.iter().map(|&node| at(model, node, time)).collect();
            combined(constraint, &motions)
        }
    }
}

/// The motion G(φ₁(t), …, φₖ(t)).
fn combined(constraint: &Constraint, motions: &[Jet]) -> Jet {
    let places: Vec<f64> = motions.iter().map(|motion| motion.value).collect();
    if let Constraint::Linear { ratios, .. } = constraint {
        let sum = |part: fn(&Jet) -> f64| {
            ratios
                .iter()
                .zip(motions)
                .map(|(ratio, x)| ratio * part(x))
                .sum()
        };
        return Jet {
            value: constraint.value(&places),
            first: sum(|x| x.first),
            second: sum(|x| x.second),
            third: sum(|x| x.third),
        };
    }
    let count = motions.len();
    let mut g = ConstraintJet::new(count);
    constraint.jet(&places, &mut g);
    let mut found = Jet {
        value: g.value,
        ..Jet::default()
    };
    for (i, x) in motions.iter().enumerate() {
        found.first += g.first[i] * x.first;
        found.second += g.first[i] * x.second;
        found.third += g.first[i] * x.third;
        for (j, y) in motions.iter().enumerate() {
            let bend = g.second[i * count + j];
            found.second += bend * x.first * y.first;
            found.third += 3.0 * bend * x.second * y.first;
            for (l, z) in motions.iter().enumerate() {
                found.third += g.third[(i * count + j) * count + l] * x.first * y.first * z.first;
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::combined;
    use crate::kinematics::constraint::{Constraint, ConstraintFunction, ConstraintJet};
    use crate::math::jet::Jet;
    use std::sync::Arc;

    /// G = sin(φ₁)·φ₂².
    #[derive(Debug)]
    struct Product;

    impl ConstraintFunction for Product {
        fn drivers(&self) -> usize {
            2
        }

        fn jet(&self, x: &[f64], jet: &mut ConstraintJet) {
            let ((sin, cos), y) = (x[0].sin_cos(), x[1]);
            jet.value = sin * y * y;
            jet.first.copy_from_slice(&[cos * y * y, 2.0 * sin * y]);
            let mixed = 2.0 * cos * y;
            let second = [-sin * y * y, mixed, mixed, 2.0 * sin];
            jet.second.copy_from_slice(&second);
            let (aab, abb) = (-2.0 * sin * y, 2.0 * cos);
            let third = [-cos * y * y, aab, aab, abb, aab, abb, abb, 0.0];
            jet.third.copy_from_slice(&third);
        }
    }

    #[test]
    fn motions_behind_a_sum_are_summed_however_many_they_are() {
        let one = Jet {
            value: 1.0,
            first: 2.0,
            second: 3.0,
            third: 4.0,
        };
        let sum = Constraint::linear(vec![0.5; 100_000], 7.0).unwrap();
        let found = combined(&sum, &vec![one; 100_000]);
        let parts = [found.value, found.first, found.second, found.third];
        assert_eq!(parts, [50_007.0, 100_000.0, 150_000.0, 200_000.0]);
    }

    #[test]
    fn motions_behind_a_constraint_are_derivatives_of_its_value() {
        // φ₁ = t² + t, φ₂ = 1 + t³.
        let motion = |t: f64| {
            let one = Jet {
                value: t * t + t,
                first: 2.0 * t + 1.0,
                second: 2.0,
                third: 0.0,
            };
            let other = Jet {
                value: 1.0 + t.powi(3),
                first: 3.0 * t * t,
                second: 6.0 * t,
                third: 6.0,
            };
            combined(&Constraint::Custom(Arc::new(Product)), &[one, other])
        };
        let (t, h) = (0.4, 1e-4);
        let [before, here, after] = [t - h, t, t + h].map(motion);
        let of = |a: f64, b: f64| (b - a) / (2.0 * h);
        approx::assert_relative_eq!(
            of(before.value, after.value),
            here.first,
            max_relative = 1e-6
        );
        approx::assert_relative_eq!(
            of(before.first, after.first),
            here.second,
            max_relative = 1e-6
        );
        approx::assert_relative_eq!(
            of(before.second, after.second),
            here.third,
            max_relative = 1e-6
        );
    }
}
