//! Contact elements: laws against closed forms and independent integrations, by every method.

mod closed_forms;
mod impacts;
mod modes;
mod pressing;
mod restitution;
mod rod;
mod starts;
mod stops;

use dam::integrate::Method;
use dam::lower::lower;
use dam::record::{ObjectFigures, PairFigures};
use dam::scene::{BuiltIn, Document, Overrides};
use dam::studies::run::{RunResult, run};
use dam::studies::{Control, RunSettings};
use dam::system::System;
use std::fmt::Write;

/// The methods that integrate anything, and `exact` where asked.
const INTEGRATED: [Method; 4] = [
    Method::Dop853,
    Method::Rodas5p,
    Method::Radau,
    Method::Dopri5,
];

/// A sliding object in front of a wall at 0, which it approaches at `speed` from the side of
/// positive displacements.
struct Wall {
    /// Properties of the object, but for its pair.
    body: String,
    contact: String,
    masses: usize,
    place: f64,
    speed: f64,
    loads: String,
    duration: f64,
    tolerance: f64,
}

impl Wall {
    fn rigid(contact: &str, speed: f64, duration: f64) -> Self {
        Self {
            body: "\"inertia\": 1, \"masses\": 0".into(),
            contact: contact.into(),
            masses: 1,
            place: 0.0,
            speed,
            loads: String::new(),
            duration,
            tolerance: 1e-10,
        }
    }

    /// A rod of mass 1 and stiffness 1.
    fn rod(masses: usize, capacity: f64, contact: &str, duration: f64) -> Self {
        let body = format!(
            "\"inertia\": 1, \"stiffness\": 1, \"damping_capacity\": {capacity}, \"masses\": {masses}"
        );
        Self {
            body,
            contact: contact.into(),
            masses,
            place: 0.0,
            speed: 1.0,
            loads: String::new(),
            duration,
            tolerance: 1e-10,
        }
    }

    fn text(&self) -> String {
        let list = |value: f64| vec![format!("{value:?}"); self.masses].join(", ");
        let mut text = String::new();
        write!(
            text,
            r#"{{ "dam": 1, "name": "wall", "objects": {{
                "wall": {{ "kind": "drive", "coordinate": "sliding", "motion": {{ "fixed": 0 }} }},
                "body": {{ "kind": "slider", "input": "wall", "position": {{ "ratio": 1 }}, {},
                    "pair": {{ "closure": "force", "contact": {} }}{} }} }},
                "run": {{ "duration": {:?}, "tolerance": {:e}, "record": "all",
                    "start": {{ "body": {{ "displacement": [{}], "speed": [{}] }} }} }} }}"#,
            self.body,
            self.contact,
            self.loads,
            self.duration,
            self.tolerance,
            list(self.place),
            list(-self.speed),
        )
        .unwrap();
        text
    }

    fn run(&self, method: Method) -> RunResult {
        run_text(&self.text(), Some(method))
    }
}

pub(crate) fn run_text(text: &str, method: Option<Method>) -> RunResult {
    let document = Document::parse("scene.json", text.as_bytes()).unwrap();
    let reading = document.scene(&BuiltIn, &Overrides::none());
    let reading = reading.unwrap_or_else(|faults| panic!("{faults:#?}\n{text}"));
    let system = System::new(lower(&reading.scene).unwrap()).unwrap();
    let settings = RunSettings {
        method,
        ..RunSettings::of(&reading.scene).unwrap()
    };
    let result = run(&system, &settings, &Control::default(), &mut []).unwrap();
    assert!(result.is_complete(), "{:?}", result.outcome.stop);
    assert!(
        result.is_trusted(),
        "{:?} {method:?} {text}",
        result.warnings
    );
    result
}

fn figures(result: &RunResult) -> &ObjectFigures {
    &result.figures.objects["body"]
}

fn pair(result: &RunResult) -> &PairFigures {
    figures(result).pair.as_ref().unwrap()
}
