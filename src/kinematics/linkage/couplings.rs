//! Couplings of two links: gears, belts, racks, cams.
//!
//! Both wheels (or a wheel and a rack) are carried by one link, the carrier. Seen from it the second
//! wheel turns ρ times as far as the first, or the rack slides by ρ times the wheel's angle:
//! θ₂ − θ = ρ·(θ₁ − θ) + q₀, with θ the angle of the carrier. A wheel turns about a pin of the
//! carrier, or about one that lies in the same place, over a link between them: sun, carrier and ring
//! of a planetary gear turn about one axis, and two pins join all three.
//!
//! A cam and its roller are coupled without a carrier: in the cam's frame the roller's centre lies on
//! the pitch curve.
//!
//! A coupling is one equation between three links, handed out like those of pairs. What it ties
//! is solved by iteration (`newton::geared`). Angles are continued along the walk, and a table
//! over the whole period, in which the wheels come back to where they were, gives the turn.
//! Behind several inputs a coupling is one more row of a larger group's matrix
//! (`multi::geared`, `multi::larger`). A position is then found on the way from the last one,
//! in parts in which nothing turns by half a turn.
//!
//! Source: the rolling of two pitch circles on each other (Willis' equation for a moving carrier).

mod cams;
mod meeting;
mod outlines;
mod pitch;

use super::spec::{CouplingKind, CouplingSpec, LinkageSpec, PairSpec};
use crate::fault::Faults;
use crate::units::shown;
pub(super) use cams::remarks;
pub(super) use meeting::Meeting;
pub(crate) use meeting::carriers;
pub(crate) use outlines::{Outline, outlines};
pub(super) use pitch::PitchCurve;

/// Ratios between these are taken, so that squares stay numbers.
const SMALLEST: f64 = 1e-6;
/// See [`SMALLEST`].
const GREATEST: f64 = 1e6;

impl CouplingSpec {
    /// The links that it ties.
    pub(super) fn links(&self) -> [Option<usize>; 3] {
        let [one, other] = self.wheels;
        [one, other, self.carrier]
    }
}

/// Everything wrong with the couplings, the pairs being right.
pub(super) fn check(spec: &LinkageSpec, found: &mut Faults) {
    for (index, coupling) in spec.couplings.iter().enumerate() {
        let path = format!("couplings.{}", coupling.name);
        let mut pairs = spec.pairs.iter().map(|pair| &pair.name);
        let mut before = spec.couplings[..index]
            .iter()
            .map(|coupling| &coupling.name);
        if pairs.any(|name| *name == coupling.name) || before.any(|name| *name == coupling.name) {
            let message = "a pair or another coupling has this name".to_owned();
            found.add(path.as_str(), message, "give it a name of its own");
        }
        found.finite(&format!("{path}.offset"), coupling.offset);
        if let CouplingKind::Cam(cam) = &coupling.kind {
            cams::check(cam, &format!("{path}.cam"), found);
        }
        let wheels = !matches!(coupling.kind, CouplingKind::Cam(_));
        let ratio = coupling.kind.ratio();
        if wheels && !(SMALLEST < ratio.abs() && ratio.abs() < GREATEST) {
            let message = format!("its ratio is {}", shown(ratio, 6));
            let hint = format!("give one between {SMALLEST:e} and {GREATEST:e}");
            found.add(path.as_str(), message, &hint);
        }
        let mut links = coupling.links().into_iter().flatten();
        if let Some(link) = links.find(|link| *link >= spec.links.len()) {
            found.add(path, format!("there is no link number {link}"), "");
        } else if let Err(wrong) = coupling.fits(&spec.pairs) {
            let [message, hint] = wrong.in_words(spec, coupling);
            found.add(path, message, &hint);
        }
    }
}

/// Name of a link or of the ground.
fn named(spec: &LinkageSpec, link: Option<usize>) -> String {
    match link {
        Some(link) => format!("`{}`", spec.links[link].name),
        None => "the ground".to_owned(),
    }
}

/// How pairs are joined to a link: the points of this link and of the other, and the other.
fn ends(pair: &PairSpec, link: Option<usize>) -> Option<([f64; 2], Option<usize>, [f64; 2])> {
    let (on, to) = (pair.on, pair.link);
    match (on.link == link, to.link == link) {
        (true, _) => Some((on.at, to.link, to.at)),
        (_, true) => Some((to.at, on.link, on.at)),
        _ => None,
    }
}
