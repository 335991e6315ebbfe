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

/// A lever that starts on its law, pressed on it by a force at its last mass, with all
/// times `scale` times as long.
fn lever(masses: usize, contact: &str, scale: f64) -> String {
    let mut text = String::new();
    write!(
        text,
        r#"{{ "dam": 1, "name": "Start on the law", "objects": {{
            "cam": {{ "kind": "drive", "motion": {{ "fixed": 0 }} }},
            "lever": {{ "kind": "rocker", "input": "cam", "position": {{ "ratio": 0.69 }},
                "inertia": 0.074, "stiffness": {:e}, "masses": {masses}, "damping_capacity": 0.2,
                "pair": {{ "closure": "force", "contact": {contact} }},
                "loads": {{ "h": {{ "constant": {:e} }} }} }} }},
            "run": {{ "duration": {:e}, "start": "on_law", "tolerance": 1e-8 }} }}"#,
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
                let text = lever(masses, &contact, scale);
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
