//! Studies: maps, laws of motion, cams, steady motion.

mod cam;
mod law;
mod map;
mod map_order;
mod steady;
