//! The scenes of a map's cells: decoded once for each thread and panel, then
//! changed from cell to cell.

use super::study::Study;
use crate::diagnostics::Diagnostics;
use crate::scene::{Scene, Variation};
use std::sync::{Mutex, PoisonError};

/// Scenes that threads take in turn. What a cell's scene is depends on the
/// cell alone and not on who had it before.
pub(super) struct Scenes<'s> {
    study: &'s Study<'s>,
    /// Those that nobody has at hand, with their panels.
    idle: Mutex<Vec<(usize, Variation)>>,
}

impl<'s> Scenes<'s> {
    pub(super) fn new(study: &'s Study<'s>) -> Self {
        Self {
            study,
            idle: Mutex::new(Vec::new()),
        }
    }

    /// Shows a cell's scene, or what is wrong with it.
    pub(super) fn show<T>(
        &self,
        panel: usize,
        cell: usize,
        to: impl FnOnce(Result<&Scene, Diagnostics>) -> T,
    ) -> T {
        let settings = self.study.varied(cell);
        let mut varied = match self.take(panel) {
            Some(varied) => varied,
            None => match self.study.variation(panel, &settings) {
                Ok(varied) => varied,
                Err(diagnostics) => return to(Err(diagnostics)),
            },
        };
        let shown = match varied.set(&settings) {
            Some(scene) => to(Ok(scene)),
            None => match self.study.read(panel, cell) {
                Ok(reading) => to(Ok(&reading.scene)),
                Err(diagnostics) => to(Err(diagnostics)),
            },
        };
        self.idle().push((panel, varied));
        shown
    }

    fn take(&self, panel: usize) -> Option<Variation> {
        let mut idle = self.idle();
        let own = idle.iter().rposition(|(of, _)| *of == panel)?;
        Some(idle.swap_remove(own).1)
    }

    fn idle(&self) -> std::sync::MutexGuard<'_, Vec<(usize, Variation)>> {
        self.idle.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
