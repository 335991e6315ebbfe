//! `dam law synthesize`: a stroke of run-up, uniform section and run-out.

use super::args::SynthesizeArgs;
use super::{argument_failure, deliver};
use crate::ask::StrokeQuestion;
use crate::cli::asker::Asker;
use crate::cli::failure::Failure;
use crate::fault::Fault;
use crate::kinematics::motion::stroke::{Criterion, Skewness};
use crate::report::law::{StrokeExtras, stroke_findings, stroke_rows};

pub(super) fn command(args: &SynthesizeArgs, asker: &dyn Asker) -> Result<(), Failure> {
    let found = question(args)
        .solve("--")?
        .map_err(|faults| refused(faults, args))?;
    let extras = StrokeExtras {
        against_none: found.against_none(),
        criterion: found.criterion(),
    };
    let rows = stroke_rows(&found.stroke, found.unit, args.form.samples as usize);
    let findings = stroke_findings(&found.words(), &found.stroke, found.unit, extras);
    let shown = (args.form.json, args.form.form);
    deliver(
        asker,
        (&args.form.out, false),
        (&findings, found.document()),
        &rows,
        shown,
    )
}

fn question(args: &SynthesizeArgs) -> StrokeQuestion {
    StrokeQuestion {
        run_up: args.run_up.clone(),
        run_out: args.run_out.clone(),
        stroke: args.stroke.clone(),
        span: args.span.clone(),
        peak_speed: args.peak_speed.clone(),
        uniform_stroke: args.uniform_stroke,
        uniform_span: args.uniform_span,
        uniform_optimum: args.uniform_optimum,
        skewness: skewness(args),
    }
}

fn skewness(args: &SynthesizeArgs) -> Skewness {
    if let Some(lambda) = args.acceleration_ratio {
        Skewness::AccelerationRatio(lambda)
    } else if let Some(weight) = args.least_acceleration {
        Skewness::Optimum(Criterion::Acceleration { weight })
    } else if let Some(weight) = args.least_torque {
        Skewness::Optimum(Criterion::Product { weight })
    } else {
        Skewness::Given(args.skewness.unwrap_or(1.0))
    }
}

/// Faults in terms of the options.
fn refused(faults: Vec<Fault>, args: &SynthesizeArgs) -> Failure {
    let optimum = match args.least_torque {
        Some(_) => "least-torque",
        None => "least-acceleration",
    };
    let named: Vec<Fault> = faults
        .into_iter()
        .map(|mut fault| {
            if fault.path == "optimum" {
                fault.path = optimum.to_owned();
            }
            fault
        })
        .collect();
    argument_failure(&named, "--")
}
