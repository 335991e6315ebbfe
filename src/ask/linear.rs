//! Linear equations and responses to frequencies.

use super::{Mechanism, Scene};
use crate::Error;
use crate::studies::Control;
use crate::studies::linear::{
    FrequencyResponse, Linearisation, ResponseQuestion, linearise, response,
};
use crate::studies::orders::{OrdersAnswer, OrdersQuestion, orders};

impl Scene {
    /// The linear equations of the elastic objects behind prescribed drives: matrices, state
    /// space and natural modes.
    ///
    /// ```
    /// # use dam::prelude::*;
    /// let scene = Scene::read("scenarios/rocker/two_masses.json")?;
    /// let linear = scene.linearise()?;
    /// assert_eq!(linear.modes[0].modes.len(), 2);
    /// assert_eq!(linear.state_space.a.nrows(), 4);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// Everything that is wrong with the scene; why it has no linear equations.
    pub fn linearise(&self) -> Result<Linearisation, Error> {
        Mechanism::of(self.decode()?)?.linearise()
    }

    /// The response of the elastic objects behind prescribed drives over the frequency.
    ///
    /// ```
    /// # use dam::prelude::*;
    /// use dam::studies::linear::ResponseQuestion;
    ///
    /// let scene = Scene::read("scenarios/rocker/two_masses.json")?;
    /// let question = ResponseQuestion {
    ///     frequencies: vec![500.0],
    ///     outputs: vec!["rocker.delta".to_owned()],
    ///     ..ResponseQuestion::default()
    /// };
    /// let found = scene.response(&question)?;
    /// assert!((found.pairs[0].gain[0].unwrap() - 0.1016139563736).abs() < 1e-12);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// As of [`Self::linearise`]; what is wrong with the question.
    pub fn response(&self, question: &ResponseQuestion) -> Result<FrequencyResponse, Error> {
        Mechanism::of(self.decode()?)?.response(question)
    }
}

impl Scene {
    /// Orders of the law, their resonances, and the greatest deviation over the speed.
    ///
    /// ```
    /// # use dam::prelude::*;
    /// use dam::studies::orders::OrdersQuestion;
    ///
    /// let scene = Scene::read("scenarios/rocker/two_masses.json")?;
    /// let question = OrdersQuestion { points: 2, ..OrdersQuestion::default() };
    /// let found = scene.orders(&question)?;
    /// // A sine has one order.
    /// let present = found.trees[0].orders.iter().filter(|order| order.present);
    /// assert_eq!(present.count(), 1);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// Everything that is wrong with the scene; why it has no orders.
    pub fn orders(&self, question: &OrdersQuestion) -> Result<OrdersAnswer, Error> {
        let ready = Mechanism::of(self.decode()?)?;
        ready.orders_within(question, &Control::default())
    }
}

impl Mechanism {
    /// Orders of the law and their resonances, ended from outside.
    ///
    /// # Errors
    /// Why there are none; what is wrong with the question; it was ended.
    pub fn orders_within(
        &self,
        question: &OrdersQuestion,
        control: &Control<'_>,
    ) -> Result<OrdersAnswer, Error> {
        let found = orders((&self.system, &self.settings), question, control);
        found.map_err(|faults| self.diagnose(&faults))
    }

    /// The linear equations of the elastic objects behind prescribed drives.
    ///
    /// # Errors
    /// Why there are none.
    pub fn linearise(&self) -> Result<Linearisation, Error> {
        linearise(&self.system).map_err(|faults| self.diagnose(&faults))
    }

    /// The response of the elastic objects behind prescribed drives over the frequency. The
    /// scene is changed to find the error of the model, and left as it was.
    ///
    /// # Errors
    /// Why there is none; what is wrong with the question.
    pub fn response(&mut self, question: &ResponseQuestion) -> Result<FrequencyResponse, Error> {
        let scene = &mut self.reading.scene;
        let found = response((&self.system, scene), question);
        found.map_err(|faults| self.diagnose(&faults))
    }
}
