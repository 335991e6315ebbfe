//! Where the axes of coupled wheels lie on their carrier.

use super::{ends, named};
use crate::kinematics::linkage::spec::{CouplingKind, CouplingSpec, LinkageSpec, PairSpec};
use crate::units::shown;

/// Pins of a link this far apart, over the greatest coordinate of all pairs, lie in one place.
const SAME_PLACE: f64 = 1e-9;

/// How two coupled links stand to their carrier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::kinematics::linkage) struct Meeting {
    /// The axes of the wheels in the frame of the carrier (m); of a rack the first one, twice.
    pub(in crate::kinematics::linkage) axes: [[f64; 2]; 2],
    /// The guide of a rack, and the sign of its pair's coordinate for the rack's displacement.
    pub(in crate::kinematics::linkage) guide: Option<(usize, f64)>,
}

/// What is wrong with the links of wheels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::kinematics::linkage) enum Mismatch {
    /// A link that stands for two of them.
    Same(Option<usize>),
    /// A wheel that does not turn about a point of the carrier.
    NoAxis(Option<usize>),
    /// The rack has no guide on the carrier.
    NoGuide,
    /// Both axes lie in the same place.
    OneAxis,
    /// Pulleys that overlap: sum or difference of their radii, distance of their axes (m).
    Overlap(f64, f64),
    /// Gears of one size, one inside the other.
    NoDifference,
}

impl CouplingSpec {
    /// Whether its links are joined as it needs: a cam and its roller need not be.
    pub(super) fn fits(&self, pairs: &[PairSpec]) -> Result<(), Mismatch> {
        let [one, other] = self.wheels;
        match self.kind {
            CouplingKind::Cam(_) if one == other => Err(Mismatch::Same(one)),
            CouplingKind::Cam(_) => Ok(()),
            _ => self.axis_positions(pairs).map(|_| ()),
        }
    }

    /// Where the axes of its wheels lie; a cam has none.
    pub(in crate::kinematics::linkage) fn axis_positions(
        &self,
        pairs: &[PairSpec],
    ) -> Result<Meeting, Mismatch> {
        let [one, other, carrier] = self.links();
        if let CouplingKind::Cam(_) = self.kind {
            return Err(Mismatch::NoAxis(one));
        }
        if one == other || one == carrier {
            return Err(Mismatch::Same(one));
        }
        if other == carrier {
            return Err(Mismatch::Same(other));
        }
        let axis = |wheel| axis(pairs, carrier, wheel).ok_or(Mismatch::NoAxis(wheel));
        let first = axis(one)?;
        if let CouplingKind::Rack { .. } = self.kind {
            let guide = guide(pairs, carrier, other).ok_or(Mismatch::NoGuide)?;
            return Ok(Meeting {
                axes: [first; 2],
                guide: Some(guide),
            });
        }
        let axes = [first, axis(other)?];
        let apart = (axes[1][0] - axes[0][0]).hypot(axes[1][1] - axes[0][1]);
        if !(apart > 0.0) {
            return Err(Mismatch::OneAxis);
        }
        match self.kind {
            CouplingKind::Belt {
                radii: [one, other],
            } if (one - other).abs() >= apart => Err(Mismatch::Overlap((one - other).abs(), apart)),
            CouplingKind::Gear { ratio: 1.0 } => Err(Mismatch::NoDifference),
            _ => Ok(Meeting { axes, guide: None }),
        }
    }
}

/// The guide that joins a rack to its carrier, and the sign of its coordinate.
fn guide(pairs: &[PairSpec], carrier: Option<usize>, rack: Option<usize>) -> Option<(usize, f64)> {
    pairs.iter().enumerate().find_map(|(index, pair)| {
        let sense = match (pair.on.link == carrier, pair.link.link == carrier) {
            (true, _) if pair.link.link == rack => 1.0,
            (_, true) if pair.on.link == rack => -1.0,
            _ => return None,
        };
        pair.slides().then_some((index, sense))
    })
}

/// The point of the carrier about which a wheel turns: a pin between them, or several in one place.
pub(super) fn axis(
    pairs: &[PairSpec],
    carrier: Option<usize>,
    wheel: Option<usize>,
) -> Option<[f64; 2]> {
    let pins = pairs.iter().filter(|pair| !pair.slides());
    let mut starts = pins.filter_map(|pin| ends(pin, carrier));
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
        let Some((own, next, there)) = ends(pin, link) else {
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

/// The links (and the ground) that can carry two wheels, or a wheel and a rack.
pub(crate) fn carriers(
    links: usize,
    pairs: &[PairSpec],
    wheels: [Option<usize>; 2],
    rack: bool,
) -> Vec<Option<usize>> {
    let [one, other] = wheels;
    let carries = |carrier: &Option<usize>| {
        let second = match rack {
            true => guide(pairs, *carrier, other).is_some(),
            false => axis(pairs, *carrier, other).is_some(),
        };
        !wheels.contains(carrier) && second && axis(pairs, *carrier, one).is_some()
    };
    let all = std::iter::once(None).chain((0..links).map(Some));
    all.filter(carries).collect()
}

impl Mismatch {
    /// What is wrong, and what would be right.
    pub(super) fn in_words(self, spec: &LinkageSpec, coupling: &CouplingSpec) -> [String; 2] {
        let carrier = named(spec, coupling.carrier);
        let (message, hint) = match self {
            Self::Same(link) => (
                format!("{} stands in it twice", named(spec, link)),
                match coupling.kind {
                    CouplingKind::Cam(_) => "name points of two different links".to_owned(),
                    _ => "name two wheels and the link that carries both".to_owned(),
                },
            ),
            Self::NoAxis(wheel) => (
                format!(
                    "{} does not turn about a point of {carrier}",
                    named(spec, wheel)
                ),
                "join them by a pin, or by several in one place".to_owned(),
            ),
            Self::NoGuide => (
                format!(
                    "no guide joins the rack {} to {carrier}",
                    named(spec, coupling.wheels[1])
                ),
                "join them by a sliding pair".to_owned(),
            ),
            Self::OneAxis => (
                "both wheels turn about the same point".to_owned(),
                "put a third wheel between them, on an axis of its own".to_owned(),
            ),
            Self::Overlap(reach, apart) => (
                format!(
                    "the pulleys touch each other: their axes are {} m apart, the radii take {} m",
                    shown(apart, 6),
                    shown(reach, 6)
                ),
                "give smaller diameters".to_owned(),
            ),
            Self::NoDifference => (
                "internal gears of the same size cannot roll on each other".to_owned(),
                "give other numbers of teeth, or a belt".to_owned(),
            ),
        };
        [message, hint]
    }
}
