//! The object graph.
