//! The report page draws itself in a browser, without a network and without an error.
//!
//! Needs Chromium; where there is none the test says so and leaves it. With
//! `DAM_BROWSER` set (as `.ci/run` does) that browser must be there.

use std::process::Command;

fn browser() -> Option<String> {
    if let Ok(name) = std::env::var("DAM_BROWSER") {
        return Some(name);
    }
    let names = ["chromium", "chromium-browser", "google-chrome"];
    let works = |name: &&str| Command::new(name).arg("--version").output().is_ok();
    names.into_iter().find(works).map(str::to_owned)
}

/// The page as the browser has made it after running its script.
fn drawn(browser: &str, page: &std::path::Path, profile: &std::path::Path) -> String {
    let output = Command::new(browser)
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-quic",
        ])
        .args(["--no-first-run", "--disable-background-networking"])
        .args(["--disable-component-update", "--disable-sync"])
        .args(["--virtual-time-budget=3000", "--dump-dom"])
        .arg(format!("--user-data-dir={}", profile.display()))
        .arg(format!("file://{}", page.display()))
        .output()
        .unwrap();
    assert!(output.status.success(), "{browser} failed");
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn the_report_draws_itself_in_a_browser() {
    let Some(browser) = browser() else { return };
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let root = env!("CARGO_MANIFEST_DIR");
    let runs: [&[&str]; 2] = [
        &["run", "scenarios/valve_train/lift_off.json"],
        &[
            "compare",
            "scenarios/rocker/two_masses.json",
            "--over",
            "rocker.masses=1,2",
        ],
    ];
    for arguments in runs {
        let status = Command::new(env!("CARGO_BIN_EXE_dam"))
            .args(arguments)
            .args(["--quiet", "--force", "--out"])
            .arg(&out)
            .current_dir(root)
            .output()
            .unwrap();
        assert!(status.status.success());
        // Errors of the script show in the title.
        let page = std::fs::read_to_string(out.join("report.html")).unwrap();
        let trap = "<head><script>addEventListener('error', e => \
                    { document.title = 'FAILED: ' + e.message; });</script>";
        let path = folder.path().join("page.html");
        std::fs::write(&path, page.replacen("<head>", trap, 1)).unwrap();
        let before = page.matches("<path").count();
        let dom = drawn(&browser, &path, &folder.path().join("profile"));
        let title = dom.split("<title>").nth(1).unwrap_or_default();
        let title = title.split("</title>").next().unwrap_or_default();
        assert!(!title.contains("FAILED"), "{title}");
        let curves = dom.matches("<path").count() - before;
        assert!(curves >= 6, "only {curves} curves were drawn");
        assert!(!dom.contains("NaN"), "a coordinate is not a number");
    }
}
