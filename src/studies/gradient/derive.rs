//! From parameters and results to derivatives.

use super::figures::{self, Found};
use super::lowered::{Lowered, Place, Tree};
use super::stencil::{self, RowDerivatives, Side};
use super::{Derivative, DerivativeVerdict, FigureGradient, Gradient, Parameter};
use crate::dynamics::model::owner_of;
use crate::dynamics::record::Figures;
use crate::exact::ExactRun;
use crate::exact::sensitivity::{EventTimes, Question, Unfollowed, results};
use crate::fault::Fault;
use crate::math::number::{Duals, Number};
use crate::studies::run::{RunResult, run};
use crate::studies::{Control, RunSettings};
use crate::units::shown;
use std::cmp::Ordering;

/// Condition above which fewer digits are left than are asked for.
const UNDETERMINED: f64 = 1e10;

/// Share of its size in which a value may differ from that of the run.
const AGREEMENT: f64 = 1e-8;

/// Relative change of a parameter within which another place that takes over counts.
const TAKEOVER: f64 = 1e-9;

/// Rounding of a value, relative.
const ROUNDING: f64 = 1e-12;

/// Part of an elasticity that no value in double precision shows.
const NEGLIGIBLE: f64 = 1e-12;

/// Parameters by which a motion is differentiated at once.
const TOGETHER: usize = 6;

/// Slopes at several places of one greatest value that count as one.
const ONE_SLOPE: f64 = 1e-6;

/// Scene and question.
pub(crate) struct Subject<'s> {
    /// The parameters.
    pub(crate) parameters: Vec<Parameter>,
    /// Addresses of the results, with their SI units.
    pub(crate) figures: Vec<(String, String)>,
    /// The scene.
    pub(crate) base: Place,
    /// The scene at other values of the parameters; `None`: it cannot be.
    pub(crate) at: &'s dyn Fn(&[f64]) -> Option<Place>,
    /// How long it may take.
    pub(crate) control: &'s Control<'s>,
    /// Whether derivatives are compared with differences; `None`: where that is cheap.
    pub(crate) check: Option<bool>,
}

/// Derivatives before they are checked, with what the check needs.
pub(super) struct Unchecked {
    pub(super) found: Gradient,
    pub(super) rows: Vec<Option<RowDerivatives>>,
    pub(super) near: Vec<Change>,
}

/// Derivatives by the rule that is given, not checked as yet.
///
/// # Errors
/// As of [`super::gradient`].
pub(super) fn derivatives(
    subject: &Subject<'_>,
    events: EventTimes,
) -> Result<Unchecked, Vec<Fault>> {
    let lowered = Lowered::of(&subject.base, None)?;
    let base = base_run(&subject.base, subject.control)?;
    let rows: Vec<Option<RowDerivatives>> = (0..subject.parameters.len())
        .map(|number| row_derivatives(subject, &lowered, number))
        .collect();
    let settings = &subject.base.settings;
    let motions: Vec<Result<ExactRun, String>> = (lowered.trees.iter())
        .map(|tree| tree.run(lowered.end, settings, subject.control))
        .collect();
    let mut motion = DifferentiatedMotion {
        lowered: &lowered,
        runs: Vec::new(),
        rows: &rows,
        near: Vec::new(),
        events,
    };
    for found in motions {
        motion.runs.push(found.map_err(|why| vec![whole(&why)])?);
    }
    let mut raw = vec![RawFigure::default(); subject.figures.len()];
    match rows.len() {
        1 => motion.take::<1>(subject, 0, &mut raw)?,
        all => {
            for first in (0..all).step_by(TOGETHER) {
                motion.take::<TOGETHER>(subject, first, &mut raw)?;
            }
        }
    }
    let events = motion.runs.iter().map(|run| run.switches.len()).sum();
    let mut found = Gradient {
        parameters: subject.parameters.clone(),
        figures: Vec::with_capacity(raw.len()),
        events,
        check: None,
    };
    for (raw, (address, unit)) in raw.iter().zip(&subject.figures) {
        let judge = FigureAssessment {
            raw,
            rows: &rows,
            near: &motion.near,
            parameters: &subject.parameters,
        };
        found
            .figures
            .push(judge.figure(address, unit, &base.figures));
    }
    let near = motion.near;
    Ok(Unchecked { found, rows, near })
}

fn whole(why: &str) -> Fault {
    let message = format!("there are no derivatives of this run: {why}");
    Fault::new("", message, "compare runs with `dam compare`")
}

/// The run with its results.
pub(super) fn base_run(place: &Place, control: &Control<'_>) -> Result<RunResult, Vec<Fault>> {
    let settings = RunSettings {
        samples: 0,
        ..place.settings.clone()
    };
    let found = run(&place.system, &settings, control, &mut [])?;
    match found.is_complete() {
        true => Ok(found),
        false => Err(vec![whole("it does not come to its end")]),
    }
}

/// Derivatives of all numbers by a parameter; `None`: they have none.
fn row_derivatives(
    subject: &Subject<'_>,
    lowered: &Lowered,
    number: usize,
) -> Option<RowDerivatives> {
    let values: Vec<f64> = subject.parameters.iter().map(|one| one.value).collect();
    let at = |value: f64| {
        let mut moved = values.clone();
        moved[number] = value;
        let other = Lowered::of(&(subject.at)(&moved)?, Some(lowered)).ok()?;
        let values = || {
            other
                .numbers()
                .into_iter()
                .map(|number| number[0])
                .collect()
        };
        lowered.is_like(&other).then(values)
    };
    stencil::derivatives((values[number], &lowered.numbers()), &at)
}

/// A change of the sequence of events with its derivatives by all parameters.
#[derive(Clone, Debug)]
pub(super) struct Change {
    pub(super) value: f64,
    pub(super) slopes: Vec<f64>,
}

/// Time, value and derivatives of a result where it is reached.
type Reached = (f64, f64, Vec<f64>);

/// A result with its derivatives by all parameters, before it is judged.
#[derive(Clone, Debug, Default)]
pub(super) struct RawFigure {
    /// sign·greatest of the places; one place of a plain number.
    sign: f64,
    places: Vec<Reached>,
    /// Why there is nothing, and whether it has no derivative at all.
    nothing: Option<DerivativeVerdict>,
    /// A time at which events coincide.
    coincident: Option<f64>,
    /// True: rounding decides whether there is a contact.
    grazing: bool,
    /// A flank that is touched for an instant.
    touch: Option<Touched>,
}

/// A flank that is touched for an instant: the result if it is dipped into, where that differs.
#[derive(Clone, Debug)]
struct Touched {
    time: f64,
    /// Derivatives of the clearance: the flank is dipped into where it falls.
    slopes: Vec<f64>,
    /// `None`: the derivatives have no bound, or there are several such places.
    dipped: Option<Box<RawFigure>>,
}

struct DifferentiatedMotion<'m> {
    lowered: &'m Lowered,
    runs: Vec<ExactRun>,
    rows: &'m [Option<RowDerivatives>],
    near: Vec<Change>,
    events: EventTimes,
}

impl DifferentiatedMotion<'_> {
    /// Adds the derivatives by K parameters from the first on.
    fn take<const K: usize>(
        &mut self,
        subject: &Subject<'_>,
        first: usize,
        raw: &mut [RawFigure],
    ) -> Result<(), Vec<Fault>> {
        let slope = |number: usize| -> [f64; K] {
            std::array::from_fn(|k| {
                let row = self.rows.get(first + k).and_then(Option::as_ref);
                row.map_or(0.0, |row| row.values[number])
            })
        };
        let end = Duals {
            value: self.lowered.end,
            derivatives: slope(self.lowered.numbers().len() - 1),
        };
        let mut near = Vec::new();
        for (tree, run) in self.lowered.trees.iter().zip(&self.runs) {
            let numbers = tree.first..tree.first + tree.numbers.len();
            let derivatives: Vec<[f64; K]> = numbers.map(slope).collect();
            let question = Question {
                problem: &tree.problem,
                table: tree.table.as_ref(),
                run,
                derivatives: &derivatives,
                end,
                events: self.events,
                touches: &[],
            };
            let goes_on = || !subject.control.is_spent();
            let found = match results(&question, &goes_on) {
                Ok(found) => Ok(found),
                Err(Unfollowed::Event(why)) => Err(why),
                Err(Unfollowed::Kind(why)) => return Err(vec![whole(&why)]),
                Err(Unfollowed::Ended) => return Err(vec![whole("it was ended")]),
            };
            let mut dipped = None;
            if let Ok(found) = &found {
                near.extend(found.near.iter().copied());
                if let [(touch, _)] = found.touches[..]
                    && tree.problem.masses[touch.mass].restitution.is_none()
                {
                    let touches = [touch];
                    let dips = Question {
                        touches: &touches,
                        ..question
                    };
                    dipped = results(&dips, &goes_on).ok();
                }
            }
            for (own, (address, _)) in raw.iter_mut().zip(&subject.figures) {
                let (id, name) = owner_of(address, |id| tree.objects.iter().any(|one| one == id));
                let Some(object) = tree.objects.iter().position(|one| one == id) else {
                    continue;
                };
                match &found {
                    Err(why) => {
                        own.nothing = Some(DerivativeVerdict::NotDetermined { why: why.clone() })
                    }
                    Ok(found) => {
                        own.coincident = found.coincident;
                        own.grazing = run.grazing > 0;
                        own.add(figures::figure(name, &found.objects[object], end), first);
                        let Some((touch, clearance)) = found.touches.first() else {
                            continue;
                        };
                        let touched = own.touch.get_or_insert_with(|| Touched {
                            time: touch.time,
                            slopes: Vec::new(),
                            dipped: dipped.is_some().then(Box::default),
                        });
                        touched.slopes.extend(clearance.derivatives);
                        if let (Some(raw), Some(dips)) = (&mut touched.dipped, &dipped) {
                            raw.add(figures::figure(name, &dips.objects[object], end), first);
                        }
                    }
                }
            }
        }
        self.add_near(near, first);
        Ok(())
    }

    fn add_near<const K: usize>(&mut self, near: Vec<Duals<K>>, first: usize) {
        if first == 0 {
            self.near = (near.iter())
                .map(|one| Change {
                    value: one.value,
                    slopes: Vec::with_capacity(self.rows.len()),
                })
                .collect();
        }
        let count = (self.rows.len() - first).min(K);
        // (The motion is the same whatever it is differentiated by.)
        for (own, found) in self.near.iter_mut().zip(near) {
            own.slopes.extend(&found.derivatives[..count]);
        }
    }
}

impl RawFigure {
    fn add<const K: usize>(&mut self, found: Option<Found<K>>, first: usize) {
        let (sign, places) = match found {
            Some(Found::Number(number)) => (0.0, vec![(0.0, number)]),
            Some(Found::Greatest(sign, places)) => (sign, places),
            Some(Found::Nothing(why)) => {
                let why = why.to_owned();
                self.nothing = Some(DerivativeVerdict::NotApplicable { why });
                return;
            }
            None => {
                let why = "its derivatives are not found here".to_owned();
                self.nothing = Some(DerivativeVerdict::NotApplicable { why });
                return;
            }
        };
        self.sign = sign;
        if first == 0 {
            self.places = (places.iter())
                .map(|(time, value)| (*time, value.value(), Vec::new()))
                .collect();
        }
        for (own, (_, value)) in self.places.iter_mut().zip(places) {
            own.2.extend(value.derivatives);
        }
    }

    /// The value.
    fn value(&self) -> Option<f64> {
        let values = self.places.iter().map(|place| place.1);
        let best = values.fold(f64::NEG_INFINITY, f64::max);
        let sign = if self.sign == 0.0 { 1.0 } else { self.sign };
        best.is_finite().then_some(sign * best)
    }

    /// Derivatives by a parameter of the value p with it decreasing and increasing.
    fn slopes(&self, number: usize, p: f64) -> [f64; 2] {
        let own = self.slopes_without_dips(number, p);
        let Some(Touched {
            slopes,
            dipped: Some(dipped),
            ..
        }) = &self.touch
        else {
            return own;
        };
        let dips = dipped.slopes_without_dips(number, p);
        let [below, above] = match slopes[number].total_cmp(&0.0) {
            Ordering::Greater => [dips[0], own[1]],
            Ordering::Less => [own[0], dips[1]],
            Ordering::Equal => own,
        };
        match (below - above).abs() <= ONE_SLOPE * below.abs().max(above.abs()) {
            true => [above; 2],
            false => [below, above],
        }
    }

    fn slopes_without_dips(&self, number: usize, p: f64) -> [f64; 2] {
        if self.sign == 0.0 {
            return [self.places[0].2[number]; 2];
        }
        let better = |a: &&Reached, b: &&Reached| a.1.total_cmp(&b.1);
        let Some((_, best, slopes)) = self.places.iter().max_by(better) else {
            return [f64::NAN; 2];
        };
        let rounding = ROUNDING * best.abs();
        let own = slopes[number];
        let (mut least, mut greatest) = (own, own);
        let size = if p == 0.0 { 1.0 } else { p.abs() };
        for (_, value, slopes) in &self.places {
            // Another place takes over within a hair of the parameter, and that matters.
            let change = (slopes[number] - own).abs() * size;
            if change > NEGLIGIBLE * best.abs() && best - value <= TAKEOVER * change + rounding {
                least = least.min(slopes[number]);
                greatest = greatest.max(slopes[number]);
            }
        }
        if greatest - least <= ONE_SLOPE * greatest.abs().max(least.abs()) {
            return [self.sign * own; 2];
        }
        // Of the greatest of several, the steepest wins with the parameter increasing.
        [self.sign * least, self.sign * greatest]
    }
}

struct FigureAssessment<'j> {
    raw: &'j RawFigure,
    rows: &'j [Option<RowDerivatives>],
    near: &'j [Change],
    parameters: &'j [Parameter],
}

impl FigureAssessment<'_> {
    fn figure(&self, address: &str, unit: &str, run: &Figures) -> FigureGradient {
        let told = run.value(address).ok();
        let own = match self.raw.nothing {
            Some(_) => None,
            None => self.raw.value(),
        };
        let value = told.or(own);
        let differs = match (told, own) {
            (Some(told), Some(own)) => {
                let scale = run.common_scale(run, address).max(told.abs());
                (told - own).abs() > AGREEMENT * scale
            }
            _ => false,
        };
        let by = (0..self.parameters.len()).map(|number| {
            let nothing = |verdict: DerivativeVerdict| Derivative {
                verdict,
                derivative: None,
                elasticity: None,
                agrees_to: None,
                sequence_changes_at: self.sequence_changes_at(number),
            };
            if let Some(verdict) = &self.raw.nothing {
                return nothing(verdict.clone());
            }
            if differs {
                let [told, own] = [told, own].map(|one| shown(one.unwrap_or(f64::NAN), 10));
                let why = format!("the run finds {told}, the motion with derivatives {own}");
                return nothing(DerivativeVerdict::NotDetermined { why });
            }
            self.derivative(number, value.unwrap_or(0.0))
        });
        FigureGradient {
            figure: address.to_owned(),
            value,
            unit: unit.to_owned(),
            by: by.collect(),
        }
    }

    fn derivative(&self, number: usize, value: f64) -> Derivative {
        let mut found = Derivative {
            verdict: DerivativeVerdict::Exact,
            derivative: None,
            elasticity: None,
            agrees_to: None,
            sequence_changes_at: self.sequence_changes_at(number),
        };
        let Some(row) = &self.rows[number] else {
            let why = "the equations of motion change abruptly here, or cannot be stated beside it";
            found.verdict = DerivativeVerdict::NotDifferentiable {
                why: why.to_owned(),
            };
            return found;
        };
        if let Some(why) = self.obstacle() {
            found.verdict = DerivativeVerdict::NotDifferentiable { why };
            return found;
        }
        let p = self.parameters[number].value;
        let change = nearest(self.near, |slopes| slopes[number]);
        if change.is_some_and(|step| step.abs() <= TAKEOVER * p.abs()) {
            let why = "the sequence of events changes right here".to_owned();
            found.verdict = DerivativeVerdict::NotDifferentiable { why };
            return found;
        }
        let [below, above] = self.raw.slopes(number, p);
        let size = below.abs().max(above.abs());
        let condition = (p * size / value).abs();
        if !size.is_finite() || (value != 0.0 && condition > UNDETERMINED) {
            let condition = shown(condition, 2);
            let why = format!("its condition number is {condition}: rounding decides its digits");
            found.verdict = DerivativeVerdict::NotDetermined { why };
            return found;
        }
        let (verdict, derivative) = match row.side {
            Side::Both if below == above => (DerivativeVerdict::Exact, Some(above)),
            Side::Both => (both_sides(Some(below), Some(above)), None),
            Side::Above => (both_sides(None, Some(above)), Some(above)),
            Side::Below => (both_sides(Some(below), None), Some(below)),
        };
        found.verdict = verdict;
        found.derivative = derivative;
        found.elasticity = derivative
            .filter(|_| value != 0.0)
            .map(|slope| p * slope / value);
        found
    }

    /// Why nothing can be differentiated at these values.
    fn obstacle(&self) -> Option<String> {
        if let Some(time) = self.raw.coincident {
            let time = shown(time, 7);
            return Some(format!("two events coincide at t = {time} s"));
        }
        if let Some(touch) = self
            .raw
            .touch
            .as_ref()
            .filter(|touch| touch.dipped.is_none())
        {
            let time = shown(touch.time, 7);
            return Some(format!("a contact is just touched at t = {time} s"));
        }
        let why = "a contact is touched without being closed, as far as rounding can tell";
        self.raw.grazing.then(|| why.to_owned())
    }

    /// The nearest value at which the sequence of events changes.
    fn sequence_changes_at(&self, number: usize) -> Option<f64> {
        let p = self.parameters[number].value;
        let step = nearest(self.near, |slopes| slopes[number])?;
        (p == 0.0 || step.abs() <= p.abs()).then_some(p + step)
    }
}

fn both_sides(below: Option<f64>, above: Option<f64>) -> DerivativeVerdict {
    DerivativeVerdict::OneSided { below, above }
}

/// The least step in a direction after which a change is met, to first order.
pub(super) fn nearest(near: &[Change], slope: impl Fn(&[f64]) -> f64) -> Option<f64> {
    let steps = near.iter().map(|one| -one.value / slope(&one.slopes));
    let steps = steps.filter(|step| step.is_finite() && *step != 0.0);
    steps.min_by(|a, b| a.abs().total_cmp(&b.abs()))
}

/// Values of results at other values of the parameters, with the number of events; `None`: there
/// is no such run.
pub(super) fn values_at(
    subject: &Subject<'_>,
    values: &[f64],
) -> Option<(Vec<Option<f64>>, usize)> {
    let place = (subject.at)(values)?;
    let found = base_run(&place, subject.control).ok()?;
    let value = |(address, _): &(String, String)| {
        let told = found.figures.value(address).ok();
        told.or_else(|| plain_value(subject, &place, address))
    };
    let all = subject.figures.iter().map(value).collect();
    Some((all, usize::try_from(found.figures.run.switches).ok()?))
}

/// A result that a run does not show.
fn plain_value(subject: &Subject<'_>, place: &Place, address: &str) -> Option<f64> {
    let lowered = Lowered::of(place, None).ok()?;
    let mut holder = lowered.trees.iter().filter_map(|tree: &Tree| {
        let (id, name) = owner_of(address, |id| tree.objects.iter().any(|one| one == id));
        let object = tree.objects.iter().position(|one| one == id)?;
        let run = tree
            .run(lowered.end, &place.settings, subject.control)
            .ok()?;
        let question = Question::<1> {
            problem: &tree.problem,
            table: tree.table.as_ref(),
            run: &run,
            derivatives: &[],
            end: lowered.end.into(),
            events: EventTimes::Moving,
            touches: &[],
        };
        let found = results(&question, &|| !subject.control.is_spent()).ok()?;
        let mut raw = RawFigure::default();
        raw.add(
            figures::figure(name, &found.objects[object], question.end),
            0,
        );
        raw.value()
    });
    holder.next()
}
