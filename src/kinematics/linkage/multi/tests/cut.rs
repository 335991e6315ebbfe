//! A link cut in two that are welded together: the same linkage, told otherwise.

use super::examples::{at, input};
use super::{MultiLinkage, MultiMotion};
use crate::kinematics::linkage::multi::spec::{InputCoordinate, MultiSpec};
use crate::kinematics::linkage::spec::{
    ForceLaw, LinkSpec, OutputKind, PairKind, PointOf, WeldSpec,
};

/// Where the frame of the part that is cut off lies in that of the link.
const PLACE: [f64; 2] = [0.13, -0.04];
const ANGLE: f64 = 0.7;

fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

/// A point of the link as one of the part that is cut off.
pub(super) fn in_part([x, y]: [f64; 2]) -> [f64; 2] {
    turned([x - PLACE[0], y - PLACE[1]], -ANGLE)
}

/// A linkage in which a part of a link, the last one, carries the `pairs` and all forces and points of
/// outputs of it; `about`: the weld names the part first.
pub(super) fn cut(whole: &MultiSpec, link: usize, pairs: &[usize], about: bool) -> MultiSpec {
    let mut spec = whole.clone();
    let linkage = &mut spec.linkage;
    let part = linkage.links.len();
    let give = |end: &mut PointOf| match end.link == Some(link) {
        true => {
            *end = at(Some(part), 0.0, 0.0);
            true
        }
        false => false,
    };
    let hand_over = |end: &mut PointOf| {
        let place = in_part(end.at);
        if give(end) {
            end.at = place;
            return true;
        }
        false
    };
    // By how much the coordinate of each pair changes.
    let mut changed = vec![0.0; linkage.pairs.len()];
    for &pair in pairs {
        let own = &mut linkage.pairs[pair];
        let [on, other] = [hand_over(&mut own.on), hand_over(&mut own.link)];
        assert!(on || other);
        let sign = if on { -1.0 } else { 1.0 };
        match &mut own.kind {
            PairKind::Revolute { .. } => changed[pair] = sign * ANGLE,
            PairKind::Sliding { direction, .. } if on => *direction -= ANGLE,
            PairKind::Sliding { angle, .. } => *angle += ANGLE,
        }
    }
    for input in &mut spec.inputs {
        if let InputCoordinate::Pair(pair) = input.coordinate {
            input.start += changed[pair];
        }
    }
    for force in &mut linkage.forces {
        match &mut force.law {
            ForceLaw::Strut { from, to, .. } => {
                hand_over(from);
                hand_over(to);
            }
            ForceLaw::Torsion {
                pair, free_angle, ..
            } => *free_angle += changed[*pair],
            ForceLaw::Force {
                point,
                force,
                follows,
            } => {
                let handed = hand_over(point);
                let turn = if handed && *follows { -ANGLE } else { 0.0 };
                *force = turned(*force, turn);
            }
            ForceLaw::Couple { link: own, .. } if *own == link => *own = part,
            _ => {}
        }
    }
    for output in &mut linkage.outputs {
        if let OutputKind::Point { point, .. } = &mut output.kind {
            hand_over(point);
        }
    }
    let half = split(&mut linkage.links[link]);
    linkage.links.push(half);
    let (on, own, angle) = match about {
        false => (at(Some(link), PLACE[0], PLACE[1]), [0.0; 2], ANGLE),
        true => (at(Some(part), 0.0, 0.0), PLACE, -ANGLE),
    };
    let other = if about { link } else { part };
    linkage.welds.push(WeldSpec {
        name: "W".to_owned(),
        on,
        link: at(Some(other), own[0], own[1]),
        angle,
    });
    spec
}

/// Takes two fifths of the mass of a link off it.
fn split(link: &mut LinkSpec) -> LinkSpec {
    let apart = 0.5 * (link.moment / link.mass).sqrt();
    let (mass, moment, [x, y]) = (link.mass, link.moment, link.centre);
    let half = LinkSpec {
        name: "part".to_owned(),
        mass: 0.4 * mass,
        centre: in_part([x + apart, y]),
        moment: 0.3 * moment,
        ..LinkSpec::default()
    };
    let back = apart * 0.4 / 0.6;
    link.mass = 0.6 * mass;
    link.centre = [x - back, y];
    let steiner = link.mass * back * back + half.mass * apart * apart;
    link.moment = 0.7 * moment - steiner;
    assert!(link.moment > 0.0);
    half
}

/// A five-bar whose second input is the pin between the rods: an input inside a group.
pub(super) fn knee() -> MultiSpec {
    let mut spec = super::examples::five_bar();
    let linkage = MultiLinkage::new(spec.clone()).unwrap();
    let starts: Vec<f64> = spec.inputs.iter().map(|input| input.start).collect();
    let mut motion = MultiMotion::new(&linkage);
    motion.set_inputs(&super::motion::at(&starts, 0.0)).unwrap();
    let angle = motion.pair(2).value;
    spec.inputs[1] = input("knee", InputCoordinate::Pair(2), angle);
    spec
}

/// A linkage, the same with a link cut in two, that link and the pairs that its part carries.
pub(super) struct Cut {
    pub(super) whole: MultiSpec,
    pub(super) cut: MultiSpec,
    pub(super) link: usize,
    pub(super) pairs: Vec<usize>,
}

/// Links of groups, links that inputs place, links that float, and such with inputs on both parts.
pub(super) fn all() -> Vec<Cut> {
    use super::examples::{excavator, five_bar, floating, pendulum, platform};
    let one = |whole: MultiSpec, link: usize, pairs: &[usize], about: bool| Cut {
        cut: cut(&whole, link, pairs, about),
        whole,
        link,
        pairs: pairs.to_vec(),
    };
    vec![
        one(five_bar(), 1, &[2], false),
        one(five_bar(), 2, &[2], true),
        one(five_bar(), 3, &[3], false),
        one(knee(), 1, &[2], false),
        one(knee(), 2, &[2], true),
        one(floating(), 0, &[3], true),
        one(floating(), 0, &[0], false),
        one(floating(), 1, &[1], false),
        one(excavator(), 0, &[0, 2], false),
        one(excavator(), 2, &[3], true),
        one(excavator(), 1, &[5, 6], false),
        one(platform(), 0, &[8], false),
        one(pendulum(4), 1, &[2], false),
        one(pendulum(4), 1, &[1], true),
    ]
}
