//! Gauss's rules widened by Kronrod: two rules of different degree at the same places,
//! so that their difference tells of the error.
//!
//! Source of the numbers of 15: R. Piessens, E. de Doncker-Kapenga, C. W. Überhuber,
//! D. K. Kahaner, QUADPACK, 1983.

/// A place in [0, 1], its weight in Kronrod's rule over [−1, 1] and in Gauss's, which is
/// zero where the place is not one of Gauss's; the same at the place below zero.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    pub(crate) place: f64,
    pub(crate) kronrod: f64,
    pub(crate) gauss: f64,
}

const fn node(place: f64, kronrod: f64, gauss: f64) -> Node {
    Node {
        place,
        kronrod,
        gauss,
    }
}

/// Gauss's three places, widened to seven; from the middle outwards.
pub(crate) const SEVEN: [Node; 4] = [
    node(0.0, 0.450_916_538_658_474_1, 8.0 / 9.0),
    node(0.434_243_749_346_802_6, 0.401_397_414_775_962_2, 0.0),
    node(0.774_596_669_241_483_4, 0.268_488_089_868_333_4, 5.0 / 9.0),
    node(0.960_491_268_708_020_3, 0.104_656_226_026_467_3, 0.0),
];

/// Gauss's seven places, widened to fifteen; from the outermost to the middle.
pub(crate) const FIFTEEN: [Node; 8] = [
    node(0.991_455_371_120_812_6, 0.022_935_322_010_529_224, 0.0),
    node(
        0.949_107_912_342_758_5,
        0.063_092_092_629_978_56,
        0.129_484_966_168_869_7,
    ),
    node(0.864_864_423_359_769_1, 0.104_790_010_322_250_19, 0.0),
    node(
        0.741_531_185_599_394_4,
        0.140_653_259_715_525_92,
        0.279_705_391_489_276_64,
    ),
    node(0.586_087_235_467_691_1, 0.169_004_726_639_267_9, 0.0),
    node(
        0.405_845_151_377_397_2,
        0.190_350_578_064_785_4,
        0.381_830_050_505_118_9,
    ),
    node(0.207_784_955_007_898_47, 0.204_432_940_075_298_89, 0.0),
    node(0.0, 0.209_482_141_084_727_82, 0.417_959_183_673_469_4),
];

#[cfg(test)]
mod tests {
    use super::{FIFTEEN, Node, SEVEN};
    use crate::math::quadrature::rule;

    /// ∫ x^power over [−1, 1] by a rule.
    fn moment(nodes: &[Node], power: i32, weight: impl Fn(&Node) -> f64) -> f64 {
        let both = |node: &Node| match node.place == 0.0 {
            true => node.place.powi(power),
            false => node.place.powi(power) + (-node.place).powi(power),
        };
        nodes.iter().map(|node| weight(node) * both(node)).sum()
    }

    #[test]
    fn both_rules_are_exact_to_their_degrees() {
        for (nodes, gauss, kronrod) in [(&SEVEN[..], 5, 11), (&FIFTEEN[..], 13, 23)] {
            for power in 0..=kronrod {
                let exact = if power % 2 == 0 {
                    2.0 / f64::from(power + 1)
                } else {
                    0.0
                };
                let found = moment(nodes, power, |node| node.kronrod);
                approx::assert_abs_diff_eq!(found, exact, epsilon = 2e-15);
                let found = moment(nodes, power, |node| node.gauss);
                assert_eq!(
                    (found - exact).abs() < 2e-15,
                    power <= gauss || power % 2 == 1
                );
            }
        }
    }

    #[test]
    fn the_places_of_gauss_are_the_zeros_of_legendre() {
        for (nodes, count) in [(&SEVEN[..], 3), (&FIFTEEN[..], 7)] {
            for (place, weight) in rule(count) {
                let x = 2.0 * place - 1.0;
                let near = |node: &&Node| (node.place - x.abs()).abs() < 1e-14;
                let node = nodes.iter().find(near).expect("a place");
                approx::assert_relative_eq!(node.gauss, 2.0 * weight, max_relative = 1e-13);
            }
        }
    }
}
