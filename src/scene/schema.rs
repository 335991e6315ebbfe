//! The JSON Schema of scenes, written by the code that reads them.

use super::root;
use crate::object::Registry;
use crate::read::Reader;
use serde_json::{Value, json};

/// The schema (draft 2020-12) of a scene whose objects are of the kinds of a registry.
pub fn schema(registry: &Registry) -> Value {
    let mut reader = Reader::describing();
    let (_, mut schema) = reader.read(None, "", |slot| root::read(slot, registry));
    schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    schema["title"] = json!("Scene of dam, version 1");
    schema["description"] = json!(
        "A mechanism of elastic and rigid objects. Numbers are in SI units; texts with a unit are accepted for every quantity."
    );
    schema["$defs"] = Value::Object(reader.definitions());
    schema
}

/// The schema as a file's text.
pub fn schema_text(registry: &Registry) -> String {
    format!("{:#}\n", schema(registry))
}
