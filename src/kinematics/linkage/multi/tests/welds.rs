//! Welded links against the same linkage with both as one link.

use super::cut::{Cut, all, cut, in_part};
use super::examples::{GROUND, at, five_bar, floating, input};
use super::{MultiMotion, motion, state};
use crate::kinematics::linkage::kinetostatics::{ForceWorkspace, Kinetostatics, Options};
use crate::kinematics::linkage::multi::MultiLinkage;
use crate::kinematics::linkage::multi::spec::{InputCoordinate, MultiSpec};
use crate::kinematics::linkage::spec::{LinkSpec, PointOf, WeldSpec};
use crate::math::jet::Jet;

fn near(one: f64, other: f64, tolerance: f64) {
    approx::assert_relative_eq!(one, other, max_relative = tolerance, epsilon = tolerance);
}

/// Starts of the whole linkage, and of the cut one: coordinates of pairs on the part differ.
fn starts(spec: &MultiSpec) -> Vec<f64> {
    spec.inputs.iter().map(|input| input.start).collect()
}

fn going(spec: &MultiSpec, t: f64) -> MultiMotion {
    let mut going = MultiMotion::new(&MultiLinkage::new(spec.clone()).unwrap());
    going.set_inputs(&motion::at(&starts(spec), t)).unwrap();
    going
}

fn values(jet: Jet) -> [f64; 3] {
    [jet.value, jet.first, jet.second]
}

#[test]
fn it_moves_as_one_link() {
    for Cut {
        whole, cut, link, ..
    } in all()
    {
        let (one, other) = (going(&whole, 0.04), going(&cut, 0.04));
        let part = whole.linkage.links.len();
        let compare = |a: PointOf, b: PointOf| {
            for (a, b) in one.point(a).into_iter().zip(other.point(b)) {
                for (a, b) in values(a).into_iter().zip(values(b)) {
                    near(a, b, 1e-12);
                }
            }
        };
        for link in 0..part {
            compare(at(Some(link), 0.2, 0.3), at(Some(link), 0.2, 0.3));
        }
        let [x, y] = in_part([0.2, 0.3]);
        compare(at(Some(link), 0.2, 0.3), at(Some(part), x, y));
        let (own, of_part) = (other.angle(link), other.angle(part));
        let turned = (of_part.value - own.value - 0.7).rem_euclid(std::f64::consts::TAU);
        near((turned + 1.0).rem_euclid(std::f64::consts::TAU), 1.0, 1e-12);
        assert_eq!([own.first, own.second], [of_part.first, of_part.second]);
    }
}

#[test]
fn mass_matrix_and_forces_are_those_of_one_body() {
    for Cut { whole, cut, .. } in all() {
        let of = |spec: &MultiSpec| {
            let linkage = MultiLinkage::new(spec.clone()).unwrap();
            let mut space = linkage.workspace::<f64>();
            let (q, rates) = state(spec);
            space.solve(&q, &rates).unwrap();
            space.reduce(true);
            let (reduced, power) = (&space.reduced, space.power());
            let mut all = reduced.mass.clone();
            all.extend(&reduced.force);
            all.extend(space.energies());
            all.extend([power.applied, power.dissipated]);
            all
        };
        let (one, other) = (of(&whole), of(&cut));
        let size = one.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        for (a, b) in one.iter().zip(&other) {
            near(a / size, b / size, 1e-12);
        }
    }
}

fn solved(spec: &MultiSpec) -> (Kinetostatics, ForceWorkspace, MultiMotion) {
    let going = going(spec, 0.04);
    let solver = Kinetostatics::of_inputs(spec).unwrap();
    let mut w = solver.workspace();
    let rates: Vec<f64> = going.inputs().iter().map(|input| input.first).collect();
    solver
        .solve_over_time(&going, &rates, &Options::default(), &mut w)
        .unwrap();
    assert!(solver.balance(&w).residual < 1e-11);
    (solver, w, going)
}

#[test]
fn the_other_pairs_carry_the_same() {
    for Cut { whole, cut, .. } in all() {
        let ((one, v, _), (other, w, _)) = (solved(&whole), solved(&cut));
        near(v.driver_force(), w.driver_force(), 1e-12);
        for pair in 0..whole.linkage.pairs.len() {
            let (a, b) = (one.force(pair, &v), other.force(pair, &w));
            let size = a[0].hypot(a[1]).max(1.0);
            near(a[0] / size, b[0] / size, 1e-12);
            near(a[1] / size, b[1] / size, 1e-12);
        }
        for (a, b) in one.on_frame(&v).into_iter().zip(other.on_frame(&w)) {
            near(a, b, 1e-11);
        }
    }
}

/// Force and moment about the origin that a pair exerts on the second of its links.
fn exerted(solver: &Kinetostatics, w: &ForceWorkspace, pair: usize) -> [f64; 3] {
    let ([fx, fy], [x, y]) = (solver.force(pair, w), w.pair_point(pair));
    [fx, fy, x * fy - y * fx + solver.couple(pair, w)]
}

/// d'Alembert for the part alone: weld, pairs, weight and inertia force.
#[test]
fn the_weld_carries_what_the_part_asks_for() {
    let mut seen = 0;
    for Cut { cut, pairs, .. } in all() {
        // (What forces and drives do to the part is left to the linkages without.)
        let part = cut.linkage.links.len() - 1;
        let driven = |input: &crate::kinematics::linkage::multi::spec::InputSpec| matches!(input.coordinate, InputCoordinate::Pair(pair) if pairs.contains(&pair));
        let mut bare = cut.clone();
        bare.linkage.forces.clear();
        if bare.inputs.iter().any(driven) {
            continue;
        }
        seen += 1;
        let (solver, w, going) = solved(&bare);
        let weld = solver.weld_force(0, &w);
        let sign = match bare.linkage.welds[0].link.link == Some(part) {
            true => 1.0,
            false => -1.0,
        };
        let ([x, y], [fx, fy]) = (weld.point, weld.force);
        let mut sum = [fx, fy, x * fy - y * fx + weld.couple].map(|term| sign * term);
        for &pair in &pairs {
            let own = &bare.linkage.pairs[pair];
            let sign = if own.link.link == Some(part) {
                1.0
            } else {
                -1.0
            };
            for (sum, term) in sum.iter_mut().zip(exerted(&solver, &w, pair)) {
                *sum += sign * term;
            }
        }
        let link = &bare.linkage.links[part];
        let [cx, cy] = going.point(at(Some(part), link.centre[0], link.centre[1]));
        let [gx, gy] = bare.linkage.gravity;
        let (ix, iy) = (link.mass * (gx - cx.second), link.mass * (gy - cy.second));
        let turning = link.moment * going.angle(part).second;
        let acting = [ix, iy, cx.value * iy - cy.value * ix - turning];
        for (sum, acting) in sum.iter().zip(acting) {
            approx::assert_abs_diff_eq!(sum + acting, 0.0, epsilon = 1e-10);
        }
    }
    assert!(seen >= 7, "{seen}");
}

/// A five-bar whose second pin, an input, stands on a bracket, and the same on the ground.
fn brackets() -> [MultiSpec; 2] {
    let whole = five_bar();
    let mut welded = five_bar();
    let linkage = &mut welded.linkage;
    linkage.links.push(LinkSpec {
        name: "bracket".to_owned(),
        mass: 2.0,
        centre: [0.1, 0.2],
        ..LinkSpec::default()
    });
    // The bracket is turned by a right angle: its x is the ground's y.
    linkage.pairs[4].on = at(Some(4), 0.1, -0.3);
    linkage.welds.push(WeldSpec {
        name: "foot".to_owned(),
        on: at(GROUND, 0.5, 0.0),
        link: at(Some(4), 0.0, 0.0),
        angle: std::f64::consts::FRAC_PI_2,
    });
    welded.inputs[1].start -= std::f64::consts::FRAC_PI_2;
    [whole, welded]
}

#[test]
fn a_bracket_on_the_ground_carries_an_input() {
    let [whole, welded] = brackets();
    let ((one, v, x), (other, w, y)) = (solved(&whole), solved(&welded));
    for link in 0..4 {
        let place = at(Some(link), 0.1, 0.2);
        for (a, b) in x.point(place).into_iter().zip(y.point(place)) {
            near(a.value, b.value, 1e-12);
            near(a.second, b.second, 1e-11);
        }
    }
    for pair in 0..5 {
        for (a, b) in one.force(pair, &v).into_iter().zip(other.force(pair, &w)) {
            near(a, b, 1e-11);
        }
    }
    // The foot carries the bracket's weight and what the pin gives on.
    let (foot, [fx, fy]) = (other.weld_force(0, &w), other.force(4, &w));
    let [gx, gy] = welded.linkage.gravity;
    near(foot.force[0], fx - 2.0 * gx, 1e-11);
    near(foot.force[1], fy - 2.0 * gy, 1e-11);
    // The bracket is at rest; the drive of its pin pushes back on it.
    let [on_frame, on_ground] = [other.on_frame(&w), one.on_frame(&v)];
    near(on_frame[0] - 2.0 * gx, on_ground[0], 1e-10);
    near(on_frame[1] - 2.0 * gy, on_ground[1], 1e-10);
}

#[test]
fn welds_that_cannot_be_are_refused() {
    let refused = |spec: MultiSpec| -> String {
        let faults = MultiLinkage::new(spec).unwrap_err();
        let lines = faults.iter();
        lines
            .map(|fault| format!("{}: {}\n", fault.path, fault.message))
            .collect()
    };
    let mut ring = cut(&five_bar(), 1, &[2], false);
    let again = WeldSpec {
        name: "V".to_owned(),
        ..ring.linkage.welds[0].clone()
    };
    ring.linkage.welds.push(again);
    let told = refused(ring);
    assert!(
        told.contains("pairs.V: it joins links that are one body already"),
        "{told}"
    );
    let mut ground = floating();
    ground.linkage.welds.push(WeldSpec {
        name: "V".to_owned(),
        on: at(GROUND, 0.0, 0.0),
        link: at(Some(0), 0.0, 0.0),
        angle: 0.0,
    });
    let told = refused(ground);
    assert!(
        told.contains("inputs.x: `frame` is welded to the ground"),
        "{told}"
    );
    let mut twice = cut(&floating(), 0, &[3], false);
    for (name, coordinate) in [
        ("u", InputCoordinate::X(4)),
        ("v", InputCoordinate::Y(4)),
        ("w", InputCoordinate::Angle(4)),
    ] {
        twice.inputs.push(input(name, coordinate, 0.0));
    }
    let told = refused(twice);
    assert!(
        told.contains("inputs.u: `part` is welded to `frame`: one body floats once"),
        "{told}"
    );
    let mut few = cut(&five_bar(), 1, &[2], false);
    few.inputs.pop();
    let told = refused(few);
    assert!(
        told.contains("5 moving links, 5 pairs, 1 weld: 3·5 − 2·5 − 3·1 = 2 degrees"),
        "{told}"
    );
}
