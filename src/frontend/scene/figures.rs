//! The results that a scene can expect or a command can be asked for: name, measure, meaning, sign.
//!
//! Each one is declared here once. `expect` reads by these tables, `dam schema --of results`
//! prints them, and the reference pages are made from that.

use crate::dynamics::model::Coordinate::{Sliding, Turning};
use crate::frontend::object::Measures;
use crate::frontend::read::QuantityChoice;
use crate::units::{Quantity, quantities as q};
use serde_json::{Value, json};

/// Measure of a result of something that turns or slides.
pub(crate) type OfCoordinate = fn(Measures) -> QuantityChoice;

/// A result; `M`: what it measures.
pub(crate) struct Figure<M: 'static> {
    /// Name within its owner: `pair.max_lift`.
    pub(crate) name: &'static str,
    /// What it measures.
    pub(crate) measure: M,
    /// Meaning, in a sentence.
    pub(crate) meaning: &'static str,
    /// Which sign it can have, and what the sign says.
    pub(crate) sign: &'static str,
}

const fn of_object(
    name: &'static str,
    measure: OfCoordinate,
    sign: &'static str,
    meaning: &'static str,
) -> Figure<OfCoordinate> {
    Figure {
        name,
        measure,
        meaning,
        sign,
    }
}

const fn of_study(
    name: &'static str,
    measure: Quantity,
    sign: &'static str,
    meaning: &'static str,
) -> Figure<Quantity> {
    Figure {
        name,
        measure,
        meaning,
        sign,
    }
}

fn number(_: Measures) -> QuantityChoice {
    q::NUMBER.into()
}

fn time(_: Measures) -> QuantityChoice {
    q::TIME.into()
}

fn energy(_: Measures) -> QuantityChoice {
    q::MOMENT.into()
}

fn pressure(_: Measures) -> QuantityChoice {
    q::MODULUS.into()
}

fn length(_: Measures) -> QuantityChoice {
    q::LENGTH.into()
}

fn angle(_: Measures) -> QuantityChoice {
    q::ANGLE.into()
}

fn angular_speed(_: Measures) -> QuantityChoice {
    q::ANGULAR_SPEED.into()
}

fn normal_force(_: Measures) -> QuantityChoice {
    q::FORCE.into()
}

fn torque(_: Measures) -> QuantityChoice {
    q::MOMENT.into()
}

/// Of a spring on the object itself or on one behind it.
fn force_of_spring(own: Measures) -> QuantityChoice {
    let own = own.force().first;
    let other = if own == q::FORCE { q::MOMENT } else { q::FORCE };
    QuantityChoice::either(own, other)
}

/// Signs of results.
const SIZE: &str = "≥ 0";
const ALONG: &str = "positive in the positive direction of φ";
const DELTA: &str = "positive: ahead of the law";
const COUNT: &str = "whole number ≥ 0";

/// Results of an object.
#[rustfmt::skip]
pub(super) const OBJECT_FIGURES: &[Figure<OfCoordinate>] = &[
    of_object("delta_abs", Measures::displacement, SIZE, "Greatest |δ|: how far the last mass deviates from its law."),
    of_object("delta_max", Measures::displacement, DELTA, "Greatest positioning error δ of the last mass."),
    of_object("delta_min", Measures::displacement, DELTA, "Least positioning error δ of the last mass."),
    of_object("sigma", Measures::displacement, SIZE, "Mean of |δ| over the time of the run."),
    of_object("peak_speed", Measures::speed, SIZE, "Greatest size of the speed of the last mass."),
    of_object("peak_acceleration", Measures::acceleration, SIZE, "Greatest size of the acceleration of the last mass."),
    of_object("peak_reaction", Measures::force, SIZE, "Greatest size of the force or moment in link 1, at the driving contact."),
    of_object("final.displacement", Measures::displacement, ALONG, "Displacement φ of the last mass at the end of the run."),
    of_object("final.speed", Measures::speed, ALONG, "Speed of the last mass at the end of the run."),
    of_object("pair.separations", number, COUNT, "Number of separations (lift-offs) of the driving contact after the start."),
    of_object("pair.closures", number, COUNT, "Number of closures of the driving contact after the start."),
    of_object("pair.separated_time", time, SIZE, "Total time without contact."),
    of_object("pair.longest_separation", time, SIZE, "Longest time without contact."),
    of_object("pair.max_lift", Measures::displacement, SIZE, "Greatest clearance during a separation."),
    of_object("pair.max_approach_speed", Measures::speed, SIZE, "Greatest speed of approach at a closure; 0 without one."),
    of_object("pair.max_contact_force", Measures::force, SIZE, "Greatest contact force, along the coordinate of the object."),
    of_object("pair.max_indentation", Measures::displacement, SIZE, "Greatest indentation of the contact element; absent without one."),
    of_object("pair.impacts.count", number, COUNT, "Number of impacts of a rigid contact after the start."),
    of_object("pair.impacts.max_impulse", Measures::impulse, SIZE, "Greatest impulse of one impact."),
    of_object("pair.impacts.loss", energy, SIZE, "Energy lost in all impacts."),
    of_object("pair.margin", Measures::force, "negative: the contact separates", "Least contact force that the motion of a rigid object needs; absent for elastic objects."),
    of_object("pair.in_working_order", number, "1 or 0", "1: no separation within the window of steady results; 0: there is one."),
    of_object("pressing.max_pressure", pressure, SIZE, "Greatest Hertzian pressure on the cam, or of a contact with known geometry."),
    of_object("pressing.time", time, SIZE, "Time of the greatest Hertzian pressure."),
    of_object("friction_loss", energy, SIZE, "Energy lost to friction in joints, or to dry friction."),
    of_object("standstills", number, COUNT, "Number of standstills of the input under joint friction, or of the last mass under dry friction."),
    of_object("time_at_rest", time, SIZE, "Total time for which friction holds the input of a linkage, or the last mass with dry friction, at rest."),
    of_object("creep.speed", Measures::speed, ALONG, "Speed at the end of the longest creep under regularised friction."),
    of_object("creep.force", Measures::force, SIZE, "Force that the friction carries at that instant."),
    of_object("creep.limit", Measures::force, "> 0", "Greatest force that the friction can carry at that instant."),
    of_object("creep.from", time, SIZE, "Start of the longest creep."),
    of_object("creep.until", time, SIZE, "End of the longest creep."),
];

/// Results of a stop, beside those of the mass that it stops.
#[rustfmt::skip]
pub(super) const STOP_FIGURES: &[Figure<OfCoordinate>] = &[
    of_object("stop.closures", number, COUNT, "Number of times that the mass reaches the stop after the start."),
    of_object("stop.contact_time", time, SIZE, "Total time in contact with the stop."),
    of_object("stop.max_approach_speed", Measures::speed, SIZE, "Greatest speed at which the mass reaches the stop; 0 if it never does."),
    of_object("stop.max_contact_force", Measures::force, SIZE, "Greatest force of the stop, along the coordinate of the mass."),
    of_object("stop.max_indentation", Measures::displacement, SIZE, "Greatest indentation of the stop."),
    of_object("stop.impacts.count", number, COUNT, "Number of impacts on a rigid stop after the start."),
    of_object("stop.impacts.max_impulse", Measures::impulse, SIZE, "Greatest impulse of one impact."),
    of_object("stop.impacts.loss", energy, SIZE, "Energy lost in all impacts."),
    of_object("peak_speed", Measures::speed, SIZE, "Greatest size of the speed of the mass."),
    of_object("peak_acceleration", Measures::acceleration, SIZE, "Greatest size of the acceleration of the mass."),
    of_object("peak_reaction", Measures::force, SIZE, "Greatest size of the force in the link that drives the mass."),
    of_object("final.displacement", Measures::displacement, ALONG, "Displacement of the mass at the end of the run."),
    of_object("final.speed", Measures::speed, ALONG, "Speed of the mass at the end of the run."),
];

/// Results of the run.
#[rustfmt::skip]
pub(super) const RUN_FIGURES: &[Figure<Quantity>] = &[
    of_study("time", q::TIME, SIZE, "Time at which the run ended; at a dead-centre position its \
                                     own time."),
    of_study("steps", q::NUMBER, COUNT, "Accepted steps of the method."),
    of_study("rejected", q::NUMBER, COUNT, "Rejected steps of the method."),
    of_study("evaluations", q::NUMBER, COUNT, "Evaluations of the equations of motion."),
    of_study("switches", q::NUMBER, COUNT, "Number of events: changes of contact, friction or law branch."),
    of_study("energy_error", q::NUMBER, SIZE, "Defect of the energy balance, as a share of the energy that flows."),
    of_study("complete", q::NUMBER, "1 or 0", "1: the end time was reached; 0: the run stopped before."),
];

/// Results of the steady motion, judged by `dam steady`.
#[rustfmt::skip]
pub(crate) const STEADY_FIGURES: &[Figure<Quantity>] = &[
    of_study("mean_time", q::ANGULAR_SPEED, "> 0", "Mean speed over time: Φ/∫dφ/ω."),
    of_study("mean_angle", q::ANGULAR_SPEED, "> 0", "Mean speed over the machine angle: (1/Φ)·∫ω dφ."),
    of_study("mean_midrange", q::ANGULAR_SPEED, "> 0", "Midrange speed: (ω_max + ω_min)/2."),
    of_study("period", q::TIME, "> 0", "Period of the steady motion."),
    of_study("least_speed", q::ANGULAR_SPEED, SIZE, "Least speed within the period."),
    of_study("greatest_speed", q::ANGULAR_SPEED, "> 0", "Greatest speed within the period."),
    of_study("speed_at_start", q::ANGULAR_SPEED, "> 0", "Speed at φ = 0."),
    of_study("fluctuation", q::NUMBER, SIZE, "Coefficient of speed fluctuation: (ω_max − ω_min)/ω_av."),
    of_study("energy_at_start", q::MOMENT, "> 0", "Kinetic energy at φ = 0."),
    of_study("reference_energy", q::MOMENT, "> 0", "Kinetic energy at the position of the least moment of inertia."),
    of_study("energy_fluctuation", q::MOMENT, SIZE, "Greatest less least kinetic energy."),
    of_study("cycle_work", q::MOMENT, "positive: the forces put energy in", "Work of the forces in a cycle, before it is balanced."),
    of_study("balance", q::MOMENT, "positive in the direction of rotation", "Constant moment that \
                                                                             balances the cycle; \
                                                                             absent if none was \
                                                                             requested."),
    of_study("multiplier", q::NUMBER, SIZE_OF_MULTIPLIER, "Share of a small disturbance that is left after a period; below 1 the motion is stable."),
    of_study("periods", q::NUMBER, "whole number ≥ 1", "Cycles of the machine in one period of an elastic scene."),
    of_study("flywheel", q::INERTIA, SIZE, "Moment of inertia of the flywheel."),
];

const SIZE_OF_MULTIPLIER: &str =
    "any for rigid machines; the greatest modulus, ≥ 0, for elastic scenes";

/// Results of a cam.
#[rustfmt::skip]
pub(crate) const CAM_FIGURES: &[Figure<OfCoordinate>] = &[
    of_object("base_radius", length, "> 0", "Radius of the base circle."),
    of_object("greatest_contact_force", normal_force, "any; > 0 in contact", "Greatest contact force along the normal, at constant speed."),
    of_object("greatest_pressure_angle", angle, SIZE, "Greatest size of the pressure angle over the turn."),
    of_object("greatest_torque", torque, "positive: the cam drives", "Greatest torque on the cam shaft, at constant speed."),
    of_object("least_concave_radius", length, "> 0", "Least radius of curvature where the profile is concave; absent if it is nowhere so."),
    of_object("least_pitch_radius", length, "> 0", "Least radius of curvature where the pitch curve is convex; absent under a flat face."),
    of_object("least_radius", length, "> 0", "Least radius of curvature where the profile is convex."),
    of_object("least_torque", torque, "negative: the load drives the cam", "Least torque on the cam shaft, at constant speed."),
    of_object("lift_off_speed", angular_speed, SIZE, "Least speed of the cam at which the follower lifts off, within 0.001 % for elastic objects; without a value if it never does."),
    of_object("margin", Measures::force, "rigid: negative if the contact separates; elastic: 0", "Least contact force along the coordinate of the object in the steady motion, with the elasticity of the scene."),
    of_object("margin_angle", angle, SIZE, "Angle of the cam at which the contact force is least."),
    of_object("preload_needed", force_of_spring, "positive: towards the cam", "Least preload of the closing spring with which the contact stays closed in the steady motion, without a reserve."),
    of_object("prime_radius", length, "> 0", "Radius of the prime circle: that of the roller centre when innermost."),
];

/// Reasons for which a run may be expected to stop, with their meaning.
#[rustfmt::skip]
pub(super) const STOPS: [(&str, &str); 14] = [
    ("dead_position", "The mechanism came to a dead-centre position: it cannot be assembled \
                       beyond."),
    ("end_of_travel", "A position function or table has no travel beyond this position."),
    ("held_at_jump", "A jump of a load drives the motion back from both sides."),
    ("jammed", "Rigid contacts and stops leave no motion that satisfies all of them."),
    ("not_explored", "The mechanism was not followed as far as this before the run."),
    ("self_locking", "No acceleration agrees with the joint friction: the mechanism is self-locking."),
    ("several_solutions", "Several accelerations agree with the joint friction."),
    ("no_value", "A law of the scene has no value from here on."),
    ("not_finite", "A number of the computation is no longer finite."),
    ("step_floor", "The step that the tolerance needs is below what the time resolves."),
    ("too_many_switches", "More events than `run.max_switches`."),
    ("too_many_steps", "More steps than the method may take."),
    ("wall_clock", "The time limit of the computation was reached."),
    ("method", "The method itself gave up; the message states why."),
];

/// Whether a result of this name may be expected of a stop (true), of any other object (false),
/// or of the run itself (`None`) whatever computes it.
#[cfg(feature = "live")]
pub(crate) fn is_expectable(name: &str, of_stop: Option<bool>) -> bool {
    let figures = match of_stop {
        Some(true) => STOP_FIGURES,
        Some(false) => OBJECT_FIGURES,
        None => return ["time", "switches", "complete"].contains(&name),
    };
    figures.iter().any(|figure| figure.name == name)
}

/// SI units of a measure: one, or that of turning and that of sliding.
fn units(measure: QuantityChoice) -> Vec<&'static str> {
    measure.quantities().map(|one| one.si()).collect()
}

/// One row of the list of results.
fn row(address: String, units: Vec<&str>, sign: &str, meaning: &str) -> Value {
    json!({ "address": address, "units": units, "sign": sign, "meaning": meaning })
}

fn part_rows(owner: &str, figures: &[Figure<OfCoordinate>]) -> Vec<Value> {
    let one = |figure: &Figure<OfCoordinate>| {
        let [turning, sliding] =
            [Turning, Sliding].map(|own| (figure.measure)(Measures(Some(own))));
        let mut both = units(turning);
        both.extend(units(sliding));
        both.dedup();
        let address = format!("{owner}.{}", figure.name);
        row(address, both, figure.sign, figure.meaning)
    };
    figures.iter().map(one).collect()
}

fn whole_rows(owner: &str, figures: &[Figure<Quantity>]) -> Vec<Value> {
    let one = |figure: &Figure<Quantity>| {
        let address = format!("{owner}.{}", figure.name);
        row(
            address,
            vec![figure.measure.si()],
            figure.sign,
            figure.meaning,
        )
    };
    figures.iter().map(one).collect()
}

/// All results that are known without a linkage, by what they belong to, and the reasons for
/// which a run stops. What is written in capitals stands for a name or a number.
pub(crate) fn described_results() -> Value {
    let hertz = || vec![q::FREQUENCY.si()];
    let second = || vec![q::TIME.si()];
    let mut object = part_rows("OBJECT", OBJECT_FIGURES);
    object.push(row(
        "OBJECT.pair.switch_times.N".to_owned(),
        second(),
        SIZE,
        "Time of event N of the driving contact, counted from 0.",
    ));
    let mut stop = part_rows("OBJECT.STOP", STOP_FIGURES);
    stop.push(row(
        "OBJECT.STOP.stop.switch_times.N".to_owned(),
        second(),
        SIZE,
        "Time of event N of the stop, counted from 0.",
    ));
    let mut run = whole_rows("run", RUN_FIGURES);
    run.push(row(
        "run.first_times.NAME".to_owned(),
        second(),
        SIZE,
        "First time at which the condition NAME of the scene holds; absent if it never does.",
    ));
    let frequency = [
        (
            "frequency.N",
            "Natural frequency N with all contacts closed, counted from 1, the lowest.",
        ),
        (
            "frequency.open.N",
            "Natural frequency N with all contacts separated, counted from 1, the lowest.",
        ),
    ];
    let frequency: Vec<Value> = frequency
        .map(|(address, meaning)| row(address.to_owned(), hertz(), SIZE, meaning))
        .into();
    let stops = STOPS.map(|(name, meaning)| json!({ "name": name, "meaning": meaning }));
    json!({
        "object": object,
        "stop": stop,
        "run": run,
        "steady": whole_rows("steady", STEADY_FIGURES),
        "cam": part_rows("cam.OBJECT", CAM_FIGURES),
        "frequency": frequency,
        "stops": stops,
    })
}
