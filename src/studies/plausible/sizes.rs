//! Stiffnesses and masses out of proportion to what is beside them, speeds beyond sense.

use super::node_path::NodePath;
use super::number_text;
use crate::dynamics::model::{Coordinate, Link, Model, NodeMotion, ObjectPart};

/// From which factor on a stiffness, reduced to the motion of its neighbours, is
/// called out of proportion: machines have some hundreds, mm for m makes a thousand
/// and more. An inertia may be smaller than a flywheel's by more than that.
const STIFFNESS_OUT_OF_PROPORTION: f64 = 1e4;
const INERTIA_OUT_OF_PROPORTION: f64 = 1e5;

/// The same between links and masses of one chain, which are pieces of one body.
const OUT_OF_PROPORTION_WITHIN: f64 = 1e3;

/// The square of an object's own frequency, of that of its motion, below which it
/// does not follow its law at all.
const TOO_SOFT: f64 = 1e-3;

/// Speeds of turning (rad/s, some 190 000 rpm) and of sliding (m/s, the speed of
/// sound) beyond which no mechanism works.
const FASTEST_TURNING: f64 = 2e4;
const FASTEST_SLIDING: f64 = 340.0;

/// Objects whose stiffness or inertia differs from that of every neighbour, and
/// chains with such links or masses; a motor may be taken to turn evenly.
pub(super) fn out_of_proportion(model: &Model, ways: &[Option<NodePath>]) -> Vec<String> {
    let beside = neighbours(model);
    let sizes = [Size::Stiffness, Size::Inertia];
    let odd = sizes.map(|size| outliers(model, ways, &beside, size));
    let mut found = Vec::new();
    for (index, part) in model.objects.iter().enumerate() {
        found.extend(chain_figures(model, part));
        for (size, odd) in sizes.into_iter().zip(&odd) {
            found.extend(odd[index].map(|odd| outlier_warning(model, index, odd, size)));
        }
    }
    found
}

/// For every object those that drive it and that it drives.
fn neighbours(model: &Model) -> Vec<Vec<usize>> {
    let objects = 0..model.objects.len();
    let beside = |index: usize| {
        let part = &model.objects[index];
        let others = objects.clone().filter(move |&other| {
            part.is_driven_by(other) || model.objects[other].is_driven_by(index)
        });
        others.collect()
    };
    objects.clone().map(beside).collect()
}

/// The links of an object without the one that its contact element is, or is part of:
/// that may be of any stiffness.
fn own_links(part: &ObjectPart) -> impl Iterator<Item = &usize> {
    let contact = part.contact.map(|contact| contact.link);
    (part.links.iter()).filter(move |&&link| Some(link) != contact)
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Size {
    Stiffness,
    Inertia,
}

impl Size {
    /// Stiffness of the links in series, inertia of all masses; `None` where there is none.
    fn of(self, model: &Model, part: &ObjectPart) -> Option<f64> {
        let size = match self {
            Self::Stiffness => {
                let compliance = |&link: &usize| 1.0 / model.links[link].stiffness;
                1.0 / own_links(part).map(compliance).sum::<f64>()
            }
            Self::Inertia => {
                let inertia = |&node: &usize| model.nodes[node].inertia;
                part.nodes.iter().map(inertia).sum()
            }
        };
        (size.is_finite() && size > 0.0).then_some(size)
    }

    fn out_of_proportion(self) -> f64 {
        match self {
            Self::Stiffness => STIFFNESS_OUT_OF_PROPORTION,
            Self::Inertia => INERTIA_OUT_OF_PROPORTION,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Stiffness => "stiffness",
            Self::Inertia => "inertia",
        }
    }

    fn unit(self, coordinate: Coordinate) -> &'static str {
        match (self, coordinate) {
            (Self::Stiffness, Coordinate::Turning) => "N m/rad",
            (Self::Stiffness, Coordinate::Sliding) => "N/m",
            (Self::Inertia, Coordinate::Turning) => "kg m²",
            (Self::Inertia, Coordinate::Sliding) => "kg",
        }
    }
}

/// A size with the square of the greatest speed of its object: their product is what it
/// amounts to, at most, on any coordinate of the mechanism. (Not the mean: of a law
/// that rests for most of a turn, and of a motion that is looked at near a rest, it
/// would tell of the rest.)
fn reduced_size(
    model: &Model,
    ways: &[Option<NodePath>],
    part: &ObjectPart,
    size: Size,
) -> Option<f64> {
    let way = ways[*part.nodes.last()?].as_ref()?;
    let all = size.of(model, part)? * way.fastest * way.fastest;
    (all.is_finite() && all > 0.0).then_some(all)
}

/// An object that is out of proportion: the neighbour that it is nearest to, and how
/// many times as great it is, both taken on one motion.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Odd {
    neighbour: usize,
    ratio: f64,
}

/// The objects that are out of proportion to all their neighbours, and to one side; of
/// two such neighbours the one that differs from more of its own, or the driven one.
fn outliers(
    model: &Model,
    ways: &[Option<NodePath>],
    beside: &[Vec<usize>],
    size: Size,
) -> Vec<Option<Odd>> {
    let parts = model.objects.iter();
    let reduced: Vec<Option<f64>> = parts
        .map(|part| reduced_size(model, ways, part, size))
        .collect();
    let ratios = |index: usize| -> Vec<Odd> {
        let others = beside[index].iter();
        let ratio = |&neighbour: &usize| {
            let ratio = reduced[index]? / reduced[neighbour]?;
            Some(Odd { neighbour, ratio })
        };
        others.filter_map(ratio).collect()
    };
    let all: Vec<Vec<Odd>> = (0..beside.len()).map(ratios).collect();
    let odd: Vec<Option<Odd>> = all
        .iter()
        .map(|ratios| nearest_outlier(ratios, size))
        .collect();
    let named = |index: usize| {
        let is_other = |other: &Odd| {
            let driven = model.objects[other.neighbour].is_driven_by(index);
            let (own, its) = (all[index].len(), all[other.neighbour].len());
            odd[other.neighbour].is_some() && (its > own || its == own && driven)
        };
        odd[index].filter(|_| !all[index].iter().any(is_other))
    };
    (0..beside.len()).map(named).collect()
}

/// The neighbour that an object is nearest to, where it is far from all, to one side.
fn nearest_outlier(ratios: &[Odd], size: Size) -> Option<Odd> {
    let distance = |odd: &&Odd| odd.ratio.ln().abs();
    let nearest = (ratios.iter()).min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    let one_side = (ratios.iter()).all(|other| (other.ratio > 1.0) == (nearest.ratio > 1.0));
    let far = nearest.ratio.max(1.0 / nearest.ratio) >= size.out_of_proportion();
    (one_side && far).then_some(*nearest)
}

fn outlier_warning(
    model: &Model,
    index: usize,
    Odd { neighbour, ratio }: Odd,
    size: Size,
) -> String {
    let (part, neighbour) = (&model.objects[index], &model.objects[neighbour]);
    let (times, than) = match ratio > 1.0 {
        true => (ratio, "times"),
        false => (1.0 / ratio, "times less than"),
    };
    let value = |part: &ObjectPart| {
        let value = size.of(model, part).map_or_else(String::new, number_text);
        format!("{value} {}", size.unit(part.coordinate))
    };
    format!(
        "the {name} of `{id}`, {own}, is 10^{power:.0} {than} that of `{other}` beside it, {theirs}, \
         both taken on one motion: is one of them in another unit?",
        name = size.name(),
        id = part.id,
        own = value(part),
        power = times.log10(),
        other = neighbour.id,
        theirs = value(neighbour),
    )
}

/// Links and masses of one chain.
fn chain_figures(model: &Model, part: &ObjectPart) -> Vec<String> {
    let stiffness = |&link: &usize| {
        let Link { stiffness, .. } = model.links[link];
        stiffness
    };
    let stiffnesses: Vec<f64> = own_links(part).map(stiffness).collect();
    let inertia = |&node: &usize| model.nodes[node].inertia;
    let inertias: Vec<f64> = match part.links.is_empty() {
        true => Vec::new(),
        false => part.nodes.iter().map(inertia).collect(),
    };
    let mut found = Vec::new();
    for (what, sizes, unit) in [
        ("link", stiffnesses, Size::Stiffness.unit(part.coordinate)),
        ("mass", inertias, Size::Inertia.unit(part.coordinate)),
    ] {
        let Some(at) = first_outlier(&sizes) else {
            continue;
        };
        let beside = if at > 0 { at - 1 } else { at + 1 };
        found.push(format!(
            "{what} {} of `{}` has {} {unit} and {what} {} beside it {} {unit}: is one of them in \
             another unit?",
            at + 1,
            part.id,
            number_text(sizes[at]),
            beside + 1,
            number_text(sizes[beside]),
        ));
    }
    found
}

/// The first of a row that differs from both beside it.
fn first_outlier(sizes: &[f64]) -> Option<usize> {
    let far = |a: f64, b: f64| (a / b).max(b / a) >= OUT_OF_PROPORTION_WITHIN;
    (0..sizes.len()).find(|&at| {
        let before = at.checked_sub(1).map(|before| sizes[before]);
        let after = sizes.get(at + 1).copied();
        let beside: Vec<f64> = before.into_iter().chain(after).collect();
        !beside.is_empty() && beside.iter().all(|&other| far(sizes[at], other))
    })
}

/// An object whose own vibration is slower by orders of magnitude than the motion
/// that it is to follow.
fn too_soft(model: &Model, ways: &[Option<NodePath>], part: &ObjectPart) -> Option<String> {
    let way = ways[*part.nodes.last()?].as_ref()?;
    let stiffness = Size::Stiffness
        .of(model, part)
        .filter(|_| !part.links.is_empty())?;
    let own = stiffness / Size::Inertia.of(model, part)?;
    let motion = way.mean_square_acceleration / way.mean_square_speed;
    let soft = motion.is_finite() && own < TOO_SOFT * motion;
    soft.then(|| {
        let hertz = |square: f64| number_text(square.sqrt() / std::f64::consts::TAU);
        format!(
            "`{}` does not follow its law. Its natural frequency of some {} Hz is orders of \
             magnitude below that of its motion, some {} Hz. Check its stiffness, {} {}, and \
             inertia, {} {}",
            part.id,
            hertz(own),
            hertz(motion),
            number_text(stiffness),
            Size::Stiffness.unit(part.coordinate),
            Size::Inertia
                .of(model, part)
                .map_or_else(String::new, number_text),
            Size::Inertia.unit(part.coordinate),
        )
    })
}

/// Objects that cannot follow their law at all.
pub(super) fn unable_to_follow(model: &Model, ways: &[Option<NodePath>]) -> Vec<String> {
    let objects = model.objects.iter();
    objects
        .filter_map(|part| too_soft(model, ways, part))
        .collect()
}

/// Objects that turn or slide faster than anything does.
pub(super) fn beyond_sense(model: &Model, ways: &[Option<NodePath>]) -> Vec<String> {
    let told =
        |part: &ObjectPart| {
            let node = *part.nodes.last()?;
            let speed = match &ways[node] {
                Some(way) => way.fastest,
                None => motor_speed(model, node)?,
            };
            let (limit, unit) = match part.coordinate {
                Coordinate::Turning => (FASTEST_TURNING, "rad/s"),
                Coordinate::Sliding => (FASTEST_SLIDING, "m/s"),
            };
            // What merely follows says nothing new: the first on the way is named.
            let driver = part.driver().map(|driver| &model.objects[driver]);
            let driver_too = driver.is_some_and(|driver| {
                driver.coordinate == part.coordinate
                    && driver.nodes.last().is_some_and(|&node| {
                        ways[node].as_ref().is_some_and(|way| way.fastest > limit)
                    })
            });
            (speed > limit && !driver_too).then(|| {
            let rpm = match part.coordinate {
                Coordinate::Turning => {
                    format!(" ({} rpm)", number_text(speed * 60.0 / std::f64::consts::TAU))
                }
                Coordinate::Sliding => String::new(),
            };
            format!(
                "`{}` reaches {} {unit}{rpm}: no mechanism moves as fast; check the unit of the \
                 speed",
                part.id,
                number_text(speed)
            )
        })
        };
    model.objects.iter().filter_map(told).collect()
}

/// The greatest speed that a motor's rotor starts with or is made for.
fn motor_speed(model: &Model, node: usize) -> Option<f64> {
    let NodeMotion::Rotor { speed, .. } = model.nodes[node].motion else {
        return None;
    };
    let own = model.loads.iter().filter(|load| load.node == node);
    let made_for = own.map(|load| load.law.running_speed().unwrap_or(0.0));
    Some(made_for.fold(speed.abs(), f64::max))
}
