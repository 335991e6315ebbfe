//! Constraints that hold what is held already: a third equal rod of a parallelogram, the middle crank
//! of coupling rods, a carriage on two parallel guides, wedges.
//!
//! By the count of degrees of freedom such a linkage is rigid, though it moves, since the equations of
//! its pairs depend on each other. Those that are too many are left out ([`Redundant`]), so that the
//! rest is solved as any linkage; that they hold nevertheless is verified over the whole reach. Which
//! part of the forces they carry follows from elasticity and clearances alone: reactions that depend on
//! it are statically indeterminate.

mod search;
mod several_inputs;

use super::Linkage;
use super::elements::{elements, slides};
use super::spec::{LinkageSpec, PairSpec, PointOf, Redundant, RedundantPart};
use super::state::State;
use crate::fault::Fault;
pub(super) use search::find_movable_linkage;
pub(super) use several_inputs::find_movable;

/// What a constraint may be missed by, in sizes of the linkage (angles in radians).
const MISSED: f64 = 1e-9;
/// Positions at which they are looked at.
const POSITIONS: usize = 400;
/// How far a reach without ends is looked at, in sizes of the linkage.
const FAR: f64 = 10.0;

impl Redundant {
    /// What it is, in words: ``the length of `c2` between its pins `O2` and `A2` ``.
    pub fn describe(&self, spec: &LinkageSpec) -> String {
        let pair = &spec.pairs[self.pair];
        match self.part {
            RedundantPart::Whole => format!("the pair `{}`", pair.name),
            RedundantPart::Couple => format!("the couple of the guide `{}`", pair.name),
            RedundantPart::Along(link) => {
                let name = &spec.links[link].name;
                match other_pair(spec, link, self.pair).map(|other| &spec.pairs[other]) {
                    Some(other) if other.slides() => format!(
                        "the pin `{}` of `{name}` across its guide `{}`",
                        pair.name, other.name
                    ),
                    Some(other) => format!(
                        "the length of `{name}` between its pins `{}` and `{}`",
                        other.name, pair.name
                    ),
                    None => format!("the pin `{}` of `{name}`", pair.name),
                }
            }
        }
    }

    /// Direction in which the pin of its link is free, in that link's frame; `None` where it has none.
    pub(super) fn free_direction(&self, spec: &LinkageSpec) -> Option<[f64; 2]> {
        let RedundantPart::Along(link) = self.part else {
            return None;
        };
        let own = |pair: usize| {
            elements(&spec.pairs[pair])
                .into_iter()
                .find(|element| element.link == Some(link))
        };
        let other = other_pair(spec, link, self.pair)?;
        let (here, there) = (own(self.pair)?, own(other)?);
        if slides(&spec.pairs[other]) {
            let [u, v] = there.along;
            return Some([-v, u]);
        }
        let [x, y] = [0, 1].map(|k| here.point[k] - there.point[k]);
        let length = x.hypot(y);
        (length > 0.0).then(|| [x / length, y / length])
    }

    /// By how much the pair is missed at a position (m; of a guide that turns, rad times `size`).
    fn closure_error(&self, spec: &LinkageSpec, state: &State, size: f64) -> f64 {
        let pair = &spec.pairs[self.pair];
        let place = |point: PointOf| state.frame::<1>(point.link).place(point.at).value();
        let (on, link) = (place(pair.on), place(pair.link));
        let apart = [link[0] - on[0], link[1] - on[1]];
        if !slides(pair) {
            return apart[0].hypot(apart[1]);
        }
        let [i, j] = elements(pair).map(|element| {
            let direction = state.frame::<1>(element.link).direction;
            direction.turn_constant(element.along).value()
        });
        let across = i[0] * apart[1] - i[1] * apart[0];
        let turned = i[0] * j[1] - i[1] * j[0];
        across.abs().max(turned.abs() * size)
    }
}

/// The other one of the two pairs of a link; `None` where it has not two.
fn other_pair(spec: &LinkageSpec, link: usize, pair: usize) -> Option<usize> {
    let mut others = pairs_of(spec, link).filter(|&other| other != pair);
    let other = others.next()?;
    others.next().is_none().then_some(other)
}

/// The pairs of a link.
fn pairs_of(spec: &LinkageSpec, link: usize) -> impl Iterator<Item = usize> + '_ {
    let touches = move |pair: &PairSpec| [pair.on.link, pair.link.link].contains(&Some(link));
    (0..spec.pairs.len()).filter(move |&pair| touches(&spec.pairs[pair]))
}

/// By how much the constraints that are left out are missed at a position, in sizes of the linkage.
fn closure_error(spec: &LinkageSpec, state: &State, size: f64) -> f64 {
    let each = spec.redundant.iter();
    each.map(|one| one.closure_error(spec, state, size) / size)
        .fold(0.0, |most: f64, one| if one <= most { most } else { one })
}

/// Refuses constraints that were left out and do not hold at the start.
pub(super) fn holds_at_start(
    spec: &LinkageSpec,
    state: &State,
    size: f64,
) -> Result<(), Vec<Fault>> {
    // The start is known to rounding, that of a larger group to what its iteration leaves.
    match closure_error(spec, state, size) <= 1e3 * MISSED {
        true => Ok(()),
        false => Err(not_redundant(spec, "at the start")),
    }
}

/// Refuses constraints that were left out and do not hold somewhere on the reach.
pub(super) fn holds_everywhere(linkage: &Linkage) -> Result<(), Vec<Fault>> {
    let spec = linkage.spec();
    if spec.redundant.is_empty() {
        return Ok(());
    }
    let range = linkage.range();
    let [from, to] = match range.period {
        Some(period) => [range.start, range.start + period.length],
        None => range.ends().map(|end| {
            let far = FAR * linkage.typical_length();
            end.clamp(range.start - far, range.start + far)
        }),
    };
    let mut workspace = linkage.workspace();
    let holds = |k: usize| {
        let q = from + (to - from) * (k as f64 + 0.5) / POSITIONS as f64;
        linkage.solve(q, 0, &mut workspace).is_ok()
            && closure_error(spec, &workspace.state, linkage.typical_length()) <= MISSED
    };
    match (0..POSITIONS).all(holds) {
        true => Ok(()),
        false => Err(not_redundant(spec, "on the reach")),
    }
}

fn not_redundant(spec: &LinkageSpec, place: &str) -> Vec<Fault> {
    let what = spec.redundant.iter().map(|one| {
        Fault::new(
            format!("pairs.{}", spec.pairs[one.pair].name),
            format!(
                "{} is not redundant: it does not hold {place}",
                one.describe(spec)
            ),
            "leave it out of the redundant ones",
        )
    });
    what.collect()
}
