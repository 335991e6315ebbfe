use super::SlottedLink;
use crate::kinematics::position::{SlottedDriver, SlottedLinkSpec, SlottedOutput};
use crate::math::jet::Jet;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

fn spec(crank: f64, frame: f64, driver: SlottedDriver, output: SlottedOutput) -> SlottedLinkSpec {
    SlottedLinkSpec {
        crank,
        frame,
        driver,
        output,
        branch: 1.0,
        phase: 0.0,
    }
}

fn by_crank(crank: f64, frame: f64, output: SlottedOutput) -> SlottedLink {
    SlottedLink::new(&spec(crank, frame, SlottedDriver::Crank, output)).unwrap()
}

#[test]
fn crank_and_slot_meet_in_the_block() {
    for (l, d) in [(0.1, 0.3), (0.3, 0.1), (0.2, 0.0), (0.2, 0.2)] {
        let angle = by_crank(l, d, SlottedOutput::Link);
        let distance = by_crank(l, d, SlottedOutput::Block);
        for i in -40..40 {
            let phi = 0.077 * f64::from(i);
            let (phi2, s) = (angle.jet(phi), distance.jet(phi).value);
            approx::assert_abs_diff_eq!(s * phi2.value.cos(), d + l * phi.cos(), epsilon = 1e-15);
            approx::assert_abs_diff_eq!(s * phi2.value.sin(), l * phi.sin(), epsilon = 1e-15);
            // ω2 = (l² + D·l·cos φ1)/S², V_r = −(D·l/S)·sin φ1.
            let first = (l * l + d * l * phi.cos()) / (s * s);
            approx::assert_abs_diff_eq!(phi2.first, first, epsilon = 1e-12);
            let slide = -d * l / s * phi.sin();
            approx::assert_abs_diff_eq!(distance.jet(phi).first, slide, epsilon = 1e-14);
        }
    }
}

#[test]
fn a_long_crank_takes_the_link_round_and_a_short_one_swings_it() {
    let round = by_crank(0.3, 0.1, SlottedOutput::Link);
    let swing = by_crank(0.1, 0.3, SlottedOutput::Link);
    assert_eq!(round.gain_in_turn(), Some(TAU));
    assert_eq!(swing.gain_in_turn(), Some(0.0));
    for phi in [-5.0, -1.0, 0.3, 2.0, 4.4] {
        let gained = round.jet(phi + TAU).value - round.jet(phi).value;
        approx::assert_abs_diff_eq!(gained, TAU, epsilon = 1e-14);
        let gained = swing.jet(phi + TAU).value - swing.jet(phi).value;
        approx::assert_abs_diff_eq!(gained, 0.0, epsilon = 1e-14);
    }
    let most = swing.jet((-1.0f64 / 3.0).acos()).value;
    approx::assert_abs_diff_eq!(most, (1.0f64 / 3.0).asin(), epsilon = 1e-15);
}

#[test]
fn equal_lengths_turn_the_link_half_as_fast_and_end_on_its_pivot() {
    let half = by_crank(0.1, 0.1, SlottedOutput::Link);
    for phi in [-3.0, -1.0, 0.0, 1.5, 3.1] {
        let jet = half.jet(phi);
        approx::assert_abs_diff_eq!(jet.value, 0.5 * phi, epsilon = 1e-12);
        approx::assert_abs_diff_eq!(jet.first, 0.5, epsilon = 1e-7);
    }
    assert_eq!(half.gain_in_turn(), None);
    assert_eq!(half.reach_from(1.0), Ok(Some((-PI, PI))));
    assert!(half.reach_from(PI).is_err());
    assert_eq!(
        by_crank(0.1, 0.3, SlottedOutput::Link).reach_from(9.0),
        Ok(None)
    );
}

#[test]
fn the_block_drives_the_crank_on_either_branch() {
    let (l, d) = (0.1, 0.3);
    for branch in [1.0, -1.0] {
        let with = |output| {
            SlottedLink::new(&SlottedLinkSpec {
                branch,
                ..spec(l, d, SlottedDriver::Block, output)
            })
            .unwrap()
        };
        let (crank, link) = (with(SlottedOutput::Crank), with(SlottedOutput::Link));
        for i in 1..20 {
            let s = 0.2 + 0.01 * f64::from(i);
            let (phi1, phi2): (Jet, Jet) = (crank.jet(s), link.jet(s));
            // ω1 and the distance grow together on branch +.
            assert!(phi1.first * branch > 0.0);
            let back = by_crank(l, d, SlottedOutput::Block).jet(phi1.value);
            approx::assert_relative_eq!(back.value, s, max_relative = 1e-14);
            approx::assert_relative_eq!(back.first * phi1.first, 1.0, max_relative = 1e-12);
            let angle = by_crank(l, d, SlottedOutput::Link).jet(phi1.value);
            approx::assert_abs_diff_eq!(angle.value, phi2.value, epsilon = 1e-14);
            approx::assert_relative_eq!(angle.first * phi1.first, phi2.first, max_relative = 1e-9);
        }
        let (from, to) = crank.reach_from(0.25).unwrap().unwrap();
        approx::assert_relative_eq!(from, 0.2, max_relative = 1e-15);
        approx::assert_relative_eq!(to, 0.4, max_relative = 1e-15);
        assert!(crank.reach_from(to).is_err() && crank.jet(to + 1e-9).value.is_nan());
    }
    // The paper's start: the crank stands across the line of the pivots.
    let paper = SlottedLink::new(&spec(l, d, SlottedDriver::Block, SlottedOutput::Crank)).unwrap();
    approx::assert_abs_diff_eq!(paper.jet(0.1f64.sqrt()).value, -FRAC_PI_2, epsilon = 1e-15);
}

#[test]
fn senseless_dimensions_are_refused() {
    let wrong = spec(0.0, f64::NAN, SlottedDriver::Crank, SlottedOutput::Crank);
    let paths: Vec<String> = SlottedLink::new(&wrong)
        .unwrap_err()
        .into_iter()
        .map(|fault| fault.path)
        .collect();
    assert_eq!(
        paths,
        [
            "slotted_link.crank",
            "slotted_link.frame",
            "slotted_link.output"
        ]
    );
    let one_place = spec(0.1, 0.0, SlottedDriver::Block, SlottedOutput::Crank);
    assert!(SlottedLink::new(&one_place).is_err());
}
