//! Springs, dampers and forces on the input coordinate.

use super::Linkage;
use super::spec::{ForceLaw, PointOf};
use super::workspace::Workspace;
use crate::kinematics::breaks::Breaks;
use crate::math::jet::Jet;

/// Contribution of one spring, damper or force on the input coordinate; meanings and
/// orders as in [`ReducedLinkage`](super::ReducedLinkage).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ForcePart {
    /// V, V′, V″ (J).
    pub potential: [f64; 3],
    /// Q, Q′ (N·m or N).
    pub force: [f64; 2],
    /// D, D′.
    pub damping: [f64; 2],
}

impl ForceLaw {
    /// The points of a table over the input coordinate; `None` for what has no table.
    pub fn breaks(&self) -> Option<Breaks> {
        match self {
            Self::CoupleTable { points, period, .. } | Self::Table { points, period, .. } => {
                Some(Breaks {
                    points: points.iter().map(|point| point.0).collect(),
                    period: *period,
                })
            }
            Self::Strut { .. }
            | Self::Force { .. }
            | Self::Couple { .. }
            | Self::Torsion { .. } => None,
        }
    }
}

impl Linkage {
    /// Contribution of one of [`LinkageSpec::forces`](super::spec::LinkageSpec::forces)
    /// at the position solved for.
    pub fn force_part(&self, index: usize, workspace: &Workspace) -> ForcePart {
        match &self.spec().forces[index].law {
            ForceLaw::Strut {
                from,
                to,
                rate,
                free_length,
                damping,
                force,
            } => {
                let length = distance_between(*from, *to, workspace);
                let part = spring_and_damper(length, *rate, *free_length, *damping);
                with_tension(part, length, *force)
            }
            ForceLaw::Torsion {
                pair,
                rate,
                free_angle,
                damping,
            } => spring_and_damper(workspace.pair(*pair), *rate, *free_angle, *damping),
            ForceLaw::Force {
                point,
                force,
                follows,
            } => constant_force(*point, *force, *follows, workspace),
            ForceLaw::Couple { link, couple } => ForcePart {
                force: [1, 2].map(|k| couple * workspace.transfer(*link, k)[2]),
                ..ForcePart::default()
            },
            ForceLaw::CoupleTable {
                link,
                points,
                period,
            } => {
                let [m, dm] = interpolate(points, *period, workspace.input());
                let [first, second] = [1, 2].map(|k| workspace.transfer(*link, k)[2]);
                ForcePart {
                    force: [m * first, dm * first + m * second],
                    ..ForcePart::default()
                }
            }
            ForceLaw::Table {
                point,
                direction,
                points,
                period,
            } => {
                let [f, df] = interpolate(points, *period, workspace.input());
                let (sin, cos) = direction.sin_cos();
                let [x, y] = workspace.point(*point);
                let [along, slope] = [
                    cos * x.first + sin * y.first,
                    cos * x.second + sin * y.second,
                ];
                ForcePart {
                    force: [f * along, df * along + f * slope],
                    ..ForcePart::default()
                }
            }
        }
    }
}

/// Distance of two points. Where they coincide the distance has a kink: its
/// derivatives are taken as zero there.
fn distance_between(from: PointOf, to: PointOf, workspace: &Workspace) -> Jet {
    let place = |point: PointOf| {
        let (at, direction) = workspace.frame(point.link);
        at + direction.turn_constant(point.at)
    };
    let square = (place(to) - place(from)).square();
    if square.value() > 0.0 {
        workspace.jet(square.sqrt())
    } else {
        Jet::default()
    }
}

/// V = ½·rate·(x − free)², D = damping·x′².
fn spring_and_damper(x: Jet, rate: f64, free: f64, damping: f64) -> ForcePart {
    let stretch = x.value - free;
    ForcePart {
        potential: [
            0.5 * rate * stretch * stretch,
            rate * stretch * x.first,
            rate * (x.first * x.first + stretch * x.second),
        ],
        force: [0.0; 2],
        damping: [
            damping * x.first * x.first,
            2.0 * damping * x.first * x.second,
        ],
    }
}

/// Adds a constant tension over the length: V = force·length.
fn with_tension(mut part: ForcePart, length: Jet, force: f64) -> ForcePart {
    for (sum, order) in part
        .potential
        .iter_mut()
        .zip([length.value, length.first, length.second])
    {
        *sum += force * order;
    }
    part
}

fn constant_force(
    point: PointOf,
    force: [f64; 2],
    follows: bool,
    workspace: &Workspace,
) -> ForcePart {
    let [x, y] = workspace.point(point);
    let (mut now, mut change) = (force, [0.0; 2]);
    if let (true, Some(link)) = (follows, point.link) {
        let pose = workspace.pose(link);
        now = [
            pose.cos * force[0] - pose.sin * force[1],
            pose.sin * force[0] + pose.cos * force[1],
        ];
        let turning = workspace.transfer(link, 1)[2];
        change = [-turning * now[1], turning * now[0]];
    }
    let mut slope = now[0] * x.second + now[1] * y.second;
    if workspace.order() >= 2 {
        slope += change[0] * x.first + change[1] * y.first;
    }
    ForcePart {
        force: [now[0] * x.first + now[1] * y.first, slope],
        ..ForcePart::default()
    }
}

/// Value and slope of a table at `q`: linear between the points, constant
/// outside, or closed over the period. At a point the slope is that after it.
pub(super) fn interpolate(points: &[(f64, f64)], period: Option<f64>, q: f64) -> [f64; 2] {
    let (Some(&first), Some(&last)) = (points.first(), points.last()) else {
        return [0.0; 2];
    };
    let x = match period {
        Some(period) => q - period * ((q - first.0) / period).floor(),
        None => q,
    };
    let after = points.partition_point(|point| point.0 <= x);
    let (from, to) = match (after, period) {
        (0, _) => return [first.1, 0.0],
        (n, None) if n == points.len() => return [last.1, 0.0],
        (n, Some(period)) if n == points.len() => (last, (first.0 + period, first.1)),
        (n, _) => (points[n - 1], points[n]),
    };
    if to.0 <= from.0 {
        return [from.1, 0.0];
    }
    let slope = (to.1 - from.1) / (to.0 - from.0);
    [from.1 + slope * (x - from.0), slope]
}
