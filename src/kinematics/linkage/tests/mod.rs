//! Tests of linkages.

mod branches;
mod cams;
mod change_points;
mod couplings;
mod examples;
mod forces;
mod kinetostatics;
mod known;
mod random;
mod redundant;
mod refusals;
mod resistance;
pub(super) mod support;
mod welds;
