//! What is wrong with a model, said in terms of the scene's properties.

/// A fault found after reading, while lowering or starting a model. The front
/// end finds the property's place in the text.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// Address of the property concerned: `rocker.pair.gap`.
    pub path: String,
    /// What is wrong.
    pub message: String,
    /// What would be right; empty when there is nothing to say.
    pub hint: String,
}

impl Fault {
    /// A fault of the property at `path`.
    pub fn new(
        path: impl Into<String>,
        message: impl Into<String>,
        hint: impl Into<String>,
    ) -> Self {
        Self {
            path: path.into(),
            message: message.into(),
            hint: hint.into(),
        }
    }
}
