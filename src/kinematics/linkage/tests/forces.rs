//! Springs, dampers and forces in closed form.

use super::examples::{Builder, GROUND, slider_crank};
use crate::kinematics::linkage::spec::{ForceLaw, PointOf};
use crate::kinematics::linkage::{ForcePart, Linkage, ReducedLinkage};

fn at(link: Option<usize>, at: [f64; 2]) -> PointOf {
    PointOf { link, at }
}

/// A link of 0.5 m on a pin at the origin, with one force.
fn lever(law: ForceLaw) -> Linkage {
    let lever = Builder::new(&["lever"]).pin((GROUND, [0.0; 2]), (Some(0), [0.0; 2]));
    Linkage::new(lever.force(law).0).unwrap()
}

fn part(linkage: &Linkage, q: f64) -> ForcePart {
    let mut workspace = linkage.workspace();
    linkage.solve(q, 3, &mut workspace).unwrap();
    linkage.force_part(0, &workspace)
}

#[test]
fn a_torsion_spring_counts_from_its_free_angle_over_the_turns() {
    let torsion = lever(ForceLaw::Torsion {
        pair: 0,
        rate: 3.0,
        free_angle: 0.5,
        damping: 0.2,
    });
    for q in [-9.0, 0.5, 1.0, 14.0] {
        let found = part(&torsion, q);
        let x = q - 0.5;
        for (k, wanted) in [1.5 * x * x, 3.0 * x, 3.0].into_iter().enumerate() {
            approx::assert_abs_diff_eq!(found.potential[k], wanted, epsilon = 1e-12);
        }
        approx::assert_abs_diff_eq!(found.damping[0], 0.2, epsilon = 1e-15);
        approx::assert_abs_diff_eq!(found.damping[1], 0.0, epsilon = 1e-15);
        assert_eq!(found.force, [0.0; 2]);
    }
}

#[test]
fn forces_that_stay_and_forces_that_follow_do_the_work_they_should() {
    let (point, force) = (at(Some(0), [0.5, 0.0]), [2.0, 3.0]);
    let stays = lever(ForceLaw::Force {
        point,
        force,
        follows: false,
    });
    let follows = lever(ForceLaw::Force {
        point,
        force,
        follows: true,
    });
    for q in [0.0, 0.7, 4.0] {
        let (sin, cos) = f64::sin_cos(q);
        let found = part(&stays, q).force;
        approx::assert_abs_diff_eq!(found[0], 0.5 * (3.0 * cos - 2.0 * sin), epsilon = 1e-15);
        approx::assert_abs_diff_eq!(found[1], -0.5 * (3.0 * sin + 2.0 * cos), epsilon = 1e-15);
        let found = part(&follows, q).force;
        approx::assert_abs_diff_eq!(found[0], 1.5, epsilon = 1e-15);
        approx::assert_abs_diff_eq!(found[1], 0.0, epsilon = 1e-15);
    }
}

#[test]
fn a_strut_pulls_towards_its_free_length_and_may_have_none() {
    let strut = |free_length| {
        lever(ForceLaw::Strut {
            from: at(GROUND, [0.5, 0.0]),
            to: at(Some(0), [0.5, 0.0]),
            rate: 8.0,
            free_length,
            damping: 2.0,
            force: 0.0,
        })
    };
    // The chord 2·0.5·sin(q/2): V = 4·(sin(q/2) − l₀)², D = 2·cos²(q/2)/4.
    for q in [0.3, 1.9] {
        let found = part(&strut(0.2), q);
        let (sin, cos) = f64::sin_cos(0.5 * q);
        approx::assert_abs_diff_eq!(
            found.potential[0],
            4.0 * (sin - 0.2).powi(2),
            epsilon = 1e-14
        );
        approx::assert_abs_diff_eq!(found.potential[1], 4.0 * (sin - 0.2) * cos, epsilon = 1e-14);
        approx::assert_abs_diff_eq!(found.damping[0], 0.5 * cos * cos, epsilon = 1e-14);
        approx::assert_abs_diff_eq!(found.damping[1], -0.5 * sin * cos, epsilon = 1e-14);
    }
    // Where both ends lie in one place nothing that is not a number comes out.
    let folded = part(&strut(0.2), 0.0);
    assert!(
        folded
            .potential
            .iter()
            .chain(&folded.damping)
            .all(|x| x.is_finite())
    );
}

/// A constant force between the points: V = F·l, beside the spring's.
#[test]
fn a_strut_with_a_constant_force_has_the_potential_of_its_length() {
    let strut = |rate, force| {
        lever(ForceLaw::Strut {
            from: at(GROUND, [0.5, 0.0]),
            to: at(Some(0), [0.5, 0.0]),
            rate,
            free_length: 0.2,
            damping: 0.0,
            force,
        })
    };
    for (rate, force) in [(0.0, 60.0), (0.0, -35.0), (8.0, -35.0)] {
        for q in [0.3, 1.9, 3.0] {
            let found = part(&strut(rate, force), q).potential;
            // The chord l = sin(q/2), l′ = cos(q/2)/2, l″ = −l/4.
            let (l, slope) = (f64::sin(0.5 * q), 0.5 * f64::cos(0.5 * q));
            let stretch = l - 0.2;
            let tension = rate * stretch + force;
            let potential = 0.5 * rate * stretch * stretch + force * l;
            approx::assert_abs_diff_eq!(found[0], potential, epsilon = 1e-13);
            approx::assert_abs_diff_eq!(found[1], tension * slope, epsilon = 1e-13);
            let second = rate * slope * slope - 0.25 * tension * l;
            approx::assert_abs_diff_eq!(found[2], second, epsilon = 1e-13);
        }
    }
    // Where the ends meet the force has no direction and does nothing.
    assert_eq!(part(&strut(0.0, 60.0), 0.0).potential, [0.0; 3]);
}

#[test]
fn a_table_acts_along_its_direction_and_repeats() {
    let slide = at(Some(2), [0.0; 2]);
    let table = |period| {
        let law = ForceLaw::Table {
            point: slide,
            direction: std::f64::consts::PI,
            points: vec![(0.0, 0.0), (1.0, 100.0), (2.0, 40.0)],
            period,
        };
        Linkage::new(slider_crank(0.1, 0.4, 0.0).force(law).0).unwrap()
    };
    for (period, q, force, slope) in [
        (None, 0.25, 25.0, 100.0),
        (None, 1.5, 70.0, -60.0),
        (None, 7.0, 40.0, 0.0),
        (None, -3.0, 0.0, 0.0),
        (Some(4.0), 3.0, 20.0, -20.0),
        (Some(4.0), 8.25, 25.0, 100.0),
        (Some(4.0), -1.0, 20.0, -20.0),
    ] {
        let linkage = table(period);
        let found = part(&linkage, q);
        let mut workspace = linkage.workspace();
        linkage.solve(q, 3, &mut workspace).unwrap();
        let x = workspace.pair(3);
        approx::assert_abs_diff_eq!(found.force[0], -force * x.first, epsilon = 1e-13);
        let wanted = -slope * x.first - force * x.second;
        approx::assert_abs_diff_eq!(found.force[1], wanted, epsilon = 1e-12);
    }
}

#[test]
fn lower_orders_give_what_they_can() {
    let linkage = lever(ForceLaw::Couple {
        link: 0,
        couple: 5.0,
    });
    let mut workspace = linkage.workspace();
    linkage.solve(0.3, 0, &mut workspace).unwrap();
    assert_eq!(
        linkage.reduced_linkage(&workspace),
        ReducedLinkage::default()
    );
    linkage.solve(0.3, 1, &mut workspace).unwrap();
    assert_eq!(linkage.reduced_linkage(&workspace).force, [5.0, 0.0]);
    assert_eq!((workspace.order(), workspace.input()), (1, 0.3));
}
