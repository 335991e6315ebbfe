//! Linear algebra of the implicit methods: the Jacobian on its pattern, and sparse
//! elimination of what they make of it.
//!
//! The order of the system is halved: of (κ·I − J)·[k_u; k_v] = [r_u; r_v] with
//! J = [0, I; J_u, J_v] remains (κ²·I − κ·J_v − J_u)·k_u = r_v + κ·r_u − J_v·r_u,
//! and k_v = κ·k_u − r_u.

mod entry;
mod jacobian;
mod sparse;

pub(super) use entry::{Entry, Lanes};
pub(super) use jacobian::Jacobian;
pub(super) use sparse::SparseLu;
