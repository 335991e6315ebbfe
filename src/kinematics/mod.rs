//! Functions of position and of time: constraints, position functions, laws of motion,
//! planar linkages, cams. Nothing here knows a scene or an integration in time.

pub mod breaks;
pub mod cam;
pub mod constraint;
pub(crate) mod hertzian;
pub mod linkage;
pub mod motion;
pub mod position;
