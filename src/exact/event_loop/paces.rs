//! The joints of prescribed motions that are only observed: stretches end there.

use crate::exact::{PolynomialSpan, SpanSource};
use std::sync::Arc;

/// The present spans of all such motions.
pub(super) struct Paces<'a> {
    spans: Vec<(&'a Arc<dyn SpanSource>, Option<PolynomialSpan>)>,
}

impl<'a> Paces<'a> {
    pub(super) fn new(sources: &'a [Arc<dyn SpanSource>]) -> Self {
        Self {
            spans: sources.iter().map(|source| (source, None)).collect(),
        }
    }

    /// The next joint after `time` (s).
    pub(super) fn next_joint(&mut self, time: f64) -> f64 {
        let mut next = f64::INFINITY;
        for (source, span) in &mut self.spans {
            let fresh = || source.span(time);
            let now = span.filter(|span| time < span.end).unwrap_or_else(fresh);
            *span = Some(now);
            next = next.min(now.end);
        }
        next
    }
}
