//! Contact force, lift-off and closing spring of a cam in a scene.

use super::reduction::Reduction;
use crate::dynamics::model::{Closure, Model};
use crate::dynamics::trajectory::Trajectory;
use crate::kinematics::cam::closing::{ClosingSpring, ClosureProblem, LetsGo, Rates};
use crate::kinematics::cam::search::greatest_over;
use crate::kinematics::cam::{At, DiscCam, Surface};
use crate::studies::judgement::Judgement;
pub(super) use crate::studies::law::{LiftOff, edge_between, lift_off};
use crate::studies::rigid::Rigid;
use crate::units::shown;
use serde::Serialize;

/// Reserve of contact force that is to be left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reserve {
    /// A share of the greatest force with which the follower would leave the
    /// cam without its spring.
    Share(f64),
    /// A force (N or N·m along the follower's displacement).
    Force(f64),
}

/// The contact of follower and cam at constant speed, everything being rigid
/// and without friction.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ForceFigures {
    /// Unit of forces along the follower's displacement: N or N m.
    pub unit: &'static str,
    /// Speed of the cam (rad/s).
    pub speed: f64,
    /// Reduced inertia of follower and what it carries, at the beginning of the turn (kg or kg·m²).
    pub inertia: f64,
    /// The closing spring: all springs on the follower together, or, if it has none, on the one
    /// object behind it that has springs.
    pub spring: ClosingSpring,
    /// The object behind the follower on which the spring acts; null: the follower itself.
    pub spring_on: Option<String>,
    /// Unit of the force of the spring: N or N m.
    pub spring_unit: &'static str,
    /// Names of the springs.
    pub springs: Vec<String>,
    /// Least force of the pair along the displacement of the follower (N or
    /// N·m): the margin against lift-off, negative where it would lift off. Of
    /// a form-closed or bilateral pair: below zero the other flank carries.
    pub margin: At,
    /// Greatest force of the pair, along the displacement.
    pub greatest: At,
    /// Greatest |force| between cam and follower, along the normal (N).
    pub contact_force: At,
    /// Greatest Hertzian pressure between cam and follower (Pa); null: nothing is said of
    /// their material, or they do not touch along a line everywhere.
    pub pressure: Option<At>,
    /// Greatest torque that the cam needs (N·m).
    pub torque: At,
    /// Least torque: below zero the follower drives.
    pub return_torque: At,
    /// Speed at which the pair opens; null unless it is closed by force.
    pub lets_go: Option<LetsGo>,
    /// The spring that would keep contact at the speed.
    pub closing: Option<SpringAnswer>,
    /// With the follower's elasticity: the least speed of the cam (rad/s) at which its steady motion
    /// with closed contact ceases; null unless it was looked for.
    pub elastic: Option<LiftOff>,
    /// With the follower's elasticity, by runs at the speed; null unless lift-off was looked for in
    /// an elastic scene.
    pub elastic_contact: Option<ElasticFigures>,
    /// Label of the figures where objects of the scene are elastic: they take them as rigid.
    pub rigid: Option<Rigid>,
    /// Notes on what is left out.
    pub notes: Vec<String>,
}

/// The contact in the steady motion, with the elasticity of the scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ElasticFigures {
    /// Least force along the displacement of the follower (N or N·m); 0 where it is off the cam.
    pub margin: Option<At>,
    /// Least preload of the closing spring that keeps contact, without a reserve.
    pub preload: Option<f64>,
    /// Why one of them is missing.
    pub missing: Vec<String>,
}

/// Share to which the speed of an elastic lift-off is known.
const SEARCHED: f64 = 1e-5;

impl ForceFigures {
    /// The verdict on the contact, which is closed where everything is rigid. Elastic objects are
    /// judged by their margin at the speed, else by the speed at which theirs opens.
    pub fn contact_verdict(&self) -> Judgement {
        let speed = self.speed.abs();
        if let (Some(_), Some(margin)) = (&self.rigid, self.elastic_margin()) {
            return match margin > 0.0 {
                true => Judgement::InWorkingOrder,
                false => Judgement::NotInWorkingOrder,
            };
        }
        match (&self.rigid, self.elastic) {
            (None, _) => Judgement::InWorkingOrder,
            (Some(_), Some(LiftOff::At(opens))) if speed <= opens * (1.0 - SEARCHED) => {
                Judgement::InWorkingOrder
            }
            (Some(_), Some(LiftOff::At(opens))) if speed >= opens * (1.0 + SEARCHED) => {
                Judgement::NotInWorkingOrder
            }
            (Some(_), Some(LiftOff::Above(closed))) if speed <= closed => Judgement::InWorkingOrder,
            (Some(_), Some(LiftOff::Below(open))) if speed >= open => Judgement::NotInWorkingOrder,
            (Some(_), Some(LiftOff::At(_) | LiftOff::Above(_) | LiftOff::Below(_)) | None) => {
                Judgement::NotJudged
            }
        }
    }

    fn elastic_margin(&self) -> Option<f64> {
        let margin = self.elastic_contact.as_ref()?.margin?;
        Some(margin.value)
    }

    /// The least speed of lift-off, if the follower stays in contact at a greater speed of the cam.
    pub(crate) fn lift_off_below(&self) -> Option<f64> {
        let Some(LiftOff::At(opens)) = self.elastic else {
            return None;
        };
        let closed = self.elastic_margin()? > 0.0;
        (closed && self.speed.abs() > opens * (1.0 + SEARCHED)).then_some(opens)
    }

    /// False when some force grew beyond all numbers.
    pub(super) fn is_finite(&self) -> bool {
        let mut all = vec![self.speed, self.margin.value, self.greatest.value];
        all.extend([
            self.contact_force.value,
            self.torque.value,
            self.return_torque.value,
        ]);
        if let Some(answer) = &self.closing {
            all.extend([answer.reserve, answer.preload.value]);
            all.extend(answer.boundary.iter().flatten());
        }
        all.iter().all(|value| value.is_finite())
    }
}

/// Springs that leave a reserve in contact.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SpringAnswer {
    /// The reserve (N or N·m).
    pub reserve: f64,
    /// Least preload with the present rate, and where it is needed.
    pub preload: At,
    /// Rates that do with the present preload; null: none.
    pub rates: Option<Rates>,
    /// Why none does.
    pub no_rate: Option<String>,
    /// Boundary of the region that does: rate, least preload.
    pub boundary: Vec<[f64; 2]>,
}

/// The reduced follower on its cam.
#[derive(Debug)]
pub struct CamForce<'m> {
    cam: &'m DiscCam,
    reduction: Reduction<'m>,
    speed: f64,
    unit: &'static str,
    /// Label where objects of the scene are elastic: all are taken as rigid here.
    rigid: Option<Rigid>,
}

/// The constant speed (rad/s) of the cam of an object, in its scene.
pub(super) fn cam_speed(model: &Model, object: usize) -> Option<f64> {
    let driver = model.objects[object].driver()?;
    let node = model.objects[driver].nodes.last()?;
    Trajectory::of(model, *node)?.constant_speed()
}

/// Points of the boundary of the region of springs.
const BOUNDARY: usize = 60;

impl<'m> CamForce<'m> {
    /// The object (index in the model) on its cam at a speed (rad/s), by
    /// default that of the scene.
    ///
    /// # Errors
    /// There is no constant speed, or a load that is none of the cam's angle.
    pub fn new(
        model: &'m Model,
        object: usize,
        cam: &'m DiscCam,
        speed: Option<f64>,
    ) -> Result<Self, String> {
        let reduction = Reduction::new(model, object, cam)?;
        let speed = speed.or_else(|| cam_speed(model, object));
        let speed = speed.ok_or("the cam has no constant speed: give one")?;
        if !(speed.is_finite() && speed != 0.0) {
            return Err(format!("{speed} rad/s is no speed of a cam"));
        }
        Ok(Self {
            cam,
            reduction,
            speed,
            rigid: Rigid::label(model, &["dam run", "dam cam --lift-off"]),
            unit: model.objects[object].coordinate.units()[1],
        })
    }

    /// Unit of the force of the closing spring: N or N m.
    pub(super) fn spring_unit(&self) -> &'static str {
        let owner = self.reduction.spring_owner();
        owner.map_or(self.unit, |part| part.coordinate.units()[1])
    }

    /// The cam.
    pub fn cam(&self) -> &'m DiscCam {
        self.cam
    }

    /// Speed of the cam (rad/s).
    pub fn speed(&self) -> f64 {
        self.speed
    }

    /// Force of the pair along the displacement of the follower, in the
    /// direction of opening (N or N·m), force between cam and follower along
    /// the normal, positive where the cam pushes outwards (N), and torque of
    /// the cam (N·m), at φ of a piece.
    pub fn at(&self, piece: usize, phi: f64) -> [f64; 3] {
        let demand = self.reduction.demand(self.cam, piece, phi);
        let force = demand.force(self.reduction.spring, self.speed);
        let [from, to] = self.reduction.pieces[piece];
        let (at, _) = self.cam.motion().piece_at(0.5 * (from + to));
        let state = self.cam.at(at, phi);
        let lever = self.reduction.lever();
        let opens = self.reduction.pair().opens;
        let outward = opens * lever * self.cam.geometry().outward;
        let slope = self.reduction.follower(self.cam, piece, phi)[1];
        [force, outward * force / state.lever, opens * force * slope]
    }

    /// Hertzian pressure between cam and follower (Pa) at φ of a piece; 0 where they part;
    /// `None`: see [`DiscCam::pressure`].
    pub fn pressure(&self, piece: usize, phi: f64) -> Option<f64> {
        let [_, normal, _] = self.at(piece, phi);
        let [from, to] = self.reduction.pieces[piece];
        let (at, _) = self.cam.motion().piece_at(0.5 * (from + to));
        self.cam.pressure(&self.cam.at(at, phi), normal)
    }

    /// [`Self::pressure`] for any φ between the ends of a piece of the law, as
    /// [`Self::at_within_piece`].
    pub fn pressure_within_piece(&self, phi: f64, from: f64, to: f64) -> Option<f64> {
        self.pressure(self.piece_within(phi, from, to), phi)
    }

    /// [`Self::at`] for any φ between `from` and `to`, the ends of a piece of the
    /// law; at its beginning what holds after it, else what holds before a break.
    pub fn at_within_piece(&self, phi: f64, from: f64, to: f64) -> [f64; 3] {
        self.at(self.piece_within(phi, from, to), phi)
    }

    fn piece_within(&self, phi: f64, from: f64, to: f64) -> usize {
        let inside = match phi <= from {
            true => from + 1e-9 * (to - from),
            false => phi - 1e-9 * (phi - from),
        };
        let pieces = &self.reduction.pieces;
        let after = pieces.partition_point(|piece| piece[0] <= inside);
        after.saturating_sub(1)
    }

    fn greatest_pressure(&self) -> Option<At> {
        let pressure = |piece, phi| self.pressure(piece, phi).unwrap_or(f64::INFINITY);
        let found = greatest_over(&self.reduction.pieces, &pressure);
        let known = self.cam.geometry().material.is_some() && found.value.is_finite();
        known.then_some(found)
    }

    fn extreme(&self, f: impl Fn([f64; 3]) -> f64) -> At {
        greatest_over(&self.reduction.pieces, &|piece, phi| f(self.at(piece, phi)))
    }

    /// Everything about the contact.
    pub fn figures(&self, reserve: Reserve) -> ForceFigures {
        let negative = |at: At| At {
            value: 0.0 - at.value,
            ..at
        };
        let contact_force = self.extreme(|[_, normal, _]| normal.abs());
        let torque = self.extreme(|[.., torque]| torque);
        let return_torque = negative(self.extreme(|[.., torque]| -torque));
        let demand = |piece: usize, phi: f64| self.reduction.demand(self.cam, piece, phi);
        let closing = ClosureProblem::new(&self.reduction.pieces, &demand);
        let (spring, speed) = (self.reduction.spring, self.speed);
        let forced = self.reduction.pair().closure == Closure::Force;
        let mut notes = self.reduction.notes.clone();
        let owner = self.reduction.spring_owner();
        let behind = owner.filter(|_| self.reduction.has_spring_behind());
        let spring_unit = self.spring_unit();
        notes.extend(
            self.rigid
                .as_ref()
                .map(|label| label.words("the forces are")),
        );
        if self.cam.geometry().surface == Surface::Groove && forced {
            notes.push("a groove needs no closing force".to_owned());
        }
        ForceFigures {
            unit: self.unit,
            speed,
            inertia: self
                .reduction
                .inertia(self.cam, 0, self.reduction.pieces[0][0]),
            spring,
            springs: self.reduction.springs.clone(),
            spring_on: behind.map(|part| part.id.clone()),
            spring_unit,
            margin: closing.least_force(spring, speed),
            greatest: closing.most(spring, speed),
            contact_force,
            pressure: self.greatest_pressure(),
            torque,
            return_torque,
            lets_go: forced.then(|| closing.separation_speed(spring, speed.signum())),
            closing: forced
                .then(|| answer(&closing, spring, (speed, [self.unit, spring_unit]), reserve)),
            elastic: None,
            elastic_contact: None,
            rigid: self.rigid.clone(),
            notes,
        }
    }
}

/// The least rate that keeps contact without a reserve, in words.
fn without_reserve(
    closing: &ClosureProblem<'_>,
    spring: ClosingSpring,
    speed: f64,
    unit: &str,
) -> String {
    let Ok(rates) = closing.rates_for(spring.preload, speed, 0.0) else {
        return ". No rate keeps contact without a reserve either".to_owned();
    };
    let (in_unit, of_rate) = match unit {
        "N m" => (rates.from, "N m/rad"),
        _ => (1e-3 * rates.from, "N/mm"),
    };
    let least = ClosingSpring {
        rate: rates.from,
        ..spring
    };
    format!(
        ". Without a reserve (--reserve 0) the least rate is {} {of_rate}, at φ = {:.4} deg",
        shown(in_unit, 10),
        closing.least_force(least, speed).phi.to_degrees()
    )
}

fn answer(
    closing: &ClosureProblem<'_>,
    spring: ClosingSpring,
    (speed, [unit, spring_unit]): (f64, [&str; 2]),
    reserve: Reserve,
) -> SpringAnswer {
    let reserve = match reserve {
        Reserve::Share(share) => share * closing.opening(speed).value,
        Reserve::Force(force) => force,
    };
    let rates = closing.rates_for(spring.preload, speed, reserve);
    let no_rate = rates.as_ref().err().map(|none| {
        let missing = format!(
            "no spring rate keeps the reserve of {} {unit} with the preload of {} {spring_unit}: at \
             φ = {:.3} deg {} {unit} are missing. The reserve is required in dwells too",
            shown(reserve, 6),
            shown(spring.preload, 6),
            none.lacking.phi.to_degrees(),
            shown(none.lacking.value, 6)
        );
        missing + &without_reserve(closing, spring, speed, spring_unit)
    });
    let widest = match &rates {
        Ok(rates) => rates.from.max(spring.rate),
        Err(_) => spring.rate,
    };
    let widest = match widest > 0.0 {
        true => 2.0 * widest,
        false => closing.opening(speed).value.max(1.0),
    };
    let boundary = (0..=BOUNDARY).map(|index| {
        let rate = widest * index as f64 / BOUNDARY as f64;
        [rate, closing.preload_for(rate, speed, reserve).value]
    });
    SpringAnswer {
        reserve,
        preload: closing.preload_for(spring.rate, speed, reserve),
        boundary: boundary.collect(),
        rates: rates.ok(),
        no_rate,
    }
}
