//! What is sought from records.

use crate::Error;
use crate::frontend::diagnostics::{Diagnostic, Diagnostics, Sources};
use crate::frontend::scene::{Catalogue, IdentifySpec};

/// Starts if none are named.
pub const USUAL_STARTS: usize = 8;

/// Record of a motion: a table with a header, as tables beside scenes have.
#[derive(Clone, Debug, Default)]
pub struct MeasuredRecord {
    /// Name of the file, for messages.
    pub name: String,
    /// The table as CSV. Its first column is the time.
    pub text: String,
    /// Settings of the scene that hold for this record alone.
    pub settings: Vec<String>,
}

/// What is sought, and from what.
#[derive(Clone, Debug, Default)]
pub struct IdentifyQuestion {
    /// The records. Empty: those of the scene's block `identify`.
    pub records: Vec<MeasuredRecord>,
    /// Columns and the signals that they measure: `x=rocker.delta`. Empty: those of the block.
    pub signals: Vec<String>,
    /// Numbers of the scene with their ranges: `rocker.stiffness=5:20 MN m/rad`, with `:START` for
    /// the value of the first start, and `:log` for equal ratios. Empty: those of the block.
    pub vary: Vec<String>,
    /// Standard deviations of columns: `x=1 µrad`. Empty: those of the block, if the signals are
    /// its own too.
    pub sigmas: Vec<String>,
    /// Number of starts; `None`: that of the block, else [`USUAL_STARTS`].
    pub starts: Option<usize>,
    /// Whether rows after the first separation of a contact are left out; also if the block says so.
    pub until_first_separation: bool,
    /// Number of threads; default: one for every processor core. Results do not depend on it.
    pub threads: Option<usize>,
}

impl MeasuredRecord {
    /// Name and settings of a record as it is written: `test.csv; shaft.motion.speed=300 rpm`.
    pub(crate) fn name_and_settings(text: &str) -> (String, Vec<String>) {
        let mut parts = text.split(';').map(str::trim);
        let name = parts.next().unwrap_or_default().to_owned();
        let settings = parts.filter(|part| !part.is_empty());
        (name, settings.map(str::to_owned).collect())
    }

    /// A record that the block of a scene names, in the folder of the scene.
    fn beside_scene(text: &str, catalogue: &dyn Catalogue) -> Result<Self, Box<Diagnostic>> {
        let (name, settings) = Self::name_and_settings(text);
        let wrong = |what: String| {
            let message = format!("the block `identify` names the record `{name}`: {what}");
            Diagnostic::error("question", message)
        };
        let (_, bytes) = catalogue.table(&name).map_err(|fault| {
            let hints = fault.hints.into_iter();
            Box::new(hints.fold(wrong(fault.message), Diagnostic::hint))
        })?;
        let text = String::from_utf8(bytes)
            .map_err(|_| Box::new(wrong("it is no UTF-8 text".to_owned())))?;
        Ok(Self {
            name,
            text,
            settings,
        })
    }
}

impl IdentifyQuestion {
    /// The question with what it leaves open as the scene has it.
    ///
    /// # Errors
    /// The records of the block that cannot be read.
    pub(super) fn filled(
        &self,
        block: Option<&IdentifySpec>,
        catalogue: &dyn Catalogue,
    ) -> Result<Self, Error> {
        let mut all = self.clone();
        let Some(block) = block else {
            return Ok(all);
        };
        if all.records.is_empty() {
            let mut wrong = Vec::new();
            for text in &block.record {
                match MeasuredRecord::beside_scene(text, catalogue) {
                    Ok(record) => all.records.push(record),
                    Err(fault) => wrong.push(*fault),
                }
            }
            if !wrong.is_empty() {
                return Err(Diagnostics::new(Sources::default(), wrong).into());
            }
        }
        // (Columns of other signals have other errors.)
        if all.signals.is_empty() && all.sigmas.is_empty() {
            all.sigmas.clone_from(&block.sigma);
        }
        for (own, given) in [
            (&mut all.signals, &block.matched),
            (&mut all.vary, &block.vary),
        ] {
            if own.is_empty() {
                own.clone_from(given);
            }
        }
        all.starts = all.starts.or(block.starts.map(|count| count as usize));
        all.until_first_separation |= block.until_first_separation;
        Ok(all)
    }
}
