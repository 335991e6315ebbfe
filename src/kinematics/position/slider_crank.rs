//! Slider-crank: a crank drives a slide along a straight guide through a rod.

use super::assembly_range::{ForbiddenArcs, OutOfReach, half_width};
use crate::fault::{Fault, Faults};
use crate::kinematics::linkage::closure::circle_and_line;
use crate::math::jet::Jet;
use crate::math::series::Series;
use std::f64::consts::FRAC_PI_2;

/// U = r·cos θ ± √(l² − (r·sin θ − e)²), θ = φ + phase: the slide's distance
/// from the crank's axis along the guide (m).
///
/// The guide runs parallel to θ = 0 at the distance e (towards θ = 90°) from
/// the crank's axis. Where the rod stands across the guide, |r·sin θ − e| = l,
/// is a dead-centre position: U′ grows without bound there and U has no value beyond
/// (derivatives, then values, that are not numbers).
///
/// It is the massless short form of a linkage ([`super::Position::as_linkage`])
/// and closes as its dyad does: the slide lies ahead of the crank's end on
/// branch +, behind it on branch −.
#[derive(Clone, Debug, PartialEq)]
pub struct SliderCrank {
    /// Crank radius r (m), > 0.
    pub crank: f64,
    /// Connecting rod length l (m), > 0.
    pub rod: f64,
    /// Offset e of the guide (m).
    pub offset: f64,
    /// +1 or −1: sign of the root.
    pub branch: f64,
    /// Added to the driver's displacement (rad).
    pub phase: f64,
    /// Least values of the factors of the discriminant: l − (r sin θ − e) at
    /// θ = 90°, l + (r sin θ − e) at −90° (m).
    least: [f64; 2],
    arcs: ForbiddenArcs,
}

impl SliderCrank {
    /// A slider-crank of given dimensions.
    ///
    /// # Errors
    /// Lengths out of range, or a guide too far away to be reached;
    /// paths relative to `position`.
    pub fn new(
        crank: f64,
        rod: f64,
        offset: f64,
        branch: f64,
        phase: f64,
    ) -> Result<Self, Vec<Fault>> {
        let mut faults = Faults::default();
        faults.length("slider_crank.crank", crank);
        faults.length("slider_crank.rod", rod);
        faults.finite("slider_crank.offset", offset);
        faults.finite("slider_crank.phase", phase);
        faults.branch("slider_crank.branch", branch);
        faults.check()?;
        if offset.abs() >= crank + rod {
            let message = format!(
                "crank {crank} m and rod {rod} m together never reach a guide {} m away",
                offset.abs()
            );
            let hint = "make crank + rod longer than the offset";
            faults.add("slider_crank.offset", message, hint);
            faults.check()?;
        }
        let size = crank + rod + offset.abs();
        let least = [rod + offset - crank, rod - offset - crank];
        let upper = half_width(-least[0], crank + rod + offset, size);
        let lower = half_width(-least[1], crank + rod - offset, size);
        Ok(Self {
            crank,
            rod,
            offset,
            branch,
            phase,
            least,
            arcs: ForbiddenArcs {
                centre: FRAC_PI_2,
                half_widths: [upper, lower],
            },
        })
    }

    /// U and its derivatives at `phi`.
    pub fn jet(&self, phi: f64) -> Jet {
        let r = self.crank;
        let (sin, cos) = Series::<4>::sin_cos(phi + self.phase, 1.0);
        // Both factors of the difference of squares stay exact where the rod
        // stands nearly across the guide: of 1 − sin θ and 1 + sin θ the lesser
        // one is taken from their product, cos² θ.
        let (s, c) = (sin.value(), cos.value());
        let greater = 1.0 + s.abs();
        let lesser = c * c / greater;
        let (down, up) = if s < 0.0 {
            (greater, lesser)
        } else {
            (lesser, greater)
        };
        let above = sin.scale(-r).with_value(r * down + self.least[0]);
        let below = sin.scale(r).with_value(r * up + self.least[1]);
        (cos.scale(r) + circle_and_line(above, below, self.branch)).jet()
    }

    /// The interval around `phi` in which it can be assembled; `None`: a full turn.
    ///
    /// # Errors
    /// It cannot be assembled at `phi`.
    pub fn reach_from(&self, phi: f64) -> Result<Option<(f64, f64)>, OutOfReach> {
        super::shifted(self.arcs.reach_from(phi + self.phase), self.phase)
    }
}

#[cfg(test)]
mod tests {
    use super::SliderCrank;
    use std::f64::consts::{FRAC_PI_2, PI, TAU};

    fn slider(crank: f64, rod: f64, offset: f64, branch: f64) -> SliderCrank {
        SliderCrank::new(crank, rod, offset, branch, 0.0).unwrap()
    }

    #[test]
    fn the_rod_keeps_its_length_and_the_slide_its_guide() {
        for branch in [1.0, -1.0] {
            let position = slider(0.1, 0.35, 0.03, branch);
            for i in 0..60 {
                let theta = 0.11 * f64::from(i);
                let slide = position.jet(theta).value;
                let (across, along) = (0.1 * theta.sin() - 0.03, slide - 0.1 * theta.cos());
                approx::assert_relative_eq!(across.hypot(along), 0.35, max_relative = 1e-14);
                assert!(along * branch > 0.0);
            }
        }
    }

    #[test]
    fn dead_centres_have_the_textbook_transfer_functions() {
        let (r, l) = (0.05, 0.2);
        let position = slider(r, l, 0.0, 1.0);
        let (outer, inner) = (position.jet(0.0), position.jet(PI));
        approx::assert_relative_eq!(outer.value, l + r, max_relative = 1e-15);
        approx::assert_relative_eq!(inner.value, l - r, max_relative = 1e-15);
        approx::assert_relative_eq!(outer.second, -r * (1.0 + r / l), max_relative = 1e-13);
        approx::assert_relative_eq!(inner.second, r * (1.0 - r / l), max_relative = 1e-13);
        approx::assert_abs_diff_eq!(outer.first, 0.0, epsilon = 1e-17);
        approx::assert_abs_diff_eq!(outer.third, 0.0, epsilon = 1e-16);
    }

    #[test]
    fn precision_is_kept_where_the_rod_is_nearly_across_the_guide() {
        // Crank shorter than the rod by 1e-10: at θ = 90° the root is √(2·l·1e-10).
        let position = slider(1.0, 1.0 + 1e-10, 0.0, 1.0);
        let gap = (1.0f64 + 1e-10) - 1.0;
        let jet = position.jet(FRAC_PI_2);
        let root = (gap * (2.0 + gap)).sqrt();
        approx::assert_relative_eq!(jet.value, root, max_relative = 1e-10);
        // U″ = (r sin θ − e)·r·sin θ/root there.
        approx::assert_relative_eq!(jet.second, 1.0 / root, max_relative = 1e-10);
    }

    #[test]
    fn reach_is_where_the_rod_stands_across_the_guide() {
        assert_eq!(slider(0.1, 0.3, 0.1, 1.0).reach_from(9.0), Ok(None));
        // sin θ < (l + e)/r = 0.9 limits; sin θ > (e − l)/r = −0.3 limits too.
        let position = slider(1.0, 0.6, 0.3, 1.0);
        let (from, to) = position.reach_from(TAU).unwrap().unwrap();
        approx::assert_abs_diff_eq!(from, TAU - 0.3f64.asin(), epsilon = 1e-14);
        approx::assert_abs_diff_eq!(to, TAU + 0.9f64.asin(), epsilon = 1e-14);
        let (from, to) = position.reach_from(PI).unwrap().unwrap();
        approx::assert_abs_diff_eq!(from, PI - 0.9f64.asin(), epsilon = 1e-14);
        approx::assert_abs_diff_eq!(to, PI + 0.3f64.asin(), epsilon = 1e-14);
        assert!(position.reach_from(FRAC_PI_2).is_err());
        for edge in [from, to] {
            let inwards = if edge < PI { 1e-7 } else { -1e-7 };
            assert!(position.jet(edge + inwards).is_finite());
            assert!(position.jet(edge - inwards).value.is_nan());
        }
    }

    #[test]
    fn a_rod_as_long_as_the_crank_stops_at_the_change_point() {
        let position = slider(0.2, 0.2, 0.0, 1.0);
        let (from, to) = position.reach_from(0.1).unwrap().unwrap();
        approx::assert_abs_diff_eq!(from, -FRAC_PI_2, epsilon = 1e-15);
        approx::assert_abs_diff_eq!(to, FRAC_PI_2, epsilon = 1e-15);
    }

    #[test]
    fn dimensions_that_never_meet_are_refused() {
        let faults = SliderCrank::new(0.1, 0.2, -0.31, 1.0, 0.0).unwrap_err();
        assert_eq!(faults[0].path, "slider_crank.offset");
        assert_eq!(
            SliderCrank::new(-1.0, f64::NAN, 0.0, 2.0, 0.0)
                .unwrap_err()
                .len(),
            3
        );
    }
}
