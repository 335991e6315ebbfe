//! The steady motion for the terminal, and its rows as CSV.

use super::Shown;
use crate::dynamics::steady::flywheel::Flywheel;
use crate::report::csv::{number, write};
use crate::report::quantity::significant;
use std::fmt::Write as _;

/// A name, its value and unit.
pub(super) type Line = (String, String);

pub(super) fn value(name: &str, value: f64, unit: &str) -> Line {
    let text = format!("{} {unit}", significant(value, 10));
    (name.to_owned(), text.trim_end().to_owned())
}

pub(super) fn at(name: &str, [amount, place]: [f64; 2], unit: &str) -> Line {
    let degrees = significant(place.to_degrees(), 7);
    let text = format!("{} {unit} at φ = {degrees}°", significant(amount, 10));
    (name.to_owned(), text)
}

/// The figures, name and value.
pub(super) fn figures(shown: &Shown<'_>) -> Vec<Line> {
    let f = shown.figures;
    let turns = |speed: f64| significant(speed * 60.0 / std::f64::consts::TAU, 8);
    let mut lines = vec![
        (
            "mean speed".to_owned(),
            format!(
                "{} rad/s = {} rpm ({})",
                significant(f.mean_speed, 10),
                turns(f.mean_speed),
                match shown.regime {
                    Some(_) => "a result: a moment depends on the speed",
                    None => f.mean.words(),
                }
            ),
        ),
        value("mean over time", f.means.time, "rad/s"),
        value("mean over the angle", f.means.angle, "rad/s"),
        value("midway between extremes", f.means.midrange, "rad/s"),
        at(
            "least speed",
            [f.least_speed.value, f.least_speed.at],
            "rad/s",
        ),
        at(
            "greatest speed",
            [f.greatest_speed.value, f.greatest_speed.at],
            "rad/s",
        ),
        value("fluctuation δ", f.fluctuation, ""),
        value("period", f.period, "s"),
        value("T at φ = 0", f.energy_at_start, "J"),
        at(
            "E₀, T at the least J",
            [f.reference_energy, f.reference_position],
            "J",
        ),
        value("fluctuation of the work", f.energy_fluctuation, "J"),
    ];
    // Less is rounding.
    if f.cycle_work.abs() > 1e-11 * f.energy_fluctuation {
        lines.push(value("work left over in a cycle", f.cycle_work, "J"));
    }
    if let Some(moment) = f.balance {
        lines.push(value("balanced by a constant moment", moment, "N·m"));
    }
    if let Some(regime) = shown.regime {
        let attracts = if regime.attracts {
            "others settle on it"
        } else {
            "others leave it"
        };
        lines.push((
            "multiplier of a cycle".to_owned(),
            format!("{} ({attracts})", significant(regime.multiplier, 10)),
        ));
        for other in &regime.others {
            lines.push(value("another steady mean speed", *other, "rad/s"));
        }
    }
    lines
}

/// How the ways agree.
pub(super) fn agreement(shown: &Shown<'_>) -> Vec<Line> {
    let mut lines = Vec::new();
    let mut add = |name: &str, text: String| lines.push((name.to_owned(), text));
    let short = |value: f64| significant(value, 2);
    if let Some(found) = shown.agreement {
        if let Some(check) = found.equation {
            let text = format!(
                "ω(Φ) {} off, period {} off",
                short(check.speed),
                short(check.period)
            );
            add("equation of motion over a cycle", text);
        }
        if let Some(apart) = found.cycle_map {
            add(
                "cycle map and energy-mass method",
                format!("ω(φ) {} apart", short(apart)),
            );
        }
        if let Some(run) = found.simulation {
            let from = match run.disturbed {
                0.0 => "from the steady motion".to_owned(),
                by => format!("from a speed {} % off", significant(100.0 * by, 3)),
            };
            let text = format!(
                "{} cycles {from}: ω {} off at the end",
                run.cycles,
                short(run.speed)
            );
            add("simulation of the scene in time", text);
        }
        if let Some(why) = &found.simulation_missing {
            add("simulation of the scene in time", format!("none: {why}"));
        }
    }
    if let Some(halving) = shown.halving {
        let text = format!(
            "T(0) {} J, ω_min {}, ω_max {} rad/s",
            short(halving.energy_at_start),
            short(halving.least_speed),
            short(halving.greatest_speed)
        );
        add("with every second sample left out", text);
    }
    if let Some(error) = shown.figures.period_error {
        add(
            "estimated error of the period",
            format!("{} relative", short(error)),
        );
    }
    let f = shown.figures;
    let [low, high] = f.bracket.map(|end| significant(end, 12));
    let text = format!(
        "{} evaluations, mean {} off, E₀ in [{low}, {high}] J",
        f.iterations,
        short(f.miss)
    );
    add("iteration", text);
    lines
}

/// The flywheel.
pub(super) fn flywheel(shown: &Shown<'_>) -> Vec<Line> {
    shown.flywheel.map_or_else(Vec::new, flywheel_lines)
}

/// A flywheel: the inertia to add, and what textbooks say of it.
pub(super) fn flywheel_lines(wheel: &Flywheel) -> Vec<Line> {
    let mut lines = vec![value("δ asked for", wheel.fluctuation, "")];
    match wheel.fluctuation_without {
        Some(without) => lines.push(value("δ without a flywheel", without, "")),
        None => lines.push((
            "without a flywheel".to_owned(),
            "the machine would stop".to_owned(),
        )),
    }
    lines.push(value("inertia to add", wheel.inertia, "kg·m²"));
    for one in &wheel.approximations {
        let error = one
            .error
            .map_or(String::new(), |error| format!(" ({:+.2} %)", 100.0 * error));
        let gives = one
            .fluctuation
            .map_or("the machine would stop".to_owned(), |found| {
                format!("gives δ = {}", significant(found, 5))
            });
        let text = format!("{} kg·m²{error}, {gives}", significant(one.inertia, 7));
        lines.push((format!("by {}", one.words), text));
    }
    lines
}

/// All that is known of the motion.
pub fn rigid_text(shown: &Shown<'_>) -> String {
    let mut text = format!("{}\n", shown.title);
    let mut section = |heading: &str, lines: Vec<Line>| {
        if lines.is_empty() {
            return;
        }
        let width = lines
            .iter()
            .map(|line| line.0.chars().count())
            .max()
            .unwrap_or(0);
        let _ = writeln!(text, "\n{heading}");
        for (name, value) in lines {
            let _ = writeln!(text, "  {name:<width$}  {value}");
        }
    };
    section("Steady motion", figures(shown));
    section("Flywheel", flywheel(shown));
    section("Agreement", agreement(shown));
    text
}

/// The rows as CSV.
///
/// # Errors
/// Never in practice: writing into memory.
pub fn rows_csv(shown: &Shown<'_>) -> Result<String, csv::Error> {
    let header = [
        "phi [rad]",
        "t [s]",
        "omega [rad/s]",
        "epsilon [rad/s^2]",
        "J [kg m^2]",
        "M [N m]",
        "A [J]",
        "T [J]",
    ];
    let rows = shown.rows.iter().map(|row| {
        [
            row.position,
            row.time,
            row.speed,
            row.acceleration,
            row.inertia,
            row.moment,
            row.work,
            row.energy,
        ]
        .map(number)
        .to_vec()
    });
    write(header.map(str::to_owned).into_iter(), rows)
}
