//! `dam orders`: orders of the law and resonances over the speed.

use super::answer::{Answer, AnswerForm, Content, PAGE, files};
use super::args::OrdersArgs;
use super::asker::Asker;
use super::failure::Failure;
use super::input::Ready;
use super::kinematics::quantity;
use super::output::OutputFolder;
use super::quantity::option;
use super::status::Status;
use crate::frontend::object::Measures;
use crate::frontend::read::Bounds;
use crate::report::findings::Source;
use crate::report::orders::{crossing_rows, orders_document, orders_findings, orders_rows};
use crate::studies::orders::OrdersQuestion;
use crate::units::quantities as q;
use crate::units::with_common_unit;

const FILES: [&str; 4] = ["orders.json", "orders.csv", "crossings.csv", PAGE];

/// Runs the command.
pub(crate) fn command(args: &OrdersArgs, asker: &dyn Asker) -> Result<Status, Failure> {
    let input = asker.input(&args.scene)?;
    let ready = input.prepare_and_warn(args.scene.quiet)?;
    let (name, hash) = (&ready.scene().name, &ready.scene().hash);
    let folder = OutputFolder::from_args(&args.out, name, &FILES)?;
    let found = ready.orders_within(&question(args, &ready)?, asker.budget())?;
    let document = orders_document(name, hash, &found).map_err(|error| error.to_string())?;
    let answer = Answer {
        command: "orders",
        findings: &orders_findings(name, &found, Source::scene(input.text(), hash)),
        document: document.into(),
        files: files(
            FILES,
            [
                Content::Document,
                Content::made(|| orders_rows(&found).csv()),
                Content::made(|| crossing_rows(&found).csv()),
                Content::Page,
            ],
        ),
        quiet: args.scene.quiet,
    };
    let shown = AnswerForm::json_or(args.scene.json, AnswerForm::Text);
    asker.deliver(&answer, folder.as_ref(), shown)?;
    Ok(Status::Answered)
}

fn question(args: &OrdersArgs, ready: &Ready) -> Result<OrdersQuestion, Failure> {
    let speeds = args.speeds.as_deref().map(speeds).transpose()?;
    // What deviates decides what the accuracy is a measure of.
    let elastic = ready.model().objects.iter().rev();
    let elastic = elastic
        .filter(|part| !part.links.is_empty())
        .map(|part| part.coordinate)
        .next();
    let wanted = Measures(elastic).displacement();
    Ok(OrdersQuestion {
        speeds,
        highest: usize::from(args.highest),
        accuracy: option("--accuracy", &args.accuracy, wanted, Bounds::POSITIVE)?,
        points: usize::from(args.points),
    })
}

/// `0:3000 rpm` in rad/s.
fn speeds(text: &str) -> Result<[f64; 2], Failure> {
    let wrong = |what: &str| {
        let message = format!("--speeds {text}: {what}; give LOW:HIGH, as 0:3000 rpm");
        Failure::Other(message)
    };
    let ends = text.split_once(':').ok_or_else(|| wrong("no `:`"))?;
    let ends = with_common_unit(&[ends.0, ends.1]).map_err(|what| wrong(&what))?;
    let read = |end: &str| quantity("--speeds", end, q::ANGULAR_SPEED.into());
    Ok([read(&ends[0])?, read(&ends[1])?])
}
