//! Tests of linkages.

mod examples;
mod first;
