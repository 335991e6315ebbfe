//! The bar of colours and the legend of verdicts.

use super::colour::{SHADES, Values, colour};
use super::verdict::{hatching, plain};
use super::{Frame, coordinate};
use crate::analysis::map::{MapResult, Study, Verdict};
use crate::report::quantity::escape;
use std::collections::BTreeMap;
use std::fmt::Write as _;

const ROW: f64 = 24.0;

/// The bar of colours with its values.
pub(super) fn bar(values: &Values, frame: Frame) -> String {
    let step = frame.height / SHADES as f64;
    let (x, width) = (coordinate(frame.left), coordinate(frame.width));
    let mut out = String::from("<g shape-rendering=\"crispEdges\">\n");
    for shade in 0..SHADES {
        let y = frame.top + frame.height - step * (shade + 1) as f64;
        let _ = writeln!(
            out,
            "<rect x=\"{x}\" y=\"{}\" width=\"{width}\" height=\"{}\" fill=\"{}\"/>",
            coordinate(y),
            coordinate(step + 0.3),
            colour(shade)
        );
    }
    out.push_str("</g>\n");
    for (value, label) in values.levels((frame.height / 34.0) as usize) {
        let y = coordinate(frame.y(values.share(value)));
        let _ = writeln!(
            out,
            "<path class=\"tick\" d=\"M{} {y}h4\"/><text x=\"{}\" y=\"{y}\" dy=\"4\">{}</text>",
            coordinate(frame.left + frame.width),
            coordinate(frame.left + frame.width + 7.0),
            escape(&label)
        );
    }
    let name = match (values.sizes, last_name(values.title())) {
        (true, name) => format!("|{name}|"),
        (false, name) => name,
    };
    let _ = writeln!(
        out,
        "<text class=\"panel\" x=\"{x}\" y=\"{}\">{}</text>",
        coordinate(frame.top - 9.0),
        escape(&name)
    );
    out
}

/// `delta_max` of `rocker.delta_max`: the bar has little room.
fn last_name(figure: &str) -> String {
    let name = figure.rsplit('.').next().unwrap_or(figure);
    match name {
        "delta_abs" => "|δ| max".to_owned(),
        "delta_max" => "δ max".to_owned(),
        "delta_min" => "δ min".to_owned(),
        "sigma" => "σ".to_owned(),
        other => other.replace('_', " "),
    }
}

/// What the hatchings mean, and how often they occur; with its height.
pub(super) fn legend(study: &Study<'_>, result: &MapResult, width: f64, top: f64) -> (String, f64) {
    let mut counts: BTreeMap<Verdict, usize> = BTreeMap::new();
    let (mut edge, mut undetermined) = ([false; 2], 0);
    for cell in result.panels.iter().flatten().flatten() {
        undetermined += usize::from(cell.determined == Some(false));
        *counts.entry(cell.verdict).or_insert(0) += 1;
        if let Some(margin) = cell.rigid_margin {
            edge[usize::from(margin < 0.0)] = true;
        }
    }
    let occurring = Verdict::ALL
        .iter()
        .filter_map(|verdict| Some((verdict, counts.get(verdict)?)));
    let mut entries: Vec<(String, String)> = occurring
        .map(|(&verdict, count)| {
            (
                swatch(verdict, study.y.is_some()),
                format!("{} ({count})", verdict.words()),
            )
        })
        .collect();
    if undetermined > 0 {
        let ring = "<circle class=\"undetermined\" cx=\"13\" cy=\"8\" r=\"3.6\"/>";
        let words = format!("not determined to {} digits ({undetermined})", study.digits);
        entries.push((ring.to_owned(), words));
    }
    if edge == [true; 2] {
        let line = "<path class=\"edge-back\" d=\"M0 8h26\"/><path class=\"edge\" d=\"M0 8h26\"/>";
        entries.push((
            line.to_owned(),
            "lift-off edge of the rigid mechanism".to_owned(),
        ));
    }
    let (mut out, mut x, mut row) = (String::new(), 16.0, 0.0);
    for (picture, text) in &entries {
        let room = 54.0 + 6.6 * text.chars().count() as f64;
        if x > 16.0 && x + room > width {
            (x, row) = (16.0, row + 1.0);
        }
        let y = top + ROW * row;
        let _ = writeln!(
            out,
            "<g transform=\"translate({} {})\">{picture}<text x=\"33\" y=\"12\">{}</text></g>",
            coordinate(x),
            coordinate(y),
            escape(text)
        );
        x += room;
    }
    (out, ROW * (row + 1.0))
}

/// A sample of how a verdict looks: on a colour of values in maps.
fn swatch(verdict: Verdict, map: bool) -> String {
    let rect = "width=\"26\" height=\"16\"";
    let ground = match (map, plain(verdict)) {
        (true, _) if !without_value(verdict) => colour(SHADES * 6 / 10),
        (_, own) => own.to_owned(),
    };
    let mut out =
        format!("<rect {rect} fill=\"{ground}\" stroke=\"#5a6572\" stroke-width=\".6\"/>");
    if let Some(name) = hatching(verdict) {
        let _ = write!(out, "<rect {rect} fill=\"url(#{name})\"/>");
    }
    out
}

fn without_value(verdict: Verdict) -> bool {
    matches!(
        verdict,
        Verdict::Stopped | Verdict::NumericalFailure | Verdict::Refused
    )
}
