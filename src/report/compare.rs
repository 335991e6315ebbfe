//! Several runs of one scene over each other: figures side by side, curves in one frame.

use crate::dynamics::record::Figures;
use crate::dynamics::record::Quantity;
use crate::report::abscissa::Abscissa;
use crate::report::addresses::{RESULTS, in_words, parameter_words, result_words};
use crate::report::diagram::Diagram;
use crate::report::findings::table::check_outcome;
use crate::report::findings::{Cell, Findings, Item, Section, Source, Table, Value};
use crate::report::html::mechanism;
use crate::report::html::runs::{self, QUANTITIES, RunSeries};
use crate::report::plot::Plot;
use crate::report::quantity::{readable_scale, significant, units};
use crate::report::sentence::Sentence;
use crate::report::verdict::{Sort, Verdict, capitalised};
use crate::studies::compare::{ComparedRun, Comparison, FigureTable, TableRow};
use crate::studies::judgement::{Judgement, checks};
use serde_json::{Value as Json, json};

/// The document of a comparison: each run with its verdict and checks.
pub fn document(scene: &str, comparison: &Comparison) -> Json {
    let runs = comparison.runs.iter();
    let runs = runs.map(|run| {
        let figures = &run.result.figures;
        let (verdict, checks) = (Judgement::of(figures), checks(figures));
        json!({ "value": run.label, "verdict": verdict, "checks": checks, "figures": figures })
    });
    json!({
        "dam": 1, "scene": scene, "over": comparison.over, "table": comparison.table,
        "runs": runs.collect::<Vec<_>>()
    })
}

/// The runs side by side: how many are enough, verdicts, curves, figures with their errors.
pub fn findings<'a>(
    scene: &str,
    (comparison, over): (&'a Comparison, &'a Abscissa),
    diagram: &'a Diagram,
    warnings: Vec<String>,
    mut source: Source<'a>,
) -> Findings<'a> {
    let all = &comparison.runs;
    let last = all
        .last()
        .map_or(String::new(), |run| label(comparison, run));
    let against = match comparison.table.against_limit {
        true => format!("the converged value of finer models, where there is one, else {last}"),
        false => last,
    };
    // Another machine is no error of this one.
    let shares = match is_refinement(&comparison.over) {
        true => "errors against",
        false => "percentages are differences from",
    };
    let of = |run: &ComparedRun| {
        let (figures, run_of) = (&run.result.figures, &run.result.figures.run);
        let text = format!(
            "{}; SHA-256 of the canonical scene {}; tolerance {}",
            run_of.method,
            figures.hash,
            significant(run_of.tolerance, 3)
        );
        (label(comparison, run), text)
    };
    source.more.extend(all.iter().map(of));
    let converged = |value: f64, error: f64, unit: &str| {
        let shown = readable_scale(value, unit);
        let [value, error] = [(value, 6), (error, 2)]
            .map(|(number, digits)| significant(number / shown.factor, digits));
        format!("{value} ± {error} {}", shown.unit)
    };
    let enough = comparison.describe_enough_masses(converged).into_iter();
    let over_words = parameter_words(&comparison.over);
    let named = |text: String| in_words(&text.replace(&comparison.over, &over_words));
    let enough = enough.map(|text| Item::Words(named(text))).collect();
    // Each begins with the run that it is of.
    let run = format!("{} = ", comparison.over);
    let of_a_run = |text: String| match text.strip_prefix(&run) {
        Some(rest) => format!("{over_words} = {rest}"),
        None => text,
    };
    let mut sections = vec![
        Section {
            heading: String::new(),
            items: enough,
        },
        Section::new("Runs").table(verdicts_table(comparison)),
        Section::default().drawing(|plots| mechanism(diagram, plots)),
    ];
    // Drives move alike in every run as a rule: they come last.
    let mut boxes: Vec<_> = diagram.boxes.iter().collect();
    boxes.sort_by_cached_key(|one| usize::from(one.is_drive()));
    for one in &boxes {
        let (id, kind) = (one.id.clone(), one.kind.replace('_', " "));
        sections.push(
            Section::default()
                .drawing(move |plots| runs::section(plots, &series(comparison, over), &id, &kind)),
        );
        let id = one.id.clone();
        sections.push(
            Section::default()
                .drawing(move |plots| runs::differences(plots, &series(comparison, over), &id)),
        );
        sections.push(figures_section(&comparison.table, &one.id));
    }
    sections.push(figures_section(&comparison.table, "run"));
    for study in ["frequency", "steady", "cam", "kinematics", "forces"] {
        let known = boxes.iter().any(|one| one.id == study);
        sections.extend((!known).then(|| figures_section(&comparison.table, study)));
    }
    sections.retain(|section| !section.is_empty());
    Findings {
        title: scene.to_owned(),
        subtitle: format!("{} runs compared; {shares} {against}", all.len()),
        answer: Some(answer(all)),
        warnings: warnings.into_iter().map(of_a_run).collect(),
        sections,
        source,
    }
}

/// Whether a parameter refines the model or its computation: the finest is the nearest to the
/// truth.
fn is_refinement(over: &str) -> bool {
    let name = over.rsplit('.').next().unwrap_or_default();
    matches!(name, "masses" | "modes" | "tolerance" | "step")
}

fn label(comparison: &Comparison, run: &ComparedRun) -> String {
    format!("{} = {}", parameter_words(&comparison.over), run.label)
}

/// How far the greatest deviation depends on what is compared, and whether a run is in doubt.
fn answer(runs: &[ComparedRun]) -> Verdict {
    let judged: Vec<Judgement> = (runs.iter())
        .map(|run| Judgement::of(&run.result.figures))
        .collect();
    let deviation = |run: &ComparedRun| {
        let all = run.result.figures.objects.iter();
        let greatest = all.max_by(|a, b| a.1.delta_abs.total_cmp(&b.1.delta_abs))?;
        let unit = units(&run.result.figures, greatest.0).displacement;
        Some((greatest.0.clone(), greatest.1.delta_abs, unit))
    };
    let found: Vec<_> = runs.iter().filter_map(deviation).collect();
    let least = found.iter().min_by(|a, b| a.1.total_cmp(&b.1));
    let most = found.iter().max_by(|a, b| a.1.total_cmp(&b.1));
    let headline = match least.zip(most) {
        Some(((id, least, unit), (_, most, _))) if *most > 0.0 => {
            Sentence::from(format!("Greatest |δ|, of {id}: "))
                .quantity(*least, unit, 4)
                .words(" to ")
                .quantity(*most, unit, 4)
                .words(".")
        }
        _ => Sentence::from("No object deviates from its law."),
    };
    // The worst speaks for all.
    let worst = [
        Judgement::NotToBeTrusted,
        Judgement::NotInWorkingOrder,
        Judgement::NotJudged,
        Judgement::InWorkingOrder,
    ];
    let count = |one: &Judgement| judged.iter().filter(|found| *found == one).count();
    let all = runs.len();
    let said = worst.iter().filter(|one| count(one) > 0);
    let said = said.map(|one| match (count(one), one.words().to_lowercase()) {
        (count, words) if count == all && all > 1 => match words.strip_prefix("not ") {
            Some(missed) => format!("none of the {all} runs is {missed}"),
            None => format!("all {all} runs are {words}"),
        },
        (count, words) => {
            let is = if count == 1 { "is" } else { "are" };
            format!("{count} of {all} runs {is} {words}")
        }
    });
    let text = said.collect::<Vec<_>>().join("; ");
    let text = format!("{}.", capitalised(&text));
    let first = worst.into_iter().find(|one| count(one) > 0);
    let sort = first.map_or(Sort::Unfinished, Sort::from);
    Verdict::answer(sort, headline, text)
}

/// The first check that a run failed, or that it passed them all.
fn checked(figures: &Figures) -> Cell {
    let checks = checks(figures);
    match checks.iter().find(|check| !check.passed()) {
        Some(failed) => Cell {
            good: Some(false),
            ..format!("{}: {}", failed.name, check_outcome(failed)).into()
        },
        None => format!("{} within their bounds", checks.len()).into(),
    }
}

/// One row a run: verdict, method, effort.
fn verdicts_table(comparison: &Comparison) -> Table {
    let row = |run: &ComparedRun| {
        let judgement = Judgement::of(&run.result.figures);
        let summary = &run.result.figures.run;
        vec![
            label(comparison, run).into(),
            Cell {
                good: Some(judgement == Judgement::InWorkingOrder),
                ..judgement.words().into()
            },
            summary.method.as_str().into(),
            summary.steps.to_string().into(),
            summary.evaluations.to_string().into(),
            summary.switches.to_string().into(),
            checked(&run.result.figures),
        ]
    };
    let heads = ["run", "verdict", "method", ">steps", ">evaluations"];
    let heads = heads.into_iter().chain([">events", "checks"]);
    Table::new(heads).rows(comparison.runs.iter().map(row))
}

/// Figures of an object, one column a run, each with its error.
pub(in crate::report) fn figures_section<'a>(table: &FigureTable, id: &str) -> Section<'a> {
    let own = |row: &TableRow| {
        let name = row.figure.strip_prefix(id)?.strip_prefix('.')?;
        differs(row).then(|| cells(name, row, table.against_limit))
    };
    let same = |row: &&TableRow| {
        let name = row
            .figure
            .strip_prefix(id)
            .and_then(|name| name.strip_prefix('.'));
        let zero = row.values.iter().flatten().all(|value| *value == 0.0);
        name.is_some() && !zero && !differs(row)
    };
    let same = table.rows.iter().filter(same).count();
    let left_out = match same {
        0 => String::new(),
        1 => "Not shown: 1 result that is the same in all runs.".to_owned(),
        _ => format!("Not shown: {same} results that are the same in all runs."),
    };
    let values = table.labels.iter().map(|label| format!(">{label}"));
    let limit = [">converged value", ">order"].map(str::to_owned);
    let limit = limit.into_iter().take(2 * usize::from(table.against_limit));
    let heads: Vec<String> = values.chain(limit).collect();
    let heads = heads.iter().map(String::as_str);
    let heading = format!("Results of {id} over {}", parameter_words(&table.over));
    let rows = table.rows.iter().filter_map(own);
    let table = Table::new(std::iter::once("result").chain(heads)).rows(rows);
    Section::new(heading).table(table).with_paragraph(left_out)
}

/// Whether the runs differ in a figure by more than rounding; a limit of it is worth its row.
fn differs(row: &TableRow) -> bool {
    let first = row.values.first().copied().flatten();
    let same = |value: &Option<f64>| match (first, value) {
        (Some(first), Some(value)) => (first - value).abs() <= 1e-12 * first.abs(),
        (None, None) => true,
        (Some(_), None) | (None, Some(_)) => false,
    };
    let zero = row.values.iter().flatten().all(|value| *value == 0.0);
    !row.values.iter().all(same) || (row.limit.is_some() && !zero)
}

fn cells(name: &str, row: &TableRow, against_limit: bool) -> Vec<Cell> {
    let words = RESULTS.iter().find(|(known, _)| *known == name);
    let number = |value: Option<f64>| Value::new(value.unwrap_or(f64::NAN), &row.unit, 7);
    let values = row.values.iter().zip(&row.errors);
    let values = values.map(|(value, error)| {
        let error = error.map_or(String::new(), percent);
        Cell::with_note(number(*value), error)
    });
    let limit = row.limit.as_ref();
    let settled = limit.map_or([Cell::from(""), Cell::from("")], |limit| {
        let share = limit.error.zip(limit.value);
        let share = share.map(|(error, value)| error / value.abs());
        let share = share.filter(|share| share.is_finite()).map(percent);
        let within = share.map_or(String::new(), |share| format!("± {share}"));
        let value = match limit.value {
            Some(_) => number(limit.value),
            None => "none".into(),
        };
        let order = limit
            .order
            .map_or("".into(), |order| Value::new(order, "", 3));
        [Cell::with_note(value, within), order.into()]
    });
    let settled = settled.into_iter().take(2 * usize::from(against_limit));
    let first = match words {
        Some((_, words)) => Cell::with_note(*words, name),
        None => match result_words(&row.figure) {
            words if words == row.figure => Cell::from(name),
            words => Cell::address(name, words),
        },
    };
    std::iter::once(first)
        .chain(values)
        .chain(settled)
        .collect()
}

/// A share in per cent.
pub fn percent(share: f64) -> String {
    format!("{} %", significant(100.0 * share, 3))
}

/// The curves of one quantity of one object over each other; `None` when no run
/// has it. With a single run its open intervals are shaded.
pub fn chart(
    (comparison, over): (&Comparison, &Abscissa),
    object: &str,
    quantity: Quantity,
) -> Option<Plot> {
    let name = QUANTITIES.iter().find(|(key, _)| *key == quantity)?.1;
    let title = format!("{name} of {object}");
    runs::chart(&series(comparison, over), object, quantity, &title)
}

fn series<'a>(comparison: &'a Comparison, over: &'a Abscissa) -> Vec<RunSeries<'a>> {
    let runs = comparison.runs.iter().map(|run| RunSeries {
        label: label(comparison, run),
        record: &run.result.record,
        over,
    });
    runs.collect()
}

#[cfg(test)]
mod tests {
    use super::{chart, findings, percent};
    use crate::dynamics::record::{Quantity, Record};
    use crate::report::abscissa::{Abscissa, Turns};
    use crate::report::diagram::Diagram;
    use crate::report::findings::Source;
    use crate::report::fitted::fitted;
    use crate::report::fixture;
    use crate::report::html::runs;
    use crate::studies::compare::compare;
    use crate::studies::run::RunResult;
    use crate::studies::testing::result_with;

    #[test]
    fn shares_read_as_percentages() {
        for (share, text) in [(0.0, "0 %"), (-0.004, "−0.4 %"), (1e-9, "10⁻⁷ %")] {
            assert_eq!(percent(share), text);
        }
    }

    /// Runs of the lever with 1, 2 and 10 masses, with samples at the same instants.
    fn masses_compared() -> super::Comparison {
        let labels = ["1", "2", "10"].map(str::to_owned);
        let run = |label: &str| -> Result<RunResult, ()> {
            let (figures, mut record) = fixture::run(label.parse().unwrap(), 0.05, 200);
            let (times, columns) = (&mut record.times, &mut record.columns);
            for (row, time) in times.iter_mut().enumerate() {
                *time = 0.05 * row as f64 / 200.0;
            }
            let turned = (columns.iter_mut())
                .find(|one| one.object == "shaft" && one.quantity == Quantity::Displacement);
            turned.unwrap().values = times.iter().map(|time| fixture::SPEED * time).collect();
            Ok(RunResult {
                figures,
                record,
                ..result_with(|_| {})
            })
        };
        compare("rocker.masses", &labels, run).unwrap()
    }

    #[test]
    fn differences_from_the_last_run_are_those_of_the_same_instant() {
        let mut comparison = masses_compared();
        // A switch of the first run: two rows of one instant.
        let record = &mut comparison.runs[0].result.record;
        let switch = record.times[100];
        record.times.insert(100, switch);
        for column in &mut record.columns {
            column.values.insert(100, column.values[100] + 1.0);
        }
        let all = super::series(&comparison, &Abscissa::Time);
        let shown = runs::difference(&all, "rocker", Quantity::Delta, "").unwrap();
        let has = |series: usize| {
            shown.series[series]
                .points
                .iter()
                .any(|one| one.0 == switch)
        };
        assert!(!has(0) && has(1));
        let labels: Vec<&str> = shown.series.iter().map(|one| one.label.as_str()).collect();
        assert_eq!(labels, ["masses of rocker = 1", "masses of rocker = 2"]);
        for (series, run) in shown.series.iter().zip(&comparison.runs) {
            assert!(series.points.len() > 100, "{}", series.points.len());
            // The row of an instant, found by looking through all of them.
            let value = |record: &Record, time: f64| {
                let rows =
                    (0..record.times.len()).filter(|&row| (record.times[row] - time).abs() < 1e-12);
                let [row] = rows.collect::<Vec<_>>()[..] else {
                    panic!("{time}")
                };
                record.column("rocker", Quantity::Delta).unwrap().values[row]
            };
            let last = &comparison.runs[2].result.record;
            for &(time, difference) in &series.points {
                let expected = value(&run.result.record, time) - value(last, time);
                assert_eq!(difference, expected, "{} at {time}", series.label);
            }
        }
        // The drive moves alike in all: nothing is shown of it.
        assert!(runs::difference(&all, "shaft", Quantity::Displacement, "").is_none());
        assert!(runs::difference(&all[..1], "rocker", Quantity::Delta, "").is_none());
    }

    #[test]
    fn differences_over_an_angle_need_the_same_angle() {
        let mut comparison = masses_compared();
        let over = Abscissa::Angle {
            drive: "shaft".to_owned(),
            turns: Turns::Behind,
        };
        let all = super::series(&comparison, &over);
        let shown = runs::difference(&all, "rocker", Quantity::Delta, "").unwrap();
        assert_eq!((shown.x.unit.as_str(), shown.series.len()), ("deg", 2));
        // A drive that lags behind is nowhere at the same angle at the same time.
        let columns = &mut comparison.runs[0].result.record.columns;
        let lagging = (columns.iter_mut())
            .find(|one| one.object == "shaft" && one.quantity == Quantity::Displacement);
        lagging
            .unwrap()
            .values
            .iter_mut()
            .for_each(|angle| *angle -= 1e-3);
        let all = super::series(&comparison, &over);
        let shown = runs::difference(&all, "rocker", Quantity::Delta, "").unwrap();
        assert_eq!(shown.series.len(), 1);
        assert_eq!(shown.series[0].label, "masses of rocker = 2");
    }

    #[test]
    fn runs_stand_side_by_side() {
        let comparison = masses_compared();
        let diagram = Diagram::of(&fixture::rocker(2));
        let source = Source::scene(include_str!("fixture/scene.json"), "");
        let found = findings(
            "The paper's <figures>",
            (&comparison, &Abscissa::Time),
            &diagram,
            Vec::new(),
            source,
        );
        let page = found.page();
        assert!(page.contains("errors against masses of rocker = 10"));
        let differences = "<h3>Differences of rocker from the run with masses of rocker = 10</h3>";
        assert!(page.contains(differences));
        assert!(page.contains("Δ Positioning error δ"));
        assert!(page.contains("The paper&#39;s &lt;figures&gt;"));
        // In 80 columns each row of figures stands whole, under its own name.
        let text = fitted(&found.text(Some(80)), 80);
        assert!(
            text.lines().all(|line| line.chars().count() <= 80),
            "{text}"
        );
        assert!(text.matches("\n  greatest |δ| ").count() > 1, "{text}");
        let curves = chart((&comparison, &Abscissa::Time), "rocker", Quantity::Delta).unwrap();
        assert_eq!((curves.series.len(), curves.y.unit.as_str()), (3, "rad"));
        assert!(chart((&comparison, &Abscissa::Time), "nobody", Quantity::Delta).is_none());
    }
}
