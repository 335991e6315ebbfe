//! The rows of a study, one after the other.

use super::ask::span;
use super::ask::{Asked, Over};
use super::columns::{self, unit_of};
use super::equilibria::equilibria;
use super::extremes::extremes;
use super::summary;
use super::values;
use super::{Axis, Column, Kinematics, Limit, Stopped};
use crate::dynamics::model::Coordinate;
use crate::kinematics::linkage::{Cause, OutOfReach, Reach, Rounding, Workspace};
use crate::math::jet::Jet;
use crate::math::roots::bisect;
use crate::units::shown;

/// Share of its own size, or of what is ordinary for it, that the error of a value may have.
const DETERMINED: f64 = 1e-3;

/// Positions, speeds and accelerations of a linkage over what was asked.
pub fn kinematics(asked: &Asked<'_>) -> Kinematics {
    let mut rows = Rows::new(asked);
    let stopped = rows.fill();
    let Rows {
        places,
        inputs,
        columns,
        frames,
        ..
    } = rows;
    let closed = matches!(asked.over, Over::Turn) && stopped.is_none();
    let extremes = extremes(asked, &places, &columns);
    Kinematics {
        object: asked.object.clone(),
        linkage: asked.linkage.clone(),
        input: asked.input,
        motion: motion(asked),
        times: times(asked, &places, &inputs),
        extremes,
        strokes: summary::strokes(asked),
        equilibria: equilibria(asked),
        transmission: summary::transmission(asked, &places),
        limits: limits(asked),
        closed,
        warnings: warnings(&columns, places.len()),
        axis: axis(asked, places),
        columns,
        frames,
        stopped,
    }
}

fn axis(asked: &Asked<'_>, values: Vec<f64>) -> Axis {
    match asked.over {
        Over::Time { .. } => Axis {
            name: "time",
            unit: "s",
            values,
        },
        _ => Axis {
            name: "input coordinate",
            unit: unit_of(asked.input),
            values,
        },
    }
}

/// Quantities that are not determined somewhere, or beyond what can be written as a number.
fn warnings(columns: &[Column], rows: usize) -> Vec<String> {
    let mut warnings = Vec::new();
    let doubtful = columns.iter().filter(|column| column.undetermined > 0);
    if let Some(names) = named(doubtful.clone()) {
        let most = doubtful.map(|column| column.undetermined).max();
        warnings.push(format!(
            "{names} cannot be told at up to {} of {rows} positions: so near to a singular position \
             rounding changes them by more than {} of their size",
            most.unwrap_or(0),
            shown(DETERMINED, 1)
        ));
    }
    let lost = |column: &&Column| {
        let missing = column.values.iter().filter(|value| !value.is_finite());
        !column.quantity.passes_infinity() && missing.count() > column.undetermined
    };
    if let Some(names) = named(columns.iter().filter(lost)) {
        warnings.push(format!(
            "{names} grow beyond all numbers: the speed is too great"
        ));
    }
    warnings
}

/// The first of several columns by its name, and how many others there are.
fn named<'c>(mut columns: impl Iterator<Item = &'c Column>) -> Option<String> {
    let first = columns.next()?.name();
    Some(match columns.count() {
        0 => format!("`{first}`"),
        1 => format!("`{first}` and another"),
        count => format!("`{first}` and {count} others"),
    })
}

/// Motion of the input, in words.
fn motion(asked: &Asked<'_>) -> String {
    let unit = unit_of(asked.input);
    let [speed, acceleration] = asked.rate;
    match asked.over {
        Over::Time { .. } => "by the scene's drive".to_owned(),
        _ if asked.unit_rate && acceleration == 0.0 => format!(
            "speed 1 {unit}/s at every position (no speed is given: speeds are first transfer \
             functions)"
        ),
        _ => even_motion([speed, acceleration], unit),
    }
}

/// Speed and acceleration that are the same at every position, in words.
pub fn even_motion([speed, acceleration]: [f64; 2], unit: &str) -> String {
    let speed = shown(speed, 8);
    if acceleration == 0.0 {
        return format!("speed {speed} {unit}/s at every position");
    }
    let acceleration = shown(acceleration, 8);
    format!("speed {speed} {unit}/s and acceleration {acceleration} {unit}/s² at every position")
}

/// Time of each row: at constant speed over a turn or range.
fn times(asked: &Asked<'_>, places: &[f64], inputs: &[Jet]) -> Vec<f64> {
    match asked.over {
        Over::Time { .. } => places.to_vec(),
        _ => {
            let speed = asked.rate[0].abs();
            let speed = if speed > 0.0 { speed } else { 1.0 };
            let from = inputs.first().map_or(0.0, |jet| jet.value);
            let time = |jet: &Jet| (jet.value - from).abs() / speed;
            inputs.iter().map(time).collect()
        }
    }
}

fn limits(asked: &Asked<'_>) -> Vec<Limit> {
    match asked.linkage.range().reach {
        Reach::Everywhere => Vec::new(),
        Reach::Interval { lower, upper } => [lower, upper]
            .map(|end| Limit {
                at: end.at,
                cause: cause(asked, end.cause),
            })
            .into(),
    }
}

/// Why the input goes no further, in words.
fn cause(asked: &Asked<'_>, cause: Cause) -> String {
    match cause {
        Cause::DeadPosition { group } => format!(
            "dead position: {} in line",
            asked.linkage.structure().describe(group)
        ),
        Cause::Travel => "end of the travel".to_owned(),
        Cause::Unexplored => "not explored further".to_owned(),
    }
}

/// Rows under construction.
struct Rows<'q, 'a> {
    asked: &'q Asked<'a>,
    work: Workspace,
    rounding: Rounding,
    errors: Vec<f64>,
    places: Vec<f64>,
    inputs: Vec<Jet>,
    columns: Vec<Column>,
    /// Of each column: true for an angle and its derivatives.
    turning: Vec<bool>,
    frames: Vec<Vec<[f64; 4]>>,
}

impl<'q, 'a> Rows<'q, 'a> {
    fn new(asked: &'q Asked<'a>) -> Self {
        let headings = columns::headings(asked);
        let turning = headings.iter().map(|heading| heading.turning).collect();
        let column = |heading: columns::Heading| Column {
            owner: heading.owner,
            quantity: heading.quantity,
            unit: heading.unit,
            values: Vec::with_capacity(asked.positions + 1),
            error: 0.0,
            undetermined: 0,
        };
        Self {
            asked,
            work: asked.linkage.workspace(),
            rounding: Rounding::of(&asked.linkage),
            errors: Vec::new(),
            places: Vec::new(),
            inputs: Vec::new(),
            columns: headings.into_iter().map(column).collect(),
            turning,
            frames: Vec::new(),
        }
    }

    /// All rows up to the end, or up to where the linkage goes no further.
    fn fill(&mut self) -> Option<Stopped> {
        let [from, to] = span(self.asked);
        let count = self.asked.positions;
        let mut values = Vec::new();
        let mut places: Vec<f64> = (0..=count)
            .map(|index| from + (to - from) * index as f64 / count as f64)
            .collect();
        if let Some(also) = self.asked.also {
            let sense = (to - from).signum();
            let at = places.partition_point(|place| (place - also) * sense < 0.0);
            if places.get(at) != Some(&also) {
                places.insert(at, also);
            }
        }
        for place in places {
            if let Err(outside) = self.row(place, &mut values) {
                let before = self.places.last().copied().unwrap_or(from);
                return Some(self.stop(before, place, &outside));
            }
        }
        None
    }

    fn row(&mut self, place: f64, values: &mut Vec<f64>) -> Result<(), OutOfReach> {
        let q = self.asked.input_at(place);
        self.asked.linkage.solve(q.value, 3, &mut self.work)?;
        values::values(self.asked, &self.work, q, values);
        let asked = self.asked;
        self.rounding.errors(
            q.value,
            values,
            |_, work, out| values::values(asked, work, q, out),
            &mut self.errors,
        );
        let size = asked.linkage.size();
        let unit = |turning: bool| if turning { 1.0 } else { size };
        let input = unit(asked.input == Coordinate::Turning);
        let found = values.iter().zip(&self.errors);
        let columns = self.columns.iter_mut().zip(&self.turning);
        for ((column, turning), (value, error)) in columns.zip(found) {
            let own = unit(*turning);
            let ordinary = column.quantity.scale(own, input, q).max(value.abs());
            if *error > DETERMINED * ordinary {
                let counts = value.is_finite() && !column.quantity.passes_infinity();
                column.undetermined += usize::from(counts);
                column.values.push(f64::NAN);
            } else {
                column.error = column.error.max(*error);
                column.values.push(*value);
            }
        }
        let links = self.asked.linkage.spec().links.len();
        let frame = (0..links).map(|link| {
            let pose = self.work.pose(link);
            [pose.x, pose.y, pose.cos, pose.sin]
        });
        self.frames.push(frame.collect());
        self.places.push(place);
        self.inputs.push(q);
        Ok(())
    }

    /// Where the input reaches its end, between a place inside and one outside.
    fn stop(&self, inside: f64, outside: f64, why: &OutOfReach) -> Stopped {
        let end = why.end.at;
        if !matches!(self.asked.over, Over::Time { .. }) {
            return Stopped {
                at: end,
                input: end,
                cause: cause(self.asked, why.end.cause),
            };
        }
        let beyond = |place: f64| {
            let q = self.asked.input_at(place).value;
            !(why.reach[0] < q && q < why.reach[1])
        };
        let [_, outside] = bisect([inside, outside], 200, |place| !beyond(place));
        Stopped {
            at: outside,
            input: end,
            cause: cause(self.asked, why.end.cause),
        }
    }
}
