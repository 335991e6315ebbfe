//! Elements of pairs, bodies made of links, and frames.

use super::spec::pair::{PairKind, PairSpec};
use super::vector::{Local, Vector};
use crate::math::number::Number;

/// Element of a pair: what a link contributes to it, in its own frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Element {
    /// The link; `None`: the ground.
    pub(super) link: Option<usize>,
    /// The pin, or a point on the axis of the guide (m).
    pub(super) point: [f64; 2],
    /// Unit vector along the guide; of a pin, no meaning.
    pub(super) along: [f64; 2],
}

impl Element {
    /// A link alone, whose angle counts.
    pub(super) fn of_link(link: Option<usize>) -> Self {
        Self {
            link,
            point: [0.0, 0.0],
            along: [1.0, 0.0],
        }
    }
}

/// The two elements of a pair: of link i (`on`) and of link j (`link`).
pub(super) fn elements(pair: &PairSpec) -> [Element; 2] {
    let (on, link) = match pair.kind {
        PairKind::Revolute { .. } => ([1.0, 0.0], [1.0, 0.0]),
        PairKind::Sliding {
            direction, angle, ..
        } => {
            let ((sin, cos), (sin_block, cos_block)) = (direction.sin_cos(), angle.sin_cos());
            ([cos, sin], [cos_block, -sin_block])
        }
    };
    [(pair.on, on), (pair.link, link)].map(|(point, along)| Element {
        link: point.link,
        point: point.at,
        along,
    })
}

/// True for a sliding pair.
pub(super) fn slides(pair: &PairSpec) -> bool {
    matches!(pair.kind, PairKind::Sliding { .. })
}

/// Something rigid at a given input: a link, or the two links of the driver
/// when neither is on the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Body {
    /// The link whose frame is the body's.
    pub(super) base: usize,
    /// The link that the driver moves against `base`.
    pub(super) driven: Option<usize>,
}

impl Body {
    /// True when the link is part of the body.
    pub(super) fn has_link(&self, link: usize) -> bool {
        self.base == link || self.driven == Some(link)
    }

    /// Links of the pair.
    pub(super) fn links(&self) -> impl Iterator<Item = usize> {
        std::iter::once(self.base).chain(self.driven)
    }
}

/// An element of a pair in the frame of its body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PairElement {
    /// The point, in the frame of its link (m).
    pub(super) point: [f64; 2],
    /// The direction of the guide, in the frame of its link.
    pub(super) along: [f64; 2],
    /// True: the link is the driven one of the body.
    pub(super) driven: bool,
}

impl PairElement {
    pub(super) fn new(element: &Element, body: &Body) -> Self {
        Self {
            point: element.point,
            along: element.along,
            driven: body.driven.is_some() && element.link == body.driven,
        }
    }

    /// Place of the element, in the frame of the body.
    #[inline(always)]
    pub(super) fn place<const N: usize>(&self, relative: &Frame<N>) -> Local<N> {
        if self.driven {
            Local::Moving(relative.place(self.point))
        } else {
            Local::Fixed(self.point)
        }
    }

    /// The direction of its guide, in the frame of the body.
    #[inline(always)]
    pub(super) fn guide<const N: usize>(&self, relative: &Frame<N>) -> Local<N> {
        if self.driven {
            Local::Moving(relative.direction.turn_constant(self.along))
        } else {
            Local::Fixed(self.along)
        }
    }
}

/// A frame: where its origin is and how it is turned.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame<const N: usize, T = f64> {
    /// The origin (m).
    pub(super) at: Vector<N, T>,
    /// (cos θ, sin θ).
    pub(super) direction: Vector<N, T>,
}

impl<const N: usize, T: Number> Frame<N, T> {
    /// A point given in this frame.
    #[inline(always)]
    pub(super) fn place(&self, point: [f64; 2]) -> Vector<N, T> {
        self.at + self.direction.turn_constant(point)
    }
}

impl<const N: usize> Frame<N> {
    /// The frame of the ground.
    #[inline(always)]
    pub(super) fn ground() -> Self {
        Self {
            at: Vector::constant([0.0, 0.0]),
            direction: Vector::constant([1.0, 0.0]),
        }
    }

    /// The frame that is seen from this one as `inner`.
    #[inline(always)]
    pub(super) fn then(&self, inner: &Self) -> Self {
        Self {
            at: self.at + self.direction.complex_product(inner.at),
            direction: self.direction.complex_product(inner.direction),
        }
    }

    /// The frame turned as `direction` that has `point` at `world`.
    #[inline(always)]
    pub(super) fn frame_through_point(
        direction: Vector<N>,
        point: Local<N>,
        world: Vector<N>,
    ) -> Self {
        Self {
            at: world - point.turned_to_ground(direction),
            direction,
        }
    }
}

/// The inverse of a frame: the frame of the outer in the inner.
pub(super) fn inverse<const N: usize>(frame: &Frame<N>) -> Frame<N> {
    let direction = frame.direction.mirrored();
    Frame {
        at: -direction.complex_product(frame.at),
        direction,
    }
}
