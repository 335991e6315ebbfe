//! What a designer reads is what is true: units of lists, warnings of what is
//! likely not meant, the machine on the page of a run, maps that answer.

use crate::browser::{browser, dom};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const VALVE: &str = "scenarios/valve_train/lift_off.json";
const ROCKER: &str = "scenarios/rocker/two_masses.json";

fn dam(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(arguments)
        .output()
        .unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn json_of(arguments: &[&str]) -> Value {
    let output = dam(arguments);
    serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|error| panic!("{arguments:?}: {error}: {}", text(&output.stderr)))
}

/// A scene in a folder of its own.
struct Written {
    _folder: tempfile::TempDir,
    path: PathBuf,
}

impl Written {
    fn new(scene: &Value) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("scene.json");
        std::fs::write(&path, scene.to_string()).unwrap();
        Self {
            _folder: folder,
            path,
        }
    }

    fn path(&self) -> &str {
        self.path.to_str().unwrap()
    }
}

// ---- lists carry units ---------------------------------------------------------------

#[test]
fn a_unit_after_a_list_is_that_of_all_its_values() {
    let run = |over: &str| json_of(&["compare", VALVE, "--over", over, "--json", "-q"]);
    let short = run("valve.stiffness=5,10,20 kN/mm");
    let long = run("valve.stiffness=5 kN/mm,10 kN/mm,20 kN/mm");
    assert_eq!(short["table"], long["table"]);
    assert_eq!(
        short["table"]["labels"],
        json!(["5 kN/mm", "10 kN/mm", "20 kN/mm"])
    );
    // 5 kN/mm = 5e6 N/m and so on, by numbers without a unit.
    let plain = run("valve.stiffness=5e6,1e7,2e7");
    assert_eq!(short["table"]["rows"], plain["table"]["rows"]);
}

#[test]
fn a_list_in_which_a_unit_may_mean_two_things_is_refused() {
    let scene = "scenarios/kinetostatics/slider_crank.json";
    for arguments in [
        vec!["compare", VALVE, "--over", "valve.stiffness=5 kN/mm,10"],
        vec!["map", VALVE, "--x", "camshaft.motion.speed=500 rpm:900:3"],
        vec![
            "map",
            VALVE,
            "--x",
            "camshaft.motion.speed=500:900 rpm:3",
            "--panels",
            "valve.stiffness=5 kN/mm,10",
        ],
        vec![
            "methods",
            VALVE,
            "--x",
            "camshaft.motion.speed=500 rpm:900:3",
        ],
        vec!["kinematics", scene, "--range", "10 deg:90"],
        vec!["forces", scene, "--range", "10 deg:90"],
    ] {
        let output = dam(&arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        let said = text(&output.stderr);
        assert!(said.contains("has no unit"), "{arguments:?}: {said}");
    }
}

#[test]
fn both_ends_of_a_range_are_in_the_unit_after_the_last() {
    let scene = "scenarios/kinetostatics/slider_crank.json";
    let rows = |range: &str| {
        let output = dam(&[
            "kinematics",
            scene,
            "--range",
            range,
            "--positions",
            "4",
            "--csv",
        ]);
        assert!(output.status.success(), "{}", text(&output.stderr));
        text(&output.stdout)
    };
    let wanted = rows("10 deg:90 deg");
    assert_eq!(rows("10:90 deg"), wanted);
    assert_eq!(rows("10:90°"), wanted);
}

#[test]
fn figures_of_comparisons_carry_their_units() {
    let over = "rocker.masses=1,2";
    let settings = ["--set", "run.duration=0.02"];
    let with = |more: &[&str]| {
        let mut all = vec!["compare", ROCKER, "--over", over];
        all.extend(settings);
        all.extend(more);
        all.into_iter().map(str::to_owned).collect::<Vec<_>>()
    };
    let called = |arguments: &[String]| {
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        text(&dam(&arguments).stdout)
    };
    let table = called(&with(&["-q"]));
    let line = |figure: &str| {
        let of_rocker = |line: &&str| !line.starts_with("Figures of rocker");
        let mut rows = table.lines().skip_while(of_rocker);
        let found = rows.find(|line| line.trim_start().starts_with(figure));
        found
            .unwrap_or_else(|| panic!("{figure}: {table}"))
            .to_owned()
    };
    assert!(line("delta_abs ").contains("60 µrad"), "{table}");
    assert!(line("peak_acceleration ").contains(" rad/s² "), "{table}");
    assert!(line("peak_reaction ").contains("N m "), "{table}");
    let document: Value = serde_json::from_str(&called(&with(&["-q", "--json"]))).unwrap();
    let rows = document["table"]["rows"].as_array().unwrap();
    let row = rows.iter().find(|row| row["figure"] == "rocker.peak_speed");
    assert_eq!(row.unwrap()["unit"], "rad/s");
}

// ---- greatest |δ| --------------------------------------------------------------------

#[test]
fn a_contact_force_without_a_limit_is_called_so_wherever_it_is_asked() {
    let force = "rocker.pair.max_contact_force";
    let accuracy = format!(r#"run.accuracy={{"{force}":"1 %"}}"#);
    let asked: [&[&str]; 3] = [
        &["run", ROCKER, "--set", &accuracy],
        &["compare", ROCKER, "--over", "rocker.masses=1,2"],
        &[
            "map",
            ROCKER,
            "--x",
            "rocker.inertia=0.05:0.15:2",
            "--y",
            "rocker.stiffness=1e6:1e7:2",
            "--figure",
            force,
        ],
    ];
    for arguments in asked {
        let told = format!("{force} has no limit with the number of masses");
        let said = dam(arguments);
        let shown = text(&said.stdout) + &text(&said.stderr);
        assert!(shown.contains(&told), "{arguments:?}: {shown}");
        assert!(shown.contains("With `rocker.pair.contact` it has a limit"));
        let json = json_of(&[arguments, &["--json"]].concat());
        let why = &json["accuracy"][force]["why"];
        let warnings = json["warnings"].as_array().into_iter().flatten();
        let mut all = warnings.chain([why]).filter_map(Value::as_str);
        assert!(all.any(|text| text.contains(&told)), "{arguments:?}");
    }
    // Of a contact element it has one.
    let contact = r#"rocker.pair.contact={"stiffness":1e8}"#;
    let said = dam(&[
        "compare",
        ROCKER,
        "--over",
        "rocker.masses=1,2",
        "--set",
        contact,
    ]);
    assert!(!text(&said.stderr).contains("no limit"));
}

#[test]
fn the_greatest_deviation_is_a_figure_of_every_object_by_every_method() {
    for method in ["auto", "dop853", "radau"] {
        let setting = format!("run.method=\"{method}\"");
        let document = json_of(&[
            "run",
            ROCKER,
            "--set",
            &setting,
            "--set",
            "run.duration=0.05",
            "--json",
            "-q",
        ]);
        for (id, figures) in document["objects"].as_object().unwrap() {
            let of = |name: &str| figures[name].as_f64().unwrap();
            let wanted = of("delta_max").abs().max(of("delta_min").abs());
            assert_eq!(of("delta_abs"), wanted, "{method}: {id}");
        }
        let rocker = &document["objects"]["rocker"];
        assert!(rocker["delta_abs"].as_f64().unwrap() > 1e-5);
    }
}

/// The valve, preload over speed: of the signed δ the dark cell lies inside the zone
/// of lift-off, where the valve in fact strays least.
#[test]
fn a_map_shows_how_far_the_object_strays() {
    let axis = ["--x", "camshaft.motion.speed=1500:2300 rpm:3"];
    let map = json_of(&[&["map", VALVE], &axis[..], &["--json", "-q", "--unchecked"]].concat());
    assert_eq!(map["figure"], "valve.delta_abs");
    for index in 0..3 {
        let speed = ["1500 rpm", "1900 rpm", "2300 rpm"][index];
        let setting = format!("camshaft.motion.speed={speed}");
        let run = json_of(&["run", VALVE, "--set", &setting, "--json", "-q"]);
        let valve = &run["objects"]["valve"];
        let of = |name: &str| valve[name].as_f64().unwrap();
        let wanted = of("delta_max").abs().max(of("delta_min").abs());
        let shown = map["panels"][0]["values"][index].as_f64().unwrap();
        assert!(
            (shown - wanted).abs() <= 1e-9 * wanted,
            "{speed}: {shown} {wanted}"
        );
    }
}

// ---- what is likely not meant --------------------------------------------------------

/// A crank that goes from 0 to 90 deg, a slider with a load over it.
fn press(load: Value) -> Value {
    json!({
        "dam": 1,
        "name": "press",
        "objects": {
            "crank": { "kind": "drive", "motion": { "speed": "0.25 rev/s" } },
            "ram": {
                "kind": "slider", "input": "crank", "inertia": "2 kg", "stiffness": "20 kN/mm",
                "damping_capacity": 0.2, "masses": 1,
                "position": { "sine": { "amplitude": "40 mm" } },
                "loads": { "cutting": load }
            }
        },
        "run": { "duration": 1 }
    })
}

/// Warnings of `check` and of `run --json`, which are the same.
fn warnings(scene: &Value, settings: &[&str]) -> Vec<String> {
    let written = Written::new(scene);
    let mut arguments = vec!["run", written.path(), "--json", "-q"];
    for setting in settings {
        arguments.extend(["--set", setting]);
    }
    let run = json_of(&arguments);
    let list = |value: &Value| -> Vec<String> {
        let texts = value.as_array().unwrap().iter();
        texts
            .map(|text| text.as_str().unwrap().to_owned())
            .collect()
    };
    let found = list(&run["warnings"]);
    arguments[0] = "check";
    let document = json_of(&arguments);
    let check = list(&document["remarks"]);
    // Under the name that `run` has for them they are there too, beside what is doubtful
    // in the text.
    let named = document["warnings"].as_array().unwrap().iter();
    let named: Vec<&str> = (named.map(|one| one["message"].as_str().unwrap())).collect();
    assert!(check.iter().all(|text| named.contains(&text.as_str())));
    let meant = |text: &&String| text.contains("never") || text.contains("unit");
    let of = |all: &[String]| all.iter().filter(meant).cloned().collect::<Vec<_>>();
    assert_eq!(of(&found), of(&check));
    found
}

#[test]
fn a_window_or_table_that_is_never_entered_is_named() {
    let window = |from: &str, to: &str| {
        press(json!({ "window": { "from": from, "to": to, "force": "-5 kN" } }))
    };
    let found = warnings(&window("170 deg", "180 deg"), &[]);
    assert_eq!(found.len(), 1, "{found:?}");
    for word in [
        "`ram.loads.cutting` never acts",
        "between 170 deg and 180 deg",
        "`crank` goes from",
    ] {
        assert!(found[0].contains(word), "{found:?}");
    }
    assert!(warnings(&window("70 deg", "180 deg"), &[]).is_empty());
    let table = |points: Value| press(json!({ "position_table": { "points": points } }));
    let found = warnings(
        &table(json!([["200 deg", "-1 kN"], ["210 deg", "-2 kN"]])),
        &[],
    );
    assert!(
        found.len() == 1 && found[0].contains("never entered"),
        "{found:?}"
    );
    assert!(
        warnings(
            &table(json!([["20 deg", "-1 kN"], ["210 deg", "-2 kN"]])),
            &[]
        )
        .is_empty()
    );
    // Over time: it begins after the end of the run.
    let late = press(json!({ "time_table": [["2 s", 0], ["3 s", "1 kN"]] }));
    let found = warnings(&late, &[]);
    assert!(
        found.len() == 1 && found[0].contains("the run ends at 1 s"),
        "{found:?}"
    );
    assert!(warnings(&late, &["run.duration=2.5"]).is_empty());
}

/// A period brings every window within reach.
#[test]
fn a_window_that_repeats_is_entered_in_every_turn() {
    let scene = press(json!({ "window": {
        "from": "170 deg", "to": "180 deg", "force": "-5 kN" } }));
    assert_eq!(warnings(&scene, &[]).len(), 1);
    assert!(warnings(&scene, &["crank.motion.speed=2 rev/s"]).is_empty());
    assert!(warnings(&scene, &["crank.motion.speed=-2 rev/s"]).is_empty());
    // The same a turn back, which 90 deg do not reach and 200 deg backwards do.
    assert_eq!(
        warnings(&scene, &["crank.motion.speed=-0.25 rev/s"]).len(),
        1
    );
    assert!(warnings(&scene, &["crank.motion.speed=-0.55 rev/s"]).is_empty());
}

#[test]
fn a_load_that_never_acts_is_named() {
    for load in [
        json!({ "constant": 0 }),
        json!({ "spring": { "rate": 0, "preload": 0 } }),
        json!({ "viscous": 0 }),
        json!({ "window": { "from": "10 deg", "to": "20 deg", "force": 0 } }),
        json!({ "time_table": [[0, 0], ["1 s", 0]] }),
    ] {
        let found = warnings(&press(load.clone()), &[]);
        assert_eq!(found.len(), 1, "{load}: {found:?}");
        assert!(found[0].contains("zero throughout"), "{load}: {found:?}");
    }
    assert!(warnings(&press(json!({ "constant": "-1 N" })), &[]).is_empty());
}

/// Behind a motor only the run tells how far the crank comes.
#[test]
fn a_window_behind_a_motor_is_judged_by_the_run() {
    let mut scene =
        press(json!({ "window": { "from": "200 deg", "to": "210 deg", "force": "-1 N" } }));
    scene["objects"]["crank"] = json!({ "kind": "drive", "motor": {
        "torque": { "constant": "0.01 N m" }, "inertia": "0.1 kg m^2" } });
    let run = |duration: &str| {
        let written = Written::new(&scene);
        let setting = format!("run.duration={duration}");
        let document = json_of(&["run", written.path(), "--set", &setting, "--json", "-q"]);
        document["warnings"].to_string()
    };
    let short = run("1");
    assert!(short.contains("`ram.loads.cutting` never acts"), "{short}");
    let long = run("20");
    assert!(!long.contains("never acts"), "{long}");
}

/// Levers with a cam each beside each other on an elastic shaft, in all places of their
/// motion.
fn levers(count: usize) -> Value {
    let mut objects = json!({
        "motor": { "kind": "drive", "motion": { "speed": "600 rpm" } },
        "shaft": {
            "kind": "shaft", "input": "motor", "position": { "ratio": 1 }, "inertia": 0.1,
            "stiffness": "1 MN m/rad", "damping_capacity": 0.3
        }
    });
    for index in 0..count {
        objects[format!("lever{index}")] = json!({
            "kind": "rocker", "input": "shaft", "inertia": "0.02 kg m^2",
            "stiffness": "20 kN m/rad", "damping_capacity": 0.3,
            "position": { "cam": {
                "lift": "10 deg", "rise": "70 deg", "dwell": "10 deg", "return": "70 deg",
                "law": "4-5-6-7", "phase": format!("{} deg", 37 * index % 360)
            } }
        });
    }
    json!({ "dam": 1, "name": "levers", "objects": objects, "run": { "duration": 0.001 } })
}

#[test]
fn what_rests_in_a_short_run_is_not_out_of_proportion() {
    assert!(warnings(&levers(13), &[]).is_empty());
    // Each that is, once.
    let found = warnings(
        &levers(13),
        &[
            "lever3.stiffness=2e13 N m/rad",
            "lever7.inertia=2e-12 kg m^2",
        ],
    );
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(found[0].contains("stiffness of `lever3`"), "{found:?}");
    assert!(found[1].contains("inertia of `lever7`"), "{found:?}");
    // Of one among many that fit each other it is that one.
    let found = warnings(&levers(13), &["shaft.stiffness=1e15 N m/rad"]);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].contains("stiffness of `shaft`"), "{found:?}");
}

#[test]
fn stiffnesses_and_masses_out_of_proportion_are_named() {
    let scene = json!({
        "dam": 1,
        "name": "two",
        "objects": {
            "crank": { "kind": "drive", "motion": { "speed": "2 rev/s" } },
            "lever": {
                "kind": "rocker", "input": "crank", "inertia": "0.1 kg m^2",
                "stiffness": "1e5 N m/rad", "damping_capacity": 0.2, "masses": 1,
                "position": { "sine": { "amplitude": "20 deg" } }
            },
            "ram": {
                "kind": "slider", "input": "lever", "inertia": "2 kg", "stiffness": "20 kN/mm",
                "damping_capacity": 0.2, "masses": 1,
                "position": { "ratio": "100 mm/rad" }
            }
        },
        "run": { "duration": 0.5 }
    });
    assert!(warnings(&scene, &[]).is_empty());
    // N/mm twice taken for N/m.
    let found = warnings(&scene, &["ram.stiffness=2e13 N/m"]);
    assert!(
        found
            .iter()
            .any(|text| text.contains("stiffness of `ram`") && text.contains("`lever`")),
        "{found:?}"
    );
    let found = warnings(&scene, &["ram.inertia=2e6 kg"]);
    assert!(
        found.iter().any(|text| text.contains("inertia of `ram`")),
        "{found:?}"
    );
    // The same behind a motor.
    let mut motor = scene.clone();
    motor["objects"]["crank"] = json!({ "kind": "drive", "motor": {
        "torque": { "constant": "1 N m" }, "inertia": "0.1 kg m^2" } });
    assert!(warnings(&motor, &["run.duration=0.01"]).is_empty());
    let found = warnings(&motor, &["run.duration=0.01", "ram.stiffness=2e13 N/m"]);
    assert!(
        found.iter().any(|text| text.contains("stiffness of `ram`")),
        "{found:?}"
    );
    // Too soft to follow.
    let found = warnings(&scene, &["lever.stiffness=1e-3 N m/rad"]);
    assert!(
        found
            .iter()
            .any(|text| text.contains("`lever` does not follow its law")),
        "{found:?}"
    );
    let lists = json!({
        "kind": "slider", "input": "lever",
        "inertias": ["1 kg", "1 kg"], "stiffnesses": ["20 kN/mm", "20 N/m"], "dampings": [0, 0],
        "position": { "ratio": "100 mm/rad" }
    });
    let mut chain = scene.clone();
    chain["objects"]["ram"] = lists;
    let found = warnings(&chain, &[]);
    assert!(
        found.iter().any(|text| text.contains("link 1 of `ram`")),
        "{found:?}"
    );
}

#[test]
fn speeds_beyond_sense_are_named() {
    let scene = press(json!({ "constant": "-1 N" }));
    let found = warnings(
        &scene,
        &["crank.motion.speed=30000 rev/s", "run.duration=1e-4"],
    );
    assert!(
        found
            .iter()
            .any(|text| text.contains("`crank` reaches") && text.contains("rpm")),
        "{found:?}"
    );
}

#[test]
fn no_shipped_scene_is_called_unlikely() {
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios")];
    let mut looked_at = 0;
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap().flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let name = path.file_name().unwrap().to_str().unwrap();
            if !name.ends_with(".json") || name.ends_with(".schema.json") {
                continue;
            }
            let remarks =
                json_of(&["check", path.to_str().unwrap(), "--json"])["remarks"].to_string();
            for word in [
                "never acts",
                "never entered",
                "another unit",
                "beyond sense",
                "does not follow",
            ] {
                assert!(!remarks.contains(word), "{}: {remarks}", path.display());
            }
            looked_at += 1;
        }
    }
    assert!(looked_at > 40, "{looked_at}");
}

// ---- the machine moving --------------------------------------------------------------

/// The page of a run, and the data of its player.
fn page(scene: &str, settings: &[&str]) -> (String, Value) {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let mut arguments = vec!["run", scene, "-q", "--out", out.to_str().unwrap()];
    for setting in settings {
        arguments.extend(["--set", setting]);
    }
    let output = dam(&arguments);
    let page = std::fs::read_to_string(out.join("report.html"))
        .unwrap_or_else(|_| panic!("{}", text(&output.stderr)));
    let data = element(&page, "machine-data");
    (page, data)
}

/// The JSON within the element of this id.
fn element(page: &str, id: &str) -> Value {
    let start = page
        .find(&format!("id=\"{id}\""))
        .unwrap_or_else(|| panic!("no {id}"));
    let from = start + page[start..].find('>').unwrap() + 1;
    let to = from + page[from..].find("</script>").unwrap();
    serde_json::from_str(&page[from..to]).unwrap()
}

/// The first series of a chart of a page.
fn plotted<'a>(page: &'a Value, id: &str) -> &'a Value {
    let plots = page["plots"].as_array().unwrap();
    &plots.iter().find(|plot| plot["id"] == id).unwrap()["series"][0]
}

#[test]
fn every_object_is_drawn_moving_and_its_deflection_is_seen() {
    let (page, player) = page(ROCKER, &["run.duration=0.1"]);
    let bodies = player["bodies"].as_array().unwrap();
    let parts = page.matches("data-link=\"").count();
    assert_eq!(bodies.len(), parts);
    // The shaft once, the rocker on its law and magnified.
    let shown: Vec<&str> = bodies
        .iter()
        .map(|body| body["shown"].as_str().unwrap())
        .collect();
    assert_eq!(shown, ["true", "law", "magnified"]);
    assert!(bodies.iter().all(|body| body["kind"] == "turn"));
    let factor = player["magnify"]["factor"].as_f64().unwrap();
    let plots = element(&page, "data");
    let column = player["columns"][1]["deviation"].as_u64().unwrap();
    assert_eq!(
        column,
        plotted(&plots, "rocker.delta")["y"].as_u64().unwrap()
    );
    let values = plots["columns"][column as usize].as_array().unwrap();
    let most = values
        .iter()
        .map(|v| v.as_f64().unwrap().abs())
        .fold(0.0, f64::max);
    // The lever has 76 pixels: its tip goes some pixels, and not out of the picture.
    let pixels = 76.0 * most * factor;
    assert!((4.0..=15.0).contains(&pixels), "{pixels} at {factor}");
}

/// The links of the drawing stand where an independent closure puts them.
#[test]
fn a_linkage_is_drawn_to_scale_where_it_is() {
    let (page, player) = page("scenarios/kinetostatics/slider_crank.json", &[]);
    let body = &player["bodies"]
        .as_array()
        .unwrap()
        .iter()
        .find(|body| body["kind"] == "over")
        .expect("a linkage")
        .clone();
    let table: Vec<f64> = body["table"]
        .as_array()
        .unwrap()
        .iter()
        .map(|v| v.as_f64().unwrap())
        .collect();
    let count = table.len() / 4;
    // The crank turns about its pivot by its input coordinate, from first to last.
    let [from, to] = ["from", "to"].map(|name| body[name].as_f64().unwrap());
    let angle = |place: usize| table[4 * place + 3].atan2(table[4 * place + 2]);
    for place in 0..count {
        let input = from + (to - from) * place as f64 / (count - 1) as f64;
        let off = angle(place) - angle(0) - (input - from);
        let off =
            (off + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI;
        assert!(off.abs() < 1e-5, "{place}: {off}");
        assert!((table[4 * place] - table[0]).abs() < 0.02);
    }
    assert!(page.contains("class=\"station wide\""));
}

#[test]
fn a_follower_rides_on_its_cam() {
    let (_, player) = page("scenarios/cams/flat_tappet.json", &[]);
    let bodies = player["bodies"].as_array().unwrap();
    let columns = player["columns"].as_array().unwrap().len();
    assert!(columns >= 2);
    let kinds: Vec<&str> = bodies
        .iter()
        .map(|body| body["kind"].as_str().unwrap())
        .collect();
    assert!(
        kinds.contains(&"slide") && kinds.contains(&"turn"),
        "{kinds:?}"
    );
    // The cam turns as its shaft does, counterclockwise or the other way, by the same angle.
    for body in bodies.iter().filter(|body| body["kind"] == "turn") {
        assert_eq!(body["sense"].as_f64().unwrap().abs(), 1.0);
    }
}

#[test]
fn scripts_of_the_page_know_the_units_that_take_prefixes() {
    let (page, _) = page(ROCKER, &["run.duration=0.02"]);
    assert!(page.contains(
        r#"const TAKE_ALL = ["N", "J", "W", "Pa", "Hz", "Nm"], TAKE_SMALL = ["s", "m", "rad"];"#
    ));
}

// ---- maps ----------------------------------------------------------------------------

const FIELD: [&str; 6] = [
    "map",
    ROCKER,
    "--x",
    "rocker.inertia=0.4:0.5:3",
    "--y",
    "rocker.stiffness=1e7:2e7:3",
];

fn map_of(more: &[&str]) -> Value {
    let all = [
        &FIELD[..],
        &["--set", "run.duration=1", "--json", "-q"],
        more,
    ]
    .concat();
    json_of(&all)
}

#[test]
fn the_verdict_on_the_mechanism_stays_where_digits_are_lost() {
    let (fine, coarse) = (map_of(&["--digits", "9"]), map_of(&[]));
    let unchecked = map_of(&["--unchecked"]);
    let panel = |map: &Value| map["panels"][0].clone();
    assert_eq!(panel(&fine)["verdicts"], panel(&coarse)["verdicts"]);
    assert_eq!(panel(&unchecked)["verdicts"], panel(&coarse)["verdicts"]);
    let lost = |map: &Value| {
        let cells = panel(map)["determined"].as_array().unwrap().clone();
        cells.iter().filter(|cell| **cell == json!(false)).count()
    };
    assert!(
        lost(&fine) > lost(&coarse),
        "{} {}",
        lost(&fine),
        lost(&coarse)
    );
    assert_eq!(panel(&fine)["summary"]["undetermined"], json!(lost(&fine)));
    // What is said of each follows from how far it moves.
    for map in [&fine, &coarse] {
        let bound = 10f64.powi(-(map["thresholds"]["digits"].as_i64().unwrap() as i32));
        let panel = panel(map);
        for (moved, known) in panel["moved"]
            .as_array()
            .unwrap()
            .iter()
            .zip(panel["determined"].as_array().unwrap())
        {
            if let (Some(moved), Some(known)) = (moved.as_f64(), known.as_bool()) {
                assert_eq!(known, moved <= bound, "{moved}");
            }
        }
    }
}

#[test]
fn the_page_of_a_map_answers_with_every_cell() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let more = [
        "--set",
        "run.duration=0.2",
        "-q",
        "--out",
        out.to_str().unwrap(),
    ];
    let output = dam(&[&FIELD[..], &more].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
    let page = std::fs::read_to_string(out.join("report.html")).unwrap();
    let data = element(&page, "map-data");
    let map: Value = serde_json::from_slice(&std::fs::read(out.join("map.json")).unwrap()).unwrap();
    assert_eq!(
        data["command"],
        json!(["dam", "run", ROCKER, "--set", "run.duration=0.2"])
    );
    assert_eq!(data["x"]["values"], json!(["0.4", "0.45", "0.5"]));
    let (cells, panel) = (&data["panels"][0], &map["panels"][0]);
    for index in 0..9 {
        let cause = &data["causes"][cells["causes"][index].as_u64().unwrap() as usize];
        assert_eq!(*cause, panel["causes"][index]);
        let verdict = data["verdicts"][cells["verdicts"][index].as_u64().unwrap() as usize].clone();
        let name = panel["verdicts"][index].as_str().unwrap().replace('_', " ");
        assert!(
            verdict.as_str().unwrap().starts_with(&name[..7]),
            "{verdict} {name}"
        );
    }
    assert_eq!(page.matches("class=\"plot\" data-plot=\"0\"").count(), 1);
}

// ---- in a browser --------------------------------------------------------------------

/// What a script finds in a page once its own scripts have run; `None` without a browser.
fn asked(page: &str, script: &str) -> Option<Value> {
    let browser = browser()?;
    let folder = tempfile::tempdir().unwrap();
    let ask = format!(
        "<pre id=\"answer\"></pre><script>document.getElementById('answer').textContent = \
         JSON.stringify((() => {{ {script} }})());</script></body>"
    );
    let dom = dom(&browser, &page.replace("</body>", &ask), folder.path());
    let from = dom.find("<pre id=\"answer\">").expect("an answer") + 17;
    let to = from + dom[from..].find("</pre>").unwrap();
    let plain = dom[from..to]
        .replace("&lt;", "<")
        .replace("&gt;", ">")
        .replace("&amp;", "&");
    Some(serde_json::from_str(&plain).unwrap_or_else(|error| panic!("{error}: {plain}")))
}

#[test]
fn machine_and_cursors_go_together() {
    let (page, player) = page(ROCKER, &["run.duration=0.1"]);
    let script = r##"
        const instant = (time) => document.dispatchEvent(new CustomEvent("instant", { detail: { axis: "t s", value: time, by: "plots" } }));
        const poses = () => [...document.querySelectorAll("#machine [data-link]")].map((node) => node.getAttribute("transform").match(/-?[\d.]+(e-?\d+)?/g).map(Number));
        const cursors = () => [...document.querySelectorAll(".pointer")].filter((line) => line.getAttribute("visibility") === "visible").length;
        const before = cursors();
        instant(0.013);
        const at = poses(), shown = cursors();
        const choice = [...document.querySelectorAll("#machine select")].pop();
        choice.value = "1"; choice.dispatchEvent(new Event("change"));
        const plain = poses();
        // The slider of the player leads the cursors.
        const slider = document.querySelector("#machine input[type=range]");
        slider.value = slider.max / 2; slider.dispatchEvent(new Event("input"));
        const pointer = document.querySelector(".pointer");
        return { before, shown, at, plain, x: +pointer.getAttribute("x1"), reading: document.querySelector("#machine output").textContent };
    "##;
    let Some(found) = asked(&page, script) else {
        return;
    };
    assert_eq!(found["before"], 0);
    assert!(found["shown"].as_u64().unwrap() >= 4, "{found}");
    let pose = |list: &Value, part: usize| -> Vec<f64> {
        list[part]
            .as_array()
            .unwrap()
            .iter()
            .map(|v| v.as_f64().unwrap())
            .collect()
    };
    let angle = |pose: &[f64]| pose[2].atan2(pose[0]);
    // The shaft turns at 10 rev/s.
    let shaft = angle(&pose(&found["at"], 0)) - std::f64::consts::TAU * 0.13;
    assert!(shaft.abs() < 1e-6, "{shaft}");
    // The lever: its law, and its law with the deflection magnified.
    let plots = element(&page, "data");
    let values = |id: &str, quantity: &str| {
        let series = plotted(&plots, &format!("{id}.{quantity}"));
        let column = |name: &str| &plots["columns"][series[name].as_u64().unwrap() as usize];
        let times = column("x").as_array().unwrap();
        let row = times
            .iter()
            .position(|t| t.as_f64().unwrap() >= 0.013 - 1e-12)
            .unwrap();
        column("y")[row].as_f64().unwrap()
    };
    let offset = player["bodies"][1]["offset"].as_f64().unwrap();
    let (phi, delta) = (values("rocker", "displacement"), values("rocker", "delta"));
    let factor = player["magnify"]["factor"].as_f64().unwrap();
    for (part, list, wanted) in [
        (1, &found["at"], phi - delta),
        (2, &found["at"], phi - delta + factor * delta),
        (2, &found["plain"], phi),
    ] {
        let off = angle(&pose(list, part)) - offset - wanted;
        assert!(off.abs() < 1e-5, "part {part}: {off}");
    }
    assert!(factor > 1.0 && delta.abs() > 1e-6);
    assert!(
        found["reading"].as_str().unwrap().contains("0.05 s"),
        "{found}"
    );
}

#[test]
fn a_cell_that_is_clicked_gives_its_command() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let status = dam(&[
        "map",
        VALVE,
        "--x",
        "camshaft.motion.speed=1500:2300 rpm:3",
        "--y",
        "valve.loads.spring.spring.preload=200:400 N:2",
        "--set",
        "run.duration=0.08",
        "-q",
        "--unchecked",
        "--out",
        out.to_str().unwrap(),
    ]);
    assert!(status.status.success(), "{}", text(&status.stderr));
    let page = std::fs::read_to_string(out.join("report.html")).unwrap();
    let script = r##"
        const panel = document.querySelector(".panels .pad"), box = panel.getBoundingClientRect();
        const at = { clientX: box.left + box.width * 0.9, clientY: box.top + box.height * 0.9, bubbles: true };
        panel.dispatchEvent(new PointerEvent("pointermove", at));
        const told = document.getElementById("cell").textContent;
        panel.dispatchEvent(new MouseEvent("click", at));
        return { told, command: document.getElementById("cell-command").textContent };
    "##;
    let Some(found) = asked(&page, script) else {
        return;
    };
    // The right column of the lower row.
    assert_eq!(
        found["command"],
        format!(
            "dam run {VALVE} --set run.duration=0.08 --set 'camshaft.motion.speed=2300 rpm' \
                 --set 'valve.loads.spring.spring.preload=200 N'"
        )
    );
    let map: Value = serde_json::from_slice(&std::fs::read(out.join("map.json")).unwrap()).unwrap();
    let told = found["told"].as_str().unwrap();
    let cause = map["panels"][0]["causes"][2].as_str().unwrap();
    assert!(
        told.contains(cause) && told.contains("valve.delta_abs = "),
        "{told}"
    );
}
