//! The polynomial part of the motion: the answer to constant loads, loads over
//! time and polynomial laws, and the rigid motion of floating parts.

use super::basis::Basis;
use super::basis::SLOW;
use super::law::Law;
use super::pencil::C;
use super::phase::Steady;
use super::phase::{POLY, Phase};
use super::problem::{TimeLoad, TreeMass, TreeProblem};

impl Steady {
    /// `None` when loads, law or resonance make the polynomial part change with time.
    pub(crate) fn new(problem: &TreeProblem, basis: &Basis) -> Option<Self> {
        let constant = |m: &TreeMass| m.loads.iter().all(|l| matches!(l, TimeLoad::Constant(_)));
        let grounded = |m: &TreeMass| m.ground_stiffness != 0.0 || m.ground_damping != 0.0;
        let law = match &problem.law {
            Law::Harmonic { mean, slope, .. } => {
                (*slope == 0.0 && *mean == 0.0) || !problem.masses.iter().any(grounded)
            }
            Law::Spans(_) => false,
        };
        if !law || basis.resonance.is_some() || !problem.masses.iter().all(constant) {
            return None;
        }
        let mut phase = Phase::new(problem, basis.blocks);
        let zero = vec![0.0; basis.masses];
        phase.force_polynomials(problem, basis);
        phase.clear();
        phase.elastic_polynomials(basis, f64::INFINITY);
        if phase.degree > 0 {
            // A part that drifts against its damper.
            return None;
        }
        let still = (0..basis.masses).map(|i| phase.poly[i * POLY]).collect();
        phase.clear();
        phase.rigid_polynomials(basis, &zero, &zero);
        let fall = basis
            .rigid
            .iter()
            .map(|part| {
                let i = part.shape.iter().position(|x| *x != 0.0).unwrap_or(0);
                phase.poly[i * POLY + 2] / part.shape[i]
            })
            .collect();
        (phase.degree <= 2).then_some(Self { still, fall })
    }
}

impl Phase {
    fn clear(&mut self) {
        self.poly.fill(0.0);
        self.degree = 0;
    }

    #[inline(always)]
    pub(super) fn steady_polynomials(
        &mut self,
        basis: &Basis,
        steady: &Steady,
        q: &[f64],
        v: &[f64],
    ) {
        let n = basis.masses;
        self.degree = if basis.rigid.is_empty() { 0 } else { 2 };
        for i in 0..n {
            self.poly[i * POLY..i * POLY + 3].copy_from_slice(&[steady.still[i], 0.0, 0.0]);
        }
        for (part, fall) in basis.rigid.iter().zip(&steady.fall) {
            let (mut place, mut speed) = (0.0, 0.0);
            for i in 0..n {
                place += part.row[i] * q[i];
                speed += part.row[i] * v[i];
            }
            for i in 0..n {
                let x = part.shape[i];
                self.poly[i * POLY] += x * place;
                self.poly[i * POLY + 1] += x * speed;
                self.poly[i * POLY + 2] += x * fall;
            }
        }
    }

    #[inline(never)]
    pub(super) fn moving_polynomials(
        &mut self,
        problem: &TreeProblem,
        basis: &Basis,
        q: &[f64],
        v: &[f64],
    ) {
        self.clear();
        self.reach = self.force_polynomials(problem, basis).min(basis.drift);
        self.elastic_polynomials(basis, self.reach);
        self.rigid_polynomials(basis, q, v);
    }

    /// Forces on the masses as polynomials of the local time (without
    /// harmonics); returns how long they hold.
    fn force_polynomials(&mut self, problem: &TreeProblem, basis: &Basis) -> f64 {
        let (start, law, degree) = (self.start, self.forcing.law, self.forcing.degree);
        let mut end = self.forcing.end;
        self.force.fill(0.0);
        let mut held = self.held.iter_mut();
        for (i, mass) in problem.masses.iter().enumerate() {
            let f = &mut self.force[i * POLY..(i + 1) * POLY];
            f[0] = basis.flank_force[i] - mass.ground_stiffness * mass.offset;
            for (load, held) in mass.loads.iter().zip(&mut held) {
                end = end.min(load.add(start, self.low, held, f));
            }
            for k in 0..=degree {
                let (first, second) = ((k + 1) as f64, ((k + 1) * (k + 2)) as f64);
                let speed = law.get(k + 1).map_or(0.0, |c| first * c);
                let acceleration = law.get(k + 2).map_or(0.0, |c| second * c);
                f[k] -= mass.ratio
                    * (mass.inertia * acceleration
                        + mass.ground_damping * speed
                        + mass.ground_stiffness * law[k]);
            }
        }
        ((end - start) - self.low).min(self.forcing.reach)
    }

    /// Adds to P_i what the elastic modes answer to the polynomial forces.
    ///
    /// A mode a with ȧ = λa + φ(s) has the polynomial solution
    /// y_j = ((j+1)y_{j+1} − φ_j)/λ, downwards; for a slow mode its terms grow
    /// before they cancel, and the solution with y(0) = 0,
    /// y_{j+1} = (λy_j + φ_j)/(j+1), a convergent series, takes its place.
    fn elastic_polynomials(&mut self, basis: &Basis, length: f64) {
        let n = basis.masses;
        let top = (0..n)
            .filter_map(|i| {
                self.force[i * POLY..(i + 1) * POLY]
                    .iter()
                    .rposition(|c| *c != 0.0)
            })
            .max()
            .unwrap_or(0);
        for lane in &basis.lanes {
            let mut y = [C::new(0.0, 0.0); POLY];
            let force = |k: usize| -> C {
                (0..n)
                    .map(|i| lane.row_f[i] * self.force[i * POLY + k])
                    .sum()
            };
            if lane.row_f.iter().all(|r| r.re == 0.0 && r.im == 0.0) {
                continue;
            }
            let slow = lane.lambda.norm() * length < SLOW || lane.lambda.norm() == 0.0;
            let last = if !slow {
                for k in (0..=top).rev() {
                    let next = if k < top {
                        y[k + 1] * (k + 1) as f64
                    } else {
                        C::default()
                    };
                    y[k] = (next - force(k)) / lane.lambda;
                }
                top
            } else {
                let last = if lane.lambda.norm() == 0.0 {
                    top + 1
                } else {
                    POLY - 1
                };
                for k in 0..last {
                    let push = if k <= top { force(k) } else { C::default() };
                    y[k + 1] = (lane.lambda * y[k] + push) / (k + 1) as f64;
                }
                last
            };
            self.degree = self.degree.max(last);
            for i in 0..n {
                for (sum, y) in self.poly[i * POLY..].iter_mut().zip(&y[..=last]) {
                    *sum += (lane.shape[i] * y).re;
                }
            }
        }
    }

    /// Adds the rigid motion of floating parts: η̈ = φ(s) from η, η̇ now.
    fn rigid_polynomials(&mut self, basis: &Basis, q: &[f64], v: &[f64]) {
        let n = basis.masses;
        for part in &basis.rigid {
            let mut eta = [0.0; POLY];
            for i in 0..n {
                eta[0] += part.row[i] * q[i];
                eta[1] += part.row[i] * v[i];
                for k in 0..POLY - 2 {
                    eta[k + 2] += part.row_f[i] * self.force[i * POLY + k]
                        / ((k + 1) as f64 * (k + 2) as f64);
                }
            }
            let last = eta.iter().rposition(|c| *c != 0.0).unwrap_or(0).max(2);
            self.degree = self.degree.max(last);
            for i in 0..n {
                for (sum, eta) in self.poly[i * POLY..].iter_mut().zip(&eta[..=last]) {
                    *sum += part.shape[i] * eta;
                }
            }
        }
    }
}
