//! The studio: a scene in the browser that is changed while its answers follow.
//!
//! * `answer`, `chart`, `asides`: from a text to its answer, the live map, what is asked besides;
//!   `commands`: the questions that the program's commands answer;
//! * `messages`, `view`, `pins`: what a window says, what it sees besides the run;
//!   `gallery`, `preview`: scenes that are built in, and their machines moving; `starters`: what objects begin
//!   with; `motion`: a motion
//!   made of segments, as it is drawn and edited;
//! * `server`: `dam studio`, a server on the loopback with the windows of one folder;
//! * `tab`: the same answers in a browser tab, without a server.

mod answer;
mod asides;
mod chart;
pub(crate) mod commands;
mod gallery;
mod limits;
mod messages;
mod motion;
mod pins;
mod preview;
#[cfg(feature = "studio")]
mod server;
mod starters;
pub mod tab;
mod units;
mod view;

#[cfg(feature = "studio")]
pub use server::Options;
#[cfg(feature = "studio")]
pub(crate) use server::serve;
