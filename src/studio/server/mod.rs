//! `dam studio`: a server on the loopback that shows a scene in the browser and lets it be
//! changed, while its answers follow.
//!
//! * `served`, `routes`, `guard`, `connections`: what is served, to whom, how much at a time;
//! * `folder`, `atomic`, `by_file`, `drafts`, `pin_files`, `launch`: files: within one folder,
//!   written as a whole, kept from crashes; how the browser is told the token;
//! * `first`, `recent`: the first page, what was opened last; `settings`: what the user chose for
//!   all windows; `earlier`: windows that come back;
//! * `text`: a scene's text with its edits; `room`: the text that all windows on a file share,
//!   with its answers; `window`: what one of them is sent; `socket`: what it says;
//! * `work`: the newest question wins; `inquiry`, `questions`, `files`: what is asked besides.
//!
//! The server is the authority: windows send edits of a version of the text, and get those of
//! the others. Everything that they show follows from the text.

mod atomic;
mod by_file;
mod connections;
mod disk;
mod drafts;
mod earlier;
mod files;
mod first;
mod folder;
mod guard;
mod history;
mod inquiry;
mod launch;
mod limits;
mod pin_files;
#[cfg(test)]
mod pin_tests;
mod questions;
mod recent;
mod room;
#[cfg(test)]
mod room_tests;
mod routes;
mod served;
#[cfg(test)]
mod server_tests;
mod settings;
mod socket;
mod state;
mod text;
mod token;
mod window;
mod work;

use super::commands::Commands;
use folder::Folder;
use served::Studio;
use std::path::PathBuf;
use std::sync::Arc;

/// What is to be served, and how.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// A scene, or a folder of scenes; `None`: the folder one is in.
    pub target: Option<PathBuf>,
    /// The port; `None`: any that is free.
    pub port: Option<u16>,
    /// True: the browser is opened.
    pub open: bool,
}

/// Serves until the program ends; `commands` answer what is asked besides the run, `tell` is
/// given what the user is to know.
///
/// # Errors
/// There is no such scene or folder, or the port cannot be had.
pub(crate) fn serve(
    options: &Options,
    commands: &'static dyn Commands,
    tell: impl Fn(&str),
) -> Result<(), String> {
    let (folder, scene) = Folder::open(options.target.as_deref())?;
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build()
        .map_err(|error| format!("cannot start the server: {error}"))?;
    runtime.block_on(async {
        let listener = routes::listen(options.port).await?;
        let port = listener.local_addr().map_err(|error| error.to_string())?;
        let studio = Studio::new((folder, scene), port.port(), commands)?;
        let studio = Arc::new(studio.with_earlier(port.port()));
        let address = studio.address();
        let _page = match options.open {
            false => {
                tell(&format!("The studio is at {address}\n"));
                None
            }
            true => {
                let page = launch::open_browser(&address)?;
                tell(&format!(
                    "The studio is open in the browser; it is served on port {} until Ctrl-C.\n",
                    port.port()
                ));
                Some(page)
            }
        };
        routes::run(studio, listener).await;
        Ok(())
    })
}
