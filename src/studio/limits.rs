//! How much is taken at a time.

use std::time::Duration;

/// Largest body of a request, message, and scene (bytes).
pub(super) const BODY: usize = 1 << 20;
/// Runs that a window may pin, and characters of their names.
pub(super) const PINS: usize = 3;
pub(super) const NAME: usize = 40;
/// Largest answer to a question that is sent, and largest file that is made of one (bytes).
pub(super) const ANSWER: usize = 32 << 20;
/// How long a run may last.
pub(super) const RUN: Duration = Duration::from_secs(30);
/// How long the model of a scene is judged before it is shown as it stands.
pub(super) const JUDGED: Duration = Duration::from_secs(6);
/// How long a run and its repetitions may last that tell the errors of its figures; with the
/// judging of the model less than a request may last.
pub(super) const FIGURES: Duration = Duration::from_millis(3500);
/// What is answered within this is answered before faults and numbers are told.
pub(super) const QUICK: Duration = Duration::from_millis(15);
/// Samples of a run at most, unless what it answers rests on them.
pub(super) const SAMPLES: usize = 2000;
/// Rows of a run with two at every switch; above, there is none at switches.
pub(super) const ROWS: usize = 20_000;
/// Columns of a run with those of masses and links; above, objects alone are shown.
pub(super) const MASSES: usize = 200;
/// Cells along and up the live map, first coarse, then fine.
pub(super) const CELLS: [usize; 3] = [5, 10, 20];
/// How long the run of a moving picture on the first page may last, its samples a turn of the drive
/// and in all, and the turns that are run.
pub(super) const PREVIEW: Duration = Duration::from_secs(8);
pub(super) const PREVIEW_ROWS: [f64; 2] = [120.0, 300.0];
pub(super) const PREVIEW_TURNS: f64 = 2.0;
