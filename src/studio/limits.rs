//! How much is taken at a time.

use std::time::Duration;

/// Largest body of a request, message, and scene (bytes).
pub(super) const BODY: usize = 1 << 20;
/// How long the head of a request, or the wait for the next one, may last.
pub(super) const HEAD: Duration = Duration::from_secs(10);
/// How long a whole request may last.
pub(super) const REQUEST: Duration = Duration::from_secs(10);
/// How long a WebSocket may take to say who it is.
pub(super) const HELLO: Duration = Duration::from_secs(5);
/// Connections at a time.
pub(super) const CONNECTIONS: usize = 128;
/// WebSockets at a time.
pub(super) const WINDOWS: usize = 32;
/// Documents at a time.
pub(super) const ROOMS: usize = 32;
/// Runs that a window may pin, and characters of their names.
pub(super) const PINS: usize = 3;
pub(super) const NAME: usize = 40;
/// Windows that are gone whose view a document keeps for their tabs.
pub(super) const LEFT: usize = 4;
/// Largest answer to a question that is sent, and largest file that is made of one (bytes).
pub(super) const ANSWER: usize = 32 << 20;
/// Messages that may wait for a window before it is given up.
pub(super) const WAITING: usize = 4096;
/// How long a run may last.
pub(super) const RUN: Duration = Duration::from_secs(30);
/// How long the model of a scene is judged before it is shown as it stands.
pub(super) const JUDGED: Duration = Duration::from_secs(6);
/// How long a run and its repetitions may last that tell the errors of its figures; with the
/// judging of the model less than [`REQUEST`].
pub(super) const FIGURES: Duration = Duration::from_millis(3500);
/// How long a run goes on after it was superseded: so that something is seen while a number moves.
pub(super) const GRACE: Duration = Duration::from_millis(150);
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
/// How long nothing newer comes before a map is made finer: longer than from one move to the next.
pub(super) const REST: Duration = Duration::from_millis(20);
/// From one coarse map to the next while a number moves: oftener than that nobody sees more of
/// them, and the browser draws nothing else.
pub(super) const PACE: Duration = Duration::from_millis(50);
/// Memory that runs may take beyond what the server had (bytes).
pub(super) const MEMORY: u64 = 2 << 30;
/// How long undone steps are kept: characters of all of them.
pub(super) const HISTORY: usize = 16 << 20;
/// Edits, and characters of them, that are kept for windows whose connection was lost.
pub(super) const LOGGED: usize = 4096;
pub(super) const LOGGED_SIZE: usize = 8 << 20;
