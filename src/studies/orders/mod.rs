//! Orders of the law and resonances over the speed of the drive (Campbell diagram).
//!
//! Behind a drive of constant speed the law of an object is U = Σ u_k·e^{ikφ} of the angle φ of
//! the drive. Order k shakes with k times the frequency of the drive. Where this meets a natural
//! frequency the object deviates by |H(ikω) − 1|·|2·u_k| of this order alone.
//!
//! The coefficients u_k follow in closed form from the polynomials and sines that a law consists
//! of (`math::fourier`). Linkages have no such pieces: their coefficients are integrals, by
//! adaptive quadrature. Nothing is sampled and transformed.
//!
//! The deviation over the speed is that of the exact periodic motion, not of the sum of orders.
//!
//! Limits: one function on the way that is no straight line; natural frequencies that do not
//! depend on the speed.

mod crossings;
mod deviation;
mod law;
#[cfg(test)]
mod tests;

pub use crossings::{Crossing, Order, OrdersAnswer, OrdersQuestion, TreeOrders, orders, suits};
pub use deviation::{Deviation, SpeedPoint};
