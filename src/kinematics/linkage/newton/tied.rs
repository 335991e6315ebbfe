//! The couplings of a group that is solved by iteration: one equation each.

use super::NewtonGroup;
use super::cam::Rolling;
use super::geared::Geared;
use crate::kinematics::linkage::state::{Scratch, State};
use crate::math::series::Series;

/// A coupling made ready.
#[derive(Clone, Debug)]
pub(in crate::kinematics::linkage) enum Tied {
    /// Gears, a belt, or a rack.
    Wheels(Geared),
    /// A cam.
    Cam(Box<Rolling>),
}

impl Tied {
    /// Its closing error: rad, or a length over the size.
    pub(super) fn error<const N: usize>(
        &self,
        group: &NewtonGroup,
        state: &State,
        scratch: &Scratch,
        size: f64,
    ) -> Series<N> {
        match self {
            Self::Wheels(geared) => geared.error(group, state, scratch, size),
            Self::Cam(rolling) => rolling.error(group, state, scratch, size),
        }
    }

    /// Adds the derivatives of its error by the unknowns to the row of the matrix that begins
    /// at `top`.
    pub(super) fn derivatives(
        &self,
        group: &NewtonGroup,
        state: &State,
        scratch: &mut Scratch,
        size: f64,
        top: usize,
    ) {
        match self {
            Self::Wheels(geared) => geared.derivatives(group, state, scratch, size, top),
            Self::Cam(rolling) => rolling.derivatives(group, state, scratch, size, top),
        }
    }

    /// The wheels, whose angles count over whole turns.
    pub(in crate::kinematics::linkage) fn geared(&self) -> Option<&Geared> {
        match self {
            Self::Wheels(geared) => Some(geared),
            Self::Cam(_) => None,
        }
    }
}
