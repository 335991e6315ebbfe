//! The same scene for several values of a parameter, figures side by side.

use super::run::RunResult;
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
    pub table: Table,
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
pub struct Table {
    /// Address of the parameter.
    pub over: String,
    /// Labels of the runs, the heads of the columns.
    pub labels: Vec<String>,
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
    /// (value − last)/|last| in every run; for displacements and speeds at the
    /// end relative to the greatest |δ| and speed instead. Null where that is
    /// not defined.
    pub errors: Vec<Option<f64>>,
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
    let table = Table::of(over, &runs);
    Ok(Comparison {
        over: over.to_owned(),
        runs,
        table,
    })
}

impl Table {
    /// The figures of every object, and the number of switches.
    fn of(over: &str, runs: &[ComparedRun]) -> Self {
        let found: Vec<_> = runs
            .iter()
            .map(|run| run.result.figures.addresses())
            .collect();
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
                let units = runs.iter().map(|run| run.result.figures.unit(figure));
                TableRow {
                    unit: units.max().unwrap_or_default(),
                    errors: errors(figure, &values, runs),
                    figure: figure.clone(),
                    values,
                }
            })
            .collect();
        Self {
            over: over.to_owned(),
            labels: runs.iter().map(|run| run.label.clone()).collect(),
            rows,
        }
    }
}

fn is_compared(figure: &str) -> bool {
    let of_run = figure.starts_with("run.");
    figure == "run.switches" || !(of_run || figure.contains(".switch_times."))
}

fn errors(figure: &str, values: &[Option<f64>], runs: &[ComparedRun]) -> Vec<Option<f64>> {
    let Some((&Some(last), last_run)) = values.last().zip(runs.last()) else {
        return vec![None; values.len()];
    };
    let scale = if figure.contains(".final.") {
        last_run.result.figures.scale(figure)
    } else {
        last.abs()
    };
    values
        .iter()
        .map(|value| {
            let difference = (*value)? - last;
            if difference == 0.0 {
                Some(0.0)
            } else {
                (scale > 0.0).then_some(difference / scale)
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
