//! The figures of a run: the document that `dam run --json` prints.

use crate::dynamics::audit::EquationCheck;
use crate::dynamics::integrate::Impact;
use serde::Serialize;
use std::collections::BTreeMap;

/// The whole document.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Figures {
    /// Version of the document: 1.
    pub dam: u32,
    /// Name of the scene.
    pub scene: String,
    /// Hash of the canonical scene.
    pub hash: String,
    /// Units of each object's figures.
    pub units: BTreeMap<String, Units>,
    /// Figures of each object.
    pub objects: BTreeMap<String, ObjectFigures>,
    /// Summary of the run.
    pub run: RunSummary,
    /// Results of other studies that were asked for, by their addresses: `frequency.1`.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub studies: BTreeMap<String, StudyFigure>,
    /// Warnings to the user.
    pub warnings: Vec<String>,
}

/// A result of another study than the run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StudyFigure {
    /// The value in SI units; null where the study has none.
    pub value: Option<f64>,
    /// SI unit; empty of pure numbers, and of kinematics and forces.
    pub unit: String,
}

/// Units of an object's figures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Units {
    /// `rad` or `m`.
    pub displacement: &'static str,
    /// `N m` or `N`.
    pub force: &'static str,
}

/// Figures of one object; peaks are the greatest absolute values at its last
/// mass, extremes between samples and both sides of a switch included.
///
/// Speeds, accelerations and forces grow beyond all bounds at a dead-centre position
/// that a given drive runs into. Figures of a run that stops in one are those
/// up to the last instant at which everything is regular: a millionth of the
/// reach of the linkage before the edge (ten times the tolerance, at most a
/// thousandth, where that is more). Samples and the energy audit likewise.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ObjectFigures {
    /// Greatest |δ|: how far the object strays from its law.
    pub delta_abs: f64,
    /// Greatest δ.
    pub delta_max: f64,
    /// Least δ.
    pub delta_min: f64,
    /// Mean of |δ| over the run.
    pub sigma: f64,
    /// Greatest |φ̇|.
    pub peak_speed: f64,
    /// Greatest |φ̈|.
    pub peak_acceleration: f64,
    /// Greatest |F| of link 1.
    pub peak_reaction: f64,
    /// State at the end; before a dead-centre position, the last regular one.
    #[serde(rename = "final")]
    pub end: FinalState,
    /// The driving pair; null for a bilateral one.
    pub pair: Option<PairFigures>,
    /// How hard it presses on its cam, where that has a `material`, or on what the geometry of
    /// its contact names (`contact.from`); absent where the pressure grows beyond bounds: on an
    /// edge of an undercut profile.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pressing: Option<PressingFigures>,
    /// Friction in the joints of a linkage, where it acts on the motion, or dry friction.
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub joints: Option<JointFigures>,
    /// The contact of a stop, which is an object part of its own, `valve.seat`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stop: Option<StopFigures>,
    /// The longest creep under a regularised friction below its limit; absent where there
    /// is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub creep: Option<CreepFigures>,
}

/// A motion that hangs on a regularised friction below its limit: on dry friction the object
/// would rest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct CreepFigures {
    /// φ̇ at its end.
    pub speed: f64,
    /// Force that the friction bears there, ≥ 0.
    pub force: f64,
    /// Force that it can bear, > 0.
    pub limit: f64,
    /// From here (s).
    pub from: f64,
    /// Up to here (s).
    pub until: f64,
}

/// The greatest magnitude between two extremes; not a number where one of them is none.
pub fn greatest_magnitude(least: f64, greatest: f64) -> f64 {
    if least.is_nan() || greatest.is_nan() {
        return f64::NAN;
    }
    least.abs().max(greatest.abs())
}

/// Pressure between a follower and its cam, or of a contact whose geometry is known.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct PressingFigures {
    /// Greatest Hertzian pressure (Pa); 0 while the pair is open.
    pub max_pressure: f64,
    /// Its time (s).
    pub time: f64,
}

/// Figures of a linkage whose joints have friction, or of an object with dry friction.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct JointFigures {
    /// Number of standstills of the input, t > 0: to turn back, to go on, or to rest. Of an
    /// object with several dry frictions, at the one listed last: on the mass farthest out.
    pub standstills: u64,
    /// Total time for which friction held it at rest (s), likewise.
    pub time_at_rest: f64,
    /// Energy lost to the friction of its joints, or to all its dry frictions (J), ≥ 0.
    pub friction_loss: f64,
}

impl JointFigures {
    /// Those of an object whose frictions are followed one by one: the losses add up.
    pub(crate) fn followed_by(self, last: Self) -> Self {
        Self {
            friction_loss: self.friction_loss + last.friction_loss,
            ..last
        }
    }
}

/// Figures of a one-sided stop. The other figures of its part are those of the mass that
/// it stops.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct StopFigures {
    /// How often the mass comes onto it, t > 0: more than once an event where it bounces.
    pub closures: u64,
    /// Total time in contact (s).
    pub contact_time: f64,
    /// Greatest speed at which the mass comes onto it; 0 if it never does.
    pub max_approach_speed: f64,
    /// Greatest force.
    pub max_contact_force: f64,
    /// Greatest indentation.
    pub max_indentation: f64,
    /// Impacts, where it is rigid.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub impacts: Option<ImpactFigures>,
    /// Times of all events (s).
    pub switch_times: Vec<f64>,
}

/// Figures of the impacts of a rigid contact. In an impact the contact force is an impulse:
/// it has no magnitude, and the greatest contact force is that of the times of rest between
/// impacts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct ImpactFigures {
    /// How often it is struck, t > 0.
    pub count: u64,
    /// Greatest impulse (N·s or N·m·s).
    pub max_impulse: f64,
    /// Energy lost in all of them (J), ≥ 0.
    pub loss: f64,
}

impl ImpactFigures {
    /// Another impact.
    pub(crate) fn add(&mut self, impact: &Impact) {
        self.count += 1;
        self.max_impulse = self.max_impulse.max(impact.impulse);
        self.loss += impact.lost;
    }
}

/// State of the last mass at the end of the run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct FinalState {
    /// φ.
    pub displacement: f64,
    /// φ̇.
    pub speed: f64,
}

/// Figures of a driving pair.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct PairFigures {
    /// Engaged → open, t > 0; but for openings at which the object is held by a stop.
    pub separations: u64,
    /// Open → engaged, t > 0.
    pub closures: u64,
    /// Total time open (s); but for the time after the object has come to a stop, until
    /// the pair is engaged again.
    pub separated_time: f64,
    /// Longest time open (s).
    pub longest_separation: f64,
    /// Greatest clearance.
    pub max_lift: f64,
    /// Greatest speed of approach at a closure; 0 if none.
    pub max_approach_speed: f64,
    /// Greatest contact force.
    pub max_contact_force: f64,
    /// Greatest indentation of the contact element; absent without one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_indentation: Option<f64>,
    /// Impacts of a rigid contact; absent without one. Where they follow each other in ever
    /// shorter times, those that are too low to be told apart count as one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub impacts: Option<ImpactFigures>,
    /// Rigid force-closed pair: least contact force the motion needs (negative:
    /// it would lift off); null for elastic objects.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub margin: Option<f64>,
    /// Times of all events (s).
    pub switch_times: Vec<f64>,
    /// No separation within the window; null without a window.
    pub in_working_order: Option<bool>,
}

/// Summary of a run: how it ended, by which method, at what effort.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct RunSummary {
    /// Method used.
    pub method: String,
    /// Why this method.
    pub why: String,
    /// Tolerance.
    pub tolerance: f64,
    /// Why it is this one, where it follows from the accuracy that is asked of the figures.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance_why: Option<String>,
    /// Time reached (s); of a dead-centre position, the time of the position itself.
    pub time: f64,
    /// True when the end time was reached.
    pub complete: bool,
    /// Why it stopped, when not complete: `dead_position`, `not_finite`, …
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stopped: Option<String>,
    /// Reason of the stop, in words.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stopped_because: Option<String>,
    /// Accepted steps.
    pub steps: u64,
    /// Rejected steps.
    pub rejected: u64,
    /// Evaluations of the right-hand side.
    pub evaluations: u64,
    /// Switches of pairs.
    pub switches: u64,
    /// Energy audit: |work of drives and loads − change of energy −
    /// dissipated| / max(work in, greatest kinetic energy).
    pub energy_error: f64,
    /// Check of the equations of motion.
    pub equations: EquationCheck,
    /// First time at which each condition of the scene holds (s), by its name; `until` is the one
    /// that ends the run. Null: it did not hold.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub first_times: BTreeMap<String, Option<f64>>,
    /// The conditions whose first time is not determined, by their names: the time (s) from
    /// which on they may have held earlier than `first_times` states.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub undetermined_times: BTreeMap<String, f64>,
    /// Window of steady figures `[from, to]` (s), or null.
    pub window: Option<[f64; 2]>,
    /// Why there is no window, when null.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub window_missing: Option<String>,
}
