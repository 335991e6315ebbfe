//! Why a search by runs has no answer.

use crate::Error;

/// Why a search ended before it had found anything. E: what failures are told as.
pub(super) enum NoResult<E> {
    /// From outside: by a flag, or after a time.
    Interrupted,
    /// Something is wrong.
    Failed(E),
}

impl<E: From<Error>> From<Error> for NoResult<E> {
    fn from(error: Error) -> Self {
        Self::Failed(error.into())
    }
}
