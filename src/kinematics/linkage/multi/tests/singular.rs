//! Singular curves over two inputs.

use super::examples;
use crate::kinematics::linkage::multi::{MultiLinkage, SingularCurve, singular_curves};
use std::f64::consts::TAU;

/// The determinant of the closing equations of `examples::five_bar` over the lengths of both
/// rods: ± sin of the angle between them, squared, from the distance of its outer pins alone.
fn determinant(one: f64, two: f64) -> f64 {
    let apart = [
        0.8 + 0.25 * two.cos() - 0.3 * one.cos(),
        0.1 + 0.25 * two.sin() - 0.3 * one.sin(),
    ];
    let square = apart[0] * apart[0] + apart[1] * apart[1];
    let cos = (0.49 + 0.36 - square) / (2.0 * 0.7 * 0.6);
    1.0 - cos * cos
}

fn of_five_bar() -> Vec<SingularCurve> {
    let linkage = MultiLinkage::new(examples::five_bar()).unwrap();
    singular_curves(&linkage, &[1.1, 0.6], [0, 1], [[0.0, TAU]; 2])
}

#[test]
fn the_curves_of_a_five_bar_are_the_zeros_of_its_determinant() {
    let curves = of_five_bar();
    let points: Vec<[f64; 2]> = curves
        .iter()
        .flat_map(|curve| curve.points.clone())
        .collect();
    assert!(points.len() > 100, "{}", points.len());
    for &[one, two] in &points {
        approx::assert_abs_diff_eq!(determinant(one, two), 0.0, epsilon = 1e-9);
    }
    // None is missing: wherever the sign changes along a line that the grid does not have,
    // a curve goes by.
    let fine = 1000;
    let mut crossings = 0;
    for i in 0..37 {
        let one = 0.01 + TAU * f64::from(i) / 37.5;
        for j in 0..fine {
            let at = |j: i32| TAU * f64::from(j) / f64::from(fine);
            if (determinant(one, at(j)) > 0.0) != (determinant(one, at(j + 1)) > 0.0) {
                crossings += 1;
                let near = |point: &&[f64; 2]| (point[0] - one).hypot(point[1] - at(j)) < 0.06;
                assert!(points.iter().any(|point| near(&point)), "{one} {}", at(j));
            }
        }
    }
    assert!(crossings > 10, "{crossings}");
}

#[test]
fn neighbours_on_a_curve_are_neighbours_in_the_plane() {
    let step = 2.0 * TAU / 180.0;
    for curve in of_five_bar() {
        assert_eq!(curve.group, 1);
        for two in curve.points.windows(2) {
            let [dx, dy] = [0, 1].map(|k| two[1][k] - two[0][k]);
            assert!(dx.hypot(dy) < step, "{two:?}");
        }
        if curve.closed {
            assert_eq!(curve.points.first(), curve.points.last());
        }
    }
}

/// Of a group that is solved by iteration the square of the determinant falls to nothing on
/// the curve, with the distance from it: a billionth of the way from the start away it tells
/// where the curve is to a trillionth.
#[test]
fn the_curves_of_a_larger_group_end_what_can_be_assembled() {
    let spec = examples::platform();
    let linkage = MultiLinkage::new(spec.clone()).unwrap();
    let at: Vec<f64> = spec.inputs.iter().map(|input| input.start).collect();
    let ranges = [0, 1].map(|k| [at[k] - 1.2, at[k] + 1.2]);
    let curves = singular_curves(&linkage, &at, [0, 1], ranges);
    let points: Vec<[f64; 2]> = curves
        .iter()
        .flat_map(|curve| curve.points.clone())
        .collect();
    assert!(points.len() > 20, "{}", points.len());
    let still = vec![0.0; at.len()];
    let mut first = vec![0.0; at.len()];
    let mut looked = 0;
    for point in points.iter().step_by(points.len() / 20) {
        // From the start straight to the point, where nothing lies between.
        let mut space = linkage.workspace::<f64>();
        let mut go = |share: f64| {
            let mut inputs = at.clone();
            for k in 0..2 {
                inputs[k] = at[k] + share * (point[k] - at[k]);
            }
            let reached = space.solve(&inputs, &still).is_ok();
            reached.then(|| space.distance_from_singular(0, &mut first)[0])
        };
        let walked = (1..20).all(|k| go(f64::from(k) / 20.0).is_some());
        let (near, nearer) = (go(1.0 - 1e-8), go(1.0 - 1e-9));
        if let (true, Some(near), Some(nearer)) = (walked, near, nearer) {
            looked += 1;
            approx::assert_relative_eq!(nearer, 0.1 * near, max_relative = 1e-3);
        }
    }
    assert!(looked > 5, "{looked} of {}", points.len());
}
