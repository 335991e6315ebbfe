//! Kinetostatics against figures computed elsewhere, with 34 digits.

mod checks;
mod cycle;
mod jets;
mod mechanisms;
mod motion;
mod over_a_turn;
mod over_time;
mod press;
mod scenes;
mod struts;
mod study;

use dam::linkage::Linkage;
use dam::linkage::kinetostatics::{
    Convention, ForceFailure, ForceWorkspace, InputMotion, Kinetostatics, Method, Options, Reaction,
};
use mechanisms::{known, spec};
use serde_json::Value;
use std::collections::BTreeMap;

fn reference() -> Value {
    serde_json::from_str(include_str!("../../reference/kinetostatics.json")).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

/// Every quantity of every case within 10⁻⁹ of its largest value over the case.
#[test]
fn every_quantity_of_every_case() {
    for case in reference()["cases"].as_array().unwrap() {
        let mut deviations: BTreeMap<String, (f64, f64)> = BTreeMap::new();
        for expected in case["results"].as_array().unwrap() {
            let by_hand = quantities(case, expected, false);
            for (name, value, wanted) in by_hand.into_iter().chain(quantities(case, expected, true))
            {
                let entry = deviations.entry(name).or_default();
                entry.0 = entry.0.max((value - wanted).abs());
                entry.1 = entry.1.max(wanted.abs());
                assert!(value.is_finite());
            }
        }
        assert_eq!(deviations.len(), 9, "{}", case["id"]);
        for (name, (deviation, scale)) in deviations {
            let limit = if scale > 0.0 { 1e-9 * scale } else { 1e-9 };
            assert!(
                deviation <= limit,
                "{} {name}: {deviation:.2e} of {scale:.2e}",
                case["id"]
            );
        }
    }
}

/// (name, found, expected) at one position of a case, with
/// positions by hand, or the library's own.
fn quantities(case: &Value, expected: &Value, own: bool) -> Vec<(String, f64, f64)> {
    let kind = case["kind"].as_str().unwrap();
    let (speed, acceleration) = (number(&case["phi1dot"]), number(&case["phi1ddot"]));
    let solver = Kinetostatics::new(&spec(kind, &case["data"])).unwrap();
    let mut w = solver.workspace();
    let angle = number(&expected["phi1_deg"]).to_radians();
    let (positions, output) = known(kind, &case["data"], angle);
    let motion = InputMotion {
        coordinate: angle,
        speed,
        acceleration,
    };
    let options = Options::default();
    let solved = if own {
        let linkage = Linkage::new(solver.spec().clone()).unwrap();
        let mut at = linkage.workspace();
        linkage.solve(angle, 3, &mut at).unwrap();
        solver.solve(&at, motion, &options, &mut w)
    } else {
        solver.solve(&positions, motion, &options, &mut w)
    };
    let solved = solved.unwrap();
    assert!(solved.unique && solved.solutions == 1, "{solved:?}");
    let balance = solver.balance(&w);
    assert!(balance.residual < 1e-10, "{balance:?}");
    assert!(balance.loss >= 0.0);
    assert!(solver.influence_error(&mut w) < 1e-12);
    let found = solver.transmission(0, &solver.loads_of(0), angle, &w);
    assert!((found.ratio - output.1).abs() < 1e-14 && (found.slope - output.2).abs() < 1e-12);
    let mut list = vec![
        ("i".to_owned(), found.ratio, number(&expected["i"])),
        (
            "sign".to_owned(),
            found.sign,
            number(&expected["sign_i_plus"]),
        ),
        ("M1".to_owned(), w.driver_force(), number(&expected["M1"])),
        (
            "chi".to_owned(),
            found
                .dynamic_ratio(w.driver_force(), Convention::Paper)
                .unwrap(),
            number(&expected["chi"]),
        ),
        ("loss".to_owned(), balance.loss, number(&expected["loss_W"])),
    ];
    for (index, pair) in solver.spec().pairs.iter().enumerate() {
        let found = two(&solver, index, &w);
        for k in 0..2 {
            list.push((
                pair.name.clone(),
                found[k],
                number(&expected[&pair.name][k]),
            ));
        }
    }
    list
}

fn two(solver: &Kinetostatics, pair: usize, w: &ForceWorkspace) -> [f64; 2] {
    match solver.reaction(pair, w) {
        Reaction::Pin(force) => force,
        Reaction::Guide(normal) => normal,
    }
}

/// Strong friction: where the plain iteration cycles, where there are two
/// solutions, and where there is none.
#[test]
fn strong_friction() {
    for case in reference()["stress"].as_array().unwrap() {
        let solver = Kinetostatics::new(&spec("slider_crank", &case["data"])).unwrap();
        for expected in case["results"].as_array().unwrap() {
            let angle = number(&expected["phi1_deg"]);
            let (w, solved) = stress(&solver, &case["data"], angle).unwrap();
            let near = |found: f64, wanted: f64, scale: f64| {
                assert!(
                    (found - wanted).abs() < 1e-9 * scale,
                    "{angle}: {found} {wanted}"
                );
            };
            near(w.driver_force(), number(&expected["M1"]), 300.0);
            near(solver.balance(&w).loss, number(&expected["loss_W"]), 3000.0);
            let corners = two(&solver, 3, &w);
            for k in 0..2 {
                near(corners[k], number(&expected["P03"][k]), 2600.0);
            }
            let plain = expected["plain_iteration_converges"].as_bool().unwrap();
            assert_eq!(solved.convergence.method == Method::Plain, plain, "{angle}");
            let count = number(&expected["solutions_found"]) as usize;
            assert_eq!(solved.solutions, count, "{angle}: {:?}", w.other_drives());
            assert_eq!(w.other_drives().len(), count - 1);
        }
    }
}

type Found = (ForceWorkspace, dam::linkage::kinetostatics::SolutionQuality);

fn stress(solver: &Kinetostatics, data: &Value, degrees: f64) -> Result<Found, ForceFailure> {
    let mut w = solver.workspace();
    let angle = degrees.to_radians();
    let motion = InputMotion {
        coordinate: angle,
        speed: 10.0,
        acceleration: 0.0,
    };
    let (positions, _) = known("slider_crank", data, angle);
    let solved = solver.solve(&positions, motion, &Options::default(), &mut w)?;
    Ok((w, solved))
}

/// N·(1 − 0.6·μ²) = 300·μ at 180°: a solution below μ = 1/√0.6 only.
#[test]
fn self_locking_is_recognised_at_its_exact_limit() {
    let reference = reference();
    let data = &reference["stress"][0]["data"];
    let limit = 1.0 / 0.6f64.sqrt();
    for (mu, solvable) in [
        (1.29, true),
        (limit - 1e-6, true),
        (limit + 1e-6, false),
        (1.3, false),
    ] {
        let mut linkage = spec("slider_crank", data);
        linkage.pairs.iter_mut().for_each(|pair| pair.friction = mu);
        let solver = Kinetostatics::new(&linkage).unwrap();
        match stress(&solver, data, 180.0) {
            Ok((w, _)) => {
                assert!(solvable, "{mu}");
                let normal = 300.0 * mu / (1.0 - 0.6 * mu * mu);
                let [a, b] = two(&solver, 3, &w);
                assert!((a + normal).abs() < 1e-6 * normal, "{mu}: {a} {normal}");
                assert!((b - normal).abs() < 1e-6 * normal);
            }
            Err(failure) => {
                assert!(!solvable, "{mu}: {failure}");
                assert!(
                    matches!(failure, ForceFailure::SelfLocking { .. }),
                    "{failure:?}"
                );
            }
        }
    }
}

/// At 30° and μ = 1.1 there are two solutions, and both are told.
#[test]
fn two_solutions_are_pointed_out() {
    let reference = reference();
    let case = &reference["stress"][0];
    let solver = Kinetostatics::new(&spec("slider_crank", &case["data"])).unwrap();
    let (w, solved) = stress(&solver, &case["data"], 30.0).unwrap();
    assert!(!solved.unique);
    assert_eq!(
        solved.solutions,
        2,
        "{:?} {:?}",
        w.driver_force(),
        w.other_drives()
    );
}
