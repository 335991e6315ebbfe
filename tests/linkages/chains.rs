//! Linkages near singular positions: chains of many loops that all pass through one line, friction
//! that locks, ends of the reach; and what is said of them.

mod loads;
mod told;

use dam::linkage::Linkage;
use dam::linkage::Reach;
use dam::linkage::Rounding;
use dam::linkage::spec::AssemblyChoice;
use dam::linkage::spec::AssemblySpec;
use dam::linkage::spec::LinkSpec;
use dam::linkage::spec::LinkageSpec;
use dam::linkage::spec::PairKind;
use dam::linkage::spec::PairSpec;
use dam::linkage::spec::PointOf;
use dam::lower::lower;
use dam::scene::BuiltIn;
use dam::scene::Document;
use dam::scene::Overrides;
use dam::studies::Control;
use dam::studies::RunSettings;
use dam::studies::run::run;
use dam::system::System;
use serde_json::Map;
use serde_json::Value;
use serde_json::json;
use std::f64::consts::FRAC_PI_2;
use std::f64::consts::PI;
use std::f64::consts::TAU;
use std::path::PathBuf;
use std::process::Command;
use std::process::Output;

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

/// A slider-crank close to its dead-centre position, where the rod stands across the guide: by the root of
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
