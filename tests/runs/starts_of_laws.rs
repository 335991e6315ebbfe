//! Runs that start where a law leaves its dwell or a motor rests, against an independent integration
//! (`tests/reference/starts.py`).

use crate::contact::run_text;
use dam::integrate::Method;
use serde_json::Value;

/// A mass of 2 kg on 2e5 N/m, lifted by 20 mm in 60° at 300 rpm.
fn rise(law: &str, end: f64) -> String {
    format!(
        r#"{{ "dam": 1, "name": "Rise out of a dwell", "objects": {{
            "cam": {{ "kind": "drive", "motion": {{ "speed": "300 rpm" }} }},
            "f": {{ "kind": "slider", "input": "cam", "inertia": 2, "stiffness": 2e5,
                "position": {{ "cam": {{ "lift": "20 mm", "rise": "60 deg", "dwell": "120 deg",
                    "return": "60 deg", "law": "{law}" }} }} }} }},
            "run": {{ "duration": {end:?}, "tolerance": 1e-10 }} }}"#
    )
}

#[test]
fn a_run_starts_from_the_dwell_that_lies_before_it() {
    let reference: Value = serde_json::from_str(include_str!("../reference/starts.json")).unwrap();
    let end = reference["end"].as_f64().unwrap();
    for (law, force) in reference["force"].as_object().unwrap() {
        let force = force.as_f64().unwrap();
        let result = run_text(&rise(law, end), None);
        let found = result.figures.objects["f"].peak_reaction;
        let off = (found - force).abs();
        assert!(off <= 1e-6 * force, "{law}: {found} N and not {force} N");
        let mut warnings = result.warnings.iter().map(ToString::to_string);
        let told = warnings.any(|warning| warning.contains("`f` starts from the side before"));
        // (The first derivative of 4-5-6-7 that differs is the fourth, which no start reads.)
        assert_eq!(told, law != "4-5-6-7", "{law}: {:?}", result.warnings);
    }
}

/// A rotor that a torque c·tⁿ sets in motion against v·|v|, all times `scale` times as long.
fn dragged(power: &str, scale: f64) -> String {
    format!(
        r#"{{ "dam": 1, "name": "Drag from rest", "objects": {{
            "m": {{ "kind": "drive",
                "motor": {{ "inertia": 0.2, "speed": 0, "angle": 0,
                    "torque": {{ "expression": "{:?}*(t/{scale:?})^{power}" }} }},
                "loads": {{ "d": {{ "expression": "-0.05*phi_dot*abs(phi_dot)" }} }} }} }},
            "run": {{ "duration": {:?}, "tolerance": 1e-8 }} }}"#,
        3.0 / (scale * scale),
        4.0 * scale
    )
}

#[test]
fn a_drag_from_rest_starts_with_every_method_and_unit_of_time() {
    let reference: Value = serde_json::from_str(include_str!("../reference/starts.json")).unwrap();
    for (power, end) in reference["drag"].as_object().unwrap() {
        let (angle, speed) = (end[0].as_f64().unwrap(), end[1].as_f64().unwrap());
        for scale in [1e-6, 1.0, 7.3, 1e5] {
            let text = dragged(power, scale);
            for method in [
                Method::Radau,
                Method::Taylor,
                Method::Dop853,
                Method::Rodas5p,
            ] {
                let result = run_text(&text, Some(method));
                let last = &result.figures.objects["m"].end;
                let off = (last.displacement / angle - 1.0)
                    .abs()
                    .max((last.speed * scale / speed - 1.0).abs());
                assert!(off <= 1e-6, "t^{power}, {method:?}, times {scale}: {off}");
            }
        }
    }
}
