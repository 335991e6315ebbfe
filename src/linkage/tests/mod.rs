//! Tests of linkages.

mod examples;
mod first;
mod random;
mod support;
