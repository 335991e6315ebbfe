//! The coefficients against what defines them, and against published figures.

use super::*;

/// ∫₀^{c_i} x^(q−1) dx = Σ a_ij·c_j^(q−1) for q ≤ s (stage order), and over the whole
/// step for q ≤ 2s − 1 (order).
fn conditions<const S: usize, const L: usize>() {
    let tableau = Tableau::<S, L>::new();
    assert_eq!(tableau.nodes[S - 1], 1.0);
    for q in 1..2 * S {
        let powers: [f64; S] = std::array::from_fn(|j| tableau.nodes[j].powi(q as i32 - 1));
        let found = times(&tableau.once, &powers);
        let first = if q <= S { 0 } else { S - 1 };
        for i in first..S {
            let expected = tableau.nodes[i].powi(q as i32) / q as f64;
            approx::assert_abs_diff_eq!(found[i], expected, epsilon = 2e-15);
        }
    }
    // A·T = T·Λ, and T⁻¹ is the inverse of T.
    for lane in 0..L {
        let [re, im] = tableau.eigenvalues[lane];
        let column = |k: usize| tableau.eigenvectors[k];
        let (real, imaginary) = match lane {
            0 => (column(0), [0.0; S]),
            _ => (column(2 * lane - 1), column(2 * lane)),
        };
        let found = [
            times(&tableau.once, &real),
            times(&tableau.once, &imaginary),
        ];
        for i in 0..S {
            let expected = [
                re * real[i] - im * imaginary[i],
                re * imaginary[i] + im * real[i],
            ];
            approx::assert_abs_diff_eq!(found[0][i], expected[0], epsilon = 1e-12);
            approx::assert_abs_diff_eq!(found[1][i], expected[1], epsilon = 1e-12);
        }
    }
    for j in 0..S {
        let unit = times(&tableau.inverse, &tableau.eigenvectors[j]);
        for i in 0..S {
            let expected = if i == j { 1.0 } else { 0.0 };
            approx::assert_abs_diff_eq!(unit[i], expected, epsilon = 1e-10);
        }
    }
}

#[test]
fn orders_and_eigenvectors_are_what_they_are_taken_for() {
    conditions::<3, 2>();
    conditions::<5, 3>();
    conditions::<7, 4>();
}

/// Radau IIA of order 5 in closed form (Hairer and Wanner, table IV.5.6), and the
/// real eigenvalue of A, (6 + ∛81 − ∛9)/30.
#[test]
fn order_five_has_its_published_coefficients() {
    let tableau = Tableau::<3, 2>::new();
    let root = 6f64.sqrt();
    let expected = [
        [
            (88.0 - 7.0 * root) / 360.0,
            (296.0 - 169.0 * root) / 1800.0,
            (-2.0 + 3.0 * root) / 225.0,
        ],
        [
            (296.0 + 169.0 * root) / 1800.0,
            (88.0 + 7.0 * root) / 360.0,
            (-2.0 - 3.0 * root) / 225.0,
        ],
        [(16.0 - root) / 36.0, (16.0 + root) / 36.0, 1.0 / 9.0],
    ];
    for i in 0..3 {
        for j in 0..3 {
            approx::assert_abs_diff_eq!(tableau.once[j][i], expected[i][j], epsilon = 1e-15);
        }
    }
    let expected = (6.0 + 81f64.cbrt() - 9f64.cbrt()) / 30.0;
    approx::assert_relative_eq!(tableau.eigenvalues[0][0], expected, max_relative = 1e-14);
}

/// Powers of θ are integrated exactly, from the rates alone to s and with the
/// acceleration at the start to s + 1, and the added term changes nothing at the end.
#[test]
fn the_continuous_output_is_exact_for_powers() {
    let tableau = Tableau::<5, 3>::new();
    let output = &tableau.output;
    for power in 1..=6i32 {
        let rate = |x: f64| x.powi(power);
        let differences = tableau.nodes.map(rate);
        let slope: f64 = output
            .slope
            .iter()
            .zip(&differences)
            .map(|(a, b)| a * b)
            .sum();
        let bend = if power == 1 { 1.0 - slope } else { -slope };
        let coefficients: Vec<f64> = (0..8)
            .map(|k| {
                let rates = output.rates[k].iter().zip(&differences);
                rates.map(|(a, b)| a * b).sum::<f64>() + bend * output.bend[k]
            })
            .collect();
        for i in 0..=10 {
            let x = f64::from(i) / 10.0;
            let (value, slope) = crate::math::polynomial::evaluate(&coefficients, x);
            let expected = x.powi(power + 1) / f64::from(power + 1);
            approx::assert_abs_diff_eq!(value, expected, epsilon = 1e-14);
            approx::assert_abs_diff_eq!(slope, rate(x), epsilon = 1e-13);
        }
    }
    approx::assert_abs_diff_eq!(output.bend[7], 0.0, epsilon = 1e-15);
}
