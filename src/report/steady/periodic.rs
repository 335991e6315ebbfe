//! The periodic motion of elastic objects as text, table and pictures.

use super::picture::list;
use super::picture::picture;
use super::text::Line;
use super::text::at;
use super::text::flywheel_lines;
use super::text::value;
use crate::dynamics::steady::Extreme;
use crate::report::csv::number;
use crate::report::csv::write;
use crate::report::html::facts;
use crate::report::plot::{Axis, Look, Mark, Plot, Plots, Series, Shape};
use crate::report::quantity::{escape, significant};
use crate::studies::steady::DriveFigures;
use crate::studies::steady::DriveRow;
use crate::studies::steady::LongRun;
use crate::studies::steady::PartMotion;
use crate::studies::steady::PeriodicAnswer;
use crate::studies::steady::Stability;
use std::fmt::Write as _;

/// Multipliers listed.
const LISTED: usize = 12;

fn long_run(run: &LongRun, cycle: f64) -> String {
    let turns = match cycle == std::f64::consts::TAU {
        true => "turns",
        false => "cycles",
    };
    match &run.missing {
        Some(why) => format!("none: {why}"),
        None if run.settles => format!(
            "{} {turns} from the scene's start settle on it, {} of its size away",
            run.turns,
            significant(run.distance, 2)
        ),
        None => format!(
            "{} {turns} from the scene's start do NOT settle on it: {} of its size away",
            run.turns,
            significant(run.distance, 2)
        ),
    }
}

fn lines(part: &PartMotion, cycle: f64) -> Vec<(&'static str, String)> {
    let turns = match part.periods as f64 * cycle / std::f64::consts::TAU {
        1.0 => "one turn of the drive".to_owned(),
        count => format!("{} turns of the drive", significant(count, 7)),
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
                "{} of its size, {} periods followed",
                significant(part.miss, 2),
                part.iterations
            ),
        ),
        ("long run", long_run(&part.long_run, cycle)),
    ]
}

/// How the drive turns.
fn drive_lines(drive: &DriveFigures) -> Vec<Line> {
    let turns = significant(drive.means.time * 60.0 / std::f64::consts::TAU, 8);
    let mean = significant(drive.means.time, 10);
    let speed = |name: &str, of: f64| value(name, of, "rad/s");
    let extreme = |name: &str, of: Extreme| at(name, [of.value, of.at], "rad/s");
    let why = match drive.balance {
        Some(_) => "asked for, held by a constant moment",
        None => "a result: motor and load decide",
    };
    let mut lines = vec![
        (
            "mean speed".to_owned(),
            format!("{mean} rad/s = {turns} rpm ({why})"),
        ),
        speed("mean over the angle", drive.means.angle),
        speed("midway between extremes", drive.means.midrange),
        extreme("least speed", drive.least_speed),
        extreme("greatest speed", drive.greatest_speed),
        speed("speed at φ = 0", drive.speed_at_start),
        value("fluctuation δ", drive.fluctuation, ""),
    ];
    lines.extend(
        drive
            .balance
            .map(|moment| value("moment beside the motor", moment, "N·m")),
    );
    lines.extend(drive.flywheel.iter().flat_map(flywheel_lines));
    lines
}

/// ω and ε over the angle.
fn drive_charts(drive: &DriveFigures) -> [Plot; 2] {
    let curve = |of: &dyn Fn(&DriveRow) -> f64| {
        let points = (drive.rows.iter()).map(|row| (row.position.to_degrees(), of(row)));
        Series::line("", points.collect())
    };
    let chart = |title: String, unit: &str, curve: Series| Plot {
        title,
        y: Axis::of(unit),
        series: vec![curve],
        x: Axis::new("φ", "deg"),
        ..Plot::default()
    };
    [
        chart(
            format!("Angular speed ω of {}", drive.id),
            "rad/s",
            curve(&|row| row.speed),
        ),
        chart(
            format!("Angular acceleration ε of {}", drive.id),
            "rad/s²",
            curve(&|row| row.acceleration),
        ),
    ]
}

/// The motion of a machine on its motor over the drive's angle: what the drive does, and
/// the deviations.
///
/// # Errors
/// Never in practice: writing into memory.
pub fn drive_csv(answer: &PeriodicAnswer, drive: &DriveFigures) -> Result<String, csv::Error> {
    let header = ["phi [rad]", "t [s]", "omega [rad/s]", "epsilon [rad/s^2]"];
    let parts = answer.parts.iter();
    let deviations = parts.flat_map(|part| {
        let unit = match part.unit.as_str() {
            "" => String::new(),
            unit => format!(" [{unit}]"),
        };
        let names = part.orbit.iter();
        names.map(move |(name, _)| format!("{name}: deviation{unit}"))
    });
    let rows = drive.rows.iter().map(|row| {
        let own = [row.position, row.time, row.speed, row.acceleration];
        let all = own.iter().chain(&row.deviations);
        all.map(|&one| number(one)).collect::<Vec<_>>()
    });
    write(
        header.map(str::to_owned).into_iter().chain(deviations),
        rows,
    )
}

/// All that is known of the motion.
pub fn periodic_text(title: &str, answer: &PeriodicAnswer) -> String {
    let mut text = format!("{title}\n");
    if let Some(drive) = &answer.drive {
        let _ = writeln!(text, "\nSteady motion of {}", drive.id);
        for (name, value) in drive_lines(drive) {
            let _ = writeln!(text, "  {name:<23}  {value}");
        }
    }
    for part in &answer.parts {
        let _ = writeln!(text, "\nPeriodic motion of {}", part.objects.join(", "));
        for (name, value) in lines(part, answer.cycle) {
            let _ = writeln!(text, "  {name:<20}  {value}");
        }
    }
    let start = match answer.drive {
        Some(_) => "φ = 0",
        None => "t = 0",
    };
    let _ = writeln!(text, "\nState at {start}");
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
    if let Some(drive) = &answer.drive {
        let _ = write!(body, "<h2>Figures</h2>\n{}", list(&drive_lines(drive)));
        for chart in drive_charts(drive) {
            body.push_str(&picture(plots, &chart, (1184.0, 340.0)));
        }
    }
    for part in &answer.parts {
        let _ = write!(
            body,
            "<h2>{}</h2>\n{}",
            escape(&part.objects.join(", ")),
            facts(&lines(part, answer.cycle))
        );
        body.push_str(&picture(plots, &orbit(part), (1184.0, 360.0)));
        body.push_str(&picture(plots, &circle(part), CIRCLE));
    }
    body
}
