//! Tests of linkages.

mod change_points;
mod examples;
mod known;
mod random;
mod support;
