//! How far groups are from singular positions.

use super::examples::all;
use super::{MultiLinkage, examples, moved, state};

/// sin² of the angle between the rods of a five-bar, in closed form over both inputs.
#[test]
fn the_margin_of_a_five_bar_is_its_determinant_in_closed_form() {
    let mut spec = examples::five_bar();
    spec.linkage.forces.clear();
    let linkage = MultiLinkage::new(spec).unwrap();
    let mut space = linkage.workspace::<f64>();
    let (mut known, mut beyond) = (0, 0);
    for i in 0..40 {
        for j in 0..40 {
            let [one, two] = [i, j].map(|k| std::f64::consts::TAU * f64::from(k) / 40.0);
            let apart = [
                0.8 + 0.25 * two.cos() - 0.3 * one.cos(),
                0.1 + 0.25 * two.sin() - 0.3 * one.sin(),
            ];
            // (l₁² + l₂² − d²)/(2·l₁·l₂) is the cosine between the rods.
            let square = apart[0] * apart[0] + apart[1] * apart[1];
            let cos = (0.49 + 0.36 - square) / (2.0 * 0.7 * 0.6);
            let wanted = 1.0 - cos * cos;
            let found = space.solve(&[one, two], &[0.0; 2]);
            if wanted > 1e-9 {
                assert!(found.is_ok());
                let (_, margin) = space.margin().unwrap();
                approx::assert_abs_diff_eq!(margin, wanted, epsilon = 1e-9);
                known += 1;
            } else {
                assert!(found.is_err());
                beyond += 1;
            }
        }
    }
    assert!(known > 1000 && beyond > 50, "{known} {beyond}");
}

/// The distance from a singular position with its derivatives by the inputs and in time.
#[test]
fn distances_are_smooth_and_their_derivatives_differences() {
    let h = 1e-4;
    for spec in all() {
        let linkage = MultiLinkage::new(spec.clone()).unwrap();
        let mut space = linkage.workspace::<f64>();
        let (q, rates) = state(&spec);
        let m = q.len();
        let mut first = vec![0.0; m];
        for group in 0..linkage.structure().groups.len() - 1 {
            let starts: Vec<f64> = spec.inputs.iter().map(|input| input.start).collect();
            space.solve(&starts, &rates).unwrap();
            let [one, ..] = space.distance_from_singular(group, &mut first);
            approx::assert_relative_eq!(one, 1.0, max_relative = 1e-12);
            let mut at = |along: &[f64], h: f64| {
                space.solve(&moved(&q, along, h), &rates).unwrap();
                space.distance_from_singular(group, &mut first)
            };
            let (before, after) = (at(&rates, -h), at(&rates, h));
            let mut slopes = Vec::new();
            for input in 0..m {
                let mut unit = vec![0.0; m];
                unit[input] = 1.0;
                slopes.push((at(&unit, h)[0] - at(&unit, -h)[0]) / (2.0 * h));
            }
            let [value, rate, bend] = at(&rates, 0.0);
            for (first, slope) in first.iter().zip(&slopes) {
                approx::assert_relative_eq!(*first, *slope, max_relative = 1e-5, epsilon = 1e-6);
            }
            let slope = (after[0] - before[0]) / (2.0 * h);
            approx::assert_relative_eq!(rate, slope, max_relative = 1e-5, epsilon = 1e-6);
            let second = (after[0] - 2.0 * value + before[0]) / (h * h);
            approx::assert_relative_eq!(bend, second, max_relative = 1e-4, epsilon = 1e-5);
        }
    }
}

/// The distance of a five-bar is sin² of the angle between its rods over that at the start.
#[test]
fn the_distance_of_a_five_bar_is_its_determinant_in_closed_form() {
    let mut spec = examples::five_bar();
    spec.linkage.forces.clear();
    let linkage = MultiLinkage::new(spec).unwrap();
    let mut space = linkage.workspace::<f64>();
    let sine = |one: f64, two: f64| {
        let apart = [
            0.8 + 0.25 * two.cos() - 0.3 * one.cos(),
            0.1 + 0.25 * two.sin() - 0.3 * one.sin(),
        ];
        let square = apart[0] * apart[0] + apart[1] * apart[1];
        let cos = (0.49 + 0.36 - square) / (2.0 * 0.7 * 0.6);
        1.0 - cos * cos
    };
    let start = sine(1.1, 0.6);
    let mut first = vec![0.0; 2];
    let mut known = 0;
    for i in 0..40 {
        for j in 0..40 {
            let [one, two] = [i, j].map(|k| std::f64::consts::TAU * f64::from(k) / 40.0);
            if space.solve(&[one, two], &[0.0; 2]).is_ok() {
                let [found, ..] = space.distance_from_singular(0, &mut first);
                approx::assert_abs_diff_eq!(found, sine(one, two) / start, epsilon = 1e-9);
                known += 1;
            }
        }
    }
    assert!(known > 1000);
}
