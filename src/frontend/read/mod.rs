//! Reading: text → tree → typed values, with every fault collected on the way.
//!
//! [`parse()`] turns strict JSON into a [`Node`] tree that knows its places.
//! A [`Slot`] is the place of one value; its methods read the value, note
//! faults with the [`Reader`] and go on. The same reading code, run by
//! [`Reader::describing`] without a tree, writes the JSON Schema instead: what
//! is accepted and what is described cannot drift apart. Read values leave
//! behind their canonical form (SI numbers, defaults filled in).
//!
//! The rule for reading code: ask for every property unconditionally first,
//! decide afterwards.

mod bounds;
mod compound;
mod csv;
mod dimension;
mod dimensions;
mod fields;
mod formulas;
mod given;
mod number;
mod one_of;
mod own;
mod parameter;
mod parameters;
mod parse;
mod points;
mod slot;
mod suggest;
mod synonym;
mod text;
mod tree;
mod wanted;

pub use bounds::Bounds;
pub use csv::{Files, MOST_BYTES, TableFile, TimeTable, file_names, no_folder, put_in};
pub use fields::Fields;
pub(crate) use number::UnitFault;
pub use one_of::OneOf;
pub use own::{OWN, Own};
pub use parameter::Parameters;
pub use parse::{parse, parse_fragment};
pub use points::read_points;
pub use slot::{DeclaredNumber, Reader, Slot};
pub use suggest::{closest, did_you_mean, quoted_list};
pub use synonym::synonyms;
pub use text::{MAX_DEPTH, MAX_SIZE};
pub use tree::{Member, Node, Value};
pub use wanted::QuantityChoice;

/// Names that ids and loads may have, as a regular expression.
pub const NAME_PATTERN: &str = "^[A-Za-z_][A-Za-z0-9_-]*$";

/// Rule for names, in words.
pub const NAME_RULE: &str =
    "names are made of letters, digits, `_` and `-`, and begin with a letter or `_`";

/// True for a name that fits [`NAME_PATTERN`].
pub fn is_name(name: &str) -> bool {
    let mut bytes = name.bytes();
    bytes
        .next()
        .is_some_and(|first| first.is_ascii_alphabetic() || first == b'_')
        && bytes.all(|byte| byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'-')
}
