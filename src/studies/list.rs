//! A list of values of a parameter: `rocker.masses=1,2,10`,
//! `rocker.stiffness=5,10,20 kN/mm`.

use crate::units::{number_and_unit, with_common_unit};
use serde_json::Value;

/// A parameter of a scene and values for it, as they are written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ValueList {
    /// Address of the parameter, as `--set` takes it.
    pub path: String,
    /// Values with their units; at least one.
    pub values: Vec<String>,
}

impl ValueList {
    /// Reads `PATH=A,B,C` or `PATH=[JSON, …]`. A unit after the last number alone
    /// is the unit of all ([`with_common_unit`]).
    ///
    /// # Errors
    /// What is wrong, in a few words.
    pub fn parse(text: &str) -> Result<Self, String> {
        let (path, list) = text.split_once('=').ok_or("no `=`")?;
        let path = path.trim();
        let values: Vec<String> = match serde_json::from_str::<Vec<Value>>(list) {
            Ok(values) => values.iter().map(list_item_text).collect(),
            Err(_) => list.split(',').map(|word| word.trim().to_owned()).collect(),
        };
        if path.is_empty() || values.is_empty() || values.iter().any(String::is_empty) {
            return Err("an address or a value is missing".to_owned());
        }
        Ok(Self {
            path: path.to_owned(),
            values: with_common_unit(&values)?,
        })
    }

    /// The setting `PATH=VALUE` of each value, as [`crate::frontend::scene::Overrides`] takes it.
    pub fn settings(&self) -> impl Iterator<Item = String> + '_ {
        let setting = |value: &String| format!("{}={value}", self.path);
        self.values.iter().map(setting)
    }
}

/// A JSON value as it stands in a list; a text that is a quantity without its quotes.
fn list_item_text(value: &Value) -> String {
    let quantity = |text: &&str| number_and_unit(text).is_some_and(|(_, unit)| !unit.is_empty());
    match value.as_str().filter(quantity) {
        Some(text) => text.to_owned(),
        None => value.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::ValueList;

    fn values(text: &str) -> Vec<String> {
        ValueList::parse(text).unwrap().values
    }

    #[test]
    fn a_list_is_plain_or_json() {
        let found = ValueList::parse("rocker.masses=1, 2,10").unwrap();
        assert_eq!(found.path, "rocker.masses");
        assert_eq!(found.values, ["1", "2", "10"]);
        let json = values("a.pair=[{\"gap\": \"1 mm\"}, 3]");
        assert!(json[0].contains("gap") && json[1] == "3");
        assert_eq!(values("a.law=[\"5\", \"sine\"]"), ["\"5\"", "\"sine\""]);
        for wrong in ["rocker.masses", "=1,2", "a=1,,2", "a=", "a=[]"] {
            assert!(ValueList::parse(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_unit_after_the_last_value_is_that_of_all() {
        let meant = ["5 kN/mm", "10 kN/mm", "20 kN/mm"];
        assert_eq!(values("valve.stiffness=5,10,20 kN/mm"), meant);
        assert_eq!(values("valve.stiffness=[5, 10, \"20 kN/mm\"]"), meant);
        assert!(ValueList::parse("a.b=5 mm,10").is_err());
        let found = ValueList::parse("a.b=1,2 mm").unwrap();
        assert_eq!(
            found.settings().collect::<Vec<_>>(),
            ["a.b=1 mm", "a.b=2 mm"]
        );
    }
}
