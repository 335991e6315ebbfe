//! Corners of blocks that begin to press on the other side of their guides: kinks of
//! the friction, located, so that every method keeps its order.

use crate::motions::{Motor, reference};
use crate::reference::slider_crank;
use crate::support::{figure, linkage_of, read, run_of, scene_of};

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

/// Two turns of a slider-crank: at fine tolerances the energies balance as closely as
/// is asked for (the run is trusted), and the motion is that of absolute coordinates.
#[test]
fn energies_balance_at_fine_tolerances_over_two_turns() {
    let spec = linkage_of(&read(&text(1e-10, 0.44), &[]), "m");
    let (mechanism, start) = MOTOR.mechanism(&spec);
    let (course, worth) = reference(&mechanism, &start, 0.44, 110);
    assert!(worth < 2e-6, "the reference stands: {worth:e}");
    assert!(course.state.place[2] > 4.0 * std::f64::consts::PI);
    for (tolerance, within) in [(1e-10, 1e-8), (1e-11, 2e-9), (1e-12, 2e-9)] {
        for method in ["auto", "dopri5", "dop853", "rodas5p", "radau"] {
            let found = run_of(&text(tolerance, 0.44), &[&format!("run.method={method}")]);
            let run = &found.figures.run;
            assert!(
                run.energy_error < 10.0 * tolerance,
                "{method} {tolerance:e}: {:e}",
                run.energy_error
            );
            let angle = figure(&found, "motor.final.displacement");
            let miss = (angle - course.state.place[2]).abs();
            assert!(miss < within, "{method} {tolerance:e}: {miss:e}");
            let loss = figure(&found, "m.friction_loss");
            let miss = (loss - course.loss).abs();
            assert!(miss < 10.0 * within, "{method} {tolerance:e}: {miss:e}");
        }
    }
}

/// A method of fixed steps keeps its order over kinks.
#[test]
fn the_order_is_kept_over_kinks() {
    let exact = run_of(&text(1e-12, 0.2), &["run.method=dop853"]);
    let error = |step: f64| {
        let step = format!("run.step={step}");
        let scene = read(&text(1e-6, 0.2), &["run.method=rk4", &step]);
        let found = crate::support::ran(&scene);
        let name = "motor.final.displacement";
        (figure(&found, name) - figure(&exact, name)).abs()
    };
    let errors = [4e-3, 2e-3, 1e-3].map(error);
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!(order > 3.3, "{errors:?}");
    }
}
