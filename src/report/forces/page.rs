//! The forces as a page that opens without a network.

use super::charts::{groups, massless_chart, ratio_chart};
use super::text::verdict;
use super::{ForcesReport, drawing, shown};
use crate::report::html::{bar, facts, header, scene, shell, warnings};
use crate::report::plot::{Plots, page::hodograph};
use crate::report::quantity::{escape, significant};
use crate::report::verdict::{Sort, Verdict};
use crate::studies::forces::Extreme;
use std::fmt::Write as _;

/// Sizes of pictures (pixels).
const PLOT: [f64; 2] = [579.0, 300.0];
const WIDE: [f64; 2] = [1184.0, 420.0];
const POLAR: [f64; 2] = [360.0, 370.0];
/// Most points of a hodograph.
const MOST_POINTS: usize = 2000;

/// The page.
pub fn page(report: &ForcesReport<'_>) -> String {
    let study = report.study;
    let subtitle = format!("forces of {}, {}", report.object, report.motion);
    let mut body = header(report.name, &subtitle, Some(&answer(report)));
    body.push_str("<main>\n");
    body.push_str(&warnings(report.warnings));
    if study.solved().next().is_some() {
        body.push_str("<h2>The mechanism with its forces</h2>\n");
        body.push_str(&drawing(report).section("mechanism"));
        body.push_str(
            "<p class=\"soft\">Forces act on the second link of their pair, friction included; a \
             block's force is drawn at its reference point.</p>\n",
        );
    }
    body.push_str(&zones(report));
    body.push_str(&cycle(report));
    let mut plots = Plots::default();
    if let Some(chart) = ratio_chart(report) {
        let _ = writeln!(
            body,
            "<h2>Transmission</h2>\n{}",
            plots.figure(&chart, WIDE, "")
        );
    }
    body.push_str(&massless(report, &mut plots));
    body.push_str(&hodographs(report, &mut plots));
    for group in groups(report) {
        let charts = group.charts.iter().filter(|chart| !chart.series.is_empty());
        let charts: Vec<String> = charts
            .map(|chart| plots.figure(chart, PLOT, "course"))
            .collect();
        let _ = writeln!(
            body,
            "<h2>{}</h2>\n{}<div class=\"plots\" style=\"--rows:{}\">\n{}</div>",
            group.title,
            bar("course"),
            charts.len().div_ceil(2),
            charts.concat()
        );
    }
    body.push_str(&extremes(report));
    body.push_str(&scene(report.scene));
    body.push_str("</main>\n");
    body.push_str(&footer(report));
    shell(report.name, &body, &plots.json())
}

/// Between what the driving force lies, and whether the balance of power closes.
fn answer(report: &ForcesReport<'_>) -> Verdict {
    let study = report.study;
    let solved = study.solved().count();
    let drive = study.extremes.iter().find(|found| found.name == "drive");
    let headline = match drive {
        Some(drive) => {
            let end = |end: &Extreme| report.extreme(end, &drive.unit)[0].trim().to_owned();
            format!(
                "Driving force from {} to {}.",
                end(&drive.least),
                end(&drive.greatest)
            )
        }
        None => "No position has forces.".to_owned(),
    };
    let missing = study.rows.len().saturating_sub(solved);
    let balance = study.worst_balance();
    let mut text = format!("The balance of power closes to {}", significant(balance, 2));
    if missing > 0 {
        let _ = write!(
            text,
            "; {missing} of {} positions have no forces",
            study.rows.len()
        );
    }
    let sort = match (missing, balance < 1e-6) {
        (_, false) => Sort::Numerical,
        (0, _) => Sort::Good,
        _ => Sort::Mechanism,
    };
    Verdict::answer(sort, headline, text + ".")
}

fn hodographs(report: &ForcesReport<'_>, plots: &mut Plots) -> String {
    let study = report.study;
    let mut out = String::from(
        "<h2>Hodographs</h2>\n<p class=\"soft\">The tip of each force over the course; the dot is \
         the first position.</p>\n<div class=\"round\">\n",
    );
    let stride = study.rows.len().div_ceil(MOST_POINTS).max(1);
    for (index, pair) in study.linkage.pairs.iter().enumerate() {
        let vectors = study.rows.iter().step_by(stride).map(|row| {
            let forces = row.forces.as_ref();
            let [x, y] = forces.map_or([f64::NAN; 2], |forces| forces.pairs[index].force);
            (x, y)
        });
        let mut vectors: Vec<(f64, f64)> = vectors.collect();
        if study.course.is_closed() {
            vectors.extend(vectors.first().copied());
        }
        let plot = hodograph(&format!("Force in {}", pair.name), "N", vectors);
        out.push_str(&plots.figure(&plot, POLAR, ""));
    }
    out.push_str("</div>\n");
    out
}

fn zones(report: &ForcesReport<'_>) -> String {
    if report.study.zones.is_empty() {
        return String::new();
    }
    let rows = report.study.zones.iter().map(|zone| {
        format!(
            "<tr><td>{}</td><td>{}</td><td class=\"left\">{}</td></tr>\n",
            report.place(zone.from),
            report.place(zone.to),
            escape(&report.zone(zone))
        )
    });
    format!(
        "<h2>Zones</h2>\n<div class=\"scroll\"><table>\n<thead><tr><th>from</th><th>to</th>\
         <th class=\"left\">what</th></tr></thead>\n<tbody>\n{}</tbody></table></div>\n\
         <p class=\"soft\">Shaded in the plots.</p>\n",
        rows.collect::<String>()
    )
}

fn cycle(report: &ForcesReport<'_>) -> String {
    let study = report.study;
    let mut rows: Vec<(&str, String)> = Vec::new();
    if let Some(cycle) = &study.cycle {
        rows.push(("Work of the driver", shown(cycle.drive_work, "J")));
        rows.push(("Work of the load", shown(cycle.load_work, "J")));
        rows.push(("Lost to friction", shown(cycle.loss, "J")));
        if let Some(efficiency) = cycle.efficiency {
            let percent = format!("{} %", significant(100.0 * efficiency, 5));
            rows.push(("Efficiency of the cycle", percent));
        }
        let unit = study.drive_unit();
        rows.push(("Mean driving force", shown(cycle.mean_drive, unit)));
        rows.push(("Root mean square of it", shown(cycle.rms_drive, unit)));
    }
    if let Some(found) = &study.counterweight {
        let text = format!(
            "{} at {} deg in the frame of {}: shaking force {} → {} (rms {} → {})",
            shown(found.mass_radius, "kg m"),
            significant(found.angle.to_degrees(), 5),
            study.linkage.links[found.link].name,
            shown(found.greatest[0], "N"),
            shown(found.greatest[1], "N"),
            shown(found.rms[0], "N"),
            shown(found.rms[1], "N"),
        );
        rows.push(("Best counterweight", text));
    }
    rows.push((
        "Power balance",
        format!("to {}", significant(study.worst_balance(), 2)),
    ));
    let influence = format!("to {}", significant(study.worst_influence(), 2));
    rows.push(("Influence coefficients", influence));
    format!("<h2>Figures</h2>\n{}", facts(&rows))
}

fn massless(report: &ForcesReport<'_>, plots: &mut Plots) -> String {
    let (Some(found), Some(chart)) = (report.massless, massless_chart(report)) else {
        return String::new();
    };
    format!(
        "<h2>Massless against full model</h2>\n{}<p>{}</p>\n",
        plots.figure(&chart, WIDE, ""),
        escape(&verdict(found))
    )
}

fn extremes(report: &ForcesReport<'_>) -> String {
    let rows = report.study.extremes.iter().map(|found| {
        let cell = |end: &Extreme| {
            let [value, at] = report.extreme(end, &found.unit);
            let at = match end.value.is_finite() {
                true => format!("at {at}"),
                false => at,
            };
            format!("<td>{}<span class=\"sub\">{at}</span></td>", escape(&value))
        };
        let (least, greatest) = (cell(&found.least), cell(&found.greatest));
        format!(
            "<tr><th>{}</th>{least}{greatest}</tr>\n",
            escape(&found.name)
        )
    });
    format!(
        "<h2>Extremes</h2>\n<div class=\"scroll\"><table>\n<thead><tr><th></th><th>least</th>\
         <th>greatest</th></tr></thead>\n<tbody>\n{}</tbody></table></div>\n",
        rows.collect::<String>()
    )
}

fn footer(report: &ForcesReport<'_>) -> String {
    let rows = [
        ("Scene", report.name.to_owned()),
        ("SHA-256 of the canonical scene", report.hash.to_owned()),
        ("Program", format!("dam {}", report.version)),
    ];
    format!("<footer>\n<h2>Provenance</h2>\n{}</footer>\n", facts(&rows))
}
