//! A scene's drive with all that hangs rigidly on it.

mod drive;

pub(super) use drive::nodes_moved_by;
pub use drive::{constant_speed, drive_of, is_elastic};

use super::cycle::AFTER_A_CYCLE;
use crate::dynamics::integrate::Modes;
use crate::dynamics::model::{Load, LoadLaw, Model, NodeMotion};
use crate::dynamics::steady::cycle_map;
use crate::dynamics::steady::{FunctionKind, Profile, Refusal};
use crate::dynamics::system::{Scratch, System};
use crate::fault::Fault;
use drive::backwards;
use std::cell::RefCell;

/// Places at which a turn is looked at for changes of formula, besides those
/// that the drive's own tables name.
const LOOKS: f64 = 2048.0;

/// A machine with one degree of freedom, taken from a scene: its drive turns
/// freely, everything behind it is rigid.
#[derive(Debug)]
pub struct Machine {
    system: System,
    /// The drive, index into the model's objects.
    drive: usize,
    cycle: f64,
    breaks: Vec<f64>,
    /// Modes of each piece between two breaks.
    modes: Vec<Modes>,
    /// Speeds at which a table of torque over speed has its points.
    kinks: Vec<f64>,
    depends_on_speed: bool,
    memory: RefCell<(Scratch, Vec<f64>)>,
}

/// Share of the work of the single moments that is rounding of their sum.
const ROUNDING: f64 = 1e-13;

/// Less inertia than this is none (kg·m²).
const NONE: f64 = 1e-290;

/// Objects with several inputs that move with a drive.
pub(super) fn multi_input_objects(model: &Model, moved: &[bool]) -> Vec<Fault> {
    let parts = model.objects.iter();
    let combined = parts.filter(|part| part.combination.is_some_and(|node| moved[node]));
    combined
        .map(|part| {
            let id = &part.id;
            let message = format!(
                "`{id}` has several inputs: its steady motion does not belong to one drive"
            );
            Fault::new(format!("{id}.inputs"), message, "follow it with `dam run`")
        })
        .collect()
}

/// Loads over time on what moves with a drive.
pub(super) fn over_time(model: &Model, moved: &[bool]) -> Vec<Fault> {
    let timed = |load: &&Load| load.law.needs_time(&model.tracks);
    let loads = model.loads.iter().filter(|load| moved[load.node]);
    loads
        .filter(timed)
        .map(|load| {
            let message = "a load over time repeats with no cycle of the machine";
            let hint = "a table over the driver's position: `position_table` or `window`";
            Fault::new(&load.name, message, hint)
        })
        .collect()
}

/// Faults of objects and loads that have no place in the method.
fn obstacles(model: &Model, moved: &[bool]) -> Vec<Fault> {
    let mut faults = multi_input_objects(model, moved);
    for part in &model.objects {
        let node = part.nodes[0];
        let combined = part.combination.is_some_and(|node| moved[node]);
        let elastic = matches!(model.nodes[node].motion, NodeMotion::Mass { .. });
        if !combined && moved[node] && elastic {
            let message = format!(
                "`{}` is elastic: a machine is reduced to its drive where all objects behind it \
                 are rigid",
                part.id
            );
            let hint = "\"masses\": 0 for the energy-mass method";
            faults.push(Fault::new(format!("{}.masses", part.id), message, hint));
        }
    }
    faults.extend(over_time(model, moved));
    faults
}

/// Speeds at which tables over the speed of a node have their points, ascending.
fn kinks(model: &Model, node: usize) -> Vec<f64> {
    let mut found: Vec<f64> = Vec::new();
    for load in model.loads.iter().filter(|load| load.node == node) {
        let corners = load.law.function().map_or(&[][..], |own| own.corners());
        let speeds = corners.iter().map(|corner| corner.0);
        found.extend(speeds.filter(|&speed| speed > 0.0));
    }
    found.sort_by(f64::total_cmp);
    found.dedup();
    found
}

impl Machine {
    /// The machine behind a drive of a model, over a cycle (rad).
    ///
    /// # Errors
    /// Everything that stands against it: elastic objects, loads over time,
    /// positions out of reach, a J that the cycle does not bring back.
    pub fn new(model: &Model, drive: usize, cycle: f64) -> Result<Self, Vec<Fault>> {
        let node = model.objects[drive].nodes[0];
        let moved = nodes_moved_by(model, node);
        let mut faults = obstacles(model, &moved);
        faults.extend(backwards(model, drive));
        if !faults.is_empty() {
            return Err(faults);
        }
        let system = System::new(freed(model, drive, 0.0, 1.0, [0.0; 2]))?;
        let scratch = crate::dynamics::integrate::Dynamics::scratch(&system);
        let (state, _) = system.rotor_state(drive, 0.0, 1.0);
        let loads = model.loads.iter().filter(|load| moved[load.node]);
        let mut machine = Self {
            depends_on_speed: loads.map(|load| &load.law).any(needs_speed),
            kinks: kinks(model, node),
            drive,
            cycle,
            breaks: Vec::new(),
            modes: Vec::new(),
            memory: RefCell::new((scratch, state)),
            system,
        };
        machine.find_breaks()?;
        machine.depends_on_speed |= machine.is_damped();
        machine.check_cycle()?;
        Ok(machine)
    }

    fn modes_at(&self, position: f64) -> Modes {
        self.system.rotor_state(self.drive, position, 1.0).1
    }

    /// Finds the positions at which any mode changes.
    fn find_breaks(&mut self) -> Result<(), Vec<Fault>> {
        let looks = (LOOKS * (self.cycle / std::f64::consts::TAU).max(1.0)).ceil() as usize;
        let steps = (0..=looks).map(|i| self.cycle * i as f64 / looks as f64);
        let mut places: Vec<f64> = steps.collect();
        places.extend(self.system.rotor_breaks(self.drive, self.cycle));
        places.sort_by(f64::total_cmp);
        places.dedup();
        let all: Vec<Modes> = places.iter().map(|&place| self.modes_at(place)).collect();
        if let Some(object) = all
            .iter()
            .find_map(|modes| self.system.beyond_reach(&all[0], modes))
        {
            let id = &self.system.model().objects[object].id;
            let message = "it cannot be assembled over the whole cycle of its drive";
            let hint = "a mechanism that turns fully, or swings within its range of motion";
            return Err(vec![Fault::new(format!("{id}.position"), message, hint)]);
        }
        let mut breaks = Vec::new();
        for (ends, modes) in places.windows(2).zip(all.windows(2)) {
            self.find_mode_changes([ends[0], ends[1]], [&modes[0], &modes[1]], &mut breaks);
        }
        breaks.retain(|&place| place > 0.0 && place < self.cycle);
        breaks.dedup();
        let ends: Vec<f64> = (std::iter::once(0.0))
            .chain(breaks.iter().copied())
            .chain([self.cycle])
            .collect();
        let middles = ends.windows(2).map(|ends| 0.5 * (ends[0] + ends[1]));
        self.modes = middles.map(|middle| self.modes_at(middle)).collect();
        self.breaks = breaks;
        Ok(())
    }

    /// Halves an interval until the modes at its ends are neighbours.
    fn find_mode_changes(
        &self,
        [from, to]: [f64; 2],
        [before, after]: [&Modes; 2],
        breaks: &mut Vec<f64>,
    ) {
        if before == after {
            return;
        }
        let middle = 0.5 * (from + to);
        if middle <= from || middle >= to || to - from < 1e-14 * self.cycle {
            breaks.push(to);
            return;
        }
        let modes = self.modes_at(middle);
        self.find_mode_changes([from, middle], [before, &modes], breaks);
        self.find_mode_changes([middle, to], [&modes, after], breaks);
    }

    /// True when a moment changes with the speed at rest: dampers of linkages,
    /// which are no loads of nodes.
    fn is_damped(&self) -> bool {
        let ends = std::iter::once(0.0).chain(self.breaks.iter().copied());
        ends.enumerate().any(|(piece, from)| {
            let to = self.breaks.get(piece).copied().unwrap_or(self.cycle);
            let places = (0..=16).map(|i| from + (to - from) * f64::from(i) / 16.0);
            let mut slopes = places.map(|place| self.at(piece, place, 0.0).moment_by_speed);
            slopes.any(|slope| slope != 0.0)
        })
    }

    /// Work over a cycle of the magnitudes of the single moments, roughly (J).
    fn gross_work(&self) -> f64 {
        let ends = std::iter::once(0.0).chain(self.breaks.iter().copied());
        let piece = |(piece, from): (usize, f64)| {
            let to = self.breaks.get(piece).copied().unwrap_or(self.cycle);
            let places = (0..32).map(|i| from + (to - from) * (f64::from(i) + 0.5) / 32.0);
            let moments = places.map(|place| self.at(piece, place, 0.0).gross_moment);
            moments.sum::<f64>() * (to - from) / 32.0
        };
        ends.enumerate().map(piece).sum()
    }

    fn check_cycle(&self) -> Result<(), Vec<Fault>> {
        let last = self.modes.len() - 1;
        let [start, end] = [
            self.at(0, 0.0, 0.0).inertia,
            self.at(last, self.cycle, 0.0).inertia,
        ];
        let ends = std::iter::once(0.0).chain(self.breaks.iter().copied());
        let size = ends
            .enumerate()
            .map(|(piece, from)| {
                let to = self.breaks.get(piece).copied().unwrap_or(self.cycle);
                let places = (0..=32).map(|i| from + (to - from) * f64::from(i) / 32.0);
                places
                    .map(|place| self.at(piece, place, 0.0).inertia)
                    .fold(0.0, f64::max)
            })
            .fold(0.0, f64::max);
        if (start - end).abs() <= AFTER_A_CYCLE * size {
            return Ok(());
        }
        let message = format!(
            "the reduced moment of inertia is {start} kg·m² at the start of the cycle and {end} \
             kg·m² at its end"
        );
        let hint = "the angle of the drive after which the machine repeats: \"720 deg\", say";
        Err(vec![Fault::new("steady.cycle", message, hint)])
    }

    /// J and M at a position and a speed; the piece between two breaks by its number.
    pub fn at(&self, piece: usize, position: f64, speed: f64) -> cycle_map::Load {
        let mut memory = self.memory.borrow_mut();
        let (scratch, state) = &mut *memory;
        let coordinate = self.system.last_coordinate(self.drive).unwrap_or(0);
        let count = state.len() / 2;
        (state[coordinate], state[count + coordinate]) = (position, speed);
        let found = self
            .system
            .reduced_to_rotor(self.drive, state, &self.modes[piece], scratch);
        cycle_map::Load {
            // What a rotor without inertia is given is none.
            inertia: if found.inertia > NONE {
                found.inertia
            } else {
                0.0
            },
            moment: found.moment,
            moment_by_speed: found.moment_by_speed,
            gross_moment: found.gross_moment,
        }
    }

    /// Φ (rad).
    pub fn cycle(&self) -> f64 {
        self.cycle
    }

    /// Places at which a formula changes.
    pub fn breaks(&self) -> &[f64] {
        &self.breaks
    }

    /// Speeds at which the moment has a kink.
    pub fn kinks(&self) -> &[f64] {
        &self.kinks
    }

    /// True when a moment depends on the speed.
    pub fn depends_on_speed(&self) -> bool {
        self.depends_on_speed
    }

    /// J and M as functions of the position, as at rest.
    ///
    /// # Errors
    /// See [`Profile::new`].
    pub fn profile(&self) -> Result<Profile, Refusal> {
        let mut at = |piece: usize, position: f64| {
            let load = self.at(piece, position, 0.0);
            [load.inertia, load.moment]
        };
        let profile = Profile::new(self.cycle, &self.breaks, FunctionKind::Moment, &mut at)?;
        Ok(profile.with_rounding(ROUNDING * self.gross_work()))
    }
}

/// The model with a drive that turns freely from a position and speed, with a
/// moment and a moment of inertia added to it.
pub(super) fn freed(
    model: &Model,
    drive: usize,
    angle: f64,
    speed: f64,
    [moment, inertia]: [f64; 2],
) -> Model {
    let mut model = model.clone();
    let node = model.objects[drive].nodes[0];
    model.nodes[node].motion = NodeMotion::Rotor { angle, speed };
    let own = &mut model.nodes[node].inertia;
    // A rotor needs some: this much is lost in any other.
    *own = (*own + inertia).max(f64::MIN_POSITIVE);
    if moment != 0.0 {
        model.loads.push(Load {
            node,
            name: "balance".to_owned(),
            law: LoadLaw::constant(moment),
        });
    }
    model.start = crate::dynamics::model::Start::OnLaw;
    model
}

fn needs_speed(law: &LoadLaw) -> bool {
    law.needs_speed() || law.is_stop()
}
