//! What is said of linkages: zones, ends of the reach, redundant cranks, inputs, positions.

use super::{dam, document, scenario};
use serde_json::Value;
use serde_json::json;
use std::f64::consts::TAU;

/// The crank as long as the rod: friction locks on the way back, whatever positions are asked for.
#[test]
fn zones_do_not_depend_on_positions() {
    let scene = scenario("kinetostatics/slider_crank.json");
    let set = "mechanism.links.rod.points.C=[0.06,0]";
    let study = |positions: &str| {
        document(&[
            "forces",
            &scene,
            "--set",
            set,
            "--positions",
            positions,
            "--json",
        ])
    };
    let all = ["4", "36", "100", "360"].map(study);
    let zones = |document: &Value| -> Vec<(String, [f64; 2], usize)> {
        let zones = document["zones"].as_array().unwrap().iter();
        zones
            .map(|zone| {
                let ends = ["from", "to"].map(|end| zone[end].as_f64().unwrap());
                let towards = zone["unbounded_towards"].as_array().unwrap().len();
                (zone["kind"].as_str().unwrap().to_owned(), ends, towards)
            })
            .collect()
    };
    let wanted = zones(&all[3]);
    let kinds: Vec<&str> = wanted.iter().map(|zone| zone.0.as_str()).collect();
    assert_eq!(
        kinds,
        [
            "self_locking",
            "self_locking",
            "dead_position",
            "self_locking",
            "self_locking",
            "locked",
            "dead_position",
            "locked"
        ]
    );
    for document in &all {
        for (zone, wanted) in zones(document).iter().zip(&wanted) {
            assert_eq!((&zone.0, zone.2), (&wanted.0, wanted.2));
            for (end, wanted) in zone.1.iter().zip(wanted.1) {
                assert!((end - wanted).abs() < 1e-9, "{zone:?}");
                assert!((0.0..=TAU).contains(end), "{zone:?}");
            }
        }
        assert_eq!(zones(document).len(), wanted.len());
        let drive = &document["extremes"]["drive"]["greatest"];
        assert!(drive["value"].is_null(), "{drive}");
        let towards = drive["unbounded_towards"].as_f64().unwrap().to_degrees();
        assert!((towards - 261.423).abs() < 1e-3, "{towards}");
        let least = |document: &Value| {
            document["extremes"]["drive"]["least"]["value"]
                .as_f64()
                .unwrap()
        };
        assert!(
            (least(document) - least(&all[3])).abs() < 1e-7,
            "{}",
            least(document)
        );
    }
    let output = dam(&["forces", &scene, "--set", set]);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        text.contains("forces unbounded towards 261.423 deg"),
        "{text}"
    );
    let words: Vec<&str> = text.split_whitespace().collect();
    let zone = "90 deg 90 deg dead-centre position";
    assert!(words.join(" ").contains(zone), "{text}");
}

#[test]
fn kinematics_and_forces_have_the_same_rows() {
    let scene = scenario("kinetostatics/slider_crank.json");
    for speed in ["10 rad/s", "-10 rad/s"] {
        let rows = |command: &str, column: usize| -> Vec<f64> {
            let output = dam(&[
                command,
                &scene,
                "--turn",
                "--speed",
                speed,
                "--positions",
                "8",
                "--csv",
            ]);
            let text = String::from_utf8(output.stdout).unwrap();
            let rows = text.lines().skip(1);
            rows.map(|row| row.split(',').nth(column).unwrap().parse().unwrap())
                .collect()
        };
        let (kinematics, forces) = (rows("kinematics", 0), rows("forces", 0));
        assert_eq!(kinematics.len(), 9);
        assert_eq!(kinematics.len(), forces.len());
        for (one, other) in kinematics.iter().zip(&forces) {
            assert!((one - other).abs() < 1e-14, "{kinematics:?} {forces:?}");
        }
        let sense = if speed.starts_with('-') { -1.0 } else { 1.0 };
        assert!((kinematics[8] - kinematics[0] - sense * TAU).abs() < 1e-14);
    }
}

#[test]
fn a_range_that_equals_the_reach_is_inside_it() {
    let cylinder = scenario("limits/cylinder.json");
    let found = document(&["kinematics", &cylinder, "--range", "900:1400 mm", "--json"]);
    assert!(found["stopped"].is_null(), "{}", found["stopped"]);
    assert_eq!(found["axis"]["values"].as_array().unwrap().len(), 361);
    // Ends as they are told, dead-centre positions, to the digits that are told.
    let short = scenario("limits/short_rod.json");
    let found = document(&[
        "kinematics",
        &short,
        "--range",
        "-53.130103:53.130103 deg",
        "--json",
    ]);
    assert!(found["stopped"].is_null(), "{}", found["stopped"]);
    let beyond = dam(&["kinematics", &short, "--range", "-54:53 deg"]);
    assert_eq!(beyond.status.code(), Some(2));
}

#[test]
fn a_time_without_a_leading_zero_is_one() {
    let scene = scenario("kinetostatics/slider_crank.json");
    let [short, long] = [".7", "0.7"].map(|time| {
        document(&["kinematics", &scene, "--time", time, "--json"])["axis"]["values"].clone()
    });
    assert_eq!(short, long);
    let wrong = dam(&["kinematics", &scene, "--time", ".7.1"]);
    assert_eq!(wrong.status.code(), Some(2));
}

fn check(scene: &Value) -> (Option<i32>, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.json");
    std::fs::write(&path, scene.to_string()).unwrap();
    let output = dam(&["check", &path.display().to_string()]);
    let said = [output.stdout, output.stderr].map(|text| String::from_utf8(text).unwrap());
    (output.status.code(), said.concat())
}

/// A coupling rod over three cranks, the last one being too many.
#[test]
fn a_redundant_parallel_crank_is_named() {
    let crank = json!({ "points": { "A": [0.3, 0] } });
    let mut scene = json!({
        "dam": 1, "name": "parallel cranks",
        "objects": {
            "d": { "kind": "drive", "motion": { "speed": "60 rpm" } },
            "p": {
                "kind": "linkage", "input": "d", "driver": "O0", "start": "90 deg",
                "ground": { "O0": [0, 0], "O1": [1, 0], "O2": [2, 0] },
                "links": { "c0": crank, "c1": crank, "c2": crank, "rod": { "points": { "B": [1, 0], "C": [2, 0] } } },
                "pairs": {
                    "O0": { "revolute": ["ground.O0", "c0.origin"] }, "O1": { "revolute": ["ground.O1", "c1.origin"] },
                    "O2": { "revolute": ["ground.O2", "c2.origin"] }, "A0": { "revolute": ["c0.A", "rod.origin"] },
                    "A1": { "revolute": ["rod.B", "c1.A"] }, "A2": { "revolute": ["rod.C", "c2.A"] }
                },
                "assembly": { "rod": { "angle": 0 } }, "outputs": { "o": { "angle": "rod" } }
            }
        },
        "run": { "duration": 1 }
    });
    let (code, said) = check(&scene);
    assert_eq!(code, Some(0), "{said}");
    assert!(
        said.contains("redundant: the length of `c2` between its pins `A2` and `O2`"),
        "{said}"
    );
    // Nothing needs to be said of its position; what is wrong is a warning.
    scene["objects"]["p"]["assembly"] = json!({});
    let (code, said) = check(&scene);
    assert!(code == Some(0) && !said.contains("approximate"), "{said}");
    scene["objects"]["p"]["assembly"] = json!({ "c1": { "angle": "270 deg" } });
    let (code, said) = check(&scene);
    assert_eq!(code, Some(0), "{said}");
    assert!(
        said.contains("the approximate angle of `c1` is 180 deg away"),
        "{said}"
    );
    scene["objects"]["p"]["assembly"] = json!({ "rod": { "angle": 0 } });
    // Another distance is no parallel rod, but a rigid part.
    scene["objects"]["p"]["ground"]["O2"] = json!([2.1, 0]);
    let (_, said) = check(&scene);
    assert!(
        said.contains("statically indeterminate") && !said.contains("redundant"),
        "{said}"
    );
    scene["objects"]["p"]["ground"]["O2"] = json!([2, 0]);
    // Crossed, the cranks cannot move: they are put together as they move.
    let mut bare = scene.clone();
    bare["objects"]["p"]["start"] = json!("40 deg");
    bare["objects"]["d"]["motion"]["angle"] = json!("40 deg");
    bare["objects"]["p"]["assembly"] = json!({});
    let (code, said) = check(&bare);
    assert_eq!(code, Some(0), "{said}");
    bare["objects"]["p"]["assembly"] = json!({ "c1": { "angle": "30 deg" } });
    let (code, said) = check(&bare);
    assert_eq!(code, Some(0), "{said}");
    // Without it the coupling rod never turns: its angle is no output that moves.
    for (part, name) in [
        ("ground", "O2"),
        ("links", "c2"),
        ("pairs", "O2"),
        ("pairs", "A2"),
    ] {
        scene["objects"]["p"][part]
            .as_object_mut()
            .unwrap()
            .remove(name);
    }
    let (code, said) = check(&scene);
    assert_eq!(code, Some(0), "{said}");
    assert!(said.contains("the output `o` never moves"), "{said}");
}

/// Forces that statics leaves open have no figures, in no form; what is hidden stays so.
#[test]
fn what_rigid_links_leave_open_is_marked() {
    let scene = scenario("linkages/three_cranks.json");
    let forces = |form: &[&str]| {
        let asked = [&["forces", &scene, "--positions", "37"], form].concat();
        let output = dam(&asked);
        assert!(output.status.success());
        String::from_utf8(output.stdout).unwrap()
    };
    let text = forces(&[]);
    assert!(text.contains("Statically indeterminate"), "{text}");
    assert!(
        text.contains("the forces of A1, A2, A3, O1, O2, O3 have no values"),
        "{text}"
    );
    assert!(!text.contains("A1.force"), "{text}");
    let csv = forces(&["--csv"]);
    let header: Vec<&str> = csv.lines().next().unwrap().split(',').collect();
    let cell = |row: usize, name: &str| {
        let column = header.iter().position(|known| *known == name).unwrap();
        csv.lines()
            .nth(row)
            .unwrap()
            .split(',')
            .nth(column)
            .unwrap()
            .to_owned()
    };
    assert_eq!(cell(3, "O2.x [N] (statically indeterminate)"), "");
    assert_ne!(cell(3, "K.x [N]"), "");
    // A row each for the linkage's own links and pairs.
    assert_eq!(
        header
            .iter()
            .filter(|name| name.ends_with(".mass [N m/kg]"))
            .count(),
        6
    );
    assert_eq!(
        header
            .iter()
            .filter(|name| name.contains(".loss [W]"))
            .count(),
        10
    );
    let json: Value = serde_json::from_str(&forces(&["--json"])).unwrap();
    let open = &json["indeterminate"];
    assert_eq!(
        open["reactions"],
        json!(["A1", "A2", "A3", "O1", "O2", "O3"])
    );
    assert_eq!(open["drive"], json!(false));
    assert_eq!(json["columns"]["A1.x"]["indeterminate"], json!(true));
    assert_eq!(json["columns"]["A1.x"]["values"][5], Value::Null);
    assert!(json["columns"]["K.x"]["values"][5].is_number());
}

/// Friction of a pair that statics leaves open is no motion that could be found.
#[test]
fn joint_friction_of_what_is_left_open_is_refused() {
    let text = std::fs::read_to_string(scenario("linkages/three_cranks.json")).unwrap();
    let mut scene: Value = serde_json::from_str(&text).unwrap();
    scene["objects"]["screen"]["joint_friction"] = json!(true);
    scene["objects"]["screen"]["pairs"]["B"]["friction"] = json!(0.1);
    scene["objects"]["screen"]["pairs"]["B"]["diameter"] = json!(0.05);
    let (code, said) = check(&scene);
    assert_eq!(code, Some(0), "{said}");
    scene["objects"]["screen"]["pairs"]["A2"]["friction"] = json!(0.1);
    scene["objects"]["screen"]["pairs"]["A2"]["diameter"] = json!(0.05);
    let (code, said) = check(&scene);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("`A2` is statically indeterminate"), "{said}");
}

/// A rod with an arm welded to it, in the gate of the screen: two links as one, with the weld's force.
#[test]
fn a_weld_makes_two_links_one() {
    let text = std::fs::read_to_string(scenario("linkages/three_cranks.json")).unwrap();
    let mut scene: Value = serde_json::from_str(&text).unwrap();
    scene.as_object_mut().unwrap().remove("expect");
    let screen = &mut scene["objects"]["screen"];
    screen["links"]["rod"] = json!({ "points": { "S": ["0.1 m", 0] } });
    screen["links"]["end"] = json!({ "points": { "K": [0, "-0.2 m"] } });
    screen["pairs"]["K"] = json!({ "revolute": ["end.K", "gate.origin"] });
    screen["pairs"]["S"] =
        json!({ "weld": { "on": "rod.S", "link": "end.origin", "angle": "90 deg" } });
    let path = std::env::temp_dir().join("dam_weld.json");
    std::fs::write(&path, scene.to_string()).unwrap();
    let path = path.display().to_string();
    let shown = String::from_utf8(dam(&["show", &path]).stdout).unwrap();
    assert!(shown.contains("welded: `end` to `rod` by `S`"), "{shown}");
    let asked = ["forces", &path, "--json", "--positions", "36"];
    let value = |found: &Value, name: &str| found["columns"][name]["values"][9].as_f64().unwrap();
    let found = document(&asked);
    // The rod carries the pin's force, and at the weld its moment about that place: none.
    let force = ["x", "y"].map(|axis| {
        let [pin, weld] = ["K", "S"].map(|name| value(&found, &format!("{name}.{axis}")));
        assert!((pin - weld).abs() < 1e-9, "{pin} {weld}");
        pin
    });
    assert!((force[0].hypot(force[1]) - 510.310_363_079_828_8).abs() < 1e-9);
    assert!(value(&found, "S.couple").abs() < 1e-9);
    let whole = document(&[
        "forces",
        &scenario("linkages/three_cranks.json"),
        "--json",
        "--positions",
        "36",
    ]);
    let [one, other] = [&found, &whole].map(|found| value(found, "drive"));
    assert!((one - other).abs() < 1e-10);
    // A weld has no friction, no coordinate, and joins what is not one yet.
    scene["objects"]["screen"]["pairs"]["S"]["friction"] = json!(0.1);
    let (code, said) = check(&scene);
    assert_eq!(code, Some(2));
    assert!(
        said.contains("a weld does not move and has no `friction`"),
        "{said}"
    );
    scene["objects"]["screen"]["pairs"]["S"]
        .as_object_mut()
        .unwrap()
        .remove("friction");
    scene["objects"]["screen"]["outputs"]["seam"] = json!({ "pair": "S" });
    let (code, said) = check(&scene);
    assert_eq!(code, Some(2));
    assert!(said.contains("there is no pair `S`"), "{said}");
}

#[test]
fn a_second_input_is_refused_with_what_would_be_right() {
    let crank = json!({ "points": { "A": [0.3, 0] } });
    let rod = json!({ "points": { "B": [0.8, 0] } });
    let scene = json!({
        "dam": 1, "name": "two inputs",
        "objects": {
            "d": { "kind": "drive", "motion": { "speed": "60 rpm" } },
            "p": {
                "kind": "linkage", "input": "d", "driver": "O0", "start": "90 deg", "ground": { "O0": [0, 0], "O1": [1, 0] },
                "links": { "c0": crank, "c1": crank, "r0": rod, "r1": rod },
                "pairs": {
                    "O0": { "revolute": ["ground.O0", "c0.origin"] }, "O1": { "revolute": ["ground.O1", "c1.origin"] },
                    "A0": { "revolute": ["c0.A", "r0.origin"] }, "A1": { "revolute": ["c1.A", "r1.origin"] },
                    "B": { "revolute": ["r0.B", "r1.B"] }
                },
                "outputs": { "o": { "angle": "r0" } }
            }
        },
        "run": { "duration": 1 }
    });
    let (code, said) = check(&scene);
    assert_eq!(code, Some(2));
    assert!(said.contains("tie a second input to the first"), "{said}");
}

/// A slider-crank with its slide said to be elsewhere; the nearest assembly has it at 360 mm.
#[test]
fn an_approximate_position_far_from_the_assembly_is_told_or_refused() {
    let text = std::fs::read_to_string(scenario("kinetostatics/slider_crank.json")).unwrap();
    let mut scene: Value = serde_json::from_str(&text).unwrap();
    let place = |scene: &mut Value, x: f64| {
        scene["objects"]["mechanism"]["assembly"]["slide"]["near"] = json!([x, 0]);
        check(scene)
    };
    let (code, said) = place(&mut scene, 0.355);
    assert_eq!(
        (code, said.contains("approximate")),
        (Some(0), false),
        "{said}"
    );
    let (code, said) = place(&mut scene, 0.42);
    assert_eq!(code, Some(0), "{said}");
    assert!(
        said.contains("0.06 m away from the nearest assembly"),
        "{said}"
    );
    let (code, said) = place(&mut scene, 3.36);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("3 m away"), "{said}");
}

/// A crank: its tip goes round a circle about the pin, which is its instant centre.
#[test]
fn path_components_and_instant_centres_have_their_closed_forms() {
    let scene = scenario("kinetostatics/slider_crank.json");
    let found = document(&[
        "kinematics",
        &scene,
        "--turn",
        "--speed",
        "-10 rad/s",
        "--acceleration",
        "7 rad/s^2",
        "--json",
    ]);
    let column = |name: &str| -> Vec<Option<f64>> {
        let values = found["columns"][name]["values"].as_array();
        let values = values.unwrap_or_else(|| panic!("{name}")).iter();
        values.map(Value::as_f64).collect()
    };
    let (r, l) = (0.06, 0.3);
    let tip = "links.crank.A";
    let [along, across, radius] = [
        "acceleration_along_path",
        "acceleration_across_path",
        "radius_of_curvature",
    ]
    .map(|what| column(&format!("{tip}.{what}")));
    let (x, y) = (
        column("links.rod.instant_centre_x"),
        column("links.rod.instant_centre_y"),
    );
    let slide = column("links.rod.C.radius_of_curvature");
    for row in [7, 100, 200, 333] {
        let q = -(row as f64).to_radians();
        // Backwards it becomes slower, and the centre lies to the right of the way it goes.
        assert!((along[row].unwrap() + 7.0 * r).abs() < 1e-12);
        assert!((across[row].unwrap() + 100.0 * r).abs() < 1e-11);
        assert!((radius[row].unwrap() - r).abs() < 1e-12);
        // The rod turns about the point where the crank's line meets the normal of the guide.
        let pin = r * q.cos() + (l * l - (r * q.sin()).powi(2)).sqrt();
        assert!((x[row].unwrap() - pin).abs() < 1e-10);
        assert!((y[row].unwrap() - pin * q.tan()).abs() < 1e-9 * (1.0 + q.tan().abs()));
        assert_eq!(slide[row], None, "a straight path");
    }
    // The whole acceleration is made of both.
    let size = column(&format!("{tip}.acceleration"));
    let whole = along[50].unwrap().hypot(across[50].unwrap());
    assert!((whole - size[50].unwrap()).abs() < 1e-12);
}
