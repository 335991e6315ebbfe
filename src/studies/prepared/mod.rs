//! Figures of a scene at many values of its parameters.
//!
//! What does not depend on the parameters is done once ([`Prepared`]): reading, the levels of
//! elastic objects, addresses of figures. A point then decodes only what varies
//! (`scene::Variation`): plain numbers of chains are set in place, and the rigid motion, the
//! samples of the laws and the exact propagation of the laws are kept as long as the laws are
//! the same ([`bench`]). It is lowered, frozen, run for the figures that are asked for, and
//! judged ([`Verdict`]). A figure is found as a run finds it; where a tree is propagated
//! exactly, what the figures do not need is left out.
//!
//! A point depends on nothing but its values. Results are the same for any number of threads
//! and in any order. A point that cannot be run has no values, but a verdict and its cause.
//!
//! Maps ([`super::map`]) work their cells out by it.

mod bench;
mod ends;
mod figure;
mod judge;
mod levels;
mod point;
mod rigid;
mod table;
mod verdict;

pub(super) use bench::Bench;
pub(super) use figure::{check_figure, unit as figure_unit};
pub(crate) use levels::{finest_levels, shortfall};
pub use point::{MOST_STEPS, Point, PointFigure};
pub use rigid::{RigidMotion, rigid_motion};
pub use verdict::{Family, NEAR_HARMONIC, RESONANCE, STEADY, THROWN_OFF, Verdict};

use super::Control;
use super::axis::Parameter;
use crate::dynamics::audit::{SEED, draw};
use crate::frontend::diagnostics::Diagnostics;
use crate::frontend::scene::{Catalogue, Document, Levels, Overrides, Reading, Variation};
use std::fmt;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Of so many points the equations of motion of one are checked.
const ONE_OF: u64 = 16;

/// A scene made ready for many values of its parameters.
pub struct Prepared<'a> {
    /// The scene without what points do not need.
    document: Arc<Document>,
    catalogue: Arc<dyn Catalogue + Send + Sync + 'a>,
    /// Settings made before those of the parameters.
    fixed: Vec<String>,
    /// The parameters.
    pub parameters: Vec<Parameter>,
    /// Addresses of the figures.
    pub figures: Vec<String>,
    /// True: every point is run a second time with its loads changed by one part in 10¹⁰, to
    /// see whether its figures are determined.
    pub check_determined: bool,
    /// Digits to which a figure is to be known, so as to count as determined.
    pub digits: u8,
    /// What threads worked with before, for those that come after them.
    benches: Mutex<Vec<Bench>>,
}

impl<'a> Prepared<'a> {
    /// A scene whose parameters and figures are known to exist. `document` is without
    /// expectations, and has the levels of the objects that leave theirs open.
    pub(crate) fn of(
        document: Arc<Document>,
        catalogue: Arc<dyn Catalogue + Send + Sync + 'a>,
        fixed: Vec<String>,
        (parameters, figures): (Vec<Parameter>, Vec<String>),
    ) -> Self {
        Self {
            document,
            catalogue,
            fixed,
            parameters,
            figures,
            check_determined: false,
            digits: 3,
            benches: Mutex::default(),
        }
    }

    /// Levels chosen for objects that leave theirs open; the same for all points.
    pub fn levels(&self) -> &Levels {
        self.document.levels()
    }

    /// The point at some values of the parameters, one for each, all finite; `None`: ended from
    /// outside. The equations of motion of one of 16 points are checked, chosen by its values.
    pub fn point(&self, values: &[f64], control: &Control<'_>) -> Option<Point> {
        let mut bench = HeldBench::new(self);
        self.point_with(&mut bench.bench, values, is_sample(values), control)
    }

    /// The same by what a thread keeps from point to point. `checked`: the equations of motion
    /// are checked.
    pub(super) fn point_with(
        &self,
        bench: &mut Bench,
        values: &[f64],
        checked: bool,
        control: &Control<'_>,
    ) -> Option<Point> {
        point::evaluate(self, bench, (values, checked), control)
    }

    /// Whether the scene takes these values of its parameters at all.
    ///
    /// # Errors
    /// Everything that is wrong with the scene at these values.
    pub(crate) fn check(&self, values: &[f64]) -> Result<(), Diagnostics> {
        self.variation(&self.settings(values)).map(drop)
    }

    /// How far a figure may move, as a share of its scale, and still be known to
    /// the digits asked for.
    fn precision(&self) -> f64 {
        10f64.powi(-i32::from(self.digits))
    }

    /// The settings of a point.
    fn settings(&self, values: &[f64]) -> Vec<String> {
        let each = self.parameters.iter().zip(values);
        each.map(|(parameter, &value)| parameter.setting(value))
            .collect()
    }

    /// The scene with first settings of what varies.
    fn variation(&self, settings: &[String]) -> Result<Variation, Diagnostics> {
        Variation::new(&self.document, &*self.catalogue, &self.fixed, settings)
    }

    /// Decodes the scene of a point as a whole.
    fn read(&self, settings: Vec<String>) -> Result<Reading, Diagnostics> {
        let all = self.fixed.iter().cloned().chain(settings);
        self.document.scene(&*self.catalogue, &Overrides::new(all))
    }

    fn benches(&self) -> MutexGuard<'_, Vec<Bench>> {
        self.benches.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// What a thread works with; others have it afterwards.
struct HeldBench<'p> {
    prepared: &'p Prepared<'p>,
    bench: Bench,
}

impl<'p> HeldBench<'p> {
    fn new(prepared: &'p Prepared<'p>) -> Self {
        let bench = prepared.benches().pop().unwrap_or_default();
        Self { prepared, bench }
    }
}

impl Drop for HeldBench<'_> {
    fn drop(&mut self) {
        // What a panic left behind is not used again.
        if !std::thread::panicking() {
            let bench = std::mem::take(&mut self.bench);
            self.prepared.benches().push(bench);
        }
    }
}

/// True of the points whose equations of motion are checked: one of so many, drawn by the
/// values.
fn is_sample(values: &[f64]) -> bool {
    let mixed = values
        .iter()
        .fold(SEED, |mixed, value| draw(mixed ^ value.to_bits()));
    mixed.is_multiple_of(ONE_OF)
}

/// The same of a cell of a map; the first of all is checked too.
pub(super) fn is_checked_cell(panel: usize, cell: usize) -> bool {
    cell == 0 || draw(SEED ^ ((panel as u64) << 32) ^ cell as u64).is_multiple_of(ONE_OF)
}

impl fmt::Debug for Prepared<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Prepared")
            .field("parameters", &self.parameters)
            .field("figures", &self.figures)
            .field("levels", self.levels())
            .finish_non_exhaustive()
    }
}
