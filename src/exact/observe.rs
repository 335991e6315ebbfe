//! What a run hands to its figures and its energy audit.

use super::audit::{Instant, law_at};
use super::hermite::End;
use super::lanes::{Arith, Task, run_out_of_line};
use super::phase::{Exponentials, Phase};
use super::problem::{TreeObject, TreePair, TreeProblem};
use super::regime::Regime;
use super::request::Request;
use super::search::Witness;
use super::track::{Ahead, LookBack, Scene, Track};
use super::workspace::Workspace;

/// The acceleration of the last mass and the force of link 1 among the functionals of
/// a panel.
pub(super) const ACCELERATION: usize = 2;
pub(super) const FORCE: usize = 3;

/// Hands every step of the search to the tracks.
pub(super) struct Tracks<'a> {
    pub(super) tracks: &'a mut [Track],
    pub(super) variants: &'a [(usize, bool)],
    pub(super) regime: &'a Regime,
    pub(super) phase: &'a Phase,
}

impl Witness for Tracks<'_> {
    #[inline(always)]
    fn wants_steps(&self) -> bool {
        !self.tracks.is_empty()
    }

    #[inline(always)]
    fn note_step<A: Arith>(&mut self, from: f64, now: &Exponentials) {
        A::run_out_of_line(See {
            tracks: self,
            from,
            now,
        });
    }
}

/// A step of the search noted for the figures.
struct See<'a, 'b> {
    tracks: &'a mut Tracks<'b>,
    from: f64,
    now: &'a Exponentials,
}

impl Task for See<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<A: Arith>(self) {
        let Tracks {
            tracks,
            variants,
            regime,
            phase,
        } = self.tracks;
        for (o, track) in tracks.iter_mut().enumerate() {
            let scene = scene(regime, phase, o, variants);
            track.note_step::<A>(scene, self.from, self.now);
        }
    }
}

/// q and q̇ of every mass at local time `s` of the phase gone through last.
pub(super) fn state(
    work: &Workspace<'_>,
    regime: usize,
    s: f64,
    e: &mut Exponentials,
    (q, v): (&mut [f64], &mut [f64]),
) {
    let task = State {
        regime: &work.regimes[regime],
        phase: &work.phase,
        s,
        e,
        q,
        v,
    };
    run_out_of_line(work.plain, task);
}

/// The state at an instant of a phase.
struct State<'a> {
    regime: &'a Regime,
    phase: &'a Phase,
    s: f64,
    e: &'a mut Exponentials,
    q: &'a mut [f64],
    v: &'a mut [f64],
}

impl Task for State<'_> {
    type Output = ();

    #[inline(always)]
    fn run<A: Arith>(self) {
        let basis = &self.regime.basis;
        self.phase.exponentials::<A>(basis, self.s, self.e);
        self.phase.state::<A>(basis, self.e, self.q, self.v);
    }
}

/// Bounds of functional f of object `o` between two local times of the phase gone through
/// last; the force of an open link is none.
pub(super) fn bounds_in_phase(
    work: &Workspace<'_>,
    regime: usize,
    (o, f): (usize, usize),
    span: [f64; 2],
) -> Ahead {
    let (_, engaged) = work.variants[o];
    if !engaged && f == FORCE {
        return Ahead::default();
    }
    let scene = scene(&work.regimes[regime], &work.phase, o, &work.variants);
    let task = FunctionalBounds {
        scene,
        track: &work.tracks[o],
        f,
        span,
    };
    run_out_of_line(work.plain, task)
}

/// Bounds of a functional over a part of a phase.
struct FunctionalBounds<'a> {
    scene: Scene<'a>,
    track: &'a Track,
    f: usize,
    span: [f64; 2],
}

impl Task for FunctionalBounds<'_> {
    type Output = Ahead;

    #[inline(always)]
    fn run<A: Arith>(self) -> Ahead {
        self.track.ahead::<A>(self.scene, self.f, self.span)
    }
}

/// Force of link 1 of object `o` and its slope at local time `s` of the phase gone
/// through last.
pub(super) fn force(
    work: &mut Workspace<'_>,
    regime: usize,
    o: usize,
    s: f64,
    e: &mut Exponentials,
) -> End {
    if !work.variants[o].1 {
        return End { s, f: 0.0, g: 0.0 };
    }
    let plain = work.plain;
    let task = Force {
        scene: scene(&work.regimes[regime], &work.phase, o, &work.variants),
        track: &mut work.tracks[o],
        s,
        e,
    };
    run_out_of_line(plain, task)
}

/// A force at an instant of a phase.
struct Force<'a> {
    scene: Scene<'a>,
    track: &'a mut Track,
    s: f64,
    e: &'a mut Exponentials,
}

impl Task for Force<'_> {
    type Output = End;

    #[inline(always)]
    fn run<A: Arith>(self) -> End {
        let Scene { basis, phase, .. } = self.scene;
        phase.exponentials::<A>(basis, self.s, self.e);
        self.track.value_at::<A>(self.scene, FORCE, self.e)
    }
}

/// Basis, panel and phase that the figures of object `o` are taken from.
#[inline(always)]
fn scene<'a>(
    regime: &'a Regime,
    phase: &'a Phase,
    o: usize,
    variants: &[(usize, bool)],
) -> Scene<'a> {
    Scene {
        basis: &regime.basis,
        panel: &regime.panels[o][variants[o].0],
        phase,
    }
}

/// Tracks, one an object, when figures are asked for.
pub(super) fn tracks(problem: &TreeProblem, request: &Request, blocks: usize) -> Vec<Track> {
    let harmonics = problem.law.frequencies().len();
    if !request.figures {
        return Vec::new();
    }
    let flights = problem.masses.len() * harmonics;
    let make = |object: &TreeObject| {
        let base = object
            .driver
            .map_or(0.0, |(d, ratio)| ratio * problem.displacement[d]);
        let cap = match problem.masses[object.first].pair {
            TreePair::Form { gap } => gap / 2.0,
            _ => f64::INFINITY,
        };
        let output = object.output.iter();
        let output: f64 = output
            .map(|&(m, share)| share * problem.displacement[m])
            .sum();
        Track::new(
            (blocks, harmonics),
            flights,
            output - base,
            cap,
            request.asked,
        )
    };
    problem.objects.iter().map(make).collect()
}

impl Workspace<'_> {
    /// Takes the tracks into the phase: engaged, or open near the flank that is
    /// nearer at its start.
    #[inline(always)]
    pub(super) fn begin_tracks<A: Arith>(&mut self, regime: usize) {
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
            let scene = scene(&self.regimes[regime], &self.phase, o, &self.variants);
            track.begin_phase::<A>(scene, &self.search.e, engaged);
        }
    }

    /// Looks at the steps noted since the last time. To be called before modes
    /// leave the phase or come back to it.
    #[inline(always)]
    pub(super) fn process_noted_steps<A: Arith>(&mut self, regime: usize) {
        for (o, track) in self.tracks.iter_mut().enumerate() {
            if track.has_steps() {
                let scene = scene(&self.regimes[regime], &self.phase, o, &self.variants);
                A::run_out_of_line(LookBack { track, scene });
            }
        }
    }

    #[inline(always)]
    pub(super) fn end_tracks<A: Arith>(&mut self, regime: usize) {
        for (o, track) in self.tracks.iter_mut().enumerate() {
            let scene = scene(&self.regimes[regime], &self.phase, o, &self.variants);
            track.end::<A>(scene, &self.search.e);
        }
    }

    #[inline(always)]
    pub(super) fn begin_ledger(&mut self, regime: usize) {
        let entry = &self.regimes[regime];
        if let (Some(ledger), Some(forms)) = (&mut self.ledger, &entry.forms) {
            let first = || Instant {
                q: &self.q_end,
                v: &self.v_end,
                law: law_at(&self.phase, &forms.harmonic, &self.search.e),
            };
            ledger.begin(self.problem, &entry.key, &self.q_end, first);
        }
    }

    #[inline(always)]
    pub(super) fn end_ledger<A: Arith>(&mut self, regime: usize) {
        let entry = &self.regimes[regime];
        if let (Some(ledger), Some(forms)) = (&mut self.ledger, &entry.forms) {
            let (phase, e) = (&self.phase, &self.search.e);
            let at = Instant {
                q: &self.q_end,
                v: &self.v_end,
                law: law_at(phase, &forms.harmonic, e),
            };
            ledger.end::<A>(self.problem, entry, phase, e, &at);
        }
    }
}
