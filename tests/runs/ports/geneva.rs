//! A kind from outside the library has all that the library's own have.

use super::wheel::{Geneva, KIND};
use super::{METHODS, document, read, ready, run_by, text};
use approx::{assert_abs_diff_eq, assert_relative_eq};
use dam::integrate::Method;
use dam::lower::lower;
use dam::object::Registry;
use dam::report::diagram::Diagram;
use dam::report::show;
use dam::scene::{BuiltIn, Document, Overrides, schema};
use dam::studies::Control;
use dam::studies::axis::Axis;
use dam::studies::map::{Panels, Question, Silent, Study, Verdict, map};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

fn registry() -> Registry {
    Registry::standard().with_kind(KIND)
}

const RIGID: &str = r#""crank": { "kind": "drive", "motion": { "speed": 4, "angle": 3.1 } },
    "wheel": { "kind": "geneva_wheel", "input": "crank", "slots": 4, "inertia": 0.2, "masses": 0 }"#;
const RUN: &str = r#""duration": 5, "start": "on_law""#;

#[test]
fn its_function_agrees_with_differences() {
    let wheel = Geneva { slots: 6 };
    for theta in [-0.9, -0.3, 0.0, 0.4, 1.0] {
        let jet = wheel.angle(theta);
        let step = 1e-5;
        let (above, below) = (wheel.angle(theta + step), wheel.angle(theta - step));
        let slope = |one: f64, other: f64| (one - other) / (2.0 * step);
        assert_abs_diff_eq!(jet.first, slope(above.value, below.value), epsilon = 1e-9);
        assert_abs_diff_eq!(jet.second, slope(above.first, below.first), epsilon = 1e-8);
        assert_abs_diff_eq!(jet.third, slope(above.second, below.second), epsilon = 1e-7);
    }
}

/// A wheel of four slots: greatest speed 2.414·ω, greatest acceleration 5.41·ω² at
/// 11°28′ before and behind the middle; at the entry it jumps to ω².
#[test]
fn a_rigid_wheel_has_the_figures_of_the_textbook() {
    let (system, settings) = ready(&read(&document(RIGID, RUN, registry())));
    let result = run_by(&system, &settings, None);
    let wheel = &result.figures.objects["wheel"];
    let ratio = 0.5f64.sqrt();
    assert_relative_eq!(
        wheel.peak_speed,
        4.0 * ratio / (1.0 - ratio),
        max_relative = 1e-9
    );
    // cos θ = √(q² + 2) − q, q = (1 + λ²)/4λ.
    let q = 1.5 / (4.0 * ratio);
    let cos: f64 = f64::sqrt(q * q + 2.0) - q;
    let sin = f64::sqrt(1.0 - cos * cos);
    let greatest = ratio * 0.5 * sin / (1.5 - 2.0 * ratio * cos).powi(2);
    assert_abs_diff_eq!(greatest, 5.41, epsilon = 5e-3);
    assert_relative_eq!(
        wheel.peak_acceleration,
        16.0 * greatest,
        max_relative = 1e-6
    );
    assert_relative_eq!(
        wheel.peak_reaction,
        0.2 * 16.0 * greatest,
        max_relative = 1e-6
    );
    // 23.1 rad: the pin has passed three times, and stands in the fourth slot.
    assert_relative_eq!(
        wheel.end.displacement,
        -3.5 * TAU / 4.0,
        max_relative = 1e-12
    );
    assert_eq!(wheel.end.speed, 0.0);
}

#[test]
fn an_elastic_wheel_is_propagated_exactly() {
    let objects = RIGID.replace(
        r#""masses": 0"#,
        r#""masses": 2, "stiffness": 900, "damping_capacity": 0.2"#,
    );
    let run = r#""duration": 3, "tolerance": 1e-10"#;
    let (system, settings) = ready(&read(&document(&objects, run, registry())));
    let auto = run_by(&system, &settings, None);
    assert_eq!(auto.method, Method::Exact);
    for method in METHODS {
        let other = run_by(&system, &settings, Some(method));
        let (one, two) = (
            &auto.figures.objects["wheel"],
            &other.figures.objects["wheel"],
        );
        assert_relative_eq!(one.delta_max, two.delta_max, max_relative = 1e-6);
        assert_relative_eq!(one.delta_min, two.delta_min, max_relative = 1e-6);
        assert_relative_eq!(one.peak_reaction, two.peak_reaction, max_relative = 1e-6);
    }
}

#[test]
fn it_is_shown_with_its_graph_and_its_equations() {
    let model = lower(&read(&document(RIGID, RUN, registry()))).unwrap();
    let diagram = Diagram::of(&model);
    assert_eq!(
        show::graph::tree(&diagram),
        "crank  drive, 4 rad/s\n└─ wheel  geneva_wheel, rigid; own function\n"
    );
    let equations = show::equations::text(&show::equations::equations(&model));
    assert!(
        equations.contains("geneva_wheel, rigid, driven by crank"),
        "{equations}"
    );
    assert!(show::graph::dot(&diagram).contains(r#""crank" -> "wheel""#));
}

#[test]
fn the_schema_knows_it() {
    let schema = schema(&registry());
    let own = &schema["$defs"]["geneva_wheel"];
    let slots = &own["properties"]["slots"]["anyOf"][0];
    assert_eq!(
        (&slots["minimum"], &slots["maximum"]),
        (&3.into(), &24.into())
    );
    assert!(own["description"].as_str().unwrap().contains("Geneva"));
    let required = own["then"]["required"].as_array().unwrap();
    for property in ["input", "slots"] {
        assert!(required.iter().any(|name| name == property), "{property}");
    }
    for property in ["input", "slots", "inertia", "masses", "pair", "loads"] {
        assert!(own["properties"][property].is_object(), "{property}");
    }
    assert_eq!(own["additionalProperties"], false);
    let kinds = |schema: &serde_json::Value| {
        let objects = &schema["properties"]["objects"]["additionalProperties"];
        objects["properties"]["kind"]["enum"]
            .as_array()
            .unwrap()
            .clone()
    };
    assert!(kinds(&schema).iter().any(|kind| kind == "geneva_wheel"));
    // The library alone does not know it.
    let standard = dam::scene::schema(&Registry::standard());
    assert!(standard["$defs"]["geneva_wheel"].is_null());
    assert!(kinds(&standard).iter().all(|kind| kind != "geneva_wheel"));
}

fn diagnostics(objects: &str) -> String {
    let document = document(objects, RUN, registry());
    let reading = document.scene(&BuiltIn, &Overrides::none());
    reading.expect_err("faults").to_string()
}

#[test]
fn its_faults_are_told_with_their_places() {
    let told = diagnostics(&RIGID.replace(r#""slots": 4"#, r#""slots": 2"#));
    assert!(told.contains("slots") && told.contains("^"), "{told}");
    let told = diagnostics(&RIGID.replace(r#""slots": 4, "#, ""));
    assert!(told.contains("`slots`"), "{told}");
    let told = diagnostics(&RIGID.replace("geneva_wheel", "geneva_weel"));
    assert!(told.contains("did you mean `geneva_wheel`?"), "{told}");
    let told = diagnostics(&RIGID.replace(
        r#""motion": { "speed": 4, "angle": 3.1 }"#,
        r#""coordinate": "sliding", "motion": { "speed": 4 }"#,
    ));
    assert!(told.contains("the crank of a Geneva wheel turns"), "{told}");
    // Without its registry nothing is known of it.
    let plain = Document::parse("scene.json", text(RIGID, RUN).as_bytes()).unwrap();
    let told = plain.scene(&BuiltIn, &Overrides::none()).unwrap_err();
    assert!(
        told.to_string().contains("unknown kind `geneva_wheel`"),
        "{told}"
    );
}

#[test]
fn it_is_mapped() {
    let objects = RIGID.replace(
        r#""masses": 0"#,
        r#""masses": 1, "stiffness": 900, "damping_capacity": 0.2, "pair": { "closure": "force" },
            "loads": { "closing": { "constant": -40 } }"#,
    );
    let document = document(&objects, r#""duration": 8"#, registry());
    let question = Question {
        overrides: Vec::new(),
        x: Axis::parse("wheel.inertia=0.02:0.9:4").unwrap(),
        y: None,
        panels: Panels::default(),
        figure: None,
        digits: 3,
        check_determined: false,
    };
    let study = Study::new(&document, &BuiltIn, question).unwrap();
    let result = map(
        &study,
        BTreeMap::new(),
        Some(1),
        &Control::default(),
        &Silent,
    )
    .unwrap();
    let cells: Vec<_> = result.panels.concat().into_iter().flatten().collect();
    let verdicts: Vec<Verdict> = cells.iter().map(|cell| cell.verdict).collect();
    assert_eq!(verdicts.len(), 4);
    assert_eq!(verdicts[0], Verdict::InWorkingOrder, "{verdicts:?}");
    assert_eq!(verdicts[3], Verdict::ThrownOff, "{verdicts:?}");
}
