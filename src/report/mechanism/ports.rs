//! Where a linkage is driven, where its outputs are, and where forces act on them.

use super::guides::place;
use super::names::ground_pin;
use super::view::View;
use super::Drawing;
use crate::kinematics::linkage::spec::{OutputKind, PairKind, PairSpec, PointOf};

/// Arm at which a moment is drawn as a force on a link without a second point (pixels).
const ARM: f64 = 40.0;
/// Places that are less apart than this are one to the eye (pixels).
const APART: f64 = 2.0;

/// Place of a link at which a force on a coordinate is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::report) struct Hold {
    /// Index of the link.
    pub(in crate::report) link: usize,
    /// The place in the frame of the link (pixels, y downwards).
    pub(in crate::report) at: [f64; 2],
    /// Direction of a positive force or moment, of length 1: in the frame of the link, or of the
    /// ground.
    pub(in crate::report) along: [f64; 2],
    /// True where the direction is that of the ground.
    pub(in crate::report) fixed: bool,
}

impl Drawing<'_> {
    /// The pixel at which a line to what an output drives begins: the place of the output that is
    /// farthest to the right, or the one in a position where no other is.
    pub(in crate::report) fn outlet(
        &self,
        view: &View,
        output: &OutputKind,
        frame: usize,
    ) -> [f64; 2] {
        let point = self.place_of(output);
        let pixel = |frame: &Vec<_>| view.pixel(place(frame, &point));
        let places = self.frames.iter().map(pixel);
        let finite = places.filter(|[x, y]| x.is_finite() && y.is_finite());
        let farthest = finite.max_by(|a, b| a[0].total_cmp(&b[0]));
        let own = self.frames.get(frame).map(pixel);
        let own = own.filter(|[x, y]| x.is_finite() && y.is_finite());
        match (own, farthest) {
            (Some(own), Some(farthest)) if farthest[0] - own[0] > APART => farthest,
            (Some(own), _) => own,
            (None, farthest) => farthest.unwrap_or([view.width, 0.5 * view.height]),
        }
    }

    /// The point of a link that an output is about.
    fn place_of(&self, output: &OutputKind) -> PointOf {
        match *output {
            OutputKind::Angle { link } => self.pivot(link),
            OutputKind::Point { point, .. } => point,
            OutputKind::Pair { pair } => moved(&self.spec.pairs[pair]).0,
        }
    }

    /// The pin on which a link turns in the ground, else its origin.
    fn pivot(&self, link: usize) -> PointOf {
        let pairs = self.spec.pairs.iter();
        let mut pins = pairs.filter(|pair| ground_pin(pair).is_some_and(|(_, own)| own == link));
        let origin = PointOf {
            link: Some(link),
            at: [0.0; 2],
        };
        pins.next().map_or(origin, |pair| moved(pair).0)
    }

    /// Where a force on an output is drawn; `None`: on the ground.
    pub(in crate::report) fn hold(&self, view: &View, output: &OutputKind) -> Option<Hold> {
        match *output {
            OutputKind::Angle { link } => Some(self.moment(view, (link, self.pivot(link).at), 1.0)),
            OutputKind::Point { point, direction } => Some(Hold {
                link: point.link?,
                at: local(view, point.at),
                along: [direction.cos(), -direction.sin()],
                fixed: true,
            }),
            OutputKind::Pair { pair } => self.hold_of_pair(view, pair),
        }
    }

    /// Where a force on the relative coordinate of a pair is drawn; `None`: on the ground.
    pub(in crate::report) fn hold_of_pair(&self, view: &View, pair: usize) -> Option<Hold> {
        let pair = self.spec.pairs.get(pair)?;
        let (end, sense) = moved(pair);
        let link = end.link?;
        let PairKind::Sliding {
            direction, angle, ..
        } = pair.kind
        else {
            return Some(self.moment(view, (link, end.at), sense));
        };
        // The direction of the guide in the frame of the link.
        let turned = if sense > 0.0 { -angle } else { direction };
        Some(Hold {
            link,
            at: local(view, end.at),
            along: [sense * turned.cos(), -sense * turned.sin()],
            fixed: false,
        })
    }

    /// A moment on a link about a point of it: a force at the point farthest from there, square
    /// to its arm.
    fn moment(&self, view: &View, (link, pin): (usize, [f64; 2]), sense: f64) -> Hold {
        let points = self.spec.links[link].points.iter();
        let arms = points.map(|point| [point.at[0] - pin[0], point.at[1] - pin[1]]);
        let arm = arms.max_by(|a, b| a[0].hypot(a[1]).total_cmp(&b[0].hypot(b[1])));
        let arm = arm.filter(|[x, y]| x.hypot(*y) * view.scale > APART);
        let [x, y] = arm.unwrap_or([ARM / view.scale, 0.0]);
        let size = x.hypot(y);
        Hold {
            link,
            at: local(view, [pin[0] + x, pin[1] + y]),
            along: [-sense * y / size, -sense * x / size],
            fixed: false,
        }
    }

    /// The pixel at which the motion of a driving pair comes in: its pin in the ground, else the
    /// middle of the left edge.
    pub(in crate::report) fn inlet(&self, view: &View, pair: usize) -> [f64; 2] {
        let pin = self.spec.pairs.get(pair).and_then(ground_pin);
        pin.map_or([0.0, 0.5 * view.height], |(pin, _)| view.pixel(pin))
    }
}

/// A point of a link in its own frame (pixels, y downwards).
fn local(view: &View, [x, y]: [f64; 2]) -> [f64; 2] {
    [x * view.scale, -y * view.scale]
}

/// The end of a pair that moves, and with which sign its coordinate moves it.
fn moved(pair: &PairSpec) -> (PointOf, f64) {
    match pair.link.link {
        Some(_) => (pair.link, 1.0),
        None => (pair.on, -1.0),
    }
}
