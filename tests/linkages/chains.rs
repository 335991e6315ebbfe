//! Linkages near singular positions: chains of many loops that all pass through one line, friction
//! that locks, ends of the reach; and what is said of them.

use dam::linkage::spec::{
    AssemblyChoice, AssemblySpec, LinkSpec, LinkageSpec, PairKind, PairSpec, PointOf,
};
use dam::linkage::{Linkage, Reach, Rounding};
use dam::lower::lower;
use dam::scene::{BuiltIn, Document, Overrides};
use dam::studies::run::run;
use dam::studies::{Control, RunSettings};
use dam::system::System;
use serde_json::{Map, Value, json};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::path::PathBuf;
use std::process::{Command, Output};

const GRAVITY: f64 = 9.81;

/// N windows: N + 1 cranks on the ground, 1 m apart, N couplers between their tops; all
/// slender rods of 1 m and 1 kg.
fn chain_scene(windows: usize) -> Value {
    let rod = |point: &str| json!({ "points": { point: [1, 0] }, "mass": 1, "centre": [0.5, 0], "moment": 1.0 / 12.0 });
    let (mut ground, mut links, mut pairs, mut assembly) =
        (Map::new(), Map::new(), Map::new(), Map::new());
    for k in 0..=windows {
        ground.insert(format!("O{k}"), json!([k, 0]));
        links.insert(format!("crank{k:02}"), rod("A"));
        let pin = [format!("ground.O{k}"), format!("crank{k:02}.origin")];
        pairs.insert(format!("O{k:02}"), json!({ "revolute": pin }));
    }
    for k in 0..windows {
        links.insert(format!("coupler{k:02}"), rod("B"));
        let near = [format!("crank{k:02}.A"), format!("coupler{k:02}.origin")];
        let far = [format!("coupler{k:02}.B"), format!("crank{:02}.A", k + 1)];
        pairs.insert(format!("A{k:02}"), json!({ "revolute": near }));
        pairs.insert(format!("B{k:02}"), json!({ "revolute": far }));
        assembly.insert(format!("coupler{k:02}"), json!({ "angle": 0 }));
    }
    json!({
        "dam": 1, "name": format!("{windows} windows"),
        "objects": {
            "free": { "kind": "drive", "motor": { "inertia": 0, "angle": "90 deg", "speed": -1, "torque": { "constant": 0 } } },
            "chain": {
                "kind": "linkage", "input": "free", "driver": "O00", "ground": ground, "links": links, "pairs": pairs,
                "start": "90 deg", "gravity": { "acceleration": GRAVITY }, "assembly": assembly,
                "outputs": { "last": { "angle": format!("crank{windows:02}") } }
            }
        },
        "run": { "duration": 10, "tolerance": 1e-10, "start": "on_law", "samples": 100 }
    })
}

/// The same in plain numbers, of length `length` and turned by `angle`, so that nothing is round.
fn chain(windows: usize, angle: f64, length: f64) -> Linkage {
    let (sin, cos) = angle.sin_cos();
    let link = |name: String| LinkSpec {
        name,
        mass: 1.0,
        centre: [0.5 * length, 0.0],
        moment: length * length / 12.0,
        ..LinkSpec::default()
    };
    let pin = |name: String, on, link| PairSpec {
        name,
        on,
        link,
        kind: PairKind::Revolute { diameter: 0.0 },
        friction: 0.0,
    };
    let point = |link, x| PointOf { link, at: [x, 0.0] };
    let mut spec = LinkageSpec {
        start: FRAC_PI_2 + angle,
        ..LinkageSpec::default()
    };
    spec.links = (0..=windows).map(|k| link(format!("crank{k}"))).collect();
    for k in 0..=windows {
        let x = k as f64 * length;
        let on = PointOf {
            link: None,
            at: [cos * x, sin * x],
        };
        spec.pairs
            .push(pin(format!("O{k}"), on, point(Some(k), 0.0)));
    }
    for k in 0..windows {
        let coupler = windows + 1 + k;
        spec.links.push(link(format!("coupler{k}")));
        let (tail, tip) = (point(Some(coupler), 0.0), point(Some(coupler), length));
        spec.pairs
            .push(pin(format!("A{k}"), point(Some(k), length), tail));
        spec.pairs
            .push(pin(format!("B{k}"), tip, point(Some(k + 1), length)));
        spec.assembly.push(AssemblySpec {
            link: coupler,
            choice: AssemblyChoice::Angle(angle),
        });
    }
    Linkage::new(spec).expect("it can be assembled")
}

/// Angle of the chain from the vertical: [(N+1)/3 + N]·θ″ = [(N+1)/2 + N]·g·sin θ, by the classical
/// method of Runge and Kutta in 200 000 steps.
fn pendulum(windows: usize, duration: f64) -> f64 {
    let n = windows as f64;
    let factor = ((n + 1.0) / 2.0 + n) * GRAVITY / ((n + 1.0) / 3.0 + n);
    let slope = |[angle, speed]: [f64; 2]| [speed, factor * angle.sin()];
    let steps = 200_000;
    let h = duration / f64::from(steps);
    let mut y = [0.0, 1.0];
    for _ in 0..steps {
        let along = |d: [f64; 2], part: f64| [y[0] + part * h * d[0], y[1] + part * h * d[1]];
        let a = slope(y);
        let b = slope(along(a, 0.5));
        let c = slope(along(b, 0.5));
        let d = slope(along(c, 1.0));
        y = [0, 1].map(|k| y[k] + h / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]));
    }
    y[0]
}

fn system(scene: &Value) -> (System, RunSettings) {
    let text = scene.to_string();
    let document = Document::parse("chain.json", text.as_bytes()).expect("JSON");
    let reading = document
        .scene(&BuiltIn, &Overrides::default())
        .expect("a scene");
    let system = System::new(lower(&reading.scene).expect("a model")).expect("a system");
    (system, RunSettings::of(&reading.scene).expect("settings"))
}

#[test]
fn chains_of_any_length_swing_through_positions_in_one_line() {
    for windows in [1, 2, 5, 16, 40, 64] {
        let (system, settings) = system(&chain_scene(windows));
        let result = run(&system, &settings, &Control::default(), &mut []).expect("a start");
        assert!(result.is_complete(), "{windows}: {:?}", result.outcome);
        let displacement = result.figures.objects["chain.last"].end.displacement;
        let wanted = FRAC_PI_2 - pendulum(windows, 10.0);
        let off = (displacement - wanted).abs();
        assert!(off < 1e-8, "{windows}: {displacement} {wanted} {off:e}");
    }
}

#[test]
fn positions_in_one_line_are_change_points_and_no_dead_positions() {
    for (windows, angle, length) in [(1, 0.0, 1.0), (5, 0.3, 0.7), (40, 0.0, 1.0), (64, 1.1, 0.3)] {
        let linkage = chain(windows, angle, length);
        let range = linkage.range();
        assert_eq!(range.reach, Reach::Everywhere, "{windows}");
        assert_eq!(range.period.map(|period| period.turns), Some(1));
        // Two positions in line, in which all loops meet.
        assert_eq!(range.changes.len(), 2 * windows);
        for change in &range.changes {
            let off = (change.at - angle).rem_euclid(PI);
            assert!(off.min(PI - off) < 1e-9, "{windows}: {}", change.at);
        }
        let words = range.describe(linkage.structure(), true);
        assert_eq!(words.matches("change point").count(), 2, "{words}");
    }
}

/// All cranks are parallel: θ = q, θ′ = 1, θ″ = θ‴ = 0, right to the error that is stated.
#[test]
fn transfer_functions_of_chains_are_right_to_their_stated_error() {
    for (windows, angle, length) in [(1, 0.0, 1.0), (5, 0.3, 0.7), (40, 0.0, 1.0), (64, 1.1, 0.3)] {
        let linkage = chain(windows, angle, length);
        let mut work = linkage.workspace();
        let mut rounding = Rounding::of(&linkage);
        let mut errors = Vec::new();
        let (mut beyond, mut all) = (0, 0);
        for k in 0..500 {
            let q = TAU * f64::from(k) / 499.0 - 0.7;
            linkage.solve(q, 3, &mut work).expect("it turns fully");
            let of = |work: &dam::linkage::Workspace| {
                let jet = work.turning(windows);
                [work.pose(windows).cos, jet.first, jet.second, jet.third]
            };
            let found = of(&work);
            let write = |_: &Linkage, work: &_, out: &mut Vec<f64>| {
                out.clear();
                out.extend(of(work));
            };
            rounding.errors(q, &found, write, &mut errors);
            let wanted = [q.cos(), 1.0, 0.0, 0.0];
            for (order, within) in [1e-11, 1e-10, 1e-9, 1e-8].into_iter().enumerate() {
                let off = (found[order] - wanted[order]).abs();
                assert!(off < within, "{windows} at {q}, order {order}: {off:e}");
                assert!(
                    errors[order] < 100.0 * within,
                    "{windows} at {q}: {errors:?}"
                );
                beyond += usize::from(off > errors[order] + 2.0 * f64::EPSILON);
                all += 1;
            }
        }
        // The estimate is one of rounding: hardly ever less than the error itself.
        assert!(beyond * 100 <= all, "{windows}: {beyond} of {all}");
    }
}

/// A slider-crank close to its dead position, where the rod stands across the guide: by the root of
/// r² = (l − a·sin q)·(l + a·sin q) in factors that do not cancel, x′ = −a·sin q − a²·sin q·cos q/r.
#[test]
fn errors_near_a_dead_position_are_told_and_grow_towards_it() {
    let (crank, rod): (f64, f64) = (0.1, 0.08);
    let edge = (rod / crank).asin();
    let scene = json!({
        "dam": 1, "name": "short rod",
        "objects": {
            "d": { "kind": "drive", "motion": { "speed": 1 } },
            "s": { "kind": "slider", "input": "d", "inertia": 1, "masses": 0,
                   "position": { "slider_crank": { "crank": crank, "rod": rod } } }
        },
        "run": { "duration": 0.5 }
    });
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.json");
    std::fs::write(&path, scene.to_string()).unwrap();
    let path = path.display().to_string();
    let mut before = 0.0;
    for left in [1e-2, 1e-5, 1e-8] {
        let range = format!("{}:{}", edge - 2.0 * left, edge - left);
        let output = dam(&[
            "kinematics",
            &path,
            "--range",
            &range,
            "--positions",
            "1",
            "--json",
        ]);
        let document: Value = serde_json::from_slice(&output.stdout).unwrap();
        let of = |what: &str| &document["columns"][format!("links.rod.{what}")];
        let [first, third] = ["first_transfer", "third_transfer"].map(of);
        let q: f64 = document["axis"]["values"][1].as_f64().unwrap();
        // sin of the rod's angle is a/l·sin q; near the edge its cosine by the distance.
        let d = edge - q;
        let (s, c) = (edge.sin(), edge.cos());
        let gap = c * d.sin() + 2.0 * s * (0.5 * d).sin().powi(2);
        let cosine = (gap * (2.0 * s - gap)).sqrt() * crank / rod;
        let wanted = crank * q.cos() / (rod * cosine);
        let value = first["values"][1].as_f64().unwrap();
        let error = first["error"].as_f64().unwrap();
        assert!(
            (value.abs() - wanted.abs()).abs() <= error + 1e-15 * wanted,
            "{left}: {value} {wanted} {error:e}"
        );
        let third_error = third["error"].as_f64().unwrap();
        assert!(third_error > 10.0 * before, "{left}: {third_error:e}");
        before = third_error;
    }
}

fn dam(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(arguments)
        .output()
        .unwrap()
}

fn scenario(name: &str) -> String {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    root.join("scenarios").join(name).display().to_string()
}

fn document(arguments: &[&str]) -> Value {
    let output = dam(arguments);
    serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|_| panic!("{}", String::from_utf8_lossy(&output.stderr)))
}

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
    let zone = "90 deg 90 deg dead position";
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
    // Ends as they are told, dead positions, to the digits that are told.
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

/// A coupling rod over three cranks, the middle one being too many.
#[test]
fn a_redundant_parallel_rod_is_named() {
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
    assert_eq!(code, Some(2));
    assert!(
        said.contains("redundant parallel rod") && said.contains("leave out `c2`"),
        "{said}"
    );
    // Another distance is no parallel rod, but a rigid part.
    scene["objects"]["p"]["ground"]["O2"] = json!([2.1, 0]);
    let (_, said) = check(&scene);
    assert!(
        said.contains("statically indeterminate") && !said.contains("redundant"),
        "{said}"
    );
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

/// A slider-crank that a motor without torque leaves to its forces, with more of the linkage's
/// parts, and for so long.
fn free_slider_crank(forces: Value, loads: Value, duration: f64) -> Value {
    let rod = |point: &str, length: f64| json!({ "points": { point: [length, 0] }, "mass": 1, "centre": [0.5 * length, 0], "moment": 0.01 });
    json!({
        "dam": 1, "name": "free slider-crank",
        "objects": {
            "free": { "kind": "drive", "motor": { "inertia": 0, "angle": "40 deg", "torque": { "constant": 0 } } },
            "m": {
                "kind": "linkage", "input": "free", "driver": "O", "start": "40 deg", "ground": { "O": [0, 0] },
                "links": { "crank": rod("A", 0.1), "rod": rod("B", 0.35), "slide": { "mass": 2 } },
                "pairs": {
                    "O": { "revolute": ["ground.O", "crank.origin"] }, "A": { "revolute": ["crank.A", "rod.origin"] },
                    "B": { "revolute": ["rod.B", "slide.origin"] },
                    "guide": { "sliding": { "guide": "ground.O", "block": "slide.origin" } }
                },
                "assembly": { "slide": { "near": [0.4, 0] } }, "forces": forces,
                "outputs": { "ram": { "point": "slide.origin", "loads": loads }, "crank": { "angle": "crank" } }
            }
        },
        "run": { "duration": duration, "tolerance": 1e-11, "start": "on_law", "samples": 200 }
    })
}

fn final_angle(scene: &Value) -> f64 {
    let (system, settings) = system(scene);
    let result = run(&system, &settings, &Control::default(), &mut []).expect("a start");
    assert!(result.is_complete(), "{:?}", result.outcome);
    result.figures.objects["m.crank"].end.displacement
}

/// A force over time on an output is that force on its point.
#[test]
fn loads_on_outputs_are_forces_on_their_points() {
    let force = json!({ "f": { "force": { "point": "slide.origin", "force": [-5, 0] } } });
    let wanted = final_angle(&free_slider_crank(force, json!({}), 0.8));
    for law in [
        json!({ "constant": -5 }),
        json!({ "time_table": [[0, -5], [1, -5]] }),
    ] {
        let found = final_angle(&free_slider_crank(json!({}), json!({ "f": law }), 0.8));
        assert!((found - wanted).abs() < 1e-8, "{found} {wanted}");
    }
    // One that ends half way is another.
    let half = json!({ "f": { "time_table": [[0, -5], [0.4, -5], [0.4001, 0]] } });
    let found = final_angle(&free_slider_crank(json!({}), half, 0.8));
    assert!((found - wanted).abs() > 1e-3, "{found} {wanted}");
}

/// A crank alone under a couple that grows with time, t·1 N·m: q = t³/(6·J).
#[test]
fn a_couple_over_time_accelerates_as_its_integral() {
    let scene = json!({
        "dam": 1, "name": "crank",
        "objects": {
            "free": { "kind": "drive", "motor": { "inertia": 0, "torque": { "constant": 0 } } },
            "m": {
                "kind": "linkage", "input": "free", "driver": "O", "ground": { "O": [0, 0] },
                "links": { "crank": { "mass": 0, "moment": 0.5 } },
                "pairs": { "O": { "revolute": ["ground.O", "crank.origin"] } },
                "outputs": { "crank": { "angle": "crank", "loads": { "t": { "time_table": [[0, 0], [2, 2]] } } } }
            }
        },
        "run": { "duration": 2, "tolerance": 1e-11, "start": "on_law", "samples": 20 }
    });
    assert!((final_angle(&scene) - 8.0 / 3.0).abs() < 1e-9);
}

/// A rotor of 0.5 kg·m² under the couple 3 N·m − q·1 N·m/rad swings about q = 3 rad with √2 rad/s.
#[test]
fn a_couple_over_the_input_is_a_function_of_it() {
    let scene = json!({
        "dam": 1, "name": "crank",
        "objects": {
            "free": { "kind": "drive", "motor": { "inertia": 0, "angle": 2.5, "torque": { "constant": 0 } } },
            "m": {
                "kind": "linkage", "input": "free", "driver": "O", "start": 2.5, "ground": { "O": [0, 0] },
                "links": { "crank": { "mass": 0, "moment": 0.5 } },
                "pairs": { "O": { "revolute": ["ground.O", "crank.origin"] } },
                "forces": { "c": { "couple_table": { "link": "crank", "points": [[0, 3], [6, -3]] } } },
                "outputs": { "crank": { "angle": "crank" } }
            }
        },
        "run": { "duration": 1.7, "tolerance": 1e-11, "start": "on_law", "samples": 20 }
    });
    let wanted = 3.0 - 0.5 * (2f64.sqrt() * 1.7).cos();
    assert!((final_angle(&scene) - wanted).abs() < 1e-9);
    // Its equilibrium is where the couple is zero, with the slope as stiffness.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.json");
    std::fs::write(&path, scene.to_string()).unwrap();
    let found = document(&[
        "kinematics",
        &path.display().to_string(),
        "--turn",
        "--json",
    ]);
    let equilibria = found["equilibria"].as_array().unwrap();
    let rest = equilibria
        .iter()
        .find(|rest| (rest["input"].as_f64().unwrap() - 3.0).abs() < 1e-9);
    let frequency = rest.unwrap()["angular_frequency"].as_f64().unwrap();
    assert!((frequency - 2f64.sqrt()).abs() < 1e-9, "{frequency}");
}

/// What a run records at an output is what `forces` takes as its load.
#[test]
fn forces_over_a_record_take_the_loads_of_outputs() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, scene: &Value| {
        let path = folder.path().join(name);
        std::fs::write(&path, scene.to_string()).unwrap();
        path.display().to_string()
    };
    let loaded = free_slider_crank(json!({}), json!({ "f": { "constant": -5 } }), 0.3);
    let loaded = write("loaded.json", &loaded);
    let out = folder.path().join("out").display().to_string();
    let run = dam(&["run", &loaded, "--out", &out]);
    assert_eq!(
        run.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&run.stderr)
    );
    let record = format!("{out}/record.csv");
    let found = document(&["forces", &loaded, "--record", &record, "--json"]);
    // The motor gives nothing: the drive's moment is zero with the load, and not without it.
    let drives = found["columns"]["drive"]["values"].as_array().unwrap();
    let greatest = drives
        .iter()
        .map(|drive| drive.as_f64().unwrap().abs())
        .fold(0.0, f64::max);
    assert!(greatest < 1e-6, "{greatest}");
    // Without a record the load is missing, and that stands in the document too.
    let bare = document(&["forces", &loaded, "--turn", "--speed", "1 rad/s", "--json"]);
    let warnings = bare["warnings"].to_string();
    assert!(warnings.contains("m.ram"), "{warnings}");
}
