//! Runs that start where a law leaves its dwell, against an independent integration
//! (`tests/reference/starts.py`).

use crate::contact::run_text;
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
