//! Linear functionals of the motion: clearances, forces, deviations, accelerations.

use super::basis::{Basis, Lane, LaneKind, Rigid};
use super::lanes::{Arith, V, WIDTH};
use super::pencil::C;
use super::phase::{Exponentials, POLY, Phase};

/// g = Σ (a·q_i + b·q̇_i + c·q̈_i) + l·(L, L̇, L̈) + constant.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Functional {
    /// (mass, [a, b, c]).
    pub(crate) terms: Vec<(usize, [f64; 3])>,
    /// Factors of the law and its first two derivatives.
    pub(crate) law: [f64; 3],
    pub(crate) constant: f64,
}

impl Functional {
    /// Value at a state, of a functional without accelerations and law.
    #[inline(always)]
    pub(crate) fn value(&self, q: &[f64], v: &[f64]) -> f64 {
        let mut sum = self.constant;
        for &(i, [a, b, _]) in &self.terms {
            sum += a * q[i] + b * v[i];
        }
        sum
    }

    /// Rate of change at a state with the speeds `v`, of a functional of q alone.
    pub(crate) fn rate(&self, v: &[f64]) -> f64 {
        self.terms.iter().map(|&(i, [a, ..])| a * v[i]).sum()
    }

    /// Weight of a lane in g.
    ///
    /// Where a part floats, the law's own motion and the flight's cancel in φ̇
    /// and φ̈: what the flight has of e^{iΩs} itself is taken into the lane of
    /// the harmonic, so that they cancel here and not in every bound. (In φ̇
    /// only when the law is in it: small speeds of clearances need E₁ whole.)
    pub(crate) fn weight(&self, basis_rigid: &[Rigid], lane: &Lane) -> C {
        let factor = |[a, b, c]: [f64; 3]| lane.lambda * (lane.lambda * c + b) + a;
        let mut sum = C::default();
        if let LaneKind::Harmonic(j) = lane.kind {
            sum += factor(self.law);
            for part in basis_rigid {
                let [_, y, z] = self.rigid(part);
                sum += part.push[j] * z;
                if self.folds() {
                    sum += part.push[j] / lane.lambda * y;
                }
            }
        }
        for &(i, abc) in &self.terms {
            sum += lane.shape[i] * factor(abc);
        }
        sum
    }

    /// True when e^{iΩs} of the flight's speed rides in the harmonic's lane.
    pub(crate) fn folds(&self) -> bool {
        self.law[1] != 0.0
    }

    /// The polynomial part of g over a phase, `phase.degree` + 1 coefficients
    /// (as many as the law needs, and three at least); returns its degree.
    #[inline(always)]
    pub(crate) fn polynomial(&self, phase: &Phase, out: &mut [f64; POLY]) -> usize {
        let law = self.law != [0.0; 3];
        let degree = if law {
            phase.degree.max(phase.forcing.degree)
        } else {
            phase.degree
        };
        out[..=degree.max(2)].fill(0.0);
        if degree <= 2 {
            for &(i, abc) in &self.terms {
                let at = i * POLY;
                // What lies above `phase.degree` is zero up to the second power.
                accumulate_short(out, &phase.poly[at..at + 3], abc);
            }
            if law {
                let mut own = [0.0; 3];
                let count = phase.forcing.degree + 1;
                own[..count].copy_from_slice(&phase.forcing.law[..count]);
                accumulate_short(out, &own, self.law);
            }
            out[0] += self.constant;
            return degree;
        }
        for &(i, abc) in &self.terms {
            accumulate(out, &phase.poly[i * POLY..i * POLY + phase.degree + 1], abc);
        }
        if law {
            accumulate(out, &phase.forcing.law[..=phase.forcing.degree], self.law);
        }
        out[0] += self.constant;
        degree
    }

    /// Factors of a floating part's η, η̇, η̈.
    pub(crate) fn rigid(&self, part: &Rigid) -> [f64; 3] {
        self.terms.iter().fold([0.0; 3], |sum, &(i, abc)| {
            [0, 1, 2].map(|k| sum[k] + abc[k] * part.shape[i])
        })
    }
}

/// out += a·p + b·p′ + c·p″ for a polynomial of degree 2.
#[inline(always)]
fn accumulate_short(out: &mut [f64; POLY], p: &[f64], [a, b, c]: [f64; 3]) {
    let [p0, p1, p2] = [p[0], p[1], p[2]];
    out[0] += a * p0 + b * p1 + 2.0 * c * p2;
    out[1] += a * p1 + 2.0 * b * p2;
    out[2] += a * p2;
}

/// out += a·p + b·p′ + c·p″.
#[inline(always)]
fn accumulate(out: &mut [f64; POLY], p: &[f64], [a, b, c]: [f64; 3]) {
    for (k, x) in p.iter().enumerate() {
        out[k] += a * x;
    }
    for k in 1..p.len() {
        out[k - 1] += b * k as f64 * p[k];
    }
    for k in 2..p.len() {
        out[k - 2] += c * (k * (k - 1)) as f64 * p[k];
    }
}

/// Number of derivatives of a watched function that are followed, itself included.
pub(crate) const ORDERS: usize = 5;

/// A functional in a basis: weight of each lane in g and its derivatives.
#[derive(Clone, Debug)]
pub(crate) struct Weights {
    /// By vectors of lanes, then by order: re, im.
    pub(crate) w: Vec<[[V; 2]; ORDERS]>,
    /// Weight of each floating part's η, η̇ and η̈.
    pub(crate) rigid: Vec<[f64; 3]>,
}

/// A functional of displacements at one instant of a phase, and what of it
/// cannot be told from zero.
#[inline(always)]
pub(crate) fn value<A: Arith>(
    functional: &Functional,
    weights: &Weights,
    phase: &Phase,
    e: &Exponentials,
) -> (f64, f64) {
    let (mut sum, mut size) = (V::ZERO, V::ZERO);
    for b in 0..phase.active {
        let (zr, zi) = (phase.re[b], phase.im[b]);
        let re = zr.fma::<A>(e.re[b], -(zi * e.im[b]));
        let im = zr.fma::<A>(e.im[b], zi * e.re[b]);
        let [wr, wi] = weights.w[b][0];
        let (own, other) = (wr * re, wi * im);
        sum = sum + (own - other);
        size = size + own.map(f64::abs) + other.map(f64::abs);
    }
    let (mut value, mut scale) = (sum.sum() + functional.constant, functional.constant.abs());
    for &(i, [a, ..]) in &functional.terms {
        let (place, _) = phase.polynomial::<A>(i, e.s);
        value += a * place;
        scale += (a * phase.poly[i * POLY]).abs();
    }
    for flight in &phase.flights {
        let [x, y, _] = weights.rigid[flight.rigid];
        let drive = C::new(0.0, flight.omega);
        let swing = &e.swings[flight.harmonic];
        let (a, b) = (flight.amplitude * x, flight.amplitude * drive * y);
        value += (a.re + b.re) * swing.less_one - a.im * swing.less_x - b.im * swing.sin;
    }
    (value, 4.0 * f64::EPSILON * (scale + size.sum()))
}

impl Weights {
    pub(crate) fn new(basis: &Basis, functional: &Functional) -> Self {
        let mut w = vec![[[V::ZERO; 2]; ORDERS]; basis.blocks];
        for (k, lane) in basis.lanes.iter().enumerate() {
            let mut weight = functional.weight(&basis.rigid, lane);
            for [re, im] in &mut w[k / WIDTH] {
                re.0[k % WIDTH] = weight.re;
                im.0[k % WIDTH] = weight.im;
                weight *= lane.lambda;
            }
        }
        let rigid = basis
            .rigid
            .iter()
            .map(|part| functional.rigid(part))
            .collect();
        Self { w, rigid }
    }
}
