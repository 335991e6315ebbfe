//! Four functionals side by side, bounded over a step.
//!
//! For every object the figures need δ, φ̇, φ̈ and the force (or the clearance)
//! of its pair. The four ride in one vector; values and slopes at both ends of
//! a step of the switch search bound them between ([`super::hermite`]), which
//! says whether any can pass the greatest value met so far. Almost always none
//! can.

mod instant;
mod phase;

pub(crate) use instant::Amplitudes;
pub(crate) use phase::PanelPhase;

use super::basis::Basis;
use super::functional::Functional;
use super::lanes::{V, WIDTH};

/// A lane in the four functionals.
#[derive(Clone, Copy, Debug, Default)]
struct LaneFunctionals {
    /// Weight in value and slope: re, im each.
    weight: [V; 4],
    /// |weight|.
    size: V,
    /// |weight|·|λ|⁴.
    fourth: V,
}

/// A vector of lanes in one functional.
#[derive(Clone, Copy, Debug, Default)]
struct Own {
    /// Weight in the functional and three derivatives: re, im each.
    weight: [[V; 2]; 4],
    /// |weight|.
    size: V,
    /// |weight|·|λ|⁴.
    fourth: V,
}

/// The four functionals of an object in a basis.
#[derive(Clone, Debug)]
pub(crate) struct Panel {
    functionals: [Functional; WIDTH],
    /// Masses in the functionals with the factors of q, q̇, q̈.
    terms: Vec<(usize, [V; 3])>,
    /// Factors of the law and its first two derivatives.
    law: [V; 3],
    constant: V,
    /// By lane, filled up with nothing to whole vectors.
    lanes: Vec<[LaneFunctionals; WIDTH]>,
    /// By functional and vector of lanes.
    own: Vec<Own>,
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
        let mut lanes = vec![[LaneFunctionals::default(); WIDTH]; basis.blocks];
        let mut own = vec![Own::default(); WIDTH * basis.blocks];
        let mut primitive = vec![[V::ZERO; 2]; basis.blocks];
        let mut resting = Vec::new();
        for (k, lane) in basis.lanes.iter().enumerate() {
            let (b, i) = (k / WIDTH, k % WIDTH);
            let w = [0, 1, 2, 3].map(|f| functionals[f].weight(&basis.rigid, lane));
            let modulus = lane.lambda.norm_sqr();
            let size = w.map(|x| x.norm_sqr().sqrt());
            let slope = w.map(|x| x * lane.lambda);
            lanes[b][i] = LaneFunctionals {
                weight: [
                    w.map(|x| x.re),
                    w.map(|x| x.im),
                    slope.map(|x| x.re),
                    slope.map(|x| x.im),
                ]
                .map(V),
                size: V(size),
                fourth: V(size.map(|x| x * (modulus * modulus))),
            };
            for f in 0..WIDTH {
                let mut weight = w[f];
                let own = &mut own[f * basis.blocks + b];
                for order in &mut own.weight {
                    order[0].0[i] = weight.re;
                    order[1].0[i] = weight.im;
                    weight *= lane.lambda;
                }
                own.size.0[i] = size[f];
                own.fourth.0[i] = lanes[b][i].fourth.0[f];
            }
            if modulus == 0.0 {
                resting.push(k);
            } else {
                let own = w[0] / lane.lambda;
                primitive[b][0].0[i] = own.re;
                primitive[b][1].0[i] = own.im;
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
        let terms = functionals.iter().map(|functional| functional.terms.len());
        let mut masses: Vec<usize> = Vec::with_capacity(terms.sum());
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
            lanes,
            own,
            primitive,
            resting,
            rigid,
        }
    }
}

impl Panel {
    /// |weight| of lane k in functional f.
    pub(crate) fn lane_weight(&self, f: usize, k: usize) -> f64 {
        self.lane_functionals(k).size.0[f]
    }

    #[inline(always)]
    fn lane_functionals(&self, k: usize) -> &LaneFunctionals {
        &self.lanes[k / WIDTH][k % WIDTH]
    }
}
