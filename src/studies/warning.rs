//! What the user of a run should know beside its figures.

use crate::dynamics::audit::EquationCheck;
use crate::dynamics::record::{CreepFigures, Units};
use crate::units::shown;
use std::fmt;

/// A warning; its text says what to do about it.
#[derive(Clone, Debug, PartialEq)]
pub enum Warning {
    /// Something about the start.
    Start(String),
    /// Something in the scene that is likely not meant.
    Meaning(String),
    /// The energies do not balance: the figures are not to be trusted.
    EnergyAudit {
        /// Error of the balance.
        error: f64,
        /// What it may be at this tolerance.
        bound: f64,
    },
    /// The motion does not keep its equations: the figures are not to be trusted.
    Equations(EquationCheck),
    /// A force or an acceleration was not a finite number.
    NotFinite,
    /// A fixed step keeps no tolerance.
    FixedStep {
        /// Fastest rate of the system (1/s).
        fastest: f64,
        /// What such a vibration is out of phase by at the end (rad).
        phase: f64,
        /// A step with which it would keep what the tolerance allows (s).
        step: f64,
    },
    /// There is no window in which the working order could be judged.
    WindowMissing {
        /// Why.
        reason: String,
        /// A longer run would have one.
        longer: bool,
    },
    /// A force-closed pair of a rigid object would open: the motion needs a pull.
    WouldLiftOff {
        /// The object.
        object: String,
        /// Least contact force (negative).
        margin: f64,
        /// Unit of the value.
        unit: &'static str,
        /// Time (s).
        time: f64,
    },
    /// A pair opens: the mechanism is not in working order, the computation is.
    Opens {
        /// The object.
        object: String,
        /// Number of separations.
        separations: u64,
        /// Total time open (s).
        separated_time: f64,
        /// Share of the run.
        share: f64,
        /// The working order of the pair is judged.
        judged: bool,
    },
    /// A pair switches and switches back at one instant, to rounding: whether it
    /// does so at all is not determined, and so are the counts.
    SwitchesUndetermined {
        /// The object.
        object: String,
        /// Number of returns.
        returns: usize,
        /// The first time (s).
        time: f64,
    },
    /// A condition may have held before it was seen to hold.
    FirstTimeUndetermined {
        /// Name of the condition.
        name: String,
        /// From when on it may have held (s).
        since: f64,
        /// When it was seen to hold (s).
        found: Option<f64>,
    },
    /// An object moves as slowly as a regularised friction makes it: it would rest.
    Creeps {
        /// The object.
        object: String,
        /// Its creep.
        creep: CreepFigures,
        /// Its units.
        units: Units,
    },
    /// Rounding alone may be a good part of the peak acceleration of an object.
    RoundedAcceleration {
        /// The object.
        object: String,
        /// What rounding may change the acceleration by.
        rounding: f64,
        /// The peak acceleration shown.
        peak: f64,
        /// The peak reaction.
        force: f64,
        /// Its units.
        units: Units,
    },
    /// Contact without damping that switches often: the motion is chaotic.
    Undetermined {
        /// The object.
        object: String,
        /// Switches of its pair.
        switches: usize,
    },
}

impl Warning {
    /// True when the figures are not to be trusted because of it.
    pub fn spoils_figures(&self) -> bool {
        match self {
            Self::EnergyAudit { .. } | Self::Equations(_) | Self::NotFinite => true,
            Self::Start(_)
            | Self::Meaning(_)
            | Self::FixedStep { .. }
            | Self::WindowMissing { .. }
            | Self::WouldLiftOff { .. }
            | Self::Opens { .. }
            | Self::SwitchesUndetermined { .. }
            | Self::FirstTimeUndetermined { .. }
            | Self::Creeps { .. }
            | Self::RoundedAcceleration { .. }
            | Self::Undetermined { .. } => false,
        }
    }

    /// True when it says that results are not determined.
    pub fn leaves_open(&self) -> bool {
        match self {
            Self::SwitchesUndetermined { .. }
            | Self::FirstTimeUndetermined { .. }
            | Self::RoundedAcceleration { .. }
            | Self::Undetermined { .. } => true,
            Self::EnergyAudit { .. }
            | Self::Equations(_)
            | Self::NotFinite
            | Self::Start(_)
            | Self::Meaning(_)
            | Self::FixedStep { .. }
            | Self::WindowMissing { .. }
            | Self::WouldLiftOff { .. }
            | Self::Opens { .. }
            | Self::Creeps { .. } => false,
        }
    }

    /// The warning that a check of the equations of motion gives, if they are not kept.
    pub(in crate::studies) fn of_equations(check: &EquationCheck) -> Option<Self> {
        (!check.is_kept()).then(|| Self::Equations(check.clone()))
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Start(text) | Self::Meaning(text) => f.write_str(text),
            Self::EnergyAudit { error, bound } => write!(
                f,
                "not to be trusted: the energies balance only to {error} of the work put in, \
                 where {bound} is allowed; ask for a smaller tolerance, a smaller step or another method",
                error = shown(*error, 2),
                bound = shown(*bound, 2)
            ),
            Self::Equations(check) => write!(
                f,
                "not to be trusted: {check}; ask for a smaller tolerance or another method"
            ),
            Self::NotFinite => f.write_str(
                "not to be trusted: a force or an acceleration was not a finite number; search \
                 for the object whose column holds it",
            ),
            Self::FixedStep {
                fastest,
                phase,
                step,
            } => write!(
                f,
                "a fixed step keeps no tolerance. A vibration of the fastest rate of the \
                 mechanism, {} 1/s, is out of phase by some {} rad at the end. Results that \
                 depend on it have as great an error. A step of {} s or another method keeps it",
                shown(*fastest, 3),
                shown(*phase, 2),
                shown(*step, 2)
            ),
            Self::WindowMissing { reason, longer } => write!(
                f,
                "working order not judged: {reason}; give `run.window`{}",
                match longer {
                    true => " or a longer `run.duration`",
                    false => "",
                }
            ),
            Self::WouldLiftOff {
                object,
                margin,
                unit,
                time,
            } => write!(
                f,
                "{object} would lift off: at {} s its motion needs a contact force of \
                 {} {unit}; it is rigid and goes on as if it were held. \
                 Give it at least one mass to see the flight, or close it harder by {} {unit}",
                shown(*time, 7),
                shown(*margin, 7),
                shown(-margin, 7)
            ),
            Self::Opens {
                object,
                separations,
                separated_time,
                share,
                judged,
            } => write!(
                f,
                "the contact of {object} is separated for {} s ({} % of the run, {}): {} of the \
                 mechanism, not a failure of the computation",
                shown(*separated_time, 4),
                shown(100.0 * share, 3),
                match separations {
                    1 => "1 separation".to_owned(),
                    more => format!("{more} separations"),
                },
                match judged {
                    true => "loss of working order",
                    false => "the motion",
                }
            ),
            Self::SwitchesUndetermined {
                object,
                returns,
                time,
            } => write!(
                f,
                "the counts of events of {object} are not determined. Its contact separates and \
                 closes at one instant {returns} times, first at {} s: the force that decides is \
                 smaller than rounding. The motion is not touched by it. Compare with another \
                 method, or look at the damping: a pair that is damped this strongly opens too \
                 slowly to be told from one that stays",
                shown(*time, 7)
            ),
            Self::FirstTimeUndetermined { name, since, found } => write!(
                f,
                "the first time of the condition `{name}` is not determined. From {} s on its \
                 bounds do not decide whether it holds{}. A condition that stays farther from its \
                 edge, or changes more slowly, is decided",
                shown(*since, 7),
                match found {
                    Some(time) => format!(", and it was seen to hold at {} s", shown(*time, 7)),
                    None => ", and it was not seen to hold".to_owned(),
                }
            ),
            Self::Creeps {
                object,
                creep,
                units,
            } => write!(
                f,
                "{object} creeps at {} {}/s under {force} {unit} until {} s: regularised friction \
                 holds {force} {unit} of up to {} {unit}. It would rest. From {} s on its motion \
                 is not that of dry friction; a smaller width makes the creep slower",
                shown(creep.speed, 4),
                units.displacement,
                shown(creep.until, 4),
                shown(creep.limit, 4),
                shown(creep.from, 4),
                force = shown(creep.force, 4),
                unit = units.force
            ),
            Self::RoundedAcceleration {
                object,
                rounding,
                peak,
                force,
                units,
            } => write!(
                f,
                "the peak acceleration of {object}, {} {unit}/s², is not determined: the rounding \
                 of its link force of {} {} may alone change it by {} {unit}/s². Its motion and \
                 its forces are not affected",
                shown(*peak, 4),
                shown(*force, 4),
                units.force,
                shown(*rounding, 2),
                unit = units.displacement
            ),
            Self::Undetermined { object, switches } => write!(
                f,
                "the results of {object} are not determined to the printed digits: its contact \
                 has no damping and {switches} events, and every bounce multiplies a small \
                 difference. Run with --spread to see how far they move, or give it a \
                 `damping_capacity`"
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Warning;

    #[test]
    fn lift_off_and_numerical_failure_are_different_verdicts() {
        let opens = Warning::Opens {
            object: "rocker".to_owned(),
            separations: 65,
            separated_time: 0.15,
            share: 0.3,
            judged: true,
        };
        let audit = Warning::EnergyAudit {
            error: 0.1,
            bound: 1e-4,
        };
        assert!(!opens.spoils_figures() && audit.spoils_figures());
        assert!(opens.to_string().contains("30 % of the run"));
        assert!(
            opens
                .to_string()
                .contains("not a failure of the computation")
        );
        assert!(audit.to_string().starts_with("not to be trusted"));
    }
}
