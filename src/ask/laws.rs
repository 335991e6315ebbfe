//! Laws of motion, by themselves and in a scene.

use super::Mechanism;
use crate::Error;
use crate::kinematics::position::Position;
use crate::studies::cycle::{CycleFigures, cycle};
use serde_json::{Value, json};

/// The whole cycle of what an object follows.
#[derive(Clone, Debug)]
pub struct FollowedCycle<'m> {
    /// The object's id.
    pub object: &'m str,
    /// Its position function.
    pub position: &'m Position,
    /// What multiplies it.
    pub lever: f64,
    /// Units of its displacement and of its driver's.
    pub units: [&'static str; 2],
    /// Joints, extremes, shocks.
    pub figures: CycleFigures,
}

impl FollowedCycle<'_> {
    /// The JSON document. `scene`: its name.
    pub fn document(&self, scene: &str) -> Value {
        json!({
            "dam": 1, "scene": scene, "object": self.object,
            "units": { "displacement": self.units[0], "driver": self.units[1] },
            "cycle": self.figures
        })
    }
}

impl Mechanism {
    /// The whole cycle of the cam or plan that an object follows: joints, extremes, shocks.
    ///
    /// ```
    /// # use dam::prelude::*;
    /// let scene = Scene::read("scenarios/cams/flat_tappet.json")?.prepare()?;
    /// let valve = scene.law_cycle("valve")?;
    /// assert_eq!(valve.units, ["m", "rad"]);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// There is no such object; it follows no law, or several inputs.
    pub fn law_cycle(&self, object: &str) -> Result<FollowedCycle<'_>, Error> {
        let model = self.model();
        let wrong = |what: &str| Error::question(format!("`{object}`: {what}"));
        let part = model.objects.iter().find(|part| part.id == object);
        let Some(part) = part else {
            let known: Vec<&str> = model.objects.iter().map(|part| part.id.as_str()).collect();
            return Err(Error::unknown("object", object, &known));
        };
        if part.is_drive() {
            return Err(wrong("a drive follows no law"));
        }
        let driver = part.driver();
        let driver = driver.ok_or_else(|| wrong("it follows several inputs, not one"))?;
        let law = model.nodes[part.nodes[0]].motion.law();
        let law = law.ok_or_else(|| wrong("it follows no law"))?;
        let figures = cycle(&law.position, law.lever).map_err(|message| wrong(&message))?;
        Ok(FollowedCycle {
            object: &part.id,
            position: &law.position,
            lever: law.lever,
            units: [
                part.coordinate.unit(),
                model.objects[driver].coordinate.unit(),
            ],
            figures,
        })
    }
}
