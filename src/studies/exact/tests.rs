use crate::dynamics::integrate::{Method, Stop};
use crate::dynamics::record::ObjectFigures;
use crate::dynamics::system::System;
use crate::exact::RequestedFigures;
use crate::frontend::lower::lower;
use crate::frontend::scene::{BuiltIn, Document, Overrides};
use crate::studies::demand::Demand;
use crate::studies::run::{Motion, motion, run as recorded};
use crate::studies::{Control, RunSettings};
use std::sync::atomic::AtomicBool;
use std::time::Duration;

const TWO_MASSES: &[u8] = include_bytes!("../../../scenarios/rocker/two_masses.json");

fn prepared(overrides: &[&str]) -> (System, RunSettings) {
    read(TWO_MASSES, overrides)
}

fn read(text: &[u8], overrides: &[&str]) -> (System, RunSettings) {
    let document = Document::parse("scene.json", text).unwrap();
    let overrides = Overrides::new(overrides.iter().copied());
    let reading = document.scene(&BuiltIn, &overrides).unwrap();
    let settings = RunSettings {
        method: Some(Method::Exact),
        max_switches: u64::MAX,
        max_steps: u64::MAX,
        ..RunSettings::of(&reading.scene).unwrap()
    };
    (
        System::new(lower(&reading.scene).unwrap()).unwrap(),
        settings,
    )
}

/// A run to an end for the figures asked for.
fn found(
    (system, settings): &(System, RunSettings),
    duration: f64,
    asked: RequestedFigures,
    control: &Control<'_>,
) -> Motion {
    let settings = RunSettings {
        duration,
        ..settings.clone()
    };
    let demand = Demand {
        figures: Some(&|_| asked),
        laws: None,
        checked: false,
    };
    motion(system, &settings, demand, control, &mut []).unwrap()
}

fn rocker<'f>(found: &'f Motion, scene: &(System, RunSettings)) -> &'f ObjectFigures {
    let mut objects = scene.0.model().objects.iter();
    let index = objects.position(|part| part.id == "rocker").unwrap();
    &found.recorded.figures[index]
}

fn switch_times<'f>(found: &'f Motion, scene: &(System, RunSettings)) -> &'f [f64] {
    &rocker(found, scene).pair.as_ref().unwrap().switch_times
}

#[test]
fn the_figures_asked_for_are_those_of_a_run_that_finds_all() {
    type Read = fn(&ObjectFigures) -> f64;
    let lift: Read = |f| f.pair.as_ref().unwrap().max_lift;
    let cases: [(RequestedFigures, &[Read]); 6] = [
        (
            RequestedFigures::DEVIATION,
            &[|f| f.delta_max, |f| f.delta_min],
        ),
        (only(|asked| asked.mean = true), &[|f| f.sigma]),
        (only(|asked| asked.speed = true), &[|f| f.peak_speed]),
        (
            only(|asked| asked.acceleration = true),
            &[|f| f.peak_acceleration],
        ),
        (only(|asked| asked.force = true), &[|f| f.peak_reaction]),
        (only(|asked| asked.lift = true), &[lift]),
    ];
    // Stiff levers too, of which some modes turn far within a step of the search.
    let levers: [&[&str]; 3] = [
        &[],
        &["rocker.stiffness=1e10"],
        &["rocker.stiffness=1e9", "rocker.masses=6"],
    ];
    let all = levers
        .iter()
        .flat_map(|lever| cases.map(|case| (*lever, case)));
    let control = Control::default();
    for (lever, (asked, reads)) in all {
        let scene = prepared(lever);
        let all = found(&scene, 0.5, RequestedFigures::ALL, &control);
        let some = found(&scene, 0.5, asked, &control);
        assert_eq!(switch_times(&some, &scene), switch_times(&all, &scene));
        let (own, whole) = (rocker(&some, &scene), rocker(&all, &scene));
        for read in reads {
            assert_ne!(read(own), 0.0, "{asked:?}");
            let off = (read(own) / read(whole) - 1.0).abs();
            assert!(off < 1e-12, "{lever:?} {asked:?}: {off:e}");
        }
        // The others are left alone.
        let found = [
            own.sigma,
            own.peak_speed,
            own.peak_acceleration,
            own.peak_reaction,
            lift(own),
        ];
        let zeros = found.iter().filter(|value| **value == 0.0).count();
        assert_eq!(
            zeros,
            if asked == RequestedFigures::DEVIATION {
                5
            } else {
                4
            },
            "{asked:?}"
        );
    }
}

fn only(set: impl Fn(&mut RequestedFigures)) -> RequestedFigures {
    let mut asked = RequestedFigures::DEVIATION;
    set(&mut asked);
    asked
}

#[test]
fn modes_that_have_died_away_leave_no_trace_in_long_steps() {
    // Light and stiff on a slow drive: an integrated step is as long as a thousand
    // radians of modes of which rounding alone is left.
    let slow = ["run.duration=1", "shaft.motion.speed=2 rev/s"];
    for lever in [
        ["rocker.inertia=1e-4", "rocker.stiffness=3e6"],
        ["rocker.inertia=2e-5", "rocker.damping_capacity=12.5"],
        ["rocker.inertia=0.01", "rocker.stiffness=1e9"],
        ["rocker.stiffness=1e10", "rocker.damping_capacity=4000"],
        ["rocker.stiffness=1e12", "rocker.masses=6"],
    ] {
        let scene = prepared(&[slow, lever].concat());
        let (system, settings) = &scene;
        let exact = recorded(system, settings, &Control::default(), &mut []).unwrap();
        let error = exact.figures.run.energy_error;
        assert!(error < 1e-8, "{lever:?}: {error:e}");
        let general = RunSettings {
            method: Some(Method::Radau),
            tolerance: 1e-12,
            ..settings.clone()
        };
        let general = recorded(system, &general, &Control::default(), &mut []).unwrap();
        let [own, wanted] = [&exact, &general].map(|run| &run.figures.objects["rocker"]);
        type Read = fn(&ObjectFigures) -> f64;
        let reads: [Read; 4] = [
            |f| f.delta_max,
            |f| f.delta_min,
            |f| f.peak_speed,
            |f| f.peak_reaction,
        ];
        for read in reads {
            approx::assert_relative_eq!(read(own), read(wanted), max_relative = 1e-6);
        }
        // The polynomials of long steps do not know accelerations so well. As slow as
        // this the lever follows its law, φ = 90° sin ωt.
        let speed = 2.0 * std::f64::consts::TAU;
        let law = std::f64::consts::FRAC_PI_2 * speed * speed;
        approx::assert_relative_eq!(own.peak_acceleration, law, max_relative = 1e-7);
    }
}

#[test]
fn a_run_without_end_stops_when_it_is_told() {
    let scene = prepared(&[]);
    let told = AtomicBool::new(true);
    let control = Control::interrupted_by(&told);
    let stopped = found(&scene, 1e9, RequestedFigures::ALL, &control);
    assert_eq!(stopped.outcome.stop, Stop::Interrupted);
    assert!(stopped.outcome.time < 1e9);
    // From another thread, in the middle of it.
    let told = AtomicBool::new(false);
    let control = Control::interrupted_by(&told);
    let stopped = std::thread::scope(|scope| {
        scope.spawn(|| {
            std::thread::sleep(Duration::from_millis(30));
            told.store(true, std::sync::atomic::Ordering::Relaxed);
        });
        found(&scene, 1e9, RequestedFigures::ALL, &control)
    });
    assert_eq!(stopped.outcome.stop, Stop::Interrupted);
    assert!(stopped.outcome.time > 0.0 && stopped.outcome.statistics.switches > 0);
}

/// A lever that vibrates sixteen million times a second carries a slider, which is looked at
/// some hundred million times before anything else is: the run ends when it is told.
#[test]
fn looking_at_what_a_fast_mass_carries_ends_in_time() {
    let text = br#"{ "dam": 1, "name": "fast", "objects": {
        "shaft": { "kind": "drive", "motion": { "speed": 60 } },
        "lever": { "kind": "rocker", "input": "shaft", "position": { "sine": { "amplitude": 1 } },
            "inertia": 1e-9, "stiffness": 1e7, "masses": 1 },
        "ram": { "kind": "slider", "input": "lever", "position": { "ratio": 1 },
            "inertia": 1e-12, "masses": 0 } },
        "run": { "duration": 10 } }"#;
    ends_in_time(&read(text, &[]));
}

/// A wheel that nothing happens to for three centuries is looked at in parts of a turn.
#[test]
fn looking_at_a_long_free_vibration_ends_in_time() {
    let wheel = include_bytes!("../../../scenarios/shafts/free_vibration.json");
    ends_in_time(&read(wheel, &["run.duration=1e10"]));
}

/// A run that would go on for long ends soon after its time is over.
fn ends_in_time((system, settings): &(System, RunSettings)) {
    let limit = Duration::from_millis(50);
    let begun = std::time::Instant::now();
    let control = Control::FREE.within(limit);
    let stopped = recorded(system, settings, &control, &mut []).unwrap();
    assert_eq!(stopped.outcome.stop, Stop::WallClock { limit });
    assert!(begun.elapsed() < 60 * limit, "{:?}", begun.elapsed());
}

#[test]
fn limits_of_time_steps_and_switches_end_a_run() {
    let scene = prepared(&[]);
    let limit = Duration::from_millis(20);
    let control = Control::FREE.within(limit);
    let begun = std::time::Instant::now();
    let stopped = found(&scene, 1e9, RequestedFigures::ALL, &control);
    assert_eq!(stopped.outcome.stop, Stop::WallClock { limit });
    assert!(begun.elapsed() < 100 * limit, "{:?}", begun.elapsed());
    let limited = |switches: u64, steps: u64| {
        let (system, settings) = prepared(&[]);
        let settings = RunSettings {
            max_switches: switches,
            max_steps: steps,
            ..settings
        };
        let scene = (system, settings);
        let found = found(&scene, 1e9, RequestedFigures::ALL, &Control::default());
        (scene, found)
    };
    let (_, few) = limited(u64::MAX, 500);
    assert_eq!(few.outcome.stop, Stop::TooManySteps { bound: 500 });
    // What was done until then is that of a run that goes on.
    let whole = found(
        &scene,
        few.outcome.time,
        RequestedFigures::ALL,
        &Control::default(),
    );
    assert!(whole.is_complete());
    let [times, wanted] = [&few, &whole].map(|run| switch_times(run, &scene));
    assert!(wanted.len() > 50 && wanted.len().abs_diff(times.len()) <= 1);
    for (time, wanted) in times.iter().zip(wanted) {
        approx::assert_relative_eq!(time, wanted, max_relative = 1e-12);
    }
    let [own, other] = [&few, &whole].map(|run| rocker(run, &scene));
    approx::assert_relative_eq!(own.delta_max, other.delta_max, max_relative = 1e-12);
    approx::assert_relative_eq!(
        own.end.displacement,
        other.end.displacement,
        max_relative = 1e-12
    );
    let (_, few) = limited(7, u64::MAX);
    assert_eq!(few.outcome.stop, Stop::TooManySwitches { bound: 7 });
}
