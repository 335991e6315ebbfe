//! Outputs of a linkage of several inputs, by all of them.

use super::MultiWorkspace;
use super::twist::{at, minus};
use crate::kinematics::linkage::spec::OutputKind;
use crate::math::number::Number;

impl<N: Number> MultiWorkspace<N> {
    /// An output at the position solved for (rad or m), its derivatives by the inputs into
    /// `first` (m numbers), and its second derivative in time while the accelerations of all
    /// inputs are zero.
    pub(crate) fn output(&self, kind: &OutputKind, first: &mut [N]) -> [N; 2] {
        let (plan, columns) = (&self.core.plan, &self.columns);
        let ground = plan.bodies;
        match *kind {
            OutputKind::Angle { link } => {
                for (input, first) in first.iter_mut().enumerate() {
                    *first = columns.column(plan, link, input)[0];
                }
                [self.angles[link], columns.acceleration[link][0]]
            }
            OutputKind::Point { point, direction } => {
                let body = point.link.unwrap_or(ground);
                let (sin, cos) = direction.sin_cos();
                let along = |[x, y]: [N; 2]| x.scale(cos) + y.scale(sin);
                let place = columns.poses[body].point_to_ground(point.at);
                for (input, first) in first.iter_mut().enumerate() {
                    *first = along(at(&columns.column(plan, body, input), place));
                }
                let [x0, y0] = columns.reference;
                let velocity = &columns.velocity[body];
                let [vx, vy] = at(velocity, place);
                let [ax, ay] = at(&columns.acceleration[body], place);
                let bent = [ax - velocity[0] * vy, ay + velocity[0] * vx];
                [along(place) + N::from(cos * x0 + sin * y0), along(bent)]
            }
            OutputKind::Pair { pair } => {
                let pair = &self.core.spec.linkage.pairs[pair];
                let [i, j] = [pair.on.link, pair.link.link].map(|link| link.unwrap_or(ground));
                let bent = minus(columns.acceleration[j], columns.acceleration[i]);
                let relative = |input: usize| {
                    minus(
                        columns.column(plan, j, input),
                        columns.column(plan, i, input),
                    )
                };
                if let Some(direction) = pair.direction() {
                    let along = columns.poses[i].direction_to_ground(direction);
                    let on = |twist: [N; 3]| along[0] * twist[1] + along[1] * twist[2];
                    let [from, to] = [
                        columns.poses[i].point_to_ground(pair.on.at),
                        columns.poses[j].point_to_ground(pair.link.at),
                    ];
                    for (input, first) in first.iter_mut().enumerate() {
                        *first = on(relative(input));
                    }
                    let way = along[0] * (to[0] - from[0]) + along[1] * (to[1] - from[1]);
                    return [way, on(bent)];
                }
                for (input, first) in first.iter_mut().enumerate() {
                    *first = relative(input)[0];
                }
                let angle = |body: usize| match body == ground {
                    true => N::from(0.0),
                    false => self.angles[body],
                };
                [angle(j) - angle(i), bent[0]]
            }
        }
    }
}
