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
