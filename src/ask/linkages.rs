//! Kinematics and forces of linkages.

use super::Mechanism;
use crate::Error;
use crate::studies::forces::{ForceChoice, ForceStudy, NoForces, forces_of};
use crate::studies::kinematics::{Column, Kinematics, Quantity, Question, kinematics_of};

impl Mechanism {
    /// How a linkage moves: positions, transfer functions, speeds, accelerations.
    ///
    /// # Errors
    /// What cannot be answered.
    pub fn kinematics(&self, question: &Question) -> Result<Kinematics, Error> {
        kinematics_of(self.model(), &self.complete(question)).map_err(Error::question)
    }

    /// Which forces the pairs of a linkage carry, with friction, and which force drives
    /// it.
    ///
    /// # Errors
    /// What cannot be answered; faults of the linkage's numbers.
    pub fn forces(&self, question: &Question) -> Result<ForceStudy, Error> {
        self.forces_with(question, &ForceChoice::default())
    }

    /// The same with a load, without friction, or with a direction where the input rests.
    ///
    /// # Errors
    /// As of [`Self::forces`].
    pub fn forces_with(
        &self,
        question: &Question,
        choice: &ForceChoice,
    ) -> Result<ForceStudy, Error> {
        let found = forces_of(self.model(), &self.complete(question), choice);
        found.map_err(|refused| match refused {
            NoForces::Question(message) => Error::question(message),
            NoForces::Linkage(faults) => self.diagnose(&faults),
        })
    }

    /// The question with the duration of the scene's run where it has none.
    fn complete(&self, question: &Question) -> Question {
        let mut question = question.clone();
        if question.duration == 0.0 {
            question.duration = self.settings.duration;
        }
        question
    }
}

impl Kinematics {
    /// A quantity of a part of the linkage, a value for each row: of `input`,
    /// `links.rod`, `links.rod.P`, `pairs.guide`, or an output by its name.
    ///
    /// # Errors
    /// There is no such column.
    pub fn column(&self, owner: &str, quantity: Quantity) -> Result<&[f64], Error> {
        let wanted = |column: &&Column| column.quantity == quantity && column.owner == owner;
        match self.columns.iter().find(wanted) {
            Some(column) => Ok(&column.values),
            None => {
                let name = format!("{owner}.{}", quantity.name());
                let known: Vec<String> = self.columns.iter().map(|column| column.name()).collect();
                let known: Vec<&str> = known.iter().map(String::as_str).collect();
                Err(Error::unknown("column", &name, &known))
            }
        }
    }
}
