//! The state at t = 0.

use super::balance::{Balance, Balanced, resting_mode};
use super::frozen::{Chain, Frozen, Step};
use super::passes::{Extent, Work};
use super::{InitialState, System};
use crate::fault::Fault;
use crate::integrate::Modes;
use crate::model::{Closure, DampingLaw, ExplicitStart, LinkBase, LoadLaw, Start};

/// A static start that leaves out more than this share of the static load is
/// warned of.
const LEFT_OUT: f64 = 0.01;

impl System {
    /// State just after t = 0, as the model's `start` asks.
    ///
    /// # Errors
    /// No static balance, a start outside the reach of a position function, an
    /// explicit state that does not fit its objects or is not finite.
    pub fn initial_state(&self) -> Result<InitialState, Vec<Fault>> {
        let mut warnings = Vec::new();
        let mut modes = self.frozen.no_modes();
        let y = match &self.model.start {
            Start::OnLaw => self.explicit_state(&[], &mut modes)?,
            Start::Explicit(starts) => self.explicit_state(starts, &mut modes)?,
            Start::Static => {
                let balanced = self.balanced(Balance::Static, &mut modes)?;
                self.warn_of_inertia(&balanced, &modes, &mut warnings);
                balanced.state
            }
            Start::Kinetostatic => self.kinetostatic(&mut modes)?,
        };
        self.check_start(&y, &modes)?;
        let noise = self.start_noise(&y, &modes);
        self.settle_pairs(&y, &noise, &mut modes);
        // A rotor at rest on an edge leaves it by its acceleration, which the
        // pairs have a say in.
        self.frozen.locate_tracks(&y, &mut modes);
        Ok(InitialState {
            y,
            modes: Modes(modes),
            warnings,
        })
    }

    /// The quiet start.
    fn kinetostatic(&self, modes: &mut [i64]) -> Result<Vec<f64>, Vec<Fault>> {
        let mut state = self.balanced(Balance::Kinetostatic, modes)?.state;
        let n = self.frozen.coordinates;
        let rate = self
            .frozen
            .balance_rate(Balance::Kinetostatic, &state, modes)
            .ok_or_else(|| vec![no_balance()])?;
        for chain in &self.frozen.chains {
            for coordinate in chain.coordinates() {
                state[n + coordinate] = rate[coordinate];
            }
        }
        Ok(state)
    }

    /// Balance, with the flanks and the segments of tracks that belong to it.
    fn balanced(&self, kind: Balance, modes: &mut [i64]) -> Result<Balanced, Vec<Fault>> {
        let frozen = &self.frozen;
        let mut balanced = frozen
            .settle(kind, modes)
            .ok_or_else(|| vec![no_balance()])?;
        let mut faults = Vec::new();
        for (index, chain) in frozen.chains.iter().enumerate() {
            let reaction = balanced.reactions[index];
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

    /// The loads of a force-closed pair pull it open.
    fn pulled_open(&self, kind: Balance, chain: usize, reaction: f64) -> Fault {
        let part = self.part_of_chain(chain);
        let id = self.model.objects[part].id.clone();
        let state = self.frozen.law_state();
        let mut modes = self.frozen.no_modes();
        self.frozen.locate_tracks(&state, &mut modes);
        let culprit = self
            .resting_loads(part, &state, &modes)
            .into_iter()
            .filter(|(_, force)| force * reaction > 0.0)
            .max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
        let static_force = self.frozen.link_forces(Balance::Static, &state, &modes)[chain];
        let by_inertia = kind == Balance::Kinetostatic && static_force * reaction <= 0.0;
        match culprit {
            _ if by_inertia => Fault::new(
                format!("{id}.pair"),
                format!(
                    "no quiet start: at t = 0 the inertia load pulls the pair of `{id}` open \
                     with {reaction:.6e}"
                ),
                "a greater closing force, another position at t = 0, or \"start\": \"on_law\"",
            ),
            Some((name, force)) => Fault::new(
                name.clone(),
                format!(
                    "no static balance: `{name}` ({force:.6e}) pulls the force-closed pair of \
                     `{id}` open"
                ),
                "a load that closes the pair, \"opens\" turned round, or \"start\": \"on_law\"",
            ),
            None => Fault::new(
                format!("{id}.pair"),
                format!(
                    "no static balance: the reactions of its followers pull the force-closed \
                     pair of `{id}` open with {reaction:.6e}"
                ),
                "a load that closes the pair, or \"start\": \"on_law\"",
            ),
        }
    }

    /// Name and force of the loads of an object that a body at rest feels.
    fn resting_loads(&self, part: usize, state: &[f64], modes: &[i64]) -> Vec<(String, f64)> {
        let mut work = Work::new(&self.frozen);
        self.frozen
            .motion(0.0, state, modes, Extent::Full, &mut work);
        let mut varying = 0;
        let mut forces = Vec::new();
        for load in &self.model.loads {
            let constant = matches!(load.law, LoadLaw::Constant(_));
            let force = match load.law {
                LoadLaw::Constant(force) => force,
                _ => self.frozen.load(varying, 0.0, modes, &work),
            };
            varying += usize::from(!constant);
            let own = self.model.objects[part].nodes.contains(&load.node);
            if own && !super::loads::needs_speed(&load.law) {
                forces.push((load.name.clone(), force));
            }
        }
        forces
    }

    fn warn_of_inertia(&self, balanced: &Balanced, modes: &[i64], warnings: &mut Vec<String>) {
        let with = self
            .frozen
            .link_forces(Balance::Kinetostatic, &balanced.state, modes);
        for (chain, &force) in balanced.reactions.iter().enumerate() {
            let left_out = with[chain] - force;
            if left_out.abs() > LEFT_OUT * force.abs() {
                let part = &self.model.objects[self.part_of_chain(chain)];
                let unit = match part.coordinate {
                    crate::model::Coordinate::Turning => "N m",
                    crate::model::Coordinate::Sliding => "N",
                };
                warnings.push(format!(
                    "{}: the static start leaves out an inertia load of {left_out:.4e} {unit} \
                     (static load {force:.4e} {unit}), so the run begins with a vibration; \
                     \"start\": \"kinetostatic\" includes it",
                    part.id
                ));
            }
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
        Ok(state)
    }

    /// What is wrong with an explicit start.
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
                !frozen.laws[law].reaches(work.displacement[frozen.laws[law].driver])
            });
            if outside {
                let place = law.map_or(0.0, |law| work.displacement[frozen.laws[law].driver]);
                faults.push(Fault::new(
                    format!("{}.position", part.id),
                    format!("at t = 0 the driver is at {place:.6}, outside the reach of this position function"),
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

    /// κ of Hunt–Crossley pairs that leave it open: b₁/(c₁·p*) = b₁/|F| with F
    /// the static force of the pair.
    pub(super) fn find_kappas(&mut self) -> Result<(), Vec<Fault>> {
        let open = |link: &crate::model::Link| {
            matches!(&link.base, LinkBase::Law { pair }
                if pair.closure != Closure::Bilateral
                    && pair.law == DampingLaw::HuntCrossley { kappa: None })
        };
        let links: Vec<usize> = (0..self.model.links.len())
            .filter(|&link| open(&self.model.links[link]))
            .collect();
        if links.is_empty() {
            return Ok(());
        }
        let mut modes = self.frozen.no_modes();
        let balanced = self.frozen.settle(Balance::Static, &mut modes);
        let mut faults = Vec::new();
        for link in links {
            let link = &self.model.links[link];
            let node = self.frozen.internal[link.mass];
            let Some(index) =
                (self.frozen.chains.iter()).position(|chain| chain.first_node == node)
            else {
                continue;
            };
            let force = balanced
                .as_ref()
                .map_or(0.0, |balanced| balanced.reactions[index]);
            let chain = &mut self.frozen.chains[index];
            if resting_mode(chain, force) == super::pairs::OPEN {
                let object = super::check::object_of(&self.model, link.mass);
                faults.push(Fault::new(
                    format!("{object}.pair.kappa"),
                    "κ cannot be found from the static penetration: no load presses the pair at t = 0",
                    "give \"kappa\" in seconds per unit of penetration",
                ));
                continue;
            }
            chain.contact.kappa = Some(link.damping / force.abs());
        }
        if faults.is_empty() {
            Ok(())
        } else {
            Err(faults)
        }
    }
}

fn no_balance() -> Fault {
    Fault::new(
        "run.start",
        "no balance of loads and links was found at t = 0",
        "\"start\": \"on_law\", or softer load springs",
    )
}

impl Frozen {
    /// Modes with every pair open and every track in segment 0.
    pub(super) fn no_modes(&self) -> Vec<i64> {
        vec![0; self.pairs.len() + self.tracks.len()]
    }

    /// The state on the law: u = 0, u̇ = 0, rotors at their start.
    pub(super) fn law_state(&self) -> Vec<f64> {
        let mut state = vec![0.0; 2 * self.coordinates];
        for step in &self.steps {
            if let Step::Rotor(rotor) = step {
                state[rotor.coordinate] = rotor.angle;
                state[self.coordinates + rotor.coordinate] = rotor.speed;
            }
        }
        state
    }

    /// The law that a node follows.
    pub(super) fn law_of_node(&self, node: usize) -> Option<usize> {
        let rigid = self.rigids.iter().find(|rigid| rigid.node == node);
        let of_chain = |chain: &&Chain| chain.nodes().contains(&node);
        rigid
            .map(|rigid| rigid.law)
            .or_else(|| self.chains.iter().find(of_chain).map(|chain| chain.law))
    }

    /// Balance from the law on, with the modes that belong to it.
    fn settle(&self, kind: Balance, modes: &mut [i64]) -> Option<Balanced> {
        let mut state = self.law_state();
        self.locate_tracks(&state, modes);
        // Each round may change flanks and segments; a balance that depends on
        // them so that it never settles is none.
        for _ in 0..8 + 2 * modes.len() {
            let balanced = self.balance(kind, &state, modes)?;
            let before = modes.to_vec();
            for (component, &chain) in self.pairs.iter().enumerate() {
                modes[component] = resting_mode(&self.chains[chain], balanced.reactions[chain]);
            }
            self.locate_tracks(&balanced.state, modes);
            if *modes == before {
                return Some(balanced);
            }
            state = balanced.state;
        }
        None
    }

    /// Turns given absolute displacements and speeds of nodes into a state.
    fn place_given(&self, given: &[Option<(f64, f64)>], modes: &[i64], state: &mut [f64]) {
        let mut work = Work::new(self);
        let n = self.coordinates;
        for step in &self.steps {
            // Everything before this step is in its place by now.
            match step {
                Step::Prescribed(_) | Step::Rigid(_) => {}
                Step::Rotor(rotor) => {
                    if let Some((displacement, speed)) = given[rotor.node] {
                        state[rotor.coordinate] = displacement;
                        state[n + rotor.coordinate] = speed;
                    }
                }
                Step::Chain(index) => {
                    let chain = &self.chains[*index];
                    self.motion(0.0, state, modes, Extent::Full, &mut work);
                    let law = work.laws[chain.law];
                    for (node, coordinate) in chain.nodes().zip(chain.coordinates()) {
                        if let Some((displacement, speed)) = given[node] {
                            state[coordinate] = displacement - law.value;
                            state[n + coordinate] = speed - law.speed;
                        }
                    }
                }
            }
        }
    }

    /// Sets every track to the segment in which the state at t = 0 moves on.
    pub(super) fn locate_tracks(&self, state: &[f64], modes: &mut [i64]) {
        if self.tracks.is_empty() {
            return;
        }
        let mut work = Work::new(self);
        let mut out = vec![0.0; self.coordinates];
        // Each round gives the right segments one driver further on.
        for _ in 0..=self.tracks.len() {
            self.evaluate(0.0, state, modes, Extent::Full, &mut work, &mut out);
            for (index, track) in self.tracks.iter().enumerate() {
                let (place, sense) = match track.node {
                    None => (0.0, 1.0),
                    Some(node) => {
                        let speed = work.speed[node];
                        let moving = if speed == 0.0 {
                            work.acceleration[node]
                        } else {
                            speed
                        };
                        (work.displacement[node], moving)
                    }
                };
                let component = self.track_component(index);
                if place.is_finite() {
                    modes[component] = track.breaks.locate(place, sense);
                }
            }
        }
    }
}
