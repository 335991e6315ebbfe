//! `dam law cycle`: the whole cycle of a cam in a scene.

use super::args::CycleArgs;
use super::files;
use super::files::Results;
use crate::cli::failure::Failure;
use crate::cli::input::Input;
use crate::dynamics::model::{Coordinate, NodeMotion};
use crate::report::law::{LawPage, cycle_chart, cycle_csv, cycle_parts, cycle_text, shocks_said};
use crate::report::quantity::significant;
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
    let text = format!("{}: {}", part.id, cycle_text(&found, units[0], units[1]));
    let csv = cycle_csv(&law.position, law.lever, units, args.samples as usize);
    let mut charts = vec![cycle_chart(
        &part.id,
        &law.position,
        law.lever,
        &found,
        units[1],
    )];
    charts.extend(cycle_parts(&law.position, law.lever, units));
    let (sound, shocks) = shocks_said(&found.jumps);
    let answer = format!(
        "Greatest U″ = {} {}/{}². {shocks}",
        significant(found.acceleration.value, 6),
        units[0],
        units[1]
    );
    let subtitle = format!("cycle of {}", part.id);
    let results = Results {
        document: &document,
        csv: csv.map_err(|error| error.to_string())?,
        page: LawPage {
            title: &ready.scene().name,
            subtitle: &subtitle,
            answer: (sound, answer),
            text: &text,
            charts: &charts,
            scene: Some(input.text()),
            hash: &ready.scene().hash,
            version: env!("CARGO_PKG_VERSION"),
        },
    };
    let shown = (args.scene.json, args.form);
    files::deliver(&args.out, args.scene.quiet, &results, shown)
}
