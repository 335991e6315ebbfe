//! Forces and couples over time on the outputs of a linkage, against a closed form.

use dam::model::Model;
use dam::studies::forces::ForceStudy;
use dam::studies::studied::forces_of;

/// A slider-crank without masses: crank 60 mm, rod 300 mm.
fn press(more: &str, outputs: &str) -> Model {
    let motion = r#"{ "run_up": { "speed": 10, "time": 0.2 } }"#;
    super::press::press(motion, more, "", outputs)
}

fn study(model: &Model) -> ForceStudy {
    let study = forces_of(model, "press", 0.7).unwrap();
    assert_eq!(study.solved().count(), study.rows.len());
    study
}

/// x and x′ of the slide, and the cosine of the rod's inclination.
fn slide(phi: f64) -> [f64; 3] {
    let (r, l) = (0.06, 0.3);
    let cosine = (1.0 - (r * phi.sin() / l).powi(2)).sqrt();
    let slope = -r * phi.sin() - r * r * phi.sin() * phi.cos() / (l * cosine);
    [r * phi.cos() + l * cosine, slope, cosine]
}

#[test]
fn forces_and_couples_over_time_go_through_the_pairs() {
    let model = press(
        "",
        r#""ram": { "point": "slide.origin", "loads": { "blow": { "time_table": [[0, 100], [0.7, -600]] } } },
           "crank": { "angle": "crank", "loads": { "brake": { "time_table": [[0, 0], [0.35, -7], [0.7, 0]] } } }"#,
    );
    let study = study(&model);
    assert!(study.course.has_loads());
    let pairs = ["R12", "R23"].map(|name| {
        let mut pairs = study.linkage.pairs.iter();
        pairs.position(|pair| pair.name == name).unwrap()
    });
    for (row, forces) in study.solved() {
        let time = row.time.unwrap();
        let force = 100.0 - 1000.0 * time;
        let couple = -7.0 * (1.0 - (time / 0.35 - 1.0).abs());
        let [_, slope, cosine] = slide(row.motion.coordinate);
        // Nothing has mass: the drive does what the loads take.
        approx::assert_abs_diff_eq!(forces.drive, -force * slope - couple, epsilon = 1e-6);
        for pair in pairs {
            let size = forces.pairs[pair].greatest_force();
            approx::assert_abs_diff_eq!(size, force.abs() / cosine, epsilon = 1e-6);
        }
    }
}

#[test]
fn what_hangs_on_an_output_loads_it() {
    // 2 kg that slide with the ram, rigidly.
    let mass = r#""mass": { "kind": "slider", "input": "press.ram", "position": { "ratio": 1 },
        "inertia": "2 kg", "masses": 0 },"#;
    let study = study(&press(mass, r#""ram": { "point": "slide.origin" }"#));
    for (row, forces) in study.solved() {
        let phi = row.motion.coordinate;
        let step = 1e-5;
        let bend = (slide(phi + step)[1] - slide(phi - step)[1]) / (2.0 * step);
        let slope = slide(phi)[1];
        let acceleration = slope * row.motion.acceleration + bend * row.motion.speed.powi(2);
        let wanted = 2.0 * acceleration * slope;
        approx::assert_abs_diff_eq!(forces.drive, wanted, epsilon = 1e-5);
    }
}

#[test]
fn nothing_acts_where_nothing_is_said() {
    let study = study(&press("", r#""ram": { "point": "slide.origin" }"#));
    assert!(!study.course.has_loads());
    assert!(study.solved().all(|(_, forces)| forces.drive.abs() < 1e-12));
}
