//! Curves over the course, χ against i, massless against full.

use super::ForcesReport;
use crate::math::order::by_first;
use crate::report::findings::{Layout, Section};
use crate::report::plot::{Axis, Band, Plot, Series};
use crate::report::quantity::significant;
use crate::studies::forces::Column;

/// All curves over the course.
pub(super) fn groups<'a>(report: &ForcesReport<'_>) -> Vec<Section<'a>> {
    let study = report.study;
    let all = study.columns();
    let chart = |title: &str, names: &[(String, &str)]| over_course(report, &all, title, names);
    let one = |title: &str, name: &str| chart(title, &[(name.to_owned(), "")]);
    let mut drive = match &study.several {
        None => vec![one("Driving force", "drive")],
        Some(several) => (several.spec.inputs.iter())
            .map(|input| {
                let name = format!("drive.{}", input.name);
                one(&format!("Driving force at {}", input.name), &name)
            })
            .collect(),
    };
    if let Some(several) = &study.several {
        let names = several.spec.inputs.iter();
        let names: Vec<(String, &str)> = names
            .map(|input| (format!("power.{}", input.name), input.name.as_str()))
            .collect();
        drive.push(chart("Power of the drivers", &names));
    }
    drive.push(chart(
        "Power",
        &[
            ("power.drive".to_owned(), "driver"),
            ("power.forces".to_owned(), "forces"),
            ("power.weights".to_owned(), "weights"),
            ("power.inertia".to_owned(), "into motion"),
            ("power.loss".to_owned(), "friction"),
        ],
    ));
    drive.push(one("Efficiency", "efficiency"));
    if study.settings.output.is_some() {
        drive.push(one("Dynamic transmission ratio χ", "chi"));
    }
    let pairs = study.linkage.pairs.iter().map(|pair| {
        let part = |what: &str| format!("{}.{what}", pair.name);
        chart(
            &format!("Reaction in {}", pair.name),
            &[
                (part("force"), "size"),
                (part("x"), "x"),
                (part("y"), "y"),
                (part("n1"), "corner 1"),
                (part("n2"), "corner 2"),
            ],
        )
    });
    let welds = study.linkage.welds.iter().flat_map(|weld| {
        let part = |what: &str| format!("{}.{what}", weld.name);
        let force = [(part("force"), "size"), (part("x"), "x"), (part("y"), "y")];
        let couple = [(part("couple"), "")];
        [
            chart(&format!("Force in {}", weld.name), &force),
            chart(&format!("Couple in {}", weld.name), &couple),
        ]
    });
    let couplings = study.linkage.couplings.iter().map(|coupling| {
        let title = format!("{} {}", coupling.kind.words().force, coupling.name);
        one(&title, &format!("{}.force", coupling.name))
    });
    let frame = ["shaking", "frame"].map(|name| {
        let part = |what: &str| format!("{name}.{what}");
        let title = match name {
            "shaking" => "Shaking force of the links' inertia",
            _ => "Force of all pairs on the frame",
        };
        chart(
            title,
            &[(part("force"), "size"), (part("x"), "x"), (part("y"), "y")],
        )
    });
    let names = study.linkage.pairs.iter();
    let by_friction: Vec<(String, &str)> = names
        .map(|pair| {
            (
                format!("drive_by.{}.friction", pair.name),
                pair.name.as_str(),
            )
        })
        .collect();
    let names = study.linkage.links.iter();
    let by_mass: Vec<(String, &str)> = names
        .map(|link| (format!("drive_by.{}.mass", link.name), link.name.as_str()))
        .collect();
    let changes = [
        chart(
            "Change of the driving force by coefficients of friction",
            &by_friction,
        ),
        chart("Change of the driving force by masses", &by_mass),
    ];
    let section = |title: &str, charts: Vec<Plot>| {
        let shown = charts.into_iter().filter(|chart| !chart.series.is_empty());
        Section::new(title).charts(Layout::Grid, "course", shown.collect())
    };
    vec![
        section("Driving force, power, efficiency", drive),
        section("Reactions", pairs.chain(welds).chain(couplings).collect()),
        section("The frame", frame.into()),
        section("Sensitivity", changes.into()),
    ]
}

/// Quantities over the course in one chart; those without any value left out.
fn over_course(
    report: &ForcesReport<'_>,
    all: &[Column],
    title: &str,
    names: &[(String, &str)],
) -> Plot {
    let study = report.study;
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
                let at = report.axis_value(study.course.parameter(index));
                (at, column.value(row).unwrap_or(f64::NAN))
            })
            .collect();
        unit.clone_from(&column.unit);
        curves.push(Series::line(label, points));
    }
    Plot {
        title: title.to_owned(),
        y: Axis::of(&unit),
        series: curves,
        bands: Band::plain(shaded(report)),
        x: Axis::new(report.axis_symbol(), report.axis_unit()),
        ..Plot::default()
    }
}

/// The zones.
fn shaded(report: &ForcesReport<'_>) -> Vec<[f64; 2]> {
    let zones = report.study.zones.iter();
    zones
        .map(|zone| [zone.from, zone.to].map(|at| report.axis_value(at)))
        .collect()
}

/// χ against i; without masses and friction the line of slope ∓1.
pub(super) fn ratio_chart(report: &ForcesReport<'_>) -> Option<Plot> {
    let study = report.study;
    study.settings.output?;
    let point = |forces: &crate::studies::forces::Forces| {
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
    let unit = |name: &str| {
        let all = study.columns();
        let column = all.into_iter().find(|column| column.name == name);
        column.map_or(String::new(), |column| column.unit)
    };
    Some(Plot {
        title: format!(
            "χ against i, convention {}",
            study.settings.convention.name()
        ),
        y: Axis::of(&unit("chi")),
        series: vec![
            Series::line("with friction and masses", points),
            Series::line("without", ideal),
        ],
        x: Axis::new("i", &unit("ratio")),
        ..Plot::default()
    })
}

/// χ over the input coordinate without masses and for each m·ω²/P; `None`
/// where the comparison was not asked for.
pub fn massless_chart(report: &ForcesReport<'_>) -> Option<Plot> {
    let found = report.massless?;
    let study = report.study;
    let all = study.columns();
    let unit = all.into_iter().find(|column| column.name == "chi");
    let points = |chi: &[Option<f64>]| -> Vec<(f64, f64)> {
        let at = found.coordinates.iter().map(|q| report.axis_value(*q));
        let values = chi.iter().map(|chi| chi.unwrap_or(f64::NAN));
        let mut points: Vec<(f64, f64)> = at.zip(values).collect();
        if let (Some(period), Some(first)) = (study.course.period(), points.first().copied()) {
            points.push((first.0 + report.axis_value(period), first.1));
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
    Some(Plot {
        title: format!(
            "Dynamic transmission ratio χ without masses and with them, convention {}",
            study.settings.convention.name()
        ),
        y: Axis::of(&unit.map_or(String::new(), |column| column.unit)),
        series: std::iter::once(without).chain(with).collect(),
        x: Axis::new("q", report.axis_unit()),
        ..Plot::default()
    })
}
