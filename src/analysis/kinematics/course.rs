//! The motion of a linkage's input coordinate over time, from the drive's
//! prescribed motion through the laws in between.

use crate::constraint::Constraint;
use crate::math::jet::Jet;
use crate::model::{Law, Model, NodeIndex, NodeMotion};
use crate::motion::DriveMotion;

/// The way from a prescribed drive to a node: every mass on its law.
#[derive(Clone, Debug)]
pub(super) struct Course<'m> {
    source: Source<'m>,
    /// From there on.
    laws: Vec<&'m Law>,
}

/// Where a motion comes from.
#[derive(Clone, Debug)]
enum Source<'m> {
    Drive(&'m DriveMotion),
    /// Σ ratio·φ + offset of several motions.
    Sum(Vec<(f64, Course<'m>)>, f64),
}

impl<'m> Course<'m> {
    /// The course of a node; `None` behind a motor, whose motion follows from the
    /// forces, and behind a constraint that is not linear.
    pub(super) fn of(model: &'m Model, mut node: NodeIndex) -> Option<Self> {
        let mut laws = Vec::new();
        let source = loop {
            match &model.nodes[node].motion {
                NodeMotion::Prescribed { motion, .. } => break Source::Drive(motion),
                NodeMotion::Rotor { .. } => return None,
                NodeMotion::Mass { law } | NodeMotion::Rigid { law } => {
                    laws.push(law);
                    node = law.driver;
                }
                NodeMotion::Constrained {
                    drivers,
                    constraint,
                } => {
                    let Constraint::Linear { ratios, offset } = constraint else {
                        return None;
                    };
                    let terms = ratios.iter().zip(drivers);
                    let terms = terms.map(|(&ratio, &d)| Some((ratio, Self::of(model, d)?)));
                    break Source::Sum(terms.collect::<Option<_>>()?, *offset);
                }
            }
        };
        laws.reverse();
        Some(Self { source, laws })
    }

    /// Displacement, speed, acceleration and jerk at `time`; just after a joint
    /// of the motion.
    pub(super) fn at(&self, time: f64) -> Jet {
        let mut along = self.source.at(time);
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

    /// The constant speed of the drives times the constant ratios behind them, when it
    /// is that simple.
    pub(super) fn constant_speed(&self) -> Option<f64> {
        let slowest = self.source.slowest()?;
        let now = self.at(0.0);
        let later = self.at(1.0 / slowest.max(1e-300));
        let steady = now.second == 0.0 && now.first == later.first && now.first != 0.0;
        steady.then_some(now.first)
    }
}

impl Source<'_> {
    fn at(&self, time: f64) -> Jet {
        match self {
            Self::Drive(motion) => motion.jet(motion.breaks().locate(time, 1.0), time),
            Self::Sum(terms, offset) => {
                let start = Jet {
                    value: *offset,
                    ..Jet::default()
                };
                terms.iter().fold(start, |sum, (ratio, term)| {
                    let term = term.at(time).scaled(*ratio);
                    Jet {
                        value: sum.value + term.value,
                        first: sum.first + term.first,
                        second: sum.second + term.second,
                        third: sum.third + term.third,
                    }
                })
            }
        }
    }

    /// The least speed of drives that all have a constant one, those at rest excepted.
    fn slowest(&self) -> Option<f64> {
        match self {
            Self::Drive(DriveMotion::Constant { speed, .. }) => Some(speed.abs()),
            Self::Drive(_) => None,
            Self::Sum(terms, _) => {
                let speeds = terms.iter().map(|(_, term)| term.source.slowest());
                let speeds: Vec<f64> = speeds.collect::<Option<_>>()?;
                let moving = speeds.into_iter().filter(|&speed| speed > 0.0);
                Some(moving.fold(f64::INFINITY, f64::min))
            }
        }
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
