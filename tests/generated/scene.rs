//! Scenes drawn by a number: every kind of motion of a drive before every kind of what is
//! driven.

use super::draw::{Draw, Units};
use serde_json::{Value, json};

/// Kinds of motion of a drive.
pub(crate) const MOTIONS: [&str; 13] = [
    "uniform",
    "run-up",
    "accelerated",
    "plan",
    "table",
    "sine",
    "two sines",
    "from a time on",
    "pulses",
    "dying out",
    "by a remainder",
    "motor",
    "motor, constant",
];

/// Kinds of what is driven.
pub(crate) const BODIES: [&str; 15] = [
    "rigid",
    "chain",
    "modes",
    "static",
    "force closure",
    "gap",
    "Hunt-Crossley",
    "rigid contact",
    "stop",
    "differential",
    "slider-crank",
    "five-bar",
    "friction",
    "written load",
    "contact element",
];

/// A scene that was drawn.
pub(crate) struct Drawn {
    pub(crate) motion: usize,
    pub(crate) body: usize,
    pub(crate) scene: Value,
    /// The motion of its drive as an expression in t, where it is one.
    pub(crate) written: Option<String>,
}

/// The scene of a number, in these units, with its objects named in one order or the other.
pub(crate) fn draw(number: u64, units: Units, reversed: bool) -> Drawn {
    let names = if reversed {
        ["z", "y", "a"]
    } else {
        ["a", "b", "c"]
    };
    draw_named(number, units, names)
}

/// The same with names for its drive, for another drive, and for what is driven.
pub(crate) fn draw_named(number: u64, units: Units, names: [&str; 3]) -> Drawn {
    let all = (MOTIONS.len() * BODIES.len()) as u64;
    // Every pair of kinds comes once in so many scenes.
    let place = (number * 77) % all;
    let (motion, body) = (
        place as usize % MOTIONS.len(),
        place as usize / MOTIONS.len(),
    );
    let mut draw = Draw::new(number);
    // The natural frequency (rad/s) sets all other rates.
    let natural = draw.decades(20.0, 400.0);
    let duration = draw.even(3.0, 9.0) * std::f64::consts::TAU / natural;
    let slow = natural * draw.even(0.1, 0.7);
    let mut maker = Maker {
        draw,
        units,
        natural,
        slow,
        duration,
        written: None,
    };
    let drive = maker.drive(motion);
    let driven = maker.driven(body, motion);
    let start = match body {
        10 | 11 => "on_law",
        _ => maker.draw.one_of(&["kinetostatic", "on_law", "on_law"]),
    };
    let mut objects = serde_json::Map::new();
    objects.insert(names[0].to_owned(), drive);
    for (k, mut object) in driven.into_iter().enumerate() {
        rename(&mut object, names);
        objects.insert(names[2 - k].to_owned(), object);
    }
    let scene = json!({ "dam": 1, "name": format!("Drawn {number}"), "objects": objects, "run": {
        "duration": units.time(duration), "start": start, "tolerance": 1e-9, "samples": 64,
        "max_switches": 2000 } });
    Drawn {
        motion,
        body,
        scene,
        written: maker.written,
    }
}

/// Names of objects by their places: `$0` is the drive, `$1` another one, `$2` what is driven.
fn rename(value: &mut Value, names: [&str; 3]) {
    match value {
        Value::String(text) => {
            for (k, name) in names.iter().enumerate() {
                if *text == format!("${k}") {
                    *text = (*name).to_owned();
                }
            }
        }
        Value::Array(all) => all.iter_mut().for_each(|one| rename(one, names)),
        Value::Object(all) => all.values_mut().for_each(|one| rename(one, names)),
        Value::Null | Value::Bool(_) | Value::Number(_) => {}
    }
}

struct Maker {
    draw: Draw,
    units: Units,
    natural: f64,
    slow: f64,
    duration: f64,
    written: Option<String>,
}

impl Maker {
    fn drive(&mut self, motion: usize) -> Value {
        let (units, slow, duration) = (self.units, self.slow, self.duration);
        let amplitude = self.draw.even(0.05, 0.4);
        let w = units.rate(slow);
        let other = units.rate(slow * self.draw.even(1.2, 2.9));
        let late = units.time(duration * self.draw.even(0.15, 0.6));
        let motion = match MOTIONS[motion] {
            "uniform" => json!({ "speed": w }),
            "run-up" => json!({ "run_up": { "speed": w, "time": late } }),
            "accelerated" => json!({ "acceleration": units.acceleration(slow / duration),
                "start_speed": 0.25 * w }),
            "plan" => {
                let law = self.draw.one_of(&[
                    "cycloidal",
                    "modified_sine",
                    "3-4-5",
                    "harmonic",
                    "parabolic",
                    "4-5-6-7",
                    "modified_trapezoid",
                ]);
                json!({ "plan": { "stations": [
                    { "at": 0, "displacement": 0, "motion": "dwell" },
                    { "at": 0.5 * late, "displacement": 0, "motion": law },
                    { "at": 1.5 * late, "displacement": amplitude } ] } })
            }
            "table" => {
                let points: Vec<[f64; 2]> = (0..8)
                    .map(|k| {
                        let height = self.draw.even(-0.5, 0.5) * amplitude;
                        [units.time(duration) * f64::from(k) / 7.0, height]
                    })
                    .collect();
                json!({ "table": points })
            }
            "motor" => {
                return json!({ "kind": "drive", "motor": {
                "inertia": units.inertia(self.draw.decades(0.02, 2.0)), "speed": 0.5 * w,
                "torque": { "linear": { "stall_torque": units.force(self.draw.even(0.5, 20.0)),
                    "no_load_speed": w } } } });
            }
            "motor, constant" => {
                return json!({ "kind": "drive", "motor": {
                "inertia": units.inertia(self.draw.decades(0.02, 2.0)), "speed": 0.3 * w,
                "torque": { "constant": units.force(self.draw.even(0.1, 5.0)) } } });
            }
            written => {
                let text = match written {
                    "sine" => format!("{amplitude:?}*sin({w:?}*t)"),
                    "two sines" => format!("{w:?}*t + {amplitude:?}*sin({other:?}*t)*cos({w:?}*t)"),
                    "from a time on" => {
                        format!("t < {late:?} ? 0 : {amplitude:?}*(1 - cos({w:?}*(t - {late:?})))")
                    }
                    "pulses" => format!("{amplitude:?}*max(0, sin({w:?}*t))^3"),
                    "dying out" => format!(
                        "{amplitude:?}*({w:?}*t)^3*exp(-{:?}*t)*sin({other:?}*t)",
                        1.5 * w
                    ),
                    "by a remainder" => {
                        let x = format!("(({w:?}*t) % 1)");
                        format!("{:?}*{x}^3*(1 - {x})^3", 30.0 * amplitude)
                    }
                    other => unreachable!("{other}"),
                };
                self.written = Some(text.clone());
                json!({ "expression": text })
            }
        };
        json!({ "kind": "drive", "motion": motion })
    }

    /// A position function of what a drive of this motion moves: of motors and turning drives
    /// all kinds, of the others what small angles show.
    fn position(&mut self, motion: usize) -> Value {
        let turns = matches!(
            MOTIONS[motion],
            "uniform" | "run-up" | "accelerated" | "two sines" | "motor" | "motor, constant"
        );
        let lift = self.draw.even(0.05, 0.3);
        let law = self.draw.one_of(&[
            "cycloidal",
            "modified_sine",
            "3-4-5",
            "4-5-6-7",
            "modified_trapezoid",
        ]);
        match (turns, self.draw.whole(0, 3)) {
            (true, 0) => json!({ "cam": { "lift": lift, "rise": "100 deg", "dwell": "40 deg",
                "return": "120 deg", "law": law } }),
            (true, 1) => json!({ "sine": { "amplitude": lift,
                "harmonic": self.draw.whole(1, 3) } }),
            (true, 2) => json!({ "slider_crank": { "crank": lift, "rod": 3.5 * lift } }),
            (false, 0) => json!({ "polynomial": { "coefficients": [0, 0.8, 0.7, -0.4] } }),
            (false, 1) => json!({ "sine": { "amplitude": 1, "phase": 0.4 } }),
            _ => json!({ "ratio": self.draw.even(0.3, 2.0) }),
        }
    }

    /// What is driven, and beside it another drive where one is needed.
    fn driven(&mut self, body: usize, motion: usize) -> Vec<Value> {
        let units = self.units;
        let name = BODIES[body];
        match name {
            "slider-crank" | "five-bar" => return self.linkage(name),
            _ => {}
        }
        let inertia = self.draw.decades(0.05, 5.0);
        let stiffness = inertia * self.natural * self.natural;
        let damping = 2.0 * self.draw.even(0.01, 0.2) * inertia * self.natural;
        let masses = self.draw.whole(1, 4);
        let position = match name {
            "differential" => Value::Null,
            _ => self.position(motion),
        };
        let mut object = json!({ "kind": "slider", "input": "$0", "position": position,
            "inertia": units.inertia(inertia) });
        let size = 0.05 * stiffness;
        let elastic = json!({ "stiffness": units.force(stiffness),
            "damping": units.damping(damping), "masses": masses });
        let one = json!({ "stiffness": units.force(stiffness),
            "damping": units.damping(damping), "masses": 1 });
        let spring = json!({ "spring": { "rate": units.force(0.2 * stiffness),
            "preload": units.force(size) } });
        let preload = json!({ "constant": units.force(-self.draw.even(0.1, 0.8) * size),
            "mass": "last" });
        let (more, loads, pair) = match name {
            "rigid" => (
                json!({ "masses": 0 }),
                json!({ "spring": spring, "oil": { "viscous": units.damping(damping) } }),
                None,
            ),
            "chain" => (
                elastic,
                json!({ "push": { "harmonic": {
                "amplitude": units.force(0.2 * size), "frequency": units.rate(0.3 * self.natural) } } }),
                None,
            ),
            "modes" => (
                json!({ "stiffness": units.force(stiffness), "damping_capacity": 0.3,
                "modes": self.draw.whole(1, 3) }),
                json!({}),
                None,
            ),
            "static" => (
                json!({ "stiffness": units.force(stiffness), "flexibility": "static" }),
                json!({ "closing": preload }),
                None,
            ),
            "force closure" => (
                elastic,
                json!({ "closing": preload }),
                Some(json!({ "closure": "force" })),
            ),
            "gap" => (
                elastic,
                json!({}),
                Some(json!({ "closure": "form",
                "gap": self.draw.decades(1e-4, 1e-2) })),
            ),
            "Hunt-Crossley" => (
                one,
                json!({ "closing": preload }),
                Some(json!({ "closure": "force", "law": "hunt_crossley" })),
            ),
            "rigid contact" => (
                json!({ "masses": 0 }),
                json!({ "closing": preload }),
                Some(json!({ "closure": "force",
                    "contact": { "restitution": self.draw.even(0.2, 0.8) } })),
            ),
            "contact element" => (
                elastic,
                json!({ "closing": preload }),
                Some(json!({ "closure": "force", "contact": {
                    "law": "kelvin_voigt", "stiffness": units.force(stiffness * self.draw.decades(1.0, 30.0)),
                    "damping": units.damping(0.3 * damping) } })),
            ),
            "stop" => {
                object["stops"] = json!({ "end": { "at": 0.06, "side": "+",
                    "contact": { "law": "kelvin_voigt", "stiffness": units.force(5.0 * stiffness),
                        "damping": units.damping(0.5 * damping) } } });
                (elastic, json!({}), None)
            }
            "differential" => {
                object = json!({ "kind": "differential", "coordinate": "turning",
                    "inputs": { "one": { "object": "$0", "ratio": 0.7 },
                        "other": { "object": "$1", "ratio": -0.4 } },
                    "inertia": units.inertia(inertia) });
                (elastic, json!({}), None)
            }
            "friction" => (
                elastic,
                json!({ "rubs": { "friction": {
                "force": units.force(0.1 * size), "width": units.rate(0.05 * self.natural) } } }),
                None,
            ),
            "written load" => {
                let (a, b) = (units.force(3.0 * stiffness), units.damping(damping));
                (
                    one,
                    json!({ "w": { "expression":
                    format!("-{a:?}*phi^3 - {:?}*phi_dot*abs(phi_dot)", b / self.units.rate(1.0)) } }),
                    None,
                )
            }
            other => unreachable!("{other}"),
        };
        let members = object.as_object_mut().expect("an object");
        members.extend(more.as_object().expect("members").clone());
        members.insert("loads".to_owned(), loads);
        members.extend(pair.map(|pair| ("pair".to_owned(), pair)));
        match name {
            "differential" => {
                let speed = units.rate(0.3 * self.slow);
                vec![
                    object,
                    json!({ "kind": "drive", "motion": { "speed": speed } }),
                ]
            }
            _ => vec![object],
        }
    }

    fn linkage(&mut self, name: &str) -> Vec<Value> {
        let (units, slow) = (self.units, self.slow);
        let mass = |share: f64| units.inertia(share);
        let force = units.force(self.draw.even(1.0, 20.0) * slow * slow * 0.05);
        match name {
            "slider-crank" => vec![json!({
                "kind": "linkage", "input": "$0", "driver": "O", "ground": { "O": [0, 0] },
                "links": {
                    "crank": { "points": { "A": [0.1, 0] }, "mass": mass(1.0), "centre": [0.04, 0],
                        "moment": mass(0.01) },
                    "rod": { "points": { "B": [0.4, 0] }, "mass": mass(2.0), "centre": [0.2, 0],
                        "moment": mass(0.03) },
                    "slide": { "mass": mass(3.0) } },
                "pairs": {
                    "O": { "revolute": ["ground.O", "crank.origin"] },
                    "A": { "revolute": ["crank.A", "rod.origin"] },
                    "B": { "revolute": ["rod.B", "slide.origin"] },
                    "guide": { "sliding": { "guide": "ground.O", "block": "slide.origin" } } },
                "start": "20 deg",
                "assembly": { "slide": { "near": [0.45, 0] } },
                "forces": { "pull": { "force": { "point": "slide.origin", "force": [-force, 0] } } },
                "outputs": { "slide": { "point": "slide.origin" } } })],
            _ => {
                let second = json!({ "kind": "drive", "motor": {
                    "inertia": mass(0.5), "angle": 0.6, "speed": units.rate(-0.2 * slow),
                    "torque": { "linear": { "stall_torque": units.force(-0.02 * slow * slow),
                        "no_load_speed": units.rate(-0.5 * slow) } } } });
                let five_bar = json!({
                    "kind": "linkage", "ground": { "O": [0, 0], "P": [0.6, 0] },
                    "inputs": { "left": { "pair": "O", "object": "$0", "start": 1.1 },
                        "right": { "pair": "P", "object": "$1" } },
                    "links": {
                        "crank": { "points": { "A": [0.2, 0] }, "mass": mass(1.1),
                            "centre": [0.1, 0], "moment": mass(0.004) },
                        "rod": { "points": { "C": [0.7, 0] }, "mass": mass(0.9),
                            "centre": [0.35, 0], "moment": mass(0.04) },
                        "coupler": { "points": { "C": [0.7, 0] }, "mass": mass(0.8),
                            "centre": [0.35, 0], "moment": mass(0.03) },
                        "servo": { "points": { "B": [0.15, 0] }, "mass": mass(1.3),
                            "centre": [0.07, 0], "moment": mass(0.002) } },
                    "pairs": {
                        "O": { "revolute": ["ground.O", "crank.origin"] },
                        "A": { "revolute": ["crank.A", "rod.origin"] },
                        "C": { "revolute": ["rod.C", "coupler.C"] },
                        "B": { "revolute": ["servo.B", "coupler.origin"] },
                        "P": { "revolute": ["ground.P", "servo.origin"] } },
                    "outputs": { "x": { "point": "rod.C" } },
                    "assembly": { "rod": { "branch": "-" } } });
                vec![five_bar, second]
            }
        }
    }
}
