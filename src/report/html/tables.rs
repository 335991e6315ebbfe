//! Tables of a page: figures, pairs, switches, statistics.

use super::{facts, number};
use crate::dynamics::record::{
    EnergyAudit, Figures, ObjectFigures, PairFigures, Record, SwitchRow, Units,
};
use crate::report::quantity::{escape, scale, significant, with_unit};

/// A value with its unit for reading.
fn cell(value: f64, unit: &str) -> String {
    format!("<td>{}</td>", number(value, unit, 6))
}

fn head(names: &[&str]) -> String {
    let cells: String = names
        .iter()
        .map(|name| format!("<th>{name}</th>"))
        .collect();
    format!("<thead><tr>{cells}</tr></thead>\n")
}

fn table(head: &str, rows: &str) -> String {
    format!("<div class=\"scroll\"><table>\n{head}<tbody>\n{rows}</tbody></table></div>\n")
}

/// Units of an object; SI turning units when the document names none.
pub(in crate::report) fn units(figures: &Figures, id: &str) -> Units {
    figures.units.get(id).copied().unwrap_or(Units {
        displacement: "rad",
        force: "N m",
    })
}

/// Name of an object as the head of its row, linking to its plots.
fn name(id: &str) -> String {
    let id = escape(id);
    format!("<th title=\"{id}\"><a href=\"#object-{id}\">{id}</a></th>")
}

/// Figures of every object.
pub fn figures(figures: &Figures) -> String {
    let head = head(&[
        "Object",
        "greatest <span class=\"nobr\">|δ|</span>",
        "σ, mean <span class=\"nobr\">|δ|</span>",
        "peak speed",
        "peak acceleration",
        "peak reaction",
        "displacement at the end",
        "speed at the end",
    ]);
    let row = |(id, object): (&String, &ObjectFigures)| {
        let units = units(figures, id);
        let displacement = units.displacement;
        let speed = format!("{displacement}/s");
        let cells = [
            (object.sigma, displacement),
            (object.peak_speed, &speed),
            (object.peak_acceleration, &format!("{displacement}/s²")),
            (object.peak_reaction, units.force),
            (object.end.displacement, displacement),
            (object.end.speed, &speed),
        ];
        let cells: String = cells
            .iter()
            .map(|(value, unit)| cell(*value, unit))
            .collect();
        let deviation = deviation(object, displacement);
        format!("<tr>{}{deviation}{cells}</tr>\n", name(id))
    };
    table(&head, &figures.objects.iter().map(row).collect::<String>())
}

/// Greatest |δ|, and below it the extremes of δ in the same scale.
fn deviation(object: &ObjectFigures, unit: &str) -> String {
    if !(object.delta_abs > 0.0) {
        return cell(object.delta_abs, unit);
    }
    let shown = scale(object.delta_abs, unit);
    let end = |value: f64| significant(value / shown.factor, 4);
    format!(
        "{}<span class=\"sub\">{} to {} {}</span></td>",
        cell(object.delta_abs, unit).trim_end_matches("</td>"),
        end(object.delta_min),
        end(object.delta_max),
        escape(&shown.unit)
    )
}

/// Figures of every pair that can open; nothing when there is none.
pub fn pairs(figures: &Figures) -> String {
    let row = |(id, object): (&String, &ObjectFigures)| {
        let pair = object.pair.as_ref()?;
        Some(pair_row(id, pair, units(figures, id)))
    };
    let rows: String = figures.objects.iter().filter_map(row).collect();
    if rows.is_empty() {
        return String::new();
    }
    let head = head(&[
        "Driving pair",
        "in working order",
        "separations",
        "closures",
        "time open",
        "longest opening",
        "greatest lift",
        "greatest approach speed",
        "greatest contact force",
    ]);
    table(&head, &rows)
}

/// Figures of every stop; nothing when there is none.
pub fn stops(figures: &Figures) -> String {
    let row = |(id, object): (&String, &ObjectFigures)| {
        let (stop, units) = (object.stop.as_ref()?, units(figures, id));
        Some(format!(
            "<tr>{}<td>{}</td>{}{}{}{}</tr>\n",
            name(id),
            stop.closures,
            cell(stop.contact_time, "s"),
            cell(
                stop.max_approach_speed,
                &format!("{}/s", units.displacement)
            ),
            cell(stop.max_contact_force, units.force),
            cell(stop.max_indentation, units.displacement),
        ))
    };
    let rows: String = figures.objects.iter().filter_map(row).collect();
    if rows.is_empty() {
        return String::new();
    }
    let head = head(&[
        "Stop",
        "closures",
        "time in contact",
        "greatest approach speed",
        "greatest contact force",
        "greatest indentation",
    ]);
    table(&head, &rows)
}

/// Figures of every linkage whose joints have friction; nothing when there is none.
pub fn joints(figures: &Figures) -> String {
    let row = |(id, object): (&String, &ObjectFigures)| {
        let joints = object.joints.as_ref()?;
        Some(format!(
            "<tr>{}<td>{}</td>{}{}</tr>\n",
            name(id),
            joints.standstills,
            cell(joints.time_at_rest, "s"),
            cell(joints.friction_loss, "J"),
        ))
    };
    let rows: String = figures.objects.iter().filter_map(row).collect();
    if rows.is_empty() {
        return String::new();
    }
    let head = head(&[
        "Joint friction",
        "standstills",
        "time at rest",
        "energy lost",
    ]);
    table(&head, &rows)
}

fn pair_row(id: &str, pair: &PairFigures, units: Units) -> String {
    let order = match (pair.margin, pair.in_working_order) {
        (Some(margin), _) => {
            let (class, word) = if margin < 0.0 {
                ("no", "would lift off")
            } else {
                ("yes", "yes")
            };
            format!(
                "<td class=\"{class}\">{word}<span class=\"sub\">least force {}</span></td>",
                with_unit(margin, units.force, 5)
            )
        }
        (None, Some(true)) => "<td class=\"yes\">yes</td>".into(),
        (None, Some(false)) => "<td class=\"no\">no</td>".into(),
        (None, None) => "<td>not judged</td>".into(),
    };
    let speed = format!("{}/s", units.displacement);
    let force = match pair.max_indentation {
        None => cell(pair.max_contact_force, units.force),
        Some(depth) => format!(
            "<td>{}<span class=\"sub\">indentation {}</span></td>",
            with_unit(pair.max_contact_force, units.force, 5),
            with_unit(depth, units.displacement, 5)
        ),
    };
    format!(
        "<tr>{}{order}<td>{}</td><td>{}</td>{}{}{}{}{}</tr>\n",
        name(id),
        pair.separations,
        pair.closures,
        cell(pair.separated_time, "s"),
        cell(pair.longest_separation, "s"),
        cell(pair.max_lift, units.displacement),
        cell(pair.max_approach_speed, &speed),
        force,
    )
}

/// Up to this many switches are listed openly; more are folded away.
const OPEN_LIST: usize = 12;

/// All switches in order of time.
pub fn switches(record: &Record, figures: &Figures) -> String {
    let count = record.switches.len();
    if count == 0 {
        return "<h2>Switches</h2>\n<p>No pair opens or closes during the run.</p>\n".into();
    }
    let head = head(&[
        "No.",
        "time, s",
        "object",
        "pair",
        "flank",
        "speed of approach or parting",
    ]);
    let row = |(index, row): (usize, &SwitchRow)| {
        let unit = format!("{}/s", units(figures, &row.object).displacement);
        format!(
            "<tr><td>{}</td><td>{}</td><td class=\"left\">{}</td><td class=\"left\">{}</td>\
             <td class=\"left\">{}</td><td>{}</td></tr>\n",
            index + 1,
            significant(row.time, 12),
            escape(&row.object),
            row.what,
            row.flank,
            with_unit(row.speed, &unit, 6)
        )
    };
    let rows: String = record.switches.iter().enumerate().map(row).collect();
    let table = format!("<table>\n{head}<tbody>\n{rows}</tbody></table>\n");
    if count <= OPEN_LIST {
        return format!("<h2>Switches</h2>\n<div class=\"scroll\">{table}</div>\n");
    }
    let last = &record.switches[count - 1];
    format!(
        "<h2>Switches</h2>\n<details>\n<summary>{count} switches between {} and {}</summary>\n\
         <div class=\"tall\">{table}</div>\n</details>\n",
        with_unit(record.switches[0].time, "s", 6),
        with_unit(last.time, "s", 6)
    )
}

/// How the run went.
pub fn statistics(figures: &Figures) -> String {
    let run = &figures.run;
    let bound = EnergyAudit::bound(run.tolerance);
    let judged = if run.energy_error <= bound {
        "within"
    } else {
        "beyond"
    };
    let end = match (&run.stopped, run.complete) {
        (_, true) => "complete".to_owned(),
        (Some(name), false) => format!("stopped: {}", name.replace('_', " ")),
        (None, false) => "incomplete".to_owned(),
    };
    let mut rows = vec![
        (
            "Time reached",
            format!("{}, {end}", with_unit(run.time, "s", 9)),
        ),
        ("Method", run.method.clone()),
        ("Why", run.why.clone()),
        ("Tolerance", significant(run.tolerance, 3)),
        (
            "Energy error",
            format!(
                "{}, {judged} its bound of {}",
                significant(run.energy_error, 3),
                significant(bound, 3)
            ),
        ),
        (
            "Steps",
            format!("{} accepted, {} rejected", run.steps, run.rejected),
        ),
        ("Evaluations", run.evaluations.to_string()),
        ("Switches of pairs", run.switches.to_string()),
    ];
    if let Some(reason) = &run.stopped_because {
        rows.insert(1, ("Reason", reason.clone()));
    }
    format!("<h2>Run</h2>\n{}", facts(&rows))
}
