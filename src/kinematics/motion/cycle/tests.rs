//! Plans of motion.

use super::*;
use crate::kinematics::motion::Spline;
use crate::kinematics::motion::law::LawName;
use std::f64::consts::TAU;

fn station(at: f64, displacement: f64, motion: Motion) -> Station {
    Station {
        at,
        displacement,
        speed: None,
        acceleration: None,
        order: USUAL_ORDER,
        motion,
    }
}

fn law(name: LawName) -> Motion {
    Motion::Law(name.into())
}

fn plan(stations: Vec<Station>, period: Option<f64>) -> CycleSpec {
    CycleSpec {
        stations,
        period,
        ..CycleSpec::default()
    }
}

/// Two rises, two dwells, a return, a smooth way back.
fn cam() -> CycleSpec {
    plan(
        vec![
            station(0.0, 0.0, law(LawName::ModifiedSine)),
            station(1.0, 0.01, Motion::Dwell),
            station(1.5, 0.01, law(LawName::Harmonic)),
            station(2.5, 0.03, Motion::Dwell),
            station(3.0, 0.03, Motion::Smooth),
            station(4.0, 0.02, Motion::Smooth),
            station(5.0, 0.0, Motion::Dwell),
        ],
        Some(TAU),
    )
}

fn at(cycle: &Cycle, phi: f64) -> Jet {
    cycle.jet(cycle.breaks().segment_at(phi, 1.0), phi)
}

#[test]
fn stations_are_reached_and_the_cycle_repeats() {
    let spec = CycleSpec {
        phase: 0.3,
        ..cam()
    };
    let cycle = Cycle::new(&spec).unwrap();
    for turn in [-2.0, 0.0, 3.0] {
        for station in &spec.stations {
            let jet = at(&cycle, station.at - 0.3 + turn * TAU + 1e-9);
            approx::assert_abs_diff_eq!(jet.value, station.displacement, epsilon = 1e-10);
        }
        assert_eq!(at(&cycle, 5.6 - 0.3 + turn * TAU), Jet::default());
    }
}

#[test]
fn only_the_harmonic_rise_has_soft_shocks() {
    let cycle = Cycle::new(&cam()).unwrap();
    let jumps = cycle.jumps();
    let of = |order| {
        let found = jumps.iter().filter(move |jump| jump.order == order);
        found.map(|jump| jump.at).collect::<Vec<f64>>()
    };
    assert!(of(1).is_empty(), "{jumps:?}");
    assert_eq!(of(2), [1.5, 2.5]);
    let size = jumps.iter().find(|jump| jump.order == 2).unwrap().after;
    let expected = 0.02 * std::f64::consts::PI.powi(2) / 2.0;
    approx::assert_relative_eq!(size, expected, max_relative = 1e-12);
    // Between the two smooth motions even jerk is continuous.
    assert!(!of(3).contains(&4.0), "{jumps:?}");
}

#[test]
fn derivatives_agree_with_differences() {
    let cycle = Cycle::new(&cam()).unwrap();
    for i in 0..200 {
        let phi = 0.0301 + 0.0313 * f64::from(i);
        let segment = cycle.breaks().segment_at(phi, 1.0);
        let h = 1e-4;
        let [a, b, c] = [-h, 0.0, h].map(|d| cycle.jet(segment, phi + d));
        let slope = |f: fn(&Jet) -> f64| (f(&c) - f(&a)) / (2.0 * h);
        approx::assert_abs_diff_eq!(slope(|j| j.value), b.first, epsilon = 1e-7);
        approx::assert_abs_diff_eq!(slope(|j| j.first), b.second, epsilon = 1e-6);
        approx::assert_abs_diff_eq!(slope(|j| j.second), b.third, epsilon = 1e-4);
    }
}

#[test]
fn smooth_motions_of_order_one_are_the_cubic_spline() {
    let points = [(0.0, 0.0), (0.7, 0.4), (1.1, 0.9), (2.0, 0.3), (2.4, 0.0)];
    let mut stations: Vec<Station> = points
        .iter()
        .map(|&(x, y)| Station {
            order: 1,
            ..station(x, y, Motion::Smooth)
        })
        .collect();
    let spline = Spline::periodic(&points);
    let cycle = Cycle::new(&plan(stations.clone(), Some(2.4))).unwrap();
    for i in 0..100 {
        let x = -1.0 + 0.05 * f64::from(i);
        let (found, wanted) = (at(&cycle, x), spline.jet(x));
        approx::assert_abs_diff_eq!(found.value, wanted.value, epsilon = 1e-13);
        approx::assert_abs_diff_eq!(found.second, wanted.second, epsilon = 1e-11);
    }
    // One pass: clamped by the rest outside.
    stations[4].motion = Motion::Dwell;
    let cycle = Cycle::new(&plan(stations, None)).unwrap();
    let spline = Spline::clamped(&points, (0.0, 0.0));
    for i in 0..24 {
        let x = 0.01 + 0.1 * f64::from(i);
        approx::assert_abs_diff_eq!(at(&cycle, x).value, spline.jet(x).value, epsilon = 1e-13);
    }
    assert_eq!(at(&cycle, -1.0), Jet::default());
    assert_eq!(at(&cycle, 5.0).first, 0.0);
}

#[test]
fn a_smooth_motion_between_dwells_is_the_polynomial_of_its_order() {
    for (order, name) in [(2, LawName::Polynomial345), (3, LawName::Polynomial4567)] {
        let first = Station {
            order,
            ..station(0.0, 1.0, Motion::Smooth)
        };
        let last = Station {
            order,
            ..station(2.0, 4.0, Motion::Dwell)
        };
        let cycle = Cycle::new(&plan(vec![first, last], None)).unwrap();
        let law = Law::of_stroke(&name.into()).unwrap();
        for i in 0..=20 {
            let jet = cycle.jet(1, 0.1 * f64::from(i));
            let wanted = law.at(0.05 * f64::from(i));
            approx::assert_abs_diff_eq!(jet.value, 1.0 + 3.0 * wanted.value, epsilon = 1e-13);
            approx::assert_abs_diff_eq!(jet.second, 0.75 * wanted.second, epsilon = 1e-12);
        }
    }
}

#[test]
fn uniform_sections_are_taken_over_and_prescribed_derivatives_hold() {
    let mut stations = vec![
        station(0.0, 0.0, Motion::Smooth),
        station(1.0, 1.0, Motion::Uniform),
        station(2.0, 3.0, Motion::Smooth),
        station(3.0, 2.5, Motion::Smooth),
        station(4.0, 0.0, Motion::Dwell),
    ];
    stations[3].speed = Some(-1.5);
    stations[3].acceleration = Some(0.25);
    let cycle = Cycle::new(&plan(stations, Some(5.0))).unwrap();
    for segment in [0, 2] {
        let edge = if segment == 0 { 1.0 } else { 2.0 };
        let jet = cycle.jet(segment, edge);
        approx::assert_abs_diff_eq!(jet.first, 2.0, epsilon = 1e-13);
        approx::assert_abs_diff_eq!(jet.second, 0.0, epsilon = 1e-12);
    }
    for segment in [2, 3] {
        let jet = cycle.jet(segment, 3.0);
        approx::assert_abs_diff_eq!(jet.first, -1.5, epsilon = 1e-13);
        approx::assert_abs_diff_eq!(jet.second, 0.25, epsilon = 1e-12);
    }
    assert!(cycle.jumps().iter().all(|jump| jump.order == 3));
    // Uniform motion straight from a dwell: hard shocks, listed.
    let hard = vec![
        station(0.0, 0.0, Motion::Uniform),
        station(1.0, 1.0, Motion::Dwell),
    ];
    let cycle = Cycle::new(&plan(hard, None)).unwrap();
    let hard: Vec<f64> = cycle.jumps().iter().map(|jump| jump.at).collect();
    assert_eq!(hard, [0.0, 1.0]);
    assert!(cycle.jumps().iter().all(|jump| jump.order == 1));
}

#[test]
fn an_indexing_motion_advances_every_period() {
    let stations = vec![
        station(0.0, 0.0, law(LawName::Cycloidal)),
        station(0.4, 1.5, Motion::Dwell),
    ];
    let spec = CycleSpec {
        advance: 1.5,
        ..plan(stations, Some(1.0))
    };
    let cycle = Cycle::new(&spec).unwrap();
    for (time, value) in [(0.2, 0.75), (0.7, 1.5), (5.2, 8.25), (-0.5, 0.0)] {
        approx::assert_abs_diff_eq!(at(&cycle, time).value, value, epsilon = 1e-12);
    }
    assert!(cycle.jumps().iter().all(|jump| jump.order == 3));
}

#[test]
fn faults_name_their_place() {
    let refused = |spec: CycleSpec| Cycle::new(&spec).unwrap_err()[0].clone();
    let mut spec = cam();
    spec.stations[2].displacement = 0.02;
    assert_eq!(refused(spec).path, "stations[1].motion");
    let mut spec = cam();
    spec.stations.push(station(TAU, 0.001, Motion::Dwell));
    spec.stations[6].motion = Motion::Smooth;
    let fault = refused(spec);
    assert!(fault.message.contains("not periodic"), "{fault:?}");
    let mut spec = cam();
    spec.stations.push(station(TAU, 0.0, Motion::Dwell));
    assert_eq!(
        Cycle::new(&spec).unwrap().jumps(),
        Cycle::new(&cam()).unwrap().jumps()
    );
    let mut spec = cam();
    spec.stations[3].at = 1.2;
    assert_eq!(refused(spec).path, "stations[3].at");
    let mut spec = cam();
    spec.stations[6].at = 7.0;
    assert_eq!(refused(spec).path, "stations[6].at");
    let mut spec = cam();
    spec.stations[1].speed = Some(1.0);
    assert_eq!(refused(spec).path, "stations[1].speed");
    let mut spec = cam();
    spec.stations[4].displacement = f64::NAN;
    assert_eq!(refused(spec).path, "stations[4].displacement");
    assert_eq!(refused(plan(vec![], None)).path, "stations");
    let advancing = CycleSpec {
        advance: 1.0,
        period: None,
        ..cam()
    };
    assert_eq!(refused(advancing).path, "advance");
}
