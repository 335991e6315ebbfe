//! Hertzian pressure between follower and cam in a run.

use super::run_text;
use dam::ask::CamQuestion;
use dam::integrate::Method;
use dam::prelude::*;
use dam::record::{PressingFigures, Quantity};
use dam::studies::run::RunResult;

/// A valve of 0.1 kg with a flat tappet, or a roller, on its cam.
fn valve(contact: &str, body: &str, speed: f64) -> String {
    format!(
        r#"{{ "dam": 1, "name": "valve", "objects": {{
            "camshaft": {{ "kind": "drive", "motion": {{ "speed": "{speed} rpm" }} }},
            "valve": {{ "kind": "cam_follower", "input": "camshaft", "motion": "sliding",
                "position": {{ "cam": {{ "lift": "9 mm", "rise": "70 deg", "return": "70 deg", "law": "modified_sine" }} }},
                "cam": {{ "base_radius": "45 mm", "contact": {contact}, "material": {{ "thickness": "15 mm", "modulus": "206 GPa" }} }},
                "inertia": "100 g", {body}, "pair": {{ "closure": "force" }},
                "loads": {{ "spring": {{ "spring": {{ "rate": "25 N/mm", "preload": "160 N" }} }} }} }} }},
            "run": {{ "duration": {:?}, "tolerance": 1e-10, "samples": 4000 }} }}"#,
        120.0 / speed
    )
}

const FLAT: &str = r#"{ "flat": { "width": "60 mm" } }"#;
const ROLLER: &str = r#"{ "roller": "9 mm" }"#;

fn pressing(result: &RunResult) -> PressingFigures {
    result.figures.objects["valve"].pressing.unwrap()
}

fn close(found: f64, wanted: f64, share: f64, what: &str) {
    let off = (found - wanted).abs();
    assert!(
        off <= share * wanted.abs(),
        "{what}: {found} and not {wanted}"
    );
}

#[test]
fn of_a_rigid_follower_it_is_that_of_the_study_of_cams() {
    for contact in [FLAT, ROLLER] {
        let text = valve(contact, "\"masses\": 0", 1500.0);
        let mechanism = Scene::from_json(&text)
            .and_then(|scene| scene.prepare())
            .unwrap();
        let question = CamQuestion::default();
        let of_cam = mechanism.cam(&question, |found| {
            let force = found.figures.force.as_ref().unwrap();
            force.pressure.unwrap()
        });
        let of_cam = of_cam.unwrap();
        let result = run_text(&text, None);
        let found = pressing(&result);
        close(found.max_pressure, of_cam.value, 1e-8, contact);
        assert!(found.max_pressure > 1e8, "{found:?}");
    }
}

#[test]
fn of_an_elastic_follower_it_follows_its_contact_force() {
    for (contact, speed) in [(FLAT, 2500.0), (ROLLER, 2500.0), (ROLLER, 4200.0)] {
        let text = valve(
            contact,
            "\"stiffness\": \"8 kN/mm\", \"damping_capacity\": 0.5",
            speed,
        );
        let mechanism = Scene::from_json(&text)
            .and_then(|scene| scene.prepare())
            .unwrap();
        let results = [Method::Exact, Method::Radau, Method::Dop853]
            .map(|method| run_text(&text, Some(method)));
        let [exact, radau, dop853] = results.each_ref().map(pressing);
        close(radau.max_pressure, exact.max_pressure, 1e-6, contact);
        close(dop853.max_pressure, exact.max_pressure, 1e-6, contact);
        // From the samples of the run, one by one.
        let record = &results[0].record;
        let column = |id, quantity| &record.column(id, quantity).unwrap().values;
        let angles = column("camshaft", Quantity::Displacement);
        let forces = column("valve", Quantity::ContactForce);
        let sampled = mechanism.cam(&CamQuestion::default(), |found| {
            let pressure = |(&angle, &force): (&f64, &f64)| {
                let (piece, phi) = found.cam.motion().locate(angle);
                let state = found.cam.at(piece, phi);
                found.cam.pressure(&state, force / state.lever).unwrap()
            };
            angles.iter().zip(forces).map(pressure).fold(0.0, f64::max)
        });
        let sampled = sampled.unwrap();
        assert!(
            sampled <= exact.max_pressure * (1.0 + 1e-9),
            "{sampled} {exact:?}"
        );
        close(sampled, exact.max_pressure, 2e-3, contact);
        let open = results[0].figures.objects["valve"].pair.as_ref().unwrap();
        if speed > 4000.0 {
            assert!(open.separations > 0 && forces.contains(&0.0));
        }
    }
}

/// The contact stiffness of the follower `valve` of a scene, and the scene's cam.
fn stiffness(text: &str) -> f64 {
    let mechanism = Scene::from_json(text).and_then(|scene| scene.prepare());
    let mechanism = mechanism.unwrap_or_else(|error| panic!("{error}\n{text}"));
    let mut parts = mechanism.model().objects.iter();
    let part = parts.find(|part| part.id == "valve").unwrap();
    part.contact.unwrap().stiffness
}

#[test]
fn the_stiffness_on_a_cam_is_that_of_its_radii() {
    let turning = r#""motion": "turning", "position": { "cam": { "lift": "12 deg", "rise": "90 deg", "return": "90 deg", "law": "modified_sine" } },
        "cam": { "base_radius": "30 mm", "contact": { "roller": "9 mm" }, "centre_distance": "90 mm", "arm": "70 mm", "material": MATERIAL }, "inertia": "0.01 kg m^2""#;
    let sliding = r#""motion": "sliding", "position": { "cam": { "lift": "9 mm", "rise": "90 deg", "return": "90 deg", "law": "modified_sine" } },
        "cam": { "base_radius": "30 mm", "contact": { "roller": "9 mm" }, "offset": "4 mm", "material": MATERIAL }, "inertia": "0.1 kg""#;
    let material =
        r#"{ "thickness": "15 mm", "modulus": "206 GPa", "counter_modulus": "110 GPa" }"#;
    let scene = |body: &str, from: &str| {
        let body = body.replace("MATERIAL", material);
        format!(
            r#"{{ "dam": 1, "name": "valve", "objects": {{
                "shaft": {{ "kind": "drive", "motion": {{ "speed": "600 rpm" }} }},
                "valve": {{ "kind": "cam_follower", "input": "shaft", {body}, "masses": 0,
                    "pair": {{ "closure": "force", "contact": {{ "from": {{ {from} }} }} }},
                    "loads": {{ "closing": {{ "constant": -50 }} }} }} }},
                "run": {{ "duration": 0.1 }} }}"#
        )
    };
    for (body, turns) in [(turning, true), (sliding, false)] {
        for angle in [35.0f64, 85.0] {
            let on_cam = scene(
                body,
                &format!(
                    r#""cam": {{ "load": "1 kN", "at": "{angle} deg", "cam_depth": "20 mm" }}"#
                ),
            );
            let mechanism = Scene::from_json(&on_cam)
                .and_then(|scene| scene.prepare())
                .unwrap();
            let [radius, arm] = mechanism
                .cam(&CamQuestion::default(), |found| {
                    let (piece, phi) = found.cam.motion().locate(angle.to_radians());
                    let state = found.cam.at(piece, phi);
                    [state.profile_radius, state.lever]
                })
                .unwrap();
            let depth = if radius > 0.0 {
                ""
            } else {
                r#""counter_depth": "20 mm", "#
            };
            let arm_word = if turns {
                format!(r#""arm": {arm:?}, "#)
            } else {
                String::new()
            };
            let line = format!(
                r#""line": {{ "radius": "9 mm", "counter_radius": {radius:?}, {depth}{arm_word}"width": "15 mm", "load": "1 kN",
                    "modulus": "206 GPa", "counter_modulus": "110 GPa" }}"#
            );
            let by_hand = stiffness(&scene(body, &line));
            // (Of what slides the normal is inclined by the pressure angle.)
            let factor = if turns { 1.0 } else { arm * arm };
            close(stiffness(&on_cam), factor * by_hand, 1e-12, &on_cam);
        }
        let sharpest = stiffness(&scene(body, r#""cam": { "load": "1 kN" }"#));
        assert!(sharpest > 1e5, "{sharpest}");
    }
}

#[test]
fn a_stiffness_from_a_cam_that_is_not_known_is_refused() {
    let text = valve(ROLLER, "\"masses\": 0", 600.0);
    let contact =
        r#""pair": { "closure": "force", "contact": { "from": { "cam": { "load": "1 kN" } } } }"#;
    let text = text.replace(r#""pair": { "closure": "force" }"#, contact);
    assert!(stiffness(&text) > 1e7);
    let refused = |text: &str| {
        Scene::from_json(text)
            .and_then(|scene| scene.prepare())
            .unwrap_err()
            .to_string()
    };
    let bare = text.replace(
        r#", "material": { "thickness": "15 mm", "modulus": "206 GPa" }"#,
        "",
    );
    assert!(
        refused(&bare).contains("of whose material nothing is known"),
        "{}",
        refused(&bare)
    );
    let flat = text.replace(ROLLER, FLAT);
    assert!(
        refused(&flat).contains("counted from a depth"),
        "{}",
        refused(&flat)
    );
    let hertz = text.replace(r#""from": { "cam""#, r#""law": "hertz", "from": { "cam""#);
    assert!(
        refused(&hertz).contains("contact in a point"),
        "{}",
        refused(&hertz)
    );
}
