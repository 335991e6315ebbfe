//! A drive's run-up by a law of motion.

use super::law::{Law, RunLawSpec};
use super::uniform;
use crate::fault::Fault;
use crate::math::jet::Jet;

/// A run-up by a law of motion.
#[derive(Clone, Debug)]
pub struct LawRunUp {
    law: Law,
    /// Numbers that the law was made from.
    pub spec: RunLawSpec,
    /// Final speed (rad/s).
    pub speed: f64,
    /// Duration of the run-up (s), > 0.
    pub time: f64,
    /// φ at t = 0 (rad).
    pub angle: f64,
}

impl LawRunUp {
    /// The run-up by a law; speed and time have been checked.
    ///
    /// # Errors
    /// A faulty law; paths relative to it.
    pub(super) fn new(
        spec: &RunLawSpec,
        speed: f64,
        time: f64,
        angle: f64,
    ) -> Result<Self, Vec<Fault>> {
        Ok(Self {
            law: Law::of_run_up(spec)?,
            spec: spec.clone(),
            speed,
            time,
            angle,
        })
    }

    /// Angle turned during the run-up (rad).
    pub fn angle_of_run_up(&self) -> f64 {
        self.speed * self.time / self.law.at(1.0).first
    }

    pub(super) fn jet(&self, segment: i64, time: f64) -> Jet {
        let last = self.law.joints().len();
        let piece = match segment {
            i64::MIN..=0 => return uniform(self.angle, 0.0, time),
            segment => segment as usize - 1,
        };
        if piece > last {
            return uniform(
                self.angle + self.angle_of_run_up(),
                self.speed,
                time - self.time,
            );
        }
        let jet = self.law.jet(piece, time / self.time);
        let (turned, rate) = (self.angle_of_run_up(), 1.0 / self.time);
        Jet {
            value: self.angle + turned * jet.value,
            first: turned * rate * jet.first,
            second: turned * rate * rate * jet.second,
            third: turned * rate * rate * rate * jet.third,
        }
    }

    pub(super) fn breaks(&self) -> Vec<f64> {
        let joints = self.law.joints().iter().map(|joint| joint * self.time);
        std::iter::once(0.0)
            .chain(joints)
            .chain([self.time])
            .collect()
    }
}
