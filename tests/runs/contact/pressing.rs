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
                let (piece, phi) = found.cam.motion().piece_at(angle);
                let state = found.cam.at(piece, phi);
                found.cam.pressure(&state, force / state.lever).unwrap()
            };
            let all: Vec<f64> = angles.iter().zip(forces).map(pressure).collect();
            all
        });
        let sampled = sampled.unwrap();
        let recorded = column("valve", Quantity::ContactPressure);
        assert_eq!(recorded.len(), sampled.len());
        for (recorded, sampled) in recorded.iter().zip(&sampled) {
            let off = (recorded - sampled).abs();
            assert!(off <= 1e-9 * exact.max_pressure, "{recorded} {sampled}");
        }
        let sampled = sampled.into_iter().fold(0.0, f64::max);
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
                    let (piece, phi) = found.cam.motion().piece_at(angle.to_radians());
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

/// E* of steel on steel.
const MODULUS: f64 = 206e9 / 1.82;

/// The columns of contact force and pressure of an object hold a closed form, sample by
/// sample, and its greatest pressure is that of the greatest force.
fn holds(
    text: &str,
    id: &str,
    method: Method,
    force: impl Fn(&RunResult) -> f64,
    law: &dyn Fn(f64) -> f64,
) {
    let result = run_text(text, Some(method));
    let column = |quantity| &result.record.column(id, quantity).unwrap().values;
    let (forces, pressures) = (
        column(Quantity::ContactForce),
        column(Quantity::ContactPressure),
    );
    assert!(forces.contains(&0.0) && forces.iter().any(|force| *force > 0.0));
    for (force, pressure) in forces.iter().zip(pressures) {
        close(*pressure, law(*force), 1e-9, id);
    }
    let greatest = result.figures.objects[id].pressing.unwrap().max_pressure;
    close(
        greatest,
        law(force(&result)),
        1e-6,
        &format!("{id} by {method}"),
    );
    assert!(
        pressures
            .iter()
            .all(|pressure| *pressure <= greatest * (1.0 + 1e-9))
    );
}

fn of_pair(id: &str) -> impl Fn(&RunResult) -> f64 + '_ {
    move |result| {
        result.figures.objects[id]
            .pair
            .as_ref()
            .unwrap()
            .max_contact_force
    }
}

#[test]
fn of_a_ball_it_is_that_of_hertz() {
    let text = r#"{ "dam": 1, "name": "ball", "objects": {
        "plate": { "kind": "drive", "coordinate": "sliding", "motion": { "fixed": 0 } },
        "ball": { "kind": "slider", "input": "plate", "position": { "ratio": 1 }, "inertia": "50 g", "masses": 0,
            "pair": { "closure": "force", "contact": { "law": "hertz", "dissipation": "0.1 s/m",
                "from": { "point": { "radius": "10 mm", "modulus": "206 GPa" } } } },
            "loads": { "weight": { "constant": "-0.5 N" } } } },
        "run": { "duration": "20 ms", "samples": 3000, "tolerance": 1e-10,
            "start": { "ball": { "displacement": ["1 mm"], "speed": ["-1 m/s"] } } } }"#;
    // Johnson, 4.24.
    let pressure =
        |force: f64| (6.0 * force * (MODULUS / 0.01).powi(2) / std::f64::consts::PI.powi(3)).cbrt();
    for method in [Method::Radau, Method::Dop853] {
        holds(text, "ball", method, of_pair("ball"), &pressure);
    }
}

#[test]
fn along_a_line_it_follows_the_root_of_the_force_on_its_arm() {
    let line = |arm: &str| {
        format!(
            r#"{{ "from": {{ "line": {{ "radius": "8 mm", "counter_radius": "30 mm", {arm}"width": "10 mm", "load": "1 kN", "modulus": "206 GPa" }} }} }}"#
        )
    };
    let text = |kind: &str, contact: &str, inertia: &str, force: &str| {
        format!(
            r#"{{ "dam": 1, "name": "line", "objects": {{
                "shaft": {{ "kind": "drive", "motion": {{ "speed": "20 rev/s" }} }},
                "one": {{ "kind": "{kind}", "input": "shaft", "position": {{ "sine": {{ "amplitude": 0.01 }} }},
                    "inertia": "{inertia}", "masses": 0, "pair": {{ "closure": "force", "contact": {contact} }},
                    "loads": {{ "closing": {{ "constant": "{force}" }} }} }} }},
                "run": {{ "duration": 0.1, "start": "static", "samples": 3000, "tolerance": 1e-10 }} }}"#
        )
    };
    let factor = (MODULUS * (1.0 / 0.008 + 1.0 / 0.03) / (std::f64::consts::PI * 0.01)).sqrt();
    let slider = text("slider", &line(""), "1 kg", "-100 N");
    let rocker = text(
        "rocker",
        &line(r#""arm": "50 mm", "#),
        "0.01 kg m^2",
        "-1 N m",
    );
    for method in [Method::Exact, Method::Radau] {
        holds(&slider, "one", method, of_pair("one"), &|force| {
            factor * force.sqrt()
        });
        let on_arm = |moment: f64| factor * (moment / 0.05).sqrt();
        holds(&rocker, "one", method, of_pair("one"), &on_arm);
    }
    // On a stop, behind an elastic object.
    let stop = format!(
        r#"{{ "dam": 1, "name": "stop", "objects": {{
            "shaft": {{ "kind": "drive", "motion": {{ "speed": "20 rev/s" }} }},
            "one": {{ "kind": "slider", "input": "shaft", "position": {{ "sine": {{ "amplitude": 0.01 }} }},
                "inertia": "1 kg", "stiffness": "1 kN/mm", "damping_capacity": 0.4, "masses": 2,
                "stops": {{ "end": {{ "at": "9 mm", "side": "+", "contact": {} }} }} }} }},
            "run": {{ "duration": 0.1, "samples": 3000, "tolerance": 1e-10 }} }}"#,
        line("")
    );
    let force = |result: &RunResult| {
        let stop = result.figures.objects["one.end"].stop.as_ref();
        stop.unwrap().max_contact_force
    };
    for method in [Method::Taylor, Method::Radau] {
        holds(&stop, "one.end", method, force, &|force| {
            factor * force.sqrt()
        });
    }
}

#[test]
fn what_is_of_no_known_shape_has_no_pressure() {
    let text = r#"{ "dam": 1, "name": "plain", "objects": {
        "shaft": { "kind": "drive", "motion": { "speed": "20 rev/s" } },
        "one": { "kind": "slider", "input": "shaft", "position": { "sine": { "amplitude": 0.01 } },
            "inertia": "1 kg", "masses": 0, "pair": { "closure": "force", "contact": { "stiffness": 1e7 } },
            "loads": { "closing": { "constant": "-100 N" } } } }, "run": { "duration": 0.1 } }"#;
    let result = run_text(text, None);
    assert_eq!(result.record.column("one", Quantity::ContactPressure), None);
    assert_eq!(result.figures.objects["one"].pressing, None);
    // Where the profile is undercut no pressure is finite.
    let undercut = valve(FLAT, "\"masses\": 0", 600.0);
    let result = run_text(&undercut.replace("45 mm", "10 mm"), None);
    assert_eq!(
        result.record.column("valve", Quantity::ContactPressure),
        None
    );
    assert_eq!(result.figures.objects["valve"].pressing, None);
    assert_eq!(result.record.times.len(), 4001);
}
