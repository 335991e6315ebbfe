//! Columns of records and the signals that they measure.

use super::question::IdentifyQuestion;
use crate::dynamics::model::{Model, ObjectPart};
use crate::dynamics::record::{Column, Quantity, Record};
use crate::frontend::diagnostics::Diagnostic;
use crate::frontend::read::did_you_mean;
use crate::studies::studied::quantity_of;
use crate::units::{number_and_unit, parse};

/// A column of all records, and the signal that it measures.
pub(super) struct Channel {
    /// The column.
    pub(super) column: String,
    /// Address of the signal.
    pub(super) address: String,
    /// SI unit of the signal.
    pub(super) unit: &'static str,
    /// Its stated standard deviation (SI).
    pub(super) sigma: Option<f64>,
}

/// The channels; what is wrong with them is added to the faults.
pub(super) fn channels(
    question: &IdentifyQuestion,
    model: &Model,
    wrong: &mut Vec<Diagnostic>,
) -> Vec<Channel> {
    let before = wrong.len();
    if question.signals.is_empty() {
        let hint = "name what a column measures: --match \"x=rocker.delta\"";
        wrong.push(fault("no column is matched with a signal").hint(hint));
    }
    let known = signals_of(model);
    let mut found: Vec<Channel> = Vec::new();
    for text in &question.signals {
        match channel(text, &known) {
            Ok(one) if found.iter().any(|other| other.column == one.column) => {
                let message = format!("--match names the column `{}` twice", one.column);
                wrong.push(fault(message).hint("a column measures one signal"));
            }
            Ok(one) => found.push(one),
            Err(fault) => wrong.push(*fault),
        }
    }
    let mut stated: Vec<String> = Vec::new();
    for text in &question.sigmas {
        match sigma(text, &mut found) {
            Ok(column) if stated.contains(&column) => {
                wrong.push(fault(format!("--sigma names the column `{column}` twice")));
            }
            Ok(column) => stated.push(column),
            Err(what) => wrong.push(fault(format!("--sigma `{text}`: {what}"))),
        }
    }
    let is_mixed = found.windows(2).any(|pair| pair[0].unit != pair[1].unit);
    let has_some = !stated.is_empty() && stated.len() < found.len();
    if wrong.len() == before && (has_some || is_mixed && stated.is_empty()) {
        let hint = "give the standard deviation of each: --sigma \"x=1 µrad\"";
        wrong.push(fault("the columns cannot be weighed against each other").hint(hint));
    }
    found
}

fn fault(what: impl Into<String>) -> Diagnostic {
    Diagnostic::error("question", what)
}

fn channel(text: &str, known: &[(String, &'static str)]) -> Result<Channel, Box<Diagnostic>> {
    let Some((column, address)) = text.split_once('=') else {
        let hint = "write COLUMN=SIGNAL, for example x=rocker.delta";
        let fault = fault(format!("--match `{text}`: no `=`")).hint(hint);
        return Err(Box::new(fault));
    };
    let (column, address) = (column.trim().to_owned(), address.trim().to_owned());
    let Some((_, unit)) = known.iter().find(|(name, _)| *name == address) else {
        let names = known.iter().map(|(name, _)| name.as_str());
        let hint = did_you_mean(&address, names.clone());
        let all = || format!("there are {}", names.collect::<Vec<_>>().join(", "));
        let fault = Diagnostic::error(
            "unknown-name",
            format!("--match: there is no signal `{address}`"),
        );
        return Err(Box::new(fault.hint(hint.unwrap_or_else(all))));
    };
    Ok(Channel {
        column,
        address,
        unit,
        sigma: None,
    })
}

/// The signals of a run with their SI units.
fn signals_of(model: &Model) -> Vec<(String, &'static str)> {
    let of = |part: &ObjectPart| {
        Quantity::ALL.map(|one| {
            let address = format!("{}.{}", part.id, one.name());
            (address, one.unit(part.coordinate))
        })
    };
    model.objects.iter().flat_map(of).collect()
}

/// The values of a signal in the record of a run; `None`: it has none.
pub(super) fn values_of<'r>(record: &'r Record, address: &str) -> Option<&'r [f64]> {
    let is_meant = |one: &&Column| format!("{}.{}", one.object, one.quantity.name()) == address;
    let column = record.columns.iter().find(is_meant)?;
    Some(column.values.as_slice())
}

/// Takes the standard deviation of a column, whose name is returned.
fn sigma(text: &str, channels: &mut [Channel]) -> Result<String, String> {
    let no_equals = "no `=`: write COLUMN=VALUE UNIT";
    let (column, value) = text.split_once('=').ok_or(no_equals)?;
    let column = column.trim();
    let channel = channels.iter_mut().find(|one| one.column == column);
    let channel = channel.ok_or("no column of this name is matched")?;
    let measure = parse(value.trim()).map_err(|_| "no number with a known unit".to_owned())?;
    let is_bare = number_and_unit(value).is_some_and(|(_, unit)| unit.is_empty());
    let value = match quantity_of(channel.unit).accept(measure) {
        Ok(value) => value,
        Err(_) if is_bare => measure.value,
        Err(_) => return Err(format!("the signal is measured in {}", channel.unit)),
    };
    channel.sigma = Some(value);
    match value > 0.0 && value.is_finite() {
        true => Ok(column.to_owned()),
        false => Err("a standard deviation is greater than 0".to_owned()),
    }
}
