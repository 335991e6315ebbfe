//! What is told of derivatives: sides, obstacles, the check by differences.

use super::derive::Subject;
use super::question::gradient_with;
use super::{DerivativeVerdict, Gradient, Parameter, Place};
use crate::exact::sensitivity::EventTimes;
use crate::frontend::lower::lower;
use crate::frontend::scene::{BuiltIn, Document, Overrides};
use crate::studies::{Control, RunSettings};

fn place(settings: &[String]) -> Option<Place> {
    let text = std::fs::read_to_string("scenarios/rocker/two_masses.json").expect("scenario");
    let document = Document::parse("scene", text.as_bytes()).expect("JSON");
    let short = ["run.duration=0.1".to_owned()];
    let all = short.iter().chain(settings).cloned();
    let reading = document.scene(&BuiltIn, &Overrides::new(all)).ok()?;
    let system = crate::dynamics::system::System::new(lower(&reading.scene).ok()?).ok()?;
    let settings = RunSettings::of(&reading.scene).ok()?;
    Some(Place { system, settings })
}

fn ask(by: &[(&str, f64)], figures: &[&str], events: EventTimes) -> Gradient {
    let at = |values: &[f64]| {
        let settings = by.iter().zip(values);
        place(
            &settings
                .map(|((path, _), value)| format!("{path}={value:?}"))
                .collect::<Vec<_>>(),
        )
    };
    let parameter = |&(path, value): &(&str, f64)| Parameter {
        path: path.to_owned(),
        value,
        unit: String::new(),
    };
    let subject = Subject {
        parameters: by.iter().map(parameter).collect(),
        figures: figures
            .iter()
            .map(|name| ((*name).to_owned(), String::new()))
            .collect(),
        base: place(&[]).expect("scene"),
        at: &at,
        control: &Control::default(),
        check: Some(true),
    };
    gradient_with(&subject, events).expect("derivatives")
}

const BY: [(&str, f64); 3] = [
    ("rocker.inertia", 0.1),
    ("rocker.damping_capacity", 0.4),
    ("rocker.loads.closing.constant", -600.0),
];

const FIGURES: [&str; 4] = [
    "rocker.delta_max",
    "rocker.sigma",
    "rocker.pair.max_contact_force",
    "rocker.final.displacement",
];

#[test]
fn the_check_confirms_the_rule_and_notices_a_wrong_one() {
    let found = ask(&BY, &FIGURES, EventTimes::Moving);
    let check = found.check.as_ref().expect("check");
    assert_eq!(check.failed, 0, "{found:#?}");
    assert!(check.compared >= 9 && found.is_answered(), "{check:?}");
    let wrong = ask(&BY, &FIGURES, EventTimes::ClosuresFixed);
    let check = wrong.check.as_ref().expect("check");
    assert!(check.failed > 0 && !wrong.is_answered(), "{check:?}");
    let refused = wrong.figures.iter().flat_map(|figure| &figure.by);
    let refused =
        refused.filter(|one| matches!(one.verdict, DerivativeVerdict::NotDetermined { .. }));
    assert!(refused.clone().count() > 0);
    assert!(refused.into_iter().all(|one| one.derivative.is_none()));
}

#[test]
fn an_edge_of_a_domain_has_one_side() {
    let by = [("rocker.damping_capacity", 0.0)];
    let at = |values: &[f64]| {
        let path = "rocker.damping_capacity";
        place(&[
            format!("{path}={:?}", values[0]),
            "run.duration=0.02".to_owned(),
        ])
    };
    let subject = Subject {
        parameters: vec![Parameter {
            path: by[0].0.to_owned(),
            value: 0.0,
            unit: String::new(),
        }],
        figures: vec![("rocker.final.displacement".to_owned(), String::new())],
        base: at(&[0.0]).expect("scene"),
        at: &at,
        control: &Control::default(),
        check: Some(true),
    };
    let found = gradient_with(&subject, EventTimes::Moving).expect("derivatives");
    let own = &found.figures[0].by[0];
    assert!(
        matches!(
            own.verdict,
            DerivativeVerdict::OneSided {
                below: None,
                above: Some(_)
            }
        ),
        "{own:?}"
    );
    assert!(own.agrees_to.is_some_and(|one| one < 1e-3), "{found:?}");
}
