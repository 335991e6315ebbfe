//! Tables in documents that follow from the declarations, the catalogue and the scenarios.
//!
//! `DAM_BLESS=1 cargo test --test program tables` writes them anew. Of the table of scenarios it
//! adds what is absent alone: people choose its order and its words.

use dam::object::Registry;
use dam::scene::{BuiltIn, Catalogue};
use serde_json::Value;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn is_blessed() -> bool {
    std::env::var_os("DAM_BLESS").is_some()
}

fn json(path: &Path) -> Value {
    let text = fs::read_to_string(path).expect("a file");
    serde_json::from_str(&text).expect("JSON")
}

/// A text with what lies between two lines replaced.
fn replaced(text: &str, marks: [&str; 2], new: &str) -> String {
    let [first, last] = marks;
    let (before, rest) = text.split_once(first).expect("the first line");
    let (_, after) = rest.split_once(last).expect("the last line");
    format!("{before}{first}{new}{last}{after}")
}

/// Checks what a document has between two lines, or writes it.
fn check(document: &str, marks: [&str; 2], new: &str) {
    let path = root().join(document);
    let text = fs::read_to_string(&path).expect("a document");
    let made = replaced(&text, marks, new);
    if is_blessed() {
        fs::write(&path, &made).expect("writing");
    }
    let now = fs::read_to_string(&path).expect("a document");
    assert!(
        now == made,
        "{document} is stale: run DAM_BLESS=1 cargo test --test program tables"
    );
}

/// The lines around a table in Markdown.
const TABLE: [&str; 2] = ["<!-- made from the declarations -->\n", "<!-- end -->\n"];

fn table(heads: &str, rows: impl Iterator<Item = String>) -> String {
    format!("\n{heads}\n| --- | --- |\n{}\n", rows.collect::<String>())
}

#[test]
fn the_catalogue_is_listed_in_its_order() {
    let registry = Registry::standard();
    let mut names = BuiltIn.names();
    names.sort_by_key(|name| {
        let kind = name.split('/').next();
        let kinds = registry.kinds();
        let at = kinds.iter().position(|own| Some(own.name) == kind);
        (at.expect("a folder of a kind"), name.clone())
    });
    let rows = names.into_iter().map(|name| {
        let object = json(&root().join("objects").join(format!("{name}.json")));
        let description = object["description"].as_str().expect("a description");
        format!("| `{name}` | {description} |\n")
    });
    let made = table("| object | what it is |", rows);
    check("objects/README.md", TABLE, &made);
}

#[test]
fn the_guide_lists_all_kinds_of_objects() {
    let registry = Registry::standard();
    let rows = registry.kinds().iter().map(|kind| {
        let (name, page) = (kind.name, kind.name.replace('_', "-"));
        format!("| [`{name}`](../reference/{page}.md) | {} |\n", kind.doc)
    });
    let made = table("| object | what it is |", rows);
    check("docs/site/guides/scene.md", TABLE, &made);
}

#[test]
fn the_site_has_a_page_for_each_kind_of_objects() {
    let registry = Registry::standard();
    let mut names: Vec<&str> = registry.kinds().iter().map(|kind| kind.name).collect();
    names.sort_unstable();
    let mut made = String::new();
    for name in names {
        let page = name.replace('_', "-");
        let _ = writeln!(made, "          - {name}: reference/{page}.md");
    }
    let marks = ["      - Objects:\n", "      - Position functions:"];
    check("docs/mkdocs.yml", marks, &made);
}

/// A row of the table of scenarios: the question that its description begins with, or its name,
/// and the sources of what it expects.
fn row(name: &str, scene: &Value) -> String {
    let description = scene["description"].as_str().unwrap_or_default();
    let question = match description.split_once('?') {
        Some((question, _)) => format!("{question}?"),
        None => scene["name"].as_str().unwrap_or(name).to_owned(),
    };
    let expected = scene["expect"].as_array().into_iter().flatten();
    let mut sources: Vec<&str> = expected.filter_map(|one| one["source"].as_str()).collect();
    sources.sort_unstable();
    sources.dedup();
    format!("| `{name}` | {question} | {} |\n", sources.join("; "))
}

/// A text with rows behind the last row of its table of three columns.
fn with_rows(text: &str, rows: &str) -> String {
    let is_row = |line: &&str| line.starts_with("| `") && line.matches(" | ").count() == 2;
    let last = text.split_inclusive('\n').rfind(is_row);
    let last = last.expect("a row");
    text.replacen(last, &format!("{last}{rows}"), 1)
}

#[test]
fn every_scene_is_named_in_the_table_of_scenarios() {
    let path = root().join("scenarios/README.md");
    let text = fs::read_to_string(&path).expect("a document");
    let mut absent = String::new();
    for scene in super::scenarios::scenes() {
        let file: PathBuf = scene.strip_prefix(root().join("scenarios")).unwrap().into();
        let name = file.with_extension("").display().to_string();
        if !text.contains(&format!("`{name}`")) {
            absent += &row(&name, &json(&scene));
        }
    }
    if is_blessed() {
        fs::write(&path, with_rows(&text, &absent)).expect("writing");
    } else {
        assert!(absent.is_empty(), "scenarios/README.md lacks\n{absent}");
    }
}

#[test]
fn rows_are_made_and_put_behind_the_last_one() {
    let scene = serde_json::json!({
        "name": "A ball", "description": "How high? Without loss.",
        "expect": [{ "source": "closed form" }, { "source": "closed form" }],
    });
    let made = row("contact/ball", &scene);
    assert_eq!(made, "| `contact/ball` | How high? | closed form |\n");
    let text = "| `a` | A? | b |\n| `c` | C? | d |\n\ntext\n";
    let wanted = "| `a` | A? | b |\n| `c` | C? | d |\nnew\n\ntext\n";
    assert_eq!(with_rows(text, "new\n"), wanted);
    let text = "a\n<b>\nold\n</b>\nc\n";
    let wanted = "a\n<b>\nnew\n</b>\nc\n";
    assert_eq!(replaced(text, ["<b>\n", "</b>\n"], "new\n"), wanted);
}
