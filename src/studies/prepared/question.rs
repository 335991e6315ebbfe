//! What is asked at every point of a prepared scene.

use crate::frontend::diagnostics::Diagnostics;
use crate::frontend::scene::{Catalogue, Document, Levels, Overrides, Reading, Variation};
use crate::studies::axis::Parameter;
use std::fmt;
use std::sync::Arc;

/// Question that is asked at every point: the scene, its parameters, the figures.
pub struct PointQuestion<'a> {
    /// The scene without what points do not need, with the levels of the objects that leave
    /// theirs open.
    pub(crate) document: Arc<Document>,
    /// Where its objects are copied from.
    pub(crate) catalogue: Arc<dyn Catalogue + Send + Sync + 'a>,
    /// Settings made before those of the parameters.
    pub(crate) fixed: Vec<String>,
    /// The parameters.
    pub parameters: Vec<Parameter>,
    /// Addresses of the figures.
    pub figures: Vec<String>,
    /// Digits to which a figure is to be known, so as to count as determined: every point is
    /// then run a second time with its loads changed by one part in 10¹⁰. `None`: not asked.
    pub digits: Option<u8>,
}

impl PointQuestion<'_> {
    /// Levels chosen for objects that leave theirs open; the same for all points.
    pub fn levels(&self) -> &Levels {
        self.document.levels()
    }

    /// Whether the scene takes these values of its parameters at all.
    ///
    /// # Errors
    /// Everything that is wrong with the scene at these values.
    pub(crate) fn check(&self, values: &[f64]) -> Result<(), Diagnostics> {
        self.variation(&self.settings(values)).map(drop)
    }

    /// The settings of a point.
    pub(super) fn settings(&self, values: &[f64]) -> Vec<String> {
        let each = self.parameters.iter().zip(values);
        each.map(|(parameter, &value)| parameter.setting(value))
            .collect()
    }

    /// The scene with first settings of what varies.
    pub(super) fn variation(&self, settings: &[String]) -> Result<Variation, Diagnostics> {
        Variation::new(&self.document, &*self.catalogue, &self.fixed, settings)
    }

    /// Decodes the scene of a point as a whole.
    pub(in crate::studies) fn read(&self, settings: Vec<String>) -> Result<Reading, Diagnostics> {
        let all = self.fixed.iter().cloned().chain(settings);
        self.document.scene(&*self.catalogue, &Overrides::new(all))
    }
}

impl fmt::Debug for PointQuestion<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("PointQuestion")
            .field("parameters", &self.parameters)
            .field("figures", &self.figures)
            .field("levels", self.levels())
            .field("digits", &self.digits)
            .finish_non_exhaustive()
    }
}
