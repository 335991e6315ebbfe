//! Many branches behind one shaft: what is found once for all of them, counted.

use super::{CombinedRecord, exact_parts, request, trees};
use crate::budget::Budget;
use crate::dynamics::integrate::{Limits, Modes, Sink, SwitchEvent};
use crate::dynamics::record::{Observer, RecorderSettings, Tee};
use crate::dynamics::system::System;
use crate::exact::Rest;
use crate::exact::event_loop::{Branch, Clock, EventLoop, Listener, Motion, Schedule};
use crate::frontend::lower::lower;
use crate::frontend::scene::{BuiltIn, Document, Overrides};
use serde_json::{Value, json};
use std::f64::consts::TAU;

const TREES: usize = 40;

/// Time of a turn (s).
const TURN: f64 = 0.2;

/// Levers behind a rigid shaft, whose torques nearly cancel.
fn scene() -> Value {
    let mut objects = json!({
        "motor": { "kind": "drive", "motion": { "speed": TAU / TURN } },
        "shaft": { "kind": "shaft", "input": "motor", "inertia": 0.1, "masses": 0 }
    });
    for k in 0..TREES {
        objects[format!("lever_{k}")] = json!({
            "kind": "rocker", "input": "shaft",
            "position": { "sine": { "amplitude": 0.26, "phase": 1.9 * k as f64 } },
            "inertia": 0.05, "stiffness": 2e4 + 500.0 * k as f64, "damping_capacity": 0.3
        });
    }
    json!({ "dam": 1, "name": "many", "objects": objects, "run": { "duration": TURN } })
}

/// Counts stretches and samples a torque on their way to a recorder.
struct Counted<'j, 'a> {
    joint: &'j mut CombinedRecord<'a>,
    observer: Observer<'a>,
    stretches: u64,
    /// Greatest torque of the motor at places of the stretches (N·m).
    greatest: f64,
}

impl Listener for Counted<'_, '_> {
    fn start(&mut self, y: &[f64], modes: &Modes) {
        self.joint.start(y, modes);
    }

    fn reset_tree(&mut self, number: usize) {
        self.joint.reset_tree(number);
    }

    fn phase(&mut self, number: usize, branch: &mut Branch<'_>) {
        self.joint.phase(number, branch);
    }

    fn stretch(&mut self, motion: &mut Motion<'_, '_>, span: [f64; 2], modes: &Modes) {
        self.stretches += 1;
        let mut y = vec![0.0; 2 * TREES];
        for k in 0..=100 {
            let time = span[0] + (span[1] - span[0]) * f64::from(k) / 100.0;
            motion.state(time, &mut y);
            let motor = &self.observer.state(time, &y, modes)[0];
            self.greatest = self.greatest.max(motor.reaction.abs());
        }
        self.joint.stretch(motion, span, modes);
    }

    fn switch(&mut self, event: &SwitchEvent<'_>) {
        self.joint.switch(event);
    }
}

/// Greatest torque of the motor: as it is recorded, and of samples; then the stretches,
/// and how often a force and its bounds were found.
fn run(duration: f64) -> ([f64; 2], u64, [u64; 2]) {
    let text = scene().to_string();
    let document = Document::parse("many.json", text.as_bytes()).unwrap();
    let reading = document.scene(&BuiltIn, &Overrides::none()).unwrap();
    let system = System::new(lower(&reading.scene).unwrap()).unwrap();
    let parts = exact_parts(&system).unwrap();
    assert_eq!(parts.trees.len(), TREES);
    let initial = system.initial_place().unwrap();
    let rest = Rest::outside_trees(&system, &parts).unwrap();
    let trees = trees(&parts, &initial);
    let way = Schedule {
        system: &system,
        parts: &parts,
        trees: &trees,
        initial: &initial,
        end: duration,
        whole: true,
    };
    let limits = Limits {
        switches: u64::MAX,
        steps: u64::MAX,
        budget: Budget::default(),
    };
    let settings = RecorderSettings {
        duration,
        samples: 0,
        listing: true,
        switch_rows: false,
        masses: false,
        closeups: false,
        window: None,
        long_steps: false,
        implicit: false,
        tolerance: 1e-9,
        spans: Vec::new(),
        checked: false,
    };
    let clock = Clock::new(&limits);
    let goes_on = || clock.is_running();
    let asked = |number: usize| request(&parts.trees[number], &limits, duration, None);
    let mut nobody: [&mut dyn Sink; 0] = [];
    let sink = &mut Tee(&mut nobody);
    let mut joint = CombinedRecord::new((way, &goes_on), settings, Some((&rest, false)), sink);
    let mut counted = Counted {
        joint: &mut joint,
        observer: Observer::new(&system),
        stretches: 0,
        greatest: 0.0,
    };
    let mut walk = EventLoop::new(way, &asked, &clock, &goes_on).unwrap();
    walk.begin_phases(&mut counted);
    walk.advance_to(duration, None, &mut counted);
    let Counted {
        stretches,
        greatest,
        ..
    } = counted;
    let evaluations = joint.beside.as_ref().unwrap().forces.evaluations;
    let (y, modes) = walk.current_state(None);
    let (y, modes) = (y.to_vec(), modes.clone());
    let recorded = joint.finish(walk.time(), (&y, &modes), walk.branches());
    let found = recorded.figures[0].peak_reaction;
    ([found, greatest], stretches, evaluations)
}

/// Every force is found once at each end of a stretch's parts, of which a turn has 64, and at
/// most about once within a part: not once for each object on the way and each direction, and
/// not in hundreds of cuts.
#[test]
fn forces_are_found_once_for_all_that_asks() {
    for duration in [TURN / 200.0, TURN] {
        let ([found, sampled], stretches, [forces, bounds]) = run(duration);
        assert_eq!(stretches, 1);
        assert_eq!(bounds, 64 * TREES as u64);
        let within = forces / TREES as u64 - 65;
        assert!(within < 2 * 64, "{within} times within 64 parts");
        assert!(
            found >= sampled && found < 1.0001 * sampled,
            "{found} {sampled}"
        );
    }
}
