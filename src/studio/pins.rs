//! Pinned runs as they are kept: the scene that each was run of, so that it can be worked out
//! again by a later program. It is dropped if the scene would be another, by its hash.

use serde::{Deserialize, Serialize};

/// What a run is worked out again from.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Source {
    /// Text of the scene.
    pub(super) text: String,
    /// The scene's hash: with other objects beside it the same text is another scene.
    pub(super) hash: String,
    /// Its model was judged before.
    pub(super) judged: bool,
}

/// A pinned run as it is kept.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct KeptPin {
    /// Its name.
    pub(super) name: String,
    /// What was run.
    #[serde(flatten)]
    pub(super) source: Source,
}
