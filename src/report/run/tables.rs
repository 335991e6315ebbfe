//! Tables of a run: figures, pairs, stops, joints, switches, statistics.

use crate::dynamics::model::UNTIL;
use crate::dynamics::record::{
    EquationCheck, Figures, ObjectFigures, PairFigures, RunSummary, SwitchRow, Units,
};
use crate::report::findings::table::check_outcome;
use crate::report::findings::{Cell, Figure, Table, Value};
use crate::report::quantity::{DIGITS, significant, units, with_unit};
use crate::studies::judgement::{Judgement, checks};

fn value(value: f64, unit: &str) -> Cell {
    Value::new(value, unit, DIGITS).into()
}

/// Unit of a speed.
pub(super) fn speed(units: Units) -> String {
    format!("{}/s", units.displacement)
}

/// A table with a row for every object that has what it is of.
fn table<const N: usize>(
    heads: [&str; N],
    figures: &Figures,
    cells: impl Fn(&ObjectFigures, Units) -> Option<Vec<Cell>>,
) -> Table {
    let row = |(id, object): (&String, &ObjectFigures)| {
        let cells = cells(object, units(figures, id))?;
        Some([vec![Cell::object(id)], cells].concat())
    };
    let heads = std::iter::once("object").chain(heads);
    Table::new(heads).rows(figures.objects.iter().filter_map(row))
}

/// Figures of every object.
pub(super) fn figures_table(figures: &Figures) -> Table {
    let heads = [
        ">greatest |δ|",
        ">greatest δ",
        ">least δ",
        ">σ, mean |δ|",
        ">peak speed",
        ">peak acceleration",
        ">peak reaction",
        ">displacement at the end",
        ">speed at the end",
    ];
    table(heads, figures, |object, units| {
        let (length, speed) = (units.displacement, speed(units));
        Some(vec![
            value(object.delta_abs, length),
            value(object.delta_max, length),
            value(object.delta_min, length),
            value(object.sigma, length),
            value(object.peak_speed, &speed),
            value(object.peak_acceleration, &format!("{length}/s²")),
            value(object.peak_reaction, units.force),
            value(object.end.displacement, length),
            value(object.end.speed, &speed),
        ])
    })
}

/// Figures of every pair that can open.
pub(super) fn pairs_table(figures: &Figures) -> Table {
    let heads = [
        ">in working order",
        ">separations",
        ">closures",
        ">time separated",
        ">longest separation",
        ">greatest lift",
        ">greatest approach speed",
        ">greatest contact force (along the follower)",
    ];
    table(heads, figures, |object, units| {
        let pair = object.pair.as_ref()?;
        let force = Cell {
            note: pair.max_indentation.map_or(String::new(), |depth| {
                format!("indentation {}", with_unit(depth, units.displacement, 5))
            }),
            ..value(pair.max_contact_force, units.force)
        };
        Some(vec![
            order(Judgement::of_pair_in(figures, pair), pair, units),
            pair.separations.to_string().into(),
            pair.closures.to_string().into(),
            value(pair.separated_time, "s"),
            value(pair.longest_separation, "s"),
            value(pair.max_lift, units.displacement),
            value(pair.max_approach_speed, &speed(units)),
            force,
        ])
    })
}

/// Whether a pair is in working order; of a rigid object, the least force that its motion needs.
fn order(judgement: Judgement, pair: &PairFigures, units: Units) -> Cell {
    let (word, good) = match judgement {
        Judgement::InWorkingOrder => ("yes", Some(true)),
        Judgement::NotInWorkingOrder if pair.margin.is_some() => ("would lift off", Some(false)),
        Judgement::NotInWorkingOrder => ("NO", Some(false)),
        Judgement::NotJudged => ("not judged", None),
        Judgement::NotToBeTrusted => ("not to be trusted", None),
    };
    match pair.margin {
        Some(margin) => {
            let least = with_unit(margin, units.force, DIGITS);
            Cell::with_note(word, format!("least force {least}")).with_outcome(good)
        }
        None => Cell::from(word).with_outcome(good),
    }
}

/// Figures of every stop.
pub(super) fn stops_table(figures: &Figures) -> Table {
    let heads = [
        ">closures",
        ">time in contact",
        ">greatest approach speed",
        ">greatest contact force",
        ">greatest indentation",
    ];
    table(heads, figures, |object, units| {
        let stop = object.stop.as_ref()?;
        Some(vec![
            stop.closures.to_string().into(),
            value(stop.contact_time, "s"),
            value(stop.max_approach_speed, &speed(units)),
            value(stop.max_contact_force, units.force),
            value(stop.max_indentation, units.displacement),
        ])
    })
}

/// Pressures of contacts of known shape and material.
pub(super) fn contact_pressure_table(figures: &Figures) -> Table {
    let heads = [">greatest pressure", ">at"];
    table(heads, figures, |object, _| {
        let pressing = object.pressing?;
        Some(vec![
            value(pressing.max_pressure, "Pa"),
            value(pressing.time, "s"),
        ])
    })
}

/// Impacts of every rigid contact.
pub(super) fn impacts_table(figures: &Figures) -> Table {
    let heads = [">impacts", ">greatest impulse", ">energy lost"];
    table(heads, figures, |object, units| {
        let pair = object.pair.as_ref().and_then(|pair| pair.impacts);
        let stop = object.stop.as_ref().and_then(|stop| stop.impacts);
        let impacts = pair.or(stop)?;
        Some(vec![
            impacts.count.to_string().into(),
            value(impacts.max_impulse, &format!("{} s", units.force)),
            value(impacts.loss, "J"),
        ])
    })
}

/// Figures of every linkage whose joints have friction.
pub(super) fn joints_table(figures: &Figures) -> Table {
    let heads = [">standstills", ">time at rest", ">energy lost"];
    table(heads, figures, |object, _| {
        let joints = object.joints.as_ref()?;
        Some(vec![
            joints.standstills.to_string().into(),
            value(joints.time_at_rest, "s"),
            value(joints.friction_loss, "J"),
        ])
    })
}

/// Switches, too many for a terminal.
pub(super) fn switches_table(rows: &[SwitchRow], figures: &Figures) -> Table {
    let row = |(index, row): (usize, &SwitchRow)| {
        vec![
            (index + 1).to_string().into(),
            significant(row.time, 12).into(),
            row.object.as_str().into(),
            row.what.into(),
            row.flank.into(),
            value(row.speed, &speed(units(figures, &row.object))),
        ]
    };
    let heads = ["no.", ">time, s", "object", "pair", "flank"];
    let heads = heads.into_iter().chain([">speed of approach or parting"]);
    let mut table = Table::new(heads).rows::<Cell>(rows.iter().enumerate().map(row));
    table.rows.iter_mut().for_each(|row| row.minor = true);
    table
}

/// How the run went.
pub(super) fn statistics(figures: &Figures) -> Vec<Figure> {
    let run = &figures.run;
    let end = match (&run.stopped, run.complete) {
        (_, true) => "complete".to_owned(),
        (Some(name), false) => format!("INCOMPLETE, {}", name.replace('_', " ")),
        (None, false) => "INCOMPLETE".to_owned(),
    };
    let window = match (run.window, &run.window_missing) {
        (Some([from, to]), _) => Some(format!(
            "{} to {}",
            with_unit(from, "s", DIGITS),
            with_unit(to, "s", DIGITS)
        )),
        (None, Some(reason)) => Some(format!("none, {reason}")),
        (None, None) => None,
    };
    let words = |name: &str, words: String| Figure::new(name, words);
    let mut rows = vec![words(
        "time reached",
        format!("{}, {end}", with_unit(run.time, "s", 9)),
    )];
    rows.extend(run.stopped_because.clone().map(|why| words("reason", why)));
    rows.extend(run.first_times.iter().map(|(name, time)| {
        let open = run.undetermined_times.contains_key(name);
        let time = match (time.map(|time| with_unit(time, "s", 9)), open) {
            (Some(time), false) => time,
            (Some(time), true) => format!("{time} or earlier, not determined"),
            (None, false) => "never".to_owned(),
            (None, true) => "not determined".to_owned(),
        };
        match name == UNTIL {
            true => words("condition of `until`", time),
            false => words(&format!("first time, {name}"), time),
        }
    }));
    rows.extend(window.map(|window| words("steady window", window)));
    rows.extend([
        words("method", format!("{}: {}", run.method, run.why)),
        words("tolerance", tolerance(run)),
    ]);
    rows.extend(checked(figures));
    rows.extend([
        words(
            "steps",
            format!("{} accepted, {} rejected", run.steps, run.rejected),
        ),
        words("evaluations", run.evaluations.to_string()),
        words("events of contacts", run.switches.to_string()),
    ]);
    rows
}

/// The checks of a run; that all figures are finite is shown where one is not.
fn checked(figures: &Figures) -> impl Iterator<Item = Figure> {
    let equations = equations(&figures.run.equations);
    checks(figures).into_iter().filter_map(move |check| {
        let figure = match check.name {
            "energy balance" => Figure::new("energy error", check_outcome(&check)).checked(&check),
            "equations of motion" => Figure::new(check.name, equations.clone()).checked(&check),
            _ => Figure::check(&check),
        };
        (!check.passed() || check.bound > 0.0).then_some(figure)
    })
}

/// The tolerance, with why it is this one where the scene does not say it.
fn tolerance(run: &RunSummary) -> String {
    let number = significant(run.tolerance, 3);
    match &run.tolerance_why {
        Some(why) => format!("{number}: {why}"),
        None => number,
    }
}

/// The check of the equations of motion.
fn equations(check: &EquationCheck) -> String {
    let judged = match check.is_kept() {
        true => "within",
        false => "BEYOND",
    };
    let unchecked = match check.unchecked.len() {
        0 => String::new(),
        _ => format!("; not checked: {}", check.unchecked.join(", ")),
    };
    format!(
        "defect {}, {judged} its bound of {}, at {} instants and {} events (seed {}){unchecked}",
        significant(check.defect, 2),
        significant(check.bound, 2),
        check.instants,
        check.switches,
        check.seed
    )
}
