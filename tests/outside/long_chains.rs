//! Setting up costs in proportion to the number of masses.

use dam::lower::lower;
use dam::scene::{BuiltIn, Document, Overrides};
use dam::system::{Regime, System};

/// A chain of equal masses with a spring at its end, pressed by a constant moment.
fn chain(masses: usize, rate: f64) -> System {
    let text = format!(
        r#"{{ "dam": 1, "name": "chain", "objects": {{
            "shaft": {{ "kind": "drive", "motion": {{ "speed": 10 }} }},
            "rod": {{ "kind": "shaft", "input": "shaft", "masses": {masses}, "inertia": 2.0,
                "stiffness": 1e6, "damping_capacity": 0.1,
                "loads": {{ "weight": {{ "constant": -300 }}, "spring": {{ "spring":
                    {{ "rate": {rate}, "preload": 50 }} }} }} }} }},
            "run": {{ "duration": 0.01, "start": "static" }} }}"#
    );
    let document = Document::parse("test", text.as_bytes()).unwrap();
    let reading = document.scene(&BuiltIn, &Overrides::none()).unwrap();
    System::new(lower(&reading.scene).unwrap()).unwrap()
}

#[test]
fn the_static_start_of_a_long_chain_is_the_closed_form() {
    // A uniform chain of n links c·n: the loads act on the last mass, F = −300 − 50 − k·u.
    for rate in [0.0, 1e3, 1e7] {
        for masses in [30, 500] {
            let system = chain(masses, rate);
            let start = system.initial_state().unwrap();
            let force = -350.0 / (1.0 + rate / 1e6);
            for (m, u) in start.y[..masses].iter().enumerate() {
                let exact = force / 1e6 * (m + 1) as f64 / masses as f64;
                approx::assert_relative_eq!(*u, exact, max_relative = 1e-9);
            }
        }
    }
}

#[test]
fn frequencies_of_a_long_chain_are_the_closed_form() {
    let masses = 1000;
    let found = chain(masses, 0.0).natural_frequencies(Regime::Engaged);
    let n = masses as f64;
    // ω_k = 2·√(c/m)·sin((2k − 1)·π/(2·(2n + 1))), c = n·10⁶, m = 2/n.
    let root = (n * 1e6 / (2.0 / n)).sqrt();
    for (k, frequency) in found.iter().enumerate() {
        let angle = (2 * k + 1) as f64 * std::f64::consts::PI / (2.0 * (2.0 * n + 1.0));
        approx::assert_relative_eq!(*frequency, 2.0 * root * angle.sin(), max_relative = 1e-8);
    }
}
