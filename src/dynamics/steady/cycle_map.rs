//! Moments that depend on speed: the motion that comes back to its speed.
//!
//! The energy theorem dT/dφ = M(φ, √(2T/J)) carries the kinetic energy over a
//! cycle; a steady motion is a fixed point of T(0) → T(Φ). Its multiplier says
//! how much of a small disturbance is left after a cycle: below 1 others
//! settle on it.

mod regime;

use super::extrapolation::{attempt_step, integrate_stretch};
use super::given::FunctionKind;
use super::motion::SteadyMotion;
use super::profile::Profile;
use super::refusal::Refusal;
use super::{Question, motion};
use crate::math::roots::bracketed;
use serde::Serialize;

/// The machine at a position and speed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Load {
    /// J (kg·m²).
    pub inertia: f64,
    /// M (N·m).
    pub moment: f64,
    /// ∂M/∂ω.
    pub moment_by_speed: f64,
    /// Sum of the magnitudes of the single moments (N·m); 0 where it is not known.
    pub gross_moment: f64,
}

/// A machine whose moment depends on position and speed.
pub struct Machine<'a> {
    /// Φ (rad).
    pub cycle: f64,
    /// Places inside the cycle at which a formula changes, ascending.
    pub breaks: Vec<f64>,
    /// Speeds at which the moment has a kink, ascending.
    pub kinks: Vec<f64>,
    /// J and M at a position and a speed ≥ 0; the piece between two breaks by
    /// its number.
    pub at: &'a dyn Fn(usize, f64, f64) -> Load,
}

/// End of a cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct CycleEnd {
    /// T after the cycle (J).
    pub energy: f64,
    /// Duration of the cycle (s).
    pub period: f64,
    /// dT(Φ)/dT(0).
    pub multiplier: f64,
}

/// The steady motion of a machine with a characteristic.
#[derive(Clone, Debug, Serialize)]
pub struct Regime {
    /// T at φ = 0 (J).
    pub energy: f64,
    /// ω at φ = 0 (rad/s).
    pub speed: f64,
    /// Duration of a cycle (s).
    pub period: f64,
    /// Mean over time (rad/s).
    pub mean_speed: f64,
    /// Multiplier: the share of a small disturbance of T that is left after a cycle.
    pub multiplier: f64,
    /// True when a small disturbance dies away.
    pub attracts: bool,
    /// Cycles followed in finding it.
    pub cycles: u32,
    /// |T(Φ)/T(0) − 1| left.
    pub miss: f64,
    /// Means of other steady motions found (rad/s), descending.
    pub others: Vec<f64>,
}

/// Relative tolerance of the integration.
const TOLERANCE: f64 = 1e-13;

/// T, t and ln ∂T/∂T(0) along the cycle.
type State = [f64; 3];

impl Machine<'_> {
    fn pieces(&self) -> impl Iterator<Item = (usize, [f64; 2])> + '_ {
        let ends = (std::iter::once(0.0))
            .chain(self.breaks.iter().copied())
            .chain([self.cycle]);
        let last = ends.clone().skip(1);
        ends.zip(last).map(|(from, to)| [from, to]).enumerate()
    }

    fn rates(&self, piece: usize, position: f64, state: &State) -> Option<State> {
        let energy = state[0];
        if !(energy > 0.0) {
            return None;
        }
        let speed = self.speed(piece, position, energy);
        let load = (self.at)(piece, position, speed);
        let sound = load.moment.is_finite() && load.inertia > 0.0;
        let slope = load.moment_by_speed / (load.inertia * speed);
        sound.then_some([load.moment, 1.0 / speed, slope])
    }

    fn speed(&self, piece: usize, position: f64, energy: f64) -> f64 {
        (2.0 * energy / (self.at)(piece, position, 0.0).inertia).sqrt()
    }

    /// Follows a stretch of a piece, broken where the speed meets a kink.
    fn follow_stretch(&self, piece: usize, ends: [f64; 2], state: &mut State) -> Result<(), f64> {
        let mut f = |position: f64, state: &State| self.rates(piece, position, state);
        let [mut at, to] = ends;
        let mut crossings = 0;
        while at < to {
            let mut next = *state;
            integrate_stretch(&mut f, [at, to], &mut next, TOLERANCE)?;
            let before = self.band(self.speed(piece, at, state[0]));
            let after = self.band(self.speed(piece, to, next[0]));
            // A speed that stays on a kink crosses it by rounding without end.
            if before == after || crossings >= MOST_CROSSINGS {
                *state = next;
                return Ok(());
            }
            // The first kink on the way: to its place, and on behind it.
            let kink = self.kinks[if after > before { before } else { before - 1 }];
            let mut miss =
                |position: f64| match attempt_step(&mut f, at, position - at, state, TOLERANCE) {
                    Some((found, _)) => self.speed(piece, position, found[0]) - kink,
                    None => f64::NAN,
                };
            let found = bracketed(&mut miss, [at, to], 1e-14 * kink.abs());
            let place = match found.miss.is_finite() {
                true if found.at > at => found.at,
                _ => 0.5 * (at + to),
            };
            integrate_stretch(&mut f, [at, place.min(to)], state, TOLERANCE)?;
            // Just behind the kink, so that it is not met again at once.
            let behind = (place + 1e-13 * self.cycle).min(to);
            integrate_stretch(&mut f, [place.min(to), behind], state, TOLERANCE)?;
            at = behind;
            crossings += 1;
        }
        Ok(())
    }

    fn band(&self, speed: f64) -> usize {
        self.kinks.partition_point(|&kink| kink < speed)
    }

    /// Stretches that a piece is followed in.
    fn stretches(&self, [from, to]: [f64; 2]) -> impl Iterator<Item = [f64; 2]> + use<> {
        let count = (STRETCHES * (to - from) / self.cycle).ceil().max(1.0) as usize;
        let place = move |i: usize| match i {
            i if i == count => to,
            i => from + (to - from) * i as f64 / count as f64,
        };
        (0..count).map(move |i| [place(i), place(i + 1)])
    }

    /// Follows a cycle from T(0) = `energy`; `seen` hears the state at the start
    /// of every stretch.
    ///
    /// # Errors
    /// The machine stalls.
    fn follow_cycle(
        &self,
        energy: f64,
        mut seen: impl FnMut(usize, [f64; 2], f64),
    ) -> Result<CycleEnd, Refusal> {
        let mut state = [energy, 0.0, 0.0];
        let start = self.speed(0, 0.0, energy);
        for (piece, ends) in self.pieces() {
            for ends in self.stretches(ends) {
                seen(piece, ends, state[0]);
                self.follow_stretch(piece, ends, &mut state)
                    .map_err(|position| Refusal::Stalls {
                        position,
                        speed: start,
                    })?;
            }
        }
        Ok(CycleEnd {
            energy: state[0],
            period: state[1],
            multiplier: state[2].exp(),
        })
    }

    /// One cycle from T(0) = `energy` (J).
    ///
    /// # Errors
    /// The machine stalls, at a position.
    pub fn cycle(&self, energy: f64) -> Result<CycleEnd, Refusal> {
        self.follow_cycle(energy, |_, _, _| {})
    }

    /// T at a position, from the states kept along a regime.
    fn energy(&self, grid: &[(usize, f64, f64)], position: f64) -> Option<f64> {
        let below = grid.partition_point(|entry| entry.1 <= position).max(1) - 1;
        let (piece, from, energy) = grid[below];
        let mut state = [energy, 0.0, 0.0];
        let reached = position <= from
            || self
                .follow_stretch(piece, [from, position], &mut state)
                .is_ok();
        reached.then_some(state[0])
    }

    /// Piece, place and T at the start of every stretch of a regime.
    fn grid(&self, regime: &Regime) -> Result<Vec<(usize, f64, f64)>, Refusal> {
        let mut grid = Vec::new();
        self.follow_cycle(regime.energy, |piece, [from, _], energy| {
            grid.push((piece, from, energy));
        })?;
        Ok(grid)
    }

    /// ω of a regime at `count` equal steps over the cycle, both ends included,
    /// as the map itself gives them.
    ///
    /// # Errors
    /// A stall.
    pub fn speeds(&self, regime: &Regime, count: usize) -> Result<Vec<f64>, Refusal> {
        let grid = self.grid(regime)?;
        let speed = |i: usize| {
            let position = self.cycle * i as f64 / count as f64;
            let piece = self.breaks.partition_point(|&edge| edge <= position);
            let energy = self.energy(&grid, position).unwrap_or(f64::NAN);
            self.speed(piece, position, energy)
        };
        Ok((0..=count).map(speed).collect())
    }

    /// The machine with the moment of a regime as a function of the position
    /// alone: M(φ, ω(φ)).
    ///
    /// # Errors
    /// As [`Profile::new`]; a stall.
    pub fn profile(&self, regime: &Regime) -> Result<Profile, Refusal> {
        let grid = self.grid(regime)?;
        let mut at = |piece: usize, position: f64| {
            let energy = self.energy(&grid, position).unwrap_or(f64::NAN);
            let speed = self.speed(piece, position, energy);
            let load = (self.at)(piece, position, speed);
            [load.inertia, load.moment]
        };
        let profile = Profile::new(self.cycle, &self.breaks, FunctionKind::Moment, &mut at)?;
        Ok(profile.with_rounding(RETURNED * regime.energy))
    }

    /// The motion of a regime by the energy-mass method: its own moments as
    /// functions of the position, its mean over time asked for.
    ///
    /// # Errors
    /// As [`Machine::profile`] and [`motion::find_steady_motion`].
    pub fn motion(&self, regime: &Regime) -> Result<SteadyMotion, Refusal> {
        motion::find_steady_motion(&self.profile(regime)?, &Question::new(regime.mean_speed))
    }
}

/// Kinks met in a stretch at most.
const MOST_CROSSINGS: u32 = 16;
/// Share of T by which the work of a regime's own moments may differ from zero: the map has
/// come back to its speed already.
const RETURNED: f64 = 1e-11;
/// Stretches in a cycle.
const STRETCHES: f64 = 64.0;
