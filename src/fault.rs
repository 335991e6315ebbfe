//! What is wrong with a model, said in terms of the scene's properties.

/// A fault found after reading, while lowering or starting a model. The front
/// end finds the property's place in the text.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// Address of the property concerned: `rocker.pair.gap`.
    pub path: String,
    /// Message: what is wrong.
    pub message: String,
    /// Hint: what would be right; empty when there is nothing to say.
    pub hint: String,
    /// Code of the kind of fault: `model` unless it is another.
    pub code: &'static str,
    /// Remark under the property in the text; empty: none.
    pub label: String,
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
            code: "model",
            label: String::new(),
        }
    }
}

/// Collects the faults of several numbers before giving up.
#[derive(Debug, Default)]
pub(crate) struct Faults(Vec<Fault>);

impl Faults {
    /// Adds a fault.
    pub(crate) fn add(&mut self, path: impl Into<String>, message: impl Into<String>, hint: &str) {
        self.0.push(Fault::new(path, message, hint));
    }

    /// Number of faults.
    pub(crate) fn len(&self) -> usize {
        self.0.len()
    }

    /// Requires a finite number.
    pub(crate) fn finite(&mut self, path: &str, value: f64) {
        if !value.is_finite() {
            self.add(path, format!("{value} is not a finite number"), "");
        }
    }

    /// Requires a finite number above zero.
    pub(crate) fn positive(&mut self, path: &str, value: f64) {
        if !(value.is_finite() && value > 0.0) {
            let message = format!("{value} is not a positive number");
            self.add(path, message, "give a number above zero");
        }
    }

    /// Requires a finite number, zero or above.
    pub(crate) fn not_negative(&mut self, path: &str, value: f64) {
        if !(value.is_finite() && value >= 0.0) {
            let message = format!("{value} is negative or not a number");
            self.add(path, message, "give zero or a positive number");
        }
    }

    /// Requires a finite number other than zero.
    pub(crate) fn not_zero(&mut self, path: &str, value: f64) {
        if !value.is_finite() || value == 0.0 {
            let message = format!("{value} is zero or not a number");
            self.add(path, message, "give a number other than zero");
        }
    }

    /// Requires at least `least` finite points with strictly ascending arguments.
    pub(crate) fn points(&mut self, path: &str, points: &[(f64, f64)], least: usize) {
        if points.len() < least {
            let message = format!("{} points are too few", points.len());
            self.add(path, message, &format!("give at least {least} points"));
        }
        for (index, &(x, y)) in points.iter().enumerate() {
            self.finite(&format!("{path}[{index}][0]"), x);
            self.finite(&format!("{path}[{index}][1]"), y);
        }
        for (index, pair) in points.windows(2).enumerate() {
            let (before, after) = (pair[0].0, pair[1].0);
            if after <= before {
                let at = format!("{path}[{}]", index + 1);
                let message = format!("{after} does not come after {before}");
                self.add(at, message, "put the points in strictly ascending order");
            }
        }
    }

    /// Gives up with everything found so far.
    pub(crate) fn check(&mut self) -> Result<(), Vec<Fault>> {
        match std::mem::take(&mut self.0) {
            faults if faults.is_empty() => Ok(()),
            faults => Err(faults),
        }
    }

    /// Adds faults found elsewhere, their paths being relative to `prefix`.
    pub(crate) fn absorb(&mut self, prefix: &str, faults: Vec<Fault>) {
        self.0.extend(with_prefix(prefix, faults));
    }
}

/// Faults whose paths are relative to `prefix`, with their whole paths.
pub(crate) fn with_prefix(prefix: &str, mut faults: Vec<Fault>) -> Vec<Fault> {
    for fault in &mut faults {
        fault.path = match fault.path.as_str() {
            "" => prefix.to_owned(),
            entry if prefix.is_empty() => entry.to_owned(),
            entry if entry.starts_with('[') => format!("{prefix}{entry}"),
            path => format!("{prefix}.{path}"),
        };
    }
    faults
}
