//! Synthesis against reference figures and quantities computed directly.

use super::*;
use crate::kinematics::motion::law::{Law, LawSpec, PolynomialSpec, RunLawName, RunLawSpec};
use serde_json::Value;

const REFERENCE: &str = include_str!("../../../../tests/reference/motion-laws.json");

fn reference() -> Value {
    serde_json::from_str(REFERENCE).unwrap()
}

fn number(row: &Value, name: &str) -> Option<f64> {
    row.get(name).and_then(Value::as_f64)
}

fn law(row: &Value) -> RunLawSpec {
    let (s1, s2) = match row {
        Value::Array(pair) => (pair[0].as_f64().unwrap(), pair[1].as_f64().unwrap()),
        row => (number(row, "s1").unwrap(), number(row, "s2").unwrap()),
    };
    RunLawSpec::Trapezoid { s1, s2 }
}

fn trapezoid(s: f64) -> RunLawSpec {
    RunLawSpec::Trapezoid { s1: s, s2: s }
}

/// Problem 1 with equal laws, to be changed.
fn plain() -> StrokeSpec {
    StrokeSpec {
        run_up: trapezoid(0.25),
        run_out: trapezoid(0.25),
        stroke: Some(0.05),
        span: Some(std::f64::consts::TAU / 3.0),
        skewness: Skewness::Given(1.0),
        uniform_stroke: None,
        uniform_span: None,
        uniform_optimum: false,
        peak_speed: None,
    }
}

fn given(case: &Value) -> StrokeSpec {
    let given = &case["given"];
    let skewness = match number(given, "f") {
        Some(f) => Skewness::Given(f),
        None => Skewness::AccelerationRatio(number(given, "lambda").unwrap()),
    };
    StrokeSpec {
        run_up: law(&case["law_runup"]),
        run_out: law(&case["law_runout"]),
        stroke: number(given, "Pi_III"),
        span: number(given, "phi_III"),
        skewness,
        uniform_stroke: number(given, "zeta_Pi"),
        uniform_span: number(given, "zeta_phi"),
        uniform_optimum: false,
        peak_speed: number(given, "V_max"),
    }
}

#[track_caller]
fn same(found: f64, wanted: f64, what: &str) {
    let error = (found - wanted).abs();
    let bound = 1e-12 * wanted.abs().max(1e-3);
    assert!(error <= bound, "{what}: {found} {wanted}");
}

#[test]
fn all_problems_of_the_reference_are_solved() {
    let reference = reference();
    let cases = reference["synthesis"].as_array().unwrap();
    assert_eq!(cases.len(), 8);
    for case in cases {
        let stroke = Stroke::new(&given(case)).unwrap();
        let found = stroke.figures();
        for (name, value) in [
            ("Pi_I", found.stroke_run_up),
            ("Pi_II", found.stroke_run_out),
            ("Pi_III", found.stroke),
            ("phi_I", found.angle_run_up),
            ("phi_II", found.angle_run_out),
            ("phi_III", found.span),
            ("zeta_Pi", found.uniform_stroke),
            ("zeta_phi", found.uniform_span),
            ("f", found.skewness),
            ("nu1", found.speed_ratio),
            ("nu2", found.law_acceleration_ratio),
            ("U", found.u),
            ("lambda", found.acceleration_ratio),
            ("V_max", found.peak_speed),
            ("A_runup_max", found.acceleration_run_up),
            ("A_runout_absmax", found.acceleration_run_out),
            ("VA_runup_max", found.product_run_up),
            ("VA_runout_absmax", found.product_run_out),
        ] {
            same(value, number(&case["structure"], name).unwrap(), name);
        }
        profile(&stroke, case);
    }
}

/// Samples of the profile; where a derivative jumps, the reference has one of its sides.
fn profile(stroke: &Stroke, case: &Value) {
    let figures = stroke.figures();
    let jerk = 20.0 * figures.acceleration_run_up.abs() / figures.angle_run_up;
    for row in case["profile"].as_array().unwrap() {
        // A joint of the reference and ours may differ by rounding.
        let phi = number(row, "phi").unwrap();
        let around = [phi - 1e-15, phi, phi + 1e-15];
        let sides = around.map(|phi| stroke.sides(phi));
        let wanted = ["Pi", "Pi1", "Pi2", "Pi3"].map(|name| number(row, name).unwrap());
        let scales = [
            figures.stroke,
            figures.peak_speed,
            figures.acceleration_run_up,
            jerk,
        ];
        let near = |jet: &Jet| {
            let found = [jet.value, jet.first, jet.second, jet.third];
            let mut all = found.iter().zip(wanted).zip(scales);
            all.all(|((found, wanted), scale)| (found - wanted).abs() <= 1e-12 * scale.abs())
        };
        assert!(sides.iter().flatten().any(near), "{row} {sides:?}");
    }
}

#[test]
fn the_uniform_section_of_the_text() {
    let reference = reference();
    let example = &reference["uniform_section_example"];
    let with = StrokeSpec {
        uniform_optimum: true,
        ..plain()
    };
    let without = StrokeSpec {
        uniform_stroke: Some(0.0),
        ..plain()
    };
    let (with, without) = (Stroke::new(&with).unwrap(), Stroke::new(&without).unwrap());
    let (with, without) = (with.figures(), without.figures());
    let change = |f: fn(&StrokeFigures) -> f64| f(with) / f(without) - 1.0;
    same(with.uniform_stroke, 0.5, "ζ_Π");
    same(with.uniform_span, 1.0 / 3.0, "ζ_φ");
    for (name, found) in [
        ("change_VA", change(|s| s.product_run_up)),
        ("change_V", change(|s| s.peak_speed)),
        ("change_A", change(|s| s.acceleration_run_up)),
    ] {
        same(found, number(example, name).unwrap(), name);
    }
}

#[test]
fn the_optimum_uniform_section_is_least_for_any_laws() {
    for (up, out, f) in [
        (RunLawName::Sine, RunLawName::Cosine, 0.7),
        (RunLawName::ReversedCosine, RunLawName::Rectangular, 1.6),
        (RunLawName::Cosine, RunLawName::Cosine, 1.0),
    ] {
        let base = StrokeSpec {
            run_up: up.into(),
            run_out: out.into(),
            skewness: Skewness::Given(f),
            ..plain()
        };
        let product = |share: f64| {
            let spec = StrokeSpec {
                uniform_stroke: Some(share),
                ..base.clone()
            };
            Stroke::new(&spec).unwrap().figures().product_run_up
        };
        let best = StrokeSpec {
            uniform_optimum: true,
            ..base.clone()
        };
        let best = *Stroke::new(&best).unwrap().figures();
        for i in 0..99 {
            let share = f64::from(i) / 100.0;
            assert!(product(share) >= best.product_run_up * (1.0 - 1e-14));
        }
        let near = product((best.uniform_stroke - 1e-3).max(0.0));
        assert!(near < best.product_run_up * (1.0 + 1e-4));
    }
}

#[test]
fn optimum_skewness_of_the_reference() {
    let reference = reference();
    let cases = reference["optimum_skewness"].as_array().unwrap();
    assert_eq!(cases.len(), 4);
    for case in cases {
        let weight = number(case, "weight").unwrap();
        let criterion = match case["criterion"].as_str() {
            Some("K1") => Criterion::Acceleration { weight },
            _ => Criterion::Product { weight },
        };
        let spec = StrokeSpec {
            run_up: law(&case["law_runup"]),
            run_out: law(&case["law_runout"]),
            stroke: number(case, "Pi_III"),
            span: number(case, "phi_III"),
            skewness: Skewness::Optimum(criterion),
            uniform_stroke: number(case, "fixed_zeta_Pi"),
            uniform_span: number(case, "fixed_zeta_phi"),
            ..plain()
        };
        let stroke = Stroke::new(&spec).unwrap();
        let f = number(case, "f_opt").unwrap();
        let error = (stroke.figures().skewness / f - 1.0).abs();
        assert!(error < 1e-7, "{f}: {error}");
        let k = criterion.of(stroke.figures());
        same(k, number(case, "K").unwrap(), "K");
    }
}

#[test]
fn optimum_skewness_with_a_given_greatest_speed() {
    let criterion = Criterion::Acceleration { weight: 2.0 };
    let with = |skewness| StrokeSpec {
        run_up: RunLawName::UnequalTrapezoid.into(),
        run_out: RunLawName::Cosine.into(),
        peak_speed: Some(0.034),
        skewness,
        ..plain()
    };
    let best = Stroke::new(&with(Skewness::Optimum(criterion))).unwrap();
    let (f, k) = (best.figures().skewness, criterion.of(best.figures()));
    for factor in [0.9, 0.99, 1.01, 1.1] {
        let other = Stroke::new(&with(Skewness::Given(f * factor))).unwrap();
        assert!(criterion.of(other.figures()) > k);
    }
    let none = Criterion::Product { weight: 0.0 };
    let faults = Stroke::new(&with(Skewness::Optimum(none))).unwrap_err();
    assert!(faults[0].message.contains("f → 0"));
}

#[test]
fn a_stroke_is_the_law_of_its_sections() {
    let spec = StrokeSpec {
        run_up: RunLawName::UnequalTrapezoid.into(),
        run_out: RunLawSpec::Polynomial(PolynomialSpec {
            start: vec![0.0, 0.0, 0.0],
            end: vec![1.0],
            through: vec![],
        }),
        skewness: Skewness::AccelerationRatio(1.7),
        stroke: Some(-0.3),
        span: Some(1.3),
        uniform_span: Some(0.2),
        ..plain()
    };
    let stroke = Stroke::new(&spec).unwrap();
    same(stroke.figures().acceleration_ratio, 1.7, "λ");
    let law = Law::of_stroke(&LawSpec::Sections(stroke.sections())).unwrap();
    for i in 0..=130 {
        let phi = 0.01 * f64::from(i);
        let (one, other) = (stroke.sides(phi)[1], law.at((phi / 1.3).min(1.0)));
        same(one.value, -0.3 * other.value, "Π");
        same(one.first, -0.3 / 1.3 * other.first, "Π′");
    }
    let [before, after] = stroke.sides(1.3);
    assert!(before.second > 0.0 || after.second == 0.0);
    assert_eq!(stroke.sides(2.0)[1].value, -0.3);
    assert_eq!(stroke.sides(-1.0)[0], Jet::default());
}

#[test]
fn refusals_give_the_solvable_interval() {
    let refused = |spec: StrokeSpec| Stroke::new(&spec).unwrap_err()[0].clone();
    let speed = |speed: f64| StrokeSpec {
        peak_speed: Some(speed),
        ..plain()
    };
    // Π_III/φ_III = 0.0238732…, G = 2.
    for wrong in [0.02, 0.06, 0.05 / plain().span.unwrap()] {
        let fault = refused(speed(wrong));
        assert_eq!(fault.path, "peak_speed");
        assert!(fault.message.contains("0.02387324146378"), "{fault:?}");
        assert!(fault.message.contains("0.04774648292756"), "{fault:?}");
    }
    let limit = Stroke::new(&speed(2.0 * 0.05 / plain().span.unwrap())).unwrap();
    assert!(limit.figures().uniform_stroke.abs() < 1e-12);
    let uniform = |share: f64| StrokeSpec {
        uniform_stroke: Some(share),
        ..plain()
    };
    for wrong in [-0.1, 1.0, f64::NAN] {
        assert_eq!(refused(uniform(wrong)).path, "uniform_stroke");
    }
    for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let spec = StrokeSpec {
            skewness: Skewness::Given(wrong),
            ..uniform(0.3)
        };
        assert_eq!(refused(spec).path, "skewness");
        let spec = StrokeSpec {
            skewness: Skewness::AccelerationRatio(wrong),
            ..uniform(0.3)
        };
        assert_eq!(refused(spec).path, "acceleration_ratio");
    }
    for wrong in [0.0, f64::NAN] {
        let spec = StrokeSpec {
            stroke: Some(wrong),
            ..uniform(0.3)
        };
        assert_eq!(refused(spec).path, "stroke");
    }
    let spec = StrokeSpec {
        span: Some(-1.0),
        ..uniform(0.3)
    };
    assert_eq!(refused(spec).path, "span");
    assert!(refused(plain()).message.starts_with("2 of the four"));
    let spec = StrokeSpec {
        run_up: RunLawSpec::Trapezoid { s1: 0.7, s2: 0.5 },
        ..uniform(0.3)
    };
    assert_eq!(refused(spec).path, "run_up");
}
