//! The smallest scene.

use super::{Mechanism, ModelAssessment, Scene};
use crate::Error;
use crate::studies::Control;
use crate::studies::reduce::{Reduction, reduce};

impl Scene {
    /// The smallest scene that gives figures within their accuracy: those of `run.accuracy`,
    /// else those that the scene expects.
    ///
    /// ```
    /// # use dam::prelude::*;
    /// let scene = Scene::read("scenarios/rocker/ten_masses_closed.json")?;
    /// let found = scene.set("run.accuracy", "1 %").reduce()?;
    /// assert!(found.holds());
    /// let reduced = Scene::of(found.document.clone());
    /// assert!(reduced.run()?.is_trusted());
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// Everything that is wrong with the scene.
    pub fn reduce(&self) -> Result<Reduction, Error> {
        self.reduce_within(&Control::default())
    }

    /// The same, ended from outside.
    ///
    /// # Errors
    /// As of [`Self::reduce`].
    pub fn reduce_within(&self, control: &Control<'_>) -> Result<Reduction, Error> {
        let ready = Mechanism::of_within(self.decode()?, ModelAssessment::Never, control)?;
        let settings = ready.settings.clone();
        Ok(reduce(
            self.document(),
            ready.reading,
            &settings,
            control,
            &mut || (),
        )?)
    }
}
