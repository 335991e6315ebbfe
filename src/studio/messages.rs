//! What windows say.

use super::commands::Question;
use crate::studies::axis::Axis;
use serde::Deserialize;
use serde_json::Value;
use std::collections::BTreeSet;

/// A message of a window.
#[derive(Debug, Deserialize)]
#[serde(tag = "type", rename_all = "snake_case", deny_unknown_fields)]
pub(super) enum WindowMessage {
    /// Who it is: the first message.
    Hello {
        /// The token.
        token: String,
        /// The tab that it is in, which it is when it is loaded or connected anew too.
        #[serde(default)]
        tab: String,
        /// Who makes its edits: the same after the connection was lost.
        #[serde(default)]
        author: String,
    },
    /// It comes back: the first message then.
    Back {
        /// The name of the token that it has.
        name: String,
        /// On this number the program proves that it has it too.
        number: String,
        /// As above.
        tab: String,
        /// As above.
        author: String,
    },
    /// It proves that it has the token.
    Proof {
        /// The proof.
        proof: String,
    },
    /// Opens a scene of the folder.
    Open {
        /// Its name.
        scene: String,
        /// What the window has of it.
        #[serde(default)]
        since: Option<Since>,
    },
    /// Edits of a version of the text.
    Push {
        /// The version that the first of them changes.
        version: u64,
        /// The last version that the window had heard of, where it has sent edits since: what
        /// lies between is its own. Default: `version`.
        #[serde(default)]
        heard: Option<u64>,
        /// The edits, each of the text after the one before.
        updates: Vec<Update>,
    },
    /// Takes the last step back.
    Undo,
    /// Does it again.
    Redo,
    /// Takes steps back, or does them again, until so many are done.
    GoTo {
        /// How many.
        count: usize,
        /// The version whose steps were counted.
        version: u64,
    },
    /// Writes the text to its file.
    Save,
    /// Writes it to a new file, which is opened then.
    SaveAs {
        /// The name of the file.
        scene: String,
    },
    /// Makes a new file, which is opened then.
    New {
        /// The name of the file.
        scene: String,
        /// What it begins with; without it the scene is empty.
        #[serde(default)]
        from: Option<Beginning>,
    },
    /// The file was changed by others: takes it.
    Reload,
    /// The file was changed by others: the text stays, and is saved over it when asked to.
    KeepMine,
    /// Takes the draft that was offered, or forgets it.
    Draft {
        /// True: takes it.
        restore: bool,
    },
    /// Asks for a map that follows the text; without one it ends.
    Map {
        /// The question.
        question: Option<MapRequest>,
    },
    /// Asks a question that follows the text; without one it ends.
    Question {
        /// The question.
        question: Option<Question>,
    },
    /// Keeps the present run beside those that come.
    Pin {
        /// Its name.
        name: String,
    },
    /// Lets a pinned run go.
    Unpin {
        /// Its number.
        pin: usize,
    },
    /// Gives a pinned run another name.
    Rename {
        /// Its number.
        pin: usize,
        /// The name.
        name: String,
    },
    /// Asks for a chart of a signal over another; without them it goes.
    Over {
        /// The columns of the record along and up the chart.
        signals: Option<[String; 2]>,
    },
    /// An answer was taken up, and will be on the screen in the next frame: another may come.
    Shown,
    /// A map stands on the screen.
    MapShown,
    /// The answer to a question does.
    QuestionShown,
    /// The charts in sight, by their places among those of the answer: of others no numbers come.
    Sight {
        /// Their places.
        charts: BTreeSet<usize>,
    },
    /// Keeps a setting for all windows, of later programs too.
    Keep {
        /// Which.
        name: String,
        /// What it is.
        value: String,
    },
    /// Asks for a sign of life.
    Ping {
        /// Comes back.
        number: u64,
    },
}

/// The text that a window had when its connection was lost.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Since {
    /// The document.
    pub(super) epoch: String,
    /// Its version.
    pub(super) version: u64,
}

/// What a new scene begins with.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(rename_all = "snake_case")]
pub(super) enum Beginning {
    /// One of the scenes of `dam new`, by its name.
    Template(String),
    /// A scenario by its name, `rocker/two_masses`.
    Scenario(String),
}

/// One edit.
#[derive(Debug, Deserialize)]
pub(super) struct Update {
    /// Changes as the editor writes them.
    pub(super) changes: Value,
    /// Number of the drag that it belongs to.
    #[serde(default)]
    pub(super) drag: Option<u64>,
}

/// A map that is asked for.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(super) struct MapRequest {
    /// The parameter along the map.
    pub(super) x: Range,
    /// The parameter up the map; without one it is a curve.
    pub(super) y: Option<Range>,
    /// Address of the figure; without one the greatest deviation of the last elastic object.
    pub(super) figure: Option<String>,
}

/// The range of a parameter: ends of the map, half a cell beyond the outermost points.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(super) struct Range {
    /// Address of the parameter.
    pub(super) address: String,
    /// Unit of the ends; empty: the SI unit.
    pub(super) unit: String,
    /// The ends.
    pub(super) ends: [f64; 2],
    /// Logarithmic.
    pub(super) log: bool,
    /// A whole number.
    pub(super) whole: bool,
}

impl Range {
    /// So many values in the middles of as many equal cells; of a whole number at most as many
    /// as there are.
    pub(super) fn axis(&self, count: usize) -> Axis {
        let [a, b] = self.ends;
        let count = match self.whole {
            true => count.min((b - a).round().max(2.0) as usize).max(2),
            false => count,
        };
        let half = 0.5 / count as f64;
        let (from, to) = match self.log {
            true => (a * (b / a).powf(half), b * (a / b).powf(half)),
            false => (a + (b - a) * half, b - (b - a) * half),
        };
        let whole = |value: f64| if self.whole { value.round() } else { value };
        Axis {
            path: self.address.clone(),
            unit: self.unit.clone(),
            from: whole(from),
            to: whole(to),
            count,
            log: self.log && !self.whole,
        }
    }
}
