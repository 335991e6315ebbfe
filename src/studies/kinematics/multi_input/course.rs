//! A linkage of several inputs from place to place on the axis.

use super::super::columns::{ColumnHeading, headings};
use super::super::rows::Course;
use super::request::AskedSeveral;
use super::values;
use crate::dynamics::model::Coordinate;
use crate::kinematics::linkage::multi::{MultiMotion, MultiRounding, NotAssembled};
use crate::math::jet::Jet;
use crate::studies::endless::DeadEnd;

/// The course of several inputs.
pub(super) struct SeveralInputs<'q, 'a> {
    asked: &'q AskedSeveral<'a>,
    pub(super) motion: MultiMotion,
    rounding: MultiRounding,
    /// Angles of all links at every row: from there they go on.
    angles: Vec<Vec<f64>>,
}

impl<'q, 'a> SeveralInputs<'q, 'a> {
    pub(super) fn new(asked: &'q AskedSeveral<'a>) -> Self {
        Self {
            asked,
            motion: MultiMotion::new(&asked.linkage),
            rounding: MultiRounding::of(&asked.linkage),
            angles: Vec::new(),
        }
    }

    /// Goes to a place of the axis.
    pub(super) fn set_place(&mut self, place: f64) -> Result<(), NotAssembled> {
        self.motion.set_inputs(&self.asked.inputs_at(place))
    }
}

impl Course for SeveralInputs<'_, '_> {
    type Outside = NotAssembled;

    fn headings(&self) -> Vec<ColumnHeading> {
        let spec = &self.asked.linkage.spec().linkage;
        headings(spec, &self.asked.named(), &self.asked.outputs)
    }

    fn limits(&self) -> Vec<DeadEnd> {
        self.asked.dead_ends()
    }

    fn at(&mut self, place: f64, values: &mut Vec<f64>) -> Result<(), NotAssembled> {
        self.set_place(place)?;
        values::values(self.asked, &self.motion, values);
        Ok(())
    }

    fn errors(&mut self, _place: f64, values: &[f64], errors: &mut Vec<f64>) {
        let (asked, motion) = (self.asked, &self.motion);
        self.rounding.errors(
            (motion.inputs(), motion.angles()),
            values,
            |copy, out| values::values(asked, copy, out),
            errors,
        );
    }

    fn ordinary_size(&self, _place: f64, heading: &ColumnHeading) -> f64 {
        let size = self.asked.linkage.typical_length();
        let unit = |coordinate: Coordinate| match coordinate {
            Coordinate::Turning => 1.0,
            Coordinate::Sliding => size,
        };
        let own = if heading.turning { 1.0 } else { size };
        if let Some(by) = &heading.by {
            let inputs = self.asked.linkage.inputs().iter();
            let mut named = inputs.zip(&self.asked.inputs);
            let input = named.find(|(input, _)| input.name == *by);
            let input = input.map_or(1.0, |(_, coordinate)| unit(*coordinate));
            return heading.quantity.ordinary_size(own, input, Jet::default());
        }
        let rate = |of: fn(&Jet) -> f64| -> f64 {
            let inputs = self.motion.inputs().iter().zip(&self.asked.inputs);
            inputs
                .map(|(input, own)| of(input).abs() / unit(*own))
                .sum()
        };
        let all = Jet {
            first: rate(|input| input.first),
            second: rate(|input| input.second),
            ..Jet::default()
        };
        heading.quantity.ordinary_size(own, 1.0, all)
    }

    fn add_row(&mut self) -> Vec<[f64; 4]> {
        self.angles.push(self.motion.angles().to_vec());
        frames(&self.motion, self.asked.linkage.spec().linkage.links.len())
    }

    fn resume(&mut self, row: usize) {
        self.motion.unwrap_angles(&self.angles[row]);
    }
}

/// Frames of all links: x, y, cos, sin.
pub(super) fn frames(motion: &MultiMotion, links: usize) -> Vec<[f64; 4]> {
    let frame = |link: usize| {
        let pose = motion.pose(link);
        [pose.x, pose.y, pose.cos, pose.sin]
    };
    (0..links).map(frame).collect()
}
