//! What a recorder is asked for.

use crate::dynamics::model::SpanFigure;

/// Settings of a recorder: what to record.
#[derive(Clone, Debug, PartialEq)]
pub struct RecorderSettings {
    /// Time at which the run is to end (s); it starts at 0.
    pub duration: f64,
    /// Number of equal intervals between samples (one more row than that); 0: no
    /// samples at all.
    pub samples: usize,
    /// True: every switch of a pair is listed, not only counted. (Openings are in any case:
    /// by them the working order is judged.)
    pub listing: bool,
    /// True: two more rows (before, after) at every switch of a pair.
    pub switch_rows: bool,
    /// True: columns of all masses and links of elastic objects too.
    pub masses: bool,
    /// True: more samples behind every switch of a pair, beside the record.
    pub closeups: bool,
    /// Window in which the working order of pairs is judged (s).
    pub window: Option<[f64; 2]>,
    /// True for power series and collocation, whose steps may be whole
    /// oscillations long: they are looked at in pieces.
    pub long_steps: bool,
    /// True for implicit methods, whose steps may be long against a vibration: they tell
    /// its acceleration better than their states do.
    pub implicit: bool,
    /// Tolerance of the run: the finer, the smaller the pieces.
    pub tolerance: f64,
    /// Greatest and least values within parts of the motion that are wanted.
    pub spans: Vec<SpanFigure>,
    /// True: states are kept at instants drawn at random, for the check of the run.
    pub checked: bool,
}
