//! Studies: maps, laws of motion, cams, steady motion.

mod cam;
mod contact_force;
mod law;
mod map;
mod map_order;
mod prepared;
mod steady;
