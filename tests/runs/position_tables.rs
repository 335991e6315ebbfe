//! Position functions by points: a cubic spline, whose third derivative jumps at each.
//! Methods of high order end their steps there.

use dam::prelude::*;
use std::f64::consts::TAU;

/// A lever of two masses on a table of so many points over a turn.
fn lever(points: usize, method: &str, tolerance: f64) -> RunResult {
    let place = |k: usize| TAU * k as f64 / points as f64;
    let bump = |k: usize| 0.05 * (7.3 * (k % points) as f64).sin();
    let table: Vec<String> = (0..=points)
        .map(|k| {
            format!(
                "[{:?}, {:?}]",
                place(k),
                0.2 * place(k % points).sin() + bump(k)
            )
        })
        .collect();
    let text = format!(
        r#"{{ "dam": 1, "name": "lever", "objects": {{
            "drive": {{ "kind": "drive", "motion": {{ "speed": 10 }} }},
            "lever": {{ "kind": "rocker", "input": "drive",
                "position": {{ "table": {{ "points": [{}], "periodic": true }} }},
                "inertia": 0.02, "stiffness": 2000, "damping_capacity": 0.3, "masses": 2,
                "loads": {{ "closing": {{ "constant": -30 }} }} }} }},
            "run": {{ "duration": 2, "tolerance": {tolerance:e}, "method": "{method}" }} }}"#,
        table.join(", ")
    );
    let scene = Scene::from_json(&text).unwrap();
    scene.run().unwrap()
}

#[test]
fn steps_end_at_the_points_of_a_table() {
    for points in [5, 12, 40] {
        let exact = lever(points, "exact", 1e-11);
        for method in ["dop853", "radau", "taylor"] {
            let run = lever(points, method, 1e-9);
            assert!(run.is_trusted(), "{method}, {points} points");
            for figure in [
                "delta_max",
                "peak_acceleration",
                "final.displacement",
                "final.speed",
            ] {
                let [found, wanted] = [&run, &exact]
                    .map(|run| run.figures.value(&format!("lever.{figure}")).unwrap());
                let off = (found / wanted - 1.0).abs();
                assert!(off < 1e-7, "{method}, {points} points, {figure}: {off:e}");
            }
            // Every second step was refused where steps lead over the points.
            let counts = run.outcome.statistics;
            assert!(
                3 * counts.rejected < counts.steps,
                "{method}, {points}: {counts:?}"
            );
        }
    }
}

/// A cam table of 0, 5, … 355 deg that dwells at its ends, with further properties.
fn open_table(more: &str, last: usize) -> Scene {
    let rows: Vec<String> = (0..=last)
        .map(|k| {
            let lift = if (10..50).contains(&k) {
                (k as f64 - 30.0).powi(2) - 400.0
            } else {
                0.0
            };
            format!(r#"["{} deg", {:?}]"#, 5 * k, -1e-5 * lift)
        })
        .collect();
    Scene::from_json(&format!(
        r#"{{ "dam": 1, "name": "lift", "objects": {{
            "drive": {{ "kind": "drive", "motion": {{ "speed": 10 }} }},
            "follower": {{ "kind": "slider", "input": "drive", "inertia": 1, "masses": 0,
                "position": {{ "table": {{ "points": [{}]{more} }} }} }} }},
            "run": {{ "duration": 1.3 }} }}"#,
        rows.join(", ")
    ))
    .unwrap()
}

#[test]
fn a_periodic_table_without_its_last_row_is_noticed() {
    let warnings = |more: &str, last: usize| {
        let warnings = open_table(more, last).check().unwrap();
        warnings
            .into_iter()
            .filter(|one| one.contains("repeats after"))
            .collect::<Vec<_>>()
    };
    let told = warnings(r#", "periodic": true"#, 71);
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(
        told[0].contains("355 deg") && told[0].contains("360 deg"),
        "{told:?}"
    );
    // With its last row, or with a period, nothing is said.
    assert!(warnings(r#", "periodic": true"#, 72).is_empty());
    assert!(warnings(r#", "periodic": true, "period": "355 deg""#, 71).is_empty());
    assert!(warnings(r#", "period": "360 deg""#, 71).is_empty());
}

#[test]
fn a_table_with_a_period_closes_by_itself() {
    let end = |scene: Scene| {
        let run = scene.run().unwrap();
        ["final.displacement", "final.speed", "peak_acceleration"]
            .map(|figure| run.figures.value(&format!("follower.{figure}")).unwrap())
    };
    let closed = end(open_table(r#", "periodic": true"#, 72));
    assert_eq!(end(open_table(r#", "period": "360 deg""#, 71)), closed);
    assert_eq!(end(open_table(r#", "period": "360 deg""#, 72)), closed);
    assert_ne!(end(open_table(r#", "periodic": true"#, 71)), closed);
    for wrong in [
        r#", "period": "350 deg""#,
        r#", "period": "360 deg", "periodic": false"#,
    ] {
        assert!(open_table(wrong, 71).run().is_err(), "{wrong}");
    }
}
