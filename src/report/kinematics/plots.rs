//! Plots over the axis, one a quantity.

use super::axis;
use super::endless::Endless;
use crate::report::findings::{Layout, Section};
use crate::report::plot::{Plot, Rule, Series, framed};
use crate::studies::kinematics::{Column, Kinematics, Quantity};

/// The plots: links, points, sliding pairs, outputs.
pub(super) fn plot_sections<'a>(found: &Kinematics) -> Vec<Section<'a>> {
    use Quantity as Q;
    let links: Vec<String> = names(&found.linkage.spec().links, |link| {
        format!("links.{}", link.name)
    });
    let outputs = names(&found.linkage.spec().outputs, |output| output.name.clone());
    let pairs = names(&found.linkage.spec().pairs, |pair| {
        format!("pairs.{}", pair.name)
    });
    let points: Vec<String> = (found.columns.iter())
        .filter(|column| column.quantity == Q::X)
        .map(|column| column.owner.clone())
        .collect();
    let mut groups = Vec::new();
    let mut add = |title: &str, owners: &[String], rows: &[(&str, Q)]| {
        let charts = rows
            .iter()
            .flat_map(|&(name, quantity)| charts(found, name, owners, quantity));
        groups.push(Section::new(title).charts(Layout::Grid, "course", charts.collect()));
    };
    add(
        "Outputs",
        &outputs,
        &[
            ("Displacement U", Q::Displacement),
            ("Speed", Q::Speed),
            ("Acceleration", Q::Acceleration),
            ("First transfer function U′", Q::First),
            ("Second transfer function U″", Q::Second),
            ("Third transfer function U‴", Q::Third),
        ],
    );
    add(
        "Links",
        &links,
        &[
            ("Angle", Q::Angle),
            ("Angular speed", Q::AngularSpeed),
            ("Angular acceleration", Q::AngularAcceleration),
        ],
    );
    add(
        "Points",
        &points,
        &[
            ("Speed", Q::SpeedSize),
            ("Acceleration", Q::AccelerationSize),
        ],
    );
    add(
        "Sliding pairs",
        &pairs,
        &[
            ("Displacement along the guide", Q::Displacement),
            ("Relative speed", Q::RelativeSpeed),
            ("Transport speed across the guide", Q::TransportSpeedAcross),
            ("Relative acceleration", Q::RelativeAcceleration),
            (
                "Transport acceleration along the guide",
                Q::TransportAccelerationAlong,
            ),
            (
                "Transport acceleration across the guide",
                Q::TransportAccelerationAcross,
            ),
            (
                "Coriolis acceleration across the guide",
                Q::CoriolisAcceleration,
            ),
        ],
    );
    groups
}

fn names<T>(list: &[T], name: impl Fn(&T) -> String) -> Vec<String> {
    list.iter().map(name).collect()
}

/// One chart a unit; what is zero throughout gets none.
fn charts(found: &Kinematics, name: &str, owners: &[String], quantity: Quantity) -> Vec<Plot> {
    let mut charts: Vec<Plot> = Vec::new();
    let own = owners.iter().flat_map(|owner| {
        let columns = found.columns.iter();
        columns.filter(move |column| &column.owner == owner && column.quantity == quantity)
    });
    for column in own.filter(|column| column.values.iter().any(|&v| v != 0.0)) {
        let mut curve = curve(found, column);
        let unit = match column.unit.as_str() {
            "1" => "",
            // As in the tables: angles are read in degrees.
            "rad" => {
                let degrees = |point: &mut (f64, f64)| point.1 = point.1.to_degrees();
                curve.points.iter_mut().for_each(degrees);
                "deg"
            }
            unit => unit,
        };
        match charts.iter_mut().find(|chart| chart.y.unit == unit) {
            Some(chart) => chart.series.push(curve),
            None => charts.push(Plot::new(name, axis(found).of_chart(), unit, vec![curve])),
        }
    }
    let own = |column: &Column| owners.contains(&column.owner) && column.quantity == quantity;
    let endless = Endless::of(found, own);
    if !endless.ends.is_empty() {
        for chart in &mut charts {
            frame_unbounded(chart, found, &endless);
        }
    }
    charts
}

/// Frames a chart of what grows without bound by what is farther from there, and marks the
/// places.
fn frame_unbounded(chart: &mut Plot, found: &Kinematics, endless: &Endless) {
    let places = &found.axis.values;
    let shown = chart.series.iter().flat_map(|series| {
        let points = series.points.iter().zip(places);
        points.filter(|(_, at)| !endless.is_near(**at))
    });
    chart.y.range = framed(shown.map(|(point, _)| point.1));
    let ends = endless.ends.iter().map(|&at| axis(found).in_unit(at));
    chart.rules.extend(ends.map(Rule::upright));
    if let Some(rule) = chart.rules.last_mut() {
        rule.label = "grows without bound towards here".to_owned();
    }
}

fn curve(found: &Kinematics, column: &Column) -> Series {
    let points = found.axis.values.iter().zip(&column.values);
    let points = points.map(|(&at, &value)| (axis(found).in_unit(at), value));
    let owner = owner_name(&column.owner);
    let label = match &column.by {
        Some(input) => format!("{owner} by {input}"),
        None => owner.to_owned(),
    };
    Series::line(&label, points.collect())
}

/// An owner without the word that says what it is: the heading says that.
fn owner_name(owner: &str) -> &str {
    let owner = owner.strip_prefix("links.").unwrap_or(owner);
    owner.strip_prefix("pairs.").unwrap_or(owner)
}
