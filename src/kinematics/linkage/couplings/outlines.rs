//! What couplings look like: pitch circles, strands of belts, pitch lines of racks, cams with their
//! rollers.

use super::Meeting;
use super::meeting::axis;
use super::pitch::PitchCurve;
use crate::kinematics::linkage::spec::{
    CamPairSpec, CouplingKind, CouplingSpec, LinkageSpec, PairSpec,
};
use std::f64::consts::TAU;

/// Points of a cam's flank that are drawn.
const POINTS: u32 = 180;
/// Half the length of a rack's pitch line that is shown, in radii of its gear.
const LINE: f64 = 1.6;

/// A line that goes with a link; `None`: with the ground.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Outline {
    /// The pitch circle of a wheel: its link, its centre in that link's frame and its radius (m).
    Circle(Option<usize>, [f64; 2], f64),
    /// A strand of a belt or the pitch line of a rack: the carrier, both ends in its frame (m).
    Line(Option<usize>, [[f64; 2]; 2]),
    /// A closed curve: the flank of a cam in its frame (m).
    Flank(Option<usize>, Vec<[f64; 2]>),
    /// The roller of a cam: its link, its centre in that link's frame and its radius (m).
    Roller(Option<usize>, [f64; 2], f64),
}

/// The outlines of all couplings, these having been checked.
pub(crate) fn outlines(spec: &LinkageSpec) -> Vec<Outline> {
    let of = |coupling: &CouplingSpec| {
        if let CouplingKind::Cam(cam) = &coupling.kind {
            return of_cam(coupling.wheels, cam);
        }
        let meeting = coupling.axis_positions(&spec.pairs).ok()?;
        Some(of_one(coupling, &meeting, &spec.pairs))
    };
    spec.couplings.iter().filter_map(of).flatten().collect()
}

fn of_one(coupling: &CouplingSpec, meeting: &Meeting, pairs: &[PairSpec]) -> Vec<Outline> {
    let ([one, other], carrier) = (coupling.wheels, coupling.carrier);
    let circle = |wheel, radius: f64| {
        let centre = axis(pairs, wheel, carrier)?;
        Some(Outline::Circle(wheel, centre, radius.abs()))
    };
    let (u, apart) = direction(meeting.axes);
    let (circles, lines) = match coupling.kind {
        CouplingKind::Cam(_) => return Vec::new(),
        CouplingKind::Gear { ratio } => {
            let unit = apart / (ratio - 1.0);
            ([circle(one, ratio * unit), circle(other, unit)], Vec::new())
        }
        CouplingKind::Belt { radii: [r1, r2] } => {
            let strands = strands(meeting.axes, u, [r1, r2], apart);
            ([circle(one, r1), circle(other, r2)], strands)
        }
        CouplingKind::Rack { radius } => {
            let line = meeting.guide.map(|(guide, _)| {
                let along = along(&pairs[guide], carrier);
                pitch_line(meeting.axes[0], radius, along)
            });
            ([circle(one, radius), None], line.into_iter().collect())
        }
    };
    let lines = lines.into_iter().map(|ends| Outline::Line(carrier, ends));
    circles.into_iter().flatten().chain(lines).collect()
}

/// The flanks of a cam, or its pitch curve where a point runs on it, and the roller.
fn of_cam([own, other]: [Option<usize>; 2], cam: &CamPairSpec) -> Option<Vec<Outline>> {
    let curve = PitchCurve::new(cam).ok()?;
    let [x, y] = cam.centre;
    let flank = |offset: f64| {
        let angles = (0..POINTS).map(|place| TAU * f64::from(place) / f64::from(POINTS));
        let points = angles.map(|angle| curve.equidistant_point(angle, offset));
        Outline::Flank(own, points.map(|[u, v]| [x + u, y + v]).collect())
    };
    let flanks = match cam.roller_radius > 0.0 {
        true => cam.surface.flanks(cam.roller_radius),
        false => vec![0.0],
    };
    let mut all: Vec<Outline> = flanks.into_iter().map(flank).collect();
    all.push(Outline::Roller(other, cam.roller, cam.roller_radius));
    Some(all)
}

/// Direction from one axis to the other, and their distance.
fn direction([[x, y], [to_x, to_y]]: [[f64; 2]; 2]) -> ([f64; 2], f64) {
    let [dx, dy] = [to_x - x, to_y - y];
    let apart = dx.hypot(dy);
    ([dx / apart, dy / apart], apart)
}

/// The two lines that touch both pulleys: on one side, or crossing where the second radius is
/// negative.
fn strands(
    [a, b]: [[f64; 2]; 2],
    [ux, uy]: [f64; 2],
    [r1, r2]: [f64; 2],
    apart: f64,
) -> Vec<[[f64; 2]; 2]> {
    let cos = (r1 - r2) / apart;
    // Crossed pulleys that touch or overlap have no free strands.
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    let strand = |sin: f64| {
        let (nx, ny) = (cos * ux - sin * uy, cos * uy + sin * ux);
        [
            [a[0] + r1 * nx, a[1] + r1 * ny],
            [b[0] + r2 * nx, b[1] + r2 * ny],
        ]
    };
    vec![strand(sin), strand(-sin)]
}

/// The direction of a guide in the frame of the carrier.
fn along(guide: &PairSpec, carrier: Option<usize>) -> [f64; 2] {
    let [on, link] = crate::kinematics::linkage::elements::elements(guide);
    if on.link == carrier {
        on.along
    } else {
        link.along
    }
}

fn pitch_line([x, y]: [f64; 2], radius: f64, [tx, ty]: [f64; 2]) -> [[f64; 2]; 2] {
    let (x, y) = (x + radius * ty, y - radius * tx);
    [-1.0, 1.0].map(|end| {
        let reach = end * LINE * radius.abs();
        [x + reach * tx, y + reach * ty]
    })
}
