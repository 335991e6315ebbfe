//! How the program speaks: sentences of its messages, of its help and of the comments on its code.

use super::words::{Limits, faults_of_text};
use std::path::{Path, PathBuf};

/// Every file of code below a folder that is not one of tests.
fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().and_then(|own| own.to_str()).unwrap_or("");
        if path.is_dir() && name != "tests" {
            sources(&path, found);
        } else if name.ends_with(".rs") && name != "tests.rs" {
            found.push(path);
        }
    }
}

/// A literal of text that begins behind the quotation mark at `at`: its content without the
/// breaks of its lines, and where it ends.
fn literal(code: &[char], at: usize) -> (String, usize) {
    let (mut text, mut next) = (String::new(), at);
    while next < code.len() && code[next] != '"' {
        match (code[next], code.get(next + 1)) {
            ('\\', Some('\n')) => {
                next += 1;
                while code.get(next).is_some_and(|letter| letter.is_whitespace()) {
                    next += 1;
                }
            }
            ('\\', Some('n')) => {
                text.push_str("\n\n");
                next += 2;
            }
            ('\\', Some(letter)) => {
                text.push(*letter);
                next += 2;
            }
            (letter, _) => {
                text.push(letter);
                next += 1;
            }
        }
    }
    (text, next + 1)
}

/// The literals of text of a code, and the comments that document it, each as one text.
fn texts(code: &str) -> (Vec<String>, Vec<String>) {
    let code = code.split("#[cfg(test)]").next().unwrap_or("");
    let (mut comments, mut plain, mut now) = (Vec::new(), String::new(), String::new());
    for line in code.lines() {
        let own = line.trim_start();
        match own.strip_prefix("//!").or(own.strip_prefix("///")) {
            Some(text) => {
                now.push_str(text);
                now.push('\n');
            }
            None => {
                comments.push(std::mem::take(&mut now));
                if !own.starts_with("//") {
                    plain.push_str(line);
                }
                plain.push('\n');
            }
        }
    }
    comments.push(now);
    comments.retain(|text| !text.trim().is_empty());
    let plain: Vec<char> = plain.chars().collect();
    let (mut literals, mut at) = (Vec::new(), 0);
    while at < plain.len() {
        match plain[at] {
            // A character: it may be a quotation mark.
            '\'' if plain.get(at + 2) == Some(&'\'') => at += 3,
            '\'' if plain.get(at + 1) == Some(&'\\') => at += 4,
            // A raw text: code of pages, not a sentence.
            '#' if plain.get(at + 1) == Some(&'"') && at > 0 && plain[at - 1] == 'r' => {
                at += 2;
                while at < plain.len() && !(plain[at] == '"' && plain.get(at + 1) == Some(&'#')) {
                    at += 1;
                }
                at += 2;
            }
            '"' => {
                let (text, end) = literal(&plain, at + 1);
                literals.push(text);
                at = end;
            }
            _ => at += 1,
        }
    }
    (literals, comments)
}

/// A message with a word in place of each value, if it is a sentence or a part of one.
fn sentence(literal: &str) -> Option<String> {
    // (Marks and styles of pages are no sentences.)
    if literal.contains('<') && literal.contains('>') || literal.contains(";stroke") {
        return None;
    }
    let (mut text, mut within) = (String::new(), false);
    for letter in literal.chars() {
        match letter {
            '{' => {
                within = true;
                text.push_str("value");
            }
            '}' => within = false,
            other if !within => text.push(other),
            _ => {}
        }
    }
    (text.split_whitespace().count() >= 4).then_some(text)
}

#[test]
fn messages_help_and_comments_are_written_in_short_sentences() {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let mut files = Vec::new();
    sources(&root.join("src"), &mut files);
    let (mut found, mut messages, mut help, mut comments) = (Vec::new(), vec![], vec![], vec![]);
    for path in &files {
        let code = std::fs::read_to_string(path).expect("a file of code");
        let name = path.strip_prefix(&root).unwrap_or(path).display();
        let (literals, own) = texts(&code);
        let said = literals.iter().filter_map(|own| sentence(own));
        messages.extend(said.map(|text| (name.to_string(), text)));
        let kept = match name.to_string().starts_with("src/cli/args") {
            true => &mut help,
            false => &mut comments,
        };
        kept.extend(own.into_iter().map(|text| (name.to_string(), text)));
    }
    // (The walk has found the code.)
    assert!(messages.len() > 1000 && help.len() > 100 && comments.len() > 5000);
    for (texts, limits) in [
        (messages, Limits::GUIDE),
        (help, Limits::GUIDE),
        (comments, Limits::THEORY),
    ] {
        found.extend(faults_of_text(&texts, limits));
    }
    assert!(
        found.is_empty(),
        "{} faults:\n{}",
        found.len(),
        found.join("\n")
    );
}

#[test]
fn texts_are_read_from_code() {
    let code = "/// Meant.\n/// On.\nfn one() { let a = \"two \\\n      words {x} \\\"q\\\"\"; '\"'; }\n// \"no\"\n";
    let (literals, comments) = texts(code);
    assert_eq!(literals, ["two words {x} \"q\""]);
    assert_eq!(comments, [" Meant.\n On.\n"]);
    assert_eq!(sentence("a {b} c d"), Some("a value c d".to_owned()));
    assert_eq!(sentence("<p>a b c d</p>"), None);
}
