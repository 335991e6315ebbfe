//! What a user chose for all windows: texts by name, kept in the user's state folder, since what
//! a browser keeps goes with the port.

use super::atomic;
use super::by_file::state_folder;
use serde_json::{Map, Value};
use std::fs;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

/// What may be kept, and how much of it (bytes).
const NAMES: [&str; 4] = ["units", "tour", "layout", "stars"];
const MOST: usize = 2000;

/// The settings; `None`: there is no place for them.
#[derive(Clone, Debug)]
pub(super) struct Settings {
    place: Option<PathBuf>,
    /// One at a time reads and writes.
    turn: Arc<Mutex<()>>,
}

impl Settings {
    /// Those of the user.
    pub(super) fn of_user() -> Self {
        Self::at(state_folder().map(|folder| folder.join("settings.json")))
    }

    /// Those in a file.
    pub(super) fn at(place: Option<PathBuf>) -> Self {
        Self {
            place,
            turn: Arc::default(),
        }
    }

    /// All of them; what cannot be read is none.
    pub(super) fn all_settings(&self) -> Map<String, Value> {
        let bytes = self.place.as_ref().and_then(|place| fs::read(place).ok());
        let read = bytes.and_then(|bytes| serde_json::from_slice::<Map<_, _>>(&bytes).ok());
        let mut all = read.unwrap_or_default();
        all.retain(|name, value| {
            let text = value.as_str();
            NAMES.contains(&name.as_str()) && text.is_some_and(|text| text.len() <= MOST)
        });
        all
    }

    /// Keeps one.
    ///
    /// # Errors
    /// It is none that is kept, or too long; it cannot be written.
    pub(super) fn write_setting(&self, name: &str, value: &str) -> Result<(), String> {
        if !NAMES.contains(&name) || value.len() > MOST {
            return Err("this is no setting that is kept".to_owned());
        }
        let Some((place, folder)) = self
            .place
            .as_ref()
            .and_then(|one| Some((one, one.parent()?)))
        else {
            return Ok(());
        };
        let _turn = self.turn.lock().unwrap_or_else(PoisonError::into_inner);
        let mut all = self.all_settings();
        all.insert(name.to_owned(), Value::from(value));
        atomic::private_folder(folder)
            .and_then(|()| atomic::write(place, Value::Object(all).to_string().as_bytes(), true))
            .map_err(|error| format!("the setting cannot be kept: {}", error.kind()))
    }
}

#[cfg(test)]
mod tests {
    use super::{MOST, Settings};
    use serde_json::json;

    #[test]
    fn settings_are_kept_for_all_windows_and_nothing_else_is() {
        let base = tempfile::tempdir().unwrap();
        let place = base.path().join("dam/settings.json");
        let settings = Settings::at(Some(place.clone()));
        assert!(settings.all_settings().is_empty());
        settings.write_setting("tour", "seen").unwrap();
        settings.write_setting("units", "{\"m\":\"mm\"}").unwrap();
        settings.write_setting("units", "{}").unwrap();
        let other = Settings::at(Some(place.clone()));
        assert_eq!(
            json!(other.all_settings()),
            json!({ "tour": "seen", "units": "{}" })
        );
        assert!(settings.write_setting("../x", "y").is_err());
        assert!(
            settings
                .write_setting("units", &"x".repeat(MOST + 1))
                .is_err()
        );
        std::fs::write(
            &place,
            "{\"units\": 7, \"else\": \"x\", \"tour\": \"seen\"}",
        )
        .unwrap();
        assert_eq!(json!(other.all_settings()), json!({ "tour": "seen" }));
        std::fs::write(&place, "[").unwrap();
        assert!(other.all_settings().is_empty());
        assert_eq!(Settings::at(None).write_setting("tour", "seen"), Ok(()));
    }
}
