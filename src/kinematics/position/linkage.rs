//! An output of a linkage as a position function of its input coordinate.

use super::assembly_range::OutOfReach;
use crate::kinematics::linkage::{Cause, Linkage, Reach, Workspace};
use crate::math::jet::Jet;
use std::sync::{Arc, Mutex};

/// U(q) of an output of a linkage, for questions asked one by one.
///
/// (A system that runs solves a linkage once for all its outputs; this one
/// solves it for every question, in memory that is kept for the next.)
#[derive(Clone, Debug)]
pub struct LinkageOutput {
    linkage: Arc<Linkage>,
    output: usize,
    idle: Arc<Mutex<Vec<Workspace>>>,
}

impl LinkageOutput {
    /// The output with this index; a linkage has as many as its description.
    pub fn new(linkage: &Arc<Linkage>, output: usize) -> Self {
        Self {
            linkage: Arc::clone(linkage),
            output,
            idle: Arc::default(),
        }
    }

    /// The linkage.
    pub fn linkage(&self) -> &Linkage {
        &self.linkage
    }

    /// Name of the output.
    pub fn name(&self) -> &str {
        &self.linkage.spec().outputs[self.output].name
    }

    /// U and its derivatives at `q`; not numbers where the linkage cannot be
    /// assembled.
    pub fn jet(&self, q: f64) -> Jet {
        // A thread that panicked with the lock left nothing half done: a list
        // of memory is all there is.
        let taken = self.idle.lock().map_or(None, |mut idle| idle.pop());
        let mut workspace = taken.unwrap_or_else(|| self.linkage.workspace());
        let jet = match self.linkage.solve(q, 3, &mut workspace) {
            Ok(()) => self.linkage.output(self.output, &workspace),
            Err(_) => Jet::UNKNOWN,
        };
        if let Ok(mut idle) = self.idle.lock() {
            idle.push(workspace);
        }
        jet
    }

    /// The open interval of q around `q` in which it exists; `None`: everywhere.
    pub(super) fn reach_from(&self, q: f64) -> Result<Option<(f64, f64)>, OutOfReach> {
        match reach(&self.linkage) {
            Some(interval) if !(interval.0 < q && q < interval.1) => Err(OutOfReach {
                intervals: vec![interval],
            }),
            reach => Ok(reach),
        }
    }

    /// The input after which the output repeats, and its advance in it.
    pub fn period(&self) -> Option<(f64, f64)> {
        let period = self.linkage.range().period.as_ref()?.length;
        let start = self.linkage.spec().start;
        let advance = self.jet(start + period).value - self.jet(start).value;
        advance.is_finite().then_some((period, advance))
    }
}

/// The open interval of the input coordinate in which a linkage can be
/// assembled; `None`: everywhere. The ends of a travel belong to it: a cylinder
/// may start where it is fully retracted.
pub(crate) fn reach(linkage: &Linkage) -> Option<(f64, f64)> {
    let Reach::Interval { lower, upper } = linkage.range().reach else {
        return None;
    };
    let from = match lower.cause {
        Cause::Travel => lower.at.next_down(),
        _ => lower.at,
    };
    let to = match upper.cause {
        Cause::Travel => upper.at.next_up(),
        _ => upper.at,
    };
    Some((from, to))
}
