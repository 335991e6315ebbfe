//! Disc cams: from the law of motion of a follower and its geometry to the
//! profile, its checks, its sizes and the forces in contact.
//!
//! * [`CamGeometry`]: base circle, guide, roller, flat face or edge.
//! * [`DiscCam`]: law and geometry together; pressure angle, curvature,
//!   polygons of profile and cutter path, what is wrong ([`Finding`]).
//! * [`sizing`]: the least base circle, the best offset, the greatest roller.
//! * [`closing`]: contact force, lift-off speed, the spring that keeps contact;
//!   [`DiscCam::pressure`]: how hard it presses.
//!
//! Sources of the relations: they are derived in the files from vectors and
//! checked in the tests against independent constructions; in the customary
//! form they stand in every textbook on cams (J. Volmer, *Kurvengetriebe*;
//! R. Norton, *Cam Design and Manufacturing Handbook*).

mod check;
pub mod closing;
mod contact;
mod curve;
mod disc;
mod findings;
mod motion;
pub(crate) mod pressing;
pub(crate) mod search;
pub mod sizing;
pub(crate) mod spec;
#[cfg(test)]
mod tests;

pub use curve::Polygon;
pub use disc::{CamState, DiscCam, Pose};
pub use findings::Finding;
pub use motion::{FollowerMotion, Piece};
pub use search::At;
pub use spec::{CamGeometry, CamMaterial, Contact, Guide, Surface};
