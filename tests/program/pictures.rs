//! What the pictures of pages show: the whole machine in one figure with its loads, rise, dwell and
//! return behind charts, and a diagram that fills its frame.

use serde_json::Value;
use std::path::Path;
use std::process::Command;

fn dam(arguments: &[&str], folder: &Path) {
    let run = Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap();
    // 1: the mechanism is not in working order.
    assert!(matches!(run.status.code(), Some(0 | 1)), "{run:?}");
}

/// The page that a command writes for a scene of the project, or for `cam.json`, made anew.
fn page(arguments: &[&str]) -> (String, tempfile::TempDir) {
    let folder = tempfile::tempdir().unwrap();
    dam(&["new", "cam", "cam.json"], folder.path());
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let full = |one: &&str| match one.starts_with("scenarios/") {
        true => root.join(one).display().to_string(),
        false => (*one).to_owned(),
    };
    let arguments: Vec<String> = arguments.iter().map(full).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    dam(
        &[&words[..], &["--quiet", "--out", "out"]].concat(),
        folder.path(),
    );
    let page = std::fs::read_to_string(folder.path().join("out/report.html")).unwrap();
    (page, folder)
}

/// The JSON of an element of a page.
fn data(page: &str, id: &str) -> Value {
    let at = page
        .find(&format!("id=\"{id}\""))
        .unwrap_or_else(|| panic!("{id}"));
    let text = page[at..].split_once('>').unwrap().1;
    serde_json::from_str(text.split("</script>").next().unwrap()).unwrap()
}

#[test]
fn the_machine_of_a_run_is_one_picture_with_dimensions_and_loads() {
    let (page, _folder) = page(&["run", "cam.json"]);
    assert_eq!(page.matches("<svg class=\"mechanism\"").count(), 1);
    // The drive is where it turns the cam: no station of its own, but named.
    assert_eq!(page.matches("data-first=").count(), 1);
    for shown in [
        ">camshaft</a>",
        ">follower</a>",
        "r = 30 mm",
        "class=\"sense\"",
        "class=\"dim scale\"",
    ] {
        assert!(page.contains(shown), "{shown}");
    }
    assert_eq!(page.matches("class=\"join\"").count(), 0);
    // The spring of 10 N/mm and 80 N pushes the follower back.
    let (moving, plots) = (data(&page, "machine-data"), data(&page, "data"));
    let set = &moving["sets"][0];
    assert_eq!(
        (set["name"].as_str(), set["on"].as_array().unwrap().len()),
        (Some("loads"), 1)
    );
    let arrow = &set["on"][0];
    let column =
        |index: &Value| &plots["columns"][usize::try_from(index.as_u64().unwrap()).unwrap()];
    let forces = column(&arrow["column"]).as_array().unwrap();
    let lifts = column(&moving["columns"][1]["values"]).as_array().unwrap();
    assert!(forces.len() == lifts.len() && lifts.len() > 900);
    let mut longest: f64 = 0.0;
    for (force, lift) in forces.iter().zip(lifts) {
        let [force, lift] = [force, lift].map(|one| one.as_f64().unwrap());
        let expected = -80.0 - 10e3 * lift;
        assert!(
            (force - expected).abs() < 1e-5 * expected.abs(),
            "{force} {expected}"
        );
        longest = longest.max(force.abs());
    }
    // Outwards is up on the picture: y counts downwards. The longest arrow has 64 pixels.
    let by: [f64; 2] = serde_json::from_value(arrow["by"].clone()).unwrap();
    assert!(
        by[0].abs() < 1e-9 && (by[1] * longest + 64.0).abs() < 1e-3,
        "{by:?}"
    );
}

#[test]
fn stations_are_joined_along_the_flow_of_motion() {
    let scene = "scenarios/fan_out/sewing_machine.json";
    let (page, _folder) = page(&["run", scene, "--set", "run.duration=0.05"]);
    assert_eq!(page.matches("<svg class=\"mechanism\"").count(), 1);
    // The motor turns the shaft, this the needle bar and the law of the take-up, and that the take-up.
    assert_eq!(page.matches("class=\"join\"").count(), 4);
    assert_eq!(page.matches("data-first=").count(), 5);
    // Both linkages are to one scale.
    let bars: Vec<&str> = page.split("class=\"dim scale\"").skip(1).collect();
    let length = |bar: &&str| {
        bar.split("</g>")
            .next()
            .unwrap()
            .split("-4h")
            .nth(1)
            .unwrap()
            .to_owned()
    };
    let lengths: Vec<String> = bars
        .iter()
        .map(length)
        .map(|text| text.split('m').next().unwrap().to_owned())
        .collect();
    assert_eq!(lengths.len(), 2);
    assert_eq!(lengths[0], lengths[1]);
}

#[test]
fn rise_dwell_and_return_stand_behind_charts_over_the_machine_angle() {
    let (page, _folder) = page(&["run", "cam.json", "--abscissa", "last-turn"]);
    let plots = data(&page, "data");
    let plot = |id: &str| {
        let mut all = plots["plots"].as_array().unwrap().iter();
        all.find(|plot| plot["id"] == id)
            .unwrap_or_else(|| panic!("{id}"))
            .clone()
    };
    let phases: Vec<[f64; 2]> =
        serde_json::from_value(plot("follower.speed")["phases"].clone()).unwrap();
    // Its scene: rise over 120 deg, dwell of 30, return over 120.
    for (phase, expected) in
        phases
            .iter()
            .zip([[0.0, 120.0], [120.0, 150.0], [150.0, 270.0], [270.0, 360.0]])
    {
        for (found, expected) in phase.iter().zip(expected) {
            assert!((found - expected).abs() < 4.0, "{phases:?}");
        }
    }
    assert_eq!(phases.len(), 4);
    assert!(plot("camshaft.displacement")["phases"].is_null());
    for name in ["rise", "dwell", "return"] {
        assert!(
            page.contains(&format!("<g class=\"phase {name}\">")),
            "{name}"
        );
    }
}

#[test]
fn the_energy_mass_diagram_fills_its_frame() {
    let (page, _folder) = page(&["steady", "scenarios/steady/engine.json"]);
    let plots = data(&page, "data");
    let all = plots["plots"].as_array().unwrap();
    let plot = all
        .iter()
        .find(|plot| plot["title"].as_str().unwrap().starts_with("Energy-mass"))
        .unwrap();
    let curve = &plot["series"][0];
    for axis in ["x", "y"] {
        let index = usize::try_from(curve[axis].as_u64().unwrap()).unwrap();
        let values: Vec<f64> = serde_json::from_value(plots["columns"][index].clone()).unwrap();
        let span = |all: &[f64]| {
            let most = all.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            most - all.iter().copied().fold(f64::INFINITY, f64::min)
        };
        let ends: Vec<f64> = serde_json::from_value(plot[axis]["ends"].clone()).unwrap();
        assert!(
            span(&values) > 0.6 * span(&ends),
            "{axis}: {} of {}",
            span(&values),
            span(&ends)
        );
    }
    assert!(page.contains("O₂ lies outside it"));
}

#[test]
fn laws_and_methods_are_named_in_words() {
    let folder = tempfile::tempdir().unwrap();
    dam(
        &["law", "show", "modified_sine", "--out", "out"],
        folder.path(),
    );
    let law = std::fs::read_to_string(folder.path().join("out/report.html")).unwrap();
    for title in ["Displacement θ", "Speed θ′", "Acceleration θ″", "Jerk θ‴"] {
        assert!(law.contains(&format!("\"title\":\"{title}\"")), "{title}");
    }
    let scene = "scenarios/rocker/one_mass.json";
    let short = ["--set", "run.duration=0.01", "--accuracy", "1e-4"];
    let methods = ["--repeats", "1", "--methods", "exact,rk4"];
    let (page, _folder) = page(&[&["methods", scene], &short[..], &methods].concat());
    for words in ["Runge–Kutta method of order 4", "closed-form motion"] {
        assert!(page.contains(words), "{words}");
    }
}
