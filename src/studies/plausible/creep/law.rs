//! Loads that are friction with a regularisation: those that say so, and expressions that
//! behave so.

use super::own::Columns;
use crate::dynamics::model::{LoadLaw, LoadVariable, Model, NodeIndex, WrittenLoad};
use crate::dynamics::record::Quantity;
use std::borrow::Cow;

/// The factors on a speed between which the force of a friction no longer grows.
const PLATEAU: [f64; 5] = [4.0, 10.0, 30.0, 100.0, 1000.0];
/// There it grows by no more than this share, with twice the speed.
const FLAT: f64 = 0.02;
/// A force is odd in the speed to this share of it.
const ODD: f64 = 1e-6;
/// In the range of regularisation the force grows with the speed at least to this power.
const RISES: f64 = 0.02;
/// An expression is friction only where its width is below this share of the greatest
/// speed, or below this speed (rad/s or m/s): a damper that saturates is none.
const NARROW: f64 = 0.05;
const SLOW: f64 = 0.01;

/// Samples of an object's motion against what a friction acts against.
pub(super) struct Motion<'r> {
    pub(super) times: &'r [f64],
    /// Its speed relative to that.
    pub(super) speed: Cow<'r, [f64]>,
    /// Greatest magnitude of that.
    greatest: f64,
    /// What an expression reads, in its order.
    variables: Vec<&'r [f64]>,
}

impl<'r> Motion<'r> {
    /// The motion of a node; `None`: the record lacks what the friction reads.
    pub(super) fn new(
        columns: &Columns<'r>,
        node: NodeIndex,
        friction: &Friction<'_>,
    ) -> Option<Self> {
        let times = columns.record.times.as_slice();
        let own = columns.of(node, Quantity::Speed)?;
        let speed = match friction.other_node() {
            None => Cow::Borrowed(own),
            Some(other) => {
                let other = columns.of(other, Quantity::Speed)?;
                own.iter()
                    .zip(other)
                    .map(|(own, other)| own - other)
                    .collect()
            }
        };
        let variables = match friction {
            Friction::Stated { .. } => Some(Vec::new()),
            Friction::Written { load, .. } => (load.variables.iter())
                .map(|variable| match *variable {
                    LoadVariable::Time => Some(times),
                    LoadVariable::Displacement(node) => columns.of(node, Quantity::Displacement),
                    LoadVariable::Speed(node) => columns.of(node, Quantity::Speed),
                })
                .collect(),
        };
        Some(Self::of(times, speed, variables?))
    }

    /// A motion of these samples.
    pub(super) fn of(times: &'r [f64], speed: Cow<'r, [f64]>, variables: Vec<&'r [f64]>) -> Self {
        Self {
            times,
            greatest: speed.iter().fold(0.0f64, |a, b| a.max(b.abs())),
            speed,
            variables,
        }
    }
}

/// A friction on the last mass of an object.
pub(super) enum Friction<'m> {
    /// The load `friction`.
    Stated {
        /// Its limit.
        force: f64,
        /// Width of the regularisation (speed).
        width: f64,
    },
    /// An expression that may be one.
    Written {
        /// The load.
        load: &'m WrittenLoad,
        /// Which of its variables is the speed of its own node.
        own: usize,
        /// The other node that it acts against; `None`: the ground.
        against: Option<NodeIndex>,
    },
}

/// What a friction bears at an instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct State {
    /// Its force.
    pub(super) force: f64,
    /// Its greatest force, > 0.
    pub(super) limit: f64,
    /// Width of the regularisation (speed).
    pub(super) width: f64,
}

/// The frictions on the last mass of an object: what may be one.
pub(super) fn frictions(model: &Model, object: usize) -> Vec<Friction<'_>> {
    let Some(&node) = model.objects[object].nodes.last() else {
        return Vec::new();
    };
    let loads = model.loads.iter().filter(|load| load.node == node);
    loads.flat_map(|load| friction(&load.law, node)).collect()
}

/// A load as a friction against the ground or against another object, if it may be one.
fn friction(law: &LoadLaw, node: NodeIndex) -> Vec<Friction<'_>> {
    // (All laws by name: a new one is not taken for one without friction.)
    match law {
        LoadLaw::Function { function, factor } => match function.regularised_friction() {
            Some([force, width]) if force * factor != 0.0 => vec![Friction::Stated {
                force: (force * factor).abs(),
                width,
            }],
            _ => Vec::new(),
        },
        LoadLaw::Written(load) => frictions_of_expression(load, node),
        // (Dry friction sticks and does not creep.)
        LoadLaw::Linear(_) | LoadLaw::Pieces { .. } | LoadLaw::Stop(_) | LoadLaw::Dry { .. } => {
            Vec::new()
        }
    }
}

/// An expression of the speed of its node as a friction against the ground, and against each
/// node whose speed it reads.
fn frictions_of_expression(load: &WrittenLoad, node: NodeIndex) -> Vec<Friction<'_>> {
    let program = load.expression.program();
    let speeds = load.variables.iter().enumerate();
    let speeds = speeds.filter_map(|(index, variable)| match *variable {
        LoadVariable::Speed(of) if program.reads(index) => Some((index, of)),
        LoadVariable::Speed(_) | LoadVariable::Time | LoadVariable::Displacement(_) => None,
    });
    let (own, others): (Vec<_>, Vec<_>) = speeds.partition(|(_, of)| *of == node);
    let Some(&(own, _)) = own.first() else {
        return Vec::new();
    };
    let others = others.into_iter().map(|(_, other)| Some(other));
    let all = std::iter::once(None).chain(others);
    all.map(|against| Friction::Written { load, own, against })
        .collect()
}

impl Friction<'_> {
    /// The node that it acts against; `None`: the ground.
    pub(super) fn other_node(&self) -> Option<NodeIndex> {
        match self {
            Self::Stated { .. } => None,
            Self::Written { against, .. } => *against,
        }
    }

    /// What it bears at a sample; `None`: it is no friction there.
    pub(super) fn state(&self, motion: &Motion<'_>, k: usize) -> Option<State> {
        let speed = motion.speed[k];
        match self {
            Self::Stated { force, width } => Some(State {
                force: force * (speed / width).tanh(),
                limit: *force,
                width: *width,
            }),
            Self::Written { load, own, .. } => {
                let mut values: Vec<f64> = motion.variables.iter().map(|own| own[k]).collect();
                let of_other = values[*own] - speed;
                let at = |speed: f64| {
                    values[*own] = of_other + speed;
                    load.factor * load.expression.at(&values)
                };
                regularised(speed, at)
                    .filter(|state| state.width <= NARROW * motion.greatest || state.width <= SLOW)
            }
        }
    }
}

/// A force over the speed as a friction within the width of its regularisation: odd, against
/// the speed, rising here and flat beyond.
fn regularised(speed: f64, mut force: impl FnMut(f64) -> f64) -> Option<State> {
    let here = force(speed);
    let opposes = here * speed < 0.0;
    let odd = (here + force(-speed)).abs() <= ODD * here.abs() && force(0.0) == 0.0;
    let rise = (force(1.01 * speed) - force(0.99 * speed)) / (0.02 * here);
    if !(opposes && odd && rise >= RISES) {
        return None;
    }
    let flat = |factor: &&f64| {
        let [near, far] = [1.0, 2.0].map(|times| force(times * **factor * speed));
        (far - near).abs() <= FLAT * near.abs()
    };
    let plateau = PLATEAU.iter().find(flat)?;
    let limit = force(plateau * speed).abs();
    let share = here.abs() / limit;
    (share < 1.0).then(|| State {
        force: here.abs(),
        limit,
        width: speed.abs() / share.atanh(),
    })
}

#[cfg(test)]
mod tests {
    use super::regularised;
    use approx::assert_relative_eq;

    #[test]
    fn a_written_friction_shows_its_limit_and_its_width() {
        let speed = 1e-3 * 0.8f64.atanh();
        let found = regularised(speed, |v| -5.0 * (v / 1e-3).tanh()).unwrap();
        assert_relative_eq!(found.limit, 5.0, max_relative = 0.01);
        assert_relative_eq!(found.force, 4.0, max_relative = 1e-12);
        assert_relative_eq!(found.width, 1e-3, max_relative = 0.02);
    }

    #[test]
    fn what_slides_is_not_held() {
        assert!(regularised(0.02, |v| -5.0 * (v / 1e-3).tanh()).is_none());
    }

    #[test]
    fn dampers_and_motors_are_no_friction() {
        let laws: [fn(f64) -> f64; 5] = [
            |v| -5.0 * v,
            |v| -5.0 * v * v.abs(),
            |v| -5.0 * v.signum() * v.abs().sqrt(),
            |v| 5.0 * (v / 1e-3).tanh(),
            |v| 5.0 * (1.0 - (v / 1e-3).tanh()),
        ];
        for law in laws {
            assert!(regularised(1e-3, law).is_none());
        }
    }
}
