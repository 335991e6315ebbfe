//! `method: auto`: what it picks converges and has not much more work than the
//! best, on scenes of every kind. Work is counted, not timed.

use dam::analysis::methods::{Plan, Point, Study, Verdict, study};
use dam::analysis::run::{RunResult, run};
use dam::analysis::{Control, RunSettings};
use dam::integrate::Method;
use dam::lower::lower;
use dam::scene::{BuiltIn, Document, Overrides};
use dam::system::System;
use std::path::PathBuf;
use std::time::Duration;

/// Tolerances at which `auto` is judged; the last one is for the reference.
const TOLERANCES: [f64; 4] = [1e-4, 1e-7, 1e-10, 1e-12];

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
/// the Jacobian and of linear algebra (measured on scenarios of 1 to 9 coordinates,
/// where all lie between 0.6 and 1.6).
const fn weight(method: Method) -> f64 {
    match method {
        Method::Taylor => 0.9,
        _ => 1.0,
    }
}

/// `auto` may have this many times the evaluations of the best.
const WITHIN: f64 = 2.5;

/// A run keeps its tolerance, which bounds the error of a step, within this factor.
const KEPT: f64 = 100.0;

/// True when a point ended well and its error is what a run may make of the tolerance.
fn keeps(point: &Point, tolerance: f64) -> bool {
    let ended = matches!(point.verdict, Verdict::Converged | Verdict::Inaccurate);
    let near = point.error.is_some_and(|error| error <= KEPT * tolerance);
    point.verdict == Verdict::Converged || ended && near
}

struct Judged {
    name: &'static str,
    system: System,
    settings: RunSettings,
    study: Study,
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
        let plan = Plan {
            methods: METHODS.to_vec(),
            tolerances: TOLERANCES.to_vec(),
            repeats: 1,
            point_limit: Duration::from_secs(60),
            ..Plan::new(1e-7)
        };
        let study = study(&system, &settings, &plan, &Control::default(), &mut |_| ()).unwrap();
        assert!(study.reference.is_some(), "{name}: no reference");
        Self {
            name,
            system,
            settings,
            study,
        }
    }

    fn auto(&self, tolerance: f64) -> RunResult {
        let settings = RunSettings {
            tolerance,
            ..self.settings.clone()
        };
        run(&self.system, &settings, &Control::default(), &mut []).unwrap()
    }

    fn point(&self, method: Method, tolerance: f64) -> &Point {
        let line = self.study.methods.iter().find(|line| line.method == method);
        let mut points = line.unwrap().points.iter();
        points
            .find(|point| point.tolerance == Some(tolerance))
            .unwrap_or_else(|| panic!("{}: no point of {method} at {tolerance:e}", self.name))
    }

    /// Work of the methods that converge at a tolerance, the least first.
    fn works(&self, tolerance: f64) -> Vec<(f64, Method)> {
        let points = self.study.methods.iter().filter_map(|line| {
            let fit =
                |point: &&Point| point.tolerance == Some(tolerance) && keeps(point, tolerance);
            let point = line.points.iter().find(fit)?;
            Some((weight(line.method) * point.evaluations? as f64, line.method))
        });
        let mut works: Vec<(f64, Method)> = points.collect();
        works.sort_by(|a, b| a.0.total_cmp(&b.0));
        works
    }

    /// What `auto` picks converges, with not much more work than the best.
    fn check(&self) {
        for tolerance in [1e-4, 1e-7, 1e-10] {
            let auto = self.auto(tolerance);
            let (method, why) = (auto.method, &auto.figures.run.why);
            let place = format!("{} at {tolerance:.0e}: {method}: {why}", self.name);
            let own = self.point(method, tolerance);
            assert!(keeps(own, tolerance), "{place}; {}", own.cause);
            let works = self.works(tolerance);
            let work = weight(method) * own.evaluations.unwrap() as f64;
            assert!(work <= WITHIN * works[0].0, "{place}; {works:?}");
            assert!(!why.contains("NaN") && !why.contains("inf"), "{place}");
        }
    }

    /// The check can fail: some method that converges has far more work.
    fn differs(&self, tolerance: f64) {
        let works = self.works(tolerance);
        let (least, most) = (works[0], works[works.len() - 1]);
        assert!(most.0 > 1.5 * WITHIN * least.0, "{works:?}");
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
    ] {
        Judged::new(name, &[]).check();
    }
}

#[test]
fn a_press_that_starts_from_rest_is_as_exact_as_asked() {
    // The angle of the motor grows all the while: an error relative to it would
    // be worth nothing where the tool meets the work.
    Judged::new("press/run_up.json", &[]).check();
}
