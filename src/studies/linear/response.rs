//! Gains and phases over the frequency, and up to where the model is right.

use super::finer::FinerModel;
use super::frequencies::{check, usual};
use super::model::{LeftOut, LinearModel};
use super::peaks::{ResponsePeak, peaks};
use super::signals::{InputSignal, OutputSignal, Signal};
use crate::dynamics::system::System;
use crate::exact::TreeMode;
use crate::fault::Fault;
use crate::frontend::read::{did_you_mean, quoted_list};
use crate::frontend::scene::TypedScene;
use nalgebra::Complex;
use serde::Serialize;
use std::f64::consts::TAU;

type C = Complex<f64>;

/// What is asked of a response.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ResponseQuestion {
    /// Frequencies (Hz), ascending; empty: from a tenth of the lowest natural frequency to twice
    /// the highest.
    pub frequencies: Vec<f64>,
    /// Names of inputs; empty: all laws.
    pub inputs: Vec<String>,
    /// Names of outputs; empty: all of objects that the inputs move.
    pub outputs: Vec<String>,
    /// Relative error that the model may have; `None`: 1 %.
    pub accuracy: Option<f64>,
}

/// Relative error that a model may have unless another is given.
const USUAL_ACCURACY: f64 = 0.01;

/// An undamped mode so near to a frequency, relatively, makes the answer unbounded.
const AT_POLE: f64 = 1e-10;

/// Response of elastic objects to laws and loads over the frequency.
#[derive(Clone, Debug, Serialize)]
pub struct FrequencyResponse {
    /// Frequencies (Hz), ascending.
    pub frequencies: Vec<f64>,
    /// Each pair of input and output.
    pub pairs: Vec<PairResponse>,
    /// Relative error that the model may have.
    pub accuracy: f64,
    /// How the error of the model was judged.
    pub judged_by: JudgedBy,
    /// Objects without linear equations, with the reason.
    pub left_out: Vec<LeftOut>,
    /// Warnings: frequencies at which the response is unbounded.
    pub warnings: Vec<String>,
}

/// How the error of a model was judged.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct JudgedBy {
    /// Masses of the finer model in place of one; null without one.
    pub times: Option<usize>,
    /// Objects of the finer model with their levels, in words; null without one.
    pub levels: Option<String>,
    /// Why the error is not judged; null if it is.
    pub missing: Option<String>,
}

/// Response of an output to an input.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PairResponse {
    /// Input. A law stands for the law with its derivatives: the response multiplies it.
    pub input: Signal,
    /// Output.
    pub output: Signal,
    /// SI unit of the gain; 1 of a pure number.
    pub unit: String,
    /// Real part at each frequency; null where it is unbounded.
    pub re: Vec<Option<f64>>,
    /// Imaginary part.
    pub im: Vec<Option<f64>>,
    /// Gain.
    pub gain: Vec<Option<f64>>,
    /// Phase (rad) in (−π, π], positive where the output leads.
    pub phase: Vec<Option<f64>>,
    /// Relative error of the model, by the finer one; null without one.
    pub error: Vec<Option<f64>>,
    /// Frequency (Hz) up to which the model has the accuracy; null: it has it at no frequency, or
    /// nothing is known of it.
    pub right_up_to: Option<f64>,
    /// True where the model has the accuracy at all frequencies.
    pub right_everywhere: bool,
    /// Peaks of the gain within the frequencies.
    pub peaks: Vec<ResponsePeak>,
}

/// The response of the elastic objects of a system, which was made of a scene. The scene is
/// changed to find the error of the model, and left as it was.
///
/// # Errors
/// No object has linear equations; frequencies or names are wrong: all at once.
pub fn response(
    (system, scene): (&System, &mut TypedScene),
    question: &ResponseQuestion,
) -> Result<FrequencyResponse, Vec<Fault>> {
    let model = LinearModel::of(system)?;
    let mut faults = Vec::new();
    let (all_inputs, all_outputs) = (model.inputs(), model.outputs());
    let inputs = chosen(
        &question.inputs,
        &all_inputs,
        ("input", |one| &one.signal),
        &mut faults,
    );
    let outputs = chosen(
        &question.outputs,
        &all_outputs,
        ("output", |one| &one.signal),
        &mut faults,
    );
    let by_law = |input: &&InputSignal| !question.inputs.is_empty() || input.is_law();
    let pairs: Vec<(&InputSignal, &OutputSignal)> = inputs
        .into_iter()
        .filter(by_law)
        .flat_map(|input| outputs.iter().map(move |output| (input, *output)))
        .filter(|(input, output)| input.tree == output.tree)
        .collect();
    if faults.is_empty() && pairs.is_empty() {
        let message =
            "no named input moves a named output: they belong to different drives' objects";
        faults.push(Fault::new(
            "",
            message,
            "name an input and an output of one mechanism",
        ));
    }
    let frequencies = match question.frequencies.is_empty() {
        true => usual(&model),
        false => question.frequencies.clone(),
    };
    if let Err(message) = check(&frequencies, pairs.len().max(1)) {
        faults.push(Fault::new("--frequencies", message, ""));
    }
    let accuracy = question.accuracy.unwrap_or(USUAL_ACCURACY);
    if !(accuracy > 0.0 && accuracy.is_finite()) {
        let message = format!("{accuracy} is no accuracy");
        faults.push(Fault::new(
            "--accuracy",
            message,
            "give a share above zero, as 1 %",
        ));
    }
    if !faults.is_empty() {
        return Err(faults);
    }
    let finer = FinerModel::of(scene, &model);
    let judged_by = JudgedBy {
        times: finer.as_ref().ok().map(|own| own.times),
        levels: finer.as_ref().ok().map(|own| own.levels.clone()),
        missing: finer.as_ref().err().cloned(),
    };
    let study = Study {
        modes: model
            .trees
            .iter()
            .map(|tree| tree.equations.modes())
            .collect(),
        model: &model,
        finer: finer
            .as_ref()
            .ok()
            .map(|finer| (&finer.model, finer.model.inputs(), finer.model.outputs())),
        frequencies: &frequencies,
        accuracy,
    };
    let pairs: Vec<PairResponse> = pairs.iter().map(|pair| study.pair(*pair)).collect();
    Ok(FrequencyResponse {
        warnings: study.unbounded(&pairs),
        pairs,
        accuracy,
        judged_by,
        left_out: model.left_out.clone(),
        frequencies,
    })
}

/// The signals of these names; all where none are named.
fn chosen<'a, T>(
    names: &[String],
    all: &'a [T],
    (what, signal): (&str, fn(&T) -> &Signal),
    faults: &mut Vec<Fault>,
) -> Vec<&'a T> {
    if names.is_empty() {
        return all.iter().collect();
    }
    let mut found = Vec::new();
    for name in names {
        match all.iter().find(|one| signal(one).name == *name) {
            Some(one) => found.push(one),
            None => {
                let known = || all.iter().map(|one| signal(one).name.as_str());
                let hint = did_you_mean(name, known());
                let hint =
                    hint.unwrap_or_else(|| format!("there are {}", quoted_list(known(), "and")));
                let message = format!("there is no {what} `{name}`");
                faults.push(Fault::new(format!("--{what}"), message, hint));
            }
        }
    }
    found
}

/// What all pairs are computed from.
struct Study<'s> {
    model: &'s LinearModel,
    /// The modes of each tree.
    modes: Vec<Option<Vec<TreeMode>>>,
    /// The finer model with its signals.
    finer: Option<(&'s LinearModel, Vec<InputSignal>, Vec<OutputSignal>)>,
    frequencies: &'s [f64],
    accuracy: f64,
}

impl Study<'_> {
    fn pair(&self, (input, output): (&InputSignal, &OutputSignal)) -> PairResponse {
        let exact = |at: f64| match self.undamped_at(input.tree, at) {
            Some(_) => None,
            None => self.model.transfer(input, output, at),
        };
        let values: Vec<Option<C>> = self.frequencies.iter().map(|&at| exact(at)).collect();
        let error = |at: f64, value: Option<C>| self.error((input, output), at, value?);
        let errors: Vec<Option<f64>> = (self.frequencies.iter().zip(&values))
            .map(|(&at, value)| error(at, *value))
            .collect();
        let within = |error: &Option<f64>| error.is_none_or(|error| error <= self.accuracy);
        let wrong = errors.iter().position(|error| !within(error));
        let judged = self.finer.is_some();
        let right_up_to = match wrong {
            _ if !judged => None,
            None => self.frequencies.last().copied(),
            Some(0) => None,
            Some(place) => {
                let ends = [self.frequencies[place - 1], self.frequencies[place]];
                Some(last_within(ends, &|at| within(&error(at, exact(at)))))
            }
        };
        let each = |of: fn(C) -> f64| values.iter().map(|value| value.map(of)).collect();
        PairResponse {
            input: input.signal.clone(),
            output: output.signal.clone(),
            unit: unit_of_gain(&input.signal.unit, &output.signal.unit),
            re: each(|one| one.re),
            im: each(|one| one.im),
            gain: each(|one| one.norm()),
            phase: each(phase),
            error: errors,
            right_up_to,
            right_everywhere: judged && wrong.is_none(),
            peaks: self.peaks((input, output)),
        }
    }

    /// The relative error of the model, by the finer one.
    fn error(
        &self,
        (input, output): (&InputSignal, &OutputSignal),
        at: f64,
        value: C,
    ) -> Option<f64> {
        let (model, inputs, outputs) = self.finer.as_ref()?;
        let input = inputs.iter().find(|one| one.signal == input.signal)?;
        let output = outputs.iter().find(|one| one.signal == output.signal)?;
        let better = model.transfer(input, output, at)?;
        let difference = (better - value).norm();
        Some(match difference == 0.0 {
            true => 0.0,
            false => difference / better.norm(),
        })
    }

    /// The number of the undamped mode of a tree at a frequency.
    fn undamped_at(&self, tree: usize, at: f64) -> Option<usize> {
        let modes = self.modes[tree].as_ref()?.iter();
        let omega = TAU * at;
        let near = |mode: &TreeMode| {
            mode.damping_ratio == 0.0 && (mode.frequency - omega).abs() <= AT_POLE * omega
        };
        modes
            .enumerate()
            .find(|(_, mode)| near(mode))
            .map(|(number, _)| number + 1)
    }

    /// The peaks of a gain: between the frequencies, and at modes between them.
    fn peaks(&self, (input, output): (&InputSignal, &OutputSignal)) -> Vec<ResponsePeak> {
        let (Some(&low), Some(&high)) = (self.frequencies.first(), self.frequencies.last()) else {
            return Vec::new();
        };
        let modes = self.modes[input.tree].as_deref().unwrap_or(&[]);
        let mut places = self.frequencies.to_vec();
        for mode in modes.iter().filter(|mode| mode.damping_ratio < 1.0) {
            let at = mode.frequency / TAU;
            let beside = mode.damping_ratio.max(1e-6);
            let own = [1.0 - beside, 1.0, 1.0 + beside].map(|factor| factor * at);
            places.extend(own.into_iter().filter(|place| (low..=high).contains(place)));
        }
        places.sort_by(f64::total_cmp);
        places.dedup();
        let transfer = |at: f64| match self.undamped_at(input.tree, at) {
            Some(_) => None,
            None => self.model.transfer(input, output, at),
        };
        let mut gain = |at: f64| transfer(at).map_or(f64::MAX, |value| value.norm());
        let found = peaks(&places, &mut gain).into_iter();
        let nearest = |at: f64| {
            let distance = |place: &usize| (modes[*place].frequency / TAU - at).abs();
            (0..modes.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))
        };
        let peak = |at: f64| {
            let mode = nearest(at);
            // An undamped mode has no other peak beside it.
            let undamped = mode.filter(|&mode| {
                modes[mode].damping_ratio == 0.0
                    && (modes[mode].frequency / TAU - at).abs() <= 1e-6 * at
            });
            let value = match undamped {
                Some(_) => None,
                None => transfer(at),
            };
            ResponsePeak {
                frequency: undamped.map_or(at, |mode| modes[mode].frequency / TAU),
                gain: value.map(|one| one.norm()),
                phase: value.map(phase),
                mode: mode.map(|mode| mode + 1),
            }
        };
        found.map(peak).collect()
    }

    /// What to say of frequencies at which a response is unbounded.
    fn unbounded(&self, pairs: &[PairResponse]) -> Vec<String> {
        let mut said = Vec::new();
        for (place, &at) in self.frequencies.iter().enumerate() {
            if pairs.iter().all(|pair| pair.gain[place].is_some()) {
                continue;
            }
            let trees = 0..self.modes.len();
            let mode = trees.filter_map(|tree| self.undamped_at(tree, at)).next();
            let which = mode.map_or(String::new(), |mode| format!(" of mode {mode}"));
            said.push(format!(
                "at {at} Hz the response is unbounded: this is the undamped frequency{which}"
            ));
        }
        said
    }
}

/// A phase in (−π, π].
fn phase(value: C) -> f64 {
    let phase = value.im.atan2(value.re);
    match phase <= -std::f64::consts::PI {
        true => std::f64::consts::PI,
        false => phase,
    }
}

/// The greatest place that is within, between one that is and one that is not.
fn last_within([mut within, mut beyond]: [f64; 2], is_within: &dyn Fn(f64) -> bool) -> f64 {
    for _ in 0..40 {
        let middle = 0.5 * (within + beyond);
        match is_within(middle) {
            true => within = middle,
            false => beyond = middle,
        }
    }
    within
}

/// The unit of output over input: `N m/rad`; 1 where both are the same.
fn unit_of_gain(input: &str, output: &str) -> String {
    let per = |unit: &str| match unit.contains([' ', '/']) {
        true => format!("({unit})"),
        false => unit.to_owned(),
    };
    match output.strip_prefix(input) {
        Some("") => "1".to_owned(),
        // rad/s over rad.
        Some(rest) if rest.starts_with('/') => format!("1{rest}"),
        _ => format!("{output}/{}", per(input)),
    }
}
