//! Linkages: kinematics, kinetostatics, motion, friction in their joints.

mod multipliers;

mod dynamics;
mod forces;
mod joint_friction;
mod kinematics;
mod scenes;
mod slide_crank;
