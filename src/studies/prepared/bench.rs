//! A scene that is changed from point to point: decoded once for each thread.

use super::question::PointQuestion;
use super::rigid::{Path, RigidMotion};
use crate::dynamics::model::Model;
use crate::dynamics::system::MotionRanges;
use crate::exact::KeptLaws;
use crate::frontend::diagnostics::Diagnostics;
use crate::frontend::scene::{TypedScene, Variation};
use std::cell::RefCell;
use std::sync::Arc;

/// Most numbers of a rigid motion that is kept from point to point.
const MOST_KEPT: usize = 1 << 18;

/// The scene of one thread, with what stays the same from point to point. What a point's scene
/// is depends on its values alone and not on the points before.
#[derive(Debug, Default)]
pub(in crate::studies) struct Bench {
    /// `None`: no point has been a scene yet.
    varied: Option<Variation>,
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

    /// Motion that the rigid mechanism of a point would have.
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

impl Bench {
    /// Shows the scene of a point, or what is wrong with it, and what is kept beside it.
    pub(super) fn show<T>(
        &mut self,
        question: &PointQuestion<'_>,
        values: &[f64],
        to: impl FnOnce(Result<(&TypedScene, &mut MotionCache), Diagnostics>) -> T,
    ) -> T {
        let settings = question.settings(values);
        let kept = &mut self.kept;
        let varied = match &mut self.varied {
            Some(varied) => varied,
            none => match question.variation(&settings) {
                Ok(varied) => {
                    *kept = MotionCache::default();
                    none.insert(varied)
                }
                Err(diagnostics) => return to(Err(diagnostics)),
            },
        };
        if varied.set(&settings).is_some() {
            kept.turn_to(Some(varied.laws()));
            return to(Ok((varied.scene(), kept)));
        }
        kept.turn_to(None);
        match question.read(settings) {
            Ok(reading) => to(Ok((&reading.scene, kept))),
            Err(diagnostics) => to(Err(diagnostics)),
        }
    }
}
