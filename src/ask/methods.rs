//! Methods of integration beside each other.

use super::Mechanism;
use crate::Error;
use crate::studies::Control;
use crate::studies::methods::{Now, Plan, Study, study};

impl Mechanism {
    /// Speed against accuracy of every method of a plan, and where they fail. Heard of by
    /// `tell`, and ended from outside.
    ///
    /// ```
    /// # use dam::prelude::*;
    /// use dam::studies::Control;
    /// use dam::studies::methods::Plan;
    ///
    /// let scene = Scene::read("scenarios/rocker/two_masses.json")?.duration(0.02);
    /// let plan = Plan { methods: vec![Method::Exact], repeats: 1, ..Plan::new(1e-6) };
    /// let found = scene.prepare()?.methods(&plan, &Control::default(), &mut |_| ())?;
    /// assert!(found.complete && found.methods.len() == 1);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// What no method can run.
    pub fn methods(
        &self,
        plan: &Plan,
        control: &Control<'_>,
        tell: &mut dyn FnMut(&Now),
    ) -> Result<Study, Error> {
        let found = study(&self.system, &self.settings, plan, control, tell);
        found.map_err(|faults| self.diagnose(&faults))
    }
}
