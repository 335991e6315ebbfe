//! Four functionals side by side, bounded over a step.
//!
//! For every object the figures need δ, φ̇, φ̈ and the force (or the clearance)
//! of its pair. The four ride in one vector; values and slopes at both ends of
//! a step of the switch search bound them between ([`super::hermite`]), which
//! says whether any can pass the greatest value met so far. Almost always none
//! can.

mod phase;

pub(crate) use phase::PanelPhase;

use super::basis::Basis;
use super::functional::Functional;
use super::lanes::{Arith, V, WIDTH};
use super::pencil::C;
use super::phase::{Exponentials, Phase};

/// The four functionals of an object in a basis.
#[derive(Clone, Debug)]
pub(crate) struct Panel {
    functionals: [Functional; WIDTH],
    /// Masses in the functionals with the factors of q, q̇, q̈.
    terms: Vec<(usize, [V; 3])>,
    /// Factors of the law and its first two derivatives.
    law: [V; 3],
    constant: V,
    /// Weights: lane-major, then order 0 … 3, then re, im.
    weights: Vec<V>,
    /// |weight|, and |weight|·|λ|⁴, by lane.
    sizes: Vec<[V; 2]>,
    /// Weight/λ of the first functional, its primitive, by block: re, im.
    primitive: Vec<[V; 2]>,
    /// Lanes with λ = 0, whose primitive grows with time.
    resting: Vec<usize>,
    /// Factors of η, η̇ of every floating part, and 1 where the speed is folded
    /// into the harmonic's lane.
    rigid: Vec<[V; 3]>,
}

impl Panel {
    pub(crate) fn new(basis: &Basis, functionals: [Functional; WIDTH]) -> Self {
        let mut weights = Vec::with_capacity(8 * basis.lanes.len());
        let mut sizes = Vec::new();
        let mut primitive = vec![[V::ZERO; 2]; basis.blocks];
        let mut resting = Vec::new();
        for (k, lane) in basis.lanes.iter().enumerate() {
            let w = [0, 1, 2, 3].map(|f| functionals[f].weight(&basis.rigid, lane));
            let mut power = C::new(1.0, 0.0);
            for _ in 0..4 {
                weights.push(V(w.map(|x| (x * power).re)));
                weights.push(V(w.map(|x| (x * power).im)));
                power *= lane.lambda;
            }
            let size = V(w.map(|x| x.norm()));
            sizes.push([size, size * V::splat(lane.lambda.norm().powi(4))]);
            if lane.lambda.norm() == 0.0 {
                resting.push(k);
            } else {
                let own = w[0] / lane.lambda;
                primitive[k / WIDTH][0].0[k % WIDTH] = own.re;
                primitive[k / WIDTH][1].0[k % WIDTH] = own.im;
            }
        }
        let rigid = basis
            .rigid
            .iter()
            .map(|part| {
                let f = [0, 1, 2, 3].map(|f| functionals[f].rigid(part));
                let folds = [0, 1, 2, 3].map(|f| f64::from(u8::from(functionals[f].folds())));
                [V(f.map(|x| x[0])), V(f.map(|x| x[1])), V(folds)]
            })
            .collect();
        let mut masses: Vec<usize> = Vec::new();
        for functional in &functionals {
            masses.extend(functional.terms.iter().map(|term| term.0));
        }
        masses.sort_unstable();
        masses.dedup();
        let factors = |mass: usize| {
            [0, 1, 2].map(|order| {
                V([0, 1, 2, 3].map(|f| {
                    let own = functionals[f].terms.iter().filter(|term| term.0 == mass);
                    own.map(|term| term.1[order]).sum()
                }))
            })
        };
        Self {
            terms: masses
                .into_iter()
                .map(|mass| (mass, factors(mass)))
                .collect(),
            law: [0, 1, 2].map(|order| V([0, 1, 2, 3].map(|f| functionals[f].law[order]))),
            constant: V([0, 1, 2, 3].map(|f| functionals[f].constant)),
            functionals,
            weights,
            sizes,
            primitive,
            resting,
            rigid,
        }
    }
}

impl Panel {
    /// Value and slope of lane k alone at the instant of `e`.
    #[inline(always)]
    pub(crate) fn lane<A: Arith>(&self, phase: &Phase, e: &Exponentials, k: usize) -> [V; 2] {
        let (b, i) = (k / WIDTH, k % WIDTH);
        let (zr, zi) = (phase.re[b].0[i], phase.im[b].0[i]);
        let (er, ei) = (e.re[b].0[i], e.im[b].0[i]);
        let (re, im) = (V::splat(zr * er - zi * ei), V::splat(-(zr * ei + zi * er)));
        let w = &self.weights[8 * k..8 * k + 4];
        [w[0].fma::<A>(re, w[1] * im), w[2].fma::<A>(re, w[3] * im)]
    }
}
