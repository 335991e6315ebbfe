//! Numbers of a scene from records of its motion.

use super::Mechanism;
use crate::Error;
use crate::dynamics::integrate::Stop;
use crate::dynamics::model::{Model, ObjectPart};
use crate::dynamics::record::{Column, Quantity, Record};
use crate::frontend::diagnostics::{Diagnostic, Diagnostics, Source, Sources};
use crate::frontend::read::{TableFile, did_you_mean};
use crate::frontend::scene::Reading;
use crate::studies::Control;
use crate::studies::axis::Axis;
use crate::studies::find::Span;
use crate::studies::identify::{
    Bounds, FittedSignal, Grid, Identification, Unknown, identify as fit_all, starts,
};
use crate::studies::run::{RunResult, run};
use crate::studies::side_by_side::{side_by_side, threads as number_of_threads};
use crate::studies::studied::quantity_of;
use crate::units::{number_and_unit, parse};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// Starts if none are named.
pub const USUAL_STARTS: usize = 8;

/// Most starts.
const MOST_STARTS: usize = 1000;

/// A record of a motion: a table with a header, as tables beside scenes have.
#[derive(Clone, Debug, Default)]
pub struct MeasuredRecord {
    /// Name of the file, for messages.
    pub name: String,
    /// The table as CSV. Its first column is the time.
    pub text: String,
    /// Settings of the scene that hold for this record alone.
    pub settings: Vec<String>,
}

/// What is sought, and from what.
#[derive(Clone, Debug)]
pub struct IdentifyQuestion {
    /// The records.
    pub records: Vec<MeasuredRecord>,
    /// Columns and the signals that they measure: `x=rocker.delta`.
    pub signals: Vec<String>,
    /// Numbers of the scene with their ranges: `rocker.stiffness=5:20 MN m/rad`.
    pub vary: Vec<String>,
    /// Standard deviations of columns: `x=1 µrad`.
    pub sigmas: Vec<String>,
    /// Number of starts.
    pub starts: usize,
    /// Seed of the starts.
    pub seed: u32,
    /// Whether rows after the first separation of a contact are left out.
    pub until_first_separation: bool,
    /// Number of threads; default: one for every processor core. Results do not depend on it.
    pub threads: Option<usize>,
}

impl Default for IdentifyQuestion {
    fn default() -> Self {
        Self {
            records: Vec::new(),
            signals: Vec::new(),
            vary: Vec::new(),
            sigmas: Vec::new(),
            starts: USUAL_STARTS,
            seed: 1,
            until_first_separation: false,
            threads: None,
        }
    }
}

/// Makes the scene ready with further settings.
type Prepare<'p> = dyn Fn(&[String]) -> Result<Mechanism, Error> + Sync + 'p;

/// Finds the numbers. `prepare`: the scene with further settings made ready; `heard`: told the
/// number of runs that are done, from any thread.
///
/// # Errors
/// As of [`Scene::identify`](super::Scene::identify).
pub(crate) fn identify(
    question: &IdentifyQuestion,
    prepare: &Prepare<'_>,
    control: &Control<'_>,
    heard: &(dyn Fn(usize) + Sync),
) -> Result<Identification, Error> {
    let base = prepare(&[])?;
    let mut wrong = Vec::new();
    let mut ranges = Vec::new();
    for text in &question.vary {
        match range(text, &base.reading, prepare) {
            Ok(found) => ranges.push(found),
            Err(faults) => wrong.extend(faults),
        }
    }
    let channels = channels(question, &base, &mut wrong);
    check(question, &mut wrong);
    if !wrong.is_empty() {
        return Err(Diagnostics::new(Sources::default(), wrong).into());
    }
    let (mut tests, mut signals) = (Vec::new(), Vec::new());
    for record in &question.records {
        let (test, own) = test(record, &channels, question, prepare, control)?;
        tests.push(test);
        signals.extend(own);
    }
    let (axes, unknowns): (Vec<Axis>, Vec<Unknown>) = ranges.into_iter().unzip();
    let places = starts(&unknowns, question.starts, question.seed);
    let evaluation = Evaluation {
        axes: &axes,
        tests: &tests,
        signals: &signals,
        prepare,
        control,
        heard,
        done: AtomicUsize::new(0),
        threads: number_of_threads(question.threads),
    };
    let residuals = |rows: &[Vec<f64>]| evaluation.residuals(rows);
    let mut found =
        fit_all(&unknowns, &places, signals.clone(), &residuals).map_err(Error::question)?;
    found.remarks = tests.into_iter().flat_map(|test| test.remarks).collect();
    Ok(found)
}

fn refused(what: impl Into<String>) -> Diagnostic {
    Diagnostic::error("question", what)
}

fn check(question: &IdentifyQuestion, wrong: &mut Vec<Diagnostic>) {
    if question.records.is_empty() {
        let hint =
            "give a CSV file with a column of time and columns of signals: --record test.csv";
        wrong.push(refused("no record is named").hint(hint));
    }
    if question.vary.is_empty() {
        let hint = "give numbers of the scene with their ranges: --vary rocker.stiffness=\"5:20 MN m/rad\"";
        wrong.push(refused("nothing is sought").hint(hint));
    }
    if !(1..=MOST_STARTS).contains(&question.starts) {
        let message = format!("{} starts are wanted", question.starts);
        wrong.push(refused(message).hint(format!("give 1 to {MOST_STARTS}")));
    }
}

/// A number that is sought, with its axis.
fn range(
    text: &str,
    reading: &Reading,
    prepare: &Prepare<'_>,
) -> Result<(Axis, Unknown), Vec<Diagnostic>> {
    let one = |what: String| vec![refused(what)];
    let span = Span::parse(text).map_err(|what| one(format!("--vary {what}")))?;
    let axis = span.axis;
    let [lower, upper] = [axis.from.min(axis.to), axis.from.max(axis.to)];
    let si = |value: f64| {
        let ready = prepare(&[axis.setting(value)])?;
        let number = ready.reading.number(&axis.path);
        number.map_err(|_| Error::question(format!("`{}` is no number", axis.path)))
    };
    // (Between the ends no number is whole by chance.)
    let middle = lower + 0.4321 * (upper - lower);
    let ends = [si(lower), si(middle), si(upper)];
    let mut known = ends.iter().filter_map(|end| end.as_ref().ok());
    if known.clone().count() == 0 {
        let first = ends.into_iter().find_map(Result::err);
        return Err(first.map_or_else(Vec::new, |error| error.into_diagnostics().items));
    }
    let factor = match known.next() {
        Some(found) if ends[0].is_ok() && lower != 0.0 => found / lower,
        _ => ends[1].as_ref().map_or(1.0, |found| found / middle),
    };
    let given = reading.number(&axis.path).map(|own| own / factor);
    let unit = match axis.unit.as_str() {
        "" => String::new(),
        unit => unit.to_owned(),
    };
    let unknown = Unknown {
        path: axis.path.clone(),
        unit,
        bounds: Bounds {
            lower,
            upper,
            scale: upper - lower,
        },
        given: given.unwrap_or(middle).clamp(lower, upper),
    };
    Ok((axis, unknown))
}

/// A column of all records, and the signal that it measures.
struct Channel {
    column: String,
    address: String,
    unit: &'static str,
    weight: f64,
}

fn channels(
    question: &IdentifyQuestion,
    base: &Mechanism,
    wrong: &mut Vec<Diagnostic>,
) -> Vec<Channel> {
    if question.signals.is_empty() {
        let hint = "say what a column measures: --match \"x=rocker.delta\"";
        wrong.push(refused("no column is matched with a signal").hint(hint));
    }
    let known = signals_of(base.model());
    let mut found: Vec<Channel> = Vec::new();
    for text in &question.signals {
        let Some((column, address)) = text.split_once('=') else {
            let hint = "write COLUMN=SIGNAL, for example x=rocker.delta";
            wrong.push(refused(format!("--match `{text}`: no `=`")).hint(hint));
            continue;
        };
        let (column, address) = (column.trim().to_owned(), address.trim().to_owned());
        if found.iter().any(|one| one.column == column) {
            wrong.push(refused(format!(
                "--match names the column `{column}` twice"
            )));
            continue;
        }
        match known.iter().find(|(name, _)| *name == address) {
            Some((_, unit)) => found.push(Channel {
                column,
                address,
                unit,
                weight: 1.0,
            }),
            None => {
                let names = known.iter().map(|(name, _)| name.as_str());
                let fault = refused(format!("--match: there is no signal `{address}`"));
                let hint = did_you_mean(&address, names.clone());
                let all = || format!("there are {}", names.collect::<Vec<_>>().join(", "));
                wrong.push(fault.hint(hint.unwrap_or_else(all)));
            }
        }
    }
    let mut stated = 0;
    for text in &question.sigmas {
        match sigma(text, &mut found) {
            Ok(()) => stated += 1,
            Err(what) => wrong.push(refused(format!("--sigma `{text}`: {what}"))),
        }
    }
    let mixed = found.windows(2).any(|pair| pair[0].unit != pair[1].unit);
    if wrong.is_empty() && stated < found.len() && (stated > 0 || mixed) {
        let hint = "give the standard deviation of each: --sigma \"x=1 µrad\"";
        wrong.push(refused("the columns cannot be weighed against each other").hint(hint));
    }
    found
}

/// The signals of a run with their SI units.
fn signals_of(model: &Model) -> Vec<(String, &'static str)> {
    let of = |part: &ObjectPart| {
        Quantity::ALL.map(|one| {
            (
                format!("{}.{}", part.id, one.name()),
                one.unit(part.coordinate),
            )
        })
    };
    model.objects.iter().flat_map(of).collect()
}

/// The values of a signal in a record; `None`: the run has none.
fn values_of<'r>(record: &'r Record, address: &str) -> Option<&'r [f64]> {
    let is_meant = |one: &&Column| format!("{}.{}", one.object, one.quantity.name()) == address;
    record
        .columns
        .iter()
        .find(is_meant)
        .map(|one| one.values.as_slice())
}

/// Takes the standard deviation of a column.
fn sigma(text: &str, channels: &mut [Channel]) -> Result<(), String> {
    let (column, value) = text
        .split_once('=')
        .ok_or("no `=`: write COLUMN=VALUE UNIT")?;
    let channel = channels.iter_mut().find(|one| one.column == column.trim());
    let channel = channel.ok_or("no column of this name is matched")?;
    let measure = parse(value.trim()).map_err(|_| "no number with a known unit".to_owned())?;
    let bare = number_and_unit(value).is_some_and(|(_, unit)| unit.is_empty());
    let found = match quantity_of(channel.unit).accept(measure) {
        Ok(value) => value,
        Err(_) if bare => measure.value,
        Err(_) => return Err(format!("the signal is measured in {}", channel.unit)),
    };
    match found > 0.0 && found.is_finite() {
        true => channel.weight = found,
        false => return Err("a standard deviation is greater than 0".to_owned()),
    }
    Ok(())
}

/// One record: how its runs are made.
struct Test {
    settings: Vec<String>,
    grid: Grid,
    remarks: Vec<String>,
}

fn test(
    record: &MeasuredRecord,
    channels: &[Channel],
    question: &IdentifyQuestion,
    prepare: &Prepare<'_>,
    control: &Control<'_>,
) -> Result<(Test, Vec<FittedSignal>), Error> {
    let source = Arc::new(Source {
        name: record.name.clone(),
        text: record.text.clone(),
    });
    let mut sources = Sources::default();
    let id = sources.add(Arc::clone(&source));
    let table = TableFile::new(source, id);
    let read = |channel: &Channel| {
        let found = table.over_time(&channel.column, quantity_of(channel.unit).into());
        found.map_err(|faults| Error::from(Diagnostics::new(sources.clone(), faults)))
    };
    let columns: Vec<Vec<(f64, f64)>> = channels.iter().map(read).collect::<Result<_, _>>()?;
    let mut times: Vec<f64> = columns
        .first()
        .map_or_else(Vec::new, |own| own.iter().map(|row| row.0).collect());
    let wrong = |what: String| Error::question(format!("the record `{}`: {what}", record.name));
    let mut grid = Grid::of(&times).map_err(wrong)?;
    let mut remarks = Vec::new();
    if question.until_first_separation {
        let settings = settings_of(record, &grid);
        let ready = prepare(&settings)?;
        let found = run(&ready.system, &ready.settings, control, &mut []);
        let found = found.map_err(|faults| Error::from(ready.diagnose(&faults)))?;
        let first = found
            .record
            .separations
            .iter()
            .map(|one| one.from)
            .fold(f64::INFINITY, f64::min);
        let left = times.iter().take_while(|time| **time < first).count();
        if left < times.len() {
            remarks.push(format!(
                "of the record `{}` the rows from the first separation on, at {} s, are left out",
                record.name,
                crate::units::shown(first, 6)
            ));
            times.truncate(left);
            grid = Grid::of(&times).map_err(wrong)?;
        }
    }
    if !grid.even {
        remarks.push(format!(
            "the times of the record `{}` are not even: the signals of the runs are interpolated",
            record.name
        ));
    }
    let signal = |(channel, rows): (&Channel, &Vec<(f64, f64)>)| FittedSignal {
        record: record.name.clone(),
        column: channel.column.clone(),
        address: channel.address.clone(),
        unit: channel.unit.to_owned(),
        weight: channel.weight,
        times: times.clone(),
        measured: rows.iter().take(times.len()).map(|row| row.1).collect(),
        residuals: Vec::new(),
        test: None,
    };
    let signals = channels.iter().zip(&columns).map(signal).collect();
    let settings = settings_of(record, &grid);
    Ok((
        Test {
            settings,
            grid,
            remarks,
        },
        signals,
    ))
}

/// The settings of the runs of a record.
fn settings_of(record: &MeasuredRecord, grid: &Grid) -> Vec<String> {
    let own = [
        format!("run.duration={:?}", grid.duration),
        format!("run.samples={}", grid.samples),
    ];
    record.settings.iter().cloned().chain(own).collect()
}

/// Runs at rows of the numbers.
struct Evaluation<'e> {
    axes: &'e [Axis],
    tests: &'e [Test],
    signals: &'e [FittedSignal],
    prepare: &'e Prepare<'e>,
    control: &'e Control<'e>,
    heard: &'e (dyn Fn(usize) + Sync),
    done: AtomicUsize,
    threads: usize,
}

impl Evaluation<'_> {
    /// The residuals of all rows, worked out side by side; `None`: ended from outside.
    fn residuals(&self, rows: &[Vec<f64>]) -> Option<Vec<Option<Vec<f64>>>> {
        let found: Vec<Mutex<Option<Vec<f64>>>> = rows.iter().map(|_| Mutex::default()).collect();
        let take = |(): &mut (), at: usize| {
            let own = self.row(&rows[at]);
            if self.control.is_spent() {
                return false;
            }
            (self.heard)(self.done.fetch_add(1, Ordering::Relaxed) + 1);
            *found[at].lock().unwrap_or_else(PoisonError::into_inner) = own;
            true
        };
        side_by_side(rows.len(), self.threads, || (), take);
        if self.control.is_spent() {
            return None;
        }
        let found = found.into_iter();
        Some(
            found
                .map(|one| one.into_inner().unwrap_or_else(PoisonError::into_inner))
                .collect(),
        )
    }

    /// The residuals of one row; `None`: the scene cannot be run there.
    fn row(&self, values: &[f64]) -> Option<Vec<f64>> {
        let own: Vec<String> = self
            .axes
            .iter()
            .zip(values)
            .map(|(axis, value)| axis.setting(*value))
            .collect();
        let (mut all, mut signals) = (Vec::new(), self.signals.iter());
        let channels = self.signals.len() / self.tests.len();
        for test in self.tests {
            let settings: Vec<String> = test.settings.iter().chain(&own).cloned().collect();
            let mut ready = (self.prepare)(&settings).ok()?;
            ready.settings.switch_rows = false;
            let found: RunResult =
                run(&ready.system, &ready.settings, self.control, &mut []).ok()?;
            if found.outcome.stop != Stop::Complete || !found.is_trusted() {
                return None;
            }
            for signal in signals.by_ref().take(channels) {
                let model = test
                    .grid
                    .at_times(values_of(&found.record, &signal.address)?)?;
                let rows = model.iter().zip(&signal.measured);
                all.extend(rows.map(|(model, measured)| (model - measured) / signal.weight));
            }
        }
        Some(all)
    }
}
