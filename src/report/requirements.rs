//! What scenes expect, with verdicts: as data, as JSON and as JUnit has it.

use crate::report::findings::{Cell, Findings, Section, Source, Table};
use crate::report::quantity::{escape, with_unit};
use crate::report::verdict::{Sort, Verdict};
use crate::studies::expectations::Requirement;
use serde_json::{Value, json};
use std::fmt::Write as _;

/// Digits of values.
const DIGITS: usize = 7;

/// A scene with what it expects.
#[derive(Clone, Debug)]
pub struct VerifiedScene {
    /// The file, as it was named.
    pub file: String,
    /// Name of the scene; of one that is wrong the file.
    pub scene: String,
    /// Its requirements; of one that is wrong, or that could not be asked, why.
    pub requirements: Result<Vec<Requirement>, String>,
}

impl VerifiedScene {
    /// Requirements that hold, and all.
    pub fn held_and_all(&self) -> [usize; 2] {
        let all = self.requirements.as_deref().unwrap_or_default();
        [all.iter().filter(|one| one.holds()).count(), all.len()]
    }

    /// Whether it could be asked, and all requirements hold.
    pub fn holds(&self) -> bool {
        let [held, all] = self.held_and_all();
        self.requirements.is_ok() && held == all
    }
}

/// The table of a scene.
pub fn findings(verified: &VerifiedScene) -> Findings<'_> {
    let [held, all] = verified.held_and_all();
    let (sort, headline) = match (&verified.requirements, all) {
        (Err(why), _) => (Sort::Numerical, why.clone()),
        (Ok(_), 0) => (Sort::Unfinished, "The scene expects nothing.".to_owned()),
        (Ok(_), 1) if held == 1 => (Sort::Good, "The requirement holds.".to_owned()),
        (Ok(_), 1) => (Sort::Mechanism, "The requirement does not hold.".to_owned()),
        (Ok(_), _) if held == all => (Sort::Good, format!("All {all} requirements hold.")),
        (Ok(_), _) => (
            Sort::Mechanism,
            format!("{} of {all} requirements do not hold.", all - held),
        ),
    };
    let rows = verified
        .requirements
        .as_deref()
        .unwrap_or_default()
        .iter()
        .map(row);
    let table = Table::new(["requirement", ">found", "verdict", "~why", "~source"]).rows(rows);
    let mut sections = vec![Section::new("Requirements").table(table)];
    sections.retain(|section| !section.is_empty());
    Findings {
        title: verified.scene.clone(),
        subtitle: verified.file.clone(),
        answer: Some(Verdict::answer(sort, headline, "")),
        warnings: Vec::new(),
        sections,
        source: Source::default(),
    }
}

fn row(one: &Requirement) -> Vec<Cell> {
    let found = one
        .verdict
        .found
        .map_or_else(|| "–".to_owned(), |value| quantity(value, &one.unit));
    let (words, why) = match (&one.not_judged, one.verdict.holds) {
        (Some(why), _) => ("not judged", why.as_str()),
        (None, true) => ("holds", ""),
        // What has no value fails, and says why.
        (None, false) if one.verdict.found.is_none() => ("fails", one.verdict.message.as_str()),
        (None, false) => ("fails", ""),
    };
    let source = one.verdict.source.as_deref().unwrap_or("");
    vec![
        Cell::from(words_of(one)),
        Cell::from(found),
        Cell::from(words).with_outcome(Some(one.holds())),
        Cell::from(why),
        Cell::from(source),
    ]
}

/// Why a requirement fails, with units: `8331 N, required at most 600 N`, and with all digits.
fn failure_of(one: &Requirement) -> String {
    let verdict = &one.verdict;
    match verdict.found {
        Some(value) => {
            let required = words_of(one);
            let required = required.strip_prefix(verdict.what.as_str());
            let required = required.unwrap_or_default().trim();
            format!(
                "{}, required {required} (SI: {})",
                quantity(value, &one.unit),
                verdict.message
            )
        }
        None => verdict.message.clone(),
    }
}

/// A requirement in words: `valve.pair.margin at least 50 N`.
fn words_of(one: &Requirement) -> String {
    let verdict = &one.verdict;
    let size = |value: f64| quantity(value, &one.unit);
    let limits = match (verdict.at_least, verdict.at_most) {
        (Some(least), Some(most)) => format!("between {} and {}", size(least), size(most)),
        (Some(least), None) => format!("at least {}", size(least)),
        (None, Some(most)) => format!("at most {}", size(most)),
        (None, None) => format!("{} within {}", size(verdict.expected), size(verdict.within)),
    };
    format!("{} {limits}", verdict.what)
}

fn quantity(value: f64, unit: &str) -> String {
    with_unit(value, unit, DIGITS)
}

/// The JSON document of several scenes.
pub fn document(all: &[VerifiedScene]) -> Value {
    let scene = |one: &VerifiedScene| {
        let mut document = json!({ "file": one.file, "scene": one.scene, "holds": one.holds() });
        match &one.requirements {
            Ok(requirements) => document["requirements"] = json!(requirements),
            Err(why) => document["error"] = json!(why),
        }
        document
    };
    json!({
        "dam": 1,
        "holds": all.iter().all(VerifiedScene::holds),
        "scenes": all.iter().map(scene).collect::<Vec<_>>(),
    })
}

/// The same as JUnit has it: a suite a scene, a case a requirement. What does not hold is a
/// failure, what could not be judged an error.
pub fn junit(suites: &[Suite]) -> String {
    let sum = |at: usize| suites.iter().map(|(_, counts)| counts[at]).sum::<usize>();
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"dam\" tests=\"{}\" \
         failures=\"{}\" errors=\"{}\">\n",
        sum(0),
        sum(1),
        sum(2)
    );
    for (suite, _) in suites {
        text.push_str(suite);
    }
    text + "</testsuites>\n"
}

/// The text of a suite, with the numbers of its cases, failures and errors.
pub type Suite = (String, [usize; 3]);

/// With the minus sign that tables have.
fn ascii_minus(text: &str) -> String {
    text.replace('\u{2212}', "-")
}

/// The suite of a scene, in the units that are chosen at present.
pub fn suite(one: &VerifiedScene) -> Suite {
    let file = escape(&one.file);
    let mut cases = String::new();
    let mut counts = [0; 3];
    let mut case = |name: &str, outcome: Option<(&str, &str)>| {
        counts[0] += 1;
        let name = escape(&ascii_minus(name));
        // Writing to a string cannot fail.
        let _ = match outcome {
            None => writeln!(
                cases,
                "    <testcase classname=\"{file}\" name=\"{name}\"/>"
            ),
            Some((kind, message)) => {
                counts[if kind == "failure" { 1 } else { 2 }] += 1;
                writeln!(
                    cases,
                    "    <testcase classname=\"{file}\" name=\"{name}\">\n      <{kind} \
                     message=\"{}\"/>\n    </testcase>",
                    escape(&ascii_minus(message))
                )
            }
        };
    };
    match &one.requirements {
        Err(why) => case("the scene is valid", Some(("error", why))),
        Ok(all) => {
            for requirement in all {
                let found = failure_of(requirement);
                let outcome = match (&requirement.not_judged, requirement.verdict.holds) {
                    (Some(why), _) => Some(("error", why.as_str())),
                    (None, true) => None,
                    (None, false) => Some(("failure", found.as_str())),
                };
                case(&words_of(requirement), outcome);
            }
        }
    }
    let [tests, failures, errors] = counts;
    let suite = format!(
        "  <testsuite name=\"{}\" tests=\"{tests}\" failures=\"{failures}\" \
         errors=\"{errors}\">\n{cases}  </testsuite>\n",
        escape(&one.scene)
    );
    (suite, counts)
}

#[cfg(test)]
mod tests {
    use super::{VerifiedScene, junit, suite};
    use crate::studies::expectations::Requirement;

    #[test]
    fn junit_counts_failures_and_errors_and_escapes_what_it_says() {
        let scene = |requirements: Result<Vec<Requirement>, String>| VerifiedScene {
            file: "a<b>.json".to_owned(),
            scene: "A \"name\"".to_owned(),
            requirements,
        };
        let scenes = [scene(Ok(Vec::new())), scene(Err("1 < 2 & 3".to_owned()))];
        let text = junit(&scenes.each_ref().map(suite));
        assert!(
            text.contains("tests=\"1\" failures=\"0\" errors=\"1\">"),
            "{text}"
        );
        assert!(
            text.contains("a&lt;b&gt;.json") && text.contains("1 &lt; 2 &amp; 3"),
            "{text}"
        );
        assert_eq!(text.matches("<testsuite ").count(), 2);
        assert_eq!(text.matches('<').count(), text.matches('>').count());
    }
}
