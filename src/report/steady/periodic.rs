//! The periodic motion of elastic objects as text, table and pictures.

use super::picture::picture;
use crate::analysis::steady::{LongRun, PartMotion, PeriodicAnswer, Stability};
use crate::report::html::facts;
use crate::report::plot::{Axis, Look, Mark, Plot, Plots, Series, Shape};
use crate::report::quantity::{escape, significant};
use std::fmt::Write as _;

/// Multipliers listed.
const LISTED: usize = 12;

fn long_run(run: &LongRun) -> String {
    match &run.missing {
        Some(why) => format!("none: {why}"),
        None if run.settles => format!(
            "{} turns from the scene's start settle on it, {:.1e} of its size away",
            run.turns, run.distance
        ),
        None => format!(
            "{} turns from the scene's start do NOT settle on it: {:.1e} of its size away",
            run.turns, run.distance
        ),
    }
}

fn lines(part: &PartMotion) -> Vec<(&'static str, String)> {
    let turns = match part.periods {
        1 => "one turn of the drive".to_owned(),
        count => format!("{count} turns of the drive"),
    };
    let stability = match part.stability {
        Stability::Attracts => "attracts: every small disturbance dies away",
        Stability::Neutral => "neutral: small disturbances stay, nothing damps them",
        Stability::Repels => "repels: some small disturbances grow",
    };
    let shown = part.multipliers.iter().take(LISTED).map(|multiplier| {
        let re = significant(multiplier.re, 8);
        match multiplier.im {
            0.0 => re,
            im if im > 0.0 => format!("{re} + {}i", significant(im, 8)),
            im => format!("{re} − {}i", significant(-im, 8)),
        }
    });
    let mut multipliers = shown.collect::<Vec<_>>().join(", ");
    if part.multipliers.len() > LISTED {
        let _ = write!(
            multipliers,
            " and {} smaller",
            part.multipliers.len() - LISTED
        );
    }
    vec![
        (
            "period",
            format!("{} s, {turns}", significant(part.period, 10)),
        ),
        ("stability", stability.to_owned()),
        ("Floquet multipliers", multipliers),
        ("derivative by", part.how.clone()),
        (
            "comes back to",
            format!(
                "{:.1e} of its size, {} periods followed",
                part.miss, part.iterations
            ),
        ),
        ("long run", long_run(&part.long_run)),
    ]
}

/// All that is known of the motion.
pub fn periodic_text(title: &str, answer: &PeriodicAnswer) -> String {
    let mut text = format!("{title}\n");
    for part in &answer.parts {
        let _ = writeln!(text, "\nPeriodic motion of {}", part.objects.join(", "));
        for (name, value) in lines(part) {
            let _ = writeln!(text, "  {name:<20}  {value}");
        }
    }
    let _ = writeln!(text, "\nState at t = 0");
    let width = answer
        .state_names
        .iter()
        .map(|name| name.chars().count())
        .max();
    let width = width.unwrap_or(0);
    for (name, value) in answer.state_names.iter().zip(&answer.state) {
        let _ = writeln!(text, "  {name:<width$}  {}", significant(*value, 14));
    }
    text
}

/// Size of the picture of the unit circle, in which it is round (pixels).
const CIRCLE: (f64, f64) = (420.0, 460.0);

/// The multipliers in the unit circle.
fn circle(part: &PartMotion) -> Plot {
    let points = (0..=180).map(|i| (f64::from(i) * 2.0f64.to_radians()).sin_cos());
    let mark = |note: String| Mark {
        shape: Shape::Cross,
        note,
    };
    let multipliers = &part.multipliers;
    let found = Series {
        look: Look::Points,
        marks: multipliers
            .iter()
            .map(|m| {
                mark(format!(
                    "{} + {}i",
                    significant(m.re, 6),
                    significant(m.im, 6)
                ))
            })
            .collect(),
        ..Series::line(
            "multipliers",
            multipliers.iter().map(|m| (m.re, m.im)).collect(),
        )
    };
    Plot {
        title: format!("Floquet multipliers of {}", part.objects.join(", ")),
        plane: true,
        series: vec![
            found,
            Series::line("unit circle", points.map(|(sin, cos)| (cos, sin)).collect()),
        ],
        ..Plot::default()
    }
}

/// Deviations over a period.
fn orbit(part: &PartMotion) -> Plot {
    Plot {
        title: format!(
            "Deviation from the law over a period: {}",
            part.objects.join(", ")
        ),
        y: Axis::of(&part.unit),
        series: part
            .orbit
            .iter()
            .map(|(label, points)| Series::line(label, points.clone()))
            .collect(),
        ..Plot::default()
    }
}

/// The section of a page.
pub(super) fn section(answer: &PeriodicAnswer, plots: &mut Plots) -> String {
    let mut body = String::new();
    for part in &answer.parts {
        let _ = write!(
            body,
            "<h2>{}</h2>\n{}",
            escape(&part.objects.join(", ")),
            facts(&lines(part))
        );
        body.push_str(&picture(plots, &orbit(part), (1184.0, 360.0)));
        body.push_str(&picture(plots, &circle(part), CIRCLE));
    }
    body
}
