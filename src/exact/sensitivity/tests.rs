//! Derivatives against closed forms and references computed elsewhere.

use super::*;
use crate::exact::{ExactTree, Law, Request, Sine, TimeLoad, TreeMass, TreeObject, TreePair};
use crate::math::number::Number;
use serde_json::Value;

const REFERENCE: &str = include_str!(concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/tests/reference/design-gradients.json"
));

fn one_mass(mass: TreeMass, law: Law, displacement: f64, speed: f64) -> TreeProblem {
    TreeProblem {
        masses: vec![mass],
        law,
        displacement: vec![displacement],
        speed: vec![speed],
        objects: vec![TreeObject {
            first: 0,
            output: vec![(0, 1.0)],
            driver: None,
        }],
    }
}

/// A ball that falls from rest at a height h on a table A·sin(w·t).
fn ball([e, amplitude, frequency, g, h]: [f64; 5]) -> TreeProblem {
    let mut mass = TreeMass::new(1.0, None, 0.0, 0.0);
    mass.pair = TreePair::Force { opens: 1.0 };
    mass.restitution = Some(e);
    mass.loads = vec![TimeLoad::Constant(-g)];
    let law = Law::Harmonic {
        mean: 0.0,
        slope: 0.0,
        sines: vec![Sine {
            amplitude,
            frequency,
            phase: 0.0,
        }],
    };
    one_mass(mass, law, h, -amplitude * frequency)
}

#[test]
fn five_derivatives_of_a_ball_with_impacts_agree_with_the_reference() {
    let all: Value = serde_json::from_str(REFERENCE).expect("JSON");
    let case = &all["ball_with_restitution"];
    let number = |value: &Value| -> f64 {
        let text = value.as_str().map(str::to_owned);
        let text = text.unwrap_or_else(|| value.to_string());
        text.parse().expect("number")
    };
    let names = ["e", "A", "w", "g", "h"];
    let inputs = names.map(|name| number(&case["inputs"][name]));
    let end = number(&case["time"]);
    let problem = ball(inputs);
    let run = ExactTree::new(problem.clone())
        .run(&Request::new(end, 0))
        .expect("run");
    assert_eq!(run.switches.len(), 4);
    // The numbers are linear in every parameter: differences of any length are exact.
    let place = flat_numbers(&problem, None).expect("numbers");
    let mut derivatives = vec![[0.0; 5]; place.len()];
    for k in 0..5 {
        let moved = |by: f64| {
            let mut own = inputs;
            own[k] += by;
            flat_numbers(&ball(own), None).expect("numbers")
        };
        let (low, high) = (moved(-0.125), moved(0.125));
        for (row, ([low, _], [high, _])) in derivatives.iter_mut().zip(low.iter().zip(&high)) {
            row[k] = (high - low) / 0.25;
        }
    }
    let question = Question {
        problem: &problem,
        table: None,
        run: &run,
        derivatives: &derivatives,
        end: end.into(),
        events: EventTimes::Moving,
        touches: &[],
    };
    let found = results(&question, &|| true).expect("derivatives");
    let own = &found.objects[0];
    for (figure, found) in [("height", own.displacement), ("speed", own.speed)] {
        approx::assert_relative_eq!(found.value(), number(&case[figure]), max_relative = 1e-11);
        for (k, name) in names.iter().enumerate() {
            let expected = number(&case["d"][name][figure]);
            approx::assert_relative_eq!(found.derivatives[k], expected, max_relative = 1e-9);
        }
    }
}

/// X = (t − 1)²/2 touches its flank at t = 1. A dip by ε changes the speed by b·ε/J.
#[test]
fn a_damped_flank_that_is_just_touched_has_two_derivatives() {
    let mut mass = TreeMass::new(2.0, None, 1e4, 3.0);
    mass.pair = TreePair::Force { opens: 1.0 };
    mass.loads = vec![TimeLoad::Constant(2.0)];
    let law = Law::Harmonic {
        mean: 0.0,
        slope: 0.0,
        sines: Vec::new(),
    };
    // (A miss by more than the run cannot tell, and less than counts.)
    let height = 0.5 + 1e-13;
    let problem = one_mass(mass, law, height, -1.0);
    let run = ExactTree::new(problem.clone())
        .run(&Request::new(2.0, 0))
        .expect("run");
    assert!(run.switches.is_empty(), "{:?}", run.switches);
    let place = flat_numbers(&problem, None).expect("numbers");
    let derivatives: Vec<[f64; 1]> = (place.iter())
        .map(|number| [f64::from(u8::from(number[0] == height))])
        .collect();
    let mut question = Question {
        problem: &problem,
        table: None,
        run: &run,
        derivatives: &derivatives,
        end: 2.0.into(),
        events: EventTimes::Moving,
        touches: &[],
    };
    let misses = results(&question, &|| true).expect("derivatives");
    assert_eq!(misses.objects[0].speed.derivatives, [0.0]);
    let touches: Vec<Touch> = misses.touches.iter().map(|touch| touch.0).collect();
    assert_eq!(touches.len(), 1);
    approx::assert_abs_diff_eq!(touches[0].time, 1.0, epsilon = 1e-7);
    question.touches = &touches;
    let dips = results(&question, &|| true).expect("derivatives");
    approx::assert_abs_diff_eq!(dips.objects[0].speed.derivatives[0], -1.5, epsilon = 1e-12);
    // Runs that dip: the difference of the speeds goes to b/J with the root of the depth.
    let speed = |depth: f64| {
        let mut own = problem.clone();
        own.displacement[0] -= depth;
        let run = ExactTree::new(own).run(&Request::new(2.0, 0)).expect("run");
        run.speed[0]
    };
    let slope = (speed(1e-11) - speed(0.0)) / 1e-11;
    approx::assert_relative_eq!(slope, 1.5, max_relative = 0.1);
}
