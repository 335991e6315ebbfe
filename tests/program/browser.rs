//! A browser without a window, in which tests look at pages.

use std::path::Path;
use std::process::Command;

/// Name of the browser: `DAM_BROWSER`, or a Chromium on the path; `None`: there is none.
pub(crate) fn browser() -> Option<String> {
    if let Ok(name) = std::env::var("DAM_BROWSER") {
        return Some(name);
    }
    let names = ["chromium", "chromium-browser", "google-chrome"];
    let works = |name: &&str| Command::new(name).arg("--version").output().is_ok();
    names.into_iter().find(works).map(str::to_owned)
}

/// The document that a page has become once its scripts have run; it is written into the folder.
pub(crate) fn dom(browser: &str, page: &str, folder: &Path) -> String {
    let path = folder.join("page.html");
    std::fs::write(&path, page).expect("a page");
    let profile = folder.join("profile");
    let output = Command::new(browser)
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-quic",
        ])
        .args(["--no-first-run", "--disable-background-networking"])
        .args(["--disable-component-update", "--disable-sync"])
        .args(["--window-size=1280,1600", "--virtual-time-budget=3000"])
        .arg("--dump-dom")
        .arg(format!("--user-data-dir={}", profile.display()))
        .arg(format!("file://{}", path.display()))
        .output()
        .expect("a browser");
    assert!(output.status.success(), "{browser} failed");
    String::from_utf8(output.stdout).expect("text")
}
