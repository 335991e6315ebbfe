//! The object graph as an indented tree and as DOT.

use super::units;
use crate::dynamics::model::Closure;
use crate::report::diagram::{Diagram, ObjectBox};
use crate::report::quantity::with_unit;

/// The graph as an indented tree, one object a line, drives at the margin.
///
/// ```text
/// shaft  drive, 62.83 rad/s
/// └─ rocker  rocker, 2 masses; U = (π/2)·sin φ; force-closed
/// ```
pub fn tree(diagram: &Diagram) -> String {
    let mut out = String::new();
    // (box, prefix of its own line, prefix of its followers' lines)
    let mut stack: Vec<(usize, String, String)> = (0..diagram.boxes.len())
        .rev()
        .filter(|&index| diagram.boxes[index].is_drive())
        .map(|index| (index, String::new(), String::new()))
        .collect();
    while let Some((index, own, below)) = stack.pop() {
        out.push_str(&format!("{own}{}\n", line(&diagram.boxes[index])));
        let followers: Vec<usize> = diagram.followers(index).collect();
        for (place, &follower) in followers.iter().enumerate().rev() {
            let (branch, rest) = if place + 1 == followers.len() {
                ("└─ ", "   ")
            } else {
                ("├─ ", "│  ")
            };
            stack.push((
                follower,
                format!("{below}{branch}"),
                format!("{below}{rest}"),
            ));
        }
    }
    out
}

fn line(one: &ObjectBox) -> String {
    let mut parts = vec![format!("{}  {}, {}", one.id, one.kind, one.detail)];
    if !one.position.is_empty() {
        parts.push(one.position.clone());
    }
    if let Some(pair) = pair_words(one) {
        parts.push(pair);
    }
    parts.join("; ")
}

/// How a pair is kept together, in words; `None` for a bilateral one.
fn pair_words(one: &ObjectBox) -> Option<String> {
    match one.closure {
        Closure::Bilateral => None,
        Closure::Force => Some("force-closed".into()),
        Closure::Form => {
            let unit = units(one.coordinate).displacement;
            Some(format!("form-closed, gap {}", with_unit(one.gap, unit, 4)))
        }
    }
}

/// The graph in the DOT language of Graphviz.
pub fn dot(diagram: &Diagram) -> String {
    let mut out = String::from(
        "digraph mechanism {\n  rankdir=LR;\n  node [shape=box, fontname=\"sans-serif\"];\n  \
         edge [fontname=\"sans-serif\", fontsize=10];\n",
    );
    for one in &diagram.boxes {
        let style = if one.is_drive() {
            ", style=rounded"
        } else {
            ""
        };
        let label = [one.id.as_str(), one.kind.as_str(), one.detail.as_str()].map(dot_string);
        out.push_str(&format!(
            "  \"{}\" [label=\"{}\"{style}];\n",
            dot_string(&one.id),
            label.join("\\n")
        ));
    }
    for one in &diagram.boxes {
        let pair =
            pair_words(one).map_or(String::new(), |words| format!("\\n{}", dot_string(&words)));
        for input in &one.inputs {
            let (from, to) = (&diagram.boxes[input.driver].id, dot_string(&one.id));
            let from = dot_string(from);
            let label = match input.name.as_str() {
                "" => format!("{}{pair}", dot_string(&one.position)),
                port => dot_string(port),
            };
            out.push_str(&format!("  \"{from}\" -> \"{to}\" [label=\"{label}\"];\n"));
            out.push_str(&format!(
                "  \"{to}\" -> \"{from}\" [label=\"Ω\", style=dashed, constraint=false];\n"
            ));
        }
    }
    out + "}\n"
}

/// Text for a quoted string of DOT.
fn dot_string(text: &str) -> String {
    text.replace('\\', "\\\\")
        .replace('"', "\\\"")
        .replace('\n', " ")
}

#[cfg(test)]
mod tests {
    use super::{dot, tree};
    use crate::report::diagram::Diagram;
    use crate::report::fixture;

    #[test]
    fn the_tree_shows_who_drives_whom() {
        assert_eq!(
            tree(&Diagram::of(&fixture::fan_out())),
            "motor  drive, motor\n\
             └─ shaft  shaft, 2 masses; U = 0.25φ; form-closed, gap 1 mrad\n\
             \u{20}  ├─ left  rocker, 1 mass; U = 0.2·sin(2φ − π/2) + 0.2; force-closed\n\
             \u{20}  └─ right  slider, rigid; U = 0.04·sin(2φ − π/2) + 0.04\n"
        );
    }

    #[test]
    fn dot_names_both_directions_of_every_edge() {
        let mut diagram = Diagram::of(&fixture::rocker(2));
        diagram.boxes[1].detail = "a \"quoted\" \\ detail".into();
        assert_eq!(
            dot(&diagram),
            "digraph mechanism {\n  rankdir=LR;\n  node [shape=box, fontname=\"sans-serif\"];\n  \
             edge [fontname=\"sans-serif\", fontsize=10];\n  \
             \"shaft\" [label=\"shaft\\ndrive\\n62.83 rad/s\", style=rounded];\n  \
             \"rocker\" [label=\"rocker\\nrocker\\na \\\"quoted\\\" \\\\ detail\"];\n  \
             \"shaft\" -> \"rocker\" [label=\"U = (π/2)·sin φ\\nforce-closed\"];\n  \
             \"rocker\" -> \"shaft\" [label=\"Ω\", style=dashed, constraint=false];\n}\n"
        );
    }
}
