//! The system as the integrators see it.

use super::dry_friction;
use super::frozen::{Frozen, Step as Pass};
use super::passes::{Extent, Work};
use super::taylor::{Start, Taylor};
use super::written::FrozenExpression;
use super::{Bundle, DIRECTIONS, Scratch, System};
use crate::dynamics::integrate::{
    Dynamics, EventFunction, Impact, Modes, PhysicalStop, Probe, Singularity, UndecidedGuard,
};
use crate::math::narrow::Narrow;
use crate::math::number::{Dual, Duals};
use crate::math::polynomial::Step;

impl Scratch {
    pub(super) fn new(frozen: &Frozen) -> Self {
        let coordinates = frozen.coordinates;
        Self {
            work: Work::new(frozen),
            accelerations: vec![0.0; coordinates],
            dual_work: Work::new(frozen),
            dual_state: vec![Dual::default(); 2 * coordinates],
            dual_accelerations: vec![Dual::default(); coordinates],
            bundle: None,
            taylor: None,
        }
    }
}

impl Bundle {
    fn new(frozen: &Frozen) -> Self {
        let zero = Duals::from(0.0);
        Self {
            work: Work::new(frozen),
            state: vec![zero; 2 * frozen.coordinates],
            accelerations: vec![zero; frozen.coordinates],
        }
    }
}

/// Share of a rotor's angle that counts for its size.
const TURNED: f64 = 0.01;

/// Longest step while a rigid contact is held, in units of the time in which the fastest
/// motion of the laws turns by a radian, taken as a whole: its pieces turn some times faster.
const LONGEST_HELD: f64 = 0.1;

/// Longest step while dry friction holds something, as a share of the run.
const LONGEST_RESTING: f64 = 0.01;

/// Longest step where something follows a prescribed drive rigidly, in the time in which its
/// usual motion turns by a radian: works and figures of it count, and the coordinates, whose
/// error sets the step, may be at rest or of another machine.
const LONGEST_GIVEN: f64 = 0.5;

impl Dynamics for System {
    type Scratch = Scratch;

    fn scratch(&self) -> Scratch {
        Scratch::new(&self.frozen)
    }

    fn coordinates(&self) -> usize {
        self.frozen.coordinates
    }

    fn signals(&self) -> usize {
        self.frozen.coordinates + self.frozen.extra.len()
    }

    fn derivatives(
        &self,
        time: f64,
        y: &[f64],
        modes: &Modes,
        scratch: &mut Scratch,
        dy: &mut [f64],
    ) {
        let (speeds, accelerations) = dy.split_at_mut(self.frozen.coordinates);
        speeds.copy_from_slice(&y[self.frozen.coordinates..]);
        let extent = Extent::Needed;
        self.frozen
            .evaluate(time, y, &modes.0, extent, &mut scratch.work, accelerations);
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
        for ((state, &value), &derivative) in scratch.dual_state.iter_mut().zip(y).zip(direction) {
            *state = Dual::new(value, derivative);
        }
        self.frozen.evaluate(
            Dual::from(time),
            &scratch.dual_state,
            &modes.0,
            Extent::Needed,
            &mut scratch.dual_work,
            &mut scratch.dual_accelerations,
        );
        let (speeds, accelerations) = out.split_at_mut(self.frozen.coordinates);
        speeds.copy_from_slice(&direction[self.frozen.coordinates..]);
        for (out, dual) in accelerations.iter_mut().zip(&scratch.dual_accelerations) {
            *out = dual.derivative;
        }
    }

    fn tangents(
        &self,
        time: f64,
        y: &[f64],
        modes: &Modes,
        directions: &[f64],
        scratch: &mut Scratch,
        out: &mut [f64],
    ) {
        let count = self.frozen.coordinates;
        let bundle = scratch
            .bundle
            .get_or_insert_with(|| Box::new(Bundle::new(&self.frozen)));
        let directions = directions.chunks(DIRECTIONS * 2 * count);
        for (directions, out) in directions.zip(out.chunks_mut(DIRECTIONS * count)) {
            for (state, &value) in bundle.state.iter_mut().zip(y) {
                *state = Duals::from(value);
            }
            for (k, direction) in directions.chunks_exact(2 * count).enumerate() {
                for (state, &entry) in bundle.state.iter_mut().zip(direction) {
                    state.derivatives[k] = entry;
                }
            }
            self.frozen.evaluate(
                Duals::from(time),
                &bundle.state,
                &modes.0,
                Extent::Needed,
                &mut bundle.work,
                &mut bundle.accelerations,
            );
            for (k, out) in out.chunks_exact_mut(count).enumerate() {
                for (out, acceleration) in out.iter_mut().zip(&bundle.accelerations) {
                    *out = acceleration.derivatives[k];
                }
            }
        }
    }

    fn is_autonomous(&self) -> bool {
        let timed = |step: &Pass| matches!(step, Pass::Prescribed(_));
        !self.frozen.steps.iter().any(timed)
            && self.frozen.tracks.iter().all(|t| t.node.is_some())
            && !self
                .frozen
                .expression_loads()
                .any(FrozenExpression::needs_time)
    }

    fn derivative_by_time(
        &self,
        time: f64,
        y: &[f64],
        modes: &Modes,
        scratch: &mut Scratch,
        out: &mut [f64],
    ) {
        for (state, &value) in scratch.dual_state.iter_mut().zip(y) {
            *state = Dual::from(value);
        }
        self.frozen.evaluate(
            Dual::new(time, 1.0),
            &scratch.dual_state,
            &modes.0,
            Extent::Needed,
            &mut scratch.dual_work,
            &mut scratch.dual_accelerations,
        );
        let (speeds, accelerations) = out.split_at_mut(self.frozen.coordinates);
        speeds.fill(0.0);
        for (out, dual) in accelerations.iter_mut().zip(&scratch.dual_accelerations) {
            *out = dual.derivative;
        }
    }

    fn expands(&self) -> bool {
        self.frozen.expands()
    }

    fn expand(
        &self,
        [time, length]: [f64; 2],
        y: &[f64],
        dy: &[f64],
        modes: &Modes,
        degree: usize,
        scratch: &mut Scratch,
        out: &mut [f64],
    ) -> f64 {
        let start = Start {
            time,
            y,
            dy,
            modes: &modes.0,
        };
        let Scratch { work, taylor, .. } = scratch;
        let taylor = taylor.get_or_insert_with(|| Box::new(Taylor::new(&self.frozen)));
        self.frozen
            .expand(&start, degree, length, work, taylor, out)
    }

    fn pattern(&self) -> Vec<Vec<usize>> {
        self.frozen.pattern()
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
        if self.frozen.extra.is_empty() {
            return;
        }
        let work = &mut scratch.work;
        let accelerations = &dy[self.frozen.coordinates..];
        self.frozen.motion(time, y, &modes.0, Extent::Needed, work);
        if !self.frozen.multi.is_empty() {
            self.frozen.find_distances(work);
        }
        self.frozen.known_accelerations(accelerations, work);
        for (out, &node) in out.iter_mut().zip(&self.frozen.extra) {
            *out = [
                work.displacement[node],
                work.speed[node],
                work.acceleration[node],
            ];
        }
    }

    fn scales(&self) -> &[f64] {
        self.scales_of_state()
    }

    fn error_size(&self, index: usize, value: f64) -> f64 {
        // The angle of a rotor stays well above its rounding.
        let turns = index < self.frozen.coordinates && self.frozen.is_rotor(index);
        let share = if turns { TURNED } else { 1.0 };
        self.scales_of_state()[index] + share * value.abs()
    }

    fn state_name(&self, index: usize) -> String {
        self.entry_name(index)
    }

    fn event_functions(&self, modes: &Modes, out: &mut Vec<EventFunction>) {
        self.frozen.event_functions(&modes.0, out);
    }

    fn switch(
        &self,
        time: f64,
        y: &mut [f64],
        watch: &EventFunction,
        modes: &mut Modes,
    ) -> Result<Option<Impact>, PhysicalStop> {
        self.pass_switch(time, y, watch, modes)
    }

    fn probes(&self, modes: &Modes, out: &mut Vec<Probe>) {
        out.clear();
        self.frozen.probes(&modes.0, out);
        if self.frozen.impacts {
            self.frozen.probe_held(&modes.0, out);
        }
        dry_friction::probes(&self.frozen, &modes.0, out);
    }

    fn probe(
        &self,
        probe: &Probe,
        time: f64,
        y: &mut [f64],
        modes: &Modes,
        scratch: &mut Scratch,
    ) -> f64 {
        let work = &mut scratch.work;
        if let Some(dry) = probe
            .index
            .checked_sub(dry_friction::first_probe(&self.frozen))
        {
            return dry_friction::excess(&self.frozen, dry, (time, y), &modes.0, work);
        }
        match probe.index.checked_sub(self.frozen.friction_group_count()) {
            Some(contact) => self.frozen.parting(contact, time, y, &modes.0, work),
            None => self.frozen.probe(probe, time, y, &modes.0, work),
        }
    }

    fn longest_step(&self, modes: &Modes) -> f64 {
        let given = match self.frozen.rigid_given.is_empty() {
            true => f64::INFINITY,
            false => LONGEST_GIVEN * self.laws_sampled().given_time,
        };
        let longest = match self.frozen.impacts && self.frozen.holds_any(&modes.0) {
            true => given.min(LONGEST_HELD * super::scales::quickest(self.laws_sampled())),
            false => given,
        };
        // (At rest no state tells how the forces change.)
        let rests = self
            .frozen
            .dry
            .iter()
            .any(|contact| contact.is_stuck(&modes.0));
        match rests && self.frozen.horizon.is_finite() {
            true => longest.min(LONGEST_RESTING * self.frozen.horizon),
            false => longest,
        }
    }

    fn narrow_stretches(&self, from: f64, to: f64, modes: &Modes) -> Vec<Narrow> {
        self.frozen.narrow_stretches(from, to, &modes.0)
    }

    fn has_crossings(&self) -> bool {
        self.frozen.guards > 0
    }

    fn first_crossing(
        &self,
        step: &Step<'_>,
        modes: &Modes,
        end: f64,
        fresh: bool,
        resting: &[UndecidedGuard],
    ) -> Option<(f64, EventFunction)> {
        self.frozen
            .first_guard_crossing(step, &modes.0, end, fresh, resting)
    }

    fn undecided_guards(
        &self,
        time: f64,
        y: &[f64],
        modes: &Modes,
        share: f64,
    ) -> Vec<UndecidedGuard> {
        let errors: Vec<f64> = self.scales().iter().map(|scale| share * scale).collect();
        self.frozen.undecided_guards(time, y, &modes.0, &errors)
    }

    fn obstacle(&self, time: f64, modes: &Modes, scratch: &Scratch) -> Option<PhysicalStop> {
        let work = &scratch.work;
        self.without_value(time, &modes.0, work)
            .or_else(|| self.friction_obstacle(work))
            .or_else(|| self.singular_obstacle(work))
    }

    fn has_edges(&self) -> bool {
        self.frozen.expression_loads().next().is_some()
    }

    fn pole_near(
        &self,
        span: [f64; 2],
        y: &[f64],
        dy: &[f64],
        modes: &Modes,
        scratch: &mut Scratch,
    ) -> Option<PhysicalStop> {
        if !self.may_meet_poles() {
            return None;
        }
        let work = &mut scratch.work;
        let accelerations = &dy[self.frozen.coordinates..];
        self.frozen
            .motion(span[0], y, &modes.0, Extent::Needed, work);
        self.frozen.known_accelerations(accelerations, work);
        self.at_pole(span, &modes.0, work)
    }

    fn passed_over(&self, step: &Step<'_>, modes: &Modes, tolerance: f64) -> Option<f64> {
        self.frozen.passed_over(step, &modes.0, tolerance)
    }

    fn pole_on(&self, step: &Step<'_>, modes: &Modes, end: f64) -> Option<PhysicalStop> {
        self.poles_on(step, &modes.0, end)
    }

    fn given_end(&self, time: f64, modes: &Modes, scratch: &mut Scratch) -> Option<PhysicalStop> {
        if !self.has_edges() {
            return None;
        }
        let work = &mut scratch.work;
        self.frozen.motion(time, &[], &modes.0, Extent::Full, work);
        self.without_value(time, &modes.0, work)
    }

    fn singularities(&self, modes: &Modes, out: &mut Vec<Singularity>) {
        self.frozen.singularities(&modes.0, out);
    }

    fn stop_at(&self, time: f64, edge: &Singularity) -> PhysicalStop {
        self.end_of_reach(time, edge)
    }

    /// (A displacement is known no better than the deviation that it is the sum of.)
    fn scales_of_signal(&self, signal: usize) -> Option<[f64; 2]> {
        let n = self.frozen.coordinates;
        let own = match signal.checked_sub(n) {
            None => signal,
            Some(extra) => self.frozen.coordinate[*self.frozen.extra.get(extra)?]?,
        };
        let scales = self.scales();
        Some([scales[own], scales[n + own]])
    }

    fn given_signal(&self, signal: usize, time: f64) -> Option<[f64; 2]> {
        let extra = signal.checked_sub(self.frozen.coordinates)?;
        let node = *self.frozen.extra.get(extra)?;
        let motion = self.frozen.steps.iter().find_map(|step| match step {
            Pass::Prescribed(drive) if drive.node == node => Some(&drive.motion),
            _ => None,
        })?;
        let jet = motion.jet(motion.breaks().segment_at(time, 1.0), time);
        Some([jet.value, jet.first])
    }

    fn next_break(&self, time: f64, modes: &Modes) -> f64 {
        self.frozen.next_break(time, &modes.0)
    }

    fn pass_break(&self, time: f64, modes: &mut Modes) {
        self.frozen.pass_break(time, &mut modes.0);
    }

    fn is_rigid_contact(&self, component: usize) -> bool {
        self.frozen.is_rigid(component)
    }

    fn is_pair(&self, component: usize) -> bool {
        component < self.frozen.contacts()
    }
}
