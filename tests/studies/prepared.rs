//! Prepared scenes: a point is the run of the scene with its values set.

use dam::prelude::*;
use dam::studies::Control;
use dam::studies::lookup::span_of_run;
use std::path::Path;
use std::sync::atomic::AtomicBool;

fn scene(name: &str) -> Scene {
    let scenarios = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios");
    Scene::read(scenarios.join(name)).unwrap()
}

/// Numbers between 0 and 1, drawn by a seed.
struct Draw(u64);

impl Draw {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Points about the scene's own values, each by up to `share` of it.
fn around(prepared: &PreparedScene, share: f64, count: usize) -> Vec<Vec<f64>> {
    let mut draw = Draw(count as u64);
    let mut point = || {
        let values = prepared.values().iter();
        let moved = values.map(|value| value * (1.0 + share * (2.0 * draw.next() - 1.0)));
        moved.collect()
    };
    (0..count).map(|_| point()).collect()
}

/// What a run of the scene with the values set says of the figures; `None`: it did not come to
/// its end.
fn run_of(
    scene: &Scene,
    prepared: &PreparedScene,
    values: &[f64],
) -> Result<Option<Vec<f64>>, Error> {
    let set = prepared.parameters().iter().zip(values);
    let scene = set.fold(scene.clone(), |scene, (path, &value)| {
        scene.set(path, value)
    });
    let mut ready = scene.prepare()?;
    let spans = prepared.figures().iter().filter_map(|one| span_of_run(one));
    ready.settings.spans = spans.collect();
    let found = ready.run()?;
    if !found.is_complete() || !found.is_trusted() {
        return Ok(None);
    }
    let value = |figure: &String| match found.figures.value(figure) {
        Ok(value) => value,
        Err(_) => study_figure(&ready, figure),
    };
    Ok(Some(prepared.figures().iter().map(value).collect()))
}

fn study_figure(ready: &Mechanism, figure: &str) -> f64 {
    let subject = dam::studies::lookup::Subject {
        scene: ready.scene(),
        system: &ready.system,
        settings: &ready.settings,
        control: &Control::default(),
    };
    let found = dam::studies::lookup::figure(figure, subject).unwrap();
    found.unwrap().value.unwrap()
}

/// Compares points with runs; the number of points with values.
fn agree(name: &str, parameters: &[&str], figures: &[&str], share: f64) -> usize {
    let scene = scene(name);
    let prepared = scene.prepare_points(parameters, figures).unwrap();
    let rows = around(&prepared, share, 4);
    let table = prepared.table(&rows).unwrap();
    let mut with_values = 0;
    for (row, point) in rows.iter().zip(&table.points) {
        let Some(found) = run_of(&scene, &prepared, row).unwrap() else {
            assert!(
                point.figures.iter().all(|one| one.value.is_none()),
                "{name} {row:?}"
            );
            assert!(!point.cause.is_empty());
            continue;
        };
        with_values += 1;
        for (index, (figure, value)) in figures.iter().zip(found).enumerate() {
            let own = point.value(index);
            let own = own.unwrap_or_else(|| panic!("{name} {figure} at {row:?}: {point:?}"));
            approx::assert_relative_eq!(own, value, max_relative = 1e-12);
        }
    }
    with_values
}

const ROCKER: [&str; 2] = ["rocker.inertia", "rocker.stiffness"];

#[test]
fn a_point_is_the_run_of_the_scene() {
    let all = [
        "rocker.delta_max",
        "rocker.sigma",
        "rocker.peak_acceleration",
        "rocker.pair.separations",
        "rocker.pair.longest_separation",
        "rocker.final.displacement",
    ];
    assert_eq!(agree("rocker/two_masses.json", &ROCKER, &all, 0.5), 4);
    let parameters = ["rocker.loads.closing.constant", "shaft.motion.speed"];
    let figures = ["rocker.delta_abs", "frequency.1", "run.switches"];
    assert_eq!(
        agree("rocker/two_masses.json", &parameters, &figures, 0.3),
        4
    );
}

#[test]
fn so_it_is_of_contacts_of_elastic_chains() {
    let figures = ["rod.pair.max_contact_force", "rod.pair.switch_times.0"];
    let parameters = ["rod.stiffness", "rod.pair.contact.stiffness"];
    assert_eq!(
        agree("contact/rod_on_wall.json", &parameters, &figures, 0.2),
        4
    );
    let figures = [
        "valve.seat.stop.max_contact_force",
        "valve.pair.max_contact_force",
        "valve.final.displacement",
    ];
    let parameters = ["camshaft.motion.speed", "valve.stiffness"];
    assert_eq!(
        agree("valve_train/valve_lash.json", &parameters, &figures, 0.1),
        4
    );
}

#[test]
fn so_it_is_of_linkages_and_parts_of_the_motion() {
    let parameters = [
        "mechanism.forces.spring.strut.rate",
        "mechanism.links.rod.moment",
        "run.duration",
    ];
    let figures = [
        "mechanism.slide.final.displacement",
        "mechanism.final.speed",
    ];
    assert_eq!(
        agree(
            "linkages/slider_crank_spring.json",
            &parameters,
            &figures,
            0.3
        ),
        4
    );
    let parameters = [
        "crank.motion.speed",
        "reed.inertia",
        "sley.position.four_bar.crank",
    ];
    let figures = [
        "reed.delta_min",
        "reed.delta_abs from 100 deg to 200 deg",
        "kinematics.sley.rocker.displacement.greatest",
    ];
    assert_eq!(
        agree("four_bar/loom_sley.json", &parameters, &figures, 0.05),
        4
    );
}

#[test]
fn so_it_is_where_some_points_fail() {
    // The rod reaches the crank's circle where it is longer than the crank.
    let parameters = ["slide.position.slider_crank.rod"];
    let figures = ["slide.peak_speed", "slide.final.displacement"];
    let with_values = agree("limits/short_rod.json", &parameters, &figures, 0.5);
    assert!((1..4).contains(&with_values), "{with_values}");
    let prepared = scene("limits/short_rod.json").prepare_points(&parameters, &figures);
    let prepared = prepared.unwrap();
    let stopped = prepared.at(&[0.08]).unwrap();
    assert_eq!(stopped.verdict, Verdict::Stopped, "{stopped:?}");
    assert!(stopped.cause.contains("0.4636"), "{}", stopped.cause);
    let refused = prepared.at(&[-0.08]).unwrap();
    assert_eq!(
        (refused.verdict, refused.value(0)),
        (Verdict::Refused, None)
    );
    assert_eq!(refused.figures.len(), 2);
}

#[test]
fn what_depends_on_a_named_parameter_follows_it() {
    let text = r#"{ "dam": 1, "name": "two", "parameters": { "size": 2, "hard": "1 MN m/rad" },
        "objects": {
          "shaft": { "kind": "drive", "motion": { "speed": "10 rev/s" } },
          "arm": { "kind": "rocker", "input": "shaft",
            "position": { "sine": { "amplitude": "0.1*size" } },
            "inertia": "0.05*size", "stiffness": "hard", "masses": 2 } },
        "run": { "duration": 0.3 } }"#;
    let scene = Scene::from_json(text).unwrap();
    let figures = ["arm.delta_max", "arm.peak_reaction"];
    let prepared = scene
        .prepare_points(&["parameters.size"], &figures)
        .unwrap();
    assert_eq!(prepared.values(), [2.0]);
    for size in [1.5, 3.0] {
        let point = prepared.at(&[size]).unwrap();
        let run = run_of(&scene, &prepared, &[size]).unwrap().unwrap();
        for (index, value) in run.into_iter().enumerate() {
            approx::assert_relative_eq!(point.value(index).unwrap(), value, max_relative = 1e-12);
        }
    }
}

#[test]
fn points_do_not_depend_on_threads_nor_on_the_points_before() {
    let parameters = ["rocker.inertia", "shaft.motion.speed", "run.duration"];
    let prepared = scene("rocker/two_masses.json")
        .prepare_points(
            &parameters,
            &["rocker.delta_max", "rocker.pair.separated_time"],
        )
        .unwrap()
        .check_determined(3);
    let mut rows = around(&prepared, 0.4, 12);
    rows[5][0] = -1.0;
    rows[7][1] = 1e300;
    let points = |threads: usize| {
        let free = Control::default();
        let found = prepared.table_within(&rows, Some(threads), &free, &|_| {});
        found.unwrap().points
    };
    let (one, three) = (points(1), points(3));
    assert_eq!(one, three);
    assert_eq!(
        (one[5].verdict, one[7].verdict),
        (Verdict::Refused, Verdict::Refused)
    );
    for (row, point) in rows.iter().zip(&one).rev() {
        assert_eq!(&prepared.at(row).unwrap(), point);
    }
    assert_eq!(prepared.table(&rows[..0]).unwrap().points, []);
}

#[test]
fn a_map_shows_the_points_of_the_prepared_scene() {
    let scene = scene("rocker/two_masses.json");
    let map = scene
        .map(Axis::linear("rocker.inertia", 0.05, 0.25, 3))
        .up(Axis::linear("shaft.motion.speed", 50.0, 70.0, 2))
        .figure_at("rocker.delta_max")
        .ask()
        .unwrap();
    let parameters = ["rocker.inertia", "shaft.motion.speed"];
    let prepared = scene
        .prepare_points(&parameters, &["rocker.delta_max"])
        .unwrap();
    let prepared = prepared.check_determined(3);
    for (row, &speed) in map.y.iter().enumerate() {
        for (column, &inertia) in map.x.iter().enumerate() {
            let (cell, point) = (&map[(row, column)], prepared.at(&[inertia, speed]).unwrap());
            assert_eq!((cell.value, cell.verdict), (point.value(0), point.verdict));
            assert_eq!(cell.cause, point.cause);
            assert_eq!(cell.determined, point.figures[0].determined);
        }
    }
}

#[test]
fn what_is_not_determined_says_so() {
    // A contact without damping that has opened often.
    let parameters = ["rocker.inertia"];
    let figures = ["rocker.final.displacement", "rocker.delta_max"];
    let undamped = scene("rocker/one_mass_undamped.json").set("run.duration", 2.0);
    let prepared = undamped.prepare_points(&parameters, &figures).unwrap();
    let own = prepared.values().to_vec();
    let point = prepared.at(&own).unwrap();
    assert!(point.figures.iter().all(|one| one.determined.is_none()));
    assert!(
        point.doubts.iter().any(|one| one.contains("no damping")),
        "{point:?}"
    );
    let warnings = undamped.run().unwrap().figures.warnings;
    assert!(
        point.doubts.iter().all(|doubt| warnings.contains(doubt)),
        "{warnings:?}"
    );
    let point = prepared.check_determined(7).at(&own).unwrap();
    let end = point.figures[0];
    assert_eq!(end.determined, Some(false), "{point:?}");
    assert!(end.moved.is_none_or(|moved| moved > 1e-7));
    assert!(
        point.cause.contains("rocker.final.displacement"),
        "{}",
        point.cause
    );
    // One that is damped is determined, and says nothing.
    let damped = scene("rocker/two_masses.json");
    let prepared = damped.prepare_points(&parameters, &figures).unwrap();
    let point = prepared.check_determined(3).at(&[0.05]).unwrap();
    assert!(
        point.figures.iter().all(|one| one.determined == Some(true)),
        "{point:?}"
    );
    assert_eq!(point.doubts, [""; 0]);
}

#[test]
fn levels_are_chosen_once() {
    let open = scene("rocker/two_masses.json").set("rocker.masses", "auto");
    let figures = ["rocker.delta_max"];
    let prepared = open.prepare_points(&ROCKER, &figures).unwrap();
    let level = prepared.levels()["rocker"].to_string();
    assert!(
        prepared.remarks()[0].contains(&format!("rocker {level}")),
        "{:?}",
        prepared.remarks()
    );
    assert!(prepared.at(&[0.05, 1e7]).unwrap().value(0).is_some());
}

#[test]
fn what_is_wrong_is_said_at_once() {
    let scene = scene("rocker/two_masses.json");
    let told = |parameters: &[&str], figures: &[&str]| {
        let error = scene.prepare_points(parameters, figures).unwrap_err();
        error.to_string()
    };
    let wrong = told(
        &[
            "rocker.inertai",
            "rocker.kind",
            "rocker.pair",
            "rocker.mass",
            "rocker.inertia",
        ],
        &["rocker.delta_mx", "rocker.delta_max", "rocker.delta_max"],
    );
    for part in [
        "no number `rocker.inertai`",
        "did you mean `rocker.inertia`?",
        "`rocker.kind` is a text",
        "`rocker.pair` is a group of properties",
        "`rocker.inertia` is named twice",
        "no result `rocker.delta_mx`",
        "did you mean `rocker.delta_max`",
        "the figure `rocker.delta_max` is named twice",
    ] {
        assert!(wrong.contains(part), "{part}: {wrong}");
    }
    let nothing = told(&[], &[]);
    assert!(
        nothing.contains("no parameters") && nothing.contains("no figures"),
        "{nothing}"
    );
    assert!(told(&["dam"], &["rocker.delta_max"]).contains("no number `dam`"));
    assert!(told(&["expect.0.value"], &["rocker.delta_max"]).contains("no number"));

    let prepared = scene
        .prepare_points(&ROCKER, &["rocker.delta_max"])
        .unwrap();
    assert_eq!(
        (prepared.values(), prepared.figure_units()),
        (&[0.1, 1e7][..], &["rad".to_owned()][..])
    );
    assert_eq!(prepared.parameter_units(), ["kg m²", "N m/rad"]);
    let rows = [
        vec![0.1],
        vec![f64::NAN, 1e7],
        vec![0.1, f64::INFINITY],
        vec![0.1, 1e7],
    ];
    let wrong = prepared.table(&rows).unwrap_err().to_string();
    for part in [
        "point 0 has 1 values, and there are 2 parameters",
        "point 1: the value of `rocker.inertia` is NaN",
        "point 2: the value of `rocker.stiffness` is inf",
    ] {
        assert!(wrong.contains(part), "{part}: {wrong}");
    }
    let many = prepared.table(&vec![[0.1]; 1000]).unwrap_err();
    assert_eq!(many.faults().len(), 11);
    let stop = AtomicBool::new(true);
    let ended = prepared.at_within(&[0.1, 1e7], &Control::interrupted_by(&stop));
    assert!(ended.unwrap_err().to_string().contains("interrupted"));
}
