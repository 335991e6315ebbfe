//! A JSON tree that knows its places.

use super::own::Own;
use crate::frontend::diagnostics::Place;

/// A value with its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Place in the text.
    pub place: Place,
    /// Value at the node.
    pub value: Value,
}

/// A JSON value.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// `null`.
    Null,
    /// `true` or `false`.
    Flag(bool),
    /// A number; infinite when it is too large for a double.
    Number(f64),
    /// A text, escapes resolved.
    Text(String),
    /// A list.
    List(Vec<Node>),
    /// An object; names are unique.
    Object(Vec<Member>),
    /// A value that no text can state, given in code.
    Own(Own),
}

/// A property of an object.
#[derive(Clone, Debug, PartialEq)]
pub struct Member {
    /// Name of the property.
    pub name: String,
    /// Place of the name.
    pub name_place: Place,
    /// Value of the property.
    pub value: Node,
}

impl Node {
    /// Type of the value, in words.
    pub fn type_name(&self) -> &'static str {
        match self.value {
            Value::Null => "null",
            Value::Flag(_) => "true or false",
            Value::Number(_) => "a number",
            Value::Text(_) => "a text",
            Value::List(_) => "a list",
            Value::Object(_) => "an object",
            Value::Own(_) => "a value given in code",
        }
    }

    /// Properties of an object; none of anything else.
    pub fn members(&self) -> &[Member] {
        match &self.value {
            Value::Object(members) => members,
            _ => &[],
        }
    }

    /// A property by its name.
    pub fn member(&self, name: &str) -> Option<&Member> {
        self.members().iter().find(|member| member.name == name)
    }

    /// The value of a property.
    pub fn get(&self, name: &str) -> Option<&Node> {
        self.member(name).map(|member| &member.value)
    }

    /// Text of a string; `None` of anything else.
    pub fn text(&self) -> Option<&str> {
        match &self.value {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }

    /// A tree of plain values, all at one place: for values filled in.
    pub fn filled_in(value: &serde_json::Value, place: &Place) -> Self {
        use serde_json::Value as Json;
        let value = match value {
            Json::Null => Value::Null,
            Json::Bool(flag) => Value::Flag(*flag),
            Json::Number(number) => Value::Number(number.as_f64().unwrap_or(f64::NAN)),
            Json::String(text) => Value::Text(text.clone()),
            Json::Array(items) => Value::List(
                items
                    .iter()
                    .map(|item| Self::filled_in(item, place))
                    .collect(),
            ),
            Json::Object(map) => Value::Object(
                map.iter()
                    .map(|(name, value)| Member {
                        name: name.clone(),
                        name_place: place.clone(),
                        value: Self::filled_in(value, place),
                    })
                    .collect(),
            ),
        };
        Self {
            place: place.clone(),
            value,
        }
    }
}
