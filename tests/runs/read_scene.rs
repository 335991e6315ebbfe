//! Correct scenes are read into the right numbers.

use dam::model::{Closure, ContactForm, Coordinate};
use dam::object::spec::{BodySpec, ChainSpec, InertiaSplit, LoadLawSpec, Lumping, MassChoice};
use dam::position::PositionSpec;
use dam::scene::{AllowedValues, BuiltIn, Document, Expected, Overrides, Reading, StartSpec};
use std::f64::consts::{FRAC_PI_2, TAU};

const TWO_MASSES: &str = include_str!("../rocker_scene.json");

fn read(text: &str, overrides: &[&str]) -> Reading {
    let document = Document::parse("scene.json", text.as_bytes()).unwrap_or_else(|e| panic!("{e}"));
    let overrides = Overrides::new(overrides.iter().copied());
    document
        .scene(&BuiltIn, &overrides)
        .unwrap_or_else(|e| panic!("{e}"))
}

fn chain<'a>(reading: &'a Reading, id: &str) -> &'a ChainSpec {
    let chain = reading.scene.objects[id].object.chain();
    chain.unwrap_or_else(|| panic!("{id} is no chain"))
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
    assert_eq!(scene.objects["rocker"].connection("input"), Some("shaft"));
    let rocker = chain(&reading, "rocker");
    assert_eq!(rocker.coordinate, Coordinate::Turning);
    assert_eq!(rocker.pair.closure, Closure::Force);
    assert_eq!(rocker.pair.form, ContactForm::default());
    assert_eq!(rocker.loads[0].mass, MassChoice::Last);
    assert_eq!(rocker.loads[0].law, LoadLawSpec::Constant(-600.0));
    assert_eq!(
        rocker.body,
        BodySpec::Uniform {
            inertia: 0.1,
            stiffness: 1e7,
            damping_capacity: 0.4,
            masses: 2,
            split: InertiaSplit::Cubes,
            lumping: Lumping::Ends,
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
    let Expected::Figure {
        allowed: AllowedValues::Near { within, .. },
        ..
    } = scene.expect[0].what
    else {
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

#[test]
fn geometry_gives_the_closed_forms() {
    let remove_and_add = |kind: &str, geometry: &str| {
        let mut json: serde_json::Value = serde_json::from_str(TWO_MASSES).unwrap();
        let rocker = json["objects"]["rocker"].as_object_mut().unwrap();
        for name in ["inertia", "stiffness", "pair", "loads"] {
            rocker.remove(name);
        }
        rocker["kind"] = kind.into();
        rocker["position"] = serde_json::json!({ "ratio": 1 });
        rocker.insert("geometry".into(), serde_json::from_str(geometry).unwrap());
        json["expect"] = serde_json::json!([]);
        let reading = read(&json.to_string(), &[]);
        match chain(&reading, "rocker").body {
            BodySpec::Uniform {
                inertia, stiffness, ..
            } => (inertia, stiffness),
            ref other => panic!("{other:?}"),
        }
    };
    // The test lever of the paper: J = 0.1 kg·m², c = 10⁷ N·m/rad, h = 2w.
    let (inertia, stiffness) = remove_and_add(
        "rocker",
        r#"{ "length": "205 mm", "width": "47 mm", "height": "94 mm", "density": 7850, "modulus": "206 GPa" }"#,
    );
    approx::assert_relative_eq!(inertia, 0.1, max_relative = 0.01);
    approx::assert_relative_eq!(stiffness, 1e7, max_relative = 0.03);
    // A bar turning about its end, J = mL²/3; a cantilever, c = 3EI/L.
    approx::assert_relative_eq!(
        inertia,
        7850.0 * 0.047 * 0.094 * 0.205 * 0.205f64.powi(2) / 3.0,
        max_relative = 1e-14
    );
    approx::assert_relative_eq!(
        stiffness,
        3.0 * 206e9 * (0.047 * 0.094f64.powi(3) / 12.0) / 0.205,
        max_relative = 1e-14
    );
    // A tube: J = m(R² + r²)/2, c = G·J_p/L with J_p = π(R⁴ − r⁴)/2.
    let (inertia, stiffness) = remove_and_add(
        "shaft",
        r#"{ "length": 2, "diameter": "60 mm", "bore": "40 mm", "density": 7850, "shear_modulus": "80 GPa" }"#,
    );
    let (outer, inner, pi) = (0.03f64, 0.02f64, std::f64::consts::PI);
    let mass = 7850.0 * pi * (outer.powi(2) - inner.powi(2)) * 2.0;
    approx::assert_relative_eq!(
        inertia,
        mass * (outer.powi(2) + inner.powi(2)) / 2.0,
        max_relative = 1e-13
    );
    let polar = pi * (outer.powi(4) - inner.powi(4)) / 2.0;
    approx::assert_relative_eq!(stiffness, 80e9 * polar / 2.0, max_relative = 1e-13);
    let (mass, stiffness) = remove_and_add(
        "slider",
        r#"{ "length": 0.5, "section": ["20 mm", "30 mm"], "density": 7850, "modulus": "206 GPa" }"#,
    );
    approx::assert_relative_eq!(mass, 7850.0 * 0.5 * 6e-4, max_relative = 1e-14);
    approx::assert_relative_eq!(stiffness, 206e9 * 6e-4 / 0.5, max_relative = 1e-14);
}

/// Lists, and lists mixed with totals, agree with the few data they stand for:
/// J_m = J(m³ − (m−1)³)/n³, c_m = n·c, b_m = ψ·c_m/(2π·ω₀).
#[test]
fn lists_and_totals_agree() {
    let (inertia, stiffness, capacity) = (0.1, 1e7, 0.4);
    let body = |change: &str| {
        let text = TWO_MASSES.replace(
            "\"inertia\": 0.1,\n      \"stiffness\": 1e7,\n      \"damping_capacity\": 0.4,",
            change,
        );
        assert_ne!(text, TWO_MASSES);
        chain(&read(&text, &[]), "rocker").body.clone()
    };
    let expected_inertias = [inertia / 8.0, 7.0 * inertia / 8.0];
    let frequency: f64 = f64::sqrt(stiffness / inertia);
    let damping = capacity * 2.0 * stiffness / (TAU * frequency);
    for change in [
        r#""inertias": [0.0125, 0.0875], "stiffness": 1e7, "damping_capacity": 0.4,"#,
        r#""inertia": 0.1, "stiffnesses": [2e7, 2e7], "damping_capacity": 0.4,"#,
        r#""inertias": [0.0125, 0.0875], "stiffnesses": [2e7, 2e7], "damping": 63.66197723675814,"#,
        r#""inertia": 0.1, "stiffness": 1e7, "dampings": [127.32395447351628, 127.32395447351628],"#,
    ] {
        let BodySpec::Lists {
            inertias,
            stiffnesses,
            dampings,
        } = body(change)
        else {
            panic!("lists are expected");
        };
        for mass in 0..2 {
            approx::assert_relative_eq!(
                inertias[mass],
                expected_inertias[mass],
                max_relative = 1e-14
            );
            approx::assert_relative_eq!(stiffnesses[mass], 2.0 * stiffness, max_relative = 1e-14);
            approx::assert_relative_eq!(dampings[mass], damping, max_relative = 1e-13);
        }
    }
    let BodySpec::Uniform {
        damping_capacity, ..
    } = body(r#""inertia": 0.1, "stiffness": 1e7, "damping": 63.66197723675814,"#)
    else {
        panic!("few data are expected");
    };
    approx::assert_relative_eq!(damping_capacity, capacity, max_relative = 1e-14);
}

#[test]
fn a_weight_acts_on_every_mass_and_other_loads_on_the_last() {
    let text = r#"{ "dam": 1, "name": "weights", "objects": {
        "d": { "kind": "drive", "motion": { "speed": 1 } },
        "s": { "kind": "slider", "input": "d", "position": { "ratio": 1 },
          "inertia": 3, "stiffness": 1e5, "masses": 3, "loads": {
            "own": { "weight": { "inclination": "90 deg" } },
            "hung": { "mass": "last", "weight": { "inclination": "90 deg" } },
            "push": { "constant": 5 } } } },
        "run": { "duration": 1 } }"#;
    let reading = read(text, &[]);
    let masses: Vec<_> = chain(&reading, "s")
        .loads
        .iter()
        .map(|load| (load.name.as_str(), load.mass))
        .collect();
    assert_eq!(
        masses,
        [
            ("hung", MassChoice::Last),
            ("own", MassChoice::All),
            ("push", MassChoice::Last)
        ]
    );
    // Said or not, it is the same scene.
    let said = text.replace("\"own\": {", "\"own\": { \"mass\": \"all\",");
    assert_eq!(reading.scene.hash, read(&said, &[]).scene.hash);
}

const FOUR_BAR: &str = r#"{ "dam": 1, "name": "bar", "objects": {
    "shaft": { "kind": "drive", "motion": { "speed": "30 rpm" } },
    "bar": { "from": "linkage/four-bar", "input": "shaft", "dimensions":
      { "crank": "100 mm", "coupler": "244 mm", "rocker": "160 mm", "frame": "200 mm" } } },
  "run": { "duration": 2 } }"#;

/// Hash of a scene as it is read with a change.
fn hash(changes: &[&str]) -> String {
    read(FOUR_BAR, changes).scene.hash
}

/// A coordinate of a point is an address, as an entry of a list or as a part of its own.
#[test]
fn coordinates_of_points_are_addresses() {
    let list = hash(&["bar.links.coupler.points.B=[0.25, 0.01]"]);
    for [x, y] in [
        [
            "bar.links.coupler.points.B.0",
            "bar.links.coupler.points.B.1",
        ],
        [
            "bar.links.coupler.points.B[0]",
            "bar.links.coupler.points.B[1]",
        ],
    ] {
        let both = [format!("{x}=0.25"), format!("{y}=10 mm")];
        assert_eq!(hash(&[&both[0], &both[1]]), list);
    }
    assert_ne!(hash(&["bar.links.coupler.points.B.0=0.25"]), list);
    let fault = |change: &str| {
        let document = Document::parse("scene.json", FOUR_BAR.as_bytes()).unwrap();
        let changed = document.scene(&BuiltIn, &Overrides::new([change]));
        changed.unwrap_err().to_string()
    };
    let beyond = fault("bar.links.coupler.points.B.2=1");
    assert!(
        beyond.contains("this list has the entries 0 to 1"),
        "{beyond}"
    );
    assert!(fault("bar.links.coupler.points.B.x=1").contains("this is a list and has no `x`"));
    // A name that is wrong itself is not excused by another change.
    let document = Document::parse("scene.json", FOUR_BAR.as_bytes()).unwrap();
    let both = [
        "bar.links.coupler.points.B.0=0.25",
        "bar.dimensions.couplr=0.2",
    ];
    let faults = document
        .scene(&BuiltIn, &Overrides::new(both))
        .unwrap_err()
        .to_string();
    assert!(
        faults.contains("nothing refers to the dimension `couplr`"),
        "{faults}"
    );
}
