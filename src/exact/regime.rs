//! Regimes: the combinations of engaged pairs a run has met, each with its
//! modes and the functionals in them, made when first met and kept.

use super::audit::Forms;
use super::basis::Basis;
use super::functional::{Functional, ORDERS, Weights};
use super::lanes::{Plain, V, WIDTH};
use super::law::LAW_DEGREE;
use super::panel::Panel;
use super::pencil::C;
use super::phase::Steady;
use super::problem::{PairState, Refusal, TreeMass, TreeObject, TreeProblem};
use super::sample::Strides;
use super::workspace::Workspace;

/// Regime: a combination of engaged pairs, ready for use.
#[derive(Clone, Debug)]
pub(crate) struct Regime {
    pub(super) key: Vec<PairState>,
    pub(crate) basis: Basis,
    pub(super) steady: Option<Steady>,
    pub(crate) weights: Vec<Weights>,
    /// For the energy audit.
    pub(super) forms: Option<Forms>,
    /// For the samples.
    pub(super) strides: Option<Strides>,
    /// Panels of every object: one, or one a flank while open.
    pub(super) panels: Vec<Vec<Panel>>,
}

/// Most combinations kept.
const REGIMES: usize = 256;

/// What they may take up together (bytes): one grows with the square of the masses.
const ROOM: usize = 256 << 20;

/// Combinations kept of those like the one with `basis`: as many as there is room for.
fn most(basis: &Basis, functionals: usize, audited: bool) -> usize {
    let vector = size_of::<V>();
    let lanes = basis.blocks * WIDTH;
    // Shape and row as vectors, then by lane the shape and three rows.
    let modes = basis.masses * (basis.blocks * 8 * vector + lanes * 4 * size_of::<C>());
    let weights = functionals * basis.blocks * ORDERS * 2 * vector;
    // Products of every two lanes: of the links, of the drive or the ground.
    let forms = usize::from(audited) * 2 * lanes * basis.blocks * 4 * vector;
    (ROOM / (modes + weights + forms).max(1)).clamp(1, REGIMES)
}

/// The functions of every pair: for flank f of mass i the clearance X at
/// `first[i] + 2f` and the pull c·X + b·Ẋ after it.
pub(crate) fn pair_functionals(problem: &TreeProblem) -> (Vec<Functional>, Vec<usize>) {
    let mut functionals = Vec::new();
    let mut first = Vec::new();
    for (i, mass) in problem.masses.iter().enumerate() {
        first.push(functionals.len());
        let (flanks, count) = mass.pair.flanks();
        for flank in &flanks[..count] {
            let linear = |c: f64, b: f64| {
                let s = flank.sign;
                let mut terms = vec![(i, [c * s, b * s, 0.0])];
                if let Some(p) = mass.parent {
                    terms.push((p, [-c * s * mass.lever, -b * s * mass.lever, 0.0]));
                }
                Functional {
                    terms,
                    law: [0.0; 3],
                    constant: c * flank.offset,
                }
            };
            functionals.push(linear(1.0, 0.0));
            functionals.push(match mass.restitution {
                Some(_) => held_pull(mass, i, flank.sign),
                None => linear(mass.stiffness, mass.damping),
            });
        }
    }
    (functionals, first)
}

/// The force away from its flank that acts on a mass which a rigid pair holds there:
/// sign·(W − J·φ̈ − springs), of constant loads W.
fn held_pull(mass: &TreeMass, i: usize, sign: f64) -> Functional {
    let mut load = [0.0; LAW_DEGREE + 1];
    for own in &mass.loads {
        own.add(0.0, 0.0, &mut None, &mut load);
    }
    let (spring, inertia) = (mass.ground_stiffness, mass.inertia);
    Functional {
        terms: vec![(i, [-sign * spring, 0.0, -sign * inertia])],
        law: [spring, 0.0, inertia].map(|factor| -sign * mass.ratio * factor),
        constant: sign * (load[0] - spring * mass.offset),
    }
}

/// The four functionals of every object in a regime: δ, φ̇, φ̈, and the link's
/// force (engaged) or the clearance to either flank (open).
fn panels(
    problem: &TreeProblem,
    functionals: &[Functional],
    first: &[usize],
    key: &[PairState],
    basis: &Basis,
) -> Vec<Vec<Panel>> {
    let make = |object: &TreeObject| {
        let mass = &problem.masses[object.first];
        let ratio = problem.masses[object.first].ratio;
        let output = |factors: [f64; 3]| -> Vec<(usize, [f64; 3])> {
            let shares = object.output.iter();
            let of = |&(mass, share): &(usize, f64)| (mass, factors.map(|factor| share * factor));
            shares.map(of).collect()
        };
        let moving = |order: usize| {
            let mut one = [0.0; 3];
            one[order] = 1.0;
            let law = one.map(|x| x * ratio);
            Functional {
                terms: output(one),
                law,
                constant: 0.0,
            }
        };
        let mut delta = Functional {
            terms: output([1.0, 0.0, 0.0]),
            ..moving(0)
        };
        delta.law = [0.0; 3];
        if let Some((driver, ratio)) = object.driver {
            delta.terms.push((driver, [-ratio, 0.0, 0.0]));
        }
        let at = first[object.first];
        let fourth = match (mass.pair.flanks().1, key[object.first]) {
            (0, _) => {
                let [c, b] = [mass.stiffness, mass.damping];
                let mut terms = vec![(object.first, [c, b, 0.0])];
                if let Some(p) = mass.parent {
                    terms.push((p, [-c * mass.lever, -b * mass.lever, 0.0]));
                }
                vec![Functional {
                    terms,
                    ..Functional::default()
                }]
            }
            (_, PairState::Engaged(f)) => vec![functionals[at + 2 * usize::from(f) + 1].clone()],
            (count, _) => (0..count)
                .map(|f| functionals[at + 2 * f].clone())
                .collect(),
        };
        let panel =
            |last: Functional| Panel::new(basis, [delta.clone(), moving(1), moving(2), last]);
        fourth.into_iter().map(panel).collect()
    };
    problem.objects.iter().map(make).collect()
}

impl Workspace<'_> {
    /// Number of the regime for the present states, made when first met.
    #[inline(always)]
    pub(super) fn regime(&mut self) -> Result<usize, Refusal> {
        for (key, state) in self.key.iter_mut().zip(&self.states) {
            *key = if state.engaged() {
                *state
            } else {
                PairState::Free
            };
        }
        match self
            .regimes
            .iter()
            .position(|regime| regime.key == self.key)
        {
            Some(index) => Ok(index),
            None => self.make_regime(),
        }
    }

    #[inline(never)]
    pub(super) fn make_regime(&mut self) -> Result<usize, Refusal> {
        let known = self.modes.iter().find(|(states, _)| *states == self.key);
        let basis = match known {
            Some((_, basis)) => basis.clone(),
            None => Basis::new(self.problem, &self.key).map_err(|e| Refusal::new("", e.0))?,
        };
        if self.regimes.len() >= most(&basis, self.functionals.len(), self.ledger.is_some()) {
            self.regimes.clear();
        }
        let weights = self
            .functionals
            .iter()
            .map(|f| Weights::new(&basis, f))
            .collect();
        let steady = Steady::new(self.problem, &basis);
        let panels = if self.tracks.is_empty() {
            Vec::new()
        } else {
            panels(
                self.problem,
                self.functionals,
                self.first,
                &self.key,
                &basis,
            )
        };
        let still = steady.is_some();
        let forms =
            (self.ledger.is_some()).then(|| Forms::new(self.problem, &self.key, &basis, still));
        let strides = self.sampler.interval();
        let strides = strides.map(|interval| Strides::new::<Plain>(&basis, interval));
        self.regimes.push(Regime {
            key: self.key.clone(),
            basis,
            steady,
            weights,
            forms,
            strides,
            panels,
        });
        Ok(self.regimes.len() - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::tests::chain;

    #[test]
    fn kept_combinations_of_many_masses_fit_into_their_room() {
        let kept = |masses: usize, audited: bool| {
            let problem = chain(0.1, 1e7, masses, 10.0, |_, _| 10.0);
            let states = vec![PairState::Free; masses];
            let basis = Basis::new(&problem, &states).expect("modes");
            let most = most(&basis, 2, audited);
            // What the greatest parts of one take, counted on themselves.
            let rows = basis.shape.len() + basis.row.len();
            let lanes = basis.lanes.len() * 4 * masses * size_of::<C>();
            let forms = usize::from(audited) * basis.lanes.len().pow(2) * 4 * size_of::<f64>();
            let bytes = rows * 4 * size_of::<V>() + lanes + forms;
            assert!(most == 1 || most * bytes <= ROOM, "{masses} {most} {bytes}");
            most
        };
        assert_eq!(kept(2, true), REGIMES);
        assert_eq!(kept(20, true), REGIMES);
        let [small, great] = [kept(50, true), kept(100, true)];
        assert!(great < REGIMES && great < small, "{small} {great}");
        assert!(kept(100, false) > great);
    }
}
