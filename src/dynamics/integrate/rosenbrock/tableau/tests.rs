//! The coefficients satisfy every condition that makes the method what it is.

use super::*;
use nalgebra::{SMatrix, SVector};

type Square = SMatrix<f64, STAGES, STAGES>;
type Column = SVector<f64, STAGES>;

/// α, β = α + Γ and Γ of the usual form of a Rosenbrock method (E. Hairer and
/// G. Wanner, Solving ordinary differential equations II, IV.7):
/// C = I/γ − Γ⁻¹, a = α·Γ⁻¹, m = b·Γ⁻¹.
fn usual() -> [Square; 3] {
    let lower =
        |rows: &[&[f64]; STAGES]| Square::from_fn(|i, j| rows[i].get(j).copied().unwrap_or(0.0));
    let inverse = Square::identity() / GAMMA - lower(&COUPLINGS);
    let gamma = inverse.try_inverse().unwrap();
    let alpha = lower(&STATES) * gamma;
    [alpha, alpha + gamma, gamma]
}

/// A rooted tree: its children.
#[derive(Clone)]
struct Tree(Vec<Tree>);

impl Tree {
    fn order(&self) -> u32 {
        1 + self.0.iter().map(Self::order).sum::<u32>()
    }

    /// γ(t).
    fn density(&self) -> f64 {
        f64::from(self.order()) * self.0.iter().map(Self::density).product::<f64>()
    }

    /// Φ_i(t): an only child hangs on β, several on α.
    fn weights(&self, [alpha, beta, _]: &[Square; 3]) -> Column {
        let all = &[*alpha, *beta, *beta];
        match &self.0[..] {
            [] => Column::repeat(1.0),
            [only] => beta * only.weights(all),
            several => several
                .iter()
                .map(|child| alpha * child.weights(all))
                .fold(Column::repeat(1.0), |product, child| {
                    product.component_mul(&child)
                }),
        }
    }
}

/// All trees of an order.
fn trees(order: u32) -> Vec<Tree> {
    forests(order - 1, order - 1)
        .into_iter()
        .map(Tree)
        .collect()
}

/// All lists of trees with so many vertices together, the greatest first, none
/// greater than `largest`.
fn forests(vertices: u32, largest: u32) -> Vec<Vec<Tree>> {
    if vertices == 0 {
        return vec![Vec::new()];
    }
    let mut all = Vec::new();
    for size in (1..=largest.min(vertices)).rev() {
        let first = trees(size);
        for rest in forests(vertices - size, size) {
            // Among trees of one size, in the order of their list only.
            let same = rest.first().filter(|tree| tree.order() == size);
            let from = same.map_or(0, |tree| position(&first, tree));
            for tree in &first[from..] {
                let mut forest = vec![tree.clone()];
                forest.extend(rest.iter().cloned());
                all.push(forest);
            }
        }
    }
    all
}

fn position(list: &[Tree], tree: &Tree) -> usize {
    let shape = |tree: &Tree| tree_shape(tree);
    list.iter()
        .position(|one| shape(one) == shape(tree))
        .unwrap()
}

fn tree_shape(tree: &Tree) -> String {
    let children: Vec<String> = tree.0.iter().map(tree_shape).collect();
    format!("({})", children.concat())
}

/// Greatest violation of the conditions up to an order by the result of weights
/// m, at the share θ of the step.
fn violation(weights: &Column, order: u32, theta: f64) -> f64 {
    let usual = usual();
    let b = usual[2].transpose() * weights;
    let all = (1..=order).flat_map(trees);
    all.map(|tree| {
        let expected = theta.powi(tree.order() as i32) / tree.density();
        (b.dot(&tree.weights(&usual)) - expected).abs()
    })
    .fold(0.0, f64::max)
}

/// m of the result; without k_8, of the embedded method.
fn result(embedded: bool) -> Column {
    Column::from_fn(|j, _| match j {
        0..5 => STATES[5][j],
        7 if embedded => 0.0,
        _ => 1.0,
    })
}

#[test]
fn there_are_as_many_trees_as_there_should_be() {
    let counts: Vec<usize> = (1..=6).map(|order| trees(order).len()).collect();
    assert_eq!(counts, [1, 1, 2, 4, 9, 20]);
}

#[test]
fn all_conditions_of_order_five_hold_and_of_order_four_for_the_embedded_method() {
    assert!(violation(&result(false), 5, 1.0) < 1e-13);
    assert!(violation(&result(true), 4, 1.0) < 1e-13);
    // And no more: the conditions can fail.
    assert!(violation(&result(false), 6, 1.0) > 1e-6);
    assert!(violation(&result(true), 5, 1.0) > 1e-6);
}

#[test]
fn the_continuous_output_is_of_order_four() {
    let steps = result(false);
    for theta in [0.1, 0.5, 0.8, 1.0] {
        let bend = |j: usize| OUTPUT[0][j] + theta * (OUTPUT[1][j] + theta * OUTPUT[2][j]);
        let weights = Column::from_fn(|j, _| theta * (steps[j] + (1.0 - theta) * bend(j)));
        assert!(violation(&weights, 4, theta) < 1e-12, "{theta}");
    }
}

#[test]
fn times_and_their_weights_are_the_sums_that_make_time_one_more_state() {
    let [alpha, _, gamma] = usual();
    for i in 0..STAGES {
        approx::assert_abs_diff_eq!(alpha.row(i).sum(), TIMES[i], epsilon = 1e-13);
        approx::assert_abs_diff_eq!(gamma.row(i).sum(), TIME_RATES[i], epsilon = 1e-13);
    }
}

/// |R(z)| of the method and of the embedded one: a step of y′ = λy, hλ = z.
fn growth(z: nalgebra::Complex<f64>) -> [f64; 2] {
    type Number = nalgebra::Complex<f64>;
    let mut stages: Vec<Number> = Vec::new();
    let one = Number::new(1.0, 0.0);
    let sum = |weights: &[f64], stages: &[Number]| -> Number {
        weights.iter().zip(stages).map(|(w, k)| k * *w).sum()
    };
    for stage in 0..STAGES {
        let right = z * (one + sum(STATES[stage], &stages)) + sum(COUPLINGS[stage], &stages);
        stages.push(right / (one / GAMMA - z));
    }
    [false, true].map(|embedded| (one + sum(result(embedded).as_slice(), &stages)).norm())
}

#[test]
fn both_methods_are_stable_in_the_left_half_plane_and_forget_what_is_infinitely_fast() {
    for k in 0..200 {
        let size = 10f64.powf(-2.0 + 0.04 * f64::from(k));
        for angle in [0.5, 0.55, 0.7, 0.9, 1.0] {
            let z = nalgebra::Complex::from_polar(size, std::f64::consts::PI * angle);
            for growth in growth(z) {
                assert!(growth <= 1.0 + 1e-12, "{z}: {growth}");
            }
        }
    }
    for growth in growth(nalgebra::Complex::new(-1e12, 0.0)) {
        assert!(growth < 1e-9, "{growth}");
    }
}
