//! A linkage made ready to be solved: its groups in the order of solution,
//! every pair seen from the links it joins.

use super::newton::NewtonGroup;
use super::spec::{LinkageSpec, PairKind, PairSpec};
use super::vector::{Local, Vector};

/// What a link contributes to a pair, in its own frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Element {
    /// The link; `None`: the ground.
    pub(super) link: Option<usize>,
    /// The pin, or a point on the axis of the guide (m).
    pub(super) point: [f64; 2],
    /// Unit vector along the guide; of a pin, no meaning.
    pub(super) along: [f64; 2],
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
    pub(super) fn has(&self, link: usize) -> bool {
        self.base == link || self.driven == Some(link)
    }

    /// Its links.
    pub(super) fn links(&self) -> impl Iterator<Item = usize> {
        std::iter::once(self.base).chain(self.driven)
    }
}

/// An element of a pair in the frame of its body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Part {
    /// The point, in the frame of its link (m).
    pub(super) point: [f64; 2],
    /// The direction of the guide, in the frame of its link.
    pub(super) along: [f64; 2],
    /// True: the link is the driven one of the body.
    pub(super) driven: bool,
}

impl Part {
    pub(super) fn new(element: &Element, body: &Body) -> Self {
        Self {
            point: element.point,
            along: element.along,
            driven: body.driven.is_some() && element.link == body.driven,
        }
    }

    /// Its point, in the frame of the body.
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
pub(super) struct Frame<const N: usize> {
    /// The origin (m).
    pub(super) at: Vector<N>,
    /// (cos θ, sin θ).
    pub(super) direction: Vector<N>,
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

    /// A point given in this frame.
    #[inline(always)]
    pub(super) fn place(&self, point: [f64; 2]) -> Vector<N> {
        self.at + self.direction.turn_constant(point)
    }

    /// The frame turned as `direction` that has `point` at `world`.
    #[inline(always)]
    pub(super) fn through(direction: Vector<N>, point: Local<N>, world: Vector<N>) -> Self {
        Self {
            at: world - point.seen(direction),
            direction,
        }
    }
}

/// The driver: the pair whose relative coordinate is the input.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Driver {
    /// Its elements.
    pub(super) on: Element,
    /// Its elements.
    pub(super) link: Element,
    /// Sliding: (cos, sin) of the constant angle of j's frame in i's.
    pub(super) sliding: Option<[f64; 2]>,
}

impl Driver {
    pub(super) fn new(pair: &PairSpec) -> Self {
        let [on, link] = elements(pair);
        let sliding = match pair.kind {
            PairKind::Revolute { .. } => None,
            PairKind::Sliding {
                direction, angle, ..
            } => {
                let (sin, cos) = (direction + angle).sin_cos();
                Some([cos, sin])
            }
        };
        Self { on, link, sliding }
    }

    /// The body of the driver when both its links move.
    pub(super) fn assembly(&self) -> Option<Body> {
        let driven = Some(self.link.link?);
        let base = self.on.link?;
        Some(Body { base, driven })
    }

    /// The frame of link j in the frame of link i.
    #[inline(always)]
    pub(super) fn relative<const N: usize>(&self, input: f64) -> Frame<N> {
        match self.sliding {
            None => {
                let direction = Vector::unit(input, 1.0);
                let pin = Vector::constant(self.on.point);
                Frame::through(direction, Local::Fixed(self.link.point), pin)
            }
            Some(turned) => {
                let direction = Vector::constant(turned);
                let [x, y] = self.on.point;
                let [u, v] = self.on.along;
                let q = crate::math::series::Series::variable(input);
                let block = Vector::new(q.scale(u).shift(x), q.scale(v).shift(y));
                Frame::through(direction, Local::Fixed(self.link.point), block)
            }
        }
    }
}

/// The inverse of a frame: the frame of the outer in the inner.
pub(super) fn inverse<const N: usize>(frame: &Frame<N>) -> Frame<N> {
    let direction = frame.direction.mirrored();
    Frame {
        at: -direction.turn(frame.at),
        direction,
    }
}

/// One group made ready.
#[derive(Clone, Debug)]
pub(super) enum Step {
    /// A dyad.
    Dyad(super::dyad::Dyad),
    /// A larger group.
    Newton(NewtonGroup),
}

impl Step {
    /// The bodies it places.
    pub(super) fn bodies(&self) -> &[Body] {
        match self {
            Self::Dyad(dyad) => &dyad.bodies,
            Self::Newton(group) => &group.bodies,
        }
    }
}

/// A linkage made ready to be solved.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    /// The driver.
    pub(super) driver: Driver,
    /// The groups after the driver, in the order of solution.
    pub(super) steps: Vec<Step>,
    /// Number of links.
    pub(super) links: usize,
    /// A length typical of the linkage (m).
    pub(super) size: f64,
}

/// A length typical of the linkage: the greatest distance between points that
/// belong together (m).
pub(super) fn size(spec: &LinkageSpec) -> f64 {
    let mut points: Vec<(Option<usize>, [f64; 2])> = Vec::new();
    for pair in &spec.pairs {
        for element in elements(pair) {
            points.push((element.link, element.point));
        }
    }
    let mut size = 0.0f64;
    for (index, (link, at)) in points.iter().enumerate() {
        for (other, to) in &points[index + 1..] {
            if link == other {
                size = size.max((to[0] - at[0]).hypot(to[1] - at[1]));
            }
        }
    }
    if size > 0.0 { size } else { 1.0 }
}
