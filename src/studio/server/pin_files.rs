//! Pinned runs in the user's state folder, whatever the port of the program that kept them.
//!
//! A text is run anew (`room::pinned`) for the same tab, or for the first window that comes.

use super::by_file::ByFile;
use crate::studio::limits::{BODY, PINS};
use crate::studio::pins::KeptPin;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// What was pinned last in a scene, by one of its windows.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct PinRecord {
    /// The window's tab.
    pub(super) tab: String,
    /// The runs.
    pub(super) pins: Vec<KeptPin>,
    /// A window has them again, so that the next one begins without.
    #[serde(skip)]
    given: bool,
}

impl PinRecord {
    /// What a window has.
    pub(super) fn of_window(tab: &str, pins: Vec<KeptPin>) -> Self {
        Self {
            tab: tab.to_owned(),
            pins,
            given: true,
        }
    }

    /// What a window that comes sees of it: its tab, or whoever comes first, has it again.
    pub(super) fn claim(&mut self, tab: &str) -> Option<&[KeptPin]> {
        let own = !tab.is_empty() && tab == self.tab;
        if self.pins.is_empty() || (self.given && !own) {
            return None;
        }
        self.given = true;
        Some(&self.pins)
    }
}

/// The folder in which they are kept.
#[derive(Clone, Debug)]
pub(super) struct Pins(ByFile);

impl Pins {
    /// Those of the user.
    pub(super) fn of_user() -> Self {
        Self(ByFile::of_user("pins"))
    }

    /// Those in a folder.
    #[cfg(test)]
    pub(super) fn in_folder(folder: &Path) -> Self {
        Self(ByFile::in_folder(folder))
    }

    /// Those of a file, no more of them than may be.
    pub(super) fn find(&self, path: &Path) -> PinRecord {
        let mut kept: PinRecord = self.0.find(path).unwrap_or_default();
        kept.pins.retain(|pin| pin.source.text.len() <= BODY);
        kept.pins.truncate(PINS);
        kept
    }

    /// Keeps those of a file in place of the ones before.
    ///
    /// # Errors
    /// They cannot be written.
    pub(super) fn write_pins(&self, path: &Path, kept: &PinRecord) -> Result<(), String> {
        if kept.pins.is_empty() {
            self.0.forget_record(path);
            return Ok(());
        }
        self.0.write_record(path, kept)
    }
}

#[cfg(test)]
mod tests {
    use super::{PinRecord, Pins};
    use crate::studio::pins::{KeptPin, Source};
    use std::path::Path;

    fn pin(name: &str, text: &str) -> KeptPin {
        let source = Source {
            text: text.to_owned(),
            hash: "1".to_owned(),
            judged: true,
        };
        let name = name.to_owned();
        KeptPin { name, source }
    }

    #[test]
    fn pins_are_kept_by_scene_and_given_to_their_tab_or_the_first_that_comes() {
        let folder = tempfile::tempdir().unwrap();
        let pins = Pins::in_folder(&folder.path().join("pins"));
        let (one, other) = (Path::new("/a/one.json"), Path::new("/a/other.json"));
        assert_eq!(pins.find(one), PinRecord::default());
        let all = vec![pin("first", "{}"), pin("second", "[]")];
        pins.write_pins(one, &PinRecord::of_window("tab", all.clone()))
            .unwrap();
        assert_eq!(pins.find(other).pins, []);
        let mut found = pins.find(one);
        assert_eq!(found.claim("new").unwrap(), all);
        assert_eq!(found.claim("newer"), None);
        assert_eq!(found.claim(""), None);
        assert_eq!(found.claim("tab").unwrap(), all);
        pins.write_pins(one, &PinRecord::of_window("tab", Vec::new()))
            .unwrap();
        assert_eq!(pins.find(one), PinRecord::default());
        assert_eq!(
            std::fs::read_dir(folder.path().join("pins"))
                .unwrap()
                .count(),
            0
        );
    }

    #[test]
    fn of_a_strange_file_no_more_is_taken_than_may_be_pinned() {
        let folder = tempfile::tempdir().unwrap();
        let pins = Pins::in_folder(folder.path());
        let path = Path::new("/a/one.json");
        let large = " ".repeat((1 << 20) + 1);
        let mut many = vec![pin("large", &large)];
        many.extend((0..5).map(|k| pin(&k.to_string(), "{}")));
        pins.write_pins(path, &PinRecord::of_window("", many))
            .unwrap();
        let names: Vec<_> = pins
            .find(path)
            .pins
            .into_iter()
            .map(|pin| pin.name)
            .collect();
        assert_eq!(names, ["0", "1", "2"]);
    }
}
