//! The token that tells the windows of the user from everybody else.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::fmt::Write;

/// 256 random bits, in hexadecimal.
#[derive(Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Token(String);

impl Token {
    /// A new one.
    ///
    /// # Errors
    /// The system gives no random numbers.
    pub(super) fn new() -> Result<Self, String> {
        Ok(Self(random()?))
    }

    /// Whether a text is the token; takes as long wherever they differ.
    pub(super) fn is(&self, text: &str) -> bool {
        let (own, other) = (self.0.as_bytes(), text.as_bytes());
        let differ = own.iter().zip(other).fold(0, |all, (a, b)| all | (a ^ b));
        own.len() == other.len() && differ == 0
    }

    /// One that is known.
    #[cfg(test)]
    pub(super) fn of(text: &str) -> Self {
        Self(text.to_owned())
    }

    /// What tells it from others, and gives nothing of it away.
    pub(super) fn name(&self) -> String {
        hash(format!("name {}", self.0).as_bytes())
    }

    /// What nobody knows who does not have it: of a side, and a number of the other side.
    pub(super) fn proof(&self, side: &str, number: &str) -> Self {
        Self(hash(format!("{side} {} {number}", self.0).as_bytes()))
    }

    /// The token itself.
    pub(super) fn text(&self) -> &str {
        &self.0
    }
}

impl std::fmt::Debug for Token {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Token")
    }
}

/// 256 random bits, in hexadecimal: tokens, nonces, names of files.
///
/// # Errors
/// The system gives no random numbers.
pub(super) fn random() -> Result<String, String> {
    let mut bytes = [0; 32];
    getrandom::fill(&mut bytes)
        .map_err(|error| format!("the system gives no random numbers: {error}"))?;
    let mut text = String::with_capacity(64);
    for byte in bytes {
        // Writing to a string cannot fail.
        let _ = write!(text, "{byte:02x}");
    }
    Ok(text)
}

/// SHA-256, as text.
pub(super) fn hash(bytes: &[u8]) -> String {
    let mut text = String::new();
    for byte in Sha256::digest(bytes) {
        // Writing to a string cannot fail.
        let _ = write!(text, "{byte:02x}");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::Token;

    #[test]
    fn only_the_token_itself_is_taken() {
        let (token, other) = (Token::new().unwrap(), Token::new().unwrap());
        assert_eq!(token.text().len(), 64);
        assert!(token.is(token.text()));
        assert!(!token.is(other.text()));
        assert!(!token.is(&token.text()[..63]));
        assert!(!token.is(""));
        let proof = token.proof("window", "1");
        assert!(proof.is(token.proof("window", "1").text()));
        for wrong in [
            token.proof("window", "2"),
            token.proof("program", "1"),
            other.proof("window", "1"),
        ] {
            assert!(!proof.is(wrong.text()));
        }
    }
}
