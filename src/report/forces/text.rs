//! The forces on the terminal.

use super::{ForcesReport, shown};
use crate::report::quantity::significant;
use crate::studies::forces::{Column, NEGLIGIBLE, columns};
use std::fmt::Write as _;

/// Extremes with their positions, the cycle, zones, sensitivities, checks.
pub fn text(report: &ForcesReport<'_>) -> String {
    let mut out = format!("{}\n{}\n", report.name, headline(report));
    extremes(&mut out, report);
    zones(&mut out, report);
    cycle(&mut out, report);
    counterweight(&mut out, report);
    sensitivities(&mut out, report);
    massless(&mut out, report);
    let study = report.study;
    let _ = writeln!(
        out,
        "\nchecks: power balance to {}, influence coefficients to {}",
        significant(study.worst_balance(), 2),
        significant(study.worst_influence(), 2)
    );
    out
}

fn headline(report: &ForcesReport<'_>) -> String {
    let study = report.study;
    let mut out = format!(
        "{}: {} positions, {}",
        report.object,
        study.rows.len(),
        report.motion
    );
    if let Some(output) = study.settings.output {
        let _ = write!(
            out,
            "\noutput `{}`, χ in the convention `{}`",
            study.linkage.outputs[output].name,
            study.settings.convention.name()
        );
    }
    out
}

fn extremes(out: &mut String, report: &ForcesReport<'_>) {
    let names = report
        .study
        .extremes
        .iter()
        .map(|found| found.name.chars().count());
    let width = names.max().unwrap_or(0).max(8);
    let _ = writeln!(
        out,
        "\n{:<width$} {:>16} {:>16} {:>16} {:>16}",
        "EXTREMES", "least", "at", "greatest", "at"
    );
    for found in &report.study.extremes {
        let [least, least_at] = report.extreme(&found.least, &found.unit);
        let [greatest, greatest_at] = report.extreme(&found.greatest, &found.unit);
        let _ = writeln!(
            out,
            "{:<width$} {least:>16} {least_at:>16} {greatest:>16} {greatest_at:>16}",
            found.name,
        );
    }
}

fn zones(out: &mut String, report: &ForcesReport<'_>) {
    if report.study.zones.is_empty() {
        return;
    }
    out.push_str("\nZONES\n");
    for zone in &report.study.zones {
        let (from, to) = (report.place(zone.from), report.place(zone.to));
        let what = report.zone(zone);
        let _ = match from == to {
            true => writeln!(out, "at {from}: {what}"),
            false => writeln!(out, "{from} to {to}: {what}"),
        };
    }
}

fn cycle(out: &mut String, report: &ForcesReport<'_>) {
    let Some(cycle) = &report.study.cycle else {
        return;
    };
    let what = if cycle.closed {
        "CYCLE"
    } else {
        "WHOLE COURSE"
    };
    let _ = writeln!(out, "\n{what}, {}", shown(cycle.duration, "s"));
    let force = report.study.drive_unit();
    let mut row = |name: &str, value: String| {
        let _ = writeln!(out, "{name:<26} {value:>16}");
    };
    row("work of the driver", shown(cycle.drive_work, "J"));
    if report.study.settings.output.is_some() {
        row("work of the load", shown(cycle.load_work, "J"));
    }
    row("lost to friction", shown(cycle.loss, "J"));
    for (pair, loss) in report.study.linkage.pairs.iter().zip(&cycle.pair_losses) {
        if *loss > 0.0 {
            row(&format!("  in {}", pair.name), shown(*loss, "J"));
        }
    }
    if let Some(efficiency) = cycle.efficiency {
        row(
            "efficiency",
            format!("{} %", significant(100.0 * efficiency, 4)),
        );
    }
    row("mean driving force", shown(cycle.mean_drive, force));
    row("root mean square", shown(cycle.rms_drive, force));
}

fn counterweight(out: &mut String, report: &ForcesReport<'_>) {
    let Some(found) = &report.study.counterweight else {
        return;
    };
    let _ = writeln!(
        out,
        "\nSHAKING FORCE\ngreatest {}, rms {}; a counterweight of {} at {} deg in the frame of \
         `{}` leaves {}, rms {}",
        shown(found.greatest[0], "N"),
        shown(found.rms[0], "N"),
        shown(found.mass_radius, "kg m"),
        significant(found.angle.to_degrees(), 6),
        report.study.linkage.links[found.link].name,
        shown(found.greatest[1], "N"),
        shown(found.rms[1], "N")
    );
}

/// The greatest derivative of the driving force by each coefficient and mass.
fn sensitivities(out: &mut String, report: &ForcesReport<'_>) {
    let study = report.study;
    let all = columns(&study.linkage, study.settings.output);
    let greatest = |column: &Column| {
        let values = study.rows.iter().enumerate();
        let values = values.filter_map(|(index, row)| Some((index, column.value(row)?)));
        values.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
    };
    let mut rows = String::new();
    for column in all
        .iter()
        .filter(|column| column.name.starts_with("drive_by."))
    {
        let Some((index, value)) = greatest(column).filter(|(_, value)| *value != 0.0) else {
            continue;
        };
        let name = column.name.trim_start_matches("drive_by.");
        let endless = study
            .unbounded
            .iter()
            .find(|(known, _)| *known == column.name);
        if let Some((_, at)) = endless {
            let place = format!("→ {}", report.place(*at));
            let _ = writeln!(
                rows,
                "{name:<26} {:>20} {place:>16} {:>18}",
                "unbounded", "unbounded"
            );
            continue;
        }
        let chi = all
            .iter()
            .find(|other| other.name == format!("chi_by.{name}"));
        let chi = chi.and_then(|column| Some((greatest(column)?.1, &column.unit)));
        let chi = chi.map_or(String::new(), |(value, unit)| shown(value, unit));
        let _ = writeln!(
            rows,
            "{name:<26} {:>20} {:>16} {chi:>18}",
            shown(value, &column.unit),
            report.place(study.course.parameter(index))
        );
    }
    if !rows.is_empty() {
        let _ = write!(
            out,
            "\n{:<26} {:>20} {:>16} {:>18}\n{rows}",
            "GREATEST CHANGE BY", "of the drive", "at", "of χ"
        );
    }
}

fn massless(out: &mut String, report: &ForcesReport<'_>) {
    let Some(found) = report.massless else { return };
    let study = report.study;
    let columns = columns(&study.linkage, study.settings.output);
    let unit = |name: &str| {
        let column = columns.iter().find(|column| column.name == name);
        column.map_or("", |column| column.unit.as_str())
    };
    let _ = writeln!(
        out,
        "\nMASSLESS AGAINST FULL MODEL\nmoving mass {}, load {}, greatest |χ| without masses {}\n\
         {:>14} {:>16} {:>18}",
        shown(found.mass, "kg"),
        shown(found.load, unit("load")),
        shown(found.greatest, unit("chi")),
        parameter_name(study.coordinate_unit(), unit("load")),
        "speed",
        "greatest change"
    );
    for point in &found.points {
        let missing = match point.missing {
            0 => String::new(),
            count => format!(", at {count} positions only one model moves"),
        };
        let _ = writeln!(
            out,
            "{:>14} {:>16} {:>16} %{missing}",
            significant(point.parameter, 4),
            shown(point.speed, unit("speed")),
            significant(100.0 * point.deviation, 3)
        );
    }
    let _ = writeln!(out, "{}", verdict(found));
}

/// m·ω²/P with its unit, kg·(rad/s)²/N = 1/m for an input that turns.
fn parameter_name(input: &str, load: &str) -> &'static str {
    match (input, load) {
        ("rad", "N") => "m·ω²/P, 1/m",
        ("rad", _) => "m·ω²/M, 1/m²",
        (_, "N") => "m·v²/P, m",
        _ => "m·v²/M",
    }
}

/// Up to where masses may be left out.
pub(super) fn verdict(found: &crate::studies::forces::MasslessComparison) -> String {
    let percent = significant(100.0 * NEGLIGIBLE, 3);
    let asked = found.points.iter().map(|point| point.parameter);
    match found.negligible_up_to {
        None => format!("masses change χ by more than {percent} % at any speed"),
        Some(limit) if asked.fold(0.0, f64::max) <= limit => {
            format!(
                "masses are negligible (below {percent} % of the greatest χ) at all of these speeds"
            )
        }
        Some(limit) => format!(
            "masses are negligible (below {percent} % of the greatest χ) up to m·ω²/P = {}",
            significant(limit, 3)
        ),
    }
}
