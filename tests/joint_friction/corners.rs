//! Corners of blocks that begin to press on the other side of their guides: kinks of
//! the friction, located, so that every method keeps its order.

use crate::motions::Motor;
use crate::reference::slider_crank;
use crate::support::{figure, ran, read, run_of, scene_of};

const MOTOR: Motor = Motor {
    inertia: 0.02,
    torque: 4.0,
    angle: 0.0,
    speed: 6.0,
};

fn text(tolerance: f64, duration: f64) -> String {
    let objects = format!("{}, {}", MOTOR.text(), slider_crank(0.12));
    let run = format!(r#""duration": {duration}, "tolerance": {tolerance:e}, "start": "on_law""#);
    scene_of(&objects, &run)
}

/// A method of fixed steps keeps its order over kinks.
#[test]
fn the_order_is_kept_over_kinks() {
    let exact = run_of(&text(1e-12, 0.2), &["run.method=dop853"]);
    let error = |step: f64| {
        let step = format!("run.step={step}");
        let scene = read(&text(1e-6, 0.2), &["run.method=rk4", &step]);
        let found = ran(&scene);
        let name = "motor.final.displacement";
        (figure(&found, name) - figure(&exact, name)).abs()
    };
    let errors = [4e-3, 2e-3, 1e-3].map(error);
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!(order > 3.3, "{errors:?}");
    }
}
