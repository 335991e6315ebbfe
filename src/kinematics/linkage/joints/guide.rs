//! A guide and its block: no turning against it, no distance across it.

use super::super::elements::Element;
use super::constraint::{Constraint, Frames, Measure, Shape, Turns, Wrench};
use crate::math::number::Number;
use crate::math::series::Series;

/// A guide and its block made ready.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BlockOnGuide(pub(super) [Element; 2]);

impl Constraint for BlockOnGuide {
    const SHAPE: Shape = Shape {
        rows: &[Measure::Angle, Measure::Length],
        links: 2,
        turning: &[],
    };

    /// The sine of the angle between both, and the distance of the block's point.
    #[inline(always)]
    fn errors<const K: usize>(&self, links: &impl Turns<K>, mut set: impl FnMut(usize, Series<K>)) {
        let [on, block] = &self.0;
        let (i, j) = (links.frame(0), links.frame(1));
        let along = i.direction.turn_constant(on.along);
        set(0, along.cross(j.direction.turn_constant(block.along)));
        set(1, along.cross(j.place(block.point) - i.place(on.point)));
    }

    #[inline(always)]
    fn rows<const K: usize, T: Number>(
        &self,
        links: &impl Frames<K, T>,
        mut add: impl FnMut(usize, usize, Wrench<K, T>),
    ) {
        let [on, block] = &self.0;
        let (i, j) = (links.frame(0), links.frame(1));
        let along = i.direction.turn_constant(on.along);
        let turned = along.dot(j.direction.turn_constant(block.along));
        add(0, 0, Wrench::Couple(-turned));
        add(0, 1, Wrench::Couple(turned));
        let (at, force) = (j.place(block.point), along.turned_left());
        add(1, 0, Wrench::Force { at, force: -force });
        add(1, 1, Wrench::Force { at, force });
    }

    /// The block points along its guide, not against it.
    fn is_proper(&self, links: &impl Frames<1, f64>) -> bool {
        let [i, j] = [0, 1].map(|link| {
            let direction = links.frame(link).direction;
            direction.turn_constant(self.0[link].along)
        });
        i.dot(j).value() > 0.0
    }
}
