//! Dyads: Assur groups of two bodies and three pairs, in closed form.
//!
//! The outer pairs join the two bodies to what is already placed, the inner
//! pair joins them to each other. A sliding pair ties the two directions and
//! leaves one displacement along its guide; on which of its two links the guide
//! lies does not matter to the closure. Every form is solved on directions,
//! without angles; the one square root of a form carries the branch.

use super::closure::{TwoCircles, circle_and_line, guide_between_pins};
use super::elements::{Body, Element, Frame, PairElement};
use super::vector::{Arm, Local, Vector};
use crate::math::series::Series;

/// The forms of a dyad: outer, inner, outer pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// Three pins.
    Rrr,
    /// Outer pin on the first body, inner pin, outer guide on the second.
    Rrp,
    /// Outer pins, inner guide.
    Rpr,
    /// Outer guides, inner pin.
    Prp,
    /// Outer pin on the first body, inner guide, outer guide on the second.
    Rpp,
}

/// A dyad made ready.
#[derive(Clone, Debug)]
pub(super) struct Dyad {
    /// Form of the dyad.
    pub(super) form: Form,
    /// Bodies of the dyad.
    pub(super) bodies: [Body; 2],
    /// The outer pairs as elements of what is already placed.
    pub(super) known: [Element; 2],
    /// The outer pairs as parts of the two bodies.
    pub(super) outer: [PairElement; 2],
    /// The inner pair as parts of the two bodies.
    pub(super) inner: [PairElement; 2],
    /// From the outer to the inner element of the two bodies, where both lie on
    /// the link that carries the body's frame.
    pub(super) arms: [Option<Arm>; 2],
    /// RPR: −1 where the guide is on the second body, else +1, so that `+`
    /// always has the block's pin ahead of the guide's. Others: +1.
    pub(super) sense: f64,
}

/// Margin of a group: how far it is from a dead-centre position.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Margin {
    /// Dimensionless, positive where the group can be assembled, going through
    /// zero like the square of the distance of its two assemblies; for RRR sin²
    /// of the angle between the links, for PRP and RPP the sine of that between
    /// the guides.
    pub(super) value: f64,
    /// Derivative of the margin by the input.
    pub(super) slope: f64,
    /// Size of the rounding error in `value`.
    pub(super) noise: f64,
}

impl Margin {
    #[inline(always)]
    fn new<const N: usize>(margin: Series<N>, noise: f64) -> Self {
        Self {
            value: margin.value(),
            slope: if N > 1 { margin.0[1] } else { 0.0 },
            noise: noise * f64::EPSILON,
        }
    }
}

/// Directions of the two bodies of a dyad, with its margin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Directions<const N: usize> {
    /// (cos θ, sin θ) of the bodies.
    pub(super) of: [Vector<N>; 2],
    /// Distance from a dead-centre position.
    pub(super) margin: Margin,
}

/// Surroundings of a dyad at an input, as far as they are known.
#[derive(Clone, Copy, Debug)]
pub(super) struct DyadSurroundings<const N: usize> {
    /// The frames that the outer pairs are fixed to.
    pub(super) known: [Frame<N>; 2],
    /// The frame of the driven link in its assembly.
    pub(super) relative: Frame<N>,
}

impl Dyad {
    /// Directions of the bodies on the branch `sign`; values that are not
    /// numbers where it cannot be assembled.
    #[inline]
    pub(super) fn directions<const N: usize>(
        &self,
        around: &DyadSurroundings<N>,
        sign: f64,
        size: f64,
    ) -> Directions<N> {
        match self.form {
            Form::Rrr => self.rrr(around, sign, size),
            Form::Rrp => self.rrp(around, sign, size),
            Form::Rpr => self.rpr(around, sign * self.sense, size),
            Form::Prp => self.prp(around, sign),
            Form::Rpp => self.rpp(around, sign),
        }
    }

    /// Frames of the bodies turned as `of`.
    #[inline]
    pub(super) fn frames_of_bodies<const N: usize>(
        &self,
        around: &DyadSurroundings<N>,
        of: [Vector<N>; 2],
    ) -> [Frame<N>; 2] {
        let relative = &around.relative;
        let known = |k: usize| around.known[k].place(self.known[k].point);
        match self.form {
            Form::Rrr | Form::Rpr => [0, 1].map(|k| {
                Frame::frame_through_point(of[k], self.outer[k].place(relative), known(k))
            }),
            Form::Rrp => {
                let first =
                    Frame::frame_through_point(of[0], self.outer[0].place(relative), known(0));
                let pin = first.at + self.inner[0].place(relative).turned_to_ground(of[0]);
                let second = Frame::frame_through_point(of[1], self.inner[1].place(relative), pin);
                [first, second]
            }
            Form::Prp => {
                let pin = self.place_of_inner_pin(around);
                [0, 1]
                    .map(|k| Frame::frame_through_point(of[k], self.inner[k].place(relative), pin))
            }
            Form::Rpp => {
                let first =
                    Frame::frame_through_point(of[0], self.outer[0].place(relative), known(0));
                let second = self.slider(around, &first, of[1]);
                [first, second]
            }
        }
    }

    /// Two circles: the inner pin lies to the left of the line from the first
    /// outer pin to the second on branch +.
    #[inline(always)]
    fn rrr<const N: usize>(
        &self,
        around: &DyadSurroundings<N>,
        sign: f64,
        typical: f64,
    ) -> Directions<N> {
        let (arms, lengths, apart) = self.arms(around);
        let square = apart.square();
        let [a, b] = lengths;
        let unstretched = (a + b).square() - square;
        let unfolded = square - (a - b).square();
        let discriminant = unstretched * unfolded;
        let closure = TwoCircles {
            factors: [unstretched, unfolded],
            along: square + (a - b) * (a + b),
        };
        let half = square.reciprocal().scale(0.5);
        let to_pin = apart.complex_product(closure.vector_to_inner_pin(sign).times(half));
        let size = (a.value() + b.value()).powi(2) + square.value();
        let scale = 0.25 / (arms[0].unit(typical) * arms[1].unit(typical)).powi(2);
        let noise = size * (unstretched.value().abs() + unfolded.value().abs()) * scale;
        Directions {
            of: [arms[0].frame(to_pin), arms[1].frame(to_pin - apart)],
            margin: Margin::new(discriminant.scale(scale), noise),
        }
    }

    /// From outer to inner pin on both bodies, their lengths, and the vector
    /// between the outer pins.
    #[inline(always)]
    fn arms<const N: usize>(
        &self,
        around: &DyadSurroundings<N>,
    ) -> ([Local<N>; 2], [Series<N>; 2], Vector<N>) {
        let arms = [0, 1].map(|k| self.arm(around, k));
        let lengths = [arms[0].length(), arms[1].length()];
        (arms, lengths, self.separation(around))
    }

    /// From the outer to the inner element of a body.
    #[inline(always)]
    pub(super) fn arm<const N: usize>(&self, around: &DyadSurroundings<N>, k: usize) -> Local<N> {
        if let Some(arm) = self.arms[k] {
            return Local::Arm(arm);
        }
        let relative = &around.relative;
        self.inner[k]
            .place(relative)
            .minus(self.outer[k].place(relative))
    }

    /// From the first outer element to the second.
    #[inline(always)]
    pub(super) fn separation<const N: usize>(&self, around: &DyadSurroundings<N>) -> Vector<N> {
        around.known[1].place(self.known[1].point) - around.known[0].place(self.known[0].point)
    }

    /// By how much a link fails to reach a guide (m); negative where it does.
    pub(super) fn overreach(&self, around: &DyadSurroundings<1>) -> f64 {
        let relative = &around.relative;
        match self.form {
            Form::Rrp => {
                let (along, _) = self.guided(around, 1);
                let off = along.cross(self.separation(around)) + self.aside(around, 1);
                off.value().abs() - self.arm(around, 0).length().value()
            }
            Form::Rpr => {
                let guides = [0, 1].map(|k| self.inner[k].guide(relative));
                let [one, other] = [0, 1].map(|k| self.arm(around, k).across(guides[k]));
                (one - other).value().abs() - self.separation(around).square().value().sqrt()
            }
            _ => 0.0,
        }
    }

    /// Direction of the outer guide `k` and of the body on it.
    #[inline(always)]
    fn guided<const N: usize>(
        &self,
        around: &DyadSurroundings<N>,
        k: usize,
    ) -> (Vector<N>, Vector<N>) {
        let along = around.known[k].direction.turn_constant(self.known[k].along);
        let frame = self.outer[k].guide(&around.relative).frame(along);
        (along, frame)
    }

    /// How far to the left of the outer guide `k` the inner element lies.
    #[inline(always)]
    fn aside<const N: usize>(&self, around: &DyadSurroundings<N>, k: usize) -> Series<N> {
        let guide = self.outer[k].guide(&around.relative);
        self.arm(around, k).across(guide)
    }

    /// A circle and a line: the inner pin lies ahead of the outer pin along the
    /// guide on branch +.
    #[inline(always)]
    fn rrp<const N: usize>(
        &self,
        around: &DyadSurroundings<N>,
        sign: f64,
        typical: f64,
    ) -> Directions<N> {
        let arm = self.arm(around, 0);
        let length = arm.length();
        let (along, second) = self.guided(around, 1);
        let off = along.cross(self.separation(around)) + self.aside(around, 1);
        let discriminant = (length - off) * (length + off);
        let ahead = circle_and_line(length - off, length + off, sign);
        let to_pin = along.complex_product(Vector::new(ahead, off));
        let scale = arm.unit(typical).powi(-2);
        let reach = length.value().abs() + off.value().abs();
        Directions {
            of: [arm.frame(to_pin), second],
            margin: Margin::new(discriminant.scale(scale), 2.0 * reach * reach * scale),
        }
    }

    /// A guide between two pins: with `sign` + the second outer pin lies ahead
    /// of the first along the guide.
    #[inline(always)]
    fn rpr<const N: usize>(
        &self,
        around: &DyadSurroundings<N>,
        sign: f64,
        size: f64,
    ) -> Directions<N> {
        let relative = &around.relative;
        let guides = [0, 1].map(|k| self.inner[k].guide(relative));
        let off = self.arm(around, 0).across(guides[0]) - self.arm(around, 1).across(guides[1]);
        let apart = self.separation(around);
        let square = apart.square();
        let seen = guide_between_pins(square, off, sign);
        let along = apart.complex_product(seen).times(square.reciprocal());
        let scale = (size * size).recip();
        Directions {
            of: [guides[0].frame(along), guides[1].frame(along)],
            margin: Margin::new(
                (square - off.square()).scale(scale),
                2.0 * (square.value() + off.value().powi(2)) * scale,
            ),
        }
    }

    /// Two lines: one assembly, `sign` only says on which side the second guide
    /// points, so that the margin goes through zero where they are parallel.
    #[inline(always)]
    fn prp<const N: usize>(&self, around: &DyadSurroundings<N>, sign: f64) -> Directions<N> {
        let (first, one) = self.guided(around, 0);
        let (second, other) = self.guided(around, 1);
        Directions {
            of: [one, other],
            margin: Margin::new(first.cross(second).scale(sign), 4.0),
        }
    }

    /// Sine of the angle from the outer to the inner guide of the second body.
    #[inline(always)]
    fn crossing_guides<const N: usize>(&self, relative: &Frame<N>) -> Series<N> {
        let (out, guide) = (self.outer[1].guide(relative), self.inner[1].guide(relative));
        out.vector().cross(guide.vector())
    }

    /// The side to which the second guide of PRP or RPP points; + for all others.
    pub(super) fn side_of_second_rail(&self, around: &DyadSurroundings<1>) -> f64 {
        let sine = match self.form {
            Form::Prp => {
                let [(first, _), (second, _)] = [0, 1].map(|k| self.guided(around, k));
                first.cross(second)
            }
            Form::Rpp => self.crossing_guides(&around.relative),
            _ => return 1.0,
        };
        1f64.copysign(sine.value())
    }

    /// Where the inner pin of PRP lies.
    #[inline(always)]
    fn place_of_inner_pin<const N: usize>(&self, around: &DyadSurroundings<N>) -> Vector<N> {
        let (first, _) = self.guided(around, 0);
        let (second, _) = self.guided(around, 1);
        let foot = around.known[0].place(self.known[0].point)
            + first.turned_left().times(self.aside(around, 0));
        let to = around.known[1].place(self.known[1].point) - foot;
        let missing = self.aside(around, 1) + second.cross(to);
        foot + first.times(missing * second.cross(first).reciprocal())
    }

    /// All directions are given: one assembly, `sign` as for PRP. The angle
    /// between the guides of the second body changes only where it is driven.
    #[inline(always)]
    fn rpp<const N: usize>(&self, around: &DyadSurroundings<N>, sign: f64) -> Directions<N> {
        let relative = &around.relative;
        let (_, second) = self.guided(around, 1);
        let inner = self.inner[1].guide(relative).turned_to_ground(second);
        let first = self.inner[0].guide(relative).frame(inner);
        let crossing = self.crossing_guides(relative).scale(sign);
        Directions {
            of: [first, second],
            margin: Margin::new(crossing, 4.0),
        }
    }

    /// The second body of RPP: on its outer guide and on the inner one.
    #[inline(always)]
    fn slider<const N: usize>(
        &self,
        around: &DyadSurroundings<N>,
        first: &Frame<N>,
        direction: Vector<N>,
    ) -> Frame<N> {
        let relative = &around.relative;
        let (out, _) = self.guided(around, 1);
        let inner = self.inner[1].guide(relative).turned_to_ground(direction);
        let on_first = first.at
            + self.inner[0]
                .place(relative)
                .turned_to_ground(first.direction);
        let outer = around.known[1].place(self.known[1].point);
        // The inner element is moved along the inner guide until the outer one
        // lies on the outer guide.
        let missing = self.aside(around, 1) + out.cross(outer - on_first);
        let point = on_first + inner.times(missing * out.cross(inner).reciprocal());
        Frame::frame_through_point(direction, self.inner[1].place(relative), point)
    }
}
