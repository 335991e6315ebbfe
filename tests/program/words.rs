//! How the documents speak: length of their sentences, and phrases of no textbook.

use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Limits of sentences, in words.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits {
    mean: f64,
    longest: usize,
    /// True where phrases and beginnings of sentences are looked at.
    plain: bool,
}

impl Limits {
    /// Of guides, messages and help.
    pub(super) const GUIDE: Self = Self {
        mean: 15.0,
        longest: 30,
        plain: true,
    };
    /// Of theory and of the documentation of code.
    pub(super) const THEORY: Self = Self {
        mean: 22.0,
        longest: 45,
        plain: false,
    };
}

/// Pages of folders of the site.
fn pages(folders: &[&str]) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for folder in folders {
        let entries = std::fs::read_dir(root().join(folder)).expect("a folder");
        let paths = entries.map(|entry| entry.expect("an entry").path());
        found.extend(paths.filter(|path| path.extension().is_some_and(|own| own == "md")));
    }
    found
}

/// Documents with the limits of their sentences.
fn kinds() -> [(Vec<PathBuf>, Limits); 2] {
    let top = [
        "README.md",
        "CONTRIBUTING.md",
        "SECURITY.md",
        "CHANGELOG.md",
        "python/README.md",
        "scenarios/README.md",
        "objects/README.md",
        "docs/model-order.md",
        "docs/studio-latency.md",
    ];
    let folders = [
        "docs/site",
        "docs/site/guides",
        "docs/site/tutorial",
        "docs/site/course",
        "docs/site/trust",
    ];
    let mut guides = pages(&folders);
    guides.extend(top.map(|name| root().join(name)));
    let mut theory = pages(&["docs/site/theory"]);
    theory.push(root().join("ARCHITECTURE.md"));
    [(guides, Limits::GUIDE), (theory, Limits::THEORY)]
}

/// Text between two marks replaced by one word.
fn folded(line: &str, mark: char, word: &str) -> String {
    let parts: Vec<&str> = line.split(mark).collect();
    let mut out = String::new();
    for (index, part) in parts.iter().enumerate() {
        // (A mark without its end stays as it is.)
        let within = index % 2 == 1 && index + 1 < parts.len();
        out.push_str(if within { word } else { part });
    }
    out
}

/// A line without addresses of links: `[text](address)` is its text.
fn without_links(line: &str) -> String {
    let mut out = String::new();
    let mut rest = line;
    while let Some(at) = rest.find("](") {
        out.push_str(&rest[..at]);
        rest = rest[at..].find(')').map_or("", |end| &rest[at + end + 1..]);
    }
    out.push_str(rest);
    out.replace(['[', ']', '*', '_'], "")
}

/// The paragraphs and list items of a document, without code, tables, headings and pictures.
fn paragraphs(text: &str) -> Vec<String> {
    let (mut found, mut now, mut code) = (Vec::new(), String::new(), false);
    for line in text.lines().map(str::trim) {
        let fence = line.starts_with("```");
        code ^= fence;
        let apart = ["|", "#", "<", "!", "---", "$$", ":::"];
        let number = line.split_once(". ").map(|(number, _)| number);
        let numbered = number.is_some_and(|own| !own.is_empty() && own.parse::<u32>().is_ok());
        let item = line.starts_with("- ") || line.starts_with("* ") || numbered;
        if code
            || fence
            || line.is_empty()
            || item
            || apart.iter().any(|mark| line.starts_with(mark))
        {
            found.push(std::mem::take(&mut now));
        }
        let skipped = code || fence || apart.iter().any(|mark| line.starts_with(mark));
        if !skipped {
            let own = match item {
                true => line.split_once(' ').map_or("", |(_, rest)| rest),
                false => line,
            };
            now.push_str(own);
            now.push(' ');
        }
    }
    found.push(now);
    let plain = |text: String| without_links(&folded(&folded(&text, '`', "Code"), '$', "Formula"));
    found
        .into_iter()
        .map(plain)
        .filter(|text| !text.trim().is_empty())
        .collect()
}

/// The sentences of a paragraph: they end before a word that begins with a capital.
fn sentences(paragraph: &str) -> Vec<String> {
    let mut found = vec![String::new()];
    let mut ended = false;
    for word in paragraph.split_whitespace() {
        let first = word.trim_start_matches(['(', '"', '“']).chars().next();
        if ended && first.is_some_and(char::is_uppercase) {
            found.push(String::new());
        }
        let bare = word.trim_end_matches(['"', '”', ')']);
        ended = bare.ends_with(['.', '!', '?']);
        if let Some(last) = found.last_mut() {
            last.push_str(word);
            last.push(' ');
        }
    }
    found.retain(|sentence| words(sentence) > 0);
    found
}

fn words(sentence: &str) -> usize {
    let is_word = |word: &&str| word.chars().any(char::is_alphanumeric);
    sentence.split_whitespace().filter(is_word).count()
}

/// Phrases that no guide has, with what is written instead.
fn phrases() -> Vec<(String, String)> {
    let text = std::fs::read_to_string(root().join("tests/words/phrases.txt")).expect("a list");
    let rows = text.lines().filter(|line| !line.starts_with('#'));
    rows.filter_map(|line| line.split_once(" | "))
        .map(|(phrase, instead)| (phrase.to_owned(), instead.to_owned()))
        .collect()
}

/// What is wrong with texts, each with the name of its place: their mean, and single sentences.
pub(super) fn faults_of_text(texts: &[(String, String)], limits: Limits) -> Vec<String> {
    let phrases = phrases();
    let (mut found, mut total, mut count) = (Vec::new(), 0, 0);
    for (name, text) in texts {
        for sentence in paragraphs(text).iter().flat_map(|own| sentences(own)) {
            total += words(&sentence);
            count += 1;
            let faults = faults_of_sentence(&sentence, limits, &phrases);
            found.extend(faults.into_iter().map(|fault| format!("{name}: {fault}")));
        }
    }
    let mean = total as f64 / count.max(1) as f64;
    if mean > limits.mean {
        let name = texts.first().map_or("", |(name, _)| name.as_str());
        found.push(format!(
            "{name}: {mean:.1} words a sentence, {} at most",
            limits.mean
        ));
    }
    found
}

fn faults_of_sentence(sentence: &str, limits: Limits, phrases: &[(String, String)]) -> Vec<String> {
    let mut found = Vec::new();
    let count = words(sentence);
    if count > limits.longest {
        found.push(format!("{count} words: {sentence}"));
    }
    if !limits.plain {
        return found;
    }
    if ["Of a ", "Of an ", "Of the "]
        .iter()
        .any(|own| sentence.starts_with(own))
    {
        found.push(format!("begins with \"Of\": {sentence}"));
    }
    for (phrase, instead) in phrases {
        if sentence.contains(phrase.as_str()) {
            found.push(format!("\"{phrase}\" ({instead}): {sentence}"));
        }
    }
    found
}

/// What is wrong with a document.
fn faults(path: &Path, limits: Limits) -> Vec<String> {
    let text = std::fs::read_to_string(path).expect("a document");
    let name = path.strip_prefix(root()).unwrap_or(path).display();
    faults_of_text(&[(name.to_string(), text)], limits)
}

/// What is wrong with a page that is written as guides are.
pub(super) fn faults_of_guide(path: &Path) -> Vec<String> {
    faults(path, Limits::GUIDE)
}

#[test]
fn documents_are_written_in_short_sentences() {
    let mut found = Vec::new();
    for (files, limits) in kinds() {
        assert!(files.len() > 5, "the documents are there");
        for path in &files {
            found.extend(faults(path, limits));
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn sentences_are_counted_without_code_and_tables() {
    let text = "# A heading. Not counted.\n\nOne two `three four.` five. Six\nseven [eight](nine ten).\n\n\
                - An item.\n- Another\n  one.\n\n| a | table |\n\n```sh\nmany words of code\n```\n\
                1. First. Of a kind.\n";
    let all: Vec<String> = paragraphs(text)
        .iter()
        .flat_map(|paragraph| sentences(paragraph))
        .collect();
    let counts: Vec<usize> = all.iter().map(|sentence| words(sentence)).collect();
    assert_eq!(counts, [4, 3, 2, 2, 1, 3], "{all:?}");
    let limits = Limits {
        mean: 1.0,
        longest: 3,
        plain: true,
    };
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("page.md");
    std::fs::write(&path, "Of a pump that hangs on its pipe.\n").expect("a page");
    let wrong = faults(&path, limits);
    assert_eq!(wrong.len(), 4, "{wrong:?}");
}
