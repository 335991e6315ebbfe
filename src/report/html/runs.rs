//! The plots of runs: one group an object, one chart a quantity, one curve a run.

use super::player::Coordinates;
use crate::dynamics::record::{Column, Quantity, Record};
use crate::report::abscissa::Abscissa;
use crate::report::plot::{Axis, Band, MotionPhase, Plot, Plots, Series};
use crate::report::quantity::{escape, with_unit};

/// Samples of a run under a label.
#[derive(Clone, Debug)]
pub struct RunSeries<'a> {
    /// Label that tells the run from the others: `masses = 2`.
    pub label: String,
    /// Samples of the run.
    pub record: &'a Record,
    /// What they are drawn over.
    pub over: &'a Abscissa,
}

/// Quantities in the order they are shown, with their names on the plots.
pub const QUANTITIES: [(Quantity, &str); 6] = [
    (Quantity::Displacement, "Displacement φ"),
    (Quantity::Speed, "Speed φ\u{307}"),
    (Quantity::Acceleration, "Acceleration φ\u{308}"),
    (Quantity::Delta, "Positioning error δ"),
    (Quantity::Reaction, "Reaction F"),
    (Quantity::ContactForce, "Contact force N"),
];

/// Size of a chart of one run and of several (pixels).
const ONE: [f64; 2] = [579.0, 204.0];
const SEVERAL: [f64; 2] = [1184.0, 290.0];

/// The curves of one quantity of one object over each other; `None` when no run has it.
/// Where a pair is open is shaded for a single run, shown by strips at the foot for several.
pub fn chart(
    runs: &[RunSeries<'_>],
    object: &str,
    quantity: Quantity,
    title: &str,
) -> Option<Plot> {
    let columns = columns(runs, object, quantity);
    let unit = columns.first()?.1.unit;
    let series = columns.iter().map(|&(run, column)| {
        let RunSeries {
            label,
            record,
            over,
        } = &runs[run];
        Series {
            style: Some(run),
            ..Series::line(label, over.curve(record, &column.values))
        }
    });
    let bands = runs.iter().enumerate().map(|(run, one)| {
        let band = Band {
            label: String::new(),
            spans: open_intervals(one.record, object, most_spans(runs)).spans,
            series: (runs.len() > 1).then_some(run),
        };
        one.over.band(one.record, band)
    });
    let mut bands: Vec<Band> = bands.collect();
    if bands.iter().all(|band| band.spans.is_empty()) {
        bands.clear();
    }
    Some(Plot {
        id: format!("{object}.{quantity}"),
        title: title.to_owned(),
        x: runs.first()?.over.axis(),
        y: Axis::of(unit),
        series: series.collect(),
        bands,
        phases: phases(runs.first()?, object),
        ..Plot::default()
    })
}

/// Rise, dwell and return of an object's law over the angle of the machine; none over time.
fn phases(run: &RunSeries<'_>, object: &str) -> Vec<MotionPhase> {
    let column = |quantity| run.record.column(object, quantity);
    let Some(displacement) = column(Quantity::Displacement) else {
        return Vec::new();
    };
    let Some(one_turn) = run.over.one_turn() else {
        return Vec::new();
    };
    let law: Vec<f64> = match column(Quantity::Delta) {
        Some(delta) => {
            let both = displacement.values.iter().zip(&delta.values);
            both.map(|(displacement, delta)| displacement - delta)
                .collect()
        }
        None => displacement.values.clone(),
    };
    let mut points = one_turn.curve(run.record, &law);
    points.retain(|(at, value)| at.is_finite() && value.is_finite());
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    // What goes on from turn to turn, as a shaft does, jumps where turns meet: it neither rises nor
    // returns.
    let values = points.iter().map(|(_, value)| *value);
    let [least, most] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
        [low.min(value), high.max(value)]
    });
    let mut steps = points.windows(2).filter(|pair| pair[1].0 > pair[0].0);
    let first = steps.next();
    let jumps = first.is_some_and(|pair| (pair[1].1 - pair[0].1).abs() > 0.5 * (most - least));
    match jumps {
        true => Vec::new(),
        false => MotionPhase::of(&points),
    }
}

fn columns<'a>(
    runs: &'a [RunSeries<'_>],
    object: &str,
    quantity: Quantity,
) -> Vec<(usize, &'a Column)> {
    let of =
        |(run, one): (usize, &'a RunSeries<'_>)| Some((run, one.record.column(object, quantity)?));
    runs.iter().enumerate().filter_map(of).collect()
}

/// Most intervals that all charts of a page shade, of each object in six charts.
const MOST_SPANS: usize = 30_000;
const CHARTS: usize = QUANTITIES.len();

/// Most intervals that a chart shades for a run.
fn most_spans(runs: &[RunSeries<'_>]) -> usize {
    let objects = |run: &RunSeries<'_>| {
        let mut ids: Vec<&str> = Vec::new();
        for one in &run.record.separations {
            // (Those of one object often follow each other.)
            if ids.last() != Some(&one.object.as_str()) && !ids.contains(&one.object.as_str()) {
                ids.push(&one.object);
            }
        }
        ids.len()
    };
    let all: usize = runs.iter().map(objects).sum();
    MOST_SPANS / (CHARTS * all.max(1))
}

/// When the pair of an object is open.
#[derive(Debug, Default)]
struct Open {
    /// From when until when (s): the first intervals.
    spans: Vec<[f64; 2]>,
    /// Number of all intervals.
    all: usize,
}

/// The first intervals, at most so many, in which the pair of an object is open.
fn open_intervals(record: &Record, object: &str, most: usize) -> Open {
    let mut open = Open::default();
    for one in record.separations.iter().filter(|one| one.object == object) {
        open.all += 1;
        if open.spans.len() < most {
            open.spans.push([one.from, one.to]);
        }
    }
    open
}

/// Which separations of an object are not shaded, where there are very many; else nothing.
fn unshaded(runs: &[RunSeries<'_>], object: &str) -> String {
    let most = most_spans(runs);
    let note = |run: &RunSeries<'_>| {
        let open = open_intervals(run.record, object, most);
        let until = open.spans.last().filter(|_| open.all > open.spans.len())?[1];
        let label = match run.label.as_str() {
            "" => String::new(),
            label => format!("{label}: "),
        };
        Some(format!(
            "{label}the first {} of {} separations are shaded, up to {}",
            open.spans.len(),
            open.all,
            with_unit(until, "s", 6)
        ))
    };
    let notes: Vec<String> = runs.iter().filter_map(note).collect();
    notes.join("; ")
}

/// Tables of an object for the player: its displacement and its deviation from the law.
pub(in crate::report) fn player_tables(
    plots: &mut Plots,
    record: &Record,
    object: &str,
) -> Option<Coordinates> {
    let displacement = record.column(object, Quantity::Displacement)?;
    let deviation = record.column(object, Quantity::Delta);
    let deviation = deviation.filter(|column| column.values.iter().any(|&v| v != 0.0));
    Some(Coordinates::Plotted {
        values: plots.column(&displacement.values, 9),
        deviation: deviation.map(|column| plots.column(&column.values, 9)),
    })
}

/// The charts of an object, with the quantities that are zero throughout every run.
#[derive(Debug)]
pub(in crate::report) struct ObjectCharts {
    /// Id of the object.
    id: String,
    /// Kind and model in words.
    kind: String,
    pub(in crate::report) charts: Vec<Plot>,
    silent: Vec<String>,
    /// Separations that are not shaded, in words.
    unshaded: String,
    runs: usize,
}

impl ObjectCharts {
    /// The charts of an object; `None` when no run has samples of it.
    pub(in crate::report) fn of(runs: &[RunSeries<'_>], id: &str, kind: &str) -> Option<Self> {
        let mut silent = Vec::new();
        let mut charts = Vec::new();
        for (quantity, name) in plotted_quantities(id, runs) {
            let own = columns(runs, id, quantity);
            if own.is_empty() {
                continue;
            }
            let zero = |(_, column): &(usize, &Column)| column.values.iter().all(|&v| v == 0.0);
            match own.iter().all(zero) {
                true => silent.push(name),
                false => charts.extend(chart(runs, id, quantity, &name)),
            }
        }
        if charts.is_empty() && silent.is_empty() {
            return None;
        }
        Some(Self {
            id: id.to_owned(),
            kind: kind.to_owned(),
            charts,
            silent,
            unshaded: unshaded(runs, id),
            runs: runs.len(),
        })
    }

    fn is_single(&self) -> bool {
        self.runs > 1 || self.charts.len() == 1
    }

    /// Size of each chart as long as nothing scales it.
    pub(in crate::report) fn chart_size(&self) -> [f64; 2] {
        if self.is_single() { SEVERAL } else { ONE }
    }

    /// Charts of one link are zoomed together.
    pub(in crate::report) fn link(&self) -> String {
        format!("object {}", self.id)
    }

    /// What the section shows besides numbers: two that are alike here differ in numbers alone.
    #[cfg(feature = "live")]
    pub(in crate::report) fn text_without_numbers(&self) -> String {
        let chart = |plot: &Plot| {
            let series = plot
                .series
                .iter()
                .map(|one| (&one.label, one.look, one.style));
            let series: Vec<_> = series.collect();
            let bands = plot.bands.iter().map(|band| (&band.label, band.series));
            let bands: Vec<_> = bands.collect();
            format!(
                "{}{}{:?}{series:?}{bands:?}",
                plot.id, plot.title, plot.y.name
            )
        };
        let charts: String = self.charts.iter().map(chart).collect();
        format!("{}{}{:?}{charts}", self.id, self.kind, self.silent)
    }

    /// The section: heading, tool bar, plots; quantities that are zero are named in words.
    pub(in crate::report) fn html(&self, plots: &mut Plots) -> String {
        let shaded = self.charts.iter().any(|chart| !chart.bands.is_empty());
        let figures: String = (self.charts.iter())
            .map(|chart| plots.figure(chart, self.chart_size(), &self.link()))
            .collect();
        // The studio lets no style stand in its page, and has rows of its own.
        let rows = match plots.is_live() {
            true => String::new(),
            false => format!(" style=\"--rows:{}\"", self.charts.len().div_ceil(2).max(1)),
        };
        format!(
            "<section class=\"object\" id=\"object-{id}\">\n\
             <h2>{id}<span class=\"kind\">{kind}</span></h2>\n\
             <div class=\"bar\" data-zoom=\"object {id}\">{shading}</div>\n\
             <div class=\"plots{single}\"{rows}>\n{figures}</div>\n{unshaded}{silent}</section>\n",
            id = escape(&self.id),
            kind = escape(&self.kind),
            shading = match (shaded, self.runs) {
                (false, _) => "",
                (true, 1) =>
                    "<span class=\"key\"><span class=\"swatch\"></span>contact \
                              separated</span>",
                (true, _) => "<span>strips at the foot: contact separated</span>",
            },
            unshaded = match self.unshaded.as_str() {
                "" => String::new(),
                words => format!(
                    "<p class=\"soft\">Contact separated: {}.</p>\n",
                    escape(words)
                ),
            },
            single = if self.is_single() { " single" } else { "" },
            rows = rows,
            silent = silent_note(&self.silent),
        )
    }
}

/// The section of an object: heading, tool bar, plots. Empty when no run has samples of it.
pub fn section(plots: &mut Plots, runs: &[RunSeries<'_>], id: &str, kind: &str) -> String {
    ObjectCharts::of(runs, id, kind).map_or(String::new(), |shown| shown.html(plots))
}

/// How far a quantity of an object differs in every other run from the last one, where both have a
/// sample over the same place; `None`: nowhere, or it is the same in all.
pub fn difference(
    runs: &[RunSeries<'_>],
    object: &str,
    quantity: Quantity,
    title: &str,
) -> Option<Plot> {
    let (base, others) = runs.split_last()?;
    let unit = base.record.column(object, quantity)?.unit;
    let series = others.iter().enumerate().filter_map(|(run, one)| {
        let curve = difference_of_runs(one, base, object, quantity)?;
        Some(Series {
            style: Some(run),
            ..Series::line(&one.label, curve)
        })
    });
    let series: Vec<Series> = series.collect();
    (!series.is_empty()).then(|| Plot {
        id: format!("{object}.{quantity}.difference"),
        title: title.to_owned(),
        x: base.over.axis(),
        y: Axis::of(unit),
        series,
        ..Plot::default()
    })
}

/// Share of a value, or of the greatest one of a quantity, below which a difference is rounding.
const ROUNDING: f64 = 1e-12;
/// Angles of the machine that are one place (rad).
const SAME_ANGLE: f64 = 1e-9;

/// A quantity of a run less that of another over places that both have; `None`: there are less
/// than two, or they do not differ.
fn difference_of_runs(
    run: &RunSeries<'_>,
    base: &RunSeries<'_>,
    object: &str,
    quantity: Quantity,
) -> Option<Vec<(f64, f64)>> {
    let columns = [run, base].map(|one| one.record.column(object, quantity));
    let [own, other] = [columns[0]?, columns[1]?];
    let angles = [run, base].map(|one| one.over.angles(one.record));
    let same_place = |&(i, j): &(usize, usize)| match angles {
        [Some(own), Some(other)] => (own[i] - other[j]).abs() <= SAME_ANGLE,
        _ => true,
    };
    let rows = shared_rows(&run.record.times, &base.record.times);
    let rows: Vec<(usize, usize)> = rows.into_iter().filter(same_place).collect();
    let differences = rows.iter().map(|&(i, j)| own.values[i] - other.values[j]);
    let differences: Vec<f64> = differences.collect();
    let greatest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
    let size = greatest(&mut other.values.iter().map(|value| value.abs()));
    let most = greatest(&mut differences.iter().map(|value| value.abs()));
    (rows.len() > 1 && most > ROUNDING * size).then(|| {
        // Only what places the samples is asked of the record.
        let columns = run.record.columns.iter();
        let columns = columns.filter(|column| column.quantity == Quantity::Displacement);
        let columns = columns.map(|column| Column {
            values: rows.iter().map(|&(i, _)| column.values[i]).collect(),
            ..column.clone()
        });
        let shared = Record {
            times: rows.iter().map(|&(i, _)| run.record.times[i]).collect(),
            columns: columns.collect(),
            ..Record::default()
        };
        run.over.curve(&shared, &differences)
    })
}

/// Rows of the same instant in two records. An instant with two rows is left out: there a value may
/// jump, in one of both alone.
fn shared_rows(own: &[f64], other: &[f64]) -> Vec<(usize, usize)> {
    let same = |a: f64, b: f64| (a - b).abs() <= ROUNDING * a.abs().max(b.abs());
    let single = |times: &[f64], at: usize| {
        let near = [at.checked_sub(1), Some(at + 1)].into_iter().flatten();
        let mut near = near.filter_map(|row| times.get(row));
        near.all(|&time| !same(time, times[at]))
    };
    let (mut rows, mut i, mut j) = (Vec::new(), 0, 0);
    while i < own.len() && j < other.len() {
        match (same(own[i], other[j]), own[i] < other[j]) {
            (true, _) => {
                if single(own, i) && single(other, j) {
                    rows.push((i, j));
                }
                (i, j) = (i + 1, j + 1);
            }
            (false, true) => i += 1,
            (false, false) => j += 1,
        }
    }
    rows
}

/// The charts of the differences of an object, two beside each other under a heading; empty where
/// no quantity differs.
pub fn differences(plots: &mut Plots, runs: &[RunSeries<'_>], id: &str) -> String {
    let Some(base) = runs.last() else {
        return String::new();
    };
    let charts = plotted_quantities(id, runs);
    let charts = charts
        .into_iter()
        .filter_map(|(quantity, name)| difference(runs, id, quantity, &format!("Δ {name}")));
    let charts: Vec<Plot> = charts.collect();
    if charts.is_empty() {
        return String::new();
    }
    let figures: String = (charts.iter())
        .map(|chart| plots.figure(chart, ONE, &format!("object {id}")))
        .collect();
    format!(
        "<h3>Differences of {} from the run with {}</h3>\n\
         <div class=\"plots\" style=\"--rows:{}\">\n{figures}</div>\n",
        escape(id),
        escape(&base.label),
        charts.len().div_ceil(2)
    )
}

/// The quantities of an object with their names on the plots: the six of every object,
/// then its contact pressure and those of masses and links that any run has recorded.
fn plotted_quantities(id: &str, runs: &[RunSeries<'_>]) -> Vec<(Quantity, String)> {
    let plain = order(runs.len()).into_iter();
    let mut all: Vec<(Quantity, String)> = plain
        .map(|(quantity, name)| (quantity, name.to_owned()))
        .collect();
    let columns = runs.iter().flat_map(|run| &run.record.columns);
    for column in columns.filter(|column| column.object == id) {
        if !all.iter().any(|(quantity, _)| *quantity == column.quantity) {
            all.push((column.quantity, inner_name(column.quantity)));
        }
    }
    all
}

/// The name of a mass's or a link's quantity on a plot.
fn inner_name(quantity: Quantity) -> String {
    match quantity {
        Quantity::MassDisplacement(mass) => format!("Mass {mass}: displacement φ"),
        Quantity::MassSpeed(mass) => format!("Mass {mass}: speed φ\u{307}"),
        Quantity::ContactPressure => "Contact pressure p".to_owned(),
        Quantity::LinkForce(link) => format!("Link {link}: force F"),
        other => other.to_string(),
    }
}

/// The quantities as they stand on the page: where runs are compared, what
/// they are compared for comes first.
fn order(runs: usize) -> Vec<(Quantity, &'static str)> {
    let mut list = QUANTITIES.to_vec();
    if runs > 1 {
        list.sort_by_cached_key(|(quantity, _)| usize::from(*quantity != Quantity::Delta));
    }
    list
}

fn silent_note(silent: &[String]) -> String {
    if silent.is_empty() {
        return String::new();
    }
    format!(
        "<p class=\"soft\">Zero throughout: {}.</p>\n",
        silent.join(", ")
    )
}
