//! The kinematics as a page that opens without a network.

use super::text::{behaviour, reach};
use super::{angle_or, drawing, input, place, plots};
use crate::report::html::{bar, facts, header, scene, shell};
use crate::report::plot::Plots;
use crate::report::quantity::{escape, significant};
use crate::report::verdict::{Sort, Verdict};
use crate::studies::kinematics::Kinematics;
use std::fmt::Write as _;

/// Everything that goes into the page.
#[derive(Clone, Copy, Debug)]
pub struct KinematicsReport<'a> {
    /// Study that is reported.
    pub found: &'a Kinematics,
    /// Name of the scene.
    pub name: &'a str,
    /// SHA-256 of the canonical scene.
    pub hash: &'a str,
    /// The scene's text, shown as it is.
    pub scene: &'a str,
    /// Version of `dam`.
    pub version: &'a str,
}

/// The page.
pub fn page(report: &KinematicsReport<'_>) -> String {
    let found = report.found;
    let subtitle = format!("kinematics of {}, {}", found.object, found.motion);
    let mut body = header(report.name, &subtitle, Some(&answer(found)));
    body.push_str("<main>\n");
    for warning in &found.warnings {
        let _ = writeln!(body, "<p class=\"soft\">Warning: {}</p>", escape(warning));
    }
    body.push_str(&drawing(found).section("mechanism"));
    body.push_str(&structure(found));
    body.push_str(&strokes(found));
    body.push_str(&transmission(found));
    let mut charts = Plots::default();
    for group in plots::groups(found) {
        let _ = writeln!(
            body,
            "<h2>{}</h2>\n{}<div class=\"plots\" style=\"--rows:{}\">",
            group.title,
            bar("course"),
            group.charts.len().div_ceil(2)
        );
        for chart in &group.charts {
            body.push_str(&charts.figure(chart, plots::SIZE, "course"));
        }
        body.push_str("</div>\n");
    }
    body.push_str(&equilibria(found));
    body.push_str(&extremes(found));
    body.push_str(&scene(report.scene));
    body.push_str("</main>\n");
    let rows = [
        ("Scene", report.name.to_owned()),
        ("SHA-256 of the canonical scene", report.hash.to_owned()),
        ("Program", format!("dam {}", report.version)),
    ];
    let _ = write!(
        body,
        "<footer>\n<h2>Provenance</h2>\n{}</footer>\n",
        facts(&rows)
    );
    shell(report.name, &body, &charts.json())
}

/// Where it stops, or how far its outputs and links go.
fn answer(found: &Kinematics) -> Verdict {
    if let Some(stop) = &found.stopped {
        let headline = format!("The mechanism stops at {}.", place(found, stop.at));
        let text = format!("Input {}: {}", input(found, stop.input), stop.cause);
        return Verdict::answer(Sort::Mechanism, headline, text);
    }
    let stroke = |stroke: &crate::studies::kinematics::Stroke| {
        let [low, high] = stroke.ends;
        format!("{} {}", stroke.owner, angle_or(high.1 - low.1, stroke.unit))
    };
    let strokes: Vec<String> = found.strokes.iter().take(3).map(stroke).collect();
    let text = match strokes.is_empty() {
        true => String::new(),
        false => format!("Strokes: {}.", strokes.join(", ")),
    };
    let headline = format!("It goes through all {} positions.", found.axis.values.len());
    Verdict::answer(Sort::Good, headline, text)
}

fn structure(found: &Kinematics) -> String {
    let structure = found.linkage.structure();
    let mut groups = String::new();
    for group in 0..structure.groups.len() {
        let _ = writeln!(groups, "<li>{}</li>", escape(&structure.describe(group)));
    }
    format!(
        "<h2>Structure</h2>\n<p>{}</p>\n<ol>\n{groups}</ol>\n<p>Input: {}.</p>\n",
        escape(&structure.explanation),
        escape(&reach(found))
    )
}

fn strokes(found: &Kinematics) -> String {
    if found.strokes.is_empty() {
        return String::new();
    }
    let mut rows = String::new();
    for stroke in &found.strokes {
        let [low, high] = stroke.ends;
        let [rise, fall] = stroke.rise_and_return;
        let _ = writeln!(
            rows,
            "<tr><th>{}</th><td>{}<span class=\"sub\">at {}</span></td><td>{}<span class=\"sub\">at \
             {}</span></td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>",
            escape(&stroke.owner),
            angle_or(low.1, stroke.unit),
            input(found, low.0),
            angle_or(high.1, stroke.unit),
            input(found, high.0),
            angle_or(high.1 - low.1, stroke.unit),
            input(found, rise),
            input(found, fall),
            significant(stroke.time_ratio, 6)
        );
    }
    format!(
        "<h2>Strokes</h2>\n<div class=\"scroll\"><table>\n<thead><tr><th>of</th><th>least</th>\
         <th>greatest</th><th>stroke</th><th>input while rising</th><th>input while falling</th>\
         <th>time ratio</th></tr></thead>\n<tbody>\n{rows}</tbody></table></div>\n"
    )
}

fn transmission(found: &Kinematics) -> String {
    if found.transmission.is_empty() {
        return String::new();
    }
    let mut rows = String::new();
    for angle in &found.transmission {
        let _ = writeln!(
            rows,
            "<tr><th>{}</th><td>{}<span class=\"sub\">at {}</span></td><td>{}<span class=\"sub\">at \
             {}</span></td></tr>",
            escape(&angle.owner),
            angle_or(angle.least.1, "rad"),
            place(found, angle.least.0),
            angle_or(angle.greatest.1, "rad"),
            place(found, angle.greatest.0)
        );
    }
    format!(
        "<h2>Transmission angles</h2>\n<div class=\"scroll\"><table>\n<thead><tr><th>dyad</th>\
         <th>least</th><th>greatest</th></tr></thead>\n<tbody>\n{rows}</tbody></table></div>\n\
         <p class=\"soft\">90 deg is best; at 0 the pushed link is in a dead position.</p>\n"
    )
}

fn equilibria(found: &Kinematics) -> String {
    if found.equilibria.is_empty() {
        return String::new();
    }
    let rows = found.equilibria.iter().map(|rest| {
        format!(
            "<tr><th>{}</th><td class=\"left\">{}</td></tr>\n",
            input(found, rest.at),
            escape(&behaviour(rest))
        )
    });
    format!(
        "<h2>Equilibria</h2>\n<div class=\"scroll\"><table>\n<thead><tr><th>input</th>\
         <th class=\"left\">a small push</th></tr></thead>\n<tbody>\n{}</tbody></table></div>\n\
         <p class=\"soft\">The linkage alone, its input free and nothing on its outputs.</p>\n",
        rows.collect::<String>()
    )
}

fn extremes(found: &Kinematics) -> String {
    let mut rows = String::new();
    for (column, extremes) in found.columns.iter().zip(&found.extremes) {
        let end = |(at, value): (f64, f64)| {
            let value = angle_or(value, &column.unit);
            format!(
                "<td>{value}<span class=\"sub\">at {}</span></td>",
                place(found, at)
            )
        };
        let _ = writeln!(
            rows,
            "<tr><th>{}</th>{}{}</tr>",
            escape(&column.name()),
            end(extremes.least),
            end(extremes.greatest)
        );
    }
    format!(
        "<h2>Extremes</h2>\n<details>\n<summary>all quantities</summary>\n<div class=\"scroll \
         tall\"><table>\n<thead><tr><th>quantity</th><th>least</th><th>greatest</th></tr></thead>\n\
         <tbody>\n{rows}</tbody></table></div>\n</details>\n"
    )
}
