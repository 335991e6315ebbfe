//! Several maps in one study: `--panels`.

use crate::studies::list::ValueList;
use serde::Serialize;

/// Most panels of a study.
pub const MOST_PANELS: usize = 64;

const FORM: &str = "write PATH=A,B,C, or lists of the same length that go together, separated \
                    by semicolons: shaft.motion.speed=1 rev/s,10 rev/s; run.duration=5,0.5";

/// Panel: a map of a study.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Panel {
    /// Label of what it differs in: `shaft.motion.speed = 1 rev/s, run.duration = 5`;
    /// empty for a single map.
    pub label: String,
    /// Settings `PATH=VALUE` of this map.
    pub settings: Vec<String>,
}

/// The panels that a study is made of, and how many stand in a row.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Panels {
    /// At least one.
    pub panels: Vec<Panel>,
    /// Panels in a row of the picture.
    pub columns: usize,
}

impl Default for Panels {
    fn default() -> Self {
        Self {
            panels: vec![Panel::default()],
            columns: 1,
        }
    }
}

impl Panels {
    /// Reads the occurrences of `--panels`. Within one, lists go together
    /// value by value; several occurrences multiply, the last varying fastest.
    ///
    /// # Errors
    /// What is wrong and what would be right, in one sentence.
    pub fn parse(texts: &[String]) -> Result<Self, String> {
        let mut all = Self::default();
        for text in texts {
            let own = parse_one(text).map_err(|what| format!("`{text}`: {what}; {FORM}"))?;
            if all.panels.len() * own.len() > MOST_PANELS {
                return Err(format!("more than {MOST_PANELS} panels are wanted"));
            }
            let paths = |panel: &Panel| -> Vec<String> {
                let settings = panel.settings.iter();
                let path = |setting: &String| setting.split('=').next().map(str::to_owned);
                settings.filter_map(path).collect()
            };
            let before = paths(&all.panels[0]);
            if let Some(twice) = paths(&own[0]).iter().find(|path| before.contains(path)) {
                return Err(format!("`{text}`: `{twice}` is varied twice; {FORM}"));
            }
            all.columns = own.len();
            let outer = std::mem::take(&mut all.panels);
            all.panels = outer
                .iter()
                .flat_map(|outer| own.iter().map(move |inner| join_panels(outer, inner)))
                .collect();
        }
        Ok(all)
    }
}

fn join_panels(outer: &Panel, inner: &Panel) -> Panel {
    let labels = [outer.label.as_str(), inner.label.as_str()];
    let labels: Vec<&str> = labels
        .into_iter()
        .filter(|label| !label.is_empty())
        .collect();
    Panel {
        label: labels.join(", "),
        settings: [outer.settings.clone(), inner.settings.clone()].concat(),
    }
}

fn parse_one(text: &str) -> Result<Vec<Panel>, String> {
    let mut panels: Vec<Panel> = Vec::new();
    for (index, list) in text.split(';').enumerate() {
        let list = ValueList::parse(list)?;
        let (path, values) = (list.path.as_str(), &list.values);
        let twice = |panel: &Panel| {
            panel
                .settings
                .iter()
                .any(|s| s.split('=').next() == Some(path))
        };
        if panels.first().is_some_and(twice) {
            return Err(format!("`{path}` is varied twice"));
        }
        if index == 0 {
            panels = vec![Panel::default(); values.len()];
        }
        if values.len() != panels.len() {
            let (found, wanted) = (values.len(), panels.len());
            return Err(format!(
                "{path} has {found} values, the first list has {wanted}"
            ));
        }
        for (panel, value) in panels.iter_mut().zip(values) {
            panel.settings.push(format!("{path}={value}"));
            if !panel.label.is_empty() {
                panel.label.push_str(", ");
            }
            panel.label.push_str(&format!("{path} = {value}"));
        }
    }
    Ok(panels)
}

#[cfg(test)]
mod tests {
    use super::Panels;

    fn parse(texts: &[&str]) -> Result<Panels, String> {
        let texts: Vec<String> = texts.iter().map(|text| (*text).to_owned()).collect();
        Panels::parse(&texts)
    }

    #[test]
    fn lists_go_together_and_occurrences_multiply() {
        let found = parse(&[
            "a.load=-600,-6000",
            "d.speed=1 rev/s, 5 rev/s; run.duration=5,1",
        ])
        .unwrap();
        assert_eq!((found.panels.len(), found.columns), (4, 2));
        assert_eq!(
            found.panels[1].settings,
            ["a.load=-600", "d.speed=5 rev/s", "run.duration=1"]
        );
        assert_eq!(
            found.panels[2].label,
            "a.load = -6000, d.speed = 1 rev/s, run.duration = 5"
        );
        let single = parse(&[]).unwrap();
        assert_eq!(single.panels.len(), 1);
        assert!(single.panels[0].settings.is_empty());
    }

    #[test]
    fn a_unit_after_the_last_value_is_that_of_all() {
        let found = parse(&["a.preload=100,250 N; d.speed=1,5 rev/s"]).unwrap();
        assert_eq!(
            found.panels[0].settings,
            ["a.preload=100 N", "d.speed=1 rev/s"]
        );
        assert_eq!(
            found.panels[1].label,
            "a.preload = 250 N, d.speed = 5 rev/s"
        );
    }

    #[test]
    fn what_is_wrong_is_said() {
        for (text, word) in [
            ("a.b", "no `=`"),
            ("=1,2", "missing"),
            ("a.b=1 N,2", "`2` has no unit"),
            ("a.b=1,,2", "missing"),
            ("a.b=1,2; c.d=1", "1 values"),
            ("a.b=1,2; a.b=3,4", "`a.b` is varied twice"),
            (&format!("a.b={}", vec!["1"; 65].join(",")), "more than 64"),
        ] {
            assert!(parse(&[text]).unwrap_err().contains(word), "{text}");
        }
        let twice = parse(&["a.b=1,2", "c.d=1,2; a.b=3,4"]).unwrap_err();
        assert!(twice.contains("`a.b` is varied twice"), "{twice}");
    }
}
