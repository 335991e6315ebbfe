//! The value of a parameter that meets conditions best: the highest speed at which a pair keeps
//! its force, the least preload, the smallest base circle.
//!
//! One parameter goes over a range. It is looked at in a number of places first ([`Span`]). Where
//! conditions cease to hold between two of them, the place is narrowed down to one part in 10⁷ of
//! the range ([`search()`]), and where a figure is to be greatest or least, Brent's method goes on
//! from the best place. What holds only between two neighbouring places can be missed: where a
//! parabola through three says that a condition is near its limit, its vertex is looked at too.
//!
//! A place at which the mechanism cannot be, or stops, meets no condition. Of one whose
//! computation fails or fails its own checks nothing is known, and an answer that such a place
//! could better is not certified.

mod answer;
mod figures;
mod found;
mod goal;
mod sample;
mod search;
mod span;
#[cfg(test)]
mod tests;

pub use answer::FoundValue;
pub(crate) use figures::{FigureValues, figures_of};
pub use found::{Best, ConditionEnd, FindResult, Limit, Range};
pub use goal::{Aim, Goal};
pub use sample::{Sample, State};
pub use search::{Evaluate, search};
pub use span::{MOST_WHOLE, PLACES, Span};
