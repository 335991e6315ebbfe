//! The three models of a scene.

pub mod position;
