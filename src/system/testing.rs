//! Small models for the tests of the system, and random ones.

use super::System;
use crate::breaks::Breaks;
use crate::integrate::Modes;
use crate::jet::Jet;
use crate::model::*;
use crate::motion::DriveMotion;
use crate::position::{Position, PositionFunction};
use std::sync::Arc;

/// Deterministic random numbers (SplitMix64).
pub(super) struct Random(pub(super) u64);

impl Random {
    /// The next number, uniform in [0, 1).
    pub(super) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Uniform between two bounds.
    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// One of 0 … count − 1.
    pub(super) fn below(&mut self, count: usize) -> usize {
        (self.unit() * count as f64) as usize
    }
}

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
        law: DampingLaw::KelvinVoigt,
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
        driver,
        links,
        rigid_pair: None,
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
            LoadLaw::Constant(moment),
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

/// A random mechanism of up to six bodies behind a drive or a motor, with all
/// kinds of pairs and loads; numbers of order one.
pub(super) fn random_model(random: &mut Random) -> Model {
    let mut model = Model::default();
    if random.below(2) == 0 {
        add_drive(
            &mut model,
            random.between(0.5, 2.0),
            random.between(-1.0, 1.0),
        );
    } else {
        let rotor = add_rotor(&mut model, random.between(0.5, 2.0), 0.3, 1.1);
        add_load(&mut model, rotor, 0, "torque", random_load(random));
    }
    for _ in 0..1 + random.below(5) {
        let driver = random.below(model.objects.len());
        let body = random_body(random);
        let object = add_body(&mut model, driver, &body);
        for _ in 0..random.below(3) {
            let mass = random.below(model.objects[object].nodes.len());
            let law = random_load(random);
            add_load(&mut model, object, mass, "some", law);
        }
    }
    add_tables(&mut model, random);
    model
}

fn random_body(random: &mut Random) -> Body {
    let masses = random.below(4);
    let list = |random: &mut Random, count: usize, low: f64, high: f64| -> Vec<f64> {
        (0..count).map(|_| random.between(low, high)).collect()
    };
    let closure = [Closure::Bilateral, Closure::Force, Closure::Form][random.below(3)];
    let kappa = Some(random.between(0.0, 0.5));
    Body {
        position: random_position(random),
        inertias: list(random, masses.max(1), 0.2, 2.0),
        stiffnesses: list(random, masses, 5.0, 50.0),
        dampings: list(random, masses, 0.0, 1.0),
        pair: Pair {
            closure,
            gap: [0.0, 0.1][random.below(2)],
            opens: [1.0, -1.0][random.below(2)],
            law: [DampingLaw::KelvinVoigt, DampingLaw::HuntCrossley { kappa }][random.below(2)],
        },
    }
}

fn random_position(random: &mut Random) -> Position {
    match random.below(4) {
        0 => Position::Ratio {
            ratio: random.between(-1.5, 1.5),
            offset: random.between(-0.5, 0.5),
        },
        1 => Position::Sine {
            amplitude: random.between(0.3, 1.0),
            harmonic: random.between(0.5, 2.0),
            phase: random.between(0.0, 6.0),
            offset: 0.1,
        },
        2 => Position::Custom(Arc::new(Exponential)),
        _ => Position::Custom(Arc::new(TwoPieces)),
    }
}

fn random_load(random: &mut Random) -> LoadLaw {
    match random.below(7) {
        0 => LoadLaw::Constant(random.between(-3.0, 3.0)),
        1 => LoadLaw::Spring {
            rate: random.between(0.0, 4.0),
            preload: random.between(-2.0, 2.0),
        },
        2 => LoadLaw::Viscous(random.between(0.0, 1.0)),
        3 => LoadLaw::Friction {
            force: random.between(0.0, 2.0),
            width: 0.7,
        },
        4 => LoadLaw::LinearMotor {
            stall_torque: 3.0,
            no_load_speed: 2.0,
        },
        5 => LoadLaw::Kloss {
            breakdown_torque: 3.0,
            breakdown_slip: 0.3,
            synchronous_speed: 2.0,
        },
        _ => LoadLaw::SpeedTable(vec![(-1.0, 2.0), (0.5, 1.0), (2.0, -1.0)]),
    }
}

/// A table over time on the last node and one over the drive's displacement.
fn add_tables(model: &mut Model, random: &mut Random) {
    let pieces = |random: &mut Random| {
        (0..3)
            .map(|_| LinearPiece {
                start: random.between(-1.0, 1.0),
                value: random.between(-2.0, 2.0),
                slope: random.between(-1.0, 1.0),
            })
            .collect()
    };
    for source in [TrackSource::Time, TrackSource::Node(0)] {
        let object = model.objects.len() - 1;
        model.tracks.push(Track {
            source,
            breaks: Breaks {
                points: vec![-0.5, 0.4],
                period: None,
            },
            stops: false,
            object,
        });
        let law = LoadLaw::Pieces {
            track: model.tracks.len() - 1,
            pieces: pieces(random),
        };
        add_load(model, object, 0, "table", law);
    }
}

/// A random state of a system.
pub(super) fn random_state(system: &System, random: &mut Random) -> Vec<f64> {
    let count = 2 * crate::integrate::Dynamics::coordinates(system);
    (0..count).map(|_| random.between(-0.5, 0.5)).collect()
}

/// Random modes: pairs open or on one of their flanks, tracks in some segment.
pub(super) fn random_modes(system: &System, random: &mut Random) -> Modes {
    let frozen = &system.frozen;
    let pairs = frozen.pairs.iter().map(|&chain| {
        let sides = frozen.chains[chain].contact.sides();
        match random.below(sides.len() + 1) {
            0 => 0,
            side => sides[side - 1],
        }
    });
    let mut modes: Vec<i64> = pairs.collect();
    modes.extend(frozen.tracks.iter().map(|_| random.below(2) as i64));
    Modes(modes)
}
