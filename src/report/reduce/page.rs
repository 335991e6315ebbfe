//! The page of a reduced scene.

use super::chart::chart;
use super::{answer, counted, greatest, why};
use crate::report::accuracy;
use crate::report::diagram::Diagram;
use crate::report::html::{header, mechanism, scene, shell};
use crate::report::plot::Plots;
use crate::report::quantity::escape;
use crate::report::verdict::{Sort, Verdict};
use crate::studies::reduce::{Reduction, Role, Step};
use std::fmt::Write as _;

/// Everything that goes into the page.
#[derive(Clone, Copy, Debug)]
pub struct ReduceReport<'a> {
    /// The reduced scene, and how it was found.
    pub reduction: &'a Reduction,
    /// The object graph of the scene as it was given.
    pub diagram: &'a Diagram,
    /// Version of `dam`.
    pub version: &'a str,
}

/// The page: answer, figures, what is left out and why the rest stays, error against cost.
pub fn page(report: &ReduceReport<'_>) -> String {
    let reduction = report.reduction;
    let mut plots = Plots::default();
    let subtitle = format!(
        "smallest scene, {} run",
        counted(reduction.models.len(), "model")
    );
    let sort = match (reduction.holds(), reduction.complete) {
        (true, true) => Sort::Good,
        (true, false) => Sort::Unfinished,
        (false, _) => Sort::Numerical,
    };
    let more = match reduction.complete {
        true => String::new(),
        false => "Ended before everything was tried.".to_owned(),
    };
    let verdict = Verdict::answer(sort, answer(reduction), more);
    let mut body = header(&reduction.scene, &subtitle, Some(&verdict));
    body.push_str("<main>\n");
    body.push_str(&accuracy::tables(&reduction.certificate));
    body.push_str(&steps(reduction));
    body.push_str(&sizes(reduction));
    if let Some(chart) = chart(reduction) {
        body.push_str("<h2>Error against cost</h2>\n");
        body.push_str(&plots.figure(&chart, [900.0, 420.0], ""));
        body.push_str(
            "<p class=\"soft\">Every mark is a model that was run: filled the reduced scene, \
             a cross the scene as given. Times are of single runs.</p>\n",
        );
    }
    body.push_str(&mechanism(report.diagram));
    body.push_str(&scene(reduction.document.text()));
    let _ = write!(
        body,
        "</main>\n<footer><p>dam {}</p></footer>\n",
        escape(report.version)
    );
    shell(&reduction.scene, &body, &plots.json())
}

fn steps(reduction: &Reduction) -> String {
    let row = |step: &Step| {
        let (class, verdict, says) = match &step.refused {
            None => ("yes", "left out", greatest(reduction, step)),
            Some(refused) => ("no", "kept", why(reduction, refused)),
        };
        format!(
            "<tr><th>{}</th><td class=\"left\">{}</td><td class=\"left {class}\">{verdict}</td>\
             <td class=\"left\">{}</td></tr>\n",
            escape(&step.removal.object),
            escape(&step.removal.part.to_string()),
            escape(&says)
        )
    };
    let steps: Vec<&Step> = reduction.removed().chain(reduction.kept()).collect();
    if steps.is_empty() {
        return String::new();
    }
    let rows: String = steps.into_iter().map(row).collect();
    format!(
        "<h2>What can be left out</h2>\n<div class=\"scroll\"><table>\n<thead><tr><th>Object</th>\
         <th class=\"left\">made simpler</th><th class=\"left\">verdict</th>\
         <th class=\"left\">because it</th></tr></thead>\n<tbody>\n{rows}</tbody></table></div>\n"
    )
}

/// The scene as given beside the reduced one.
fn sizes(reduction: &Reduction) -> String {
    let roles = [(Role::Given, "as given"), (Role::Reduced, "reduced")];
    let rows: String = roles
        .into_iter()
        .filter_map(|(role, name)| {
            let model = reduction.model(role)?;
            let levels = model.levels.iter();
            let levels: Vec<String> = levels.map(|(id, level)| format!("{id}: {level}")).collect();
            let time = crate::report::quantity::with_unit(model.seconds, "s", 2);
            Some(format!(
                "<tr><th>{name}</th><td class=\"left\">{}</td><td>{}</td><td>{time}</td></tr>\n",
                escape(&levels.join(", ")),
                model.coordinates
            ))
        })
        .collect();
    format!(
        "<h2>Size</h2>\n<div class=\"scroll\"><table>\n<thead><tr><th>Scene</th>\
         <th class=\"left\">elastic objects</th><th>their coordinates</th><th>time of a run</th>\
         </tr></thead>\n<tbody>\n{rows}</tbody></table></div>\n"
    )
}
