use super::*;
use std::f64::consts::PI;

#[test]
fn a_linkage_that_cannot_be_assembled_at_the_start_is_a_fault() {
    // Crank longer than the rod: |sin θ| < 0.2/0.25, θ within ±53.13 deg.
    let ram = || part(chain(Coordinate::Sliding, slider_crank(0.25), rigid(1.0)));
    let faults = lower(&scene(vec![
        ("drive", None, drive(1.0, PI / 2.0)),
        ("ram", Some("drive"), ram()),
    ]))
    .unwrap_err();
    assert_eq!(faults[0].path, "ram.position");
    assert!(faults[0].message.contains("`drive` at 90 deg"));
    assert!(
        faults[0]
            .hint
            .contains("between -53.1301024 and 53.1301024 deg"),
        "{}",
        faults[0].hint
    );
    // A motor's angle counts as well.
    assert_eq!(
        fault_paths(vec![("m", None, motor(2.0)), ("ram", Some("m"), ram())]),
        ["ram.position"]
    );
}

#[test]
fn a_dead_position_on_the_way_is_said_before_and_stops_the_run() {
    let ram = || part(chain(Coordinate::Sliding, slider_crank(0.25), rigid(1.0)));
    let edge = 0.8f64.asin();
    let model = lowered(vec![
        ("drive", None, drive(2.0, 0.1)),
        ("ram", Some("drive"), ram()),
    ]);
    let track = &model.tracks[0];
    assert!(track.stops && track.object == 1 && track.source == TrackSource::Node(0));
    approx::assert_abs_diff_eq!(track.breaks.points[0], -edge, epsilon = 1e-15);
    approx::assert_abs_diff_eq!(track.breaks.points[1], edge, epsilon = 1e-15);
    let when = format!("t = {:.6} s", (edge - 0.1) / 2.0);
    assert!(model.warnings[0].contains(&when), "{}", model.warnings[0]);
    // Backwards the other edge comes first; a slow drive never gets there.
    let model = lowered(vec![
        ("drive", None, drive(-2.0, 0.1)),
        ("ram", Some("drive"), ram()),
    ]);
    let when = format!("t = {:.6} s", (edge + 0.1) / 2.0);
    assert!(model.warnings[0].contains(&when), "{}", model.warnings[0]);
    let model = lowered(vec![
        ("drive", None, drive(0.5, 0.1)),
        ("ram", Some("drive"), ram()),
    ]);
    assert!(model.warnings.is_empty() && model.tracks[0].stops);
}

#[test]
fn reach_is_followed_through_rigid_and_elastic_objects() {
    // A rocker swinging ±0.95 rad drives a linkage that ends at asin 0.8 = 0.9273 rad.
    let swing = PositionSpec::Sine {
        amplitude: 0.95,
        harmonic: 1.0,
        phase: 0.0,
        offset: 0.0,
    };
    for body in [rigid(0.1), uniform(3)] {
        let model = lowered(vec![
            ("drive", None, drive(2.0, 0.0)),
            (
                "lever",
                Some("drive"),
                part(chain(Coordinate::Turning, swing.clone(), body)),
            ),
            (
                "ram",
                Some("lever"),
                part(chain(Coordinate::Sliding, slider_crank(0.25), rigid(1.0))),
            ),
        ]);
        let time = (0.8f64.asin() / 0.95).asin() / 2.0;
        let when = format!("t = {time:.6} s");
        assert!(model.warnings[0].contains(&when), "{}", model.warnings[0]);
        assert_eq!(
            model.tracks[0].source,
            TrackSource::Node(model.objects[1].nodes.len())
        );
    }
}
