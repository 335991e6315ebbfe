//! Two wheels on a carrier that turn at a constant ratio, as gears and belts make them.

use super::carrier::{Mismatch, axes, axis};
use super::constraint::{Act, Constraint, Frames, Measure, Shape, Turns, Wrench};
use super::outline::Outline;
use super::reader::MissingCarrier;
use super::{CouplingSpec, Words};
use crate::fault::Faults;
use crate::kinematics::linkage::spec::pair::PairSpec;
use crate::math::number::Number;
use crate::math::series::Series;
use crate::units::shown;

/// Ratios between these are taken, so that squares stay numbers.
const SMALLEST: f64 = 1e-6;
/// See [`SMALLEST`].
const GREATEST: f64 = 1e6;

/// What is said where no link carries both wheels.
pub(super) const LACKS: MissingCarrier = MissingCarrier {
    message: "no link carries both `{one}` and `{other}`",
    hint: "join both to one link (or to the ground) by pins",
};

/// Words about wheels, but for where their force is drawn.
pub(super) const WORDS: Words = Words {
    force: "Circumferential force of",
    drawn: "",
    is_one_force: true,
    held_link: "geared link",
};

/// What a unit of the circumferential force does to both wheels, by their axes (m) and their sizes.
type Press = fn([[f64; 2]; 2], [f64; 2]) -> [Act; 2];

/// Two wheels: θ₂ − θ = ρ·(θ₁ − θ) + q₀, with θ the angle of the carrier.
#[derive(Clone, Copy, Debug)]
pub(in crate::kinematics::linkage) struct TwoWheels {
    /// Their sizes; ρ is the first over the second.
    sizes: [f64; 2],
    /// ρ.
    ratio: f64,
    /// q₀ (rad).
    offset: f64,
    /// The axes of the wheels in the frame of the carrier (m).
    axes: [[f64; 2]; 2],
    press: Press,
}

impl TwoWheels {
    /// Of a coupling that has been checked.
    pub(super) fn new(
        coupling: &CouplingSpec,
        pairs: &[PairSpec],
        sizes: [f64; 2],
        press: Press,
    ) -> Option<Self> {
        Some(Self {
            sizes,
            ratio: sizes[0] / sizes[1],
            offset: coupling.offset,
            axes: axes(coupling, pairs).ok()?,
            press,
        })
    }
}

impl Constraint for TwoWheels {
    const SHAPE: Shape = Shape {
        rows: &[Measure::Angle],
        links: 3,
        turning: &[0, 1, 2],
    };

    #[inline(always)]
    fn errors<const K: usize>(&self, links: &impl Turns<K>, mut set: impl FnMut(usize, Series<K>)) {
        let (one, other, carrier) = (links.angle(0), links.angle(1), links.angle(2));
        let error = other - carrier - (one - carrier).scale(self.ratio);
        set(0, error.shift(-self.offset));
    }

    #[inline(always)]
    fn rows<const K: usize, T: Number>(
        &self,
        _links: &impl Frames<K, T>,
        mut add: impl FnMut(usize, usize, Wrench<K, T>),
    ) {
        add(0, 0, Wrench::couple(-self.ratio));
        add(0, 1, Wrench::couple(1.0));
        add(0, 2, Wrench::couple(self.ratio - 1.0));
    }

    fn unit_force_acts(&self, links: &impl Frames<1, f64>) -> [Act; 2] {
        let carrier = links.frame(2);
        let axes = self.axes.map(|at| carrier.place(at).value());
        (self.press)(axes, self.sizes)
    }
}

/// Direction from one point to another, and their distance.
pub(super) fn direction_and_distance([one, other]: [[f64; 2]; 2]) -> ([f64; 2], f64) {
    let [x, y] = [other[0] - one[0], other[1] - one[1]];
    let apart = x.hypot(y);
    ([x / apart, y / apart], apart)
}

/// Circles of both wheels.
pub(super) fn circles(
    coupling: &CouplingSpec,
    pairs: &[PairSpec],
    radii: [f64; 2],
) -> impl Iterator<Item = Outline> {
    let circles = [0, 1].map(|k| circle(coupling, pairs, k, radii[k]));
    circles.into_iter().flatten()
}

/// Circle of one of the wheels.
pub(super) fn circle(
    coupling: &CouplingSpec,
    pairs: &[PairSpec],
    which: usize,
    radius: f64,
) -> Option<Outline> {
    let wheel = coupling.wheels[which];
    let centre = axis(pairs, wheel, coupling.carrier)?;
    Some(Outline::Circle(wheel, centre, radius.abs()))
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
