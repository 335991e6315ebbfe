//! The contact of a follower with its elasticity, by runs of the dynamic model: its least force in
//! the steady motion, and the preload that keeps it closed.

use super::closing_spring::ClosingLoads;
use super::force::ElasticFigures;
use super::speed_search::SpeedSearch;
use crate::dynamics::integrate::Stop;
use crate::dynamics::model::{Closure, Model, Span, SpanAxis, SpanFigure};
use crate::dynamics::record::drive_cycle;
use crate::dynamics::system::System;
use crate::dynamics::trajectory::Trajectory;
use crate::fault::Fault;
use crate::kinematics::cam::At;
use crate::studies::demand::Demand;
use crate::studies::document::stop_in_words;
use crate::studies::run::{Motion, motion};
use crate::studies::{Control, RunSettings};
use std::f64::consts::TAU;

/// Fewest cycles of a run, so that the last one can be taken for steady.
const CYCLES: f64 = 4.0;
/// Most cycles.
const MOST_CYCLES: f64 = 1000.0;
/// Share of the greatest contact force by which its least and greatest value may differ between
/// the last two cycles of a steady motion.
const STEADY: f64 = 1e-6;
/// Most times that a preload is raised to close the contact.
const MOST_RAISES: usize = 8;
/// Share of the least contact force by which it may differ from a straight line over the preload.
const STRAIGHT: f64 = 1e-3;

/// Contact force along the displacement of a follower in the steady motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteadyForce {
    /// Least force (N or N·m) and the angle of the cam; 0 while an elastic follower is off its
    /// cam, negative if a rigid one would be.
    pub least: At,
    /// Greatest force.
    pub greatest: f64,
}

/// Why there is no result.
#[derive(Clone, Debug, PartialEq)]
pub enum Missing {
    /// The run was ended from outside.
    Interrupted,
    /// What is wrong with the question or the run.
    Refused(Vec<Fault>),
}

/// The contact of an object in runs of its scene.
#[derive(Clone, Copy)]
pub struct ElasticContact<'s> {
    /// The system.
    pub system: &'s System,
    /// Index of the object in its model.
    pub object: usize,
    /// Settings of the scene's run.
    pub settings: &'s RunSettings,
    /// How long the runs may take.
    pub control: &'s Control<'s>,
}

impl ElasticContact<'_> {
    pub(super) fn model(&self) -> &Model {
        self.system.model()
    }

    pub(super) fn id(&self) -> &str {
        &self.model().objects[self.object].id
    }

    fn refusal(&self, why: impl Into<String>) -> Vec<Fault> {
        vec![Fault::new(self.id(), why.into(), "")]
    }

    pub(super) fn refused(&self, why: impl Into<String>) -> Missing {
        Missing::Refused(self.refusal(why))
    }

    fn cycle(&self) -> Result<f64, Vec<Fault>> {
        drive_cycle(self.model()).map_err(|why| {
            let hint = "give the drive a constant speed";
            vec![Fault::new(self.id(), why, hint)]
        })
    }

    /// Whole cycles as long as the scene's run, and enough of them.
    fn cycles(&self, cycle: f64) -> f64 {
        let cycles = (self.settings.duration / cycle * (1.0 - 1e-12)).ceil();
        cycles.clamp(CYCLES, MOST_CYCLES)
    }

    pub(super) fn run_of(&self, cycle: f64, cycles: f64) -> RunSettings {
        RunSettings {
            duration: cycle * cycles,
            samples: 100,
            window: None,
            spans: Vec::new(),
            ..self.settings.clone()
        }
    }

    /// The contact force in the steady motion: in the last cycle of a run that is prolonged until
    /// its last two cycles agree, or that opens in both after the most cycles.
    ///
    /// # Errors
    /// The run was ended from outside, has no start or no cycle, stops, or comes to no steady
    /// motion.
    pub fn force(&self) -> Result<SteadyForce, Missing> {
        let cycle = self.cycle().map_err(Missing::Refused)?;
        let mut cycles = self.cycles(cycle);
        loop {
            let (before, last) = self.last_cycles(cycle, cycles)?;
            let within = STEADY * last.greatest.abs();
            let now = [last.least.value, last.greatest];
            // Both: while the start dies away a follower may open in turn after turn, its least
            // force being zero in all of them.
            if before
                .iter()
                .zip(now)
                .all(|(before, now)| (before - now).abs() <= within)
            {
                return Ok(last);
            }
            if cycles >= MOST_CYCLES {
                // It bounces to the end, though never twice alike.
                if before[0] == 0.0 && now[0] == 0.0 {
                    return Ok(last);
                }
                return Err(self.refused(format!(
                    "its contact force does not repeat from turn to turn after {cycles} turns: it \
                     has no steady margin"
                )));
            }
            cycles = (2.0 * cycles).min(MOST_CYCLES);
        }
    }

    /// The least and greatest force of the cycle before the last, and the forces of the last.
    fn last_cycles(&self, cycle: f64, cycles: f64) -> Result<([f64; 2], SteadyForce), Missing> {
        let mut settings = self.run_of(cycle, cycles);
        let end = settings.duration;
        let span = |figure: &str, from: f64, to: f64| self.span(figure, [from, to]);
        settings.spans = vec![
            span("pair.margin", end - 2.0 * cycle, end - cycle),
            span("pair.margin", end - cycle, end),
            span("pair.max_contact_force", end - 2.0 * cycle, end - cycle),
            span("pair.max_contact_force", end - cycle, end),
        ];
        let found = self.motion(&settings)?;
        let value = |index: usize| {
            let address = &settings.spans[index].address;
            let known = found.recorded.spans.get(address).copied().flatten();
            known.ok_or_else(|| self.refused("its contact force is not known in the last turn"))
        };
        let least = value(1)?;
        let phi = self.angle_at(least.time);
        let force = SteadyForce {
            least: At {
                value: 0.0 + least.value,
                phi,
            },
            greatest: value(3)?.value,
        };
        Ok(([value(0)?.value, value(2)?.value], force))
    }

    /// A figure of the object within a span of time (s).
    pub(super) fn span(&self, figure: &str, [from, to]: [f64; 2]) -> SpanFigure {
        SpanFigure {
            address: format!("{figure} {from}"),
            figure: format!("{}.{figure}", self.id()),
            span: Span {
                axis: SpanAxis::Time,
                from,
                to,
            },
        }
    }

    pub(super) fn motion(&self, settings: &RunSettings) -> Result<Motion, Missing> {
        let found = motion(
            self.system,
            settings,
            Demand::EVERYTHING,
            self.control,
            &mut [],
        );
        let found = found.map_err(Missing::Refused)?;
        match &found.outcome.stop {
            Stop::Interrupted | Stop::WallClock { .. } => Err(Missing::Interrupted),
            Stop::Complete => match found.reason_for_doubt(settings) {
                None => Ok(found),
                Some(why) => Err(self.refused(format!("its run is not to be trusted: {why}"))),
            },
            stop => Err(self.refused(stop_in_words(stop).1)),
        }
    }

    /// Angle of the cam (rad) within a turn.
    fn angle_at(&self, time: f64) -> f64 {
        let model = self.model();
        let driver = model.objects[self.object].driver();
        let node = driver.and_then(|driver| model.objects[driver].nodes.last());
        let motion = node.and_then(|&node| Trajectory::of(model, node));
        motion.map_or(f64::NAN, |motion| motion.at(time).value.rem_euclid(TAU))
    }

    /// The same contact in a changed model.
    pub(super) fn of<'t>(&'t self, system: &'t System) -> ElasticContact<'t> {
        ElasticContact { system, ..*self }
    }

    /// Margin and preload at a speed of the cam (rad/s); `None`: ended from outside.
    pub fn figures_at(&self, speed: f64) -> Option<ElasticFigures> {
        let mut found = ElasticFigures {
            margin: None,
            preload: None,
            missing: Vec::new(),
        };
        let search = SpeedSearch::of_scene(self.model(), self.object);
        let changed = search.map_err(|why| self.refused(why)).and_then(|search| {
            let is_own = (search.start - speed.abs()).abs() <= 1e-12 * search.start;
            match is_own {
                true => Ok(None),
                false => self
                    .system_of(search.model_at(self.model(), speed.abs()))
                    .map(Some),
            }
        });
        let mut take = |result: Result<f64, Missing>| match result {
            Ok(value) => Some(Some(value)),
            Err(Missing::Interrupted) => None,
            Err(Missing::Refused(faults)) => {
                found
                    .missing
                    .extend(faults.into_iter().map(|fault| fault.message));
                Some(None)
            }
        };
        let system = match changed {
            Ok(system) => system,
            Err(missing) => {
                take(Err(missing))?;
                return Some(found);
            }
        };
        let contact = system.as_ref().map_or(*self, |system| self.of(system));
        let mut margin = None;
        take(
            contact
                .force()
                .map(|force| margin.insert(force.least).value),
        )?;
        let preload = take(contact.preload_needed())?;
        let has = ClosingLoads::of(self.model(), self.object).map(|spring| spring.preload);
        if let (Some(At { value: 0.0, .. }), Some(needed), Ok(has)) = (&margin, preload, has)
            && has > needed
        {
            found.missing.push(
                "whether the contact closes from another start: with this preload closed contact \
                 is a steady motion, and so is the bouncing of this run"
                    .to_owned(),
            );
        }
        found.margin = margin;
        found.preload = preload;
        Some(found)
    }

    pub(super) fn system_of(&self, model: Model) -> Result<System, Missing> {
        System::new(model).map_err(Missing::Refused)
    }

    /// The least preload of the closing spring (N or N·m) with which closed contact is a steady
    /// motion, at the speed of the scene. With little damping another one, that bounces, may stand
    /// beside it.
    ///
    /// While the contact is closed its least force is linear in the preload: two runs give the
    /// line, and a third one between them and its zero confirms it.
    ///
    /// # Errors
    /// The contact is not closed by force; there is no closing spring; no preload closes it; the
    /// runs.
    pub fn preload_needed(&self) -> Result<f64, Missing> {
        let pair = self.model().pair(&self.model().objects[self.object]);
        if pair.map(|pair| pair.closure) != Some(Closure::Force) {
            return Err(self.refused("only a pair that is closed by force needs a preload"));
        }
        let spring = ClosingLoads::of(self.model(), self.object);
        let spring = spring.map_err(|why| self.refused(why))?;
        let force = |preload: f64| {
            let system = self.system_of(spring.model_with(self.model(), preload))?;
            self.of(&system).force()
        };
        let mut preload = spring.preload;
        let mut closed = force(preload)?;
        let mut step = closed.greatest.abs().max(preload.abs());
        for _ in 0..MOST_RAISES {
            if closed.least.value > 0.0 {
                break;
            }
            preload += step;
            step *= 2.0;
            closed = force(preload)?;
        }
        let least = closed.least.value;
        if !(least > 0.0) {
            return Err(self.refused(format!(
                "its contact stays open within the turn even with a preload of {preload} (SI)"
            )));
        }
        // (A preload acts on the contact with its full force at most, beside other springs.)
        let lower = preload - 0.5 * least / spring.most_leverage;
        let line = |[a, b]: [(f64, f64); 2]| a.0 - a.1 * (b.0 - a.0) / (b.1 - a.1);
        let second = (lower, force(lower)?.least.value);
        let zero = line([(preload, least), second]);
        let middle = 0.5 * (zero + lower);
        let expected = 0.5 * second.1;
        let confirmed = force(middle)?.least.value;
        if !(zero.is_finite() && (confirmed - expected).abs() <= STRAIGHT * least) {
            return Err(self.refused(
                "its least contact force is no straight line over the preload: look for the \
                 preload with `dam find --vary`",
            ));
        }
        Ok(zero)
    }
}
