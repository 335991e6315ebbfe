//! The object graph as a picture. Charts are drawn by [`crate::report::plot`].

pub mod graph;
