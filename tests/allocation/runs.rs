//! The right-hand side and everything called at every step allocate nothing.

use crate::counting::allocations;
use dam::expression::Expression;
use dam::integrate::{Dynamics, Limits, Method, Modes, Settings, Sink, Stop, integrate};
use dam::laws::LawInstance;
use dam::model::*;
use dam::motion::DriveMotion;
use dam::position::{Position, PositionSpec};
use dam::system::{ObjectState, System};
use std::sync::Arc;

fn law(driver: usize, position: Position, track: Option<usize>) -> Law {
    Law {
        driver,
        position,
        lever: 1.0,
        track,
    }
}

fn part(id: &str, nodes: Vec<usize>, driver: Option<usize>, links: Vec<usize>) -> ObjectPart {
    ObjectPart {
        id: id.into(),
        kind: "rocker",
        coordinate: Coordinate::Turning,
        nodes,
        inputs: PartInput::behind_one_driver(driver),
        links,
        combination: None,
        contact: None,
        driven_end: None,
        rigid_pair: None,
        pressing: None,
    }
}

const GUARDED: &str = "3*sin(20*t)*abs(x - 0.1) - (v > 2 ? 0.1*v : 0) + floor(3*r) + max(x, t)^2";

/// An expression over time, its own motion and the rotor's.
fn written(text: &str) -> WrittenLoad {
    let expression = Expression::new(text, &["t", "x", "v", "r"]).unwrap();
    WrittenLoad {
        expression: Arc::new(expression),
        factor: 1.0,
        variables: vec![
            LoadVariable::Time,
            LoadVariable::Displacement(3),
            LoadVariable::Speed(3),
            LoadVariable::Displacement(0),
        ],
    }
}

/// A motor with a rigid slider-crank and a chain of three masses behind it, a
/// gap, a table over the rotor's angle and one over time.
fn model() -> Model {
    let slider_crank = PositionSpec::SliderCrank {
        crank: 0.1,
        rod: 0.4,
        offset: 0.01,
        branch: 1.0,
        phase: 0.0,
    };
    let table = Position::new(&PositionSpec::Table {
        points: vec![(0.0, 0.0), (1.0, 0.5), (2.0, 0.2), (4.0, 0.9)],
        periodic: false,
        end_slopes: (0.0, 0.0),
    })
    .unwrap();
    let breaks = table.breaks();
    let mut model = Model::default();
    let node = |inertia, motion| Node { inertia, motion };
    model.nodes.push(node(
        0.5,
        NodeMotion::Rotor {
            angle: 1.5,
            speed: 10.0,
        },
    ));
    let rigid = law(0, Position::new(&slider_crank).unwrap(), None);
    model
        .nodes
        .push(node(2.0, NodeMotion::Rigid { law: rigid }));
    for mass in 2..5 {
        let law = law(0, table.clone(), Some(0));
        model.nodes.push(node(0.1, NodeMotion::Mass { law }));
        let pair = Pair {
            closure: Closure::Form,
            gap: 1e-4,
            opens: 1.0,
            form: ContactForm::Proportional(Loss::Factor(0.1)),
        };
        model.links.push(Link {
            mass,
            base: if mass == 2 {
                LinkBase::Law { pair }
            } else {
                LinkBase::Mass(mass - 1)
            },
            stiffness: 1e4,
            damping: 1.0,
        });
    }
    model.nodes.push(node(
        0.0,
        NodeMotion::Prescribed {
            motion: DriveMotion::Constant {
                speed: 3.0,
                angle: 0.0,
            },
            track: None,
        },
    ));
    model.objects = vec![
        part("motor", vec![0], None, vec![]),
        part("press", vec![1], Some(0), vec![]),
        part("rocker", vec![2, 3, 4], Some(0), vec![0, 1, 2]),
        part("drive", vec![5], None, vec![]),
    ];
    let track = |source, breaks| Track {
        source,
        breaks,
        repeats: false,
        stops: false,
        object: 2,
    };
    let steps = dam::breaks::Breaks {
        points: vec![0.1, 0.2],
        period: Some(0.5),
    };
    model.tracks.push(track(TrackSource::Node(0), breaks));
    model.tracks.push(track(TrackSource::Time, steps));
    let load = |node, law| Load {
        node,
        name: "some".into(),
        law,
    };
    let pieces = vec![
        LinearPiece {
            start: 0.0,
            value: 5.0,
            slope: 1.0
        };
        2
    ];
    model.loads = vec![
        load(4, LoadLaw::constant(-2.0)),
        load(4, LoadLaw::Pieces { track: 1, pieces }),
        load(3, LoadLaw::Written(written(GUARDED))),
        load(3, LawInstance::friction(1.0, 0.1).law()),
        load(0, LawInstance::kloss([30.0, 0.2, 100.0]).law()),
        load(0, LoadLaw::speed_table(vec![(0.0, 1.0), (50.0, 0.0)])),
        load(1, LoadLaw::spring(10.0, 1.0)),
    ];
    model
}

#[test]
fn nothing_that_a_step_calls_allocates() {
    let system = System::new(model()).unwrap();
    let start = system.initial_state().unwrap();
    let (y, modes) = (start.y, start.modes);
    let mut scratch = system.scratch();
    let mut dy = vec![0.0; y.len()];
    let direction = vec![0.5; y.len()];
    let mut extra = vec![[0.0; 3]; system.signals() - system.coordinates()];
    let mut states = vec![ObjectState::default(); system.model().objects.len()];
    let mut watches = Vec::new();
    let mut sum = 0.0;
    let mut step = |time: f64, watches: &mut Vec<_>| {
        system.derivatives(time, &y, &modes, &mut scratch, &mut dy);
        system.extra_signals(time, &y, &dy, &modes, &mut scratch, &mut extra);
        system.tangent(time, &y, &modes, &direction, &mut scratch, &mut dy);
        system.observe(time, &y, &modes, &mut scratch, &mut states);
        system.event_functions(&modes, watches);
        sum += system.power(time, &y, &modes, &mut scratch).loads;
        sum += system.energy(time, &y, &modes, &mut scratch).kinetic;
        sum += system.next_break(time, &modes);
    };
    step(0.0, &mut watches);
    let before = allocations();
    for index in 0..100 {
        step(1e-3 * f64::from(index), &mut watches);
    }
    let after = allocations();
    assert_eq!(after - before, 0);
    assert!(sum.is_finite() && !watches.is_empty());
    // The counter counts.
    let kept = std::hint::black_box(Box::new([sum; 3]));
    assert!(allocations() > after && kept.len() == 3);
}

/// A motor that drives a rigid slider-crank and a chain without a gap: nothing
/// switches.
fn quiet_model() -> Model {
    let mut model = model();
    for node in &mut model.nodes {
        if let NodeMotion::Mass { law } = &mut node.motion {
            law.track = None;
            law.position = Position::Sine {
                amplitude: 0.3,
                harmonic: 1.0,
                phase: 0.0,
                offset: 0.0,
            };
        }
    }
    for link in &mut model.links {
        if let LinkBase::Law { pair } = &mut link.base {
            pair.closure = Closure::Bilateral;
            pair.form = ContactForm::default();
            pair.gap = 0.0;
        }
    }
    model.tracks.clear();
    model.loads.retain(|load| {
        let table = load
            .law
            .function()
            .is_some_and(|own| !own.corners().is_empty());
        !(table || matches!(load.law, LoadLaw::Pieces { .. }))
    });
    for load in &mut model.loads {
        if let LoadLaw::Written(written) = &mut load.law {
            *written = self::written("3*sin(20*t)*x - v*exp(-x^2) + 2*cos(r)/(1 + v^2)");
        }
    }
    model
}

/// Listens to nothing.
struct Nobody;

impl Sink for Nobody {
    fn start(&mut self, _: f64, _: &[f64], _: &Modes) {}
    fn step(&mut self, _: &dam::polynomial::Step<'_>, _: &Modes) {}
    fn switch(&mut self, _: &dam::integrate::SwitchEvent<'_>) {}
}

#[test]
fn the_steps_of_the_own_methods_allocate_nothing() {
    let system = System::new(quiet_model()).unwrap();
    let start = system.initial_state().unwrap();
    for method in [Method::Taylor, Method::Rodas5p, Method::Radau] {
        let count = |duration: f64| {
            let settings = Settings {
                method,
                tolerance: 1e-6,
                step: Some(1e-3),
            };
            let limits = Limits {
                switches: 10,
                steps: 1_000_000,
                budget: dam::budget::Budget::FREE,
            };
            let before = allocations();
            let outcome = integrate(
                &system,
                0.0,
                duration,
                &start.y,
                &start.modes,
                &settings,
                &limits,
                &mut Nobody,
            );
            assert_eq!(outcome.stop, Stop::Complete, "{method}");
            assert!(outcome.statistics.steps as f64 >= 999.0 * duration);
            allocations() - before
        };
        // The first run fills tables that are made once.
        count(0.05);
        assert_eq!(count(0.05), count(0.5), "{method}");
    }
}

/// A motor that drives a slider-crank with weights and a spring, on whose slide an
/// elastic tool hangs.
fn linkage_model(tool: bool) -> Model {
    let tool_text = r#", "tool": { "kind": "slider", "input": "press.slide", "position": { "ratio": 1 },
        "inertia": 3, "stiffness": 1e5, "damping_capacity": 0.1 }"#;
    let text = format!(
        r#"{{ "dam": 1, "name": "press", "objects": {{
        "motor": {{ "kind": "drive", "motor": {{ "inertia": 0.01, "speed": 20, "torque": {{ "constant": 1 }} }} }},
        "press": {{ "from": "linkage/slider-crank", "input": "motor", "gravity": true, "forces": {{
            "spring": {{ "strut": {{ "from": "ground.O", "to": "slide.origin", "rate": 500, "free_length": 0.1, "damping": 2 }} }} }} }}{}
      }}, "run": {{ "duration": 1, "start": "on_law" }} }}"#,
        if tool { tool_text } else { "" }
    );
    let document = dam::scene::Document::parse("scene", text.as_bytes()).unwrap();
    let reading = document
        .scene(&dam::scene::BuiltIn, &dam::scene::Overrides::none())
        .unwrap();
    dam::lower::lower(&reading.scene).unwrap()
}

#[test]
fn linkages_allocate_nothing_on_the_way() {
    for tool in [true, false] {
        let system = System::new(linkage_model(tool)).unwrap();
        let start = system.initial_state().unwrap();
        let (mut y, modes) = (start.y, start.modes);
        let mut scratch = system.scratch();
        let mut dy = vec![0.0; y.len()];
        let direction = vec![0.5; y.len()];
        let mut states = vec![ObjectState::default(); system.model().objects.len()];
        let mut sum = 0.0;
        let mut step = |time: f64| {
            y[0] += 0.1;
            system.derivatives(time, &y, &modes, &mut scratch, &mut dy);
            system.tangent(time, &y, &modes, &direction, &mut scratch, &mut dy);
            system.observe(time, &y, &modes, &mut scratch, &mut states);
            sum += system.power(time, &y, &modes, &mut scratch).dissipated;
            sum += system.energy(time, &y, &modes, &mut scratch).elastic;
        };
        step(0.0);
        let before = allocations();
        for index in 0..100 {
            step(1e-3 * f64::from(index));
        }
        assert_eq!(allocations() - before, 0, "tool: {tool}");
        assert!(sum.is_finite() && sum != 0.0);
    }
}

/// A sum of two inputs, with inertia that couples two motors.
fn sum_of_two(masses: usize) -> String {
    format!(
        r#"{{ "dam": 1, "name": "sum", "objects": {{
                "a": {{ "kind": "drive", "motor": {{ "inertia": 0.3, "torque": {{ "linear": {{
                    "stall_torque": 5, "no_load_speed": 30 }} }} }} }},
                "b": {{ "kind": "drive", "motor": {{ "inertia": 0.2, "speed": 4, "torque": {{ "constant": -1 }} }} }},
                "swing": {{ "kind": "rocker", "input": "a", "inertia": 0.1, "masses": 0,
                    "position": {{ "sine": {{ "amplitude": 0.4 }} }} }},
                "sum": {{ "kind": "differential", "inertia": 0.7, "masses": {masses}, "stiffness": 900,
                    "inputs": {{ "x": {{ "object": "swing", "ratio": 0.5 }},
                        "y": {{ "object": "b", "ratio": -2 }} }} }} }},
                "run": {{ "duration": 1, "start": "on_law" }} }}"#
    )
}

/// Sums of several inputs, and linkages with and without joint friction.
#[test]
fn several_inputs_allocate_nothing_on_the_way() {
    let scenario = |name: &str| {
        let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
        std::fs::read_to_string(root.join(format!("scenarios/{name}.json"))).unwrap()
    };
    let texts = [
        (sum_of_two(0), true),
        (sum_of_two(2), true),
        (scenario("linkages/five_bar"), true),
        // The derivatives of several inputs' joint friction take a few small vectors.
        (scenario("joint_friction/arm_comes_to_rest"), false),
    ];
    for (case, (text, derived)) in texts.iter().enumerate() {
        let document = dam::scene::Document::parse("scene.json", text.as_bytes()).unwrap();
        let reading = document
            .scene(&dam::scene::BuiltIn, &dam::scene::Overrides::none())
            .unwrap_or_else(|e| panic!("{e}"));
        let system = System::new(dam::lower::lower(&reading.scene).unwrap()).unwrap();
        let start = system.initial_state().unwrap();
        let (mut y, modes) = (start.y, start.modes);
        let rates = y.len() / 2;
        y[rates..].fill(0.3);
        let mut scratch = system.scratch();
        let mut dy = vec![0.0; y.len()];
        let direction = vec![0.5; y.len()];
        let mut states = vec![ObjectState::default(); system.model().objects.len()];
        let mut sum = 0.0;
        let mut step = |time: f64| {
            y[0] += 0.1;
            system.derivatives(time, &y, &modes, &mut scratch, &mut dy);
            if *derived {
                system.tangent(time, &y, &modes, &direction, &mut scratch, &mut dy);
            }
            system.observe(time, &y, &modes, &mut scratch, &mut states);
            sum += system.energy(time, &y, &modes, &mut scratch).kinetic;
        };
        step(0.0);
        let before = allocations();
        for index in 0..100 {
            step(1e-3 * f64::from(index));
        }
        assert_eq!(allocations() - before, 0, "case {case}");
        assert!(sum.is_finite() && sum != 0.0, "case {case}: {sum}");
    }
}

/// A full turn of kinetostatics with friction, in both directions of the
/// question: driving force of a motion, and motion under a driving force.
#[test]
fn kinetostatics_allocate_nothing() {
    use dam::linkage::kinetostatics::{InputMotion, Kinetostatics, Options};
    use dam::scene::{BuiltIn, Document, Overrides};
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    for name in ["slider_crank", "slotted_lever"] {
        let path = root.join(format!("scenarios/kinetostatics/{name}.json"));
        let document = Document::parse(name, &std::fs::read(path).unwrap()).unwrap();
        let reading = document.scene(&BuiltIn, &Overrides::none()).unwrap();
        let model = dam::lower::lower(&reading.scene).unwrap();
        let linkage = &model.linkages[0].linkage;
        let solver = Kinetostatics::new(linkage.spec()).unwrap();
        let (mut at, mut w) = (linkage.workspace(), solver.workspace());
        let options = Options::default();
        let now = || allocations();
        let mut proved = 0;
        for step in 0..36 {
            let coordinate = f64::from(step) * 0.1745;
            let before = now();
            linkage.solve(coordinate, 3, &mut at).unwrap();
            let motion = InputMotion {
                coordinate,
                speed: 10.0,
                acceleration: 3.0,
            };
            let solved = solver.solve(&at, motion, &options, &mut w).unwrap();
            assert!(solved.unique && now() == before, "{name} {coordinate}");
            let (drive, before) = (w.driver_force(), now());
            let back = solver.accelerate(&at, coordinate, 10.0, drive, &options, &mut w);
            // Where uniqueness is not proved, others are looked for.
            if back.unwrap().solved.is_some_and(|solved| solved.unique) {
                assert_eq!(now(), before, "{name} {coordinate}");
                proved += 1;
            }
        }
        assert!(proved > 9, "{name}: {proved}");
    }
}
