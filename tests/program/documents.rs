//! Every command shown in a document runs.
//!
//! Lines of `sh` blocks that call `dam` (or `cargo run --release --`) are run
//! in an empty folder that sees `scenarios` and `objects`. A comment
//! `# exit status N` on the line states an expected status other than 0. Maps are
//! run with fewer cells than shown. A studio is ended once it has told its address.

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::Command;

const DOCUMENTS: [&str; 4] = [
    "README.md",
    "ARCHITECTURE.md",
    "scenarios/README.md",
    "objects/README.md",
];

/// Commands that a test cannot run from within a test, or need not.
const LEFT_OUT: [&str; 3] = ["cargo test", "cargo bench", "cargo install"];

struct Shown {
    document: &'static str,
    line: usize,
    arguments: Vec<String>,
    status: i32,
}

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn shown_commands() -> Vec<Shown> {
    DOCUMENTS
        .iter()
        .filter(|document| root().join(document).exists())
        .flat_map(|document| commands_of(document))
        .collect()
}

fn commands_of(document: &'static str) -> Vec<Shown> {
    let text = std::fs::read_to_string(root().join(document)).unwrap();
    let mut inside = false;
    let mut found = Vec::new();
    // A backslash at the end of a line continues the command.
    let text = text.replace("\\\n", "");
    for (index, line) in text.lines().enumerate() {
        if line.starts_with("```") {
            inside = !inside && matches!(line.trim(), "```sh" | "```bash" | "```console");
            continue;
        }
        let line = line.trim().trim_start_matches("$ ");
        if !inside || line.is_empty() || line.starts_with('#') {
            continue;
        }
        if LEFT_OUT.iter().any(|start| line.starts_with(start)) {
            continue;
        }
        found.push(parse(document, index + 1, line));
    }
    found
}

fn parse(document: &'static str, line: usize, text: &str) -> Shown {
    let (command, comment) = text.split_once(" #").unwrap_or((text, ""));
    let status = comment
        .trim()
        .strip_prefix("exit status ")
        .map_or(0, |number| number.trim().parse().unwrap());
    let arguments = command
        .strip_prefix("cargo run --release -- ")
        .or_else(|| command.strip_prefix("cargo run --release --features studio -- "))
        .or_else(|| command.strip_prefix("dam "))
        .unwrap_or_else(|| panic!("{document}:{line}: a test cannot run `{text}`"));
    Shown {
        document,
        line,
        arguments: split(arguments),
        status,
    }
}

/// Splits as a shell does, as far as the documents need it: quotes group.
fn split(text: &str) -> Vec<String> {
    let mut words = Vec::new();
    let mut word = String::new();
    let mut quote = None;
    for character in text.trim().chars() {
        match (quote, character) {
            (Some(open), c) if c == open => quote = None,
            (None, '"' | '\'') => quote = Some(character),
            (None, ' ') => words.push(std::mem::take(&mut word)),
            (_, c) => word.push(c),
        }
    }
    words.push(word);
    words.retain(|word| !word.is_empty());
    words
}

/// A map takes as long as it has cells, and shows what it can with few of them:
/// `PATH=FROM:TO:100` becomes `PATH=FROM:TO:10`.
fn fewer_cells(mut arguments: Vec<String>) -> Vec<String> {
    if arguments.first().is_some_and(|command| command == "map") {
        for axis in arguments
            .iter_mut()
            .filter(|word| word.matches(':').count() == 2)
        {
            if let Some(range) = axis.strip_suffix(":100") {
                *axis = format!("{range}:10");
            }
        }
    }
    arguments
}

fn link(folder: &Path, name: &str) {
    #[cfg(unix)]
    std::os::unix::fs::symlink(root().join(name), folder.join(name)).unwrap();
    #[cfg(not(unix))]
    panic!("this test needs links to {name} in {}", folder.display());
}

/// The studio tells its address and serves until it is ended; a program without it says how to
/// get it.
fn studio(arguments: &[String], folder: &Path) -> Result<(), String> {
    let mut child = Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(arguments)
        .args((!arguments.contains(&"--no-open".to_owned())).then_some("--no-open"))
        .current_dir(folder)
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    let mut told = String::new();
    let mut lines = BufReader::new(child.stderr.take().unwrap());
    lines.read_line(&mut told).unwrap();
    let served = told.contains("http://127.0.0.1:");
    if served {
        child.kill().unwrap();
    }
    let status = child.wait().unwrap();
    let fits = match cfg!(feature = "studio") {
        true => served,
        false => status.code() == Some(2) && told.contains("--features studio"),
    };
    match fits {
        true => Ok(()),
        false => Err(format!("dam {}: {status}\n{told}", arguments.join(" "))),
    }
}

#[test]
fn every_command_shown_in_a_document_runs() {
    let folder = tempfile::tempdir().unwrap();
    link(folder.path(), "scenarios");
    link(folder.path(), "objects");
    let commands = shown_commands();
    assert!(commands.len() >= 8, "the documents show commands");
    let mut failures = Vec::new();
    for shown in &commands {
        let mut arguments = shown.arguments.clone();
        // `> file` at the end of a line: the shell's part.
        if let Some(at) = arguments.iter().position(|word| word == ">") {
            arguments.truncate(at);
        }
        if arguments.first().is_some_and(|command| command == "studio") {
            failures.extend(studio(&arguments, folder.path()).err());
            continue;
        }
        let output = Command::new(env!("CARGO_BIN_EXE_dam"))
            .args(fewer_cells(arguments))
            .current_dir(folder.path())
            .output()
            .unwrap();
        if output.status.code() != Some(shown.status) {
            failures.push(format!(
                "{}:{}: dam {}\nended with {:?} instead of {}\n{}",
                shown.document,
                shown.line,
                shown.arguments.join(" "),
                output.status.code(),
                shown.status,
                String::from_utf8_lossy(&output.stderr)
            ));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n\n"));
}

/// Blocks of a language in a document.
fn blocks(document: &str, language: &str) -> Vec<String> {
    let text = std::fs::read_to_string(root().join(document)).unwrap();
    let open = format!("```{language}\n");
    let mut found = Vec::new();
    let mut rest = text.as_str();
    while let Some(start) = rest.find(&open) {
        rest = &rest[start + open.len()..];
        let end = rest.find("```").unwrap();
        found.push(rest[..end].to_owned());
        rest = &rest[end..];
    }
    found
}

#[test]
fn the_scene_in_the_readme_is_right() {
    let scenes: Vec<String> = blocks("README.md", "json")
        .into_iter()
        .filter(|block| block.contains("\"dam\""))
        .collect();
    assert!(!scenes.is_empty());
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.json");
    for scene in scenes {
        std::fs::write(&path, scene).unwrap();
        let output = Command::new(env!("CARGO_BIN_EXE_dam"))
            .arg("check")
            .arg(&path)
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{said}");
    }
}

#[test]
fn the_figures_in_the_readme_are_those_that_are_printed() {
    let output = Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(["run", "scenarios/rocker/two_masses.json"])
        .env("COLUMNS", "110")
        .current_dir(root())
        .output()
        .unwrap();
    let printed = String::from_utf8(output.stdout).unwrap();
    let shown = &blocks("README.md", "text")[0];
    // The second line counts steps, which may differ from machine to machine.
    let lines = |text: &str| -> Vec<String> {
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        lines.remove(1);
        lines
    };
    assert_eq!(lines(shown), lines(&printed));
}

#[test]
fn the_readme_begins_with_the_two_commands() {
    let readme = std::fs::read_to_string(root().join("README.md")).unwrap();
    for command in [
        "cargo run --release -- run scenarios/rocker/two_masses.json --out out",
        "cargo test --release",
    ] {
        assert!(readme.contains(command), "README shows `{command}`");
    }
    let ci = std::fs::read_to_string(root().join(".ci/run")).unwrap();
    assert!(ci.contains("cargo test --release"), ".ci/run calls it");
}
