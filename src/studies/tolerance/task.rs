//! What is asked of a study of tolerances, and the places at which it is run.

use super::sampling::SamplePlan;
use super::slopes::PLACES;
use super::zone::Zone;
use crate::studies::condition::Condition;
use crate::studies::prepared::Verdict;

/// Dimension: numbers of the scene that deviate by the same.
#[derive(Clone, Debug, PartialEq)]
pub struct Dimension {
    /// Addresses of the numbers.
    pub paths: Vec<String>,
    /// Their nominal values (SI).
    pub nominal: Vec<f64>,
    /// SI unit; empty of pure numbers, and where it is not known.
    pub unit: String,
    /// The tolerance as it was written.
    pub tolerance: String,
    /// The tolerance zone (SI).
    pub zone: Zone,
}

impl Dimension {
    /// Its addresses as one text.
    pub fn name(&self) -> String {
        self.paths.join(", ")
    }
}

/// Result of which the tolerance is sought.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Address.
    pub address: String,
    /// SI unit; empty of pure numbers, counts and answers.
    pub unit: String,
    /// True: it counts or answers, and has no derivative.
    pub counts: bool,
    /// Derivatives by all dimensions at the middle of the zones that are known exactly.
    pub exact: Vec<Option<f64>>,
}

/// One run.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// The results in the order of the figures; `None`: there is none.
    pub values: Vec<Option<f64>>,
    /// What became of it.
    pub verdict: Verdict,
    /// Why there is no result; empty if there is.
    pub cause: String,
}

impl Outcome {
    /// Whether the run or one of its results failed.
    pub fn failed(&self) -> bool {
        !self.cause.is_empty()
    }
}

/// Runs at deviations of all dimensions from their nominal values; `None`: ended from outside.
pub type Evaluate<'e> = dyn Fn(&[Vec<f64>]) -> Option<Vec<Outcome>> + 'e;

/// What is asked.
#[derive(Clone, Debug, PartialEq)]
pub struct ToleranceTask {
    /// The dimensions.
    pub dimensions: Vec<Dimension>,
    /// The results.
    pub figures: Vec<Figure>,
    /// The limits of results that all samples are to meet.
    pub limits: Vec<Condition>,
    /// Number of samples; 0: the stack alone.
    pub samples: usize,
    /// Seed of the samples.
    pub seed: u32,
}

impl ToleranceTask {
    pub(super) fn zones(&self) -> Vec<Zone> {
        self.dimensions.iter().map(|one| one.zone).collect()
    }

    /// Points of the sequence: each makes two samples.
    pub(super) fn points(&self) -> usize {
        self.samples.div_ceil(2)
    }

    /// Number of runs of the whole, without those that search the worst case.
    pub fn runs(&self) -> usize {
        let places = self.dimensions.len() * 2 * PLACES.len();
        let plan = SamplePlan::new(self.zones(), self.seed);
        2 + places + self.points() * plan.runs()
    }

    /// A row of deviations at places of all dimensions: −1 the lower limit, 0 the middle, 1 the
    /// upper limit.
    pub(super) fn row_at(&self, places: &[f64]) -> Vec<f64> {
        let each = self.dimensions.iter().zip(places);
        each.map(|(one, place)| match *place {
            // (The limits themselves, to the last digit.)
            1.0 => one.zone.upper,
            -1.0 => one.zone.lower,
            place => one.zone.middle() + place * one.zone.half(),
        })
        .collect()
    }

    /// The places of the stack: the middle, the nominal values, then those of every dimension
    /// above and below the middle.
    pub(super) fn stack_rows(&self) -> Vec<Vec<f64>> {
        let middle = vec![0.0; self.dimensions.len()];
        let nominal = middle.clone();
        let row = |at: usize, place: f64| {
            let mut places = middle.clone();
            places[at] = place;
            self.row_at(&places)
        };
        let sides = || PLACES.into_iter().chain(PLACES.map(|place| -place));
        let all = (0..self.dimensions.len()).flat_map(|at| sides().map(move |place| (at, place)));
        let all = all.map(|(at, place)| row(at, place));
        [self.row_at(&middle), nominal]
            .into_iter()
            .chain(all)
            .collect()
    }
}
