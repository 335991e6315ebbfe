//! An elastic tool behind an output of a linkage that rests: it breaks the linkage
//! loose, and lets it come to rest again.

use super::support::{figure, run_of, scene_of};

const G: f64 = 9.81;
const FRICTION: f64 = 0.3;
/// Half the distance of the corners, and the height at which the tool pulls (m).
const HALF: f64 = 0.05;
/// Block, tool (kg), spring (N/m).
const BLOCK: f64 = 2.5;
const TOOL: f64 = 0.8;
const RATE: f64 = 900.0;

/// A block on a level guide; a tool of its own speed hangs on a spring that pulls at a
/// `height` above the guide.
fn scene(height: f64, speed: f64, duration: f64) -> String {
    let objects = format!(
        r#""push": {{ "kind": "drive", "coordinate": "sliding", "motor": {{ "inertia": 0, "speed": 0, "force": {{ "constant": 0 }} }} }},
        "m": {{ "kind": "linkage", "input": "push", "driver": "guide", "joint_friction": true,
            "gravity": {{ "acceleration": {G} }}, "ground": {{ "O": [0, 0] }},
            "links": {{ "block": {{ "mass": {BLOCK}, "points": {{ "eye": [0, {height}] }} }} }},
            "pairs": {{ "guide": {{ "friction": {FRICTION}, "sliding": {{ "guide": "ground.O",
                "block": "block.origin", "corners": [{HALF}, -{HALF}] }} }} }},
            "outputs": {{ "eye": {{ "point": "block.eye" }} }} }},
        "tool": {{ "kind": "slider", "input": "m.eye", "position": {{ "ratio": 1 }}, "inertia": {TOOL},
            "stiffness": {RATE}, "damping_capacity": 0, "masses": 1 }}"#
    );
    let run = format!(
        r#""duration": {duration}, "tolerance": 1e-11,
           "start": {{ "tool": {{ "displacement": [0], "speed": [{speed}] }} }}"#
    );
    scene_of(&objects, &run)
}

/// What the block does, from the laws of two masses alone.
#[derive(Clone, Copy, Default)]
struct Course {
    /// Places and speeds of block and tool.
    state: [f64; 4],
    rest: f64,
    loss: f64,
    starts: usize,
}

/// The friction limit under a pull of the spring: a couple beyond the weight's lifts
/// one corner and presses the other.
fn limit(pull: f64, height: f64) -> f64 {
    FRICTION * (BLOCK * G).max((pull * height / HALF).abs())
}

/// Runge and Kutta's method on steps so short that kinks and stops do not count.
fn followed(height: f64, speed: f64, duration: f64) -> Course {
    let steps = 200_000;
    let h = duration / steps as f64;
    let mut course = Course {
        state: [0.0, 0.0, 0.0, speed],
        ..Course::default()
    };
    let pull = |y: &[f64; 4]| RATE * (y[2] - y[0]);
    let mut going = 0.0;
    for _ in 0..steps {
        let now = pull(&course.state);
        if going == 0.0 && now.abs() > limit(now, height) {
            going = now.signum();
            course.starts += 1;
        }
        let slope = |y: [f64; 4]| {
            let force = pull(&y);
            let block = match going {
                0.0 => 0.0,
                going => (force - going * limit(force, height)) / BLOCK,
            };
            [y[1], block, y[3], -force / TOOL]
        };
        let ahead = |slope: [f64; 4], part: f64| {
            std::array::from_fn(|k| course.state[k] + part * h * slope[k])
        };
        let a = slope(course.state);
        let b = slope(ahead(a, 0.5));
        let c = slope(ahead(b, 0.5));
        let d = slope(ahead(c, 1.0));
        let before = course.state;
        course.state = ahead(
            std::array::from_fn(|k| (a[k] + 2.0 * (b[k] + c[k]) + d[k]) / 6.0),
            1.0,
        );
        let middle = 0.5 * (pull(&before) + pull(&course.state));
        course.loss += limit(middle, height) * (course.state[0] - before[0]).abs();
        course.rest += if going == 0.0 { h } else { 0.0 };
        if course.state[1] * going < 0.0 {
            (course.state[1], going) = (0.0, 0.0);
        }
    }
    course
}

#[test]
fn a_tool_behind_an_output_breaks_a_resting_block_loose() {
    for (height, speed, duration) in [(0.0, 0.6, 0.5), (0.12, 0.6, 0.5), (0.12, -0.9, 0.7)] {
        let course = followed(height, speed, duration);
        assert!(
            course.starts >= 2 && course.rest > 0.02,
            "{}",
            course.starts
        );
        let found = run_of(&scene(height, speed, duration), &[]);
        let near = |name: &str, wanted: f64, epsilon: f64| {
            approx::assert_abs_diff_eq!(figure(&found, name), wanted, epsilon = epsilon);
        };
        near("m.final.displacement", course.state[0], 2e-6);
        near("tool.final.displacement", course.state[2], 2e-6);
        near("tool.final.speed", course.state[3], 1e-4);
        near("m.time_at_rest", course.rest, 1e-4);
        near("m.friction_loss", course.loss, 1e-4);
        assert!(found.figures.run.energy_error < 1e-9);
    }
}

/// A pull too weak, at a height where it would rather tip the block than shove it.
#[test]
fn a_tool_that_cannot_break_it_loose_vibrates_alone() {
    // At b/h < μ no pull at this height starts it, however strong.
    for (height, speed) in [(0.0, 0.25), (0.2, 2.0)] {
        let found = run_of(&scene(height, speed, 0.5), &[]);
        assert_eq!(figure(&found, "m.final.displacement"), 0.0);
        assert_eq!(figure(&found, "m.time_at_rest"), 0.5);
        let frequency = f64::sqrt(RATE / TOOL);
        let place = speed / frequency * (0.5 * frequency).sin();
        let end = figure(&found, "tool.final.displacement");
        approx::assert_abs_diff_eq!(end, place, epsilon = 1e-10);
    }
}
