//! Corners of blocks that begin to press on the other side of their guides: kinks of
//! the friction, located, so that every method keeps its order.

use super::motions::Motor;
use super::reference::slider_crank;
use super::support::{figure, ran, read, run_of, scene_of};

const MOTOR: Motor = Motor {
    inertia: 0.02,
    torque: 4.0,
    angle: 0.0,
    speed: 6.0,
};

fn text() -> String {
    let objects = format!("{}, {}", MOTOR.text(), slider_crank(0.12));
    scene_of(&objects, r#""duration": 0.3, "start": "on_law""#)
}

/// The guide alone rubs, and the slide's centre lies beside it, so that it tips to and
/// fro.
const TIPPING: [&str; 6] = [
    "m.pairs.O.friction=0",
    "m.pairs.A.friction=0",
    "m.pairs.B.friction=0",
    "m.pairs.guide.friction=0.3",
    "m.pairs.guide.sliding.half_height=0",
    "m.links.slide.centre=[0.05, 0.06]",
];

/// A method of fixed steps keeps its order over kinks.
#[test]
fn the_order_is_kept_where_a_slide_tips() {
    let found = |method: &str, more: &str| {
        let asked = [&TIPPING[..], &[method, more]].concat();
        let found = ran(&read(&text(), &asked));
        figure(&found, "motor.final.displacement")
    };
    let exact = found("run.method=dop853", "run.tolerance=1e-13");
    let error = |step: f64| (found("run.method=rk4", &format!("run.step={step}")) - exact).abs();
    let errors = [4e-3, 2e-3, 1e-3].map(error);
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!(order > 3.3, "{errors:?}");
    }
}

/// Methods that know nothing of each other agree to fine tolerances.
#[test]
fn methods_agree_to_fine_tolerances_where_a_slide_tips() {
    let found = |method: &str| {
        let method = format!("run.method={method}");
        let asked = [&TIPPING[..], &[&method, "run.tolerance=1e-12"]].concat();
        let found = run_of(&text(), &asked);
        assert!(found.figures.run.energy_error < 1e-11);
        figure(&found, "motor.final.displacement")
    };
    let wanted = found("dop853");
    for method in ["radau", "rodas5p"] {
        approx::assert_abs_diff_eq!(found(method), wanted, epsilon = 3e-11);
    }
}
