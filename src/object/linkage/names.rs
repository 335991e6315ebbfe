//! What the parts of a linkage are called, and references to them.

use crate::diagnostics::Diagnostic;
use crate::linkage::spec::{LinkSpec, NamedPoint, PointOf};
use crate::read::{Node, Slot, did_you_mean, quoted_list};
use std::collections::BTreeMap;

/// The name that addresses the frame of the ground.
pub(super) const GROUND: &str = "ground";

/// The point that every link and the ground have: the origin of their frame.
pub(super) const ORIGIN: &str = "origin";

/// Points of one frame by name.
type Points = BTreeMap<String, [f64; 2]>;

/// Names of links, points and pairs in the order of their names, also of faulty
/// ones, so that a reference to them is no fault of its own.
#[derive(Debug, Default)]
pub(super) struct Names {
    ground: Points,
    links: BTreeMap<String, Points>,
    pairs: Vec<String>,
}

impl Names {
    /// All names in a linkage's text.
    pub(super) fn new(linkage: Option<&Node>) -> Self {
        let Some(linkage) = linkage else {
            return Self::default();
        };
        let names = |node: Option<&Node>| -> Vec<String> {
            let members = node.map_or(&[][..], Node::members);
            let mut names: Vec<String> = members.iter().map(|m| m.name.clone()).collect();
            names.sort();
            names
        };
        let points = |node: Option<&Node>| -> Points {
            let all = names(node).into_iter().chain([ORIGIN.to_owned()]);
            all.map(|name| (name, [0.0; 2])).collect()
        };
        let links = linkage.get("links");
        let of_link = |name: String| {
            let link = links.and_then(|links| links.get(&name));
            let points = points(link.and_then(|link| link.get("points")));
            (name, points)
        };
        Self {
            ground: points(linkage.get(GROUND)),
            links: names(links).into_iter().map(of_link).collect(),
            pairs: names(linkage.get("pairs")),
        }
    }

    /// Fills in the coordinates that were read.
    pub(super) fn fill_in(&mut self, ground: &[NamedPoint], links: &[LinkSpec]) {
        for point in ground {
            self.ground.insert(point.name.clone(), point.at);
        }
        for link in links {
            if let Some(points) = self.links.get_mut(&link.name) {
                let at = |point: &NamedPoint| (point.name.clone(), point.at);
                points.extend(link.points.iter().map(at));
            }
        }
    }

    /// The index of the link that the name of a property addresses.
    pub(super) fn link_named(&self, slot: &mut Slot<'_>, name: &str) -> Option<usize> {
        let found = self.links.keys().position(|link| link == name);
        if found.is_none() && !slot.describing() {
            let known = || self.links.keys().map(String::as_str);
            let place = slot.name_place();
            unknown(slot, format!("there is no link `{name}`"), name, known).place = Some(place);
        }
        found
    }

    /// Reads the name of a link; its index.
    pub(super) fn link(&self, mut slot: Slot<'_>) -> Option<usize> {
        let name = slot.look(|slot| slot.text())?;
        let found = self.links.keys().position(|link| *link == name);
        if found.is_none() {
            let known = || self.links.keys().map(String::as_str);
            unknown(
                &mut slot,
                format!("there is no link `{name}`"),
                &name,
                known,
            );
        }
        found
    }

    /// Reads the name of a pair; its index.
    pub(super) fn pair(&self, mut slot: Slot<'_>) -> Option<usize> {
        let name = slot.look(|slot| slot.text())?;
        let found = self.pairs.iter().position(|pair| *pair == name);
        if found.is_none() {
            let known = || self.pairs.iter().map(String::as_str);
            unknown(
                &mut slot,
                format!("there is no pair `{name}`"),
                &name,
                known,
            );
        }
        found
    }

    /// Reads the reference to a point: `rod.B`, `ground.O`, `slider.origin`.
    pub(super) fn point(&self, mut slot: Slot<'_>) -> Option<PointOf> {
        let text = slot.look(|slot| slot.text())?;
        let Some((owner, name)) = text.split_once('.') else {
            self.not_a_point(&mut slot, &text);
            return None;
        };
        let link = self.links.keys().position(|link| link == owner);
        let points = match owner {
            GROUND => Some(&self.ground),
            _ => self.links.get(owner),
        };
        let Some(points) = points else {
            let known = || self.links.keys().map(String::as_str).chain([GROUND]);
            unknown(
                &mut slot,
                format!("there is no link `{owner}`"),
                owner,
                known,
            );
            return None;
        };
        let Some(at) = points.get(name) else {
            let known = || points.keys().map(String::as_str);
            let message = format!("`{owner}` has no point `{name}`");
            unknown(&mut slot, message, name, known);
            return None;
        };
        let link = link.filter(|_| owner != GROUND);
        Some(PointOf { link, at: *at })
    }

    /// Reads the name of a point of one link; its coordinates.
    pub(super) fn own_point(&self, mut slot: Slot<'_>, link: &str) -> Option<[f64; 2]> {
        let name = slot.look(|slot| slot.text())?;
        let points = self.links.get(link)?;
        if let Some(at) = points.get(&name) {
            return Some(*at);
        }
        let known = || points.keys().map(String::as_str);
        let message = format!("`{link}` has no point `{name}`");
        unknown(&mut slot, message, &name, known);
        None
    }

    fn not_a_point(&self, slot: &mut Slot<'_>, text: &str) {
        let fault = slot.refuse("unknown-point", format!("`{text}` is no point of a link"));
        let points = match text {
            GROUND => Some(&self.ground),
            _ => self.links.get(text),
        };
        let example = points.and_then(|points| points.keys().next());
        fault.hints.push(match example {
            Some(point) => format!("write link.point, as in \"{text}.{point}\""),
            None => "write link.point, as in \"rod.A\" or \"ground.O\"".to_owned(),
        });
    }
}

fn unknown<'s, 'a, I: Iterator<Item = &'a str>>(
    slot: &'s mut Slot<'_>,
    message: String,
    name: &str,
    known: impl Fn() -> I,
) -> &'s mut Diagnostic {
    let hint = did_you_mean(name, known()).unwrap_or_else(|| match known().next() {
        Some(_) => format!("there are {}", quoted_list(known().take(20), "and")),
        None => "there is none yet".to_owned(),
    });
    let fault = slot.refuse("unknown-part", message);
    fault.hints.push(hint);
    fault
}
