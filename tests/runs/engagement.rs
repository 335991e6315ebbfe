//! Dry friction that is engaged over time or a motion: clutches and brakes that are pressed.
//! Closed forms and the balance of momentum.

use super::dry_friction::{METHODS, figures, ran, refused, system};
use dam::integrate::Method;

/// Two rotors (0.4 and 0.6 kg m²) joined by a clutch of 60 N m, 5 N m on the first.
fn clutch(engagement: &str) -> String {
    format!(
        r#"{{ "dam": 1, "name": "clutch", "objects": {{
            "motor": {{ "kind": "drive",
                "motor": {{ "inertia": 0.4, "speed": 100, "torque": {{ "constant": 5 }} }},
                "loads": {{ "clutch": {{ "over": "wheel",
                    "friction": {{ "sliding": 60, "engagement": "{engagement}" }} }} }} }},
            "wheel": {{ "kind": "drive",
                "motor": {{ "inertia": 0.6, "speed": 0, "torque": {{ "constant": 0 }} }} }} }},
            "run": {{ "duration": 1.5 }} }}"#
    )
}

/// Closed from 0.2 s on: slips, and then both run together.
#[test]
fn a_clutch_that_closes_slips_until_both_run_together() {
    let slip = 102.5 / (55.0 / 0.4 + 60.0 / 0.6);
    let rest: f64 = 1.3 - slip;
    let speed = 60.0 / 0.6 * slip;
    let together = speed * rest + 2.5 * rest * rest;
    let wheel = 0.5 * speed * slip + together;
    let motor = 0.2 * 101.25 + 0.5 * (102.5 + speed) * slip + together;
    for method in METHODS {
        let result = ran(&system(&clutch("t < 0.2 ? 0 : 1")), method, 1.5, 1e-10);
        let [one, other] = ["motor", "wheel"].map(|object| figures(&result, object).end);
        for (own, angle) in [(one, motor), (other, wheel)] {
            assert!((own.displacement - angle).abs() < 1e-7, "{method:?}");
            assert!((own.speed - 47.5).abs() < 1e-8, "{method:?}");
        }
        let rubs = figures(&result, "motor").joints.expect("friction");
        assert!((rubs.time_at_rest - rest).abs() < 1e-8, "{method:?}");
        let loss = 60.0 * 0.5 * 102.5 * slip;
        assert!((rubs.friction_loss - loss).abs() < 1e-5, "{method:?}");
        assert_eq!(rubs.standstills, 1, "{method:?}");
    }
}

/// Opened again at 1 s: what is carried along goes on alone.
#[test]
fn a_clutch_that_opens_lets_go_at_once() {
    let text = clutch("t > 0.2 && t < 1 ? 1 : 0");
    for method in METHODS {
        let result = ran(&system(&text), method, 1.5, 1e-10);
        let [one, other] = ["motor", "wheel"].map(|object| figures(&result, object).end.speed);
        // 0.4·100 + 5·1 of momentum at 1 s on 1 kg m².
        assert!((other - 45.0).abs() < 1e-8, "{method:?}: {other}");
        let alone = 45.0 + 5.0 / 0.4 * 0.5;
        assert!((one - alone).abs() < 1e-8, "{method:?}: {one}");
    }
}

/// Pressed by and by, up to 4 times what it has to carry, and released by and by: it carries 3 N m
/// of 60, so that it slips again where less than a twentieth is left.
#[test]
fn a_clutch_that_is_released_slowly_slips_where_it_no_longer_carries() {
    let text = clutch("t < 0.5 ? 2*t : t < 1 ? 1 : max(1 - 4*(t - 1), 0)");
    let result = [Method::Radau, Method::Dop853].map(|own| ran(&system(&text), own, 1.5, 1e-10));
    // From 1.2375 s on 60·(1 − 4·(t − 1)) N m up to 1.25 s: 60·4·0.0125²/2 N m s.
    let together = 0.4 * 100.0 + 5.0 * 1.2375;
    let wheel = together + 60.0 * 4.0 * 0.0125 * 0.0125 / 2.0 / 0.6;
    for result in &result {
        let own = figures(result, "wheel").end.speed;
        assert!((own - wheel).abs() < 1e-7, "{own} {wheel}");
        let motor = figures(result, "motor").end.speed;
        assert!((0.4 * motor + 0.6 * own - 47.5).abs() < 1e-8);
    }
}

/// A block on the ground, pressed in a part of its way only: loses the work of that part.
#[test]
fn a_brake_over_a_part_of_the_way_takes_the_work_of_that_part() {
    let text = r#"{ "dam": 1, "name": "brake", "objects": {
        "block": { "kind": "drive", "coordinate": "sliding",
            "motor": { "inertia": 2, "speed": 3, "force": { "constant": 0 } },
            "loads": { "brake": { "friction": { "sliding": 4, "static": 6,
                "engagement": "phi > 1 && phi < 2 ? 0.5 : 0" } } } } },
        "run": { "duration": 2 } }"#;
    for method in METHODS {
        let result = ran(&system(text), method, 2.0, 1e-10);
        let speed = figures(&result, "block").end.speed;
        assert!((speed - (9.0f64 - 2.0).sqrt()).abs() < 1e-8, "{method:?}");
    }
}

/// What is never engaged, or below zero, does nothing; half engaged is half of it.
#[test]
fn what_is_not_engaged_does_nothing() {
    // (Half engaged it slips all the time: 30 N m.)
    let cases = [("0", 5.0), ("-1", 5.0), ("t - 9", 5.0), ("0.5", 5.0 - 30.0)];
    for (engagement, torque) in cases {
        let result = ran(&system(&clutch(engagement)), Method::Radau, 0.5, 1e-10);
        let own = figures(&result, "motor").end.speed;
        let expected = 100.0 + torque / 0.4 * 0.5;
        assert!((own - expected).abs() < 1e-8, "{engagement}: {own}");
    }
    let equal = clutch("0").replace("\"speed\": 0,", "\"speed\": 100,");
    let idle = equal.replace("\"constant\": 5", "\"constant\": 0");
    let result = ran(
        &system(&idle.replace("\"0\"", "\"t - 9\"")),
        Method::Radau,
        0.5,
        1e-10,
    );
    assert!((figures(&result, "motor").end.speed - 100.0).abs() < 1e-12);
}

#[test]
fn an_engagement_that_cannot_be_is_refused() {
    for (engagement, words) in [("t <", "ends too early"), ("speed", "speed")] {
        let message = refused(&clutch(engagement));
        assert!(message.contains(words), "{engagement}: {message}");
    }
    let smooth = clutch("1").replace("\"sliding\": 60", "\"force\": 60, \"width\": 0.1");
    assert!(refused(&smooth).contains("no `engagement`"));
}
