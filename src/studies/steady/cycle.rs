//! After which angle of its drives a machine repeats: its ratios tell.

use crate::dynamics::model::{
    Load, LoadLaw, Model, NodeIndex, NodeMotion, TrackSource, WrittenLoad,
};
use crate::dynamics::steady::MOST_TURNS;
use crate::exact::{PrescribedMotion, Rhythm};
use crate::fault::Fault;
use crate::kinematics::motion::DriveMotion;
use crate::kinematics::position::Position;
use crate::math::fraction::Fraction;
use std::f64::consts::TAU;

/// Relative differences of inertias and accelerations after a cycle that are rounding.
pub(super) const AFTER_A_CYCLE: f64 = 1e-8;

/// Rhythms of everything while a drive turns evenly: what repeats after which angle, and
/// what never does.
#[derive(Debug, Default)]
pub(super) struct Rhythms {
    /// Angles after which something repeats (rad).
    periods: Vec<f64>,
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
                driver.map(|driver| driver.through(&law.position, law.lever))
            }
            _ => None,
        };
        found.push(course);
    }
    found
}

/// Something that repeats with a period over a node's displacement.
fn over(course: &PrescribedMotion, period: f64) -> Rhythm {
    let wave = Position::Sine {
        amplitude: 1.0,
        harmonic: TAU / period,
        phase: 0.0,
        offset: 0.0,
    };
    course.through(&wave, 1.0).rhythm()
}

/// True when a displacement goes on and on.
/// Least number of turns of a node after which an expression repeats, tried at places
/// spread over its variables; `None`: none up to [`MOST_REPEATED`].
fn turns_of(written: &WrittenLoad, node: NodeIndex) -> Option<f64> {
    let at = |place: usize, shift: f64| {
        // Shares without a common period.
        let share = |root: f64| (0.37 + place as f64 * root.sqrt()).fract();
        written.force(10.0 * share(2.0), |other| {
            let own = if other == node { shift } else { 0.0 };
            let root = 3.0 + other as f64;
            (
                TAU * (6.0 * share(root) - 3.0) + own,
                4.0 * share(root + 0.5) - 2.0,
            )
        })
    };
    let repeats = |turns: &f64| {
        (0..PLACES).all(|place| {
            let (one, other) = (at(place, 0.0), at(place, TAU * turns));
            (one - other).abs() <= 1e-9 * (one.abs() + other.abs() + written.factor.abs())
        })
    };
    (1..=MOST_REPEATED).map(f64::from).find(repeats)
}

/// Places at which an expression is tried.
const PLACES: usize = 40;

/// Most turns after which an expression may repeat.
const MOST_REPEATED: u32 = 12;

fn grows(rhythm: Rhythm) -> bool {
    match rhythm {
        Rhythm::Uniform(advance) | Rhythm::Periodic(_, advance) => advance != 0.0,
        Rhythm::None => false,
    }
}

impl Rhythms {
    /// Rhythms of everything behind a drive that turns as it likes, `moved` by node.
    pub(super) fn behind(model: &Model, drive: NodeIndex, moved: &[bool]) -> Self {
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
            if let Some(course) = known(part.nodes[0]) {
                rhythms.add(course.rhythm());
            }
        }
        for body in &model.linkages {
            if let (Some(course), Some(period)) =
                (known(body.node), body.linkage.range().period.as_ref())
            {
                rhythms.add(over(course, period.length));
            }
        }
        for load in model.loads.iter().filter(|load| moved[load.node]) {
            rhythms.load(model, load, &known, speed);
        }
        rhythms
    }

    fn add(&mut self, rhythm: Rhythm) {
        if let Rhythm::Periodic(period, _) = rhythm {
            self.periods.push(period);
        }
    }

    fn load<'c>(
        &mut self,
        model: &Model,
        load: &Load,
        known: &dyn Fn(NodeIndex) -> Option<&'c PrescribedMotion>,
        speed: Option<f64>,
    ) {
        let never = |what: &str, hint: &str| Fault::new(&load.name, what, hint);
        match &load.law {
            LoadLaw::Pieces { track, .. } => {
                let track = &model.tracks[*track];
                match (track.source, track.breaks.period) {
                    (TrackSource::Time, Some(period)) => {
                        self.periods.extend(speed.map(|speed| period * speed));
                    }
                    (TrackSource::Node(node), Some(period)) => {
                        if let Some(course) = known(node) {
                            self.add(over(course, period));
                        }
                    }
                    (TrackSource::Node(node), None) => {
                        if known(node).is_some_and(|course| grows(course.rhythm())) {
                            let what = "a table that does not repeat, over a displacement that \
                                        grows with every turn: the machine leaves it behind";
                            self.growing.push(never(what, "a `period`"));
                        }
                    }
                    (TrackSource::Time, None) => {}
                }
            }
            LoadLaw::Written(written) => {
                for node in written.nodes() {
                    let Some(course) = known(node).filter(|course| grows(course.rhythm())) else {
                        continue;
                    };
                    match turns_of(written, node) {
                        Some(turns) => self.add(over(course, TAU * turns)),
                        None => {
                            let what = "an expression that does not repeat with whole turns, over \
                                        a displacement that grows with every turn";
                            let hint = "sin(phi), or phi % (2*pi)";
                            self.growing.push(never(what, hint));
                        }
                    }
                }
            }
            LoadLaw::Spring { rate, .. }
                if *rate != 0.0
                    && known(load.node).is_some_and(|course| grows(course.rhythm())) =>
            {
                let what = "a spring on what turns on and on is wound up with every turn";
                self.growing.push(never(what, "a spring on what swings"));
            }
            _ => {}
        }
    }

    /// The least angle after which a machine behind a motor repeats (rad): that of
    /// [`Rhythms::cycle`], but where the ratios ask for more than `least` they alone decide.
    /// A motor is the same at every angle, so that it need not have come to whole turns.
    pub(super) fn cycle_of_motor(&self, least: f64) -> Option<f64> {
        let turns = |angle: &f64| Fraction::of(angle / TAU);
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
    /// whole multiple of `least` (rad); `None`: there is none up to [`MOST_TURNS`].
    pub(super) fn cycle(&self, least: f64) -> Option<f64> {
        let turns = |angle: f64| Fraction::of(angle / TAU);
        let mut cycle = turns(least)?;
        for &period in &self.periods {
            cycle = cycle.common_multiple(turns(period)?)?;
        }
        let angle = TAU * cycle.value();
        match cycle.value() {
            value if (value * TAU - least).abs() <= 1e-12 * least => Some(least),
            value => (value <= MOST_TURNS).then_some(angle),
        }
    }
}
