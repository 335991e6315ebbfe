//! Strict JSON to a tree with places.

use super::text;
use super::tree::{Member, Node, Value};
use crate::frontend::diagnostics::{Diagnostic, Place, Source, SourceId, Sources};
use jsonc_parser::ast;
use jsonc_parser::common::Ranged;
use jsonc_parser::errors::{ParseError, ParseErrorKind};
use jsonc_parser::{CollectOptions, ParseOptions, parse_to_ast};
use std::collections::BTreeMap;
use std::sync::Arc;

const STRICT: ParseOptions = ParseOptions {
    allow_comments: false,
    allow_loose_object_property_names: false,
    allow_trailing_commas: false,
    allow_missing_commas: false,
    allow_single_quoted_strings: false,
    allow_hexadecimal_numbers: false,
    allow_unary_plus_numbers: false,
    allow_bare_decimal_point_numbers: false,
    allow_non_finite_numbers: false,
    allow_extended_string_escapes: false,
};

/// Reads a file as strict JSON and adds it to the sources.
///
/// # Errors
/// Not UTF-8, too large, too deep, not JSON, duplicate names; all duplicates
/// at once.
pub fn parse(name: &str, bytes: &[u8], sources: &mut Sources) -> Result<Node, Vec<Diagnostic>> {
    // What cannot be decoded is shown with replacement characters.
    let shown = match bytes.len() > text::MAX_SIZE {
        true => String::new(),
        false => String::from_utf8_lossy(text::without_mark(bytes)).into_owned(),
    };
    let id = sources.add(Arc::new(Source {
        name: name.to_owned(),
        text: shown,
    }));
    let decoded = text::decode(bytes, id);
    let at_start = |fault: Diagnostic| match fault.place {
        Some(_) => fault,
        None => fault.at(Place::new(id, 0..0)),
    };
    let at_start = |faults: Vec<Diagnostic>| faults.into_iter().map(at_start).collect();
    let text = decoded.map_err(at_start)?;
    parse_fragment(text, id, 0).map_err(at_start)
}

/// Parses a part of a source that starts `offset` bytes into it.
///
/// # Errors
/// Empty, too deep, not JSON, duplicate names.
pub fn parse_fragment(
    text: &str,
    source: SourceId,
    offset: usize,
) -> Result<Node, Vec<Diagnostic>> {
    text::check(text, source, offset)?;
    let place = |range: jsonc_parser::common::Range| {
        Place::new(source, range.start + offset..range.end + offset)
    };
    let parsed = parse_to_ast(text, &CollectOptions::default(), &STRICT)
        .map_err(|error| vec![syntax_fault(&error, text, place(error.range()))])?;
    let Some(value) = parsed.value else {
        return Err(vec![
            Diagnostic::error("empty", "the text holds no JSON value")
                .at(Place::new(source, offset..offset)),
        ]);
    };
    let mut builder = Builder {
        text,
        source,
        offset,
        faults: Vec::new(),
    };
    let node = builder.node(&value);
    match builder.faults.is_empty() {
        true => Ok(node),
        false => Err(builder.faults),
    }
}

fn syntax_fault(error: &ParseError, text: &str, place: Place) -> Diagnostic {
    use ParseErrorKind as Kind;
    let fault = |message: &str| Diagnostic::error("not-json", message).at(place.clone());
    match error.kind() {
        Kind::CommentsNotAllowed | Kind::UnterminatedCommentBlock => {
            fault("JSON has no comments").hint("use the property `description` for remarks")
        }
        Kind::TrailingCommasNotAllowed => {
            fault("a comma before a closing bracket").hint("remove the comma")
        }
        Kind::SingleQuotedStringsNotAllowed => {
            fault("a text in single quotes").hint("use double quotes: \"…\"")
        }
        Kind::ExpectedStringObjectProperty => fault("a property name without double quotes")
            .hint("write property names in double quotes: \"name\": …"),
        Kind::ExpectedComma if second_digit(text, error.range().start) => {
            fault("a number cannot begin with a 0 before other digits")
        }
        Kind::ExpectedComma => fault("a comma is missing here"),
        Kind::ExpectedColonAfterObjectKey => fault("a colon is missing after the property name"),
        Kind::ExpectedObjectValue => fault("a value is missing after the colon"),
        Kind::MultipleRootJsonValues => {
            fault("something follows after the end").hint("one file holds one JSON value")
        }
        Kind::UnterminatedObject => fault("this object is not closed").hint("a `}` is missing"),
        Kind::UnterminatedArray => fault("this list is not closed").hint("a `]` is missing"),
        Kind::UnexpectedWord | Kind::UnexpectedToken | Kind::UnexpectedTokenInObject => {
            let at = error.range().start.min(text.len());
            fault(&unexpected(text.get(at..).unwrap_or("")))
                .hint("values are numbers, \"texts\", true, false, null, [lists] and {objects}")
        }
        other => {
            let mut message = other.to_string();
            if let Some(first) = message.get_mut(0..1) {
                first.make_ascii_lowercase();
            }
            fault(&format!("not JSON: {message}"))
        }
    }
}

/// True between the digits of `05`, which JSON does not take for a number.
fn second_digit(text: &str, at: usize) -> bool {
    let digit = |at: usize| text.as_bytes().get(at).is_some_and(u8::is_ascii_digit);
    at > 0 && digit(at) && digit(at - 1)
}

fn unexpected(rest: &str) -> String {
    let word: String = rest
        .chars()
        .take_while(|c| c.is_alphanumeric() || *c == '_')
        .take(40)
        .collect();
    match (word.is_empty(), rest.chars().next()) {
        (false, _) => format!("`{word}` is not a JSON value"),
        (true, Some(found)) => format!("`{found}` does not belong here"),
        (true, None) => "the text ends too early".to_owned(),
    }
}

/// Turns the parser's tree into ours. Recursion is bounded by the check on depth.
struct Builder<'a> {
    text: &'a str,
    source: SourceId,
    offset: usize,
    faults: Vec<Diagnostic>,
}

impl Builder<'_> {
    fn place(&self, ranged: &impl Ranged) -> Place {
        let range = ranged.range();
        Place::new(
            self.source,
            range.start + self.offset..range.end + self.offset,
        )
    }

    fn node(&mut self, value: &ast::Value<'_>) -> Node {
        let place = self.place(value);
        let value = match value {
            ast::Value::NullKeyword(_) => Value::Null,
            ast::Value::BooleanLit(literal) => Value::Flag(literal.value),
            ast::Value::NumberLit(literal) => self.number(literal, &place),
            ast::Value::StringLit(literal) => {
                self.check_text(literal, &place);
                Value::Text(literal.value.clone().into_owned())
            }
            ast::Value::Array(array) => {
                Value::List(array.elements.iter().map(|item| self.node(item)).collect())
            }
            ast::Value::Object(object) => Value::Object(self.parse_members(object)),
        };
        Node { place, value }
    }

    fn number(&mut self, literal: &ast::NumberLit<'_>, place: &Place) -> Value {
        let digits = literal.value.trim_start_matches('-');
        let zero_first =
            digits.starts_with('0') && digits[1..].starts_with(|c: char| c.is_ascii_digit());
        match literal.value.parse() {
            Ok(number) if !zero_first => Value::Number(number),
            _ => {
                let message = format!("`{}` is not a JSON number", literal.value);
                self.faults
                    .push(Diagnostic::error("not-json", message).at(place.clone()));
                Value::Null
            }
        }
    }

    fn check_text(&mut self, literal: &ast::StringLit<'_>, place: &Place) {
        let range = literal.range();
        let raw = self.text.get(range.start..range.end).unwrap_or("");
        if let Some(at) = raw.find(|c: char| (c as u32) < 0x20) {
            let fault = Diagnostic::error("not-json", "a text with a raw line break or tab")
                .at(place.within(at..at + 1))
                .hint("is a closing quote missing? Otherwise write \\n or \\t");
            self.faults.push(fault);
        }
    }

    fn parse_members(&mut self, object: &ast::Object<'_>) -> Vec<Member> {
        let mut first: BTreeMap<String, Place> = BTreeMap::new();
        let mut members = Vec::with_capacity(object.properties.len());
        for property in &object.properties {
            let name = property.name.as_str().to_owned();
            let name_place = self.place(&property.name);
            let value = self.node(&property.value);
            if let Some(earlier) = first.get(&name) {
                self.faults.push(
                    Diagnostic::error("duplicate", format!("`{name}` is given twice"))
                        .at(name_place)
                        .label("given again here")
                        .with_place(earlier.clone(), "first given here"),
                );
                continue;
            }
            first.insert(name.clone(), name_place.clone());
            members.push(Member {
                name,
                name_place,
                value,
            });
        }
        members
    }
}
