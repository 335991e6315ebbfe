//! Crossings of orders with natural frequencies.

use super::deviation::{Deviation, Periodic, SpeedPoint};
use super::law::OrderedLaw;
use crate::dynamics::system::System;
use crate::fault::Fault;
use crate::studies::linear::{LeftOut, LinearModel, OutputSignal, TreeModes};
use crate::studies::{Control, RunSettings};
use serde::Serialize;
use std::f64::consts::TAU;

/// What is asked of orders.
#[derive(Clone, Debug, PartialEq)]
pub struct OrdersQuestion {
    /// Speeds of the drive (rad/s) between which crossings are sought; `None`: up to twice the
    /// speed of the scene.
    pub speeds: Option<[f64; 2]>,
    /// Highest order of the drive.
    pub highest: usize,
    /// Amplitude of a deviation (rad or m) from which on a crossing counts; `None`: 1 % of the
    /// greatest deviation at the speed of the scene.
    pub accuracy: Option<f64>,
    /// Number of speeds at which the greatest deviation is found.
    pub points: usize,
}

impl Default for OrdersQuestion {
    fn default() -> Self {
        Self {
            speeds: None,
            highest: 20,
            accuracy: None,
            points: 60,
        }
    }
}

/// Share of the greatest deviation from which on a crossing counts unless another is given.
const USUAL: f64 = 0.01;

/// Coefficients below this share of the greatest are nothing.
const NOTHING: f64 = 1e-12;

/// Most crossings, and most speeds.
const MOST: usize = 100_000;

/// Orders and resonances of a scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OrdersAnswer {
    /// Orders of each tree of masses.
    pub trees: Vec<TreeOrders>,
    /// Objects without orders, with the reason.
    pub left_out: Vec<LeftOut>,
}

/// Orders and resonances of a tree behind a law.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TreeOrders {
    /// Object whose law moves the tree.
    pub law: String,
    /// Object whose deviation is shown.
    pub object: String,
    /// Its drive.
    pub drive: String,
    /// SI unit of the deviation.
    pub unit: String,
    /// SI unit of the contact force.
    pub force_unit: String,
    /// Speed of the drive in the scene (rad/s).
    pub speed: f64,
    /// Speeds between which crossings were sought (rad/s).
    pub speeds: [f64; 2],
    /// True where the coefficients of the law follow in closed form; else by quadrature.
    pub closed_form: bool,
    /// Orders of the drive, from the lowest.
    pub orders: Vec<Order>,
    /// Natural frequencies of the modes that oscillate (Hz), undamped.
    pub frequencies: Vec<f64>,
    /// Crossings, by speed.
    pub crossings: Vec<Crossing>,
    /// Amplitude from which on a crossing counts (rad or m).
    pub accuracy: f64,
    /// Deviation in the periodic motion at the speed of the scene; null where there is none.
    pub deviation: Option<Deviation>,
    /// Why there is none; null where there is one.
    pub deviation_missing: Option<String>,
    /// Greatest deviation over the speed.
    pub over_speed: Vec<SpeedPoint>,
}

/// An order of a law.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Order {
    /// Oscillations in a turn of the drive.
    pub order: f64,
    /// Amplitude |2·u_k| of the law (rad or m).
    pub amplitude: f64,
    /// Phase of u_k (rad): the law has the part amplitude·cos(k·φ + phase).
    pub phase: f64,
    /// False where the law does not have this order.
    pub present: bool,
    /// Amplitude of the deviation by this order at the speed of the scene; null where unbounded.
    pub deviation: Option<f64>,
    /// Speed of the drive at which it meets each of the natural frequencies (rad/s).
    pub resonances: Vec<f64>,
}

/// A crossing of an order with a natural frequency.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Crossing {
    /// Oscillations in a turn of the drive.
    pub order: f64,
    /// Number of the mode, from 1.
    pub mode: usize,
    /// Speed of the drive (rad/s).
    pub speed: f64,
    /// Natural frequency (Hz).
    pub frequency: f64,
    /// Amplitude of the deviation by this order alone (rad or m); null where it is unbounded.
    pub amplitude: Option<f64>,
    /// False where the law does not have this order: nothing happens at the crossing.
    pub present: bool,
    /// True where the amplitude exceeds the accuracy.
    pub marked: bool,
    /// Greatest deviation of the periodic motion at this speed, of a marked crossing.
    pub greatest: Option<f64>,
    /// True where the contact separates at this speed, of a marked crossing.
    pub separates: bool,
    /// Least contact force at this speed, of a marked crossing with a force-closed contact.
    pub least_contact_force: Option<f64>,
}

/// The orders of the laws of a system and their resonances.
///
/// # Errors
/// Nothing in the scene has orders: every reason; what is wrong with the question.
pub fn orders(
    (system, settings): (&System, &RunSettings),
    question: &OrdersQuestion,
    control: &Control<'_>,
) -> Result<OrdersAnswer, Vec<Fault>> {
    check(question)?;
    let linear = LinearModel::of(system)?;
    let mut answer = OrdersAnswer {
        trees: Vec::new(),
        left_out: linear.left_out.clone(),
    };
    let model = system.model();
    let index = |id: &str| model.objects.iter().position(|part| part.id == id);
    for (number, modes) in TreeModes::of(&linear)?.iter().enumerate() {
        let (Some(first), Some(object)) = (index(&modes.law), index(&modes.output)) else {
            continue;
        };
        match OrderedLaw::of(model, model.objects[first].nodes[0]) {
            Ok(law) => answer.trees.push(
                TreeStudy {
                    linear: &linear,
                    number,
                    modes,
                    law: &law,
                    question,
                    periodic: Periodic {
                        model,
                        settings,
                        control,
                        law: &law,
                        objects: [first, object],
                    },
                }
                .orders(model.objects[object].coordinate.units()),
            ),
            Err(reason) => answer.left_out.push(LeftOut {
                object: modes.law.clone(),
                reason,
            }),
        }
    }
    if control.is_spent() {
        return Err(vec![Fault::new("", "the question was interrupted", "")]);
    }
    match answer.trees.is_empty() {
        true => Err(answer.left_out.into_iter().map(refusal).collect()),
        false => Ok(answer),
    }
}

/// Whether anything in a system has orders.
///
/// # Errors
/// Every reason against it.
pub fn suits(system: &System) -> Result<(), Vec<Fault>> {
    let linear = LinearModel::of(system)?;
    let model = system.model();
    let mut refused = Vec::new();
    for id in linear.laws() {
        let part = model.objects.iter().find(|part| part.id == id);
        match part.map(|part| OrderedLaw::of(model, part.nodes[0])) {
            Some(Err(reason)) => refused.push(refusal(LeftOut {
                object: id.to_owned(),
                reason,
            })),
            Some(Ok(_)) => return Ok(()),
            None => {}
        }
    }
    Err(refused)
}

fn refusal(one: LeftOut) -> Fault {
    let message = format!("`{}` has no orders: {}", one.object, one.reason);
    let hint = "an elastic object behind a drive of constant speed and a law that repeats has some";
    Fault::new(one.object, message, hint)
}

fn check(question: &OrdersQuestion) -> Result<(), Vec<Fault>> {
    let mut faults = Vec::new();
    if let Some([low, high]) = question.speeds
        && !(low >= 0.0 && low < high && high.is_finite())
    {
        let message = format!("no speeds lie between {low} rad/s and {high} rad/s");
        faults.push(Fault::new(
            "--speeds",
            message,
            "give LOW:HIGH from 0 on, as 0:3000 rpm",
        ));
    }
    if !(1..=MOST).contains(&question.highest) {
        let message = format!("{} is no highest order", question.highest);
        faults.push(Fault::new(
            "--highest",
            message,
            "give a number from 1 on, as 20",
        ));
    }
    if !(2..=MOST).contains(&question.points) {
        let message = format!("{} speeds are no curve", question.points);
        faults.push(Fault::new(
            "--points",
            message,
            "give a number from 2 on, as 60",
        ));
    }
    match faults.is_empty() {
        true => Ok(()),
        false => Err(faults),
    }
}

/// What the orders of a tree are computed from.
struct TreeStudy<'s> {
    linear: &'s LinearModel,
    number: usize,
    modes: &'s TreeModes,
    law: &'s OrderedLaw,
    question: &'s OrdersQuestion,
    periodic: Periodic<'s>,
}

impl TreeStudy<'_> {
    fn orders(&self, [unit, force_unit]: [&str; 2]) -> TreeOrders {
        let speed = self.law.speed.abs();
        let speeds = self.question.speeds.unwrap_or([0.0, 2.0 * speed]);
        let oscillating = self.modes.modes.iter().filter(|mode| !mode.overdamped);
        let frequencies: Vec<f64> = oscillating.map(|mode| mode.frequency).collect();
        let orders = self.all_orders(speed, &frequencies);
        let over_speed = self.over_speed(speeds);
        let (deviation, deviation_missing) = match self.periodic.deviation(self.law.speed) {
            Ok(found) => (Some(found), None),
            Err(why) => (None, Some(why)),
        };
        let usual = deviation.as_ref().map(|own| own.greatest.abs());
        // (Without a motion there, that of any other speed.)
        let usual = usual.or_else(|| over_speed.iter().find_map(|point| point.greatest));
        let accuracy = self
            .question
            .accuracy
            .unwrap_or(USUAL * usual.unwrap_or(0.0));
        let mut parts = self.periodic.model.objects.iter();
        let drive = parts.find(|part| part.nodes.first() == Some(&self.law.drive));
        TreeOrders {
            law: self.modes.law.clone(),
            object: self.modes.output.clone(),
            drive: drive.map_or(String::new(), |part| part.id.clone()),
            unit: unit.to_owned(),
            force_unit: force_unit.to_owned(),
            speed,
            speeds,
            closed_form: self.law.is_closed(),
            crossings: self.crossings(&orders, &frequencies, speeds, accuracy),
            orders,
            frequencies,
            accuracy,
            deviation,
            deviation_missing,
            over_speed,
        }
    }

    fn all_orders(&self, speed: f64, frequencies: &[f64]) -> Vec<Order> {
        let spacing = self.law.spacing();
        let count = (self.question.highest as f64 / spacing * (1.0 + 1e-12)) as usize;
        let numbers = 1..=count.clamp(1, MOST);
        let coefficients: Vec<_> = numbers.map(|number| self.law.coefficient(number)).collect();
        let greatest = coefficients
            .iter()
            .map(|own| own.norm())
            .fold(0.0, f64::max);
        let order = |(place, own): (usize, &nalgebra::Complex<f64>)| {
            let order = spacing * (place + 1) as f64;
            let amplitude = 2.0 * own.norm();
            let resonance = |frequency: &f64| TAU * frequency / order;
            let at = order * speed / TAU;
            Order {
                order,
                amplitude,
                phase: own.im.atan2(own.re),
                present: own.norm() > NOTHING * greatest,
                deviation: self.gain(at).map(|gain| gain * amplitude),
                resonances: frequencies.iter().map(resonance).collect(),
            }
        };
        coefficients.iter().enumerate().map(order).collect()
    }

    /// |H − 1| at a frequency (Hz); `None` where it is unbounded.
    fn gain(&self, at: f64) -> Option<f64> {
        let undamped = self.modes.modes.iter().any(|mode| {
            mode.damping_ratio == 0.0 && (mode.frequency - at).abs() <= 1e-10 * mode.frequency
        });
        let name = format!("{}.delta", self.modes.output);
        let inputs = self.linear.inputs();
        let law = inputs
            .iter()
            .find(|one| one.is_of(self.number) && one.is_law())?;
        let outputs = self.linear.outputs();
        let delta: &OutputSignal = outputs.iter().find(|one| one.signal.name == name)?;
        let gain = self.linear.transfer(law, delta, at)?.norm();
        (!undamped).then_some(gain)
    }

    fn crossings(
        &self,
        orders: &[Order],
        frequencies: &[f64],
        [low, high]: [f64; 2],
        accuracy: f64,
    ) -> Vec<Crossing> {
        let mut found = Vec::new();
        for order in orders {
            for (mode, (&frequency, &speed)) in
                frequencies.iter().zip(&order.resonances).enumerate()
            {
                if !(low <= speed && speed <= high) || found.len() >= MOST {
                    continue;
                }
                let amplitude = match order.present {
                    true => self.gain(frequency).map(|gain| gain * order.amplitude),
                    false => Some(0.0),
                };
                let marked = amplitude.is_none_or(|own| own > accuracy);
                // (Without damping there is no periodic motion at the crossing itself.)
                let point = (marked && amplitude.is_some()).then(|| self.point(speed));
                found.push(Crossing {
                    order: order.order,
                    mode: mode + 1,
                    speed,
                    frequency,
                    amplitude,
                    present: order.present,
                    marked,
                    greatest: point.as_ref().and_then(|point| point.greatest),
                    separates: point.as_ref().is_some_and(|point| point.separates),
                    least_contact_force: point.and_then(|point| point.least_contact_force),
                });
            }
        }
        found.sort_by(|a, b| a.speed.total_cmp(&b.speed));
        found
    }

    /// The periodic motion at a speed in the sense of the drive.
    fn point(&self, speed: f64) -> SpeedPoint {
        let found = self.periodic.point(speed.copysign(self.law.speed));
        SpeedPoint { speed, ..found }
    }

    fn over_speed(&self, [low, high]: [f64; 2]) -> Vec<SpeedPoint> {
        let count = self.question.points;
        let step = (high - low) / count as f64;
        let speed = |place: usize| low + step * (place + 1) as f64;
        let speeds = (0..count).map(speed);
        speeds
            .take_while(|_| !self.periodic.control.is_spent())
            .map(|speed| self.point(speed))
            .collect()
    }
}
