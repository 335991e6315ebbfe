//! The propagation against trajectories and figures computed elsewhere.

use super::*;
use serde_json::Value;

const REFERENCE: &str = include_str!(concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/tests/reference/elastic-rocker.json"
));

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
    let objects = vec![TreeObject {
        first: 0,
        output: vec![(n - 1, 1.0)],
        driver: None,
    }];
    TreeProblem {
        masses,
        law,
        displacement: vec![0.0; n],
        speed: vec![0.0; n],
        objects,
    }
}

fn reference_problem(inputs: &Value) -> TreeProblem {
    let number = |name: &str| inputs[name].as_f64().expect(name);
    let (j, c, psi) = (
        number("inertia_kg_m2"),
        number("stiffness_N_m_per_rad"),
        number("psi"),
    );
    let n = number("masses") as usize;
    let base = std::f64::consts::TAU * (c / j).sqrt();
    let mut problem = chain(j, c, n, number("frequency_Hz"), |c, _| psi * c / base);
    let load = number("closing_moment_N_m");
    problem.masses[0].pair = match inputs["closure"].as_str() {
        Some("form") => TreePair::Form {
            gap: number("gap_rad"),
        },
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
fn damped_reference_cases_agree_to_their_tolerance_with_exact_counts() {
    let all: Value = serde_json::from_str(REFERENCE).expect("JSON");
    let mut checked = 0;
    for (name, case) in all["cases"].as_object().expect("cases") {
        let (inputs, out) = (&case["inputs"], &case["outputs"]);
        let figure = |key: &str| out[key].as_f64().expect("number");
        let thrown = figure("delta_max_rad") > 1.0;
        let undamped = inputs["psi"] == 0.0;
        if undamped && inputs["masses"] != 1 {
            continue;
        }
        checked += 1;
        let tolerance = if thrown { 1e-6 } else { 1e-9 };
        let end = inputs["duration_s"].as_f64().expect("duration");
        let tree = ExactTree::new(reference_problem(inputs));
        let run = tree
            .run(&Request {
                figures: true,
                audit: true,
                ..Request::new(end, 40)
            })
            .expect("runs");
        let f = run.figures[0];
        let audit = run.audit.expect("audit");
        assert!(audit.error() < 1e-12, "{name}: {audit:?}");
        let scale = figure("delta_max_rad")
            .abs()
            .max(figure("delta_min_rad").abs());
        let close = |what: &str, value: f64, reference: f64, scale: f64| {
            let error = (value - reference).abs() / scale;
            assert!(
                error < tolerance,
                "{name}: {what} {value} {reference} {error:e}"
            );
        };
        close("delta_max", f.delta_max, figure("delta_max_rad"), scale);
        close("delta_min", f.delta_min, figure("delta_min_rad"), scale);
        close("sigma", f.sigma, figure("sigma_rad"), figure("sigma_rad"));
        let omega = std::f64::consts::TAU * inputs["frequency_Hz"].as_f64().expect("number");
        let law = std::f64::consts::FRAC_PI_2 * (omega * end).sin();
        let last = run.displacement[run.displacement.len() - 1];
        close("end", last + law, figure("phi_n_end_rad"), scale);
        let opened = run.switches.iter().filter(|s| s.before.engaged()).count() as u64;
        let closed = run.switches.iter().filter(|s| s.after.engaged()).count() as u64;
        assert_eq!(
            (opened, closed),
            (
                out["separations"].as_u64().unwrap_or(0),
                out["closures"].as_u64().unwrap_or(0)
            ),
            "{name}"
        );
        let times = out["first_switch_times_s"].as_array().expect("times");
        for (time, switch) in times.iter().zip(&run.switches) {
            let time = time.as_f64().expect("number");
            assert!(
                (time - switch.time).abs() < 1e-11,
                "{name}: {time} {}",
                switch.time
            );
        }
        let approach = run
            .switches
            .iter()
            .filter(|s| s.after.engaged())
            .fold(0.0f64, |m, s| m.max(-s.speed));
        close(
            "approach",
            approach,
            figure("max_approach_speed_rad_per_s"),
            approach.max(1.0),
        );
        for (k, sample) in case["samples"]
            .as_array()
            .expect("samples")
            .iter()
            .enumerate()
            .skip(1)
        {
            let t = sample["t"].as_f64().expect("t");
            let law = std::f64::consts::FRAC_PI_2 * (omega * t).sin();
            close(
                "sample",
                run.samples[k - 1] + law,
                sample["phi_n"].as_f64().expect("phi"),
                scale,
            );
        }
        assert_eq!(run.grazing, 0, "{name}");
    }
    assert_eq!(checked, 12);
}

#[test]
fn one_undamped_mass_is_thrown_higher_every_cycle() {
    // 0.0464570 rad and 155 switches after three cycles, 40-digit arithmetic.
    let mut problem = chain(0.1, 1e7, 1, 10.0, |_, _| 0.0);
    problem.masses[0].pair = TreePair::Force { opens: 1.0 };
    problem.masses[0].loads.push(TimeLoad::Constant(-600.0));
    problem.displacement[0] = -6e-5;
    let request = Request {
        figures: true,
        ..Request::new(0.3, 0)
    };
    let run = ExactTree::new(problem).run(&request).expect("runs");
    assert_eq!(run.switches.len(), 155);
    approx::assert_abs_diff_eq!(run.figures[0].delta_max, 0.0464570, epsilon = 5e-8);
    approx::assert_relative_eq!(
        run.figures[0].max_lift,
        run.figures[0].delta_max,
        max_relative = 1e-12
    );
}

/// Cases A–E of the comparison with general solvers: masses, load, ψ, duration,
/// with local dampers b_m = ψ√(c_m J_m)/2π, started on the law.
const COMPARED: [(usize, f64, f64, f64); 5] = [
    (1, 1000.0, 0.4, 1.0),
    (1, 600.0, 0.4, 1.0),
    (2, 600.0, 0.4, 1.0),
    (10, 1000.0, 0.4, 1.0),
    (1, 600.0, 0.0, 0.1),
];

fn compared((n, load, psi, _): (usize, f64, f64, f64)) -> TreeProblem {
    let local = |c: f64, j: f64| psi * (c * j).sqrt() / std::f64::consts::TAU;
    let mut problem = chain(0.1, 1e7, n, 10.0, local);
    problem.masses[0].pair = TreePair::Force { opens: 1.0 };
    problem.masses[n - 1].loads.push(TimeLoad::Constant(-load));
    problem
}

#[test]
fn starts_on_the_law_agree_with_quadruple_precision() {
    // Taylor series of order 34 in quadruple precision: max|δ|, mean |δ|, δ(T), switches.
    let reference = [
        (
            1.8930477690897016e-4,
            9.999940218746998e-5,
            -1.0002480697601677e-4,
            0,
        ),
        (
            7.5060277489378295e-3,
            8.590180896464142e-4,
            -6.002496902451878e-5,
            300,
        ),
        (
            7.64229731785684e-3,
            9.098588649871621e-4,
            -5.9667822470328825e-5,
            446,
        ),
        (
            1.8870457351414607e-4,
            9.999290877030223e-5,
            -1.0000145288989408e-4,
            87,
        ),
        (
            8.2531048718529e-3,
            1.9444926865204817e-3,
            1.8697203851181367e-3,
            103,
        ),
    ];
    for (case, (peak, sigma, end, switches)) in COMPARED.into_iter().zip(reference) {
        let tree = ExactTree::new(compared(case));
        let request = Request {
            figures: true,
            audit: true,
            ..Request::new(case.3, 1000)
        };
        let run = tree.run(&request).expect("runs");
        let f = run.figures[0];
        let audit = run.audit.expect("audit");
        assert!(audit.error() < 1e-12, "{audit:?}");
        assert_eq!(run.switches.len(), switches);
        assert_eq!(run.samples.len(), 1000);
        let measured = f.delta_max.max(-f.delta_min);
        approx::assert_relative_eq!(measured, peak, max_relative = 1e-12);
        approx::assert_relative_eq!(f.sigma, sigma, max_relative = 1e-12);
        approx::assert_abs_diff_eq!(run.samples[999], end, epsilon = 1e-11 * peak);
        let work = Workspace::new(&tree, &request);
        let mut work = work.expect("starts");
        work.plain = true;
        let plain = work.run(&request).expect("runs");
        assert_eq!(plain.switches.len(), switches);
        let audit = plain.audit.expect("audit");
        assert!(audit.error() < 1e-12, "{audit:?}");
        for (a, b) in plain.samples.iter().zip(&run.samples) {
            approx::assert_abs_diff_eq!(a, b, epsilon = 1e-11 * peak);
        }
    }
}

#[test]
fn random_scenes_miss_nothing_that_dense_sampling_sees() {
    let mut seed = 12345u64;
    let mut random = || {
        seed = seed
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (seed >> 11) as f64 / (1u64 << 53) as f64
    };
    let mut switches = 0;
    for scene in 0..60 {
        let n = 1 + scene % 4;
        let psi = if scene % 5 == 0 { 0.0 } else { 2.0 * random() };
        let (j, c) = (0.05 + random(), 10f64.powf(5.0 + 3.0 * random()));
        let mut problem = chain(j, c, n, 5.0 + 10.0 * random(), |c, j| {
            psi * (c * j).sqrt() / std::f64::consts::TAU
        });
        let gap = 1e-4 * random();
        problem.masses[0].pair = match scene % 3 {
            0 => TreePair::Form { gap },
            1 => TreePair::Force { opens: 1.0 },
            _ => TreePair::Force { opens: -1.0 },
        };
        let load = 6000.0 * random() * if scene % 3 == 2 { 1.0 } else { -1.0 };
        problem.masses[n - 1].loads.push(TimeLoad::Constant(load));
        let (mass, flanks) = (problem.masses[0].clone(), problem.masses[0].pair.flanks());
        let tree = ExactTree::new(problem);
        let request = Request {
            all_masses: true,
            ..Request::new(0.1, 20_000)
        };
        let run = tree.run(&request).expect("runs");
        assert!(run.complete);
        switches += run.switches.len();
        let mut state = run.start[0];
        let mut next = run.switches.iter().peekable();
        for (k, row) in run.samples.chunks(run.columns).enumerate() {
            let t = 0.1 * (k + 1) as f64 / 20_000.0;
            while next.peek().is_some_and(|s| s.time < t) {
                state = next.next().expect("peeked").after;
            }
            let (x, v) = (row[0], row[n]);
            let small = 1e-12 * (1.0 + x.abs());
            for (f, flank) in flanks.0[..flanks.1].iter().enumerate() {
                let clear = flank.sign * x + flank.offset;
                let pull = mass.stiffness * clear + mass.damping * flank.sign * v;
                let engaged = state == PairState::Engaged(f as u8);
                let fine = if engaged {
                    clear < small && pull < mass.stiffness * small
                } else {
                    clear > -small || pull > -mass.stiffness * small
                };
                assert!(
                    fine,
                    "scene {scene} t {t} {state:?} clear {clear} pull {pull}"
                );
            }
        }
    }
    assert!(switches > 1000, "{switches}");
}
