//! Trees made in code: the same values that a text holds, without a place in one.

use super::own::Own;
use super::tree::{Member, Node, Value};
use crate::frontend::diagnostics::Place;
use serde::ser::{Serialize, SerializeMap, Serializer};

impl From<Value> for Node {
    fn from(value: Value) -> Self {
        Self {
            place: Place::default(),
            value,
        }
    }
}

impl From<f64> for Node {
    /// A number in SI units.
    fn from(number: f64) -> Self {
        Value::Number(number).into()
    }
}

/// Whole numbers: counts, or numbers in SI units.
macro_rules! whole_numbers {
    ($($number:ty),*) => {$(
        impl From<$number> for Node {
            fn from(number: $number) -> Self {
                Value::Number(number as f64).into()
            }
        }
    )*};
}

whole_numbers!(i32, i64, u32, u64, usize);

impl From<bool> for Node {
    fn from(flag: bool) -> Self {
        Value::Flag(flag).into()
    }
}

impl From<&str> for Node {
    /// A name, or a number with its unit: `"10 rev/s"`.
    fn from(text: &str) -> Self {
        Value::Text(text.to_owned()).into()
    }
}

impl From<String> for Node {
    fn from(text: String) -> Self {
        Value::Text(text).into()
    }
}

impl<T: Into<Node>> From<Vec<T>> for Node {
    fn from(items: Vec<T>) -> Self {
        Value::List(items.into_iter().map(Into::into).collect()).into()
    }
}

impl<T: Into<Node>, const N: usize> From<[T; N]> for Node {
    fn from(items: [T; N]) -> Self {
        Value::List(items.into_iter().map(Into::into).collect()).into()
    }
}

impl<T: Into<Node> + Clone> From<&[T]> for Node {
    fn from(items: &[T]) -> Self {
        Value::List(items.iter().cloned().map(Into::into).collect()).into()
    }
}

impl<A: Into<Node>, B: Into<Node>> From<(A, B)> for Node {
    /// A list of two values: a point of a table.
    fn from((first, second): (A, B)) -> Self {
        Value::List(vec![first.into(), second.into()]).into()
    }
}

impl From<Own> for Node {
    fn from(own: Own) -> Self {
        Value::Own(own).into()
    }
}

impl Node {
    /// An object without properties.
    pub fn object() -> Self {
        Value::Object(Vec::new()).into()
    }

    /// Sets a property; anything that is no object becomes one with this property
    /// alone.
    pub fn set_property(&mut self, name: &str, value: impl Into<Self>) {
        *self.property(name) = value.into();
    }

    /// As JSON; a number that JSON does not know as its name.
    pub fn json(&self) -> String {
        match &self.value {
            Value::Number(number) if !number.is_finite() => number.to_string(),
            // The names of a tree are texts: it can be written.
            _ => serde_json::to_string(self).unwrap_or_default(),
        }
    }

    /// For people: a text without quotes, anything else as JSON.
    pub fn words(&self) -> String {
        match self.text() {
            Some(text) => text.to_owned(),
            None => self.json(),
        }
    }

    /// A property to be changed, an empty object where there was none.
    pub fn property(&mut self, name: &str) -> &mut Self {
        if !matches!(self.value, Value::Object(_)) {
            self.value = Value::Object(Vec::new());
        }
        let Value::Object(members) = &mut self.value else {
            unreachable!("it has just become an object");
        };
        let at = members.iter().position(|member| member.name == name);
        let at = at.unwrap_or_else(|| {
            members.push(Member {
                name: name.to_owned(),
                name_place: Place::default(),
                value: Self::object(),
            });
            members.len() - 1
        });
        &mut members[at].value
    }
}

/// As JSON; values given in code as their `Debug` texts.
impl Serialize for Node {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match &self.value {
            Value::Null => serializer.serialize_unit(),
            Value::Flag(flag) => serializer.serialize_bool(*flag),
            Value::Number(number) if number.fract() == 0.0 && number.abs() < 1e15 => {
                serializer.serialize_i64(*number as i64)
            }
            Value::Number(number) => serializer.serialize_f64(*number),
            Value::Text(text) => serializer.serialize_str(text),
            Value::Own(own) => serializer.serialize_str(own.words()),
            Value::List(items) => serializer.collect_seq(items),
            Value::Object(members) => {
                let mut map = serializer.serialize_map(Some(members.len()))?;
                for member in members {
                    map.serialize_entry(&member.name, &member.value)?;
                }
                map.end()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Node;

    #[test]
    fn a_tree_made_in_code_is_the_json_that_says_the_same() {
        let mut node = Node::object();
        node.set_property("speed", "10 rev/s");
        node.property("pair").set_property("gap", 1e-4);
        node.set_property("points", vec![(0.0, 1), (0.5, -2)]);
        node.set_property("masses", 2);
        node.set_property("masses", 3);
        let text = serde_json::to_string(&node).unwrap();
        let wanted =
            r#"{"speed":"10 rev/s","pair":{"gap":0.0001},"points":[[0,1],[0.5,-2]],"masses":3}"#;
        assert_eq!(text, wanted);
    }
}
