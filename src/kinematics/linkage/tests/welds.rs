//! Welded links against the same linkage with both as one link.

use super::examples::{Builder, GROUND};
use super::support::{close, compare_with_differences};
use crate::kinematics::linkage::kinetostatics::{
    ForceWorkspace, InputMotion, Kinetostatics, Options,
};
use crate::kinematics::linkage::spec::{AssemblyChoice, LinkageSpec, PairKind, PointOf, WeldSpec};
use crate::kinematics::linkage::{Linkage, Workspace};

/// Angle of the arm's frame less that of the rod's, and the weld's point in both.
const TURNED: f64 = 0.7;
const ON_ROD: [f64; 2] = [0.25, 0.05];
const ON_ARM: [f64; 2] = [0.1, -0.02];
/// Mass, centre and moment of the arm.
const ARM: (f64, [f64; 2], f64) = (0.8, [-0.03, 0.04], 0.002);
const ROD: (f64, [f64; 2], f64) = (1.5, [0.15, 0.01], 0.01);

fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

/// A point of the arm in the rod's frame.
fn in_rod(at: [f64; 2]) -> [f64; 2] {
    let [x, y] = turned([at[0] - ON_ARM[0], at[1] - ON_ARM[1]], TURNED);
    [ON_ROD[0] + x, ON_ROD[1] + y]
}

fn weld(
    name: &str,
    on: (Option<usize>, [f64; 2]),
    link: (Option<usize>, [f64; 2]),
    angle: f64,
) -> WeldSpec {
    let point = |(link, at)| PointOf { link, at };
    WeldSpec {
        name: name.to_owned(),
        on: point(on),
        link: point(link),
        angle,
    }
}

/// A crank, a rod, and an arm welded to it, which carries a guide: links 0 to 2; a block on the guide,
/// pinned to the ground.
fn welded() -> Builder {
    let mut builder = Builder::new(&["crank", "rod", "arm", "block"])
        .pin((GROUND, [0.0; 2]), (Some(0), [0.0; 2]))
        .pin((Some(0), [0.1, 0.0]), (Some(1), [0.0; 2]))
        .slide((Some(2), [0.02, 0.01]), (Some(3), [0.0; 2]), 0.3, 0.2)
        .pin((GROUND, [0.5, 0.1]), (Some(3), [0.01, 0.0]))
        .mass(0, 2.0, [0.05, 0.0], 0.01)
        .mass(1, ROD.0, ROD.1, ROD.2)
        .mass(2, ARM.0, ARM.1, ARM.2)
        .mass(3, 0.3, [0.0; 2], 0.001)
        .choose(2, AssemblyChoice::Angle(0.9))
        .start(0.5);
    builder.0.gravity = [0.0, -9.81];
    builder
        .0
        .welds
        .push(weld("W", (Some(1), ON_ROD), (Some(2), ON_ARM), TURNED));
    builder
}

/// The same with rod and arm as one link.
fn merged() -> LinkageSpec {
    let mut spec = welded().0;
    spec.welds.clear();
    spec.assembly[0].link = 1;
    spec.assembly[0].choice = AssemblyChoice::Angle(0.9 - TURNED);
    for pair in &mut spec.pairs {
        for end in [&mut pair.on, &mut pair.link] {
            match end.link {
                Some(2) => (end.link, end.at) = (Some(1), in_rod(end.at)),
                Some(3) => end.link = Some(2),
                _ => {}
            }
        }
        if let PairKind::Sliding { direction, .. } = &mut pair.kind {
            *direction += TURNED;
        }
    }
    spec.links.remove(2);
    let (centre, mass) = (in_rod(ARM.1), ARM.0 + ROD.0);
    let both = [0, 1].map(|k| (ARM.0 * centre[k] + ROD.0 * ROD.1[k]) / mass);
    let apart = (centre[0] - ROD.1[0]).powi(2) + (centre[1] - ROD.1[1]).powi(2);
    let rod = &mut spec.links[1];
    (rod.mass, rod.centre) = (mass, both);
    rod.moment = ARM.2 + ROD.2 + ARM.0 * ROD.0 / mass * apart;
    spec
}

fn solved(
    spec: LinkageSpec,
    coordinate: f64,
) -> (Kinetostatics, ForceWorkspace, Workspace, Linkage) {
    let linkage = Linkage::new(spec).unwrap();
    let mut at = linkage.workspace();
    linkage.solve(coordinate, 3, &mut at).unwrap();
    let solver = Kinetostatics::new(linkage.spec()).unwrap();
    let mut w = solver.workspace();
    let motion = InputMotion {
        coordinate,
        speed: 7.0,
        acceleration: -20.0,
    };
    solver
        .solve(&at, motion, &Options::default(), &mut w)
        .unwrap();
    assert!(solver.balance(&w).residual < 1e-11);
    assert!(solver.influence_error(&mut w) < 1e-11);
    (solver, w, at, linkage)
}

fn accelerated(at: &Workspace, link: usize, point: [f64; 2]) -> [f64; 2] {
    let place = at.point(PointOf {
        link: Some(link),
        at: point,
    });
    place.map(|jet| jet.second * 49.0 - 20.0 * jet.first)
}

#[test]
fn it_moves_as_one_link() {
    for q in [0.5, 1.7, 3.9, 5.5] {
        let (one, v, x, _) = solved(welded().0, q);
        let (other, w, y, whole) = solved(merged(), q);
        assert!(close(v.driver_force(), w.driver_force(), 1e-11, 1e-11));
        for pair in 0..4 {
            let (a, b) = (one.force(pair, &v), other.force(pair, &w));
            assert!(close(a[0], b[0], 1e-10, 1e-9) && close(a[1], b[1], 1e-10, 1e-9));
        }
        let arm = PointOf {
            link: Some(2),
            at: [0.3, -0.2],
        };
        let rod = PointOf {
            link: Some(1),
            at: in_rod(arm.at),
        };
        for (a, b) in x.point(arm).into_iter().zip(y.point(rod)) {
            assert!(close(a.value, b.value, 1e-13, 1e-13));
            assert!(close(a.third, b.third, 1e-10, 1e-10));
        }
        assert!(close(x.angle(2), x.angle(1) + TURNED, 0.0, 1e-13));
        assert_eq!(whole.structure().groups.len(), 2);
    }
}

#[test]
fn the_weld_carries_what_the_arm_asks_for() {
    let q = 1.7;
    let (solver, w, at, linkage) = solved(welded().0, q);
    // The arm alone: weld, guide's reaction, weight.
    let found = solver.weld_force(0, &w);
    let guide = solver.force(2, &w).map(|part| -part);
    let wanted = accelerated(&at, 2, ARM.1);
    let weight = [0.0, -9.81 * ARM.0];
    for k in 0..2 {
        let sum = found.force[k] + guide[k] + weight[k];
        assert!(close(sum, ARM.0 * wanted[k], 1e-11, 1e-10), "{sum}");
    }
    // Moments about its centre.
    let centre = at.pose(2).to_ground(ARM.1);
    let moment =
        |point: [f64; 2], [x, y]: [f64; 2]| (point[0] - centre[0]) * y - (point[1] - centre[1]) * x;
    let couple = found.couple - solver.couple(2, &w)
        + moment(found.point, found.force)
        + moment(w.pair_point(2), guide);
    let turning = at.turning(2);
    let wanted = ARM.2 * (turning.second * 49.0 - 20.0 * turning.first);
    assert!(close(couple, wanted, 1e-10, 1e-11), "{couple} {wanted}");
    let told = linkage.structure().to_string();
    assert!(
        told.contains("4 pairs, 1 weld: 3·4 − 2·4 − 3·1 = 1 degree"),
        "{told}"
    );
    assert!(told.contains("welded: `arm` to `rod` by `W`"), "{told}");
}

#[test]
fn derivatives_are_right() {
    let linkage = Linkage::new(welded().0).unwrap();
    for q in [0.6, 2.0, 4.0] {
        compare_with_differences(&linkage, q).unwrap();
    }
}

#[test]
fn a_bracket_is_welded_to_the_ground() {
    // The rocker of a four-bar on a bracket that stands on the ground.
    let four_bar = |bracket: bool| {
        let mut builder = Builder::new(&["crank", "coupler", "rocker", "bracket"])
            .pin((GROUND, [0.0; 2]), (Some(0), [0.0; 2]))
            .pin((Some(0), [0.1, 0.0]), (Some(1), [0.0; 2]))
            .pin((Some(1), [0.4, 0.0]), (Some(2), [0.3, 0.0]))
            .mass(2, 3.0, [0.1, 0.0], 0.1);
        builder = match bracket {
            true => builder.pin((Some(3), [0.0, 0.2]), (Some(2), [0.0; 2])),
            false => builder.pin((GROUND, [0.45, 0.2]), (Some(2), [0.0; 2])),
        };
        let foot = weld("F", (Some(3), [0.0; 2]), (GROUND, [0.45, 0.0]), 0.0);
        match bracket {
            true => builder.0.welds.push(foot),
            false => drop(builder.0.links.pop()),
        }
        solved(builder.0, 0.9)
    };
    let ((one, v, ..), (other, w, ..)) = (four_bar(true), four_bar(false));
    assert!(close(v.driver_force(), w.driver_force(), 1e-12, 1e-12));
    let (foot, pin) = (one.weld_force(0, &v), other.force(3, &w));
    // On the ground from the bracket, as the pin from the rocker.
    for (foot, pin) in foot.force.into_iter().zip(pin) {
        assert!(close(foot, -pin, 1e-11, 1e-11));
    }
    // The force acts 0.2 m above the foot.
    assert!(close(foot.couple, 0.2 * pin[0], 1e-11, 1e-11));
    for axis in 0..3 {
        let (a, b) = (one.on_frame(&v)[axis], other.on_frame(&w)[axis]);
        assert!(close(a, b, 1e-11, 1e-11), "{a} {b}");
    }
}

#[test]
fn welds_that_cannot_be_are_refused() {
    let refused = |weld: WeldSpec| {
        let mut spec = welded().0;
        spec.welds.push(weld);
        let faults = Linkage::new(spec).unwrap_err();
        faults
            .iter()
            .map(|fault| format!("{}: {}\n", fault.path, fault.message))
            .collect::<String>()
    };
    let ring = refused(weld("V", (Some(2), [0.0; 2]), (Some(1), [0.0; 2]), 0.0));
    assert!(
        ring.contains("pairs.V: it joins links that are one body already"),
        "{ring}"
    );
    let stuck = refused(weld("V", (Some(1), [0.0; 2]), (Some(0), [0.0; 2]), 0.0));
    assert!(
        stuck.contains("pairs.p1: its links are welded together"),
        "{stuck}"
    );
    let held = refused(weld("V", (GROUND, [0.0; 2]), (Some(0), [0.0; 2]), 0.0));
    assert!(
        held.contains("pairs.p0: its links are welded together"),
        "{held}"
    );
    let twice = refused(weld("p0", (GROUND, [0.0; 2]), (Some(2), [0.0; 2]), 0.0));
    assert!(twice.contains("`p0` stands twice"), "{twice}");
}
