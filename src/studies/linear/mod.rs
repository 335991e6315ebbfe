//! The linear equations of elastic objects behind prescribed drives, and their answer to a
//! frequency.
//!
//! Every tree of masses behind a prescribed drive is linear and does not change with time while
//! its contacts stay closed ([`LinearTree`](crate::exact::LinearTree)). Its states are the
//! deviations q of the masses from the rigid mechanism, and their speeds:
//!
//! J·q̈ + B·q̇ + K·q = W − ratio·(J·L̈ + g_b·L̇ + g_k·L)
//!
//! with loads W, the law L of the first object, and springs g_k and dampers g_b to the ground.
//! A state space takes L, L̇ and L̈ as three inputs. The transfer function of the law is
//! H = H_L + s·H_L̇ + s²·H_L̈: it multiplies L.
//!
//! Conventions: time dependence e^{+iωt}; H = output/input; a phase in (−π, π], positive where
//! the output leads. Base motion enters displacements as (c₁ + b₁·s)·L.
//!
//! A machine that a motor turns steadily is linearised about that motion (`machine`): its states
//! are twists and speeds, and its angle counts for nothing.
//!
//! The error of the model is found by the same answer of a model with more masses (`finer`).
//!
//! Limits: objects reduced to modes, contacts whose force is not linear, rigid contacts, joint
//! friction, and machines with linkages or varying ratios behind a motor are refused with the reason.

mod finer;
mod frequencies;
mod linearise;
mod machine;
mod model;
mod modes;
mod peaks;
mod response;
mod signals;
mod state_space;
#[cfg(test)]
mod tests;

pub use frequencies::{MOST_NUMBERS, check as check_frequencies, usual as usual_frequencies};
pub use linearise::linearise;
pub use model::{LeftOut, LinearModel};
pub use modes::{Mode, TreeModes};
pub use peaks::ResponsePeak;
pub use response::{FrequencyResponse, JudgedBy, PairResponse, ResponseQuestion, response};
pub use signals::{InputSignal, OutputSignal, Signal};
pub use state_space::{Linearisation, OperatingPoint, StateSpace};
