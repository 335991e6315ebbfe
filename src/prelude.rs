//! What most programs need: `use dam::prelude::*;`

pub use crate::analysis::axis::Axis;
pub use crate::analysis::kinematics::{
    Over, Quantity as LinkageQuantity, Question as LinkageQuestion,
};
pub use crate::analysis::map::Verdict;
pub use crate::analysis::run::RunResult;
pub use crate::analysis::steady::Answer as SteadyAnswer;
pub use crate::ask::{Map, MapQuestion, Mechanism, RunOptions, Scene};
pub use crate::build::{
    AnyObject, Assembly, CamFollower, Crank, Differential, DiscCam, Drive, Force, Geometry, Joint,
    Law, Link, Linkage, LinkageForce, Load, Output, OwnObject, Pair, Position, Rocker, Shaft,
    Slider, Station, Torque,
};
pub use crate::error::Error;
pub use crate::integrate::Method;
pub use crate::record::{Figure, Quantity};
