//! A law of motion, a stroke, a cycle or a comparison as a page that opens without a network.

use super::{DIAGRAM_POINTS, Jet, Law, sampled};
use crate::kinematics::motion::stroke::Stroke;
use crate::kinematics::position::Position;
use crate::report::html::{bar, facts, header, scene, shell};
use crate::report::plot::{Axis, Look, Mark, Plot, Plots, Series, Shape};
use crate::report::quantity::{escape, significant};
use crate::report::verdict::{Sort, Verdict};
use crate::studies::law::{ComparedLaw, Figure};

/// Everything that goes into the page.
#[derive(Clone, Debug)]
pub struct LawPage<'a> {
    /// Name of the law, or of what follows it.
    pub title: &'a str,
    /// Subtitle: what was asked.
    pub subtitle: &'a str,
    /// The answer in a sentence, and whether it is good news.
    pub answer: (bool, String),
    /// All figures, as the terminal shows them.
    pub text: &'a str,
    /// The charts: the first over the whole width, the others beside each other.
    pub charts: &'a [Plot],
    /// The scene's text, shown as it is; `None`: there is no scene.
    pub scene: Option<&'a str>,
    /// SHA-256 of the canonical scene; may be empty.
    pub hash: &'a str,
    /// Version of `dam`.
    pub version: &'a str,
}

impl LawPage<'_> {
    /// The page.
    pub fn html(&self) -> String {
        let (good, text) = &self.answer;
        let verdict = Verdict {
            sort: if *good { Sort::Good } else { Sort::Mechanism },
            headline: text
                .split_inclusive(". ")
                .next()
                .unwrap_or("")
                .trim()
                .to_owned(),
            text: text
                .split_once(". ")
                .map_or(String::new(), |(_, rest)| rest.to_owned()),
        };
        let mut body = header(self.title, self.subtitle, Some(&verdict));
        let mut plots = Plots::default();
        body.push_str("<main>\n<h2>Diagrams</h2>\n");
        body.push_str(&bar("law"));
        for (index, chart) in self.charts.iter().enumerate() {
            if index == 1 {
                let rows = (self.charts.len() - 1).div_ceil(2);
                body.push_str(&format!("<div class=\"plots\" style=\"--rows:{rows}\">\n"));
            }
            let rows = chart.y.rows.len() as f64;
            let size = match index {
                0 if rows > 0.0 => [1184.0, 150.0 + 24.0 * rows],
                0 => [1184.0, 440.0],
                _ => [579.0, 270.0],
            };
            body.push_str(&plots.figure(chart, size, "law"));
        }
        if self.charts.len() > 1 {
            body.push_str("</div>\n");
        }
        body.push_str(&format!(
            "<h2>Figures</h2>\n<pre>{}</pre>\n",
            escape(self.text.trim_end())
        ));
        if let Some(text) = self.scene {
            body.push_str(&scene(text));
        }
        let mut rows = vec![("Program", format!("dam {}", self.version))];
        if !self.hash.is_empty() {
            rows.insert(0, ("SHA-256 of the canonical scene", self.hash.to_owned()));
        }
        body.push_str(&format!(
            "</main>\n<footer>\n<h2>Provenance</h2>\n{}</footer>\n",
            facts(&rows)
        ));
        shell(self.title, &body, &plots.json())
    }
}

/// Primes behind the symbol, and what they stand for.
type Part = (&'static str, fn(&Jet) -> f64);

/// Value and derivatives, each in a chart of its own.
fn parts(rows: &[(f64, Jet)], symbol: &str, x: &Axis, unit: &str, per: &str) -> Vec<Plot> {
    let list: [Part; 4] = [
        ("", |jet| jet.value),
        ("′", |jet| jet.first),
        ("″", |jet| jet.second),
        ("‴", |jet| jet.third),
    ];
    let power = ["", "", "²", "³"];
    let chart = |(order, (prime, part)): (usize, &Part)| Plot {
        title: format!("{symbol}{prime}"),
        x: x.clone(),
        y: Axis::of(&match (order, unit, per) {
            (0, unit, _) => unit.to_owned(),
            (_, "", "") => String::new(),
            (_, "", per) => format!("1/{per}{}", power[order]),
            (_, unit, per) => format!("{unit}/{per}{}", power[order]),
        }),
        series: vec![Series::line(
            "",
            rows.iter().map(|(x, jet)| (*x, part(jet))).collect(),
        )],
        ..Plot::default()
    };
    list.iter().enumerate().map(chart).collect()
}

/// A law's value and derivatives, stroke 1 in a time of 1.
pub fn law_parts(law: &Law) -> Vec<Plot> {
    parts(
        &sampled(law, DIAGRAM_POINTS),
        "θ",
        &Axis::new("τ", ""),
        "",
        "",
    )
}

/// A stroke's displacement and derivatives by the angle of the driver.
pub fn stroke_parts(stroke: &Stroke, unit: &str) -> Vec<Plot> {
    let rows = super::stroke::sampled(stroke, DIAGRAM_POINTS);
    parts(&rows, "Π", &Axis::new("φ", "rad"), unit, "rad")
}

/// A cycle's displacement and derivatives by the coordinate of the driver.
pub fn cycle_parts(position: &Position, lever: f64, [unit, driver]: [&str; 2]) -> Vec<Plot> {
    let rows = super::cycle::sampled(position, lever, 2 * DIAGRAM_POINTS);
    parts(&rows, "U", &Axis::new("φ", driver), unit, driver)
}

/// Laws compared: every figure as a multiple of the best law's, one row a law.
pub fn comparison_chart(laws: &[ComparedLaw]) -> Plot {
    let figures = Figure::ALL.into_iter().filter_map(|figure| {
        let places = figure.ranks(laws);
        let best = laws
            .iter()
            .zip(&places)
            .find(|(_, place)| **place == Some(1));
        let best = figure.of(best?.0)?;
        let mut points = Vec::new();
        let mut marks = Vec::new();
        for (row, law) in laws.iter().enumerate() {
            let Some(value) = figure.of(law).filter(|_| best != 0.0) else {
                continue;
            };
            points.push((value / best, row as f64 + 0.5));
            marks.push(Mark {
                shape: Shape::Good,
                note: format!(
                    "{}: {} = {}",
                    law.name,
                    figure.name(),
                    significant(value, 6)
                ),
            });
        }
        let series = Series {
            look: Look::Points,
            marks,
            ..Series::line(figure.name(), points)
        };
        (!series.points.is_empty()).then_some(series)
    });
    Plot {
        title: "Every figure as a multiple of the best law's".to_owned(),
        x: Axis {
            log: true,
            ..Axis::new("multiple of the best", "")
        },
        y: Axis {
            rows: laws.iter().map(|law| law.name.clone()).collect(),
            ..Axis::default()
        },
        series: figures.collect(),
        ..Plot::default()
    }
}

/// What is to be said of a law's shocks: nothing good or bad but that there are none.
pub fn shocks_said(jumps: &[crate::kinematics::motion::law::Jump]) -> (bool, &'static str) {
    match jumps.iter().map(|jump| jump.order).min() {
        Some(1) => (
            false,
            "Its speed jumps: a hard shock, that no mechanism bears.",
        ),
        Some(2) => (
            true,
            "Its acceleration jumps: a soft shock, that excites vibrations.",
        ),
        _ => (
            true,
            "Speed and acceleration are continuous: there is no shock.",
        ),
    }
}
