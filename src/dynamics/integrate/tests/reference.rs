//! The published rocker against figures computed independently: file
//! elastic-rocker.json (modal closed form between switches, 80-bit arithmetic,
//! event-exact), cases one_mass_damped, two_mass_damped, ten_mass_damped.

use super::problems::Rocker;
use super::*;

struct Case {
    masses: usize,
    duration: f64,
    /// φ_n and its rate at the end (rad, rad/s).
    end: [f64; 2],
    /// Greatest positioning error (rad).
    greatest: f64,
    switches: u64,
    first_switches: [f64; 8],
}

const ONE: Case = Case {
    masses: 1,
    duration: 0.5,
    end: [-6.00249690245187e-5, 98.6999411233864],
    greatest: 0.00750604325896589,
    switches: 150,
    first_switches: [
        0.0209322348537,
        0.0372733871517,
        0.0375891575529,
        0.0414417973759,
        0.0417628517441,
        0.0443445712537,
        0.0446706401503,
        0.0466117147113,
    ],
};

const TWO: Case = Case {
    masses: 2,
    duration: 0.5,
    end: [-6.00232442465282e-5, 98.699696930596],
    greatest: 0.00750086431057496,
    switches: 130,
    first_switches: [
        0.0209319661193,
        0.0372729356335,
        0.0375724836487,
        0.0413280485618,
        0.0416328351733,
        0.044086004532,
        0.0443961025765,
        0.0461906571619,
    ],
};

const TEN: Case = Case {
    masses: 10,
    duration: 0.2,
    end: [-6.00197830777874e-5, 98.6991514497686],
    greatest: 0.00749017401566336,
    switches: 52,
    first_switches: [
        0.0209325195221,
        0.0372722326933,
        0.0375384939177,
        0.0412299790817,
        0.0415007581411,
        0.043870562037,
        0.0441460000914,
        0.0458488210999,
    ],
};

/// Greatest error of the end displacement and of the first eight switch times,
/// relative to the greatest positioning error and to the duration.
fn errors(case: &Case, method: Method, tolerance: f64) -> (f64, f64) {
    let system = Rocker::published(case.masses, 0.4);
    let (y, modes) = system.static_start();
    let settings = settings(method, tolerance, None);
    let (outcome, keeper) = run(&system, case.duration, &y, &modes.0, &settings);
    assert_eq!(outcome.stop, Stop::Complete);
    assert_eq!(outcome.statistics.switches, case.switches, "{method}");
    let end = system.last(case.duration, &keeper.y);
    let speed = (end[1] - case.end[1]).abs() / case.end[1];
    assert!(speed < 1e-6, "{method}: end speed {speed:e}");
    let times = keeper.times();
    let late = case.first_switches.iter().zip(&times);
    let late = late.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    (
        (end[0] - case.end[0]).abs() / case.greatest,
        late / case.duration,
    )
}

#[test]
fn at_a_tight_tolerance_the_rocker_agrees_to_ten_digits() {
    for case in [ONE, TWO] {
        for method in [Method::Dopri5, Method::Dop853, Method::Taylor] {
            let (end, late) = errors(&case, method, 1e-10);
            assert!(end < 1e-10, "{method}, {} masses: {end:e}", case.masses);
            // The file gives the times to 12 digits after the point.
            assert!(late < 1e-11, "{method}, {} masses: {late:e}", case.masses);
        }
    }
}

/// Ten masses are stiff: overdamped modes of 10⁷ 1/s beside a lever of 10⁴ rad/s.
#[test]
fn ten_masses_agree_with_an_implicit_method() {
    let methods = [
        (Method::Bdf, 1e-8),
        (Method::Rodas5p, 1e-9),
        (Method::Radau, 1e-9),
    ];
    for (method, tolerance) in methods {
        if !method.is_available() {
            continue;
        }
        let (end, late) = errors(&TEN, method, tolerance);
        assert!(end < 1e-8, "{method}: {end:e}");
        assert!(late < 1e-8, "{method}: {late:e}");
    }
}

#[test]
fn every_method_finds_all_switches_at_an_ordinary_tolerance() {
    for case in [ONE, TWO] {
        let left_out = [Method::Rk4, Method::TrBdf2];
        for method in Method::available().filter(|method| !left_out.contains(method)) {
            let (end, late) = errors(&case, method, 1e-6);
            assert!(end < 1e-6, "{method}, {} masses: {end:e}", case.masses);
            assert!(late < 1e-6, "{method}, {} masses: {late:e}", case.masses);
        }
    }
}
