use super::*;

/// Cases A–E of the peers' comparison.
pub(crate) fn peer(n: usize, load: f64, psi: f64) -> TreeProblem {
    let masses = (0..n)
        .map(|m| {
            let (a, b) = ((m + 1) as f64 / n as f64, m as f64 / n as f64);
            let inertia = 0.1 * (a.powi(3) - b.powi(3));
            let c = n as f64 * 1e7;
            let damping = psi * (c * inertia).sqrt() / std::f64::consts::TAU;
            let mut mass = TreeMass::new(inertia, m.checked_sub(1), c, damping);
            if m == 0 {
                mass.pair = TreePair::Force { opens: 1.0 };
            }
            if m + 1 == n {
                mass.loads.push(TimeLoad::Constant(-load));
            }
            mass
        })
        .collect();
    let law = Law::Harmonic {
        mean: 0.0,
        slope: 0.0,
        sines: vec![Sine {
            amplitude: std::f64::consts::FRAC_PI_2,
            frequency: 20.0 * std::f64::consts::PI,
            phase: 0.0,
        }],
    };
    TreeProblem { masses, law, displacement: vec![0.0; n], speed: vec![0.0; n], objects: vec![TreeObject { first: 0, last: n - 1, driver: None }] }
}

#[test]
fn peer_cases_agree_with_the_references() {
    for (name, n, load, psi, end, switches) in [
        ("A", 1, 1000.0, 0.4, 1.0, 0),
        ("B", 1, 600.0, 0.4, 1.0, 300),
        ("C", 2, 600.0, 0.4, 1.0, 446),
        ("D", 10, 1000.0, 0.4, 1.0, 87),
        ("E", 1, 600.0, 0.0, 0.1, 103),
    ] {
        let Ok(text) = std::fs::read_to_string(format!("/work/shared/peers/ref/{name}.txt")) else { return };
        let reference: Vec<f64> = text.lines().map(|l| l.split_whitespace().nth(1).unwrap().parse().unwrap()).collect();
        let tree = ExactTree::new(peer(n, load, psi));
        let run = tree.run(&Request::new(end, 1000)).unwrap();
        let scale = reference.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        let error = reference.iter().zip(&run.samples).fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
        println!("{name}: error {:.2e} samples {} switches {} ({switches}) phases {} steps {} evaluations {} grazing {}", error / scale, run.samples.len(), run.switches.len(), run.phases, run.steps, run.evaluations, run.grazing);
    }
}
