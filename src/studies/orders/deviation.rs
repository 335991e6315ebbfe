//! The deviation in the exact periodic motion at a speed of the drive.

use super::law::OrderedLaw;
use crate::dynamics::model::{Model, NodeMotion};
use crate::dynamics::system::System;
use crate::exact::{Part, Parts, Request, TreePair};
use crate::kinematics::motion::DriveMotion;
use crate::studies::steady::recurring_state;
use crate::studies::{Control, RunSettings};
use serde::Serialize;

/// Intervals of a turn at whose ends deviations are listed.
const SAMPLES: usize = 720;

/// The deviation over a turn at the speed of the scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Deviation {
    /// Greatest magnitude with its sign (rad or m).
    pub greatest: f64,
    /// Angle of the drive there (rad).
    pub at: f64,
    /// Angle of the drive (rad) and deviation, over one period.
    pub course: Vec<[f64; 2]>,
    /// True where the contact separates.
    pub separates: bool,
    /// Least contact force (N or N m) at these angles; null without a force-closed contact.
    pub least_contact_force: Option<f64>,
}

/// The greatest deviation at a speed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SpeedPoint {
    /// Speed of the drive (rad/s).
    pub speed: f64,
    /// Greatest |δ| (rad or m) of the periodic motion; null where none was found.
    pub greatest: Option<f64>,
    /// True where the contact separates in it.
    pub separates: bool,
    /// Least contact force; null without a force-closed contact.
    pub least_contact_force: Option<f64>,
}

/// What deviations are computed from.
#[derive(Clone, Copy)]
pub(super) struct Periodic<'s> {
    pub(super) model: &'s Model,
    pub(super) settings: &'s RunSettings,
    pub(super) control: &'s Control<'s>,
    pub(super) law: &'s OrderedLaw,
    /// Object of the model whose tree it is, and the object whose δ is wanted.
    pub(super) objects: [usize; 2],
}

impl Periodic<'_> {
    /// The point of a diagram over the speed.
    pub(super) fn point(&self, speed: f64) -> SpeedPoint {
        let found = self.deviation(speed).ok();
        SpeedPoint {
            speed,
            greatest: found.as_ref().map(|own| own.greatest.abs()),
            separates: found.as_ref().is_some_and(|own| own.separates),
            least_contact_force: found.and_then(|own| own.least_contact_force),
        }
    }

    /// The deviation over a period at a speed of the drive.
    ///
    /// # Errors
    /// There is no periodic motion, in a sentence.
    pub(super) fn deviation(&self, speed: f64) -> Result<Deviation, String> {
        let mut model = self.model.clone();
        if let NodeMotion::Prescribed {
            motion: DriveMotion::Constant { speed: own, .. },
            ..
        } = &mut model.nodes[self.law.drive].motion
        {
            *own = speed;
        }
        let said = |faults: Vec<crate::fault::Fault>| {
            faults
                .first()
                .map_or(String::new(), |fault| fault.message.clone())
        };
        let system = System::new(model).map_err(said)?;
        let (state, period) =
            recurring_state(&system, self.settings, self.control).map_err(said)?;
        let parts = Parts::of(&system);
        let [first, object] = self.objects;
        let part = parts
            .trees
            .iter()
            .find(|part| part.objects.first() == Some(&first));
        let part = part.ok_or("its tree cannot be propagated exactly")?;
        self.over_period(part, object, &state, [speed, period])
    }

    fn over_period(
        &self,
        part: &Part,
        object: usize,
        state: &[f64],
        [speed, period]: [f64; 2],
    ) -> Result<Deviation, String> {
        let request = Request {
            all_masses: true,
            figures: true,
            ..Request::new(period, SAMPLES)
        };
        let goes_on = || !self.control.is_spent();
        let tree = part.tree(state);
        let run = tree
            .run_while(&request, &goes_on)
            .map_err(|refusal| refusal.reason)?;
        if !run.complete {
            return Err("its periodic motion could not be followed to its end".to_owned());
        }
        let place = part.objects.iter().position(|&own| own == object);
        let place = place.ok_or("it is not in its tree")?;
        let (figures, own) = (&run.figures[place], &part.problem().objects[place]);
        let delta = |q: &[f64]| {
            let output: f64 = own
                .output
                .iter()
                .map(|&(mass, share)| share * q[mass])
                .sum();
            output - own.driver.map_or(0.0, |(mass, ratio)| ratio * q[mass])
        };
        let first = tree.problem();
        let start = [first.displacement.as_slice(), first.speed.as_slice()].concat();
        let rows =
            || std::iter::once(start.as_slice()).chain(run.samples.chunks_exact(run.columns));
        let angle = |time: f64| self.law.angle + speed * time;
        let course = rows().enumerate().map(|(row, q)| {
            let time = period * row as f64 / SAMPLES as f64;
            [angle(time), delta(q)]
        });
        let (greatest, time) = match figures.delta_max >= -figures.delta_min {
            true => (figures.delta_max, figures.times.delta_max),
            false => (figures.delta_min, figures.times.delta_min),
        };
        // The contact of the object next to the law decides.
        let mass = &part.problem().masses[own.first];
        let n = part.problem().masses.len();
        let force = |row: &[f64]| {
            let base = mass.parent.map_or([0.0; 2], |parent| {
                [row[parent], row[n + parent]].map(|own| mass.lever * own)
            });
            let [x, v] = [row[own.first] - base[0], row[n + own.first] - base[1]];
            mass.stiffness * x + mass.damping * v
        };
        let least = match mass.pair {
            TreePair::Force { opens } => {
                let forces = rows().map(|row| -opens * force(row));
                Some(forces.fold(f64::INFINITY, f64::min))
            }
            TreePair::Bilateral | TreePair::Form { .. } => None,
        };
        let separates = !run.switches.is_empty();
        Ok(Deviation {
            greatest,
            at: angle(time),
            course: course.collect(),
            separates,
            // (While it is open the formula of the closed contact says nothing.)
            least_contact_force: least.map(|least| if separates { 0.0 } else { least }),
        })
    }
}
