//! Curves over the course, χ against i, massless against full.

use super::words::driving;
use super::{ForcesReport, inputs};
use crate::math::order::by_first;
use crate::report::findings::{Layout, Section};
use crate::report::plot::{Axis, Band, Plot, Series};
use crate::report::quantity::significant;
use crate::report::verdict::capitalised;
use crate::studies::forces::{Column, ForceStudy, Forces};

/// All curves over the course.
pub(super) fn chart_sections<'a>(report: &ForcesReport<'_>) -> Vec<Section<'a>> {
    let (study, linkage) = (report.study, &report.study.linkage);
    let all = study.columns();
    let chart = |title: &str, names: Vec<(String, &str)>| over_course(report, &all, title, &names);
    let parts = |title: &str, owner: &str, parts: &[(&str, &'static str)]| {
        let names = parts
            .iter()
            .map(|(part, label)| (format!("{owner}.{part}"), *label));
        chart(title, names.collect())
    };
    let section = |title: &str, charts: Vec<Plot>| {
        let shown = charts.into_iter().filter(|chart| !chart.series.is_empty());
        Section::new(title).charts(Layout::Grid, "course", shown.collect())
    };
    let force = [("force", "size"), ("x", "x"), ("y", "y")];
    let corners = [force.as_slice(), &[("n1", "corner 1"), ("n2", "corner 2")]].concat();
    let mut reactions = Vec::new();
    for pair in &linkage.pairs {
        let title = format!("Reaction in {}", pair.name);
        reactions.push(parts(&title, &pair.name, &corners));
    }
    for weld in &linkage.welds {
        let name = &weld.name;
        reactions.push(parts(&format!("Force in {name}"), name, &force));
        reactions.push(parts(&format!("Couple in {name}"), name, &[("couple", "")]));
    }
    for coupling in &linkage.couplings {
        let title = format!("{} {}", coupling.kind.words().force, coupling.name);
        reactions.push(parts(&title, &coupling.name, &[("force", "")]));
    }
    let frame = vec![
        parts("Shaking force of the links' inertia", "shaking", &force),
        parts("Force of all pairs on the frame", "frame", &force),
    ];
    let by_friction = linkage
        .pairs
        .iter()
        .map(|pair| change(&pair.name, "friction"));
    let by_mass = linkage.links.iter().map(|link| change(&link.name, "mass"));
    let sensitivity = vec![
        chart("Change by coefficients of friction", by_friction.collect()),
        chart("Change by masses", by_mass.collect()),
    ];
    vec![
        section(&heading(study, &all), driving_charts(study, &all, &chart)),
        section("Reactions", reactions),
        section("The frame", frame),
        section(
            &format!("Sensitivity of the {}", driving(study.drive_unit())),
            sensitivity,
        ),
    ]
}

/// Name and label of the change of the driving force by something of a pair or link.
fn change<'n>(name: &'n str, what: &str) -> (String, &'n str) {
    (format!("drive_by.{name}.{what}"), name)
}

/// Makes a chart of a title and of columns, each with its label.
type Chart<'a> = dyn Fn(&str, Vec<(String, &str)>) -> Plot + 'a;

/// What drives an input, by the column that has it.
fn driven_by(all: &[Column], name: &str) -> &'static str {
    let column = all.iter().find(|column| column.name == name);
    driving(column.map_or("", |column| &column.unit))
}

/// The heading above what drives: of inputs of both kinds that of a force.
fn heading(study: &ForceStudy, all: &[Column]) -> String {
    let turns = |name: &str| driven_by(all, name) == driving("N m");
    let turns = match study.several {
        None => turns("drive"),
        Some(_) => (inputs(study).iter()).all(|name| turns(&format!("drive.{name}"))),
    };
    let kind = driving(if turns { "N m" } else { "N" });
    format!("{}, power, efficiency", capitalised(kind))
}

/// Driving forces, powers, efficiency and the dynamic transmission ratio.
fn driving_charts(study: &ForceStudy, all: &[Column], chart: &Chart<'_>) -> Vec<Plot> {
    let one = |title: &str, name: &str| chart(title, vec![(name.to_owned(), "")]);
    let mut charts = Vec::new();
    match &study.several {
        None => charts.push(one(&capitalised(driven_by(all, "drive")), "drive")),
        Some(several) => {
            let names = || several.spec.inputs.iter().map(|input| input.name.as_str());
            let of_one = |name: &str| {
                let column = format!("drive.{name}");
                let title = format!("{} at {name}", capitalised(driven_by(all, &column)));
                one(&title, &column)
            };
            charts.extend(names().map(of_one));
            let powers = names().map(|name| (format!("power.{name}"), name));
            charts.push(chart("Power of the drivers", powers.collect()));
        }
    }
    let powers = [
        ("drive", "driver"),
        ("forces", "forces"),
        ("weights", "weights"),
        ("inertia", "into motion"),
        ("loss", "friction"),
    ];
    let powers = powers.map(|(part, label)| (format!("power.{part}"), label));
    charts.push(chart("Power", powers.into()));
    charts.push(one("Efficiency", "efficiency"));
    if study.settings.output.is_some() {
        charts.push(one("Dynamic transmission ratio χ", "chi"));
    }
    charts
}

/// Quantities over the course in one chart; those without any value left out.
fn over_course(
    report: &ForcesReport<'_>,
    all: &[Column],
    title: &str,
    names: &[(String, &str)],
) -> Plot {
    let study = report.study;
    let axis = report.axis();
    let mut unit = String::new();
    let mut curves = Vec::new();
    for (name, label) in names {
        let known = |column: &&Column| column.name == *name && !column.indeterminate;
        let Some(column) = all.iter().find(known) else {
            continue;
        };
        let points: Vec<(f64, f64)> = study
            .rows
            .iter()
            .enumerate()
            .map(|(index, row)| {
                let at = axis.in_unit(study.course.parameter(index));
                (at, column.value(row).unwrap_or(f64::NAN))
            })
            .collect();
        unit.clone_from(&column.unit);
        curves.push(Series::line(label, points));
    }
    Plot {
        bands: Band::plain(shaded(report)),
        ..Plot::new(title, axis.of_chart(), &unit, curves)
    }
}

/// The zones.
fn shaded(report: &ForcesReport<'_>) -> Vec<[f64; 2]> {
    let zones = report.study.zones.iter();
    zones
        .map(|zone| [zone.from, zone.to].map(|at| report.axis().in_unit(at)))
        .collect()
}

/// χ against i; without masses and friction the line of slope ∓1.
pub(super) fn ratio_chart(report: &ForcesReport<'_>) -> Option<Plot> {
    let study = report.study;
    study.settings.output?;
    let point = |forces: &Forces| {
        let found = forces.transmission?;
        Some((found.ratio, forces.chi?, found))
    };
    let found: Vec<_> = study
        .solved()
        .filter_map(|(_, forces)| point(forces))
        .collect();
    if found.is_empty() {
        return None;
    }
    let again = found.iter().take(usize::from(study.course.is_closed()));
    let (mut points, mut before) = (Vec::new(), None);
    for (i, chi, transmission) in found.iter().chain(again) {
        // χ jumps where the output reverses: a gap, no line.
        if before.is_some_and(|sign| sign != transmission.sign) {
            points.push((*i, f64::NAN));
        }
        points.push((*i, *chi));
        before = Some(transmission.sign);
    }
    let sign = match study.settings.convention.name() {
        "paper" => -1.0,
        _ => 1.0,
    };
    let mut ideal: Vec<(f64, f64)> = found.iter().map(|(i, ..)| (*i, sign * i.abs())).collect();
    ideal.push((0.0, 0.0));
    by_first(&mut ideal);
    let convention = study.settings.convention.name();
    Some(Plot::new(
        format!("χ against i, convention {convention}"),
        Axis::new("i", &study.unit("ratio")),
        &study.unit("chi"),
        vec![
            Series::line("with friction and masses", points),
            Series::line("without", ideal),
        ],
    ))
}

/// χ over the input coordinate without masses and for each m·ω²/P; `None`
/// where the comparison was not asked for.
pub fn massless_chart(report: &ForcesReport<'_>) -> Option<Plot> {
    let found = report.massless?;
    let study = report.study;
    let axis = report.axis();
    let points = |chi: &[Option<f64>]| -> Vec<(f64, f64)> {
        let at = found.coordinates.iter().map(|q| axis.in_unit(*q));
        let values = chi.iter().map(|chi| chi.unwrap_or(f64::NAN));
        let mut points: Vec<(f64, f64)> = at.zip(values).collect();
        if let (Some(period), Some(first)) = (study.course.period(), points.first().copied()) {
            points.push((first.0 + axis.in_unit(period), first.1));
        }
        points
    };
    let without = Series::line("massless", points(&found.massless));
    let with = found.points.iter().map(|point| {
        let label = format!(
            "m·ω²/P = {}: {} %",
            significant(point.parameter, 4),
            significant(100.0 * point.deviation, 2)
        );
        Series::line(&label, points(&point.chi))
    });
    let convention = study.settings.convention.name();
    Some(Plot::new(
        format!(
            "Dynamic transmission ratio χ without masses and with them, convention {convention}"
        ),
        Axis::new("q", axis.unit()),
        &study.unit("chi"),
        std::iter::once(without).chain(with).collect(),
    ))
}
