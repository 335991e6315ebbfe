//! A cycle of a position function: its joints, extremes and shocks.

use crate::kinematics::breaks::Breaks;
use crate::kinematics::motion::law::{Jump, Peak};
use crate::kinematics::position::Position;
use crate::math::jet::{JUMP_ROUNDING, Jet};
use crate::math::optimise::greatest;
use serde::Serialize;

/// Figures of a cam's cycle that a designer looks for.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CycleFigures {
    /// Length of the cycle (rad or m of the driver).
    pub period: f64,
    /// The function on both sides of each place where its formula changes.
    pub joints: Vec<FormulaChange>,
    /// Greatest U′.
    pub speed: Peak,
    /// Least U′.
    pub return_speed: Peak,
    /// Greatest U″.
    pub acceleration: Peak,
    /// Least U″.
    pub deceleration: Peak,
    /// Greatest |U‴|; jumps of U″ are not in it.
    pub jerk: Peak,
    /// Greatest |U′U″|.
    pub product: Peak,
    /// Jumps of the first three derivatives: of the first a hard, of the
    /// second a soft shock.
    pub jumps: Vec<Jump>,
}

/// A place where the formula changes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FormulaChange {
    /// The driver's displacement.
    pub at: f64,
    /// U just before and just after.
    pub value: [f64; 2],
    /// U′.
    pub first: [f64; 2],
    /// U″.
    pub second: [f64; 2],
    /// U‴.
    pub third: [f64; 2],
}

/// The cycle of a position function times `lever`.
///
/// # Errors
/// The function is not given by pieces that repeat, in words.
pub fn cycle(position: &Position, lever: f64) -> Result<CycleFigures, String> {
    let breaks = position.breaks();
    if breaks.period.is_none() || breaks.is_empty() {
        return Err("the position function has no cycle made of pieces".to_owned());
    }
    Ok(over_pieces(&breaks, &|segment, phi| {
        position.jet(segment, phi).scaled(lever)
    }))
}

/// The figures of what is given by pieces that repeat, or that are gone through once between rests.
pub(crate) fn over_pieces(breaks: &Breaks, jet: &dyn Fn(i64, f64) -> Jet) -> CycleFigures {
    // Without a period the segments before the first and after the last point are rests.
    let first = i64::from(breaks.period.is_none());
    let count = breaks.points.len();
    let inner = count as i64 - first;
    let length = match (breaks.period, breaks.points.first(), breaks.points.last()) {
        (Some(period), ..) => period,
        (None, Some(from), Some(to)) => to - from,
        (None, ..) => 0.0,
    };
    let pieces = || (first..first + inner).map(|segment| (segment, breaks.edges(segment)));
    let peak = |f: &dyn Fn(&Jet) -> f64| {
        let mut ends = pieces().map(|(segment, (from, to))| (segment as usize, from, to));
        greatest(&mut ends, &|segment, phi| f(&jet(segment as i64, phi)))
    };
    let least = |f: &dyn Fn(&Jet) -> f64| {
        let found = peak(&|jet| -f(jet));
        Peak {
            value: 0.0 - found.value,
            ..found
        }
    };
    let joints: Vec<FormulaChange> = (0..count)
        .map(|index| {
            let (at, after) = (breaks.points[index], index as i64 + first);
            let sides = [jet(after - 1, at), jet(after, at)];
            FormulaChange {
                at,
                value: sides.map(|side| side.value),
                first: sides.map(|side| side.first),
                second: sides.map(|side| side.second),
                third: sides.map(|side| side.third),
            }
        })
        .collect();
    let (speed, return_speed) = (peak(&|j| j.first), least(&|j| j.first));
    let (acceleration, deceleration) = (peak(&|j| j.second), least(&|j| j.second));
    let jerk = peak(&|j| j.third.abs());
    let sizes = [
        speed.value.max(-return_speed.value),
        acceleration.value.max(-deceleration.value),
        jerk.value,
    ];
    CycleFigures {
        period: length,
        jumps: jumps(&joints, sizes),
        joints,
        speed,
        return_speed,
        acceleration,
        deceleration,
        jerk,
        product: peak(&|j| (j.first * j.second).abs()),
    }
}

fn jumps(joints: &[FormulaChange], sizes: [f64; 3]) -> Vec<Jump> {
    let mut found = Vec::new();
    for joint in joints {
        let sides = [joint.first, joint.second, joint.third];
        for (order, ([before, after], size)) in (1..).zip(sides.into_iter().zip(sizes)) {
            if (after - before).abs() > JUMP_ROUNDING * size {
                found.push(Jump {
                    at: joint.at,
                    order,
                    before,
                    after,
                });
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::cycle;
    use crate::kinematics::motion::LawName;
    use crate::kinematics::position::{CamSpec, Position, PositionSpec};
    use std::f64::consts::{PI, TAU};

    fn cam(rise_law: LawName, return_law: LawName) -> Position {
        let spec = CamSpec {
            lift: 0.02,
            rise: 2.0,
            dwell: 0.5,
            return_angle: 1.0,
            rise_law: rise_law.into(),
            return_law: return_law.into(),
            phase: 0.0,
        };
        Position::new(&PositionSpec::Cam(spec)).unwrap()
    }

    #[test]
    fn extremes_are_those_of_the_laws_and_soft_shocks_are_listed() {
        let found = cycle(&cam(LawName::Harmonic, LawName::Cycloidal), 2.0).unwrap();
        assert_eq!(found.period, TAU);
        let close = |one: f64, other: f64| {
            approx::assert_relative_eq!(one, other, max_relative = 1e-13);
        };
        close(found.speed.value, 0.04 / 2.0 * PI / 2.0);
        close(found.return_speed.value, -0.04 * 2.0);
        close(found.acceleration.value, 0.04 * TAU);
        close(found.jerk.value, 0.04 * TAU * TAU);
        close(found.product.value, 0.0016 * 8.162097139053979);
        let soft: Vec<f64> = found
            .jumps
            .iter()
            .filter(|j| j.order < 3)
            .map(|j| j.at)
            .collect();
        assert_eq!(soft, [0.0, 2.0]);
        let smooth = cycle(&cam(LawName::Polynomial4567, LawName::Polynomial4567), 1.0).unwrap();
        assert!(smooth.jumps.is_empty());
    }

    #[test]
    fn functions_without_pieces_have_no_cycle() {
        let ratio = PositionSpec::Ratio {
            ratio: 2.0,
            offset: 0.0,
        };
        assert!(cycle(&Position::new(&ratio).unwrap(), 1.0).is_err());
    }
}
