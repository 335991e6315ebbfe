//! Dimensionless laws of motion: a rise from 0 to 1 while τ runs from 0 to 1.
//!
//! Two kinds: laws of a full stroke, from rest to rest ([`Law::of_stroke`]),
//! and laws of a run-up, from rest to uniform motion ([`Law::of_run_up`]), of
//! which strokes are composed. A law is laid out once, as pieces with one
//! formula each; evaluating it allocates nothing.

mod compose;
mod constants;
mod extremes;
mod form;
mod names;
mod polynomial;
mod spec;
#[cfg(test)]
mod tests;
mod trapezoid;

pub use crate::math::optimise::Peak;
pub use constants::{Jump, LawConstants};
pub use names::{LawName, RunLawName};
pub(crate) use polynomial::MOST_CONDITIONS;
pub use polynomial::{EndPolynomial, PolynomialSpec};
pub(crate) use spec::TABLE_POINTS;
pub use spec::{LawSpec, RunLawSpec, SectionsSpec};
pub use trapezoid::{Trapezoid, TrapezoidPart};

use crate::math::fourier::Terms;
use crate::math::jet::Jet;
use form::Form;

/// A dimensionless law of motion θ(τ), 0 ≤ τ ≤ 1, with θ(0) = 0, θ(1) = 1 and
/// θ′(0) = 0; θ′(1) = 0 too for the law of a stroke.
#[derive(Clone, Debug, PartialEq)]
pub struct Law {
    /// Joints, where the formula changes: strictly between 0 and 1, ascending.
    joints: Vec<f64>,
    /// Pieces, one more than joints.
    pieces: Vec<Piece>,
    /// True: it ends in uniform motion, not at rest.
    run_up: bool,
}

/// A formula with its place: θ = base + height·form((τ − origin)/span).
#[derive(Clone, Debug, PartialEq)]
struct Piece {
    form: Form,
    origin: f64,
    span: f64,
    base: f64,
    height: f64,
}

impl Piece {
    /// A formula that is a law as it stands.
    fn of_form(form: Form) -> Self {
        Self {
            form,
            origin: 0.0,
            span: 1.0,
            base: 0.0,
            height: 1.0,
        }
    }

    fn jet(&self, tau: f64) -> Jet {
        let jet = self.form.jet((tau - self.origin) / self.span);
        let rate = 1.0 / self.span;
        Jet {
            value: self.base + self.height * jet.value,
            first: self.height * rate * jet.first,
            second: self.height * rate * rate * jet.second,
            third: self.height * rate * rate * rate * jet.third,
        }
    }
}

impl Law {
    /// Joints, where the formula changes: strictly between 0 and 1, ascending.
    pub fn joints(&self) -> &[f64] {
        &self.joints
    }

    /// True: it ends in uniform motion; false: at rest.
    pub fn is_run_up(&self) -> bool {
        self.run_up
    }

    /// θ, θ′, θ″, θ‴ at `tau` by the formula of `piece` (0 before the first
    /// joint), also a little beyond the ends of the piece.
    pub fn jet(&self, piece: usize, tau: f64) -> Jet {
        self.pieces[piece].jet(tau)
    }

    /// θ and its derivatives at `tau`; at a joint those after it.
    pub fn at(&self, tau: f64) -> Jet {
        let piece = self.joints.partition_point(|&joint| joint <= tau);
        self.jet(piece, tau)
    }

    /// θ by the formula of `piece` in closed form, on the interval about `middle` of half the
    /// length `half`.
    pub(crate) fn terms(&self, piece: usize, [middle, half]: [f64; 2]) -> Terms {
        let own = &self.pieces[piece];
        let place = [(middle - own.origin) / own.span, half / own.span];
        own.form.terms(place).scaled(own.base, own.height)
    }

    /// Pieces with their ends, in order.
    pub fn pieces(&self) -> impl Iterator<Item = (usize, f64, f64)> + '_ {
        (0..self.pieces.len()).map(|piece| {
            let from = piece.checked_sub(1).map_or(0.0, |i| self.joints[i]);
            let to = self.joints.get(piece).copied().unwrap_or(1.0);
            (piece, from, to)
        })
    }

    /// What comes before τ = 0 and after τ = 1: rest, or uniform motion after a run-up.
    pub fn beyond(&self) -> (Jet, Jet) {
        let speed = if self.run_up { self.at(1.0).first } else { 0.0 };
        let after = Jet {
            value: 1.0,
            first: speed,
            ..Jet::default()
        };
        (Jet::default(), after)
    }
}
