//! Solving a linkage and reducing it to its input allocates nothing.

use crate::counting::allocations;
use dam::integrate::Dynamics;
use dam::linkage::Linkage;
use dam::linkage::spec::{
    AssemblyChoice, AssemblySpec, ForceLaw, ForceSpec, LinkSpec, LinkageSpec, OutputKind,
    OutputSpec, PairKind, PairSpec, PointOf,
};
use dam::lower::lower;
use dam::scene::{BuiltIn, Document, Overrides};
use dam::system::System;

fn at(link: Option<usize>, at: [f64; 2]) -> PointOf {
    PointOf { link, at }
}

fn pin(name: &str, on: PointOf, link: PointOf) -> PairSpec {
    PairSpec {
        name: name.to_owned(),
        on,
        link,
        kind: PairKind::Revolute { diameter: 0.0 },
        friction: 0.0,
    }
}

/// A plate on three levers (solved by iteration), one of them driven by a
/// four-bar (in closed form).
fn linkage() -> Linkage {
    let o = [0.0; 2];
    let names = [
        "crank", "coupler", "rocker", "plate", "left", "right", "rod",
    ];
    let links = names.map(|name| LinkSpec {
        name: name.to_owned(),
        mass: 1.0,
        centre: [0.1, 0.0],
        moment: 0.01,
        ..LinkSpec::default()
    });
    let [crank, coupler, rocker, plate, left, right, rod] = [0, 1, 2, 3, 4, 5, 6].map(Some);
    let pairs = vec![
        pin("A", at(None, [-0.45, -0.3]), at(crank, o)),
        pin("B", at(crank, [0.05, 0.0]), at(coupler, o)),
        pin("C", at(coupler, [0.4, 0.0]), at(rocker, [0.3, 0.0])),
        pin("D", at(None, [0.0, -0.3]), at(rocker, o)),
        pin("E", at(rocker, [0.1, 0.0]), at(rod, o)),
        pin("F", at(rod, [0.62, 0.0]), at(plate, o)),
        pin("G", at(None, [1.2, 0.2]), at(right, o)),
        pin("H", at(right, [0.4, 0.0]), at(plate, [0.5, 0.1])),
        pin("I", at(None, [-0.1, 1.1]), at(left, o)),
        pin("J", at(left, [0.79, 0.0]), at(plate, [0.2, 0.45])),
    ];
    let choose = |link: usize, angle: f64| AssemblySpec {
        link,
        choice: AssemblyChoice::Angle(angle),
    };
    let strut = ForceLaw::Strut {
        from: at(None, o),
        to: at(plate, [0.3, 0.3]),
        rate: 100.0,
        free_length: 0.2,
        damping: 3.0,
        force: -20.0,
    };
    let follower = ForceLaw::Force {
        point: at(plate, o),
        force: [1.0, 2.0],
        follows: true,
    };
    let force = |name: &str, law| ForceSpec {
        name: name.to_owned(),
        law,
    };
    Linkage::new(LinkageSpec {
        links: links.to_vec(),
        pairs,
        assembly: vec![
            choose(3, 0.0),
            choose(4, -0.3),
            choose(5, 2.2),
            choose(6, 1.0),
        ],
        gravity: [0.0, -9.81],
        forces: vec![force("strut", strut), force("follower", follower)],
        outputs: vec![OutputSpec {
            name: "tilt".to_owned(),
            kind: OutputKind::Angle { link: 3 },
        }],
        ..LinkageSpec::default()
    })
    .expect("a linkage")
}

#[test]
fn solving_allocates_nothing() {
    let linkage = linkage();
    let [from, to] = linkage.range().ends().map(|end| end.clamp(-20.0, 20.0));
    let mut workspace = linkage.workspace();
    let before = allocations();
    let mut sum = 0.0;
    for i in 1..500 {
        let q = from + (to - from) * f64::from(i) / 500.0;
        if linkage.solve(q, i as usize % 4, &mut workspace).is_ok() {
            let reduced = linkage.reduced_linkage(&workspace);
            sum += reduced.inertia[0] + linkage.output(0, &workspace).value;
        }
    }
    // Out of reach, too.
    let _ = linkage.solve(f64::NAN, 1, &mut workspace);
    assert!(sum.is_finite() && sum != 0.0);
    assert_eq!(allocations(), before);
}

/// Linkages of several inputs: on motors alone, and with an elastic shaft before one of them.
#[test]
fn the_right_hand_side_of_several_inputs_allocates_nothing() {
    let five_bar = std::fs::read_to_string("scenarios/linkages/five_bar.json").expect("a scene");
    let shaft = r#""shaft": { "kind": "shaft", "input": "right", "inertia": 0.01, "stiffness": 500, "masses": 2 }, "bar": {"#;
    let elastic = five_bar.replace(r#""bar": {"#, shaft);
    let elastic = elastic.replace(r#""object": "right""#, r#""object": "shaft""#);
    assert!(elastic.contains(r#""object": "shaft""#));
    for text in [five_bar, elastic] {
        let document = Document::parse("scene", text.as_bytes()).expect("JSON");
        let scene = document.scene(&BuiltIn, &Overrides::new(Vec::<String>::new()));
        let scene = scene
            .map_err(|faults| faults.render(false))
            .expect("a scene")
            .scene;
        let system = System::new(lower(&scene).expect("a model")).expect("a system");
        let start = system.initial_state().expect("a start");
        let n = start.y.len();
        let mut scratch = system.scratch();
        let (mut dy, mut signals) = (vec![0.0; n], vec![[0.0; 3]; system.signals()]);
        let mut out = vec![0.0; n];
        let direction = vec![1.0; n];
        let mut y = start.y.clone();
        let before = allocations();
        for _ in 0..200 {
            system.derivatives(0.0, &y, &start.modes, &mut scratch, &mut dy);
            let extra = &mut signals[system.coordinates()..];
            system.extra_signals(0.0, &y, &dy, &start.modes, &mut scratch, extra);
            system.tangent(0.0, &y, &start.modes, &direction, &mut scratch, &mut out);
            for (y, dy) in y.iter_mut().zip(&dy) {
                *y += 1e-6 * dy;
            }
        }
        assert!(y.iter().chain(&out).all(|value| value.is_finite()));
        assert_eq!(allocations(), before);
    }
}
