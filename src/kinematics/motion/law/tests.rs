//! Laws against published figures, differences and quadrature.

mod published;

use super::*;
use std::f64::consts::PI;

#[track_caller]
fn same(found: f64, wanted: f64, what: &str) {
    let error = (found - wanted).abs();
    assert!(error <= 1e-12 * wanted.abs(), "{what}: {found} {wanted}");
}

fn stroke(spec: impl Into<LawSpec>) -> Law {
    Law::of_stroke(&spec.into()).unwrap()
}

fn run_up(s1: f64, s2: f64) -> Law {
    Law::of_run_up(&RunLawSpec::Trapezoid { s1, s2 }).unwrap()
}

fn polynomial(start: &[f64], end: &[f64], through: &[(f64, f64)]) -> PolynomialSpec {
    PolynomialSpec {
        start: start.to_vec(),
        end: end.to_vec(),
        through: through.to_vec(),
    }
}

/// Strokes of every kind.
fn strokes() -> Vec<(String, Law)> {
    let skewed = SectionsSpec {
        run_up: RunLawName::UnequalTrapezoid.into(),
        run_out: RunLawName::Cosine.into(),
        skewness: 1.4,
        uniform: 0.2,
    };
    let table = vec![(0.0, 0.0), (0.2, 0.05), (0.5, 0.5), (0.7, 0.9), (1.0, 1.0)];
    let mut all: Vec<LawSpec> = LawName::ALL.into_iter().map(LawSpec::Named).collect();
    all.extend([
        LawSpec::Scca { b: 0.2, d: 0.5 },
        LawSpec::Scca { b: 0.5, d: 0.5 },
        LawSpec::Scca { b: 1.0, d: 0.0 },
        LawSpec::Sections(skewed),
        LawSpec::Polynomial(polynomial(&[0.0; 4], &[1.0, 0.0, 0.0], &[])),
        LawSpec::Polynomial(polynomial(
            &[0.0, 0.0, 0.0],
            &[1.0, 0.0, 0.0],
            &[(0.5, 0.6)],
        )),
        LawSpec::Table(table),
    ]);
    all.iter()
        .map(|spec| (spec.words(), Law::of_stroke(spec).unwrap()))
        .collect()
}

#[test]
fn closed_forms_are_the_laws_themselves() {
    for (words, law) in strokes() {
        for (piece, from, to) in law.pieces() {
            // Also on a part of the piece, and backwards.
            for (a, b) in [
                (from, to),
                (0.7 * from + 0.3 * to, 0.2 * from + 0.8 * to),
                (to, from),
            ] {
                let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
                let terms = law.terms(piece, [middle, half]);
                for y in [-1.0, -0.4, 0.1, 1.0] {
                    let expected = law.jet(piece, middle + half * y).value;
                    approx::assert_abs_diff_eq!(terms.at(y), expected, epsilon = 1e-13);
                }
            }
        }
        assert!(!words.is_empty());
    }
}

/// ∫ f dτ over the law, piece by piece (Simpson with 2000 intervals each).
fn quadrature(law: &Law, f: impl Fn(f64, &Jet) -> f64, to: f64) -> f64 {
    let mut sum = 0.0;
    for (piece, a, b) in law.pieces() {
        let b = b.min(to);
        if b <= a {
            continue;
        }
        let h = (b - a) / 2000.0;
        for i in 0..=2000 {
            let weight = match i {
                0 | 2000 => 1.0,
                i if i % 2 == 1 => 4.0,
                _ => 2.0,
            };
            let tau = a + h * f64::from(i);
            sum += weight * h / 3.0 * f(tau, &law.jet(piece, tau));
        }
    }
    sum
}

#[test]
fn scca_contains_the_classical_laws() {
    for (b, d, name) in [
        (0.0, 0.0, LawName::Parabolic),
        (0.0, 1.0, LawName::Harmonic),
        (0.5, 0.5, LawName::Cycloidal),
        (0.25, 0.25, LawName::ModifiedTrapezoid),
        (0.25, 0.75, LawName::ModifiedSine),
    ] {
        let (family, named) = (stroke(LawSpec::Scca { b, d }), stroke(name));
        for i in 0..=50 {
            let tau = 0.001 + 0.998 * f64::from(i) / 50.0;
            let (a, b) = (family.at(tau), named.at(tau));
            approx::assert_abs_diff_eq!(a.value, b.value, epsilon = 1e-14);
            approx::assert_abs_diff_eq!(a.first, b.first, epsilon = 1e-13);
            if tau != 0.5 {
                approx::assert_abs_diff_eq!(a.second, b.second, epsilon = 1e-12);
            }
        }
    }
}

#[test]
fn strokes_start_and_end_at_rest_and_their_pieces_join() {
    for (name, law) in strokes() {
        let last = law.joints().len();
        let (start, end) = (law.jet(0, 0.0), law.jet(last, 1.0));
        assert!(
            start.value.abs() < 1e-15 && (end.value - 1.0).abs() < 1e-15,
            "{name}"
        );
        assert!(
            start.first.abs() < 1e-15 && end.first.abs() < 1e-15,
            "{name}"
        );
        assert!(law.joints().is_sorted(), "{name}");
        for (piece, &joint) in law.joints().iter().enumerate() {
            let (left, right) = (law.jet(piece, joint), law.jet(piece + 1, joint));
            assert!((left.value - right.value).abs() < 1e-14, "{name} {joint}");
            assert!((left.first - right.first).abs() < 1e-13, "{name} {joint}");
        }
    }
}

#[test]
fn named_laws_are_antisymmetric() {
    for name in LawName::ALL {
        let law = stroke(name);
        for i in 0..=2000 {
            let tau = f64::from(i) / 2000.0;
            let (one, other) = (law.at(tau), law.at(1.0 - tau));
            assert!((one.value + other.value - 1.0).abs() < 1e-14, "{name:?}");
            assert!((one.first - other.first).abs() < 1e-13, "{name:?}");
        }
    }
}

#[test]
fn derivatives_agree_with_differences() {
    let mut laws = strokes();
    for name in RunLawName::ALL {
        laws.push((
            name.name().to_owned(),
            Law::of_run_up(&name.into()).unwrap(),
        ));
    }
    for (name, law) in laws {
        for (piece, from, to) in law.pieces() {
            for i in 0..=10 {
                // Also a little beyond the ends of the piece.
                let tau = from + (to - from) * (f64::from(i) * 0.11 - 0.05);
                let h = 1e-4 * (to - from);
                let [left, middle, right] = [-h, 0.0, h].map(|d| law.jet(piece, tau + d));
                let slope = |f: fn(&Jet) -> f64| (f(&right) - f(&left)) / (2.0 * h);
                let close = |found: f64, wanted: f64, size: f64| {
                    let error = (found - wanted).abs();
                    assert!(error < 1e-6 * size, "{name} {tau}: {found} {wanted}");
                };
                close(slope(|j| j.value), middle.first, 10.0);
                close(slope(|j| j.first), middle.second, 100.0);
                close(slope(|j| j.second), middle.third, 1000.0);
            }
        }
    }
}

#[test]
fn constants_agree_with_quadrature() {
    let mut laws = strokes();
    for (s1, s2) in [(0.125, 0.5), (0.0, 1.0), (0.6, 0.4)] {
        laws.push((format!("{s1} {s2}"), run_up(s1, s2)));
    }
    for (name, law) in laws {
        let found = law.constants();
        let top = found.speed.at;
        let area = quadrature(&law, |_, j| j.second, top);
        approx::assert_relative_eq!(area, found.speed.value, max_relative = 1e-9);
        approx::assert_relative_eq!(
            area / (top * found.acceleration.value),
            found.filling,
            max_relative = 1e-9
        );
        let moment = quadrature(&law, |tau, j| tau * j.second, top);
        let shown = format!("{name}: {} {}", moment / area, found.centre);
        assert!((moment / area - found.centre).abs() < 1e-9, "{shown}");
        if let Some(centre) = found.centre_after {
            let total = quadrature(&law, |tau, j| tau * j.second, 1.0);
            let after = (moment - total) / area;
            assert!((after - centre).abs() < 1e-9, "{name}: {after} {centre}");
        }
        let stroke = quadrature(&law, |_, j| j.first, 1.0);
        approx::assert_relative_eq!(stroke, 1.0, max_relative = 1e-9);
    }
}

#[test]
fn extremes_are_above_every_sample() {
    for (name, law) in strokes() {
        let found = law.constants();
        for (piece, from, to) in law.pieces() {
            for i in 0..=5000 {
                let jet = law.jet(piece, from + (to - from) * f64::from(i) / 5000.0);
                let over = |value: f64, bound: f64| value <= bound + 1e-12 * bound.abs();
                assert!(over(jet.first, found.speed.value), "{name}");
                assert!(over(jet.second, found.acceleration.value), "{name}");
                assert!(over(-jet.second, -found.deceleration.value), "{name}");
                assert!(over(jet.third.abs(), found.jerk.value), "{name}");
                assert!(
                    over((jet.first * jet.second).abs(), found.torque_factor),
                    "{name}"
                );
            }
        }
    }
}

#[test]
fn shocks_and_continuity_classes() {
    let class = |spec: LawSpec| stroke(spec).constants().continuity;
    assert_eq!(class(LawName::Parabolic.into()), 1);
    assert_eq!(class(LawName::Harmonic.into()), 1);
    assert_eq!(class(LawName::Cycloidal.into()), 2);
    assert_eq!(class(LawName::ModifiedSine.into()), 2);
    assert_eq!(class(LawName::Polynomial345.into()), 2);
    assert_eq!(class(LawName::Polynomial4567.into()), 3);
    let jumps = stroke(LawName::Harmonic).constants().jumps;
    let soft: Vec<f64> = jumps
        .iter()
        .filter(|j| j.order == 2)
        .map(|j| j.at)
        .collect();
    assert_eq!(soft, [0.0, 1.0]);
    same(jumps[0].after, 0.5 * PI * PI, "jump");
    // A run-up without fall passes into uniform motion with a soft shock.
    let jumps = run_up(0.5, 0.0).constants().jumps;
    let soft: Vec<f64> = jumps
        .iter()
        .filter(|j| j.order == 2)
        .map(|j| j.at)
        .collect();
    assert_eq!(soft, [1.0]);
}

#[test]
fn faulty_laws_are_refused_with_their_place() {
    let refused = |spec: LawSpec| Law::of_stroke(&spec).unwrap_err()[0].clone();
    let sections = |skewness, uniform| {
        LawSpec::Sections(SectionsSpec {
            skewness,
            uniform,
            ..SectionsSpec::scca(0.25, 0.25)
        })
    };
    assert_eq!(refused(sections(0.0, 0.0)).path, "sections.skewness");
    assert_eq!(refused(sections(1.0, 1.0)).path, "sections.uniform");
    assert_eq!(refused(sections(f64::NAN, 0.0)).path, "sections.skewness");
    assert_eq!(refused(LawSpec::Scca { b: 0.7, d: 0.7 }).path, "scca");
    let moving = polynomial(&[0.0, 1.0], &[1.0, 0.0], &[]);
    assert_eq!(
        refused(LawSpec::Polynomial(moving)).path,
        "polynomial.start"
    );
    let table = vec![(0.0, 0.0), (0.5, 0.4), (0.9, 1.0)];
    assert_eq!(refused(LawSpec::Table(table)).path, "table");
    // θ = 3τ² − 2τ³ is fastest in the middle: no run-up.
    let hump = RunLawSpec::Polynomial(polynomial(&[0.0, 0.0], &[1.0, 0.0], &[]));
    let message = &Law::of_run_up(&hump).unwrap_err()[0].message;
    assert!(message.contains("τ = 0.5"), "{message}");
    let back = RunLawSpec::Table(vec![(0.0, 0.0), (0.3, -0.1), (1.0, 1.0)]);
    assert!(Law::of_run_up(&back).is_err());
    let square = RunLawSpec::Polynomial(polynomial(&[0.0, 0.0], &[1.0], &[]));
    let constants = Law::of_run_up(&square).unwrap().constants();
    same(constants.speed.value, 2.0, "τ²");
}
