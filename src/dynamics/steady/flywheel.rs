//! The flywheel for a required coefficient of fluctuation.

use super::law::{Question, SteadyFigures};
use super::motion::{SteadyMotion, find_steady_motion};
use super::profile::Profile;
use super::refusal::Refusal;
use super::table::Table;
use super::table_motion::TableMotion;
use crate::math::roots::bracketed;
use serde::Serialize;

/// A flywheel: the moment of inertia to add to the input link.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Flywheel {
    /// δ asked for.
    pub fluctuation: f64,
    /// δ without a flywheel; `None` where the machine has no steady motion
    /// without one.
    pub fluctuation_without: Option<f64>,
    /// The inertia to add (kg·m²), from the steady motion itself; 0 where none
    /// is needed.
    pub inertia: f64,
    /// δ with it, as a check.
    pub fluctuation_with: f64,
    /// The approximations of the textbooks.
    pub approximations: Vec<Approximation>,
}

/// A textbook's estimate of the inertia to add, and how wrong it is here.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Approximation {
    /// Name of the estimate.
    pub name: &'static str,
    /// In words.
    pub words: &'static str,
    /// The inertia to add (kg·m²).
    pub inertia: f64,
    /// Relative to the exact one, − 1; `None` where none is needed.
    pub error: Option<f64>,
    /// δ that it would give; `None` where there is no steady motion with it.
    pub fluctuation: Option<f64>,
}

/// Flywheel by the fluctuation of energy: E/(δ·ω²) (kg·m²), E the greatest less
/// the least energy (J). All other inertia is neglected.
pub fn by_energy(energy: f64, fluctuation: f64, mean_speed: f64) -> f64 {
    energy / (fluctuation * mean_speed * mean_speed)
}

/// Flywheel by Wittenbauer's tangents to the energy-mass curve, at the slopes
/// ω_max²/2 and ω_min²/2, ω = ω_av·(1 ± δ/2): where they meet lies the origin.
/// Exact when the mean is midway between the extremes.
pub fn by_tangents(profile: &Profile, fluctuation: f64, mean_speed: f64) -> f64 {
    let height = |sense: f64| {
        let speed = mean_speed * (1.0 + sense * 0.5 * fluctuation);
        let slope = 0.5 * speed * speed;
        let above = profile.extreme(sense, &|point| {
            [
                point.rise_signed - slope * point.inertia,
                point.moment - slope * point.inertia_slope,
            ]
        });
        above.value
    };
    (height(1.0) - height(-1.0)) / (fluctuation * mean_speed * mean_speed)
}

/// A motion with inertia added to the input link; `None` where the machine would
/// stop.
pub type WithInertia<'a, M> = &'a dyn Fn(f64) -> Result<Option<M>, Refusal>;

/// The fluctuation with inertia added to the input link; `None` where the machine would
/// stop.
pub type Fluctuation<'a> = &'a dyn Fn(f64) -> Result<Option<f64>, Refusal>;

/// A steady motion of a machine, on functions or on samples.
pub trait Motion {
    /// Figures of the motion.
    fn figures(&self) -> &SteadyFigures;

    /// Of the machine with `inertia` (kg·m²) less: greatest less least work (J), least
    /// inertia (kg·m²), and the flywheel by Wittenbauer's tangents for the
    /// fluctuation `fluctuation` (kg·m²).
    ///
    /// # Errors
    /// The inertia left is not above zero.
    fn work_range_without(&self, inertia: f64, fluctuation: f64) -> Result<[f64; 3], Refusal>;
}

impl Motion for SteadyMotion {
    fn figures(&self) -> &SteadyFigures {
        &self.figures
    }

    fn work_range_without(&self, inertia: f64, fluctuation: f64) -> Result<[f64; 3], Refusal> {
        let bare = self.profile().with_inertia(-inertia)?;
        let tangents = by_tangents(&bare, fluctuation, self.figures.mean_speed);
        Ok([bare.range(), bare.least_inertia().value, tangents])
    }
}

impl Motion for TableMotion {
    fn figures(&self) -> &SteadyFigures {
        &self.figures.steady
    }

    fn work_range_without(&self, inertia: f64, fluctuation: f64) -> Result<[f64; 3], Refusal> {
        let bare = self.table().with_inertia(-inertia);
        let tangents = bare.by_tangents(fluctuation, self.figures.steady.mean_speed);
        Ok([bare.range(), bare.least_inertia(), tangents])
    }
}

/// The same on samples.
///
/// # Errors
/// As [`size_flywheel`].
pub fn size_of_table(
    table: &Table,
    question: &Question,
    fluctuation: f64,
) -> Result<(Flywheel, TableMotion), Refusal> {
    question.check()?;
    let with = |inertia: f64| match table.with_inertia(inertia).find_steady_motion(question) {
        Ok(motion) => Ok(Some(motion)),
        Err(Refusal::TooSlow { .. }) => Ok(None),
        Err(refusal) => Err(refusal),
    };
    let first = by_energy(table.range(), fluctuation, question.mean_speed);
    size_of(&with, fluctuation, first + table.least_inertia())
}

/// The flywheel for a coefficient of fluctuation δ = (ω_max − ω_min)/ω_av.
///
/// # Errors
/// δ is not between 0 and 2, or the steady motion is refused for another reason
/// than for stopping.
pub fn size_flywheel(
    profile: &Profile,
    question: &Question,
    fluctuation: f64,
) -> Result<(Flywheel, SteadyMotion), Refusal> {
    question.check()?;
    let with = |inertia: f64| match find_steady_motion(&profile.with_inertia(inertia)?, question) {
        Ok(motion) => Ok(Some(motion)),
        Err(Refusal::TooSlow { .. }) => Ok(None),
        Err(refusal) => Err(refusal),
    };
    let first = by_energy(profile.range(), fluctuation, question.mean_speed);
    size_of(&with, fluctuation, first + profile.least_inertia().value)
}

/// How near δ comes to the one asked for, of it.
const NEAR: f64 = 1e-12;

/// The inertia to add (kg·m²) for a coefficient of fluctuation, and the fluctuation
/// without it, of any machine whose fluctuation with a given inertia is known (`None`: it
/// would stop). `first` is a guess of the inertia, > 0; `near` says how near δ comes to the
/// one asked for, of it.
///
/// # Errors
/// As [`size_flywheel`].
pub fn inertia_for(
    delta: Fluctuation<'_>,
    wanted: f64,
    first: f64,
    near: f64,
) -> Result<(f64, Option<f64>), Refusal> {
    if !(wanted > 0.0 && wanted < 2.0) {
        let message = format!("{wanted} is not between 0 and 2");
        let hint = "δ = (ω_max − ω_min)/ω_av; machine tools 0.02 … 0.05";
        return Err(Refusal::field("fluctuation", message, hint));
    }
    let without = delta(0.0)?;
    match without {
        Some(own) if own <= wanted => Ok((0.0, without)),
        _ => Ok((search(delta, wanted, first, without, near)?, without)),
    }
}

/// The same for any machine whose motion with a given inertia is known; `first`
/// is a guess of the inertia (kg·m²), > 0.
///
/// # Errors
/// As [`size_flywheel`].
pub fn size_of<M: Motion>(
    with: WithInertia<'_, M>,
    fluctuation: f64,
    first: f64,
) -> Result<(Flywheel, M), Refusal> {
    let delta = |inertia: f64| Ok(with(inertia)?.map(|motion| motion.figures().fluctuation));
    let (inertia, without) = inertia_for(&delta, fluctuation, first, NEAR)?;
    let motion = with(inertia)?.ok_or_else(|| unreachable_fluctuation(fluctuation, without))?;
    let flywheel = Flywheel {
        fluctuation,
        fluctuation_without: without,
        inertia,
        fluctuation_with: motion.figures().fluctuation,
        approximations: approximations(with, &motion, fluctuation, inertia)?,
    };
    Ok((flywheel, motion))
}

/// The textbooks' estimates, from the forces of the motion with the flywheel.
fn approximations<M: Motion>(
    with: WithInertia<'_, M>,
    motion: &M,
    fluctuation: f64,
    inertia: f64,
) -> Result<Vec<Approximation>, Refusal> {
    let speed = motion.figures().mean_speed;
    let [range, least, tangents] = motion.work_range_without(inertia, fluctuation)?;
    let energy = by_energy(range, fluctuation, speed);
    let estimates = [
        ("energy", "fluctuation of energy, no other inertia", energy),
        (
            "energy_less_own",
            "fluctuation of energy, less own inertia",
            (energy - least).max(0.0),
        ),
        ("tangents", "Wittenbauer's tangents", tangents.max(0.0)),
    ];
    let judge = |(name, words, estimate): (&'static str, &'static str, f64)| {
        Ok(Approximation {
            name,
            words,
            inertia: estimate,
            error: (inertia > 0.0).then(|| estimate / inertia - 1.0),
            fluctuation: with(estimate)?.map(|motion| motion.figures().fluctuation),
        })
    };
    estimates.into_iter().map(judge).collect()
}

/// Doublings of the first estimate at most.
const DOUBLINGS: u32 = 200;

fn unreachable_fluctuation(wanted: f64, without: Option<f64>) -> Refusal {
    Refusal::Fluctuation {
        wanted,
        without,
        why: "more inertia does not lower it".to_owned(),
    }
}

fn search(
    delta: Fluctuation<'_>,
    wanted: f64,
    first: f64,
    without: Option<f64>,
    near: f64,
) -> Result<f64, Refusal> {
    let excess = |inertia: f64| -> Result<f64, Refusal> {
        // A machine that stops fluctuates by 2 at least in the limit.
        Ok(delta(inertia)?.unwrap_or(2.0) - wanted)
    };
    let (mut low, mut high, mut tries) = (0.0, first, 0);
    while excess(high)? > 0.0 {
        (low, high, tries) = (high, 2.0 * high, tries + 1);
        if tries > DOUBLINGS || !high.is_finite() {
            return Err(unreachable_fluctuation(wanted, without));
        }
    }
    let mut refused = None;
    let found = bracketed(
        &mut |inertia| match excess(inertia) {
            Ok(excess) => excess,
            Err(refusal) => {
                refused = Some(refusal);
                f64::NAN
            }
        },
        [low, high],
        near * wanted,
    );
    refused.map_or(Ok(found.at), Err)
}
