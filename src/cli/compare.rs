//! `dam compare`: the same scene for several values of a parameter.

use super::answer::{Answer, AnswerForm, Content, Document, DocumentWithWarnings, PAGE};
use super::args::CompareArgs;
use super::asker::Terminal;
use super::failure::Failure;
use super::input::{Input, Ready, print_doubts};
use super::interrupt;
use super::output::OutputFolder;
use super::run::{abscissa, run_with_progress};
use super::status::Status;
use crate::ask::ModelAssessment;
use crate::dynamics::integrate::Stop;
use crate::dynamics::model::Model;
use crate::dynamics::record::Quantity;
use crate::fault::Fault;
use crate::report::abscissa::Abscissa;
use crate::report::compare::{chart, document, findings};
use crate::report::csv::{record_csv, table_csv};
use crate::report::diagram::Diagram;
use crate::report::findings::Source;
use crate::studies::RunSettings;
use crate::studies::compare::{ComparedRun, Comparison, compare};
use crate::studies::limit::without_limit;
use crate::studies::list::ValueList;
use crate::studies::lookup;
use crate::studies::order::{Limits, limits};
use crate::studies::rigid::Rigid;
use serde_json::{Value, json};

const FILES: [&str; 3] = ["comparison.json", "comparison.csv", PAGE];

/// Most values of one comparison.
const MOST: usize = 50;

/// Quantities drawn over each other.
const DRAWN: [Quantity; 5] = [
    Quantity::Displacement,
    Quantity::Speed,
    Quantity::Acceleration,
    Quantity::Delta,
    Quantity::ContactForce,
];

/// Runs the command.
pub(crate) fn command(args: &CompareArgs) -> Result<Status, Failure> {
    let over = parse_over(&args.over)?;
    let input = Input::load(&args.scene)?;
    let ready = prepare_all(&input, &over)?;
    print_doubts(&ready[0].reading, args.scene.quiet);
    check_figures(&args.figure, ready[0].system.model())?;
    let scene = ready[0].scene().name.clone();
    let folder = prepare_folder(args, &ready, over.values.len())?;
    let mut next = ready.iter();
    let mut keeping = None;
    let mut comparison = compare(&over.path, &over.values, |_| {
        let Some(ready) = next.next() else {
            return Err(Failure::Other("fewer systems than values".to_owned()));
        };
        let found = run_with_progress((ready, &Terminal), &ready.settings, args.scene.quiet);
        keeping.get_or_insert_with(interrupt::hold_interrupt);
        let mut found = found?;
        let named = args.figure.iter().map(String::as_str);
        ready.attach(&mut found.figures, named, interrupt::budget())?;
        found.figures.warnings.extend(ready.shortfalls());
        Ok(found)
    })?;
    if let Some(limits) = limits_of(&input, &over, &comparison)? {
        comparison.measure_against(&limits);
    }
    let model = ready[0].system.model();
    let named = |run: &ComparedRun| {
        let name = format!("{} = {}", over.path, run.label);
        let said = run.result.figures.warnings.clone().into_iter();
        said.map(move |warning| format!("{name}: {warning}"))
    };
    let mut warnings: Vec<String> = comparison.runs.iter().flat_map(named).collect();
    warnings.extend(contact_force_remarks(&over.path, &ready, &comparison));
    let over_what = abscissa(args.abscissa.as_deref(), model, folder.is_some())?;
    let (diagram, hash) = (Diagram::of(model), &ready[0].scene().hash);
    let source = Source::scene(input.text(), hash);
    let files = match folder {
        Some(_) => files(model, (&comparison, &over_what))?,
        None => Vec::new(),
    };
    let label = Rigid::label(model, &["dam run"]);
    let rigid = args.figure.iter().filter(|figure| lookup::is_rigid(figure));
    let rigid: Vec<&str> = rigid.map(String::as_str).collect();
    let label = label.filter(|_| !rigid.is_empty());
    let what = match rigid.as_slice() {
        [one] => format!("{one} is"),
        several => format!("{} are", several.join(", ")),
    };
    warnings.extend(label.as_ref().map(|label| label.words(&what)));
    let told = warnings.clone();
    let mut shown = findings(
        &scene,
        (&comparison, &over_what),
        &diagram,
        warnings,
        source,
    );
    shown.label(label.as_ref(), &what);
    let answer = Answer {
        command: "compare",
        findings: &shown,
        document: Document::made(|| DocumentWithWarnings {
            document: labelled(document(&scene, &comparison), label.as_ref()),
            warnings: &told,
        }),
        files,
        quiet: args.scene.quiet,
    };
    answer.deliver(
        folder.as_ref(),
        AnswerForm::json_or(args.scene.json, AnswerForm::Text),
    )?;
    let accurate = ready.iter().all(|ready| ready.shortfalls().is_empty());
    Ok(match (status(&comparison), accurate) {
        (Status::Answered, false) => Status::NotTrusted,
        (status, _) => status,
    })
}

/// A document with the label of results that take elastic objects for rigid.
fn labelled(mut document: Value, label: Option<&Rigid>) -> Value {
    document["rigid"] = json!(label);
    document
}

/// Results that are asked for besides are those of other studies.
fn check_figures(figures: &[String], model: &Model) -> Result<(), Failure> {
    for figure in figures {
        match lookup::check(figure, model) {
            Some(Ok(())) => {}
            Some(Err(fault)) => {
                let hint = match fault.hint.is_empty() {
                    true => String::new(),
                    false => format!("; {}", fault.hint),
                };
                return Err(Failure::Other(format!("--figure: {}{hint}", fault.message)));
            }
            None => {
                return Err(Failure::Other(format!(
                    "--figure: `{figure}` is no result of another study; those of a run are \
                     compared in any case; write `frequency.1`, `steady.mean_time`, \
                     `cam.follower.least_radius`, `kinematics.press.ram.speed.greatest`"
                )));
            }
        }
    }
    Ok(())
}

/// The limits of all figures, where the order of a model is compared: its masses or modes.
fn limits_of(
    input: &Input<'_>,
    over: &ValueList,
    comparison: &Comparison,
) -> Result<Option<Limits>, Failure> {
    let order = [".masses", ".modes"]
        .iter()
        .any(|name| over.path.ends_with(name));
    let counts: Option<Vec<u64>> = over.values.iter().map(|value| value.parse().ok()).collect();
    let complete = comparison.runs.len() == over.values.len();
    let (true, true, Some(counts)) = (order, complete, counts) else {
        return Ok(None);
    };
    let finest = (0..counts.len()).max_by_key(|&at| counts[at]);
    let setting = finest.and_then(|at| over.settings().nth(at));
    let mut reading = input.decode(&setting.into_iter().collect::<Vec<_>>())?;
    if reading.scene.elastic().objects.is_empty() {
        return Ok(None);
    }
    let diagnose = |faults: Vec<Fault>| reading.places.diagnose(&faults);
    let settings = RunSettings::of(&reading.scene).map_err(|fault| diagnose(vec![fault]))?;
    let figures = comparison.table.rows.iter().map(|row| row.figure.clone());
    let figures = figures.filter(|figure| !lookup::is_address(figure));
    let found = limits(&mut reading.scene, &settings, figures, interrupt::budget());
    Ok(found.ok())
}

/// What is to be said of the contact force where numbers of masses are compared.
fn contact_force_remarks(path: &str, ready: &[Ready], comparison: &Comparison) -> Vec<String> {
    let object = path.strip_suffix(".masses");
    let (Some(id), Some(last), Some(run)) = (object, ready.last(), comparison.runs.last()) else {
        return Vec::new();
    };
    let asked = format!("{id}.pair.max_contact_force");
    let figures = Some(&run.result.figures);
    without_limit(last.scene(), last.system.model(), [asked.as_str()], figures)
}

fn status(comparison: &Comparison) -> Status {
    let mut results = comparison.runs.iter().map(|run| &run.result);
    if results
        .clone()
        .any(|result| result.outcome.stop == Stop::Interrupted)
    {
        Status::Interrupted
    } else if results.all(|result| result.is_complete() && result.is_trusted()) {
        Status::Answered
    } else {
        Status::NotTrusted
    }
}

/// The parameter and its values.
fn parse_over(over: &str) -> Result<ValueList, Failure> {
    let wrong = |what: &str| {
        Failure::Other(format!(
            "--over {over}: {what}; write PATH=LIST, for example rocker.masses=1,2,10 or \
             rocker.stiffness=5,10,20 kN/mm"
        ))
    };
    let list = ValueList::parse(over).map_err(|what| wrong(&what))?;
    match list.values.len() {
        2..=MOST => Ok(list),
        _ => Err(wrong(&format!("between 2 and {MOST} values are compared"))),
    }
}

fn prepare_all(input: &Input<'_>, over: &ValueList) -> Result<Vec<Ready>, Failure> {
    over.settings()
        .map(|setting| input.prepare_judging(&[setting], ModelAssessment::Asked))
        .collect()
}

fn record_name(index: usize) -> String {
    format!("record-{}.csv", index + 1)
}

fn chart_name(object: &str, quantity: Quantity) -> String {
    format!("{object}-{}.svg", quantity.name().replace('_', "-"))
}

fn prepare_folder(
    args: &CompareArgs,
    ready: &[Ready],
    count: usize,
) -> Result<Option<OutputFolder>, Failure> {
    let mut names: Vec<String> = FILES.map(str::to_owned).into();
    names.extend((0..count).map(record_name));
    for object in &ready[0].system.model().objects {
        names.extend(DRAWN.map(|quantity| chart_name(&object.id, quantity)));
    }
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let scene = &ready[0].scene().name;
    Ok(OutputFolder::from_args(&args.out, scene, &names)?)
}

/// The files: figures, page, samples, curves over each other.
fn files<'a>(
    model: &'a Model,
    (comparison, over): (&'a Comparison, &'a Abscissa),
) -> Result<Vec<(String, Content<'a>)>, Failure> {
    let mut files = vec![
        (FILES[0].to_owned(), Content::Document),
        (
            FILES[1].to_owned(),
            Content::made(|| table_csv(&comparison.table)),
        ),
        (FILES[2].to_owned(), Content::Page),
    ];
    for (index, run) in comparison.runs.iter().enumerate() {
        let text = record_csv(&run.result.record, over)?;
        files.push((record_name(index), Content::made(move || text.clone())));
    }
    for object in &model.objects {
        for quantity in DRAWN {
            if let Some(chart) = chart((comparison, over), &object.id, quantity) {
                let name = chart_name(&object.id, quantity);
                files.push((name, Content::made(move || chart.svg(900.0, 420.0))));
            }
        }
    }
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::parse_over;

    #[test]
    fn two_values_or_more_are_compared() {
        let over = parse_over("rocker.masses=1, 2,10").unwrap();
        assert_eq!(
            (over.path.as_str(), over.values.len()),
            ("rocker.masses", 3)
        );
        let many = format!("a.b={}1", "1,".repeat(50));
        for wrong in [
            "rocker.masses",
            "=1,2",
            "a=1",
            "a=1,,2",
            "a=",
            "a=1 mm,2",
            &many,
        ] {
            assert!(parse_over(wrong).is_err(), "{wrong}");
        }
    }
}
