//! What linkages of several inputs have beside those of one: the machine with a slider for
//! each input, and their singular positions.

use super::drawing::placements;
use super::{coordinate, input};
use crate::kinematics::linkage::multi::{MultiLinkage, SingularCurve};
use crate::report::findings::{Layout, Section, Table};
use crate::report::mechanism::{Drawing, GridAxis};
use crate::report::plot::{Axis, Plot, Series};
use crate::studies::kinematics::{Kinematics, Plane, PlaneInput};

/// Meaning of all inputs, and how far the one that moves goes.
pub(super) fn inputs(found: &Kinematics, linkage: &MultiLinkage) -> String {
    let names: Vec<String> = (linkage.inputs().iter())
        .map(|input| format!("{} ({})", input.name, linkage.describe(input)))
        .collect();
    let limits: Vec<String> = (found.limits.iter())
        .map(|limit| format!("{} ({})", input(found, limit.at), limit.cause))
        .collect();
    match limits.as_slice() {
        [from, to] => format!("Inputs: {}; from {from} to {to}.", names.join(", ")),
        _ => format!("Inputs: {}.", names.join(", ")),
    }
}

/// The machine over the ranges of its inputs, with a slider for each.
pub(super) fn machine_section<'a>(found: &'a Kinematics) -> Section<'a> {
    match found.grid {
        Some(_) => Section::new("Positions over the inputs")
            .drawing(move |_| over_inputs(found).unwrap_or_default()),
        None => Section::default(),
    }
}

fn over_inputs(found: &Kinematics) -> Option<String> {
    let grid = found.grid.as_ref()?;
    let axes = grid.axes.iter().map(|(name, own, values)| GridAxis {
        name: name.clone(),
        unit: own.displacement_for_reading(0.0).1.to_owned(),
        values: values
            .iter()
            .map(|&value| own.displacement_for_reading(value).0)
            .collect(),
    });
    let drawing = Drawing {
        spec: found.linkage.spec(),
        frames: grid.frames.iter().map(|frame| placements(frame)).collect(),
        axis: crate::report::mechanism::Axis::default(),
        paths: Vec::new(),
        arrows: Vec::new(),
    };
    Some(drawing.section_over("inputs", &axes.collect::<Vec<_>>(), grid.start))
}

/// The singular positions: curves in the plane of two inputs.
pub(super) fn singular_section<'a>(found: &Kinematics) -> Section<'a> {
    let Some(plane) = &found.plane else {
        return Section::default();
    };
    let [one, other] = &plane.inputs;
    let looked = format!(
        "{} from {} to {}, {} from {} to {}",
        one.name,
        coordinate(one.coordinate, one.range[0]),
        coordinate(one.coordinate, one.range[1]),
        other.name,
        coordinate(other.coordinate, other.range[0]),
        coordinate(other.coordinate, other.range[1])
    );
    let section = Section::new("Singular positions");
    if plane.curves.is_empty() {
        return section.with_paragraph(format!("None is seen over {looked}."));
    }
    let end = |input: &PlaneInput, curve: &SingularCurve, k: usize| {
        let values = || curve.points.iter().map(|point| point[k]);
        let from = values().fold(f64::INFINITY, f64::min);
        let to = values().fold(f64::NEG_INFINITY, f64::max);
        [from, to].map(|at| coordinate(input.coordinate, at))
    };
    let rows = plane.curves.iter().map(|curve| {
        let [[from, to], [low, high]] = [end(one, curve, 0), end(other, curve, 1)];
        let course = if curve.closed { "closed" } else { "open" };
        vec![
            found.linkage.structure().describe(curve.group),
            course.to_owned(),
            curve.points.len().to_string(),
            format!("{from} to {to}"),
            format!("{low} to {high}"),
        ]
    });
    let names = [one, other].map(|input| format!(">{}", input.name));
    let table = Table::new(["group", "curve", ">points", &names[0], &names[1]]).rows(rows);
    section
        .table(table)
        .with_paragraph(format!(
            "On these curves the determinant of a group vanishes: speeds and forces grow without \
             bound. Ranges are those of the points; between them a curve goes a little further. \
             Examined: {looked}."
        ))
        .charts(Layout::Grid, "", vec![chart(found, plane)])
}

fn chart(found: &Kinematics, plane: &Plane) -> Plot {
    let [one, other] = &plane.inputs;
    let point = |&[x, y]: &[f64; 2]| {
        (
            one.coordinate.displacement_for_reading(x).0,
            other.coordinate.displacement_for_reading(y).0,
        )
    };
    let mut groups: Vec<usize> = plane.curves.iter().map(|curve| curve.group).collect();
    groups.sort_unstable();
    groups.dedup();
    let mut series: Vec<Series> = Vec::new();
    for group in groups {
        let mut points = Vec::new();
        for curve in plane.curves.iter().filter(|curve| curve.group == group) {
            points.extend(curve.points.iter().map(point));
            // Not a number: the next one is another curve.
            points.push((f64::NAN, f64::NAN));
        }
        series.push(Series::line(
            &found.linkage.structure().describe(group),
            points,
        ));
    }
    let path = plane.path.iter().map(point);
    series.push(Series::theory("path of the inputs", path.collect()));
    let axis = |input: &PlaneInput| Axis {
        range: Some(
            input
                .range
                .map(|value| input.coordinate.displacement_for_reading(value).0),
        ),
        ..Axis::new(
            &input.name,
            input.coordinate.displacement_for_reading(0.0).1,
        )
    };
    Plot {
        id: "singular".to_owned(),
        title: "Singular positions".to_owned(),
        x: axis(one),
        y: axis(other),
        series,
        ..Plot::default()
    }
}
