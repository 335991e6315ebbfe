//! Runs of mechanisms without a coordinate: every object is rigid and every
//! drive prescribed, so that the motion follows from the drives alone.
//!
//! There is nothing to integrate, but breaks of laws and tables are still to be
//! found, and the recorder still wants steps. One idle coordinate, always zero,
//! is put in front of the state for the integrator and taken away again before
//! anyone listens. Systems with coordinates pass through the same type
//! unchanged, so that the methods are compiled for one type only.

use crate::integrate::{Dynamics, Edge, Modes, PhysicalStop, Probe, Sink, SwitchEvent, Watch};
use crate::polynomial::Step;
use crate::system::{Scratch, System};

/// Steps in a turn of the drive: continuous output of order 6 is then exact to
/// rounding for smooth laws.
const STEPS_IN_CYCLE: f64 = 256.0;
/// Steps in a run at least.
const STEPS_IN_RUN: f64 = 1024.0;

/// Greatest step of a kinematic run (s).
pub(super) fn greatest_step(duration: f64, cycle: Option<f64>) -> f64 {
    let in_cycle = cycle.map_or(f64::INFINITY, |cycle| cycle / STEPS_IN_CYCLE);
    in_cycle.min(duration / STEPS_IN_RUN)
}

/// A system as the integrator sees it: with an idle coordinate if it has none.
pub(super) struct Driven<'s> {
    system: &'s System,
    /// True when the idle coordinate is there.
    idle: bool,
}

impl<'s> Driven<'s> {
    /// Puts an idle coordinate before a system that has none.
    pub(super) fn new(system: &'s System) -> Self {
        Self {
            system,
            idle: system.coordinates() == 0,
        }
    }

    /// The state of the system itself.
    fn own<'a>(&self, y: &'a [f64]) -> &'a [f64] {
        if self.idle { &[] } else { y }
    }

    fn own_mut<'a>(&self, y: &'a mut [f64]) -> &'a mut [f64] {
        if self.idle { &mut [] } else { y }
    }
}

impl Dynamics for Driven<'_> {
    type Scratch = Scratch;

    fn scratch(&self) -> Scratch {
        self.system.scratch()
    }

    fn coordinates(&self) -> usize {
        self.system.coordinates().max(1)
    }

    fn signals(&self) -> usize {
        self.system.signals() + usize::from(self.idle)
    }

    fn derivatives(
        &self,
        time: f64,
        y: &[f64],
        modes: &Modes,
        scratch: &mut Scratch,
        dy: &mut [f64],
    ) {
        if self.idle {
            dy.copy_from_slice(&[y[1], 0.0]);
        } else {
            self.system.derivatives(time, y, modes, scratch, dy);
        }
    }

    fn tangent(
        &self,
        time: f64,
        y: &[f64],
        modes: &Modes,
        direction: &[f64],
        scratch: &mut Scratch,
        out: &mut [f64],
    ) {
        if self.idle {
            out.copy_from_slice(&[direction[1], 0.0]);
        } else {
            self.system.tangent(time, y, modes, direction, scratch, out);
        }
    }

    fn time_tangent(
        &self,
        time: f64,
        y: &[f64],
        modes: &Modes,
        scratch: &mut Scratch,
        out: &mut [f64],
    ) {
        if self.idle {
            out.fill(0.0);
        } else {
            self.system.time_tangent(time, y, modes, scratch, out);
        }
    }

    fn expands(&self) -> bool {
        !self.idle && self.system.expands()
    }

    fn expand(
        &self,
        span: [f64; 2],
        y: &[f64],
        dy: &[f64],
        modes: &Modes,
        degree: usize,
        scratch: &mut Scratch,
        out: &mut [f64],
    ) -> f64 {
        self.system.expand(span, y, dy, modes, degree, scratch, out)
    }

    fn pattern(&self) -> Vec<Vec<usize>> {
        if self.idle {
            vec![vec![0]]
        } else {
            self.system.pattern()
        }
    }

    fn extra_signals(
        &self,
        time: f64,
        y: &[f64],
        dy: &[f64],
        modes: &Modes,
        scratch: &mut Scratch,
        out: &mut [[f64; 3]],
    ) {
        let (y, dy) = (self.own(y), self.own(dy));
        self.system.extra_signals(time, y, dy, modes, scratch, out);
    }

    fn scales(&self) -> &[f64] {
        if self.idle {
            &[1.0, 1.0]
        } else {
            self.system.scales()
        }
    }

    fn size(&self, index: usize, value: f64) -> f64 {
        if self.idle {
            1.0
        } else {
            self.system.size(index, value)
        }
    }

    fn state_name(&self, index: usize) -> String {
        if self.idle {
            "idle coordinate".to_owned()
        } else {
            self.system.state_name(index)
        }
    }

    fn watches(&self, modes: &Modes, out: &mut Vec<Watch>) {
        self.system.watches(modes, out);
        for guard in out.iter_mut().flat_map(|watch| &mut watch.guards) {
            guard.signal += usize::from(self.idle);
        }
    }

    fn edges(&self, modes: &Modes, out: &mut Vec<Edge>) {
        self.system.edges(modes, out);
        for edge in out {
            edge.signal += usize::from(self.idle);
        }
    }

    fn stop_at(&self, time: f64, edge: &Edge) -> PhysicalStop {
        self.system.stop_at(time, edge)
    }

    fn given_signal(&self, signal: usize, time: f64) -> Option<[f64; 2]> {
        let own = signal.checked_sub(usize::from(self.idle))?;
        self.system.given_signal(own, time)
    }

    fn switch(
        &self,
        time: f64,
        y: &mut [f64],
        watch: &Watch,
        modes: &mut Modes,
    ) -> Result<(), PhysicalStop> {
        let mut own = *watch;
        for guard in &mut own.guards {
            // One made up for a probe looks at no signal.
            guard.signal = guard.signal.saturating_sub(usize::from(self.idle));
        }
        self.system.switch(time, self.own_mut(y), &own, modes)
    }

    fn probes(&self, modes: &Modes, out: &mut Vec<Probe>) {
        self.system.probes(modes, out);
    }

    fn probe(
        &self,
        probe: &Probe,
        time: f64,
        y: &mut [f64],
        modes: &Modes,
        scratch: &mut Scratch,
    ) -> f64 {
        let own = self.own_mut(y);
        self.system.probe(probe, time, own, modes, scratch)
    }

    fn obstacle(&self, scratch: &Scratch) -> Option<PhysicalStop> {
        self.system.obstacle(scratch)
    }

    fn next_break(&self, time: f64, modes: &Modes) -> f64 {
        self.system.next_break(time, modes)
    }

    fn pass_break(&self, time: f64, modes: &mut Modes) {
        self.system.pass_break(time, modes);
    }

    fn is_pair(&self, component: usize) -> bool {
        self.system.is_pair(component)
    }
}

/// Takes the idle coordinate away before passing everything on.
pub(super) struct WithoutIdle<'a>(pub(super) &'a mut dyn Sink);

impl Sink for WithoutIdle<'_> {
    fn start(&mut self, time: f64, _: &[f64], modes: &Modes) {
        self.0.start(time, &[], modes);
    }

    fn step(&mut self, step: &Step<'_>, modes: &Modes) {
        let own = Step {
            coordinates: 0,
            coefficients: &step.coefficients[step.degree + 1..],
            ..*step
        };
        self.0.step(&own, modes);
    }

    fn switch(&mut self, event: &SwitchEvent<'_>) {
        self.0.switch(&SwitchEvent {
            y: &[],
            ..event.clone()
        });
    }

    fn passes(&mut self, time: f64, switches: u64) {
        self.0.passes(time, switches);
    }

    fn looks_within(&self, until: f64) -> bool {
        self.0.looks_within(until)
    }
}
