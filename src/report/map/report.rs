//! What a map's page shows.

use crate::studies::map::{MapResult, Study};

/// Everything that goes into the page of a map.
#[derive(Clone, Copy, Debug)]
pub struct MapReport<'a> {
    /// Study: what was asked.
    pub study: &'a Study<'a>,
    /// Result: what came out.
    pub result: &'a MapResult,
    /// The command that runs the scene with the settings of all cells, word by
    /// word: `dam`, `run`, `scene.json`, `--set`, `rocker.masses=2`.
    pub command: &'a [String],
    /// The scene's text, shown as it is.
    pub scene: &'a str,
    /// Version of `dam`.
    pub version: &'a str,
}
