//! Loads that are written as expressions: what their names stand for, and what of them
//! is one of the other laws. Loads over the motion of an object that is lowered later.

use super::{ModelBuilder, NodeEntry};
use crate::dynamics::model::{
    LoadLaw, LoadVariable, Node, NodeIndex, NodeMotion, Track, TrackSource, WrittenLoad,
};
use crate::kinematics::breaks::Breaks;
use crate::kinematics::constraint::Constraint;
use crate::math::expression::Expression;
use std::sync::Arc;

/// Names with the index of the variable that each means.
pub(crate) type Names = [(&'static str, usize)];

/// Names of time and of the own motion.
pub(crate) const OWN: [(&str, usize); 5] = [
    ("t", 0),
    ("phi", 1),
    ("phi_dot", 2),
    ("φ", 1),
    ("φ\u{307}", 2),
];

/// Names of the driver's motion.
pub(crate) const DRIVER: [(&str, usize); 2] = [("driver_phi", 3), ("driver_phi_dot", 4)];

/// Names of the motion of another object.
pub(crate) const OVER: [(&str, usize); 2] = [("over_phi", 5), ("over_phi_dot", 6)];

/// The name by which a message calls a variable.
pub(crate) fn variable_name(index: usize) -> &'static str {
    let all = OWN.iter().chain(&DRIVER).chain(&OVER);
    let mut named = all.filter(|(_, own)| *own == index);
    named.next().map_or("", |(name, _)| name)
}

/// Indices of the own motion among the variables.
const PHI: usize = 1;
const PHI_DOT: usize = 2;

/// A force written as an expression.
#[derive(Clone, Debug, PartialEq)]
pub struct WrittenSpec {
    /// The expression over `t`, `phi`, `phi_dot` of the mass, `driver_phi` and
    /// `driver_phi_dot`, and with `over` `over_phi` and `over_phi_dot`, in SI units.
    pub expression: Expression,
    /// Factor on its value, which is then in N or N·m.
    pub factor: f64,
    /// Another object or output whose motion it looks at.
    pub over: Option<String>,
}

/// Axis of a track over an object that has no node yet.
pub(super) const NO_NODE_YET: NodeIndex = NodeIndex::MAX;

/// What refers to an object that may be lowered later.
#[derive(Clone, Debug)]
pub(super) struct PendingReference {
    what: ReferenceKind,
    over: String,
    path: String,
}

#[derive(Clone, Copy, Debug)]
enum ReferenceKind {
    /// Index into [`Model::loads`](crate::dynamics::model::Model::loads): an expression.
    Load(usize),
    /// The same: dry friction between two objects.
    Friction(usize),
    /// Index into [`Model::tracks`](crate::dynamics::model::Model::tracks): the axis of a table
    /// or window.
    Track(usize),
}

impl ModelBuilder {
    /// The law of an expression on a node behind a driver.
    pub(super) fn expression_law(
        &mut self,
        path: &str,
        spec: &WrittenSpec,
        node: NodeIndex,
        driver: NodeIndex,
    ) -> Option<LoadLaw> {
        if !spec.factor.is_finite() {
            self.faults
                .add(format!("{path}.unit"), "a factor that is not finite", "");
            return None;
        }
        let program = spec.expression.program();
        if let Some(value) = program.value.constant() {
            let force = value * spec.factor;
            if !force.is_finite() {
                let message = format!("\"{}\" has no finite value", spec.expression.text());
                self.faults.add(format!("{path}.expression"), message, "");
                return None;
            }
            return Some(LoadLaw::constant(force));
        }
        if let Some(law) = simple(spec) {
            return Some(law);
        }
        let expression = spec.expression.clone();
        let written = WrittenLoad::of(expression, spec.factor, [node, driver]);
        Some(LoadLaw::Written(written))
    }

    /// The track of a table or window over an object that has no node yet; `None`: no breaks.
    pub(super) fn waiting_track(
        &mut self,
        path: &str,
        over: &str,
        breaks: Breaks,
        object: usize,
    ) -> Option<usize> {
        if breaks.is_empty() {
            return None;
        }
        // (A track of its own: two that wait may be over different objects.)
        self.model.tracks.push(Track {
            source: TrackSource::Node(NO_NODE_YET),
            breaks,
            repeats: false,
            stops: false,
            object,
        });
        let track = self.model.tracks.len() - 1;
        self.waiting.push(PendingReference {
            what: ReferenceKind::Track(track),
            over: over.to_owned(),
            path: format!("{path}.over"),
        });
        Some(track)
    }

    /// Remembers that the load added last looks at another object.
    pub(super) fn wait_for(&mut self, path: &str, over: Option<&String>) {
        let last = self.model.loads.len().checked_sub(1);
        if let (Some(over), Some(load)) = (over, last) {
            let law = &self.model.loads[load].law;
            let what = match (law.dry_friction(), law.expression_load()) {
                (Some(_), _) => ReferenceKind::Friction(load),
                (None, Some(_)) => ReferenceKind::Load(load),
                (None, None) => return,
            };
            self.waiting.push(PendingReference {
                what,
                over: over.clone(),
                path: format!("{path}.over"),
            });
        }
    }

    /// Connects the loads that look at other objects, now that all have their nodes.
    pub(super) fn connect_waiting(&mut self) {
        for waiting in std::mem::take(&mut self.waiting) {
            let Some(&node) = self.outputs.get(&waiting.over) else {
                let known: Vec<&str> = self.outputs.keys().map(String::as_str).collect();
                let message = format!("unknown object `{}`", waiting.over);
                let hint = format!("the objects are {}", known.join(", "));
                self.faults.add(waiting.path, message, &hint);
                continue;
            };
            match waiting.what {
                ReferenceKind::Load(load) => self.connect_load(load, node),
                ReferenceKind::Friction(load) => self.connect_friction(load, node, &waiting),
                ReferenceKind::Track(track) => self.connect_track(track, node),
            }
        }
    }

    /// Dry friction between two nodes acts on their difference, a node without inertia.
    fn connect_friction(&mut self, load: usize, other: NodeIndex, waiting: &PendingReference) {
        self.connect_load(load, other);
        let own = self.model.loads[load].node;
        let part = |node: NodeIndex| self.known[node].part;
        let coordinate = |node: NodeIndex| self.model.objects[part(node)].coordinate;
        if own == other {
            let hint = "name another object, or leave out `over`: friction against the ground";
            let message = "an object does not rub on itself";
            return self.faults.add(&waiting.path, message, hint);
        }
        if coordinate(own) != coordinate(other) {
            let message = format!(
                "what turns does not rub on what slides: `{}` has another unit",
                waiting.over
            );
            let hint = "friction acts between two objects that both turn or both slide";
            return self.faults.add(&waiting.path, message, hint);
        }
        let start = self.known[own].start - self.known[other].start;
        let part = part(own);
        self.model.nodes.push(Node {
            inertia: 0.0,
            motion: NodeMotion::Constrained {
                drivers: vec![own, other],
                constraint: Constraint::Linear {
                    ratios: vec![1.0, -1.0],
                    offset: 0.0,
                },
            },
        });
        self.known.push(NodeEntry { part, start });
        self.model.loads[load].node = self.model.nodes.len() - 1;
    }

    fn connect_load(&mut self, load: usize, node: NodeIndex) {
        if let Some(written) = self.model.loads[load].law.written_mut() {
            written.variables[OVER[0].1] = LoadVariable::Displacement(node);
            written.variables[OVER[1].1] = LoadVariable::Speed(node);
        }
    }
}

impl WrittenLoad {
    /// An expression on a node behind a driver.
    pub(super) fn of(expression: Expression, factor: f64, [node, driver]: [NodeIndex; 2]) -> Self {
        Self {
            expression: Arc::new(expression),
            factor,
            variables: vec![
                LoadVariable::Time,
                LoadVariable::Displacement(node),
                LoadVariable::Speed(node),
                LoadVariable::Displacement(driver),
                LoadVariable::Speed(driver),
                // (Another object may not have its node yet.)
                LoadVariable::Displacement(node),
                LoadVariable::Speed(node),
            ],
        }
    }
}

/// The law of an expression that is a spring or a damper.
fn simple(spec: &WrittenSpec) -> Option<LoadLaw> {
    let linear = spec.expression.affine_in(&[PHI, PHI_DOT])?;
    let rest = spec.factor * linear.rest.value.constant()?;
    let [rate, damping] = [0, 1].map(|k| -spec.factor * linear.factors[k]);
    let finite = rest.is_finite() && rate.is_finite() && damping.is_finite();
    match finite {
        true if rate > 0.0 && damping == 0.0 => Some(LoadLaw::spring(rate, -rest)),
        true if damping > 0.0 && rate == 0.0 && rest == 0.0 => Some(LoadLaw::viscous(damping)),
        _ => None,
    }
}
