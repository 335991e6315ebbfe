//! The periodic motion of elastic objects.

use super::over_period;
use super::rigid::{estimates_section, flywheel_figures, mean_speed, value, value_at_place};
use crate::dynamics::steady::Extreme;
use crate::report::csv::{Field, Rows, column_heading};
use crate::report::findings::table::check_outcome;
use crate::report::findings::{Figure, Findings, Item, Layout, Section, Source, Table, Value};
use crate::report::plot::{Axis, Mark, Plot, Series, Shape};
use crate::report::quantity::{significant, with_unit};
use crate::report::verdict::{Verdict, capitalised};
use crate::studies::check::Check;
use crate::studies::judgement::Judgement;
use crate::studies::steady::{
    DriveFigures, DriveRow, LongRun, Multiplier, PartMotion, PeriodicAnswer, Stability,
};
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

fn figures(part: &PartMotion, cycle: f64) -> Vec<Figure> {
    let turns = match part.periods as f64 * cycle / std::f64::consts::TAU {
        1.0 => "one turn of the drive".to_owned(),
        count => format!("{} turns of the drive", significant(count, 7)),
    };
    let stability = match part.stability {
        Stability::Attracts => "attracts: every small disturbance dies away",
        Stability::Neutral => "neutral: small disturbances stay, nothing damps them",
        Stability::Repels => "repels: some small disturbances grow",
        Stability::Undecided => "not decided: a multiplier is 1 in modulus within its error",
    };
    let shown = part.multipliers.iter().take(LISTED).map(|multiplier| {
        let re = significant(multiplier.re, 8);
        let error = significant(multiplier.error, 2);
        match multiplier.im {
            0.0 => format!("{re} ± {error}"),
            im if im > 0.0 => format!("{re} + {}i ± {error}", significant(im, 8)),
            im => format!("{re} − {}i ± {error}", significant(-im, 8)),
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
        value("period", part.period, "s").with_note(turns),
        Figure::new("stability", stability),
        Figure::new("Floquet multipliers", multipliers),
        Figure::new("derivative by", part.how.as_str()),
        Figure::new("errors (±) by", part.checked_by.as_str()),
        Figure::new("periods followed", part.iterations.to_string()),
        Figure::new("long run", long_run(&part.long_run, cycle)),
    ]
}

/// How the drive turns.
fn drive_figures(drive: &DriveFigures) -> Vec<Figure> {
    let speed = |name: &str, of: f64| value(name, of, "rad/s");
    let extreme = |name: &str, of: Extreme| value_at_place(name, [of.value, of.at], "rad/s");
    let why = match drive.balance {
        Some(_) => "required, held by a constant moment",
        None => "a result: motor and load decide",
    };
    let mut figures = vec![
        mean_speed(drive.means.time, why),
        speed("mean over the angle", drive.means.angle),
        speed("midway between extremes", drive.means.midrange),
        extreme("least speed", drive.least_speed),
        extreme("greatest speed", drive.greatest_speed),
        speed("speed at φ = 0", drive.speed_at_start),
        value("fluctuation δ", drive.fluctuation, ""),
    ];
    let balance = drive.balance;
    figures.extend(balance.map(|moment| value("moment beside the motor", moment, "N m")));
    figures.extend(drive.flywheel.iter().flat_map(flywheel_figures));
    figures
}

/// ω and ε over the angle.
fn drive_charts(drive: &DriveFigures) -> [Plot; 2] {
    let chart = |quantity: &str, unit: &str, of: fn(&DriveRow) -> f64| {
        let points = (drive.rows.iter()).map(|row| (row.position.to_degrees(), of(row)));
        let curve = Series::line("", points.collect());
        Plot::over_angle(format!("{quantity} of {}", drive.id), unit, vec![curve])
    };
    [
        chart("Angular speed ω", "rad/s", |row| row.speed),
        chart("Angular acceleration ε", "rad/s²", |row| row.acceleration),
    ]
}

/// The motion as a table: of a machine on its motor over the drive's angle, with what the drive
/// does; else the deviations over a period, each value a row, since parts have periods of their
/// own.
pub fn periodic_rows(answer: &PeriodicAnswer) -> Rows {
    let Some(drive) = &answer.drive else {
        let all = answer.parts.iter().flat_map(|part| &part.orbit);
        let rows = all.flat_map(|(name, points)| {
            let row = |&(time, value): &(f64, f64)| {
                [Field::from(name.as_str()), time.into(), value.into()]
            };
            points.iter().map(row)
        });
        return Rows::new(["coordinate", "t [s]", "deviation"], rows);
    };
    let header = ["phi [rad]", "t [s]", "omega [rad/s]", "epsilon [rad/s^2]"];
    let deviations = answer.parts.iter().flat_map(|part| {
        let names = part.orbit.iter();
        names.map(|(name, _)| column_heading(&format!("{name}: deviation"), &part.unit))
    });
    let rows = drive.rows.iter().map(|row| {
        let own = [row.position, row.time, row.speed, row.acceleration];
        own.into_iter().chain(row.deviations.iter().copied())
    });
    Rows::new(
        header.map(str::to_owned).into_iter().chain(deviations),
        rows,
    )
}

/// Whether the motion is the one that comes about, and what is known of it.
pub fn periodic_findings<'a>(
    title: &str,
    answer: &PeriodicAnswer,
    source: Source<'a>,
) -> Findings<'a> {
    let mut sections = Vec::new();
    if let Some(drive) = &answer.drive {
        let section = Section::new(format!("Steady motion of {}", drive.id));
        let charts = drive_charts(drive).into();
        let section = section.figures(drive_figures(drive));
        sections.push(section.charts(Layout::Wide(340.0), "cycle", charts));
        sections.extend(drive.flywheel.as_ref().map(estimates_section));
    }
    for part in &answer.parts {
        let section = Section::new(format!("Periodic motion of {}", part.objects.join(", ")));
        let section = section.figures(figures(part, answer.cycle));
        let section = section.charts(Layout::Wide(360.0), "", vec![orbit(part)]);
        sections.push(section.charts(Layout::Round, "", vec![circle(part)]));
    }
    sections.extend(over_period::sections(answer));
    let start = match answer.drive {
        Some(_) => "State at φ = 0",
        None => "State at t = 0",
    };
    let state = answer.state_names.iter().zip(&answer.state);
    let state = state.map(|(name, value)| vec![name.as_str().into(), Value::new(*value, "", 14)]);
    let state = Table::new(["coordinate", ">value, SI"]).rows(state);
    sections.push(Section::new(start).item(Item::Folded("all coordinates".into(), state)));
    let subtitle = match &answer.drive {
        Some(drive) => format!(
            "steady motion on its motor, mean speed {}, δ = {}",
            with_unit(drive.means.time, "rad/s", 6),
            significant(drive.fluctuation, 5)
        ),
        None => "periodic motion behind the drive and its stability".to_owned(),
    };
    Findings {
        title: title.to_owned(),
        subtitle,
        answer: Some(verdict(answer)),
        warnings: answer.checks().iter().filter_map(Check::failure).collect(),
        sections,
        source,
    }
}

fn verdict(answer: &PeriodicAnswer) -> Verdict {
    let any = |stability| answer.parts.iter().any(|part| part.stability == stability);
    let judgement = answer.judgement();
    let headline = match judgement {
        Judgement::NotToBeTrusted => "A periodic motion was found that is not to be trusted.",
        Judgement::InWorkingOrder => "A periodic motion was found, and it is stable.",
        Judgement::NotInWorkingOrder | Judgement::NotJudged if any(Stability::Repels) => {
            "A periodic motion was found that repels its neighbours."
        }
        Judgement::NotInWorkingOrder => "A periodic motion was found in which a contact separates.",
        Judgement::NotJudged if !any(Stability::Undecided) => match answer.unsettled() {
            Some(part) if part.long_run.missing.is_none() => {
                "A periodic motion was found on which the scene does not settle from its own start."
            }
            Some(_) => {
                "A periodic motion was found. Whether the scene settles on it is not known: its \
                 long run ended early."
            }
            None => "A periodic motion was found. Whether a contact separates is not known.",
        },
        Judgement::NotJudged => "A periodic motion was found. Whether it is stable is not decided.",
    };
    let checks = answer.checks();
    let text = match checks.iter().find(|check| !check.passed()) {
        Some(failed) => format!("{}: {}.", capitalised(failed.name), check_outcome(failed)),
        None => format!("{} checks are within their bounds.", checks.len()),
    };
    Verdict::of_judgement(judgement, headline.to_owned(), text)
}

/// The multipliers in the unit circle.
fn circle(part: &PartMotion) -> Plot {
    let circle = (0..=180).map(|i| (f64::from(i) * 2.0f64.to_radians()).sin_cos());
    let circle = circle.map(|(sin, cos)| (cos, sin)).collect();
    let mark = |m: &Multiplier| {
        let [re, im] = [m.re, m.im].map(|part| significant(part, 6));
        let note = format!("{re} + {im}i, error {}", significant(m.error, 2));
        Mark::new(Shape::Good, note)
    };
    let all = part.multipliers.iter();
    let (points, marks) = all.map(|m| ((m.re, m.im), mark(m))).unzip();
    Plot {
        plane: true,
        ..Plot::new(
            format!("Floquet multipliers of {}", part.objects.join(", ")),
            Axis::default(),
            "",
            vec![
                Series::marked("multipliers", points, marks),
                Series::line("unit circle", circle),
            ],
        )
    }
}

/// Deviations over a period.
fn orbit(part: &PartMotion) -> Plot {
    let objects = part.objects.join(", ");
    let curves = part.orbit.iter();
    let curves = curves.map(|(label, points)| Series::line(label, points.clone()));
    Plot::new(
        format!("Deviation from the law over a period: {objects}"),
        Axis::new("t", "s"),
        &part.unit,
        curves.collect(),
    )
}
