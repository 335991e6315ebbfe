//! `dam law cycle`: the whole cycle of a cam in a scene.

use super::args::CycleArgs;
use super::deliver;
use crate::cli::asker::Asker;
use crate::cli::failure::Failure;
use crate::report::findings::Source;
use crate::report::law::{cycle_findings, cycle_rows};

pub(super) fn command(args: &CycleArgs, asker: &dyn Asker) -> Result<(), Failure> {
    let input = asker.input(&args.scene)?;
    let ready = input.prepare_and_warn(args.scene.quiet)?;
    let scene = ready.scene();
    let found = ready.law_cycle(&args.of)?;
    let rows = cycle_rows(
        found.position,
        found.lever,
        found.units,
        args.samples as usize,
    );
    let document = found.document(&scene.name);
    let source = Source::scene(input.text(), &scene.hash);
    let followed = (found.position, found.lever);
    let (object, units) = (found.object, found.units);
    let found = cycle_findings(&scene.name, object, followed, &found.figures, units, source);
    let shown = (args.scene.json, args.form);
    deliver(
        asker,
        (&args.out, args.scene.quiet),
        (&found, document),
        &rows,
        shown,
    )
}
