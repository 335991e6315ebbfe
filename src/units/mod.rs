//! Units and quantities: what a number with a unit means, and whether it fits.
//!
//! Numbers are SI. A text such as `600 rpm` or `1e7 N m/rad` is read by
//! [`parse()`] into a value in SI units and a [`Dimension`]; a [`Quantity`] says
//! which dimensions it takes and which units it names in its messages. Angle
//! is a dimension of its own here, so that `10 Hz` is not mistaken for an
//! angular speed; where custom drops the radian (N·m or N·m/rad for a
//! stiffness) the quantity takes both.

mod dimension;
mod formula;
mod list;
mod parse;
mod quantity;
mod shown;
mod table;

pub use dimension::Dimension;
pub(crate) use formula::{Scope, formula, reserved_meaning};
pub use list::{number_and_unit, with_common_unit};
pub use parse::{Measure, UnitError, parse};
pub use quantity::{Mismatch, Quantity, quantities};
pub use shown::shown;
pub use table::known_units;
