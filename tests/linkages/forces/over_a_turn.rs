//! Loads on the outputs of a linkage over a turn of its input, against a closed form.

use dam::model::Model;
use dam::studies::forces::ForceStudy;
use dam::studies::studied::forces_of;

/// A slider-crank without masses, crank 60 mm and rod 300 mm, that turns uniformly at half the
/// speed of its drive, with a load on its slide.
fn press(load: &str) -> Model {
    let outputs =
        format!(r#""ram": {{ "point": "slide.origin", "loads": {{ "cutting": {load} }} }}"#);
    let ratio = r#""position": { "ratio": 0.5 },"#;
    super::press::press(r#"{ "speed": 20 }"#, "", ratio, &outputs)
}

fn study(load: &str) -> ForceStudy {
    let study = forces_of(&press(load), "press", 0.7).unwrap();
    assert!(study.course.is_closed());
    assert_eq!(study.solved().count(), study.rows.len());
    study
}

/// x and x′ of the slide.
fn slide(phi: f64) -> [f64; 2] {
    let (r, l) = (0.06, 0.3);
    let cosine = (1.0 - (r * phi.sin() / l).powi(2)).sqrt();
    let slope = -r * phi.sin() - r * r * phi.sin() * phi.cos() / (l * cosine);
    [r * phi.cos() + l * cosine, slope]
}

#[test]
fn a_window_over_the_machine_angle_acts_over_a_turn() {
    // From 30.3 to 170.7 deg of the crank, which are no positions of the course.
    let study = study(
        r#"{ "window": { "from": "60.6 deg", "to": "341.4 deg", "force": "2 kN", "period": "720 deg" }, "over": "drive" }"#,
    );
    assert_eq!(study.acting, ["press.outputs.ram.loads.cutting"]);
    for (row, forces) in study.solved() {
        let phi = row.motion.coordinate;
        let inside = (30.3..170.7).contains(&phi.to_degrees());
        let force = if inside { 2000.0 } else { 0.0 };
        // Nothing has mass: the drive does what the load takes.
        approx::assert_abs_diff_eq!(forces.drive, -force * slide(phi)[1], epsilon = 1e-9);
    }
    // Jumps are met between the positions: work and greatest value are exact.
    let [from, to] = [30.3f64, 170.7].map(|deg| slide(deg.to_radians())[0]);
    let work = study.cycle.as_ref().unwrap().drive_work;
    approx::assert_relative_eq!(work, 2000.0 * (from - to), max_relative = 1e-9);
    let greatest = study.figure("drive.greatest").unwrap();
    let wanted = (0..20_000).map(|k| -2000.0 * slide(f64::from(k) * 1.0e-4)[1]);
    let wanted = wanted.fold(0.0, f64::max);
    approx::assert_relative_eq!(greatest, wanted, max_relative = 1e-7);
}

#[test]
fn loads_over_displacement_and_speed_of_an_output_act_over_a_turn() {
    let spring = study(r#"{ "spring": { "rate": "3 N/mm", "preload": "100 N" } }"#);
    for (row, forces) in spring.solved() {
        let [x, slope] = slide(row.motion.coordinate);
        let force = -100.0 - 3000.0 * x;
        approx::assert_abs_diff_eq!(forces.drive, -force * slope, epsilon = 1e-9);
    }
    let damper = study(r#"{ "viscous": "50 N s/m" }"#);
    for (row, forces) in damper.solved() {
        let [_, slope] = slide(row.motion.coordinate);
        let force = -50.0 * slope * 10.0;
        approx::assert_abs_diff_eq!(forces.drive, -force * slope, epsilon = 1e-9);
    }
}

#[test]
fn a_load_that_is_not_known_over_a_turn_leaves_no_figure() {
    // Over time, and over the machine angle with a period of two turns of the crank.
    for load in [
        r#"{ "time_table": [[0, 100], [0.7, -600]] }"#,
        r#"{ "window": { "from": 1, "to": 2, "force": -100, "period": "1440 deg" }, "over": "drive" }"#,
    ] {
        let why = forces_of(&press(load), "press", 0.7).unwrap_err();
        assert!(why.contains("press.outputs.ram.loads.cutting"), "{why}");
        assert!(why.contains("--time"), "{why}");
    }
}
