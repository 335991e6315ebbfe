//! What a position of a kinetostatic study costs: positions with transfer
//! functions, reactions with friction, and the proof that they are the only ones.

use criterion::{Criterion, criterion_group, criterion_main};
use dam::linkage::Linkage;
use dam::linkage::kinetostatics::{InputMotion, Kinetostatics, Options};
use dam::linkage::spec::{
    AssemblyChoice, AssemblySpec, ForceLaw, ForceSpec, LinkSpec, LinkageSpec, PairKind, PairSpec,
    PointOf,
};
use std::f64::consts::TAU;
use std::hint::black_box;

/// Positions of a turn.
const POSITIONS: usize = 360;

fn of(link: usize, x: f64, y: f64) -> PointOf {
    PointOf {
        link: Some(link),
        at: [x, y],
    }
}

fn ground(x: f64, y: f64) -> PointOf {
    PointOf {
        link: None,
        at: [x, y],
    }
}

fn pin(on: PointOf, link: PointOf) -> PairSpec {
    PairSpec {
        name: format!("pin of {:?} and {:?}", on.link, link.link),
        on,
        link,
        kind: PairKind::Revolute { diameter: 0.03 },
        friction: 0.1,
    }
}

fn bar(name: &str, length: f64) -> LinkSpec {
    LinkSpec {
        name: name.to_owned(),
        points: Vec::new(),
        mass: 1.0 + length,
        centre: [0.5 * length, 0.0],
        moment: 0.1 * length * length,
    }
}

fn push(link: usize) -> Vec<ForceSpec> {
    let law = ForceLaw::Force {
        point: of(link, 0.0, 0.0),
        force: [-1000.0, 30.0],
        follows: false,
    };
    let name = "load".to_owned();
    vec![ForceSpec { name, law }]
}

/// Crank, rod and slider.
fn slider_crank() -> LinkageSpec {
    let guide = PairSpec {
        name: "guide".to_owned(),
        on: ground(0.0, 0.0),
        link: of(2, 0.0, 0.0),
        kind: PairKind::Sliding {
            direction: 0.0,
            angle: 0.0,
            corners: [0.03, -0.02],
            half_height: 0.02,
        },
        friction: 0.1,
    };
    LinkageSpec {
        links: vec![bar("crank", 0.06), bar("rod", 0.3), bar("slider", 0.0)],
        pairs: vec![
            pin(ground(0.0, 0.0), of(0, 0.0, 0.0)),
            pin(of(0, 0.06, 0.0), of(1, 0.0, 0.0)),
            pin(of(1, 0.3, 0.0), of(2, 0.0, 0.0)),
            guide,
        ],
        assembly: vec![AssemblySpec {
            link: 1,
            choice: AssemblyChoice::Angle(0.0),
        }],
        gravity: [0.0, -9.81],
        forces: push(2),
        ..LinkageSpec::default()
    }
}

/// A crank and three dyads of bars, one behind the other: with the ground eight links.
fn eight_links() -> LinkageSpec {
    let mut linkage = LinkageSpec {
        links: vec![bar("crank", 0.05)],
        pairs: vec![pin(ground(0.0, 0.0), of(0, 0.0, 0.0))],
        gravity: [0.0, -9.81],
        forces: push(6),
        ..LinkageSpec::default()
    };
    let mut last = of(0, 0.05, 0.0);
    for stage in 0..3 {
        let (coupler, rocker) = (2 * stage + 1, 2 * stage + 2);
        linkage.links.push(bar("coupler", 0.3));
        linkage.links.push(bar("rocker", 0.2));
        let pivot = 0.3 * (stage + 1) as f64;
        linkage.pairs.push(pin(last, of(coupler, 0.0, 0.0)));
        linkage
            .pairs
            .push(pin(of(coupler, 0.3, 0.0), of(rocker, 0.2, 0.0)));
        linkage
            .pairs
            .push(pin(ground(pivot, -0.2), of(rocker, 0.0, 0.0)));
        last = of(rocker, 0.2, 0.02);
    }
    // Names are addresses and must differ.
    for (index, link) in linkage.links.iter_mut().enumerate() {
        link.name = format!("{} {index}", link.name);
    }
    linkage
}

/// A turn of a linkage: the sum of all driving forces, which is looked at only
/// that it is not left out.
fn turn(linkage: &Linkage, solver: &Kinetostatics) -> impl FnMut() -> f64 {
    let (mut at, mut w) = (linkage.workspace(), solver.workspace());
    let options = Options {
        search: false,
        ..Options::default()
    };
    move || {
        let mut sum = 0.0;
        for index in 0..POSITIONS {
            let coordinate = TAU * index as f64 / POSITIONS as f64;
            linkage.solve(coordinate, 3, &mut at).expect("within reach");
            let motion = InputMotion {
                coordinate,
                speed: 20.0,
                acceleration: 0.0,
            };
            let solved = solver
                .solve(&at, motion, &options, &mut w)
                .expect("solvable");
            assert!(solved.unique);
            sum += w.driver_force();
        }
        sum
    }
}

fn forces(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("forces, 360 positions");
    for (name, spec) in [
        ("slider-crank", slider_crank()),
        ("eight links", eight_links()),
    ] {
        let solver = Kinetostatics::new(&spec).expect("a good linkage");
        let linkage = Linkage::new(spec).expect("a good linkage");
        let mut run = turn(&linkage, &solver);
        group.bench_function(name, |bencher| bencher.iter(|| black_box(run())));
    }
    group.finish();
}

criterion_group!(benches, forces);
criterion_main!(benches);
