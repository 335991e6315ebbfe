//! Inputs that a linkage lacks, as text that can be pasted.
//!
//! From the ground outwards pairs are taken as inputs, the nearest to it first and these by their
//! names, as long as nothing is held more than once. A part that nothing joins to the ground gets x, y
//! and angle of one of its links. Where that can be put together, the rates of all pairs by these
//! coordinates are known: with others the linkage may be much farther from a singular position. Those
//! are taken that span the greatest volume (elimination with the greatest row first).
//!
//! A proposal is not applied by itself, for three reasons. Which inputs are best depends on
//! numbers, and the names of columns must not. Where a free coordinate starts is known to the
//! author of the scene. An input that is absent may be forgotten.

use super::compile;
use super::spec::{InputCoordinate, InputSpec, MultiSpec};
use super::welded::WeldedLinkage;
use super::{MultiLinkage, MultiMotion, wrong};
use crate::fault::{Fault, Faults};
use crate::kinematics::linkage::spec::{AssemblyChoice, LinkageSpec, OutputKind, PointOf};
use crate::kinematics::linkage::structure::{explanation, mobility};
use crate::math::jet::Jet;
use crate::units::shown;
use std::f64::consts::TAU;

/// Others are proposed where they span this much more than those nearest to the ground.
const CLEARLY_BETTER: f64 = 3.0;

/// A linkage with the inputs that it lacks behind its own.
struct CompletedLinkage {
    spec: MultiSpec,
    /// Number of inputs that it had.
    own: usize,
}

/// What could stand in `inputs` beside what is there, for as many coordinates as are free; `None`
/// where none are, or no choice is found.
pub fn proposal(spec: &MultiSpec) -> Option<String> {
    let completed = completed(spec)?;
    let added = completed.spec.inputs[completed.own..].iter();
    let lines = added.map(|input| {
        let linkage = &completed.spec.linkage;
        let link = |link: usize| &linkage.links[link].name;
        let (what, of) = match input.coordinate {
            InputCoordinate::Pair(pair) => ("pair", &linkage.pairs[pair].name),
            InputCoordinate::X(own) => ("x", link(own)),
            InputCoordinate::Y(own) => ("y", link(own)),
            InputCoordinate::Angle(own) => ("angle", link(own)),
        };
        let start = match (input.coordinate.slides(linkage), input.start) {
            (_, 0.0) => String::new(),
            (true, start) => format!(r#", "start": "{} m""#, shown(start, 6)),
            (false, start) => format!(r#", "start": "{} deg""#, shown(start.to_degrees(), 6)),
        };
        format!(r#""{}": {{ "{what}": "{of}"{start} }}"#, input.name)
    });
    Some(lines.collect::<Vec<_>>().join(", "))
}

/// The count of the degrees of freedom, in words.
pub fn freedom(linkage: &LinkageSpec) -> String {
    explanation(linkage)
}

/// Adds a proposal to what is said of too few inputs.
pub(super) fn hinted(spec: &MultiSpec, mut faults: Vec<Fault>) -> Vec<Fault> {
    let few = faults.iter_mut().find(|fault| fault.path == "inputs");
    if let Some((fault, proposed)) = few.zip(proposal(spec)) {
        fault.hint.push_str(&format!(
            "; it would do with {proposed}, each with the `object` that moves it, or free"
        ));
    }
    faults
}

/// The linkage with all inputs.
fn completed(spec: &MultiSpec) -> Option<CompletedLinkage> {
    let own = spec.inputs.len();
    let wanted = usize::try_from(mobility(&spec.linkage)).ok()?;
    if wanted <= own {
        return None;
    }
    let mut faults = Faults::default();
    wrong::check_numbers(&spec.linkage, &mut faults);
    faults.check().ok()?;
    let mut all = spec.clone();
    float(&mut all, wanted);
    while all.inputs.len() < wanted {
        let last = all.inputs.len() + 1 == wanted;
        let next = pairs_outwards(&all).into_iter().find(|&pair| {
            let mut tried = all.clone();
            add(&mut tried, InputCoordinate::Pair(pair));
            let welded = WeldedLinkage::of(&tried);
            match last {
                true => compile::compile(&welded).is_ok(),
                false => !compile::is_overconstrained(&welded),
            }
        });
        add(&mut all, InputCoordinate::Pair(next?));
    }
    compile::compile(&WeldedLinkage::of(&all)).ok()?;
    for input in own..wanted {
        all.inputs[input].start = start(&all, all.inputs[input].coordinate);
    }
    let placed = MultiLinkage::new(all.clone()).ok();
    let better = placed
        .as_ref()
        .and_then(|linkage| better_conditioned_inputs(&all, linkage, own));
    Some(CompletedLinkage {
        spec: better.unwrap_or(all),
        own,
    })
}

/// Adds an input with a name that nothing has.
fn add(spec: &mut MultiSpec, coordinate: InputCoordinate) {
    let linkage = &spec.linkage;
    let link = |link: usize| &linkage.links[link].name;
    let wanted = match coordinate {
        InputCoordinate::Pair(pair) => linkage.pairs[pair].name.clone(),
        InputCoordinate::X(own) => format!("{}_x", link(own)),
        InputCoordinate::Y(own) => format!("{}_y", link(own)),
        InputCoordinate::Angle(own) => format!("{}_angle", link(own)),
    };
    let taken = |name: &String| {
        spec.inputs.iter().any(|input| input.name == *name)
            || linkage.outputs.iter().any(|output| output.name == *name)
    };
    let mut name = wanted.clone();
    let mut number = 2;
    while taken(&name) {
        name = format!("{wanted}_{number}");
        number += 1;
    }
    spec.inputs.push(InputSpec {
        name,
        coordinate,
        start: 0.0,
    });
}

/// Of every link by how many pairs it is away from the ground, or from a link that floats.
fn distances(spec: &MultiSpec) -> Vec<Option<usize>> {
    let linkage = &spec.linkage;
    let mut found: Vec<Option<usize>> = vec![None; linkage.links.len()];
    for input in &spec.inputs {
        if let Some(link) = input.coordinate.floating_link() {
            found[link] = Some(0);
        }
    }
    let pairs = linkage.pairs.iter().map(|pair| (pair.on, pair.link, 1));
    let welds = linkage.welds.iter().map(|weld| (weld.on, weld.link, 0));
    let ties: Vec<(PointOf, PointOf, usize)> = pairs.chain(welds).collect();
    let mut changed = true;
    while changed {
        changed = false;
        for &(one, other, way) in &ties {
            for (from, to) in [(one, other), (other, one)] {
                let here = from.link.map_or(Some(0), |link| found[link]);
                let (Some(here), Some(to)) = (here, to.link) else {
                    continue;
                };
                if found[to].is_none_or(|known| known > here + way) {
                    found[to] = Some(here + way);
                    changed = true;
                }
            }
        }
    }
    found
}

/// Lets one link of every part float that nothing joins to the ground: that of the most pairs, and
/// of these the first by its name.
fn float(spec: &mut MultiSpec, wanted: usize) {
    while spec.inputs.len() + 3 <= wanted {
        let away = distances(spec);
        let linkage = &spec.linkage;
        let pairs = |link: usize| {
            let ends = linkage.pairs.iter().flat_map(|pair| [&pair.on, &pair.link]);
            ends.filter(|end| end.link == Some(link)).count()
        };
        let loose = (0..linkage.links.len()).filter(|&link| away[link].is_none());
        let first = loose.min_by_key(|&link| {
            let name = &linkage.links[link].name;
            (std::cmp::Reverse(pairs(link)), name)
        });
        let Some(link) = first else { return };
        for coordinate in [
            InputCoordinate::X(link),
            InputCoordinate::Y(link),
            InputCoordinate::Angle(link),
        ] {
            add(spec, coordinate);
        }
    }
}

/// Pairs that are no inputs yet: those that lead on from what inputs place before all others, the
/// nearest to the ground first, and then by their names.
fn pairs_outwards(spec: &MultiSpec) -> Vec<usize> {
    let linkage = &spec.linkage;
    let away = distances(spec);
    let placed = compile::links_placed_by_inputs(&WeldedLinkage::of(spec));
    let taken = |pair: &usize| {
        let mut inputs = spec.inputs.iter();
        inputs.any(|input| input.coordinate == InputCoordinate::Pair(*pair))
    };
    let mut pairs: Vec<usize> = (0..linkage.pairs.len()).filter(|p| !taken(p)).collect();
    pairs.sort_by_key(|&pair| {
        let own = &linkage.pairs[pair];
        let ends = [own.on.link, own.link.link];
        let stands = ends.map(|link| link.is_none_or(|link| placed[link]));
        let far = ends.map(|link| link.map_or(Some(0), |link| away[link]));
        let nearest = far.into_iter().flatten().min();
        (stands[0] == stands[1], nearest, &own.name)
    });
    pairs
}

/// Where a coordinate starts as far as angles and places in `assembly` tell, else zero.
fn start(spec: &MultiSpec, coordinate: InputCoordinate) -> f64 {
    let linkage = &spec.linkage;
    let said = |link: usize| {
        let mut choices = linkage.assembly.iter();
        let one = choices.find(|choice| choice.link == link)?;
        Some(one.choice)
    };
    let angle = |link: Option<usize>| match link {
        None => Some(0.0),
        Some(link) => match said(link) {
            Some(AssemblyChoice::Angle(angle)) => Some(angle),
            _ => None,
        },
    };
    let place = |link: usize, axis: usize| match said(link) {
        Some(AssemblyChoice::Near { point, place }) => place[axis] - point[axis],
        _ => 0.0,
    };
    match coordinate {
        InputCoordinate::X(link) => place(link, 0),
        InputCoordinate::Y(link) => place(link, 1),
        InputCoordinate::Angle(link) => angle(Some(link)).unwrap_or(0.0),
        InputCoordinate::Pair(pair) => {
            let pair = &linkage.pairs[pair];
            match (angle(pair.on.link), angle(pair.link.link)) {
                (Some(on), Some(link)) if !pair.slides() => link - on,
                _ => 0.0,
            }
        }
    }
}

/// The same with other pairs as its further inputs, where these are clearly better conditioned at the
/// position at which it is put together.
fn better_conditioned_inputs(
    spec: &MultiSpec,
    linkage: &MultiLinkage,
    own: usize,
) -> Option<MultiSpec> {
    let exchanged: Vec<usize> = (own..spec.inputs.len())
        .filter(|&input| spec.inputs[input].coordinate.floating_link().is_none())
        .collect();
    let mut motion = MultiMotion::new(linkage);
    let still = |input: &InputSpec| Jet {
        value: input.start,
        ..Jet::default()
    };
    let inputs: Vec<Jet> = spec.inputs.iter().map(still).collect();
    motion.set_inputs(&inputs).ok()?;
    let candidates = possible_inputs(spec, own);
    let mut rows: Vec<Vec<f64>> = candidates
        .iter()
        .map(|&pair| {
            let mut first = vec![0.0; inputs.len()];
            motion.output_transfer(&OutputKind::Pair { pair }, &mut first);
            let unit = match spec.linkage.pairs[pair].slides() {
                true => linkage.typical_length(),
                false => 1.0,
            };
            let of = |&input: &usize| {
                let slides = spec.inputs[input].coordinate.slides(&spec.linkage);
                first[input] / unit
                    * if slides {
                        linkage.typical_length()
                    } else {
                        1.0
                    }
            };
            exchanged.iter().map(of).collect()
        })
        .collect();
    let (chosen, volume) = widest(&mut rows, exchanged.len())?;
    if !(volume > CLEARLY_BETTER) {
        return None;
    }
    let mut found = spec.clone();
    let kept = |input: &InputSpec| input.coordinate.floating_link().is_some();
    let mut index = 0;
    found.inputs.retain(|input| {
        index += 1;
        index <= own || kept(input)
    });
    for row in chosen {
        let pair = candidates[row];
        add(&mut found, InputCoordinate::Pair(pair));
        let value = motion.pair(pair).value;
        let start = match spec.linkage.pairs[pair].slides() {
            true => value,
            false => value - TAU * (value / TAU).round(),
        };
        if let Some(input) = found.inputs.last_mut() {
            input.start = start;
        }
    }
    MultiLinkage::new(found.clone()).ok().map(|_| found)
}

/// Pairs that may be inputs: those found first, then all others by their names.
fn possible_inputs(spec: &MultiSpec, own: usize) -> Vec<usize> {
    let of = |input: &InputSpec| match input.coordinate {
        InputCoordinate::Pair(pair) => Some(pair),
        _ => None,
    };
    let given: Vec<usize> = spec.inputs[..own].iter().filter_map(of).collect();
    let mut found: Vec<usize> = spec.inputs[own..].iter().filter_map(of).collect();
    let pairs = &spec.linkage.pairs;
    let mut others: Vec<usize> = (0..pairs.len())
        .filter(|pair| !given.contains(pair) && !found.contains(pair))
        .collect();
    others.sort_by_key(|&pair| &pairs[pair].name);
    found.extend(others);
    found
}

/// Rows that span the greatest volume, one after the other the one farthest from those before it, and
/// that volume; of rows as far the first. `None` where they span none.
fn widest(rows: &mut [Vec<f64>], count: usize) -> Option<(Vec<usize>, f64)> {
    /// Rows whose squares differ by less than this share are as far.
    const ALIKE: f64 = 1e-6;
    let (mut chosen, mut volume) = (Vec::new(), 1.0);
    for _ in 0..count {
        let square = |row: &[f64]| row.iter().map(|part| part * part).sum::<f64>();
        let mut most: Option<(usize, f64)> = None;
        for (index, row) in rows.iter().enumerate() {
            let own = square(row);
            let beyond = most.is_none_or(|(_, known)| own > known * (1.0 + ALIKE));
            if own > 0.0 && own.is_finite() && beyond {
                most = Some((index, own));
            }
        }
        let (index, length) = most?;
        volume *= length.sqrt();
        let along: Vec<f64> = rows[index]
            .iter()
            .map(|part| part / length.sqrt())
            .collect();
        for row in rows.iter_mut() {
            let share: f64 = row.iter().zip(&along).map(|(a, b)| a * b).sum();
            for (part, along) in row.iter_mut().zip(&along) {
                *part -= share * along;
            }
        }
        rows[index].fill(0.0);
        chosen.push(index);
    }
    Some((chosen, volume))
}
