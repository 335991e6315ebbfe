//! Speed against accuracy of every method on one's own scene, and where and
//! why methods fail.
//!
//! Every method runs the scene at a ladder of tolerances, or of steps. Each
//! point is timed (from the system ready to all samples of δ and all switch
//! times, the median of repeated runs), its error is taken against a reference,
//! and it is judged. A point that is not what it should be is named with its
//! cause. From the points the fastest method for the asked accuracy follows.
//!
//! Errors of the trajectory are the greatest difference of δ at the samples
//! relative to max|δ| of the reference, of the worst elastic object (where
//! nothing is elastic: of the displacement of rotors). Wall-clock times vary
//! from run to run; everything else does not.

mod attempt;
mod doubt;
mod light;
mod limit;
mod line;
mod models;
mod point;
mod recommend;
mod reference;
mod setting;
mod stability;
mod study;
pub mod sweep;
mod verdict;

pub use doubt::AGREE;
pub use doubt::Doubt;
pub use limit::StabilityLimit;
pub use line::MethodLine;
pub use models::{ModelError, Models, models};
pub use point::{FigureError, Point};
pub use recommend::{Recommendation, recommend};
pub use reference::{Distance, HORIZON, Reference};
pub use setting::{Setting, all_methods, is_exact, is_fixed_step};
pub use stability::{series_limit, stability_limit};
pub use study::{Now, Plan, Study, study};
pub use verdict::{GROWN, Verdict};
