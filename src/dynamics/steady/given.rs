//! What of a machine is given over its cycle.

/// What is given beside J.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Given {
    /// The reduced moment M(φ) of all external forces (N·m).
    Moment,
    /// Their work A(φ) from any position on (J).
    Work,
}
