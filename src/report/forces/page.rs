//! The forces as a page that opens without a network.

use super::charts::{groups, massless_chart, ratio_chart};
use super::text::verdict;
use super::{ForcesReport, Hodograph, drawing, shown};
use crate::analysis::forces::Extreme;
use crate::report::html::data::PlotData;
use crate::report::html::{facts, header, scene, shell, warnings};
use crate::report::quantity::{escape, significant};
use std::fmt::Write as _;

/// Sizes of pictures (pixels).
const PLOT: (f64, f64) = (590.0, 300.0);
const WIDE: (f64, f64) = (1000.0, 420.0);
const POLAR: f64 = 330.0;
/// Most points of a hodograph.
const MOST_POINTS: usize = 2000;

/// The page.
pub fn page(report: &ForcesReport<'_>) -> String {
    let study = report.study;
    let subtitle = format!("forces of {}, {}", report.object, report.motion);
    let mut body = header(report.name, &subtitle, None);
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
    if let Some(chart) = ratio_chart(report) {
        let _ = writeln!(
            body,
            "<h2>Transmission</h2>\n<div class=\"graph\">{}</div>",
            chart.svg(WIDE.0, WIDE.1)
        );
    }
    body.push_str(&massless(report));
    body.push_str(&hodographs(report));
    for group in groups(report) {
        let charts = group.charts.iter().filter(|chart| !chart.curves.is_empty());
        let charts: Vec<String> = charts
            .map(|chart| format!("<div class=\"graph\">{}</div>\n", chart.svg(PLOT.0, PLOT.1)))
            .collect();
        let _ = writeln!(
            body,
            "<h2>{}</h2>\n<div class=\"plots\" style=\"--rows:{}\">\n{}</div>",
            group.title,
            charts.len().div_ceil(2),
            charts.concat()
        );
    }
    body.push_str(&extremes(report));
    body.push_str(&scene(report.scene));
    body.push_str("</main>\n");
    body.push_str(&footer(report));
    shell(report.name, &body, &PlotData::new(&[]).json())
}

fn hodographs(report: &ForcesReport<'_>) -> String {
    let study = report.study;
    let mut out = String::from(
        "<h2>Hodographs</h2>\n<p class=\"soft\">The tip of each force over the course; the dot is \
         the first position.</p>\n<div style=\"display:flex;flex-wrap:wrap;gap:12px\">\n",
    );
    let stride = study.rows.len().div_ceil(MOST_POINTS).max(1);
    for (index, pair) in study.linkage.pairs.iter().enumerate() {
        let vectors = study.rows.iter().step_by(stride).map(|row| {
            let forces = row.forces.as_ref();
            forces.map_or([f64::NAN; 2], |forces| forces.pairs[index].force)
        });
        let plot = Hodograph {
            title: format!("Force in {}", pair.name),
            unit: "N".to_owned(),
            vectors: vectors.collect(),
            closed: study.course.is_closed(),
        };
        let _ = writeln!(out, "<div class=\"graph\">{}</div>", plot.svg(POLAR));
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
    rows.push(("Power balance", format!("to {:.1e}", study.worst_balance())));
    let influence = format!("to {:.1e}", study.worst_influence());
    rows.push(("Influence coefficients", influence));
    format!("<h2>Figures</h2>\n{}", facts(&rows))
}

fn massless(report: &ForcesReport<'_>) -> String {
    let (Some(found), Some(chart)) = (report.massless, massless_chart(report)) else {
        return String::new();
    };
    format!(
        "<h2>Massless against full model</h2>\n<div class=\"graph\">{}</div>\n<p>{}</p>\n",
        chart.svg(WIDE.0, WIDE.1),
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
