//! Massless against full: how far the dynamic transmission ratio is a property
//! of the mechanism alone.
//!
//! The parameter is m·ω²/P: mass of the moving links times the square of the
//! input's speed over the load.

use super::row::Solver;
use super::{Course, ForceSettings, PositionSource};
use crate::fault::{Fault, Faults};
use crate::kinematics::linkage::kinetostatics::Kinetostatics;
use crate::kinematics::linkage::spec::LinkageSpec;
use crate::math::roots::bisect;
use serde::Serialize;

/// Deviation that counts as negligible.
pub const NEGLIGIBLE: f64 = 0.01;
/// Bisections of the limit up to which masses are negligible.
const BISECTIONS: u32 = 40;

/// The comparison of χ without and with masses over one course.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MasslessComparison {
    /// Input coordinates.
    pub coordinates: Vec<f64>,
    /// χ without masses at each.
    #[serde(rename = "chi")]
    pub massless: Vec<Option<f64>>,
    /// Greatest |χ| without masses.
    #[serde(rename = "greatest_chi")]
    pub greatest: f64,
    /// Mass of the moving links (kg).
    pub mass: f64,
    /// Greatest size of the load (N or N·m).
    pub load: f64,
    /// The full model at each parameter.
    pub points: Vec<MasslessPoint>,
    /// Parameter up to which the deviation stays below [`NEGLIGIBLE`], as far
    /// as it was looked for: up to the greatest parameter asked.
    pub negligible_up_to: Option<f64>,
}

/// The full model at one parameter.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MasslessPoint {
    /// m·ω²/P.
    pub parameter: f64,
    /// Speed of the input that makes it so.
    pub speed: f64,
    /// χ with masses at each coordinate.
    pub chi: Vec<Option<f64>>,
    /// Greatest |χ − χ massless| over the greatest |χ massless|, where both exist.
    pub deviation: f64,
    /// Positions at which only one of the two models has a χ: masses decide
    /// there whether friction locks.
    pub missing: usize,
}

impl MasslessPoint {
    /// True when masses change χ by more than [`NEGLIGIBLE`].
    pub fn matters(&self) -> bool {
        self.missing > 0 || !(self.deviation <= NEGLIGIBLE)
    }
}

/// Compares the massless with the full model over an even course, for every
/// parameter m·ω²/P.
///
/// # Errors
///
/// Faults of the linkage; no output with a load; a linkage without masses; a
/// course that is not even; parameters that are not positive.
pub fn compare_massless<S: PositionSource>(
    linkage: &LinkageSpec,
    source: &mut S,
    course: &Course,
    settings: &ForceSettings,
    parameters: &[f64],
) -> Result<MasslessComparison, Vec<Fault>> {
    let Course::Even { speed, .. } = *course else {
        return Err(vec![Fault::new(
            "",
            "the comparison needs positions at one speed",
            "",
        )]);
    };
    let direction = if speed < 0.0 { -1.0 } else { 1.0 };
    let mass: f64 = linkage.links.iter().map(|link| link.mass).sum();
    check(mass, parameters, settings)?;
    let full = Kinetostatics::new(linkage)?;
    let bare = Kinetostatics::new(&without_masses(linkage))?;
    let (massless, load) = {
        let mut solver = Solver::new(&bare, source, settings);
        ratios(&mut solver, course, direction)
    };
    let sizes = massless.iter().flatten().map(|chi| chi.abs());
    let greatest = sizes.fold(0.0, f64::max);
    if !(greatest > 0.0 && load > 0.0) {
        let message = "the output has no load, so that there is no dynamic transmission ratio";
        return Err(vec![Fault::new(
            "outputs",
            message,
            "put a force or couple on the output's link",
        )]);
    }
    let mut solver = Solver::new(&full, source, settings);
    let mut at = |parameter: f64| {
        let speed = direction * (parameter * load / mass).sqrt();
        let (chi, _) = ratios(&mut solver, course, speed);
        let pairs = chi.iter().zip(&massless);
        let differences = pairs.filter_map(|(a, b)| Some(((*a)? - (*b)?).abs()));
        let deviation = differences.fold(0.0, f64::max) / greatest;
        let pairs = chi.iter().zip(&massless);
        let missing = pairs.filter(|(a, b)| a.is_some() != b.is_some()).count();
        MasslessPoint {
            parameter,
            speed,
            deviation,
            missing,
            chi,
        }
    };
    let points: Vec<MasslessPoint> = parameters.iter().map(|value| at(*value)).collect();
    let negligible_up_to =
        parameter_where_masses_matter(&points, |parameter| at(parameter).matters());
    Ok(MasslessComparison {
        coordinates: (0..course.len())
            .map(|index| course.parameter(index))
            .collect(),
        massless,
        greatest,
        mass,
        load,
        points,
        negligible_up_to,
    })
}

fn check(mass: f64, parameters: &[f64], settings: &ForceSettings) -> Result<(), Vec<Fault>> {
    let mut faults = Faults::default();
    if !(mass > 0.0) {
        faults.add(
            "links",
            "no link has a mass: there is nothing to compare",
            "give the links masses",
        );
    }
    for parameter in parameters {
        faults.positive("", *parameter);
    }
    if settings.output.is_none() {
        faults.add(
            "outputs",
            "the comparison needs an output with a load",
            "name one with --load",
        );
    }
    faults.check()
}

/// The linkage without masses and moments of inertia.
fn without_masses(linkage: &LinkageSpec) -> LinkageSpec {
    let mut bare = linkage.clone();
    for link in &mut bare.links {
        link.mass = 0.0;
        link.moment = 0.0;
    }
    bare
}

/// χ at all positions at a speed, and the greatest load.
fn ratios<S: PositionSource>(
    solver: &mut Solver<'_, S>,
    course: &Course,
    speed: f64,
) -> (Vec<Option<f64>>, f64) {
    let mut load = 0.0f64;
    let chi = (0..course.len()).map(|index| {
        let mut instant = course.instant(index);
        instant.motion.speed = speed;
        instant.motion.acceleration = 0.0;
        let forces = solver.row(&instant, false).forces.ok()?;
        let size = forces.transmission.and_then(|found| found.load);
        load = load.max(size.map_or(0.0, f64::abs));
        forces.chi
    });
    let chi = chi.collect();
    (chi, load)
}

/// The parameter from which on masses matter.
fn parameter_where_masses_matter(
    points: &[MasslessPoint],
    mut matters: impl FnMut(f64) -> bool,
) -> Option<f64> {
    let above = points.iter().filter(|point| point.matters());
    let first = above.min_by(|a, b| a.parameter.total_cmp(&b.parameter));
    let Some(first) = first else {
        return points.iter().map(|point| point.parameter).reduce(f64::max);
    };
    let [low, _] = bisect([0.0, first.parameter], BISECTIONS, |parameter| {
        !matters(parameter)
    });
    (low > 0.0).then_some(low)
}
