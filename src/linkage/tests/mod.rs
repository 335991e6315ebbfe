//! Tests of linkages.

mod branches;
mod change_points;
mod examples;
mod forces;
mod known;
mod random;
mod refusals;
mod support;
