//! Tests of linkages.

mod examples;
mod known;
mod random;
mod support;
