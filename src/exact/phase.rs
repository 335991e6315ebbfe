//! A phase: the motion between two switches in closed form.
//!
//! Every mass moves as q_i(s) = Σ Re(shape·z·e^{λs}) + P_i(s) + flight, s the
//! time since the phase began: lanes of exponentials (modes and harmonics), a
//! polynomial (constant loads, polynomial laws, the rigid motion of floating
//! parts), and the rigid motion of floating parts under harmonics, which is
//! kept in the forms cos x − 1 and sin x − x because it would cancel otherwise.
//!
//! Amplitudes are those at the start of the phase and e^{λs} is evaluated with
//! the local s; the start is a double-double.

use super::basis::Basis;
use super::lanes::{Arith, V, WIDTH, exp, reduced, sin_cos};
use super::law::{Forcing, PolynomialSpan};
use super::pencil::C;
use super::problem::TreeProblem;

/// Room for the coefficients of a polynomial part.
pub(crate) const POLY: usize = 32;

/// A mode with |λ|·(length of the span) below this gets its response to a
/// polynomial as a Taylor series, the others as a finite polynomial.
const SLOW: f64 = 3.0;

/// Rigid motion of a floating part under a harmonic.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Flight {
    /// Which floating part.
    pub(crate) rigid: usize,
    /// Ω.
    pub(crate) omega: f64,
    /// η = Re(amplitude·(e^{iΩs} − 1 − iΩs)).
    pub(crate) amplitude: C,
}

/// e^{λs} of all lanes at one instant.
#[derive(Clone, Debug, Default)]
pub(crate) struct Exponentials {
    pub(crate) s: f64,
    /// Real part.
    pub(crate) re: Vec<V>,
    /// Imaginary part.
    pub(crate) im: Vec<V>,
    /// |e^{λs}|.
    pub(crate) size: Vec<V>,
}

/// The motion between two switches.
#[derive(Clone, Debug)]
pub(crate) struct Phase {
    /// Start (s), high part.
    pub(crate) start: f64,
    /// Start, low part.
    pub(crate) low: f64,
    /// Longest validity (s of local time): end of the span, or of accuracy.
    pub(crate) reach: f64,
    /// Amplitudes at the start.
    pub(crate) re: Vec<V>,
    pub(crate) im: Vec<V>,
    /// Number of vectors that still matter.
    pub(crate) active: usize,
    /// P_i, `POLY` coefficients a mass.
    pub(crate) poly: Vec<f64>,
    /// Greatest power in use.
    pub(crate) degree: usize,
    pub(crate) flights: Vec<Flight>,
    pub(crate) forcing: Forcing,
    span: Option<PolynomialSpan>,
    /// Forces on the masses as polynomials.
    force: Vec<f64>,
}

/// The response to forces that never change: P_i of a steady problem.
#[derive(Clone, Debug)]
pub(crate) struct Steady {
    /// Displacement of each mass by the constant loads (elastic part).
    still: Vec<f64>,
    /// η̈/2 of each floating part.
    fall: Vec<f64>,
}

impl Steady {
    /// `None` when loads or law make the polynomial part change with time.
    pub(crate) fn new(problem: &TreeProblem, basis: &Basis) -> Option<Self> {
        use super::law::Law;
        use super::problem::TimeLoad;
        let constant = |m: &super::problem::TreeMass| {
            m.loads.iter().all(|l| matches!(l, TimeLoad::Constant(_)))
        };
        let grounded =
            |m: &super::problem::TreeMass| m.ground_stiffness != 0.0 || m.ground_damping != 0.0;
        let law = match &problem.law {
            Law::Harmonic { mean, slope, .. } => {
                (*slope == 0.0 && *mean == 0.0) || !problem.masses.iter().any(grounded)
            }
            Law::Spans(_) => false,
        };
        if !law || !problem.masses.iter().all(constant) {
            return None;
        }
        let mut phase = Phase::new(problem, basis.blocks);
        let zero = vec![0.0; basis.masses];
        phase.forces(problem, basis);
        phase.clear();
        phase.elastic_polynomials(basis, f64::INFINITY);
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
    /// Room for a problem whose bases need at most `blocks` vectors.
    pub(crate) fn new(problem: &TreeProblem, blocks: usize) -> Self {
        let n = problem.masses.len();
        Self {
            start: 0.0,
            low: 0.0,
            reach: f64::INFINITY,
            re: vec![V::ZERO; blocks],
            im: vec![V::ZERO; blocks],
            active: blocks,
            poly: vec![0.0; n * POLY],
            degree: 0,
            flights: Vec::with_capacity(n * problem.law.frequencies().len()),
            forcing: problem.law.forcing(),
            span: None,
            force: vec![0.0; n * POLY],
        }
    }

    fn clear(&mut self) {
        self.poly.fill(0.0);
        self.degree = 0;
    }

    /// Starts a phase at `start` + `low` from q, q̇.
    #[inline(always)]
    pub(crate) fn begin<A: Arith>(
        &mut self,
        problem: &TreeProblem,
        basis: &Basis,
        steady: Option<&Steady>,
        at: (f64, f64),
        q: &mut [f64],
        v: &mut [f64],
    ) {
        (self.start, self.low) = at;
        problem
            .law
            .start(at.0, at.1, &mut self.span, &mut self.forcing);
        self.reach = f64::INFINITY;
        match steady {
            Some(steady) => self.steady_polynomials(basis, steady, q, v),
            None => self.moving_polynomials(problem, basis, q, v),
        }
        self.reach = self.reach.min(basis.longest);
        self.take_flights(basis);
        self.project::<A>(basis, q, v);
    }

    #[inline(always)]
    fn steady_polynomials(&mut self, basis: &Basis, steady: &Steady, q: &[f64], v: &[f64]) {
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
    fn moving_polynomials(&mut self, problem: &TreeProblem, basis: &Basis, q: &[f64], v: &[f64]) {
        self.clear();
        self.reach = self.forces(problem, basis);
        self.elastic_polynomials(basis, self.reach);
        self.rigid_polynomials(basis, q, v);
    }

    /// Forces on the masses as polynomials of the local time (without
    /// harmonics); returns how long they hold.
    fn forces(&mut self, problem: &TreeProblem, basis: &Basis) -> f64 {
        let (start, law, degree) = (self.start, self.forcing.law, self.forcing.degree);
        let mut end = self.forcing.end;
        self.force.fill(0.0);
        for (i, mass) in problem.masses.iter().enumerate() {
            let f = &mut self.force[i * POLY..(i + 1) * POLY];
            f[0] = basis.flank_force[i] - mass.ground_stiffness * mass.offset;
            for load in &mass.loads {
                let (value, slope, next) = load.at(start);
                f[0] += value;
                f[1] += slope;
                end = end.min(next);
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
        (end - start) - self.low
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

    #[inline(always)]
    fn take_flights(&mut self, basis: &Basis) {
        self.flights.clear();
        for (index, part) in basis.rigid.iter().enumerate() {
            for (j, &lane) in basis.harmonic.iter().enumerate() {
                let omega = basis.lanes[lane].lambda.im;
                let amplitude = -part.push[j] * self.forcing.harmonics[j] / (omega * omega);
                self.flights.push(Flight {
                    rigid: index,
                    omega,
                    amplitude,
                });
            }
        }
    }

    /// Amplitudes of the lanes from the state (which is overwritten).
    #[inline(always)]
    fn project<A: Arith>(&mut self, basis: &Basis, q: &mut [f64], v: &mut [f64]) {
        let (n, blocks) = (basis.masses, basis.blocks);
        self.active = blocks;
        for i in 0..n {
            q[i] -= self.poly[i * POLY];
            if self.degree > 0 {
                v[i] -= self.poly[i * POLY + 1];
            }
            for (j, &k) in basis.harmonic.iter().enumerate() {
                let (at, lane) = (i * blocks + k / WIDTH, k % WIDTH);
                let z = self.forcing.harmonics[j];
                q[i] -= basis.shape[0][at].0[lane] * z.re - basis.shape[1][at].0[lane] * z.im;
                v[i] -= basis.shape[2][at].0[lane] * z.re - basis.shape[3][at].0[lane] * z.im;
            }
        }
        for b in 0..blocks {
            let (mut re, mut im) = (V::ZERO, V::ZERO);
            for i in 0..n {
                let at = i * blocks + b;
                let (x, y) = (V::splat(q[i]), V::splat(v[i]));
                re = basis.row[0][at].fma::<A>(x, basis.row[2][at].fma::<A>(y, re));
                im = basis.row[1][at].fma::<A>(x, basis.row[3][at].fma::<A>(y, im));
            }
            self.re[b] = re;
            self.im[b] = im;
        }
        for (j, &k) in basis.harmonic.iter().enumerate() {
            self.re[k / WIDTH].0[k % WIDTH] = self.forcing.harmonics[j].re;
            self.im[k / WIDTH].0[k % WIDTH] = self.forcing.harmonics[j].im;
        }
    }

    /// Evaluates e^{λs} of the active lanes.
    #[inline(always)]
    pub(crate) fn exponentials<A: Arith>(&self, basis: &Basis, s: f64, out: &mut Exponentials) {
        out.s = s;
        let time = V::splat(s);
        for b in 0..self.active {
            let size = exp::<A>(basis.re[b] * time);
            let (sin, cos) = sin_cos::<A>(basis.im[b] * time);
            out.size[b] = size;
            out.re[b] = size * cos;
            out.im[b] = size * sin;
        }
    }

    /// q and q̇ of all masses at the instant of `e`.
    #[inline(always)]
    pub(crate) fn state<A: Arith>(
        &self,
        basis: &Basis,
        e: &Exponentials,
        q: &mut [f64],
        v: &mut [f64],
    ) {
        let (n, blocks) = (basis.masses, basis.blocks);
        for i in 0..n {
            let (mut place, mut speed) = (V::ZERO, V::ZERO);
            for b in 0..self.active {
                let at = i * blocks + b;
                let re = self.re[b] * e.re[b] - self.im[b] * e.im[b];
                let im = self.re[b] * e.im[b] + self.im[b] * e.re[b];
                place = basis.shape[0][at].fma::<A>(re, place) - basis.shape[1][at] * im;
                speed = basis.shape[2][at].fma::<A>(re, speed) - basis.shape[3][at] * im;
            }
            let (p, dp) = self.polynomial::<A>(i, e.s);
            q[i] = place.sum() + p;
            v[i] = speed.sum() + dp;
        }
        for flight in &self.flights {
            let x = flight.omega * e.s;
            let (sin, cos) = scalar_sin_cos::<A>(x);
            let (c, s) = reduced::<A>(x, sin, cos);
            let a = flight.amplitude;
            let eta = a.re * c - a.im * s;
            let rate = -flight.omega * (a.re * sin + a.im * c);
            for i in 0..n {
                q[i] += basis.rigid[flight.rigid].shape[i] * eta;
                v[i] += basis.rigid[flight.rigid].shape[i] * rate;
            }
        }
    }

    #[inline(always)]
    fn polynomial<A: Arith>(&self, i: usize, s: f64) -> (f64, f64) {
        let c = &self.poly[i * POLY..(i + 1) * POLY];
        let (mut value, mut slope) = (c[self.degree], 0.0);
        for k in (0..self.degree).rev() {
            slope = A::fma(slope, s, value);
            value = A::fma(value, s, c[k]);
        }
        (value, slope)
    }

    /// Start + s as a double-double.
    #[inline(always)]
    pub(crate) fn time(&self, s: f64) -> (f64, f64) {
        let sum = self.start + s;
        let part = sum - self.start;
        let error = (self.start - (sum - part)) + (s - part);
        let low = error + self.low;
        let high = sum + low;
        (high, low - (high - sum))
    }

    /// Local time of the instant `time`.
    #[inline(always)]
    pub(crate) fn local(&self, time: f64) -> f64 {
        (time - self.start) - self.low
    }
}

/// sin and cos of one number.
#[inline(always)]
pub(crate) fn scalar_sin_cos<A: Arith>(x: f64) -> (f64, f64) {
    let (s, c) = sin_cos::<A>(V::splat(x));
    (s.0[0], c.0[0])
}

impl Exponentials {
    /// Takes over the first `active` vectors of another.
    #[inline(always)]
    pub(crate) fn copy(&mut self, other: &Self, active: usize) {
        self.s = other.s;
        for b in 0..active {
            self.re[b] = other.re[b];
            self.im[b] = other.im[b];
            self.size[b] = other.size[b];
        }
    }

    pub(crate) fn new(blocks: usize) -> Self {
        Self {
            s: 0.0,
            re: vec![V::ZERO; blocks],
            im: vec![V::ZERO; blocks],
            size: vec![V::ZERO; blocks],
        }
    }
}
