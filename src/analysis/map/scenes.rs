//! The scenes of a map's cells: decoded once for each thread and panel, then
//! changed from cell to cell.

use super::rigid::{Path, RigidMotion};
use super::study::Study;
use crate::diagnostics::Diagnostics;
use crate::model::Model;
use crate::scene::{Scene, Variation};

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
    paths: Paths,
}

/// The rigid motion of the cell before, for as long as the laws are the same.
#[derive(Debug, Default)]
pub(super) struct Paths {
    /// The laws of the scene at hand; `None`: they are those of no other.
    laws: Option<u64>,
    known: Option<(u64, Path)>,
}

impl Paths {
    /// What the rigid mechanism of a cell would do.
    pub(super) fn rigid_motion(&mut self, model: &Model, duration: f64) -> RigidMotion {
        if let Some((laws, path)) = &self.known
            && self.laws == Some(*laws)
        {
            return path.rigid_motion(model);
        }
        let path = Path::new(model, duration);
        let found = path.rigid_motion(model);
        let few = path.size() <= MOST_KEPT;
        self.known = self.laws.filter(|_| few).map(|laws| (laws, path));
        found
    }
}

impl<'s> Scenes<'s> {
    pub(super) fn new(study: &'s Study<'s>) -> Self {
        Self { study, bench: None }
    }

    /// Shows a cell's scene, or what is wrong with it.
    pub(super) fn show<T>(
        &mut self,
        panel: usize,
        cell: usize,
        to: impl FnOnce(Result<(&Scene, &mut Paths), Diagnostics>) -> T,
    ) -> T {
        let settings = self.study.varied(cell);
        let kept = self.bench.take().filter(|(of, _)| *of == panel);
        let (_, bench) = match kept {
            Some(kept) => self.bench.insert(kept),
            None => match self.study.variation(panel, &settings) {
                Ok(varied) => {
                    let paths = Paths::default();
                    self.bench.insert((panel, Bench { varied, paths }))
                }
                Err(diagnostics) => return to(Err(diagnostics)),
            },
        };
        if bench.varied.set(&settings).is_some() {
            bench.paths.laws = Some(bench.varied.laws());
            return to(Ok((bench.varied.scene(), &mut bench.paths)));
        }
        bench.paths.laws = None;
        match self.study.read(panel, cell) {
            Ok(reading) => to(Ok((&reading.scene, &mut bench.paths))),
            Err(diagnostics) => to(Err(diagnostics)),
        }
    }
}
