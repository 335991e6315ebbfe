//! `dam schema --of`: what the program declares, for editors and for the pages of reference.

use super::args::SchemaSubject;
use crate::frontend::diagnostics::CODES;
use crate::frontend::scene;
use crate::studies::studied;
use crate::units::{Quantity, known_units, parse, quantities};
use serde_json::{Value, json};

/// What is declared, as a document; `None`: the JSON Schema of scenes, which has a command of
/// its own.
pub(super) fn document(of: SchemaSubject) -> Option<Value> {
    match of {
        SchemaSubject::Scenes => None,
        SchemaSubject::Results => Some(results()),
        SchemaSubject::Units => Some(units()),
        SchemaSubject::Codes => Some(codes()),
    }
}

fn results() -> Value {
    let mut all = scene::described_results();
    for (study, figures) in studied::described_results() {
        all[study] = of_study(study, &figures);
    }
    all["ends"] = (studied::ends().iter())
        .map(|(name, meaning)| json!({ "name": name, "meaning": meaning }))
        .collect();
    all["dam"] = json!(1);
    all
}

fn of_study(study: &str, figures: &[studied::DescribedFigure]) -> Value {
    let one = |figure: &studied::DescribedFigure| {
        json!({
            "address": format!("{study}.OBJECT.{}", figure.address),
            "units": figure.units,
            "meaning": figure.meaning,
        })
    };
    figures.iter().map(one).collect()
}

fn units() -> Value {
    let quantity = |one: &Quantity| {
        json!({
            "name": one.name,
            "units": one.units,
            "angle_may_be_left_out": one.angle_may_be_left_out,
        })
    };
    let symbol = |symbol: String| {
        let one = parse(&format!("1 {symbol}")).ok()?;
        let dimension = one.dimension.to_string();
        Some(json!({ "symbol": symbol, "dimension": dimension, "in_si": one.value }))
    };
    let symbols: Vec<Value> = known_units().into_iter().filter_map(symbol).collect();
    let quantities: Vec<Value> = quantities::ALL.iter().map(quantity).collect();
    json!({ "dam": 1, "quantities": quantities, "symbols": symbols })
}

fn codes() -> Value {
    let one = |code: &crate::frontend::diagnostics::Code| json!({ "code": code.name, "cause": code.cause, "remedy": code.remedy });
    let codes: Vec<Value> = CODES.iter().map(one).collect();
    json!({ "dam": 1, "codes": codes })
}
