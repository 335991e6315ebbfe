//! How much is taken at a time, of what comes over the line.

use std::time::Duration;

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
/// Windows that are gone whose view a document keeps for their tabs.
pub(super) const LEFT: usize = 4;
/// Messages that may wait for a window before it is given up.
pub(super) const WAITING: usize = 4096;
/// How long a run goes on after it was superseded: so that something is seen while a number moves.
pub(super) const GRACE: Duration = Duration::from_millis(150);
/// How long nothing newer comes before a map is made finer: longer than from one move to the next.
pub(super) const REST: Duration = Duration::from_millis(20);
/// From one coarse map to the next while a number moves: oftener than that nobody sees more of
/// them, and the browser draws nothing else.
pub(super) const PACE: Duration = Duration::from_millis(50);
/// Memory that runs may take beyond what the server had (bytes).
pub(super) const MEMORY: u64 = 2 << 30;
/// How long undone steps are kept: characters of all of them.
pub(super) const HISTORY: usize = 16 << 20;
/// Steps that a window lists, back and forward each, and about how many characters of them.
pub(super) const LISTED: usize = 200;
pub(super) const LISTED_SIZE: usize = 4 << 20;
/// Edits, and characters of them, that are kept for windows whose connection was lost.
pub(super) const LOGGED: usize = 4096;
pub(super) const LOGGED_SIZE: usize = 8 << 20;
