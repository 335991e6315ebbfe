//! Every command shown in a document runs, and prints what is shown behind it.
//!
//! Each document has an empty folder that sees `scenarios` and `objects`. Lines of `sh` blocks
//! that call `dam` (or `cargo run --release --`) are run there. A comment `# exit status N` on
//! the line states an expected status other than 0. A `json` block with a title is a file of that
//! name. A `text` block behind commands is what they print: every line of it, in this order, `…`
//! for what is left out. Maps are run with fewer cells than shown. A studio is ended once it
//! has told its address.

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Beside the pages of the site.
const DOCUMENTS: [&str; 5] = [
    "README.md",
    "ARCHITECTURE.md",
    "CONTRIBUTING.md",
    "scenarios/README.md",
    "objects/README.md",
];

/// Made by running all scenarios, by docs/reference.py, and a tutorial that takes minutes:
/// docs/examples.py executes it.
const OTHER_PAGES: [&str; 3] = ["gallery", "reference", "tutorial"];

/// Commands that a test cannot run from within a test, or need not.
const LEFT_OUT: [&str; 9] = [
    "cargo test",
    "cargo bench",
    "cargo build",
    "cargo install",
    "pip install",
    "python",
    "docs/build",
    ".ci/run",
    "studio/offline",
];

struct Shown {
    line: usize,
    arguments: Vec<String>,
    status: i32,
}

/// A block of a document between its fences.
struct Block {
    /// What stands behind the opening fence: `sh`, `json title="lever.json"`.
    head: String,
    /// Of the opening fence, from 1.
    line: usize,
    text: String,
}

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn documents() -> Vec<String> {
    let mut found: Vec<String> = DOCUMENTS.map(str::to_owned).to_vec();
    pages(Path::new("docs/site"), &mut found);
    found
}

/// The pages of a folder of the site and of the folders within.
fn pages(folder: &Path, found: &mut Vec<String>) {
    let entries = std::fs::read_dir(root().join(folder)).unwrap();
    let mut names: Vec<String> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    for name in names {
        let path = folder.join(&name);
        if root().join(&path).is_dir() {
            if !OTHER_PAGES.contains(&name.as_str()) {
                pages(&path, found);
            }
        } else if name.ends_with(".md") {
            found.push(path.display().to_string());
        }
    }
}

fn blocks(document: &str) -> Vec<Block> {
    let text = std::fs::read_to_string(root().join(document)).unwrap();
    let mut found: Vec<Block> = Vec::new();
    let mut inside = false;
    for (index, line) in text.lines().enumerate() {
        match (line.strip_prefix("```"), inside) {
            (Some(head), false) => {
                found.push(Block {
                    head: head.trim().to_owned(),
                    line: index + 1,
                    text: String::new(),
                });
                inside = true;
            }
            (Some(_), true) => inside = false,
            (None, true) => {
                let block = found.last_mut().unwrap();
                block.text += line;
                block.text.push('\n');
            }
            (None, false) => {}
        }
    }
    found
}

fn texts(document: &str, language: &str) -> Vec<String> {
    blocks(document)
        .into_iter()
        .filter(|block| block.head == language)
        .map(|block| block.text)
        .collect()
}

fn commands_of(document: &str, block: &Block) -> Vec<Shown> {
    let mut found = Vec::new();
    // A backslash at the end of a line continues the command.
    let text = block.text.replace("\\\n", "");
    for (index, line) in text.lines().enumerate() {
        let line = line.trim().trim_start_matches("$ ");
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        if LEFT_OUT.iter().any(|start| line.starts_with(start)) {
            continue;
        }
        found.push(parse(document, block.line + 1 + index, line));
    }
    found
}

fn parse(document: &str, line: usize, text: &str) -> Shown {
    let (command, comment) = text.split_once(" #").unwrap_or((text, ""));
    let status = comment
        .trim()
        .strip_prefix("exit status ")
        .map_or(0, |number| number.trim().parse().unwrap());
    let arguments = command
        .strip_prefix("cargo run --release -- ")
        .or_else(|| command.strip_prefix("dam "))
        .unwrap_or_else(|| panic!("{document}:{line}: a test cannot run `{text}`"));
    Shown {
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

/// Runs a command as its document shows it. Returns what it prints.
fn printed(shown: &Shown, folder: &Path) -> Result<String, String> {
    let mut arguments = shown.arguments.clone();
    // `> file` at the end of a line: the shell's part.
    let file = arguments.iter().position(|word| word == ">").map(|at| {
        let file = folder.join(&arguments[at + 1]);
        arguments.truncate(at);
        file
    });
    if arguments.first().is_some_and(|command| command == "studio") {
        return studio(&arguments, folder).map(|()| String::new());
    }
    let output = Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(fewer_cells(arguments))
        .current_dir(folder)
        .env("COLUMNS", "100")
        .output()
        .unwrap();
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    if output.status.code() != Some(shown.status) {
        return Err(format!(
            "dam {}\nended with {:?} instead of {}\n{errors}",
            shown.arguments.join(" "),
            output.status.code(),
            shown.status,
        ));
    }
    if let Some(file) = file {
        std::fs::write(file, &output.stdout).unwrap();
        return Ok(errors);
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned() + &errors)
}

/// The first line that is shown and not printed, in this order.
fn missing<'a>(shown: &'a str, printed: &str) -> Option<&'a str> {
    let spaced = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut rest = printed.lines().map(spaced);
    shown.lines().find(|line| {
        let wanted = spaced(line);
        !wanted.is_empty() && wanted != "…" && !rest.any(|line| line.starts_with(&wanted))
    })
}

/// What is wrong in a document, and how many commands it shows.
fn judged(document: &str) -> (usize, Vec<String>) {
    let folder = tempfile::tempdir().unwrap();
    link(folder.path(), "scenarios");
    link(folder.path(), "objects");
    let (mut count, mut said, mut faults) = (0, None, Vec::new());
    for block in blocks(document) {
        match block.head.as_str() {
            "sh" | "bash" | "console" => {
                let commands = commands_of(document, &block);
                count += commands.len();
                let mut text = String::new();
                for shown in &commands {
                    match printed(shown, folder.path()) {
                        Ok(printed) => text += &printed,
                        Err(fault) => faults.push(format!("{document}:{}: {fault}", shown.line)),
                    }
                }
                said = (!commands.is_empty()).then_some(text);
                continue;
            }
            "text" => {
                let line = said.as_ref().and_then(|said| missing(&block.text, said));
                if let Some(line) = line {
                    faults.push(format!("{document}:{}: is not printed: {line}", block.line));
                }
                continue;
            }
            head => {
                if let Some(title) = head.strip_prefix("json title=") {
                    let path = folder.path().join(title.trim_matches('"'));
                    std::fs::write(path, &block.text).unwrap();
                }
            }
        }
        said = None;
    }
    (count, faults)
}

#[test]
fn every_command_shown_in_a_document_runs() {
    let documents = documents();
    assert!(documents.len() > 20, "the site has pages: {documents:?}");
    let next = std::sync::atomic::AtomicUsize::new(0);
    let all = std::sync::Mutex::new((0, Vec::new()));
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                loop {
                    let index = next.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
                    let Some(document) = documents.get(index) else {
                        break;
                    };
                    let (count, faults) = judged(document);
                    let mut all = all.lock().unwrap();
                    all.0 += count;
                    all.1.extend(faults);
                }
            });
        }
    });
    let (count, faults) = all.into_inner().unwrap();
    assert!(faults.is_empty(), "{}", faults.join("\n\n"));
    assert!(count >= 60, "the documents show {count} commands");
}

#[test]
fn a_line_that_is_not_printed_is_missed() {
    let printed = "a  1\nb 2\nc 3\n";
    assert_eq!(missing("a 1\n…\nc\n", printed), None);
    assert_eq!(missing("b 2\na 1\n", printed), Some("a 1"));
    assert_eq!(missing("b 3\n", printed), Some("b 3"));
}

#[test]
fn scenes_shown_in_documents_are_right() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.json");
    let mut in_the_readme = 0;
    for document in documents() {
        for scene in texts(&document, "json") {
            if !scene.contains("\"dam\"") {
                continue;
            }
            in_the_readme += usize::from(document == "README.md");
            std::fs::write(&path, scene).unwrap();
            let output = Command::new(env!("CARGO_BIN_EXE_dam"))
                .arg("check")
                .arg(&path)
                .output()
                .unwrap();
            let said = String::from_utf8_lossy(&output.stderr).into_owned();
            assert!(output.status.success(), "{document}: {said}");
        }
    }
    assert!(in_the_readme > 0);
}

#[test]
fn the_first_answer_is_shown_as_it_is_printed() {
    let output = Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(["run", "scenarios/rocker/two_masses.json"])
        .env("COLUMNS", "100")
        .current_dir(root())
        .output()
        .unwrap();
    let printed = String::from_utf8(output.stdout).unwrap();
    let shown = &texts("docs/site/get-started.md", "text")[0];
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

#[test]
fn the_readme_is_short_and_its_pictures_are_small() {
    let readme = std::fs::read_to_string(root().join("README.md")).unwrap();
    let (lines, words) = (readme.lines().count(), readme.split_whitespace().count());
    assert!(
        lines <= 150 && words <= 1200,
        "{lines} lines, {words} words"
    );
    let pictures: Vec<String> = addresses(&readme)
        .into_iter()
        .filter(|address| address.contains("/pictures/"))
        .collect();
    assert!(pictures.len() >= 4, "light and dark: {pictures:?}");
    for picture in pictures {
        let size = std::fs::metadata(root().join(&picture)).unwrap().len();
        assert!(size <= 1_500_000, "{picture}: {size} bytes");
    }
}

/// Addresses of links and pictures of a document that lead to files.
fn addresses(text: &str) -> Vec<String> {
    let inline = text
        .split("](")
        .skip(1)
        .filter_map(|rest| rest.split(')').next());
    let marked = ["src=\"", "srcset=\""]
        .into_iter()
        .flat_map(|mark| text.split(mark).skip(1))
        .filter_map(|rest| rest.split('"').next());
    inline
        .chain(marked)
        .filter(|address| !address.contains("://") && !address.starts_with('#'))
        .map(|address| address.split('#').next().unwrap().to_owned())
        .collect()
}

/// Pages of the site too are read where the repository is hosted.
#[test]
fn links_between_documents_lead_to_files() {
    let mut faults = Vec::new();
    let mut count = 0;
    for document in documents() {
        let folder = root().join(&document).parent().unwrap().to_owned();
        let mut text = std::fs::read_to_string(root().join(&document)).unwrap();
        for block in blocks(&document) {
            text = text.replace(&block.text, "");
        }
        for address in addresses(&text) {
            count += 1;
            // Pages of gallery and reference are made by the program.
            let is_made = ["gallery/", "reference/"]
                .iter()
                .any(|made| address.contains(made));
            if !is_made && !folder.join(&address).exists() {
                faults.push(format!("{document}: {address}"));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(count > 50, "{count} links");
}
