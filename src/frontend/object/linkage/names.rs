//! What the parts of a linkage are called, and references to them.

use crate::frontend::diagnostics::Diagnostic;
use crate::frontend::read::{Node, Slot, did_you_mean, quoted_list};
use crate::kinematics::linkage::spec::{LinkSpec, NamedPoint, PointOf};

/// The name that addresses the frame of the ground.
pub(super) const GROUND: &str = "ground";

/// The point that every link and the ground have: the origin of their frame.
pub(super) const ORIGIN: &str = "origin";

/// Points of one frame in the order of their names.
type Points = Vec<NamedPoint>;

/// Names of links, points and pairs in the order of their names, also of faulty
/// ones, so that a reference to them is no fault of its own.
#[derive(Debug, Default)]
pub(super) struct Names {
    ground: Points,
    links: Vec<(String, Points)>,
    pairs: Vec<String>,
}

impl Names {
    /// All names in a linkage's text.
    pub(super) fn new(linkage: Option<&Node>) -> Self {
        let Some(linkage) = linkage else {
            return Self::default();
        };
        let links = linkage.get("links");
        let of_link = |name: String| {
            let link = links.and_then(|links| links.get(&name));
            let points = points(link.and_then(|link| link.get("points")));
            (name, points)
        };
        Self {
            ground: points(linkage.get(GROUND)),
            links: sorted(links, &[]).into_iter().map(of_link).collect(),
            pairs: pairs(linkage.get("pairs")),
        }
    }

    /// Fills in the coordinates that were read.
    pub(super) fn fill_in(&mut self, ground: &[NamedPoint], links: &[LinkSpec]) {
        place_known_points(&mut self.ground, ground);
        for link in links {
            let known = self.links.iter_mut().find(|known| known.0 == link.name);
            if let Some((_, points)) = known {
                place_known_points(points, &link.points);
            }
        }
    }

    /// The names of all links.
    fn link_names(&self) -> Vec<&str> {
        self.links.iter().map(|link| link.0.as_str()).collect()
    }

    fn position(&self, link: &str) -> Option<usize> {
        self.links.iter().position(|known| known.0 == link)
    }

    /// The points of a link; `None`: there is no such link.
    fn points(&self, link: &str) -> Option<&Points> {
        Some(&self.links[self.position(link)?].1)
    }

    /// The index of the link that the name of a property addresses.
    pub(super) fn link_named(&self, slot: &mut Slot<'_>, name: &str) -> Option<usize> {
        let found = self.position(name);
        if found.is_none() && !slot.describing() {
            let known = self.link_names();
            let place = slot.name_place();
            unknown(slot, format!("there is no link `{name}`"), name, &known).place = Some(place);
        }
        found
    }

    /// Reads the name of a link; its index.
    pub(super) fn link(&self, mut slot: Slot<'_>) -> Option<usize> {
        let name = slot.read_in_place(|slot| slot.text())?;
        let found = self.position(&name);
        if found.is_none() {
            let message = format!("there is no link `{name}`");
            unknown(&mut slot, message, &name, &self.link_names());
        }
        found
    }

    /// Reads the name of a link or of the ground (`None`).
    pub(super) fn link_or_ground(&self, mut slot: Slot<'_>) -> Option<Option<usize>> {
        let name = slot.read_in_place(|slot| slot.text())?;
        if name == GROUND {
            return Some(None);
        }
        let found = self.position(&name);
        if found.is_none() {
            let mut known = self.link_names();
            known.push(GROUND);
            let message = format!("there is no link `{name}`");
            unknown(&mut slot, message, &name, &known);
        }
        found.map(Some)
    }

    /// What a link or the ground is called.
    pub(super) fn of_link(&self, link: Option<usize>) -> &str {
        link.and_then(|link| self.links.get(link))
            .map_or(GROUND, |link| link.0.as_str())
    }

    /// How many links there are.
    pub(super) fn links(&self) -> usize {
        self.links.len()
    }

    /// Reads the name of a pair; its index.
    pub(super) fn pair(&self, mut slot: Slot<'_>) -> Option<usize> {
        let name = slot.read_in_place(|slot| slot.text())?;
        let found = self.pairs.iter().position(|pair| *pair == name);
        if found.is_none() {
            let known: Vec<&str> = self.pairs.iter().map(String::as_str).collect();
            let message = format!("there is no pair `{name}`");
            unknown(&mut slot, message, &name, &known);
        }
        found
    }

    /// Reads the reference to a point: `rod.B`, `ground.O`, `slider.origin`.
    pub(super) fn point(&self, mut slot: Slot<'_>) -> Option<PointOf> {
        let text = slot.read_in_place(|slot| slot.text())?;
        let Some((owner, name)) = text.split_once('.') else {
            self.not_a_point(&mut slot, &text);
            return None;
        };
        let link = self.position(owner);
        let points = match owner {
            GROUND => Some(&self.ground),
            _ => self.points(owner),
        };
        let Some(points) = points else {
            let mut known = self.link_names();
            known.push(GROUND);
            let message = format!("there is no link `{owner}`");
            unknown(&mut slot, message, owner, &known);
            return None;
        };
        let at = point_named(&mut slot, owner, name, points)?;
        let link = link.filter(|_| owner != GROUND);
        Some(PointOf { link, at })
    }

    /// Reads the name of a point of one link; its coordinates.
    pub(super) fn own_point(&self, mut slot: Slot<'_>, link: &str) -> Option<[f64; 2]> {
        let name = slot.read_in_place(|slot| slot.text())?;
        let points = self.points(link)?;
        point_named(&mut slot, link, &name, points)
    }

    fn not_a_point(&self, slot: &mut Slot<'_>, text: &str) {
        let fault = slot.refuse("unknown-point", format!("`{text}` is no point of a link"));
        let points = match text {
            GROUND => Some(&self.ground),
            _ => self.points(text),
        };
        let example = points.and_then(|points| Some(&points.first()?.name));
        fault.hints.push(match example {
            Some(point) => format!("write link.point, as in \"{text}.{point}\""),
            None => "write link.point, as in \"rod.A\" or \"ground.O\"".to_owned(),
        });
    }
}

/// The names of an object's properties and further ones, sorted, each once.
fn sorted(node: Option<&Node>, further: &[&str]) -> Vec<String> {
    let members = node.map_or(&[][..], Node::members);
    let mut names: Vec<String> = members.iter().map(|member| member.name.clone()).collect();
    names.extend(further.iter().map(|name| (*name).to_owned()));
    names.sort();
    names.dedup();
    names
}

/// The names of the pairs, those of the welds among them left out.
fn pairs(node: Option<&Node>) -> Vec<String> {
    let is_weld = |name: &String| {
        let pair = node.and_then(|node| node.get(name));
        pair.is_some_and(|pair| pair.get("weld").is_some())
    };
    let mut names = sorted(node, &[]);
    names.retain(|name| !is_weld(name));
    names
}

/// The points of a frame, whose coordinates are not known yet.
fn points(node: Option<&Node>) -> Points {
    let at = [0.0; 2];
    let names = sorted(node, &[ORIGIN]);
    names
        .into_iter()
        .map(|name| NamedPoint { name, at })
        .collect()
}

/// Puts known points into their places.
fn place_known_points(points: &mut Points, known: &[NamedPoint]) {
    for point in known {
        if let Some(found) = points.iter_mut().find(|other| other.name == point.name) {
            found.at = point.at;
        }
    }
}

/// The coordinates of a point by its name.
fn point_named(slot: &mut Slot<'_>, owner: &str, name: &str, points: &Points) -> Option<[f64; 2]> {
    if let Some(point) = points.iter().find(|point| point.name == name) {
        return Some(point.at);
    }
    let known: Vec<&str> = points.iter().map(|point| point.name.as_str()).collect();
    unknown(
        slot,
        format!("`{owner}` has no point `{name}`"),
        name,
        &known,
    );
    None
}

fn unknown<'s>(
    slot: &'s mut Slot<'_>,
    message: String,
    name: &str,
    known: &[&str],
) -> &'s mut Diagnostic {
    let known = known.iter().copied();
    let hint = did_you_mean(name, known.clone()).unwrap_or_else(|| match known.len() {
        0 => "there is none yet".to_owned(),
        _ => format!("there are {}", quoted_list(known.take(20), "and")),
    });
    let fault = slot.refuse("unknown-part", message);
    fault.hints.push(hint);
    fault
}
