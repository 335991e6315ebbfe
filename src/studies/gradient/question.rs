//! The question as a whole: derivatives, then their check.

use super::Gradient;
use super::check;
use super::derive::{Subject, Unchecked, derivatives};
use crate::exact::sensitivity::EventTimes;
use crate::fault::Fault;

/// Derivatives of results of the run by parameters of the scene.
///
/// # Errors
/// The scene is of a kind that has no derivatives here, or its run does not come to its end.
pub(crate) fn gradient(subject: &Subject<'_>) -> Result<Gradient, Vec<Fault>> {
    gradient_with(subject, EventTimes::Moving)
}

/// The same by the rule that is given.
pub(super) fn gradient_with(
    subject: &Subject<'_>,
    events: EventTimes,
) -> Result<Gradient, Vec<Fault>> {
    let Unchecked {
        mut found,
        rows,
        near,
    } = derivatives(subject, events)?;
    if subject.check.unwrap_or(check::is_cheap(&found)) {
        check::check(subject, &mut found, &rows, &near);
    }
    Ok(found)
}
