//! Motions of all inputs over time against differences.

use super::examples;
use crate::kinematics::linkage::kinetostatics::Positions;
use crate::kinematics::linkage::multi::{MultiLinkage, MultiMotion};
use crate::kinematics::linkage::spec::PointOf;
use crate::math::jet::Jet;

/// A smooth motion of all inputs about the start.
pub(super) fn at(starts: &[f64], t: f64) -> Vec<Jet> {
    let one = |(k, start): (usize, &f64)| {
        let (rate, bend) = (0.7 - 0.4 * k as f64, 0.3 + 0.5 * k as f64);
        Jet {
            value: start + rate * t + 0.5 * bend * t * t,
            first: rate + bend * t,
            second: bend,
            third: 0.0,
        }
    };
    starts.iter().enumerate().map(one).collect()
}

/// Everything that a motion tells, as values with first and second derivatives.
fn told(motion: &MultiMotion, links: usize, pairs: usize) -> Vec<[f64; 3]> {
    let mut all = Vec::new();
    for link in 0..links {
        let angle = motion.angle(link);
        all.push([angle.value, angle.first, angle.second]);
        let point = PointOf {
            link: Some(link),
            at: [0.13, -0.04],
        };
        all.extend(motion.point(point).map(|x| [x.value, x.first, x.second]));
        let placed = motion.link(link);
        for k in 0..2 {
            all.push([placed.origin[k], placed.first[k], placed.second[k]]);
        }
    }
    for pair in 0..pairs {
        let rates = motion.pair_rates(pair);
        all.push([motion.pair_coordinate(pair), rates[0], rates[1]]);
    }
    all
}

#[test]
fn velocities_and_accelerations_are_derivatives_in_time() {
    let h = 1e-5;
    for spec in examples::all() {
        let linkage = MultiLinkage::new(spec.clone()).unwrap();
        let starts: Vec<f64> = spec.inputs.iter().map(|input| input.start).collect();
        let mut motion = MultiMotion::new(&linkage);
        let (links, pairs) = (spec.linkage.links.len(), spec.linkage.pairs.len());
        let mut look = |t: f64| {
            motion.set_inputs(&at(&starts, t)).unwrap();
            told(&motion, links, pairs)
        };
        let t = 0.03;
        let (before, here, after) = (look(t - h), look(t), look(t + h));
        for ((one, here), other) in before.iter().zip(&here).zip(&after) {
            for order in 0..2 {
                let slope = (other[order] - one[order]) / (2.0 * h);
                approx::assert_relative_eq!(
                    here[order + 1],
                    slope,
                    max_relative = 1e-6,
                    epsilon = 1e-6
                );
            }
        }
    }
}

#[test]
fn the_jacobian_gives_the_velocities() {
    for spec in examples::all() {
        let linkage = MultiLinkage::new(spec.clone()).unwrap();
        let starts: Vec<f64> = spec.inputs.iter().map(|input| input.start).collect();
        let mut motion = MultiMotion::new(&linkage);
        let inputs = at(&starts, 0.02);
        motion.set_inputs(&inputs).unwrap();
        for link in 0..spec.linkage.links.len() {
            let point = PointOf {
                link: Some(link),
                at: [0.05, 0.11],
            };
            let (mut turning, mut moving) = (0.0, [0.0; 2]);
            for (input, jet) in inputs.iter().enumerate() {
                turning += motion.angle_transfer(link, input) * jet.first;
                let [x, y] = motion.point_transfer(point, input);
                moving = [moving[0] + x * jet.first, moving[1] + y * jet.first];
            }
            approx::assert_abs_diff_eq!(turning, motion.angle(link).first, epsilon = 1e-12);
            let [x, y] = motion.point(point);
            approx::assert_abs_diff_eq!(moving[0], x.first, epsilon = 1e-12);
            approx::assert_abs_diff_eq!(moving[1], y.first, epsilon = 1e-12);
        }
    }
}
