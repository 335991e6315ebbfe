//! The scenes of a map's cells: decoded once for each thread and panel, then
//! changed from cell to cell.

use super::rigid::{Path, RigidMotion};
use super::study::Study;
use crate::dynamics::model::Model;
use crate::dynamics::system::MotionRanges;
use crate::exact::KeptLaws;
use crate::frontend::diagnostics::Diagnostics;
use crate::frontend::scene::{TypedScene, Variation};
use std::cell::RefCell;
use std::sync::Arc;

/// Most numbers of a rigid motion that is kept from cell to cell.
const MOST_KEPT: usize = 1 << 18;

/// The scenes of one thread. What a cell's scene is depends on the cell alone and
/// not on the cells before.
pub(super) struct Scenes<'s> {
    study: &'s Study<'s>,
    /// The scene at hand, with its panel.
    bench: Option<(usize, Bench)>,
}

/// A scene that is changed from cell to cell, with what stays the same.
struct Bench {
    varied: Variation,
    kept: MotionCache,
}

/// Results that follow from the laws of motion alone, kept for as long as these are the
/// same.
#[derive(Debug, Default)]
pub(super) struct MotionCache {
    /// The laws of the scene at hand; `None`: they are those of no other.
    laws: Option<u64>,
    path: Option<Path>,
    /// Samples of the laws for the scales of a system.
    pub(super) samples: Option<Arc<MotionRanges>>,
    /// The laws as exact propagation has them.
    pub(super) exact: RefCell<KeptLaws>,
}

impl MotionCache {
    /// Turns to a scene with these laws.
    fn turn_to(&mut self, laws: Option<u64>) {
        if laws.is_none() || laws != self.laws {
            *self = Self::default();
        }
        self.laws = laws;
    }

    /// Motion that the rigid mechanism of a cell would have.
    pub(super) fn rigid_motion(&mut self, model: &Model, duration: f64) -> RigidMotion {
        if let Some(path) = &self.path {
            return path.rigid_motion(model);
        }
        let path = Path::new(model, duration);
        let found = path.rigid_motion(model);
        self.path = (path.count_of_numbers() <= MOST_KEPT).then_some(path);
        found
    }
}

impl<'s> Scenes<'s> {
    pub(super) fn new(study: &'s Study<'s>) -> Self {
        Self { study, bench: None }
    }

    /// Shows a cell's scene, or what is wrong with it, and what is kept beside it.
    pub(super) fn show<T>(
        &mut self,
        panel: usize,
        cell: usize,
        to: impl FnOnce(Result<(&TypedScene, &mut MotionCache), Diagnostics>) -> T,
    ) -> T {
        let settings = self.study.varied(cell);
        let before = self.bench.take().filter(|(of, _)| *of == panel);
        let (_, bench) = match before {
            Some(before) => self.bench.insert(before),
            None => match self.study.variation(panel, &settings) {
                Ok(varied) => {
                    let kept = MotionCache::default();
                    self.bench.insert((panel, Bench { varied, kept }))
                }
                Err(diagnostics) => return to(Err(diagnostics)),
            },
        };
        if bench.varied.set(&settings).is_some() {
            bench.kept.turn_to(Some(bench.varied.laws()));
            return to(Ok((bench.varied.scene(), &mut bench.kept)));
        }
        bench.kept.turn_to(None);
        match self.study.read(panel, cell) {
            Ok(reading) => to(Ok((&reading.scene, &mut bench.kept))),
            Err(diagnostics) => to(Err(diagnostics)),
        }
    }
}
