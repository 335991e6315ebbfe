//! Loads whose force is not constant.

use super::written::Written;
use crate::dynamics::model::{LinearPiece, LoadLaw, Track};
use crate::kinematics::breaks::Breaks;
use crate::math::quantity::Quantity;

/// A load, frozen.
#[derive(Clone, Debug)]
pub(super) struct FrozenLoad {
    /// Internal index of the node it acts on.
    pub(super) node: usize,
    /// Law of the force.
    pub(super) law: LoadLaw,
    /// Of [`LoadLaw::Pieces`]: what runs along the table.
    pub(super) argument: Option<Argument>,
    /// Of [`LoadLaw::Stop`]: index into [`Frozen::stops`](super::frozen::Frozen::stops).
    pub(super) stop: Option<usize>,
    /// Of [`LoadLaw::Written`]: the expression.
    pub(super) written: Option<Written>,
}

/// Argument of a load's table: what it runs over.
#[derive(Clone, Debug)]
pub(super) struct Argument {
    /// Component of the modes that selects the piece.
    pub(super) component: usize,
    /// Internal index of the node whose displacement it is; `None`: time.
    pub(super) node: Option<usize>,
    /// The break points of the table.
    breaks: Breaks,
}

impl Argument {
    /// The argument of a table on a track.
    pub(super) fn new(track: &Track, component: usize, node: Option<usize>) -> Self {
        Self {
            component,
            node,
            breaks: track.breaks.clone(),
        }
    }
}

impl FrozenLoad {
    /// Force towards positive displacement. `argument` gives the place on a
    /// table's axis and its segment; it is asked for tables only.
    #[inline]
    pub(super) fn force<N: Quantity>(
        &self,
        displacement: N,
        speed: N,
        argument: impl Fn(&Argument) -> (N, i64),
    ) -> N {
        match &self.law {
            LoadLaw::Constant(force) => N::from(*force),
            // (A stop's force depends on its mode, that of an expression on other nodes.)
            LoadLaw::Stop(_) | LoadLaw::Written(_) => N::from(0.0),
            LoadLaw::Pieces { pieces, .. } => match &self.argument {
                Some(axis) => {
                    let (x, segment) = argument(axis);
                    piece_force(pieces, &axis.breaks, x, segment)
                }
                None => N::from(0.0),
            },
            LoadLaw::Spring { rate, preload } => N::from(-preload) - displacement.scale(*rate),
            LoadLaw::Viscous(damping) => -speed.scale(*damping),
            LoadLaw::Friction { force, width } => {
                speed.apply(|speed| friction(speed, *force, *width))
            }
            LoadLaw::LinearMotor {
                stall_torque,
                no_load_speed,
            } => N::from(*stall_torque) - speed.scale(stall_torque / no_load_speed),
            LoadLaw::Kloss {
                breakdown_torque,
                breakdown_slip,
                synchronous_speed,
            } => speed.apply(|speed| {
                kloss(
                    speed,
                    *breakdown_torque,
                    *breakdown_slip,
                    *synchronous_speed,
                )
            }),
            LoadLaw::SpeedTable(points) => speed.apply(|speed| speed_table(points, speed)),
            LoadLaw::Custom { function, factor } => {
                let force = function.force(displacement.value(), speed.value());
                // Its derivatives are those of the force along the motion's.
                let moved = displacement - N::from(displacement.value());
                let faster = speed - N::from(speed.value());
                let change = moved.scale(force.by_displacement) + faster.scale(force.by_speed);
                (N::from(force.value) + change).scale(*factor)
            }
        }
    }

    /// Slope of the piece of a table that a segment selects; 0 for other laws.
    pub(super) fn slope(&self, segment: i64) -> f64 {
        match (&self.law, &self.argument) {
            (LoadLaw::Pieces { pieces, .. }, Some(axis)) => {
                let (index, _) = axis.breaks.piece(segment);
                pieces[index.min(pieces.len() - 1)].slope
            }
            _ => 0.0,
        }
    }

    /// True for loads that a body at rest does not feel: viscous, friction and
    /// motor torques.
    pub(super) fn needs_speed(&self) -> bool {
        needs_speed(&self.law)
    }
}

/// True for laws that are functions of speed.
pub(super) fn needs_speed(law: &LoadLaw) -> bool {
    match law {
        LoadLaw::Constant(_)
        | LoadLaw::Pieces { .. }
        | LoadLaw::Spring { .. }
        | LoadLaw::Stop(_) => false,
        LoadLaw::Viscous(_)
        | LoadLaw::Friction { .. }
        | LoadLaw::LinearMotor { .. }
        | LoadLaw::Kloss { .. }
        | LoadLaw::SpeedTable(_) => true,
        LoadLaw::Custom { function, .. } => function.needs_speed(),
        LoadLaw::Written(written) => written.needs_speed(),
    }
}

/// True for the torque characteristics of motors.
pub(super) fn is_motor(law: &LoadLaw) -> bool {
    matches!(
        law,
        LoadLaw::LinearMotor { .. } | LoadLaw::Kloss { .. } | LoadLaw::SpeedTable(_)
    )
}

fn piece_force<N: Quantity>(pieces: &[LinearPiece], breaks: &Breaks, x: N, segment: i64) -> N {
    let (index, shift) = breaks.piece(segment);
    let piece = pieces[index.min(pieces.len() - 1)];
    N::from(piece.value) + (x - N::from(shift + piece.start)).scale(piece.slope)
}

/// Coulomb friction, regularised, and its slope.
fn friction(speed: f64, force: f64, width: f64) -> (f64, f64) {
    let tanh = (speed / width).tanh();
    (-force * tanh, -force * (1.0 - tanh * tanh) / width)
}

/// Kloss' formula for an asynchronous motor and its slope over speed.
fn kloss(speed: f64, breakdown: f64, breakdown_slip: f64, synchronous: f64) -> (f64, f64) {
    let slip = 1.0 - speed / synchronous;
    let square = slip * slip + breakdown_slip * breakdown_slip;
    let factor = 2.0 * breakdown * breakdown_slip;
    let over_slip = factor * (breakdown_slip * breakdown_slip - slip * slip) / (square * square);
    (factor * slip / square, -over_slip / synchronous)
}

/// A table over speed, linear between its points and constant outside.
fn speed_table(points: &[(f64, f64)], speed: f64) -> (f64, f64) {
    let above = points.partition_point(|point| point.0 <= speed);
    match (above.checked_sub(1).map(|i| points[i]), points.get(above)) {
        (Some((low, from)), Some(&(high, to))) => {
            let slope = (to - from) / (high - low);
            (from + slope * (speed - low), slope)
        }
        (Some((_, torque)), None) => (torque, 0.0),
        (None, Some(&(_, torque))) => (torque, 0.0),
        (None, None) => (0.0, 0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::{friction, kloss, speed_table};

    #[test]
    fn slopes_of_characteristics_agree_with_differences() {
        let step = 1e-5;
        for speed in [-12.0, -0.3, 0.0, 2.2, 90.0, 104.0, 130.0] {
            for law in [
                |speed| friction(speed, 20.0, 0.5),
                |speed| kloss(speed, 25.0, 0.2, 104.7),
                |speed| speed_table(&[(0.5, 10.0), (50.0, 8.0), (104.0001, 0.0)], speed),
            ] {
                let difference = (law(speed + step).0 - law(speed - step).0) / (2.0 * step);
                approx::assert_abs_diff_eq!(law(speed).1, difference, epsilon = 1e-6);
            }
        }
    }

    #[test]
    fn kloss_has_its_breakdown_torque_at_its_breakdown_slip() {
        let (torque, slope) = kloss(104.7 * 0.8, 25.0, 0.2, 104.7);
        approx::assert_relative_eq!(torque, 25.0, max_relative = 1e-12);
        approx::assert_abs_diff_eq!(slope, 0.0, epsilon = 1e-12);
        assert_eq!(kloss(104.7, 25.0, 0.2, 104.7).0, 0.0);
    }
}
