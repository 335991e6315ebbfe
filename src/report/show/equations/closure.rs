//! The closing equations of a linkage: vector loops in x and y, angles of guides and welds, gears,
//! belts and racks, and its inputs.
//!
//! Links and the ground are the nodes of a graph, joints its edges. A spanning tree from the ground
//! places every link; each joint beyond it closes a loop. Around a loop the vectors between the
//! joints of each link sum to zero: l·cos(θ + α) with the length l, the angle θ of the link's frame
//! and the angle α of the vector in it. A guide adds its displacement s along its direction.

use super::{Section, symbol};
use crate::report::math::{Expr, Index, Symbol};
use std::collections::{BTreeMap, VecDeque};
use std::f64::consts::PI;

/// What is known of a position, for the legend.
pub(super) struct ClosurePosition<'p> {
    /// Angle of a link's frame (rad).
    pub(super) angle: &'p dyn Fn(usize) -> f64,
    /// Coordinate of a pair (rad or m).
    pub(super) pair: &'p dyn Fn(usize) -> f64,
}

/// A point of a link.
#[derive(Clone, Copy)]
pub(super) struct End {
    /// The link; `None`: the ground.
    pub(super) link: Option<usize>,
    /// The point in its frame (m).
    pub(super) at: [f64; 2],
}

/// A joint that is an edge of the graph.
#[derive(Clone, Copy)]
pub(super) struct Edge<'s> {
    pub(super) name: &'s str,
    pub(super) ends: [End; 2],
    /// Index of the pair, if it slides.
    pub(super) slides: Option<usize>,
    /// Angle of the second link's frame less that of the first, if it is constant (rad).
    pub(super) turned: Option<f64>,
    /// Direction of sliding in the frame of the first link (rad).
    pub(super) direction: f64,
}

/// A coupling between two links, seen from a third.
pub(super) struct Coupled<'s> {
    pub(super) name: &'s str,
    /// What it is called.
    pub(super) noun: &'static str,
    pub(super) links: [Option<usize>; 2],
    pub(super) carrier: Option<usize>,
    pub(super) rule: Rule,
    /// Angle or displacement of the second link where the angle of the first is zero.
    pub(super) offset: f64,
}

/// How the second link of a coupling moves with the first.
pub(super) enum Rule {
    /// It turns as far times this.
    Turns(f64),
    /// It slides by this for a radian (m).
    Slides(f64),
    /// In words.
    InWords(&'static str),
}

/// How a link is reached from the ground: by an edge, from its end of this number.
type Parents = BTreeMap<usize, (usize, usize)>;

/// A link of a path (`None`: the ground), with the edge by which it is reached and the parent's end
/// of that.
type Station = (Option<usize>, Option<(usize, usize)>);

/// A term of a loop.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Term {
    /// From one point of a link (or the ground) to another, in its frame; the names of the joints.
    Vector {
        link: Option<usize>,
        vector: [f64; 2],
        joints: [Option<usize>; 2],
    },
    /// Along a guide (an edge), in its sense or against it.
    Along { edge: usize, sign: f64 },
    /// To the origin of a link that no joint reaches from the ground.
    Origin { link: usize, sign: f64 },
}

/// The closing equations of a linkage.
pub(super) struct Closure<'s> {
    /// Names of the links.
    links: Vec<&'s str>,
    edges: Vec<Edge<'s>>,
    couplings: Vec<Coupled<'s>>,
    parents: Parents,
    /// Lengths that are written: of a link, between two joints (edges).
    lengths: BTreeMap<(usize, [usize; 2]), f64>,
}

impl<'s> Closure<'s> {
    pub(super) fn new(
        links: Vec<&'s str>,
        edges: Vec<Edge<'s>>,
        couplings: Vec<Coupled<'s>>,
    ) -> Self {
        let parents = spanning_tree(&edges, links.len());
        Self {
            links,
            edges,
            couplings,
            parents,
            lengths: BTreeMap::new(),
        }
    }

    /// Writes the equations, with the values of a position in the legend.
    pub(super) fn write(mut self, section: &mut Section, position: Option<&ClosurePosition<'_>>) {
        let loops: Vec<(usize, Vec<Term>)> = self.loops();
        for (number, (edge, terms)) in loops.iter().enumerate() {
            let links = self.links_of(terms);
            let remark = format!(
                "loop {}, closed at {}: {links}",
                number + 1,
                self.edges[*edge].name
            );
            for (axis, name) in [(0, "x"), (1, "y")] {
                let sum: Vec<Expr> = terms
                    .iter()
                    .flat_map(|term| self.term(term, axis))
                    .collect();
                let remark = match axis {
                    0 => format!("{remark}; {name}"),
                    _ => name.to_owned(),
                };
                section.line(Expr::Number(0.0), Expr::sum(sum), remark);
            }
        }
        self.constant_angles(section);
        for coupling in &self.couplings {
            self.coupling(coupling, section);
        }
        self.legend(section, position);
    }

    /// The edges beyond the tree, each with the terms around its loop.
    fn loops(&mut self) -> Vec<(usize, Vec<Term>)> {
        let tree: Vec<usize> = self.parents.values().map(|(edge, _)| *edge).collect();
        let beyond = (0..self.edges.len()).filter(|edge| !tree.contains(edge));
        let found: Vec<(usize, Vec<Term>)> =
            beyond.map(|edge| (edge, self.loop_terms(edge))).collect();
        for (_, terms) in &found {
            for term in terms {
                if let Term::Vector {
                    link: Some(link),
                    vector: [x, y],
                    joints: [Some(one), Some(other)],
                } = *term
                {
                    let key = (link, [one.min(other), one.max(other)]);
                    self.lengths.insert(key, x.hypot(y));
                }
            }
        }
        found
    }

    /// From the ground (or the last common link) along the one side of an edge, over it, and back
    /// along the other.
    fn loop_terms(&self, edge: usize) -> Vec<Term> {
        let joint = &self.edges[edge];
        let [mut one, mut other] = [0, 1].map(|end| self.path(joint.ends[end].link));
        while one.len() > 1 && other.len() > 1 && one[1].0 == other[1].0 {
            one.remove(0);
            other.remove(0);
        }
        // Both begin on the same link now.
        let exit = |path: &[Station], end: usize| match path.get(1) {
            None => (Some(edge), joint.ends[end].at),
            Some((_, Some((next, parent)))) => (Some(*next), self.edges[*next].ends[*parent].at),
            // (A link that no joint reaches begins at the origin of the ground.)
            Some((_, None)) => (None, [0.0; 2]),
        };
        let (to, there) = exit(&one, 0);
        let (from, here) = exit(&other, 1);
        let mut terms = vec![Term::Vector {
            link: one[0].0,
            vector: [there[0] - here[0], there[1] - here[1]],
            joints: [from, to],
        }];
        terms.extend(self.path_terms(&one, edge, 0, 1.0));
        if joint.slides.is_some() {
            terms.push(Term::Along { edge, sign: 1.0 });
        }
        let back = self.path_terms(&other, edge, 1, -1.0);
        terms.extend(back.into_iter().rev());
        let is_zero = |term: &Term| match term {
            Term::Vector { vector, .. } => *vector == [0.0; 2],
            Term::Along { .. } | Term::Origin { .. } => false,
        };
        terms.retain(|term| !is_zero(term));
        terms
    }

    /// The links from the ground to a link, each with the edge by which it is reached and the
    /// parent's end of it; a link that no joint reaches begins its own path.
    fn path(&self, link: Option<usize>) -> Vec<Station> {
        let mut found = Vec::new();
        let mut here = link;
        while let Some(own) = here {
            let by = self.parents.get(&own).copied();
            found.push((here, by));
            let Some((edge, parent)) = by else { break };
            here = self.edges[edge].ends[parent].link;
        }
        found.push((None, None));
        found.reverse();
        found
    }

    /// The terms behind the first link of a path, up to the end of an edge.
    fn path_terms(&self, path: &[Station], last: usize, end: usize, sign: f64) -> Vec<Term> {
        let mut terms = Vec::new();
        for (place, (link, by)) in path.iter().enumerate().skip(1) {
            let Some(own) = *link else { continue };
            let (from, here) = match by {
                Some((edge, parent)) => {
                    if self.edges[*edge].slides.is_some() {
                        let sense = if *parent == 0 { sign } else { -sign };
                        terms.push(Term::Along {
                            edge: *edge,
                            sign: sense,
                        });
                    }
                    (Some(*edge), self.edges[*edge].ends[1 - *parent].at)
                }
                None => {
                    terms.push(Term::Origin { link: own, sign });
                    (None, [0.0; 2])
                }
            };
            let (to, there) = match path.get(place + 1) {
                Some((_, Some((edge, parent)))) => (*edge, self.edges[*edge].ends[*parent].at),
                _ => (last, self.edges[last].ends[end].at),
            };
            terms.push(Term::Vector {
                link: *link,
                vector: [sign * (there[0] - here[0]), sign * (there[1] - here[1])],
                joints: [from, Some(to)],
            });
        }
        terms
    }

    fn links_of(&self, terms: &[Term]) -> String {
        let mut names: Vec<&str> = Vec::new();
        let name = |link: Option<usize>| match link {
            None => "ground",
            Some(link) => self.links[link],
        };
        for term in terms {
            let links = match *term {
                Term::Vector { link, .. } => vec![name(link)],
                Term::Along { edge, sign } => {
                    let [one, other] = self.edges[edge].ends.map(|end| name(end.link));
                    if sign > 0.0 {
                        vec![one, other]
                    } else {
                        vec![other, one]
                    }
                }
                Term::Origin { link, .. } => vec![name(Some(link))],
            };
            for link in links {
                if names.last() != Some(&link) {
                    names.push(link);
                }
            }
        }
        names.join(", ")
    }

    fn name(&self, link: usize) -> String {
        self.links[link].to_owned()
    }

    fn angle(&self, link: Option<usize>) -> Vec<Expr> {
        link.map(|link| symbol("θ", Index::Word(self.name(link))).expr())
            .into_iter()
            .collect()
    }

    fn length(&self, link: usize, joints: [usize; 2]) -> Symbol {
        let [one, other] = [joints[0].min(joints[1]), joints[0].max(joints[1])];
        let of_link = self.lengths.keys().filter(|(own, _)| *own == link);
        let word = match of_link.count() {
            1 => self.name(link),
            _ => format!(
                "{}:{}–{}",
                self.name(link),
                self.edges[one].name,
                self.edges[other].name
            ),
        };
        symbol("l", Index::Word(word))
    }

    fn displacement(&self, edge: usize) -> Symbol {
        symbol("s", Index::Word(self.edges[edge].name.to_owned()))
    }

    /// A term along x (0) or y (1).
    fn term(&self, term: &Term, axis: usize) -> Vec<Expr> {
        match *term {
            Term::Vector {
                link: None, vector, ..
            } => vec![Expr::Number(vector[axis])],
            Term::Vector {
                link: Some(link),
                vector: [x, y],
                joints,
            } => {
                let size = match joints {
                    [Some(one), Some(other)] => self.length(link, [one, other]).expr(),
                    _ => Expr::Number(x.hypot(y)),
                };
                vec![self.projected(size, Some(link), y.atan2(x), axis)]
            }
            Term::Along { edge, sign } => {
                let slide = &self.edges[edge];
                let size = self.displacement(edge).expr();
                let projected = self.projected(size, slide.ends[0].link, slide.direction, axis);
                vec![projected.signed(sign)]
            }
            Term::Origin { link, sign } => {
                let letter = ["x", "y"][axis];
                vec![
                    symbol(letter, Index::Word(self.name(link)))
                        .expr()
                        .signed(sign),
                ]
            }
        }
    }

    /// size·cos(θ + α) or size·sin(θ + α).
    fn projected(&self, size: Expr, link: Option<usize>, angle: f64, axis: usize) -> Expr {
        let turned = self.angle(link);
        if turned.is_empty() {
            let factor = [angle.cos(), angle.sin()][axis];
            return match rounded(factor) {
                0.0 => Expr::Number(0.0),
                1.0 => size,
                -1.0 => size.negative(),
                _ => size.times(Expr::Number(factor)),
            };
        }
        // A vector against the frame's axis is a negative length.
        let against = angle.abs() > 0.5 * PI + 1e-12;
        let angle = match against {
            true => angle - PI.copysign(angle),
            false => angle,
        };
        let mut argument = turned;
        if angle != 0.0 {
            argument.push(Expr::Angle(angle));
        }
        let function = ["cos", "sin"][axis];
        let projected = size.times(Expr::Function(function, Box::new(Expr::sum(argument))));
        match against {
            true => projected.negative(),
            false => projected,
        }
    }

    /// Guides and welds: the angle of one link follows that of the other.
    fn constant_angles(&self, section: &mut Section) {
        for edge in &self.edges {
            let Some(turned) = edge.turned else { continue };
            let [on, link] = edge.ends.map(|end| end.link);
            let (Some(link), difference) = (match link {
                Some(_) => (link, turned),
                None => (on, -turned),
            }) else {
                continue;
            };
            let from = if edge.ends[1].link.is_some() {
                on
            } else {
                None
            };
            let mut right = self.angle(from);
            right.push(Expr::Angle(difference));
            let left = symbol("θ", Index::Word(self.name(link)));
            section.line(
                left,
                Expr::sum(right),
                format!("{} does not turn", edge.name),
            );
        }
    }

    /// The angle of a link seen from a carrier.
    fn angle_seen_from(&self, link: Option<usize>, carrier: Option<usize>) -> Expr {
        let mut terms = self.angle(link);
        terms.extend(self.angle(carrier).into_iter().map(Expr::negative));
        Expr::sum(terms)
    }

    /// What a coupling asks of the links.
    fn coupling(&self, coupling: &Coupled<'_>, section: &mut Section) {
        let [one, other] = coupling.links;
        let turned = self.angle_seen_from(one, coupling.carrier);
        let name = format!("{} {}", coupling.noun, coupling.name);
        match coupling.rule {
            Rule::Turns(ratio) => {
                let right = Expr::sum(vec![scaled(ratio, turned), Expr::Angle(coupling.offset)]);
                section.line(self.angle_seen_from(other, coupling.carrier), right, name);
            }
            Rule::Slides(radius) => {
                let Some(left) = self.sliding_displacement(coupling) else {
                    return;
                };
                let right = Expr::sum(vec![scaled(radius, turned), Expr::Number(coupling.offset)]);
                section.line(left, right, name);
            }
            Rule::InWords(rule) => {
                let what = Expr::Words(format!("{name}:"));
                section.line(what, Expr::Words(rule.to_owned()), "");
            }
        }
    }

    /// The displacement of the second link of a coupling on its carrier.
    fn sliding_displacement(&self, coupling: &Coupled<'_>) -> Option<Expr> {
        let [_, other] = coupling.links;
        let joins = |edge: &Edge<'_>| {
            let links = edge.ends.map(|end| end.link);
            edge.slides.is_some()
                && (links == [coupling.carrier, other] || links == [other, coupling.carrier])
        };
        let edge = self.edges.iter().position(joins)?;
        let is_on_carrier = self.edges[edge].ends[0].link == coupling.carrier;
        let sign = if is_on_carrier { 1.0 } else { -1.0 };
        Some(self.displacement(edge).expr().signed(sign))
    }

    fn legend(&self, section: &mut Section, position: Option<&ClosurePosition<'_>>) {
        for (&(link, [one, other]), &length) in &self.lengths {
            let joints = [one, other].map(|edge| self.edges[edge].name);
            let meaning = format!(
                "distance from {} to {} on {}",
                joints[0],
                joints[1],
                self.name(link)
            );
            section.add_entry(self.length(link, [one, other]), length, "m", meaning);
        }
        let Some(position) = position else { return };
        let here = "here where the linkage is put together";
        for link in 0..self.links.len() {
            let letter = symbol("θ", Index::Word(self.name(link)));
            let meaning = format!("angle of the frame of {}; {here}", self.name(link));
            section.add_entry(letter, (position.angle)(link), "rad", meaning);
        }
        for (edge, joint) in self.edges.iter().enumerate() {
            let Some(pair) = joint.slides else { continue };
            let meaning = format!("displacement along the guide of {}; {here}", joint.name);
            section.add_entry(self.displacement(edge), (position.pair)(pair), "m", meaning);
        }
    }
}

/// factor·expr, without a factor of one.
fn scaled(factor: f64, expr: Expr) -> Expr {
    match factor {
        1.0 => expr,
        -1.0 => expr.negative(),
        _ => Expr::Number(factor).times(expr),
    }
}

/// Rounds what differs from 0, 1 or −1 by rounding alone.
fn rounded(factor: f64) -> f64 {
    let whole = factor.round();
    match (factor - whole).abs() < 1e-15 {
        true => 0.0 + whole,
        false => factor,
    }
}

/// Breadth first from the ground, then from links that no joint reaches.
fn spanning_tree(edges: &[Edge<'_>], links: usize) -> Parents {
    let mut parents = Parents::new();
    let mut known = vec![false; links];
    let mut waiting = VecDeque::from([None]);
    let mut next = 0;
    loop {
        while let Some(here) = waiting.pop_front() {
            for (index, edge) in edges.iter().enumerate() {
                for parent in [0, 1] {
                    let child = edge.ends[1 - parent].link;
                    if let (true, Some(child)) = (edge.ends[parent].link == here, child)
                        && !known[child]
                    {
                        known[child] = true;
                        parents.insert(child, (index, parent));
                        waiting.push_back(Some(child));
                    }
                }
            }
        }
        let Some(apart) = (next..links).find(|&link| !known[link]) else {
            return parents;
        };
        known[apart] = true;
        next = apart + 1;
        waiting.push_back(Some(apart));
    }
}
