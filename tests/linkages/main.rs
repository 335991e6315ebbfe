//! Linkages: kinematics, kinetostatics, motion, friction in their joints.

mod multipliers;

mod chains;
mod dynamics;
mod forces;
mod joint_friction;
mod kinematics;
mod scenes;
mod several;
mod several_cams;
mod several_forces;
mod several_kinematics;
mod slide_crank;
