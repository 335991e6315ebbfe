//! The page of a steady motion.

use super::charts::{charts, wittenbauer};
use super::picture::list;
use super::picture::picture;
use super::text::{agreement, figures, flywheel};
use super::{Shown, periodic};
use crate::report::html::{bar, facts, header, scene, shell, warnings};
use crate::report::plot::Plots;
use crate::report::quantity::significant;
use crate::report::verdict::{Sort, Verdict};
use crate::studies::steady::{PeriodicAnswer, Stability};
use std::fmt::Write as _;

/// Everything that goes into the page of a steady motion.
#[derive(Clone, Copy, Debug)]
pub struct SteadyReport<'a> {
    /// The scene's name, or what machine it is.
    pub title: &'a str,
    /// The motion of a machine reduced to its drive.
    pub rigid: Option<Shown<'a>>,
    /// The periodic motion of elastic objects.
    pub periodic: Option<&'a PeriodicAnswer>,
    /// The scene's text, shown as it is.
    pub scene: Option<&'a str>,
    /// SHA-256 of the canonical scene.
    pub hash: &'a str,
    /// Version of `dam`.
    pub version: &'a str,
}

/// Size of the pictures (pixels).
const PICTURE: (f64, f64) = (579.0, 300.0);
const DIAGRAM: (f64, f64) = (1184.0, 520.0);

/// The page.
pub fn page(report: &SteadyReport<'_>) -> String {
    let subtitle = match (&report.rigid, report.periodic) {
        (Some(shown), _) => format!(
            "Steady motion, mean speed {} rad/s, δ = {}",
            significant(shown.figures.mean_speed, 6),
            significant(shown.figures.fluctuation, 5)
        ),
        (
            None,
            Some(PeriodicAnswer {
                drive: Some(drive), ..
            }),
        ) => format!(
            "Steady motion on its motor, mean speed {} rad/s, δ = {}",
            significant(drive.means.time, 6),
            significant(drive.fluctuation, 5)
        ),
        (None, Some(_)) => "Periodic motion behind the drive and its stability".to_owned(),
        (None, None) => "Steady motion".to_owned(),
    };
    let mut body = header(report.title, &subtitle, answer(report).as_ref());
    body.push_str("<main>\n");
    let mut plots = Plots::default();
    if let Some(shown) = &report.rigid {
        body.push_str(&rigid(shown, &mut plots));
    }
    if let Some(answer) = report.periodic {
        body.push_str(&periodic::section(answer, &mut plots));
    }
    if let Some(text) = report.scene {
        body.push_str(&scene(text));
    }
    body.push_str("</main>\n");
    let mut rows = vec![("Machine", report.title.to_owned())];
    if !report.hash.is_empty() {
        rows.push(("SHA-256 of the canonical scene", report.hash.to_owned()));
    }
    rows.push(("Program", format!("dam {}", report.version)));
    let _ = write!(
        body,
        "<footer>\n<h2>Provenance</h2>\n{}</footer>\n",
        facts(&rows)
    );
    shell(report.title, &body, &plots.json())
}

/// Mean speed and fluctuation, or whether the periodic motion is the one that comes about.
fn answer(report: &SteadyReport<'_>) -> Option<Verdict> {
    if let Some(shown) = &report.rigid {
        let f = shown.figures;
        let headline = format!(
            "The speed fluctuates by δ = {}.",
            significant(f.fluctuation, 4)
        );
        let text = format!(
            "From {} to {} rad/s about a mean of {} rad/s.",
            significant(f.least_speed.value, 5),
            significant(f.greatest_speed.value, 5),
            significant(f.mean_speed, 5)
        );
        let sort = if f.warnings.is_empty() {
            Sort::Good
        } else {
            Sort::Mechanism
        };
        return Some(Verdict::answer(sort, headline, text));
    }
    let parts = &report.periodic?.parts;
    let repels = parts.iter().any(|part| part.stability == Stability::Repels);
    let (sort, headline) = match repels {
        true => (
            Sort::Mechanism,
            "A periodic motion was found that repels its neighbours.",
        ),
        false => (
            Sort::Good,
            "A periodic motion was found that no small disturbance leaves.",
        ),
    };
    let miss = parts.iter().map(|part| part.miss).fold(0.0, f64::max);
    let text = format!("It comes back to {} of its size.", significant(miss, 2));
    Some(Verdict::answer(sort, headline.to_owned(), text))
}

fn rigid(shown: &Shown<'_>, plots: &mut Plots) -> String {
    let mut body = warnings(&shown.figures.warnings);
    let _ = write!(body, "<h2>Figures</h2>\n{}", list(&figures(shown)));
    let wheel = flywheel(shown);
    if !wheel.is_empty() {
        let _ = write!(
            body,
            "<h2>Flywheel</h2>\n{}<p class=\"soft\">The motion on this page is the one with the \
             flywheel.</p>\n",
            list(&wheel)
        );
    }
    let all = charts(shown);
    let _ = write!(
        body,
        "<h2>Motion over a cycle</h2>\n{}<div class=\"plots\" style=\"--rows:{}\">\n",
        bar("cycle"),
        all.len().div_ceil(2)
    );
    for chart in all {
        body.push_str(&picture(plots, &chart, PICTURE));
    }
    body.push_str("</div>\n");
    body.push_str("<h2>Energy-mass diagram</h2>\n");
    body.push_str(&picture(plots, &wittenbauer(shown), DIAGRAM));
    body.push_str(
        "<p class=\"soft\">A straight line from O₂ with the slope ω²/2 meets the curve where the \
         drive has the speed ω: the tangents touch it at the greatest and the least speed. O₂ lies \
         T(0) below the start of the curve.</p>\n",
    );
    let _ = write!(body, "<h2>Agreement</h2>\n{}", list(&agreement(shown)));
    body
}
