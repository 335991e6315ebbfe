//! Figures of runs against closed forms.

use approx::{assert_abs_diff_eq, assert_relative_eq};
use dam::integrate::Method;
use dam::model::{
    Closure, ContactForm, Coordinate, ExplicitStart, Law, Link, LinkBase, Load, LoadLaw, Model,
    Node, NodeMotion, ObjectPart, Pair, PartInput, Start,
};
use dam::motion::DriveMotion;
use dam::position::Position;
use dam::record::Quantity;
use dam::studies::run::{RunResult, run};
use dam::studies::spread::repeat_with_changes;
use dam::studies::{Control, RunSettings, Warning};
use dam::system::System;
use std::f64::consts::TAU;

const INERTIA: f64 = 2.0;
const STIFFNESS: f64 = 5000.0;
/// √(c/J) = 50 rad/s.
const FREQUENCY: f64 = 50.0;

fn pair(closure: Closure) -> Pair {
    Pair {
        closure,
        gap: 0.0,
        opens: 1.0,
        form: ContactForm::default(),
    }
}

/// A drive at 1 turn a second and one object behind it with a constant load.
fn one_object(position: Position, motion: fn(Law) -> NodeMotion, load: f64) -> Model {
    let law = Law {
        driver: 0,
        position,
        lever: 1.0,
        track: None,
    };
    let drive = NodeMotion::Prescribed {
        motion: DriveMotion::Constant {
            speed: TAU,
            angle: 0.0,
        },
        track: None,
    };
    let part = |id: &str, kind, node, driver| ObjectPart {
        id: id.to_owned(),
        kind,
        coordinate: Coordinate::Turning,
        nodes: vec![node],
        inputs: PartInput::behind_one_driver(driver),
        links: Vec::new(),
        combination: None,
        contact: None,
        driven_end: None,
        rigid_pair: None,
        pressing: None,
    };
    Model {
        nodes: vec![
            Node {
                inertia: 0.0,
                motion: drive,
            },
            Node {
                inertia: INERTIA,
                motion: motion(law),
            },
        ],
        loads: vec![Load {
            node: 1,
            name: "output.loads.load".to_owned(),
            law: LoadLaw::constant(load),
        }],
        objects: vec![
            part("drive", "drive", 0, None),
            part("output", "shaft", 1, Some(0)),
        ],
        start: Start::OnLaw,
        ..Model::default()
    }
}

fn elastic(position: Position, closure: Closure, damping: f64, load: f64) -> Model {
    let mut model = one_object(position, |law| NodeMotion::Mass { law }, load);
    model.links.push(Link {
        mass: 1,
        base: LinkBase::Law {
            pair: pair(closure),
        },
        stiffness: STIFFNESS,
        damping,
    });
    model.objects[1].links.push(0);
    model
}

fn straight(ratio: f64) -> Position {
    Position::Ratio { ratio, offset: 0.0 }
}

fn settings(duration: f64) -> RunSettings {
    RunSettings {
        method: Some(Method::Dop853),
        tolerance: 1e-11,
        ..RunSettings::new(duration)
    }
}

fn run_model(model: Model, settings: &RunSettings) -> RunResult {
    let system = System::new(model).expect("the model is sound");
    let result = run(&system, settings, &Control::default(), &mut []).expect("it starts");
    let sound = result.is_complete() && result.is_trusted();
    assert!(sound, "{:?} {:?}", result.outcome, result.warnings);
    result
}

#[test]
fn a_shaft_under_a_sudden_load_swings_about_its_deflection() {
    // x = −x₀·(1 − cos ωt), x₀ = W/c, on a shaft that turns at 2π.
    let load = 100.0;
    let deflection = load / STIFFNESS;
    let cycles = 4.0 * TAU / FREQUENCY;
    let model = elastic(straight(1.0), Closure::Bilateral, 0.0, -load);
    let result = run_model(model, &settings(cycles));
    let output = &result.figures.objects["output"];
    let close = |found: f64, wanted: f64| assert_relative_eq!(found, wanted, max_relative = 1e-9);
    close(output.delta_min, -2.0 * deflection);
    assert_abs_diff_eq!(output.delta_max, 0.0, epsilon = 1e-11 * deflection);
    close(output.sigma, deflection);
    close(output.peak_speed, TAU + deflection * FREQUENCY);
    close(output.peak_acceleration, deflection * FREQUENCY * FREQUENCY);
    close(output.peak_reaction, 2.0 * load);
    close(output.end.displacement, TAU * cycles);
    assert!(output.pair.is_none());
    assert_eq!(result.record.times.len(), 1001);
    assert!(result.audit.error() < 1e-11, "{:?}", result.audit);
}

/// A mass dropped on an undamped contact: flight, half a swing about the
/// static deflection, flight, …
#[test]
fn a_bouncing_mass_keeps_its_closed_form_times() {
    let (load, height) = (40.0, 0.01);
    let (fall, deflection) = ((2.0 * height * INERTIA / load).sqrt(), load / STIFFNESS);
    let impact = load / INERTIA * fall;
    // In contact x = −x₀ + x₀ cos ωt − (v/ω) sin ωt until x = 0 again.
    let contact = (TAU - 2.0 * (impact / FREQUENCY / deflection).atan()) / FREQUENCY;
    let bounces = 3;
    let duration = fall + f64::from(bounces) * (contact + 2.0 * fall) - fall;
    let mut model = elastic(straight(0.0), Closure::Force, 0.0, -load);
    model.start = Start::Explicit(vec![ExplicitStart {
        object: 1,
        displacement: vec![height],
        speed: vec![0.0],
    }]);
    let result = run_model(model, &settings(duration));
    let output = &result.figures.objects["output"];
    let pair = output.pair.as_ref().expect("it can open");
    assert_eq!((pair.separations, pair.closures), (3, 3));
    let mut time = 0.0;
    for (index, found) in pair.switch_times.iter().enumerate() {
        time += match index {
            0 => fall,
            odd if odd % 2 == 1 => contact,
            _ => 2.0 * fall,
        };
        assert_abs_diff_eq!(*found, time, epsilon = 1e-10);
    }
    let close = |found: f64, wanted: f64| assert_relative_eq!(found, wanted, max_relative = 1e-8);
    close(pair.max_lift, height);
    close(pair.max_approach_speed, impact);
    close(pair.longest_separation, 2.0 * fall);
    close(pair.separated_time, 6.0 * fall);
    let deepest = deflection + deflection.hypot(impact / FREQUENCY);
    close(output.delta_min, -deepest);
    close(pair.max_contact_force, STIFFNESS * deepest);
    close(output.delta_max, height);
    assert_eq!(result.record.separations.len(), 4);
    assert_eq!(result.record.switches.len(), 6);
    let opens = |warning: &Warning| matches!(warning, Warning::Opens { .. });
    assert!(result.warnings.iter().any(opens));
}

#[test]
fn a_rigid_follower_says_by_how_much_it_would_lift_off() {
    // N = M − J·A·Ω²·sin Ωt: least at a quarter turn.
    let (amplitude, load) = (0.5, 30.0);
    let law = Position::Sine {
        amplitude,
        harmonic: 1.0,
        phase: 0.0,
        offset: 0.0,
    };
    let mut model = one_object(law, |law| NodeMotion::Rigid { law }, -load);
    model.objects[1].rigid_pair = Some(pair(Closure::Force));
    let margin = load - INERTIA * amplitude * TAU * TAU;
    assert!(margin < 0.0);
    let result = run_model(model, &settings(3.0));
    let output = &result.figures.objects["output"];
    let figures = output.pair.as_ref().expect("a force-closed pair");
    assert_relative_eq!(figures.margin.unwrap(), margin, max_relative = 1e-10);
    assert_relative_eq!(
        figures.max_contact_force,
        load + INERTIA * amplitude * TAU * TAU,
        max_relative = 1e-10
    );
    assert_eq!(figures.in_working_order, Some(false));
    assert_eq!(
        (output.delta_max, output.delta_min, output.sigma),
        (0.0, 0.0, 0.0)
    );
    let time = result.warnings.iter().find_map(|warning| match warning {
        Warning::WouldLiftOff { time, .. } => Some(time.fract()),
        _ => None,
    });
    assert_abs_diff_eq!(time.expect("a warning"), 0.25, epsilon = 1e-6);
}

#[test]
fn working_order_is_judged_in_the_last_whole_cycle() {
    // Starts 10 mm above its flank, comes to rest on it within the first turn.
    let mut model = elastic(straight(0.0), Closure::Force, 100.0, -40.0);
    model.start = Start::Explicit(vec![ExplicitStart {
        object: 1,
        displacement: vec![0.01],
        speed: vec![0.0],
    }]);
    let result = run_model(model.clone(), &settings(4.0));
    assert_eq!(result.figures.run.window, Some([3.0, 4.0]));
    let order = |result: &RunResult| {
        let pair = result.figures.objects["output"].pair.clone();
        pair.expect("it can open").in_working_order
    };
    assert_eq!(order(&result), Some(true));
    let all = RunSettings {
        window: Some((0.0, 4.0)),
        ..settings(4.0)
    };
    assert_eq!(order(&run_model(model.clone(), &all)), Some(false));
    let short = run_model(model, &settings(2.0));
    assert_eq!(order(&short), None);
    assert!(short.figures.run.window_missing.is_some());
}

#[test]
fn switches_have_rows_before_and_after_when_asked_for() {
    let mut model = elastic(straight(0.0), Closure::Force, 20.0, -40.0);
    model.start = Start::Explicit(vec![ExplicitStart {
        object: 1,
        displacement: vec![0.01],
        speed: vec![0.0],
    }]);
    let wanted = RunSettings {
        switch_rows: true,
        masses: false,
        closeups: false,
        samples: 10,
        ..settings(0.1)
    };
    let result = run_model(model, &wanted);
    let switches = result.record.switches.len();
    assert!(switches >= 1);
    assert_eq!(result.record.times.len(), 11 + 2 * switches);
    let row = result
        .record
        .times
        .iter()
        .position(|&time| time == result.record.switches[0].time)
        .expect("a row at the switch");
    let column = |quantity| {
        let column = result.record.column("output", quantity);
        &column.expect("a column").values
    };
    // The damper makes the force jump from 0 to b·|v|; the displacement stays.
    let (force, speed) = (column(Quantity::ContactForce), column(Quantity::Speed));
    assert_eq!(force[row], 0.0);
    assert_relative_eq!(force[row + 1], 20.0 * speed[row].abs(), max_relative = 1e-9);
    let place = column(Quantity::Displacement);
    assert_eq!(place[row], place[row + 1]);
}

#[test]
fn the_spread_tells_determined_figures_from_others() {
    let model = elastic(straight(1.0), Closure::Bilateral, 30.0, -100.0);
    let system = System::new(model).expect("the model is sound");
    let wanted = settings(1.0);
    let base = run(&system, &wanted, &Control::default(), &mut []).expect("it starts");
    let spread =
        repeat_with_changes(&system, &wanted, &base, &Control::default()).expect("it starts");
    let of = |name: &str| {
        let mut figures = spread.figures.iter();
        figures
            .find(|entry| entry.figure == name)
            .expect("a figure")
    };
    assert!(spread.undetermined().next().is_none(), "{spread:?}");
    // A linear system: δ follows the load in proportion.
    let moved = of("output.delta_min");
    assert_relative_eq!(
        moved.by_loads.unwrap(),
        1e-10 * moved.value.abs(),
        max_relative = 0.2
    );
}
