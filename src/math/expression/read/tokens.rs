//! The next word, number or sign of an expression.

use super::super::Symbol;
use super::{Error, Reader, Wrong};

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Token<'t> {
    Number(&'t str),
    /// A number with a unit.
    Quantity(Symbol),
    Name(&'t str),
    Symbol(&'static str),
    End,
}

/// Symbols, the longer ones first.
const SYMBOLS: [&str; 22] = [
    "**", "<=", ">=", "==", "!=", "&&", "||", "+", "-", "*", "/", "%", "^", "(", ")", ",", "<",
    ">", "!", "?", ":", "·",
];

fn is_letter(letter: char) -> bool {
    // (The dot above a letter is a letter of its own.)
    letter.is_alphabetic() || letter == '_' || letter == '\u{307}'
}

impl<'t> Reader<'t, '_> {
    pub(super) fn next_token(&mut self) -> Result<Token<'t>, Error> {
        let before = self.token;
        self.end = self.place.end;
        let rest = &self.text[self.position..];
        let blank = rest.len()
            - rest
                .trim_start_matches([' ', '\t', '\n', '\r', '\u{c}'])
                .len();
        let start = self.position + blank;
        let rest = &self.text[start..];
        let length = match rest.chars().next() {
            None => {
                self.token = Token::End;
                0
            }
            Some('0'..='9' | '.') => {
                let number = number_length(rest);
                if number == 0 {
                    return Err((Wrong::Character, start..start + 1));
                }
                let quantity = self.symbols.quantity(rest);
                let (length, token) = match quantity {
                    Some((length, symbol)) => (length, Token::Quantity(symbol)),
                    None => (number, Token::Number(&rest[..number])),
                };
                self.token = token;
                length
            }
            Some(letter) if is_letter(letter) => {
                let other = |c: char| !(is_letter(c) || c.is_ascii_digit());
                let plain = rest.find(other).unwrap_or(rest.len());
                let length = self.symbols.long_name_length(rest).unwrap_or(plain);
                self.token = match &rest[..length] {
                    "mod" => Token::Symbol("%"),
                    name => Token::Name(name),
                };
                length
            }
            Some(letter) => {
                let Some(symbol) = SYMBOLS.iter().find(|symbol| rest.starts_with(**symbol)) else {
                    return Err((Wrong::Character, start..start + letter.len_utf8()));
                };
                self.token = Token::Symbol(symbol);
                symbol.len()
            }
        };
        self.place = start..start + length;
        self.position = start + length;
        Ok(before)
    }
}

/// Length of the number that a text begins with; 0 where it is none.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |from: usize| {
        bytes[from..]
            .iter()
            .take_while(|b| b.is_ascii_digit())
            .count()
    };
    let mut length = digits(0);
    let mut count = length;
    if bytes.get(length) == Some(&b'.') {
        length += 1;
        let after = digits(length);
        length += after;
        count += after;
    }
    if count == 0 {
        return 0;
    }
    if matches!(bytes.get(length), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(length + 1), Some(b'+' | b'-')));
        if bytes.get(length + 1 + sign).is_some_and(u8::is_ascii_digit) {
            length += 1 + sign;
            length += digits(length);
        }
    }
    length
}
