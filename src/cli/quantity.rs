//! Quantities that options state.

use super::failure::Failure;
use crate::frontend::object::law::read_argument;
use crate::frontend::read::{Bounds, QuantityChoice};

/// What an option states, if it is given.
pub(crate) fn option(
    name: &str,
    text: &Option<String>,
    wanted: impl Into<QuantityChoice>,
    bounds: Bounds,
) -> Result<Option<f64>, Failure> {
    let wanted = wanted.into();
    let read = |text: &String| read_argument(name, text, |slot| slot.quantity(wanted, bounds));
    Ok(text.as_ref().map(read).transpose()?)
}
