//! A linkage made ready to be solved: its groups in the order of solution,
//! every pair seen from the links it joins.

use super::dyad::Margin;
use super::elements::{Body, Element, Frame, elements};
use super::newton::NewtonGroup;
use super::spec::{LinkageSpec, PairKind, PairSpec, PointOf};
use super::state::{Motion, Scratch, State};
use super::vector::{Local, Vector};
use super::welds::AttachedLink;

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
            PairKind::Sliding {
                direction, angle, ..
            } => {
                let (sin, cos) = (direction + angle).sin_cos();
                Some([cos, sin])
            }
            _ => None,
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
    pub(super) fn relative_frame<const N: usize>(&self, input: f64) -> Frame<N> {
        match self.sliding {
            None => {
                let direction = Vector::unit(input, 1.0);
                let pin = Vector::constant(self.on.point);
                Frame::frame_through_point(direction, Local::Fixed(self.link.point), pin)
            }
            Some(turned) => {
                let direction = Vector::constant(turned);
                let [x, y] = self.on.point;
                let [u, v] = self.on.along;
                let q = crate::math::series::Series::variable(input);
                let block = Vector::new(q.scale(u).shift(x), q.scale(v).shift(y));
                Frame::frame_through_point(direction, Local::Fixed(self.link.point), block)
            }
        }
    }
}

/// Step of the plan: a group made ready.
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
    /// Links that are welded to others, placed after all groups.
    pub(super) attached: Vec<AttachedLink>,
    /// Number of links.
    pub(super) links: usize,
    /// A length typical of the linkage (m).
    pub(super) size: f64,
}

impl Plan {
    /// Places the links that are welded to others, these being placed.
    #[inline]
    pub(super) fn attach<const N: usize>(&self, state: &mut State) {
        for one in &self.attached {
            let frame = one.frame::<N>(&state.frame(one.base));
            state.links[one.link].set(&frame);
        }
    }

    /// Memory for solving, everything in the frame of the ground.
    pub(super) fn state(&self) -> State {
        let most = self.steps.iter().map(|step| match step {
            Step::Dyad(_) => 0,
            Step::Newton(group) => group.bodies.len(),
        });
        State {
            links: vec![Motion::GROUND; self.links],
            relative: Motion::GROUND,
            margins: vec![Margin::default(); self.steps.len()],
            scratch: Scratch::new(most.max().unwrap_or(0)),
            reduced: 0.0,
            near: vec![0.0; self.links],
            turned: self.driver.sliding.is_none(),
        }
    }
}

/// A length typical of the linkage: the greatest distance between points that
/// belong together, or radius of a cam (m).
pub(super) fn typical_length(spec: &LinkageSpec) -> f64 {
    let points: Vec<PointOf> = spec.joints().collect();
    let mut size = spec.greatest_coupling();
    for (index, one) in points.iter().enumerate() {
        for other in points[index + 1..].iter().filter(|o| o.link == one.link) {
            let [x, y] = [other.at[0] - one.at[0], other.at[1] - one.at[1]];
            size = size.max(x.hypot(y));
        }
    }
    if size > 0.0 { size } else { 1.0 }
}
