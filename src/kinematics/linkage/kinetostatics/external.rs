//! External forces: weights, struts, forces, couples, torsion springs, tables.

use super::positions::{LinkPosition, PointPosition};
use crate::kinematics::linkage::forces::interpolate;
use crate::kinematics::linkage::spec::{ForceLaw, PointOf};

/// A force at a point and a couple on one link; on the ground they change nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Wrench {
    /// The link; `None`: the ground.
    pub(super) link: Option<usize>,
    /// Point that the force acts on, with its motion.
    pub(super) point: PointPosition,
    /// The force (N).
    pub(super) force: [f64; 2],
    /// The couple (N·m).
    pub(super) couple: f64,
}

/// Motion of the input as the laws of force see it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Input {
    /// Coordinate (rad or m).
    pub(super) coordinate: f64,
    /// Speed of the point.
    pub(super) speed: f64,
}

/// A point of a link or of the ground, with its derivatives.
#[inline]
pub(super) fn point_of(links: &[LinkPosition], point: &PointOf) -> PointPosition {
    match point.link {
        Some(link) => links[link].point(point.at),
        None => LinkPosition::GROUND.point(point.at),
    }
}

/// What a law of force does to the links, as up to two wrenches.
///
/// `pair` gives the relative coordinate of the pair of a torsion spring and its
/// derivative by the input coordinate, `ends` the links it joins.
pub(super) fn wrenches(
    law: &ForceLaw,
    links: &[LinkPosition],
    input: Input,
    pair: impl Fn(usize) -> [f64; 2],
    ends: impl Fn(usize) -> [Option<usize>; 2],
) -> [Option<Wrench>; 2] {
    match law {
        ForceLaw::Strut { from, to, .. } => {
            let (start, end) = (point_of(links, from), point_of(links, to));
            let pull = strut_pull(law, &start, &end, input.speed);
            let back = [-pull[0], -pull[1]];
            [
                Some(Wrench::force(from.link, start, pull)),
                Some(Wrench::force(to.link, end, back)),
            ]
        }
        ForceLaw::Force {
            point,
            force,
            follows,
        } => {
            let force = match point.link {
                Some(link) if *follows => links[link].vector_in_ground(*force),
                _ => *force,
            };
            let at = point_of(links, point);
            [Some(Wrench::force(point.link, at, force)), None]
        }
        ForceLaw::Couple { link, couple } => [Some(Wrench::couple(Some(*link), *couple)), None],
        ForceLaw::CoupleTable {
            link,
            points,
            period,
        } => {
            let couple = interpolate(points, *period, input.coordinate)[0];
            [Some(Wrench::couple(Some(*link), couple)), None]
        }
        ForceLaw::Torsion {
            pair: index,
            rate,
            free_angle,
            damping,
        } => {
            let [angle, rate_of_turn] = pair(*index);
            let couple = -rate * (angle - free_angle) - damping * rate_of_turn * input.speed;
            let [on, link] = ends(*index);
            [
                Some(Wrench::couple(link, couple)),
                Some(Wrench::couple(on, -couple)),
            ]
        }
        ForceLaw::Table {
            point,
            direction,
            points,
            period,
        } => {
            let size = interpolate(points, *period, input.coordinate)[0];
            let force = [size * direction.cos(), size * direction.sin()];
            let at = point_of(links, point);
            [Some(Wrench::force(point.link, at, force)), None]
        }
    }
}

impl Wrench {
    /// A force at a point.
    pub(super) fn force(link: Option<usize>, point: PointPosition, force: [f64; 2]) -> Self {
        Self {
            link,
            point,
            force,
            couple: 0.0,
        }
    }

    /// A couple.
    pub(super) fn couple(link: Option<usize>, couple: f64) -> Self {
        Self {
            link,
            point: PointPosition::default(),
            force: [0.0; 2],
            couple,
        }
    }

    /// Generalised force along the input coordinate, per unit of it: virtual
    /// work of the wrench.
    #[inline]
    pub(super) fn generalised(&self, links: &[LinkPosition]) -> f64 {
        match self.link {
            Some(link) => {
                self.force[0] * self.point.first[0]
                    + self.force[1] * self.point.first[1]
                    + self.couple * links[link].first[2]
            }
            None => 0.0,
        }
    }
}

/// Pull of a strut on its start, towards its end; zero where both ends meet,
/// which gives it no direction.
fn strut_pull(law: &ForceLaw, start: &PointPosition, end: &PointPosition, speed: f64) -> [f64; 2] {
    let &ForceLaw::Strut {
        rate,
        free_length,
        damping,
        force,
        ..
    } = law
    else {
        return [0.0; 2];
    };
    let along = [end.place[0] - start.place[0], end.place[1] - start.place[1]];
    if free_length == 0.0 && damping == 0.0 && force == 0.0 {
        // Smooth where both ends meet: no direction is needed.
        return [rate * along[0], rate * along[1]];
    }
    let length = along[0].hypot(along[1]);
    if length == 0.0 {
        return [0.0; 2];
    }
    let unit = [along[0] / length, along[1] / length];
    let lengthening = speed
        * (unit[0] * (end.first[0] - start.first[0]) + unit[1] * (end.first[1] - start.first[1]));
    let tension = rate * (length - free_length) + damping * lengthening + force;
    [tension * unit[0], tension * unit[1]]
}
