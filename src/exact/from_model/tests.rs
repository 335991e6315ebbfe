//! Fitted laws and loads against the motions that they follow.

use super::law::{CourseLaw, law};
use super::load::load;
use super::prescribed::PrescribedMotion;
use crate::dynamics::model::{Law as ModelLaw, LinearPiece};
use crate::exact::{LAW_DEGREE, Law, PolynomialSpan, SpanSource, TimeLoad};
use crate::kinematics::breaks::Breaks;
use crate::kinematics::motion::cycle::{CycleSpec, Motion, Station};
use crate::kinematics::motion::{DriveMotion, DriveMotionSpec, LawName, RunLawName};
use crate::kinematics::position::{CamSpec, Position, PositionSpec};

fn motions() -> Vec<DriveMotion> {
    let points = vec![
        (0.0, 0.8),
        (0.05, -1.5),
        (0.1, 1.7),
        (0.15, 1.9),
        (0.2, -1.5),
    ];
    [
        DriveMotionSpec::Constant {
            speed: 47.0,
            angle: 0.3,
        },
        DriveMotionSpec::Constant {
            speed: -31.0,
            angle: 0.0,
        },
        DriveMotionSpec::RunUp {
            speed: -40.0,
            time: 0.12,
            angle: 0.0,
            law: None,
        },
        DriveMotionSpec::RunUp {
            speed: 25.0,
            time: 0.15,
            angle: 0.2,
            law: Some(RunLawName::UnequalTrapezoid.into()),
        },
        DriveMotionSpec::Table { points },
        DriveMotionSpec::Accelerated {
            acceleration: 190.0,
            speed: -23.0,
            angle: 0.4,
        },
        DriveMotionSpec::Plan(over_time()),
    ]
    .iter()
    .map(|spec| DriveMotion::new(spec).expect("a motion"))
    .collect()
}

fn station(at: f64, displacement: f64, motion: Motion) -> Station {
    Station {
        at,
        displacement,
        speed: None,
        acceleration: None,
        order: 2,
        motion,
    }
}

/// A plan over time that turns the drive once in every 70 ms, with a stop.
fn over_time() -> CycleSpec {
    CycleSpec {
        stations: vec![
            station(0.0, 0.0, Motion::Law(LawName::ModifiedSine.into())),
            station(0.03, 2.5, Motion::Dwell),
            station(0.04, 2.5, Motion::Smooth),
        ],
        period: Some(0.07),
        advance: std::f64::consts::TAU,
        phase: 0.01,
    }
}

fn cam(rise_law: LawName, return_law: LawName) -> Position {
    let spec = CamSpec {
        lift: 0.2,
        rise: 1.7,
        dwell: 0.5,
        return_angle: 2.1,
        rise_law: rise_law.into(),
        return_law: return_law.into(),
        phase: -0.4,
    };
    Position::new(&PositionSpec::Cam(spec)).expect("a cam")
}

fn positions() -> Vec<Position> {
    let specs = [
        PositionSpec::Ratio {
            ratio: -0.7,
            offset: 0.2,
        },
        PositionSpec::Sine {
            amplitude: 0.4,
            harmonic: 2.0,
            phase: 0.3,
            offset: 0.1,
        },
        PositionSpec::Polynomial {
            coefficients: vec![0.1, 0.2, -0.02],
        },
        PositionSpec::Table {
            points: vec![(0.0, 0.0), (1.0, 0.1), (2.0, 0.35), (4.0, 0.1), (6.25, 0.0)],
            periodic: true,
            end_slopes: (0.0, 0.0),
        },
        PositionSpec::Table {
            points: vec![(-1.0, 0.0), (0.5, 0.3), (3.0, 0.1)],
            periodic: false,
            end_slopes: (0.1, -0.1),
        },
        PositionSpec::SliderCrank {
            crank: 0.04,
            rod: 0.13,
            offset: 0.01,
            branch: 1.0,
            phase: 0.2,
        },
        PositionSpec::FourBar {
            crank: 0.13,
            coupler: 0.1,
            rocker: 0.12,
            frame: 0.04,
            branch: 1.0,
            phase: 0.5,
        },
    ];
    let mut all: Vec<_> = specs
        .iter()
        .map(|spec| Position::new(spec).expect("a position"))
        .collect();
    all.push(cam(LawName::Harmonic, LawName::Cycloidal));
    all.push(cam(LawName::Polynomial4567, LawName::Polynomial345));
    all.push(cam(LawName::ModifiedTrapezoid, LawName::ModifiedTrapezoid));
    all.push(plan());
    all
}

/// A plan that advances by 0.3 in every turn.
fn plan() -> Position {
    let spec = CycleSpec {
        stations: vec![
            station(0.0, 0.0, Motion::Law(LawName::ModifiedSine.into())),
            station(1.2, 0.2, Motion::Dwell),
            station(1.9, 0.2, Motion::Smooth),
            station(3.5, 0.1, Motion::Smooth),
        ],
        period: Some(std::f64::consts::TAU),
        advance: 0.3,
        phase: 0.4,
    };
    Position::new(&PositionSpec::Plan(spec)).expect("a plan")
}

/// All motions through one position function, and through two.
fn courses() -> Vec<PrescribedMotion> {
    let mut all = Vec::new();
    for motion in motions() {
        let drive = PrescribedMotion::new(&motion);
        for first in positions() {
            let one = drive.through_position(&first, 1.3);
            for second in [&positions()[1], &positions()[7]] {
                all.push(one.through_position(second, -0.8));
            }
            all.push(one);
        }
    }
    all
}

/// Irregular instants over some cycles.
fn times() -> impl Iterator<Item = f64> {
    (0..400).map(|k| (f64::from(k) * 0.618_033_988_75).fract() * 0.5)
}

fn at(span: &PolynomialSpan, time: f64) -> [f64; 3] {
    let tau = (time - span.start) - span.low;
    let (mut value, mut speed) = (span.value + span.speed * tau, span.speed);
    let mut acceleration = 0.0;
    for (k, a) in span.acceleration.iter().enumerate() {
        let (power, k) = (tau.powi(k as i32), k as f64);
        acceleration += a * power;
        speed += a * power * tau / (k + 1.0);
        value += a * power * tau * tau / ((k + 1.0) * (k + 2.0));
    }
    [value, speed, acceleration]
}

#[test]
fn spans_follow_their_motion_everywhere() {
    for course in courses() {
        let depth = course.stages.len();
        let law = CourseLaw::new(course.clone());
        for time in times() {
            let span = law.span(time);
            assert!(span.start <= time && time < span.end, "{time} in {span:?}");
            let formulas = course.formulas(time);
            let wanted = course.at(&formulas, depth, time);
            let found = at(&span, time);
            let size = wanted.size.max(1.0);
            let label = format!("t = {time} of {course:?}: {found:?} for {wanted:?}");
            assert!(
                (found[0] - wanted.value).abs() <= 1e-12 * (1.0 + wanted.span),
                "{label}"
            );
            assert!(
                (found[1] - wanted.speed).abs() <= 1e-11 * (10.0 + wanted.speed.abs()),
                "{label}"
            );
            assert!(
                (found[2] - wanted.acceleration).abs() <= 1e-11 * size,
                "{label}"
            );
        }
    }
}

#[test]
fn every_instant_has_a_span_just_after_a_joint_too() {
    for course in courses() {
        let law = CourseLaw::new(course.clone());
        let (mut time, mut count) = (0.0, 0);
        while time < 1.0 {
            let span = law.span(time);
            assert!(
                span.value.is_finite() && span.end > time,
                "t = {time} of {course:?}"
            );
            // Value and speed do not jump at a joint.
            if span.end < 1.0 {
                let next = law.span(span.end);
                let before = at(&span, span.end);
                let after = at(&next, span.end);
                let size = 1.0 + before[0].abs();
                assert!(
                    (before[0] - after[0]).abs() <= 1e-12 * size,
                    "t = {} of {course:?}",
                    span.end
                );
                assert!((before[1] - after[1]).abs() <= 1e-10 * (10.0 + before[1].abs()));
            }
            time = span.end;
            count += 1;
        }
        assert!(count < 3000, "{count} spans in a second of {course:?}");
    }
}

#[test]
fn a_pure_sine_is_a_harmonic_and_agrees_with_its_spans() {
    let motion = &motions()[1];
    let sine = &positions()[1];
    let ratio = &positions()[0];
    let of = |position: &Position, lever| ModelLaw {
        driver: 0,
        position: position.clone(),
        lever,
        track: None,
    };
    let laws = [of(ratio, 1.5), of(sine, -2.0), of(ratio, 0.5)];
    let mut course = PrescribedMotion::new(motion);
    for law in &laws {
        course = course.through_position(&law.position, law.lever);
    }
    let closed = law(&course, &laws.iter().collect::<Vec<_>>());
    assert!(matches!(&closed, Law::Harmonic { sines, .. } if sines.len() == 1));
    let spans = CourseLaw::new(course);
    for time in times() {
        let (value, speed) = closed.at(time);
        let [other, rate, _] = at(&spans.span(time), time);
        approx::assert_abs_diff_eq!(value, other, epsilon = 1e-13);
        approx::assert_abs_diff_eq!(speed, rate, epsilon = 1e-11);
    }
}

#[test]
fn loads_over_a_displacement_follow_their_table() {
    let breaks = Breaks {
        points: vec![0.0, 1.0, 2.5, 4.0],
        period: Some(std::f64::consts::TAU),
    };
    let values = [0.0, -7.0, 3.0, 0.0, 0.0];
    let ends = [0.0, 1.0, 2.5, 4.0, std::f64::consts::TAU];
    let pieces: Vec<LinearPiece> = (0..4)
        .map(|k| LinearPiece {
            start: ends[k],
            value: values[k],
            slope: (values[k + 1] - values[k]) / (ends[k + 1] - ends[k]),
        })
        .collect();
    let direct = |x: f64| {
        let (index, shift) = breaks.piece(breaks.segment_at(x, 1.0));
        pieces[index].value + pieces[index].slope * (x - shift - pieces[index].start)
    };
    for course in courses().into_iter().chain([PrescribedMotion::time()]) {
        let TimeLoad::Pieces(source) = load(course.clone(), &breaks, &pieces, 2.0) else {
            panic!("pieces");
        };
        for time in times() {
            let piece = source.piece(time);
            assert!(piece.end > time, "t = {time} of {course:?}");
            // Halfway to the end, or there.
            for share in [0.0, 0.3, 0.9] {
                let tau = share * (piece.end - time).min(0.1);
                let powers = (0..=LAW_DEGREE).map(|k| piece.coefficients[k] * tau.powi(k as i32));
                let formulas = course.formulas(time);
                let place = course.at(&formulas, course.stages.len(), time + tau);
                let found: f64 = powers.sum();
                let wanted = 2.0 * direct(place.value);
                let off = (found - wanted).abs();
                assert!(
                    off <= 1e-10 * (10.0 + place.span),
                    "t = {time}, {share}: {found} for {wanted}, {course:?}"
                );
            }
        }
    }
}
