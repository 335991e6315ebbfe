//! The JSON Schema of scenes, written by the code that reads them.

use super::objects::ObjectTable;
use super::{BuiltIn, Catalogue, Document, root};
use crate::frontend::object::Registry;
use crate::frontend::read::Reader;
use serde_json::{Value, json};

/// The schema (draft 2020-12) of a scene whose objects are of the kinds of a registry.
/// Editors complete units and the names of the catalogue that is built in by it.
pub fn schema(registry: &Registry) -> Value {
    schema_with(ObjectTable::new(registry).offering(None, &BuiltIn))
}

/// Schema of one scene: with its own ids and outputs for `input`, and with the names of a
/// catalogue for `from`. The scene need not be right, only JSON.
pub fn schema_of(document: &Document, catalogue: &dyn Catalogue) -> Value {
    schema_with(document.object_table(catalogue))
}

fn schema_with(known: ObjectTable) -> Value {
    let mut reader = Reader::describing();
    let (_, mut schema) = reader.read(None, "", |slot| root::read(slot, known));
    schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    schema["title"] = json!("Scene of dam, version 1");
    schema["description"] = json!(
        "A mechanism of elastic and rigid objects. Numbers are in SI units; texts with a unit are accepted for every quantity."
    );
    schema["$defs"] = Value::Object(reader.definitions());
    schema
}

/// A schema as a file's text.
pub fn schema_text(schema: &Value) -> String {
    format!("{schema:#}\n")
}
