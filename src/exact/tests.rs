//! The propagation against trajectories and figures computed elsewhere.

use super::*;
use serde_json::Value;

const REFERENCE: &str = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/reference/elastic-rocker.json"));

/// A chain on a sine law of amplitude π/2.
pub(crate) fn chain(
    inertia: f64,
    stiffness: f64,
    n: usize,
    frequency: f64,
    damping: impl Fn(f64, f64) -> f64,
) -> TreeProblem {
    let masses = (0..n)
        .map(|m| {
            let (a, b) = ((m + 1) as f64 / n as f64, m as f64 / n as f64);
            let inertia = inertia * (a.powi(3) - b.powi(3));
            let c = n as f64 * stiffness;
            TreeMass::new(inertia, m.checked_sub(1), c, damping(c, inertia))
        })
        .collect();
    let law = Law::Harmonic {
        mean: 0.0,
        slope: 0.0,
        sines: vec![Sine {
            amplitude: std::f64::consts::FRAC_PI_2,
            frequency: std::f64::consts::TAU * frequency,
            phase: 0.0,
        }],
    };
    let objects = vec![TreeObject { first: 0, last: n - 1, driver: None }];
    TreeProblem { masses, law, displacement: vec![0.0; n], speed: vec![0.0; n], objects }
}

fn reference_problem(inputs: &Value) -> TreeProblem {
    let number = |name: &str| inputs[name].as_f64().expect(name);
    let (j, c, psi) = (number("inertia_kg_m2"), number("stiffness_N_m_per_rad"), number("psi"));
    let n = number("masses") as usize;
    let base = std::f64::consts::TAU * (c / j).sqrt();
    let mut problem = chain(j, c, n, number("frequency_Hz"), |c, _| psi * c / base);
    let load = number("closing_moment_N_m");
    problem.masses[0].pair = match inputs["closure"].as_str() {
        Some("form") => TreePair::Form { gap: number("gap_rad") },
        _ => TreePair::Force { opens: 1.0 },
    };
    problem.masses[n - 1].loads.push(TimeLoad::Constant(-load));
    if inputs["start"] == "static" {
        for m in 0..n {
            problem.displacement[m] = -load / c * (m + 1) as f64 / n as f64;
        }
    }
    problem
}

#[test]
fn all_reference_cases() {
    let all: Value = serde_json::from_str(REFERENCE).expect("JSON");
    for (name, case) in all["cases"].as_object().expect("cases") {
        let inputs = &case["inputs"];
        let end = inputs["duration_s"].as_f64().expect("duration");
        let problem = reference_problem(inputs);
        let tree = ExactTree::new(problem);
        let run = tree.run(&Request { figures: true, ..Request::new(end, 40) }).expect("runs");
        let out = &case["outputs"];
        let figure = |key: &str| out[key].as_f64().expect("number");
        let f = run.figures[0];
        let scale = figure("delta_max_rad").abs().max(figure("delta_min_rad").abs());
        let opened = run.switches.iter().filter(|s| s.before.engaged()).count();
        let closed = run.switches.iter().filter(|s| s.after.engaged()).count();
        println!(
            "{name}: max {:.1e} min {:.1e} sigma {:.1e} end {:.1e} lift {:.3e} {opened}/{} {closed}/{}  steps {} grazing {}",
            (f.delta_max - figure("delta_max_rad")) / scale,
            (f.delta_min - figure("delta_min_rad")) / scale,
            (f.sigma - figure("sigma_rad")) / figure("sigma_rad"),
            (run.displacement.last().unwrap() - (figure("phi_n_end_rad") - std::f64::consts::FRAC_PI_2 * (std::f64::consts::TAU * inputs["frequency_Hz"].as_f64().unwrap() * end).sin())) / scale,
            f.max_lift,
            out["separations"], out["closures"], run.steps, run.grazing
        );
        let switch: f64 = out["first_switch_times_s"].as_array().unwrap().iter().zip(&run.switches).map(|(t, s)| (t.as_f64().unwrap() - s.time).abs()).fold(0.0, f64::max);
        println!("      switch times {switch:.1e}");
    }
}
