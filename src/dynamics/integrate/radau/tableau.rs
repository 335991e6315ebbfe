//! Coefficients of the Radau IIA methods, worked out from their definition.
//!
//! The nodes are the zeros of P_s(x) − P_{s−1}(x), P Legendre's polynomials moved
//! to [0, 1]; the last is 1. A integrates the polynomials through the stages. Its
//! eigenvalues, one real and the others in pairs (s is odd), decouple the stages:
//! E. Hairer and G. Wanner, Solving Ordinary Differential Equations II (1996),
//! IV.5 and IV.8, and Stiff differential equations solved by Radau methods,
//! Journal of Computational and Applied Mathematics 111 (1999).

mod coefficients;

use coefficients::Coefficients;

/// A square matrix by columns: `m[j][i]` stands in row i and column j.
pub(super) type Matrix<const S: usize> = [[f64; S]; S];

/// A matrix times a vector.
#[inline(always)]
pub(super) fn times<const S: usize>(matrix: &Matrix<S>, vector: &[f64; S]) -> [f64; S] {
    let mut out = [0.0; S];
    for (column, &factor) in matrix.iter().zip(vector) {
        for (out, entry) in out.iter_mut().zip(column) {
            *out += entry * factor;
        }
    }
    out
}

/// The coefficients of a method of S stages, L = (S + 1)/2.
#[derive(Clone, Debug)]
pub(super) struct Tableau<const S: usize, const L: usize> {
    /// Nodes c, ascending.
    pub(super) nodes: [f64; S],
    /// 1/Π(c_j − c_k), k ≠ j.
    pub(super) weights: [f64; S],
    /// A.
    pub(super) once: Matrix<S>,
    /// A².
    pub(super) twice: Matrix<S>,
    /// Eigenvalues of A, the real one first, then those above the real axis.
    pub(super) eigenvalues: [[f64; 2]; L],
    /// T, whose columns are the real eigenvector, and the real and imaginary parts
    /// of the others: vectors from what they are in terms of these.
    pub(super) eigenvectors: Matrix<S>,
    /// T⁻¹.
    pub(super) inverse: Matrix<S>,
    /// A·T and A²·T.
    pub(super) once_eigenvectors: Matrix<S>,
    pub(super) twice_eigenvectors: Matrix<S>,
    /// Values at 0 of the basis polynomials of degree s − 1 through the nodes.
    pub(super) at_start: [f64; S],
    /// The continuous output.
    pub(super) output: Output<S>,
}

/// A signal over the step from the rates at its start and at the nodes:
/// s(θ) = s₀ + h·∫ṡ, in Bernstein form of degree S + 2.
#[derive(Clone, Debug)]
pub(super) struct Output<const S: usize> {
    /// Of h·(ṡ_j − ṡ₀) for every node: what each adds to the coefficients.
    pub(super) rates: Vec<[f64; S]>,
    /// Of h²·(s̈₀ − what the polynomial through the rates has there): a term that is
    /// zero at the nodes and has an integral of zero.
    pub(super) bend: Vec<f64>,
    /// The greatest of these.
    pub(super) greatest_bend: f64,
    /// The slope at the start that the polynomial through the rates has, of
    /// ṡ_j − ṡ₀, times h.
    pub(super) slope: [f64; S],
}

impl<const S: usize, const L: usize> Tableau<S, L> {
    pub(super) fn new() -> Self {
        let found = Coefficients::new(S);
        let mut eigenvalues = [[0.0; 2]; L];
        eigenvalues.copy_from_slice(&found.eigenvalues);
        Self {
            nodes: row(&found.nodes),
            weights: row(&found.weights),
            once: square(&found.once),
            twice: square(&found.twice),
            eigenvalues,
            eigenvectors: square(&found.eigenvectors),
            inverse: square(&found.inverse),
            once_eigenvectors: square(&found.once_eigenvectors),
            twice_eigenvectors: square(&found.twice_eigenvectors),
            at_start: row(&found.at_start),
            output: Output {
                rates: found.rates.iter().map(|rates| row(rates)).collect(),
                bend: found.bend,
                greatest_bend: found.greatest_bend,
                slope: row(&found.slope),
            },
        }
    }
}

fn row<const S: usize>(entries: &[f64]) -> [f64; S] {
    let mut out = [0.0; S];
    out.copy_from_slice(entries);
    out
}

fn square<const S: usize>(columns: &[Vec<f64>]) -> Matrix<S> {
    let mut out = [[0.0; S]; S];
    for (out, column) in out.iter_mut().zip(columns) {
        out.copy_from_slice(column);
    }
    out
}

#[cfg(test)]
mod tests;
