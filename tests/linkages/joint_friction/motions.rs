//! Motions through changes of direction, against absolute coordinates with
//! multipliers.

use super::oracle::{Course, integrate};
use super::reference::slider_crank;
use super::support::{figure, linkage_of, read, run_of, scene_of};
use crate::multipliers::{Mechanism, State};
use dam::linkage::Linkage;
use dam::linkage::spec::LinkageSpec;
use dam::studies::run::RunResult;

/// The motor of a scene: inertia, constant torque, angle and speed at the start.
#[derive(Clone, Copy)]
pub(crate) struct Motor {
    pub(crate) inertia: f64,
    pub(crate) torque: f64,
    pub(crate) angle: f64,
    pub(crate) speed: f64,
}

impl Motor {
    pub(crate) fn text(self) -> String {
        let Self {
            inertia,
            torque,
            angle,
            speed,
        } = self;
        format!(
            r#""motor": {{ "kind": "drive", "motor": {{ "inertia": {inertia}, "angle": {angle}, "speed": {speed},
                "torque": {{ "constant": {torque} }} }} }}"#
        )
    }

    fn mechanism(self, spec: &LinkageSpec) -> (Mechanism<'_>, State) {
        let linkage = Linkage::new(spec.clone()).expect("a linkage");
        let mechanism = Mechanism {
            spec,
            torque: self.torque,
            rotor: self.inertia,
        };
        let start = mechanism.start(&linkage, self.angle, self.speed);
        (mechanism, start)
    }
}

fn run_text(duration: f64) -> String {
    format!(r#""duration": {duration}, "tolerance": 1e-10, "start": "on_law""#)
}

/// The reference at two step widths: the finer one, and how far the coarser
/// one is off; at order 10 the finer one is a thousand times better.
fn reference(m: &Mechanism<'_>, start: &State, duration: f64, steps: usize) -> (Course, f64) {
    let (coarse, fine) = (
        integrate(m, start, duration, steps / 2),
        integrate(m, start, duration, steps),
    );
    assert_eq!(coarse.stops.len(), fine.stops.len());
    let all = |state: &State| [state.place.clone(), state.speed.clone()].concat();
    let pairs = all(&coarse.state).into_iter().zip(all(&fine.state));
    let worth = pairs.fold(0.0f64, |most, (a, b)| most.max((a - b).abs()));
    (fine, worth)
}

/// Angle and speed of the link 2 (the crank's name comes first), friction and
/// rest agree.
fn assert_same(found: &RunResult, course: &Course, link: usize, within: f64) {
    let of = |name: &str| figure(found, name);
    let (place, speed) = (
        course.state.place[3 * link + 2],
        course.state.speed[3 * link + 2],
    );
    approx::assert_abs_diff_eq!(of("motor.final.displacement"), place, epsilon = within);
    let faster = within * (1.0 + 10.0 * speed.abs());
    approx::assert_abs_diff_eq!(of("motor.final.speed"), speed, epsilon = faster);
    assert_eq!(of("m.standstills"), course.stops.len() as f64);
    approx::assert_abs_diff_eq!(of("m.time_at_rest"), course.rest, epsilon = 10.0 * within);
    let loss = of("m.friction_loss");
    approx::assert_abs_diff_eq!(loss, course.loss, epsilon = 10.0 * within * (1.0 + loss));
    assert!(
        found.figures.run.energy_error < 1e-8,
        "{:e}",
        found.figures.run.energy_error
    );
}

/// A pendulum on a thick pin: its reaction is made of weight, centrifugal and
/// inertia force.
const PENDULUM: &str = r#""m": { "kind": "linkage", "input": "motor", "driver": "O", "joint_friction": true,
    "gravity": { "acceleration": 9.81 }, "ground": { "O": [0, 0] },
    "links": { "bob": { "mass": 3, "centre": [0.4, 0.05], "moment": 0.05 } },
    "pairs": { "O": { "revolute": ["ground.O", "bob.origin"], "diameter": 0.12, "friction": 0.5 } } }"#;

#[test]
fn a_pendulum_swings_out_by_the_friction_of_its_pin() {
    let motor = Motor {
        inertia: 0.0,
        torque: 0.0,
        angle: -0.4,
        speed: 5.0,
    };
    let text = scene_of(&format!("{}, {PENDULUM}", motor.text()), &run_text(6.0));
    let spec = linkage_of(&read(&text, &[]), "m");
    let (mechanism, start) = motor.mechanism(&spec);
    let (course, worth) = reference(&mechanism, &start, 6.0, 320);
    assert!(worth < 2e-6, "the reference stands: {worth:e}");
    assert!(
        course.stops.len() > 5 && course.rest > 0.05,
        "{:?} {}",
        course.stops,
        course.rest
    );
    let found = run_of(&text, &[]);
    assert_same(&found, &course, 0, 1e-8);
    assert_eq!(figure(&found, "m.final.speed"), 0.0);
}

/// At fine tolerances, too, the energies balance as closely as is asked for (the run is
/// trusted), whatever the method: what makes kinks is located.
#[test]
fn a_slider_crank_with_friction_everywhere_turns_twice_under_a_motor() {
    let motor = Motor {
        inertia: 0.02,
        torque: 4.0,
        angle: 0.0,
        speed: 6.0,
    };
    let objects = format!("{}, {}", motor.text(), slider_crank(0.12));
    let text = scene_of(&objects, &run_text(0.44));
    let spec = linkage_of(&read(&text, &[]), "m");
    let (mechanism, start) = motor.mechanism(&spec);
    let (course, worth) = reference(&mechanism, &start, 0.44, 110);
    assert!(worth < 2e-6, "the reference stands: {worth:e}");
    // Two turns at least: the slide turns round twice a turn.
    assert!(course.state.place[2] > 4.0 * std::f64::consts::PI && course.changes >= 4);
    for tolerance in [1e-10, 1e-11] {
        for method in ["auto", "dopri5", "dop853", "rodas5p", "radau"] {
            let asked = [
                format!("run.tolerance={tolerance:e}"),
                format!("run.method={method}"),
            ];
            let found = run_of(&text, &asked.each_ref().map(String::as_str));
            assert_same(&found, &course, 0, 1e-8);
            let error = found.figures.run.energy_error;
            assert!(
                error < 10.0 * tolerance,
                "{method} {tolerance:e}: {error:e}"
            );
        }
    }
}

#[test]
fn a_slider_crank_runs_out_and_stays_where_friction_holds_it() {
    let motor = Motor {
        inertia: 0.02,
        torque: 0.0,
        angle: 0.3,
        speed: -14.0,
    };
    let objects = format!("{}, {}", motor.text(), slider_crank(0.15));
    let text = scene_of(&objects, &run_text(2.0));
    let spec = linkage_of(&read(&text, &[]), "m");
    let (mechanism, start) = motor.mechanism(&spec);
    let (course, worth) = reference(&mechanism, &start, 2.0, 200);
    assert!(worth < 2e-6, "the reference stands: {worth:e}");
    assert!(!course.stops.is_empty(), "{:?}", course.stops);
    let found = run_of(&text, &[]);
    assert_same(&found, &course, 0, 1e-7);
}

/// A slider-crank without offset and without spring, the centre of the slide
/// on the guide.
fn plain(slide: f64, pull: f64, more: &str) -> String {
    format!(
        r#""m": {{ "kind": "linkage", "input": "motor", "driver": "O", "joint_friction": true,
        "ground": {{ "O": [0, 0] }}, "gravity": true,
        "links": {{
            "crank": {{ "points": {{ "A": [0.06, 0] }}, "mass": 0.8, "centre": [0.02, 0], "moment": 0.001 }},
            "rod": {{ "points": {{ "B": [0.24, 0] }}, "mass": 1.1, "centre": [0.1, 0], "moment": 0.006 }},
            "slide": {{ "mass": {slide} }} }},
        "pairs": {{
            "O": {{ "revolute": ["ground.O", "crank.origin"], "diameter": 0.04, "friction": 0.1 }},
            "A": {{ "revolute": ["crank.A", "rod.origin"], "diameter": 0.03, "friction": 0.1 }},
            "B": {{ "revolute": ["rod.B", "slide.origin"], "diameter": 0.03, "friction": 0.1 }},
            "guide": {{ "sliding": {{ "guide": "ground.O", "block": "slide.origin",
                "corners": [0.02, -0.03] }}, "friction": 0.1 }} }},
        "assembly": {{ "slide": {{ "near": [0.3, 0] }} }},
        "forces": {{ "pull": {{ "force": {{ "point": "slide.origin", "force": [{pull}, 0] }} }} }},
        "outputs": {{ "slide": {{ "point": "slide.origin" }} }} }}{more}"#
    )
}

/// Mass and load that hang on an output press on the pairs as if they were the
/// slide's own.
#[test]
fn what_hangs_rigidly_on_an_output_loads_the_pairs_like_a_part_of_the_link() {
    let motor = Motor {
        inertia: 0.05,
        torque: 3.0,
        angle: 0.5,
        speed: 9.0,
    };
    // Without weights: that of a tool would not rest on the guide.
    let scene = |linkage: &str| {
        let linkage = linkage.replace(r#""gravity": true"#, r#""gravity": false"#);
        scene_of(&format!("{}, {linkage}", motor.text()), &run_text(0.3))
    };
    let own = scene(&plain(2.2, -55.0, ""));
    let spec = linkage_of(&read(&own, &[]), "m");
    let (mechanism, start) = motor.mechanism(&spec);
    let (course, worth) = reference(&mechanism, &start, 0.3, 60);
    assert!(worth < 2e-6, "the reference stands: {worth:e}");
    assert_same(&run_of(&own, &[]), &course, 0, 1e-7);
    let tool = r#", "tool": { "kind": "slider", "input": "m.slide", "position": { "ratio": 1 }, "inertia": 0.7, "masses": 0,
        "loads": { "cut": { "constant": -40 } } }"#;
    let hung = scene(&plain(1.5, -15.0, tool));
    assert_same(&run_of(&hung, &[]), &course, 0, 1e-7);
    let geared = r#", "tool": { "kind": "slider", "input": "m.slide", "position": { "ratio": -2 }, "inertia": 0.175, "masses": 0,
        "loads": { "cut": { "constant": 20 } } }"#;
    let hung = scene(&plain(1.5, -15.0, geared));
    assert_same(&run_of(&hung, &[]), &course, 0, 1e-7);
}

/// The linkage behind a gear, its rotor's inertia seen through the ratio.
#[test]
fn a_motor_in_front_of_a_gear_moves_it_as_one_with_the_reduced_rotor() {
    let direct = Motor {
        inertia: 0.05,
        torque: 3.0,
        angle: 0.5,
        speed: 9.0,
    };
    let geared = Motor {
        inertia: 0.0125,
        torque: 1.5,
        angle: 1.0,
        speed: 18.0,
    };
    let run = run_text(0.3);
    let one = run_of(
        &scene_of(
            &format!("{}, {}", direct.text(), plain(2.2, -55.0, "")),
            &run,
        ),
        &[],
    );
    let linkage = plain(2.2, -55.0, "").replacen(
        r#""driver": "O""#,
        r#""driver": "O", "position": { "ratio": 0.5 }"#,
        1,
    );
    let two = run_of(
        &scene_of(&format!("{}, {linkage}", geared.text()), &run),
        &[],
    );
    for name in [
        "m.final.displacement",
        "m.final.speed",
        "m.friction_loss",
        "m.slide.final.displacement",
    ] {
        let (one, two) = (figure(&one, name), figure(&two, name));
        approx::assert_abs_diff_eq!(one, two, epsilon = 1e-8 * (1.0 + one.abs()));
    }
}

/// An elastic tool behind the slide: in absolute coordinates one more body on
/// a strut.
#[test]
fn an_elastic_tool_behind_the_slide_presses_on_the_pairs() {
    let motor = Motor {
        inertia: 0.05,
        torque: 3.0,
        angle: 0.5,
        speed: 9.0,
    };
    let tool = r#", "tool": { "kind": "slider", "input": "m.slide", "position": { "ratio": 1 }, "inertia": 0.7,
        "stiffness": 4000, "damping_capacity": 0, "masses": 1 }"#;
    let text = scene_of(
        &format!("{}, {}", motor.text(), plain(1.5, -15.0, tool)),
        &run_text(0.3),
    );
    let mut spec = linkage_of(&read(&text, &[]), "m");
    let (_, mut start) = motor.mechanism(&spec);
    // The slide is the last link; the tool stands half a metre ahead of it.
    let slide = spec.links.len() - 1;
    assert_eq!(spec.links[slide].name, "slide");
    for (values, ahead) in [(&mut start.place, 0.5), (&mut start.speed, 0.0)] {
        let x = values[3 * slide] + ahead;
        values.extend([x, 0.0, 0.0]);
    }
    add_tool(&mut spec, slide);
    let mechanism = Mechanism {
        spec: &spec,
        torque: motor.torque,
        rotor: motor.inertia,
    };
    let (course, worth) = reference(&mechanism, &start, 0.3, 60);
    assert!(worth < 2e-6, "the reference stands: {worth:e}");
    let found = run_of(&text, &[]);
    assert_same(&found, &course, 0, 1e-7);
    let x = course.state.place[3 * (slide + 1)] - 0.5;
    approx::assert_abs_diff_eq!(figure(&found, "tool.final.displacement"), x, epsilon = 1e-7);
}

/// A body on the ground's guide, and a spring to it.
fn add_tool(spec: &mut LinkageSpec, slide: usize) {
    use dam::linkage::spec::{ForceLaw, ForceSpec, LinkSpec, PointOf};
    let tool = spec.links.len();
    let mut link = LinkSpec {
        name: "tool".to_owned(),
        mass: 0.7,
        ..LinkSpec::default()
    };
    // It never turns; without a moment of inertia its row would be empty.
    link.moment = 1.0;
    spec.links.push(link);
    let at = |link| PointOf {
        link: Some(link),
        at: [0.0; 2],
    };
    let guide = spec
        .pairs
        .iter()
        .find(|pair| pair.name == "guide")
        .expect("a guide");
    let mut second = guide.clone();
    (second.link, second.friction) = (at(tool), 0.0);
    spec.pairs.push(second);
    let law = ForceLaw::Strut {
        from: at(slide),
        to: at(tool),
        rate: 4000.0,
        free_length: 0.5,
        damping: 0.0,
        force: 0.0,
    };
    spec.forces.push(ForceSpec {
        name: "spring".to_owned(),
        law,
    });
    // The strut pulls the tool to a distance of half a metre; weights do nothing along the guide.
}

/// More friction takes more from the same start.
#[test]
fn the_loss_grows_with_the_coefficient_and_the_energies_balance() {
    let motor = Motor {
        inertia: 0.5,
        torque: 0.0,
        angle: 0.3,
        speed: 20.0,
    };
    let mut before = 0.0;
    for friction in [0.01, 0.05, 0.1, 0.2] {
        let objects = format!("{}, {}", motor.text(), slider_crank(friction));
        let found = run_of(&scene_of(&objects, &run_text(0.5)), &[]);
        let loss = figure(&found, "m.friction_loss");
        assert!(loss > before, "{friction}: {loss} {before}");
        assert!(
            found.figures.run.energy_error < 4e-9,
            "{:e}",
            found.figures.run.energy_error
        );
        before = loss;
    }
}

#[test]
fn a_vanishing_coefficient_comes_near_to_no_friction() {
    let motor = Motor {
        inertia: 0.05,
        torque: 2.0,
        angle: 0.3,
        speed: 8.0,
    };
    let run = |friction: f64| {
        let objects = format!("{}, {}", motor.text(), slider_crank(friction));
        figure(
            &run_of(&scene_of(&objects, &run_text(0.4)), &[]),
            "motor.final.displacement",
        )
    };
    let (none, little, more) = (run(0.0), run(1e-6), run(2e-6));
    let (one, two) = (none - little, none - more);
    assert!(one > 0.0 && one < 1e-4, "{one:e}");
    approx::assert_abs_diff_eq!(two / one, 2.0, epsilon = 1e-3);
}
