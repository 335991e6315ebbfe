//! Speed against accuracy: limits of stability, verdicts, recommendation,
//! documents, and the command itself.

mod command;
mod sweeps;

use dam::integrate::Method;
use dam::lower::lower;
use dam::model::LoadLaw;
use dam::scene::BuiltIn;
use dam::scene::Document;
use dam::scene::Overrides;
use dam::studies::Control;
use dam::studies::RunSettings;
use dam::studies::methods::MethodLine;
use dam::studies::methods::Plan;
use dam::studies::methods::Point;
use dam::studies::methods::Study;
use dam::studies::methods::Verdict;
use dam::studies::methods::study;
use dam::system::System;
use serde_json::Value;
use std::path::PathBuf;
use std::process::Command;
use std::process::Output;
use std::time::Duration;

/// A wheel turned against its shaft and released: ω₀ = √(8000/0.02) = 632.46 rad/s.
const WHEEL: &str = r#"{
  "dam": 1, "name": "Wheel",
  "objects": {
    "drive": { "kind": "drive", "motion": { "speed": "30 rad/s" } },
    "wheel": { "kind": "shaft", "input": "drive", "inertia": 0.02, "stiffness": 8000,
      "loads": { "drag": { "mass": "last", "constant": -2 } } }
  },
  "run": { "duration": 0.2, "tolerance": 1e-8, "samples": 200,
    "start": { "wheel": { "displacement": [0.01], "speed": [30] } } }
}"#;

fn system(text: &str, overrides: &[&str]) -> (System, RunSettings) {
    let document = Document::parse("scene.json", text.as_bytes()).unwrap();
    let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
    let reading = document
        .scene(&BuiltIn, &Overrides::new(overrides))
        .unwrap();
    let model = lower(&reading.scene).unwrap();
    let settings = RunSettings::of(&reading.scene).unwrap();
    (System::new(model).unwrap(), settings)
}

fn scenario(name: &str) -> String {
    std::fs::read_to_string(path(name)).unwrap()
}

fn path(name: &str) -> PathBuf {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    root.join("scenarios").join(name)
}

/// A plan without repetitions; errors are taken against its methods only.
fn plan(accuracy: f64, methods: &[Method], tolerances: &[f64], steps: &[f64]) -> Plan {
    Plan {
        methods: methods.to_vec(),
        exact_beside: false,
        tolerances: tolerances.to_vec(),
        steps: (!steps.is_empty()).then(|| steps.to_vec()),
        repeats: 1,
        point_limit: Duration::from_secs(60),
        ..Plan::new(accuracy)
    }
}

fn studied(text: &str, overrides: &[&str], plan: &Plan) -> Study {
    let (system, settings) = system(text, overrides);
    study(&system, &settings, plan, &Control::default(), &mut |_| {}).unwrap()
}

fn line(study: &Study, method: Method) -> &MethodLine {
    study
        .methods
        .iter()
        .find(|line| line.method == method)
        .unwrap()
}

fn only(study: &Study, method: Method) -> &Point {
    let points = &line(study, method).points;
    assert_eq!(points.len(), 1, "{points:?}");
    &points[0]
}

#[test]
fn measured_limits_of_stability_agree_with_theory() {
    let aperiodic = 2.785_293_563_4;
    for (damping, limit, place) in [
        ("wheel.damping=0", 8f64.sqrt(), "on the imaginary axis"),
        ("wheel.damping=253", aperiodic, "on the real axis"),
    ] {
        let plan = plan(1e-8, &[Method::Exact, Method::Rk4], &[], &[]);
        let study = studied(WHEEL, &[damping], &plan);
        let found = &line(&study, Method::Rk4).stability;
        assert_eq!(found.place, Some(place));
        approx::assert_relative_eq!(found.theory.unwrap(), limit, max_relative = 1e-6);
        let measured = found.measured.unwrap();
        approx::assert_relative_eq!(measured, limit, max_relative = 0.03);
        // The step itself agrees with the closed form of |λ|.
        let rate = match damping {
            "wheel.damping=0" => 4e5f64.sqrt(),
            _ => {
                let half = 253.0 / 0.04;
                half + (half * half - 4e5f64).sqrt()
            }
        };
        let step = found.measured_step.unwrap();
        approx::assert_relative_eq!(step * rate, limit, max_relative = 0.03);
    }
}

#[test]
fn the_limit_of_a_series_is_measured_as_it_is_foreseen() {
    for (damping, accuracy, degree) in [
        ("wheel.damping=0", 1e-8, 16),
        ("wheel.damping=0", 1e-6, 14),
        ("wheel.damping=8", 1e-6, 14),
        ("wheel.damping=253", 1e-8, 16),
    ] {
        let plan = plan(accuracy, &[Method::Exact, Method::Taylor], &[accuracy], &[]);
        let study = studied(WHEEL, &[damping], &plan);
        let found = &line(&study, Method::Taylor).stability;
        assert_eq!(found.degree, Some(degree));
        let (theory, measured) = (found.theory.unwrap(), found.measured.unwrap());
        assert!(theory > 1.0);
        approx::assert_relative_eq!(measured, theory, max_relative = 0.01);
        assert_eq!(only(&study, Method::Taylor).verdict, Verdict::Converged);
    }
}

#[test]
fn a_motion_beyond_all_numbers_is_given_up() {
    // A load that pushes the wheel away harder than its shaft holds it: the
    // motion itself grows as e^(7000 t), and no method can follow it for 0.2 s.
    let document = Document::parse("scene.json", WHEEL.as_bytes()).unwrap();
    let reading = document.scene(&BuiltIn, &Overrides::none()).unwrap();
    let mut model = lower(&reading.scene).unwrap();
    model.loads[0].law = LoadLaw::spring(-1e6, 0.0);
    let system = System::new(model).unwrap();
    let settings = RunSettings::of(&reading.scene).unwrap();
    let plan = plan(1e-6, &[Method::Dopri5, Method::Dop853], &[1e-6], &[]);
    let study = study(&system, &settings, &plan, &Control::default(), &mut |_| {}).unwrap();
    assert!(study.reference.is_none());
    for method in [Method::Dopri5, Method::Dop853] {
        let point = only(&study, method);
        assert_eq!(point.verdict, Verdict::GaveUp, "{}", point.cause);
        assert!(
            point.cause.contains("no longer a finite number"),
            "{}",
            point.cause
        );
        assert!(point.time.unwrap() < 0.2);
    }
}

#[test]
fn errors_are_those_of_the_closed_form() {
    // Undamped about the drag's deflection −2/8000: rk4 at ωh = 0.1 loses phase
    // by (ωh)⁴/120 of the angle ωt = 126.5, and amplitude by (ωh)⁵/144 a step.
    let rate = 4e5f64.sqrt();
    let step = 0.1 / rate;
    let plan = plan(1e-8, &[Method::Exact, Method::Rk4], &[], &[step]);
    let study = studied(WHEEL, &["wheel.damping=0"], &plan);
    let point = only(&study, Method::Rk4);
    let phase = 1e-4 / 120.0 * rate * 0.2;
    // max|δ| is the free amplitude and the deflection together.
    let expected = phase * 0.01025 / 0.0105;
    approx::assert_relative_eq!(point.error.unwrap(), expected, max_relative = 0.05);
    assert_eq!(point.verdict, Verdict::Inaccurate);
    let reference = study.reference.as_ref().unwrap();
    assert!(reference.exact && reference.confirmed_by.is_some());
    let last = point.figures.iter().find(|f| f.figure == "wheel.delta_max");
    assert!(last.unwrap().error.unwrap() < expected);
    assert!(point.worst_figure.is_some());
}

#[test]
fn a_point_that_is_good_and_the_fastest_is_recommended() {
    let methods = [Method::Rk4, Method::Dopri5, Method::Dop853];
    let plan = plan(1e-8, &methods, &[1e-4, 1e-8, 1e-9, 1e-12], &[1e-3, 1e-5]);
    let study = studied(WHEEL, &["wheel.damping=0.1"], &plan);
    let reference = study.reference.as_ref().unwrap();
    assert!(!reference.exact, "two methods agree");
    assert!(reference.resolution < 1e-10);
    let chosen = &study.recommendation;
    assert!(chosen.error.unwrap() <= 1e-8);
    let all = study.methods.iter().flat_map(|line| &line.points);
    let came = |p: &Point| matches!(p.verdict, Verdict::Converged | Verdict::Inaccurate);
    let fit = all.filter(|p| came(p) && p.error.is_some_and(|e| e <= 1e-8));
    let fastest = fit.filter_map(|p| p.measured_seconds).reduce(f64::min);
    assert_eq!(chosen.measured_seconds, fastest);
    assert!(chosen.text.contains(chosen.method.as_deref().unwrap()));
}

#[test]
fn unstable_is_growth_beyond_the_limit() {
    let step = 3.2 / 4e5f64.sqrt();
    let plan = plan(1e-6, &[Method::Exact, Method::Rk4], &[], &[step]);
    let study = studied(WHEEL, &["wheel.damping=0"], &plan);
    let point = only(&study, Method::Rk4);
    assert_eq!(point.verdict, Verdict::Unstable, "{}", point.cause);
    assert!(
        point
            .cause
            .contains("exceeds the limit 2.828 on the imaginary axis")
    );
    assert!(point.growth.unwrap() > 3.0);
}

#[test]
fn missed_switches_are_counted_against_the_true_ones() {
    let text = scenario("rocker/one_mass_undamped.json");
    let plan = plan(1e-4, &[Method::Exact, Method::Rk4], &[], &[1.2e-4]);
    let study = studied(&text, &[], &plan);
    assert_eq!(study.reference.as_ref().unwrap().switches, 67);
    let point = only(&study, Method::Rk4);
    assert_eq!(point.verdict, Verdict::SwitchesMissed, "{}", point.cause);
    let found = point.switches.unwrap();
    assert_eq!(
        point.cause,
        format!("{found} events, the true number is 67")
    );
}

#[test]
fn a_long_vibration_is_inaccurate_at_a_loose_tolerance() {
    // Four thousand turns of phase: the error of a step adds up.
    let overrides = ["wheel.damping=0", "run.duration=40"];
    let plan = plan(1e-6, &[Method::Exact, Method::Dopri5], &[1e-5], &[]);
    let study = studied(WHEEL, &overrides, &plan);
    let point = only(&study, Method::Dopri5);
    assert_eq!(point.verdict, Verdict::Inaccurate, "{:?}", point.error);
    assert!(point.cause.contains("although it reported success"));
    assert!(point.error.unwrap() > 1e-3);
}

#[test]
fn an_error_just_beyond_the_tolerance_is_inaccurate() {
    // Phase is lost in proportion to the time: about twice the tolerance here.
    let methods = [Method::Exact, Method::Rk4, Method::Rodas5p];
    let rate = 4e5f64.sqrt();
    let step = 0.02 / rate;
    let error = 0.02f64.powi(4) / 120.0 * rate * 0.2 * 0.01025 / 0.0105;
    for (share, verdict) in [(0.5, Verdict::Inaccurate), (2.0, Verdict::Converged)] {
        let asked = share * error;
        let plan = plan(asked, &methods[..2], &[], &[step]);
        let study = studied(WHEEL, &["wheel.damping=0"], &plan);
        let point = only(&study, Method::Rk4);
        assert_eq!(point.verdict, verdict, "{}", point.cause);
        let fits = point.error.unwrap() <= asked;
        assert_eq!(fits, verdict == Verdict::Converged);
    }
    // Every point of a ladder is judged by its own tolerance; what fits the
    // accuracy is recommended whatever tolerance it took.
    let ladder = [1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10];
    let plan = plan(1e-6, &methods, &ladder, &[step]);
    let study = studied(WHEEL, &["wheel.damping=0", "run.duration=2"], &plan);
    let reference = study.reference.as_ref().unwrap();
    let mut inaccurate = 0;
    for point in &line(&study, Method::Rodas5p).points {
        let error = point.error.unwrap();
        let kept = error <= point.tolerance.unwrap().max(3.0 * reference.resolution);
        let verdict = match kept {
            true => Verdict::Converged,
            false => Verdict::Inaccurate,
        };
        assert_eq!(point.verdict, verdict, "{}", point.cause);
        inaccurate += usize::from(!kept);
    }
    assert!(inaccurate > 0);
    assert!(study.recommendation.error.unwrap() <= 1e-6);
}

#[test]
fn few_samples_make_no_method_unstable() {
    // The greatest deviations lie between the samples.
    let text = scenario("rocker/two_masses.json");
    let methods = [Method::Exact, Method::Radau, Method::Taylor];
    let plan = plan(1e-6, &methods, &[1e-8], &[]);
    let study = studied(&text, &["run.samples=2", "run.duration=0.2"], &plan);
    for method in [Method::Radau, Method::Taylor] {
        let point = only(&study, method);
        // Between the samples a method looks at the ends of its steps only.
        let growth = point.growth.unwrap();
        assert!((0.5..1.01).contains(&growth), "{growth}");
        assert_ne!(point.verdict, Verdict::Unstable, "{}", point.cause);
    }
}

#[test]
fn floors_refusals_and_limits_have_their_names() {
    let floor = plan(1e-6, &[Method::Exact, Method::Rk4], &[], &[1e-18]);
    let study = studied(WHEEL, &["wheel.damping=0"], &floor);
    assert_eq!(only(&study, Method::Rk4).verdict, Verdict::StepFloor);

    let refused = plan(1e-6, &[Method::Exact, Method::Dop853], &[1e-16, 1e-17], &[]);
    let study = studied(WHEEL, &["wheel.damping=0"], &refused);
    let point = only(&study, Method::Dop853);
    assert_eq!(point.verdict, Verdict::Refused);
    assert!(point.cause.contains("tolerance"), "{}", point.cause);

    let slow = Plan {
        point_limit: Duration::from_millis(20),
        ..plan(1e-6, &[Method::Exact, Method::Rk4], &[], &[1e-9, 1e-10])
    };
    let study = studied(WHEEL, &["wheel.damping=0"], &slow);
    let point = only(&study, Method::Rk4);
    assert_eq!(point.verdict, Verdict::TimeLimit, "{}", point.cause);
}

#[test]
fn too_many_switches_are_chatter() {
    let text = scenario("rocker/two_masses.json");
    let methods = [Method::Exact, Method::Rk4];
    // Above the limit of 5.1e-5 s every contact throws the mass off anew.
    let plan = plan(1e-4, &methods, &[], &[5.5e-5]);
    let study = studied(&text, &["run.duration=0.03"], &plan);
    let point = only(&study, Method::Rk4);
    assert_eq!(point.verdict, Verdict::Chatter, "{}", point.cause);
    let limit = "exceeds the limit 2.949 in the direction of λ";
    assert!(point.cause.contains(limit), "{}", point.cause);
    // A bound below the true count is no chatter, and no reference either.
    let overrides = ["run.duration=0.1", "run.max_switches=3"];
    let study = studied(&text, &overrides, &self::plan(1e-4, &methods, &[], &[1e-6]));
    assert!(study.reference.is_none());
    for method in methods {
        let point = only(&study, method);
        assert_eq!(point.verdict, Verdict::GaveUp, "{}", point.cause);
        assert!(point.cause.contains("more than 3 events"));
    }
}

#[test]
fn exact_is_refused_with_its_reason_where_a_motor_drives() {
    let text = scenario("press/run_up.json");
    let methods = [Method::Exact, Method::Dopri5, Method::Dop853];
    let plan = plan(1e-6, &methods, &[1e-6, 1e-9], &[]);
    let study = studied(&text, &["run.duration=0.05"], &plan);
    let point = only(&study, Method::Exact);
    assert_eq!(point.verdict, Verdict::Refused);
    assert!(!point.cause.is_empty());
    let reference = study.reference.as_ref().unwrap();
    assert!(!reference.exact && reference.confirmed_by.is_some());
    assert!(
        study.recommendation.method.is_some(),
        "{}",
        study.recommendation.text
    );
}

#[test]
fn with_one_method_alone_nothing_can_be_known() {
    let plan = plan(1e-6, &[Method::Dopri5], &[1e-6, 1e-9], &[]);
    let study = studied(WHEEL, &[], &plan);
    assert!(study.reference.is_none());
    let points = &line(&study, Method::Dopri5).points;
    assert!(
        points
            .iter()
            .all(|p| p.verdict == Verdict::NotJudged && p.error.is_none())
    );
    assert_eq!(study.recommendation.method, None);
    // Two methods that disagree are no reference either, and are shown apart.
    let text = scenario("rocker/two_masses.json");
    let apart = self::plan(1e-6, &[Method::Rk4, Method::Dop853], &[1e-6], &[3e-5]);
    let study = studied(&text, &["run.duration=0.1"], &apart);
    assert!(study.reference.is_none());
    assert_eq!(study.mutual_distances.len(), 1);
    assert!(study.mutual_distances[0].distance > 1e-3);
}

#[test]
fn one_method_alone_is_judged_by_exact_where_that_applies() {
    let beside = Plan {
        exact_beside: true,
        ..plan(1e-6, &[Method::Dopri5], &[1e-6, 1e-9], &[])
    };
    let both = plan(1e-6, &[Method::Exact, Method::Dopri5], &[1e-6, 1e-9], &[]);
    let study = studied(WHEEL, &[], &beside);
    let reference = study.reference.as_ref().unwrap();
    assert!(reference.exact && reference.method == Method::Exact);
    // It is not shown, and the errors are those of a study that shows it.
    assert_eq!(study.methods.len(), 1);
    let points = &line(&study, Method::Dopri5).points;
    let shown = studied(WHEEL, &[], &both);
    for (point, other) in points.iter().zip(&line(&shown, Method::Dopri5).points) {
        assert!(point.error.is_some_and(|error| error > 0.0));
        assert_eq!(point.error, other.error);
        assert_eq!(point.figures, other.figures);
        assert!(!point.figures.is_empty() && !point.is_reference);
    }
    assert_eq!(study.recommendation.method.as_deref(), Some("dopri5"));
    // Where a motor drives it does not apply, and nothing is known as before.
    let text = scenario("press/run_up.json");
    let study = studied(&text, &["run.duration=0.05"], &beside);
    assert!(study.reference.is_none());
    assert_eq!(study.recommendation.method, None);
}

#[test]
fn what_is_not_determined_is_not_judged() {
    let text = scenario("rocker/one_mass_undamped.json");
    let methods = [Method::Dopri5, Method::Dop853];
    let plan = plan(1e-4, &methods, &[1e-9, 1e-12], &[]);
    let study = studied(&text, &["run.duration=1"], &plan);
    let reference = study.reference.as_ref().unwrap();
    assert!(
        reference.horizon > 0.1 && reference.horizon < 0.9,
        "{}",
        reference.horizon
    );
    assert!(reference.moved <= 1e-2);
    assert!(
        reference
            .undetermined
            .iter()
            .any(|f| f == "rocker.delta_max")
    );
    let best = line(&study, Method::Dop853).points.last().unwrap();
    assert_eq!(best.verdict, Verdict::Converged, "{}", best.cause);
    assert!(best.figures.is_empty());
}

#[test]
fn the_table_reads_back_as_the_points() {
    let methods = [Method::Exact, Method::Rk4, Method::Dop853];
    let plan = plan(1e-8, &methods, &[1e-5, 1e-9], &[1e-2, 1e-5]);
    let study = studied(WHEEL, &["wheel.damping=0"], &plan);
    let document: Value = serde_json::from_str(&serde_json::to_string(&study).unwrap()).unwrap();
    let csv = dam::report::methods::methods_rows(&study).csv();
    let mut rows = csv::Reader::from_reader(csv.as_bytes());
    let head = rows.headers().unwrap().clone();
    let column = |name: &str| head.iter().position(|found| found == name).unwrap();
    let mut rows = rows.records().map(Result::unwrap);
    for (k, line) in study.methods.iter().enumerate() {
        for (i, point) in line.points.iter().enumerate() {
            let row = rows.next().unwrap();
            assert_eq!(&row[column("method")], line.method.name());
            let real = |name: &str| row[column(name)].parse::<f64>().ok();
            assert_eq!(real("error"), point.error);
            assert_eq!(real("tolerance"), point.tolerance);
            assert_eq!(real("step [s]"), point.step);
            assert_eq!(real("measured_seconds [s]"), point.measured_seconds);
            assert_eq!(&row[column("cause")], point.cause);
            for figure in &point.figures {
                let name = format!("error of {}", figure.figure);
                assert_eq!(real(&name), figure.error, "{name}");
            }
            let json = &document["methods"][k]["points"][i];
            assert_eq!(json["error"].as_f64(), point.error);
            assert_eq!(json["verdict"].as_str(), Some(&row[column("verdict")]));
        }
    }
    assert!(rows.next().is_none());
}

fn dam(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(arguments)
        .output()
        .unwrap()
}
