//! A run taken phase by phase, so that several trees can be followed side by side.

use super::basis::{Basis, LaneKind};
#[cfg(target_arch = "x86_64")]
use super::lanes::Fused;
use super::lanes::{Plain, WIDTH};
use super::pencil::C;
use super::phase::POLY;
use super::problem::{PairState, Refusal};
use super::request::{ExactSwitch, Request};
use super::run::Passed;
use super::workspace::Workspace;
use super::{ExactTree, Law};

/// Highest number of derivatives that [`Cursor::derivatives`] gives, the
/// displacement itself included.
pub const MOST_ORDERS: usize = 8;

/// Radians of a harmonic that [`Cursor::pace`] allows.
const RADIANS: f64 = 0.5;

/// A mode that has died away to this share of the motion is no part of it any
/// more. (Its derivatives still might be: a thousand radians to a step make 10²¹
/// of them by the seventh.)
const NOTHING: f64 = 1e-17;

/// Degree up to which a polynomial part needs no shorter steps.
const PLAIN_DEGREE: usize = 2 * MOST_ORDERS - 1;

/// A run of a tree, standing at the end of its present phase.
///
/// Over a phase the motion is known in closed form and can be evaluated
/// anywhere, with its derivatives.
pub struct Cursor<'a> {
    work: Workspace<'a>,
    end: f64,
    passed: Option<Passed>,
    /// Greatest share of every lane in the motion of a mass at the start of the
    /// present phase.
    shares: Vec<f64>,
    /// States of the pairs over the present phase.
    states: Vec<PairState>,
    /// Switches taken before the present phase ended.
    before: usize,
}

impl<'a> Cursor<'a> {
    /// A run of `tree` to `end` (s), before its first phase.
    ///
    /// # Errors
    /// The state at t = 0 has no answer; see [`Refusal`].
    pub fn new(tree: &'a ExactTree, end: f64) -> Result<Self, Refusal> {
        let request = Request::new(end, 0);
        let work = Workspace::new(&tree.problem, &tree.functionals, &tree.first, &request)?;
        Ok(Self {
            states: work.states.clone(),
            work,
            end,
            passed: None,
            shares: Vec::new(),
            before: 0,
        })
    }

    /// Goes through the next phase; false when the end has been reached.
    ///
    /// # Errors
    /// Modes that cannot be separated, numbers that are no longer finite.
    pub fn advance(&mut self) -> Result<bool, Refusal> {
        if self.work.reached(self.end) {
            return Ok(false);
        }
        self.states.copy_from_slice(&self.work.states);
        self.before = self.work.out.switches.len();
        let passed = self.forward()?;
        self.passed = Some(passed);
        self.take_shares(passed.regime);
        self.work.settle(&passed)?;
        Ok(true)
    }

    fn forward(&mut self) -> Result<Passed, Refusal> {
        #[cfg(target_arch = "x86_64")]
        if std::is_x86_feature_detected!("avx2") && std::is_x86_feature_detected!("fma") {
            // SAFETY: the processor has the features the function is compiled for.
            #[allow(unsafe_code)]
            return unsafe { forward_fused(&mut self.work, self.end) };
        }
        self.work.forward::<Plain>(self.end)
    }

    /// Start of the present phase (s), as a number and what it lacks.
    pub fn start(&self) -> (f64, f64) {
        (self.work.phase.start, self.work.phase.low)
    }

    /// Length of the present phase (s).
    pub fn length(&self) -> f64 {
        self.passed.map_or(0.0, |passed| passed.length)
    }

    /// End of the present phase (s); t = 0 before the first.
    pub fn time(&self) -> f64 {
        self.work.at.0
    }

    /// Local time of the instant `time` (s) in the present phase.
    pub fn local(&self, time: f64) -> f64 {
        self.work.phase.local(time)
    }

    /// States of the pairs over the present phase, by mass.
    pub fn states(&self) -> &[PairState] {
        &self.states
    }

    /// States of the pairs from the end of the present phase on, by mass.
    pub fn states_after(&self) -> &[PairState] {
        &self.work.states
    }

    /// The switch that ended the present phase.
    pub fn switch(&self) -> Option<&ExactSwitch> {
        self.work.out.switches.get(self.before)
    }

    /// Phases gone through, and evaluations in the search.
    pub fn counts(&self) -> (u64, u64) {
        (self.work.out.phases, self.work.search.evaluations)
    }

    /// Longest time (s) over which what drives the present phase (harmonics,
    /// spans of the law, polynomials) changes so little that a polynomial of
    /// degree 15 follows it; +∞ when nothing changes.
    pub(super) fn pace(&self) -> f64 {
        let phase = &self.work.phase;
        let mut longest = match &self.work.problem.law {
            Law::Harmonic { sines, .. } => {
                let fastest = sines.iter().map(|sine| sine.frequency);
                RADIANS / fastest.fold(0.0, f64::max)
            }
            Law::Spans(_) => phase
                .span
                .map_or(f64::INFINITY, |span| (span.end - span.start) / 3.0),
        };
        if phase.degree > PLAIN_DEGREE {
            longest = longest.min(phase.reach / 3.0);
        }
        longest
    }

    /// q of every mass and its derivatives at local time `s` of the present
    /// phase: `out[mass·orders + k]` is the k-th derivative, k < `orders` ≤
    /// [`MOST_ORDERS`].
    pub fn derivatives(&self, s: f64, orders: usize, out: &mut [f64]) {
        let Some(passed) = self.passed else {
            return;
        };
        let basis = &self.work.regimes[passed.regime].basis;
        let phase = &self.work.phase;
        let (masses, blocks) = (basis.masses, basis.blocks);
        self.polynomials(s, orders, out);
        for lane in 0..basis.lanes.len() {
            if self.decay(basis, lane, s).is_none() {
                continue;
            }
            let (b, l) = (lane / WIDTH, lane % WIDTH);
            let lambda = C::new(basis.re[b].0[l], basis.im[b].0[l]);
            let amplitude = C::new(phase.re[b].0[l], phase.im[b].0[l]);
            let mut w = amplitude * (lambda * s).exp();
            for order in 0..orders {
                for mass in 0..masses {
                    let at = mass * blocks + b;
                    let (re, im) = (basis.shape[at][0].0[l], basis.shape[at][1].0[l]);
                    out[mass * orders + order] += re * w.re - im * w.im;
                }
                w *= lambda;
            }
        }
        for flight in &phase.flights {
            let drive = C::new(0.0, flight.omega);
            let eta = flight_derivatives(flight.amplitude, drive, s, orders);
            for mass in 0..masses {
                let shape = basis.rigid[flight.rigid].shape[mass];
                for (order, eta) in eta[..orders].iter().enumerate() {
                    out[mass * orders + order] += shape * eta;
                }
            }
        }
    }

    /// Sets `out` to the polynomial part: Taylor's coefficients at s by
    /// repeated synthetic division, times k!.
    fn polynomials(&self, s: f64, orders: usize, out: &mut [f64]) {
        let phase = &self.work.phase;
        let degree = phase.degree;
        let mut work = [0.0; POLY];
        for (mass, out) in out.chunks_exact_mut(orders).enumerate() {
            work[..=degree].copy_from_slice(&phase.poly[mass * POLY..=mass * POLY + degree]);
            let mut factorial = 1.0;
            for (order, out) in out.iter_mut().enumerate() {
                for k in (order..degree).rev() {
                    work[k] += s * work[k + 1];
                }
                factorial *= order.max(1) as f64;
                *out = if order <= degree {
                    factorial * work[order]
                } else {
                    0.0
                };
            }
        }
    }

    /// Calls `see` with |λ| and the size of the motion of every lane that is
    /// in the motion at local time `s`: the greatest over the masses of
    /// |shape·amplitude·e^{λs}|.
    pub(super) fn lanes(&self, s: f64, mut see: impl FnMut(f64, f64)) {
        let Some(passed) = self.passed else {
            return;
        };
        let basis = &self.work.regimes[passed.regime].basis;
        let phase = &self.work.phase;
        for (lane, &modulus) in basis.modulus.iter().enumerate().take(basis.lanes.len()) {
            if let Some(decay) = self.decay(basis, lane, s) {
                let (b, l) = (lane / WIDTH, lane % WIDTH);
                let amplitude = phase.re[b].0[l].hypot(phase.im[b].0[l]);
                see(modulus, amplitude * basis.extent[b].0[l].sqrt() * decay);
            }
        }
    }

    /// What is left of a lane at local time `s`; `None` for a mode that is
    /// nothing, from then on to the end of the phase.
    fn decay(&self, basis: &Basis, lane: usize, s: f64) -> Option<f64> {
        let decay = (basis.re[lane / WIDTH].0[lane % WIDTH] * s).exp();
        let mode = basis.lanes[lane].kind == LaneKind::Mode;
        (!mode || self.shares[lane] * decay > NOTHING).then_some(decay)
    }

    /// Takes the shares of the lanes in the phase that has just been gone through.
    fn take_shares(&mut self, regime: usize) {
        let basis = &self.work.regimes[regime].basis;
        let phase = &self.work.phase;
        let size = |mass: usize, lane: usize| {
            let (b, l) = (lane / WIDTH, lane % WIDTH);
            let [re, im, ..] = basis.shape[mass * basis.blocks + b];
            let shape = re.0[l].hypot(im.0[l]);
            shape * phase.re[b].0[l].hypot(phase.im[b].0[l])
        };
        let lanes = basis.lanes.len();
        self.shares.clear();
        self.shares.resize(lanes, 0.0);
        for mass in 0..basis.masses {
            let constant = phase.poly[mass * POLY].abs();
            let whole = (0..lanes).fold(constant, |most, lane| most.max(size(mass, lane)));
            for (lane, share) in self.shares.iter_mut().enumerate() {
                if whole > 0.0 {
                    *share = share.max(size(mass, lane) / whole);
                }
            }
        }
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn forward_fused(work: &mut Workspace<'_>, end: f64) -> Result<Passed, Refusal> {
    work.forward::<Fused>(end)
}

/// η = Re(a·(e^{iΩs} − 1 − iΩs)) and its derivatives.
fn flight_derivatives(a: C, drive: C, s: f64, orders: usize) -> [f64; MOST_ORDERS] {
    let x = drive.im * s;
    let (sin, cos) = x.sin_cos();
    let (less_one, less_x) = super::lanes::reduced_one::<Plain>(x, sin, cos);
    let mut out = [0.0; MOST_ORDERS];
    let mut factor = a;
    for (order, out) in out[..orders].iter_mut().enumerate() {
        let e = match order {
            0 => C::new(less_one, less_x),
            1 => C::new(less_one, sin),
            _ => C::new(cos, sin),
        };
        *out = (factor * e).re;
        factor *= drive;
    }
    out
}
