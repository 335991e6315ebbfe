//! What changes the driving force and χ: coefficients, masses, leaving masses out.

use super::charts::massless_chart;
use super::words::{cause_words, driving};
use super::{ForcesReport, WIDE, value};
use crate::report::findings::{Cell, Figure, Section, Table, Value};
use crate::report::quantity::significant;
use crate::studies::forces::{Column, MasslessComparison, NEGLIGIBLE};

/// The greatest derivative of the driving force by each coefficient and mass.
pub(super) fn sensitivities_section<'a>(report: &ForcesReport<'_>) -> Section<'a> {
    let study = report.study;
    let all = study.columns();
    let greatest = |column: &Column| {
        let values = study.rows.iter().enumerate();
        let values = values.filter_map(|(index, row)| Some((index, column.value(row)?)));
        values.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
    };
    let cause = |name: &str| Cell::address(name, cause_words(name));
    let row = |column: &Column| {
        let name = column.name.strip_prefix("drive_by.")?;
        let (index, by) = greatest(column).filter(|(_, by)| *by != 0.0)?;
        let mut endless = study.unbounded.iter();
        if let Some((_, at)) = endless.find(|(known, _)| *known == column.name) {
            let place = format!("→ {}", report.place_text(*at));
            let unbounded = Cell::with_note("unbounded", place);
            return Some(vec![cause(name), unbounded, "unbounded".into()]);
        }
        let place = report.place_text(study.course.parameter(index));
        let chi = format!("chi_by.{name}");
        let chi = all.iter().find(|other| other.name == chi);
        let chi = chi.and_then(|chi| Some(value(greatest(chi)?.1, &chi.unit)));
        let by = Cell::with_note(value(by, &column.unit), format!("at {place}"));
        Some(vec![cause(name), by, chi.unwrap_or("".into()).into()])
    };
    let drive = format!(">of the {}", driving(study.drive_unit()));
    Section::new("Greatest change by coefficients of friction and masses")
        .table(Table::new(["by", &drive, ">of χ"]).rows(all.iter().filter_map(row)))
}

pub(super) fn massless_section<'a>(report: &ForcesReport<'_>) -> Section<'a> {
    let (Some(found), Some(chart)) = (report.massless, massless_chart(report)) else {
        return Section::default();
    };
    let study = report.study;
    let [load, chi, speed] = ["load", "chi", "speed"].map(|name| study.unit(name));
    let figures = vec![
        Figure::new("moving mass", value(found.mass, "kg")),
        Figure::new("load", value(found.load, &load)),
        Figure::new("greatest |χ| without masses", value(found.greatest, &chi)),
    ];
    let rows = found.points.iter().map(|point| {
        let missing = match point.missing {
            0 => String::new(),
            count => format!("at {count} positions only one model moves"),
        };
        vec![
            Value::new(point.parameter, "", 4),
            value(point.speed, &speed),
            Value::new(100.0 * point.deviation, "%", 3),
            missing.into(),
        ]
    });
    let parameter = format!(">{}", parameter_name(study.coordinate_unit(), &load));
    let table = Table::new([parameter.as_str(), ">speed", ">greatest change", ""]).rows(rows);
    Section::new("Massless against full model")
        .figures(figures)
        .charts(WIDE, "", vec![chart])
        .table(table)
        .with_paragraph(verdict(found))
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
fn verdict(found: &MasslessComparison) -> String {
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
