//! Pages that open without a network: style, script and data are in them.
//!
//! One player (`player.rs`, `player.js`) moves all drawings: parts are placed anew by tables
//! over rows or coordinates, turns and slides. It saves them as SVG that runs by itself and as
//! animated GIF (`picture.js`); images of the page itself (`data:`) are let in for the frames.

pub(in crate::report) mod player;
pub mod runs;

use crate::report::addresses::in_words;
use crate::report::diagram::Diagram;
use crate::report::display_units;
use crate::report::mechanism;
use crate::report::plot::{Plots, page::SCRIPT, palette};
use crate::report::quantity::{escape, readable_scale, significant};
use crate::report::sentence::Sentence;
use crate::report::svg::graph;
use crate::report::symbols::{Setting, symbols};
use crate::report::verdict::{Sort, Verdict};

/// The style of pages.
pub(in crate::report) const STYLE: &str = include_str!("style.css");
/// What writes pictures of a page as files.
const PICTURE: &str = include_str!("picture.js");
/// The buttons that save charts.
const SAVES: &str = include_str!("saves.js");
/// The player of what moves, behind what writes its pictures as files.
pub(in crate::report) const PLAYER: &str =
    concat!(include_str!("picture.js"), include_str!("player.js"));

/// A complete document around `body`, with the data of its plots, with the player where something
/// moves and with buttons that save where there are charts.
pub(in crate::report) fn shell(title: &str, body: &str, data: &str) -> String {
    let moves = body.contains("<figure class=\"moving\"");
    let charts = body.contains("<div class=\"chart");
    let picture = match (moves, charts) {
        (true, _) => PLAYER,
        (false, true) => PICTURE,
        (false, false) => "",
    };
    let saves = if charts { SAVES } else { "" };
    let more = match [picture, saves].concat() {
        none if none.is_empty() => none,
        scripts => format!("<script>\n{scripts}</script>\n"),
    };
    let moving = if moves { mechanism::STYLE } else { "" };
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; \
         style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:\">\n\
         <meta name=\"generator\" content=\"dam\">\n\
         <title>{}</title>\n<style>\n{}{}{STYLE}{moving}</style>\n</head>\n<body>\n{body}\
         <script id=\"data\" type=\"application/json\">{data}</script>\n\
         <script>\n{SCRIPT}</script>\n{more}</body>\n</html>\n",
        escape(title),
        palette::of_page(),
        palette::STYLE,
    )
}

/// Title, subtitle and verdict.
pub(in crate::report) fn header(title: &str, subtitle: &str, verdict: Option<&Verdict>) -> String {
    let verdict = verdict.map_or(String::new(), verdict_banner);
    format!(
        "<header>\n<h1>{}</h1>\n<p class=\"subtitle\">{}</p>\n{verdict}</header>\n\
         <noscript><main><p>The small script that zooms the plots of this page and moves its \
         drawings is switched off here; everything is shown all the same.</p></main></noscript>\n",
        escape(title),
        escape(subtitle)
    )
}

/// The answer in a sentence.
pub(in crate::report) fn verdict_banner(verdict: &Verdict) -> String {
    let (class, sort) = match verdict.sort {
        Sort::Good if verdict.judgement.is_none() => ("good", "Result"),
        Sort::Good => ("good", "Mechanism"),
        Sort::Mechanism => ("mechanism", "Mechanism"),
        Sort::Numerical => ("numerical", "Computation"),
        Sort::Unfinished => ("unfinished", "Run"),
        Sort::Recommended => ("good", "Recommendation"),
    };
    format!(
        "<p class=\"verdict {class}\"><span class=\"sort\">{sort}</span><b>{}</b> {}</p>\n",
        verdict.headline.html(),
        verdict.following_sentence().html()
    )
}

/// The place of the buttons that zoom the charts of a link, and of words on how.
pub(in crate::report) fn bar(link: &str) -> String {
    format!("<div class=\"bar\" data-zoom=\"{}\"></div>\n", escape(link))
}

/// The list of warnings; nothing without any.
pub(in crate::report) fn warnings(warnings: &[String]) -> String {
    if warnings.is_empty() {
        return String::new();
    }
    let item =
        |warning: &String| format!("<li>{}</li>\n", Sentence::read(&in_words(warning)).html());
    let items: String = warnings.iter().map(item).collect();
    format!("<h2>Warnings</h2>\n<ul class=\"warnings\">\n{items}</ul>\n")
}

/// The section with the object graph.
pub(in crate::report) fn mechanism(diagram: &Diagram, plots: &Plots) -> String {
    format!(
        "<h2>Mechanism</h2>\n<div class=\"graph scroll\">\n{}</div>\n\
         <p class=\"soft\">Solid arrows carry the motion φ, φ̇ to what is driven; dashed ones \
         bring the force Ω back to the driver.</p>\n",
        graph::diagram_with_links(diagram, plots)
    )
}

/// Longest text of a scene that stands on a page (bytes).
const MOST_OF_SCENE: usize = 1_000_000;

/// The scene as it was written.
pub(in crate::report) fn scene(text: &str) -> String {
    let lines = text.lines().count();
    if text.len() > MOST_OF_SCENE {
        let size = text.len() as f64 / 1e6;
        return format!(
            "<h2>Scene</h2>\n<p class=\"soft\">The scene has {size:.1} MB, too much for this page. \
             Its SHA-256 is stated below.</p>\n"
        );
    }
    let open = if lines <= 60 { " open" } else { "" };
    format!(
        "<h2>Scene</h2>\n<details{open}>\n<summary>{lines} lines of JSON</summary>\n\
         <pre>{}</pre>\n</details>\n",
        escape(text.trim_end())
    )
}

/// A list of names and texts.
pub(in crate::report) fn definition_list(rows: &[(&str, String)]) -> String {
    let row = |(name, text): &(&str, String)| ((*name).to_owned(), escape(text));
    fact_list(&rows.iter().map(row).collect::<Vec<_>>())
}

/// A list of names, and texts that are HTML already.
pub(in crate::report) fn fact_list(rows: &[(String, String)]) -> String {
    let row = |(name, text): &(String, String)| {
        format!("<dt>{}</dt><dd>{text}</dd>\n", name_with_symbols(name))
    };
    format!(
        "<dl class=\"facts\">\n{}</dl>\n",
        rows.iter().map(row).collect::<String>()
    )
}

/// A name with its symbols; no line ends within |δ|.
pub(in crate::report) fn name_with_symbols(name: &str) -> String {
    symbols(&escape(name), Setting::Page).replace("|δ|", "<span class=\"nobr\">|δ|</span>")
}

/// A number with its unit for reading, the full number on hover.
pub(in crate::report) fn number(value: f64, unit: &str, digits: usize) -> String {
    if value.is_nan() {
        return significant(value, digits);
    }
    let shown = readable_scale(value, unit);
    let joint = match &shown.unit {
        unit if unit.is_empty() => "",
        unit if unit.starts_with("10") => "·",
        _ => " ",
    };
    format!(
        "<span title=\"{value} {}\">{}{joint}<span class=\"unit\">{}</span></span>",
        escape(unit),
        significant(value / shown.factor, display_units::shown_digits(digits)),
        escape(&shown.unit)
    )
}
