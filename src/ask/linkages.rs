//! Kinematics and forces of linkages.

use super::Mechanism;
use crate::Error;
use crate::fault::Fault;
use crate::kinematics::linkage::kinetostatics::{Convention, Kinetostatics, Options};
use crate::studies::forces::{
    ForceSettings, ForceStudy, LinkagePositions, course_of, multi_input_forces, only_loaded_output,
    study,
};
use crate::studies::kinematics::{
    AskedSeveral, Column, Kinematics, KinematicsRequest, Quantity, Question, kinematics_of,
    linkage_of, several_of, whole_travel,
};

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
        let model = self.model();
        if let Some(body) = several_of(model, question.object.as_deref()) {
            let asked = AskedSeveral::new(model, body, &self.complete(question));
            let object = &model.objects[body.object].id;
            return multi_input_forces(&asked.map_err(Error::question)?, Options::default())
                .map_err(|faults| self.diagnose(&placed(object, faults)));
        }
        let body = linkage_of(model, question.object.as_deref()).map_err(Error::question)?;
        let object = &model.objects[body.object].id;
        let told = |faults| self.diagnose(&placed(object, faults));
        let solver = Kinetostatics::new(body.linkage.spec()).map_err(told)?;
        let mut question = self.complete(question);
        // A speed is meant for the whole travel.
        if question.over.is_none() && question.speed.or(question.acceleration).is_some() {
            question.over = Some(whole_travel(&body.linkage));
        }
        let asked = KinematicsRequest::new(model, &question).map_err(Error::question)?;
        let course = course_of(&asked).map_err(Error::question)?;
        let settings = ForceSettings {
            options: Options::default(),
            output: only_loaded_output(&solver),
            loads: None,
            convention: Convention::Paper,
        };
        let mut positions = LinkagePositions::new(&body.linkage);
        study(body.linkage.spec(), &mut positions, course, settings).map_err(told)
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

/// Faults of an object's properties, with their addresses in the scene.
fn placed(object: &str, mut faults: Vec<Fault>) -> Vec<Fault> {
    for fault in &mut faults {
        fault.path = match fault.path.as_str() {
            "" => object.to_owned(),
            path => format!("{object}.{path}"),
        };
    }
    faults
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
