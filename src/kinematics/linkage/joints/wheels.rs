//! Two wheels on a carrier that turn at a constant ratio, as gears and belts make them.

use super::carrier::Mismatch;
use super::constraint::{Constraint, Frames, Measure, Turns, Wrench};
use super::reader::Lacks;
use crate::fault::Faults;
use crate::math::number::Number;
use crate::math::series::Series;
use crate::units::shown;

/// Ratios between these are taken, so that squares stay numbers.
const SMALLEST: f64 = 1e-6;
/// See [`SMALLEST`].
const GREATEST: f64 = 1e6;

/// What is said where no link carries both wheels.
pub(super) const LACKS: Lacks = Lacks {
    message: "no link carries both `{one}` and `{other}`",
    hint: "join both to one link (or to the ground) by pins",
};

/// Two wheels: θ₂ − θ = ρ·(θ₁ − θ) + q₀, with θ the angle of the carrier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::kinematics::linkage) struct TwoWheels {
    /// ρ.
    pub(super) ratio: f64,
    /// q₀ (rad).
    pub(super) offset: f64,
    /// The axes of the wheels in the frame of the carrier (m).
    pub(super) axes: [[f64; 2]; 2],
}

impl Constraint for TwoWheels {
    const MEASURE: Measure = Measure::Angle;
    const TURNING: &'static [usize] = &[0, 1, 2];

    fn error<const K: usize>(&self, links: &impl Turns<K>) -> Series<K> {
        let [one, other, carrier] = [0, 1, 2].map(|link| links.angle(link));
        (other - carrier - (one - carrier).scale(self.ratio)).shift(-self.offset)
    }

    #[inline(always)]
    fn row<const K: usize, T: Number>(
        &self,
        _links: &impl Frames<K, T>,
        mut add: impl FnMut(usize, Wrench<K, T>),
    ) {
        add(0, Wrench::couple(-self.ratio));
        add(1, Wrench::couple(1.0));
        add(2, Wrench::couple(self.ratio - 1.0));
    }
}

impl TwoWheels {
    /// Places of both axes.
    pub(super) fn placed_axes(&self, links: &impl Frames<1, f64>) -> [[f64; 2]; 2] {
        let carrier = links.frame(2);
        self.axes.map(|at| carrier.place(at).value())
    }
}

/// Direction from one point to another, and their distance.
pub(super) fn towards([one, other]: [[f64; 2]; 2]) -> ([f64; 2], f64) {
    let [x, y] = [other[0] - one[0], other[1] - one[1]];
    let apart = x.hypot(y);
    ([x / apart, y / apart], apart)
}

/// Refuses a ratio whose square is no number.
pub(super) fn check_ratio(ratio: f64, path: &str, faults: &mut Faults) {
    if !(SMALLEST < ratio.abs() && ratio.abs() < GREATEST) {
        let message = format!("its ratio is {}", shown(ratio, 6));
        let hint = format!("give one between {SMALLEST:e} and {GREATEST:e}");
        faults.add(path, message, &hint);
    }
}

/// What is wrong with wheels themselves.
pub(super) fn wrong(message: String, hint: &str) -> Mismatch {
    Mismatch::Own([message, hint.to_owned()])
}
