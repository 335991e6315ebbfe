//! Opening the browser: the token goes through a file that only the user can read, so that it
//! stands in no list of processes.
//!
//! The token is behind the `#` of an address.

use super::{atomic, by_file, token};
use std::fs;
use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Stdio};

/// The file, which goes with this.
#[derive(Debug)]
pub(super) struct Page(PathBuf);

impl Drop for Page {
    fn drop(&mut self) {
        // It may be gone already.
        let _ = fs::remove_file(&self.0);
    }
}

/// Opens the browser at an address.
///
/// # Errors
/// The file cannot be written, or there is nothing that opens a browser.
pub(super) fn open_browser(address: &str) -> Result<Page, String> {
    let folder = by_file::state_folder().ok_or("there is no folder for the state of programs")?;
    let page = (|| {
        atomic::private_folder(&folder)?;
        let name = token::random().map_err(std::io::Error::other)?;
        let path = folder.join(format!("open-{}.html", &name[..16]));
        let mut file = atomic::new(&path, true)?;
        let page = Page(path);
        writeln!(
            file,
            "<!DOCTYPE html><meta charset=\"utf-8\"><meta name=\"referrer\" content=\"no-referrer\">\
             <title>dam studio</title><script>location.replace(\"{address}\")</script>\
             <p><a href=\"{address}\">dam studio</a></p>"
        )?;
        Ok(page)
    })();
    let page = page.map_err(|error: std::io::Error| {
        format!(
            "cannot write the page that opens the studio: {error}; --no-open prints the address"
        )
    })?;
    let (program, arguments) = opener();
    let started = Command::new(program)
        .args(arguments)
        .arg(&page.0)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn();
    match started {
        Ok(mut child) => {
            // Nobody waits for it otherwise.
            std::thread::spawn(move || child.wait());
            Ok(page)
        }
        Err(error) => Err(format!(
            "cannot open the browser with `{program}`: {error}; --no-open prints the address"
        )),
    }
}

fn opener() -> (&'static str, &'static [&'static str]) {
    if cfg!(target_os = "macos") {
        ("open", &[])
    } else if cfg!(windows) {
        ("cmd", &["/C", "start", ""])
    } else {
        ("xdg-open", &[])
    }
}
