//! Scenes built by hand, and what they lower to.

mod reach;
mod structure;

use super::{FREE_FALL, lower};
use crate::dynamics::builder::spec::*;
use crate::dynamics::model::{
    Closure, ContactForm, Coordinate, LinkBase, LoadLaw, Model, NodeMotion, Start, TrackSource,
};
use crate::frontend::object::{Connection, INPUT, ModelBuilder, Object, Place, Ports};
use crate::frontend::scene::{RunSpec, SceneObject, StartSpec, TypedScene};
use crate::kinematics::position::PositionSpec;
use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

#[derive(Debug)]
struct Part(Coordinate, Spec);

#[derive(Debug)]
enum Spec {
    Drive(DriveSpec),
    Chain(ChainSpec),
}

impl Object for Part {
    fn kind(&self) -> &'static str {
        "part"
    }

    fn ports(&self) -> Ports {
        match &self.1 {
            Spec::Drive(_) => Ports::source(self.0),
            Spec::Chain(_) => Ports::with_one_driver(self.0),
        }
    }

    fn lower(&self, at: &Place, into: &mut ModelBuilder) {
        match &self.1 {
            Spec::Drive(spec) => into.add_drive(at, spec),
            Spec::Chain(spec) => into.chain(at, at.input(INPUT), spec),
        }
    }
}

fn scene(parts: Vec<(&str, Option<&str>, Part)>) -> TypedScene {
    let objects = parts
        .into_iter()
        .map(|(id, input, part)| {
            let connection = |input: &str| Connection {
                port: INPUT.to_owned(),
                output: input.to_owned(),
            };
            let entry = SceneObject {
                connections: input.map(connection).into_iter().collect(),
                mentions: Vec::new(),
                object: Box::new(part),
            };
            (id.to_owned(), entry)
        })
        .collect();
    TypedScene {
        name: "test".into(),
        objects,
        run: RunSpec {
            accuracy: None,
            duration: 1.0,
            start: StartSpec::OnLaw,
            method: "auto".into(),
            tolerance: 1e-6,
            tolerance_given: false,
            step: None,
            samples: 10,
            switch_rows: false,
            masses: false,
            window: None,
            max_switches: 1000,
            conditions: Vec::new(),
        },
        steady: None,
        optimize: None,
        tolerance: None,
        identify: None,
        expect: Vec::new(),
        measured: Vec::new(),
        hash: String::new(),
    }
}

fn drive(speed: f64, angle: f64) -> Part {
    let motion = DriveMotionSpec::Constant { speed, angle };
    Part(
        Coordinate::Turning,
        Spec::Drive(DriveSpec::Prescribed(motion)),
    )
}

fn motor(angle: f64) -> Part {
    let spec = MotorSpec {
        inertia: 0.2,
        angle,
        speed: 3.0,
        torque: LoadLawSpec::Declared(LawInstance::linear_motor(10.0, 100.0)),
        loads: vec![load(
            "drag",
            LoadLawSpec::Declared(LawInstance::viscous(0.1)),
        )],
    };
    Part(Coordinate::Turning, Spec::Drive(DriveSpec::Motor(spec)))
}

fn load(name: &str, law: LoadLawSpec) -> LoadSpec {
    LoadSpec {
        name: name.into(),
        mass: MassChoice::Last,
        law,
    }
}

fn rigid(inertia: f64) -> BodySpec {
    BodySpec::Rigid { inertia }
}

fn uniform(masses: usize) -> BodySpec {
    BodySpec::Uniform {
        inertia: 0.1,
        stiffness: 1e7,
        damping_capacity: 0.4,
        masses,
        split: InertiaSplit::Cubes,
        lumping: Lumping::Ends,
    }
}

fn chain(coordinate: Coordinate, position: PositionSpec, body: BodySpec) -> ChainSpec {
    ChainSpec {
        coordinate,
        position,
        lever: 1.0,
        body,
        pair: PairSpec {
            closure: Closure::Force,
            gap: 0.0,
            opens: 1.0,
            form: ContactForm::default(),
            contact: None,
        },
        loads: Vec::new(),
        stops: Vec::new(),
    }
}

fn part(spec: ChainSpec) -> Part {
    Part(spec.coordinate, Spec::Chain(spec))
}

fn ratio() -> PositionSpec {
    PositionSpec::Ratio {
        ratio: 1.0,
        offset: 0.0,
    }
}

/// Turns fully: a crank-slider.
fn slider_crank(crank: f64) -> PositionSpec {
    PositionSpec::SliderCrank {
        crank,
        rod: 0.2,
        offset: 0.0,
        branch: 1.0,
        phase: 0.0,
    }
}

fn lowered(parts: Vec<(&str, Option<&str>, Part)>) -> Model {
    lower(&scene(parts)).unwrap()
}

fn fault_paths(parts: Vec<(&str, Option<&str>, Part)>) -> Vec<String> {
    let faults = lower(&scene(parts)).unwrap_err();
    faults.into_iter().map(|fault| fault.path).collect()
}
