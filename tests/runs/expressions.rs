//! Loads, torques and motions by expressions: against the built-in laws, closed forms and
//! each other's methods; mistakes with their place.

use approx::{assert_abs_diff_eq, assert_relative_eq};
use dam::integrate::Method;
use dam::prelude::*;
use dam::scene::{BuiltIn, Document, Overrides};

fn run(text: &str) -> RunResult {
    let scene = Scene::from_json(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    scene
        .run()
        .unwrap_or_else(|error| panic!("{text}: {error}"))
}

/// A lever of two masses behind a crank on a motor, with a load on it.
fn lever(load: &str, method: &str) -> String {
    format!(
        r#"{{ "dam": 1, "name": "lever", "objects": {{
            "motor": {{ "kind": "drive", "motor": {{ "inertia": 0.5, "speed": 30, "torque": {{ "constant": 5 }} }} }},
            "lever": {{ "kind": "rocker", "input": "motor", "position": {{ "sine": {{ "amplitude": 0.4 }} }},
                "inertia": 0.02, "stiffness": 4000, "damping_capacity": 0.2, "masses": 2,
                "loads": {{ "own": {load} }} }} }},
            "run": {{ "duration": 0.4, "tolerance": 1e-9, "method": "{method}" }} }}"#
    )
}

fn figures(text: &str) -> [f64; 4] {
    let run = run(text);
    assert!(run.is_complete(), "{text}");
    [
        "motor.final.displacement",
        "motor.final.speed",
        "lever.final.displacement",
        "lever.delta_max",
    ]
    .map(|figure| run.figures.value(figure).unwrap())
}

/// Laws of the library and the same written out.
const ALIKE: [(&str, &str); 9] = [
    (r#"{ "constant": 7 }"#, r#"{ "expression": "3.5*2" }"#),
    (
        r#"{ "spring": { "rate": 40, "preload": 3 } }"#,
        r#"{ "expression": "-3 - 40*phi" }"#,
    ),
    (
        r#"{ "viscous": 0.6 }"#,
        r#"{ "expression": "-0.6*phi_dot" }"#,
    ),
    (
        r#"{ "friction": { "force": 4, "width": 0.7 } }"#,
        r#"{ "expression": "-4*tanh(phi_dot/0.7)" }"#,
    ),
    (
        r#"{ "time_table": [[0, 0], [0.1, 6], [0.25, -4]] }"#,
        r#"{ "expression": "t < 0.1 ? 60*t : t < 0.25 ? 6 - (t - 0.1)*200/3 : -4" }"#,
    ),
    (
        r#"{ "window": { "from": "30 deg", "to": "80 deg", "force": "9 N m" } }"#,
        r#"{ "expression": "driver_phi % (2*pi) > pi/6 && driver_phi % (2*pi) < 4*pi/9 ? 9 : 0" }"#,
    ),
    (
        r#"{ "position_table": { "points": [[0, 0], [1, 5], [2, -3]], "period": 4 } }"#,
        r#"{ "expression": "driver_phi % 4 < 1 ? 5*(driver_phi % 4) : driver_phi % 4 < 2 ? 5 - 8*(driver_phi % 4 - 1) : -3 + 1.5*(driver_phi % 4 - 2)" }"#,
    ),
    (
        r#"{ "harmonic": { "amplitude": "0.006 kN m", "frequency": "11 Hz", "phase": "40 deg", "mean": 2 } }"#,
        r#"{ "expression": "0.002 + 0.006*sin(2*pi*11*t + pi*40/180)", "unit": "kN m" }"#,
    ),
    (
        r#"{ "harmonic": { "amplitude": 6, "order": 3 } }"#,
        r#"{ "expression": "6*sin(3*driver_phi)" }"#,
    ),
];

#[test]
fn an_expression_is_the_load_that_it_says() {
    for (built_in, written) in ALIKE {
        for method in ["taylor", "dop853", "radau", "rodas5p"] {
            let pairs = [built_in, written].map(|load| figures(&lever(load, method)));
            for (own, wanted) in pairs[1].iter().zip(pairs[0]) {
                assert_relative_eq!(*own, wanted, max_relative = 2e-7, epsilon = 1e-8);
            }
        }
    }
}

#[test]
fn every_jump_and_kink_is_located() {
    // A free rotor, J = 2: pieces of constant torque in closed form.
    let rotor = |torque: &str, method: &str, tolerance: f64| {
        let text = format!(
            r#"{{ "dam": 1, "name": "rotor", "objects": {{ "rotor": {{ "kind": "drive",
                "motor": {{ "inertia": 2, "speed": 1, "torque": {{ "expression": "{torque}" }} }} }} }},
                "run": {{ "duration": 3, "tolerance": {tolerance}, "method": "{method}" }} }}"#
        );
        let run = run(&text);
        assert!(run.is_complete(), "{torque}");
        ["rotor.final.displacement", "rotor.final.speed"]
            .map(|figure| run.figures.value(figure).unwrap())
    };
    for method in ["taylor", "dopri5", "dop853", "radau", "rodas5p"] {
        // 4 N m for a millisecond: a step over it would miss all of it.
        let [angle, speed] = rotor("abs(t - 1.2) < 0.0005 ? 4000 : 0", method, 1e-6);
        assert_relative_eq!(speed, 3.0, max_relative = 1e-9);
        // (1 for 1.1995, from 1 to 3 within 0.001, then 3.)
        assert_relative_eq!(angle, 1.1995 + 0.002 + 3.0 * 1.7995, max_relative = 1e-9);
        // Steps of the time: 2·(0 + 1 + 2 + 3 + 4 + 5)/2 over half seconds.
        let [_, speed] = rotor("2*floor(2*t)", method, 1e-6);
        assert_relative_eq!(speed, 1.0 + 0.5 * 15.0, max_relative = 1e-9);
        // A push while the angle is within two edges that are close together.
        let [_, speed] = rotor("max(0, 1 - 1e5*(phi - 2)^2) > 0 ? 3 : 0", method, 1e-6);
        // v² grows by 2·(3/2)·width.
        let width = 2.0 / 1e5f64.sqrt();
        assert_relative_eq!(speed, (1.0 + 3.0 * width).sqrt(), max_relative = 1e-9);
    }
}

/// A load that begins where its condition is zero with its rate: what it does just behind
/// does not depend on the unit of time.
#[test]
fn conditions_that_begin_at_zero_know_no_unit_of_time() {
    for unit in [1e-8, 1e-4, 1.0, 1e3] {
        // A rotor, J = 2, that turns at 1 rad per unit, and 10 N m·s² per unit squared.
        let (half, push) = (0.5 * unit, 10.0 / (unit * unit));
        for (condition, speed) in [
            // On for half a unit.
            (format!("t*t*({half:e} - t) > 0"), 1.0 + 0.5 * 5.0),
            (format!("t^3*({half:e} - t) > 0"), 1.0 + 0.5 * 5.0),
            // Always on.
            ("1 - cos(phi) > 0".to_owned(), 1.0 + 5.0),
            ("phi - sin(phi) > 0".to_owned(), 1.0 + 5.0),
            // Never.
            ("cos(phi) > 1".to_owned(), 1.0),
        ] {
            for method in ["dop853", "radau", "taylor"] {
                let text = format!(
                    r#"{{ "dam": 1, "name": "rotor", "objects": {{ "rotor": {{ "kind": "drive",
                        "motor": {{ "inertia": 2, "speed": {:e},
                            "torque": {{ "expression": "{condition} ? {push:e} : 0" }} }} }} }},
                        "run": {{ "duration": {unit:e}, "tolerance": 1e-9, "method": "{method}" }} }}"#,
                    1.0 / unit
                );
                let run = run(&text);
                assert!(run.is_complete(), "{text}");
                let found = run.figures.value("rotor.final.speed").unwrap() * unit;
                assert_relative_eq!(found, speed, max_relative = 1e-10);
            }
        }
    }
}

#[test]
fn a_jump_that_holds_the_motion_is_told() {
    let text = r#"{ "dam": 1, "name": "x", "objects": { "rotor": { "kind": "drive",
        "motor": { "inertia": 1, "speed": 3, "torque": { "expression": "-0.5*sign(phi_dot)" } } } },
        "run": { "duration": 10 } }"#;
    let run = run(text);
    assert!(!run.is_complete());
    assert_abs_diff_eq!(run.outcome.time, 6.0, epsilon = 1e-6);
    let told = format!("{:?}", run.outcome);
    assert!(
        told.contains("held_at_jump") && told.contains("friction"),
        "{told}"
    );
}

#[test]
fn sinusoids_polynomials_and_pieces_of_time_stay_exact() {
    let scene = |load: &str, method: &str| {
        format!(
            r#"{{ "dam": 1, "name": "x", "objects": {{
                "drive": {{ "kind": "drive", "motion": {{ "speed": 12 }} }},
                "lever": {{ "kind": "shaft", "input": "drive", "inertia": 0.02, "stiffness": 800,
                    "damping_capacity": 0.3, "masses": 3, "loads": {{ "own": {{ "expression": "{load}" }} }} }} }},
                "run": {{ "duration": 0.5, "tolerance": 1e-11, "method": "{method}" }} }}"#
        )
    };
    for load in [
        "12*sin(2*pi*25*t)",
        "3 + 20*t - 90*t^2 + 15*t^3",
        "5*exp(-8*t)*cos(60*t) - 30*phi - 0.04*phi_dot",
        "t < 0.2 ? 100*t : 4*abs(sin(30*t))",
        "6*sin(driver_phi)^2 + driver_phi_dot/12",
        "2*floor(10*t) - 8*fract(4*t)",
    ] {
        let own = run(&scene(load, "auto"));
        assert_eq!(own.method, Method::Exact, "{load}");
        let other = run(&scene(load, "dop853"));
        for figure in ["lever.delta_max", "lever.delta_min", "lever.final.speed"] {
            let [own, other] = [&own, &other].map(|run| run.figures.value(figure).unwrap());
            assert_abs_diff_eq!(own, other, epsilon = 1e-9);
        }
        // The samples, too: but for those on a jump.
        let column = |run: &RunResult| {
            let mut columns = run.record.columns.iter();
            let is_own = |column: &&dam::record::Column| {
                column.object == "lever" && column.quantity == Quantity::Acceleration
            };
            columns.find(is_own).unwrap().values.clone()
        };
        let (own, other) = (column(&own), column(&other));
        let greatest = other
            .iter()
            .fold(1.0, |most: f64, value| most.max(value.abs()));
        let pairs = own.iter().zip(&other);
        let off = pairs.filter(|(own, other)| (*own - *other).abs() > 1e-6 * greatest);
        assert!(off.count() <= 8, "{load}");
    }
}

#[test]
fn a_load_looks_at_any_object() {
    // Two rotors, the second pulled towards the first: the same as a spring between them.
    let text = r#"{ "dam": 1, "name": "x", "objects": {
        "z": { "kind": "drive", "motor": { "inertia": 1, "torque": { "expression": "-3*(phi - over_phi)", "over": "a" } } },
        "a": { "kind": "drive", "motor": { "inertia": 2, "angle": 0.5, "torque": { "constant": 0 } },
            "loads": { "pull": { "expression": "-3*(phi - over_phi)", "over": "z" } } } },
        "run": { "duration": 4, "tolerance": 1e-11 } }"#;
    let run = run(text);
    // The difference swings with ω² = 3·(1/1 + 1/2), the centre of mass rests.
    let swing = 0.5 * (4.5f64.sqrt() * 4.0).cos();
    let [a, z] = ["a", "z"].map(|id| {
        run.figures
            .value(&format!("{id}.final.displacement"))
            .unwrap()
    });
    assert_abs_diff_eq!(a - z, swing, epsilon = 1e-9);
    assert_abs_diff_eq!(2.0 * a + z, 1.0, epsilon = 1e-9);
    let wrong = text.replace("\"over\": \"a\"", "\"over\": \"b\"");
    let error = Scene::from_json(&wrong)
        .and_then(|scene| scene.run())
        .unwrap_err();
    assert!(error.to_string().contains("unknown object `b`"), "{error}");
}

#[test]
fn a_motion_by_an_expression_has_its_derivatives_and_no_jumps() {
    let text = |motion: &str| {
        format!(
            r#"{{ "dam": 1, "name": "x", "objects": {{
                "feed": {{ "kind": "drive", "motion": {{ "expression": "{motion}", "unit": "deg" }} }},
                "load": {{ "kind": "shaft", "input": "feed", "masses": 0, "inertia": 0.1 }} }},
                "run": {{ "duration": 0.3, "tolerance": 1e-9 }} }}"#
        )
    };
    let run = run(&text("90*sin(2*pi*2*t)*exp(-t) + t"));
    let (w, one) = (4.0 * std::f64::consts::PI, 1f64.to_radians());
    let (sin, cos, fall) = ((0.3 * w).sin(), (0.3 * w).cos(), (-0.3f64).exp());
    let speed = one * (90.0 * fall * (w * cos - sin) + 1.0);
    assert_relative_eq!(
        run.figures.value("load.final.speed").unwrap(),
        speed,
        max_relative = 1e-12
    );
    // φ̈ at t = 0: −2·90·w.
    let acceleration = run.acceleration("load").unwrap()[0];
    assert_relative_eq!(acceleration, -one * 180.0 * w, max_relative = 1e-12);
    for (motion, word) in [
        ("t < 0.1 ? 0 : 5", "displacement jumps at t = 0.1"),
        ("abs(t - 0.2)", "speed jumps at t = 0.2"),
        ("sqrt(t)", "no finite value, speed"),
        ("t + phi", "`phi` is not known"),
    ] {
        let scene = Scene::from_json(&text(motion)).and_then(|scene| scene.run());
        let error = scene.unwrap_err().to_string();
        assert!(error.contains(word), "{motion}: {error}");
    }
}

/// A small generator with a fixed seed (xorshift64*).
struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 16) as usize % bound.max(1)
    }

    fn one<'t>(&mut self, of: &[&'t str]) -> &'t str {
        of[self.below(of.len())]
    }
}

/// Expressions that are read, to be mutated.
const SEEDS: [&str; 8] = [
    "120*sin(2*pi*5*t) + 3*phi^2 - phi_dot/2",
    "t < 0.2 ? 100*t : 4*abs(sin(30*t)) - max(phi, driver_phi)",
    "2*floor(10*t) - 8*fract(4*t) + atan2(phi, 1 + t^2)*sign(phi_dot)",
    "exp(-t)*sqrt(1 + phi^2)*tanh(phi_dot/0.01) - ln(2 + cos(driver_phi))",
    "(t % 0.2 > 0.1 && phi > -1 || !(t < 3)) ? 2^phi : -(1e-3 + .5E2*t)",
    "min(1, max(-1, 5*(phi - 0.1)))*φ̇ + round(3*φ) - π*τ/e",
    "phi/(0.3 + phi*phi) - cbrt(phi)*asin(phi/4) + log10(3 + t)*cosh(t/9)",
    "((t)) - (phi + (phi_dot*(2 - driver_phi_dot)))^3",
];

const PARTS: [&str; 34] = [
    "+",
    "-",
    "*",
    "/",
    "%",
    "^",
    "(",
    ")",
    "?",
    ":",
    "<",
    ">=",
    "==",
    "&&",
    "||",
    "!",
    ",",
    "t",
    "phi",
    "phi_dot",
    "driver_phi",
    "sin(",
    "abs(",
    "floor(",
    "1",
    "0",
    "1e308",
    "-",
    "..",
    "e5",
    "φ̇",
    "if",
    "\u{2028}",
    "x",
];

fn mutated(random: &mut Random) -> String {
    let mut letters: Vec<char> = random.one(&SEEDS).chars().collect();
    if random.below(2) == 0 {
        // Another digit, another operator: mostly an expression again.
        for _ in 0..1 + random.below(3) {
            let alike = [
                ['1', '7', '0', '3'],
                ['+', '-', '*', '/'],
                ['<', '>', '<', '>'],
            ];
            let at = random.below(letters.len());
            let found = alike.iter().find(|some| some.contains(&letters[at]));
            if let Some(found) = found {
                letters[at] = found[random.below(4)];
            }
        }
        return letters.into_iter().collect();
    }
    for _ in 0..1 + random.below(3) {
        let at = random.below(letters.len() + 1);
        match random.below(4) {
            0 if at < letters.len() => {
                letters.remove(at);
            }
            1 if at < letters.len() => {
                let from = random.below(letters.len());
                letters[at] = letters[from];
            }
            _ => {
                let part: Vec<char> = random.one(&PARTS).chars().collect();
                letters.splice(at..at, part);
            }
        }
    }
    letters.into_iter().collect()
}

/// Expressions of the test below; `DAM_EXPRESSIONS=10000` asks for all of them.
fn expressions() -> usize {
    let asked = std::env::var("DAM_EXPRESSIONS").ok();
    asked.map_or(300, |asked| asked.parse().expect("a number of expressions"))
}

#[test]
fn mutated_expressions_give_an_answer_or_a_fault_with_its_place() {
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    let none = Overrides::none();
    let (mut answers, mut faults) = (0, 0);
    let count = expressions();
    for _ in 0..count {
        let expression = mutated(&mut random);
        let scene = serde_json::json!({ "dam": 1, "name": "x", "objects": {
            "drive": { "kind": "drive", "motion": { "speed": 3 } },
            "lever": { "kind": "shaft", "input": "drive", "inertia": 1, "stiffness": 100, "masses": 1,
                "loads": { "own": { "expression": expression } } } },
            "run": { "duration": 0.3, "tolerance": 1e-4, "start": "on_law" } });
        let text = scene.to_string();
        let document = Document::parse("x.json", text.as_bytes()).expect("a text");
        match document.scene(&BuiltIn, &none) {
            Err(told) => {
                faults += 1;
                for fault in told.items.iter() {
                    assert!(fault.place.is_some(), "{expression}: {fault:?}");
                    assert!(
                        fault.path.starts_with("lever.loads.own"),
                        "{expression}: {fault:?}"
                    );
                }
            }
            Ok(_) => {
                // Numbers, or a reason: nothing that is not a number passes silently.
                match Scene::from_json(&text).and_then(|scene| scene.run()) {
                    Ok(run) => {
                        let end = run.figures.value("lever.final.displacement");
                        let sound = !run.is_complete() || end.is_ok_and(f64::is_finite);
                        assert!(sound, "{expression}");
                    }
                    Err(error) => assert!(!error.faults().is_empty(), "{expression}"),
                }
                answers += 1;
            }
        }
    }
    assert!(
        answers > count / 10 && faults > count / 10,
        "{answers} {faults}"
    );
}
