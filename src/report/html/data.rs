//! The data of a page's plots, as compact JSON for its script.

use crate::record::{Column, Quantity, Record};
use crate::report::quantity::escape;
use serde::Serialize;

/// One run's samples under a label.
#[derive(Clone, Debug)]
pub struct RunSeries<'a> {
    /// What tells the run from the others: `masses = 2`.
    pub label: String,
    /// Its samples.
    pub record: &'a Record,
}

/// Plots of a page: one group an object, one panel a quantity, one curve a run.
#[derive(Clone, Debug, Serialize)]
pub struct PlotData {
    runs: Vec<String>,
    times: Vec<Vec<f64>>,
    groups: Vec<Group>,
}

#[derive(Clone, Debug, Serialize)]
struct Group {
    index: usize,
    id: String,
    shades: Vec<Shade>,
    panels: Vec<Panel>,
    #[serde(skip)]
    silent: Vec<String>,
}

#[derive(Clone, Debug, Serialize)]
struct Panel {
    quantity: String,
    name: String,
    unit: &'static str,
    series: Vec<Series>,
}

#[derive(Clone, Debug, Serialize)]
struct Series {
    run: usize,
    /// `null` where a value is not a finite number: a gap in the curve.
    values: Vec<Option<f64>>,
}

#[derive(Clone, Debug, Serialize)]
struct Shade {
    run: usize,
    intervals: Vec<[f64; 2]>,
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

impl PlotData {
    /// Gathers the plots of several runs. Every object of any run gets a group;
    /// quantities that are zero throughout every run get no plot and are named
    /// in words instead.
    pub fn new(runs: &[RunSeries<'_>]) -> Self {
        let mut ids: Vec<&str> = Vec::new();
        for column in runs.iter().flat_map(|run| &run.record.columns) {
            if !ids.contains(&column.object.as_str()) {
                ids.push(&column.object);
            }
        }
        let groups = ids
            .iter()
            .enumerate()
            .map(|(index, id)| group(index, id, runs))
            .collect();
        let times = |run: &RunSeries<'_>| {
            let times = run.record.times.iter();
            times.map(|&time| rounded(time, 12)).collect()
        };
        Self {
            runs: runs.iter().map(|run| run.label.clone()).collect(),
            times: runs.iter().map(times).collect(),
            groups,
        }
    }

    /// The place of an object's group among all; `None` when no run has samples of it.
    pub(in crate::report) fn place(&self, id: &str) -> Option<usize> {
        self.groups.iter().position(|group| group.id == id)
    }

    /// The section of an object: heading, tool bar, place of the plots. Empty
    /// when no run has samples of it.
    pub fn section(&self, id: &str, kind: &str) -> String {
        let Some(group) = self.groups.iter().find(|group| group.id == id) else {
            return String::new();
        };
        let shaded = group.shades.iter().any(|shade| !shade.intervals.is_empty());
        let single = self.runs.len() > 1 || group.panels.len() == 1;
        format!(
            "<section class=\"object\" id=\"object-{id}\" data-group=\"{index}\">\n\
             <h2>{id}<span class=\"kind\">{kind}</span></h2>\n\
             <div class=\"bar\">{keys}{shading}</div>\n\
             <div class=\"plots{single}\" style=\"--rows:{rows}\"></div>\n{silent}</section>\n",
            id = escape(id),
            index = group.index,
            kind = escape(kind),
            keys = self.keys(),
            shading = match (shaded, self.runs.len()) {
                (false, _) => "",
                (true, 1) => {
                    "<span class=\"key\"><span class=\"swatch\"></span>pair open</span>"
                }
                (true, _) => "<span>strips at the foot: pair open</span>",
            },
            single = if single { " single" } else { "" },
            rows = group.panels.len().div_ceil(2).max(1),
            silent = silent_note(&group.silent),
        )
    }

    /// Legend of the runs; empty for a single one.
    fn keys(&self) -> String {
        if self.runs.len() < 2 {
            return String::new();
        }
        let dashes = [
            "",
            "7 3",
            "2 2.5",
            "9 3 2 3",
            "4 2",
            "12 4",
            "1.5 3.5",
            "6 2 1 2 1 2",
        ];
        let key = |(index, label): (usize, &String)| {
            format!(
                "<span class=\"key\"><svg width=\"30\" height=\"10\" aria-hidden=\"true\">\
                 <path d=\"M0 5h30\" style=\"stroke:var(--series-{color});stroke-width:2\" \
                 stroke-dasharray=\"{dash}\"/></svg>{}</span>",
                escape(label),
                color = index % 8,
                dash = dashes[index % 8],
            )
        };
        self.runs.iter().enumerate().map(key).collect()
    }

    /// The data as JSON that cannot end the element it stands in.
    pub fn json(&self) -> String {
        // Plain numbers, strings and lists: writing them cannot fail.
        let text = serde_json::to_string(self).unwrap_or_else(|_| "null".into());
        text.replace('<', "\\u003c")
    }
}

fn group(index: usize, id: &str, runs: &[RunSeries<'_>]) -> Group {
    let mut panels = Vec::new();
    let mut silent = Vec::new();
    for (quantity, name) in shown(id, runs) {
        let columns: Vec<(usize, &Column)> = runs
            .iter()
            .enumerate()
            .filter_map(|(run, one)| Some((run, one.record.column(id, quantity)?)))
            .collect();
        let Some((_, first)) = columns.first() else {
            continue;
        };
        if columns
            .iter()
            .all(|(_, c)| c.values.iter().all(|&v| v == 0.0))
        {
            silent.push(name);
            continue;
        }
        panels.push(Panel {
            quantity: quantity.to_string(),
            name,
            unit: first.unit,
            series: columns
                .iter()
                .map(|&(run, column)| series(run, column))
                .collect(),
        });
    }
    let shades = runs.iter().enumerate().map(|(run, one)| Shade {
        run,
        intervals: one
            .record
            .separations
            .iter()
            .filter(|interval| interval.object == id)
            .map(|interval| [rounded(interval.from, 12), rounded(interval.to, 12)])
            .collect(),
    });
    Group {
        index,
        id: id.to_owned(),
        shades: shades.collect(),
        panels,
        silent,
    }
}

/// The quantities of an object with their names on the plots: the six of every object,
/// then those of masses and links that any run has recorded.
fn shown(id: &str, runs: &[RunSeries<'_>]) -> Vec<(Quantity, String)> {
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

fn series(run: usize, column: &Column) -> Series {
    let value = |&v: &f64| v.is_finite().then(|| rounded(v, 9));
    Series {
        run,
        values: column.values.iter().map(value).collect(),
    }
}

/// A number with that many significant digits: what a plot can show, in a
/// third of the bytes.
fn rounded(value: f64, digits: usize) -> f64 {
    format!("{:.*e}", digits - 1, value)
        .parse()
        .unwrap_or(value)
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
