use super::{Quick, QuickRun};
use crate::analysis::run::run as recorded;
use crate::analysis::{Control, RunSettings};
use crate::budget::Budget;
use crate::exact::Asked;
use crate::integrate::{Limits, Method, Stop};
use crate::lower::lower;
use crate::record::ObjectFigures;
use crate::scene::{BuiltIn, Document, Overrides};
use crate::system::System;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

const TWO_MASSES: &[u8] = include_bytes!("../../../scenarios/rocker/two_masses.json");

const UNLIMITED: Limits<'static> = Limits {
    switches: u64::MAX,
    steps: u64::MAX,
    budget: Budget::FREE,
};

fn prepared(overrides: &[&str]) -> (System, RunSettings) {
    let document = Document::parse("two_masses.json", TWO_MASSES).unwrap();
    let overrides = Overrides::new(overrides.iter().copied());
    let reading = document.scene(&BuiltIn, &overrides).unwrap();
    let settings = RunSettings::of(&reading.scene).unwrap();
    (
        System::new(lower(&reading.scene).unwrap()).unwrap(),
        settings,
    )
}

fn quick(overrides: &[&str]) -> Quick {
    Quick::new(&prepared(overrides).0).unwrap()
}

fn run(quick: &Quick, end: f64, asked: Asked, limits: &Limits<'_>) -> QuickRun {
    quick.run(end, 0, Some(&|_| asked), limits).unwrap()
}

#[test]
fn the_figures_asked_for_are_those_of_a_run_that_finds_all() {
    type Read = fn(&ObjectFigures) -> f64;
    let lift: Read = |f| f.pair.as_ref().unwrap().max_lift;
    let cases: [(Asked, &[Read]); 6] = [
        (Asked::DEVIATION, &[|f| f.delta_max, |f| f.delta_min]),
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
    for (lever, (asked, reads)) in all {
        let quick = quick(lever);
        let all = run(&quick, 0.5, Asked::ALL, &UNLIMITED);
        let whole = all.objects[0].figures.clone().unwrap();
        let found = run(&quick, 0.5, asked, &UNLIMITED);
        assert_eq!(found.objects[0].switch_times, all.objects[0].switch_times);
        let own = found.objects[0].figures.as_ref().unwrap();
        for read in reads {
            assert_ne!(read(own), 0.0, "{asked:?}");
            let off = (read(own) / read(&whole) - 1.0).abs();
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
            if asked == Asked::DEVIATION { 5 } else { 4 },
            "{asked:?}"
        );
    }
}

fn only(set: impl Fn(&mut Asked)) -> Asked {
    let mut asked = Asked::DEVIATION;
    set(&mut asked);
    asked
}

#[test]
fn modes_that_have_died_away_leave_no_trace_in_long_steps() {
    // Light and stiff on a slow drive: a recorded step is as long as a thousand
    // radians of modes of which rounding alone is left.
    let slow = ["run.duration=1", "shaft.motion.speed=2 rev/s"];
    for lever in [
        ["rocker.inertia=1e-4", "rocker.stiffness=3e6"],
        ["rocker.inertia=2e-5", "rocker.damping_capacity=12.5"],
        ["rocker.inertia=0.01", "rocker.stiffness=1e9"],
        ["rocker.stiffness=1e10", "rocker.damping_capacity=4000"],
        ["rocker.stiffness=1e12", "rocker.masses=6"],
    ] {
        let overrides = [slow, lever].concat();
        let (system, settings) = prepared(&overrides);
        let played = recorded(&system, &settings, &Control::default(), &mut []).unwrap();
        assert_eq!(played.method, Method::Exact);
        let error = played.figures.run.energy_error;
        assert!(error < 1e-8, "{lever:?}: {error:e}");
        let played = &played.figures.objects["rocker"];
        let found = run(&quick(&overrides), 1.0, Asked::ALL, &UNLIMITED);
        let wanted = found.objects[0].figures.as_ref().unwrap();
        type Read = fn(&ObjectFigures) -> f64;
        let reads: [Read; 5] = [
            |f| f.delta_max,
            |f| f.delta_min,
            |f| f.peak_speed,
            |f| f.peak_acceleration,
            |f| f.peak_reaction,
        ];
        for read in reads {
            approx::assert_relative_eq!(read(played), read(wanted), max_relative = 1e-9);
        }
    }
}

#[test]
fn a_run_without_end_stops_when_it_is_told() {
    let quick = quick(&[]);
    let told = AtomicBool::new(true);
    let limits = Limits {
        budget: Budget::interrupted_by(&told),
        ..UNLIMITED
    };
    let found = run(&quick, 1e9, Asked::ALL, &limits);
    assert_eq!(found.stop, Stop::Interrupted);
    assert!(found.time < 1e9);
    // From another thread, in the middle of it.
    let told = AtomicBool::new(false);
    let limits = Limits {
        budget: Budget::interrupted_by(&told),
        ..UNLIMITED
    };
    let found = std::thread::scope(|scope| {
        scope.spawn(|| {
            std::thread::sleep(Duration::from_millis(30));
            told.store(true, std::sync::atomic::Ordering::Relaxed);
        });
        run(&quick, 1e9, Asked::ALL, &limits)
    });
    assert_eq!(found.stop, Stop::Interrupted);
    assert!(found.time > 0.0 && found.switches > 0);
}

#[test]
fn limits_of_time_steps_and_switches_end_a_run() {
    let quick = quick(&[]);
    let limit = Duration::from_millis(20);
    let limits = Limits {
        budget: Budget::FREE.within(limit),
        ..UNLIMITED
    };
    let begun = std::time::Instant::now();
    let found = run(&quick, 1e9, Asked::ALL, &limits);
    assert_eq!(found.stop, Stop::WallClock { limit });
    assert!(begun.elapsed() < 100 * limit, "{:?}", begun.elapsed());
    let steps = Limits {
        steps: 500,
        ..UNLIMITED
    };
    let found = run(&quick, 1e9, Asked::ALL, &steps);
    assert_eq!(found.stop, Stop::TooManySteps { bound: 500 });
    // What was done until then is that of a run that goes on.
    let whole = run(&quick, found.time, Asked::ALL, &UNLIMITED);
    assert!(whole.is_complete());
    let times = |run: &QuickRun| run.objects[0].switch_times.clone();
    let (wanted, times) = (times(&whole), times(&found));
    assert!(wanted.len() > 50 && wanted.len().abs_diff(times.len()) <= 1);
    for (time, wanted) in times.iter().zip(&wanted) {
        approx::assert_relative_eq!(time, wanted, max_relative = 1e-12);
    }
    let [own, other] = [&found, &whole].map(|run| run.objects[0].figures.as_ref().unwrap());
    approx::assert_relative_eq!(own.delta_max, other.delta_max, max_relative = 1e-12);
    approx::assert_relative_eq!(
        own.end.displacement,
        other.end.displacement,
        max_relative = 1e-12
    );
    let switches = Limits {
        switches: 7,
        ..UNLIMITED
    };
    let found = run(&quick, 1e9, Asked::ALL, &switches);
    assert_eq!(found.stop, Stop::TooManySwitches { bound: 7 });
}
