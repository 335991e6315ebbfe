//! Checks of the plain numbers of a linkage, all at once.

use super::choice::number_text;
use super::couplings;
use super::spec::{
    AssemblyChoice, ForceLaw, LinkageSpec, OutputKind, PairKind, PairSpec, PointOf, RedundantPart,
};
use super::welds;
use crate::fault::{Fault, Faults};

/// Most links: what is dense in their number (a larger group, the equations of all
/// forces) still fits into the memory and is factorised within a second.
const MOST_LINKS: usize = 500;
/// Longest distance of a point from its frame (m), so that squares stay numbers.
const FARTHEST: f64 = 1e9;
/// Least size of a whole linkage (m), so that squares stay numbers.
const SMALLEST: f64 = 1e-9;

/// Everything wrong with the numbers of a linkage, each taken for itself.
pub(super) fn check(spec: &LinkageSpec) -> Result<(), Vec<Fault>> {
    let mut faults = Faults::default();
    let found = &mut faults;
    if spec.links.is_empty() {
        found.add(
            "links",
            "there are no links",
            "give at least the driven link",
        );
    }
    if spec.links.len() > MOST_LINKS {
        let message = format!("{} links are too many", spec.links.len());
        found.add("links", message, &format!("at most {MOST_LINKS}"));
    }
    names(found, "links", spec.links.iter().map(|link| &link.name));
    let welds = spec.welds.iter().map(|weld| &weld.name);
    names(
        found,
        "pairs",
        spec.pairs.iter().map(|pair| &pair.name).chain(welds),
    );
    for point in &spec.ground {
        check_point(found, &format!("ground.{}", point.name), point.at);
    }
    links(spec, found);
    for pair in &spec.pairs {
        self::pair(spec, pair, found);
    }
    for weld in &spec.welds {
        for (end, at) in [("on", &weld.on), ("link", &weld.link)] {
            self::point(spec, &format!("pairs.{}.{end}", weld.name), at, found);
        }
    }
    welds::check(spec, found);
    names(
        found,
        "couplings",
        spec.couplings.iter().map(|coupling| &coupling.name),
    );
    couplings::check(spec, found);
    for one in &spec.redundant {
        index(found, "redundant", one.pair, spec.pairs.len(), "pair");
        if let RedundantPart::Along(link) = one.part {
            index(found, "redundant", link, spec.links.len(), "link");
        }
    }
    match spec.pairs.get(spec.driver) {
        Some(_) => {}
        None => found.add("driver", "there is no such pair", "name one of the pairs"),
    }
    extent(spec, found);
    assembly(spec, found);
    found.finite("start", spec.start);
    moderate(found, "start", spec.start);
    if let Some([from, to]) = spec.travel
        && !(from <= spec.start && spec.start <= to && from < to)
    {
        let message = format!("{from} to {to} does not hold the start, {}", spec.start);
        found.add(
            "travel",
            message,
            "give the lower limit and the upper, the start between them",
        );
    }
    check_point(found, "gravity", spec.gravity);
    for force in &spec.forces {
        law(spec, &format!("forces.{}", force.name), &force.law, found);
    }
    for output in &spec.outputs {
        let path = format!("outputs.{}", output.name);
        match output.kind {
            OutputKind::Angle { link } => index(found, &path, link, spec.links.len(), "link"),
            OutputKind::Pair { pair } => index(found, &path, pair, spec.pairs.len(), "pair"),
            OutputKind::Point { point, direction } => {
                self::point(spec, &path, &point, found);
                found.finite(&format!("{path}.direction"), direction);
            }
        }
    }
    faults.check()
}

fn names<'a>(found: &mut Faults, list: &str, names: impl Iterator<Item = &'a String>) {
    let mut seen: Vec<&String> = Vec::new();
    for name in names {
        if seen.contains(&name) {
            let message = format!("`{name}` stands twice");
            found.add(
                format!("{list}.{name}"),
                message,
                "give every one a name of its own",
            );
        }
        seen.push(name);
    }
}

fn links(spec: &LinkageSpec, found: &mut Faults) {
    for link in &spec.links {
        let path = format!("links.{}", link.name);
        found.not_negative(&format!("{path}.mass"), link.mass);
        found.not_negative(&format!("{path}.moment"), link.moment);
        check_point(found, &format!("{path}.centre"), link.centre);
        for point in &link.points {
            check_point(found, &format!("{path}.points.{}", point.name), point.at);
        }
    }
}

fn check_point(found: &mut Faults, path: &str, at: [f64; 2]) {
    for (k, &coordinate) in at.iter().enumerate() {
        if !(coordinate.abs() <= FARTHEST) {
            let message = format!(
                "{} is not a finite number below {FARTHEST:e}",
                number_text(coordinate)
            );
            found.add(format!("{path}[{k}]"), message, "");
        }
    }
}

/// Requires that a finite number is not too great for what is done with it.
fn moderate(found: &mut Faults, path: &str, value: f64) {
    if value.is_finite() && value.abs() > FARTHEST {
        found.add(
            path,
            format!("{} is above {FARTHEST:e}", number_text(value)),
            "",
        );
    }
}

/// Requires that the linkage is no mere point.
fn extent(spec: &LinkageSpec, found: &mut Faults) {
    let ends = spec
        .pairs
        .iter()
        .flat_map(|pair| [pair.on.at, pair.link.at]);
    let largest = ends.flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
    if largest > 0.0 && largest < SMALLEST {
        let message = format!(
            "all points of the pairs lie within {} m",
            number_text(largest)
        );
        let hint = "give the lengths in metres, or with their unit";
        found.add("links", message, hint);
    }
}

fn index(found: &mut Faults, path: &str, index: usize, count: usize, what: &str) {
    if index >= count {
        found.add(path, format!("there is no {what} number {index}"), "");
    }
}

fn point(spec: &LinkageSpec, path: &str, point: &PointOf, found: &mut Faults) {
    if let Some(link) = point.link {
        index(found, path, link, spec.links.len(), "link");
    }
    check_point(found, path, point.at);
}

fn pair(spec: &LinkageSpec, pair: &PairSpec, found: &mut Faults) {
    let path = format!("pairs.{}", pair.name);
    point(spec, &format!("{path}.on"), &pair.on, found);
    point(spec, &format!("{path}.link"), &pair.link, found);
    if pair.on.link == pair.link.link {
        let message = "it joins a link to itself";
        found.add(
            path.as_str(),
            message,
            "name two different links, or a link and the ground",
        );
    }
    found.not_negative(&format!("{path}.friction"), pair.friction);
    match pair.kind {
        PairKind::Revolute { diameter } => {
            found.not_negative(&format!("{path}.diameter"), diameter);
            moderate(found, &format!("{path}.diameter"), diameter);
        }
        PairKind::Sliding {
            direction,
            angle,
            corners,
            half_height,
        } => {
            found.finite(&format!("{path}.direction"), direction);
            found.finite(&format!("{path}.angle"), angle);
            found.not_negative(&format!("{path}.half_height"), half_height);
            moderate(found, &format!("{path}.half_height"), half_height);
            check_point(found, &format!("{path}.corners"), corners);
            if corners[0] < corners[1] {
                let message = format!("{} lies behind {}", corners[0], corners[1]);
                found.add(
                    format!("{path}.corners"),
                    message,
                    "give the corner ahead along the guide first, then the one behind",
                );
            }
        }
    }
}

fn assembly(spec: &LinkageSpec, found: &mut Faults) {
    for choice in &spec.assembly {
        let Some(link) = spec.links.get(choice.link) else {
            index(found, "assembly", choice.link, spec.links.len(), "link");
            continue;
        };
        let path = format!("links.{}", link.name);
        match choice.choice {
            AssemblyChoice::Branch(sign) if sign.abs() != 1.0 => {
                let message = format!("{sign} names no branch");
                found.add(format!("{path}.branch"), message, "give + or -");
            }
            AssemblyChoice::Branch(_) => {}
            AssemblyChoice::Angle(angle) => found.finite(&format!("{path}.angle"), angle),
            AssemblyChoice::Near { point, place: at } => {
                check_point(found, &format!("{path}.point"), point);
                check_point(found, &format!("{path}.near"), at);
            }
        }
    }
}

fn law(spec: &LinkageSpec, path: &str, law: &ForceLaw, found: &mut Faults) {
    let under = |name: &str| format!("{path}.{name}");
    match law {
        ForceLaw::Strut {
            from,
            to,
            rate,
            free_length,
            damping,
            force,
        } => {
            point(spec, &under("from"), from, found);
            point(spec, &under("to"), to, found);
            found.not_negative(&under("rate"), *rate);
            found.not_negative(&under("free_length"), *free_length);
            found.not_negative(&under("damping"), *damping);
            found.finite(&under("force"), *force);
            if from.link == to.link {
                found.add(
                    path,
                    "both its ends are on the same link",
                    "join two different links",
                );
            }
        }
        ForceLaw::Force {
            point: at, force, ..
        } => {
            point(spec, &under("point"), at, found);
            found.finite(&under("force[0]"), force[0]);
            found.finite(&under("force[1]"), force[1]);
        }
        ForceLaw::Couple { link, couple } => {
            index(found, &under("link"), *link, spec.links.len(), "link");
            found.finite(&under("couple"), *couple);
        }
        ForceLaw::Torsion {
            pair,
            rate,
            free_angle,
            damping,
        } => {
            index(found, &under("pair"), *pair, spec.pairs.len(), "pair");
            if spec.pairs.get(*pair).is_some_and(super::elements::slides) {
                let hint = "name a revolute pair, or put a strut between two points";
                found.add(
                    under("pair"),
                    "a torsion spring cannot sit in a sliding pair",
                    hint,
                );
            }
            found.not_negative(&under("rate"), *rate);
            found.finite(&under("free_angle"), *free_angle);
            found.not_negative(&under("damping"), *damping);
        }
        ForceLaw::CoupleTable {
            link,
            points,
            period,
        } => {
            index(found, &under("link"), *link, spec.links.len(), "link");
            over_input(path, points, *period, found);
        }
        ForceLaw::Table {
            point: at,
            direction,
            points,
            period,
        } => {
            point(spec, &under("point"), at, found);
            found.finite(&under("direction"), *direction);
            over_input(path, points, *period, found);
        }
    }
}

/// A table over the input coordinate, repeated or not.
fn over_input(path: &str, points: &[(f64, f64)], period: Option<f64>, found: &mut Faults) {
    found.points(&format!("{path}.points"), points, 1);
    let Some(period) = period else { return };
    let path = format!("{path}.period");
    found.positive(&path, period);
    let width = points.last().map_or(0.0, |last| last.0 - points[0].0);
    if width > period {
        let message = format!("the points extend over {width}, the period is {period}");
        found.add(path, message, "give points of one period only");
    }
}
