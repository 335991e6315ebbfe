//! What imports what in `src`: folders in one direction, few circles between files.

use petgraph::algo::tarjan_scc;
use petgraph::graph::{DiGraph, NodeIndex};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Folders and files of `src`, each with the row it stands in: what stands in a row
/// imports from its own folder and from lower rows alone.
const ROWS: &[&[&str]] = &[
    &["math", "fault", "budget"],
    &["units"],
    &["kinematics"],
    &["dynamics"],
    &["exact"],
    &["frontend"],
    &["error"],
    &["studies"],
    &["ask", "report"],
    &["studio"],
    &["prelude", "cli"],
];

/// Circles between files that share one job: the audit and the walk of `exact`, a run of
/// the integrator, the passes of the equations of motion.
const MOST_CIRCLES: usize = 3;

/// Where the crate's root has the types that it names itself.
const ROOT: [(&str, &str); 3] = [("Error", "error"), ("Mechanism", "ask"), ("Scene", "ask")];

/// A module: its path from the crate's root, and what it imports of the crate.
struct Module {
    path: Vec<String>,
    imports: Vec<Vec<String>>,
}

fn row(name: &str) -> Option<usize> {
    ROWS.iter().position(|row| row.contains(&name))
}

/// All modules of `src` besides tests, the crate's root and the program's.
fn modules() -> Vec<Module> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    collect(&root, &mut files);
    files.sort();
    files
        .iter()
        .filter_map(|file| {
            let relative = file.strip_prefix(&root).unwrap().with_extension("");
            let mut path: Vec<String> = (relative.iter())
                .map(|part| part.to_str().unwrap().to_owned())
                .collect();
            if path.last().is_some_and(|last| last == "mod") {
                path.pop();
            }
            let of_tests = |part: &String| {
                ["tests", "testing", "fixture"].contains(&part.as_str()) || part.ends_with("_tests")
            };
            let is_root = path.len() == 1 && ["lib", "main"].contains(&path[0].as_str());
            if is_root || path.iter().any(of_tests) {
                return None;
            }
            let text = std::fs::read_to_string(file).unwrap();
            let imports = imports(&path, &code(&text));
            Some(Module { path, imports })
        })
        .collect()
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            collect(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
}

/// A file without comments and without its tests.
fn code(text: &str) -> String {
    let text = match text.find("#[cfg(test)]\nmod tests {") {
        Some(tests) => &text[..tests],
        None => text,
    };
    let lines = text
        .lines()
        .map(|line| line.split("//").next().unwrap_or(""));
    lines.collect::<Vec<_>>().join("\n")
}

/// Absolute paths of what a file imports or names with `crate::` or `super::`.
fn imports(of: &[String], code: &str) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    let mut rest = code;
    while let Some(at) = ["crate::", "super::"]
        .iter()
        .filter_map(|start| rest.find(start))
        .min()
    {
        let boundary = rest[..at].chars().next_back();
        let mut end = at;
        let bytes = rest.as_bytes();
        while end < bytes.len()
            && (bytes[end].is_ascii_alphanumeric() || b"_:".contains(&bytes[end]))
        {
            end += 1;
        }
        if !boundary.is_some_and(|c| c.is_alphanumeric() || "_:".contains(c)) {
            let head = rest[at..end].trim_end_matches("::");
            match rest[end..].strip_prefix('{') {
                Some(tree) if rest[..end].ends_with("::") => {
                    for leaf in leaves(tree) {
                        found.push(absolute(of, &format!("{head}::{leaf}")));
                    }
                }
                _ => found.push(absolute(of, head)),
            }
        }
        rest = &rest[end.max(at + 1)..];
    }
    found
}

/// First parts of the items of a `use` tree, up to its closing brace.
fn leaves(tree: &str) -> Vec<String> {
    let (mut depth, mut items, mut item) = (0, Vec::new(), String::new());
    for c in tree.chars() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => break,
            '}' => depth -= 1,
            ',' if depth == 0 => items.push(std::mem::take(&mut item)),
            c if depth == 0 => item.push(c),
            _ => {}
        }
    }
    items.push(item);
    let trimmed = items
        .iter()
        .map(|item| item.split(" as ").next().unwrap().trim());
    trimmed
        .map(|item| {
            item.trim_end_matches("::")
                .trim_end_matches("::self")
                .to_owned()
        })
        .filter(|item| !item.is_empty() && item != "self")
        .collect()
}

fn absolute(of: &[String], path: &str) -> Vec<String> {
    let mut parts = path.split("::").map(str::to_owned).peekable();
    let mut base = of.to_vec();
    if parts.next_if(|part| part == "crate").is_some() {
        base.clear();
    }
    while parts.next_if(|part| part == "super").is_some() {
        base.pop();
    }
    base.extend(parts);
    base
}

/// The module that a path leads into: the longest beginning that is one.
fn target(known: &BTreeMap<&[String], usize>, path: &[String]) -> Option<usize> {
    (1..=path.len())
        .rev()
        .find_map(|length| known.get(&path[..length]).copied())
}

#[test]
fn folders_import_in_one_direction() {
    let modules = modules();
    assert!(
        modules.len() > 400,
        "only {} modules were found",
        modules.len()
    );
    let mut wrong = Vec::new();
    for module in &modules {
        let own = &module.path[0];
        let Some(here) = row(own) else {
            wrong.push(format!("`{own}` has no row"));
            continue;
        };
        for import in &module.imports {
            let Some(other) = import.first().filter(|other| *other != own) else {
                continue;
            };
            let named = ROOT.iter().find(|(name, _)| name == other);
            let other = named.map_or(other.as_str(), |(_, home)| home);
            if row(other).is_none_or(|there| there >= here && other != own) {
                wrong.push(format!(
                    "{} imports {}",
                    module.path.join("::"),
                    import.join("::")
                ));
            }
        }
    }
    wrong.dedup();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn circles_between_files_are_few_and_inside_folders() {
    let modules = modules();
    let known: BTreeMap<&[String], usize> = (modules.iter().enumerate())
        .map(|(index, module)| (&module.path[..], index))
        .collect();
    let mut graph = DiGraph::<usize, ()>::new();
    for index in 0..modules.len() {
        graph.add_node(index);
    }
    for (index, module) in modules.iter().enumerate() {
        for other in module
            .imports
            .iter()
            .filter_map(|import| target(&known, import))
        {
            // A folder's own file gathers what lies in it.
            let below = modules[index].path.starts_with(&modules[other].path)
                || modules[other].path.starts_with(&modules[index].path);
            if !below {
                graph.update_edge(NodeIndex::new(index), NodeIndex::new(other), ());
            }
        }
    }
    let circles: Vec<Vec<String>> = (tarjan_scc(&graph).iter())
        .filter(|circle| circle.len() > 1)
        .map(|circle| {
            circle
                .iter()
                .map(|node| modules[graph[*node]].path.join("::"))
                .collect()
        })
        .collect();
    let told: Vec<String> = circles.iter().map(|circle| circle.join(" ")).collect();
    assert!(
        circles.len() <= MOST_CIRCLES,
        "{} circles:\n{}",
        circles.len(),
        told.join("\n")
    );
    for circle in &circles {
        let folder = |path: &str| path.rsplit_once("::").map(|(folder, _)| folder.to_owned());
        assert!(
            circle.iter().all(|path| folder(path) == folder(&circle[0])),
            "{circle:?}"
        );
    }
}

#[test]
fn imports_are_found_wherever_they_stand() {
    let of = ["exact".to_owned(), "walk".to_owned(), "branch".to_owned()];
    let code = "mod one { use super::super::phase::Phase; }\n\
                fn two() { use crate::studies::run; }\n\
                fn three() -> crate::report::Findings { super::cut() }\n\
                macro_rules! four { () => { $crate::cli::main() } }\n\
                use crate::{frontend::{scene::Document, read}, Error};";
    let found: Vec<String> = imports(&of, code)
        .iter()
        .map(|path| path.join("::"))
        .collect();
    let wanted = [
        "exact::phase::Phase",
        "studies::run",
        "report::Findings",
        "exact::walk::cut",
        "cli::main",
        "frontend",
        "Error",
    ];
    assert_eq!(found, wanted);
}

#[test]
fn import_trees_are_read() {
    let of = ["dynamics".to_owned(), "record".to_owned(), "log".to_owned()];
    let code = "use super::{failure::{self, Failure}, tally::Tally as T};\nuse crate::math::roots;\nlet x = crate::units::shown(1.0);";
    let found: Vec<String> = imports(&of, code)
        .iter()
        .map(|path| path.join("::"))
        .collect();
    let wanted = [
        "dynamics::record::failure",
        "dynamics::record::tally::Tally",
        "math::roots",
        "units::shown",
    ];
    assert_eq!(found, wanted);
}
