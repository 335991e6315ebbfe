//! Windows that come back after the program was started again: tokens of earlier programs that
//! served the same folder on the same port.
//!
//! Neither side sends such a token. Window and program each prove that they have it, on a random
//! number of the other, since another program may have taken the port meanwhile.

use super::atomic;
use super::by_file::state_folder;
use super::token::Token;
use serde::{Deserialize, Serialize};
use std::fs;
use std::path::{Path, PathBuf};

/// Programs of which the tokens are kept.
const MOST: usize = 32;

/// The token of a program, and what it served.
#[derive(Clone, PartialEq, Serialize, Deserialize)]
struct Record {
    port: u16,
    folder: PathBuf,
    token: Token,
}

/// Tokens that windows may come back with.
#[derive(Clone, Debug)]
pub(super) struct Earlier(Vec<Token>);

impl Earlier {
    /// The token of this program alone.
    pub(super) fn own_token_only(own: &Token) -> Self {
        Self(vec![own.clone()])
    }

    /// Those of the user's earlier programs too; the own one is kept for later programs.
    pub(super) fn of_user(own: &Token, port: u16, folder: &Path) -> Self {
        let place = state_folder().map(|state| state.join("windows.json"));
        match place {
            Some(place) => Self::at(&place, own, port, folder),
            None => Self::own_token_only(own),
        }
    }

    /// Those in a file.
    fn at(place: &Path, own: &Token, port: u16, folder: &Path) -> Self {
        let bytes = fs::read(place).unwrap_or_default();
        let mut all: Vec<Record> = serde_json::from_slice(&bytes).unwrap_or_default();
        let fits = |record: &&Record| record.port == port && record.folder == folder;
        let known = all.iter().filter(fits).map(|record| record.token.clone());
        let known = std::iter::once(own.clone()).chain(known).collect();
        all.push(Record {
            port,
            folder: folder.to_owned(),
            token: own.clone(),
        });
        let over = all.len().saturating_sub(MOST);
        let kept = serde_json::to_vec(&all[over..]).unwrap_or_default();
        // Where it cannot be kept, later programs do not know this one's windows.
        let _ = atomic::private_folder(place.parent().unwrap_or(Path::new(".")))
            .and_then(|()| atomic::write(place, &kept, true));
        Self(known)
    }

    /// The token of a name.
    pub(super) fn named(&self, name: &str) -> Option<&Token> {
        self.0.iter().find(|token| token.name() == name)
    }
}

#[cfg(test)]
mod tests {
    use super::{Earlier, MOST};
    use crate::studio::server::token::Token;
    use std::path::Path;

    #[test]
    fn tokens_of_the_same_port_and_folder_are_known_and_few_are_kept() {
        let base = tempfile::tempdir().unwrap();
        let place = base.path().join("dam/windows.json");
        let (one, other) = (Path::new("/a"), Path::new("/b"));
        let tokens: Vec<Token> = (0..MOST + 2).map(|_| Token::new().unwrap()).collect();
        Earlier::at(&place, &tokens[0], 80, one);
        let known = Earlier::at(&place, &tokens[1], 80, one);
        let is_known = |known: &Earlier, k: usize| known.named(&tokens[k].name()).is_some();
        assert!(is_known(&known, 0) && is_known(&known, 1) && !is_known(&known, 2));
        assert!(!is_known(&Earlier::at(&place, &tokens[2], 81, one), 0));
        assert!(!is_known(&Earlier::at(&place, &tokens[3], 80, other), 0));
        for token in &tokens[4..] {
            Earlier::at(&place, token, 82, other);
        }
        let known = Earlier::at(&place, &tokens[2], 80, one);
        assert!(!is_known(&known, 0) && !is_known(&known, 1));
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            let mode = place.metadata().unwrap().permissions().mode();
            assert_eq!(mode & 0o777, 0o600);
        }
    }
}
