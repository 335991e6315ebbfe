//! What happens over a period of a steady motion: works of the drives, extremes, events.
//!
//! The period is integrated from the state that shooting found, by a general method, and
//! recorded as a run is. Where shooting followed the motion in closed form, the return of the
//! state is a check of it by another method.

use super::map::integrate_from;
use super::shooting::relative_distance;
use super::sink::Last;
use crate::budget::Budget;
use crate::dynamics::energy::EnergyAudit;
use crate::dynamics::integrate::{Dynamics, Method, Modes, Sink, SwitchEvent};
use crate::dynamics::record::{
    ObjectFigures, Observer, Quantity, Recorder, RecorderSettings, RunRecord, SwitchRow, Tee,
};
use crate::dynamics::system::System;
use crate::math::polynomial::Step;
use crate::math::quadrature::rule;
use crate::studies::check::Check;
use crate::studies::judgement::Judgement;
use serde::Serialize;

/// What happens over a period.
#[derive(Clone, Debug, Serialize)]
pub struct OverPeriod {
    /// The period of the whole (s).
    pub period: f64,
    /// The method by which it was integrated.
    pub method: Method,
    /// Work of each drive.
    pub drives: Vec<DriveWork>,
    /// All works, with what becomes of them.
    pub works: Works,
    /// Extremes of each object.
    pub objects: Vec<Extremes>,
    /// Separations, closures and impacts in order of time.
    pub events: Vec<Event>,
    /// Checks with their bounds.
    pub checks: Vec<Check>,
    /// The verdict on the pairs: whether one opens over the period.
    #[serde(skip)]
    pub pairs: Judgement,
}

/// Work of a drive over a period.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DriveWork {
    /// The drive.
    pub id: String,
    /// Work that it does on the mechanism (J).
    pub work: f64,
    /// Its mean power (W).
    pub mean_power: f64,
}

/// Works over a period (J). Over a period the energy that is stored does not change.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Works {
    /// Of prescribed drives.
    pub drives: f64,
    /// Of all loads, motors among them.
    pub loads: f64,
    /// Lost in links, contacts and dampers.
    pub dissipated: f64,
    /// Lost in impacts of rigid contacts.
    pub impacts: f64,
}

/// Extremes of an object over a period.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Extremes {
    /// The object.
    pub id: String,
    /// Unit of displacements.
    pub unit: &'static str,
    /// Unit of forces.
    pub force_unit: &'static str,
    /// Greatest δ.
    pub delta_max: f64,
    /// Least δ.
    pub delta_min: f64,
    /// Greatest speed.
    pub peak_speed: f64,
    /// Greatest magnitude of the reaction of link 1; of a drive, of its moment.
    pub peak_reaction: f64,
    /// Greatest contact force of its pair or stop.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_contact_force: Option<f64>,
}

/// A separation, a closure or an impact.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Event {
    /// Time since the start of the period (s).
    pub time: f64,
    /// The object.
    pub object: String,
    /// `opens`, `closes` or `impact`.
    pub what: &'static str,
    /// `lower` or `upper` flank.
    pub flank: &'static str,
    /// Speed of approach or parting.
    pub speed: f64,
    /// Its unit.
    pub unit: &'static str,
}

/// Tolerance that the balance of the energies is judged by.
const TOLERANCE: f64 = 1e-9;

/// Greatest distance of the end of the period from its start, relative to the sizes of the
/// state's entries; as much greater as a disturbance grows.
pub(super) const RETURN: f64 = 1e-6;

impl OverPeriod {
    /// Integrates a period from a state; `greatest`: modulus of a multiplier, at least 1.
    ///
    /// # Errors
    /// Why the integration does not get to its end.
    pub(super) fn of(
        system: &System,
        method: Method,
        budget: Budget<'_>,
        state: &[f64],
        (period, greatest): (f64, f64),
    ) -> Result<Self, String> {
        let mut recorder = Recorder::new(system, settings(method, period));
        let mut works = DriveWorkSum::new(system);
        let mut last = Last::default();
        let modes = system.modes_at_start(state);
        let mut sinks: [&mut dyn Sink; 3] = [&mut recorder, &mut works, &mut last];
        let sink = &mut Tee(&mut sinks);
        integrate_from(system, method, budget, state, &modes, period, sink)?;
        let recorded = recorder.finish();
        if let Some(failure) = &recorded.failure {
            return Err(format!(
                "{} is no finite number at t = {} s",
                failure.what, failure.time
            ));
        }
        let away = relative_distance(
            &without_drive_turns(system, &last.y, state),
            state,
            system.scales(),
        );
        let works = works.finish(period);
        Ok(Self {
            period,
            method,
            checks: checks(&recorded.audit, &works, [away, RETURN * greatest]),
            works: Works {
                drives: recorded.audit.drives,
                loads: recorded.audit.loads,
                dissipated: recorded.audit.dissipated + recorded.audit.friction,
                impacts: recorded.audit.impacts,
            },
            drives: works.into_iter().map(|own| own.of).collect(),
            objects: extremes(system, &recorded),
            pairs: Judgement::of_objects(reported(system, &recorded)),
            events: recorded
                .record
                .switches
                .iter()
                .map(|row| event(system, row))
                .collect(),
        })
    }
}

fn reported<'r>(
    system: &System,
    recorded: &'r RunRecord,
) -> impl Iterator<Item = &'r ObjectFigures> {
    let all = system.model().objects.iter().zip(&recorded.figures);
    all.filter(|(part, _)| part.is_reported())
        .map(|(_, figures)| figures)
}

/// A state whose drives have turned on by a period, with them back where they were.
fn without_drive_turns(system: &System, end: &[f64], start: &[f64]) -> Vec<f64> {
    let model = system.model();
    let mut moved = end.to_vec();
    let drives = model.objects.iter().enumerate();
    for (object, _) in drives.filter(|(_, part)| part.is_drive()) {
        if let Some(rotor) = system.last_coordinate(object) {
            moved[rotor] = start[rotor];
        }
    }
    moved
}

fn settings(method: Method, period: f64) -> RecorderSettings {
    RecorderSettings {
        duration: period,
        samples: 0,
        listing: true,
        switch_rows: false,
        masses: false,
        closeups: false,
        // The whole period is steady.
        window: Some([0.0, period]),
        long_steps: matches!(method, Method::Taylor | Method::Radau),
        implicit: matches!(method, Method::Radau | Method::Rodas5p),
        tolerance: TOLERANCE,
        spans: Vec::new(),
        checked: false,
    }
}

fn checks(audit: &EnergyAudit, works: &[Worked], [away, bound]: [f64; 2]) -> Vec<Check> {
    let balance = EnergyAudit::bound(TOLERANCE);
    let prescribed: f64 = works
        .iter()
        .filter(|one| one.is_prescribed)
        .map(|one| one.of.work)
        .sum();
    let scale = audit.balance_scale();
    let apart = match (prescribed - audit.drives).abs() {
        0.0 => 0.0,
        apart => apart / scale,
    };
    [
        ("energy balance over a period", audit.error(), balance),
        ("works of the drives over a period", apart, balance),
        ("return of the state by integration", away, bound),
    ]
    .map(|(name, value, bound)| Check { name, value, bound })
    .into()
}

fn extremes(system: &System, recorded: &RunRecord) -> Vec<Extremes> {
    let parts = system.model().objects.iter().zip(&recorded.figures);
    let own = |(part, figures): (&crate::dynamics::model::ObjectPart, &ObjectFigures)| {
        let pair = figures.pair.as_ref().map(|pair| pair.max_contact_force);
        let stop = figures.stop.as_ref().map(|stop| stop.max_contact_force);
        Extremes {
            id: part.id.clone(),
            unit: Quantity::Displacement.unit(part.coordinate),
            force_unit: Quantity::Reaction.unit(part.coordinate),
            delta_max: figures.delta_max,
            delta_min: figures.delta_min,
            peak_speed: figures.peak_speed,
            peak_reaction: figures.peak_reaction,
            max_contact_force: pair.or(stop),
        }
    };
    parts
        .filter(|(part, _)| part.is_reported())
        .map(own)
        .collect()
}

fn event(system: &System, row: &SwitchRow) -> Event {
    let parts = &system.model().objects;
    let part = parts.iter().find(|part| part.id == row.object);
    Event {
        time: row.time,
        object: row.object.clone(),
        what: row.what,
        flank: row.flank,
        speed: row.speed,
        unit: part.map_or("", |part| Quantity::Speed.unit(part.coordinate)),
    }
}

/// Places of Gauss's rule in a part of a step, and parts of a step.
const PLACES: usize = 8;
const PARTS: u32 = 4;

/// Work of a drive.
struct Worked {
    object: usize,
    is_prescribed: bool,
    of: DriveWork,
}

/// Integrates the power of each drive, its moment by its speed, and adds its works in impacts.
struct DriveWorkSum<'s> {
    system: &'s System,
    observer: Observer<'s>,
    rule: Vec<(f64, f64)>,
    works: Vec<Worked>,
}

impl<'s> DriveWorkSum<'s> {
    fn new(system: &'s System) -> Self {
        let parts = system.model().objects.iter().enumerate();
        let drives = parts.filter(|(_, part)| part.is_drive());
        let works = drives.map(|(object, part)| Worked {
            object,
            is_prescribed: system.last_coordinate(object).is_none(),
            of: DriveWork {
                id: part.id.clone(),
                work: 0.0,
                mean_power: 0.0,
            },
        });
        Self {
            system,
            observer: Observer::new(system),
            rule: rule(PLACES),
            works: works.collect(),
        }
    }

    fn finish(mut self, period: f64) -> Vec<Worked> {
        for own in &mut self.works {
            own.of.mean_power = own.of.work / period;
        }
        self.works
    }
}

impl Sink for DriveWorkSum<'_> {
    fn start(&mut self, _: f64, _: &[f64], _: &Modes) {}

    fn step(&mut self, step: &Step<'_>, modes: &Modes) {
        let part = step.end / f64::from(PARTS);
        for number in 0..PARTS {
            for (place, weight) in &self.rule {
                let s = part * (f64::from(number) + place);
                let states = self.observer.at(step, s, modes);
                for own in &mut self.works {
                    let drive = &states[own.object];
                    own.of.work += weight * part * step.length * drive.reaction * drive.speed;
                }
            }
        }
    }

    fn switch(&mut self, event: &SwitchEvent<'_>) {
        for (object, work) in self.system.works_in_impact(event) {
            let own = self.works.iter_mut().filter(|own| own.object == object);
            own.for_each(|own| own.of.work += work);
        }
    }
}
