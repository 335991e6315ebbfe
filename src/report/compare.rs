//! Several runs of one scene over each other: figures side by side, curves in
//! one frame.

use crate::dynamics::record::{Figures, ObjectFigures, Quantity, Record};
use crate::report::diagram::Diagram;
use crate::report::html::runs::{self, QUANTITIES, RunSeries};
use crate::report::html::{facts, header, mechanism, scene, shell, tables, warnings};
use crate::report::plot::{Plot, Plots};
use crate::report::quantity::{escape, significant, with_unit};
use crate::report::verdict::{Sort, Verdict, verdict};

/// A run among those compared.
#[derive(Clone, Debug)]
pub struct ComparedRun<'a> {
    /// Setting that it differs in: `rocker.masses = 2`.
    pub label: String,
    /// Figures of the run.
    pub figures: &'a Figures,
    /// Samples of the run.
    pub record: &'a Record,
}

/// Everything that goes into the page of a comparison. The last run is what
/// the others are measured against.
#[derive(Clone, Copy, Debug)]
pub struct CompareReport<'a> {
    /// Title: the scene's name.
    pub title: &'a str,
    /// The runs, at least one.
    pub runs: &'a [ComparedRun<'a>],
    /// How many masses or modes are enough, a sentence a figure.
    pub enough: &'a [String],
    /// The object graph of the scene.
    pub diagram: &'a Diagram,
    /// The scene's text.
    pub scene: &'a str,
    /// Version of `dam`.
    pub version: &'a str,
}

/// A figure that is compared: its name, its unit relative to the object's, and
/// how to read it.
struct Compared {
    name: &'static str,
    unit: Unit,
    read: fn(&ObjectFigures) -> Option<f64>,
}

#[derive(Clone, Copy)]
enum Unit {
    Displacement,
    Speed,
    Acceleration,
    Force,
    Time,
    Count,
}

const COMPARED: [Compared; 14] = [
    row("greatest |δ|", Unit::Displacement, |o| Some(o.delta_abs)),
    row("δ<sub>max</sub>", Unit::Displacement, |o| {
        Some(o.delta_max)
    }),
    row("δ<sub>min</sub>", Unit::Displacement, |o| {
        Some(o.delta_min)
    }),
    row("σ, mean |δ|", Unit::Displacement, |o| Some(o.sigma)),
    row("peak speed", Unit::Speed, |o| Some(o.peak_speed)),
    row("peak acceleration", Unit::Acceleration, |o| {
        Some(o.peak_acceleration)
    }),
    row("peak reaction", Unit::Force, |o| Some(o.peak_reaction)),
    row("displacement at the end", Unit::Displacement, |o| {
        Some(o.end.displacement)
    }),
    row("separations", Unit::Count, |o| {
        o.pair.as_ref().map(|p| p.separations as f64)
    }),
    row("time open", Unit::Time, |o| {
        o.pair.as_ref().map(|p| p.separated_time)
    }),
    row("longest opening", Unit::Time, |o| {
        o.pair.as_ref().map(|p| p.longest_separation)
    }),
    row("greatest lift", Unit::Displacement, |o| {
        o.pair.as_ref().map(|p| p.max_lift)
    }),
    row("greatest approach speed", Unit::Speed, |o| {
        o.pair.as_ref().map(|p| p.max_approach_speed)
    }),
    row("greatest contact force", Unit::Force, |o| {
        o.pair.as_ref().map(|p| p.max_contact_force)
    }),
];

const fn row(name: &'static str, unit: Unit, read: fn(&ObjectFigures) -> Option<f64>) -> Compared {
    Compared { name, unit, read }
}

/// The page of a comparison.
pub fn page(report: &CompareReport<'_>) -> String {
    let runs = report.runs;
    let mut plots = Plots::default();
    let series = series(runs);
    let last = runs.last().map_or("", |run| run.label.as_str());
    let subtitle = format!("{} runs compared; errors against {last}", runs.len());
    let mut body = header(report.title, &subtitle, Some(&answer(runs)));
    body.push_str("<main>\n");
    for sentence in report.enough {
        body.push_str(&format!("<p>{}</p>\n", escape(sentence)));
    }
    body.push_str(&verdicts(runs));
    body.push_str(&all_warnings(runs));
    body.push_str(&mechanism(report.diagram));
    // Drives move alike in every run as a rule: they come last.
    let mut boxes: Vec<_> = report.diagram.boxes.iter().collect();
    boxes.sort_by_cached_key(|one| usize::from(one.is_drive()));
    for one in boxes {
        body.push_str(&runs::section(
            &mut plots,
            &series,
            &one.id,
            &one.kind.replace('_', " "),
        ));
        body.push_str(&side_by_side(runs, &one.id));
    }
    body.push_str(&scene(report.scene));
    body.push_str("</main>\n");
    body.push_str(&footer(report));
    shell(report.title, &body, &plots.json())
}

/// How far the greatest deviation depends on what is compared, and whether a run is in doubt.
fn answer(runs: &[ComparedRun<'_>]) -> Verdict {
    let judged: Vec<Verdict> = runs.iter().map(|run| verdict(run.figures)).collect();
    let deviation = |run: &ComparedRun<'_>| {
        let all = run.figures.objects.iter();
        let greatest = all.max_by(|a, b| a.1.delta_abs.total_cmp(&b.1.delta_abs))?;
        let unit = tables::units(run.figures, greatest.0).displacement;
        Some((greatest.0.clone(), greatest.1.delta_abs, unit))
    };
    let found: Vec<_> = runs.iter().filter_map(deviation).collect();
    let least = found.iter().min_by(|a, b| a.1.total_cmp(&b.1));
    let most = found.iter().max_by(|a, b| a.1.total_cmp(&b.1));
    let headline = match least.zip(most) {
        Some(((id, least, unit), (_, most, _))) if *most > 0.0 => format!(
            "Greatest |δ|, of {id}: {} to {}.",
            with_unit(*least, unit, 4),
            with_unit(*most, unit, 4)
        ),
        _ => "No object deviates from its law.".to_owned(),
    };
    let bad = |sort: Sort| judged.iter().filter(|one| one.sort == sort).count();
    let (numerical, mechanism, unfinished) = (
        bad(Sort::Numerical),
        bad(Sort::Mechanism),
        bad(Sort::Unfinished),
    );
    let (sort, text) = match (numerical, unfinished, mechanism) {
        (0, 0, 0) => (
            Sort::Good,
            format!("All {} runs are in working order.", runs.len()),
        ),
        (0, 0, count) => (
            Sort::Mechanism,
            format!("{count} of {} runs are not in working order.", runs.len()),
        ),
        (0, count, _) => (
            Sort::Unfinished,
            format!("{count} of {} runs did not finish.", runs.len()),
        ),
        (count, ..) => (
            Sort::Numerical,
            format!(
                "{count} of {} runs failed their own check and are not to be trusted.",
                runs.len()
            ),
        ),
    };
    Verdict::answer(sort, headline, text)
}

/// One row a run: verdict, method, effort.
fn verdicts(runs: &[ComparedRun<'_>]) -> String {
    let row = |run: &ComparedRun<'_>| {
        let judged = verdict(run.figures);
        let class = match judged.sort {
            Sort::Good => "yes",
            _ => "no",
        };
        let kind = match judged.sort {
            Sort::Numerical => " (computation)",
            _ => "",
        };
        let summary = &run.figures.run;
        format!(
            "<tr><th>{}</th><td class=\"left {class}\">{}{kind}</td><td>{}</td><td>{}</td>\
             <td>{}</td><td>{}</td><td>{}</td></tr>\n",
            escape(&run.label),
            escape(&judged.headline),
            escape(&summary.method),
            summary.steps,
            summary.evaluations,
            summary.switches,
            significant(summary.energy_error, 2)
        )
    };
    format!(
        "<h2>Runs</h2>\n<div class=\"scroll\"><table>\n<thead><tr><th>Run</th>\
         <th class=\"left\">verdict</th><th>method</th><th>steps</th><th>evaluations</th>\
         <th>switches</th><th>energy error</th></tr></thead>\n<tbody>\n{}</tbody></table></div>\n",
        runs.iter().map(row).collect::<String>()
    )
}

fn all_warnings(runs: &[ComparedRun<'_>]) -> String {
    let of = |run: &ComparedRun<'_>| {
        let label = run.label.clone();
        let named = move |text: &String| format!("{label}: {text}");
        run.figures.warnings.iter().map(named).collect::<Vec<_>>()
    };
    warnings(&runs.iter().flat_map(of).collect::<Vec<_>>())
}

/// Figures of an object, one column a run, the error against the last below.
fn side_by_side(runs: &[ComparedRun<'_>], id: &str) -> String {
    let head: String = runs
        .iter()
        .map(|run| format!("<th>{}</th>", escape(&run.label)))
        .collect();
    let rows: String = COMPARED
        .iter()
        .map(|figure| figure_row(runs, id, figure))
        .collect();
    if rows.is_empty() {
        return String::new();
    }
    format!(
        "<h3>Figures of {}</h3>\n<div class=\"scroll\"><table>\n<thead><tr><th>Figure</th>{head}\
         </tr></thead>\n<tbody>\n{rows}</tbody></table></div>\n",
        escape(id)
    )
}

/// One row; nothing when no run has this figure or all are zero.
fn figure_row(runs: &[ComparedRun<'_>], id: &str, figure: &Compared) -> String {
    let read = |run: &ComparedRun<'_>| run.figures.objects.get(id).and_then(figure.read);
    let values: Vec<Option<f64>> = runs.iter().map(read).collect();
    if values.iter().flatten().all(|&value| value == 0.0) {
        return String::new();
    }
    let last = values.last().copied().flatten();
    let cell = |(index, value): (usize, &Option<f64>)| {
        let Some(value) = value else {
            return "<td>–</td>".to_owned();
        };
        let unit = unit_text(figure.unit, runs[index].figures, id);
        let error = match (index + 1 == runs.len(), last) {
            (true, _) | (false, None) => String::new(),
            (false, Some(last)) => error_text(*value, last),
        };
        format!(
            "<td title=\"{value}\">{}<span class=\"sub\">{error}</span></td>",
            escape(&with_unit(*value, &unit, 6))
        )
    };
    let cells: String = values.iter().enumerate().map(cell).collect();
    format!("<tr><th>{}</th>{cells}</tr>\n", figure.name)
}

fn unit_text(unit: Unit, figures: &Figures, id: &str) -> String {
    let units = tables::units(figures, id);
    match unit {
        Unit::Displacement => units.displacement.to_owned(),
        Unit::Speed => format!("{}/s", units.displacement),
        Unit::Acceleration => format!("{}/s²", units.displacement),
        Unit::Force => units.force.to_owned(),
        Unit::Time => "s".to_owned(),
        Unit::Count => String::new(),
    }
}

/// Error against the reference in per cent; absolute where the reference is 0.
pub fn error_text(value: f64, reference: f64) -> String {
    if value == reference {
        return "same".into();
    }
    let signed = |number: f64, unit: &str| {
        let plus = if number > 0.0 { "+" } else { "" };
        format!("{plus}{}{unit}", significant(number, 2))
    };
    if reference == 0.0 {
        return signed(value, "");
    }
    signed((value - reference) / reference.abs() * 100.0, " %")
}

fn footer(report: &CompareReport<'_>) -> String {
    let mut rows = vec![
        ("Scene", report.title.to_owned()),
        ("Program", format!("dam {}", report.version)),
    ];
    for run in report.runs {
        let figures = run.figures;
        rows.push((
            run.label.as_str(),
            format!(
                "{}; SHA-256 of the canonical scene {}; tolerance {}",
                figures.run.method,
                figures.hash,
                significant(figures.run.tolerance, 3)
            ),
        ));
    }
    format!("<footer>\n<h2>Provenance</h2>\n{}</footer>\n", facts(&rows))
}

/// The curves of one quantity of one object over each other; `None` when no run
/// has it. With a single run its open intervals are shaded.
pub fn chart(runs: &[ComparedRun<'_>], object: &str, quantity: Quantity) -> Option<Plot> {
    let name = QUANTITIES.iter().find(|(key, _)| *key == quantity)?.1;
    runs::chart(
        &series(runs),
        object,
        quantity,
        &format!("{name} of {object}"),
    )
}

fn series<'a>(runs: &'a [ComparedRun<'_>]) -> Vec<RunSeries<'a>> {
    let one = |run: &'a ComparedRun<'_>| RunSeries {
        label: run.label.clone(),
        record: run.record,
    };
    runs.iter().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::{CompareReport, ComparedRun, chart, error_text, page};
    use crate::dynamics::record::Quantity;
    use crate::report::diagram::Diagram;
    use crate::report::fixture;

    #[test]
    fn errors_are_taken_against_the_last_run() {
        assert_eq!(error_text(1.01, 1.0), "+1 %");
        assert_eq!(error_text(-1.2, -1.0), "−20 %");
        assert_eq!(error_text(2.0, 2.0), "same");
        assert_eq!(error_text(3.0, 0.0), "+3");
    }

    #[test]
    fn runs_stand_side_by_side() {
        let done: Vec<_> = [1, 2, 10].map(|n| (n, fixture::run(n, 0.05, 200))).into();
        let runs: Vec<_> = done
            .iter()
            .map(|(n, (figures, record))| ComparedRun {
                label: format!("rocker.masses = {n}"),
                figures,
                record,
            })
            .collect();
        let page = page(&CompareReport {
            title: "The paper's <figures>",
            runs: &runs,
            enough: &[],
            diagram: &Diagram::of(&fixture::rocker(2)),
            scene: include_str!("fixture/scene.json"),
            version: "0.1.0",
        });
        assert!(page.contains("errors against rocker.masses = 10"));
        assert!(page.contains("The paper&#39;s &lt;figures&gt;"));
        let chart = chart(&runs, "rocker", Quantity::Delta).unwrap();
        assert_eq!((chart.series.len(), chart.y.unit.as_str()), (3, "rad"));
        assert!(super::chart(&runs, "nobody", Quantity::Delta).is_none());
        if std::env::var_os("DAM_PREVIEW").is_some() {
            std::fs::write("target/preview/compare.html", page).unwrap();
            std::fs::write("target/preview/chart.svg", chart.svg(760.0, 380.0)).unwrap();
        }
    }
}
