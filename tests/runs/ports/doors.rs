//! Functions from outside the library: constraints, loads.

use super::{METHODS, document, read, ready, run_by};
use approx::{assert_abs_diff_eq, assert_relative_eq};
use dam::constraint::{Constraint, ConstraintFunction, ConstraintJet};
use dam::integrate::{Dynamics, Method};
use dam::load::{Force, LoadFunction};
use dam::model::{Coordinate, LoadLaw, Pair};
use dam::object::{Context, Inputs, Kind, ModelBuilder, Object, Place, Port, Ports, Registry};
use dam::position::Position;
use dam::read::{Bounds, Fields};
use std::sync::Arc;

/// A cam on a moving carrier: φ = φ₂ + A·sin(φ₁ − φ₂).
#[derive(Debug)]
struct CarriedCam {
    amplitude: f64,
}

impl ConstraintFunction for CarriedCam {
    fn drivers(&self) -> usize {
        2
    }

    fn jet(&self, at: &[f64], jet: &mut ConstraintJet) {
        let (sin, cos) = (at[0] - at[1]).sin_cos();
        let a = self.amplitude;
        jet.value = at[1] + a * sin;
        jet.first.copy_from_slice(&[a * cos, 1.0 - a * cos]);
        let sign = |i: usize| if i == 0 { 1.0 } else { -1.0 };
        for i in 0..2 {
            for j in 0..2 {
                jet.second[2 * i + j] = -a * sin * sign(i) * sign(j);
                for l in 0..2 {
                    jet.third[4 * i + 2 * j + l] = -a * cos * sign(i) * sign(j) * sign(l);
                }
            }
        }
    }

    fn formula(&self, drivers: &[String]) -> String {
        format!(
            "{1} + {2}·sin({0} − {1})",
            drivers[0], drivers[1], self.amplitude
        )
    }
}

/// A magnetic detent: −M·sin(n·φ), damped.
#[derive(Debug)]
struct Detent {
    moment: f64,
    teeth: f64,
    damping: f64,
}

impl LoadFunction for Detent {
    fn force(&self, displacement: f64, speed: f64) -> Force {
        let (sin, cos) = (self.teeth * displacement).sin_cos();
        Force {
            value: -self.moment * sin - self.damping * speed,
            by_displacement: -self.moment * self.teeth * cos,
            by_speed: -self.damping,
        }
    }

    fn magnitude(&self) -> f64 {
        self.moment
    }

    fn description(&self) -> String {
        format!("detent of {} teeth", self.teeth)
    }
}

#[derive(Debug)]
struct Follower {
    inertia: f64,
    amplitude: f64,
    teeth: f64,
    damping: f64,
}

impl Object for Follower {
    fn kind(&self) -> &'static str {
        KIND.name
    }

    fn ports(&self) -> Ports {
        Ports {
            inputs: vec![Port::input("cam"), Port::input("carrier")],
            ..Ports::source(Coordinate::Turning)
        }
    }

    fn lower(&self, at: &Place, into: &mut ModelBuilder) {
        let (Some(cam), Some(carrier)) = (at.input("cam"), at.input("carrier")) else {
            return;
        };
        let constraint = Constraint::Custom(Arc::new(CarriedCam {
            amplitude: self.amplitude,
        }));
        let sum = into.combine(at, &[cam, carrier], constraint);
        let straight = Position::Ratio {
            ratio: 1.0,
            offset: 0.0,
        };
        let Some(law) = into.law(at, "inputs", &sum, straight, 1.0) else {
            return;
        };
        let node = into.rigid(at, law, self.inertia, Pair::default());
        let detent = Detent {
            moment: 0.5,
            teeth: self.teeth,
            damping: self.damping,
        };
        let function = Arc::new(detent);
        into.force(
            at,
            node,
            "detent",
            LoadLaw::Function {
                function,
                factor: 1.0,
            },
        );
    }
}

fn number(fields: &mut Fields<'_>, name: &'static str) -> Option<f64> {
    fields.need(name, "A number.", |slot| slot.number(Bounds::ANY))
}

const KIND: Kind = Kind {
    name: "carried_follower",
    doc: "The follower of a cam on a moving carrier.",
    inputs: Inputs::Several,
    outputs: Kind::no_outputs,
    coordinate: |_| Some(Coordinate::Turning),
    read: |fields: &mut Fields<'_>, context: &Context<'_>| {
        let inputs = fields.need("inputs", "Cam and carrier.", |slot| {
            slot.record(|fields| {
                let mut one = |name: &'static str| {
                    fields.need(name, "What moves it.", |slot| {
                        slot.record(|fields| context.connect(fields, "object", name))
                    })
                };
                let (cam, carrier) = (one("cam"), one("carrier"));
                cam.and(carrier)
            })
        });
        let (inertia, amplitude) = (number(fields, "inertia"), number(fields, "amplitude"));
        let (teeth, damping) = (number(fields, "teeth"), number(fields, "damping"));
        inputs?;
        Some(Box::new(Follower {
            inertia: inertia?,
            amplitude: amplitude?,
            teeth: teeth?,
            damping: damping?,
        }))
    },
};

fn scene(carrier: &str, damping: f64) -> dam::scene::TypedScene {
    let objects = format!(
        r#""m": {{ "kind": "drive", "motor": {{ "inertia": 0.2, "speed": 6, "torque": {{ "constant": 0 }} }} }},
        "c": {{ "kind": "drive", {carrier} }},
        "f": {{ "kind": "carried_follower", "inertia": 0.3, "amplitude": 0.4, "teeth": 3,
            "damping": {damping},
            "inputs": {{ "cam": {{ "object": "m" }}, "carrier": {{ "object": "c" }} }} }}"#
    );
    let run = r#""duration": 1.5, "start": "on_law", "tolerance": 1e-11"#;
    read(&document(
        &objects,
        run,
        Registry::standard().with_kind(KIND),
    ))
}

/// Two free coordinates: T + V is kept, with T = ½(J_m·φ̇_m² + J_c·φ̇_c² + J·φ̇²) and
/// V = −(M/n)·cos nφ of the detent.
#[test]
fn a_constraint_and_a_load_of_ones_own_keep_the_energy() {
    let scene = scene(
        r#""motor": { "inertia": 0.1, "torque": { "constant": 0 } }"#,
        0.0,
    );
    let (system, settings) = ready(&scene);
    let energy = |[m, c]: [f64; 2], [v_m, v_c]: [f64; 2]| {
        let phi = c + 0.4 * (m - c).sin();
        let slope = 0.4 * (m - c).cos();
        let speed = slope * v_m + (1.0 - slope) * v_c;
        0.5 * (0.2 * v_m * v_m + 0.1 * v_c * v_c + 0.3 * speed * speed)
            - 0.5 / 3.0 * (3.0 * phi).cos()
    };
    for method in METHODS {
        let result = run_by(&system, &settings, Some(method));
        let [m, c, f] = ["m", "c", "f"].map(|id| result.figures.objects[id].end);
        let phi = c.displacement + 0.4 * (m.displacement - c.displacement).sin();
        assert_relative_eq!(f.displacement, phi, max_relative = 1e-12);
        let end = energy([m.displacement, c.displacement], [m.speed, c.speed]);
        assert_relative_eq!(end, energy([0.0; 2], [6.0, 0.0]), max_relative = 1e-8);
        assert!(result.figures.run.energy_error < 1e-8);
    }
}

#[test]
fn they_are_shown_and_refuse_what_they_cannot_do() {
    let scene = scene(r#""motion": { "speed": 2 }"#, 0.1);
    let (system, settings) = ready(&scene);
    let result = run_by(&system, &settings, None);
    assert!(result.figures.run.energy_error < 1e-8);
    let model = system.model();
    let tree = dam::report::show::graph::tree(&dam::report::diagram::Diagram::of(model));
    assert!(
        tree.contains("φ_carrier + 0.4·sin(φ_cam − φ_carrier)"),
        "{tree}"
    );
    let equations = dam::report::show::equations::equations(model);
    let text = dam::report::show::equations::text(&equations);
    assert!(text.contains("detent of 3 teeth"), "{text}");
    assert!(text.contains("driven by m and c"), "{text}");
    let control = dam::studies::Control::default();
    let asked = dam::studies::RunSettings {
        method: Some(Method::Taylor),
        ..settings
    };
    let refused = dam::studies::run::run(&system, &asked, &control, &mut []).unwrap_err();
    assert!(
        refused[0].message.contains("`taylor` cannot be used"),
        "{refused:?}"
    );
}

/// The Jacobian of a constraint that is not linear.
#[test]
fn its_jacobian_agrees_with_differences() {
    let scene = scene(
        r#""motor": { "inertia": 0.1, "torque": { "constant": 1 } }"#,
        0.2,
    );
    let (system, _) = ready(&scene);
    let start = system.initial_state().unwrap();
    let mut scratch = system.scratch();
    let y = [0.7, -0.2, 5.0, 2.0];
    for column in 0..4 {
        let mut direction = [0.0; 4];
        direction[column] = 1.0;
        let mut exact = [0.0; 4];
        system.tangent(0.0, &y, &start.modes, &direction, &mut scratch, &mut exact);
        let mut at = |side: f64| {
            let mut moved = y;
            moved[column] += side * 1e-5;
            let mut dy = [0.0; 4];
            system.derivatives(0.0, &moved, &start.modes, &mut scratch, &mut dy);
            dy
        };
        let (above, below) = (at(1.0), at(-1.0));
        for row in 0..4 {
            let difference = (above[row] - below[row]) / 2e-5;
            assert_abs_diff_eq!(exact[row], difference, epsilon = 1e-6);
        }
    }
}
