//! What is timed is right: the same code is held against the reference
//! trajectories.

use crate::case::{Case, SAMPLES};
use crate::peer::Peer;
use crate::{exact_peer, map, press};

#[test]
fn exact_propagation_reaches_the_reference_in_all_cases() {
    for case in Case::all() {
        let solution = exact_peer::solve(&case.chain, SAMPLES).expect("runs");
        let error = case.error(&solution.samples);
        assert!(error <= 1e-10, "case {}: {error:e}", case.name);
        assert_eq!(solution.switches, Some(case.switches), "case {}", case.name);
    }
}

#[test]
fn the_general_solvers_solve_the_same_problem() {
    // Errors lie between 3e-7 and 1.3e-4 at this tolerance; a mistake in the
    // equations would show as 1.
    for case in Case::all().iter().filter(|case| "AB".contains(case.name)) {
        for peer in Peer::all(None) {
            let (solution, _) = peer.solve(case, 1e-7).expect("runs");
            let error = case.error(&solution.samples);
            let place = format!("case {}, {}: {error:e}", case.name, peer.name());
            assert!(error <= 5e-4, "{place}");
            assert!(error >= 1e-9, "too good to be its own work: {place}");
            if let Some(switches) = solution.switches {
                assert_eq!(switches, case.switches, "{place}");
            }
        }
    }
}

#[test]
fn explicit_solvers_come_closer_with_the_tolerance() {
    let case = &Case::all()[1];
    for peer in Peer::all(None).iter().take(3) {
        let error = |tolerance: f64| {
            let (solution, _) = peer.solve(case, tolerance).expect("runs");
            case.error(&solution.samples)
        };
        let (loose, close) = (error(1e-5), error(1e-10));
        assert!(close < 1e-4 * loose, "{}: {loose:e} {close:e}", peer.name());
    }
}

#[test]
fn an_error_is_measured_where_it_is_greatest_and_a_missing_number_is_infinite() {
    let case = &Case::all()[0];
    let largest = case.reference.iter().fold(0.0f64, |m, q| m.max(q.abs()));
    let mut samples = case.reference.clone();
    assert_eq!(case.error(&samples), 0.0);
    samples[700] += 1e-3 * largest;
    approx::assert_relative_eq!(case.error(&samples), 1e-3, max_relative = 1e-9);
    samples[300] = f64::NAN;
    assert_eq!(case.error(&samples), f64::INFINITY);
}

#[test]
fn every_determined_cell_of_the_map_is_right() {
    let ([_, worst], determined) = map::own_errors();
    assert!(worst <= 1e-6, "{worst:e}");
    let count = determined.iter().filter(|cell| **cell).count();
    assert!((300..400).contains(&count), "{count} cells");
}

#[test]
fn the_solvers_of_the_press_agree() {
    let fine = press::fine(&press::Press::new(5).expect("a press")).expect("runs");
    assert!(fine.apart <= 1e-9, "{:e}", fine.apart);
    assert_eq!(fine.switches, [3, 3]);
}
