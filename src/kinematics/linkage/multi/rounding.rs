//! How far rounding reaches: the same linkage with its numbers moved in the last digits.

use super::{MultiLinkage, MultiMotion};
use crate::kinematics::linkage::rounding::{COPIES, SAFETY, perturbed};
use crate::math::jet::Jet;

/// Copies of a linkage of several inputs that differ from it by rounding.
#[derive(Clone, Debug)]
pub struct MultiRounding {
    copies: Vec<MultiMotion>,
    values: Vec<f64>,
}

impl MultiRounding {
    /// Of a linkage; without copies, and so without any error, where none can be put together.
    pub fn of(linkage: &MultiLinkage) -> Self {
        let copies = (1..=COPIES).filter_map(|seed| {
            let mut spec = linkage.spec().clone();
            spec.linkage = perturbed(&spec.linkage, linkage.typical_length(), seed);
            let copy = MultiLinkage::new(spec).ok()?;
            let alike = copy.core.signs == linkage.core.signs;
            alike.then(|| MultiMotion::new(&copy))
        });
        Self {
            copies: copies.collect(),
            values: Vec::new(),
        }
    }

    /// Estimated errors of `values`, which `evaluate` finds at a motion of the inputs;
    /// `angles`: those of the links there. Infinite where a copy cannot be assembled.
    pub fn errors(
        &mut self,
        (inputs, angles): (&[Jet], &[f64]),
        values: &[f64],
        mut evaluate: impl FnMut(&MultiMotion, &mut Vec<f64>),
        errors: &mut Vec<f64>,
    ) {
        errors.clear();
        errors.resize(values.len(), 0.0);
        for copy in &mut self.copies {
            copy.unwrap_angles(angles);
            if copy.set_inputs(inputs).is_err() {
                errors.fill(f64::INFINITY);
                return;
            }
            evaluate(copy, &mut self.values);
            for (error, (value, moved)) in errors.iter_mut().zip(values.iter().zip(&self.values)) {
                let off = SAFETY * (moved - value).abs();
                // Not a number is no small error.
                *error = match off.is_nan() {
                    true => f64::INFINITY,
                    false => error.max(off),
                };
            }
        }
    }
}
