//! Figures on the terminal.

use crate::dynamics::record::{Figures, ObjectFigures, PairFigures, Units};
use crate::units::shown;
use std::fmt::Write as _;

/// Significant digits shown; files carry all of them.
const DIGITS: usize = 7;

/// The summary of a run as text.
pub(crate) fn summary(figures: &Figures) -> String {
    let mut text = format!("{}\n", figures.scene);
    headline(&mut text, figures);
    for (id, object) in &figures.objects {
        let units = figures.units.get(id).copied();
        text.push('\n');
        object_block(&mut text, id, object, units);
    }
    text
}

fn headline(text: &mut String, figures: &Figures) {
    let run = &figures.run;
    let _ = writeln!(
        text,
        "{} s by {} at tolerance {}: {} steps, {} evaluations, {} switches, energy error {}",
        number(run.time),
        run.method,
        number(run.tolerance),
        run.steps,
        run.evaluations,
        run.switches,
        share(run.energy_error)
    );
    let _ = writeln!(text, "method: {}", run.why);
    if !run.complete {
        let why = run.stopped_because.as_deref().unwrap_or("no reason given");
        let _ = writeln!(text, "INCOMPLETE: stopped at {} s: {why}", number(run.time));
    }
    match (&run.window, &run.window_missing) {
        (Some([from, to]), _) => {
            let _ = writeln!(text, "window: {} to {} s", number(*from), number(*to));
        }
        (None, Some(reason)) => {
            let _ = writeln!(text, "window: none, {reason}");
        }
        (None, None) => {}
    }
}

/// A share of something, to two digits.
fn share(value: f64) -> String {
    shown(value, 2)
}

fn object_block(text: &mut String, id: &str, object: &ObjectFigures, units: Option<Units>) {
    let (length, force) = units.map_or(("", ""), |units| (units.displacement, units.force));
    let _ = writeln!(text, "{id}");
    let mut row = |name: &str, value: String, unit: &str| {
        let line = format!("  {name:<26} {value:>15} {unit}");
        text.push_str(line.trim_end());
        text.push('\n');
    };
    let rate = |order: &str| format!("{length}/{order}");
    // Drives and rigid objects do not deviate from their law.
    if object.delta_max != 0.0 || object.delta_min != 0.0 {
        row("greatest |δ|", number(object.delta_abs), length);
        row("greatest deviation δ_max", number(object.delta_max), length);
        row("least deviation δ_min", number(object.delta_min), length);
        row("mean deviation σ", number(object.sigma), length);
    }
    row("peak speed", number(object.peak_speed), &rate("s"));
    row(
        "peak acceleration",
        number(object.peak_acceleration),
        &rate("s²"),
    );
    row("peak reaction", number(object.peak_reaction), force);
    row(
        "final displacement",
        number(object.end.displacement),
        length,
    );
    row("final speed", number(object.end.speed), &rate("s"));
    if let Some(joints) = &object.joints {
        row("standstills", joints.standstills.to_string(), "");
        row("time at rest", number(joints.time_at_rest), "s");
        row("lost to joint friction", number(joints.friction_loss), "J");
    }
    if let Some(pair) = &object.pair {
        pair_rows(&mut row, pair, length, force);
    }
    if let Some(stop) = &object.stop {
        row("closures", stop.closures.to_string(), "");
        row("time in contact", number(stop.contact_time), "s");
        let speed = number(stop.max_approach_speed);
        row("greatest approach speed", speed, &rate("s"));
        row(
            "greatest contact force",
            number(stop.max_contact_force),
            force,
        );
        row("greatest indentation", number(stop.max_indentation), length);
    }
}

fn pair_rows(
    row: &mut impl FnMut(&str, String, &str),
    pair: &PairFigures,
    length: &str,
    force: &str,
) {
    row("separations", pair.separations.to_string(), "");
    row("closures", pair.closures.to_string(), "");
    row("time separated", number(pair.separated_time), "s");
    row("longest separation", number(pair.longest_separation), "s");
    row("greatest lift", number(pair.max_lift), length);
    let rate = format!("{length}/s");
    row(
        "greatest approach speed",
        number(pair.max_approach_speed),
        &rate,
    );
    row(
        "greatest contact force",
        number(pair.max_contact_force),
        force,
    );
    if let Some(indentation) = pair.max_indentation {
        row("greatest indentation", number(indentation), length);
    }
    if let Some(margin) = pair.margin {
        row("least contact force needed", number(margin), force);
    }
    let order = match pair.in_working_order {
        Some(true) => "yes",
        Some(false) => "NO: it opens",
        None => "not judged",
    };
    row("in working order", order.to_owned(), "");
}

/// A number as people read it, in the one format of the terminal.
pub(crate) fn number(value: f64) -> String {
    shown(value, DIGITS)
}

#[cfg(test)]
mod tests {
    use super::number;

    #[test]
    fn numbers_are_short_and_keep_their_digits() {
        for (value, text) in [
            (0.0, "0"),
            (0.5, "0.5"),
            (-1234.5678, "-1234.568"),
            (0.007500864310574964, "0.007500864"),
            (75.0, "75"),
            (1e-4, "1e-4"),
            (1e-7, "1e-7"),
            (2.5e-7, "2.5e-7"),
            (98.699696930596, "98.6997"),
            (1.2345e7, "1.2345e7"),
            (f64::NAN, "not a number"),
            (f64::INFINITY, "not a number"),
        ] {
            assert_eq!(number(value), text);
        }
    }
}
