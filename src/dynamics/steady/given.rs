//! What of a machine is given over its cycle.

/// Kind of function that is given beside J.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FunctionKind {
    /// The reduced moment M(φ) of all external forces (N·m).
    Moment,
    /// Work A(φ) of the forces from any position on (J).
    Work,
}
