//! The pitch curve of a cam: where the centre of its roller can be, seen from the cam.
//!
//! In the cam's frame the roller's centre p, seen from the cam's own centre, satisfies |p| =
//! R(angle of p). R is a prime radius and a lift, one of the position functions that repeat
//! after a turn. Directions are enough; no turns are counted.
//!
//! Limits: the motion takes the pair for closed. A cam with one flank that would have to pull
//! is reported by `studies::forces::closing`.

use super::CamPairSpec;
use crate::fault::{Fault, Faults};
use crate::kinematics::breaks::Breaks;
use crate::kinematics::linkage::vector::Vector;
use crate::kinematics::motion::Cycle;
use crate::kinematics::position::cam::Cam;
use crate::kinematics::position::sine;
use crate::kinematics::position::spec::{CustomPosition, PositionSpec};
use crate::kinematics::position::table::Table;
use crate::math::jet::Jet;
use crate::math::number::Number;
use crate::math::series::Series;

/// A pitch curve R(ψ), polar about a point of the cam, ψ counterclockwise in the cam's frame.
///
/// A point p of the cam's frame, seen from that point, lies on it where |p| = R(angle of p): an
/// equation that tells directions alone, so that no turns need to be counted.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::kinematics::linkage) struct PitchCurve {
    /// Radius where the lift is zero (m).
    prime: f64,
    direction: f64,
    sense: f64,
    lift: Lift,
    breaks: Breaks,
}

/// The lift over the angle φ of the cam.
#[derive(Clone, Debug, PartialEq)]
enum Lift {
    None,
    Sine([f64; 4]),
    Table(Table),
    Cam(Box<Cam>),
    Plan(Box<Cycle>),
    Custom(CustomPosition),
}

impl PitchCurve {
    /// The pitch curve of a cam, whose radii are right.
    ///
    /// # Errors
    /// Everything wrong with the lift, paths relative to it; a law that no cam has.
    pub(in crate::kinematics::linkage) fn new(spec: &CamPairSpec) -> Result<Self, Vec<Fault>> {
        let (lift, breaks) = lift(spec.lift.as_ref())?;
        Ok(Self {
            prime: spec.prime_radius(),
            direction: spec.direction,
            sense: spec.sense,
            lift,
            breaks,
        })
    }

    /// The lift and its derivatives at the angle φ, by the formula that holds towards greater
    /// angles (`way` ≥ 0) or lesser ones.
    pub(super) fn lift(&self, phi: f64, way: f64) -> Jet {
        let segment = match self.breaks.is_empty() {
            true => 0,
            false => self.breaks.segment_at(phi, way),
        };
        match &self.lift {
            Lift::None => Jet::default(),
            Lift::Sine(numbers) => sine::jet(*numbers, phi),
            Lift::Table(table) => table.jet(segment, phi),
            Lift::Cam(cam) => cam.jet(segment, phi),
            Lift::Plan(cycle) => cycle.jet(segment, phi),
            Lift::Custom(function) => function.0.jet(segment, phi),
        }
    }

    /// Where the lift changes its formula.
    pub(super) fn breaks(&self) -> &Breaks {
        &self.breaks
    }

    /// R and its derivatives at the polar angle ψ.
    pub(in crate::kinematics::linkage) fn radius(&self, angle: f64) -> Jet {
        let sense = self.sense;
        let lift = self.lift(sense * (angle - self.direction), 1.0);
        Jet {
            value: self.prime + lift.value,
            first: sense * lift.first,
            second: lift.second,
            third: sense * lift.third,
        }
    }

    /// The angle φ of the lift that belongs to a polar angle, and back.
    pub(super) fn polar(&self, phi: f64) -> f64 {
        self.direction + self.sense * phi
    }

    /// |p| − R(angle of p): zero where p, seen from the curve's centre in the frame of the cam,
    /// lies on the curve.
    pub(super) fn error<const K: usize>(&self, p: Vector<K>) -> Series<K> {
        let angle = p.angle();
        let radius = self.radius(angle.value());
        let taylor = [
            radius.value,
            radius.first,
            radius.second / 2.0,
            radius.third / 6.0,
        ];
        p.square().sqrt() - taylor_over_series(angle, taylor)
    }

    /// The derivatives of the error by the coordinates of p, in the frame of p: along the outward
    /// normal of the curve that goes through p. Over a path of p three coefficients at most, R being
    /// known to its third derivative.
    #[inline(always)]
    pub(super) fn gradient<const K: usize, T: Number>(&self, p: Vector<K, T>) -> Vector<K, T> {
        let far = p.square().sqrt().reciprocal();
        let angle = p.angle();
        let radius = self.radius(angle.0[0].value());
        let [_, first, second] = radius.lift(angle.0[0]);
        let third = T::from(radius.third / 2.0);
        let slope = taylor_over_series(angle, [first, second, third]) * far;
        let unit = p.times(far);
        unit - unit.turned_left().times(slope)
    }

    /// Curvature of the pitch curve at a polar angle (1/m), positive where it is convex:
    /// (R² + 2·R′² − R·R″)/(R² + R′²)^{3/2}.
    pub(super) fn curvature(&self, angle: f64) -> f64 {
        let r = self.radius(angle);
        let square = r.value * r.value + r.first * r.first;
        (square + r.first * r.first - r.value * r.second) / (square * square.sqrt())
    }

    /// The point of an equidistant curve, `offset` outside the pitch curve, at a polar angle of
    /// the latter; seen from its centre in the frame of the cam (m).
    pub(super) fn equidistant_point(&self, angle: f64, offset: f64) -> [f64; 2] {
        let (sin, cos) = angle.sin_cos();
        let radius = self.radius(angle).value;
        let at = [radius * cos, radius * sin];
        let [x, y] = self.gradient(Vector::<1>::constant(at)).value();
        let size = x.hypot(y);
        [at[0] + offset * x / size, at[1] + offset * y / size]
    }
}

/// A function over a series, by its Taylor coefficients at the value of that.
#[inline(always)]
fn taylor_over_series<const K: usize, const D: usize, T: Number>(
    angle: Series<K, T>,
    taylor: [T; D],
) -> Series<K, T> {
    let mut step = angle;
    step.0[0] = T::from(0.0);
    let mut sum = Series([T::from(0.0); K]);
    for c in taylor.into_iter().rev() {
        sum = sum * step;
        sum.0[0] += c;
    }
    sum
}

/// The lift made ready, and where it changes its formula.
fn lift(spec: Option<&PositionSpec>) -> Result<(Lift, Breaks), Vec<Fault>> {
    let mut faults = Faults::default();
    let found = match spec {
        None => (Lift::None, Breaks::NONE),
        Some(PositionSpec::Sine {
            amplitude,
            harmonic,
            phase,
            offset,
        }) => {
            let numbers = [*amplitude, *harmonic, *phase, *offset];
            for (name, number) in ["amplitude", "harmonic", "phase", "offset"]
                .into_iter()
                .zip(numbers)
            {
                faults.finite(&format!("sine.{name}"), number);
            }
            (Lift::Sine(numbers), Breaks::NONE)
        }
        Some(PositionSpec::Table {
            points,
            periodic,
            end_slopes,
        }) => {
            let table = Table::new(points, *periodic, *end_slopes)?;
            let breaks = table.breaks().clone();
            (Lift::Table(table), breaks)
        }
        Some(PositionSpec::Cam(spec)) => {
            let cam = Cam::new(spec)?;
            let breaks = cam.breaks().clone();
            (Lift::Cam(Box::new(cam)), breaks)
        }
        Some(PositionSpec::Plan(spec)) => {
            let cycle = Cycle::new(spec)?;
            let breaks = cycle.breaks().clone();
            (Lift::Plan(Box::new(cycle)), breaks)
        }
        Some(PositionSpec::Custom(function)) => {
            (Lift::Custom(function.clone()), function.0.breaks())
        }
        Some(_) => {
            let hint = "give a `sine`, a `table`, a `cam` or a `plan`";
            faults.add("", "this function does not repeat after a turn", hint);
            (Lift::None, Breaks::NONE)
        }
    };
    faults.check()?;
    Ok(found)
}
