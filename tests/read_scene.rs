//! Correct scenes are read into the right numbers.

use dam::model::{Closure, Coordinate, DampingLaw};
use dam::object::Description;
use dam::object::spec::{BodySpec, ChainSpec, InertiaSplit, LoadLawSpec, MassChoice};
use dam::position::PositionSpec;
use dam::scene::{BuiltIn, Document, Expected, Overrides, Reading, StartSpec};
use std::f64::consts::{FRAC_PI_2, TAU};

const TWO_MASSES: &str = include_str!("../scenarios/rocker/two_masses.json");

fn read(text: &str, overrides: &[&str]) -> Reading {
    let document = Document::parse("scene.json", text.as_bytes()).unwrap_or_else(|e| panic!("{e}"));
    let overrides = Overrides::new(overrides.iter().copied());
    document
        .scene(&BuiltIn, &overrides)
        .unwrap_or_else(|e| panic!("{e}"))
}

fn chain<'a>(reading: &'a Reading, id: &str) -> &'a ChainSpec {
    match reading.scene.objects[id].object.description() {
        Description::Chain(chain) => chain,
        Description::Drive(_) => panic!("{id} is a drive"),
    }
}

#[test]
fn the_two_mass_rocker_is_read() {
    let reading = read(TWO_MASSES, &[]);
    assert!(reading.warnings.is_empty(), "{}", reading.warnings);
    let scene = &reading.scene;
    assert_eq!(scene.order(), ["shaft", "rocker"]);
    assert_eq!(scene.run.duration, 0.5);
    assert_eq!(scene.run.start, StartSpec::Static);
    assert_eq!(scene.run.samples, 1000);
    assert_eq!(scene.objects["rocker"].input.as_deref(), Some("shaft"));
    let rocker = chain(&reading, "rocker");
    assert_eq!(rocker.coordinate, Coordinate::Turning);
    assert_eq!(rocker.pair.closure, Closure::Force);
    assert_eq!(rocker.pair.law, DampingLaw::KelvinVoigt);
    assert_eq!(rocker.loads[0].mass, MassChoice::Last);
    assert_eq!(rocker.loads[0].law, LoadLawSpec::Constant(-600.0));
    assert_eq!(
        rocker.body,
        BodySpec::Uniform {
            inertia: 0.1,
            stiffness: 1e7,
            damping_capacity: 0.4,
            masses: 2,
            split: InertiaSplit::Cubes
        }
    );
    assert_eq!(
        rocker.position,
        PositionSpec::Sine {
            amplitude: FRAC_PI_2,
            harmonic: 1.0,
            phase: 0.0,
            offset: 0.0
        }
    );
    let Expected::Figure { within, .. } = scene.expect[0].what else {
        panic!("a figure is expected");
    };
    approx::assert_relative_eq!(within, 0.00750086e-5, max_relative = 1e-12);
}

#[test]
fn overrides_change_single_properties() {
    let reading = read(
        TWO_MASSES,
        &[
            "rocker.masses=10",
            "rocker.pair={\"closure\": \"form\"}",
            "rocker.pair.gap=0.1 mrad",
            "run.tolerance=1e-9",
            "rocker.loads.closing.constant=\"-1 kN m\"",
        ],
    );
    let rocker = chain(&reading, "rocker");
    assert!(matches!(rocker.body, BodySpec::Uniform { masses: 10, .. }));
    assert_eq!(rocker.pair.gap, 1e-4);
    assert_eq!(rocker.loads[0].law, LoadLawSpec::Constant(-1000.0));
    assert_eq!(reading.scene.run.tolerance, 1e-9);
}

#[test]
fn the_hash_depends_on_neither_order_nor_units() {
    let first = read(TWO_MASSES, &[]).scene.hash;
    let mut json: serde_json::Value = serde_json::from_str(TWO_MASSES).unwrap();
    json["objects"]["shaft"]["motion"]["speed"] = "600 rpm".into();
    json["objects"]["rocker"]["stiffness"] = "10 kN m/mrad".into();
    json["objects"]["rocker"]["position"]["sine"]["amplitude"] = FRAC_PI_2.into();
    json["objects"]["rocker"]["split"] = "cubes".into();
    json["description"] = "the same".into();
    let rocker = json["objects"]["rocker"].take();
    let shaft = json["objects"]["shaft"].take();
    let objects = format!("{{ \"shaft\": {shaft}, \"rocker\": {rocker} }}");
    json["objects"] = serde_json::Value::Null;
    let text = json
        .to_string()
        .replace("\"objects\":null", &format!("\"objects\":{objects}"));
    assert_eq!(read(&text, &[]).scene.hash, first);
    assert_ne!(read(TWO_MASSES, &["rocker.masses=3"]).scene.hash, first);
    assert_eq!(first.len(), 64);
}

#[test]
fn a_full_turn_repeats_a_window() {
    let loads =
        r#"rocker.loads={"work": {"window": {"from": "350 deg", "to": "370 deg", "force": -5}}}"#;
    let reading = read(TWO_MASSES, &[loads]);
    let LoadLawSpec::Window { period, .. } = chain(&reading, "rocker").loads[0].law else {
        panic!("a window is expected");
    };
    assert_eq!(period, Some(TAU));
}
