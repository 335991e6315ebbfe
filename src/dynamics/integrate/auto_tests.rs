use super::super::tests::problems::{Oscillator, Rocker, Thrown};
use super::*;

#[test]
fn the_fastest_rate_agrees_with_closed_forms() {
    let rate = |damping: f64| {
        let system = Oscillator {
            damping,
            ..Oscillator::free(30.0)
        };
        fastest_rate(&system, 0.0, &[0.0, 0.0], &Modes::default())
    };
    approx::assert_relative_eq!(rate(0.0), 30.0, max_relative = 1e-2);
    approx::assert_relative_eq!(rate(0.2), 30.0, max_relative = 2e-2);
    // Overdamped: λ = −ω(ζ + √(ζ² − 1)).
    let expected = 30.0 * (5.0 + 24.0f64.sqrt());
    approx::assert_relative_eq!(rate(5.0), expected, max_relative = 1e-3);
    let free = Thrown::new(9.81, 1.0);
    assert_eq!(fastest_rate(&free, 0.0, &[0.0, 0.0], &Modes(vec![0])), 0.0);
}

fn rocker(masses: usize, tolerance: f64) -> MethodChoice {
    let system = Rocker::published(masses, 0.4);
    let (y, modes) = system.static_start();
    choose(&Situation {
        fastest: fastest_rate(&system, 0.0, &y, &modes),
        vibrations: vec![stays(1e4)],
        coordinates: masses,
        ..situation(tolerance, 0.5)
    })
}

fn stays(frequency: f64) -> Vibration {
    Vibration {
        frequency,
        decay: 0.0,
    }
}

/// Nothing vibrates, nothing turns.
fn situation(tolerance: f64, duration: f64) -> Situation {
    Situation {
        fastest: 0.0,
        vibrations: Vec::new(),
        turning: 0.0,
        has_variable_ratio: false,
        way: f64::INFINITY,
        breaks: 0.0,
        expands: true,
        corners: false,
        joint_friction: false,
        tolerance,
        coordinates: 1,
        duration,
    }
}

#[test]
fn a_stiff_chain_gets_the_implicit_method_and_a_short_one_power_series() {
    for tolerance in [1e-4, 1e-6, 1e-8] {
        let MethodChoice { method, why, .. } = rocker(10, tolerance);
        assert_eq!(method, Method::Radau, "{why}");
        assert!(why.contains("times what the motion shows"));
    }
    for tolerance in [1e-6, 1e-8, 1e-10] {
        let MethodChoice { method, why, .. } = rocker(1, tolerance);
        assert_eq!(method, Method::Taylor, "{why}");
        assert!(why.starts_with("power series"), "{why}");
    }
}

#[test]
fn what_would_not_come_to_an_end_is_not_in_reserve() {
    let stiff = Situation {
        fastest: 1e11,
        ..situation(1e-9, 0.5)
    };
    let methods = |situation: &Situation| -> Vec<Method> {
        let reserve = choose(situation).reserve;
        reserve.iter().map(|own| own.method).collect()
    };
    assert_eq!(methods(&stiff), [Method::Rodas5p]);
    let soft = methods(&situation(1e-9, 0.5));
    assert!(soft.contains(&Method::Radau) && soft.len() > 1, "{soft:?}");
}

#[test]
fn a_system_at_rest_without_springs_has_a_method_and_a_readable_reason() {
    let MethodChoice { method, why, .. } = choose(&situation(1e-8, 2.0));
    assert_eq!(method, Method::Taylor);
    assert!(!why.contains("NaN") && !why.contains("inf"), "{why}");
}

#[test]
fn what_has_no_series_gets_a_method_of_stages_by_its_tolerance() {
    let mut situation = Situation {
        fastest: 1e7,
        vibrations: vec![stays(100.0)],
        expands: false,
        coordinates: 4,
        ..situation(1e-5, 1.0)
    };
    assert_eq!(choose(&situation).method, Method::Radau);
    situation.fastest = 100.0;
    situation.tolerance = 1e-2;
    let MethodChoice { method, why, .. } = choose(&situation);
    assert_eq!(method, Method::Dopri5);
    assert!(why.contains("the tolerance asks for steps"), "{why}");
    // Long smooth steps are worth their price where they are few.
    situation.tolerance = 1e-8;
    assert_eq!(choose(&situation).method, Method::Radau);
}

#[test]
fn a_vibration_that_dies_out_counts_for_as_long_as_it_lasts() {
    let shown = |decay: f64, turning: f64| {
        let vibrations = vec![Vibration {
            frequency: 2e4,
            decay,
        }];
        Situation {
            vibrations,
            turning,
            ..situation(1e-4, 2.0)
        }
        .highest_frequency()
    };
    assert_eq!(shown(0.0, 10.0), 2e4);
    // Half of ln 1e4/400 s of the 2π/10 s of a turn.
    let share = 0.5 * 1e4f64.ln() / 400.0 / (TAU / 10.0);
    approx::assert_relative_eq!(shown(400.0, 10.0), share * 2e4, max_relative = 1e-12);
    // Within the whole run, where nothing turns; never less than the drive shows.
    approx::assert_relative_eq!(
        shown(400.0, 0.0),
        0.5 * 1e4f64.ln() / 800.0 * 2e4,
        max_relative = 1e-12
    );
    assert_eq!(shown(1e9, 10.0), 10.0);
}

#[test]
fn what_dies_out_and_what_stays_get_different_methods() {
    let of = |decay: f64| {
        choose(&Situation {
            fastest: 2e4,
            vibrations: vec![Vibration {
                frequency: 2e4,
                decay,
            }],
            turning: 10.0,
            coordinates: 2,
            ..situation(1e-7, 1.0)
        })
    };
    assert_eq!(of(0.0).method, Method::Taylor);
    let MethodChoice { method, why, .. } = of(1000.0);
    assert_eq!(method, Method::Radau, "{why}");
    assert!(why.contains("times what the motion shows"), "{why}");
}

#[test]
fn many_breaks_speak_for_steps_that_begin_easily() {
    let of = |breaks: f64| {
        choose(&Situation {
            turning: 100.0,
            has_variable_ratio: true,
            way: 0.2,
            breaks,
            ..situation(1e-7, 0.5)
        })
    };
    assert_eq!(of(0.0).method, Method::Radau);
    assert_ne!(of(100.0).method, Method::Radau);
}

#[test]
fn laws_of_many_harmonics_speak_against_power_series() {
    let of = |way: f64| {
        choose(&Situation {
            turning: 100.0,
            has_variable_ratio: true,
            way,
            breaks: 20.0,
            ..situation(1e-7, 0.5)
        })
    };
    assert_eq!(of(0.5).method, Method::Taylor);
    assert_ne!(of(0.02).method, Method::Taylor);
}

#[test]
fn errors_add_up_so_that_a_finer_tolerance_is_aimed_at() {
    for asked in [1e-4, 1e-7, 1e-10, 1e-13, 1e-14] {
        let MethodChoice { tolerance, why, .. } = choose(&situation(asked, 2.0));
        let expected = if asked < 5e-13 { asked } else { 0.05 * asked };
        approx::assert_relative_eq!(tolerance, expected, max_relative = 1e-12);
        assert_eq!(
            why.contains("with a tolerance of"),
            tolerance < asked,
            "{why}"
        );
    }
}

#[test]
fn joint_friction_of_several_inputs_keeps_implicit_methods_away() {
    let of = |joint_friction: bool, fastest: f64| {
        let chosen = choose(&Situation {
            fastest,
            turning: 40.0,
            vibrations: vec![stays(40.0)],
            expands: false,
            joint_friction,
            ..situation(1e-9, 1.5)
        });
        chosen.method
    };
    let moderate = 1e4;
    assert_eq!(of(false, moderate), Method::Radau);
    let explicit = of(true, moderate);
    assert!(
        matches!(explicit, Method::Dopri5 | Method::Dop853),
        "{explicit:?}"
    );
    // What is stiff beyond that still needs one.
    assert_eq!(of(true, 1e7), Method::Radau);
}

#[test]
fn corners_that_no_switch_marks_ask_for_a_greater_margin() {
    let of = |corners: bool| {
        let chosen = choose(&Situation {
            fastest: 1e7,
            vibrations: vec![stays(100.0)],
            expands: false,
            corners,
            ..situation(1e-7, 1.0)
        });
        assert_eq!(chosen.method, Method::Radau, "{}", chosen.why);
        chosen.tolerance
    };
    approx::assert_relative_eq!(of(true), of(false) / UNSEEN, max_relative = 1e-12);
}

#[test]
fn no_method_that_a_build_may_lack_is_ever_chosen() {
    for behaviour in &BEHAVIOURS {
        let needs = matches!(
            behaviour.method,
            Method::Bdf | Method::TrBdf2 | Method::Esdirk34
        );
        assert!(!needs, "{}", behaviour.method);
    }
}
