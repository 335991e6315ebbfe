//! The same scene for several values of a parameter, figures side by side.

use super::order::Limits;
use super::run::RunResult;
use crate::dynamics::record::Figures;
use crate::units::shown;
use serde::Serialize;

/// Runs for several values of a parameter.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// Address of the parameter: `rocker.masses`.
    pub over: String,
    /// The runs, in the order of the values; fewer than asked for when one was
    /// interrupted.
    pub runs: Vec<ComparedRun>,
    /// The figures side by side.
    pub table: FigureTable,
}

/// A run of a comparison.
#[derive(Clone, Debug)]
pub struct ComparedRun {
    /// The parameter's value as given: `10`.
    pub label: String,
    /// The run, its record kept for plots.
    pub result: RunResult,
}

/// Figures side by side.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct FigureTable {
    /// Address of the parameter.
    pub over: String,
    /// Labels of the runs, the heads of the columns.
    pub labels: Vec<String>,
    /// True where errors are against the limit of the model as it is refined, wherever a
    /// figure has one; false: against the last run.
    pub against_limit: bool,
    /// Rows, one a figure.
    pub rows: Vec<TableRow>,
}

/// A figure in all runs.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct TableRow {
    /// Address of the figure.
    pub figure: String,
    /// SI unit of its values; empty for counts and answers.
    pub unit: String,
    /// Values in the runs; null where one has none.
    pub values: Vec<Option<f64>>,
    /// (value − reference)/|reference| in every run, the reference being the limit where the
    /// figure has one, else the last run; for displacements and speeds at the end relative
    /// to the greatest |δ| and speed instead. Null where that is not defined.
    pub errors: Vec<Option<f64>>,
    /// Where the figure leads as the model is refined; absent where that is not looked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limit: Option<Limit>,
}

/// Where a figure leads as the model is refined.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Limit {
    /// The limit; null where there is none.
    pub value: Option<f64>,
    /// How far it may be off.
    pub error: Option<f64>,
    /// Observed order in 1/n, where the figure shows one.
    pub order: Option<f64>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why: Option<String>,
}

/// Runs `run` for every label and compares the figures.
///
/// # Errors
/// The first error of `run`.
pub fn compare<E>(
    over: &str,
    labels: &[String],
    mut run: impl FnMut(&str) -> Result<RunResult, E>,
) -> Result<Comparison, E> {
    let mut runs = Vec::with_capacity(labels.len());
    for label in labels {
        let result = run(label)?;
        let interrupted = result.outcome.stop.is_from_outside();
        runs.push(ComparedRun {
            label: label.clone(),
            result,
        });
        if interrupted {
            break;
        }
    }
    let table = FigureTable::of(over, &labelled(&runs));
    Ok(Comparison {
        over: over.to_owned(),
        runs,
        table,
    })
}

/// Share within which a figure is called near enough.
const NEAR: f64 = 0.01;

impl Comparison {
    /// Measures against the limits of the figures, where they have one.
    pub fn measure_against(&mut self, limits: &Limits) {
        self.table.against_limit = true;
        for row in &mut self.table.rows {
            let Some(found) = limits.get(&row.figure) else {
                continue;
            };
            if let Some(limit) = found.value {
                let last = self.runs.last().map(|run| &run.result.figures);
                row.errors = errors_from(limit, &row.figure, &row.values, last);
            }
            row.limit = Some(found.clone());
        }
    }

    /// How many are enough: for the greatest |δ| and the contact force of the object whose
    /// model is varied, a sentence each; `told` is a value, its error and their unit in words.
    pub fn describe_enough_masses(&self, told: impl Fn(f64, f64, &str) -> String) -> Vec<String> {
        let Some((id, _)) = self.over.rsplit_once('.') else {
            return Vec::new();
        };
        let figures = ["delta_abs", "pair.max_contact_force"];
        let rows = figures.iter().filter_map(|name| {
            let address = format!("{id}.{name}");
            self.table.rows.iter().find(|row| row.figure == address)
        });
        // Why a figure has no limit is a warning of its own.
        let warned = |row: &TableRow, limit: &Limit| {
            let why = limit.why.as_deref();
            why.is_some_and(|why| why.starts_with(&row.figure))
        };
        rows.filter_map(|row| Some((row, row.limit.as_ref()?)))
            .filter(|(row, limit)| !warned(row, limit))
            .map(|(row, limit)| self.enough_of(row, limit, &told))
            .collect()
    }

    fn enough_of(
        &self,
        row: &TableRow,
        limit: &Limit,
        told: impl Fn(f64, f64, &str) -> String,
    ) -> String {
        let (Some(value), Some(error)) = (limit.value, limit.error) else {
            let why = limit.why.as_deref().unwrap_or("it does not settle");
            return format!("{}: {why}", row.figure);
        };
        let within = |found: &Option<f64>| {
            let off = (found.unwrap_or(f64::NAN) - value).abs() + error;
            match off == 0.0 {
                true => 0.0,
                false => off / value.abs(),
            }
        };
        let shares: Vec<f64> = row.values.iter().map(within).collect();
        // From a value on: all after it are near enough too.
        let from = shares.iter().rposition(|share| !(*share <= NEAR));
        let from = from.map_or(0, |far| far + 1);
        let name = |at: usize| format!("{} = {}", self.over, self.table.labels[at]);
        let limit = format!("{} leads to {}", row.figure, told(value, error, &row.unit));
        match shares.get(from) {
            Some(share) => format!(
                "{limit}; it is within 1 % from {} on ({} %)",
                name(from),
                shown(100.0 * share, 2)
            ),
            None => match shares.last() {
                Some(share) if share.is_finite() => format!(
                    "{limit}; at {} it is {} % off",
                    name(shares.len() - 1),
                    shown(100.0 * share, 2)
                ),
                _ => limit,
            },
        }
    }
}

impl FigureTable {
    /// The figures of every object, and the number of switches, of runs under their labels.
    pub fn of(over: &str, runs: &[(&str, &Figures)]) -> Self {
        let found: Vec<_> = runs
            .iter()
            .map(|(_, figures)| figures.addresses())
            .collect();
        let last = runs.last().map(|(_, figures)| *figures);
        let mut figures: Vec<&String> = found.iter().flat_map(|values| values.keys()).collect();
        figures.sort();
        figures.dedup();
        let rows = figures
            .into_iter()
            .filter(|figure| is_compared(figure))
            .map(|figure| {
                let values: Vec<Option<f64>> = found
                    .iter()
                    .map(|values| values.get(figure).copied().flatten())
                    .collect();
                let units = runs.iter().map(|(_, figures)| figures.unit(figure));
                TableRow {
                    unit: units.max().unwrap_or_default(),
                    errors: errors(figure, &values, last),
                    figure: figure.clone(),
                    values,
                    limit: None,
                }
            })
            .collect();
        Self {
            over: over.to_owned(),
            labels: runs.iter().map(|(label, _)| (*label).to_owned()).collect(),
            against_limit: false,
            rows,
        }
    }
}

fn is_compared(figure: &str) -> bool {
    let of_run = figure.starts_with("run.");
    figure == "run.switches"
        || figure.starts_with("run.first_times.")
        || !(of_run || figure.contains(".switch_times."))
}

fn labelled(runs: &[ComparedRun]) -> Vec<(&str, &Figures)> {
    let all = runs.iter();
    all.map(|run| (run.label.as_str(), &run.result.figures))
        .collect()
}

fn errors(figure: &str, values: &[Option<f64>], run: Option<&Figures>) -> Vec<Option<f64>> {
    match values.last() {
        Some(&Some(last)) => errors_from(last, figure, values, run),
        _ => vec![None; values.len()],
    }
}

fn errors_from(
    last: f64,
    figure: &str,
    values: &[Option<f64>],
    run: Option<&Figures>,
) -> Vec<Option<f64>> {
    let Some(last_run) = run else {
        return vec![None; values.len()];
    };
    let scale = if figure.contains(".final.") {
        last_run.scale(figure)
    } else {
        last.abs()
    };
    values
        .iter()
        .map(|value| {
            let difference = (*value)? - last;
            // (Of next to nothing a share, or its percentage, may be beyond all numbers.)
            match difference / scale {
                _ if difference == 0.0 => Some(0.0),
                share => (scale > 0.0 && (100.0 * share).is_finite()).then_some(share),
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::compare;
    use crate::dynamics::integrate::Stop;
    use crate::studies::run::RunResult;
    use crate::studies::testing::result_with;

    fn labels(values: &[&str]) -> Vec<String> {
        values.iter().map(|value| (*value).to_owned()).collect()
    }

    #[test]
    fn errors_are_measured_against_the_last_run() {
        let comparison = compare("rocker.masses", &labels(&["1", "2", "10"]), |label| {
            let masses: f64 = label.parse().unwrap();
            Ok::<RunResult, ()>(result_with(|rocker| {
                rocker.delta_max = 2.0 + 1.0 / masses;
                rocker.delta_abs = rocker.delta_max;
                rocker.end.displacement = 1.0 / masses;
            }))
        })
        .unwrap();
        assert_eq!(comparison.table.labels, ["1", "2", "10"]);
        let row = |figure: &str| {
            let mut rows = comparison.table.rows.iter();
            rows.find(|row| row.figure == figure).unwrap()
        };
        let errors = &row("rocker.delta_max").errors;
        approx::assert_relative_eq!(errors[0].unwrap(), 0.9 / 2.1, max_relative = 1e-15);
        assert_eq!(errors[2], Some(0.0));
        assert_eq!(row("rocker.delta_max").unit, "rad");
        assert_eq!(row("rocker.peak_speed").unit, "rad/s");
        // The end displacement is measured against the greatest |δ|, not against itself.
        let errors = &row("rocker.final.displacement").errors;
        approx::assert_relative_eq!(errors[1].unwrap(), 0.4 / 2.1, max_relative = 1e-15);
        let mut rows = comparison.table.rows.iter();
        assert!(rows.all(|row| !row.figure.starts_with("run.") || row.figure == "run.switches"));
    }

    #[test]
    fn a_share_beyond_all_numbers_is_none() {
        let comparison = compare("x", &labels(&["1", "1e-300", "1e-307"]), |label| {
            let size: f64 = label.parse().unwrap();
            Ok::<RunResult, ()>(result_with(|rocker| rocker.delta_max = size))
        })
        .unwrap();
        let mut rows = comparison.table.rows.iter();
        let row = rows.find(|row| row.figure == "rocker.delta_max").unwrap();
        assert_eq!((row.errors[0], row.errors[2]), (None, Some(0.0)));
        assert!(row.errors[1].is_some_and(|share| share > 9.9e6));
    }

    #[test]
    fn an_interrupted_run_is_the_last() {
        let comparison = compare("rocker.masses", &labels(&["1", "2"]), |_| {
            let mut result = result_with(|_| {});
            result.outcome.stop = Stop::Interrupted;
            Ok::<RunResult, ()>(result)
        });
        assert_eq!(comparison.unwrap().runs.len(), 1);
        assert_eq!(
            compare("x", &labels(&["1"]), |_| Err("no")).unwrap_err(),
            "no"
        );
        let nothing = compare("x", &[], |_| Err("never asked")).unwrap();
        assert!(nothing.table.rows.is_empty());
    }
}
