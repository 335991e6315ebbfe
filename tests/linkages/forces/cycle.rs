//! Sums over a course where friction changes its direction, against closed forms.

use super::mechanisms::{ground, of, push};
use dam::linkage::Linkage;
use dam::linkage::kinetostatics::InputMotion;
use dam::linkage::spec::{LinkSpec, LinkageSpec, PairKind, PairSpec, PointOf};
use dam::studies::forces::{Course, CycleForces, ForceSettings, Instant, LinkagePositions, study};
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, PI, TAU};

/// Weight on the sliding part (N) and coefficient of friction under it.
const WEIGHT: f64 = 40.0;
const FRICTION: f64 = 0.2;
/// Crank of the yoke (m).
const CRANK: f64 = 0.05;

fn link(name: &str) -> LinkSpec {
    LinkSpec {
        name: name.to_owned(),
        ..LinkSpec::default()
    }
}

fn pin(name: &str, on: PointOf, link: PointOf) -> PairSpec {
    PairSpec {
        name: name.to_owned(),
        on,
        link,
        kind: PairKind::Revolute { diameter: 0.0 },
        friction: 0.0,
    }
}

fn guide(name: &str, on: PointOf, link: PointOf, direction: f64, friction: f64) -> PairSpec {
    PairSpec {
        name: name.to_owned(),
        on,
        link,
        kind: PairKind::Sliding {
            direction,
            angle: -direction,
            corners: [0.1, -0.1],
            half_height: 0.0,
        },
        friction,
    }
}

fn summed(spec: LinkageSpec, course: Course) -> CycleForces {
    let linkage = Linkage::new(spec).unwrap();
    let mut positions = LinkagePositions::new(&linkage);
    let settings = ForceSettings::default();
    let found = study(linkage.spec(), &mut positions, course, settings).unwrap();
    found.cycle.expect("sums")
}

fn near(found: f64, wanted: f64, what: &str) {
    let off = (found - wanted).abs();
    assert!(off <= 1e-10 * wanted.abs(), "{what}: {found} for {wanted}");
}

/// A crank moves a yoke with a weight to and fro over 4·r a turn: seven
/// positions are as good as many, though the driving moment has its kinks and
/// the corners of the guide their jumps between them.
#[test]
fn a_yoke_loses_what_its_weight_rubs() {
    let spec = LinkageSpec {
        links: vec![link("crank"), link("block"), link("yoke")],
        pairs: vec![
            pin("O", ground(0.0, 0.0), of(0, 0.0, 0.0)),
            pin("A", of(0, CRANK, 0.0), of(1, 0.0, 0.0)),
            guide("slot", of(2, 0.0, 0.0), of(1, 0.0, 0.0), FRAC_PI_2, 0.0),
            guide("guide", ground(0.0, 0.0), of(2, 0.0, 0.0), 0.0, FRICTION),
        ],
        driver: 0,
        forces: vec![push("weight", of(2, 0.0, 0.0), [0.0, -WEIGHT])],
        start: 0.3,
        ..LinkageSpec::default()
    };
    let course = Course::Even {
        from: 0.3,
        to: 0.3 + TAU,
        count: 7,
        speed: 3.0,
        acceleration: 0.0,
        closed: true,
    };
    let sums = summed(spec, course);
    let loss = FRICTION * WEIGHT * 4.0 * CRANK;
    near(sums.duration, TAU / 3.0, "duration");
    near(sums.loss, loss, "loss");
    near(sums.drive_work, loss, "work of the driver");
    near(sums.pair_losses[3], loss, "loss in the guide");
    assert_eq!(sums.applied_work, 0.0);
    assert_eq!(sums.efficiency, Some(0.0));
    let moment = FRICTION * WEIGHT * CRANK;
    near(sums.mean_drive, 2.0 / PI * moment, "mean");
    near(sums.rms_drive, FRAC_1_SQRT_2 * moment, "root mean square");
}

/// A slide that turns back between two instants: its driving force jumps there.
#[test]
fn a_slide_turns_back_between_two_instants() {
    let spec = LinkageSpec {
        links: vec![link("slide")],
        pairs: vec![guide(
            "guide",
            ground(0.0, 0.0),
            of(0, 0.0, 0.0),
            0.0,
            FRICTION,
        )],
        driver: 0,
        forces: vec![push("weight", of(0, 0.0, 0.0), [0.0, -WEIGHT])],
        ..LinkageSpec::default()
    };
    let (turning, end) = (1.7, 4.0);
    let times = vec![0.0, 1.0, 2.5, end];
    let instant = |t: &f64| Instant {
        motion: InputMotion {
            coordinate: 0.5 * (t - turning) * (t - turning),
            speed: t - turning,
            acceleration: 1.0,
        },
        ..Instant::default()
    };
    let course = Course::Instants {
        instants: times.iter().map(instant).collect(),
        times,
        closed: false,
    };
    let sums = summed(spec, course);
    let (back, forth) = (turning, end - turning);
    let force = FRICTION * WEIGHT;
    near(sums.duration, end, "duration");
    near(sums.mean_drive, force * (forth - back) / end, "mean");
    near(sums.rms_drive, force, "root mean square");
    let way = 0.5 * (back * back + forth * forth);
    near(sums.loss, force * way, "loss");
    near(sums.drive_work, force * way, "work of the driver");
    assert_eq!(sums.efficiency, None);
}
