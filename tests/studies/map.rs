//! Maps: verdicts, their causes, and values.

use dam::scene::{BuiltIn, Document};
use dam::studies::Control;
use dam::studies::axis::Axis;
use dam::studies::map::{Cell, Family, Panels, Question, Silent, Study, StudyFault, Verdict, map};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

fn scene(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("scenarios")
        .join(name)
}

fn load(name: &str) -> Document {
    Document::parse(name, &std::fs::read(scene(name)).unwrap()).unwrap()
}

/// A question; settings first, then x, then perhaps y.
fn question(settings: &[&str], x: &str, y: Option<&str>) -> Question {
    Question {
        overrides: settings
            .iter()
            .map(|setting| (*setting).to_owned())
            .collect(),
        x: Axis::parse(x).unwrap(),
        y: y.map(|y| Axis::parse(y).unwrap()),
        panels: Panels::default(),
        figure: None,
        check_determined: false,
        digits: 7,
    }
}

fn cells(document: &Document, question: Question) -> Vec<Cell> {
    let study = Study::new(document, &BuiltIn, question).unwrap();
    let result = map(
        &study,
        BTreeMap::new(),
        Some(1),
        &Control::default(),
        &Silent,
    )
    .unwrap();
    assert!(result.complete);
    result.panels.concat().into_iter().flatten().collect()
}

const TWO: &str = "rocker/two_masses.json";
const TEN: &str = "rocker/ten_masses.json";

#[test]
fn a_lever_works_lifts_off_or_is_thrown_off() {
    let found = cells(
        &load(TWO),
        question(&[], "rocker.inertia=0.05:0.25:5", None),
    );
    let verdicts: Vec<Verdict> = found.iter().map(|cell| cell.verdict).collect();
    assert_eq!(verdicts[0], Verdict::InWorkingOrder, "{:?}", found[0]);
    assert_eq!(verdicts[1], Verdict::LiftOff, "{:?}", found[1]);
    assert_eq!(verdicts[4], Verdict::ThrownOff, "{:?}", found[4]);
    assert!(
        found[1].cause.contains("in 5 of 5 cycles"),
        "{}",
        found[1].cause
    );
    // The scene's own figure.
    let value = found[1].value.unwrap();
    approx::assert_relative_eq!(value, 0.00750086, max_relative = 1e-6);
    // The rigid edge: M − J·A·Ω² in closed form.
    let carried = std::f64::consts::FRAC_PI_2 * (20.0 * std::f64::consts::PI).powi(2);
    for (index, cell) in found.iter().enumerate() {
        let inertia = 0.05 * (index + 1) as f64;
        let margin = 600.0 - inertia * carried;
        approx::assert_abs_diff_eq!(cell.rigid_margin.unwrap(), margin, epsilon = 1e-6);
    }
}

#[test]
fn lift_off_of_the_start_is_told_from_lift_off_of_the_motion() {
    let on_law = ["run.start=on_law", "rocker.loads.closing.constant=-1000"];
    let found = cells(
        &load(TEN),
        question(&on_law, "run.duration=0.4:0.5:2", None),
    );
    for cell in &found {
        assert_eq!(cell.verdict, Verdict::LiftOffDiesAway, "{cell:?}");
        assert!(cell.cause.contains("not after"), "{}", cell.cause);
    }
    // Two cycles are too few to tell.
    let found = cells(
        &load(TWO),
        question(&["run.duration=0.2"], "rocker.inertia=0.1:0.11:2", None),
    );
    assert!(
        found
            .iter()
            .all(|cell| cell.verdict == Verdict::LiftOffNotJudged),
        "{found:?}"
    );
}

#[test]
fn resonance_needs_a_frequency_near_a_harmonic_and_a_large_motion() {
    let settings = [
        "rocker.masses=1",
        "rocker.pair.closure=bilateral",
        "rocker.damping_capacity=0.2",
        "run.duration=4",
        "run.tolerance=1e-8",
    ];
    // ω = Ω at c = J·Ω² = 394.8 N·m/rad.
    let found = cells(
        &load(TWO),
        question(&settings, "rocker.stiffness=395:3950:2", None),
    );
    assert_eq!(found[0].verdict, Verdict::Resonance, "{:?}", found[0]);
    assert!(
        found[0].cause.contains("harmonic 1 of the drive"),
        "{}",
        found[0].cause
    );
    assert_eq!(found[1].verdict, Verdict::InWorkingOrder, "{:?}", found[1]);
    // The same by a general method.
    let mut general = settings.to_vec();
    general.push("run.method=dop853");
    let again = cells(
        &load(TWO),
        question(&general, "rocker.stiffness=395:3950:2", None),
    );
    for (exact, general) in found.iter().zip(&again) {
        assert_eq!(exact.verdict, general.verdict);
        let (exact, general) = (exact.value.unwrap(), general.value.unwrap());
        approx::assert_relative_eq!(exact, general, max_relative = 1e-5);
    }
}

#[test]
fn an_undamped_mode_driven_at_its_own_frequency_is_resonance_too() {
    let settings = [
        "rocker.masses=1",
        "rocker.pair.closure=bilateral",
        "rocker.damping_capacity=0",
        "run.duration=2",
    ];
    // c = J·Ω² to rounding, and twice that.
    let own = 0.1 * (20.0 * std::f64::consts::PI).powi(2);
    let axis = format!("rocker.stiffness={own}:{}:2", 2.0 * own);
    let found = cells(&load(TWO), question(&settings, &axis, None));
    assert_eq!(found[0].verdict, Verdict::Resonance, "{:?}", found[0]);
    assert!(
        found[0].cause.contains("at 1.0000 of"),
        "{}",
        found[0].cause
    );
}

#[test]
fn a_large_free_vibration_of_the_start_is_no_resonance() {
    // J·Ω²: stiffness at which one mass has the frequency of the drive.
    let own = 0.1 * (20.0 * std::f64::consts::PI).powi(2);
    let mut settings = vec![
        "rocker.masses=1",
        "rocker.pair.closure=bilateral",
        "rocker.damping_capacity=0",
        "run.duration=2",
        r#"run.start={"rocker":{"displacement":[60],"speed":[0]}}"#,
    ];
    // ω = 2.05·Ω beside a drive of one harmonic, which deflects it less than twice as
    // far as at rest; it swings freely 80 times as far, for ever.
    let stiffness = 2.05f64.powi(2) * own;
    let axis = format!("rocker.stiffness={stiffness}:{}:2", 1.001 * stiffness);
    let document = load(TWO);
    for method in ["run.method=exact", "run.method=dop853"] {
        settings.push(method);
        for cell in cells(&document, question(&settings, &axis, None)) {
            assert_eq!(cell.verdict, Verdict::InWorkingOrder, "{cell:?}");
            assert!(cell.value.unwrap() > 50.0, "{cell:?}");
        }
        settings.pop();
    }
    // What the drive builds up is resonance from any start.
    let axis = format!("rocker.stiffness={own}:{}:2", 1.0001 * own);
    for start in [
        r#"run.start={"rocker":{"displacement":[60],"speed":[0]}}"#,
        r#"run.start={"rocker":{"displacement":[0],"speed":[0]}}"#,
        "run.start=on_law",
    ] {
        settings[4] = start;
        for cell in cells(&document, question(&settings, &axis, None)) {
            assert_eq!(cell.verdict, Verdict::Resonance, "{start}: {cell:?}");
            assert!(cell.cause.contains("harmonic 1 of the drive"), "{cell:?}");
        }
    }
}

#[test]
fn rigid_cells_are_part_of_a_map_over_the_number_of_masses() {
    let document = load(TWO);
    let study = Study::new(
        &document,
        &BuiltIn,
        question(&[], "rocker.masses=0:3:4", None),
    );
    assert_eq!(study.unwrap().figure, "rocker.delta_abs");
    let found = cells(&document, question(&[], "rocker.masses=0:3:4", None));
    // Rigid, the rocker is on its law; and its pair would have to pull.
    assert_eq!(found[0].value, Some(0.0));
    assert_eq!(found[0].verdict, Verdict::LiftOff, "{:?}", found[0]);
    assert!(found[0].cause.contains("rigid rocker would lift off"));
    approx::assert_relative_eq!(found[2].value.unwrap(), 0.00750086, max_relative = 1e-6);
    assert!(found[1..].iter().all(|cell| cell.value > Some(0.007)));
    // Nothing elastic anywhere: the figures that all cells have are named.
    let rigid = question(&["rocker.masses=0"], "rocker.inertia=0.1:1:4", None);
    let Err(StudyFault::Question(what)) = Study::new(&document, &BuiltIn, rigid) else {
        panic!("a figure was found");
    };
    assert!(what.contains("rocker.peak_reaction"), "{what}");
    let named = Question {
        figure: Some("rocker.peak_reaction".to_owned()),
        ..question(&["rocker.masses=0"], "rocker.inertia=0.1:1:4", None)
    };
    assert!(
        cells(&document, named)
            .iter()
            .all(|cell| cell.value > Some(0.0))
    );
}

#[test]
fn what_is_no_answer_about_the_mechanism_is_not_mixed_with_one() {
    // Too few switches allowed: by exact propagation and by a general method.
    for method in ["run.method=auto", "run.method=dop853"] {
        let settings = ["run.max_switches=5", method];
        let found = cells(
            &load(TWO),
            question(&settings, "rocker.inertia=0.05:0.1:2", None),
        );
        assert_eq!(found[0].verdict, Verdict::InWorkingOrder);
        assert_eq!(found[1].verdict, Verdict::NotFinished, "{:?}", found[1]);
        assert_eq!(
            (found[1].value, found[1].verdict.family()),
            (None, Family::Computation)
        );
        assert!(found[1].cause.contains("5 events"), "{}", found[1].cause);
    }
    // A scene that is none at some values.
    let found = cells(
        &load(TWO),
        question(&[], "rocker.inertia=-0.05:0.1:4", None),
    );
    assert!(
        found[..2]
            .iter()
            .all(|cell| cell.verdict == Verdict::Refused && cell.value.is_none())
    );
    assert!(
        found[2..]
            .iter()
            .all(|cell| cell.verdict.family() == Family::Mechanism)
    );
    assert!(found[0].cause.contains("inertia"), "{}", found[0].cause);
    // A dead-centre position.
    let short = Question {
        figure: Some("slide.peak_speed".to_owned()),
        ..question(
            &["run.duration=4"],
            "slide.position.slider_crank.rod=80:120 mm:2",
            None,
        )
    };
    let found = cells(&load("limits/short_rod.json"), short);
    assert_eq!(
        (found[0].verdict, found[0].value),
        (Verdict::Stopped, None),
        "{:?}",
        found[0]
    );
    assert_eq!(found[1].verdict, Verdict::InWorkingOrder, "{:?}", found[1]);
    // A rigid follower that would lift off.
    let rigid = Question {
        figure: Some("valve.pair.margin".to_owned()),
        ..question(&[], "camshaft.motion.speed=1500:3000 rpm:2", None)
    };
    let found = cells(&load("valve_train/rigid_margin.json"), rigid);
    assert_eq!(found[0].verdict, Verdict::InWorkingOrder);
    assert_eq!(found[1].verdict, Verdict::LiftOff);
    for cell in &found {
        let (value, margin) = (cell.value.unwrap(), cell.rigid_margin.unwrap());
        approx::assert_relative_eq!(value, margin, max_relative = 1e-4);
    }
}

#[test]
fn cells_that_hang_on_the_last_digits_are_marked() {
    let checked = |x: &str, y: &str| {
        let question = Question {
            check_determined: true,
            digits: 7,
            ..question(&["run.duration=1"], x, Some(y))
        };
        cells(&load(TWO), question)
    };
    let found = checked("rocker.inertia=0.44:0.46:3", "rocker.stiffness=1e7:2e7:5");
    let marked = |cell: &&Cell| cell.determined == Some(false);
    let first = found
        .iter()
        .find(marked)
        .expect("some cell is not determined");
    assert!(first.value.is_some() && first.moved.is_none_or(|moved| moved > 1e-7));
    assert!(
        first.cause.contains("when the loads change by 1e-10"),
        "{}",
        first.cause
    );
    let quiet = checked("rocker.inertia=0.05:0.06:2", "rocker.stiffness=1e7:2e7:2");
    for cell in &quiet {
        assert_eq!(cell.verdict, Verdict::InWorkingOrder);
        // A deflection under loads moves as the loads do.
        assert!(cell.moved.unwrap() < 1e-9, "{cell:?}");
    }
}

#[test]
fn questions_without_sense_are_refused() {
    let document = load(TWO);
    let ask = |question: Question| match Study::new(&document, &BuiltIn, question) {
        Ok(_) => panic!("this question makes no sense"),
        Err(StudyFault::Scene(diagnostics)) => diagnostics.render(false),
        Err(StudyFault::Question(what)) => what,
    };
    let twice = question(&[], "rocker.inertia=1:2:3", Some("rocker.inertia=1:2:3"));
    assert!(ask(twice).contains("on both axes"));
    let many = question(
        &[],
        "rocker.inertia=1:2:2000",
        Some("rocker.stiffness=1:2:2000"),
    );
    assert!(ask(many).contains("4000000 cells"));
    let figure = Question {
        figure: Some("rocker.delta_mx".to_owned()),
        ..question(&[], "rocker.inertia=1:2:3", None)
    };
    assert!(ask(figure).contains("rocker.delta_max"));
    assert!(ask(question(&[], "roker.inertia=1:2:3", None)).contains("rocker"));
    assert!(ask(question(&[], "rocker.inertia=1:2 rpm:3", None)).contains("rpm"));
    let fixed = Question {
        panels: Panels::parse(&["rocker.inertia=1,2".to_owned()]).unwrap(),
        ..question(&[], "rocker.inertia=1:2:3", None)
    };
    assert!(ask(fixed).contains("on an axis"));
}

#[test]
fn determined_cells_agree_with_an_independent_computation() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/map.json");
    let reference: serde_json::Value =
        serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap();
    let document = load(TWO);
    let mut compared = 0;
    for entry in reference["cells"].as_array().unwrap() {
        let number = |name: &str| entry[name].as_f64().unwrap();
        let (inertia, stiffness) = (number("inertia"), number("stiffness"));
        let x = format!("rocker.inertia={inertia}:{}:2", inertia + 0.001);
        let settings = [
            format!("rocker.stiffness={stiffness}"),
            "run.duration=0.5".to_owned(),
        ];
        let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
        let asked = Question {
            check_determined: true,
            digits: 7,
            figure: Some("rocker.delta_max".to_owned()),
            ..question(&settings, &x, None)
        };
        let cell = cells(&document, asked).remove(0);
        if cell.determined == Some(false) {
            continue;
        }
        compared += 1;
        approx::assert_relative_eq!(
            cell.value.unwrap(),
            number("delta_max"),
            max_relative = 1e-6
        );
    }
    assert!(compared >= 8, "{compared} cells compared");
}

/// A map over a coordinate of a point: after a quarter of a turn the pin is √(l² − r²) away.
#[test]
fn coordinates_of_points_are_parameters() {
    let text = r#"{ "dam": 1, "name": "Slider-crank", "objects": {
        "shaft": { "kind": "drive", "motion": { "speed": "30 rpm" } },
        "press": { "kind": "linkage", "input": "shaft", "ground": { "O": [0, 0] },
          "links": { "crank": { "points": { "A": [0.1, 0] } }, "rod": { "points": { "B": [0.4, 0] } },
            "slide": { "mass": 1 } },
          "pairs": { "O": { "revolute": ["ground.O", "crank.origin"] },
            "A": { "revolute": ["crank.A", "rod.origin"] }, "B": { "revolute": ["rod.B", "slide.origin"] },
            "guide": { "sliding": { "guide": "ground.O", "block": "slide.origin" } } },
          "driver": "O", "assembly": { "slide": { "near": [0.5, 0] } },
          "outputs": { "ram": { "point": "slide.origin" } } } },
      "run": { "duration": 0.5, "samples": 10 } }"#;
    let document = Document::parse("press.json", text.as_bytes()).unwrap();
    for name in ["press.links.rod.points.B.0", "press.links.rod.points.B[0]"] {
        let asked = Question {
            figure: Some("press.ram.final.displacement".to_owned()),
            ..question(&[], &format!("{name}=0.3:0.5:3"), None)
        };
        let found: Vec<f64> = cells(&document, asked)
            .iter()
            .map(|cell| cell.value.unwrap())
            .collect();
        for (value, length) in found.iter().zip([0.3f64, 0.4, 0.5]) {
            assert!(
                (value - (length * length - 0.01).sqrt()).abs() < 1e-12,
                "{name}: {found:?}"
            );
        }
    }
}
