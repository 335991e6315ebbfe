//! The library's face: scenes in code, errors, what is asked beside runs.

use approx::{assert_abs_diff_eq, assert_relative_eq};
use dam::build::OwnObject;
use dam::model::{Coordinate, LoadLaw, Pair as ModelPair};
use dam::object::{INPUT, ModelBuilder, Object, Place, Ports};
use dam::position::Position as PositionFunction;
use dam::prelude::*;
use std::error::Error as _;

fn rocker() -> Scene {
    Scene::new("A rocker")
        .add("shaft", Drive::speed("10 rev/s"))
        .add("rocker", swinging())
        .duration(0.1)
}

fn swinging() -> Rocker {
    Rocker::on("shaft")
        .position(Position::sine("90 deg"))
        .inertia(0.1)
        .stiffness(1e7)
}

#[test]
fn faults_of_scenes_in_code_name_their_property() {
    let scene = rocker()
        .add(
            "slide",
            Slider::on("rocke")
                .position(Position::sine(f64::NAN))
                .inertia(-1.0),
        )
        .add("shaft", Drive::speed(3.0));
    let error = scene.run().unwrap_err();
    let paths: Vec<&str> = error
        .faults()
        .iter()
        .map(|fault| fault.path.as_str())
        .collect();
    for path in [
        "shaft",
        "slide.input",
        "slide.position.sine.amplitude",
        "slide.inertia",
    ] {
        assert!(paths.contains(&path), "{path} in {paths:?}");
    }
    let text = error.to_string();
    for part in [
        "error[unknown-object]: unknown object `rocke`",
        "--> slide.input",
        "did you mean `rocker`?",
        "`amplitude` is not a number",
        "the object `shaft` is given twice",
    ] {
        assert!(text.contains(part), "{part} in\n{text}");
    }
    assert_eq!(format!("{error:?}"), format!("\n{text}"));
    // Settings have a text, and an excerpt of it.
    let error = rocker().set("rocker.masses", -1).run().unwrap_err();
    assert!(error.to_string().contains("rocker.masses=-1"), "{error}");
    // Faults of the model have their property too.
    let far = Position::slider_crank("50 mm", "20 mm");
    let slide = Slider::on("shaft").position(far).masses(0).inertia(1);
    let error = rocker()
        .set("shaft.motion.angle", "60 deg")
        .add("slide", slide)
        .run()
        .unwrap_err();
    assert!(error.to_string().contains("--> slide.position"), "{error}");
}

#[test]
fn one_error_for_files_texts_and_names() {
    let missing = Scene::read("no/such/scene.json").unwrap_err();
    assert!(missing.source().is_some());
    assert!(missing.to_string().contains("no/such/scene.json"));
    let broken = "{ \"dam\": 1, ".parse::<Scene>().unwrap_err();
    assert!(broken.to_string().contains("--> scene:1:"), "{broken}");
    let run = rocker().run().unwrap();
    let unknown = run.delta("roker").unwrap_err();
    assert!(unknown.to_string().contains("did you mean `rocker`?"));
    let nothing = run.figure("rocker", Figure::MaxLift).unwrap_err();
    assert_eq!(nothing.faults()[0].path, "rocker.pair.max_lift");
    let axis = Axis::linear("rocker.inertia", 1.0, 1.0, 3);
    let question = rocker().map(axis).ask().unwrap_err();
    assert!(question.to_string().contains("too close"), "{question}");
}

#[test]
fn a_scene_in_code_is_the_text_that_it_writes() {
    let scene = rocker().set("rocker.masses", 3);
    let again = Scene::from_json(scene.json()).unwrap();
    let again = again.set("rocker.masses", 3);
    let [one, other] = [scene, again].map(|scene| scene.decode().unwrap());
    assert_eq!(one.scene.hash, other.scene.hash);
}

#[test]
fn what_is_said_last_holds() {
    let scene = rocker().set("run.duration", 0.3).duration(0.2);
    assert_eq!(scene.decode().unwrap().scene.run.duration, 0.2);
    let scene = rocker().duration(0.2).set("run.duration", 0.3);
    assert_eq!(scene.decode().unwrap().scene.run.duration, 0.3);
}

#[test]
fn options_change_a_run_and_are_checked_like_the_scene() {
    let options = RunOptions {
        samples: Some(50),
        tolerance: Some(1e-8),
        method: Some(Method::Dop853),
        ..RunOptions::default()
    };
    let run = rocker().run_with(&options).unwrap();
    assert_eq!((run.times().len(), run.method), (51, Method::Dop853));
    let wrong = RunOptions {
        tolerance: Some(-1.0),
        ..RunOptions::default()
    };
    let error = rocker().run_with(&wrong).unwrap_err();
    assert_eq!(error.faults()[0].path, "run.tolerance");
}

#[test]
fn columns_have_typed_keys() {
    let run = rocker().run().unwrap();
    let all: Vec<&[f64]> = [
        run.displacement("rocker"),
        run.speed("rocker"),
        run.acceleration("rocker"),
        run.delta("rocker"),
        run.reaction("rocker"),
        run.contact_force("rocker"),
    ]
    .map(Result::unwrap)
    .to_vec();
    for (quantity, column) in Quantity::ALL.into_iter().zip(all) {
        assert_eq!(run.column("rocker", quantity).unwrap(), column);
        assert_eq!(column.len(), run.times().len());
    }
    let law = |t: f64| std::f64::consts::FRAC_PI_2 * (20.0 * std::f64::consts::PI * t).sin();
    let rows = run.times().iter().zip(run.displacement("rocker").unwrap());
    for ((time, place), delta) in rows.zip(run.delta("rocker").unwrap()) {
        assert_abs_diff_eq!(place - delta, law(*time), epsilon = 1e-12);
    }
}

#[test]
fn masses_and_links_are_recorded_on_request() {
    let scene = rocker().set("rocker.masses", 3);
    let run = scene.clone().record_all().run().unwrap();
    let last = Quantity::MassDisplacement(3);
    assert_eq!(
        run.column("rocker", last).unwrap(),
        run.displacement("rocker").unwrap()
    );
    let first = Quantity::LinkForce(1);
    assert_eq!(
        run.column("rocker", first).unwrap(),
        run.reaction("rocker").unwrap()
    );
    let error = scene.run().unwrap().column("rocker", last).unwrap_err();
    assert!(error.to_string().contains("record_all"), "{error}");
}

/// A flywheel with a brake on a shaft: one rigid node, a moment, an input.
#[derive(Debug)]
struct BrakedFlywheel {
    inertia: f64,
    braking: f64,
}

impl Object for BrakedFlywheel {
    fn kind(&self) -> &'static str {
        "braked_flywheel"
    }

    fn ports(&self) -> Ports {
        Ports::with_one_driver(Coordinate::Turning)
    }

    fn lower(&self, at: &Place, into: &mut ModelBuilder) {
        let Some(shaft) = at.input(INPUT) else {
            return;
        };
        let ratio = PositionFunction::Ratio {
            ratio: 1.0,
            offset: 0.0,
        };
        if let Some(law) = into.law(at, "", shaft, ratio, 1.0) {
            let node = into.rigid(at, law, self.inertia, ModelPair::default());
            into.force(at, node, "brake", LoadLaw::constant(-self.braking));
        }
    }
}

#[test]
fn an_own_object_is_driven_by_a_motor() {
    let (inertia, torque, braking) = (0.3, 12.0, 2.0);
    let wheel = BrakedFlywheel {
        inertia: 0.2,
        braking,
    };
    let scene = Scene::new("A flywheel")
        .add(
            "motor",
            Drive::motor(inertia - 0.2, Torque::constant(torque)),
        )
        .add("wheel", OwnObject::new(wheel).on("motor"))
        .duration(2);
    let run = scene.run().unwrap();
    let end = *run.speed("wheel").unwrap().last().unwrap();
    // Constant acceleration (T − M)/J.
    assert_relative_eq!(end, (torque - braking) / inertia * 2.0, max_relative = 1e-6);
    let unconnected = BrakedFlywheel {
        inertia: 1.0,
        braking,
    };
    let scene = Scene::new("Nothing drives it")
        .add("motor", Drive::speed(1))
        .add("wheel", OwnObject::new(unconnected))
        .duration(1);
    let error = scene.run().unwrap_err();
    assert_eq!(error.faults()[0].path, "wheel", "{error}");
}

#[test]
fn an_own_position_function_does_not_fit_a_gear() {
    #[derive(Debug)]
    struct Straight;
    impl dam::position::PositionFunction for Straight {
        fn jet(&self, _: i64, phi: f64) -> dam::jet::Jet {
            dam::jet::Jet {
                value: phi,
                first: 1.0,
                ..Default::default()
            }
        }
    }
    let with = |object: Node| rocker().add("other", object).run();
    type Node = dam::read::Node;
    let gear = Shaft::on("shaft")
        .position(Position::own(Straight))
        .inertia(1)
        .masses(0);
    let error = with(gear.into()).unwrap_err();
    assert_eq!(error.faults()[0].path, "other.position");
    let crank = Crank::on("shaft")
        .position(Position::own(Straight))
        .inertia(1)
        .masses(0);
    let run = with(crank.into()).unwrap();
    assert_eq!(
        run.displacement("other").unwrap(),
        run.displacement("shaft").unwrap()
    );
}

/// A cam on a moving carrier: φ = r·sin φ₁ + φ₂.
#[derive(Debug)]
struct CarriedCam(f64);

impl dam::constraint::ConstraintFunction for CarriedCam {
    fn drivers(&self) -> usize {
        2
    }

    fn jet(&self, at: &[f64], jet: &mut dam::constraint::ConstraintJet) {
        let (sin, cos) = at[0].sin_cos();
        jet.value = self.0 * sin + at[1];
        jet.first.copy_from_slice(&[self.0 * cos, 1.0]);
        jet.second.copy_from_slice(&[-self.0 * sin, 0.0, 0.0, 0.0]);
        jet.third.fill(0.0);
        jet.third[0] = -self.0 * cos;
    }
}

#[test]
fn an_own_constraint_combines_inputs() {
    let slide = Differential::new()
        .coordinate("sliding")
        .member("cam", "shaft")
        .member("carrier", "carriage")
        .combined_by(CarriedCam(0.01))
        .inertia(2)
        .masses(0);
    let scene = |slide: Differential| {
        Scene::new("A cam on a carriage")
            .add("shaft", Drive::speed(30))
            .add("carriage", Drive::speed(0.5).sliding())
            .add("slide", slide)
            .duration(0.3)
    };
    let run = scene(slide.clone()).run().unwrap();
    let rows = run.times().iter().zip(run.displacement("slide").unwrap());
    for ((t, place), force) in rows.zip(run.reaction("slide").unwrap()) {
        let law = 0.01 * (30.0 * t).sin();
        assert_abs_diff_eq!(*place, law + 0.5 * t, epsilon = 1e-9);
        // m·a of the prescribed motion.
        assert_abs_diff_eq!(force.abs(), (2.0 * 900.0 * law).abs(), epsilon = 1e-6);
    }
    let third = slide.clone().member("third", "shaft");
    let error = scene(third).run().unwrap_err();
    assert!(error.to_string().contains("2 drivers, not 3"), "{error}");
    let error = scene(slide.lever(0.1)).run().unwrap_err();
    assert!(error.to_string().contains("in one way"), "{error}");
}

#[test]
fn a_value_of_another_type_is_refused() {
    let own = || dam::read::Own::new(3);
    let mut load = dam::read::Node::object();
    load.set_property("own", own());
    let error = rocker().add("other", swinging().load("odd", load)).run();
    let error = error.unwrap_err();
    assert_eq!(error.faults()[0].path, "other.loads.odd.own", "{error}");
    let error = rocker().add("other", swinging().position(own())).run();
    let error = error.unwrap_err();
    assert_eq!(error.faults()[0].path, "other.position", "{error}");
}

/// A force that grows with the cube of the displacement.
#[derive(Debug)]
struct CubicSpring(f64);

impl dam::load::LoadFunction for CubicSpring {
    fn force(&self, displacement: f64, _: f64) -> dam::load::Force {
        dam::load::Force {
            value: -self.0 * displacement.powi(3),
            by_displacement: -3.0 * self.0 * displacement.powi(2),
            by_speed: 0.0,
        }
    }

    fn magnitude(&self) -> f64 {
        self.0
    }

    fn needs_speed(&self) -> bool {
        false
    }

    fn description(&self) -> String {
        "a cubic spring".to_owned()
    }
}

#[test]
fn an_own_load_holds_a_mass_in_balance() {
    // Held by the stiffness c and the cubic spring k: c·(U − φ) = k·φ³ at rest.
    let (stiffness, cubic, law) = (1e3, 2e4, 0.2);
    let slide = Slider::on("table")
        .position(Position::ratio(1))
        .inertia(1)
        .stiffness(stiffness)
        .load("cubic", Load::own(CubicSpring(cubic)));
    let scene = Scene::new("A cubic spring")
        .add("table", Drive::fixed(law).sliding())
        .add("slide", slide)
        .start("static")
        .duration(0.5);
    let run = scene.run().unwrap();
    let end = run.figure("slide", Figure::FinalDisplacement).unwrap();
    let rest: f64 = stiffness * (law - end) - cubic * end.powi(3);
    assert_abs_diff_eq!(rest, 0.0, epsilon = 1e-6 * stiffness * law);
    assert!(end < 0.15, "{end}");
}

fn slider_crank() -> Scene {
    let linkage = Linkage::on("motor")
        .driver("O")
        .ground("O", 0, 0)
        .link("crank", Link::new().point("A", "50 mm", 0))
        .link(
            "rod",
            Link::new()
                .point("B", "200 mm", 0)
                .mass("0.6 kg")
                .centre(("80 mm", 0))
                .moment(2.4e-3),
        )
        .link("slide", Link::new().mass("0.5 kg"))
        .pair("O", Joint::revolute("ground.O", "crank.origin"))
        .pair("A", Joint::revolute("crank.A", "rod.origin"))
        .pair("B", Joint::revolute("rod.B", "slide.origin"))
        .pair("guide", Joint::sliding("ground.O", 0, "slide.origin"))
        .assembly("slide", Assembly::near("200 mm", 0))
        .output("stroke", Output::point("slide.origin", 0));
    Scene::new("A slider-crank")
        .add("motor", Drive::speed("300 rpm"))
        .add("press", linkage)
        .duration(0.2)
}

#[test]
fn a_linkage_in_code_is_asked_for_its_motion_and_its_forces() {
    let found = slider_crank()
        .kinematics(&LinkageQuestion::default())
        .unwrap();
    let stroke = found
        .column("stroke", LinkageQuantity::Displacement)
        .unwrap();
    let inputs = found
        .column("input", LinkageQuantity::Displacement)
        .unwrap();
    for (angle, place) in inputs.iter().zip(stroke) {
        let (sin, cos) = angle.sin_cos();
        let wanted = 0.05 * cos + (0.04 - (0.05 * sin).powi(2)).sqrt();
        assert_abs_diff_eq!(*place, wanted, epsilon = 1e-12);
    }
    let error = found.column("stroke", LinkageQuantity::Angle).unwrap_err();
    assert!(error.to_string().contains("stroke."), "{error}");
    let forces = slider_crank().forces(&LinkageQuestion::default()).unwrap();
    assert_eq!(forces.solved().count(), forces.rows.len());
    assert!(forces.worst_balance() < 1e-10);
    let nobody = LinkageQuestion {
        object: Some("nobody".to_owned()),
        ..LinkageQuestion::default()
    };
    assert!(slider_crank().kinematics(&nobody).is_err());
}

#[test]
fn the_steady_motion_is_asked_for() {
    let scene = rocker().duration(1.0);
    let SteadyAnswer::Periodic(_) = scene.steady().unwrap() else {
        panic!("an elastic object behind a prescribed drive has a periodic motion");
    };
}

#[test]
fn comparisons_take_values_of_any_type() {
    let found = rocker()
        .compare("shaft.motion.speed", ["10 rev/s", "5 rev/s"])
        .unwrap();
    assert_eq!(found.table.labels, ["10 rev/s", "5 rev/s"]);
    let speeds: Vec<f64> = (found.runs.iter())
        .map(|run| run.result.figures("shaft").unwrap().peak_speed)
        .collect();
    assert_relative_eq!(speeds[0], 2.0 * speeds[1], max_relative = 1e-12);
}

#[test]
fn a_scene_that_says_how_accurate_it_is_to_be_is_judged_by_the_library_too() {
    let scene = rocker().set("rocker.masses", 2);
    let plain = scene.prepare().expect("a mechanism");
    assert!(plain.certificate.is_none());
    let judged = scene.set("run.accuracy", "10 %");
    let ready = judged.prepare().expect("a mechanism");
    let certificate = ready.certificate.as_ref().expect("a certificate");
    let found = &certificate.accuracy["rocker.delta_abs"];
    assert_eq!(certificate.models["rocker"].coordinates, 2);
    // The run is that of the model that was judged.
    let run = judged.run().expect("a run");
    let value = run.figures("rocker").expect("figures").delta_abs;
    assert_relative_eq!(value, found.value, max_relative = 1e-2);
    // The continuum's deviation under slow accelerations, 3/4 of that of one mass.
    let limit = found.limit.expect("a limit");
    assert!((value - limit).abs() <= found.error.expect("an error"));
    // What is no run is not judged.
    assert!(
        Mechanism::of(judged.decode().expect("a scene"))
            .unwrap()
            .certificate
            .is_none()
    );
}
