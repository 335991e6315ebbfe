//! `dam law cycle`: the whole cycle of a cam in a scene.

use super::PICTURE;
use super::args::{CycleArgs, Form};
use crate::analysis::cycle::cycle;
use crate::cli::console;
use crate::cli::failure::Failure;
use crate::cli::input::Input;
use crate::model::{Coordinate, NodeMotion};
use crate::report::law::{cycle_chart, cycle_csv, cycle_text};
use serde_json::json;

pub(super) fn command(args: &CycleArgs) -> Result<(), Failure> {
    let ready = Input::load(&args.scene)?.prepare(&[])?;
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
    if args.scene.json {
        console::json(&json!({
            "dam": 1, "scene": ready.scene().name, "object": part.id,
            "units": { "displacement": units[0], "driver": units[1] }, "cycle": found
        }))?;
        return Ok(());
    }
    match args.form {
        Form::Text => {
            console::data(&format!(
                "{}: {}",
                part.id,
                cycle_text(&found, units[0], units[1])
            ))?;
        }
        Form::Csv => {
            let text = cycle_csv(&law.position, law.lever, units, args.samples as usize);
            console::data(&text.map_err(|error| error.to_string())?)?;
        }
        Form::Svg => {
            let chart = cycle_chart(&part.id, &law.position, law.lever, &found, units[1]);
            console::data(&chart.svg(PICTURE.0, PICTURE.1))?;
        }
    }
    Ok(())
}
