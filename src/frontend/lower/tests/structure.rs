use super::*;

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
    assert_eq!(model.objects[0].driver(), Some(4));
    assert_eq!(model.objects[1].driver(), Some(0));
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
    let model = lowered(vec![("engine", None, motor(0.7))]);
    assert!(
        matches!(model.nodes[0].motion, NodeMotion::Rotor { angle, speed } if angle == 0.7 && speed == 3.0)
    );
    assert_eq!(model.nodes[0].inertia, 0.2);
    let names: Vec<_> = model.loads.iter().map(|load| load.name.as_str()).collect();
    assert_eq!(names, ["engine.motor.torque", "engine.loads.drag"]);
}

#[test]
fn windows_and_tables_become_pieces_over_shared_tracks() {
    let window = |to| LoadLawSpec::Window {
        from: 0.5,
        to,
        force: -7.0,
        period: Some(TAU),
        over: None,
    };
    let table = LoadLawSpec::PositionTable {
        points: vec![(0.0, 1.0), (2.0, 5.0), (TAU, 1.0)],
        period: Some(TAU),
        over: None,
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
            let (piece, turned) = breaks.piece(breaks.segment_at(x, 1.0));
            let piece = pieces[piece];
            piece.value + piece.slope * (x - turned - piece.start)
        }
        law => law.as_constant().expect("a constant"),
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
        .map(|load| load.law.as_constant().expect("a constant"))
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
            LoadLawSpec::Declared(LawInstance::friction(1.0, 0.0)),
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

#[test]
fn faults_of_tables_name_the_point() {
    let paths = |law: LoadLawSpec| {
        let mut spec = chain(Coordinate::Turning, ratio(), rigid(0.1));
        spec.loads = vec![load("push", law)];
        fault_paths(vec![
            ("drive", None, drive(1.0, 0.0)),
            ("rocker", Some("drive"), part(spec)),
        ])
    };
    let points = vec![(0.0, 1.0), (0.0, 2.0)];
    assert_eq!(
        paths(LoadLawSpec::TimeTable(points.clone())),
        ["rocker.loads.push.time_table[1]"]
    );
    for period in [None, Some(1.0)] {
        let points = points.clone();
        assert_eq!(
            paths(LoadLawSpec::PositionTable {
                points,
                period,
                over: None
            }),
            ["rocker.loads.push.position_table.points[1]"]
        );
    }
}
