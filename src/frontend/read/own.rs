//! Values that no text can state: functions and objects of the library's user.

use std::any::Any;
use std::fmt;
use std::sync::Arc;

/// Name of the property of an object that holds what no text can state.
pub const OWN: &str = "own";

/// A value given in code, of a type that the reader of the property knows. Equal
/// only to itself and its clones.
#[derive(Clone)]
pub struct Own {
    value: Arc<dyn Any + Send + Sync>,
    words: String,
}

impl Own {
    /// Any value; its `Debug` text stands for it in the canonical form of a scene, so
    /// that two values with other numbers should have other texts.
    pub fn new<T: fmt::Debug + Send + Sync + 'static>(value: T) -> Self {
        let words = format!("{value:?}");
        Self {
            value: Arc::new(value),
            words,
        }
    }

    /// The value, if it is of this type.
    pub fn get<T: 'static>(&self) -> Option<&T> {
        self.value.downcast_ref()
    }

    /// Its `Debug` text.
    pub fn words(&self) -> &str {
        &self.words
    }
}

impl fmt::Debug for Own {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Own({})", self.words)
    }
}

impl PartialEq for Own {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.value, &other.value)
    }
}
