//! How the lanes of a signal go on from the start of a part.

use crate::exact::lanes::V;
use crate::exact::panel::Amplitudes;

/// Lanes from the start of a part on.
#[derive(Clone, Copy)]
pub(super) enum LanesAhead<'a> {
    /// All can be followed; a bound on the fourth derivatives.
    Followed(V),
    /// Some turn far.
    Mixed(&'a Amplitudes),
}
