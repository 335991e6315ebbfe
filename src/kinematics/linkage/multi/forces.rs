//! Springs, dampers and forces on the links of a linkage of several inputs.

use super::columns::Columns;
use super::dynamics::MultiReduced;
use super::plan::MultiPlan;
use super::twist::at;
use crate::kinematics::linkage::spec::{ForceLaw, LinkageSpec, PointOf};
use crate::math::number::{Number, sqrt};

/// What dampers and forces take and give at an instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MultiPower {
    /// Power lost in dampers, ≥ 0 (W).
    pub dissipated: f64,
    /// Power of constant forces and couples (W).
    pub applied: f64,
}

/// Where a force asks: positions and velocities, and continuous angles.
pub(super) struct Surroundings<'a, N> {
    pub(super) plan: &'a MultiPlan,
    pub(super) spec: &'a LinkageSpec,
    pub(super) columns: &'a Columns<N>,
    /// Angles of all bodies (rad).
    pub(super) angles: &'a [N],
}

/// Where a strut is, and how it lengthens.
struct Strut<N> {
    /// Its ends, seen from the reference point.
    ends: [[N; 2]; 2],
    /// From the first to the second.
    apart: [N; 2],
    length: N,
    rate: N,
}

impl<N: Number> Surroundings<'_, N> {
    fn body_of_point(&self, point: PointOf) -> usize {
        self.plan.body_of_link(point.link)
    }

    /// A point from the reference point, and its velocity.
    pub(super) fn point(&self, point: PointOf) -> [[N; 2]; 2] {
        let body = self.body_of_point(point);
        let place = self.columns.poses[body].point_to_ground(point.at);
        [place, at(&self.columns.velocity[body], place)]
    }

    /// A strut from one point to another; `None` where they meet, and it has no direction.
    fn strut(&self, from: PointOf, to: PointOf) -> Option<Strut<N>> {
        let [[p, v], [q, w]] = [from, to].map(|point| self.point(point));
        let apart = [q[0] - p[0], q[1] - p[1]];
        let square = apart[0] * apart[0] + apart[1] * apart[1];
        if !(square.value() > 0.0) {
            return None;
        }
        let length = sqrt(square);
        let drawn = apart[0] * (w[0] - v[0]) + apart[1] * (w[1] - v[1]);
        Some(Strut {
            ends: [p, q],
            apart,
            length,
            rate: drawn / length,
        })
    }

    /// The angle of a link; of the ground zero.
    pub(super) fn angle(&self, link: Option<usize>) -> N {
        link.map_or(N::from(0.0), |link| self.angles[link])
    }

    /// Angle of a revolute pair, and its rate.
    fn angle_and_rate(&self, pair: usize) -> [N; 2] {
        let pair = &self.spec.pairs[pair];
        let [i, j] = [pair.on.link, pair.link.link];
        let rate = |link: Option<usize>| self.columns.velocity[self.plan.body_of_link(link)][0];
        [self.angle(j) - self.angle(i), rate(j) - rate(i)]
    }
}

impl<N: Number> MultiReduced<N> {
    /// Adds the forces to the wrenches on the links, those of dampers where they are asked
    /// for.
    pub(super) fn load(&mut self, around: &Surroundings<'_, N>, dampers: bool) {
        let damped = |damping: f64| if dampers { damping } else { 0.0 };
        for force in &around.spec.forces {
            match &force.law {
                ForceLaw::Strut {
                    from,
                    to,
                    rate,
                    free_length,
                    damping,
                    force,
                } => {
                    let Some(strut) = around.strut(*from, *to) else {
                        continue;
                    };
                    let tension = (strut.length - N::from(*free_length)).scale(*rate)
                        + strut.rate.scale(damped(*damping))
                        + N::from(*force);
                    let pull = tension / strut.length;
                    let pull = strut.apart.map(|part| part * pull);
                    let [p, q] = strut.ends;
                    self.push(around.body_of_point(*from), p, pull);
                    self.push(around.body_of_point(*to), q, pull.map(|part| -part));
                }
                ForceLaw::Torsion {
                    pair,
                    rate,
                    free_angle,
                    damping,
                } => {
                    let [angle, speed] = around.angle_and_rate(*pair);
                    let moment =
                        (angle - N::from(*free_angle)).scale(*rate) + speed.scale(damped(*damping));
                    let pair = &around.spec.pairs[*pair];
                    self.wrenches[around.body_of_point(pair.on)][0] += moment;
                    self.wrenches[around.body_of_point(pair.link)][0] -= moment;
                }
                ForceLaw::Force {
                    point,
                    force,
                    follows,
                } => {
                    let body = around.body_of_point(*point);
                    let [place, _] = around.point(*point);
                    let force = match follows {
                        true => around.columns.poses[body].direction_to_ground(*force),
                        false => force.map(N::from),
                    };
                    self.push(body, place, force);
                }
                ForceLaw::Couple { link, couple } => {
                    self.wrenches[*link][0] += N::from(*couple);
                }
                // Refused beforehand: over which of the inputs?
                ForceLaw::Table { .. } | ForceLaw::CoupleTable { .. } => {}
            }
        }
    }
}

impl<N: Number> Surroundings<'_, N> {
    /// Kinetic energy, and potential energy of weights and springs (J).
    pub(super) fn energies(&self) -> [N; 2] {
        let ([gx, gy], [x0, y0]) = (self.spec.gravity, self.columns.reference);
        let (mut kinetic, mut potential) = (N::from(0.0), N::from(0.0));
        for (body, link) in self.spec.links.iter().enumerate() {
            if link.mass == 0.0 && link.moment == 0.0 {
                continue;
            }
            let [x, y] = self.columns.poses[body].point_to_ground(link.centre);
            let velocity = &self.columns.velocity[body];
            let [vx, vy] = at(velocity, [x, y]);
            kinetic += (vx * vx + vy * vy).scale(0.5 * link.mass);
            kinetic += (velocity[0] * velocity[0]).scale(0.5 * link.moment);
            let height = (x + N::from(x0)).scale(gx) + (y + N::from(y0)).scale(gy);
            potential -= height.scale(link.mass);
        }
        for force in &self.spec.forces {
            match &force.law {
                ForceLaw::Strut {
                    from,
                    to,
                    rate,
                    free_length,
                    force,
                    ..
                } => {
                    let strut = self.strut(*from, *to);
                    let length = strut.map_or(N::from(0.0), |strut| strut.length);
                    let drawn = length - N::from(*free_length);
                    potential += (drawn * drawn).scale(0.5 * rate) + length.scale(*force);
                }
                ForceLaw::Torsion {
                    pair,
                    rate,
                    free_angle,
                    ..
                } => {
                    let [angle, _] = self.angle_and_rate(*pair);
                    let turned = angle - N::from(*free_angle);
                    potential += (turned * turned).scale(0.5 * rate);
                }
                _ => {}
            }
        }
        [kinetic, potential]
    }
}

impl Surroundings<'_, f64> {
    /// What dampers and forces take and give.
    pub(super) fn power(&self) -> MultiPower {
        let mut sum = MultiPower::default();
        for force in &self.spec.forces {
            match &force.law {
                ForceLaw::Strut {
                    from, to, damping, ..
                } => {
                    let rate = self.strut(*from, *to).map_or(0.0, |strut| strut.rate);
                    sum.dissipated += damping * rate * rate;
                }
                ForceLaw::Torsion { pair, damping, .. } => {
                    let [_, speed] = self.angle_and_rate(*pair);
                    sum.dissipated += damping * speed * speed;
                }
                ForceLaw::Force {
                    point,
                    force,
                    follows,
                } => {
                    let [_, velocity] = self.point(*point);
                    let force = match follows {
                        true => self.columns.poses[self.body_of_point(*point)]
                            .direction_to_ground(*force),
                        false => *force,
                    };
                    sum.applied += force[0] * velocity[0] + force[1] * velocity[1];
                }
                ForceLaw::Couple { link, couple } => {
                    sum.applied += couple * self.columns.velocity[*link][0];
                }
                ForceLaw::Table { .. } | ForceLaw::CoupleTable { .. } => {}
            }
        }
        sum
    }
}

/// Faults of forces that several inputs do not bear.
pub(super) fn refused(spec: &LinkageSpec, faults: &mut crate::fault::Faults) {
    for force in &spec.forces {
        let path = format!("forces.{}", force.name);
        match &force.law {
            ForceLaw::Table { .. } | ForceLaw::CoupleTable { .. } => faults.add(
                path,
                "a table over the input coordinate belongs to a linkage of one input",
                "give a constant force or couple, or a load on one of the inputs",
            ),
            ForceLaw::Torsion { pair, .. } => {
                let turns = spec.pairs.get(*pair);
                if turns.is_some_and(|pair| pair.slides()) {
                    faults.add(
                        path,
                        "a torsion spring acts in a pin",
                        "name a revolute pair",
                    );
                }
            }
            _ => {}
        }
    }
}
