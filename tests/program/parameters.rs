//! Named parameters of scenes: what they mean, how they are set and varied.

use dam::Scene;
use dam::lower::lower;
use dam::scene::{BuiltIn, Document, Overrides};
use proptest::prelude::*;
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

/// A scene with parameters wherever numbers and expressions are.
const SCENE: &str = r#"{ "dam": 1, "name": "parameters",
  "parameters": { PARAMETERS },
  "objects": {
    "shaft": { "kind": "drive", "motion": { "speed": "n" } },
    "slide": {
      "kind": "slider", "input": "shaft",
      "position": { "sine": { "amplitude": "half + 5 mm" } },
      "inertia": "m_0/2", "stiffness": "k*10 N/mm", "damping_capacity": 0.4, "masses": "k - 1",
      "loads": {
        "closing": { "constant": "-F" },
        "table": { "time_table": [[0, 0], ["1 s/k", "F"]] },
        "shaking": { "expression": "F*sin(2*pi*k*t + over_phi)", "over": "shaft" }
      }
    }
  },
  "run": {
    "duration": "0.1*k*1 s",
    "first_times": { "far": { "of": "slide", "condition": "phi > half/2 && t > k/100" } }
  },
  "expect": [{ "figure": "slide.final.displacement", "value": "half", "within": "2*r" }]
}"#;

const GIVEN: &str =
    r#""r": "50 mm", "n": "300 rpm", "k": 3, "half": "r/2", "F": "600 N", "m_0": "4 kg""#;

fn with(parameters: &str) -> String {
    SCENE.replace("PARAMETERS", parameters)
}

fn dam(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(arguments)
        .output()
        .unwrap()
}

fn written(folder: &Path, text: &str) -> String {
    let path = folder.join("scene.json");
    std::fs::write(&path, text).unwrap();
    path.display().to_string()
}

fn answer(arguments: &[&str]) -> Value {
    let output = dam(arguments);
    let error = String::from_utf8_lossy(&output.stderr);
    serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{arguments:?}: {error}"))
}

/// What a scene means: its model, its run and its expectations.
fn meaning(text: &str, set: &[String]) -> String {
    let document = Document::parse("scene.json", text.as_bytes()).unwrap();
    let reading = document.scene(&BuiltIn, &Overrides::new(set.to_vec()));
    let scene = reading.unwrap_or_else(|faults| panic!("{faults}")).scene;
    format!("{:?} {:?} {:?}", lower(&scene), scene.run, scene.expect)
}

/// The same scene with numbers in place of names.
fn inlined([r, n, k, force, mass]: [f64; 5]) -> String {
    let (half, k) = (r / 2.0, k.round());
    let speed = n / 60.0 * std::f64::consts::TAU;
    let numbers = [
        ("\"n\"", format!("{speed:?}")),
        ("\"half + 5 mm\"", format!("{:?}", half + 5e-3)),
        ("\"m_0/2\"", format!("{:?}", mass / 2.0)),
        ("\"k*10 N/mm\"", format!("{:?}", k * 1e4)),
        ("\"k - 1\"", format!("{:?}", k as u32 - 1)),
        ("\"-F\"", format!("{:?}", -force)),
        ("\"1 s/k\"", format!("{:?}", 1.0 / k)),
        ("\"F\"", format!("{force:?}")),
        (
            "F*sin(2*pi*k*t + over_phi)",
            format!("{force:?}*sin(2*pi*{k:?}*t + over_phi)"),
        ),
        ("\"0.1*k*1 s\"", format!("{:?}", 0.1 * k)),
        ("half/2", format!("{half:?}/2")),
        ("k/100", format!("{k:?}/100")),
        ("\"half\"", format!("{half:?}")),
        ("\"2*r\"", format!("{:?}", 2.0 * r)),
    ];
    let text = SCENE.replace("\"parameters\": { PARAMETERS },", "");
    let text = numbers
        .iter()
        .fold(text, |text, (name, number)| text.replace(name, number));
    assert!(!text.contains("half") && !text.contains("m_0"), "{text}");
    text
}

/// Expressions print as they were written, and are the same program.
fn without_texts(meaning: &str) -> String {
    let text = meaning.split("text: \"");
    let rest = |part: &str| {
        part.split_once('"')
            .map_or(part.to_owned(), |(_, rest)| rest.to_owned())
    };
    text.enumerate()
        .map(|(at, part)| if at == 0 { part.to_owned() } else { rest(part) })
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// A scene with parameters is the scene with their values, to the last bit of each
    /// number that is not rounded on the way.
    #[test]
    fn a_parameter_is_its_value(
        r in 1e-3..1.0f64, n in 1.0..1e3f64, k in 2..9u32, force in 1.0..1e4f64, mass in 0.1..1e3f64,
    ) {
        let values = [r, n, f64::from(k), force, mass];
        let given = format!(
            r#""half": "r/2", "r": "{r:?} m", "n": {:?}, "k": {k}, "F": {force:?}, "m_0": "{mass:?} kg""#,
            n / 60.0 * std::f64::consts::TAU,
        );
        // A pure number cannot be added to a length, but takes the unit of its slot.
        let own = meaning(&with(&given), &[]);
        prop_assert_eq!(without_texts(&own), without_texts(&meaning(&inlined(values), &[])));
        // Set from outside it is the same as written.
        let set = [format!("parameters.r={r:?} m"), format!("parameters.k={k}")];
        let other = given.replace(&format!("\"{r:?} m\""), "\"1 m\"").replace(&format!("\"k\": {k}"), "\"k\": 2");
        prop_assert_eq!(own, meaning(&with(&other), &set));
    }
}

#[test]
fn what_depends_on_a_parameter_follows_it_in_every_command() {
    let folder = tempfile::tempdir().unwrap();
    let scene = written(folder.path(), &with(GIVEN));
    let stroke = |document: &Value| document["objects"]["slide"]["peak_speed"].as_f64().unwrap();
    let rigid = ["--set", "slide.masses=0"];
    let speed = |set: &str| {
        let call = ["run", &scene, "--json", "--set", set];
        stroke(&answer(&[&call[..], &rigid].concat()))
    };
    // Peak speed of a sine: amplitude times speed, once per value of its parameter.
    let n = 10.0 * std::f64::consts::PI;
    for (set, wanted) in [
        ("parameters.r=50mm", 0.03 * n),
        ("parameters.r=70 mm", 0.04 * n),
        ("parameters.half=45 mm", 0.05 * n),
        ("parameters.n=600 rpm", 0.06 * n),
        // The address of a derived number sets this number alone.
        ("slide.position.sine.amplitude=10 mm", 0.01 * n),
    ] {
        approx::assert_relative_eq!(speed(set), wanted, max_relative = 1e-6);
    }
    let compared = answer(&[
        "compare",
        &scene,
        "--json",
        "--over",
        "parameters.r=50 mm,70 mm",
        "--set",
        "slide.masses=0",
    ]);
    let mut found = Vec::new();
    numbers(&compared, &mut found);
    for wanted in [0.03 * n, 0.04 * n] {
        let near = |value: &f64| (value - wanted).abs() < 1e-6 * wanted;
        assert!(found.iter().any(near), "{wanted}: {compared}");
    }
    let map = answer(&[
        "map",
        &scene,
        "--json",
        "--quiet",
        "--x",
        "parameters.r=50:70 mm:3",
        "--unchecked",
        "--set",
        "slide.masses=0",
        "--figure",
        "slide.peak_speed",
    ]);
    let mut found = Vec::new();
    numbers(&map, &mut found);
    for wanted in [0.03 * n, 0.035 * n, 0.04 * n] {
        let near = |value: &f64| (value - wanted).abs() < 1e-6 * wanted;
        assert!(found.iter().any(near), "{wanted}: {map}");
    }
}

fn numbers(value: &Value, found: &mut Vec<f64>) {
    match value {
        Value::Number(number) => found.extend(number.as_f64()),
        Value::Array(items) => items.iter().for_each(|item| numbers(item, found)),
        Value::Object(map) => map.values().for_each(|item| numbers(item, found)),
        _ => {}
    }
}

#[test]
fn a_scene_that_is_read_and_printed_keeps_its_parameters() {
    let scene = Scene::from_json(&with(GIVEN)).unwrap();
    assert!(scene.json().contains("\"half\": \"r/2\""));
    let set = scene.clone().set("parameters.r", "60 mm");
    let again = Scene::from_json(set.json()).unwrap();
    assert_eq!(again.json(), scene.json());
    // The hash is that of the values in force.
    let hash = |scene: &Scene| scene.decode().unwrap().scene.hash;
    assert_eq!(hash(&scene), hash(&again));
    assert_ne!(hash(&scene), hash(&set));
}

#[test]
fn a_property_is_set_by_either_of_its_names() {
    let folder = tempfile::tempdir().unwrap();
    let named = with(GIVEN).replace("\"inertia\"", "\"mass\"");
    let hash = |text: &str, set: &[&str]| {
        let scene = written(folder.path(), text);
        let arguments = [&["check", &scene, "--json"], set].concat();
        answer(&arguments)["hash"].as_str().unwrap().to_owned()
    };
    // The canonical scene has the first name.
    assert_eq!(hash(&named, &[]), hash(&with(GIVEN), &[]));
    let by_first = hash(&named, &["--set", "slide.inertia=7"]);
    assert_eq!(by_first, hash(&named, &["--set", "slide.mass=7 kg"]));
    assert_eq!(by_first, hash(&with(GIVEN), &["--set", "slide.mass=7 kg"]));
}

#[test]
fn parameters_are_named_in_code() {
    let text = Scene::from_json(&with("")).unwrap();
    let pairs = [
        ("r", "50 mm"),
        ("n", "300 rpm"),
        ("half", "r/2"),
        ("F", "600 N"),
        ("m_0", "4 kg"),
    ];
    let scene = pairs
        .into_iter()
        .fold(text, |scene, (name, value)| scene.parameter(name, value));
    let scene = scene.parameter("k", 3);
    let hash = |scene: &Scene| scene.decode().unwrap().scene.hash;
    assert_eq!(hash(&scene), hash(&Scene::from_json(&with(GIVEN)).unwrap()));
}

#[test]
fn remarks_name_what_nothing_uses() {
    let folder = tempfile::tempdir().unwrap();
    let unused = format!("{GIVEN}, \"q\": 1, \"two\": \"q*2\"");
    let scene = written(folder.path(), &with(&unused));
    let document = answer(&["check", &scene, "--json"]);
    let remarks = document["diagnostics"].as_array().unwrap();
    assert_eq!(remarks.len(), 1, "{document}");
    assert_eq!(remarks[0]["path"], "parameters.two");
    assert_eq!(remarks[0]["code"], "unused-parameter");
    // What uses it may have been set to another value.
    let document = answer(&["check", &scene, "--json", "--set", "slide.inertia=1"]);
    assert_eq!(
        document["diagnostics"].as_array().unwrap().len(),
        0,
        "{document}"
    );
}

#[test]
fn hostile_parameters_are_refused_in_time() {
    let folder = tempfile::tempdir().unwrap();
    let many = |count: usize, one: &dyn Fn(usize) -> String| {
        let all: Vec<String> = (0..count)
            .map(|at| format!("\"a{at}\":{}", one(at)))
            .collect();
        all.join(",")
    };
    let count = 100_000;
    let nested = format!("\"a\": \"{}1{}\"", "(".repeat(900), ")".repeat(900));
    let long = format!("\"a\": \"1{}\"", "+1".repeat(50_000));
    let scene = |parameters: &str, speed: &str| {
        let text = format!(
            r#"{{"dam":1,"name":"x","parameters":{{{parameters}}},
               "objects":{{"s":{{"kind":"drive","motion":{{"speed":{speed}}}}}}},"run":{{"duration":1}}}}"#
        );
        written(folder.path(), &text)
    };
    let chain = many(count, &|at| match at {
        0 => "\"1 rad/s\"".to_owned(),
        _ => format!("\"a{}\"", at - 1),
    });
    for (parameters, speed, word) in [
        (chain, format!("\"a{}\"", count - 1), "is valid"),
        (
            many(count, &|at| format!("\"a{}\"", (at + 1) % count)),
            "1".to_owned(),
            "in a circle",
        ),
        (
            many(count, &|at| format!("\"b{at}\"")),
            "1".to_owned(),
            "is not known",
        ),
        (
            many(count, &|_| "1".to_owned()),
            "1".to_owned(),
            "nothing refers to",
        ),
        (nested, "1".to_owned(), "nested too deeply"),
        (long, "1".to_owned(), "longer than"),
    ] {
        let output = dam(&["check", &scene(&parameters, &speed)]);
        let text = format!(
            "{}{}",
            String::from_utf8_lossy(&output.stdout),
            String::from_utf8_lossy(&output.stderr)
        );
        assert!(
            text.contains(word),
            "{word}: {}",
            &text[..text.len().min(500)]
        );
    }
}
