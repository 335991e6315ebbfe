//! Records: how they are read, and how the runs beside them are made.

use super::channels::Channel;
use super::question::{IdentifyQuestion, MeasuredRecord};
use crate::Error;
use crate::ask::prepared::PointSource;
use crate::ask::variables::ready;
use crate::frontend::diagnostics::{Diagnostic, Diagnostics, Source, Sources};
use crate::frontend::read::{TableFile, TimeTable};
use crate::frontend::scene::{Levels, Reading};
use crate::studies::Control;
use crate::studies::identify::{FittedSignal, Grid};
use crate::studies::optimize::Variable;
use crate::studies::run::run;
use crate::studies::studied::quantity_of;
use crate::units::shown;
use std::sync::Arc;

/// Digits of a time in a remark.
const DIGITS: usize = 6;

/// How the runs of a record are made.
pub(super) struct Test {
    /// Settings of its runs.
    pub(super) settings: Vec<String>,
    /// Its times among the samples of a run.
    pub(super) grid: Grid,
}

/// The records as they are used.
pub(super) struct Tests {
    /// One a record.
    pub(super) tests: Vec<Test>,
    /// The signals of all records, record by record.
    pub(super) signals: Vec<FittedSignal>,
    /// What is to be known of them.
    pub(super) remarks: Vec<String>,
}

/// Reads the tables of all records.
///
/// # Errors
/// All that is wrong with them.
pub(super) fn tables(
    records: &[MeasuredRecord],
    channels: &[Channel],
) -> Result<Vec<TimeTable>, Diagnostics> {
    let wanted: Vec<_> = channels
        .iter()
        .map(|one| (one.column.as_str(), quantity_of(one.unit).into()))
        .collect();
    let (mut sources, mut wrong, mut found) = (Sources::default(), Vec::new(), Vec::new());
    for record in records {
        let source = Arc::new(Source {
            name: record.name.clone(),
            text: record.text.clone(),
        });
        let id = sources.add(Arc::clone(&source));
        match TableFile::new(source, id).over_time(&wanted) {
            Ok(table) => found.push(table),
            Err(faults) => wrong.extend(faults),
        }
    }
    wrong.extend(repeated(records));
    match wrong.is_empty() {
        true => Ok(found),
        false => Err(Diagnostics::new(sources, wrong)),
    }
}

/// Records that stand twice under the same settings: each measurement counts once.
fn repeated(records: &[MeasuredRecord]) -> Vec<Diagnostic> {
    let again = records.iter().enumerate().filter_map(|(index, own)| {
        let same =
            |other: &&MeasuredRecord| other.text == own.text && other.settings == own.settings;
        let first = records[..index].iter().find(same)?;
        Some((first, own))
    });
    again
        .map(|(first, own)| {
            let message = format!(
                "the record `{}` is the same as `{}`, under the same settings",
                own.name, first.name
            );
            let hint = "give each record once: counted twice, it would make the standard errors \
                        smaller than they are";
            Diagnostic::error("question", message).hint(hint)
        })
        .collect()
}

/// What is wrong with the settings of a record.
pub(super) fn wrong_settings(
    record: &MeasuredRecord,
    variables: &[Variable],
    (reading, source): (&Reading, &PointSource<'_, '_>),
) -> Vec<Diagnostic> {
    let mut wrong = Vec::new();
    for setting in &record.settings {
        let path = setting.split('=').next().unwrap_or_default().trim();
        if variables.iter().any(|one| reading.is_same(&one.path, path)) {
            let message = format!(
                "the record `{}` sets `{path}`, which is sought",
                record.name
            );
            wrong.push(Diagnostic::error("question", message).hint("leave out one of both"));
        }
    }
    if let Err(found) = source.decode(&record.settings) {
        wrong.extend(found.items.into_iter().map(|one| {
            let message = format!("the record `{}`: {}", record.name, one.message);
            let own = Diagnostic::error("question", message);
            one.hints.into_iter().fold(own, Diagnostic::hint)
        }));
    }
    wrong
}

/// The records with their tables, cut where rows are left out.
///
/// # Errors
/// What is wrong with the times; the scene cannot be run, if its first separation is asked for.
pub(super) fn tests(
    question: &IdentifyQuestion,
    tables: Vec<TimeTable>,
    (channels, levels): (&[Channel], &Levels),
    (source, control): (&PointSource<'_, '_>, &Control<'_>),
) -> Result<Tests, Error> {
    let mut found = Tests {
        tests: Vec::new(),
        signals: Vec::new(),
        remarks: Vec::new(),
    };
    let (mut wrong, mut grids) = (Vec::new(), Vec::new());
    for (record, table) in question.records.iter().zip(&tables) {
        match grid(record, &table.times) {
            Ok(grid) => grids.push(grid),
            Err(fault) => wrong.push(*fault),
        }
    }
    if !wrong.is_empty() {
        return Err(Diagnostics::new(Sources::default(), wrong).into());
    }
    for ((record, mut table), mut own) in question.records.iter().zip(tables).zip(grids) {
        if question.until_first_separation {
            let first = first_separation((record, &own), levels, (source, control))?;
            found.remarks.push(cut(record, &mut table, first));
            let fault = |one: Box<Diagnostic>| Diagnostics::new(Sources::default(), vec![*one]);
            own = grid(record, &table.times).map_err(fault)?;
        }
        if !own.even {
            found.remarks.push(format!(
                "the times of the record `{}` are not even: the signals of the runs are interpolated",
                record.name
            ));
        }
        found.signals.extend(signals(record, &table, channels));
        found.tests.push(Test {
            settings: settings(record, &own),
            grid: own,
        });
    }
    Ok(found)
}

fn grid(record: &MeasuredRecord, times: &[f64]) -> Result<Grid, Box<Diagnostic>> {
    Grid::of(times).map_err(|what| {
        let message = format!("the record `{}`: {what}", record.name);
        Box::new(Diagnostic::error("question", message))
    })
}

fn signals<'s>(
    record: &'s MeasuredRecord,
    table: &'s TimeTable,
    channels: &'s [Channel],
) -> impl Iterator<Item = FittedSignal> + 's {
    let each = channels.iter().zip(&table.columns);
    each.map(move |(channel, values)| FittedSignal {
        record: record.name.clone(),
        column: channel.column.clone(),
        address: channel.address.clone(),
        unit: channel.unit.to_owned(),
        sigma: channel.sigma,
        times: table.times.clone(),
        measured: values.clone(),
        residuals: Vec::new(),
        test: None,
        is_exact: false,
        outliers: Vec::new(),
    })
}

/// The settings of the runs of a record.
fn settings(record: &MeasuredRecord, grid: &Grid) -> Vec<String> {
    let own = [
        format!("run.duration={:?}", grid.duration),
        format!("run.samples={}", grid.samples),
    ];
    record.settings.iter().cloned().chain(own).collect()
}

/// Time of the first separation in the scene as it is; infinite if there is none.
fn first_separation(
    (record, grid): (&MeasuredRecord, &Grid),
    levels: &Levels,
    (source, control): (&PointSource<'_, '_>, &Control<'_>),
) -> Result<f64, Error> {
    let reading = source.decode(&settings(record, grid))?;
    let ready = ready(reading, levels, control)?;
    let found = run(&ready.system, &ready.settings, control, &mut []);
    let found = found.map_err(|faults| ready.diagnose(&faults))?;
    let starts = found.record.separations.iter().map(|one| one.from);
    Ok(starts.fold(f64::INFINITY, f64::min))
}

/// Leaves out the rows from a time on; what is to be known of it.
fn cut(record: &MeasuredRecord, table: &mut TimeTable, first: f64) -> String {
    let left = table.times.partition_point(|time| *time < first);
    if left == table.times.len() {
        return format!(
            "no contact separates before the end of the record `{}`: all its rows are used",
            record.name
        );
    }
    table.times.truncate(left);
    for values in &mut table.columns {
        values.truncate(left);
    }
    format!(
        "rows of the record `{}` from the first separation on, at {} s, are left out",
        record.name,
        shown(first, DIGITS)
    )
}
