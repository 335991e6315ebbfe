//! The least and the greatest result with every dimension in the middle or at a limit of its zone.
//!
//! The search begins where each dimension by itself makes the result least or greatest. As long as
//! the result improves, the one dimension is moved that improves it most. What only several moves
//! at once improve is not found.

use super::answer::FigureTolerance;
use super::stack::{AtLimits, corners};
use super::task::{Evaluate, ToleranceTask};

/// Most moves.
const MOVES: usize = 8;

/// Share of the width by which a move has to improve the result.
const IMPROVEMENT: f64 = 1e-9;

/// Places of a dimension: lower limit, middle, upper limit.
const PLACES: [f64; 3] = [-1.0, 0.0, 1.0];

/// One end of one result.
struct End {
    figure: usize,
    /// 1: the greatest, −1: the least.
    sign: f64,
    /// The place of every dimension.
    places: Vec<f64>,
    value: Option<f64>,
    /// False: no move improves it.
    moves: bool,
    /// Runs about it without a result.
    failed: usize,
}

/// The least and the greatest of a result.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Extremes {
    /// Least and greatest; `None`: no run has one.
    pub(super) ends: [Option<f64>; 2],
    /// Runs that have no result and that it may have lain at.
    pub(super) failed: usize,
}

impl End {
    /// All places that differ in one dimension.
    fn neighbours(&self) -> Vec<Vec<f64>> {
        let of = |at: usize| {
            let others = PLACES
                .into_iter()
                .filter(move |place| *place != self.places[at]);
            others.map(move |place| {
                let mut places = self.places.clone();
                places[at] = place;
                places
            })
        };
        (0..self.places.len()).flat_map(of).collect()
    }

    /// Moves to the best of places with their results.
    fn take_best(&mut self, found: Vec<(Vec<f64>, Option<f64>)>, middle: f64) {
        self.failed += found.iter().filter(|(_, value)| value.is_none()).count();
        let known = found
            .into_iter()
            .filter_map(|(places, value)| Some((places, value?)));
        let best = known.max_by(|a, b| (self.sign * a.1).total_cmp(&(self.sign * b.1)));
        let Some((places, value)) = best else {
            self.moves = false;
            return;
        };
        self.moves = self
            .value
            .is_none_or(|own| self.sign * (value - own) > IMPROVEMENT * (value - middle).abs());
        if self.moves {
            (self.places, self.value) = (places, Some(value));
        }
    }
}

/// The least and the greatest of every result; `None`: ended from outside.
pub(super) fn extremes(
    task: &ToleranceTask,
    figures: &[FigureTolerance],
    evaluate: &Evaluate<'_>,
) -> Option<Vec<Extremes>> {
    let mut ends: Vec<End> = figures
        .iter()
        .enumerate()
        .filter_map(|(number, figure)| Some((number, figure.middle?, figure)))
        .flat_map(|(figure, middle, own)| {
            let limits: Vec<AtLimits> = own.effects.iter().map(|one| one.limits).collect();
            let start = move |(sign, places)| End {
                figure,
                sign,
                places,
                value: None,
                moves: true,
                failed: 0,
            };
            [-1.0, 1.0]
                .into_iter()
                .zip(corners(middle, &limits))
                .map(start)
        })
        .collect();
    for round in 0..=MOVES {
        let wanted = |end: &End| match round {
            0 => vec![end.places.clone()],
            _ => end.neighbours(),
        };
        let active = ends.iter().filter(|end| end.moves);
        let places: Vec<Vec<f64>> = active.flat_map(wanted).collect();
        if places.is_empty() {
            break;
        }
        let rows: Vec<Vec<f64>> = places.iter().map(|places| task.row_at(places)).collect();
        let outcomes = evaluate(&rows)?;
        let mut found = places.into_iter().zip(outcomes);
        for end in ends.iter_mut().filter(|end| end.moves) {
            let count = wanted(end).len();
            let own = found.by_ref().take(count);
            let own = own.map(|(places, one)| (places, one.values[end.figure]));
            let middle = figures[end.figure].middle.unwrap_or(0.0);
            end.take_best(own.collect(), middle);
        }
    }
    let mut all = vec![Extremes::default(); figures.len()];
    for end in &ends {
        let own = &mut all[end.figure];
        own.ends[usize::from(end.sign > 0.0)] = end.value;
        own.failed += end.failed;
    }
    Some(all)
}
