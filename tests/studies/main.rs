//! Studies: derivatives, best values, maps, laws of motion, cams, steady motion.

mod cam;
mod contact_force;
mod gradient;
mod identify;
mod law;
mod map;
mod map_order;
mod optimize;
mod prepared;
mod steady;
