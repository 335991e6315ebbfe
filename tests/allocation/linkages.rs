//! Solving a linkage and reducing it to its input allocates nothing.

use crate::counting::allocations;
use dam::linkage::Linkage;
use dam::linkage::spec::{
    AssemblyChoice, AssemblySpec, ForceLaw, ForceSpec, LinkSpec, LinkageSpec, OutputKind,
    OutputSpec, PairKind, PairSpec, PointOf,
};

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
            let reduced = linkage.reduced(&workspace);
            sum += reduced.inertia[0] + linkage.output(0, &workspace).value;
        }
    }
    // Out of reach, too.
    let _ = linkage.solve(f64::NAN, 1, &mut workspace);
    assert!(sum.is_finite() && sum != 0.0);
    assert_eq!(allocations(), before);
}
