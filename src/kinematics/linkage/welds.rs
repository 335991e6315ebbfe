//! Links that are welded together: one body for structure and motion.
//!
//! Of links that are joined by welds one is the base, the ground where it is among them; the others
//! are attached to it. Their pairs are taken as pairs of the base where the linkage is solved, and
//! they are placed after it.
//!
//! The free-body equations are those of every link, with three unknowns a weld
//! (`kinetostatics::welds`).

use super::elements::Frame;
use super::spec::{AssemblyChoice, LinkageSpec, PairKind, PairSpec, PointOf};
use crate::fault::Faults;

/// A link that is attached to a base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct AttachedLink {
    pub(super) link: usize,
    /// The base; `None`: the ground.
    pub(super) base: Option<usize>,
    /// Origin of its frame in that of the base (m).
    at: [f64; 2],
    /// Angle of its frame less that of the base (rad).
    angle: f64,
}

/// Attaches a link, where it stands behind others on which it depends.
#[derive(Clone, Copy)]
struct Place {
    base: Option<usize>,
    at: [f64; 2],
    angle: f64,
}

impl Place {
    fn point(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = self.angle.sin_cos();
        [
            self.at[0] + cos * x - sin * y,
            self.at[1] + sin * x + cos * y,
        ]
    }

    /// The place of a link turned by `angle` against this one, whose point `own` lies on `here`.
    fn place_of_welded_link(&self, here: [f64; 2], own: [f64; 2], angle: f64) -> Self {
        let turned = Self {
            base: self.base,
            at: [0.0; 2],
            angle: self.angle + angle,
        };
        let ([x, y], [u, v]) = (self.point(here), turned.point(own));
        Self {
            at: [x - u, y - v],
            ..turned
        }
    }
}

/// All links that are attached to others; links in `preferred` are bases wherever they can be.
pub(super) fn attached(
    spec: &LinkageSpec,
    preferred: impl IntoIterator<Item = usize>,
) -> Vec<AttachedLink> {
    let places = places(spec, preferred);
    let links = places.iter().enumerate();
    let attached = links.filter_map(|(link, place)| {
        let Place { base, at, angle } = (*place)?;
        (base != Some(link)).then_some(AttachedLink {
            link,
            base,
            at,
            angle,
        })
    });
    attached.collect()
}

/// Places of all links that are welded to any; the ground is the first base, then what is preferred.
fn places(spec: &LinkageSpec, preferred: impl IntoIterator<Item = usize>) -> Vec<Option<Place>> {
    let mut places: Vec<Option<Place>> = vec![None; spec.links.len()];
    let welded = spec
        .welds
        .iter()
        .flat_map(|weld| [weld.on.link, weld.link.link])
        .flatten();
    let mut welded: Vec<usize> = welded.collect();
    welded.sort_unstable();
    let preferred = preferred.into_iter().filter(|link| welded.contains(link));
    let bases = std::iter::once(None).chain(preferred.map(Some));
    for base in bases.chain(welded.iter().copied().map(Some)) {
        if base.is_some_and(|link| places[link].is_some()) {
            continue;
        }
        let first = Place {
            base,
            at: [0.0; 2],
            angle: 0.0,
        };
        if let Some(link) = base {
            places[link] = Some(first);
        }
        place_welded(spec, first, &mut places);
    }
    places
}

/// Places all that welds join to a base.
fn place_welded(spec: &LinkageSpec, first: Place, places: &mut [Option<Place>]) {
    let mut grew = true;
    while grew {
        grew = false;
        for weld in &spec.welds {
            let place = |end: &PointOf, places: &[Option<Place>]| match end.link {
                None => Some(first).filter(|first| first.base.is_none()),
                Some(link) => places.get(link).copied().flatten(),
            };
            let (one, other) = (place(&weld.on, places), place(&weld.link, places));
            let (to, found) = match (one, other) {
                (Some(on), None) => (
                    &weld.link,
                    on.place_of_welded_link(weld.on.at, weld.link.at, weld.angle),
                ),
                (None, Some(link)) => (
                    &weld.on,
                    link.place_of_welded_link(weld.link.at, weld.on.at, -weld.angle),
                ),
                _ => continue,
            };
            if let Some(link) = to.link.filter(|&link| link < places.len()) {
                places[link] = Some(found);
                grew = true;
            }
        }
    }
}

/// Gives the pairs of attached links to their bases, and what is said of their assembly.
pub(super) fn give_to_bases(spec: &mut LinkageSpec, attached: &[AttachedLink]) {
    let of = |link: Option<usize>| attached.iter().find(|one| Some(one.link) == link);
    for pair in &mut spec.pairs {
        let [on, link] = [&mut pair.on, &mut pair.link].map(|end| {
            let angle = of(end.link).map_or(0.0, |one| one.angle);
            if let Some(one) = of(end.link) {
                *end = one.on_base(end.at);
            }
            angle
        });
        if let PairKind::Sliding {
            direction, angle, ..
        } = &mut pair.kind
        {
            *direction += on;
            *angle -= link;
        }
    }
    spec.assembly.retain_mut(|choice| {
        let Some(one) = of(Some(choice.link)) else {
            return true;
        };
        match &mut choice.choice {
            AssemblyChoice::Branch(_) => {}
            AssemblyChoice::Angle(angle) => *angle -= one.angle,
            AssemblyChoice::Near { point, .. } => *point = one.on_base(*point).at,
        }
        choice.link = one.base.unwrap_or(choice.link);
        one.base.is_some()
    });
}

impl AttachedLink {
    /// A point of it as a point of its base.
    fn on_base(&self, at: [f64; 2]) -> PointOf {
        let Self {
            base,
            angle,
            at: own,
            ..
        } = *self;
        let place = Place {
            base,
            at: own,
            angle,
        };
        PointOf {
            link: base,
            at: place.point(at),
        }
    }

    /// Its angle, those of all links being known (rad).
    pub(super) fn angle_of_link(&self, angles: &[f64]) -> f64 {
        self.base.map_or(0.0, |base| angles[base]) + self.angle
    }

    /// Its frame, where that of its base is known.
    pub(super) fn frame<const N: usize>(&self, base: &Frame<N>) -> Frame<N> {
        let (sin, cos) = self.angle.sin_cos();
        Frame {
            at: base.place(self.at),
            direction: base.direction.turn_constant([cos, sin]),
        }
    }
}

/// Coordinate of a pair as one between the bases of its links, less that between these (rad).
pub(super) fn shift(pair: &PairSpec, attached: &[AttachedLink]) -> f64 {
    if pair.slides() {
        return 0.0;
    }
    let angle = |end: &PointOf| {
        let one = attached.iter().find(|one| Some(one.link) == end.link);
        one.map_or(0.0, |one| one.angle)
    };
    angle(&pair.on) - angle(&pair.link)
}

/// Refuses welds that join what is joined already, and what they would stop.
pub(super) fn check(spec: &LinkageSpec, faults: &mut Faults) {
    let ground = spec.links.len();
    let mut tied: Vec<usize> = (0..=ground).collect();
    for weld in &spec.welds {
        let [one, other] = [weld.on.link, weld.link.link].map(|link| link.unwrap_or(ground));
        let path = format!("pairs.{}", weld.name);
        faults.finite(&format!("{path}.angle"), weld.angle);
        let (Some(&a), Some(&b)) = (tied.get(one), tied.get(other)) else {
            faults.add(path, "there is no such link", "");
            return;
        };
        if a == b {
            let message = "it joins links that are one body already";
            faults.add(path, message, "leave it out");
        }
        tied.iter_mut()
            .filter(|class| **class == a)
            .for_each(|class| *class = b);
    }
    for (index, pair) in spec.pairs.iter().enumerate() {
        let ends = [pair.on.link, pair.link.link];
        let classes = ends.map(|link| tied.get(link.unwrap_or(ground)).copied());
        if ends[0] != ends[1] && classes[0] == classes[1] {
            faults.add(
                format!("pairs.{}", pair.name),
                "its links are welded together, it cannot move",
                "leave it out, or a weld",
            );
        } else if index == spec.driver {
            let fixed =
                |link: &Option<usize>| link.is_some_and(|link| tied.get(link) == tied.get(ground));
            if ends.iter().any(fixed) {
                faults.add(
                    format!("pairs.{}", pair.name),
                    "the driver sits on a link that is welded to the ground",
                    "name a point of the ground in its place",
                );
            }
        }
    }
    for coupling in &spec.couplings {
        let welded = |link: usize| {
            spec.welds
                .iter()
                .any(|weld| [weld.on.link, weld.link.link].contains(&Some(link)))
        };
        if coupling.links().into_iter().flatten().any(welded) {
            faults.add(
                format!("couplings.{}", coupling.name),
                "it couples a link that is welded to another one",
                "make both one link with the points of both",
            );
        }
    }
}
