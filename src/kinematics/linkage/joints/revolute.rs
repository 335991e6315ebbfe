//! A pin: both points lie in one place.

use super::super::elements::Element;
use super::super::vector::Vector;
use super::constraint::{Constraint, Frames, Measure, Shape, Turns, Wrench};
use crate::math::number::Number;
use crate::math::series::Series;

/// A pin made ready: its points on both links.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PinInHole(pub(super) [Element; 2]);

impl Constraint for PinInHole {
    const SHAPE: Shape = Shape {
        rows: &[Measure::Length; 2],
        links: 2,
        turning: &[],
    };

    #[inline(always)]
    fn errors<const K: usize>(&self, links: &impl Turns<K>, mut set: impl FnMut(usize, Series<K>)) {
        let [on, link] = &self.0;
        let gap = links.frame(1).place(link.point) - links.frame(0).place(on.point);
        set(0, gap.x);
        set(1, gap.y);
    }

    #[inline(always)]
    fn rows<const K: usize, T: Number>(
        &self,
        links: &impl Frames<K, T>,
        mut add: impl FnMut(usize, usize, Wrench<K, T>),
    ) {
        for (link, sign) in [(0, -1.0), (1, 1.0)] {
            let at = links.frame(link).place(self.0[link].point);
            let force = Vector::fixed([sign, 0.0]);
            add(0, link, Wrench::Force { at, force });
            let force = Vector::fixed([0.0, sign]);
            add(1, link, Wrench::Force { at, force });
        }
    }
}
