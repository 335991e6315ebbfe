//! `method: auto`: what it picks keeps the tolerance over the whole run, and has not much
//! more work than the best method that does so when given that tolerance, on scenes of
//! every kind. Work is counted, not timed.

use dam::integrate::Method;
use dam::lower::lower;
use dam::scene::{BuiltIn, Document, Overrides};
use dam::studies::methods::{Plan, Point, Study, Verdict, study};
use dam::studies::run::{RunResult, run};
use dam::studies::{Control, RunSettings};
use dam::system::System;
use std::path::PathBuf;
use std::time::Duration;

/// The finest tolerance, for the reference.
const FINEST: f64 = 1e-12;

/// The library's own methods and those of ode_solvers.
const METHODS: [Method; 5] = [
    Method::Dopri5,
    Method::Dop853,
    Method::Taylor,
    Method::Rodas5p,
    Method::Radau,
];

/// Evaluations of the right-hand side that an evaluation counted by a method amounts
/// to in time: an order of a power series, a stage of an implicit method with its share of
/// the Jacobian and of linear algebra; dopri5, whose steps are short, has a continuous
/// output for every six of them. Measured on scenarios of 1 to 9 coordinates, where all lie
/// between 0.6 and 1.6 of Dop853's, and dopri5 between 1 and 2.
const fn weight(method: Method) -> f64 {
    match method {
        Method::Taylor => 0.9,
        Method::Dopri5 => 1.5,
        _ => 1.0,
    }
}

/// `auto` may have this many times the evaluations of the best.
const WITHIN: f64 = 2.0;

/// Tolerances at which `auto` is judged.
const JUDGED: [f64; 3] = [1e-4, 1e-7, 1e-10];

struct Judged {
    name: &'static str,
    study: Study,
    /// What `auto` does at the tolerances [`JUDGED`].
    autos: Vec<RunResult>,
}

impl Judged {
    fn new(name: &'static str, overrides: &[&str]) -> Self {
        let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("scenarios");
        let bytes = std::fs::read(root.join(name)).unwrap();
        let document = Document::parse(name, &bytes).unwrap();
        let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
        let reading = document
            .scene(&BuiltIn, &Overrides::new(overrides))
            .unwrap();
        let system = System::new(lower(&reading.scene).unwrap()).unwrap();
        let settings = RunSettings {
            method: None,
            ..RunSettings::of(&reading.scene).unwrap()
        };
        let autos = JUDGED.map(|tolerance| {
            let settings = RunSettings {
                tolerance,
                ..settings.clone()
            };
            run(&system, &settings, &Control::default(), &mut []).unwrap()
        });
        let aims = autos.iter().map(|auto| auto.tolerance);
        let mut tolerances: Vec<f64> = aims.chain(JUDGED).chain([FINEST]).collect();
        tolerances.sort_by(|a, b| b.total_cmp(a));
        tolerances.dedup();
        let plan = Plan {
            methods: METHODS.to_vec(),
            tolerances,
            repeats: 1,
            point_limit: Duration::from_secs(60),
            ..Plan::new(1e-7)
        };
        let study = study(&system, &settings, &plan, &Control::default(), &mut |_| ()).unwrap();
        assert!(study.reference.is_some(), "{name}: no reference");
        Self {
            name,
            study,
            autos: autos.into(),
        }
    }

    /// What `auto` does at one of the tolerances [`JUDGED`].
    fn auto(&self, tolerance: f64) -> &RunResult {
        let place = JUDGED.iter().position(|judged| *judged == tolerance);
        &self.autos[place.unwrap()]
    }

    fn point(&self, method: Method, tolerance: f64) -> &Point {
        let line = self.study.methods.iter().find(|line| line.method == method);
        let mut points = line.unwrap().points.iter();
        points
            .find(|point| point.tolerance == Some(tolerance))
            .unwrap_or_else(|| panic!("{}: no point of {method} at {tolerance:e}", self.name))
    }

    /// Work of the methods that converge when given a tolerance, the least first.
    fn works(&self, tolerance: f64) -> Vec<(f64, Method)> {
        let points = self.study.methods.iter().filter_map(|line| {
            let fit = |point: &&Point| {
                point.tolerance == Some(tolerance) && point.verdict == Verdict::Converged
            };
            let point = line.points.iter().find(fit)?;
            Some((weight(line.method) * point.evaluations? as f64, line.method))
        });
        let mut works: Vec<(f64, Method)> = points.collect();
        works.sort_by(|a, b| a.0.total_cmp(&b.0));
        works
    }

    /// What `auto` picks keeps the tolerance, with not much more work than the best.
    fn check(&self) {
        let resolution = self.study.reference.as_ref().unwrap().resolution;
        for tolerance in JUDGED {
            let auto = self.auto(tolerance);
            let (method, why) = (auto.method, &auto.figures.run.why);
            let place = format!("{} at {tolerance:.0e}: {method}: {why}", self.name);
            let own = self.point(method, auto.tolerance);
            let ended = matches!(own.verdict, Verdict::Converged | Verdict::Inaccurate);
            let error = own.error.unwrap_or(f64::INFINITY);
            let kept = error <= tolerance.max(3.0 * resolution);
            assert!(ended && kept, "{place}; {error:e}; {}", own.cause);
            assert!(!why.contains("NaN") && !why.contains("inf"), "{place}");
            let works = self.works(tolerance);
            let Some(best) = works.first() else { continue };
            let work = weight(method) * own.evaluations.unwrap() as f64;
            assert!(work <= WITHIN * best.0, "{place}; {work} {works:?}");
        }
    }

    /// The check can fail: some method that converges has too much work.
    fn differs(&self, tolerance: f64) {
        let works = self.works(tolerance);
        let (least, most) = (works[0], works[works.len() - 1]);
        assert!(most.0 > WITHIN * least.0, "{works:?}");
    }
}

#[test]
fn vibrations_that_die_out_get_a_method_of_long_steps() {
    for name in ["packaging/pusher.json", "shafts/fan_on_line.json"] {
        let judged = Judged::new(name, &[]);
        judged.check();
        judged.differs(1e-7);
        assert_eq!(judged.auto(1e-7).method, Method::Radau, "{name}");
    }
}

#[test]
fn a_motor_with_a_table_of_speeds_has_no_series() {
    let judged = Judged::new("shafts/vertical_feed.json", &[]);
    judged.check();
}

#[test]
fn vibrations_that_stay_get_power_series() {
    let judged = Judged::new("shafts/two_rotors.json", &[]);
    judged.check();
    assert_eq!(judged.auto(1e-10).method, Method::Taylor);
}

#[test]
fn rigid_machines_behind_a_motor() {
    for name in [
        "rigid/pump.json",
        "steady/press_flywheel.json",
        "linkages/slider_crank_spring.json",
        "linkages/one_window.json",
    ] {
        Judged::new(name, &[]).check();
    }
}

#[test]
fn laws_that_start_at_a_dead_centre() {
    // At rest there, rounding must not be taken for a bend of the law.
    Judged::new("fan_out/sewing_machine.json", &[]).check();
}

#[test]
fn a_press_that_starts_from_rest_is_as_exact_as_asked() {
    // The angle of the motor grows all the while: an error relative to it would
    // be worth nothing where the tool meets the work.
    Judged::new("press/run_up.json", &[]).check();
}
