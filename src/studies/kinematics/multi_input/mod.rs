//! Kinematics of linkages of several inputs: over the way of one input or of several, or over
//! the time of the scene's drives; the singular positions over two of them.

mod course;
mod input_range;
mod plane;
mod request;
mod resolved_request;
mod values;

pub use request::AskedSeveral;

use super::columns::Inputs;
use super::figures::{NamedFigure, Places, figures_of};
use super::rows::{Course, Rows, equally_spaced_places, times_of_places, warnings};
use super::summary::{stroke_of, transmission_of};
use super::{AnyLinkage, Axis, Kinematics, Limit, Quantity, RowsEnd, Stroke, Transmission};
use crate::dynamics::model::Coordinate;
use crate::kinematics::linkage::multi::NotAssembled;
use crate::math::roots::bisect;
use course::SeveralInputs;
use request::Advance;

/// Positions, speeds and accelerations of a linkage of several inputs over what was asked.
pub fn multi_input_kinematics(asked: &AskedSeveral<'_>) -> Kinematics {
    let mut rows = Rows::new(SeveralInputs::new(asked));
    let places = equally_spaced_places(asked.span(), asked.positions, asked.also);
    let stopped = rows.fill(&places);
    let stopped = stopped.map(|(before, place, why)| end_of_range(asked, [before, place], why));
    let extremes = rows.extremes();
    let closed = asked.closed && stopped.is_none();
    let strokes = match closed {
        true => strokes(asked, &mut rows),
        false => Vec::new(),
    };
    let transmission = transmission(asked, &rows.places);
    let (plane, grid) = (plane::plane(asked, &rows.places), plane::grid(asked));
    let Rows {
        places,
        columns,
        frames,
        ..
    } = rows;
    Kinematics {
        object: asked.object.clone(),
        linkage: AnyLinkage::Several(asked.linkage.clone()),
        input: asked.first_coordinate(),
        motion: asked.motion(),
        times: times_of_places(&places, asked.axis_rate()),
        closed,
        extremes,
        strokes,
        equilibria: Vec::new(),
        transmission,
        limits: limits(asked),
        warnings: warnings(&columns, places.len()),
        axis: axis(asked, places),
        columns,
        frames,
        stopped,
        plane,
        grid,
    }
}

impl AskedSeveral<'_> {
    /// All figures that a study of this question can have.
    pub fn figures(&self) -> Vec<NamedFigure> {
        let (_, way) = self.axis();
        let places = Places {
            rows: way,
            input: way,
        };
        let spec = &self.linkage.spec().linkage;
        figures_of(spec, &self.named(), &self.outputs, places)
    }

    /// The inputs with their names.
    pub(super) fn named(&self) -> Inputs<'_> {
        let inputs = self.inputs.iter().enumerate();
        Inputs::Several(
            inputs
                .map(|(input, own)| (self.name(input), *own))
                .collect(),
        )
    }

    /// Why a group cannot be assembled, in words.
    pub(in crate::studies) fn cause_in_words(
        &self,
        NotAssembled { group }: NotAssembled,
    ) -> String {
        format!(
            "singular position of {}",
            self.linkage.structure().describe(group)
        )
    }
}

fn axis(asked: &AskedSeveral<'_>, values: Vec<f64>) -> Axis {
    let (name, unit) = asked.axis();
    Axis { name, unit, values }
}

fn limits(asked: &AskedSeveral<'_>) -> Vec<Limit> {
    let limit = |(at, why): &(f64, NotAssembled)| Limit {
        at: *at,
        cause: asked.cause_in_words(*why),
    };
    asked.limits.iter().map(limit).collect()
}

/// Where the linkage goes no further, between a place inside and one outside.
fn end_of_range(
    asked: &AskedSeveral<'_>,
    [inside, outside]: [f64; 2],
    why: NotAssembled,
) -> RowsEnd {
    let mut course = SeveralInputs::new(asked);
    let mut why = why;
    let [_, at] = bisect([inside, outside], 100, |place| {
        match course.set_place(place) {
            Ok(()) => true,
            Err(found) => {
                why = found;
                false
            }
        }
    });
    let input = match asked.way {
        Advance::Time { .. } => asked.inputs_at(at)[0].value,
        Advance::Path { .. } => at,
    };
    RowsEnd {
        at,
        input,
        cause: asked.cause_in_words(why),
    }
}

/// Strokes of outputs and sliding pairs over a turn of the one input that moves.
fn strokes(asked: &AskedSeveral<'_>, rows: &mut Rows<SeveralInputs<'_, '_>>) -> Vec<Stroke> {
    let [from, to] = asked.span();
    let mut found = Vec::new();
    let mut values = Vec::new();
    for index in 0..rows.columns.len() {
        let column = &rows.columns[index];
        let slides = column.owner.starts_with("pairs.");
        let output = asked.outputs().position(|name| name == column.owner);
        if column.quantity != Quantity::Displacement || !(slides || output.is_some()) {
            continue;
        }
        let coordinate = output.map_or(Coordinate::Sliding, |output| asked.outputs[output]);
        // Speeds stand behind their displacements.
        let owner = (column.owner.clone(), coordinate.unit());
        let course = &mut rows.course;
        let sense = asked.axis_rate();
        let mut look = |place: f64, value: bool| match course.at(place, &mut values) {
            Ok(()) if value => values[index],
            Ok(()) => values[index + 1] / sense,
            Err(_) => f64::NAN,
        };
        found.extend(stroke_of(&mut look, from.min(to), (to - from).abs(), owner));
    }
    found
}

fn transmission(asked: &AskedSeveral<'_>, places: &[f64]) -> Vec<Transmission> {
    let linkage = &asked.linkage;
    let spec = &linkage.spec().linkage;
    let mut course = SeveralInputs::new(asked);
    transmission_of(
        spec,
        linkage.structure(),
        places,
        &mut |place, dyad| match course.set_place(place) {
            Ok(()) => dyad.angle(
                &|point| course.motion.point(point).map(|jet| jet.value),
                &|link| course.motion.angle(link).value,
            ),
            Err(_) => f64::NAN,
        },
    )
}
