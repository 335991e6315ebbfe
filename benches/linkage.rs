//! Cost of one position of a linkage: transfer functions to second and third
//! order, and the reduced inertia, potential and forces.
//!
//! `cargo bench -p dam-benches --bench linkage`

use criterion::{Criterion, criterion_group, criterion_main};
use dam::linkage::Linkage;
use dam::linkage::spec::{
    AssemblyChoice, AssemblySpec, ForceLaw, ForceSpec, LinkSpec, LinkageSpec, PairKind, PairSpec,
    PointOf,
};
use std::hint::black_box;

/// A place on a link (index from 0) or on the ground (−1).
type Side = (i64, [f64; 2]);

fn linkage(links: usize, pins: &[(Side, Side)], slides: &[(Side, Side, f64, f64)]) -> LinkageSpec {
    let at = |(link, at): Side| PointOf {
        link: usize::try_from(link).ok(),
        at,
    };
    let pair = |(on, link, kind): (Side, Side, PairKind)| PairSpec {
        name: format!("{on:?}{link:?}"),
        on: at(on),
        link: at(link),
        kind,
        friction: 0.0,
    };
    let pins = pins
        .iter()
        .map(|&(on, link)| (on, link, PairKind::Revolute { diameter: 0.0 }));
    let slides = slides.iter().map(|&(on, link, direction, angle)| {
        let kind = PairKind::Sliding {
            direction,
            angle,
            corners: [0.01, -0.01],
            half_height: 0.0,
        };
        (on, link, kind)
    });
    LinkageSpec {
        links: (0..links)
            .map(|link| LinkSpec {
                name: format!("l{link}"),
                mass: 1.0,
                centre: [0.05, 0.0],
                moment: 0.01,
                ..LinkSpec::default()
            })
            .collect(),
        pairs: pins.chain(slides).map(pair).collect(),
        gravity: [0.0, -9.81],
        ..LinkageSpec::default()
    }
}

const O: [f64; 2] = [0.0, 0.0];

fn four_bar() -> LinkageSpec {
    let pins = [
        ((-1, O), (0, O)),
        ((0, [0.1, 0.0]), (1, O)),
        ((1, [0.4, 0.0]), (2, [0.3, 0.0])),
        ((-1, [0.45, 0.0]), (2, O)),
    ];
    linkage(3, &pins, &[])
}

/// Andrews' squeezing mechanism: geometry of the Test Set for IVP Solvers.
fn andrews() -> LinkageSpec {
    let (a, b) = ([-0.06934, -0.00227], [-0.03635, 0.03273]);
    let end = [-0.028, 0.0];
    let pins = [
        ((-1, O), (0, O)),
        ((0, [0.007, 0.0]), (1, O)),
        ((-1, b), (2, O)),
        ((1, end), (2, [0.0, -0.035])),
        ((-1, a), (4, O)),
        ((4, [0.04, 0.0]), (3, [0.0, 0.02])),
        ((1, end), (3, O)),
        ((-1, a), (6, O)),
        ((6, [0.0, -0.04]), (5, [-0.02, 0.0])),
        ((1, end), (5, O)),
    ];
    let mut spec = linkage(7, &pins, &[]);
    spec.start = -0.0617;
    let angles = [-0.0617, 0.45528, 0.71003, 0.48736, 1.00788, 1.23055];
    spec.assembly = angles
        .iter()
        .enumerate()
        .map(|(index, &angle)| AssemblySpec {
            link: index + 1,
            choice: AssemblyChoice::Angle(angle),
        })
        .collect();
    spec.forces.push(ForceSpec {
        name: "spring".to_owned(),
        law: ForceLaw::Strut {
            from: PointOf {
                link: None,
                at: [0.014, 0.072],
            },
            to: PointOf {
                link: Some(2),
                at: [0.02, -0.018],
            },
            rate: 4530.0,
            free_length: 0.07785,
            damping: 0.0,
            force: 0.0,
        },
    });
    spec
}

/// Eight links with the ground: a four-bar, a slotted lever on its rocker and a
/// ram behind it.
fn eight_links() -> LinkageSpec {
    let pins = [
        ((-1, O), (0, O)),
        ((0, [0.1, 0.0]), (1, O)),
        ((1, [0.4, 0.0]), (2, [0.3, 0.0])),
        ((-1, [0.45, 0.0]), (2, O)),
        ((2, [0.15, 0.05]), (3, O)),
        ((-1, [0.45, -0.4]), (4, O)),
        ((4, [0.8, 0.0]), (5, O)),
        ((5, [0.5, 0.0]), (6, O)),
    ];
    let slides = [
        ((4, O), (3, O), 0.0, 0.0),
        ((-1, [0.0, 0.5]), (6, O), 0.0, 0.0),
    ];
    linkage(7, &pins, &slides)
}

fn bench(c: &mut Criterion) {
    for (name, spec) in [
        ("four-bar", four_bar()),
        ("Andrews", andrews()),
        ("eight links", eight_links()),
    ] {
        let linkage = Linkage::new(spec.clone()).expect("a linkage");
        let mut workspace = linkage.workspace();
        let mut group = c.benchmark_group(name);
        for order in [2, 3] {
            let mut q = 0.0;
            group.bench_function(format!("transfer functions to order {order}"), |bencher| {
                bencher.iter(|| {
                    q += 0.01;
                    linkage.solve(black_box(q), order, &mut workspace)
                })
            });
        }
        group.bench_function("reduced inertia, potential and forces", |bencher| {
            bencher.iter(|| linkage.reduced_linkage(black_box(&workspace)))
        });
        group.bench_function("structure, assembly and range", |bencher| {
            bencher.iter(|| Linkage::new(spec.clone()).is_ok())
        });
        group.finish();
    }
}

criterion_group!(benches, bench);
criterion_main!(benches);
