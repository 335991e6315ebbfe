//! Struts with a constant force, and struts whose ends meet.

use dam::linkage::Linkage;
use dam::linkage::kinetostatics::{InputMotion, Kinetostatics, Options, Reaction};
use dam::linkage::spec::{ForceLaw, ForceSpec, LinkSpec, LinkageSpec, PairKind, PairSpec, PointOf};

/// A massless lever on a pin, held by a strut from a point of the ground.
fn gas_spring(law: ForceLaw) -> LinkageSpec {
    let at = |link, at| PointOf { link, at };
    LinkageSpec {
        links: vec![LinkSpec {
            name: "lever".to_owned(),
            ..LinkSpec::default()
        }],
        pairs: vec![PairSpec {
            name: "pin".to_owned(),
            on: at(None, [0.0; 2]),
            link: at(Some(0), [0.0; 2]),
            kind: PairKind::Revolute { diameter: 0.0 },
            friction: 0.0,
        }],
        forces: vec![ForceSpec {
            name: "strut".to_owned(),
            law,
        }],
        ..LinkageSpec::default()
    }
}

/// The pin bears what the strut presses, the driver holds its moment; the same
/// as the virtual work of [`Linkage::force_part`] against differences. Where
/// the ends meet neither has a force.
#[test]
fn a_constant_force_of_a_strut_is_borne_by_pin_and_driver() {
    let (pivot, end, force) = ([0.5, 0.0], [0.4, 0.3], -60.0);
    let spec = gas_spring(ForceLaw::Strut {
        from: PointOf {
            link: None,
            at: pivot,
        },
        to: PointOf {
            link: Some(0),
            at: end,
        },
        rate: 0.0,
        free_length: 0.0,
        damping: 0.0,
        force,
    });
    let at = |spec: &LinkageSpec, coordinate: f64, speed: f64| {
        let (linkage, solver) = (
            Linkage::new(spec.clone()).unwrap(),
            Kinetostatics::new(spec).unwrap(),
        );
        let (mut place, mut w) = (linkage.workspace(), solver.workspace());
        linkage.solve(coordinate, 3, &mut place).unwrap();
        let motion = InputMotion {
            coordinate,
            speed,
            acceleration: 0.0,
        };
        let found = solver.solve(&place, motion, &Options::default(), &mut w);
        found.expect("a solution");
        let part = linkage.force_part(0, &place);
        (w.driver_force(), solver.reaction(0, &w), part.potential)
    };
    for q in [0.4, -1.1, 2.5] {
        let (drive, reaction, potential) = at(&spec, q, 3.0);
        let (sin, cos) = f64::sin_cos(q);
        let tip = [
            cos * end[0] - sin * end[1] - pivot[0],
            sin * end[0] + cos * end[1] - pivot[1],
        ];
        let length = tip[0].hypot(tip[1]);
        // A negative force presses the tip away from the other end.
        let Reaction::Pin(found) = reaction else {
            panic!("a pin")
        };
        for k in 0..2 {
            approx::assert_abs_diff_eq!(found[k], force * tip[k] / length, epsilon = 1e-11);
        }
        let h = 1e-5;
        let slope = (at(&spec, q + h, 0.0).2[0] - at(&spec, q - h, 0.0).2[0]) / (2.0 * h);
        approx::assert_abs_diff_eq!(drive, slope, epsilon = 1e-6);
        approx::assert_abs_diff_eq!(potential[1], slope, epsilon = 1e-6);
        approx::assert_abs_diff_eq!(potential[0], force * length, epsilon = 1e-12);
    }
}

/// Struts whose ends meet exactly: without direction, without force.
#[test]
fn a_strut_whose_ends_meet_has_no_force() {
    for (rate, free_length, damping, force) in [
        (900.0, 0.2, 0.0, 0.0),
        (900.0, 0.0, 15.0, 0.0),
        (0.0, 0.0, 0.0, -60.0),
    ] {
        let point = |link| PointOf {
            link,
            at: [0.5, 0.0],
        };
        let spec = gas_spring(ForceLaw::Strut {
            from: point(None),
            to: point(Some(0)),
            rate,
            free_length,
            damping,
            force,
        });
        let (linkage, solver) = (
            Linkage::new(spec.clone()).unwrap(),
            Kinetostatics::new(&spec).unwrap(),
        );
        let (mut place, mut w) = (linkage.workspace(), solver.workspace());
        linkage.solve(0.0, 3, &mut place).unwrap();
        let motion = InputMotion {
            coordinate: 0.0,
            speed: 2.0,
            acceleration: 0.0,
        };
        let found = solver.solve(&place, motion, &Options::default(), &mut w);
        found.expect("a solution");
        assert_eq!(w.driver_force(), 0.0);
        assert_eq!(solver.reaction(0, &w), Reaction::Pin([0.0; 2]));
        let part = linkage.force_part(0, &place);
        assert_eq!((part.potential[1], part.damping[0]), (0.0, 0.0));
    }
}
