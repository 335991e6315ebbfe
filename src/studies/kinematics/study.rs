//! The study of a linkage of one input.

use super::columns::{ColumnHeading, Inputs, headings};
use super::equilibria::find_equilibria;
use super::request::span;
use super::request::{KinematicsRequest, Over};
use super::rows::{Course, Rows, equally_spaced_places, times_of_places, warnings};
use super::summary;
use super::values;
use super::{AnyLinkage, Axis, Kinematics, Limit, RowsEnd};
use crate::dynamics::model::Coordinate;
use crate::kinematics::linkage::{Cause, OutOfReach, Reach, Rounding, Workspace};
use crate::math::roots::bisect;
use crate::studies::endless::DeadEnd;
use crate::units::shown;

/// Positions, speeds and accelerations of a linkage over what was asked.
pub fn kinematics(asked: &KinematicsRequest<'_>) -> Kinematics {
    let mut rows = Rows::new(OneInput::new(asked));
    let stopped = rows.fill(&equally_spaced_places(
        span(asked),
        asked.positions,
        asked.also,
    ));
    let stopped = stopped.map(|(before, place, why)| end_of_range(asked, [before, place], &why));
    let extremes = rows.extremes();
    let Rows {
        places,
        columns,
        frames,
        ..
    } = rows;
    let closed = matches!(asked.over, Over::Turn) && stopped.is_none();
    Kinematics {
        object: asked.object.clone(),
        linkage: AnyLinkage::One(asked.linkage.clone()),
        input: asked.input,
        motion: motion(asked),
        times: match asked.over {
            Over::Time { .. } => places.clone(),
            Over::Turn | Over::Range { .. } => times_of_places(&places, asked.rate[0]),
        },
        extremes,
        strokes: summary::strokes(asked),
        equilibria: find_equilibria(asked),
        transmission: summary::transmission(asked, &places),
        limits: limits(asked),
        closed,
        warnings: warnings(&columns, places.len()),
        axis: axis(asked, places),
        columns,
        frames,
        stopped,
        plane: None,
        grid: None,
    }
}

fn axis(asked: &KinematicsRequest<'_>, values: Vec<f64>) -> Axis {
    let name = match asked.over {
        Over::Time { .. } => "time",
        Over::Turn | Over::Range { .. } => "input coordinate",
    };
    Axis {
        name,
        unit: asked.axis_unit(),
        values,
    }
}

/// Motion of the input, in words.
fn motion(asked: &KinematicsRequest<'_>) -> String {
    let unit = asked.input.unit();
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

fn limits(asked: &KinematicsRequest<'_>) -> Vec<Limit> {
    match asked.linkage.range().reach {
        Reach::Everywhere => Vec::new(),
        Reach::Interval { lower, upper } => [lower, upper]
            .map(|end| Limit {
                at: end.at,
                cause: cause_in_words(asked, end.cause),
            })
            .into(),
    }
}

/// Why the input goes no further, in words.
fn cause_in_words(asked: &KinematicsRequest<'_>, cause: Cause) -> String {
    match cause {
        Cause::DeadPosition { group } => format!(
            "dead-centre position: {} in line",
            asked.linkage.structure().describe(group)
        ),
        Cause::Travel => "end of the travel".to_owned(),
        Cause::Unexplored => "not explored further".to_owned(),
    }
}

/// The course of one input.
struct OneInput<'q, 'a> {
    asked: &'q KinematicsRequest<'a>,
    work: Workspace,
    rounding: Rounding,
}

impl<'q, 'a> OneInput<'q, 'a> {
    fn new(asked: &'q KinematicsRequest<'a>) -> Self {
        Self {
            asked,
            work: asked.linkage.workspace(),
            rounding: Rounding::of(&asked.linkage),
        }
    }
}

impl Course for OneInput<'_, '_> {
    type Outside = OutOfReach;

    fn headings(&self) -> Vec<ColumnHeading> {
        let asked = self.asked;
        headings(
            asked.linkage.spec(),
            &Inputs::One(asked.input),
            &asked.outputs,
        )
    }

    fn limits(&self) -> Vec<DeadEnd> {
        let ends = self.asked.linkage.range().dead_ends();
        match self.asked.over {
            Over::Range { .. } => ends.into_iter().map(DeadEnd::new).collect(),
            _ => Vec::new(),
        }
    }

    fn at(&mut self, place: f64, values: &mut Vec<f64>) -> Result<(), OutOfReach> {
        let q = self.asked.input_at(place);
        self.asked.linkage.solve(q.value, 3, &mut self.work)?;
        values::values(self.asked, &self.work, q, values);
        Ok(())
    }

    fn errors(&mut self, place: f64, values: &[f64], errors: &mut Vec<f64>) {
        let (asked, q) = (self.asked, self.asked.input_at(place));
        self.rounding.errors(
            q.value,
            values,
            |_, work, out| values::values(asked, work, q, out),
            errors,
        );
    }

    fn ordinary_size(&self, place: f64, heading: &ColumnHeading) -> f64 {
        let size = self.asked.linkage.typical_length();
        let unit = |turning: bool| if turning { 1.0 } else { size };
        let input = unit(self.asked.input == Coordinate::Turning);
        let q = self.asked.input_at(place);
        heading
            .quantity
            .ordinary_size(unit(heading.turning), input, q)
    }

    fn add_row(&mut self) -> Vec<[f64; 4]> {
        let links = self.asked.linkage.spec().links.len();
        let frame = (0..links).map(|link| {
            let pose = self.work.pose(link);
            [pose.x, pose.y, pose.cos, pose.sin]
        });
        frame.collect()
    }
}

/// Where the input reaches its end, between a place inside and one outside.
fn end_of_range(
    asked: &KinematicsRequest<'_>,
    [inside, outside]: [f64; 2],
    why: &OutOfReach,
) -> RowsEnd {
    let end = why.end.at;
    if !matches!(asked.over, Over::Time { .. }) {
        return RowsEnd {
            at: end,
            input: end,
            cause: cause_in_words(asked, why.end.cause),
        };
    }
    let beyond = |place: f64| {
        let q = asked.input_at(place).value;
        !(why.reach[0] < q && q < why.reach[1])
    };
    let [_, outside] = bisect([inside, outside], 200, |place| !beyond(place));
    RowsEnd {
        at: outside,
        input: end,
        cause: cause_in_words(asked, why.end.cause),
    }
}
