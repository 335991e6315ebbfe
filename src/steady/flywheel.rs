//! The flywheel for a required coefficient of fluctuation.

use super::law::Question;
use super::motion::{SteadyMotion, steady};
use super::profile::Profile;
use super::refusal::{Field, Refusal};
use super::root::bracketed;
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
    /// What it is called.
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
        let above = profile.extreme(sense, |point| {
            [
                point.rise_signed - slope * point.inertia,
                point.moment - slope * point.inertia_slope,
            ]
        });
        above.value
    };
    (height(1.0) - height(-1.0)) / (fluctuation * mean_speed * mean_speed)
}

/// The flywheel for a coefficient of fluctuation δ = (ω_max − ω_min)/ω_av.
///
/// # Errors
/// δ is not between 0 and 2, or the steady motion is refused for another reason
/// than for stopping.
pub fn size(
    profile: &Profile,
    question: &Question,
    fluctuation: f64,
) -> Result<(Flywheel, SteadyMotion), Refusal> {
    if !(fluctuation > 0.0 && fluctuation < 2.0) {
        let faults = vec![Field {
            field: "fluctuation".to_owned(),
            message: format!("{fluctuation} is not between 0 and 2"),
            hint: "δ = (ω_max − ω_min)/ω_av; machine tools 0.02 … 0.05".to_owned(),
        }];
        return Err(Refusal::Input { faults });
    }
    let own = attempt(profile, question, 0.0)?;
    let without = own.as_ref().map(|motion| motion.figures.fluctuation);
    let inertia = match without {
        Some(found) if found <= fluctuation => 0.0,
        _ => search(profile, question, fluctuation, without)?,
    };
    let motion = match (inertia, own) {
        (0.0, Some(motion)) => motion,
        _ => steady(&profile.with_inertia(inertia)?, question)?,
    };
    let balanced = motion.profile();
    let speed = question.mean_speed;
    let bare = balanced.with_inertia(-inertia)?;
    let energy = by_energy(bare.range(), fluctuation, speed);
    let least = bare.least_inertia().value;
    let mut approximations = Vec::new();
    for (name, words, estimate) in [
        (
            "energy",
            "fluctuation of energy, all other inertia neglected",
            energy,
        ),
        (
            "energy_less_own",
            "fluctuation of energy, less the machine's least own inertia",
            (energy - least).max(0.0),
        ),
        (
            "tangents",
            "Wittenbauer's tangents to the energy-mass curve",
            by_tangents(&bare, fluctuation, speed).max(0.0),
        ),
    ] {
        let with = attempt(profile, question, estimate)?;
        approximations.push(Approximation {
            name,
            words,
            inertia: estimate,
            error: (inertia > 0.0).then(|| estimate / inertia - 1.0),
            fluctuation: with.map(|motion| motion.figures.fluctuation),
        });
    }
    let flywheel = Flywheel {
        fluctuation,
        fluctuation_without: without,
        inertia,
        fluctuation_with: motion.figures.fluctuation,
        approximations,
    };
    Ok((flywheel, motion))
}

/// The motion with inertia added; `None` where the machine would stop.
fn attempt(
    profile: &Profile,
    question: &Question,
    inertia: f64,
) -> Result<Option<SteadyMotion>, Refusal> {
    match steady(&profile.with_inertia(inertia)?, question) {
        Ok(motion) => Ok(Some(motion)),
        Err(Refusal::TooSlow { .. }) => Ok(None),
        Err(refusal) => Err(refusal),
    }
}

/// Doublings of the first estimate at most.
const DOUBLINGS: u32 = 200;

fn search(
    profile: &Profile,
    question: &Question,
    wanted: f64,
    without: Option<f64>,
) -> Result<f64, Refusal> {
    let excess = |inertia: f64| -> Result<f64, Refusal> {
        let found = attempt(profile, question, inertia)?;
        // A machine that stops fluctuates by 2 at least in the limit.
        Ok(found.map_or(2.0, |motion| motion.figures.fluctuation) - wanted)
    };
    let least = profile.least_inertia().value;
    let mut high = by_energy(profile.range(), wanted, question.mean_speed).max(1e-3 * least);
    let (mut low, mut tries) = (0.0, 0);
    while excess(high)? > 0.0 {
        (low, high, tries) = (high, 2.0 * high, tries + 1);
        if tries > DOUBLINGS || !high.is_finite() {
            return Err(Refusal::Fluctuation {
                wanted,
                without: without.unwrap_or(f64::NAN),
                why: "more inertia does not lower it".to_owned(),
            });
        }
    }
    let mut refused = None;
    let found = bracketed(
        |inertia| match excess(inertia) {
            Ok(excess) => excess,
            Err(refusal) => {
                refused = Some(refusal);
                f64::NAN
            }
        },
        [low, high],
        1e-12 * wanted,
    );
    refused.map_or(Ok(found.at), Err)
}
