//! What the scene as given and the reduced one cost, measured: both are run several times.

use super::removal::Removal;
use super::variant::scene_without;
use crate::budget::Instant;
use crate::frontend::scene::{Document, Levels};
use crate::studies::order::trial::Trials;
use crate::studies::{Control, RunSettings};
use serde::Serialize;
use std::time::Duration;

/// Runs of each scene, at least and at most.
const REPEATS: [usize; 2] = [3, 25];

/// Measuring ends after this time once there are enough repeats, …
const ENOUGH: Duration = Duration::from_millis(500);

/// … and after this time in any case.
const MOST: Duration = Duration::from_secs(20);

/// A scene is called slower from this ratio of times on: less is noise of the clock.
const SLOWER: f64 = 1.1;

/// Times of runs by the clock, both scenes run in turn.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Cost {
    /// Runs of each.
    pub repeats: usize,
    /// The scene as given.
    pub given: Times,
    /// The reduced scene.
    pub reduced: Times,
}

/// Times of the runs of a scene (s).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Times {
    /// The least.
    pub least: f64,
    /// The median.
    pub median: f64,
}

impl Times {
    fn of(mut times: Vec<f64>) -> Self {
        times.sort_by(f64::total_cmp);
        let at = |place: usize| times.get(place).copied().unwrap_or(f64::NAN);
        Self {
            least: at(0),
            median: at(times.len() / 2),
        }
    }
}

impl Cost {
    /// True when the reduced scene runs slower, by the least times: what else runs on the
    /// machine only adds to the others.
    pub fn is_slower(&self) -> bool {
        self.reduced.least > SLOWER * self.given.least
    }
}

/// Runs a scene as given at its levels, and with what is left out at others, in turn.
/// `None`: one of them cannot be run, or the search was ended.
pub(super) fn measured(
    whole: &Document,
    (settings, control): (&RunSettings, &Control<'_>),
    given: &Levels,
    (removals, reduced): (&[Removal], &Levels),
) -> Option<Cost> {
    let mut scenes = [
        scene_without(whole, &[]).ok()?,
        scene_without(whole, removals).ok()?,
    ];
    let mut times = [Vec::new(), Vec::new()];
    let [first, second] = &mut scenes;
    let mut trials = [first, second].map(|scene| Trials::all_open(scene, settings, control));
    let begun = Instant::now();
    for repeat in 0..REPEATS[1] {
        for ((trials, levels), times) in trials.iter_mut().zip([given, reduced]).zip(&mut times) {
            let trial = trials.run(levels, settings.tolerance).ok()?;
            if control.is_spent() || trial.doubt.is_some() {
                return None;
            }
            times.push(trial.seconds);
        }
        let spent = begun.elapsed();
        if repeat + 1 >= REPEATS[0] && spent > ENOUGH || spent > MOST {
            break;
        }
    }
    let repeats = times[0].len();
    let [given, reduced] = times.map(Times::of);
    Some(Cost {
        repeats,
        given,
        reduced,
    })
}

#[cfg(test)]
mod tests {
    use super::{Cost, Times};

    #[test]
    fn slower_is_what_is_slower_at_its_best() {
        let cost = |reduced: Vec<f64>| Cost {
            repeats: 3,
            given: Times::of(vec![1.2, 1.0, 1.1]),
            reduced: Times::of(reduced),
        };
        assert_eq!(
            cost(vec![1.0]).given,
            Times {
                least: 1.0,
                median: 1.1
            }
        );
        assert!(cost(vec![1.5, 1.2, 1.3]).is_slower());
        // Noise in some runs.
        assert!(!cost(vec![1.0, 2.0, 2.0]).is_slower());
        assert!(!cost(vec![1.05, 1.16, 1.2]).is_slower());
        assert!(!cost(vec![0.5, 0.5, 0.5]).is_slower());
        assert!(!cost(Vec::new()).is_slower());
    }
}
