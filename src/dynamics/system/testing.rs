//! Small models for the tests of the system.

use crate::dynamics::model::*;
use crate::kinematics::breaks::Breaks;
use crate::kinematics::motion::DriveMotion;
use crate::kinematics::position::{Position, PositionFunction};
use crate::math::jet::Jet;

/// U = e^(φ/3) + φ/5, as a function that the library does not know.
#[derive(Debug)]
pub(super) struct Exponential;

impl PositionFunction for Exponential {
    fn jet(&self, _segment: i64, phi: f64) -> Jet {
        let value = (phi / 3.0).exp();
        Jet {
            value: value + phi / 5.0,
            first: value / 3.0 + 0.2,
            second: value / 9.0,
            third: value / 27.0,
        }
    }
}

/// U of a central slider-crank: r cos φ + √(l² − r² sin² φ).
#[derive(Debug)]
pub(super) struct SliderCrank {
    pub(super) crank: f64,
    pub(super) rod: f64,
}

impl PositionFunction for SliderCrank {
    fn jet(&self, _segment: i64, phi: f64) -> Jet {
        let (sin, cos) = phi.sin_cos();
        let (double_sin, double_cos) = (2.0 * phi).sin_cos();
        // q = l² − r² sin² φ with its derivatives, then those of its root.
        let square = self.crank * self.crank;
        let q = self.rod * self.rod - square * sin * sin;
        let (q1, q2, q3) = (
            -square * double_sin,
            -2.0 * square * double_cos,
            4.0 * square * double_sin,
        );
        let root = q.sqrt();
        let first = q1 / (2.0 * root);
        let second = (q2 - 2.0 * first * first) / (2.0 * root);
        let third = (q3 - 6.0 * first * second) / (2.0 * root);
        Jet {
            value: self.crank * cos + root,
            first: -self.crank * sin + first,
            second: -self.crank * cos + second,
            third: self.crank * sin + third,
        }
    }
}

/// U = φ³/6 + φ/2 for φ ≥ 0 and a straight line below: two segments.
#[derive(Debug)]
pub(super) struct TwoPieces;

impl PositionFunction for TwoPieces {
    fn jet(&self, segment: i64, phi: f64) -> Jet {
        let curved = if segment > 0 { 1.0 } else { 0.0 };
        Jet {
            value: curved * phi.powi(3) / 6.0 + phi / 2.0,
            first: curved * phi * phi / 2.0 + 0.5,
            second: curved * phi,
            third: curved,
        }
    }

    fn breaks(&self) -> Breaks {
        Breaks {
            points: vec![0.0],
            period: None,
        }
    }
}

/// A driven object to be added to a model.
#[derive(Clone, Debug)]
pub(super) struct Body {
    pub(super) position: Position,
    pub(super) inertias: Vec<f64>,
    pub(super) stiffnesses: Vec<f64>,
    pub(super) dampings: Vec<f64>,
    pub(super) pair: Pair,
}

/// A pair of a closure, Kelvin–Voigt, without gap.
pub(super) fn pair(closure: Closure) -> Pair {
    Pair {
        closure,
        gap: 0.0,
        opens: 1.0,
        form: ContactForm::default(),
    }
}

/// Adds a drive at constant speed; the number of the object.
pub(super) fn add_drive(model: &mut Model, speed: f64, angle: f64) -> usize {
    add_root(
        model,
        NodeMotion::Prescribed {
            motion: DriveMotion::Constant { speed, angle },
            track: None,
        },
        0.0,
        "drive",
    )
}

/// Adds a motor's rotor; the number of the object.
pub(super) fn add_rotor(model: &mut Model, inertia: f64, angle: f64, speed: f64) -> usize {
    add_root(model, NodeMotion::Rotor { angle, speed }, inertia, "motor")
}

fn add_root(model: &mut Model, motion: NodeMotion, inertia: f64, id: &str) -> usize {
    let node = model.nodes.len();
    model.nodes.push(Node { inertia, motion });
    add_part(
        model,
        format!("{id}{node}"),
        "drive",
        vec![node],
        None,
        vec![],
    )
}

fn add_part(
    model: &mut Model,
    id: String,
    kind: &'static str,
    nodes: Vec<usize>,
    driver: Option<usize>,
    links: Vec<usize>,
) -> usize {
    model.objects.push(ObjectPart {
        id,
        kind,
        coordinate: Coordinate::Turning,
        nodes,
        inputs: PartInput::behind_one_driver(driver),
        links,
        combination: None,
        contact: None,
        driven_end: None,
        rigid_pair: None,
        pressing: None,
    });
    model.objects.len() - 1
}

/// Adds a driven object, rigid when it has no stiffnesses; its number.
pub(super) fn add_body(model: &mut Model, driver: usize, body: &Body) -> usize {
    let object = model.objects.len();
    let breaks = body.position.breaks();
    let source = *model.objects[driver].nodes.last().unwrap();
    let track = (!breaks.is_empty()).then(|| {
        model.tracks.push(Track {
            source: TrackSource::Node(source),
            repeats: breaks.period.is_some(),
            breaks,
            stops: false,
            object,
        });
        model.tracks.len() - 1
    });
    let law = Law {
        driver: source,
        position: body.position.clone(),
        lever: 1.0,
        track,
    };
    let first = model.nodes.len();
    let id = format!("body{first}");
    if body.stiffnesses.is_empty() {
        model.nodes.push(Node {
            inertia: body.inertias[0],
            motion: NodeMotion::Rigid { law },
        });
        let part = add_part(model, id, "rocker", vec![first], Some(driver), vec![]);
        model.objects[part].rigid_pair = Some(body.pair);
        return part;
    }
    let first_link = model.links.len();
    for m in 0..body.inertias.len() {
        model.nodes.push(Node {
            inertia: body.inertias[m],
            motion: NodeMotion::Mass { law: law.clone() },
        });
        model.links.push(Link {
            mass: first + m,
            base: match m {
                0 => LinkBase::Law { pair: body.pair },
                _ => LinkBase::Mass(first + m - 1),
            },
            stiffness: body.stiffnesses[m],
            damping: body.dampings[m],
        });
    }
    let nodes = (first..model.nodes.len()).collect();
    let links = (first_link..model.links.len()).collect();
    add_part(model, id, "rocker", nodes, Some(driver), links)
}

/// Adds a load on mass `mass` (from 0) of an object.
pub(super) fn add_load(model: &mut Model, object: usize, mass: usize, name: &str, law: LoadLaw) {
    let part = &model.objects[object];
    model.loads.push(Load {
        node: part.nodes[mass],
        name: format!("{}.loads.{name}", part.id),
        law,
    });
}

/// The rocker of the published test: n masses, J = 0.1 kg·m², c = 10⁷ N·m/rad,
/// U = (π/2)·sin φ at 10 rev/s, a constant moment on the last mass.
pub(super) fn rocker(masses: usize, psi: f64, moment: f64, pair: Pair, start: Start) -> Model {
    let mut model = Model {
        start,
        ..Model::default()
    };
    let drive = add_drive(&mut model, 20.0 * std::f64::consts::PI, 0.0);
    let rocker = add_body(&mut model, drive, &rocker_body(masses, psi, pair));
    if moment != 0.0 {
        add_load(
            &mut model,
            rocker,
            masses - 1,
            "closing",
            LoadLaw::constant(moment),
        );
    }
    model
}

/// The rocker of the published test as a body.
pub(super) fn rocker_body(masses: usize, psi: f64, pair: Pair) -> Body {
    let n = masses as f64;
    let share = |m: usize| {
        let m = m as f64;
        ((m + 1.0).powi(3) - m.powi(3)) / n.powi(3)
    };
    let stiffness = n * 1e7;
    let base_frequency = (1e7f64 / 0.1).sqrt();
    let damping = psi * stiffness / (2.0 * std::f64::consts::PI * base_frequency);
    Body {
        position: Position::Sine {
            amplitude: std::f64::consts::FRAC_PI_2,
            harmonic: 1.0,
            phase: 0.0,
            offset: 0.0,
        },
        inertias: (0..masses).map(|m| 0.1 * share(m)).collect(),
        stiffnesses: vec![stiffness; masses],
        dampings: vec![damping; masses],
        pair,
    }
}
