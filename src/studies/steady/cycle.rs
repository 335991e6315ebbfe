//! After which angle of its drives a machine repeats: its ratios tell.

use crate::dynamics::load::LoadFunction;
use crate::dynamics::model::{
    LinearPiece, LinkageBody, Load, LoadLaw, LoadVariable, Model, NodeIndex, NodeMotion,
    TrackSource, WrittenLoad,
};
use crate::dynamics::steady::MOST_TURNS;
use crate::exact::{PrescribedMotion, Rhythm};
use crate::fault::Fault;
use crate::kinematics::constraint::Constraint;
use crate::kinematics::linkage::spec::ForceLaw;
use crate::kinematics::motion::DriveMotion;
use crate::kinematics::position::Position;
use crate::math::expression::Repetition;
use crate::math::fraction::Fraction;
use crate::units::shown;
use std::f64::consts::TAU;

/// Relative differences of inertias and accelerations after a cycle that are rounding.
pub(super) const AFTER_A_CYCLE: f64 = 1e-8;

/// Rhythms of everything while a drive turns evenly: what repeats after which angle, and
/// what never does.
#[derive(Debug, Default)]
pub(super) struct Rhythms {
    /// What repeats, and after which angle (rad).
    periods: Vec<(String, f64)>,
    /// Faults of what goes on without ever coming back.
    pub(super) growing: Vec<Fault>,
}

/// The angle, counted in turns of a drive of unit speed, as a course over time.
fn turning(speed: f64) -> PrescribedMotion {
    PrescribedMotion::new(&DriveMotion::Constant { speed, angle: 0.0 })
}

/// Where a node is while the drives turn evenly; deviations of masses from their laws
/// come and go with what causes them.
fn courses(model: &Model, drive: Option<NodeIndex>, speed: f64) -> Vec<Option<PrescribedMotion>> {
    let mut found: Vec<Option<PrescribedMotion>> = Vec::with_capacity(model.nodes.len());
    for (index, node) in model.nodes.iter().enumerate() {
        let course = match &node.motion {
            _ if drive == Some(index) => Some(turning(1.0)),
            NodeMotion::Prescribed {
                motion: DriveMotion::Constant { speed: own, .. },
                ..
            } if drive.is_none() => Some(turning(own / speed)),
            NodeMotion::Mass { law } | NodeMotion::Rigid { law } => {
                let driver = found[law.driver].as_ref();
                driver.map(|driver| driver.through_position(&law.position, law.lever))
            }
            NodeMotion::Constrained {
                drivers,
                constraint,
            } => {
                let drivers = drivers.iter().map(|&driver| found[driver].as_ref());
                let drivers: Option<Vec<&PrescribedMotion>> = drivers.collect();
                drivers.map(|drivers| combined(&drivers, constraint))
            }
            _ => None,
        };
        found.push(course);
    }
    found
}

/// A course that stands for all that are rhythmic alike.
fn rhythmic(rhythm: Rhythm) -> PrescribedMotion {
    match rhythm {
        Rhythm::Uniform(speed) => turning(speed),
        Rhythm::Periodic(period, advance) => {
            let wave = Position::Sine {
                amplitude: 1.0,
                harmonic: TAU / period,
                phase: 0.0,
                offset: 0.0,
            };
            let wave = turning(1.0).through_position(&wave, 1.0);
            match advance {
                0.0 => wave,
                _ => {
                    PrescribedMotion::sum(vec![(1.0, turning(advance / period)), (1.0, wave)], 0.0)
                }
            }
        }
        Rhythm::None => PrescribedMotion::new(&DriveMotion::Accelerated {
            speed: 0.0,
            acceleration: 1.0,
            angle: 0.0,
        }),
    }
}

/// The course of what follows several nodes. Of functions other than sums it is not known what
/// they do with inputs that turn on. (Linkages of several inputs are refused.)
fn combined(drivers: &[&PrescribedMotion], constraint: &Constraint) -> PrescribedMotion {
    let rhythms = drivers.iter().map(|driver| driver.rhythm());
    let rhythm = match constraint {
        Constraint::Linear { ratios, .. } => common_rhythm(rhythms.zip(ratios.iter().copied())),
        Constraint::Custom(_) if rhythms.clone().any(grows) => None,
        Constraint::Custom(_) => common_rhythm(rhythms.map(|rhythm| (rhythm, 0.0))),
    };
    rhythmic(rhythm.unwrap_or(Rhythm::None))
}

/// The rhythm of Σ ratio·φ; `None`: the terms have no period in common.
fn common_rhythm(terms: impl Iterator<Item = (Rhythm, f64)>) -> Option<Rhythm> {
    let (mut speed, mut cycle, mut periods) = (0.0, None, Vec::new());
    for (rhythm, ratio) in terms {
        match rhythm {
            Rhythm::Uniform(own) => speed += ratio * own,
            Rhythm::Periodic(period, advance) => {
                let turns = Fraction::of(period / TAU)?;
                cycle = match cycle {
                    None => Some(turns),
                    Some(cycle) => Some(turns.common_multiple(cycle)?),
                };
                periods.push((period, ratio * advance));
            }
            Rhythm::None => return None,
        }
    }
    let Some(cycle) = cycle.map(|cycle| TAU * cycle.value()) else {
        return Some(Rhythm::Uniform(speed));
    };
    let advances = periods
        .iter()
        .map(|(period, advance)| advance * cycle / period);
    Some(Rhythm::Periodic(
        cycle,
        speed * cycle + advances.sum::<f64>(),
    ))
}

/// Something that repeats with a period over a node's displacement.
fn rhythm_over(course: &PrescribedMotion, period: f64) -> Rhythm {
    let wave = Position::Sine {
        amplitude: 1.0,
        harmonic: TAU / period,
        phase: 0.0,
        offset: 0.0,
    };
    course.through_position(&wave, 1.0).rhythm()
}

/// Places at which a force is tried.
const PLACES: usize = 40;

/// Most turns after which a force may repeat.
const MOST_REPEATED: u32 = 12;

/// Shares without a common period.
fn irrational_share(place: usize, root: f64) -> f64 {
    (0.37 + place as f64 * root.sqrt()).fract()
}

/// Least number of turns after which a force repeats, tried at [`PLACES`] with and without a
/// shift; `None`: none up to [`MOST_REPEATED`].
fn turns_to_repeat(size: f64, at: impl Fn(usize, f64) -> f64) -> Option<f64> {
    let repeats = |turns: &f64| {
        (0..PLACES).all(|place| {
            let (one, other) = (at(place, 0.0), at(place, TAU * turns));
            (one - other).abs() <= 1e-9 * (one.abs() + other.abs() + size)
        })
    };
    (1..=MOST_REPEATED).map(f64::from).find(repeats)
}

/// Least number of turns of a node after which an expression repeats.
fn turns_of(written: &WrittenLoad, node: NodeIndex) -> Option<f64> {
    turns_to_repeat(written.factor.abs(), |place, shift| {
        written.force(10.0 * irrational_share(place, 2.0), |other| {
            let own = if other == node { shift } else { 0.0 };
            let root = 3.0 + other as f64;
            (
                TAU * (6.0 * irrational_share(place, root) - 3.0) + own,
                4.0 * irrational_share(place, root + 0.5) - 2.0,
            )
        })
    })
}

/// The same of any other function.
fn turns_of_function(function: &dyn LoadFunction) -> Option<f64> {
    turns_to_repeat(function.magnitude(), |place, shift| {
        let displacement = TAU * (6.0 * irrational_share(place, 3.0) - 3.0) + shift;
        let speed = 4.0 * irrational_share(place, 3.5) - 2.0;
        function.force(displacement, speed).value
    })
}

/// True when a displacement goes on and on.
fn grows(rhythm: Rhythm) -> bool {
    match rhythm {
        Rhythm::Uniform(advance) | Rhythm::Periodic(_, advance) => advance != 0.0,
        Rhythm::None => false,
    }
}

/// True of a table that is the same everywhere.
fn is_constant(pieces: &[LinearPiece]) -> bool {
    let same = |piece: &LinearPiece| piece.slope == 0.0 && piece.value == pieces[0].value;
    pieces.iter().all(same)
}

/// How a course over the angle repeats; `None`: it does not.
fn repetition(rhythm: Rhythm) -> Option<Repetition> {
    match rhythm {
        Rhythm::Uniform(slope) => Some(Repetition::Line(slope)),
        Rhythm::Periodic(period, advance) => Some(Repetition::Cycles { period, advance }),
        Rhythm::None => None,
    }
}

/// The same of its speed.
fn repetition_of_speed(rhythm: Rhythm) -> Option<Repetition> {
    match rhythm {
        Rhythm::Uniform(_) => repetition(Rhythm::Uniform(0.0)),
        Rhythm::Periodic(period, _) => repetition(Rhythm::Periodic(period, 0.0)),
        Rhythm::None => None,
    }
}

/// Why there is no cycle: something has no period in common with the drive, or the rest.
fn no_cycle((name, period): &(String, f64)) -> Fault {
    let message = format!(
        "it repeats after {} turns of the drive: {}",
        shown(period / TAU, 9),
        no_common_period()
    );
    Fault::new(name, message, TOGETHER)
}

fn no_common_period() -> String {
    format!(
        "the ratios and loads of the scene do not repeat together after any angle of the drive \
         up to {MOST_TURNS} turns, there is no periodic motion"
    )
}

/// What repeats together.
const TOGETHER: &str = "give ratios of whole numbers of teeth (20/41: \"ratio\": \
                        0.4878048780487805). Loads over time need a frequency that is to the \
                        drive's as small whole numbers. `dam run` follows the scene as it is";

/// Why something never repeats, and what does.
const LEFT_BEHIND: (&str, &str) = (
    "a table that does not repeat, over a displacement that grows with every turn: the machine \
     moves past it",
    "a `period`",
);
const NO_WHOLE_TURNS: (&str, &str) = (
    "an expression that does not repeat with whole turns, over a displacement that grows with \
     every turn",
    "sin(phi), or phi % (2*pi)",
);
const NEVER_BACK: (&str, &str) = (
    "its motion does not repeat while its driver turns on and on: there is no periodic motion",
    "a position function with a `period`; `dam run` follows the scene as it is",
);
const WOUND_UP: (&str, &str) = (
    "a spring on what turns on and on is wound up with every turn",
    "a spring on what swings",
);
const STOPPED: (&str, &str) = (
    "a stop on what turns on and on is left behind, or ends its motion",
    "a stop on what swings",
);
const TABLE_OVER_TIME: (&str, &str) = (
    "a table over time does not repeat: there is no periodic motion",
    "`harmonic`, or a table over the driver's position with a `period`; `dam run` follows the \
     scene as it is",
);
const OVER_TIME: (&str, &str) = (
    "an expression over time that does not repeat: there is no periodic motion",
    "what repeats with time: 20*sin(2*pi*5*t), or t % 0.2; `dam run` follows the scene as it is",
);

impl Rhythms {
    /// Rhythms of everything behind a drive that turns as it likes, `moved` by node.
    pub(super) fn rhythms_behind_drive(model: &Model, drive: NodeIndex, moved: &[bool]) -> Self {
        Self::of(model, &courses(model, Some(drive), 1.0), moved, None)
    }

    /// Rhythms of everything behind drives of constant speed; the angle is that of a
    /// drive with `speed` (rad/s, > 0).
    pub(super) fn of_all(model: &Model, speed: f64) -> Self {
        let moved = vec![true; model.nodes.len()];
        Self::of(model, &courses(model, None, speed), &moved, Some(speed))
    }

    fn of(
        model: &Model,
        courses: &[Option<PrescribedMotion>],
        moved: &[bool],
        speed: Option<f64>,
    ) -> Self {
        let mut rhythms = Self::default();
        let known = |node: NodeIndex| courses[node].as_ref().filter(|_| moved[node]);
        for part in &model.objects {
            match known(part.nodes[0]).map(PrescribedMotion::rhythm) {
                Some(Rhythm::None) => rhythms.never(&part.id, NEVER_BACK),
                Some(rhythm) => rhythms.add(&part.id, rhythm),
                None => {}
            }
        }
        for body in &model.linkages {
            if let (Some(course), Some(period)) =
                (known(body.node), body.linkage.range().period.as_ref())
            {
                rhythms.add(
                    &model.objects[body.object].id,
                    rhythm_over(course, period.length),
                );
            }
            if let Some(course) = known(body.node) {
                rhythms.tables_of(&model.objects[body.object].id, body, course);
            }
        }
        for load in model.loads.iter().filter(|load| moved[load.node]) {
            rhythms.load(model, load, &known, speed);
        }
        rhythms
    }

    fn add(&mut self, name: &str, rhythm: Rhythm) {
        if let Rhythm::Periodic(period, _) = rhythm {
            self.periods.push((name.to_owned(), period));
        }
    }

    /// Forces of a linkage that are tables over its input.
    fn tables_of(&mut self, id: &str, body: &LinkageBody, course: &PrescribedMotion) {
        for force in &body.linkage.spec().forces {
            let (points, period) = match &force.law {
                ForceLaw::Table { points, period, .. }
                | ForceLaw::CoupleTable { points, period, .. } => (points, *period),
                ForceLaw::Strut { .. }
                | ForceLaw::Torsion { .. }
                | ForceLaw::Force { .. }
                | ForceLaw::Couple { .. } => continue,
            };
            match period {
                _ if points.iter().all(|point| point.1 == points[0].1) => {}
                Some(period) => {
                    self.add(
                        &format!("{id}.forces.{}", force.name),
                        rhythm_over(course, period),
                    );
                }
                None if grows(course.rhythm()) => {
                    self.never(&format!("{id}.forces.{}", force.name), LEFT_BEHIND);
                }
                None => {}
            }
        }
    }

    fn load<'c>(
        &mut self,
        model: &Model,
        load: &Load,
        known: &dyn Fn(NodeIndex) -> Option<&'c PrescribedMotion>,
        speed: Option<f64>,
    ) {
        let growing = |node: NodeIndex| known(node).filter(|course| grows(course.rhythm()));
        match &load.law {
            LoadLaw::Pieces { track, pieces } => {
                let track = &model.tracks[*track];
                match (track.source, track.breaks.period) {
                    _ if is_constant(pieces) => {}
                    (TrackSource::Time, Some(period)) => {
                        let own = speed.map(|speed| (load.name.clone(), period * speed));
                        self.periods.extend(own);
                    }
                    // (Where a motor decides the speed, loads over time are refused anyway.)
                    (TrackSource::Time, None) if speed.is_some() => {
                        self.never(&load.name, TABLE_OVER_TIME);
                    }
                    (TrackSource::Time, None) => {}
                    (TrackSource::Node(node), Some(period)) => {
                        if let Some(course) = known(node) {
                            self.add(&load.name, rhythm_over(course, period));
                        }
                    }
                    (TrackSource::Node(node), None) if growing(node).is_some() => {
                        self.never(&load.name, LEFT_BEHIND);
                    }
                    (TrackSource::Node(_), None) => {}
                }
            }
            LoadLaw::Written(written) if written.needs_time() => {
                if let Some(speed) = speed {
                    self.over_time(&load.name, written, known, speed);
                }
            }
            LoadLaw::Written(written) => {
                for node in written.nodes() {
                    if let Some(course) = growing(node) {
                        self.turns(&load.name, course, turns_of(written, node));
                    }
                }
            }
            LoadLaw::Function { function, .. } if function.needs_displacement() => {
                if let Some(course) = growing(load.node) {
                    self.turns(&load.name, course, turns_of_function(function.as_ref()));
                }
            }
            LoadLaw::Linear(own) if own.rate != 0.0 && growing(load.node).is_some() => {
                self.never(&load.name, WOUND_UP);
            }
            LoadLaw::Stop(_) if growing(load.node).is_some() => {
                self.never(&load.name, STOPPED);
            }
            // What depends on nothing, on a speed, or on a displacement that comes back.
            LoadLaw::Linear(_)
            | LoadLaw::Stop(_)
            | LoadLaw::Dry { .. }
            | LoadLaw::Function { .. } => {}
        }
    }

    /// A load by an expression that reads the time, beside displacements maybe.
    fn over_time<'c>(
        &mut self,
        name: &str,
        written: &WrittenLoad,
        known: &dyn Fn(NodeIndex) -> Option<&'c PrescribedMotion>,
        speed: f64,
    ) {
        // What is not known is deviations, and those come and go with what causes them.
        let of = |node: NodeIndex| known(node).map_or(Rhythm::Uniform(0.0), |one| one.rhythm());
        let variable = |index: usize| match written.variables[index] {
            LoadVariable::Time => Some(Repetition::Line(1.0 / speed)),
            LoadVariable::Displacement(node) => repetition(of(node)),
            LoadVariable::Speed(node) => repetition_of_speed(of(node)),
        };
        match Repetition::repetition_of_program(written.expression.program(), &variable) {
            Some(Repetition::Line(0.0)) => {}
            Some(Repetition::Cycles {
                period,
                advance: 0.0,
            }) => self.periods.push((name.to_owned(), period)),
            Some(_) | None => self.never(name, OVER_TIME),
        }
    }

    /// A force over whole turns of what goes on and on; `None`: it repeats after none.
    fn turns(&mut self, name: &str, course: &PrescribedMotion, turns: Option<f64>) {
        match turns {
            Some(turns) => self.add(name, rhythm_over(course, TAU * turns)),
            None => self.never(name, NO_WHOLE_TURNS),
        }
    }

    fn never(&mut self, name: &str, (what, hint): (&str, &str)) {
        self.growing.push(Fault::new(name, what, hint));
    }

    /// The least angle after which a machine behind a motor repeats (rad): that of
    /// [`Rhythms::cycle`], but where the ratios ask for more than `least` they alone decide.
    /// A motor is the same at every angle, so that it need not have come to whole turns.
    pub(super) fn cycle_of_motor(&self, least: f64) -> Option<f64> {
        let turns = |(_, angle): &(String, f64)| Fraction::of(angle / TAU);
        let periods: Option<Vec<Fraction>> = self.periods.iter().map(turns).collect();
        let mut periods = periods?.into_iter();
        let first = periods.next();
        let ratios = first.and_then(|first| {
            periods.try_fold(first, |common, period| common.common_multiple(period))
        });
        match ratios.map(Fraction::value) {
            Some(value) if value * TAU > least * (1.0 + 1e-12) => {
                (value <= MOST_TURNS).then_some(TAU * value)
            }
            _ => self.cycle(least),
        }
    }

    /// The least angle after which everything that is known here repeats, and that is a
    /// whole multiple of `least` (rad).
    ///
    /// # Errors
    /// What never repeats, and what does not with the rest up to [`MOST_TURNS`], by name.
    pub(super) fn whole_cycle(self, least: f64) -> Result<f64, Vec<Fault>> {
        let common = self.cycle(least);
        if let (Some(cycle), true) = (common, self.growing.is_empty()) {
            return Ok(cycle);
        }
        let mut faults = self.growing;
        if Fraction::of(least / TAU).is_none() {
            let fault = Fault::new("steady.cycle", no_common_period(), TOGETHER);
            return Err(faults.into_iter().chain([fault]).collect());
        }
        let alone = |period: &(String, f64)| common_cycle(least, [period]).is_none();
        let (apart, others): (Vec<_>, Vec<_>) = self.periods.into_iter().partition(alone);
        // Each may repeat with the drive, and all of them do not together.
        let none = apart.is_empty() && common.is_none();
        let named = apart.into_iter().chain(others.into_iter().filter(|_| none));
        let mut named: Vec<(String, f64)> = named
            .filter(|(_, period)| (period - least).abs() > 1e-12 * least)
            .collect();
        // (An object may repeat by more than one of its parts.)
        named.dedup_by(|one, other| one.0 == other.0);
        faults.extend(named.iter().map(no_cycle));
        Err(faults)
    }

    /// The least angle after which everything that is known here repeats, and that is a
    /// whole multiple of `least` (rad); `None`: there is none up to [`MOST_TURNS`].
    fn cycle(&self, least: f64) -> Option<f64> {
        common_cycle(least, &self.periods)
    }
}

fn common_cycle<'p>(
    least: f64,
    periods: impl IntoIterator<Item = &'p (String, f64)>,
) -> Option<f64> {
    let turns = |angle: f64| Fraction::of(angle / TAU);
    let mut cycle = turns(least)?;
    for (_, period) in periods {
        cycle = cycle.common_multiple(turns(*period)?)?;
    }
    let angle = TAU * cycle.value();
    match cycle.value() {
        value if (value * TAU - least).abs() <= 1e-12 * least => Some(least),
        value => (value <= MOST_TURNS).then_some(angle),
    }
}

#[cfg(test)]
mod tests {
    use super::{Rhythm, common_rhythm, rhythmic};
    use std::f64::consts::TAU;

    fn near(found: Option<Rhythm>, turns: f64, advance: f64) {
        let Some(Rhythm::Periodic(period, gained)) = found else {
            panic!("{found:?}");
        };
        approx::assert_relative_eq!(period, turns * TAU, max_relative = 1e-13);
        approx::assert_abs_diff_eq!(gained, advance, epsilon = 1e-12);
    }

    #[test]
    fn sums_repeat_when_all_terms_do_together() {
        let periodic = |turns: f64, advance: f64| Rhythm::Periodic(turns * TAU, advance);
        let sum = |terms: &[(Rhythm, f64)]| common_rhythm(terms.iter().copied());
        let line = Rhythm::Uniform(0.5);
        assert_eq!(
            sum(&[(line, 3.0), (line, -1.0)]),
            Some(Rhythm::Uniform(1.0))
        );
        // Neither period is a whole multiple of the other.
        let both = [(periodic(2.0, 0.3), 2.0), (periodic(3.0, -0.1), 1.0)];
        near(sum(&both), 6.0, 3.0 * 0.6 - 0.2);
        near(sum(&[both[1], (line, 0.2)]), 3.0, -0.1 + 0.3 * TAU);
        let irrational = [both[0], (periodic(2.0f64.sqrt(), 0.0), 1.0)];
        assert_eq!(sum(&irrational), None);
        assert_eq!(sum(&[(Rhythm::None, 1.0), (line, 1.0)]), None);
    }

    #[test]
    fn a_course_that_stands_for_a_rhythm_has_it() {
        assert_eq!(
            rhythmic(Rhythm::Uniform(0.75)).rhythm(),
            Rhythm::Uniform(0.75)
        );
        assert_eq!(rhythmic(Rhythm::None).rhythm(), Rhythm::None);
        for (turns, advance) in [(1.5, 0.0), (6.0, 2.0), (0.75, -0.5)] {
            near(
                Some(rhythmic(Rhythm::Periodic(turns * TAU, advance)).rhythm()),
                turns,
                advance,
            );
        }
    }
}
