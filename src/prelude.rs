//! What most programs need: `use dam::prelude::*;`

pub use crate::ask::{Map, MapQuestion, Mechanism, PreparedScene, RunOptions, Scene};
pub use crate::dynamics::integrate::Method;
pub use crate::dynamics::record::{Figure, Quantity};
pub use crate::error::Error;
pub use crate::frontend::build::kinds::*;
pub use crate::frontend::build::{
    AnyObject, Assembly, Differential, DiscCam, Drive, Force, Geometry, Joint, Law, Link, Linkage,
    LinkageForce, LinkageInput, Load, Output, OwnObject, Pair, Position, Station, Torque,
};
pub use crate::studies::axis::Axis;
pub use crate::studies::kinematics::{
    InputCourse, InputOver, Over, Quantity as LinkageQuantity, Question as LinkageQuestion,
};
pub use crate::studies::map::Verdict;
pub use crate::studies::run::RunResult;
pub use crate::studies::steady::Answer as SteadyAnswer;
