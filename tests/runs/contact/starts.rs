//! Contacts that start closed with neither force nor speed: nothing is decided by rounding.

use super::run_text;
use dam::integrate::Method;
use std::fmt::Write;

/// Contacts of a lever, with stiffness and losses in units of time of `scale` seconds.
fn contacts(scale: f64) -> [(&'static str, String); 3] {
    [
        (
            "Kelvin–Voigt",
            format!(
                r#"{{ "law": "kelvin_voigt", "stiffness": {:e}, "damping": {:e} }}"#,
                150_000.0 / scale.powi(2),
                23.0 / scale
            ),
        ),
        (
            "Hunt–Crossley",
            format!(
                r#"{{ "law": "hunt_crossley", "stiffness": {:e}, "dissipation": {:e} }}"#,
                150_000.0 / scale.powi(2),
                0.2 * scale
            ),
        ),
        (
            "elastic",
            format!(r#"{{ "stiffness": {:e} }}"#, 150_000.0 / scale.powi(2)),
        ),
    ]
}

/// A lever that starts as told, pressed on its law by a force at its last mass, with all
/// times `scale` times as long.
fn lever(masses: usize, contact: &str, scale: f64, start: &str) -> String {
    let mut text = String::new();
    write!(
        text,
        r#"{{ "dam": 1, "name": "Start", "objects": {{
            "cam": {{ "kind": "drive", "motion": {{ "fixed": 0 }} }},
            "lever": {{ "kind": "rocker", "input": "cam", "position": {{ "ratio": 0.69 }},
                "inertia": 0.074, "stiffness": {:e}, "masses": {masses}, "damping_capacity": 0.2,
                "pair": {{ "closure": "force", "contact": {contact} }},
                "loads": {{ "h": {{ "constant": {:e} }} }} }} }},
            "run": {{ "duration": {:e}, "start": {start}, "tolerance": 1e-8 }} }}"#,
        3600.0 / scale.powi(2),
        -14.0 / scale.powi(2),
        0.01 * scale
    )
    .unwrap();
    text
}

#[test]
fn a_start_on_the_law_is_decided_by_derivatives() {
    let methods = [Method::Radau, Method::Taylor, Method::Dop853];
    for scale in [1e-3, 1.0, 1e6] {
        for (name, contact) in contacts(scale) {
            for masses in [1, 2, 5, 8] {
                let text = lever(masses, &contact, scale, r#""on_law""#);
                let mut deflections = Vec::new();
                for method in methods {
                    let result = run_text(&text, Some(method));
                    let figures = &result.figures.objects["lever"];
                    let pair = figures.pair.as_ref().unwrap();
                    let what = format!("{name}, {masses} masses, {method:?}, times {scale}");
                    // The lever swings into its contact, and does not come back by the end.
                    assert_eq!(pair.separations, 0, "{what}");
                    deflections.push((figures.delta_abs, what));
                }
                let (reference, _) = deflections[0];
                for (deflection, what) in &deflections {
                    let off = (deflection - reference).abs();
                    assert!(off <= 1e-5 * reference, "{what}: {deflection}, {reference}");
                }
            }
        }
    }
}

/// From its equilibrium it does not move, whatever the method and the unit of time.
#[test]
fn a_start_in_equilibrium_stays_there() {
    for scale in [1e-3, 1.0, 1e6] {
        for (name, contact) in contacts(scale) {
            for (masses, start) in [(1, "static"), (2, "kinetostatic"), (8, "static")] {
                let text = lever(masses, &contact, scale, &format!(r#""{start}""#));
                for method in [Method::Radau, Method::Taylor, Method::Dop853] {
                    let result = run_text(&text, Some(method));
                    let own = &result.figures.objects["lever"];
                    let pair = own.pair.as_ref().unwrap();
                    let what = format!("{name}, {masses} masses, {method:?}, times {scale}");
                    assert_eq!([pair.separations, pair.closures], [0, 0], "{what}");
                    // ω is some 200 rad/s.
                    let sway = own.delta_max - own.delta_min;
                    assert!(own.delta_abs > 0.003, "{what}: {}", own.delta_abs);
                    assert!(sway < 1e-6 * own.delta_abs, "{what}: {sway}");
                }
            }
        }
    }
}

/// From a state off its law it falls onto its contact, at the same instant by all methods.
#[test]
fn a_start_off_the_law_comes_to_the_contact() {
    for scale in [1e-3, 1.0, 1e6] {
        for (name, contact) in contacts(scale) {
            for masses in [1, 2, 5] {
                let (off, at_rest) = (vec![0.001; masses], vec![0.0; masses]);
                let start = format!(
                    r#"{{ "lever": {{ "displacement": {off:?}, "speed": {at_rest:?} }} }}"#
                );
                let text = lever(masses, &contact, scale, &start);
                let mut first = None;
                for method in [Method::Radau, Method::Taylor, Method::Dop853] {
                    let result = run_text(&text, Some(method));
                    let own = &result.figures.objects["lever"];
                    let pair = own.pair.as_ref().unwrap();
                    let what = format!("{name}, {masses} masses, {method:?}, times {scale}");
                    assert_eq!(pair.closures, 1, "{what}: {:?}", pair.switch_times);
                    let here = [pair.switch_times[0], own.delta_abs];
                    let there = *first.get_or_insert(here);
                    for (here, there) in here.into_iter().zip(there) {
                        assert!(
                            (here - there).abs() <= 1e-5 * there,
                            "{what}: {here}, {there}"
                        );
                    }
                }
            }
        }
    }
}

/// A drive that starts with neither acceleration nor deflection, written as products of sines:
/// the sum of what cancels is no acceleration, and the jerk opens the pair at once. That is no
/// switch of the run.
#[test]
fn what_cancels_at_the_start_decides_nothing() {
    let text = r#"{ "dam": 1, "name": "Cancels", "objects": {
        "a": { "kind": "drive",
            "motion": { "expression": "15.03*t + 0.3117*sin(23.7*t)*cos(15.03*t)" } },
        "c": { "kind": "slider", "input": "a", "position": { "ratio": 1.697 }, "inertia": 0.0833,
            "stiffness": 84, "damping": 0.3235, "masses": 2, "pair": { "closure": "force" },
            "loads": { "closing": { "constant": -0.5496, "mass": "last" } } } },
        "run": { "duration": 1.2, "tolerance": 1e-9, "start": "on_law" } }"#;
    let mut first = None;
    for method in [Method::Exact, Method::Taylor, Method::Radau] {
        let result = run_text(text, Some(method));
        let own = &result.figures.objects["c"];
        let pair = own.pair.as_ref().unwrap();
        assert_eq!(pair.switch_times, Vec::<f64>::new(), "{method:?}");
        assert!((pair.separated_time - 1.2).abs() < 1e-12, "{method:?}");
        let there = *first.get_or_insert(own.end.displacement);
        assert!(
            (own.end.displacement - there).abs() < 1e-6 * there,
            "{method:?}"
        );
    }
}

/// A rigid contact that is held through a whole rise: the drive's work is what the loads took,
/// and the energies balance by every method.
#[test]
fn a_held_contact_balances_its_energies() {
    let text = r#"{ "dam": 1, "name": "Held", "objects": {
        "a": { "kind": "drive", "motion": { "plan": { "stations": [
            { "at": 0, "displacement": 0, "motion": "dwell" },
            { "at": 0.056, "displacement": 0, "motion": "3-4-5" },
            { "at": 0.168, "displacement": 0.328 } ] } } },
        "c": { "kind": "slider", "input": "a", "inertia": 2.06, "masses": 0,
            "position": { "ratio": 0.392 },
            "pair": { "closure": "force", "contact": { "restitution": 0.34 } },
            "loads": { "closing": { "constant": -2942, "mass": "last" } } } },
        "run": { "duration": 0.233, "tolerance": 1e-9 } }"#;
    for method in [Method::Exact, Method::Taylor, Method::Dop853] {
        let result = run_text(text, Some(method));
        let error = result.figures.run.energy_error;
        assert!(error < 1e-12, "{method:?}: {error:e}");
    }
}

/// Where the law is at rest at the start but for its rounding, the force on the last of four
/// masses decides, though only the fifth derivative of the first one tells of it.
#[test]
fn the_rounding_of_a_law_at_rest_decides_nothing() {
    let text = r#"{ "dam": 1, "name": "Run-up", "objects": {
        "a": { "kind": "drive", "motion": { "run_up": { "speed": 23.6, "time": 0.2467 } } },
        "c": { "kind": "slider", "input": "a", "inertia": 0.1639, "masses": 4, "damping": 2.852,
            "stiffness": 724.6, "pair": { "closure": "force" },
            "position": { "cam": { "law": "4-5-6-7", "lift": 0.06675, "rise": "100 deg",
                "dwell": "40 deg", "return": "120 deg" } },
            "loads": { "closing": { "constant": -18.64, "mass": "last" } } } },
        "run": { "duration": 0.5554, "tolerance": 1e-9, "start": "on_law" } }"#;
    for method in [Method::Exact, Method::Dop853] {
        let result = run_text(text, Some(method));
        let pair = result.figures.objects["c"].pair.as_ref().unwrap();
        assert_eq!([pair.separations, pair.closures], [2, 2], "{method:?}");
        assert!(result.figures.run.evaluations < 50_000, "{method:?}");
    }
}
