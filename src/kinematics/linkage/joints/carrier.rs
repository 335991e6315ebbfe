//! Where the axes of coupled wheels lie on their carrier.

use super::super::spec::pair::PairSpec;
use super::CouplingSpec;

/// Pins of a link this far apart, over the greatest coordinate of all pairs, lie in one place.
const SAME_PLACE: f64 = 1e-9;

/// What is said of a link and the carrier, by their names: what is wrong, and what would be right.
type Said = fn(&str, &str) -> [String; 2];

/// What is wrong with the links of a joint.
#[derive(Clone, Debug)]
pub(in crate::kinematics::linkage) enum Mismatch {
    /// A link that stands for two of them, and what would be right.
    Same(Option<usize>, &'static str),
    /// A link that is not joined to the carrier as it must be.
    Apart(Option<usize>, Said),
    /// What is wrong, and what would be right.
    Own([String; 2]),
}

impl Mismatch {
    /// A wheel that does not turn about a point of the carrier.
    pub(super) fn no_axis(wheel: Option<usize>) -> Self {
        Self::Apart(wheel, |wheel, carrier| {
            let message = format!("{wheel} does not turn about a point of {carrier}");
            let hint = "join them by a pin, or by several in one place";
            [message, hint.to_owned()]
        })
    }

    /// What is wrong, and what would be right.
    pub(in crate::kinematics::linkage) fn in_words(
        self,
        coupling: &CouplingSpec,
        named: impl Fn(Option<usize>) -> String,
    ) -> [String; 2] {
        match self {
            Self::Same(link, hint) => [
                format!("{} occurs in it twice", named(link)),
                hint.to_owned(),
            ],
            Self::Apart(link, said) => said(&named(link), &named(coupling.carrier)),
            Self::Own(words) => words,
        }
    }
}

/// Both wheels and their carrier are different links.
pub(super) fn require_distinct_links(coupling: &CouplingSpec) -> Result<(), Mismatch> {
    let [one, other, carrier] = coupling.links();
    let hint = "name two wheels and the link that carries both";
    match () {
        () if one == other || one == carrier => Err(Mismatch::Same(one, hint)),
        () if other == carrier => Err(Mismatch::Same(other, hint)),
        () => Ok(()),
    }
}

/// The axes of both wheels in the frame of the carrier (m), which do not coincide.
pub(super) fn axes(coupling: &CouplingSpec, pairs: &[PairSpec]) -> Result<[[f64; 2]; 2], Mismatch> {
    require_distinct_links(coupling)?;
    let [one, other, carrier] = coupling.links();
    let axis = |wheel| axis(pairs, carrier, wheel).ok_or(Mismatch::no_axis(wheel));
    let axes = [axis(one)?, axis(other)?];
    let apart = (axes[1][0] - axes[0][0]).hypot(axes[1][1] - axes[0][1]);
    if !(apart > 0.0) {
        let message = "both wheels turn about the same point".to_owned();
        let hint = "put a third wheel between them, on an axis of its own".to_owned();
        return Err(Mismatch::Own([message, hint]));
    }
    Ok(axes)
}

/// How pairs are joined to a link: the points of this link and of the other, and the other.
fn points_of_pair(
    pair: &PairSpec,
    link: Option<usize>,
) -> Option<([f64; 2], Option<usize>, [f64; 2])> {
    let (on, to) = (pair.on, pair.link);
    match (on.link == link, to.link == link) {
        (true, _) => Some((on.at, to.link, to.at)),
        (_, true) => Some((to.at, on.link, on.at)),
        _ => None,
    }
}

/// The guide that joins a link to the one that carries it.
pub(super) fn guide(
    pairs: &[PairSpec],
    carrier: Option<usize>,
    slide: Option<usize>,
) -> Option<&PairSpec> {
    let joins = |pair: &&PairSpec| {
        let links = [pair.on.link, pair.link.link];
        pair.slides() && (links == [carrier, slide] || links == [slide, carrier])
    };
    pairs.iter().find(joins)
}

/// The point of the carrier about which a wheel turns: a pin between them, or several in one place.
pub(super) fn axis(
    pairs: &[PairSpec],
    carrier: Option<usize>,
    wheel: Option<usize>,
) -> Option<[f64; 2]> {
    let pins = pairs.iter().filter(|pair| !pair.slides());
    let mut starts = pins.filter_map(|pin| points_of_pair(pin, carrier));
    let leads = |&(_, link, at): &(_, _, [f64; 2])| {
        // On one axis a link has one point.
        leads(pairs, (link, at), wheel, &mut vec![carrier])
    };
    starts.find(leads).map(|(start, ..)| start)
}

/// True where a link, or others on pins in one place with this one of it, is the wheel.
fn leads(
    pairs: &[PairSpec],
    (link, at): (Option<usize>, [f64; 2]),
    wheel: Option<usize>,
    seen: &mut Vec<Option<usize>>,
) -> bool {
    if link == wheel {
        return true;
    }
    let near = SAME_PLACE * greatest(pairs);
    seen.push(link);
    let mut pins = pairs.iter().filter(|pair| !pair.slides());
    pins.any(|pin| {
        let Some((own, next, there)) = points_of_pair(pin, link) else {
            return false;
        };
        let apart = (own[0] - at[0]).hypot(own[1] - at[1]);
        apart <= near && !seen.contains(&next) && leads(pairs, (next, there), wheel, seen)
    })
}

/// The greatest coordinate of all pairs.
fn greatest(pairs: &[PairSpec]) -> f64 {
    let points = pairs.iter().flat_map(|pair| [pair.on.at, pair.link.at]);
    points.flatten().fold(0.0, |most, x| most.max(x.abs()))
}

/// The links (and the ground) that can carry two wheels, or a wheel and what slides.
pub(crate) fn carriers(
    links: usize,
    pairs: &[PairSpec],
    wheels: [Option<usize>; 2],
    slides: bool,
) -> Vec<Option<usize>> {
    let [one, other] = wheels;
    let carries = |carrier: &Option<usize>| {
        let second = match slides {
            true => guide(pairs, *carrier, other).is_some(),
            false => axis(pairs, *carrier, other).is_some(),
        };
        !wheels.contains(carrier) && second && axis(pairs, *carrier, one).is_some()
    };
    let all = std::iter::once(None).chain((0..links).map(Some));
    all.filter(carries).collect()
}
