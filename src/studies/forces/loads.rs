//! Forces on the outputs of a linkage: of loads on them, and of what hangs on them.
//!
//! Over time they are those of a run. Over a turn or a range the loads act that follow from the
//! motion of the input: the displacement of a node is known where it follows the input, or drives
//! it at a constant ratio, as the machine angle does. What depends on time, or on the motion of
//! anything else, is left out then, and so is what hangs on an output.

use super::{Course, ForceStudy};
use crate::dynamics::model::{
    LinkageBody, Load, Model, NodeIndex, NodeMotion, ObjectPart, TrackSource,
};
use crate::dynamics::record::Quantity;
use crate::dynamics::system::System;
use crate::dynamics::trajectory::transfer;
use crate::kinematics::breaks::Breaks;
use crate::kinematics::linkage::kinetostatics::InputMotion;
use crate::math::roots::{BISECTIONS, bisect};
use crate::studies::kinematics::linkage_of;
use crate::studies::run::run;
use crate::studies::{Control, RunSettings};

/// Tolerance of the run that they are taken from.
const TOLERANCE: f64 = 1e-9;

/// Forces along each output of a linkage (N·m or N) at equal steps from t = 0 to `to`
/// (s), both ends included: those of a run of the scene.
///
/// `None` where nothing acts on an output, and where the run does not come to its end or
/// is not to be trusted.
pub(super) fn over_time(
    model: &Model,
    object: &str,
    to: f64,
    steps: usize,
) -> Option<Vec<Vec<f64>>> {
    let body = linkage_of(model, Some(object)).ok()?;
    let outputs = body.linkage.spec().outputs.iter();
    let ids: Vec<String> = outputs
        .map(|output| format!("{object}.{}", output.name))
        .collect();
    let of_output = |driver: usize| ids.contains(&model.objects[driver].id);
    let hangs = |part: &ObjectPart| (part.inputs.iter()).any(|input| of_output(input.driver));
    let loaded = (model.loads.iter()).any(|load| body.outputs.contains(&load.node));
    if !loaded && !model.objects.iter().any(hangs) {
        return None;
    }
    let settings = RunSettings {
        samples: steps,
        tolerance: TOLERANCE,
        ..RunSettings::new(to)
    };
    let system = System::new(model.clone()).ok()?;
    let result = run(&system, &settings, &Control::FREE, &mut []).ok()?;
    if !result.is_complete() || !result.is_trusted() {
        return None;
    }
    let columns = ids.iter().map(|id| {
        let column = result.record.column(id, Quantity::Reaction)?;
        (column.values.len() == steps + 1).then_some(&column.values)
    });
    let columns = columns.collect::<Option<Vec<_>>>()?;
    let row = |index: usize| columns.iter().map(|column| column[index]).collect();
    Some((0..=steps).map(row).collect())
}

/// What acts on the outputs and is not among the forces of a study, in a sentence.
pub fn loads_left_out(study: &ForceStudy, model: &Model, object: &str) -> Option<String> {
    if study.course.has_loads() {
        return None;
    }
    let behind: Vec<&str> = (loads_on_outputs(model, object).into_iter())
        .filter(|name| !study.acting.iter().any(|own| own == name))
        .collect();
    if behind.is_empty() {
        return None;
    }
    let instead = match study.several {
        None => ": --time includes them, and so does the --record of a run",
        Some(_) => "",
    };
    Some(format!(
        "the forces of what the linkage drives ({}) are not among its loads{instead}",
        behind.join(", ")
    ))
}

/// Objects that the linkage's outputs drive, and the loads on outputs.
fn loads_on_outputs<'m>(model: &'m Model, object: &str) -> Vec<&'m str> {
    let own = |id: &str| {
        id == object
            || id
                .strip_prefix(object)
                .is_some_and(|rest| rest.starts_with('.'))
    };
    let driven = |part: &&ObjectPart| {
        !own(&part.id) && (part.inputs.iter()).any(|input| own(&model.objects[input.driver].id))
    };
    let loaded = |load: &&Load| {
        let parts = model.objects.iter();
        let mut parts = parts.filter(|part| own(&part.id));
        parts.any(|part| part.nodes.contains(&load.node))
    };
    let objects = model.objects.iter().filter(driven);
    let loads = model.loads.iter().filter(loaded);
    (objects.map(|part| part.id.as_str()))
        .chain(loads.map(|load| load.name.as_str()))
        .collect()
}

/// Places of a turn at which a load is compared with itself a turn later.
const PLACES: usize = 720;
/// A difference of this share of the greatest force is rounding.
const REPEATS: f64 = 1e-6;
/// Distance of the two places beside a jump, as a share of what is looked at.
const BESIDE: f64 = 1e-10;
/// Most edges of tables between two places that are looked at.
const EDGES: i64 = 10_000;

/// Loads that act on the outputs of a linkage.
#[derive(Clone, Debug)]
pub struct ActingLoads<'m> {
    model: &'m Model,
    body: &'m LinkageBody,
    /// Index of the output, and the load.
    loads: Vec<(usize, &'m Load)>,
}

impl<'m> ActingLoads<'m> {
    /// The loads that are known along a course at constant speed; of a closed one those that come
    /// again with it. Over time there are none: its instants have their own.
    pub fn loads_along_course(model: &'m Model, body: &'m LinkageBody, course: &Course) -> Self {
        let Course::Even { from, speed, .. } = *course else {
            let loads = Vec::new();
            return Self { model, body, loads };
        };
        let cycle = course.period().map(|period| [from, period]);
        let all = Self {
            model,
            body,
            loads: on_outputs(model, body).collect(),
        };
        let known = |load: &Load| match cycle {
            Some(cycle) => all.repeats_each_cycle(load, speed, cycle),
            None => all
                .force(load, [body.linkage.range().start, speed])
                .is_some(),
        };
        let loads = all.loads.iter().filter(|(_, load)| known(load));
        Self {
            loads: loads.copied().collect(),
            ..all
        }
    }

    /// Their names.
    pub(super) fn names(&self) -> Vec<String> {
        let names = self.loads.iter().map(|(_, load)| load.name.clone());
        names.collect()
    }

    /// The force along each output (N·m or N).
    pub(super) fn at(&self, input: InputMotion) -> Vec<f64> {
        if self.loads.is_empty() {
            return Vec::new();
        }
        let mut forces = vec![0.0; self.body.outputs.len()];
        for (output, load) in &self.loads {
            let force = self.force(load, [input.coordinate, input.speed]);
            forces[*output] += force.unwrap_or(f64::NAN);
        }
        forces
    }

    /// Input coordinates between two of them beside which a load jumps or has a kink: on either
    /// side of each.
    pub(super) fn places(&self, [from, to]: [f64; 2], speed: f64) -> Vec<f64> {
        let mut found = Vec::new();
        for (_, load) in &self.loads {
            let Some(track) = load.law.track(&self.model.tracks) else {
                continue;
            };
            let TrackSource::Node(node) = track.source else {
                continue;
            };
            let place = |q: f64| self.motion(node, [q, speed]).map_or(f64::NAN, |own| own[0]);
            let [low, high] = [from.min(to), from.max(to)];
            for edge in edges_between(&track.breaks, [place(low), place(high)]) {
                let sign = place(high) - edge;
                let before = |q: f64| !((place(q) - edge) * sign > 0.0);
                let [at, _] = bisect([low, high], BISECTIONS, before);
                let beside = BESIDE * (high - low);
                found.extend([at - beside, at + beside].map(|q| q.clamp(low, high)));
            }
        }
        found
    }

    /// The force of a load at a displacement and speed of the input; `None`: it is not known.
    fn force(&self, load: &Load, input: [f64; 2]) -> Option<f64> {
        if load.law.needs_time(&self.model.tracks) {
            return None;
        }
        let motion = |node: NodeIndex| self.motion(node, input).map(|[x, v]| (x, v));
        let force = load.force(0.0, motion, &self.model.tracks)?;
        force.is_finite().then_some(force)
    }

    /// Displacement and speed of a node; `None`: they do not follow from those of the input.
    fn motion(&self, node: NodeIndex, input: [f64; 2]) -> Option<[f64; 2]> {
        let own = self.body.node;
        if node == own {
            return Some(input);
        }
        if let Some([ratio, offset]) = self.model.constant_ratio(own, node) {
            return Some([(input[0] - offset) / ratio, input[1] / ratio]);
        }
        match &self.model.nodes[node].motion {
            NodeMotion::Rigid { law } => {
                let [x, v] = self.motion(law.driver, input)?;
                let jet = transfer(self.model, law, x, v);
                Some([jet.value, jet.first * v])
            }
            _ => None,
        }
    }

    /// True of a load that is known over a cycle and the same in the next one.
    fn repeats_each_cycle(&self, load: &Load, speed: f64, [first, period]: [f64; 2]) -> bool {
        // Between the places of tables that divide a turn evenly.
        let place = |k: usize| first + period * (k as f64 + 0.382) / PLACES as f64;
        let pair = |k: usize| {
            let one = self.force(load, [place(k), speed])?;
            Some((one, self.force(load, [place(k) + period, speed])?))
        };
        let pairs: Option<Vec<(f64, f64)>> = (0..PLACES).map(pair).collect();
        pairs.is_some_and(|pairs| {
            let size = pairs
                .iter()
                .fold(0.0f64, |most, (one, _)| most.max(one.abs()));
            let same = |(one, next): &(f64, f64)| (one - next).abs() <= REPEATS * size;
            pairs.iter().all(same)
        })
    }
}

/// The loads on the outputs of a linkage, each with the index of its output.
pub(super) fn on_outputs<'m>(
    model: &'m Model,
    body: &'m LinkageBody,
) -> impl Iterator<Item = (usize, &'m Load)> {
    let output = |load: &Load| body.outputs.iter().position(|node| *node == load.node);
    let loads = model.loads.iter();
    loads.filter_map(move |load| Some((output(load)?, load)))
}

/// Edges between two places of an axis.
fn edges_between(breaks: &Breaks, [from, to]: [f64; 2]) -> Vec<f64> {
    if breaks.is_empty() || !(from.is_finite() && to.is_finite()) {
        return Vec::new();
    }
    let [first, last] = [from.min(to), from.max(to)].map(|x| breaks.segment_at(x, 1.0));
    let last = last.min(first + EDGES);
    (first..last)
        .map(|segment| breaks.edges(segment).1)
        .collect()
}
