//! What a method needs to know of a system.
//!
//! A system is second order: u″ = a(t, u, u′, modes), with n coordinates u and
//! the state y = [u, u′] (2n numbers). `modes` are its discrete state: which
//! pairs are engaged, which piece of a law is in force. While they do not
//! change the right-hand side is smooth, also a little beyond the places where
//! they should have changed; a *watch* says where that is.

use crate::math::narrow::Narrow;
use crate::math::polynomial::Step;

/// Discrete state: one small integer per component (a pair, a track).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Modes(pub Vec<i64>);

/// A smooth function of time that a watch looks at:
/// `offset + displacement·s + speed·ṡ` of signal s.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Guard {
    /// Index of the signal.
    pub signal: usize,
    /// Constant term.
    pub offset: f64,
    /// Factor of the signal's value.
    pub displacement: f64,
    /// Factor of the signal's rate.
    pub speed: f64,
}

/// A guard without a sign yet: it keeps its mode until it is beyond a floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UndecidedGuard {
    /// Component of [`Modes`].
    pub component: usize,
    /// Value below zero at which it has changed its sign.
    pub floor: f64,
    /// Its rate.
    pub rate: f64,
}

/// A switch to be looked for: the moment when w = min(guards) changes to the
/// sign asked for. Time intervals are half-open: a switch at the start of an
/// interval has been dealt with, one at its end belongs to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EventFunction {
    /// The two guards; the second may repeat the first.
    pub guards: [Guard; 2],
    /// True: the switch comes when w becomes positive (both guards positive);
    /// false: when w becomes negative (either guard negative).
    pub rising: bool,
    /// Component of [`Modes`] that changes.
    pub component: usize,
    /// Mode after the switch.
    pub target: i64,
}

/// A switch to be looked for where no signal tells it: a function of the state that
/// is looked at `looks` times a step, and located by bisection where it becomes
/// positive. It may jump.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Probe {
    /// Index among the probes of the system.
    pub index: usize,
    /// Component of [`Modes`] that changes.
    pub component: usize,
    /// Mode after the switch.
    pub target: i64,
    /// Places of a step to look at, the last at its end.
    pub looks: usize,
    /// True of a function that is as long as a step takes it to be smooth, whatever the method
    /// resolves: it is looked at closer where it bends.
    pub refined: bool,
}

impl Probe {
    /// Value of a probe that fires.
    pub const FIRES: f64 = 1.0;
    /// Value of a probe that does not fire.
    pub const RESTS: f64 = -1.0;
    /// Value of a probe where there are no forces: the motion ends just before.
    pub const NO_FORCES: f64 = f64::INFINITY;
}

/// A place that a signal cannot pass, because the equations end there: they hold
/// the square root of the distance to it, and are not numbers beyond. A run
/// ends a little before (a millionth of the span, or ten times the tolerance in
/// shares of the span), with the time at which the place itself is reached.
/// What would turn back within that last bit counts as having reached it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Singularity {
    /// Index of the signal.
    pub signal: usize,
    /// Value of the signal at the edge.
    pub place: f64,
    /// +1: reached from below; −1: from above.
    pub side: f64,
    /// Size of the range that the edge belongs to, > 0.
    pub span: f64,
    /// Component of [`Modes`] that it belongs to.
    pub component: usize,
}

/// An impact of a rigid contact: its speeds jump at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// Component of [`Modes`] of the contact.
    pub component: usize,
    /// The flank that is struck: −1 the lower, +1 the upper.
    pub side: i64,
    /// Speed at which it came together (rad/s or m/s), ≥ 0.
    pub approach: f64,
    /// Impulse (N·m·s or N·s), ≥ 0.
    pub impulse: f64,
    /// Energy lost (J), ≥ 0.
    pub lost: f64,
    /// Work of the prescribed drives in it (J).
    pub drives: f64,
    /// Time at which the impacts end that would follow in ever shorter times (s), where
    /// it is held from here on; `None`: it goes apart.
    pub rests: Option<f64>,
}

/// The mechanism itself cannot go on; not a failure of the method.
#[derive(Clone, Debug, PartialEq)]
pub struct PhysicalStop {
    /// Short name as in a scene's `expect`: `dead_position`, …
    pub name: &'static str,
    /// The object concerned.
    pub object: String,
    /// Message to the user: what happened.
    pub message: String,
}

impl PhysicalStop {
    /// Name of the stop at which a law of the scene has no finite value.
    pub const NO_VALUE: &str = "no_value";
}

/// A switching second-order system.
pub trait Dynamics: Sync {
    /// Working memory of one evaluation; one per thread.
    type Scratch: Send;

    /// New working memory.
    fn scratch(&self) -> Self::Scratch;

    /// Number n of coordinates; the state has 2n entries.
    fn coordinates(&self) -> usize;

    /// Number of signals: the n coordinates first, then whatever else the
    /// event_functions look at.
    fn signals(&self) -> usize;

    /// dy/dt = [u′, u″]. Must not allocate.
    fn derivatives(
        &self,
        time: f64,
        y: &[f64],
        modes: &Modes,
        scratch: &mut Self::Scratch,
        dy: &mut [f64],
    );

    /// Directional derivative of `derivatives` along `direction` at fixed time:
    /// the Jacobian times a vector.
    fn tangent(
        &self,
        time: f64,
        y: &[f64],
        modes: &Modes,
        direction: &[f64],
        scratch: &mut Self::Scratch,
        out: &mut [f64],
    );

    /// Derivatives of the accelerations along several directions at once, 2n
    /// entries each, one after the other; n entries of `out` for each. Must not
    /// allocate after the first call with a scratch. Default: one by one.
    fn tangents(
        &self,
        time: f64,
        y: &[f64],
        modes: &Modes,
        directions: &[f64],
        scratch: &mut Self::Scratch,
        out: &mut [f64],
    ) {
        let count = self.coordinates();
        let mut product = vec![0.0; 2 * count];
        let directions = directions.chunks_exact(2 * count);
        for (direction, out) in directions.zip(out.chunks_exact_mut(count)) {
            self.tangent(time, y, modes, direction, scratch, &mut product);
            out.copy_from_slice(&product[count..]);
        }
    }

    /// True when the right-hand side does not depend on time, in any modes.
    /// Default: false.
    fn is_autonomous(&self) -> bool {
        false
    }

    /// Derivative of `derivatives` with respect to time at a fixed state.
    fn derivative_by_time(
        &self,
        time: f64,
        y: &[f64],
        modes: &Modes,
        scratch: &mut Self::Scratch,
        out: &mut [f64],
    );

    /// True when [`Self::expand`] works. Default: false.
    fn expands(&self) -> bool {
        false
    }

    /// The motion from a state with derivative `dy` as power series in
    /// s = (t − `time`)/`length`, the modes unchanged: coefficients of the powers
    /// 0 … `degree` of every signal, one signal after the other, into `out`.
    /// 2 ≤ `degree` ≤ 24. Returns the share of `length` used up by what the
    /// series take for granted: at 2, only the first half can be relied on.
    /// Must not allocate after the first call with a scratch.
    #[allow(clippy::too_many_arguments)] // a state, what is asked for, and room for it
    fn expand(
        &self,
        [_time, _length]: [f64; 2],
        _y: &[f64],
        _dy: &[f64],
        _modes: &Modes,
        _degree: usize,
        _scratch: &mut Self::Scratch,
        out: &mut [f64],
    ) -> f64 {
        out.fill(f64::NAN);
        f64::INFINITY
    }

    /// For every coordinate, the coordinates whose value or rate its
    /// acceleration may depend on, in any modes: where the Jacobian may not be
    /// zero. Default: all.
    fn pattern(&self) -> Vec<Vec<usize>> {
        let count = self.coordinates();
        vec![(0..count).collect(); count]
    }

    /// The signals beyond the coordinates, each as (s, ṡ, s̈), at a state whose
    /// derivative `dy` is known; `out[0]` is signal n.
    fn extra_signals(
        &self,
        time: f64,
        y: &[f64],
        dy: &[f64],
        modes: &Modes,
        scratch: &mut Self::Scratch,
        out: &mut [[f64; 3]],
    );

    /// Scale of each of the 2n state entries: the error wanted is
    /// tolerance × scale (all > 0 and finite).
    fn scales(&self) -> &[f64];

    /// Scales of a signal and of its rate. Default: those of the entries of the state, none of
    /// extra signals.
    fn scales_of_signal(&self, signal: usize) -> Option<[f64; 2]> {
        let n = self.coordinates();
        (signal < n).then(|| [self.scales()[signal], self.scales()[n + signal]])
    }

    /// Size of a state entry that errors are measured by. Default: its scale and
    /// its value together. The angle of a rotor, which grows with every turn, is not
    /// known less well for that.
    fn error_size(&self, index: usize, value: f64) -> f64 {
        self.scales()[index] + value.abs()
    }

    /// Name of a state entry, for messages: "rocker, mass 2: speed".
    fn state_name(&self, index: usize) -> String;

    /// All event_functions for the present modes; clears `out` first.
    fn event_functions(&self, modes: &Modes, out: &mut Vec<EventFunction>);

    /// All edges for the present modes; clears `out` first. Default: none.
    fn singularities(&self, _modes: &Modes, out: &mut Vec<Singularity>) {
        out.clear();
    }

    /// Reason for which the run stops at an edge, reached at `time`.
    fn stop_at(&self, time: f64, edge: &Singularity) -> PhysicalStop {
        PhysicalStop {
            name: "dead_position",
            object: String::new(),
            message: format!(
                "signal {} cannot pass {} at t = {time} s",
                edge.signal, edge.place
            ),
        }
    }

    /// Value and rate of a signal at `time` where it is a given function of time,
    /// whatever the state; `None` (default) elsewhere.
    fn given_signal(&self, _signal: usize, _time: f64) -> Option<[f64; 2]> {
        None
    }

    /// Changes the modes for a switch located at (`time`, `y`), and the state where
    /// the new modes bind it (by no more than it is uncertain by), or where an impact lets
    /// speeds jump.
    ///
    /// # Errors
    /// The mechanism cannot go on.
    fn switch(
        &self,
        time: f64,
        y: &mut [f64],
        watch: &EventFunction,
        modes: &mut Modes,
    ) -> Result<Option<Impact>, PhysicalStop>;

    /// All probes for the present modes; clears `out` first. Default: none.
    fn probes(&self, _modes: &Modes, out: &mut Vec<Probe>) {
        out.clear();
    }

    /// Value of a probe at a state: the probe fires where the value becomes positive, or
    /// just before where the value is [`Probe::NO_FORCES`]. `y` is memory afterwards.
    /// Must not allocate.
    fn probe(
        &self,
        _probe: &Probe,
        _time: f64,
        _y: &mut [f64],
        _modes: &Modes,
        _scratch: &mut Self::Scratch,
    ) -> f64 {
        Probe::RESTS
    }

    /// True where [`Self::first_crossing`] has to be asked. Default: false.
    fn has_crossings(&self) -> bool {
        false
    }

    /// The first switch on a step, up to `end`, of what is no linear function of a
    /// signal and its rate: its place and what changes. `fresh`: something has switched
    /// at the step's start. Guards at rest change beyond their floors. Default: none.
    fn first_crossing(
        &self,
        _step: &Step<'_>,
        _modes: &Modes,
        _end: f64,
        _fresh: bool,
        _resting: &[UndecidedGuard],
    ) -> Option<(f64, EventFunction)> {
        None
    }

    /// The guards that [`Self::first_crossing`] looks at of which a state does not tell the sign,
    /// as what errors of `share` of the scales of the state change in them is more than
    /// their value. Default: none.
    fn undecided_guards(
        &self,
        _time: f64,
        _y: &[f64],
        _modes: &Modes,
        _share: f64,
    ) -> Vec<UndecidedGuard> {
        Vec::new()
    }

    /// The longest step (s) in which what the state does not tell, a force by which
    /// something is held, can be followed. Default: any.
    fn longest_step(&self, _modes: &Modes) -> f64 {
        f64::INFINITY
    }

    /// Stretches between two instants, without a break between them, in which given functions
    /// of time change so briefly that a long step would pass over it unseen; ascending.
    /// Default: none.
    fn narrow_stretches(&self, _from: f64, _to: f64, _modes: &Modes) -> Vec<Narrow> {
        Vec::new()
    }

    /// Why the evaluation made last, at `time`, gave no numbers, where the mechanism itself
    /// or a law of the scene is the reason. Default: it never is.
    fn obstacle(
        &self,
        _time: f64,
        _modes: &Modes,
        _scratch: &Self::Scratch,
    ) -> Option<PhysicalStop> {
        None
    }

    /// True where a law of the scene may end with the motion, or have no derivatives at the
    /// edge of a piece. Default: false.
    fn has_edges(&self) -> bool {
        false
    }

    /// The end of the run, where a law of the scene grows without bound within `reach` (s) of
    /// a state. Default: none does.
    fn pole_near(
        &self,
        [_time, _reach]: [f64; 2],
        _y: &[f64],
        _dy: &[f64],
        _modes: &Modes,
        _scratch: &mut Self::Scratch,
    ) -> Option<PhysicalStop> {
        None
    }

    /// The share of a step at which it is to end instead, where a law of the scene changes so
    /// briefly along it that no place of a method sees it. Default: none does.
    fn passed_over(&self, _step: &Step<'_>, _modes: &Modes, _tolerance: f64) -> Option<f64> {
        None
    }

    /// The end of the run, where a law of the scene grows without bound on a step, up to
    /// the place `end` of it. Default: none does.
    fn pole_on(&self, _step: &Step<'_>, _modes: &Modes, _end: f64) -> Option<PhysicalStop> {
        None
    }

    /// The end of the run, where every motion is given and a law of the scene has no value at
    /// `time`. Default: all have.
    fn given_end(
        &self,
        _time: f64,
        _modes: &Modes,
        _scratch: &mut Self::Scratch,
    ) -> Option<PhysicalStop> {
        None
    }

    /// The first time after `time` at which a formula changes with time; +∞: never.
    fn next_break(&self, time: f64, modes: &Modes) -> f64;

    /// Changes the modes for a break at `time`, just reached.
    fn pass_break(&self, time: f64, modes: &mut Modes);

    /// True of a contact that comes apart from exactly where it touches: its guard begins at
    /// zero then. Default: false.
    fn is_rigid_contact(&self, _component: usize) -> bool {
        false
    }

    /// True for components whose changes are switches of a pair, which are
    /// counted and reported; false for changes of a formula (tracks).
    fn is_pair(&self, component: usize) -> bool;
}
