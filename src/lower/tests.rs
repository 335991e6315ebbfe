use super::{FREE_FALL, lower};
use crate::model::{
    Closure, Coordinate, DampingLaw, LinkBase, LoadLaw, Model, NodeMotion, Start, TrackSource,
};
use crate::object::spec::*;
use crate::object::{Description, Object};
use crate::position::PositionSpec;
use crate::scene::{RunSpec, Scene, SceneObject, StartSpec};
use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

#[derive(Debug)]
struct Part(Coordinate, Spec);

#[derive(Debug)]
enum Spec {
    Drive(DriveSpec),
    Chain(ChainSpec),
}

impl Object for Part {
    fn kind(&self) -> &'static str {
        "part"
    }

    fn coordinate(&self) -> Coordinate {
        self.0
    }

    fn description(&self) -> Description<'_> {
        match &self.1 {
            Spec::Drive(spec) => Description::Drive(spec),
            Spec::Chain(spec) => Description::Chain(spec),
        }
    }
}

fn scene(parts: Vec<(&str, Option<&str>, Part)>) -> Scene {
    let objects = parts
        .into_iter()
        .map(|(id, input, part)| {
            let entry = SceneObject {
                input: input.map(str::to_owned),
                object: Box::new(part),
            };
            (id.to_owned(), entry)
        })
        .collect();
    Scene {
        name: "test".into(),
        objects,
        run: RunSpec {
            duration: 1.0,
            start: StartSpec::OnLaw,
            method: "auto".into(),
            tolerance: 1e-6,
            step: None,
            samples: 10,
            switch_rows: false,
            window: None,
            max_switches: 1000,
        },
        expect: Vec::new(),
        hash: String::new(),
    }
}

fn drive(speed: f64, angle: f64) -> Part {
    let motion = DriveMotionSpec::Constant { speed, angle };
    Part(
        Coordinate::Turning,
        Spec::Drive(DriveSpec::Prescribed(motion)),
    )
}

fn motor(angle: f64) -> Part {
    let spec = MotorSpec {
        inertia: 0.2,
        angle,
        speed: 3.0,
        torque: TorqueSpec::Linear {
            stall_torque: 10.0,
            no_load_speed: 100.0,
        },
        loads: vec![load("drag", LoadLawSpec::Viscous(0.1))],
    };
    Part(Coordinate::Turning, Spec::Drive(DriveSpec::Motor(spec)))
}

fn load(name: &str, law: LoadLawSpec) -> LoadSpec {
    LoadSpec {
        name: name.into(),
        mass: MassChoice::Last,
        law,
    }
}

fn rigid(inertia: f64) -> BodySpec {
    BodySpec::Rigid { inertia }
}

fn uniform(masses: usize) -> BodySpec {
    BodySpec::Uniform {
        inertia: 0.1,
        stiffness: 1e7,
        damping_capacity: 0.4,
        masses,
        split: InertiaSplit::Cubes,
    }
}

fn chain(coordinate: Coordinate, position: PositionSpec, body: BodySpec) -> ChainSpec {
    ChainSpec {
        coordinate,
        position,
        lever: 1.0,
        body,
        pair: PairSpec {
            closure: Closure::Force,
            gap: 0.0,
            opens: 1.0,
            law: DampingLaw::KelvinVoigt,
        },
        loads: Vec::new(),
    }
}

fn part(spec: ChainSpec) -> Part {
    Part(spec.coordinate, Spec::Chain(spec))
}

fn ratio() -> PositionSpec {
    PositionSpec::Ratio {
        ratio: 1.0,
        offset: 0.0,
    }
}

/// Turns fully: a crank-slider.
fn slider_crank(crank: f64) -> PositionSpec {
    PositionSpec::SliderCrank {
        crank,
        rod: 0.2,
        offset: 0.0,
        branch: 1.0,
        phase: 0.0,
    }
}

fn lowered(parts: Vec<(&str, Option<&str>, Part)>) -> Model {
    lower(&scene(parts)).unwrap()
}

fn fault_paths(parts: Vec<(&str, Option<&str>, Part)>) -> Vec<String> {
    let faults = lower(&scene(parts)).unwrap_err();
    faults.into_iter().map(|fault| fault.path).collect()
}

#[test]
fn drivers_come_before_what_they_drive_and_ids_decide_the_rest() {
    let rocker = |masses| part(chain(Coordinate::Turning, ratio(), uniform(masses)));
    let model = lowered(vec![
        ("alpha", Some("zeta"), rocker(2)),
        ("beta", Some("alpha"), rocker(1)),
        ("drive", None, drive(1.0, 0.0)),
        ("zeta", Some("drive"), rocker(1)),
        (
            "gamma",
            Some("drive"),
            part(chain(Coordinate::Turning, ratio(), rigid(0.5))),
        ),
    ]);
    // Nodes: drive 0, gamma 1, zeta 2, alpha 3–4, beta 5; objects by id.
    let nodes: Vec<_> = model
        .objects
        .iter()
        .map(|part| (part.id.as_str(), part.nodes.clone()))
        .collect();
    assert_eq!(
        nodes,
        [
            ("alpha", vec![3, 4]),
            ("beta", vec![5]),
            ("drive", vec![0]),
            ("gamma", vec![1]),
            ("zeta", vec![2]),
        ]
    );
    assert_eq!(model.objects[0].driver, Some(4));
    assert_eq!(model.objects[1].driver, Some(0));
    let NodeMotion::Mass { law } = &model.nodes[5].motion else {
        panic!()
    };
    assert_eq!(law.driver, 4, "beta follows the last mass of alpha");
    let bases: Vec<_> = model.objects[0]
        .links
        .iter()
        .map(|&link| match model.links[link].base {
            LinkBase::Law { .. } => None,
            LinkBase::Mass(node) => Some(node),
        })
        .collect();
    assert_eq!(bases, [None, Some(3)]);
    assert!(model.objects[3].rigid_pair.is_some() && model.objects[3].links.is_empty());
    assert_eq!(model.nodes[1].inertia, 0.5);
}

#[test]
fn a_motor_has_its_rotor_its_torque_and_its_loads() {
    let model = lowered(vec![("motor", None, motor(0.7))]);
    assert!(
        matches!(model.nodes[0].motion, NodeMotion::Rotor { angle, speed } if angle == 0.7 && speed == 3.0)
    );
    assert_eq!(model.nodes[0].inertia, 0.2);
    let names: Vec<_> = model.loads.iter().map(|load| load.name.as_str()).collect();
    assert_eq!(names, ["motor.torque", "motor.loads.drag"]);
}

#[test]
fn windows_and_tables_become_pieces_over_shared_tracks() {
    let window = |to| LoadLawSpec::Window {
        from: 0.5,
        to,
        force: -7.0,
        period: Some(TAU),
    };
    let table = LoadLawSpec::PositionTable {
        points: vec![(0.0, 1.0), (2.0, 5.0), (TAU, 1.0)],
        period: Some(TAU),
    };
    let mut spec = chain(Coordinate::Turning, ratio(), uniform(2));
    spec.loads = vec![
        load("one", window(1.0)),
        load("other", window(1.0)),
        load("table", table),
        load("time", LoadLawSpec::TimeTable(vec![(0.1, 2.0), (0.3, 4.0)])),
        load("always", window(0.5 + TAU)),
    ];
    spec.loads[1].mass = MassChoice::All;
    let model = lowered(vec![
        ("drive", None, drive(1.0, 0.0)),
        ("rocker", Some("drive"), part(spec)),
    ]);
    assert_eq!(model.loads.len(), 6, "one load on each of two masses");
    assert_eq!(model.tracks.len(), 3, "equal windows share a track");
    assert_eq!(model.tracks[0].source, TrackSource::Node(0));
    assert_eq!(model.tracks[2].source, TrackSource::Time);
    let force = |load: usize, x: f64| match &model.loads[load].law {
        LoadLaw::Pieces { track, pieces } => {
            let breaks = &model.tracks[*track].breaks;
            let (piece, turned) = breaks.piece(breaks.locate(x, 1.0));
            let piece = pieces[piece];
            piece.value + piece.slope * (x - turned - piece.start)
        }
        LoadLaw::Constant(force) => *force,
        _ => panic!(),
    };
    for turn in [-2.0, 0.0, 3.0] {
        let at = |x: f64| x + turn * TAU;
        assert_eq!(force(0, at(0.7)), -7.0);
        assert_eq!(force(1, at(1.1)), 0.0);
        approx::assert_abs_diff_eq!(force(3, at(1.0)), 3.0, epsilon = 1e-13);
        approx::assert_abs_diff_eq!(force(3, at(0.5 * (2.0 + TAU))), 3.0, epsilon = 1e-13);
    }
    for (time, value) in [(0.0, 2.0), (0.2, 3.0), (0.5, 4.0)] {
        approx::assert_abs_diff_eq!(force(4, time), value, epsilon = 1e-14);
    }
    assert_eq!(force(5, 17.0), -7.0);
}

#[test]
fn weight_acts_on_the_mass_of_its_node_in_a_slider_alone() {
    let mut spec = chain(Coordinate::Sliding, slider_crank(0.05), uniform(2));
    spec.loads = vec![load(
        "weight",
        LoadLawSpec::Weight {
            inclination: PI / 2.0,
        },
    )];
    spec.loads[0].mass = MassChoice::All;
    let model = lowered(vec![
        ("drive", None, drive(1.0, 0.0)),
        ("ram", Some("drive"), part(spec.clone())),
    ]);
    let total: f64 = model
        .loads
        .iter()
        .map(|load| match load.law {
            LoadLaw::Constant(force) => force,
            _ => panic!(),
        })
        .sum();
    approx::assert_relative_eq!(total, -0.1 * FREE_FALL, max_relative = 1e-14);
    spec.coordinate = Coordinate::Turning;
    assert_eq!(
        fault_paths(vec![
            ("drive", None, drive(1.0, 0.0)),
            ("ram", Some("drive"), part(spec))
        ]),
        ["ram.loads.weight.weight"]
    );
}

#[test]
fn every_fault_is_found_at_once_with_its_property() {
    let mut gap = chain(Coordinate::Turning, ratio(), rigid(0.1));
    gap.pair.gap = 1e-3;
    gap.pair.closure = Closure::Form;
    let mut number = chain(Coordinate::Turning, ratio(), uniform(2));
    number.loads = vec![
        load("push", LoadLawSpec::Constant(1.0)),
        load(
            "stop",
            LoadLawSpec::Friction {
                force: 1.0,
                width: 0.0,
            },
        ),
    ];
    number.loads[0].mass = MassChoice::Number(3);
    let bad = chain(Coordinate::Sliding, slider_crank(-1.0), uniform(1));
    let paths = fault_paths(vec![
        ("drive", None, drive(f64::NAN, 0.0)),
        ("engine", None, motor(0.0)),
        ("gapped", Some("engine"), part(gap)),
        ("loaded", Some("engine"), part(number)),
        ("wrong", Some("engine"), part(bad)),
        // Nothing more is said of what a faulty drive drives.
        (
            "behind",
            Some("drive"),
            part(chain(Coordinate::Turning, ratio(), rigid(0.1))),
        ),
    ]);
    assert_eq!(
        paths,
        [
            "drive.motion.speed",
            "gapped.pair.gap",
            "loaded.loads.push.mass",
            "loaded.loads.stop.friction.width",
            "wrong.position.slider_crank.crank",
        ]
    );
}

#[test]
fn inputs_that_lead_nowhere_are_faults() {
    let follower = || part(chain(Coordinate::Turning, ratio(), rigid(0.1)));
    let paths = fault_paths(vec![
        ("a", Some("b"), follower()),
        ("b", Some("a"), follower()),
        ("d", None, motor(0.0)),
    ]);
    assert_eq!(paths, ["a.input", "b.input"]);
    let paths = fault_paths(vec![
        ("a", None, follower()),
        ("b", Some("nobody"), follower()),
        ("d", Some("b"), motor(0.0)),
    ]);
    assert_eq!(paths, ["a.input", "b.input", "d.input"]);
}

#[test]
fn a_linkage_that_cannot_be_assembled_at_the_start_is_a_fault() {
    // Crank longer than the rod: |sin θ| < 0.2/0.25, θ within ±53.13 deg.
    let ram = || part(chain(Coordinate::Sliding, slider_crank(0.25), rigid(1.0)));
    let faults = lower(&scene(vec![
        ("drive", None, drive(1.0, PI / 2.0)),
        ("ram", Some("drive"), ram()),
    ]))
    .unwrap_err();
    assert_eq!(faults[0].path, "ram.position");
    assert!(faults[0].message.contains("`drive` at 90.000000 deg"));
    assert!(
        faults[0]
            .hint
            .contains("between -53.130102 and 53.130102 deg"),
        "{}",
        faults[0].hint
    );
    // A motor's angle counts as well.
    assert_eq!(
        fault_paths(vec![("m", None, motor(2.0)), ("ram", Some("m"), ram())]),
        ["ram.position"]
    );
}

#[test]
fn a_dead_position_on_the_way_is_said_before_and_stops_the_run() {
    let ram = || part(chain(Coordinate::Sliding, slider_crank(0.25), rigid(1.0)));
    let edge = 0.8f64.asin();
    let model = lowered(vec![
        ("drive", None, drive(2.0, 0.1)),
        ("ram", Some("drive"), ram()),
    ]);
    let track = &model.tracks[0];
    assert!(track.stops && track.object == 1 && track.source == TrackSource::Node(0));
    approx::assert_abs_diff_eq!(track.breaks.points[0], -edge, epsilon = 1e-15);
    approx::assert_abs_diff_eq!(track.breaks.points[1], edge, epsilon = 1e-15);
    let when = format!("t = {:.6} s", (edge - 0.1) / 2.0);
    assert!(model.warnings[0].contains(&when), "{}", model.warnings[0]);
    // Backwards the other edge comes first; a slow drive never gets there.
    let model = lowered(vec![
        ("drive", None, drive(-2.0, 0.1)),
        ("ram", Some("drive"), ram()),
    ]);
    let when = format!("t = {:.6} s", (edge + 0.1) / 2.0);
    assert!(model.warnings[0].contains(&when), "{}", model.warnings[0]);
    let model = lowered(vec![
        ("drive", None, drive(0.5, 0.1)),
        ("ram", Some("drive"), ram()),
    ]);
    assert!(model.warnings.is_empty() && model.tracks[0].stops);
}

#[test]
fn reach_is_followed_through_rigid_and_elastic_objects() {
    // A rocker swinging ±0.95 rad drives a linkage that ends at asin 0.8 = 0.9273 rad.
    let swing = PositionSpec::Sine {
        amplitude: 0.95,
        harmonic: 1.0,
        phase: 0.0,
        offset: 0.0,
    };
    for body in [rigid(0.1), uniform(3)] {
        let model = lowered(vec![
            ("drive", None, drive(2.0, 0.0)),
            (
                "lever",
                Some("drive"),
                part(chain(Coordinate::Turning, swing.clone(), body)),
            ),
            (
                "ram",
                Some("lever"),
                part(chain(Coordinate::Sliding, slider_crank(0.25), rigid(1.0))),
            ),
        ]);
        let time = (0.8f64.asin() / 0.95).asin() / 2.0;
        let when = format!("t = {time:.6} s");
        assert!(model.warnings[0].contains(&when), "{}", model.warnings[0]);
        assert_eq!(
            model.tracks[0].source,
            TrackSource::Node(model.objects[1].nodes.len())
        );
    }
}

#[test]
fn explicit_starts_are_checked_against_the_masses() {
    let parts = || {
        vec![
            ("drive", None, drive(1.0, 0.0)),
            (
                "rocker",
                Some("drive"),
                part(chain(Coordinate::Turning, ratio(), uniform(2))),
            ),
        ]
    };
    let with_start = |states: &[(&str, usize)]| {
        let mut scene = scene(parts());
        let states = states
            .iter()
            .map(|&(id, n)| (id.to_owned(), (vec![0.1; n], vec![0.0; n])));
        scene.run.start = StartSpec::Explicit(states.collect::<BTreeMap<_, _>>());
        lower(&scene)
    };
    let Start::Explicit(states) = with_start(&[("rocker", 2)]).unwrap().start else {
        panic!()
    };
    assert_eq!((states[0].object, states[0].displacement.len()), (1, 2));
    let paths = |states: &[(&str, usize)]| -> Vec<String> {
        with_start(states)
            .unwrap_err()
            .into_iter()
            .map(|fault| fault.path)
            .collect()
    };
    assert_eq!(
        paths(&[("rocker", 3)]),
        ["run.start.rocker.displacement", "run.start.rocker.speed"]
    );
    assert_eq!(paths(&[("drive", 1)]), ["run.start.drive"]);
    assert_eq!(paths(&[("nobody", 1)]), ["run.start.nobody"]);
}
