//! A phase: the motion between two switches in closed form.
//!
//! Every mass moves as q_i(s) = Σ Re(shape·z·e^{λs}) + P_i(s) + flight, s the
//! time since the phase began. Lanes of exponentials (modes and harmonics), a
//! polynomial (constant loads, polynomial laws, the rigid motion of floating
//! parts), and the rigid motion of floating parts under harmonics, which is
//! kept in the forms cos x − 1 and sin x − x because it would cancel otherwise.
//!
//! Amplitudes are those at the start of the phase and e^{λs} is evaluated with
//! the local s; the start is a double-double.

use super::basis::Basis;
use super::lanes::{Arith, Task, V, WIDTH, exp, reduced_one, sin_cos, sin_cos_one};
use super::law::{Forcing, PolynomialSpan};
use super::pencil::C;
use super::problem::{ForcePiece, TreeProblem};

/// Room for the coefficients of a polynomial part.
pub(crate) const POLY: usize = 32;

/// Rigid motion of a floating part under a harmonic.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Flight {
    /// Index of the floating part.
    pub(crate) rigid: usize,
    /// Index of the harmonic.
    pub(crate) harmonic: usize,
    /// Ω.
    pub(crate) omega: f64,
    /// η = Re(amplitude·(e^{iΩs} − 1 − iΩs)).
    pub(crate) amplitude: C,
}

/// A harmonic at one instant, as flights need it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Swing {
    pub(crate) sin: f64,
    pub(crate) cos: f64,
    /// cos Ωs − 1.
    pub(crate) less_one: f64,
    /// sin Ωs − Ωs.
    pub(crate) less_x: f64,
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
    /// Real and imaginary part of a phase's amplitudes times e^{λs}, where its state was asked for.
    turned: Vec<[V; 2]>,
    /// The harmonics, while parts float.
    pub(crate) swings: Vec<Swing>,
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
    pub(super) span: Option<PolynomialSpan>,
    /// Forces on the masses as polynomials.
    pub(super) force: Vec<f64>,
    /// Pieces in force of all loads, mass by mass.
    pub(super) held: Vec<Option<ForcePiece>>,
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
            held: vec![None; problem.masses.iter().map(|mass| mass.loads.len()).sum()],
        }
    }

    /// Starts a phase at `start` + `low` from q, q̇.
    #[inline(always)]
    pub(crate) fn begin_phase<A: Arith>(
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
            .start::<A>(at.0, at.1, &mut self.span, &mut self.forcing);
        if let Some(resonance) = &basis.resonance {
            resonance.make_polynomials(&mut self.forcing);
        }
        self.reach = f64::INFINITY;
        match steady {
            Some(steady) => self.steady_polynomials(basis, steady, q, v),
            None => self.moving_polynomials(problem, basis, q, v),
        }
        for &(mass, place) in &basis.held {
            self.poly[mass * POLY] = place;
        }
        self.reach = self.reach.min(basis.longest);
        self.take_flights(basis);
        self.project::<A>(basis, q, v);
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
                    harmonic: j,
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
                let shape = &basis.shape[at];
                q[i] -= shape[0].0[lane] * z.re - shape[1].0[lane] * z.im;
                v[i] -= shape[2].0[lane] * z.re - shape[3].0[lane] * z.im;
            }
        }
        for b in 0..blocks {
            let (mut re, mut im) = (V::ZERO, V::ZERO);
            for i in 0..n {
                let row = &basis.row[i * blocks + b];
                let (x, y) = (V::splat(q[i]), V::splat(v[i]));
                re = row[0].fma::<A>(x, row[2].fma::<A>(y, re));
                im = row[1].fma::<A>(x, row[3].fma::<A>(y, im));
            }
            self.re[b] = re;
            self.im[b] = im;
        }
        // Rows of harmonics are zero; one number stored into a vector would hold up
        // whoever reads the vector next.
        for (&(b, unit), z) in basis.unit.iter().zip(&self.forcing.harmonics) {
            self.re[b] = unit.fma::<A>(V::splat(z.re), self.re[b]);
            self.im[b] = unit.fma::<A>(V::splat(z.im), self.im[b]);
        }
    }

    /// Evaluates e^{λs} of the active lanes.
    #[inline(always)]
    pub(crate) fn exponentials<A: Arith>(&self, basis: &Basis, s: f64, out: &mut Exponentials) {
        A::run_out_of_line(Evaluate {
            phase: self,
            basis,
            s,
            out,
        });
    }

    /// Sets the harmonics of `e` from their lanes.
    #[inline(always)]
    pub(crate) fn swing<A: Arith>(&self, basis: &Basis, e: &mut Exponentials) {
        for (swing, &k) in e.swings.iter_mut().zip(&basis.harmonic) {
            let (b, i) = (k / WIDTH, k % WIDTH);
            let x = basis.im[b].0[i] * e.s;
            let (sin, cos) = if b < self.active {
                (e.im[b].0[i], e.re[b].0[i])
            } else {
                sin_cos_one::<A>(x)
            };
            let (less_one, less_x) = reduced_one::<A>(x, sin, cos);
            *swing = Swing {
                sin,
                cos,
                less_one,
                less_x,
            };
        }
    }

    /// q and q̇ of all masses at the instant of `e`.
    #[inline(always)]
    pub(crate) fn state<A: Arith>(
        &self,
        basis: &Basis,
        e: &mut Exponentials,
        q: &mut [f64],
        v: &mut [f64],
    ) {
        let (n, blocks, active) = (basis.masses, basis.blocks, self.active);
        let (ar, ai) = (&self.re[..active], &self.im[..active]);
        let (er, ei) = (&e.re[..active], &e.im[..active]);
        let turned = &mut e.turned[..active];
        for b in 0..active {
            turned[b] = [ar[b] * er[b] - ai[b] * ei[b], ar[b] * ei[b] + ai[b] * er[b]];
        }
        for i in 0..n {
            let (mut place, mut speed) = (V::ZERO, V::ZERO);
            let shapes = &basis.shape[i * blocks..][..active];
            for (shape, &[re, im]) in shapes.iter().zip(&*turned) {
                place = shape[0].fma::<A>(re, place) - shape[1] * im;
                speed = shape[2].fma::<A>(re, speed) - shape[3] * im;
            }
            let (p, dp) = self.polynomial::<A>(i, e.s);
            q[i] = place.sum() + p;
            v[i] = speed.sum() + dp;
        }
        for flight in &self.flights {
            let swing = &e.swings[flight.harmonic];
            let a = flight.amplitude;
            let eta = a.re * swing.less_one - a.im * swing.less_x;
            let rate = -flight.omega * (a.re * swing.sin + a.im * swing.less_one);
            for i in 0..n {
                q[i] += basis.rigid[flight.rigid].shape[i] * eta;
                v[i] += basis.rigid[flight.rigid].shape[i] * rate;
            }
        }
    }

    /// P_i and its rate.
    #[inline(always)]
    pub(crate) fn polynomial<A: Arith>(&self, i: usize, s: f64) -> (f64, f64) {
        let c = &self.poly[i * POLY..(i + 1) * POLY];
        if self.degree <= 2 {
            let value = A::fma(A::fma(c[2], s, c[1]), s, c[0]);
            return (value, A::fma(2.0 * c[2], s, c[1]));
        }
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

/// The exponentials of a phase at one instant. (Out of line: inlined where they
/// are needed, the many constants are fetched and put aside there.)
struct Evaluate<'a> {
    phase: &'a Phase,
    basis: &'a Basis,
    s: f64,
    out: &'a mut Exponentials,
}

impl Task for Evaluate<'_> {
    type Output = ();

    #[inline(always)]
    fn run<A: Arith>(self) {
        let Self {
            phase,
            basis,
            s,
            out,
        } = self;
        out.s = s;
        // Most often there is one vector: without a loop its constants are used
        // where they are, and not put aside for the next round.
        out.advance_vector::<A>(basis, 0);
        if phase.active > 1 {
            A::run_out_of_line(Others {
                basis,
                active: phase.active,
                out,
            });
        }
        if !phase.flights.is_empty() {
            phase.swing::<A>(basis, out);
        }
    }
}

/// The vectors behind the first.
struct Others<'a> {
    basis: &'a Basis,
    active: usize,
    out: &'a mut Exponentials,
}

impl Task for Others<'_> {
    type Output = ();

    #[inline(always)]
    fn run<A: Arith>(self) {
        for b in 1..self.active {
            self.out.advance_vector::<A>(self.basis, b);
        }
    }
}

impl Exponentials {
    /// Those of the start of a phase, of its first `active` vectors.
    #[inline(always)]
    pub(crate) fn start(&mut self, active: usize) {
        self.s = 0.0;
        self.swings.fill(Swing {
            cos: 1.0,
            ..Swing::default()
        });
        for b in 0..active {
            self.re[b] = V::splat(1.0);
            self.im[b] = V::ZERO;
            self.size[b] = V::splat(1.0);
        }
    }

    /// Vector b at the instant s.
    #[inline(always)]
    fn advance_vector<A: Arith>(&mut self, basis: &Basis, b: usize) {
        let time = V::splat(self.s);
        let size = exp::<A>(basis.re[b] * time);
        let (sin, cos) = sin_cos::<A>(basis.im[b] * time);
        self.size[b] = size;
        self.re[b] = size * cos;
        self.im[b] = size * sin;
    }

    pub(crate) fn new(blocks: usize, harmonics: usize) -> Self {
        Self {
            s: 0.0,
            re: vec![V::ZERO; blocks],
            im: vec![V::ZERO; blocks],
            size: vec![V::ZERO; blocks],
            turned: vec![[V::ZERO; 2]; blocks],
            swings: vec![Swing::default(); harmonics],
        }
    }
}

/// The response to forces that never change: P_i of a steady problem.
#[derive(Clone, Debug)]
pub(crate) struct Steady {
    /// Displacement of each mass by the constant loads (elastic part).
    pub(super) still: Vec<f64>,
    /// η̈/2 of each floating part.
    pub(super) fall: Vec<f64>,
}
