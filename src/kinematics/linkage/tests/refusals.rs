//! What is refused, and how it is said.

use super::examples::{Builder, GROUND, four_bar, slider_crank, triad};
use crate::fault::Fault;
use crate::kinematics::linkage::Linkage;
use crate::kinematics::linkage::spec::{
    AssemblyChoice, ForceLaw, LinkageSpec, OutputKind, PointOf,
};
use proptest::prelude::*;

fn refused(spec: LinkageSpec) -> Vec<Fault> {
    Linkage::new(spec).expect_err("it is refused")
}

/// `path: message (hint)`, a line each.
fn text(faults: &[Fault]) -> String {
    let line = |fault: &Fault| format!("{}: {} ({})\n", fault.path, fault.message, fault.hint);
    faults.iter().map(line).collect()
}

#[test]
fn golden() {
    let cases = [
        ("four-bar with a fifth pin", {
            let four_bar = four_bar([0.1, 0.4, 0.3, 0.45]);
            four_bar.pin((GROUND, [0.2, 0.2]), (Some(1), [0.1, 0.1])).0
        }),
        ("five links in a ring", {
            Builder::new(&["a", "b", "c", "d"])
                .pin((GROUND, [0.0; 2]), (Some(0), [0.0; 2]))
                .pin((Some(0), [0.1, 0.0]), (Some(1), [0.0; 2]))
                .pin((Some(1), [0.3, 0.0]), (Some(2), [0.0; 2]))
                .pin((Some(2), [0.3, 0.0]), (Some(3), [0.0; 2]))
                .pin((GROUND, [0.4, 0.0]), (Some(3), [0.3, 0.0]))
                .0
        }),
        ("one part rigid, one part loose", {
            Builder::new(&["crank", "plate", "a", "b", "c"])
                .pin((GROUND, [0.0; 2]), (Some(0), [0.0; 2]))
                .pin((GROUND, [1.0, 0.0]), (Some(1), [0.0; 2]))
                .pin((GROUND, [1.0, 1.0]), (Some(1), [0.0, 1.0]))
                .pin((Some(0), [0.1, 0.0]), (Some(2), [0.0; 2]))
                .pin((Some(2), [0.3, 0.0]), (Some(3), [0.0; 2]))
                .pin((Some(3), [0.3, 0.0]), (Some(4), [0.0; 2]))
                .pin((GROUND, [0.4, 0.0]), (Some(4), [0.3, 0.0]))
                .0
        }),
        ("two links pinned together twice", {
            Builder::new(&["crank", "plate", "lid"])
                .pin((GROUND, [0.0; 2]), (Some(0), [0.0; 2]))
                .pin((Some(0), [0.1, 0.0]), (Some(1), [0.0; 2]))
                .pin((Some(1), [0.3, 0.0]), (Some(2), [0.3, 0.0]))
                .pin((Some(1), [0.2, 0.1]), (Some(2), [0.2, 0.1]))
                .0
        }),
        ("wedges", {
            Builder::new(&["crank", "a", "b"])
                .pin((GROUND, [0.0; 2]), (Some(0), [0.0; 2]))
                .slide((GROUND, [0.0; 2]), (Some(1), [0.0; 2]), 0.0, 0.0)
                .slide((Some(1), [0.0; 2]), (Some(2), [0.0; 2]), 0.5, -0.5)
                .slide((GROUND, [0.0; 2]), (Some(2), [0.0; 2]), 1.5, -1.5)
                .0
        }),
        ("too short", four_bar([0.1, 0.2, 0.1, 0.45]).0),
        ("guide out of reach", slider_crank(0.1, 0.2, 0.5).0),
        ("both pins in one place", four_bar([0.1, 0.0, 0.3, 0.45]).0),
        ("in line at the start", four_bar([0.2, 0.5, 0.2, 0.5]).0),
        ("a triad with nothing said", {
            let mut spec = triad().0;
            spec.assembly.clear();
            spec
        }),
        (
            "a branch of a triad",
            triad().choose(2, AssemblyChoice::Branch(1.0)).0,
        ),
        ("both branches", {
            let plus = four_bar([0.1, 0.4, 0.3, 0.45]).choose(1, AssemblyChoice::Branch(1.0));
            plus.choose(2, AssemblyChoice::Branch(-1.0)).0
        }),
        ("a branch and a position on the other", {
            let plus = four_bar([0.1, 0.4, 0.3, 0.45]).choose(1, AssemblyChoice::Branch(1.0));
            plus.choose(2, AssemblyChoice::Angle(-1.8)).0
        }),
        ("two positions on different branches", {
            let below = four_bar([0.1, 0.4, 0.3, 0.45]).choose(1, AssemblyChoice::Angle(-0.8));
            below.choose(2, AssemblyChoice::Angle(1.8)).0
        }),
        ("another angle of the crank", {
            let four_bar = four_bar([0.1, 0.4, 0.3, 0.45]).start(0.3);
            four_bar.choose(0, AssemblyChoice::Angle(1.5)).0
        }),
        ("wrong numbers", wrong_numbers()),
    ];
    let mut all = String::new();
    for (name, spec) in cases {
        all += &format!("== {name}\n{}", text(&refused(spec)));
    }
    let golden = include_str!("refusals.txt");
    assert!(all == golden, "found:\n{all}");
}

fn wrong_numbers() -> LinkageSpec {
    let mut spec = four_bar([0.1, 0.4, 0.3, 0.45])
        .slide((Some(1), [0.0; 2]), (Some(1), [0.0; 2]), f64::NAN, 0.0)
        .mass(0, -1.0, [0.0, f64::INFINITY], f64::NAN)
        .choose(2, AssemblyChoice::Branch(0.5))
        .force(ForceLaw::Couple {
            link: 9,
            couple: 1.0,
        })
        .force(ForceLaw::Torsion {
            pair: 4,
            rate: -1.0,
            free_angle: 0.0,
            damping: 0.0,
        })
        .force(ForceLaw::Table {
            point: PointOf {
                link: GROUND,
                at: [0.0; 2],
            },
            direction: 0.0,
            points: vec![(1.0, 0.0), (1.0, 2.0)],
            period: Some(0.0),
        })
        .output(OutputKind::Angle { link: 3 })
        .0;
    spec.links[2].name = "crank".to_owned();
    spec.driver = 7;
    spec.start = f64::NAN;
    spec.travel = Some([1.0, 0.0]);
    spec
}

fn any_number() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -2.0f64..2.0,
        1 => prop::num::f64::ANY,
        1 => Just(0.0),
        1 => prop::sample::select(vec![1e-12, 1e-8, 1e9, -1e9, 1e150]),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]
    /// Links and pairs at random, mostly senseless: refused or solved, never a
    /// panic, never not a number.
    #[test]
    fn anything_is_refused_or_solved(
        numbers in prop::collection::vec(any_number(), 40),
        ends in prop::collection::vec((-1i64..5, -1i64..5, any::<bool>()), 1..8),
        links in 1usize..5,
        driver in 0usize..3,
        q in any_number(),
    ) {
        let names: Vec<String> = (0..links).map(|link| format!("l{link}")).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let mut builder = Builder::new(&names).start(numbers[0]);
        let mut next = numbers.iter().copied().cycle();
        let mut place = |link: i64| {
            let link = usize::try_from(link).ok().map(|link| link % links);
            (link, [next.next().unwrap_or(0.0), next.next().unwrap_or(0.0)])
        };
        for &(i, j, slides) in &ends {
            let (on, to) = (place(i), place(j));
            builder = if slides {
                builder.slide(on, to, on.1[0], to.1[1])
            } else {
                builder.pin(on, to)
            };
        }
        builder.0.driver = driver;
        let Ok(linkage) = Linkage::new(builder.0) else { return Ok(()) };
        let mut workspace = linkage.workspace();
        if linkage.solve(q, 3, &mut workspace).is_ok() {
            for link in 0..links {
                let pose = workspace.pose(link);
                prop_assert!((pose.x + pose.y + pose.cos + pose.sin).is_finite());
            }
        }
    }
}
