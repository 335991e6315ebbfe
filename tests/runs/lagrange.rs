//! A rigid slider-crank on a motor against Lagrange's equation written and
//! integrated here, from nothing that `dam` uses.
//!
//! T = ½(J_m + J_c)φ̇² + ½ m ẋ², x = r cos φ + √(l² − (r sin φ − e)²), so with
//! J(φ) = J_m + J_c + m x′²:  J φ̈ + ½ J′ φ̇² = T(φ̇) + (P − b ẋ) x′.

use dam::lower::lower;
use dam::scene::{BuiltIn, Document, Overrides};
use dam::studies::run::run;
use dam::studies::{Control, RunSettings};
use dam::system::System;

const CRANK: f64 = 0.08;
const ROD: f64 = 0.3;
const OFFSET: f64 = 0.02;
const MOTOR: f64 = 0.05;
const DISC: f64 = 0.3;
const SLIDE: f64 = 12.0;
const PRESS: f64 = -150.0;
const VISCOUS: f64 = 40.0;
const STALL: f64 = 60.0;
const NO_LOAD: f64 = 50.0;

const SCENE: &str = r#"{
  "dam": 1,
  "name": "slider-crank on a motor",
  "objects": {
    "motor": { "kind": "drive", "motor": { "inertia": 0.05, "angle": 0.4, "speed": 3,
      "torque": { "linear": { "stall_torque": 60, "no_load_speed": 50 } } } },
    "disc": { "kind": "crank", "input": "motor", "position": { "ratio": 1 }, "masses": 0, "inertia": 0.3 },
    "slide": { "kind": "slider", "input": "disc", "masses": 0, "inertia": 12,
      "position": { "slider_crank": { "crank": 0.08, "rod": 0.3, "offset": 0.02 } },
      "loads": { "press": { "constant": -150 }, "guide": { "viscous": 40 } } }
  },
  "run": { "duration": 1, "tolerance": 1e-12, "method": "METHOD" }
}"#;

/// x′ and x″ by differentiating x above by hand.
fn transfer(phi: f64) -> (f64, f64) {
    let (sin, cos) = phi.sin_cos();
    let height = CRANK * sin - OFFSET;
    let root = (ROD * ROD - height * height).sqrt();
    let slope = CRANK * cos;
    let first = -CRANK * sin - height * slope / root;
    let second = -CRANK * cos
        - (slope * slope - height * CRANK * sin) / root
        - (height * slope).powi(2) / root.powi(3);
    (first, second)
}

fn acceleration(phi: f64, speed: f64) -> f64 {
    let (first, second) = transfer(phi);
    let inertia = MOTOR + DISC + SLIDE * first * first;
    let half_slope = SLIDE * first * second;
    let torque = STALL * (1.0 - speed / NO_LOAD);
    let load = (PRESS - VISCOUS * first * speed) * first;
    (torque + load - half_slope * speed * speed) / inertia
}

/// Classical Runge–Kutta with a step so small that halving it changes nothing
/// to eleven digits.
fn integrate(steps: usize) -> (f64, f64) {
    let step = 1.0 / steps as f64;
    let (mut phi, mut speed) = (0.4, 3.0);
    for _ in 0..steps {
        let (k1, l1) = (speed, acceleration(phi, speed));
        let (p, v) = (phi + 0.5 * step * k1, speed + 0.5 * step * l1);
        let (k2, l2) = (v, acceleration(p, v));
        let (p, v) = (phi + 0.5 * step * k2, speed + 0.5 * step * l2);
        let (k3, l3) = (v, acceleration(p, v));
        let (p, v) = (phi + step * k3, speed + step * l3);
        let (k4, l4) = (v, acceleration(p, v));
        phi += step / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
        speed += step / 6.0 * (l1 + 2.0 * (l2 + l3) + l4);
    }
    (phi, speed)
}

fn dam(method: &str) -> (f64, f64, f64) {
    let text = SCENE.replace("METHOD", method);
    let document = Document::parse("scene", text.as_bytes()).unwrap();
    let reading = document.scene(&BuiltIn, &Overrides::none()).unwrap();
    let system = System::new(lower(&reading.scene).unwrap()).unwrap();
    let settings = RunSettings::of(&reading.scene).unwrap();
    let result = run(&system, &settings, &Control::default(), &mut []).unwrap();
    let motor = &result.figures.objects["motor"];
    let audit = result.figures.run.energy_error;
    (motor.end.displacement, motor.end.speed, audit)
}

#[test]
fn a_rigid_slider_crank_on_a_motor_moves_as_lagrange_says() {
    let (phi, speed) = integrate(40_000);
    let (coarse, _) = integrate(20_000);
    assert!((phi - coarse).abs() < 1e-10 * phi, "the reference stands");
    for method in ["dop853", "dopri5"] {
        let (found, found_speed, audit) = dam(method);
        approx::assert_relative_eq!(found, phi, max_relative = 1e-9);
        approx::assert_relative_eq!(found_speed, speed, max_relative = 1e-9);
        assert!(audit < 1e-9, "{method}: energy error {audit:e}");
    }
}
