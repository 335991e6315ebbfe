//! How much of an elastic object is modelled: chains whose inertia is put at the far ends of
//! their cells or balanced, vibration modes. Held against closed forms of the continuum and
//! against models that say the same in another way.

use approx::assert_relative_eq;
use dam::prelude::*;

/// A scene of one elastic object behind a drive that turns with a speed of 1.
fn scene(object: &str, run: &str) -> Scene {
    let text = format!(
        r#"{{ "dam": 1, "name": "Levels", "objects": {{
            "drive": {{ "kind": "drive", "motion": {{ "speed": 0.1 }} }},
            "one": {{ "input": "drive", {object} }} }}, "run": {{ {run} }} }}"#
    );
    Scene::from_json(&text).expect("a scene")
}

fn delta_abs(scene: &Scene) -> f64 {
    let run = scene.run().expect("a run");
    run.figures("one").expect("figures").delta_abs
}

/// Greatest |δ|/lift of a rod in its rise by the cycloidal law, its duration so many times
/// the period T₁ = 4·√(J/c) of the first mode: tip = 2·Σ(−1)^k·y(t − 2k − 1).
const RISES: [(f64, f64); 4] = [
    (2.0, 0.086321289979),
    (3.3, 0.026035043926),
    (5.3, 0.008355383138),
    (10.3, 0.002048951099),
];

fn rise(ratio: f64, level: &str, run: &str) -> f64 {
    let duration = 4.0 * ratio;
    let angle = 0.1 * duration;
    let object = format!(
        r#""kind": "slider", "position": {{ "cam": {{
            "lift": 1, "rise": {angle}, "return": 1, "law": "cycloidal" }} }},
            "inertia": 1, "stiffness": 1, {level}"#
    );
    let run = format!(r#""duration": {duration}, "start": "on_law", "samples": 10 {run}"#);
    delta_abs(&scene(&object, &run))
}

/// Logarithm to base 2 of how much smaller an error becomes.
fn order(coarse: f64, fine: f64) -> f64 {
    (coarse / fine).abs().log2()
}

#[test]
fn the_deviation_of_a_rise_settles_on_that_of_the_continuum_in_the_order_of_its_level() {
    for (ratio, exact) in RISES {
        let error = |level: &str| rise(ratio, level, "") / exact - 1.0;
        let masses =
            |lumping: &str, n: u32| error(&format!(r#""masses": {n}, "lumping": "{lumping}""#));
        // Far ends: first order. Balanced: second.
        let [coarse, fine] = [64, 128].map(|n| masses("ends", n));
        let found = order(coarse, fine);
        assert!(
            (0.8..1.2).contains(&found),
            "ends at {ratio}: {coarse} {fine}"
        );
        let [coarse, fine] = [64, 128].map(|n| masses("balanced", n));
        let found = order(coarse, fine);
        assert!(
            (1.7..2.3).contains(&found),
            "balanced at {ratio}: {coarse} {fine}"
        );
        // At the same cost, that much nearer.
        assert!(fine.abs() < 0.1 * masses("ends", 128).abs());
        // Modes with what the others give way by.
        let modes = |m: u32| error(&format!(r#""modes": {m}"#)).abs();
        let [one, four] = [1, 4].map(modes);
        assert!(
            one < 3.2e-3 && four < 7.5e-5,
            "modes at {ratio}: {one} {four}"
        );
    }
}

#[test]
fn every_method_finds_the_same_of_modes() {
    let level = r#""modes": 3, "damping_capacity": 0.2"#;
    let exact = rise(5.3, level, r#", "method": "exact""#);
    for method in ["taylor", "radau", "rodas5p", "dop853"] {
        let run = format!(r#", "method": "{method}", "tolerance": 1e-11"#);
        assert_relative_eq!(rise(5.3, level, &run), exact, max_relative = 1e-7);
    }
}

/// Levels of an object without vibrations: start and motion are quasi-static.
#[test]
fn balanced_chains_and_modes_give_way_to_a_steady_acceleration_as_the_continuum() {
    // U = 3·φ² with φ̇ = 0.1: Ü = 0.06.
    for (kind, beta) in [("slider", 0.5), ("rocker", 0.75)] {
        for level in [
            r#""masses": 1, "lumping": "balanced""#,
            r#""masses": 2, "lumping": "balanced""#,
            r#""masses": 7, "lumping": "balanced""#,
            r#""modes": 1"#,
            r#""modes": 3"#,
        ] {
            let position = r#""position": { "polynomial": { "coefficients": [0, 0, 3] } }"#;
            let object =
                format!(r#""kind": "{kind}", {position}, "inertia": 2, "stiffness": 50, {level}"#);
            let run = scene(&object, r#""duration": 3, "samples": 10"#)
                .run()
                .expect("a run");
            let figures = run.figures("one").expect("figures");
            let expected = -beta * 2.0 * 0.06 / 50.0;
            assert_relative_eq!(figures.delta_max, expected, max_relative = 1e-9);
            assert_relative_eq!(figures.delta_min, expected, max_relative = 1e-9);
            assert_relative_eq!(figures.sigma, -expected, max_relative = 1e-9);
            // The whole inertia pulls at the law, and at the drive.
            assert_relative_eq!(figures.peak_reaction, 0.12, max_relative = 1e-9);
            let drive = run.figures("drive").expect("figures");
            // F·U′ at the end, φ = 0.3: U′ = 1.8.
            assert_relative_eq!(drive.peak_reaction, 0.12 * 1.8, max_relative = 1e-9);
        }
    }
}

/// Behind a motor, so that what lies at the driven end turns it with U′² and its bias.
#[test]
fn a_balanced_chain_is_a_list_of_masses_beside_a_rigid_share() {
    let common = r#""motor": { "kind": "drive", "motor": { "inertia": 0.5, "speed": 3,
        "torque": { "constant": 2 } } }"#;
    let place = r#""input": "motor", "position": { "sine": { "amplitude": 0.8 } }"#;
    let run = r#""run": { "duration": 3, "tolerance": 1e-10, "samples": 20 }"#;
    let balanced = format!(
        r#"{{ "dam": 1, "name": "Balanced", "objects": {{ {common},
            "one": {{ "kind": "rocker", {place}, "inertia": 0.8, "stiffness": 900,
                "damping_capacity": 0.3, "masses": 2, "lumping": "balanced" }} }}, {run} }}"#
    );
    // Shares of a lever in two cells: ¼/8 at the driven end, 3.5/8, 4.25/8.
    let delay = 0.3 / (std::f64::consts::TAU * (900f64 / 0.8).sqrt());
    let damping = 1800.0 * delay;
    let [end, first, last] = [0.25, 3.5, 4.25].map(|share| share * 0.1);
    let written_out = format!(
        r#"{{ "dam": 1, "name": "Written out", "objects": {{ {common},
            "one": {{ "kind": "rocker", {place}, "inertias": [{first}, {last}],
                "stiffnesses": [1800, 1800], "dampings": [{damping}, {damping}] }},
            "end": {{ "kind": "rocker", {place}, "inertia": {end}, "masses": 0 }} }}, {run} }}"#
    );
    let run = |text: &str| {
        Scene::from_json(text)
            .expect("a scene")
            .run()
            .expect("a run")
    };
    let (balanced, written_out) = (run(&balanced), run(&written_out));
    let figures = |run: &'_ RunResult, id: &str| run.figures(id).expect("figures").clone();
    let [one, other] = [&balanced, &written_out].map(|run| figures(run, "one"));
    for (found, expected) in [
        (one.delta_max, other.delta_max),
        (one.delta_min, other.delta_min),
        (one.sigma, other.sigma),
        (one.peak_speed, other.peak_speed),
        (one.peak_acceleration, other.peak_acceleration),
        (one.end.displacement, other.end.displacement),
    ] {
        assert_relative_eq!(found, expected, max_relative = 1e-7);
    }
    let [one, other] = [&balanced, &written_out].map(|run| figures(run, "motor").end.speed);
    assert_relative_eq!(one, other, max_relative = 1e-8);
    let [one, other] = [
        figures(&balanced, "one.driven_end").peak_reaction,
        figures(&written_out, "end").peak_reaction,
    ];
    assert_relative_eq!(one, other, max_relative = 1e-7);
}

/// The output's deviation under a harmonic base, over a whole period of the response that
/// starts on it: A·(1/cos z − 1) of a rod, z = ω·√(J/c).
#[test]
fn modes_answer_a_harmonic_base_as_the_continuum() {
    // By the start at rest the free vibrations come in; they die out.
    let response = |kind: &str, frequency: f64, level: &str| {
        let harmonic = 10.0 * frequency;
        let object = format!(
            r#""kind": "{kind}", "position": {{ "sine": {{ "amplitude": 1, "harmonic": {harmonic} }} }},
                "inertia": 1, "stiffness": 1, "damping_capacity": 0.02, {level}"#
        );
        let run = r#""duration": 3000, "samples": 100000"#;
        let run = scene(&object, run).run().expect("a run");
        let delta = run.delta("one").expect("samples");
        delta[delta.len() - 1500..]
            .iter()
            .fold(0.0f64, |most, delta| most.max(delta.abs()))
    };
    for (kind, at_half) in [("slider", 0.139493927), ("rocker", 0.2255032639)] {
        for (level, within) in [(r#""modes": 1"#, 3e-3), (r#""modes": 4"#, 3e-4)] {
            let found = response(kind, 0.5, level);
            assert_relative_eq!(found, at_half, max_relative = within);
        }
        let [coarse, fine] = [4, 8].map(|n| {
            response(
                kind,
                0.5,
                &format!(r#""masses": {n}, "lumping": "balanced""#),
            ) - at_half
        });
        assert!(fine.abs() < 0.4 * coarse.abs(), "{kind}: {coarse} {fine}");
    }
}

/// How far a shaft on a motor, of so many modes or masses and in such a pair, and what hangs
/// on it deviate, and how fast that is.
pub(crate) fn shaft_with_follower(level: &str, pair: &str, follower: &str) -> [f64; 3] {
    let text = format!(
        r#"{{ "dam": 1, "name": "Follower", "objects": {{
            "motor": {{ "kind": "drive", "motor": {{ "inertia": 1, "speed": 4,
                "torque": {{ "linear": {{ "stall_torque": 9, "no_load_speed": 8 }} }} }} }},
            "one": {{ "kind": "shaft", "input": "motor", "position": {{ "ratio": 1 }},
                "inertia": 0.4, "stiffness": 300, "damping_capacity": 0.4, {level}, "pair": {{ {pair} }},
                "loads": {{ "brake": {{ "viscous": 0.3 }} }} }},
            "slide": {{ "kind": "slider", "input": "one", "position": {{ "sine": {{ "amplitude": 0.3 }} }},
                "inertia": 2, {follower} }} }},
            "run": {{ "duration": 3, "tolerance": 1e-9, "samples": 20 }} }}"#
    );
    let scene = Scene::from_json(&text).expect("a scene");
    let run = scene.run().expect("a run");
    assert!(run.is_trusted(), "{:?} {text}", run.warnings);
    let error = run.audit.error();
    assert!(error < 1e-6, "{level}: {error}");
    let of = |id: &str| run.figures(id).expect("figures");
    [
        of("one").delta_abs,
        of("slide").delta_abs,
        of("slide").peak_speed,
    ]
}

/// Modes behind such a pair come to a long chain, with what hangs on them.
pub(crate) fn modes_carry_followers(pair: &str) {
    for follower in [
        r#""stiffness": 4000, "damping_capacity": 0.4"#,
        r#""masses": 0"#,
    ] {
        let deviations = |level: &str| shaft_with_follower(level, pair, follower);
        let long = deviations(r#""masses": 64, "lumping": "balanced""#);
        for (level, within) in [(r#""modes": 1"#, 1e-2), (r#""modes": 3"#, 1e-3)] {
            for (found, expected) in deviations(level).into_iter().zip(long) {
                assert_relative_eq!(found, expected, max_relative = within);
            }
        }
    }
}

#[test]
fn what_hangs_on_an_object_of_modes_moves_as_behind_a_long_chain() {
    modes_carry_followers(r#""closure": "bilateral""#);
}

#[test]
fn the_closed_rocker_deviates_as_the_continuum_with_two_modes() {
    // Limit of long chains: −5.349·10⁻⁵ rad.
    let text = |level: &str| {
        format!(
            r#"{{ "dam": 1, "name": "Closed", "objects": {{
                "shaft": {{ "kind": "drive", "motion": {{ "speed": "10 rev/s" }} }},
                "one": {{ "kind": "rocker", "input": "shaft", "position": {{ "sine": {{ "amplitude": "90 deg" }} }},
                    "inertia": 0.1, "stiffness": 1e7, "damping_capacity": 0.4, {level},
                    "loads": {{ "closing": {{ "constant": "-1 kN m" }} }} }} }},
                "run": {{ "duration": 0.2, "start": "static" }} }}"#
        )
    };
    let delta_max = |level: &str| {
        let run = Scene::from_json(&text(level))
            .expect("a scene")
            .run()
            .expect("a run");
        run.figures("one").expect("figures").delta_max
    };
    for level in [
        r#""modes": 1"#,
        r#""modes": 2"#,
        r#""masses": 2, "lumping": "balanced""#,
    ] {
        assert_relative_eq!(delta_max(level), -5.349e-5, max_relative = 1e-2);
    }
}

#[test]
fn what_has_no_such_level_is_refused_by_name() {
    let refused = |object: &str, words: &[&str]| {
        let text = format!(
            r#"{{ "dam": 1, "name": "Refused", "objects": {{
                "drive": {{ "kind": "drive", "motion": {{ "speed": 1 }} }},
                "one": {{ "kind": "rocker", "input": "drive", "position": {{ "sine": {{ "amplitude": 1 }} }},
                    {object} }} }}, "run": {{ "duration": 1 }} }}"#
        );
        let error = Scene::from_json(&text).and_then(|scene| scene.run().map(|_| ()));
        let error = error.expect_err(object).to_string();
        for word in words {
            assert!(error.contains(word), "{word} in\n{error}");
        }
    };
    let body = r#""inertia": 1, "stiffness": 1"#;
    for (level, closure, words) in [
        (r#""lumping": "balanced""#, "force", "cannot separate"),
        (r#""lumping": "balanced""#, "form", "cannot separate"),
        // Behind a closing force they hold as long as the pair stays closed.
        (r#""modes": 2"#, "form", "stays closed"),
        (r#""flexibility": "static""#, "form", "stays closed"),
    ] {
        let object = format!(r#"{body}, {level}, "pair": {{ "closure": "{closure}" }}"#);
        refused(&object, &[words, "bilateral"]);
    }
    let lists = r#""inertias": [1, 2], "stiffnesses": [3, 4]"#;
    refused(
        &format!(r#"{lists}, "lumping": "balanced""#),
        &["`inertias`", "`lumping`"],
    );
    refused(
        &format!(r#"{lists}, "modes": 2"#),
        &["`inertias`", "`modes`"],
    );
    refused(
        &format!(r#"{body}, "split": [0.5, 0.5], "lumping": "balanced""#),
        &["`split`"],
    );
    refused(
        &format!(r#"{body}, "split": [0.5, 0.5], "modes": 1"#),
        &["uniform"],
    );
    refused(
        &format!(r#"{body}, "masses": 2, "modes": 1"#),
        &["`masses`", "`modes`"],
    );
    let load = r#""loads": { "tool": { "mass": 1, "constant": 3 } }"#;
    refused(
        &format!(r#"{body}, "modes": 1, {load}"#),
        &["tool", "single masses"],
    );
}
