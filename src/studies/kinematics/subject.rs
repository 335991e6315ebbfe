//! Whose kinematics is looked at: a linkage, or an object whose position
//! function is the short form of one.

use crate::dynamics::model::{
    Coordinate, Law, LinkageBody, Model, MultiLinkageBody, NodeIndex, NodeMotion, ObjectPart,
};
use crate::fault::Fault;
use crate::kinematics::linkage::multi::MultiLinkage;
use crate::kinematics::linkage::spec::{LinkageSpec, OutputKind};
use crate::kinematics::linkage::{Linkage, Reach};
use crate::kinematics::position::Position;

/// A linkage with its place in a model.
#[derive(Clone, Debug)]
pub struct Subject {
    /// The object's id.
    pub object: String,
    /// The linkage; of a short form the massless one that it stands for.
    pub linkage: Linkage,
    /// The node whose displacement is the input coordinate.
    pub(super) node: NodeIndex,
    /// Whether the input turns or slides.
    pub input: Coordinate,
    /// Whether each output turns or slides.
    pub(super) outputs: Vec<Coordinate>,
}

impl Subject {
    /// The subject with this id; without one the only linkage, or, in a scene
    /// without linkages, the only object that moves by the short form of one.
    ///
    /// # Errors
    /// There is none, or more than one and no id; in words.
    pub fn of(model: &Model, id: Option<&str>) -> Result<Self, String> {
        let by_id = |id: &str| shorts(model).find(|part| part.id == id);
        let part = match (id, model.linkages.is_empty()) {
            (Some(id), _) => by_id(id),
            (None, true) => match shorts(model).collect::<Vec<_>>().as_slice() {
                [] => None,
                [only] => Some(*only),
                several => return Err(say_which(several.iter().map(|part| part.id.as_str()))),
            },
            (None, false) => None,
        };
        match part {
            Some(part) => Self::of_short_form(model, part),
            None => linkage_of(model, id).map(|body| Self::of_linkage(model, body)),
        }
    }

    /// The node whose displacement is the input coordinate.
    pub(in crate::studies) fn input_node(&self) -> NodeIndex {
        self.node
    }

    fn of_linkage(model: &Model, body: &LinkageBody) -> Self {
        let part = &model.objects[body.object];
        Self::new(&part.id, Linkage::clone(&body.linkage), body.node)
    }

    fn of_short_form(model: &Model, part: &ObjectPart) -> Result<Self, String> {
        let law = short_form_law(model, part).ok_or("it moves by no linkage")?;
        let start = start_of(model, law.driver);
        let linkage = assembled(&law.position, start).map_err(|faults| {
            let words: Vec<String> = faults.into_iter().map(|fault| fault.message).collect();
            format!(
                "the linkage of `{}` cannot be assembled: {}",
                part.id,
                words.join("; ")
            )
        })?;
        Ok(Self::new(&part.id, linkage, law.driver))
    }

    fn new(id: &str, linkage: Linkage, node: NodeIndex) -> Self {
        let spec = linkage.spec();
        Self {
            object: id.to_owned(),
            node,
            input: of_pair(spec, spec.driver),
            outputs: of_outputs(spec),
            linkage,
        }
    }
}

/// Whether a pair turns or slides.
fn of_pair(spec: &LinkageSpec, pair: usize) -> Coordinate {
    Coordinate::sliding(spec.pairs[pair].slides())
}

/// Whether each output turns or slides.
pub(super) fn of_outputs(spec: &LinkageSpec) -> Vec<Coordinate> {
    let outputs = spec.outputs.iter().map(|output| match output.kind {
        OutputKind::Angle { .. } => Coordinate::Turning,
        OutputKind::Point { .. } => Coordinate::Sliding,
        OutputKind::Pair { pair } => of_pair(spec, pair),
    });
    outputs.collect()
}

/// The linkage of several inputs with this id; without one the only linkage, where that is
/// one of several inputs.
pub fn several_of<'m>(model: &'m Model, id: Option<&str>) -> Option<&'m MultiLinkageBody> {
    let mut all = model.multi_linkages.iter();
    match id {
        Some(id) => all.find(|body| model.objects[body.object].id == id),
        None => {
            let only = model.multi_linkages.len() == 1 && model.linkages.is_empty();
            all.next().filter(|_| only)
        }
    }
}

/// Linkages, and objects that move by the short form of one, whose input cannot
/// go everywhere: how far it can, in words; and the redundant constraints of linkages.
pub fn limited_inputs(model: &Model) -> Vec<String> {
    let limited = |part: &&ObjectPart| match short_form_law(model, part) {
        Some(law) => {
            let reach = law.position.reach_from(start_of(model, law.driver));
            reach.is_ok_and(|reach| reach.is_some())
        }
        None => model.linkages.iter().any(|body| {
            let interval = matches!(body.linkage.range().reach, Reach::Interval { .. });
            model.objects[body.object].id == part.id && interval
        }),
    };
    let parts = model.objects.iter().filter(limited);
    let subjects = parts.filter_map(|part| Subject::of(model, Some(&part.id)).ok());
    let words = subjects.map(|subject| {
        let range = subject.linkage.range();
        let turning = subject.input == Coordinate::Turning;
        let words = range.describe(subject.linkage.structure(), turning);
        format!("`{}`: input {words}", subject.object)
    });
    let redundant = model.linkages.iter().flat_map(|body| {
        let id = &model.objects[body.object].id;
        let sentences = body.linkage.structure().redundant.iter();
        sentences.map(move |sentence| format!("`{id}`: {sentence}"))
    });
    words.chain(redundant).collect()
}

/// The objects whose position function is the short form of a linkage.
fn shorts(model: &Model) -> impl Iterator<Item = &ObjectPart> {
    let parts = model.objects.iter();
    parts.filter(|part| short_form_law(model, part).is_some())
}

/// The assembly mode of every linkage that has another, each in a sentence with how to choose the
/// other.
pub fn assembly_modes(model: &Model) -> Vec<String> {
    let of = |object: usize, modes: Vec<String>| {
        let id = &model.objects[object].id;
        modes.into_iter().map(move |mode| format!("`{id}`: {mode}"))
    };
    let single = model.linkages.iter().flat_map(|body| {
        let (linkage, spec) = (&body.linkage, body.linkage.spec());
        let assembles = |assembly| {
            let spec = spec.clone();
            Linkage::new(LinkageSpec { assembly, ..spec }).is_ok()
        };
        let modes = linkage.structure();
        of(
            body.object,
            modes.assembly_modes(&spec.assembly, &assembles),
        )
    });
    let multi = model.multi_linkages.iter().flat_map(|body| {
        let (linkage, spec) = (&body.linkage, body.linkage.spec());
        let assembles = |assembly| {
            let mut spec = spec.clone();
            spec.linkage.assembly = assembly;
            MultiLinkage::new(spec).is_ok()
        };
        let modes = linkage.structure();
        of(
            body.object,
            modes.assembly_modes(&spec.linkage.assembly, &assembles),
        )
    });
    let parts = model.objects.iter();
    let short = parts.filter_map(|part| {
        let (name, branch) = short_form_law(model, part)?.position.branch()?;
        let (own, other) = match branch < 0.0 {
            true => ('-', '+'),
            false => ('+', '-'),
        };
        Some(format!(
            "`{}`: the {name} is assembled on branch {own}; the other: \"{name}\": {{ …, \
             \"branch\": \"{other}\" }}",
            part.id
        ))
    });
    single.chain(multi).chain(short).collect()
}

/// The law of an object that moves by the short form of a linkage.
fn short_form_law<'m>(model: &'m Model, part: &ObjectPart) -> Option<&'m Law> {
    let law = model.nodes[*part.nodes.first()?].motion.law()?;
    let linkage = matches!(
        law.position,
        Position::SliderCrank(_) | Position::FourBar(_) | Position::SlottedLink(_)
    );
    linkage.then_some(law)
}

/// Displacement of a node at the start, every mass on its law.
pub(super) fn start_of(model: &Model, node: NodeIndex) -> f64 {
    match &model.nodes[node].motion {
        NodeMotion::Prescribed { motion, .. } => {
            motion.jet(motion.breaks().segment_at(0.0, 1.0), 0.0).value
        }
        NodeMotion::Rotor { angle, .. } => *angle,
        NodeMotion::Mass { law } | NodeMotion::Rigid { law } => {
            let driver = start_of(model, law.driver);
            let segment = law.position.breaks().segment_at(driver, 1.0);
            law.lever * law.position.jet(segment, driver).value
        }
        NodeMotion::Constrained {
            drivers,
            constraint,
        } => {
            let starts: Vec<f64> = drivers.iter().map(|&d| start_of(model, d)).collect();
            constraint.value(&starts)
        }
    }
}

/// The linkage of a short form that stands at `start`. Where its links are just
/// in line there, it is put together beside that place.
fn assembled(position: &Position, start: f64) -> Result<Linkage, Vec<Fault>> {
    let at = |phi: f64| {
        let within = position.reach_from(phi).is_ok();
        let spec = position.as_linkage(phi).filter(|_| within);
        let missing = || {
            vec![Fault::new(
                "",
                "it is outside the range of motion at the start",
                "",
            )]
        };
        Linkage::new(spec.ok_or_else(missing)?)
    };
    let reach = position.reach_from(start).ok().flatten();
    let aside = reach.map_or(0.1, |(from, to)| 1e-3 * (to - from));
    let linkage = at(start).or_else(|faults| {
        let beside = at(start + aside).or_else(|_| at(start - aside));
        beside.map_err(|_| faults)
    })?;
    match reach {
        Some(reach) => limited_to_short_form(linkage, reach),
        None => Ok(linkage),
    }
}

/// Keeps a linkage within the reach of its short form, which does not pass a
/// position where all links are in line.
fn limited_to_short_form(linkage: Linkage, (from, to): (f64, f64)) -> Result<Linkage, Vec<Fault>> {
    let [lower, upper] = linkage.range().ends();
    let room = 1e-6 * (to - from);
    if lower >= from - room && upper <= to + room {
        return Ok(linkage);
    }
    let mut spec = linkage.spec().clone();
    spec.travel = Some([from, to]);
    Linkage::new(spec)
}

/// The linkage with this id, or the only one.
///
/// # Errors
/// There is none, or more than one and no id; in words.
pub fn linkage_of<'m>(model: &'m Model, id: Option<&str>) -> Result<&'m LinkageBody, String> {
    let name = |body: &LinkageBody| model.objects[body.object].id.as_str();
    let found = match id {
        Some(id) => model.linkages.iter().find(|body| name(body) == id),
        None => model.linkages.first().filter(|_| model.linkages.len() == 1),
    };
    if let Some(body) = found {
        return Ok(body);
    }
    if let Some(part) = shorts(model).find(|part| id.is_none_or(|id| part.id == id)) {
        return Err(format!(
            "`{}` moves by a position function, which has no pairs that could carry forces; write \
             it as a linkage, as with \"from\": \"linkage/slider-crank\"",
            part.id
        ));
    }
    let mut several = model.multi_linkages.iter();
    let several = several.find(|body| {
        let own = &model.objects[body.object].id;
        id.is_none_or(|id| id == own)
    });
    if let Some(body) = several {
        return Err(format!(
            "`{}` has several inputs: forces are worked out for linkages of one; `dam run` moves \
             it",
            model.objects[body.object].id
        ));
    }
    let names = model.linkages.iter().map(name);
    Err(match (id, model.linkages.is_empty()) {
        (_, true) => "the scene has no object of kind `linkage`, and none whose `position` is the \
                      short form of one (`slider_crank`, `four_bar`, `slotted_link`)"
            .to_owned(),
        (None, false) => say_which(names),
        (Some(id), false) => {
            let names = names.chain(shorts(model).map(|part| part.id.as_str()));
            let names: Vec<&str> = names.collect();
            format!(
                "`{id}` is no linkage of the scene; one of {}",
                names.join(", ")
            )
        }
    })
}

fn say_which<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<&str> = names.collect();
    format!(
        "the scene has several linkages: say which by --object ({})",
        names.join(", ")
    )
}
