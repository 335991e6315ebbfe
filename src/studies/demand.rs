//! What of a run is wanted.
//!
//! A prepared scene requests some results of an exact point, and what a verdict rests on, but no
//! samples and no balance. `dam methods` times the same walk, or the integration itself with samples of δ
//! and events alone (`studies::methods::light`). `steady` integrates its cycles into listeners
//! of its own.

use super::exact;
use crate::dynamics::system::System;
use crate::exact::{KeptLaws, Parts, RequestedFigures};
use crate::fault::Fault;
use std::cell::RefCell;

/// Demand on a motion: what is wanted of it.
#[derive(Clone, Copy)]
pub(super) struct Demand<'d> {
    /// Where the whole system is propagated exactly: the figures of its elastic objects
    /// that are wanted, and no others, no samples and no energy audit; `None`:
    /// everything.
    pub(super) figures: Option<&'d dyn Fn(usize) -> RequestedFigures>,
    /// Laws of systems before that move by the same ones.
    pub(super) laws: Option<&'d RefCell<KeptLaws>>,
    /// True: the equations of motion are checked.
    pub(super) checked: bool,
}

impl Demand<'_> {
    /// Figures of all objects, samples, the energy audit.
    pub(super) const EVERYTHING: Self = Self {
        figures: None,
        laws: None,
        checked: true,
    };

    /// The parts of a system that is propagated exactly as a whole; its modes are not
    /// tried beforehand.
    pub(super) fn exact_parts(&self, system: &System) -> Result<Parts, Vec<Fault>> {
        match self.laws {
            Some(laws) => exact::whole_with(system, &mut laws.borrow_mut()),
            None => exact::exact_parts(system),
        }
    }
}
