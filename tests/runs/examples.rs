//! The examples do what they say.

use approx::assert_abs_diff_eq;
use dam::prelude::*;

#[path = "../../examples/map.rs"]
mod map;
#[path = "../../examples/own_object.rs"]
mod own_object;
#[path = "../../examples/rocker.rs"]
mod rocker;
#[path = "../../examples/sweep.rs"]
mod sweep;

#[test]
fn they_run() {
    for example in [rocker::main, own_object::main, sweep::main, map::main] {
        example().unwrap();
    }
}

#[test]
fn the_rocker_in_code_is_the_one_in_json() {
    let in_json = Scene::read("scenarios/rocker/two_masses.json").unwrap();
    let [in_code, in_json] = [rocker::scene(), in_json].map(|scene| scene.decode().unwrap());
    // All but the expectations.
    let mut canonical = in_json.canonical;
    canonical["expect"] = in_code.canonical["expect"].clone();
    assert_eq!(in_code.canonical, canonical);
    let figures = rocker::scene().run().unwrap();
    let delta_max = figures.figure("rocker", Figure::DeltaMax).unwrap();
    assert_abs_diff_eq!(delta_max, 0.00750086, epsilon = 1e-8);
}

#[test]
fn the_elliptic_gears_have_right_derivatives() {
    use dam::position::PositionFunction;
    let e = 0.3;
    let gears = own_object::EllipticGears::new(e);
    let at = |phi: f64| gears.jet(0, phi);
    let h = 1e-5;
    for phi in [-7.0, -0.9, 0.0, 0.7, 3.0, 3.2, 6.0, 7.1] {
        let (before, here, after) = (at(phi - h), at(phi), at(phi + h));
        let slope = |read: fn(&dam::jet::Jet) -> f64| (read(&after) - read(&before)) / (2.0 * h);
        assert_abs_diff_eq!(slope(|jet| jet.value), here.first, epsilon = 1e-8);
        assert_abs_diff_eq!(slope(|jet| jet.first), here.second, epsilon = 1e-8);
        assert_abs_diff_eq!(slope(|jet| jet.second), here.third, epsilon = 1e-8);
        let angle = 2.0 * ((1.0 + e) / (1.0 - e) * (0.5 * phi).tan()).atan();
        assert_abs_diff_eq!((here.value - angle).sin(), 0.0, epsilon = 1e-12);
    }
    let turn = at(1.0 + std::f64::consts::TAU).value - at(1.0).value;
    assert_abs_diff_eq!(turn, std::f64::consts::TAU, epsilon = 1e-12);
}

#[test]
fn an_own_kind_runs_exactly_and_has_json_and_diagnostics() {
    let run = own_object::scene().run().unwrap();
    assert!(run.is_complete() && run.is_trusted());
    assert_eq!(run.method, Method::Exact);
    let general = own_object::scene().method("dop853").tolerance(1e-11);
    let general = general.run().unwrap();
    let (one, other) = (run.displacement("drum"), general.displacement("drum"));
    for (one, other) in one.unwrap().iter().zip(other.unwrap()) {
        assert_abs_diff_eq!(one, other, epsilon = 1e-7);
    }
    let text = own_object::scene().json().replace("0.3", "1.3");
    let scene = Scene::from_json(&text).unwrap();
    let unknown = scene.run().unwrap_err().to_string();
    assert!(unknown.contains("`elliptic_gears`"), "{unknown}");
    let error = scene.with_kind(own_object::ELLIPTIC_GEARS).run();
    let error = error.unwrap_err();
    assert_eq!(error.faults()[0].path, "drum.eccentricity");
    assert!(
        error
            .to_string()
            .contains("must be at least 0 and at most 0.9")
    );
}

#[test]
fn an_own_kind_is_mapped() {
    let axis = Axis::linear("drum.eccentricity", 0.1, 0.5, 3);
    let map = own_object::scene().duration(1).map(axis);
    let map = map.figure("drum", Figure::PeakSpeed).ask().unwrap();
    assert_eq!(map.shape(), (1, 3));
    // Greatest speed over that of the driving gear: (1 + e)/(1 − e), and what the
    // elastic drum adds to it.
    for (e, cell) in map.x.iter().zip(&map.cells) {
        let rigid = 4.0 * std::f64::consts::PI * (1.0 + e) / (1.0 - e);
        let value = cell.value.unwrap();
        assert!(
            value > rigid && value < 1.2 * rigid,
            "{e}: {value} for {rigid}"
        );
    }
}

#[test]
fn the_sweep_finds_where_it_lifts_off() {
    let scene = rocker::scene();
    let rows = sweep::sweep(&scene, &[2.0, 10.0]).unwrap();
    assert_eq!((rows[0].1, rows[1].1), (0.0, 65.0));
}

#[test]
fn the_map_is_an_array() {
    let map = map::map().unwrap();
    assert_eq!(map.shape(), (3, 7));
    let values = map.values(f64::NAN);
    assert_eq!(values.shape(), (3, 7));
    for (row, cells) in map.rows().enumerate() {
        for (column, cell) in cells.iter().enumerate() {
            assert_eq!(cell.value, Some(values[(row, column)]));
            assert_eq!(&map[(row, column)], cell);
        }
    }
    // A point of the map is the run with those values.
    let scene = rocker::scene().set("rocker.inertia", map.x[3]);
    let run = scene.set("rocker.stiffness", map.y[1]).run().unwrap();
    let value = run.figure("rocker", Figure::DeltaMax).unwrap();
    assert_abs_diff_eq!(values[(1, 3)], value, epsilon = 1e-9 * value.abs());
}
