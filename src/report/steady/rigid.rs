//! The steady motion of a machine with rigid objects.

use super::SteadyReport;
use super::charts::{charts, origin_is_shown, wittenbauer};
use crate::dynamics::steady::Row;
use crate::dynamics::steady::flywheel::{Approximation, Flywheel};
use crate::report::csv::Rows;
use crate::report::findings::{Cell, Figure, Findings, Layout, Section, Source, Table, Value};
use crate::report::quantity::{result, significant, with_unit};
use crate::report::sentence::Sentence;
use crate::report::verdict::Verdict;
use crate::studies::check::Check;
use crate::studies::steady::{rigid_checks, rigid_judgement};

/// A quantity to all the digits that say something.
pub(super) fn value(name: &str, value: f64, unit: &str) -> Figure {
    Figure::number(name, value, unit, 10)
}

/// A quantity and the angle of the drive at which it is met.
pub(super) fn value_at_place(name: &str, [amount, place]: [f64; 2], unit: &str) -> Figure {
    let place = Value::angle_or(place, "rad", 7).words();
    value(name, amount, unit).with_note(format!("at φ = {place}"))
}

/// A speed, in turns a minute as well.
pub(super) fn mean_speed(speed: f64, why: &str) -> Figure {
    let shown = value("mean speed", speed, "rad/s");
    if shown.value.words().ends_with("rpm") {
        return shown.with_note(format!("({why})"));
    }
    let turns = result(speed * 60.0 / std::f64::consts::TAU, 8);
    shown.with_note(format!("= {turns} rpm ({why})"))
}

/// The motion over a cycle, its flywheel, how independent ways agree.
pub fn rigid_findings<'a>(shown: &SteadyReport<'_>, source: Source<'a>) -> Findings<'a> {
    let f = shown.figures;
    let text = Sentence::from("From ")
        .quantity(f.least_speed.value, "rad/s", 5)
        .words(" to ")
        .quantity(f.greatest_speed.value, "rad/s", 5)
        .words(" about a mean of ")
        .quantity(f.mean_speed, "rad/s", 5)
        .words(".");
    let checks = rigid_checks(f, shown.agreement);
    let failed = checks.iter().any(|check| !check.passed());
    let begun = match failed {
        true => "Not to be trusted: the speed",
        false => "The speed",
    };
    let fluctuates = format!(
        "{begun} fluctuates by δ = {}",
        significant(f.fluctuation, 4)
    );
    let headline = match shown.flywheel {
        Some(wheel) if wheel.inertia > 0.0 => Sentence::from(fluctuates)
            .words(" with a flywheel of ")
            .quantity(wheel.inertia, "kg m²", 5)
            .words("."),
        Some(_) => Sentence::from(fluctuates + " without a flywheel: none is needed."),
        None => Sentence::from(fluctuates + "."),
    };
    let judgement = rigid_judgement(f, shown.regime, &checks);
    let flywheel = |make: fn(&Flywheel) -> Section<'static>| {
        shown.flywheel.map_or_else(Section::default, make)
    };
    let wheel = |wheel: &Flywheel| {
        Section::new("Flywheel")
            .figures(flywheel_figures(wheel))
            .legend("The motion on this page is the one with the flywheel.")
    };
    let diagram = Section::new("Energy-mass diagram")
        .charts(Layout::Wide(520.0), "", vec![wittenbauer(shown)])
        .legend(
            "A straight line from O₂ with the slope ω²/2 meets the curve where the drive has the \
             speed ω: the tangents touch it at the greatest and the least speed. O₂ lies T(0) \
             below the start of the curve.",
        )
        .legend(match origin_is_shown(shown) {
            true => String::new(),
            false => format!(
                "The frame shows the curve alone. O₂ lies outside it, at J = 0 and A = {}.",
                with_unit(-f.energy_at_start, "J", 4)
            ),
        });
    Findings {
        title: shown.title.to_owned(),
        subtitle: "steady motion".to_owned(),
        answer: Some(Verdict::of_judgement(judgement, headline, text)),
        warnings: f.warnings.clone(),
        sections: vec![
            Section::new("Results").figures(figures(shown)),
            flywheel(wheel),
            flywheel(estimates_section),
            Section::new("Motion over a cycle").charts(Layout::Grid, "cycle", charts(shown)),
            diagram,
            Section::new("Agreement").figures(agreement(shown, &checks)),
        ],
        source,
    }
}

fn figures(shown: &SteadyReport<'_>) -> Vec<Figure> {
    let f = shown.figures;
    let why = match shown.regime {
        Some(_) => "a result: a moment depends on the speed",
        None => f.mean.words(),
    };
    let extreme = |name, found: crate::dynamics::steady::Extreme| {
        value_at_place(name, [found.value, found.at], "rad/s")
    };
    let reference = [f.reference_energy, f.reference_position];
    let mut figures = vec![
        mean_speed(f.mean_speed, why),
        value("mean over time", f.means.time, "rad/s"),
        value("mean over the angle", f.means.angle, "rad/s"),
        value("midway between extremes", f.means.midrange, "rad/s"),
        extreme("least speed", f.least_speed),
        extreme("greatest speed", f.greatest_speed),
        value("fluctuation δ", f.fluctuation, ""),
        value("period", f.period, "s"),
        value("T at φ = 0", f.energy_at_start, "J"),
        value_at_place("E₀, T at the least J", reference, "J"),
        value("fluctuation of the work", f.energy_fluctuation, "J"),
    ];
    // Less is rounding.
    if f.cycle_work.abs() > 1e-11 * f.energy_fluctuation {
        figures.push(value("work left over in a cycle", f.cycle_work, "J"));
    }
    if let Some(moment) = f.balance {
        figures.push(value("balanced by a constant moment", moment, "N m"));
    }
    if let Some(regime) = shown.regime {
        let attracts = match regime.attracts {
            true => "(others settle on it)",
            false => "(others leave it)",
        };
        figures.push(value("multiplier of a cycle", regime.multiplier, "").with_note(attracts));
        let others = regime.others.iter();
        figures.extend(others.map(|&other| value("another steady mean speed", other, "rad/s")));
    }
    figures
}

/// How the ways agree.
fn agreement(shown: &SteadyReport<'_>, checks: &[Check]) -> Vec<Figure> {
    let mut figures: Vec<Figure> = checks.iter().map(Figure::check).collect();
    let mut add = |name: &str, text: String| figures.push(Figure::new(name, text));
    let short = |value: f64| significant(value, 2);
    if let Some(found) = shown.agreement {
        let name = "simulation of the scene in time";
        if let Some(run) = found.simulation {
            let from = match run.disturbed {
                0.0 => "from the steady motion".to_owned(),
                by => format!("from a speed {} % away", significant(100.0 * by, 3)),
            };
            add(name, format!("{} cycles {from}", run.cycles));
        }
        if let Some(why) = &found.simulation_missing {
            add(name, format!("none: {why}"));
        }
    }
    if let Some(halving) = shown.halving {
        let text = format!(
            "T(0) {} J, ω_min {}, ω_max {} rad/s",
            short(halving.energy_at_start),
            short(halving.least_speed),
            short(halving.greatest_speed)
        );
        add("change without every second sample", text);
    }
    let f = shown.figures;
    let [low, high] = f.bracket.map(|end| significant(end, 12));
    let text = format!("{} evaluations, E₀ in [{low}, {high}] J", f.iterations);
    add("iteration", text);
    figures
}

/// What becomes of a machine without enough inertia.
const STOPS: &str = "the machine would stop";

/// A flywheel: the inertia to add.
pub(super) fn flywheel_figures(wheel: &Flywheel) -> Vec<Figure> {
    vec![
        value("required δ", wheel.fluctuation, ""),
        match wheel.fluctuation_without {
            Some(without) => value("δ without a flywheel", without, ""),
            None => Figure::new("without a flywheel", STOPS),
        },
        value("inertia to add", wheel.inertia, "kg m²"),
    ]
}

/// What textbooks say of a flywheel, and what it would do.
pub(super) fn estimates_section<'a>(wheel: &Flywheel) -> Section<'a> {
    let row = |one: &Approximation| {
        vec![
            Cell::from(one.words),
            Value::new(one.inertia, "kg m²", 7).into(),
            Cell::known_number(one.error.map(|error| 100.0 * error), "%", 3),
            match one.fluctuation {
                Some(found) => Value::new(found, "", 5).into(),
                None => STOPS.into(),
            },
        ]
    };
    let heads = ["estimate", ">inertia to add", ">difference", ">gives δ"];
    let table = Table::new(heads).rows(wheel.approximations.iter().map(row));
    Section::new("Flywheel by textbook estimates").table(table)
}

/// A column of the cycle: its heading and its value.
type Column = (&'static str, fn(&Row) -> f64);

/// The motion over the cycle, a row a place.
pub fn rigid_rows(shown: &SteadyReport<'_>) -> Rows {
    let columns: [Column; 8] = [
        ("phi [rad]", |row| row.position),
        ("t [s]", |row| row.time),
        ("omega [rad/s]", |row| row.speed),
        ("epsilon [rad/s^2]", |row| row.acceleration),
        ("J [kg m^2]", |row| row.inertia),
        ("M [N m]", |row| row.moment),
        ("A [J]", |row| row.work),
        ("T [J]", |row| row.energy),
    ];
    let rows = shown
        .rows
        .iter()
        .map(|row| columns.map(|(_, read)| read(row)));
    Rows::new(columns.map(|(head, _)| head), rows)
}
