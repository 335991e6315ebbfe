//! The run: phases and switches in turn.

use super::basis::Basis;
use super::lanes::{Arith, Fused, Plain};
use super::panel::Panel;
use super::phase::Exponentials;
use super::phase::{Phase, Steady};
use super::problem::{PairState, Refusal, TreeObject, TreePair, TreeProblem};
use super::sample::Sampler;
use super::search::{Search, Step, Witness};
use super::signal::{Functional, Signal, Weights};
use super::start;
use super::track::{Track, TreeFigures};

/// What is asked of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// End time (s), > 0.
    pub end: f64,
    /// Number of equal intervals at whose ends samples are taken (t = 0 is not
    /// one of them); 0: none.
    pub samples: usize,
    /// Samples of every mass, q and q̇; otherwise of the last mass's q alone.
    pub all_masses: bool,
    /// Most switches.
    pub switches: u64,
    /// Figures between samples, wanted or not.
    pub figures: bool,
}

impl Request {
    /// A run to `end` with `samples` samples of the last mass.
    pub fn new(end: f64, samples: usize) -> Self {
        Self {
            end,
            samples,
            all_masses: false,
            switches: 1_000_000,
            figures: false,
        }
    }
}

/// A switch of a pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExactSwitch {
    /// When (s).
    pub time: f64,
    /// The mass whose link holds the pair.
    pub mass: usize,
    /// State before.
    pub before: PairState,
    /// State after.
    pub after: PairState,
    /// Ẋ at the switch: speed of parting (> 0) or of approach (< 0).
    pub speed: f64,
}

/// What a run leaves behind.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ExactRun {
    /// Time reached (s).
    pub time: f64,
    /// True when the end was reached.
    pub complete: bool,
    /// States of the pairs just after t = 0, by mass.
    pub start: Vec<PairState>,
    /// Every switch.
    pub switches: Vec<ExactSwitch>,
    /// Samples: one row an interval end; one column (δ of the last mass), or
    /// q then q̇ of every mass.
    pub samples: Vec<f64>,
    /// Columns of `samples`.
    pub columns: usize,
    /// q at the end.
    pub displacement: Vec<f64>,
    /// q̇ at the end.
    pub speed: Vec<f64>,
    /// Figures of every object, when asked for.
    pub figures: Vec<TreeFigures>,
    /// Phases, search steps, evaluations.
    pub phases: u64,
    /// Steps of the search.
    pub steps: u64,
    /// Evaluations of the exponentials in the search.
    pub evaluations: u64,
    /// Steps over which a watched signal could not be told from zero.
    pub grazing: u64,
}

/// One combination of engaged pairs, ready for use.
#[derive(Clone, Debug)]
pub(crate) struct Regime {
    key: Vec<PairState>,
    pub(crate) basis: Basis,
    steady: Option<Steady>,
    pub(crate) weights: Vec<Weights>,
    /// Panels of every object: one, or one a flank while open.
    panels: Vec<Vec<Panel>>,
}

/// Most combinations kept.
const REGIMES: usize = 256;

/// A watched pair function.
#[derive(Clone, Copy, Debug)]
struct Watch {
    mass: usize,
    functional: usize,
    sign: f64,
    target: PairState,
}

/// Hands every step of the search to the tracks.
struct Tracks<'a> {
    tracks: &'a mut [Track],
    variants: &'a [(usize, bool)],
    regime: &'a Regime,
    phase: &'a Phase,
}

impl Witness for Tracks<'_> {
    #[inline(always)]
    fn see<A: Arith>(&mut self, e: &Exponentials, length: f64) {
        for (o, track) in self.tracks.iter_mut().enumerate() {
            let panel = &self.regime.panels[o][self.variants[o].0];
            track.step::<A>(&self.regime.basis, panel, self.phase, e, length);
        }
    }
}

/// Working memory of a run.
struct Workspace<'a> {
    problem: &'a TreeProblem,
    functionals: &'a [Functional],
    first: &'a [usize],
    regimes: Vec<Regime>,
    states: Vec<PairState>,
    key: Vec<PairState>,
    watches: Vec<Watch>,
    watched: Vec<usize>,
    signals: Vec<Signal>,
    phase: Phase,
    search: Search,
    q: Vec<f64>,
    v: Vec<f64>,
    q_end: Vec<f64>,
    v_end: Vec<f64>,
    /// Number of leading derivatives known to vanish, by functional.
    zeros: Vec<usize>,
    sampler: Sampler,
    tracks: Vec<Track>,
    /// Panel in use and whether the object's link transmits force.
    variants: Vec<(usize, bool)>,
    out: ExactRun,
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
            functionals.push(linear(mass.stiffness, mass.damping));
        }
    }
    (functionals, first)
}

/// One track an object, when figures are asked for.
fn tracks(problem: &TreeProblem, request: &Request, blocks: usize) -> Vec<Track> {
    if !request.figures {
        return Vec::new();
    }
    let flights = problem.masses.len() * problem.law.frequencies().len();
    let make = |object: &TreeObject| {
        let base = object
            .driver
            .map_or(0.0, |(d, ratio)| ratio * problem.displacement[d]);
        let cap = match problem.masses[object.first].pair {
            TreePair::Form { gap } => gap / 2.0,
            _ => f64::INFINITY,
        };
        Track::new(
            blocks,
            flights,
            problem.displacement[object.last] - base,
            cap,
        )
    };
    problem.objects.iter().map(make).collect()
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
        let ratio = problem.masses[object.last].ratio;
        let moving = |order: usize| {
            let mut one = [0.0; 3];
            one[order] = 1.0;
            let law = one.map(|x| x * ratio);
            Functional {
                terms: vec![(object.last, one)],
                law,
                constant: 0.0,
            }
        };
        let mut delta = Functional {
            terms: vec![(object.last, [1.0, 0.0, 0.0])],
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

/// Runs with the best arithmetic of this processor.
pub(crate) fn run(
    problem: &TreeProblem,
    functionals: &[Functional],
    first: &[usize],
    request: &Request,
) -> Result<ExactRun, Refusal> {
    #[cfg(target_arch = "x86_64")]
    if std::is_x86_feature_detected!("avx2") && std::is_x86_feature_detected!("fma") {
        // SAFETY: the processor has the features the function is compiled for.
        #[allow(unsafe_code)]
        return unsafe { run_fused(problem, functionals, first, request) };
    }
    run_plain(problem, functionals, first, request)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn run_fused(
    problem: &TreeProblem,
    functionals: &[Functional],
    first: &[usize],
    request: &Request,
) -> Result<ExactRun, Refusal> {
    Workspace::new(problem, functionals, first, request)?.run::<Fused>(request)
}

/// The run without special instructions.
pub(crate) fn run_plain(
    problem: &TreeProblem,
    functionals: &[Functional],
    first: &[usize],
    request: &Request,
) -> Result<ExactRun, Refusal> {
    Workspace::new(problem, functionals, first, request)?.run::<Plain>(request)
}

impl<'a> Workspace<'a> {
    fn new(
        problem: &'a TreeProblem,
        functionals: &'a [Functional],
        first: &'a [usize],
        request: &Request,
    ) -> Result<Self, Refusal> {
        let n = problem.masses.len();
        let harmonics = problem.law.frequencies().len();
        // Overdamped modes take two lanes a mass.
        let blocks = (2 * n + harmonics).div_ceil(super::lanes::WIDTH);
        let (states, zeros) = start::states(problem, functionals, first)?;
        Ok(Self {
            problem,
            functionals,
            first,
            regimes: Vec::new(),
            key: states.clone(),
            states: states.clone(),
            watches: Vec::with_capacity(2 * n),
            watched: Vec::with_capacity(2 * n),
            signals: vec![Signal::new(blocks, n * harmonics); functionals.len()],
            phase: Phase::new(problem, blocks),
            search: Search::new(blocks),
            q: problem.displacement.clone(),
            v: problem.speed.clone(),
            q_end: problem.displacement.clone(),
            v_end: problem.speed.clone(),
            zeros,
            sampler: Sampler::new(problem, request, blocks),
            tracks: tracks(problem, request, blocks),
            variants: vec![(0, true); problem.objects.len()],
            out: ExactRun {
                start: states.clone(),
                switches: Vec::with_capacity(256),
                columns: if request.all_masses { 2 * n } else { 1 },
                ..ExactRun::default()
            },
        })
    }

    #[inline(always)]
    fn run<A: Arith>(mut self, request: &Request) -> Result<ExactRun, Refusal> {
        let mut at = (0.0, 0.0);
        let mut stalled = 0;
        loop {
            let regime = self.regime()?;
            self.out.phases += 1;
            let entry = &self.regimes[regime];
            // The projection uses q, v up; the tracks look at the copy.
            self.q_end.copy_from_slice(&self.q);
            self.v_end.copy_from_slice(&self.v);
            let (q, v) = (&mut self.q, &mut self.v);
            self.phase
                .begin::<A>(self.problem, &entry.basis, entry.steady.as_ref(), at, q, v);
            let horizon = self.phase.local(request.end).min(self.phase.reach);
            self.begin_tracks::<A>(regime);
            let event = self.pass::<A>(regime, horizon)?;
            let entry = &self.regimes[regime];
            let s = self.search.e.s;
            self.phase.state::<A>(
                &entry.basis,
                &self.search.e,
                &mut self.q_end,
                &mut self.v_end,
            );
            self.sampler
                .phase::<A>(&entry.basis, &self.phase, s, &mut self.out.samples);
            self.end_tracks::<A>(regime);
            at = self.phase.time(s);
            std::mem::swap(&mut self.q, &mut self.q_end);
            std::mem::swap(&mut self.v, &mut self.v_end);
            self.zeros.fill(0);
            if let Some(number) = event {
                stalled = if s > 0.0 { 0 } else { stalled + 1 };
                if stalled > 8 * self.states.len() {
                    return Err(Refusal::new("", "pairs switch without end at one instant"));
                }
                self.switch(number, at.0);
            }
            if at.0 + at.1 >= request.end || self.out.switches.len() as u64 > request.switches {
                break;
            }
        }
        let length = at.0;
        for track in &mut self.tracks {
            track.figures.sigma = track.area / length;
            self.out.figures.push(track.figures);
        }
        self.out.time = at.0;
        self.out.complete = at.0 + at.1 >= request.end;
        self.out.displacement = self.q;
        self.out.speed = self.v;
        self.out.steps = self.search.steps;
        self.out.evaluations = self.search.evaluations;
        self.out.grazing = self.search.grazing;
        Ok(self.out)
    }

    /// Number of the regime for the present states, made when first met.
    #[inline(always)]
    fn regime(&mut self) -> Result<usize, Refusal> {
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
    fn make_regime(&mut self) -> Result<usize, Refusal> {
        if self.regimes.len() >= REGIMES {
            self.regimes.clear();
        }
        let basis = Basis::new(self.problem, &self.key).map_err(|e| Refusal::new("", e.0))?;
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
        self.regimes.push(Regime {
            key: self.key.clone(),
            basis,
            steady,
            weights,
            panels,
        });
        Ok(self.regimes.len() - 1)
    }

    /// What has to be watched in the present states.
    #[inline(always)]
    fn watch(&mut self) {
        self.watches.clear();
        self.watched.clear();
        for i in 0..self.states.len() {
            let (_, count) = self.problem.masses[i].pair.flanks();
            for f in 0..count {
                let clear = self.first[i] + 2 * f;
                let flank = f as u8;
                let (functional, sign, target) = match self.states[i] {
                    PairState::Engaged(own) if own == flank => {
                        (clear + 1, -1.0, PairState::Pressed(flank))
                    }
                    PairState::Pressed(own) if own == flank => {
                        (clear + 1, 1.0, PairState::Engaged(flank))
                    }
                    PairState::Engaged(_) => continue,
                    _ => (clear, 1.0, PairState::Engaged(flank)),
                };
                self.watches.push(Watch {
                    mass: i,
                    functional,
                    sign,
                    target,
                });
                self.watched.push(functional);
            }
        }
    }

    #[inline(always)]
    fn take_signals<A: Arith>(&mut self, regime: usize) {
        let entry = &self.regimes[regime];
        for watch in &self.watches {
            let f = watch.functional;
            let signal = &mut self.signals[f];
            signal.take::<A>(
                &entry.basis,
                &self.phase,
                &self.functionals[f],
                &entry.weights[f],
                watch.sign,
            );
            signal.zeros = self.zeros[f];
            signal.leaving = self.zeros[f] > 0;
        }
    }

    /// Takes the tracks into the phase: engaged, or open near the flank that is
    /// nearer at its start.
    #[inline(always)]
    fn begin_tracks<A: Arith>(&mut self, regime: usize) {
        for (o, track) in self.tracks.iter_mut().enumerate() {
            let first = self.problem.objects[o].first;
            let count = self.problem.masses[first].pair.flanks().1;
            let engaged = count == 0 || self.states[first].engaged();
            let variant = match (engaged, count) {
                (false, 2) => {
                    let x = |f: usize| {
                        self.functionals[self.first[first] + 2 * f].value(&self.q_end, &self.v_end)
                    };
                    usize::from(x(1) < x(0))
                }
                _ => 0,
            };
            self.variants[o] = (variant, engaged);
            let entry = &self.regimes[regime];
            track.begin::<A>(
                &entry.basis,
                &entry.panels[o][variant],
                &self.phase,
                engaged,
            );
        }
    }

    #[inline(always)]
    fn end_tracks<A: Arith>(&mut self, regime: usize) {
        for (o, track) in self.tracks.iter_mut().enumerate() {
            let entry = &self.regimes[regime];
            let panel = &entry.panels[o][self.variants[o].0];
            track.end::<A>(&entry.basis, panel, &self.phase, &self.search.e);
        }
    }

    /// Follows the phase to its end: the number of the watch that fired, or
    /// none at the horizon.
    #[inline(always)]
    fn pass<A: Arith>(&mut self, regime: usize, horizon: f64) -> Result<Option<usize>, Refusal> {
        self.watch();
        self.take_signals::<A>(regime);
        self.search.restart(&self.phase);
        if horizon <= 0.0 {
            return Ok(None);
        }
        loop {
            let entry = &self.regimes[regime];
            let mut witness = Tracks {
                tracks: &mut self.tracks,
                variants: &self.variants,
                regime: entry,
                phase: &self.phase,
            };
            let step = self.search.step_seen::<A>(
                &entry.basis,
                &self.phase,
                &mut self.signals,
                &self.watched,
                horizon,
                &mut witness,
            );
            match step {
                Step::NotFinite => {
                    return Err(Refusal::new("", "the motion is no longer a finite number"));
                }
                Step::Reached => return Ok(None),
                Step::Root(number) => {
                    if self.comes_clear::<A>(regime, Some(number)) {
                        self.watch();
                        self.take_signals::<A>(regime);
                        continue;
                    }
                    return Ok(Some(number));
                }
                Step::Free => {
                    if self.comes_clear::<A>(regime, None) {
                        self.watch();
                        self.take_signals::<A>(regime);
                    }
                }
            }
        }
    }

    /// Pressed pairs that have come clear of their flank become free: from
    /// X > 0 the next event can only be the root of X itself (Ẋ < 0 there, so
    /// the pull is negative too).
    #[inline(always)]
    fn comes_clear<A: Arith>(&mut self, regime: usize, fired: Option<usize>) -> bool {
        let mut changed = false;
        for number in 0..self.watches.len() {
            let watch = self.watches[number];
            let PairState::Pressed(f) = self.states[watch.mass] else {
                continue;
            };
            if watch.target != PairState::Engaged(f) || fired.is_some_and(|k| k != number) {
                continue;
            }
            let clear = watch.functional - 1;
            let entry = &self.regimes[regime];
            let signal = &mut self.signals[clear];
            signal.take::<A>(
                &entry.basis,
                &self.phase,
                &self.functionals[clear],
                &entry.weights[clear],
                1.0,
            );
            let x = signal.value::<A>(&entry.basis, self.phase.active, &self.search.e);
            if x > signal.noise {
                self.states[watch.mass] = PairState::Free;
                changed = true;
            }
        }
        changed
    }

    /// Takes the switch of a watch at the state now in q, v.
    fn switch(&mut self, number: usize, time: f64) {
        let watch = self.watches[number];
        let i = watch.mass;
        let before = self.states[i];
        let (PairState::Pressed(f) | PairState::Engaged(f)) = watch.target else {
            return;
        };
        let clear = self.first[i] + 2 * usize::from(f);
        let rate = Functional {
            constant: 0.0,
            ..self.functionals[clear].clone()
        };
        let speed = rate.value(&self.v, &self.v);
        let undamped = self.problem.masses[i].damping == 0.0;
        let after = match watch.target {
            // Without damping the force vanishes with the penetration.
            PairState::Pressed(_) if undamped => PairState::Free,
            target => target,
        };
        match (before, after) {
            (_, PairState::Free) => self.zeros[clear] = 1,
            (_, PairState::Pressed(_)) | (PairState::Pressed(_), _) => self.zeros[clear + 1] = 1,
            _ if undamped => self.zeros[clear + 1] = 1,
            _ => {}
        }
        self.states[i] = after;
        self.out.switches.push(ExactSwitch {
            time,
            mass: i,
            before,
            after,
            speed,
        });
    }
}
