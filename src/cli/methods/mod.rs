//! `dam methods`: speed against accuracy of every method, and where they fail.

mod bar;

use super::answer::{Answer, AnswerForm, Content, Document, Files, PAGE, files};
use super::args::MethodsArgs;
use super::asker::Asker;
use super::failure::Failure;
use super::input::{Input, Ready, print_doubts};
use super::interrupt;
use super::output::OutputFolder;
use super::status::Status;
use crate::ask::ModelAssessment;
use crate::dynamics::integrate::Method;
use crate::fault::Fault;
use crate::report::diagram::Diagram;
use crate::report::findings::Source;
use crate::report::methods::charts::{
    Against, cost, height_of_regions, regions, stable_steps, work_precision,
};
use crate::report::methods::{findings, methods_rows, sweep_findings, sweep_rows};
use crate::report::plot::Plot;
use crate::studies::RunSettings;
use crate::studies::axis::Axis;
use crate::studies::methods::sweep::{Sweep, sweep};
use crate::studies::methods::{
    Models, Now, Plan, Study, all_methods, is_exact, is_fixed_step, models, study,
};
use crate::studies::order::USUAL_SHARE;
use bar::PointBar;
use std::time::Duration;

/// Files of a study.
const OF_STUDY: [&str; 5] = [
    "methods.json",
    "methods.csv",
    "error-time.svg",
    "error-evaluations.svg",
    PAGE,
];

/// Files of a study over a parameter; without a method of fixed step there is
/// no chart of stable steps.
const OF_SWEEP: [&str; 6] = [
    "methods.json",
    "methods.csv",
    "regions.svg",
    "cost.svg",
    "stable-steps.svg",
    PAGE,
];

/// Size of the pictures (pixels).
const SIZE: (f64, f64) = (900.0, 540.0);

/// Most values of an axis: each is a study of its own.
const MOST_VALUES: usize = 1000;

/// Runs the command.
pub(crate) fn command(args: &MethodsArgs, asker: &dyn Asker) -> Result<Status, Failure> {
    let input = asker.input(&args.scene)?;
    let axis = args.x.as_deref().map(axis).transpose()?;
    // Of an axis the first value shows whether the scene can take it.
    let further: Vec<String> = axis.iter().map(|axis| axis.setting(axis.from)).collect();
    let (ready, models) = match args.models {
        true => with_model((args, asker), &input)?,
        false => (input.prepare(&further)?, None),
    };
    print_doubts(&ready.reading, args.scene.quiet);
    let plan = plan(args, &ready, models.as_ref())?;
    let folder = prepare_folder(args, &ready)?;
    let (scene, hash) = (&ready.scene().name, &ready.scene().hash);
    let (diagram, source) = (
        Diagram::of(ready.system.model()),
        Source::scene(input.text(), hash),
    );
    let answer = |findings, document, files| {
        let answer = Answer {
            command: "methods",
            findings: &findings,
            document,
            files,
            quiet: args.scene.quiet,
        };
        let shown = AnswerForm::json_or(args.scene.json, AnswerForm::Text);
        asker.deliver(&answer, folder.as_ref(), shown)
    };
    let (complete, doubted) = match &axis {
        None => {
            let mut found = study_once((args, asker), &ready, &plan)?;
            if let Some(models) = models {
                found = found.with_models(models);
            }
            let document = Document::made(|| &found);
            let files = files_of_study(&found);
            answer(findings(&found, &diagram, source), document, files)?;
            (found.complete, found.doubt.is_some())
        }
        Some(axis) => {
            let found = study_over_axis((args, asker), &input, &ready, axis, &plan)?;
            let document = Document::made(|| &found);
            let files = files_of_sweep(&found);
            let findings = sweep_findings(scene, &found, &diagram, source);
            answer(findings, document, files)?;
            (found.complete, found.is_doubted())
        }
    };
    Ok(match (complete, doubted) {
        (true, false) => Status::Answered,
        (true, true) => Status::NotTrusted,
        (false, _) => interrupt::status(),
    })
}

fn files_of_study(study: &Study) -> Files<'_> {
    let chart = |against| Content::made(move || work_precision(study, against).svg(SIZE.0, SIZE.1));
    let contents = [
        Content::Document,
        Content::made(|| methods_rows(study).csv()),
        chart(Against::Time),
        chart(Against::Evaluations),
        Content::Page,
    ];
    files(OF_STUDY, contents)
}

fn files_of_sweep(sweep: &Sweep) -> Files<'_> {
    let chart = |chart: Option<Plot>, height| {
        chart.map(|chart| Content::made(move || chart.svg(SIZE.0, height)))
    };
    let contents = [
        Some(Content::Document),
        Some(Content::made(|| sweep_rows(sweep).csv())),
        chart(Some(regions(sweep)), height_of_regions(sweep)),
        chart(cost(sweep), SIZE.1),
        chart(stable_steps(sweep), SIZE.1),
        Some(Content::Page),
    ];
    let named = OF_SWEEP.map(str::to_owned).into_iter().zip(contents);
    named
        .filter_map(|(name, content)| Some((name, content?)))
        .collect()
}

/// The scene with the least model that is accurate enough, and the errors of all models.
fn with_model(
    (args, asker): (&MethodsArgs, &dyn Asker),
    input: &Input<'_>,
) -> Result<(Ready, Option<Models>), Failure> {
    let control = asker.budget();
    let mut reading = input.decode(&[])?;
    let places = reading.places.clone();
    let diagnose = |faults: Vec<Fault>| places.diagnose(&faults);
    let settings = RunSettings::of(&reading.scene).map_err(|fault| diagnose(vec![fault]))?;
    let asked = args.accuracy.unwrap_or(USUAL_SHARE);
    let found = models(&mut reading.scene, &settings, asked, control).map_err(diagnose)?;
    let ready = Ready::of_within(reading, ModelAssessment::Never, control)?;
    Ok((ready, Some(found)))
}

/// The folder for the results, checked before the work.
fn prepare_folder(args: &MethodsArgs, ready: &Ready) -> Result<Option<OutputFolder>, Failure> {
    let names: &[&str] = match args.x {
        None => &OF_STUDY,
        Some(_) => &OF_SWEEP,
    };
    let scene = &ready.scene().name;
    Ok(OutputFolder::from_args(&args.out, scene, names)?)
}

fn axis(text: &str) -> Result<Axis, Failure> {
    let axis = Axis::parse(text).map_err(|what| Failure::Other(format!("--x {what}")))?;
    if axis.count > MOST_VALUES {
        return Err(Failure::Other(format!(
            "--x {text}: {} values, each a study of its own; at most {MOST_VALUES} are taken",
            axis.count
        )));
    }
    Ok(axis)
}

/// Plan that the arguments and the scene ask for.
fn plan(args: &MethodsArgs, ready: &Ready, models: Option<&Models>) -> Result<Plan, Failure> {
    let accuracy = match models {
        Some(models) => models.accuracy_of_methods(),
        None => args.accuracy.unwrap_or(ready.settings.tolerance),
    };
    let mut plan = Plan {
        repeats: args.repeats as usize,
        point_limit: Duration::from_secs_f64(args.point_limit),
        ..Plan::new(accuracy)
    };
    if !args.methods.is_empty() {
        let named: Result<Vec<Method>, Failure> =
            args.methods.iter().map(|name| method(name)).collect();
        let named = named?;
        plan.methods.retain(|method| named.contains(method));
    }
    refuse_unused(args, &plan.methods)?;
    if !args.tolerances.is_empty() {
        plan.tolerances.clone_from(&args.tolerances);
        plan.tolerances.sort_by(|a, b| b.total_cmp(a));
        plan.tolerances.dedup();
    }
    if !args.steps.is_empty() {
        let mut steps = args.steps.clone();
        steps.sort_by(|a, b| b.total_cmp(a));
        steps.dedup();
        plan.steps = Some(steps);
    }
    Ok(plan)
}

/// Refuses settings that none of the methods takes.
fn refuse_unused(args: &MethodsArgs, methods: &[Method]) -> Result<(), Failure> {
    let fixed = methods.iter().any(|&method| is_fixed_step(method));
    let controlled = |method: &Method| !is_fixed_step(*method) && !is_exact(*method);
    let why = match (args.steps.is_empty(), args.tolerances.is_empty()) {
        (false, _) if !fixed => "--steps has no effect: no method of fixed step is tried",
        (_, false) if !methods.iter().any(controlled) => {
            "--tolerances has no effect: no method that controls its step is tried"
        }
        _ => return Ok(()),
    };
    Err(Failure::Other(why.to_owned()))
}

fn method(name: &str) -> Result<Method, Failure> {
    let known = all_methods();
    let found = known.iter().find(|method| method.name() == name.trim());
    found.copied().ok_or_else(|| {
        let names: Vec<&str> = known.iter().map(|method| method.name()).collect();
        Failure::Other(format!(
            "--methods {name}: unknown method; one of {}",
            names.join(", ")
        ))
    })
}

/// Runs one study, with a progress bar.
fn study_once(
    (args, asker): (&MethodsArgs, &dyn Asker),
    ready: &Ready,
    plan: &Plan,
) -> Result<Study, Failure> {
    let bar = PointBar::new(1, args.scene.quiet);
    let mut keeping = None;
    let mut tell = |now: &Now| {
        keeping.get_or_insert_with(|| asker.guard_from_interrupt());
        bar.at(0, now);
        asker.report_progress(
            now.done,
            now.total,
            &format!("{}, {}", now.method, now.setting),
        );
    };
    let control = asker.budget();
    let found = study(&ready.system, &ready.settings, plan, control, &mut tell);
    bar.finish();
    found.map_err(|faults| ready.reading.places.diagnose(&faults).into())
}

/// A study at every value of an axis, with a progress bar.
fn study_over_axis(
    (args, asker): (&MethodsArgs, &dyn Asker),
    input: &Input<'_>,
    first: &Ready,
    axis: &Axis,
    plan: &Plan,
) -> Result<Sweep, Failure> {
    let bar = PointBar::new(axis.count, args.scene.quiet);
    let mut keeping = None;
    let found = sweep(
        axis,
        plan,
        asker.budget(),
        |x| {
            let ready = input.prepare(&[axis.setting(x)])?;
            Ok((ready.system, ready.settings))
        },
        |x, mut faults| {
            for fault in &mut faults {
                let message = std::mem::take(&mut fault.message);
                fault.message = format!("with {}: {message}", axis.setting(x));
            }
            first.reading.places.diagnose(&faults).into()
        },
        &mut |index, now| {
            keeping.get_or_insert_with(|| asker.guard_from_interrupt());
            bar.at(index, now);
            let (done, of) = (index * now.total + now.done, axis.count * now.total);
            asker.report_progress(done, of, &format!("{}, {}", now.method, now.setting));
        },
    );
    bar.finish();
    found
}
