//! Linkages that move although the count of their degrees of freedom says no.

use super::examples::{Builder, GROUND};
use super::support::{close, closure_error, compare_with_differences, interior};
use crate::kinematics::linkage::kinetostatics::{
    ForceWorkspace, Indeterminate, InputMotion, Kinetostatics, Options, Reaction,
};
use crate::kinematics::linkage::spec::{
    AssemblyChoice, ForceLaw, LinkageSpec, PointOf, Redundant, RedundantPart,
};
use crate::kinematics::linkage::{GroupKind, Linkage, Workspace};
use std::f64::consts::{FRAC_PI_2, PI};

/// A crank's radius, the distance of the axles (m).
const RADIUS: f64 = 0.3;
const APART: f64 = 1.0;
/// Length of the connecting rod (m), force on the piston (N).
const ROD: f64 = 1.5;
const PISTON: f64 = -40e3;

/// Three coupled wheels of a locomotive, the first one driven: links 0 to 2 the wheels, 3 the
/// coupling rod; connecting rod (4) and crosshead (5) act on it at the wheel in the middle.
fn locomotive() -> Builder {
    let wheel = |k: usize| (Some(k), [0.0; 2]);
    let crank = |k: usize| (Some(k), [RADIUS, 0.0]);
    let at = |k: usize| [APART * k as f64, 0.0];
    let mut builder = Builder::new(&["first", "second", "third", "coupling", "rod", "crosshead"])
        .start(1.0)
        .choose(1, AssemblyChoice::Angle(1.0))
        .choose(2, AssemblyChoice::Angle(1.0))
        .choose(
            5,
            AssemblyChoice::Near {
                point: [0.0; 2],
                place: [-0.5, 0.0],
            },
        );
    for k in 0..3 {
        builder = builder
            .pin((GROUND, at(k)), wheel(k))
            .pin(crank(k), (Some(3), at(k)))
            .mass(k, 300.0, [-0.05, 0.0], 20.0);
    }
    let piston = PointOf {
        link: Some(5),
        at: [0.0; 2],
    };
    builder
        .mass(3, 150.0, [APART, 0.0], 30.0)
        .pin((Some(3), [APART, 0.0]), (Some(4), [0.0; 2]))
        .pin((Some(4), [ROD, 0.0]), (Some(5), [0.0; 2]))
        .slide((GROUND, [0.0; 2]), (Some(5), [0.0; 2]), 0.0, 0.0)
        .force(ForceLaw::Force {
            point: piston,
            force: [PISTON, 0.0],
            follows: false,
        })
}

/// A carriage on two parallel guides, moved by a crank and a rod.
fn two_guides() -> Builder {
    Builder::new(&["crank", "rod", "carriage"])
        .pin((GROUND, [0.0; 2]), (Some(0), [0.0; 2]))
        .pin((Some(0), [0.1, 0.0]), (Some(1), [0.0; 2]))
        .pin((Some(1), [0.4, 0.0]), (Some(2), [0.0; 2]))
        .slide((GROUND, [0.0, -0.1]), (Some(2), [0.0, -0.1]), 0.0, 0.0)
        .slide((GROUND, [0.0, 0.1]), (Some(2), [0.0, 0.1]), 0.0, 0.0)
        .mass(2, 3.0, [0.0; 2], 0.1)
}

/// A wedge that lifts another one, of sliding pairs alone.
fn wedges() -> Builder {
    Builder::new(&["wedge", "ram"])
        .slide((GROUND, [0.0; 2]), (Some(0), [0.0; 2]), 0.0, 0.0)
        .slide((Some(0), [0.0; 2]), (Some(1), [0.0; 2]), 0.4, -0.4)
        .slide((GROUND, [0.0; 2]), (Some(1), [0.0; 2]), 1.5, -1.5)
        .mass(1, 2.0, [0.0; 2], 0.1)
}

/// An elliptic trammel with a crank to the middle of its bar: the crank drives, the bar has a block
/// at either end.
fn trammel() -> Builder {
    Builder::new(&["crank", "bar", "block", "other"])
        .pin((GROUND, [0.0; 2]), (Some(0), [0.0; 2]))
        .pin((Some(0), [0.2, 0.0]), (Some(1), [0.0; 2]))
        .pin((Some(1), [0.2, 0.0]), (Some(2), [0.0; 2]))
        .slide((GROUND, [0.0; 2]), (Some(2), [0.0; 2]), 0.0, 0.0)
        .pin((Some(1), [-0.2, 0.0]), (Some(3), [0.0; 2]))
        .slide((GROUND, [0.0; 2]), (Some(3), [0.0; 2]), FRAC_PI_2, 0.0)
        .start(0.7)
        .choose(
            2,
            AssemblyChoice::Near {
                point: [0.0; 2],
                place: [0.3, 0.0],
            },
        )
        .mass(1, 1.0, [0.1, 0.0], 0.02)
}

fn all() -> Vec<(&'static str, Builder)> {
    vec![
        ("locomotive", locomotive()),
        ("two guides", two_guides()),
        ("wedges", wedges()),
        ("trammel", trammel()),
    ]
}

#[test]
fn all_pairs_hold_and_derivatives_are_right() {
    for (name, builder) in all() {
        let linkage = Linkage::new(builder.0).unwrap_or_else(|faults| panic!("{name}: {faults:?}"));
        assert_eq!(linkage.structure().mobility, 1, "{name}");
        let mut workspace = linkage.workspace();
        for k in 0..23 {
            let q = interior(&linkage, 0.03 + f64::from(k) / 24.0);
            linkage.solve(q, 0, &mut workspace).unwrap();
            let off = closure_error(&linkage, &workspace);
            assert!(off < 1e-11, "{name} at {q}: {off}");
            compare_with_differences(&linkage, q).unwrap();
        }
    }
}

#[test]
fn what_is_redundant_is_told_in_words() {
    let told = |builder: Builder| {
        let linkage = Linkage::new(builder.0).unwrap();
        linkage.structure().to_string()
    };
    let locomotive = told(locomotive());
    assert!(
        locomotive.contains("3·6 − 2·9 = 0, 1 redundant constraint: 0 + 1 = 1 degree of freedom"),
        "{locomotive}"
    );
    assert!(
        locomotive.contains("redundant: the length of `third` between its pins `p4` and `p5`"),
        "{locomotive}"
    );
    assert!(
        locomotive.contains("redundantly held link: third (pairs p4, p5)"),
        "{locomotive}"
    );
    assert!(told(two_guides()).contains("redundant: the pair `p4` holds"));
    assert!(told(wedges()).contains("redundant: the couple of the guide `p2` holds"));
    assert!(told(trammel()).contains("the pin `p4` of `other` across its guide `p5`"));
}

#[test]
fn hidden_links_are_not_seen() {
    let linkage = Linkage::new(locomotive().0).unwrap();
    let (spec, structure) = (linkage.spec(), linkage.structure());
    assert_eq!([spec.links.len(), spec.pairs.len()], [6, 9]);
    for group in &structure.groups {
        assert!(group.links.iter().all(|&link| link < 6));
        assert!(group.pairs.iter().all(|&pair| pair < 9));
    }
    let last = structure
        .groups
        .iter()
        .find(|group| group.kind == GroupKind::Overheld);
    assert_eq!(last.map(|group| group.branch), Some(None));
}

/// Hints for each link in turn and for all of them together, each off by a part of the size.
#[test]
fn hints_that_are_off_are_warnings_and_no_faults() {
    for (name, builder) in all() {
        let bare = Linkage::new(builder.0.clone()).unwrap();
        let mut workspace = bare.workspace();
        bare.solve(bare.spec().start, 0, &mut workspace).unwrap();
        for (off, around) in [(0.02, 0.4), (0.3, 4.0), (7.0, 2.0)] {
            let hint = |link: usize| {
                // A point that no pin holds, so that it tells both assemblies apart.
                let at = [0.37 * bare.typical_length(), 0.21 * bare.typical_length()];
                let own = PointOf {
                    link: Some(link),
                    at,
                };
                let [x, y] = workspace.point(own).map(|jet| jet.value);
                let far = off * bare.typical_length();
                let (sin, cos) = f64::sin_cos(around + link as f64);
                AssemblyChoice::Near {
                    point: at,
                    place: [x + far * cos, y + far * sin],
                }
            };
            let what = format!("{name} off by {off}");
            hinted_in_turn(&builder, &what, &hint, |linkage, link, said| {
                let own = &linkage.spec().links[link].name;
                said.contains(&format!("position of `{own}`")) || off < 0.1
            });
        }
        for off in [0.02, 1.7, 3.0] {
            let hint = |link: usize| AssemblyChoice::Angle(angle(&workspace, link) + off);
            let what = format!("{name} turned by {off}");
            hinted_in_turn(&builder, &what, &hint, |linkage, link, said| {
                let mut workspace = linkage.workspace();
                linkage
                    .solve(linkage.spec().start, 0, &mut workspace)
                    .unwrap();
                let AssemblyChoice::Angle(said_of) = hint(link) else {
                    return false;
                };
                // The other assembly of a link that has two may be nearer.
                let turned = said_of - angle(&workspace, link);
                let far = 0.5 * turned.sin().hypot(1.0 - turned.cos()) > f64::sin(0.125);
                let own = &linkage.spec().links[link].name;
                said.contains(&format!("angle of `{own}`")) == far
            });
        }
    }
}

fn angle(workspace: &Workspace, link: usize) -> f64 {
    let pose = workspace.pose(link);
    pose.sin.atan2(pose.cos)
}

/// The linkage with hints for each link in turn, for all of them, and for all but one.
fn hinted_in_turn(
    builder: &Builder,
    what: &str,
    hint: &dyn Fn(usize) -> AssemblyChoice,
    warned: impl Fn(&Linkage, usize, &str) -> bool,
) {
    let links = builder.0.links.len();
    let mut choices: Vec<Vec<usize>> = (0..links).map(|link| vec![link]).collect();
    choices.push((0..links).collect());
    choices.extend((0..links).map(|left| (0..links).filter(|&link| link != left).collect()));
    for hints in choices {
        let mut spec = builder.0.clone();
        spec.assembly.retain(|choice| !hints.contains(&choice.link));
        let hinted = hints.iter().fold(Builder(spec), |builder, &link| {
            builder.choose(link, hint(link))
        });
        let linkage = Linkage::new(hinted.0)
            .unwrap_or_else(|faults| panic!("{what}, hints of {hints:?}: {faults:?}"));
        assert_eq!(linkage.spec().redundant.len(), 1, "{what} {hints:?}");
        let said = linkage.remarks().join("\n");
        for &link in &hints {
            let right = warned(&linkage, link, &said);
            assert!(right, "{what} {hints:?} {link}: {said}");
        }
    }
}

/// Three cranks of one length on a coupling link that is as long as the axles are apart.
fn three_cranks() -> Builder {
    let mut builder = Builder::new(&["a", "b", "c", "coupling"]).start(0.7);
    for k in 0..3 {
        let at = [0.1 * k as f64, 0.0];
        builder = builder
            .pin((GROUND, at), (Some(k), [0.0; 2]))
            .pin((Some(k), [0.05, 0.0]), (Some(3), at));
    }
    builder
}

/// Without hints, and with hints of every kind of assembly: that in which it moves is the only one.
#[test]
fn three_parallel_cranks_are_put_together_whatever_is_said_of_them() {
    let turned = |link: usize, angle: f64| (link, AssemblyChoice::Angle(angle));
    let near = |link: usize, place: [f64; 2]| {
        let point = [0.0; 2];
        (link, AssemblyChoice::Near { point, place })
    };
    let hints = [
        vec![],
        vec![turned(1, 0.7 + PI)],
        vec![turned(0, 0.7 + PI)],
        vec![turned(2, -0.7), turned(1, 0.7)],
        vec![turned(3, 2.0)],
        vec![near(3, [3.0, -2.0])],
        vec![near(1, [-1.0, -1.0]), turned(2, 4.0)],
        vec![
            turned(0, 3.0),
            turned(1, 3.0),
            turned(2, 3.0),
            turned(3, 3.0),
        ],
    ];
    for said in hints {
        let builder = said.iter().fold(three_cranks(), |builder, (link, choice)| {
            builder.choose(*link, *choice)
        });
        let linkage =
            Linkage::new(builder.0).unwrap_or_else(|faults| panic!("{said:?}: {faults:?}"));
        let mut workspace = linkage.workspace();
        for k in 0..12 {
            let q = 0.3 + f64::from(k) * PI / 6.0;
            linkage.solve(q, 0, &mut workspace).unwrap();
            for (link, angle) in [(0, q), (1, q), (2, q), (3, 0.0)] {
                let pose = workspace.pose(link);
                let off = (pose.cos - angle.cos()).hypot(pose.sin - angle.sin());
                assert!(off < 1e-12, "{said:?} {link} at {q}: {off}");
            }
        }
    }
}

/// A branch is no hint: where the linkage cannot move in it, that is said of it.
#[test]
fn a_branch_in_which_it_cannot_move_is_refused_by_name() {
    for sign in [1.0, -1.0] {
        let told = [1, 2].map(|link| {
            let builder = three_cranks().choose(link, AssemblyChoice::Branch(sign));
            Linkage::new(builder.0)
        });
        for found in told.into_iter().filter_map(Result::err) {
            assert!(
                found
                    .iter()
                    .all(|fault| fault.path.starts_with("assembly.")),
                "{found:?}"
            );
        }
    }
    let builder = three_cranks().choose(3, AssemblyChoice::Branch(1.0));
    let other = three_cranks().choose(3, AssemblyChoice::Branch(-1.0));
    let built = [builder, other].map(|builder| Linkage::new(builder.0).is_ok());
    assert_eq!(built.iter().filter(|built| **built).count(), 1);
}

/// The place of the ram follows from its guides alone: a hint chooses nothing.
#[test]
fn a_hint_for_the_only_assembly_is_a_warning_with_its_distance() {
    let linkage = |y: f64| {
        let near = AssemblyChoice::Near {
            point: [0.0; 2],
            place: [0.0, y],
        };
        Linkage::new(wedges().choose(1, near).0).unwrap()
    };
    for y in [0.2, 0.5, -20.0] {
        let warning = linkage(y).remarks().join("\n");
        let wanted = format!("position of `ram` is {} m away", y.abs());
        assert!(warning.contains(&wanted), "{warning}");
    }
    let (plain, hinted) = (Linkage::new(wedges().0).unwrap(), linkage(0.5));
    assert_eq!(plain.spec().redundant, hinted.spec().redundant);
    assert_eq!(
        plain.structure().to_string(),
        hinted.structure().to_string()
    );
}

#[test]
fn a_rod_of_another_length_is_refused_as_before() {
    let mut spec = locomotive().0;
    spec.pairs[4].on.at[0] += 1e-6;
    let faults = Linkage::new(spec).unwrap_err();
    assert!(
        faults
            .iter()
            .any(|fault| fault.message.contains("statically indeterminate"))
    );
    assert!(
        faults
            .iter()
            .all(|fault| !fault.message.contains("redundant"))
    );
}

/// The forces at an input, with a redundant constraint of one's own choice or without.
fn forces(
    builder: Builder,
    redundant: &[Redundant],
    coordinate: f64,
) -> (Kinetostatics, ForceWorkspace, Indeterminate) {
    let mut spec: LinkageSpec = builder.0;
    spec.redundant = redundant.to_vec();
    let linkage = Linkage::new(spec).unwrap();
    let mut at = linkage.workspace();
    linkage.solve(coordinate, 3, &mut at).unwrap();
    let solver = Kinetostatics::new(linkage.spec()).unwrap();
    let mut w = solver.workspace();
    let motion = InputMotion {
        coordinate,
        speed: 3.0,
        acceleration: -2.0,
    };
    solver
        .solve(&at, motion, &Options::default(), &mut w)
        .unwrap();
    let reduced = linkage.reduced_linkage(&at);
    let wanted = reduced.inertia[0] * -2.0 + 0.5 * reduced.inertia[1] * 9.0 + reduced.potential[1]
        - reduced.force[0];
    assert!(
        close(w.driver_force(), wanted, 1e-10, 1e-9),
        "{} {wanted}",
        w.driver_force()
    );
    assert!(solver.balance(&w).residual < 1e-11);
    assert!(solver.influence_error(&mut w) < 1e-11);
    let open = solver.indeterminate(&w);
    (solver, w, open)
}

/// The pairs in the other order, so that other forces are taken as zero.
fn reversed(mut builder: Builder) -> Builder {
    builder.0.pairs.reverse();
    builder.0.driver = builder.0.pairs.len() - 1 - builder.0.driver;
    builder
}

#[test]
fn determinate_figures_do_not_depend_on_what_is_left_out() {
    let along = |pair, link| Redundant {
        pair,
        part: RedundantPart::Along(link),
    };
    for q in [0.4, 1.3, 2.9, 4.4] {
        let (solver, w, open) = forces(locomotive(), &[], q);
        assert_eq!(open.pairs[..6], [true; 6]);
        assert_eq!(open.pairs[6..], [false; 3]);
        assert!(!open.drive);
        // The middle wheel's length in place of the last one's.
        let (other, v, mut same) = forces(reversed(locomotive()), &[along(5, 1)], q);
        same.pairs.reverse();
        assert_eq!(open, same);
        assert!(close(w.driver_force(), v.driver_force(), 1e-12, 1e-9));
        for pair in 6..9 {
            let (one, other) = (solver.force(pair, &w), other.force(8 - pair, &v));
            for axis in 0..2 {
                assert!(close(one[axis], other[axis], 1e-11, 1e-7), "pair {pair}");
            }
        }
        let shared = [solver.force(5, &w), other.force(3, &v)];
        assert!((shared[0][0] - shared[1][0]).abs() > 1.0);
        for axis in 0..3 {
            let [one, two] = [solver.on_frame(&w)[axis], other.on_frame(&v)[axis]];
            assert!(close(one, two, 1e-11, 1e-6), "{one} {two}");
        }
    }
}

#[test]
fn three_cranks_that_are_not_in_line_have_no_dead_position() {
    let mut builder = locomotive();
    builder.0.pairs[4].on.at[1] = -0.8;
    builder.0.pairs[5].link.at[1] = -0.8;
    // With two cranks alone the coupling rod is in line with them here.
    for q in [0.0, PI, 7.0] {
        let (_, _, open) = forces(builder.clone(), &[], q);
        assert!(!open.drive);
    }
}

#[test]
fn the_crosshead_presses_as_the_piston_asks() {
    // Without masses the guide carries F·tan β, the connecting rod F/cos β, the driving couple
    // balances F·r·sin(φ + β)/cos β.
    let mut builder = locomotive();
    for link in &mut builder.0.links {
        (link.mass, link.moment) = (0.0, 0.0);
    }
    let phi = 1.1f64;
    let (solver, w, _) = forces(builder, &[], phi);
    // Seen from the crosshead, behind the wheel.
    let beta = (RADIUS * phi.sin() / ROD).asin();
    let Reaction::Guide([a, b]) = solver.reaction(8, &w) else {
        panic!("a guide")
    };
    assert!(close(
        (a + b).abs(),
        (PISTON * beta.tan()).abs(),
        1e-12,
        0.0
    ));
    let rod = solver.force(7, &w);
    assert!(close(
        rod[0].hypot(rod[1]),
        PISTON.abs() / beta.cos(),
        1e-12,
        0.0
    ));
    let lever = RADIUS * (phi.sin() - phi.cos() * beta.tan());
    assert!(
        close(w.driver_force().abs(), (PISTON * lever).abs(), 1e-12, 0.0),
        "{} {}",
        w.driver_force(),
        PISTON * lever
    );
}

#[test]
fn parallel_guides_share_as_they_like() {
    let (_, _, open) = forces(two_guides(), &[], 0.8);
    assert_eq!(open.pairs, [false, false, false, true, true]);
    let (_, _, open) = forces(wedges(), &[], 0.01);
    assert_eq!(open.pairs, [true; 3]);
    assert!(!open.drive);
}

#[test]
fn friction_of_what_is_left_open_leaves_the_driving_force_open() {
    let mut builder = two_guides();
    builder.0.pairs[2].friction = 0.1;
    let (_, _, open) = forces_with_friction(builder.clone());
    assert!(!open.drive);
    builder.0.pairs[4].friction = 0.001;
    let (_, _, open) = forces_with_friction(builder);
    assert!(open.drive && open.pairs[1]);
}

fn forces_with_friction(builder: Builder) -> (Kinetostatics, ForceWorkspace, Indeterminate) {
    let linkage = Linkage::new(builder.0).unwrap();
    let mut at = linkage.workspace();
    linkage.solve(0.8, 3, &mut at).unwrap();
    let solver = Kinetostatics::new(linkage.spec()).unwrap();
    let mut w = solver.workspace();
    let motion = InputMotion {
        coordinate: 0.8,
        speed: 3.0,
        acceleration: -2.0,
    };
    solver
        .solve(&at, motion, &Options::default(), &mut w)
        .unwrap();
    let open = solver.indeterminate(&w);
    (solver, w, open)
}
