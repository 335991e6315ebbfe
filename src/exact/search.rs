//! The guaranteed search for the next switch within a phase.
//!
//! Each step advances by a length over which no watched signal has a root
//! (see [`super::bound`]); when one has exactly one root just ahead, it is
//! polished to rounding. Accepted steps and the certified root cover the phase:
//! no crossing is lost, however short. What cannot be decided, because the
//! signal is below its own rounding, is counted as grazing.
//!
//! Exponentials are moved from place to place instead of evaluating a function, several at
//! once. So the search has a form of its own, as have `hermite`, `bound` and `track::refine`,
//! and stands beside `math::roots`.

use super::basis::Basis;
use super::bound::{Assessment, Bracket, assess, root_correction};
use super::functional::ORDERS;
use super::lanes::{Arith, V, WIDTH};
use super::phase::{Exponentials, Phase};
use super::signal::{Share, Signal, Terms};

/// Finding of a step of the search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Step {
    /// Nothing up to the instant now evaluated.
    Free,
    /// The signal with this number (of those watched) falls through zero at
    /// the instant now evaluated.
    Root(usize),
    /// The horizon was reached.
    Reached,
    /// Numbers stopped being finite.
    NotFinite,
}

/// Is told of every step. (A trait and not a closure: closures cannot be forced
/// inline, and out of line they lose the processor's instructions.)
pub(crate) trait Witness {
    /// False when it need not be told.
    fn wants_steps(&self) -> bool;

    /// Nothing has switched between the local time `from` and the instant of `now`.
    fn note_step<A: Arith>(&mut self, from: f64, now: &Exponentials);
}

/// Working memory of the search.
#[derive(Clone, Debug)]
pub(crate) struct Search {
    pub(crate) e: Exponentials,
    pub(crate) terms: Terms,
    /// Steps taken.
    pub(crate) steps: u64,
    /// Evaluations of the exponentials.
    pub(crate) evaluations: u64,
    /// Exponentials in all of them together.
    pub(crate) exponentials: u64,
    /// Steps over which a signal could not be told from zero.
    pub(crate) grazing: u64,
}

impl Search {
    pub(crate) fn new(blocks: usize, harmonics: usize) -> Self {
        Self {
            e: Exponentials::new(blocks, harmonics),
            terms: Terms {
                lanes: vec![Share::default(); blocks],
                slow: [0.0; ORDERS],
            },
            steps: 0,
            evaluations: 0,
            exponentials: 0,
            grazing: 0,
        }
    }

    /// Puts the search at the start of a phase.
    #[inline(always)]
    pub(crate) fn restart(&mut self, phase: &Phase) {
        self.e.start(phase.active);
    }

    #[inline(always)]
    pub(crate) fn evaluate<A: Arith>(&mut self, basis: &Basis, phase: &Phase, s: f64) {
        phase.exponentials::<A>(basis, s, &mut self.e);
        self.evaluations += 1;
        self.exponentials += (phase.active * WIDTH) as u64;
    }

    /// One step towards `horizon`, of which the witness is told.
    #[inline(always)]
    pub(crate) fn step<A: Arith>(
        &mut self,
        basis: &Basis,
        phase: &Phase,
        signals: &mut [Signal],
        watched: &[usize],
        horizon: f64,
        witness: &mut impl Witness,
    ) -> Step {
        let s = self.e.s;
        let left = horizon - s;
        if left <= 0.0 {
            return Step::Reached;
        }
        let fastest = basis.modulus.last().copied().unwrap_or(0.0);
        let mut length = left;
        let mut second = left;
        let mut root: Option<(usize, Bracket)> = None;
        for (number, &index) in watched.iter().enumerate() {
            let signal = &mut signals[index];
            let seen = assess::<A>(basis, phase.active, signal, &self.e, &mut self.terms, left);
            if !seen.jet[0].is_finite() || !seen.remainder.is_finite() {
                return Step::NotFinite;
            }
            if crossed(signal, &seen, s, fastest) {
                return Step::Root(number);
            }
            let free = self.cleared(signal, &seen, left);
            if let Some(bracket) = seen.root
                && root.is_none_or(|(_, other)| bracket.guess < other.guess)
            {
                root = Some((number, bracket));
                second = least_of_two(second, length);
            } else {
                second = least_of_two(second, free);
            }
            length = least_of_two(length, free);
        }
        self.steps += 1;
        let looks = witness.wants_steps();
        if let Some((number, bracket)) = root
            && (second >= bracket.high || second >= left)
            && !(s == 0.0 && signals[watched[number]].passing)
        {
            let signal = &signals[watched[number]];
            let step = self.refine_root::<A>(basis, phase, signal, bracket, left, number);
            if looks {
                witness.note_step::<A>(s, &self.e);
            }
            return step;
        }
        let target = if length >= left { horizon } else { s + length };
        self.evaluate::<A>(basis, phase, target);
        if looks {
            witness.note_step::<A>(s, &self.e);
        }
        if length >= left {
            Step::Reached
        } else {
            Step::Free
        }
    }

    /// Length that is free of roots, taking up what is below rounding as grazing.
    #[inline(always)]
    fn cleared(&mut self, signal: &mut Signal, seen: &Assessment, left: f64) -> f64 {
        if signal.leaving && seen.jet[0] > 4.0 * signal.noise {
            signal.leaving = false;
        }
        let least = 4.0 * f64::EPSILON * self.e.s;
        if seen.free > least {
            return seen.free;
        }
        self.grazing += 1;
        grazed(signal.noise, seen, least, left)
    }

    /// Polishes the root in the bracket and evaluates there.
    #[inline(always)]
    fn refine_root<A: Arith>(
        &mut self,
        basis: &Basis,
        phase: &Phase,
        signal: &Signal,
        bracket: Bracket,
        left: f64,
        number: usize,
    ) -> Step {
        let start = self.e.s;
        let horizon = start + left;
        let (mut low, mut high) = (start + bracket.low, start + bracket.high);
        let mut s = start + bracket.guess;
        let lanes = basis.lanes.len().min(phase.active * WIDTH);
        let fastest = if lanes > 0 {
            basis.modulus[lanes - 1]
        } else {
            0.0
        };
        for _ in 0..60 {
            self.evaluate::<A>(basis, phase, s);
            let (a, r) = signal.jet::<A>(basis, phase.active, &self.e);
            if a[0] > 0.0 {
                low = s
            } else {
                high = s
            }
            let (x, lost) = root_correction::<A>(a, r);
            let next = s + x;
            let inside = next >= low && next <= high;
            if inside && lost * x.abs() <= 1e-16 * s {
                if next > horizon {
                    self.evaluate::<A>(basis, phase, horizon);
                    return Step::Reached;
                }
                if fastest * x.abs() < 1e-4 {
                    self.advance_exponentials::<A>(basis, phase.active, x);
                    self.e.s = next;
                    if !phase.flights.is_empty() {
                        phase.swing::<A>(basis, &mut self.e);
                    }
                } else if next != s {
                    self.evaluate::<A>(basis, phase, next);
                }
                return Step::Root(number);
            }
            let newton = s - a[0] / a[1];
            s = if inside {
                next
            } else if newton > low && newton < high {
                newton
            } else {
                0.5 * (low + high)
            };
        }
        if s > horizon {
            self.evaluate::<A>(basis, phase, horizon);
            return Step::Reached;
        }
        Step::Root(number)
    }

    /// Moves the exponentials by a small x: e^{λx} by its Taylor series
    /// (|λx| < 10⁻⁴: error 10⁻¹⁸).
    #[inline(always)]
    fn advance_exponentials<A: Arith>(&mut self, basis: &Basis, active: usize, x: f64) {
        let x = V::splat(x);
        let f = V::splat;
        for b in 0..active {
            let (u, w) = (basis.re[b] * x, basis.im[b] * x);
            // 1 + y(1 + y/2(1 + y/3)), y = u + iw.
            let (mut re, mut im) = (f(1.0) + u * f(1.0 / 3.0), w * f(1.0 / 3.0));
            for share in [0.5, 1.0] {
                let (yr, yi) = (u * f(share), w * f(share));
                (re, im) = (yr.fma::<A>(re, f(1.0)) - yi * im, yr.fma::<A>(im, yi * re));
            }
            let (er, ei) = (self.e.re[b], self.e.im[b]);
            self.e.re[b] = er * re - ei * im;
            self.e.im[b] = er.fma::<A>(im, ei * re);
            // A size is a bound: e^u ≤ 1 + u + u².
            self.e.size[b] = self.e.size[b] * u.fma::<A>(f(1.0) + u, f(1.0));
        }
    }
}

/// The lesser of two numbers; one that is not a number has been refused before.
#[inline(always)]
fn least_of_two(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// How long a signal that is not told from zero stays within a quarter of `noise`.
#[cold]
#[inline(never)]
fn grazed(noise: f64, seen: &Assessment, least: f64, left: f64) -> f64 {
    let [_, d1, d2, d3, d4] = seen.jet.map(f64::abs);
    let n = 0.25 * noise;
    let mut h = left;
    h = h
        .min(n / d1)
        .min((2.0 * n / d2).sqrt())
        .min((6.0 * n / d3).cbrt());
    h = h.min((24.0 * n / d4).sqrt().sqrt());
    h = h.min((120.0 * n / seen.remainder).powf(0.2));
    // Exactly zero in every order that is seen: a billionth of what is left.
    h.max(2.0 * least).max(1e-9 * left).min(left)
}

/// True when the signal has passed zero already.
///
/// A signal that starts on zero is judged by its first derivative that is not
/// lost in rounding; one that has not yet left the band of its rounding is
/// only believed when it lies clearly below.
#[inline(always)]
fn crossed(signal: &Signal, seen: &Assessment, s: f64, fastest: f64) -> bool {
    if s == 0.0 && signal.zeros > 0 {
        // Rounding of the n-th derivative: that of g times the fastest rate.
        let mut noise = signal.noise;
        for (order, derivative) in seen.jet.iter().enumerate() {
            if order >= signal.zeros && derivative.abs() > noise {
                return *derivative < 0.0;
            }
            noise *= fastest;
        }
        return false;
    }
    if signal.leaving {
        // A root is where the clock puts it: half a unit of s times the rate.
        let clock = f64::EPSILON * s * seen.jet[1].abs();
        return seen.jet[0] < -2.0 * (signal.noise + clock);
    }
    seen.jet[0] <= 0.0 && seen.jet[1] <= 0.0
}
