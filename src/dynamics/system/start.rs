//! The state at t = 0.

use super::balance::{Balance, BalanceState};
use super::dry_friction;
use super::passes::{Extent, Work};
use super::placing::Side;
use super::{InitialState, System};
use crate::dynamics::integrate::Modes;
use crate::dynamics::model::{Closure, ExplicitStart, NodeIndex, Start};
use crate::fault::Fault;
use crate::units::shown;

/// Share of a speed that is nothing but the rounding of two formulas.
const ROUNDING: f64 = 1e-12;

impl System {
    /// State just after t = 0, as the model's `start` asks.
    ///
    /// # Errors
    /// No static balance, a start outside the reach of a position function, an
    /// explicit state that does not fit its objects or is not finite.
    pub fn initial_state(&self) -> Result<InitialState, Vec<Fault>> {
        let mut state = self.place_at_start()?;
        let (y, modes) = (&state.y, &mut state.modes.0);
        let noise = self.start_noise(y, modes);
        self.settle_pairs(y, &noise, modes);
        // A rotor at rest on an edge leaves it by its acceleration, which the
        // pairs have a say in.
        self.frozen.locate_tracks(y, modes);
        self.frozen.settle_points(&mut state.y, &state.modes.0);
        self.settle_directions(&mut state.y, &mut state.modes.0);
        dry_friction::settle(self, &mut state.y, &mut state.modes.0);
        self.frozen.settle_sides(0.0, &state.y, &mut state.modes.0);
        Ok(state)
    }

    /// The state at t = 0 with the modes that were supposed in finding it, for methods
    /// that find out by themselves what pairs that just touch do next: developing the
    /// motion for it costs more than many a run.
    ///
    /// # Errors
    /// Those of [`Self::initial_state`].
    pub fn initial_place(&self) -> Result<InitialState, Vec<Fault>> {
        let mut state = self.place_at_start()?;
        self.frozen.locate_tracks(&state.y, &mut state.modes.0);
        self.frozen.settle_points(&mut state.y, &state.modes.0);
        Ok(state)
    }

    fn place_at_start(&self) -> Result<InitialState, Vec<Fault>> {
        let mut warnings = Vec::new();
        let mut modes = self.frozen.no_modes();
        let mut y = match &self.model.start {
            Start::OnLaw => self.explicit_state(&[], &mut modes)?,
            Start::Explicit(starts) => self.explicit_state(starts, &mut modes)?,
            Start::State(state) => state.clone(),
            Start::Static => {
                let balanced = self.balanced(Side::After, Balance::Static, &mut modes)?;
                self.warn_of_inertia(&balanced, &modes, &mut warnings);
                balanced.state
            }
            Start::Kinetostatic => self.quiet_start(&mut modes, &mut warnings)?,
        };
        self.check_start(&y, &modes)?;
        if self.frozen.impacts {
            let noise = self.start_noise(&y, &modes);
            self.settle_rigid(&mut y, &noise, &mut modes)?;
        }
        Ok(InitialState {
            y,
            modes: Modes(modes),
            warnings,
        })
    }

    /// The modes in which a state at t = 0 moves on.
    pub fn modes_at_start(&self, y: &[f64]) -> Modes {
        let mut modes = self.frozen.no_modes();
        self.frozen.locate_tracks(y, &mut modes);
        let noise: Vec<f64> = y.iter().map(|entry| entry.abs()).collect();
        if self.frozen.impacts {
            // (Of a state on the way, which stands within no flank but by rounding.)
            let _ = self.settle_rigid(&mut y.to_vec(), &noise, &mut modes);
        }
        self.settle_pairs(y, &noise, &mut modes);
        self.frozen.locate_tracks(y, &mut modes);
        Modes(modes)
    }

    /// The quiet start: on the side of t = 0 that the motion comes from. A law that
    /// repeats has one, and what it asks for there may differ from what it asks for next:
    /// out of a dwell nothing is deflected by inertia yet.
    fn quiet_start(
        &self,
        modes: &mut [i64],
        warnings: &mut Vec<String>,
    ) -> Result<Vec<f64>, Vec<Fault>> {
        let (mut after, mut before) = (modes.to_vec(), modes.to_vec());
        let law = self.frozen.law_state();
        self.frozen.locate_tracks_on(Side::After, &law, &mut after);
        self.frozen
            .locate_tracks_on(Side::Before, &law, &mut before);
        if after == before {
            return self.kinetostatic(Side::After, modes);
        }
        let mut start = self.kinetostatic(Side::Before, &mut before)?;
        self.keep_speeds(&before, &after, &mut start);
        let ahead = self.kinetostatic(Side::After, &mut after);
        let others = self.starts_apart(&start, ahead.as_deref().ok());
        modes.copy_from_slice(&after);
        modes[..self.frozen.contacts()].copy_from_slice(&before[..self.frozen.contacts()]);
        if !others.is_empty() {
            warnings.push(from_before(&others));
        }
        Ok(start)
    }

    /// Speeds are those of the masses: where the slope of a law jumps, the rates of the
    /// deviations do.
    fn keep_speeds(&self, before: &[i64], after: &[i64], state: &mut [f64]) {
        let frozen = &self.frozen;
        let n = frozen.coordinates;
        let mut work = Work::new(frozen);
        frozen.motion(0.0, state, before, Extent::Full, &mut work);
        let speeds: Vec<f64> = work.laws.iter().map(|law| law.speed).collect();
        frozen.motion(0.0, state, after, Extent::Full, &mut work);
        for chain in &frozen.chains {
            let speed = work.laws[chain.law].speed;
            let jump = speed - speeds[chain.law];
            if jump.abs() <= ROUNDING * speed.abs().max(speeds[chain.law].abs()) {
                continue;
            }
            for coordinate in chain.coordinates() {
                state[n + coordinate] -= jump;
            }
            // A chain that follows this one sees the speeds that it has by now.
            frozen.motion(0.0, state, after, Extent::Full, &mut work);
        }
    }

    /// The objects that a state starts otherwise than another does, by more than rounding;
    /// without another, all that have a state.
    fn starts_apart(&self, one: &[f64], other: Option<&[f64]>) -> Vec<&str> {
        let sizes = self.scales_of_state();
        let differs = |index: usize| {
            other.is_none_or(|other| {
                let (a, b) = (one[index], other[index]);
                (a - b).abs() > 1e-9 * (sizes[index] + a.abs().max(b.abs()))
            })
        };
        let n = self.frozen.coordinates;
        let chains = self.frozen.chains.iter().enumerate();
        let apart = chains.filter(|(_, chain)| {
            let mut own = chain.coordinates();
            own.any(|index| differs(index) || differs(n + index))
        });
        let objects = &self.model.objects;
        let names = apart.map(|(index, _)| objects[self.part_of_chain(index)].id.as_str());
        names.collect()
    }

    /// Deflections and their rates under all loads on a side of t = 0.
    fn kinetostatic(&self, side: Side, modes: &mut [i64]) -> Result<Vec<f64>, Vec<Fault>> {
        let mut state = self.balanced(side, Balance::Kinetostatic, modes)?.state;
        let n = self.frozen.coordinates;
        let rate = self
            .frozen
            .balance_rate(Balance::Kinetostatic, &state, modes)
            .ok_or_else(|| vec![no_rate()])?;
        for chain in &self.frozen.chains {
            for coordinate in chain.coordinates() {
                state[n + coordinate] = rate[coordinate];
            }
        }
        Ok(state)
    }

    /// Balance, with the flanks and the segments of tracks that belong to it.
    fn balanced(
        &self,
        side: Side,
        kind: Balance,
        modes: &mut [i64],
    ) -> Result<BalanceState, Vec<Fault>> {
        let frozen = &self.frozen;
        let mut balanced = frozen
            .settle_on(side, kind, modes)
            .ok_or_else(|| vec![self.no_balance(modes)])?;
        let mut faults = Vec::new();
        for (index, chain) in frozen.chains.iter().enumerate() {
            let reaction = balanced.reactions[index];
            if frozen.lies_on_stop(index, modes) {
                continue;
            }
            let open = frozen.pair_mode(chain, modes) == super::pairs::OPEN;
            if chain.contact.closure == Closure::Force && open && reaction != 0.0 {
                faults.push(self.pulled_open(kind, index, reaction));
            }
            if open && reaction == 0.0 {
                // The middle of the gap, not the rounding that Newton leaves.
                balanced.state[chain.first_coordinate] = 0.0;
            }
        }
        if faults.is_empty() {
            Ok(balanced)
        } else {
            Err(faults)
        }
    }

    /// A state given by absolute displacements and speeds; what is not given
    /// is on its law.
    fn explicit_state(
        &self,
        starts: &[ExplicitStart],
        modes: &mut [i64],
    ) -> Result<Vec<f64>, Vec<Fault>> {
        let faults: Vec<Fault> = starts
            .iter()
            .filter_map(|start| self.misfit(start))
            .collect();
        if !faults.is_empty() {
            return Err(faults);
        }
        let frozen = &self.frozen;
        let mut given: Vec<Option<(f64, f64)>> = vec![None; frozen.inertia.len()];
        for start in starts {
            let nodes = &self.model.objects[start.object].nodes;
            for (m, &node) in nodes.iter().enumerate() {
                given[frozen.internal[node]] = Some((start.displacement[m], start.speed[m]));
            }
        }
        let mut state = frozen.law_state();
        // Each round gives the right segments one driver further on.
        for _ in 0..=frozen.tracks.len() + 1 {
            frozen.place_given(&given, modes, &mut state);
            let before = modes.to_vec();
            frozen.locate_tracks(&state, modes);
            if *modes == before {
                break;
            }
        }
        frozen.rest_points(&mut state);
        Ok(state)
    }

    /// Fault of an explicit start, if it has one.
    fn misfit(&self, start: &ExplicitStart) -> Option<Fault> {
        let part = self.model.objects.get(start.object)?;
        let path = format!("run.start.{}", part.id);
        let masses = part.nodes.len();
        let free = self.last_coordinate(start.object).is_some();
        if !free {
            let message = format!(
                "`{}` has no state of its own: its driver or its motion determines it",
                part.id
            );
            return Some(Fault::new(path, message, "leave it out of the start"));
        }
        if start.displacement.len() != masses || start.speed.len() != masses {
            return Some(Fault::new(
                path,
                format!(
                    "{} displacements and {} speeds for {masses} masses",
                    start.displacement.len(),
                    start.speed.len()
                ),
                format!("{masses} of each"),
            ));
        }
        let mut numbers = start.displacement.iter().chain(&start.speed);
        if numbers.all(|number| number.is_finite()) {
            return None;
        }
        Some(Fault::new(path, "a number that is not finite", ""))
    }

    /// The start must be finite and within the reach of every law.
    fn check_start(&self, y: &[f64], modes: &[i64]) -> Result<(), Vec<Fault>> {
        let frozen = &self.frozen;
        let mut work = Work::new(frozen);
        frozen.motion(0.0, y, modes, Extent::Full, &mut work);
        let mut faults = Vec::new();
        for part in &self.model.objects {
            let node = frozen.internal[part.nodes[0]];
            let law = frozen.law_of_node(node);
            let outside = law.is_some_and(|law| {
                !frozen.laws[law].is_defined_at(work.displacement[frozen.laws[law].driver])
            });
            if outside {
                let place = law.map_or(0.0, |law| work.displacement[frozen.laws[law].driver]);
                faults.push(Fault::new(
                    format!("{}.position", part.id),
                    format!(
                        "at t = 0 the driver is at {}, outside the range of motion of this \
                         position function",
                        shown(place, 7)
                    ),
                    "another position of the drive at t = 0",
                ));
            } else if !(work.displacement[node].is_finite() && work.speed[node].is_finite()) {
                faults.push(Fault::new(
                    format!("{}.position", part.id),
                    "the state at t = 0 is not finite",
                    "",
                ));
            }
        }
        if y.iter().any(|value| !value.is_finite()) && faults.is_empty() {
            faults.push(Fault::new(
                "run.start",
                "the state at t = 0 is not finite",
                "",
            ));
        }
        if faults.is_empty() {
            Ok(())
        } else {
            Err(faults)
        }
    }

    /// Size of the numbers whose rounding is in each state entry. A deviation
    /// of exactly zero carries none.
    fn start_noise(&self, y: &[f64], modes: &[i64]) -> Vec<f64> {
        let mut noise: Vec<f64> = y.iter().map(|entry| entry.abs()).collect();
        if let Start::Explicit(starts) = &self.model.start {
            // u = φ − U carries the rounding of φ.
            let mut work = Work::new(&self.frozen);
            self.frozen.motion(0.0, y, modes, Extent::Full, &mut work);
            let n = self.frozen.coordinates;
            for start in starts {
                for &node in &self.model.objects[start.object].nodes {
                    let node = self.frozen.internal[node];
                    if let Some(coordinate) = self.frozen.coordinate[node] {
                        noise[coordinate] += work.displacement[node].abs();
                        noise[n + coordinate] += work.speed[node].abs();
                    }
                }
            }
        }
        noise
    }

    /// Index of the object that a chain belongs to.
    pub(super) fn part_of_chain(&self, chain: usize) -> usize {
        let is = |place: &super::ObjectPlace| matches!(place.body, super::Body::Chain(index) if index == chain);
        self.places.iter().position(is).unwrap_or(0)
    }
}

impl System {
    /// Why there is no balance: a load that has no value where every mass is on its law, or
    /// nothing that could be told.
    fn no_balance(&self, modes: &[i64]) -> Fault {
        let on_law = vec![0.0; 2 * self.frozen.coordinates];
        let mut work = Work::new(&self.frozen);
        self.frozen
            .motion(0.0, &on_law, modes, Extent::Full, &mut work);
        let motion = |node: NodeIndex| {
            let node = self.frozen.internal[node];
            (work.displacement[node], work.speed[node])
        };
        let mut loads = self.model.loads.iter();
        let without = loads.find_map(|load| {
            let written = load.law.expression_load()?;
            let force = written.force(0.0, motion);
            (!force.is_finite()).then_some((load, written))
        });
        match without {
            None => no_balance(),
            Some((load, written)) => Fault::new(
                format!("{}.expression", load.name),
                format!(
                    "\"{}\" has no finite value at t = 0 where every object is on its law",
                    written.expression.text()
                ),
                "a function that is finite at the start, or a condition before what is not: \
                 `phi > 0 ? log(phi) : 0`",
            ),
        }
    }
}

/// Warning that objects start from the side before t = 0.
fn from_before(objects: &[&str]) -> String {
    let named: Vec<String> = objects.iter().map(|id| format!("`{id}`")).collect();
    format!(
        "the derivatives of a law that repeats differ on the two sides of t = 0: {} {} from the \
         side before t = 0",
        named.join(", "),
        match objects.len() {
            1 => "starts",
            _ => "start",
        }
    )
}

fn no_rate() -> Fault {
    Fault::new(
        "run.start",
        "the deflection in balance changes infinitely fast at t = 0, as a load does: there is no \
         speed to start with",
        "\"start\": \"static\" or \"on_law\"",
    )
}

fn no_balance() -> Fault {
    Fault::new(
        "run.start",
        "no balance of loads and links was found at t = 0",
        "\"start\": \"on_law\", or softer load springs",
    )
}
