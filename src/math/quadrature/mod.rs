//! Integrals: Gauss's rules, widened by Kronrod where an error is to be known.
//!
//! `integrate` estimates the error of one smooth integrand; `Integrals` closes in on jumps of
//! several.

mod adaptive;
mod kronrod;
mod legendre;
mod panels;

pub(crate) use adaptive::{Area, integrate};
pub(crate) use legendre::{FIVE, legendre, rule, zeros};
pub(crate) use panels::Integrals;
