//! A synthesised stroke as findings and rows.

use super::curve::{Curve, DIAGRAM_POINTS, rows};
use crate::kinematics::motion::stroke::Stroke;
use crate::math::jet::Jet;
use crate::report::csv::Rows;
use crate::report::findings::{Figure, Findings, Section, Source, Value};
use crate::report::plot::Axis;
use crate::report::quantity::{DIGITS, significant};
use crate::report::sentence::Sentence;
use crate::report::verdict::{Sort, Verdict, capitalised};

/// What stands behind the figures of a stroke.
#[derive(Clone, Copy, Debug, Default)]
pub struct StrokeExtras {
    /// What its uniform section changes of the greatest Π′, |Π″| and |Π′Π″| (shares).
    pub against_none: Option<[f64; 3]>,
    /// The criterion that its skewness makes least.
    pub criterion: Option<f64>,
}

impl StrokeExtras {
    fn sections(self) -> Vec<Section<'static>> {
        let mut sections = Vec::new();
        if let Some(changes) = self.against_none {
            let names = ["greatest Π′", "greatest |Π″|", "greatest |Π′Π″|"];
            let figure = |(name, change): (&str, f64)| {
                let sign = if change < 0.0 { "" } else { "+" };
                Figure::new(name, format!("{sign}{} %", significant(100.0 * change, 5)))
            };
            let figures = names.into_iter().zip(changes).map(figure).collect();
            sections.push(Section::new("Against no uniform section").figures(figures));
        }
        if let Some(value) = self.criterion {
            let figure = Figure::number("criterion", value, "", 10);
            sections.push(Section::new("Skewness").figures(vec![figure]));
        }
        sections
    }
}

/// Structure and criteria of a stroke, whose laws are named by `words`; `unit` is that of its
/// displacement, `extras` stand behind its own figures.
pub fn stroke_findings(
    words: &str,
    stroke: &Stroke,
    unit: &str,
    extras: StrokeExtras,
) -> Findings<'static> {
    let found = stroke.figures();
    let headline = Sentence::from("Stroke ")
        .angle_or(found.stroke, unit, DIGITS)
        .words(" in ")
        .angle_or(found.span, "rad", DIGITS)
        .words(", greatest speed ")
        .quantity(found.peak_speed, &format!("{unit}/rad"), DIGITS)
        .words(".");
    let second = format!("{unit}/rad²");
    let text = Sentence::from("Greatest acceleration Π″ ")
        .quantity(found.acceleration_run_up, &second, DIGITS)
        .words(" in the run-up and ")
        .quantity(found.acceleration_run_out, &second, DIGITS)
        .words(" in the run-out.");
    let mut sections = vec![
        curve(stroke, unit).section(&words.replace('_', " ")),
        Section::new("Results").figures(figures(stroke, unit)),
    ];
    sections.extend(extras.sections());
    Findings {
        title: capitalised(&words.replace('_', " ")),
        subtitle: "a stroke of run-up, uniform section and run-out".to_owned(),
        answer: Some(Verdict::answer(Sort::Good, headline, text)),
        warnings: Vec::new(),
        sections,
        source: Source::default(),
    }
}

fn figures(stroke: &Stroke, unit: &str) -> Vec<Figure> {
    let found = stroke.figures();
    let per = |power: &str| format!("{unit}/rad{power}");
    let product = format!("{unit}²/rad³");
    let rows: [(&str, f64, &str); 18] = [
        ("stroke Π_III", found.stroke, unit),
        ("span φ_III", found.span, "rad"),
        ("skewness f", found.skewness, ""),
        ("uniform share of stroke ζ_Π", found.uniform_stroke, ""),
        ("uniform share of span ζ_φ", found.uniform_span, ""),
        ("ν₁", found.speed_ratio, ""),
        ("ν₂", found.law_acceleration_ratio, ""),
        ("U", found.u, ""),
        ("run-up ends at φ_I", found.angle_run_up, "rad"),
        ("run-out begins at φ_II", found.angle_run_out, "rad"),
        ("Π_I", found.stroke_run_up, unit),
        ("Π_II", found.stroke_run_out, unit),
        ("greatest speed Π′", found.peak_speed, &per("")),
        ("run-up: greatest Π″", found.acceleration_run_up, &per("²")),
        (
            "run-out: greatest |Π″|",
            found.acceleration_run_out,
            &per("²"),
        ),
        ("run-up: greatest Π′Π″", found.product_run_up, &product),
        ("run-out: greatest |Π′Π″|", found.product_run_out, &product),
        ("acceleration ratio λ", found.acceleration_ratio, ""),
    ];
    let figure = |(name, value, unit): (&str, f64, &str)| {
        Figure::new(name, Value::angle_or(value, unit, 10))
    };
    rows.into_iter().map(figure).collect()
}

/// Samples over the span with both sides of the ends of the sections.
fn sample_stroke(stroke: &Stroke, count: usize) -> Vec<(f64, Jet)> {
    let figures = stroke.figures();
    let count = count.max(1);
    let steps = (0..=count).map(|i| figures.span * i as f64 / count as f64);
    let ends = [figures.angle_run_up, figures.angle_run_out];
    let mut places: Vec<f64> = steps.chain(ends).collect();
    places.sort_by(f64::total_cmp);
    places.dedup();
    let mut rows = Vec::new();
    for phi in places {
        let [before, after] = stroke.sides(phi);
        if phi > 0.0 {
            rows.push((phi, before));
        }
        if phi == 0.0 || phi < figures.span && before != after {
            rows.push((phi, after));
        }
    }
    rows
}

/// Π and its derivatives: `count` equal steps, both sides of every jump.
pub fn stroke_rows(stroke: &Stroke, unit: &str, count: usize) -> Rows {
    rows(["phi", "Pi"], [unit, "rad"], &sample_stroke(stroke, count))
}

fn curve<'a>(stroke: &Stroke, unit: &'a str) -> Curve<'a> {
    let found = stroke.figures();
    let rows = sample_stroke(stroke, DIAGRAM_POINTS);
    let acceleration = found.acceleration_run_up.abs();
    let acceleration = acceleration.max(found.acceleration_run_out);
    let jerks = rows.iter().map(|row| row.1.third.abs());
    let jerk = jerks.fold(0.0, f64::max);
    Curve {
        rows,
        symbol: "Π",
        x: Axis::new("φ", "rad"),
        unit,
        sizes: [
            found.stroke.abs(),
            found.peak_speed.abs(),
            acceleration,
            jerk,
        ],
    }
}
