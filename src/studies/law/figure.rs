//! What laws are compared by.

use super::{ComparedLaw, LiftOff};

/// Figure that laws are ranked by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Figure {
    /// C_v.
    Speed,
    /// C_a.
    Acceleration,
    /// C_j.
    Jerk,
    /// C_m.
    Torque,
    /// Residual vibration.
    Residual,
    /// Greatest |δ|.
    Deviation,
    /// Greatest contact force.
    ContactForce,
    /// Greatest torque asked of the driver.
    DriverTorque,
    /// Lift-off speed: the higher the better.
    LiftOff,
}

impl Figure {
    /// All of them: first the constants, then the response.
    pub const ALL: [Self; 9] = [
        Self::Speed,
        Self::Acceleration,
        Self::Jerk,
        Self::Torque,
        Self::Residual,
        Self::Deviation,
        Self::ContactForce,
        Self::DriverTorque,
        Self::LiftOff,
    ];

    /// Name in tables and arguments.
    pub fn name(self) -> &'static str {
        match self {
            Self::Speed => "C_v",
            Self::Acceleration => "C_a",
            Self::Jerk => "C_j",
            Self::Torque => "C_m",
            Self::Residual => "residual",
            Self::Deviation => "deviation",
            Self::ContactForce => "contact_force",
            Self::DriverTorque => "driver_torque",
            Self::LiftOff => "lift_off",
        }
    }

    /// Name in sentences and heads.
    pub fn words(self) -> &'static str {
        match self {
            Self::Residual => "residual vibration",
            Self::ContactForce => "contact force",
            Self::DriverTorque => "driver torque",
            Self::LiftOff => "lift-off speed",
            other => other.name(),
        }
    }

    /// Unit of the value for a law; empty of its constants.
    pub fn unit(self, law: &ComparedLaw) -> &'static str {
        let units = &law.response.units;
        match self {
            Self::Residual | Self::Deviation => units.displacement,
            Self::ContactForce => units.force,
            Self::DriverTorque => units.driver_force,
            Self::LiftOff => "rad/s",
            Self::Speed | Self::Acceleration | Self::Jerk | Self::Torque => "",
        }
    }

    /// True of the law's own constants.
    pub fn is_constant(self) -> bool {
        matches!(
            self,
            Self::Speed | Self::Acceleration | Self::Jerk | Self::Torque
        )
    }

    /// Value for a law; `None`: it has none.
    pub fn of(self, law: &ComparedLaw) -> Option<f64> {
        let (constants, response) = (&law.constants, &law.response);
        match self {
            Self::Speed => Some(constants.speed.value),
            Self::Acceleration => {
                let least = -constants.deceleration.value;
                Some(constants.acceleration.value.max(least))
            }
            Self::Jerk => Some(constants.jerk.value),
            Self::Torque => Some(constants.torque_factor),
            Self::Residual => response.residual,
            Self::Deviation => Some(response.deviation),
            Self::ContactForce => Some(response.contact_force),
            Self::DriverTorque => Some(response.driver_torque),
            Self::LiftOff => match response.lift_off? {
                LiftOff::At(speed) | LiftOff::Above(speed) | LiftOff::Below(speed) => Some(speed),
            },
        }
    }

    /// Places of the laws by this figure, 1 the best, equal values (to 1e-9)
    /// sharing one; `None` where a law has no value.
    pub fn ranks(self, laws: &[ComparedLaw]) -> Vec<Option<usize>> {
        let sign = if self == Self::LiftOff { -1.0 } else { 1.0 };
        let values: Vec<Option<f64>> = laws
            .iter()
            .map(|law| self.of(law).map(|value| sign * value))
            .collect();
        let better = |one: f64, than: f64| one < than - 1e-9 * than.abs();
        let place = |value: f64| {
            let known = values.iter().flatten();
            1 + known.filter(|&&other| better(other, value)).count()
        };
        values.iter().map(|value| value.map(place)).collect()
    }
}
