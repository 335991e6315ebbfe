use super::ChainParameters;
use crate::dynamics::builder::spec::{BodySpec, InertiaSplit, Lumping};
use std::f64::consts::{PI, TAU};

fn body(masses: usize, split: InertiaSplit) -> BodySpec {
    BodySpec::Uniform {
        inertia: 0.1,
        stiffness: 1e7,
        damping_capacity: 0.4,
        masses,
        split,
        lumping: Lumping::Ends,
    }
}

/// Natural frequencies of the chain with its first link clamped, ascending:
/// square roots of the eigenvalues of M^(−1/2)·C·M^(−1/2).
fn frequencies(chain: &ChainParameters) -> Vec<f64> {
    let n = chain.inertias.len();
    let matrix = nalgebra::DMatrix::from_fn(n, n, |i, j| {
        let after = |m: usize| chain.stiffnesses.get(m + 1).copied().unwrap_or(0.0);
        let entry = match i.abs_diff(j) {
            0 => chain.stiffnesses[i] + after(i),
            1 => -chain.stiffnesses[i.max(j)],
            _ => 0.0,
        };
        entry / (chain.inertias[i] * chain.inertias[j]).sqrt()
    });
    let mut found: Vec<f64> = matrix
        .symmetric_eigenvalues()
        .iter()
        .map(|square| square.sqrt())
        .collect();
    found.sort_by(f64::total_cmp);
    found
}

#[test]
fn series_stiffness_damper_and_inertia_do_not_depend_on_the_number_of_masses() {
    for masses in [1, 2, 3, 10, 100] {
        for split in [InertiaSplit::Cubes, InertiaSplit::Equal] {
            let chain = ChainParameters::new(&body(masses, split)).unwrap();
            let series = |list: &[f64]| 1.0 / list.iter().map(|x| 1.0 / x).sum::<f64>();
            let total: f64 = chain.inertias.iter().sum();
            let damper = 0.4 * (1e7f64 * 0.1).sqrt() / TAU;
            approx::assert_relative_eq!(total, 0.1, max_relative = 1e-13);
            approx::assert_relative_eq!(series(&chain.stiffnesses), 1e7, max_relative = 1e-13);
            approx::assert_relative_eq!(series(&chain.dampings), damper, max_relative = 1e-13);
        }
    }
    let cubes = ChainParameters::new(&body(2, InertiaSplit::Cubes)).unwrap();
    approx::assert_relative_eq!(cubes.inertias[0], 0.1 / 8.0, max_relative = 1e-15);
    approx::assert_relative_eq!(cubes.inertias[1], 0.1 * 7.0 / 8.0, max_relative = 1e-15);
}

#[test]
fn a_uniform_shaft_has_its_closed_form_frequencies() {
    for (masses, first_error) in [(1, -0.36), (2, -0.21), (10, -0.049)] {
        let chain = ChainParameters::new(&body(masses, InertiaSplit::Equal)).unwrap();
        let n = masses as f64;
        let base = 1e4;
        let found = frequencies(&chain);
        for (k, frequency) in found.iter().enumerate() {
            let angle = (2.0 * k as f64 + 1.0) * PI / (2.0 * (2.0 * n + 1.0));
            approx::assert_relative_eq!(
                *frequency,
                2.0 * n * base * angle.sin(),
                max_relative = 1e-10
            );
        }
        let error = found[0] / (PI / 2.0 * base) - 1.0;
        approx::assert_abs_diff_eq!(error, first_error, epsilon = 0.006);
    }
}

#[test]
fn numbers_out_of_range_and_lists_that_do_not_match_are_refused() {
    let paths = |body: &BodySpec| -> Vec<String> {
        let faults = ChainParameters::new(body).unwrap_err();
        faults.into_iter().map(|fault| fault.path).collect()
    };
    assert_eq!(
        paths(&body(2, InertiaSplit::Shares(vec![0.5]))),
        ["split", "split"]
    );
    assert_eq!(paths(&body(0, InertiaSplit::Equal)), ["masses"]);
    assert_eq!(paths(&BodySpec::Rigid { inertia: -1.0 }), ["inertia"]);
    let lists = BodySpec::Lists {
        inertias: vec![1.0, 0.0],
        stiffnesses: vec![f64::INFINITY, 1.0],
        dampings: vec![-1.0],
    };
    assert_eq!(
        paths(&lists),
        ["dampings", "inertias[1]", "stiffnesses[0]", "dampings[0]"]
    );
}
