//! `dam law compare`: laws ranked by constants and by what a scene makes of them.

use super::args::{CompareArgs, LawForm, RankBy};
use super::deliver;
use crate::ask::{LawQuestion, compare_laws};
use crate::cli::asker::Asker;
use crate::cli::failure::Failure;
use crate::cli::interrupt;
use crate::cli::run::run_with_progress;
use crate::cli::status::Status;
use crate::report::findings::Source;
use crate::report::law::{comparison_findings, comparison_rows};
use crate::studies::law::Figure;

pub(super) fn command(args: &CompareArgs, asker: &dyn Asker) -> Result<Status, Failure> {
    let input = asker.input(&args.scene)?;
    let question = LawQuestion {
        at: args.at.clone(),
        laws: args.law.clone(),
        lift_off: args.lift_off,
    };
    let quiet = args.scene.quiet;
    let (mut keeping, mut runs) = (None, 0);
    let compared = compare_laws(
        &question,
        asker.budget(),
        |settings| input.prepare(settings),
        |ready, settings, searching| {
            asker.report_progress(
                runs,
                0,
                if searching {
                    "search for the lift-off"
                } else {
                    "runs of the laws"
                },
            );
            runs += 1;
            let result = run_with_progress((ready, asker), settings, quiet || searching)?;
            // From the first run on there is something to keep.
            if !result.outcome.stop.is_from_outside() {
                keeping.get_or_insert_with(|| asker.guard_from_interrupt());
            }
            Ok::<_, Failure>(result)
        },
    )?;
    let by = figure(args.by);
    let ready = input.prepare_and_warn(quiet)?;
    let (name, hash) = (&ready.scene().name, &ready.scene().hash);
    let source = Source::scene(input.text(), hash);
    let (laws, trusted) = (&compared.laws, compared.trusted);
    let found = comparison_findings(name, &args.at, laws, by, trusted, source);
    let rows = comparison_rows(laws);
    let form = if args.csv {
        LawForm::Csv
    } else {
        LawForm::Text
    };
    let shown = (args.scene.json, form);
    deliver(
        asker,
        (&args.out, quiet),
        (&found, compared.document(by)),
        &rows,
        shown,
    )?;
    Ok(match (compared.complete, trusted) {
        (false, _) => interrupt::status(),
        (true, true) => Status::Answered,
        (true, false) => Status::NotTrusted,
    })
}

fn figure(by: RankBy) -> Figure {
    match by {
        RankBy::Residual => Figure::Residual,
        RankBy::Deviation => Figure::Deviation,
        RankBy::ContactForce => Figure::ContactForce,
        RankBy::DriverTorque => Figure::DriverTorque,
        RankBy::LiftOff => Figure::LiftOff,
    }
}
