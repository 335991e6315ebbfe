//! The machines of `tests/reference/steady-state.json`, written from its
//! definitions.

use dam::steady::{FunctionKind, Mean, Profile, Question, Refusal};
use serde_json::Value;

/// The whole file.
pub(crate) fn reference() -> Value {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/tests/reference/steady-state.json"
    );
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// The question of a case.
pub(crate) fn question(case: &Value, mean: Mean) -> Question {
    Question {
        mean,
        ..Question::new(number(&case["omega_av"]))
    }
}

/// Worst relative difference met so far.
#[derive(Default)]
pub(crate) struct Worst(pub(crate) f64, pub(crate) String);

impl Worst {
    pub(crate) fn see(&mut self, what: &str, found: f64, expected: f64, bound: f64) {
        self.see_of(what, found, expected, expected.abs(), bound);
    }

    pub(crate) fn see_of(&mut self, what: &str, found: f64, expected: f64, size: f64, bound: f64) {
        let off = (found - expected).abs() / size;
        assert!(off <= bound, "{what}: {found} for {expected}, {off:e} off");
        if off > self.0 {
            *self = Self(off, what.to_owned());
        }
    }
}

/// A machine as functions of the position.
pub(crate) struct Machine {
    pub(crate) cycle: f64,
    pub(crate) breaks: Vec<f64>,
    pub(crate) given: FunctionKind,
    /// J, and the moment or the work.
    pub(crate) at: Box<dyn Fn(usize, f64) -> [f64; 2]>,
}

impl Machine {
    pub(crate) fn profile(&self) -> Result<Profile, Refusal> {
        let mut at = |piece: usize, position: f64| (self.at)(piece, position);
        Profile::new(self.cycle, &self.breaks, self.given, &mut at)
    }
}

/// A number, written as one or as a text.
pub(crate) fn number(value: &Value) -> f64 {
    match value {
        Value::String(text) => text.parse().unwrap(),
        other => other
            .as_f64()
            .unwrap_or_else(|| panic!("{other} is no number")),
    }
}

/// The machine of a case, with its balancing moment.
pub(crate) fn machine(case: &Value) -> Machine {
    let data = &case["data"];
    let get = |name: &str| number(&data[name]);
    let cycle = number(&case["cycle"]);
    match case["id"].as_str().unwrap() {
        "S1-sinus" => {
            let (inertia, work) = (get("J0"), get("a"));
            Machine {
                cycle,
                breaks: vec![],
                given: FunctionKind::Work,
                at: Box::new(move |_, phi| [inertia, work * phi.sin()]),
            }
        }
        "S2-two-stroke" | "S2-slow" => {
            engine(data, cycle, -number(&case["derived"]["load_moment"]))
        }
        "S3-press" => {
            let moment = number(&case["derived"]["driving_moment"]);
            press(data, cycle, Box::new(move |_| moment))
        }
        "S4-harmonics" => {
            let list = |name: &str| -> Vec<f64> {
                data[name].as_array().unwrap().iter().map(number).collect()
            };
            let (inertia, work, phase) = (list("J"), list("A"), list("phase"));
            let at = move |_: usize, phi: f64| {
                let cosines = inertia
                    .iter()
                    .enumerate()
                    .map(|(k, j)| j * (k as f64 * phi).cos());
                let sines = work.iter().zip(&phase).enumerate();
                let sines =
                    sines.map(|(k, (a, p))| a * (((k + 1) as f64 * phi + p).sin() - p.sin()));
                [cosines.sum::<f64>(), sines.sum::<f64>()]
            };
            Machine {
                cycle,
                breaks: vec![],
                given: FunctionKind::Work,
                at: Box::new(at),
            }
        }
        other => panic!("no machine {other}"),
    }
}

/// A slider-crank: J(φ), the slider's place and its derivative.
pub(crate) fn slider_crank(data: &Value) -> impl Fn(f64) -> [f64; 3] + Copy + use<> {
    let get = |name: &str| number(&data[name]);
    let (l1, l2) = (get("l1"), get("l2"));
    let (j1, m2, h2, j2, m3) = (get("J1"), get("m2"), get("h2"), get("J2"), get("m3"));
    move |phi: f64| {
        let (sin, cos) = phi.sin_cos();
        let ratio = l1 / l2;
        let root = (1.0 - ratio * ratio * sin * sin).sqrt();
        let place = l1 * cos + l2 * root;
        let first = -l1 * sin - l2 * ratio * ratio * sin * cos / root;
        // The rod's angle β below the line: sin β = ratio·sin φ.
        let rate = ratio * cos / root;
        let (sin_b, cos_b) = (ratio * sin, root);
        let vx = -l1 * sin - h2 * sin_b * rate;
        let vy = l1 * cos - h2 * cos_b * rate;
        let inertia = j1 + m2 * (vx * vx + vy * vy) + j2 * rate * rate + m3 * first * first;
        [inertia, place, first]
    }
}

fn engine(data: &Value, cycle: f64, load: f64) -> Machine {
    let get = |name: &str| number(&data[name]);
    let crank = slider_crank(data);
    let (l1, l2, area) = (get("l1"), get("l2"), get("piston_area"));
    let least = 2.0 * l1 * area / (get("compression_ratio") - 1.0);
    let greatest = least + 2.0 * l1 * area;
    let (n, peak) = (get("polytropic_n"), get("p_max"));
    let (ambient, intake) = (get("p_ambient"), get("p_intake"));
    let at = move |piece: usize, phi: f64| {
        let [inertia, place, first] = crank(phi);
        let volume = least + area * (l1 + l2 - place);
        let pressure = match piece {
            0 => peak * (least / volume).powf(n),
            _ => intake * (greatest / volume).powf(n),
        };
        [inertia, load - (pressure - ambient) * area * first]
    };
    Machine {
        cycle,
        breaks: vec![std::f64::consts::PI],
        given: FunctionKind::Moment,
        at: Box::new(at),
    }
}

/// Where the press begins to punch.
pub(crate) fn contact(data: &Value) -> f64 {
    let crank = slider_crank(data);
    let end = number(&data["l1"]) + number(&data["l2"]);
    let wanted = end - number(&data["last_part_of_stroke"]);
    let (mut low, mut high) = (std::f64::consts::PI, std::f64::consts::TAU);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if crank(middle)[1] < wanted {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

fn press(data: &Value, cycle: f64, driving: Box<dyn Fn(f64) -> f64>) -> Machine {
    let crank = slider_crank(data);
    let force = number(&data["force"]);
    let at = move |piece: usize, phi: f64| {
        let [inertia, _, first] = crank(phi);
        let punching = if piece == 1 { force * first } else { 0.0 };
        [inertia, driving(phi) - punching]
    };
    Machine {
        cycle,
        breaks: vec![contact(data)],
        given: FunctionKind::Moment,
        at: Box::new(at),
    }
}
