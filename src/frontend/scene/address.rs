//! Addresses of properties: `rocker.pair.gap`, `run.tolerance`,
//! `cam.position.table.points[3]` or `cam.position.table.points.3`.

use crate::frontend::diagnostics::Place;
use crate::frontend::read::{Member, Node, Value, synonyms};
use std::ops::Range;

/// Names that address the scene itself and cannot be ids.
pub(super) const RESERVED: [&str; 12] = [
    "parameters",
    "run",
    "steady",
    "optimize",
    "tolerance",
    "identify",
    "kinematics",
    "forces",
    "expect",
    "objects",
    "name",
    "dam",
];

/// Part of an address, with its bytes in the text of the address.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Part {
    pub(super) step: Step,
    pub(super) range: Range<usize>,
}

/// One step down the tree.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Step {
    Name(String),
    Index(usize),
}

impl Step {
    /// The entry of a list that it means: `[0]`, or `0` as in `points.C.0`.
    pub(super) fn list_index(&self) -> Option<usize> {
        match self {
            Self::Index(index) => Some(*index),
            Self::Name(name) => {
                let digits = name.bytes().all(|byte| byte.is_ascii_digit());
                digits.then(|| name.parse().ok()).flatten()
            }
        }
    }
}

/// Splits an address; `None` when it is not one.
pub(super) fn split_address(address: &str) -> Option<Vec<Part>> {
    let mut parts = Vec::new();
    let mut at = 0;
    for piece in address.split('.') {
        let (name, indices) = match piece.find('[') {
            Some(bracket) => piece.split_at(bracket),
            None => (piece, ""),
        };
        if name.is_empty() {
            return None;
        }
        parts.push(Part {
            step: Step::Name(name.to_owned()),
            range: at..at + name.len(),
        });
        let mut inner = at + name.len();
        for index in indices.split_inclusive(']') {
            let number = index.strip_prefix('[')?.strip_suffix(']')?;
            parts.push(Part {
                step: Step::Index(number.parse().ok()?),
                range: inner..inner + index.len(),
            });
            inner += index.len();
        }
        at += piece.len() + 1;
    }
    Some(parts)
}

/// Finds what an address means; the place of the nearest part that exists
/// (its name where it has one).
pub(super) fn place_of_address(root: &Node, address: &str) -> Place {
    let Some(parts) = split_address(address) else {
        return root.place.first();
    };
    let reserved = matches!(&parts[0].step, Step::Name(name) if RESERVED.contains(&name.as_str()));
    let (mut node, mut place) = match reserved {
        true => (root, root.place.first()),
        false => match root.member("objects") {
            Some(member) => (&member.value, member.name_place.clone()),
            None => return root.place.first(),
        },
    };
    for part in &parts {
        let next = match (&part.step, &node.value) {
            (Step::Name(name), Value::Object(_)) => member(node, name).map(|member| {
                let small = !matches!(member.value.value, Value::Object(_) | Value::List(_));
                let shown = if small {
                    &member.value.place
                } else {
                    &member.name_place
                };
                (&member.value, shown.clone())
            }),
            (step, Value::List(items)) => {
                let item = step.list_index().and_then(|index| items.get(index));
                item.map(|item| (item, item.place.clone()))
            }
            _ => None,
        };
        match next {
            Some(found) => (node, place) = found,
            None => break,
        }
    }
    place
}

/// A property under any of its names.
fn member<'n>(node: &'n Node, name: &str) -> Option<&'n Member> {
    let other = || synonyms(name).find_map(|other| node.member(other));
    node.member(name).or_else(other)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_have_names_and_indices() {
        let steps = |address| -> Option<Vec<Step>> {
            Some(
                split_address(address)?
                    .into_iter()
                    .map(|part| part.step)
                    .collect(),
            )
        };
        let name = |name: &str| Step::Name(name.to_owned());
        assert_eq!(
            steps("cam.points[3][0].x"),
            Some(vec![
                name("cam"),
                name("points"),
                Step::Index(3),
                Step::Index(0),
                name("x")
            ])
        );
        assert_eq!(split_address("a.bc").unwrap()[1].range, 2..4);
        let entries: Vec<_> = ["7", "x7", "07", "-1", "99999999999999999999"]
            .map(|text| name(text).list_index())
            .into();
        assert_eq!(entries, [Some(7), None, Some(7), None, None]);
        for bad in [
            "", ".", "a.", ".a", "a..b", "a[", "a[]", "a[x]", "a]b[", "[0]",
        ] {
            assert_eq!(steps(bad), None, "{bad}");
        }
    }
}
