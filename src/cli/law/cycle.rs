//! `dam law cycle`: the whole cycle of a cam in a scene.

use super::args::CycleArgs;
use super::deliver;
use crate::cli::failure::Failure;
use crate::cli::input::Input;
use crate::dynamics::model::{Coordinate, NodeMotion};
use crate::report::findings::Source;
use crate::report::law::{cycle_findings, cycle_rows};
use crate::studies::cycle::cycle;
use serde_json::json;

pub(super) fn command(args: &CycleArgs) -> Result<(), Failure> {
    let input = Input::load(&args.scene)?;
    let ready = input.prepare(&[])?;
    let model = ready.system.model();
    let wrong = |what: &str| Failure::Other(format!("--of {}: {what}", args.of));
    let part = model.objects.iter().find(|part| part.id == args.of);
    let part = part.ok_or_else(|| wrong("there is no such object"))?;
    if part.is_drive() {
        return Err(wrong("a drive follows no law"));
    }
    let driver = part.driver();
    let driver = driver.ok_or_else(|| wrong("it follows several inputs, not one"))?;
    let law = match &model.nodes[part.nodes[0]].motion {
        NodeMotion::Mass { law } | NodeMotion::Rigid { law } => law,
        _ => return Err(wrong("it follows no law")),
    };
    let found = cycle(&law.position, law.lever).map_err(|message| wrong(&message))?;
    let unit = |coordinate: Coordinate| match coordinate {
        Coordinate::Turning => "rad",
        Coordinate::Sliding => "m",
    };
    let units = [
        unit(part.coordinate),
        unit(model.objects[driver].coordinate),
    ];
    let document = json!({
        "dam": 1, "scene": ready.scene().name, "object": part.id,
        "units": { "displacement": units[0], "driver": units[1] }, "cycle": found
    });
    let rows = cycle_rows(&law.position, law.lever, units, args.samples as usize);
    let scene = ready.scene();
    let source = Source::scene(input.text(), &scene.hash);
    let followed = (&law.position, law.lever);
    let found = cycle_findings(&scene.name, &part.id, followed, &found, units, source);
    let shown = (args.scene.json, args.form);
    deliver(
        (&args.out, args.scene.quiet),
        (&found, document),
        &rows,
        shown,
    )
}
