//! The table against the linkage itself.

use super::Table;
use crate::dynamics::integrate::{Dynamics, Modes};
use crate::dynamics::laws::LawInstance;
use crate::dynamics::model::{Closure, LinkageBody, LoadLaw, Model};
use crate::dynamics::system::System;
use crate::dynamics::system::testing::{Body, add_body, add_load, add_rotor, pair};
use crate::kinematics::linkage::Linkage;
use crate::kinematics::linkage::spec::*;
use crate::kinematics::position::{LinkageOutput, Position};
use std::cell::Cell;
use std::sync::Arc;

fn pin(name: &str, on: (Option<usize>, [f64; 2]), link: (Option<usize>, [f64; 2])) -> PairSpec {
    let point = |(link, at)| PointOf { link, at };
    PairSpec {
        name: name.to_owned(),
        on: point(on),
        link: point(link),
        kind: PairKind::Revolute { diameter: 0.0 },
        friction: 0.0,
    }
}

/// A four-bar with weights, a damper, and a spring in the rocker's pivot.
fn four_bar(crank: f64) -> LinkageSpec {
    let bar = |name: &str, length: f64| LinkSpec {
        name: name.to_owned(),
        points: Vec::new(),
        mass: 2.0 * length,
        centre: [0.5 * length, 0.01],
        moment: length.powi(3) / 6.0,
    };
    let torsion = |pair, rate, damping| ForceSpec {
        name: "force".to_owned(),
        law: ForceLaw::Torsion {
            pair,
            rate,
            free_angle: 0.3,
            damping,
        },
    };
    LinkageSpec {
        links: vec![bar("crank", crank), bar("coupler", 0.4), bar("rocker", 0.3)],
        pairs: vec![
            pin("A", (None, [0.0; 2]), (Some(0), [0.0; 2])),
            pin("B", (Some(0), [crank, 0.0]), (Some(1), [0.0; 2])),
            pin("C", (Some(1), [0.4, 0.0]), (Some(2), [0.3, 0.0])),
            pin("D", (None, [0.35, 0.0]), (Some(2), [0.0; 2])),
        ],
        gravity: [1.0, -9.81],
        forces: vec![torsion(3, 5.0, 0.2), torsion(2, 0.0, 0.1)],
        start: 1.0,
        ..LinkageSpec::default()
    }
}

/// The angle of the crank, which gains a turn in a turn, that of the rocker, and
/// the height of a point of the coupler.
fn outputs() -> Vec<OutputSpec> {
    let output = |name: &str, kind| OutputSpec {
        name: name.to_owned(),
        kind,
    };
    let point = PointOf {
        link: Some(1),
        at: [0.2, 0.1],
    };
    vec![
        output("crank", OutputKind::Angle { link: 0 }),
        output("rocker", OutputKind::Angle { link: 2 }),
        output(
            "height",
            OutputKind::Point {
                point,
                direction: 1.5,
            },
        ),
    ]
}

/// Compares the table with the linkage; the greatest difference of J, J′, J″,
/// W, W′, D, D′ in units of the greatest value, and the share of places that
/// the table knows.
fn compared(linkage: &Linkage, from: f64, to: f64) -> ([f64; 7], f64) {
    let table = Table::new(linkage, &[]).expect("a table");
    let mut workspace = linkage.workspace();
    let cursor = Cell::default();
    let (mut miss, mut size, mut known) = ([0.0f64; 7], [0.0f64; 7], 0);
    let count = 5000;
    for step in 0..count {
        let q = from + (to - from) * (f64::from(step) + 0.5) / f64::from(count);
        linkage.solve(q, 3, &mut workspace).expect("within reach");
        let reduced = linkage.reduced_linkage(&workspace);
        let [j0, j1, j2] = reduced.inertia;
        let [w0, w1] = [0, 1].map(|k| reduced.force[k] - reduced.potential[k + 1]);
        let [d0, d1] = reduced.damping;
        let Some(place) = table.place_of_input(q, &cursor) else {
            continue;
        };
        known += 1;
        let ([i0, i1, f0, c0], [_, i2, f1, c1]) = (table.values(place), table.slopes(place));
        let found = [i0, i1, i2, f0, f1, c0, c1];
        for (k, wanted) in [j0, j1, j2, w0, w1, d0, d1].into_iter().enumerate() {
            miss[k] = miss[k].max((found[k] - wanted).abs());
            size[k] = size[k].max(wanted.abs());
        }
    }
    (
        std::array::from_fn(|k| miss[k] / size[k]),
        f64::from(known) / f64::from(count),
    )
}

#[test]
fn a_crank_that_turns_fully_is_known_everywhere_to_rounding() {
    let linkage = Linkage::new(four_bar(0.1)).expect("a linkage");
    // Three turns on, the configuration is the same.
    for shift in [0.0, 6.0 * std::f64::consts::PI] {
        let (miss, known) = compared(&linkage, shift, shift + 6.25);
        assert_eq!(known, 1.0);
        for (miss, bound) in miss
            .into_iter()
            .zip([1e-13, 1e-11, 1e-8, 1e-13, 1e-11, 1e-13, 1e-11])
        {
            assert!(miss < bound, "{miss:e} against {bound:e}");
        }
    }
}

#[test]
fn outputs_are_known_with_three_derivatives_on_every_turn() {
    let spec = LinkageSpec {
        outputs: outputs(),
        ..four_bar(0.1)
    };
    let linkage = Linkage::new(spec).expect("a linkage");
    // In another order, and one of them not at all.
    let table = Table::new(&linkage, &[2, 0]).expect("a table");
    assert!(table.knows(0) && !table.knows(1) && table.knows(2) && !table.knows(3));
    let (mut workspace, cursor) = (linkage.workspace(), Cell::default());
    for step in 0..3000 {
        let q = -20.0 + 0.0137 * f64::from(step);
        let place = table.place_of_input(q, &cursor).expect("known everywhere");
        assert!(table.output(1, place).is_none() && table.output(3, place).is_none());
        linkage.solve(q, 3, &mut workspace).expect("within reach");
        for output in [0, 2] {
            let found = table.output(output, place).expect("asked for");
            let wanted = linkage.output(output, &workspace);
            for (found, wanted, bound) in [
                (found.value, wanted.value, 1e-14),
                (found.first, wanted.first, 1e-13),
                (found.second, wanted.second, 1e-11),
                (found.third, wanted.third, 1e-8),
            ] {
                let miss = (found - wanted).abs();
                assert!(miss <= bound * (1.0 + q.abs()), "{output} at {q}: {miss:e}");
            }
        }
    }
}

#[test]
fn near_dead_positions_the_linkage_is_solved_itself() {
    let linkage = Linkage::new(four_bar(0.3)).expect("a linkage");
    let [from, to] = linkage.range().ends();
    let span = to - from;
    let (miss, known) = compared(&linkage, from + 0.02 * span, to - 0.02 * span);
    assert!(known > 0.95 && miss[0] < 1e-12, "{known} {miss:?}");
    let table = Table::new(&linkage, &[]).expect("a table");
    let middle = Cell::default();
    assert!(table.place_of_input(0.5 * (from + to), &middle).is_some());
    for cursor in [Cell::default(), middle] {
        for place in [from + 1e-9, to + 0.1, f64::NAN, f64::INFINITY] {
            assert!(table.place_of_input(place, &cursor).is_none(), "{place}");
        }
    }
}

#[test]
fn springs_that_wind_up_and_tables_over_the_input_have_none() {
    let mut wound = four_bar(0.1);
    let ForceLaw::Torsion { pair, .. } = &mut wound.forces[0].law else {
        panic!("a spring");
    };
    *pair = 0;
    assert!(Table::new(&Linkage::new(wound).expect("a linkage"), &[]).is_none());
}

/// A motor with a gear on it and the four-bar on the gear, its crank going
/// −0.91·φ + 0.04; a load and a wheel on the rocker, if they are wanted.
fn geared(loaded: bool) -> System {
    let mut model = Model::default();
    let gear = |ratio: f64, offset: f64, inertia: f64| Body {
        position: Position::Ratio { ratio, offset },
        inertias: vec![inertia],
        stiffnesses: vec![],
        dampings: vec![],
        pair: pair(Closure::Bilateral),
    };
    let motor = LawInstance::linear_motor(3.0, 20.0).law();
    let rotor = add_rotor(&mut model, 0.02, 0.3, 1.1);
    add_load(&mut model, rotor, 0, "torque", motor);
    let wheel = add_body(&mut model, rotor, &gear(0.7, 0.2, 0.03));
    add_load(&mut model, wheel, 0, "bearing", LoadLaw::viscous(0.1));
    let crank = add_body(&mut model, wheel, &gear(-1.3, 0.3, 0.0));
    let spec = LinkageSpec {
        outputs: outputs(),
        ..four_bar(0.1)
    };
    let linkage = Arc::new(Linkage::new(spec).expect("a linkage"));
    let outputs = (0..3).map(|output| {
        let body = Body {
            position: Position::Linkage(LinkageOutput::new(&linkage, output)),
            ..gear(0.0, 0.0, 0.0)
        };
        add_body(&mut model, crank, &body)
    });
    let outputs: Vec<usize> = outputs.collect();
    if loaded {
        let spring = LoadLaw::spring(2.0, 0.5);
        add_load(&mut model, outputs[1], 0, "spring", spring);
        add_body(&mut model, outputs[1], &gear(2.0, 0.1, 0.02));
    }
    model.linkages.push(LinkageBody {
        node: model.objects[crank].nodes[0],
        outputs: outputs
            .iter()
            .map(|&part| model.objects[part].nodes[0])
            .collect(),
        linkage,
        friction: None,
        object: crank,
    });
    System::new(model).expect("a system")
}

#[test]
fn a_linkage_on_gears_moves_as_in_the_passes_whichever_piece_was_last() {
    let alone = geared(false);
    assert_eq!(alone.frozen.trains.len(), 1);
    moves_as_in_the_passes(&alone);
    let loaded = geared(true);
    assert!(loaded.frozen.trains.is_empty());
    let table = loaded.frozen.linkages[0].table.as_ref().expect("a table");
    assert!(table.knows(1) && !table.knows(0));
    moves_as_in_the_passes(&loaded);
}

fn moves_as_in_the_passes(system: &System) {
    let modes = Modes::default();
    let (mut scratch, mut whole) = (system.scratch(), system.scratch());
    for step in 0..2000 {
        // Near and far, to and fro.
        let position = match step % 5 {
            0 => -40.0 + 0.037 * f64::from(step),
            _ => 0.011 * f64::from(step % 400),
        };
        let y = [position, 3.0 - 0.01 * f64::from(step % 700)];
        let mut dy = [0.0; 2];
        system.derivatives(0.0, &y, &modes, &mut scratch, &mut dy);
        system.evaluate_fully(0.0, &y, &modes, &mut whole);
        let expected = whole.accelerations[0];
        let miss = (dy[1] - expected).abs();
        assert!(miss < 1e-11 * (1.0 + expected.abs()), "{miss:e} at {y:?}");
    }
}
