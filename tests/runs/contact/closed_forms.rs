//! Rigid bodies on contacts, in closed form.

use super::{INTEGRATED, Wall, figures, pair, run_text};
use dam::integrate::Method;

/// 2·∫₀¹ dx/√(1 − x^{5/2}) = 4√π·Γ(2/5)/(5·Γ(9/10)).
const HERTZ_DURATION: f64 = 2.943_275_184_324_704_5;

#[test]
fn a_rigid_body_on_kelvin_voigt() {
    let (k, d, v) = (400.0f64, 6.0f64, 0.7);
    let contact = format!(r#"{{ "law": "kelvin_voigt", "stiffness": {k:?}, "damping": {d:?} }}"#);
    let (rate, square) = (0.5 * d, k - 0.25 * d * d);
    let omega = square.sqrt();
    // N = 0, that is p̈ = 0, before p has come back to 0.
    let end = (2.0 * rate * omega).atan2(rate * rate - square) / omega;
    let speed =
        v * (-rate * end).exp() * ((omega * end).cos() - rate / omega * (omega * end).sin());
    for method in INTEGRATED
        .into_iter()
        .chain([Method::Taylor, Method::Exact])
    {
        let result = Wall::rigid(&contact, v, 0.5).run(method);
        let own = pair(&result);
        approx::assert_relative_eq!(own.switch_times[0], end, max_relative = 1e-8);
        approx::assert_relative_eq!(figures(&result).end.speed, -speed, max_relative = 1e-7);
        assert_eq!(own.separations, 1);
        let deepest = (omega / rate).atan() / omega;
        let depth = v * (-rate * deepest).exp() * (omega * deepest).sin() / omega;
        approx::assert_relative_eq!(own.max_indentation.unwrap(), depth, max_relative = 1e-7);
    }
}

#[test]
fn an_impact_by_hertz() {
    let (stiffness, v) = (2e6f64, 0.9f64);
    let contact = format!(r#"{{ "law": "hertz", "stiffness": {stiffness:?} }}"#);
    let depth = (1.25 * v * v / stiffness).powf(0.4);
    for method in INTEGRATED {
        let result = Wall::rigid(&contact, v, 0.05).run(method);
        let own = pair(&result);
        let time = HERTZ_DURATION * depth / v;
        approx::assert_relative_eq!(own.switch_times[0], time, max_relative = 1e-7);
        let force = stiffness * depth.powf(1.5);
        approx::assert_relative_eq!(own.max_contact_force, force, max_relative = 1e-7);
        approx::assert_relative_eq!(own.max_indentation.unwrap(), depth, max_relative = 1e-7);
        approx::assert_relative_eq!(figures(&result).end.speed, v, max_relative = 1e-7);
        // Action is reaction: the wall is held with the force of the contact.
        let wall = &result.figures.objects["wall"];
        approx::assert_relative_eq!(wall.peak_reaction, own.max_contact_force);
    }
}

#[test]
fn hertz_in_series_with_an_undamped_link() {
    // One mass: at rest all energy is in contact and link.
    let (stiffness, v) = (30.0f64, 1.0);
    let contact = format!(r#"{{ "law": "hertz", "stiffness": {stiffness:?} }}"#);
    let energy = |q: f64| 0.4 * stiffness * q.powf(2.5) + 0.5 * (stiffness * q.powf(1.5)).powi(2);
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if energy(middle) < 0.5 * v * v {
            low = middle;
        } else {
            high = middle;
        }
    }
    for method in INTEGRATED {
        let result = Wall::rod(1, 0.0, &contact, 6.0).run(method);
        let own = pair(&result);
        approx::assert_relative_eq!(own.max_indentation.unwrap(), low, max_relative = 1e-7);
        let force = stiffness * low.powf(1.5);
        approx::assert_relative_eq!(own.max_contact_force, force, max_relative = 1e-7);
        approx::assert_relative_eq!(figures(&result).end.speed, v, max_relative = 1e-7);
    }
}

fn resting(contact: &str, body: &str) -> String {
    format!(
        r#"{{ "dam": 1, "name": "rest", "objects": {{
            "wall": {{ "kind": "drive", "coordinate": "sliding", "motion": {{ "fixed": 0 }} }},
            "body": {{ "kind": "slider", "input": "wall", "position": {{ "ratio": 1 }}, "inertia": 2,
                {body}, "pair": {{ "closure": "force", "contact": {contact} }},
                "loads": {{ "weight": {{ "constant": -20 }} }} }} }},
            "run": {{ "duration": 2, "start": "static", "tolerance": 1e-8 }} }}"#
    )
}

#[test]
fn a_body_at_rest_stays_at_rest() {
    let elastic = r#""stiffness": 1000, "damping_capacity": 0.5, "masses": 3"#;
    for (contact, depth) in [
        (r#"{ "stiffness": 500 }"#, 0.04),
        (
            r#"{ "law": "kelvin_voigt", "stiffness": 500, "damping": 3 }"#,
            0.04,
        ),
        (
            r#"{ "law": "hunt_crossley", "stiffness": 500, "dissipation": 0.3 }"#,
            0.04,
        ),
        (
            r#"{ "law": "hertz", "stiffness": 2500, "dissipation": 0.3 }"#,
            0.04,
        ),
    ] {
        for (body, further) in [(r#""masses": 0"#, 0.0), (elastic, 0.02)] {
            // (Of explicit methods stability alone limits the steps at rest: their noise is
            // no error of the balance.)
            for method in [
                Method::Rodas5p,
                Method::Radau,
                Method::Dopri5,
                Method::Dop853,
            ] {
                let result = run_text(&resting(contact, body), Some(method));
                let own = pair(&result);
                assert_eq!(own.separations, 0, "{contact} {body} {method:?}");
                let explicit = matches!(method, Method::Dopri5 | Method::Dop853);
                let within = if explicit { 1e-6 } else { 1e-7 };
                approx::assert_relative_eq!(
                    figures(&result).end.displacement,
                    -(depth + further),
                    max_relative = within
                );
                approx::assert_relative_eq!(own.max_contact_force, 20.0, max_relative = within);
            }
        }
    }
}

#[test]
fn a_rigid_body_on_a_contact_is_a_chain_of_one_mass() {
    let scene = |body: &str, pair: &str| {
        format!(
            r#"{{ "dam": 1, "name": "gap", "objects": {{
                "shaft": {{ "kind": "drive", "motion": {{ "speed": 30 }} }},
                "body": {{ "kind": "rocker", "input": "shaft",
                    "position": {{ "sine": {{ "amplitude": 0.2 }} }}, "inertia": 0.1, {body},
                    "pair": {{ {pair} }} }} }},
                "run": {{ "duration": 0.3, "start": "on_law", "tolerance": 1e-10 }} }}"#
        )
    };
    let contact = r#""contact": { "law": "kelvin_voigt", "stiffness": 1e5, "damping": 4 }"#;
    let plain = r#""stiffness": 1e5, "damping": 4, "masses": 1"#;
    for pair in [
        r#""closure": "bilateral""#,
        r#""closure": "form", "gap": 0.002"#,
    ] {
        for method in [Method::Exact, Method::Dop853, Method::Radau] {
            let own = run_text(
                &scene(r#""masses": 0"#, &format!("{pair}, {contact}")),
                Some(method),
            );
            let mut other = run_text(&scene(plain, pair), Some(method));
            let (own, other) = (&own.figures.objects["body"], {
                let other = other.figures.objects.get_mut("body").unwrap();
                if let Some(pair) = &mut other.pair {
                    assert!(pair.separations > 3, "{}", pair.separations);
                    pair.max_indentation = own.figures.objects["body"]
                        .pair
                        .as_ref()
                        .and_then(|pair| pair.max_indentation);
                }
                &*other
            });
            approx::assert_relative_eq!(own.delta_max, other.delta_max, max_relative = 1e-9);
            approx::assert_relative_eq!(
                own.peak_reaction,
                other.peak_reaction,
                max_relative = 1e-8
            );
            let switches = |one: &dam::record::ObjectFigures| {
                one.pair.as_ref().map(|pair| pair.switch_times.len())
            };
            assert_eq!(switches(own), switches(other));
        }
    }
}

#[test]
fn a_ball_of_given_radius_and_material() {
    // Hertz: (4/3)·E*·√R, E* = E/(2(1 − ν²)) between bodies of one material; on an arm the force
    // has the moment N·arm at p = arm·φ.
    let (v, radius, modulus) = (0.4f64, 0.01f64, 206e9);
    let stiffness = 4.0 / 3.0 * modulus / (2.0 * (1.0 - 0.09)) * radius.sqrt();
    let contact = format!(
        r#"{{ "law": "hertz", "from": {{ "point": {{ "radius": {radius:?}, "modulus": {modulus:?} }} }} }}"#
    );
    let result = Wall::rigid(&contact, v, 1e-3).run(Method::Radau);
    let depth = (1.25 * v * v / stiffness).powf(0.4);
    let force = stiffness * depth.powf(1.5);
    approx::assert_relative_eq!(pair(&result).max_contact_force, force, max_relative = 1e-6);
    let arm = 0.05f64;
    let turning = Wall::rigid(&contact, v, 2e-2)
        .text()
        .replace("\"slider\"", "\"rocker\"")
        .replace("\"coordinate\": \"sliding\", ", "")
        .replace("\"modulus\"", &format!("\"arm\": {arm:?}, \"modulus\""));
    let result = run_text(&turning, Some(Method::Radau));
    let stiffness = stiffness * arm.powf(2.5);
    let depth = (1.25 * v * v / stiffness).powf(0.4);
    let moment = stiffness * depth.powf(1.5);
    approx::assert_relative_eq!(pair(&result).max_contact_force, moment, max_relative = 1e-6);
}
