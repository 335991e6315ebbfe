//! Hand-built models and a fabricated run for the tests of this folder.

use crate::model::{
    Closure, Coordinate, DampingLaw, Law, Link, LinkBase, Load, LoadLaw, Model, Node, NodeMotion,
    ObjectPart, Pair, Start,
};
use crate::motion::DriveMotion;
use crate::position::Position;
use crate::record::{
    Column, Figures, FinalState, Interval, ObjectFigures, PairFigures, Record, RunSummary,
    SwitchRow, Units,
};
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI};

pub(super) const SPEED: f64 = 20.0 * PI;

fn pair(closure: Closure, gap: f64) -> Pair {
    Pair {
        closure,
        gap,
        opens: 1.0,
        law: DampingLaw::KelvinVoigt,
    }
}

fn law(driver: usize, position: Position) -> Law {
    Law {
        driver,
        position,
        lever: 1.0,
        track: None,
    }
}

fn drive(model: &mut Model, id: &str) -> usize {
    model.nodes.push(Node {
        inertia: 0.0,
        motion: NodeMotion::Prescribed {
            motion: DriveMotion::Constant {
                speed: SPEED,
                angle: 0.0,
            },
            track: None,
        },
    });
    push_object(model, id, "drive", Coordinate::Turning, 1, None)
}

/// Registers the last `count` nodes as an object; links are added later.
fn push_object(
    model: &mut Model,
    id: &str,
    kind: &'static str,
    coordinate: Coordinate,
    count: usize,
    driver: Option<usize>,
) -> usize {
    let end = model.nodes.len();
    model.objects.push(ObjectPart {
        id: id.into(),
        kind,
        coordinate,
        nodes: (end - count..end).collect(),
        driver,
        links: Vec::new(),
        rigid_pair: None,
    });
    model.objects.len() - 1
}

/// A uniform chain by the rules of the specification.
struct Chain {
    id: &'static str,
    kind: &'static str,
    inertia: f64,
    stiffness: f64,
    psi: f64,
    masses: usize,
    pair: Pair,
}

fn chain(model: &mut Model, part: &Chain, driver: usize, position: Position) -> usize {
    let last = *model.objects[driver].nodes.last().unwrap();
    let n = part.masses as f64;
    let base = (part.stiffness / part.inertia).sqrt();
    let first = model.nodes.len();
    let mut links = Vec::new();
    for m in 1..=part.masses {
        let (m1, m0) = (m as f64, m as f64 - 1.0);
        model.nodes.push(Node {
            inertia: part.inertia * (m1.powi(3) - m0.powi(3)) / n.powi(3),
            motion: NodeMotion::Mass {
                law: law(last, position.clone()),
            },
        });
        links.push(model.links.len());
        model.links.push(Link {
            mass: first + m - 1,
            base: if m == 1 {
                LinkBase::Law { pair: part.pair }
            } else {
                LinkBase::Mass(first + m - 2)
            },
            stiffness: n * part.stiffness,
            damping: part.psi * n * part.stiffness / (2.0 * PI * base),
        });
    }
    let object = push_object(
        model,
        part.id,
        part.kind,
        Coordinate::Turning,
        part.masses,
        Some(driver),
    );
    model.objects[object].links = links;
    object
}

fn load(model: &mut Model, object: usize, name: &str, law: LoadLaw) {
    let node = *model.objects[object].nodes.last().unwrap();
    let name = format!("{}.loads.{name}", model.objects[object].id);
    model.loads.push(Load { node, name, law });
}

/// V. Telegin's rocker with n masses.
pub(super) fn rocker(masses: usize) -> Model {
    let mut model = Model {
        start: Start::Static,
        ..Model::default()
    };
    let shaft = drive(&mut model, "shaft");
    let part = Chain {
        id: "rocker",
        kind: "rocker",
        inertia: 0.1,
        stiffness: 1e7,
        psi: 0.4,
        masses,
        pair: pair(Closure::Force, 0.0),
    };
    let sine = Position::Sine {
        amplitude: FRAC_PI_2,
        harmonic: 1.0,
        phase: 0.0,
        offset: 0.0,
    };
    let rocker = chain(&mut model, &part, shaft, sine);
    load(&mut model, rocker, "closing", LoadLaw::Constant(-600.0));
    model
}

/// A motor, a geared shaft with backlash, and on it a cam rocker and a rigid slide.
pub(super) fn fan_out() -> Model {
    let mut model = Model::default();
    model.nodes.push(Node {
        inertia: 0.02,
        motion: NodeMotion::Rotor {
            angle: 0.0,
            speed: 0.0,
        },
    });
    let motor = push_object(&mut model, "motor", "drive", Coordinate::Turning, 1, None);
    load(
        &mut model,
        motor,
        "torque",
        LoadLaw::Kloss {
            breakdown_torque: 60.0,
            breakdown_slip: 0.2,
            synchronous_speed: 50.0 * PI,
        },
    );
    let mut part = Chain {
        id: "shaft",
        kind: "shaft",
        inertia: 0.3,
        stiffness: 4e4,
        psi: 0.2,
        masses: 2,
        pair: pair(Closure::Form, 1e-3),
    };
    let gear = Position::Ratio {
        ratio: 0.25,
        offset: 0.0,
    };
    let shaft = chain(&mut model, &part, motor, gear);
    part = Chain {
        id: "left",
        kind: "rocker",
        inertia: 0.05,
        stiffness: 1e5,
        psi: 0.3,
        masses: 1,
        pair: pair(Closure::Force, 0.0),
    };
    let wave = |amplitude| Position::Sine {
        amplitude,
        harmonic: 2.0,
        phase: -FRAC_PI_2,
        offset: amplitude,
    };
    let left = chain(&mut model, &part, shaft, wave(0.2));
    let spring = LoadLaw::Spring {
        rate: 300.0,
        preload: 50.0,
    };
    load(&mut model, left, "closing", spring);
    let last = *model.objects[shaft].nodes.last().unwrap();
    model.nodes.push(Node {
        inertia: 12.0,
        motion: NodeMotion::Rigid {
            law: law(last, wave(0.04)),
        },
    });
    let kind = Coordinate::Sliding;
    let right = push_object(&mut model, "right", "slider", kind, 1, Some(shaft));
    let friction = LoadLaw::Friction {
        force: 40.0,
        width: 0.01,
    };
    load(&mut model, right, "friction", friction);
    model
}

/// Figures and record of the two-mass rocker, integrated coarsely here: good
/// enough to look at, not to quote.
pub(super) fn run(masses: usize, duration: f64, samples: usize) -> (Figures, Record) {
    let model = rocker(masses);
    let mut run = Run::new(&model, samples);
    let steps = (duration / if masses > 2 { 1e-7 } else { 4e-7 }).ceil() as usize;
    let step = duration / steps as f64;
    for index in 0..=steps {
        let time = index as f64 * step;
        run.observe(time, index % (steps / samples).max(1) == 0);
        run.advance(time, step);
    }
    run.finish(duration)
}

struct Run<'a> {
    model: &'a Model,
    u: Vec<f64>,
    v: Vec<f64>,
    rows: Vec<[f64; 7]>,
    open: Option<f64>,
    record: Record,
    peaks: [f64; 6],
    integral: f64,
}

impl<'a> Run<'a> {
    fn new(model: &'a Model, samples: usize) -> Self {
        let n = model.links.len();
        Self {
            model,
            u: vec![-6e-5; n],
            v: vec![0.0; n],
            rows: Vec::with_capacity(samples + 1),
            open: None,
            record: Record::default(),
            peaks: [0.0; 6],
            integral: 0.0,
        }
    }

    fn force(&self) -> f64 {
        let link = &self.model.links[0];
        let pull = link.stiffness * self.u[0] + link.damping * self.v[0];
        if self.u[0] < 0.0 { pull.min(0.0) } else { 0.0 }
    }

    fn acceleration(&self, time: f64) -> Vec<f64> {
        let second = -FRAC_PI_2 * SPEED * SPEED * (SPEED * time).sin();
        let n = self.u.len();
        let inner = |m: usize| {
            let link = &self.model.links[m];
            link.stiffness * (self.u[m] - self.u[m - 1])
                + link.damping * (self.v[m] - self.v[m - 1])
        };
        let mut force = vec![self.force()];
        force.extend((1..n).map(inner));
        force.push(-600.0);
        let of = |m: usize| (force[m + 1] - force[m]) / self.model.nodes[m + 1].inertia - second;
        (0..n).map(of).collect()
    }

    fn advance(&mut self, time: f64, step: f64) {
        let a = self.acceleration(time);
        for ((u, v), a) in self.u.iter_mut().zip(&mut self.v).zip(a) {
            *v += step * a;
            *u += step * *v;
        }
        self.integral += step * self.u.last().unwrap().abs();
    }

    fn observe(&mut self, time: f64, sample: bool) {
        let (u, v) = (*self.u.last().unwrap(), *self.v.last().unwrap());
        let a = *self.acceleration(time).last().unwrap();
        let (sin, cos) = (SPEED * time).sin_cos();
        let row = [
            time,
            u + FRAC_PI_2 * sin,
            v + FRAC_PI_2 * SPEED * cos,
            a - FRAC_PI_2 * SPEED * SPEED * sin,
            u,
            self.force(),
            -self.force(),
        ];
        for (peak, value) in self
            .peaks
            .iter_mut()
            .zip([row[2], row[3], row[5], u, -u, 0.0])
        {
            *peak = peak.max(value);
        }
        let open = self.force() == 0.0 && time > 0.0;
        if open != self.open.is_some() {
            self.record.switches.push(SwitchRow {
                time,
                object: "rocker".into(),
                what: if open { "opens" } else { "closes" },
                flank: "lower",
                speed: self.v[0].abs(),
            });
            match self.open.take() {
                None => self.open = Some(time),
                Some(from) => self.record.separations.push(Interval {
                    object: "rocker".into(),
                    from,
                    to: time,
                }),
            }
        }
        if sample {
            self.rows.push(row);
        }
    }

    fn finish(mut self, duration: f64) -> (Figures, Record) {
        self.record.times = self.rows.iter().map(|row| row[0]).collect();
        let quantities = [
            ("displacement", "rad"),
            ("speed", "rad/s"),
            ("acceleration", "rad/s²"),
            ("delta", "rad"),
            ("reaction", "N m"),
            ("contact_force", "N m"),
        ];
        for (place, (quantity, unit)) in quantities.into_iter().enumerate() {
            let value = |row: &[f64; 7], drive: bool| match (drive, place) {
                (false, _) => row[place + 1],
                (true, 0) => SPEED * row[0],
                (true, 1) => SPEED,
                (true, 4) => row[5] * FRAC_PI_2 * (SPEED * row[0]).cos(),
                (true, _) => 0.0,
            };
            for (object, drive) in [("rocker", false), ("shaft", true)] {
                self.record.columns.push(Column {
                    object: object.into(),
                    quantity,
                    unit,
                    values: self.rows.iter().map(|row| value(row, drive)).collect(),
                });
            }
        }
        (self.figures(duration), self.record)
    }

    fn figures(&self, duration: f64) -> Figures {
        let last = self.rows.last().unwrap();
        let opens = |row: &&SwitchRow| row.what == "opens";
        let separations = self.record.switches.iter().filter(opens).count() as u64;
        let lengths = self.record.separations.iter().map(|i| i.to - i.from);
        let rocker = ObjectFigures {
            delta_max: self.peaks[3],
            delta_min: -self.peaks[4],
            sigma: self.integral / duration,
            peak_speed: self.peaks[0],
            peak_acceleration: self.peaks[1],
            peak_reaction: 1234.5,
            end: FinalState {
                displacement: last[1],
                speed: last[2],
            },
            pair: Some(PairFigures {
                separations,
                closures: self.record.switches.len() as u64 - separations,
                separated_time: lengths.clone().sum(),
                longest_separation: lengths.fold(0.0, f64::max),
                max_lift: self.peaks[3],
                max_approach_speed: 4.6,
                max_contact_force: 1234.5,
                margin: None,
                switch_times: self.record.switches.iter().map(|s| s.time).collect(),
                in_working_order: Some(separations == 0),
            }),
        };
        let units = Units {
            displacement: "rad",
            force: "N m",
        };
        let ids = ["rocker", "shaft"].map(String::from);
        let objects = [rocker, ObjectFigures::default()];
        Figures {
            dam: 1,
            scene: "Rocker of a cam mechanism <two masses>".into(),
            hash: "6d1f0c2a".repeat(8),
            units: ids.iter().map(|id| (id.clone(), units)).collect(),
            objects: ids.into_iter().zip(objects).collect::<BTreeMap<_, _>>(),
            run: summary(duration, self.record.switches.len() as u64),
            warnings: vec![],
        }
    }
}

fn summary(duration: f64, switches: u64) -> RunSummary {
    RunSummary {
        method: "dop853".into(),
        why: "fastest frequency 3.2·10⁴ rad/s: an explicit method needs no more steps than \
              accuracy does"
            .into(),
        tolerance: 1e-8,
        time: duration,
        complete: true,
        stopped: None,
        stopped_because: None,
        steps: 4321,
        rejected: 87,
        evaluations: 53210,
        switches,
        energy_error: 3.2e-9,
        window: Some([duration * 0.8, duration]),
        window_missing: None,
    }
}
