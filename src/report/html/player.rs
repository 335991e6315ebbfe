//! What the player of a page moves: parts, the coordinates that they follow, and
//! what it shows beside them. There is one player for all pages, `player.js`.

use crate::report::quantity::escape;
use serde::Serialize;

/// A picture whose parts move, for a page; told apart from others on it by its id.
#[derive(Clone, Debug, Default, Serialize)]
pub(in crate::report) struct Player {
    /// Identifier of the figure within its page.
    #[serde(skip)]
    pub(in crate::report) id: String,
    /// Axis that leads from one row to the next; `None`: the time of the page's plots,
    /// whose cursors then go with it.
    pub(in crate::report) axis: Option<RowAxis>,
    /// Inputs with sliders of their own, in place of the axis: the rows are a grid over them,
    /// the first one fastest.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(in crate::report) sliders: Vec<Slider>,
    /// Of a grid the row that is shown first.
    #[serde(skip_serializing_if = "is_first")]
    pub(in crate::report) start: usize,
    /// How long the whole axis is played at normal speed (s).
    pub(in crate::report) seconds: f64,
    /// The time of a turn of the drive (s), where it turns evenly: a picture that runs by itself
    /// shows one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(in crate::report) turn: Option<f64>,
    /// Coordinates that parts follow.
    pub(in crate::report) columns: Vec<Coordinates>,
    /// The parts, by the number that their group bears as `data-link`, counted from
    /// the `data-first` of its picture.
    pub(in crate::report) bodies: Vec<Body>,
    /// Arrows.
    pub(in crate::report) sets: Vec<Arrows>,
    /// Numbers shown beside the picture.
    pub(in crate::report) readings: Vec<Reading>,
    /// How deflections are magnified, where some are shown.
    pub(in crate::report) magnify: Option<Magnify>,
    /// The column of the page's charts that is the time of the rows, where there is no
    /// axis.
    pub(in crate::report) times: Option<usize>,
    /// Metres a pixel, and the place of the origin (pixels), of pictures to scale: what the
    /// pointer reads.
    pub(in crate::report) scale: Option<[f64; 3]>,
    /// Names of the parts.
    pub(in crate::report) names: Vec<String>,
}

#[cfg(feature = "live")]
impl Player {
    /// Columns of the page's charts that it reads.
    pub(in crate::report) fn plotted(&self) -> Vec<usize> {
        let of = |one: &Coordinates| match one {
            Coordinates::Plotted { values, deviation } => vec![Some(*values), *deviation],
            Coordinates::Own { .. } => Vec::new(),
        };
        let all = self.columns.iter().flat_map(of);
        let forces = self.sets.iter().flat_map(|set| &set.on);
        let forces = forces.map(|arrow| Some(arrow.column));
        all.chain([self.times]).chain(forces).flatten().collect()
    }
}

/// Axis of a player: a quantity that leads from one row to the next.
#[derive(Clone, Debug, Default, Serialize)]
pub(in crate::report) struct RowAxis {
    /// Name: `crank angle`.
    pub(in crate::report) name: String,
    /// The unit in which it is shown.
    pub(in crate::report) unit: String,
    /// Values, one a row.
    pub(in crate::report) values: Vec<Option<f64>>,
    /// The time of every row (s).
    pub(in crate::report) times: Vec<Option<f64>>,
    /// True when the first row follows the last.
    pub(in crate::report) closed: bool,
}

/// An input with a slider of its own.
#[derive(Clone, Debug, Serialize)]
pub(in crate::report) struct Slider {
    /// Name of the input.
    pub(in crate::report) name: String,
    /// The unit in which it is shown.
    pub(in crate::report) unit: String,
    /// Its values.
    pub(in crate::report) values: Vec<Option<f64>>,
}

/// True of the row that is shown first unless another is told.
#[allow(clippy::trivially_copy_pass_by_ref, reason = "as serde asks for it")]
fn is_first(row: &usize) -> bool {
    *row == 0
}

/// A coordinate over the rows.
#[derive(Clone, Debug, Serialize)]
#[serde(untagged)]
pub(in crate::report) enum Coordinates {
    /// Displacement and deviation, columns of the page's charts.
    Plotted {
        /// The displacement.
        values: usize,
        /// Index of the deviation from the law; `None`: none.
        deviation: Option<usize>,
    },
    /// Numbers of its own.
    Own {
        /// Displacements, one a row.
        own: Vec<f64>,
    },
}

/// Displacement that a part shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(in crate::report) enum PartDisplacement {
    /// The true one.
    True,
    /// The one of the law, without deviation.
    Law,
    /// Displacement of the law and the magnified deviation.
    Magnified,
}

/// Motion of a part on the picture; all in pixels, y downwards, angles counterclockwise.
#[derive(Clone, Debug, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub(in crate::report) enum Body {
    /// By the row.
    Rows {
        /// x, y, cosine and sine of every row, one after the other.
        table: Vec<Option<f64>>,
    },
    /// By a coordinate, at even distances between two values of it.
    Over {
        /// The coordinate.
        column: usize,
        /// Value at the first place.
        from: f64,
        /// Value at the last place.
        to: f64,
        /// True when everything repeats from there on.
        repeats: bool,
        /// Displacement that is shown.
        shown: PartDisplacement,
        /// x, y, cosine and sine of every place, one after the other.
        table: Vec<Option<f64>>,
    },
    /// Turned about a place by offset + sense · coordinate.
    Turn {
        /// The coordinate (rad).
        column: usize,
        /// Centre of the turning.
        at: [f64; 2],
        /// Counterclockwise angle by radian.
        sense: f64,
        /// Angle at zero (rad).
        offset: f64,
        /// Displacement that is shown.
        shown: PartDisplacement,
    },
    /// Pushed from a place by the coordinate.
    Slide {
        /// The coordinate.
        column: usize,
        /// Place at zero.
        at: [f64; 2],
        /// Pixels by unit of the coordinate.
        by: [f64; 2],
        /// Displacement that is shown.
        shown: PartDisplacement,
    },
}

/// Arrows of one kind.
#[derive(Clone, Debug, Serialize)]
pub(in crate::report) struct Arrows {
    /// Name of the arrows' quantity.
    pub(in crate::report) name: String,
    /// Caption: the name with the scale.
    pub(in crate::report) caption: String,
    /// Greatest size and its SI unit, where all are to one scale.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(in crate::report) greatest: Option<(f64, String)>,
    /// True when they are shown from the beginning.
    pub(in crate::report) shown: bool,
    /// x, y, dx, dy of every row, for every arrow.
    pub(in crate::report) arrows: Vec<Vec<Option<f64>>>,
    /// Arrows that go with a part, behind the others.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(in crate::report) on: Vec<ForceArrow>,
}

/// An arrow on a part, as long as a column of the page's charts says.
#[derive(Clone, Debug, Serialize)]
pub(in crate::report) struct ForceArrow {
    /// The part.
    pub(in crate::report) body: usize,
    /// Place of the picture that the part is in (pixels).
    pub(in crate::report) origin: [f64; 2],
    /// The place in the frame of the part (pixels, y downwards).
    pub(in crate::report) at: [f64; 2],
    /// Pixels a unit of the column, in the frame of the part.
    pub(in crate::report) by: [f64; 2],
    /// True where `by` is in the frame of the picture.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub(in crate::report) fixed: bool,
    /// The column.
    pub(in crate::report) column: usize,
}

/// A number shown beside the picture.
#[derive(Clone, Debug, Serialize)]
pub(in crate::report) struct Reading {
    /// Name of the reading.
    pub(in crate::report) name: String,
    /// Unit of the reading.
    pub(in crate::report) unit: String,
    /// Values, one a row; none where one is not finite.
    pub(in crate::report) values: Vec<Option<f64>>,
}

/// Magnification of deflections.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(in crate::report) struct Magnify {
    /// The factor to begin with, one of the choices.
    pub(in crate::report) factor: f64,
    /// Factors to choose from.
    pub(in crate::report) choices: Vec<f64>,
}

impl Player {
    /// The figure of a page: pictures with moving parts, controls, data.
    pub(in crate::report) fn figure(&self, pictures: &str) -> String {
        // Plain numbers, strings and lists: writing them cannot fail.
        let data = serde_json::to_string(self).unwrap_or_else(|_| "null".into());
        let readings = match self.readings.is_empty() {
            true => "",
            false => "<dl class=\"facts readings\"></dl>\n",
        };
        let id = escape(&self.id);
        format!(
            "<figure class=\"moving\" id=\"{id}\">\n{pictures}<div class=\"bar controls\"></div>\n\
             {readings}</figure>\n<script type=\"application/json\" id=\"{id}-data\">{}</script>\n",
            data.replace('<', "\\u003c")
        )
    }
}

/// A number for the player, with that many digits after the point; none for what is no number.
pub(in crate::report) fn short(value: f64, digits: i32) -> Option<f64> {
    let factor = 10f64.powi(digits);
    let rounded = (value * factor).round() / factor;
    rounded.is_finite().then_some(rounded)
}
