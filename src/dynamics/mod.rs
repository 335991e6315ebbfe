//! Models and their motion: ports and nodes, equations of motion, integration in time,
//! records with figures and energy audit, steady motions of machines.

pub(crate) mod audit;
pub mod builder;
pub mod energy;
pub mod integrate;
pub mod laws;
pub mod load;
pub mod model;
pub mod record;
pub(crate) mod restitution;
pub(crate) mod segment;
pub(crate) mod stated;
pub mod steady;
pub mod system;
pub(crate) mod trajectory;
