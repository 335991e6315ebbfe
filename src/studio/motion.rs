//! The motion of an object, or of a drive, that is made of segments: what the studio draws of it and
//! lets be edited by hand.
//!
//! The window knows the text alone. Curves, greatest values and jumps are those of the program's own
//! functions; the window draws them and writes stations and laws into the text.

use crate::ask::Mechanism;
use crate::dynamics::model::{Coordinate, Model, NodeMotion, ObjectPart};
use crate::kinematics::breaks::Breaks;
use crate::kinematics::motion::cycle::Motion;
use crate::kinematics::motion::law::Peak;
use crate::kinematics::motion::{CycleSpec, DriveMotion};
use crate::kinematics::position::{CamSpec, Position};
use crate::math::jet::Jet;
use crate::report::live::samples;
use crate::studies::cycle::over_pieces;
use serde::Serialize;
use serde_json::{Value, json};
use std::f64::consts::TAU;

/// Equal steps over the cycle: one a degree of a turn.
const STEPS: usize = 360;

/// Shorter segments are none (rad).
const NO_ANGLE: f64 = 1e-9;

/// The beginning of a segment.
#[derive(Clone, Debug, Serialize)]
struct Station {
    /// On the axis of the text: the phase is not taken off.
    at: f64,
    displacement: f64,
    /// Which segment of a cam begins here; empty in a plan.
    part: &'static str,
    /// The motion from here on, by name or in words.
    law: String,
}

/// A motion of segments, as the text states it.
struct Segments {
    /// `cam` or `plan`.
    form: &'static str,
    stations: Vec<Station>,
    phase: f64,
    period: Option<f64>,
    advance: f64,
    breaks: Breaks,
}

impl Segments {
    fn of_cam(spec: &CamSpec, breaks: Breaks) -> Self {
        let (top, fall) = (spec.rise, spec.rise + spec.dwell);
        let end = fall + spec.return_angle;
        let dwell = || "dwell".to_owned();
        let all = [
            ("rise", [0.0, 0.0, spec.rise], spec.rise_law.words()),
            ("dwell", [top, spec.lift, spec.dwell], dwell()),
            (
                "return",
                [fall, spec.lift, spec.return_angle],
                spec.return_law.words(),
            ),
            ("rest", [end, 0.0, TAU - end], dwell()),
        ];
        let stations = all
            .into_iter()
            .filter(|(_, [.., length], _)| *length > NO_ANGLE);
        Self {
            form: "cam",
            stations: stations
                .map(|(part, [at, displacement, _], law)| Station {
                    at,
                    displacement,
                    part,
                    law,
                })
                .collect(),
            phase: spec.phase,
            period: Some(TAU),
            advance: 0.0,
            breaks,
        }
    }

    fn of_plan(spec: &CycleSpec, breaks: Breaks) -> Self {
        let stations = spec.stations.iter();
        Self {
            form: "plan",
            stations: stations
                .map(|one| Station {
                    at: one.at,
                    displacement: one.displacement,
                    part: "",
                    law: match &one.motion {
                        Motion::Dwell => "dwell".to_owned(),
                        Motion::Uniform => "uniform".to_owned(),
                        Motion::Smooth => "smooth".to_owned(),
                        Motion::Law(law) => law.words(),
                    },
                })
                .collect(),
            phase: spec.phase,
            period: spec.period,
            advance: spec.advance,
            breaks,
        }
    }

    /// What is drawn: a whole period from zero on, or the plan from end to end.
    fn range(&self) -> [f64; 2] {
        let points = &self.breaks.points;
        match (self.period, points.first(), points.last()) {
            (Some(period), ..) => [0.0, period],
            (None, Some(first), Some(last)) => [*first, *last],
            (None, ..) => [0.0, 0.0],
        }
    }

    /// Segments of the formula within the range, with their ends there.
    fn pieces(&self) -> Vec<(i64, [f64; 2])> {
        let [from, to] = self.range();
        let first = self.breaks.segment_at(from, 1.0);
        let edges = (first..).map(|segment| (segment, self.breaks.edges(segment)));
        let within = edges.take_while(|(_, (begin, _))| *begin < to);
        within
            .map(|(segment, (begin, end))| (segment, [begin.max(from), end.min(to)]))
            .filter(|(_, [begin, end])| end > begin)
            .collect()
    }

    /// Argument, displacement and derivatives, both sides of every joint.
    fn rows(&self, jet: &dyn Fn(i64, f64) -> Jet) -> Vec<[f64; 5]> {
        let ([from, to], pieces) = (self.range(), self.pieces());
        let ends = pieces.iter().map(|(_, ends)| *ends);
        samples(ends, [from, to - from], STEPS, |piece, at| {
            let found = jet(pieces[piece].0, at);
            [at, found.value, found.first, found.second, found.third]
        })
    }
}

/// The motion of the object `id`, where it is made of segments; `None`: it is not. `by_arm`: its
/// function gives an angle, and an arm the displacement.
pub(super) fn motion(mechanism: &Mechanism, id: &str, by_arm: bool) -> Option<Value> {
    let model = mechanism.model();
    let part = model.objects.iter().find(|part| part.id == id)?;
    if part.is_drive() {
        return of_drive(model, part);
    }
    let position = &model.nodes[part.nodes[0]].motion.law()?.position;
    let segments = match position {
        Position::Cam(cam) => Segments::of_cam(cam.spec(), position.breaks()),
        Position::Plan(cycle) => Segments::of_plan(cycle.spec(), position.breaks()),
        _ => return None,
    };
    let driver = &model.objects[part.driver()?];
    let unit = match by_arm {
        true => Coordinate::Turning.unit(),
        false => part.coordinate.unit(),
    };
    let speed = speed_of(model, driver);
    let axis = driver.coordinate.unit();
    let over_time = Jet {
        first: speed.unwrap_or(1.0),
        ..Jet::default()
    };
    Some(drawn(&segments, [unit, axis], speed, &|segment, phi| {
        position.jet(segment, phi).composed_with(over_time)
    }))
}

fn of_drive(model: &Model, part: &ObjectPart) -> Option<Value> {
    let NodeMotion::Prescribed { motion, .. } = &model.nodes[part.nodes[0]].motion else {
        return None;
    };
    let DriveMotion::Plan(cycle) = motion else {
        return None;
    };
    let segments = Segments::of_plan(cycle.spec(), motion.breaks());
    let units = [part.coordinate.unit(), "s"];
    Some(drawn(&segments, units, None, &|segment, time| {
        motion.jet(segment, time)
    }))
}

/// The constant speed of a drive (rad/s or m/s).
fn speed_of(model: &Model, part: &ObjectPart) -> Option<f64> {
    match &model.nodes[part.nodes[0]].motion {
        NodeMotion::Prescribed {
            motion: DriveMotion::Constant { speed, .. },
            ..
        } if *speed != 0.0 => Some(*speed),
        _ => None,
    }
}

/// Units of displacement, velocity, acceleration and jerk: over time where the speed is known.
fn units([unit, axis]: [&str; 2], speed: Option<f64>) -> [String; 4] {
    let axis = if speed.is_some() { "s" } else { axis };
    let per = |power: &str| format!("{unit}/{axis}{power}");
    [unit.to_owned(), per(""), per("²"), per("³")]
}

fn drawn(
    segments: &Segments,
    [unit, axis]: [&str; 2],
    speed: Option<f64>,
    jet: &dyn Fn(i64, f64) -> Jet,
) -> Value {
    let found = over_pieces(&segments.breaks, jet);
    let rows = segments.rows(jet);
    let column = |k: usize| rows.iter().map(|row| row[k]).collect::<Vec<f64>>();
    let sides = |up: Peak, down: Peak| {
        if up.value >= -down.value { up } else { down }
    };
    let jumps = found.jumps.iter().filter(|jump| jump.order < 3);
    json!({
        "form": segments.form,
        "stations": segments.stations,
        "phase": segments.phase,
        "period": segments.period,
        "advance": segments.advance,
        "range": segments.range(),
        "axis": axis,
        "speed": speed,
        "units": units([unit, axis], speed),
        "columns": [column(0), column(1), column(2), column(3), column(4)],
        "peaks": [
            sides(found.speed, found.return_speed),
            sides(found.acceleration, found.deceleration),
            found.jerk,
        ],
        "jumps": jumps.collect::<Vec<_>>(),
    })
}

#[cfg(test)]
mod tests {
    use super::motion;
    use crate::ask::Scene;
    use serde_json::Value;

    fn of(scenario: &str, id: &str) -> Value {
        let path = format!("{}/scenarios/{scenario}.json", env!("CARGO_MANIFEST_DIR"));
        let mechanism = Scene::read(path).unwrap().prepare().unwrap();
        motion(&mechanism, id, false).unwrap()
    }

    fn column(found: &Value, k: usize) -> Vec<f64> {
        let column = found["columns"][k].as_array().unwrap().iter();
        column.map(|one| one.as_f64().unwrap()).collect()
    }

    /// Derivatives by differences of the displacements, between joints.
    #[test]
    fn curves_are_the_displacement_and_its_derivatives_over_time() {
        for (scenario, id) in [
            ("cams/indexing_dwells", "table"),
            ("valve_train/valve_lash", "valve"),
            ("valve_train/in_working_order", "valve"),
        ] {
            let found = of(scenario, id);
            let speed = found["speed"].as_f64().unwrap();
            let columns: Vec<Vec<f64>> = (0..5).map(|k| column(&found, k)).collect();
            let at = &columns[0];
            let size = |k: usize| {
                columns[k]
                    .iter()
                    .fold(0.0, |most: f64, one| most.max(one.abs()))
            };
            let mut compared = 0;
            for row in 1..at.len() - 1 {
                let (before, after) = (at[row] - at[row - 1], at[row + 1] - at[row]);
                if after < 1e-6 || (before - after).abs() > 1e-9 {
                    continue;
                }
                let (dt, jerk) = (after / speed, size(4));
                for k in 1..4 {
                    let difference = (columns[k][row + 1] - columns[k][row - 1]) / (2.0 * dt);
                    let bound = [0.0, jerk * dt * dt, jerk * dt, 0.05 * jerk][k];
                    let error = (difference - columns[k + 1][row]).abs();
                    assert!(
                        error <= bound,
                        "{scenario} row {row}, derivative {k}: {error}"
                    );
                    compared += 1;
                }
            }
            assert!(compared > 600, "{scenario}: {compared}");
            for (k, peak) in found["peaks"].as_array().unwrap().iter().enumerate() {
                let (greatest, seen) = (peak["value"].as_f64().unwrap().abs(), size(k + 2));
                assert!(
                    seen <= greatest * (1.0 + 1e-12) && seen > 0.99 * greatest,
                    "{scenario}"
                );
            }
        }
    }

    #[test]
    fn stations_are_those_of_the_text_and_jumps_are_at_joints() {
        let found = of("valve_train/in_working_order", "valve");
        let stations = found["stations"].as_array().unwrap();
        let degrees = |one: &Value| one["at"].as_f64().unwrap().to_degrees().round();
        let at: Vec<f64> = stations.iter().map(degrees).collect();
        assert_eq!(at, [0.0, 70.0, 74.0, 144.0]);
        assert_eq!(stations[3]["part"], "rest");
        assert_eq!(
            found["units"],
            serde_json::json!(["m", "m/s", "m/s²", "m/s³"])
        );
        assert_eq!(found["jumps"], serde_json::json!([]));
        let soft = of("indexing/soft_shock", "lever");
        let jumps = soft["jumps"].as_array().unwrap();
        assert!(!jumps.is_empty() && jumps.iter().all(|jump| jump["order"] == 2));
        let joints = column(&soft, 0);
        for jump in jumps {
            let place = jump["at"]
                .as_f64()
                .unwrap()
                .rem_euclid(std::f64::consts::TAU);
            let near = joints
                .windows(2)
                .any(|two| two[0] == two[1] && (two[0] - place).abs() < 1e-9);
            assert!(near || place < 1e-9, "{jump}");
        }
    }

    #[test]
    fn what_is_not_made_of_segments_has_no_such_motion() {
        let path = format!(
            "{}/scenarios/four_bar/loom_sley.json",
            env!("CARGO_MANIFEST_DIR")
        );
        let mechanism = Scene::read(path).unwrap().prepare().unwrap();
        for part in &mechanism.model().objects {
            assert!(motion(&mechanism, &part.id, false).is_none());
        }
        assert!(motion(&mechanism, "nothing", false).is_none());
    }
}
