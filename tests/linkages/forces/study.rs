//! Studies over a turn: the paper's comparison, zones of self-locking,
//! efficiency, the counterweight.

use super::mechanisms::{Known, known, spec};
use super::reference;
use dam::linkage::spec::LinkageSpec;
use dam::report::forces::{ForcesReport, document};
use dam::studies::forces::{
    Course, ForceSettings, ForceStudy, PositionSource, ZoneKind, columns, compare_massless, study,
};
use serde_json::Value;
use std::f64::consts::{PI, TAU};

/// Positions written down by hand as a source.
struct Hand {
    kind: String,
    data: Value,
    at: Known,
}

impl Hand {
    fn new(kind: &str, data: &Value) -> Self {
        Self {
            kind: kind.to_owned(),
            data: data.clone(),
            at: known(kind, data, 0.0).0,
        }
    }
}

impl PositionSource for Hand {
    type At = Known;

    fn at(&mut self, coordinate: f64) -> Result<&Known, String> {
        self.at = known(&self.kind, &self.data, coordinate).0;
        Ok(&self.at)
    }
}

fn turn(count: usize, speed: f64) -> Course {
    Course::Even {
        from: 0.0,
        to: TAU,
        count,
        speed,
        acceleration: 0.0,
        closed: true,
    }
}

fn case(id: &str) -> Value {
    let reference = reference();
    let cases = reference["cases"].as_array().unwrap();
    cases.iter().find(|case| case["id"] == id).unwrap().clone()
}

fn settings() -> ForceSettings {
    ForceSettings {
        output: Some(0),
        ..ForceSettings::default()
    }
}

fn studied(linkage: &LinkageSpec, case: &Value, course: Course) -> ForceStudy {
    let kind = case["kind"].as_str().unwrap();
    let mut source = Hand::new(kind, &case["data"]);
    study(linkage, &mut source, course, settings()).unwrap()
}

fn of(id: &str, count: usize) -> ForceStudy {
    let case = case(id);
    let linkage = spec(case["kind"].as_str().unwrap(), &case["data"]);
    let speed = case["phi1dot"].as_f64().unwrap();
    studied(&linkage, &case, turn(count, speed))
}

/// The paper calls the influence of masses negligible; it grows to 23 %.
#[test]
fn masses_are_negligible_only_at_low_speed() {
    let case = case("paper-rod-mass-ratio0.1");
    let linkage = spec("slider_crank", &case["data"]);
    let mut source = Hand::new("slider_crank", &case["data"]);
    let parameters = [0.1, 0.4, 2.5, 10.0];
    let found = compare_massless(
        &linkage,
        &mut source,
        &turn(24, 10.0),
        &settings(),
        &parameters,
    )
    .unwrap();
    // In steps of 15°, as the comparison was first made: 0.23 %, 0.93 %, 5.8 %, 23 %.
    for (point, (wanted, within)) in
        found
            .points
            .iter()
            .zip([(0.0023, 5e-5), (0.0093, 5e-5), (0.058, 5e-4), (0.23, 5e-3)])
    {
        assert!(
            (point.deviation - wanted).abs() <= within,
            "{}: {}",
            point.parameter,
            point.deviation
        );
    }
    assert_eq!(
        found
            .points
            .iter()
            .map(|p| p.speed.round())
            .collect::<Vec<_>>(),
        [10.0, 20.0, 50.0, 100.0]
    );
    let limit = found.negligible_up_to.unwrap();
    assert!((0.42..0.44).contains(&limit), "{limit}");
}

/// Around the dead centres the load cannot drive the crank against friction.
#[test]
fn zones_of_self_locking() {
    let found = of("paper-massless-mu0.1", 24);
    let kinds: Vec<_> = found.zones.iter().map(|zone| zone.kind).collect();
    assert_eq!(kinds, [ZoneKind::SelfLocking; 2], "{:?}", found.zones);
    // The load pushes the slider towards the crank and drives from 0 to π: it
    // fails to just before π and just after 0; no zone runs past the turn.
    let [after, before] = [found.zones[0], found.zones[1]];
    assert!((before.to - PI).abs() < 1e-9 && after.from.abs() < 1e-9);
    for inner in [before.from, after.to] {
        let case = case("paper-massless-mu0.1");
        let linkage = spec("slider_crank", &case["data"]);
        let course = Course::Even {
            from: inner,
            to: inner + 1e-3,
            count: 2,
            speed: 10.0,
            acceleration: 0.0,
            closed: false,
        };
        // There the driver has nothing to do.
        let at = studied(&linkage, &case, course);
        let (_, forces) = at.solved().next().unwrap();
        assert!(forces.drive.abs() < 1e-9, "{inner}: {}", forces.drive);
    }
    assert!(before.to - before.from > 0.05 && after.to - after.from > 0.05);
    // A range has the same zones from either end, also between its positions.
    let case = case("paper-massless-mu0.1");
    let linkage = spec("slider_crank", &case["data"]);
    let range = |from: f64, to: f64| {
        let course = Course::Even {
            from,
            to,
            count: 5,
            speed: 10.0,
            acceleration: 0.0,
            closed: false,
        };
        studied(&linkage, &case, course).zones
    };
    let (up, down) = (range(2.0, 4.0), range(4.0, 2.0));
    assert_eq!((up.len(), down.len()), (1, 1), "{up:?} {down:?}");
    for found in [up[0], down[0]] {
        assert!((found.from - before.from).abs() < 1e-9, "{found:?}");
        assert!((found.to - before.to).abs() < 1e-9, "{found:?}");
    }
}

/// At μ = 1.3 nothing moves the slider-crank around 180°: a zone of its own.
#[test]
fn locked_positions_are_a_zone() {
    let case = reference()["stress"][1].clone();
    let mut linkage = spec("slider_crank", &case["data"]);
    linkage
        .pairs
        .iter_mut()
        .for_each(|pair| pair.friction = 1.3);
    let course = Course::Even {
        from: 0.6 * PI,
        to: 1.2 * PI,
        count: 20,
        speed: 10.0,
        acceleration: 0.0,
        closed: false,
    };
    let found = studied(&linkage, &case, course);
    let locked = found
        .zones
        .iter()
        .find(|zone| zone.kind == ZoneKind::Locked)
        .unwrap();
    assert!(locked.from < PI && locked.to > PI, "{locked:?}");
    assert!(
        found
            .warnings()
            .iter()
            .any(|text| text.contains("self-locking"))
    );
    assert!(found.cycle.is_none());
}

#[test]
fn efficiency_of_a_cycle() {
    let found = of("four-bar", 720);
    let cycle = found.cycle.as_ref().unwrap();
    let sum: f64 = cycle.pair_losses.iter().sum();
    assert!((sum - cycle.loss).abs() < 1e-12 * sum);
    // A constant couple on a rocker that returns takes no work over a cycle:
    // the driver covers the loss alone.
    assert!((cycle.drive_work - cycle.loss).abs() < 1e-12 * sum);
    assert!(cycle.efficiency.unwrap() < 1e-12);
    assert!(found.worst_balance() < 1e-11);
    assert!(found.worst_influence() < 1e-13);
    assert!(found.warnings().is_empty());
    // Sums that there are none of although every position has its forces.
    let mut without = found.clone();
    without.cycle = None;
    let warnings = without.warnings().join(" ");
    assert!(warnings.contains("between two positions"), "{warnings}");
    for extreme in &found.extremes {
        assert!(extreme.least.value <= extreme.greatest.value);
    }
    let said = found.warnings();
    let report = ForcesReport {
        study: &found,
        warnings: &said,
        massless: None,
        object: "linkage",
        motion: "steadily",
        name: "four-bar",
        hash: "",
    };
    let text = document(&report).to_string();
    assert!(!text.contains("NaN"));
    assert_eq!(
        columns(&found.linkage, Some(0)).len(),
        columns(&found.linkage, None).len() + 10
    );
}

/// With the counterweight on the crank the shaking force is what was foretold,
/// and any other counterweight leaves more.
#[test]
fn the_counterweight_is_the_best_one() {
    let case = case("four-bar");
    let linkage = spec("four_bar", &case["data"]);
    let found = studied(&linkage, &case, turn(90, 15.0))
        .counterweight
        .unwrap();
    let rms = |mass_radius: f64, angle: f64| {
        let mut balanced = linkage.clone();
        let link = &mut balanced.links[found.link];
        // A small mass far out: the sum of both masses' moments.
        let extra = 1e-6;
        let total = link.mass + extra;
        let radius = mass_radius / extra;
        let (sin, cos) = angle.sin_cos();
        for (axis, direction) in [cos, sin].into_iter().enumerate() {
            link.centre[axis] =
                (link.mass * link.centre[axis] + extra * radius * direction) / total;
        }
        link.mass = total;
        let study = studied(&balanced, &case, turn(90, 15.0));
        // The end of the turn is its start.
        let squares = study
            .solved()
            .take(90)
            .map(|(_, f)| f.shaking[0].powi(2) + f.shaking[1].powi(2));
        (squares.sum::<f64>() / 90.0).sqrt()
    };
    let best = rms(found.mass_radius, found.angle);
    assert!(
        (best - found.rms[1]).abs() < 1e-9 * best,
        "{best} {found:?}"
    );
    assert!(best < found.rms[0]);
    for (factor, turn) in [(1.01, 0.0), (0.99, 0.0), (1.0, 0.02), (1.0, -0.02)] {
        assert!(rms(found.mass_radius * factor, found.angle + turn) > best);
    }
}

/// Extremes lie between the positions and are those of a much finer course.
#[test]
fn extremes_do_not_depend_on_the_positions() {
    let [coarse, fine] = [36, 720].map(|count| of("four-bar", count));
    for (a, b) in coarse.extremes.iter().zip(&fine.extremes) {
        // χ changes its sign where the rocker reverses, the efficiency dips.
        if ["efficiency", "chi"].contains(&a.name.as_str()) {
            continue;
        }
        let name = &a.name;
        for (a, b) in [(a.least, b.least), (a.greatest, b.greatest)] {
            assert!(
                (a.value - b.value).abs() <= 1e-6 * (1e-3 + b.value.abs()),
                "{name} {a:?} {b:?}"
            );
        }
    }
}
