//! Links that hold what is held already: parallel rods.
//!
//! A rod between two pins of other links whose distance never changes binds nothing. By the count of
//! degrees of freedom the linkage is rigid, though it moves; which part of the forces such a rod
//! takes follows from its elasticity alone, so that it is refused, by its name.

use super::Linkage;
use super::spec::{AssemblySpec, LinkageSpec, PointOf};

/// Most rods that are left out together.
const MOST_RODS: usize = 3;
/// Most links that are tried.
const MOST_TRIED: usize = 40;
/// Positions at which the distance of the pins is looked at.
const POSITIONS: usize = 25;
/// Change of the distance, in sizes of the linkage, that is rounding.
const CONSTANT: f64 = 1e-9;

/// The rods of a linkage that bind nothing, indices into its links; `None` where leaving out no few of
/// them gives a linkage that moves as they do.
pub(super) fn parallel_rods(spec: &LinkageSpec, candidates: &[usize]) -> Option<Vec<usize>> {
    let missing = 1 - super::structure::mobility(spec);
    // A rod with its two pins takes one degree of freedom away.
    let rods = usize::try_from(missing).ok()?;
    if rods == 0 || rods > MOST_RODS {
        return None;
    }
    let candidates: Vec<usize> = candidates.iter().copied().take(MOST_TRIED).collect();
    left_out(spec, &candidates, rods, &mut Vec::new())
}

/// Tries to leave out `count` more rods besides those in `chosen`.
fn left_out(
    spec: &LinkageSpec,
    candidates: &[usize],
    count: usize,
    chosen: &mut Vec<usize>,
) -> Option<Vec<usize>> {
    if count == 0 {
        return binds_nothing(spec, chosen).then(|| chosen.clone());
    }
    // The last ones first: the rods that were there before stay.
    for (index, &link) in candidates.iter().enumerate().rev() {
        if pins(spec, link).is_some() {
            chosen.push(link);
            let found = left_out(spec, &candidates[..index], count - 1, chosen);
            chosen.pop();
            if found.is_some() {
                return found;
            }
        }
    }
    None
}

/// Both ends of a link that hangs on two pins only: its own points and those they are
/// pinned to.
fn pins(spec: &LinkageSpec, link: usize) -> Option<[[PointOf; 2]; 2]> {
    let mut ends = Vec::new();
    for (index, pair) in spec.pairs.iter().enumerate() {
        let sides = [pair.on, pair.link];
        if let Some(own) = sides.iter().position(|side| side.link == Some(link)) {
            if pair.slides() || index == spec.driver {
                return None;
            }
            ends.push([sides[own], sides[1 - own]]);
        }
    }
    ends.try_into().ok()
}

/// Without the rods the linkage moves, and the distances of their pins never change.
fn binds_nothing(spec: &LinkageSpec, rods: &[usize]) -> bool {
    let Some(ends) = rods
        .iter()
        .map(|&rod| pins(spec, rod))
        .collect::<Option<Vec<_>>>()
    else {
        return false;
    };
    if rods
        .iter()
        .any(|rod| ends.iter().flatten().any(|end| end[1].link == Some(*rod)))
    {
        return false;
    }
    let Ok(rest) = Linkage::new(without(spec, rods)) else {
        return false;
    };
    let range = rest.range();
    let [from, to] = match range.period {
        Some(period) => [range.start, range.start + period.length],
        None => range.ends(),
    };
    let mut workspace = rest.workspace();
    (0..POSITIONS).all(|k| {
        let q = from + (to - from) * (k as f64 + 0.5) / POSITIONS as f64;
        rest.solve(q, 0, &mut workspace).is_ok()
            && ends.iter().all(|ends| {
                let places = ends.map(|[_, pinned]| {
                    let link = pinned.link.map(|link| renumbered(link, rods));
                    let point = PointOf { link, ..pinned };
                    workspace.point(point).map(|jet| jet.value)
                });
                let length = distance(ends[0][0].at, ends[1][0].at);
                let apart = distance(places[0], places[1]);
                (apart - length).abs() <= CONSTANT * rest.size()
            })
    })
}

fn distance(one: [f64; 2], other: [f64; 2]) -> f64 {
    (one[0] - other[0]).hypot(one[1] - other[1])
}

/// Number of a link when some are left out.
fn renumbered(link: usize, left_out: &[usize]) -> usize {
    link - left_out.iter().filter(|&&gone| gone < link).count()
}

/// The linkage without some links and their pairs, without forces and outputs.
fn without(spec: &LinkageSpec, rods: &[usize]) -> LinkageSpec {
    let gone = |link: Option<usize>| link.is_some_and(|link| rods.contains(&link));
    let moved = |point: PointOf| PointOf {
        link: point.link.map(|link| renumbered(link, rods)),
        ..point
    };
    let stays = |index: &usize| {
        let pair = &spec.pairs[*index];
        !gone(pair.on.link) && !gone(pair.link.link)
    };
    let kept: Vec<usize> = (0..spec.pairs.len()).filter(stays).collect();
    let pairs = kept.iter().map(|&index| {
        let mut pair = spec.pairs[index].clone();
        (pair.on, pair.link) = (moved(pair.on), moved(pair.link));
        pair
    });
    let links = spec.links.iter().enumerate();
    let assembly = spec.assembly.iter();
    LinkageSpec {
        links: links
            .filter(|(link, _)| !rods.contains(link))
            .map(|(_, link)| link.clone())
            .collect(),
        ground: spec.ground.clone(),
        pairs: pairs.collect(),
        driver: kept
            .iter()
            .position(|&index| index == spec.driver)
            .unwrap_or(0),
        assembly: assembly
            .filter(|choice| !rods.contains(&choice.link))
            .map(|choice| AssemblySpec {
                link: renumbered(choice.link, rods),
                choice: choice.choice,
            })
            .collect(),
        start: spec.start,
        travel: spec.travel,
        ..LinkageSpec::default()
    }
}
