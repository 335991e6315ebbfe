//! The slotted link against published figures, as a general linkage and as a
//! position function (tests/reference/README.md).

use dam::linkage::spec::{
    AssemblyChoice, AssemblySpec, LinkSpec, LinkageSpec, PairKind, PairSpec, PointOf,
};
use dam::linkage::{Cause, GroupKind, Linkage, Reach};
use dam::position::{Position, PositionSpec, SlottedDriver, SlottedLinkSpec, SlottedOutput};
use serde_json::Value;
use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

fn reference() -> Value {
    let text = include_str!("../reference/slide-crank.json");
    serde_json::from_str(text).expect("the reference file")
}

fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap_or_else(|| panic!("no {key}"))
}

/// One case of the file.
struct Case<'a>(&'a Value);

impl Case<'_> {
    fn data(&self, key: &str) -> f64 {
        number(&self.0["data"], key)
    }

    fn law(&self, key: &str) -> f64 {
        number(&self.0["law"], key)
    }

    fn by_block(&self) -> bool {
        self.0["law"]["of"] == "slide"
    }

    /// Displacement, speed and acceleration of the driver.
    fn driver(&self, t: f64) -> [f64; 3] {
        let [x, v, a] = ["x0", "v0", "a0"].map(|key| self.law(key));
        [x + v * t + 0.5 * a * t * t, v + a * t, a]
    }

    /// Crank 0 about O1, block 1 on its end, slotted link 2 about O2.
    fn linkage(&self) -> Linkage {
        let (o1, o2) = (
            [self.data("xO1"), self.data("yO1")],
            [self.data("xO2"), self.data("yO2")],
        );
        let at = |link, at| PointOf { link, at };
        let pin = |name: &str, on, link| PairSpec {
            name: name.to_owned(),
            on,
            link,
            kind: PairKind::Revolute { diameter: 0.0 },
            friction: 0.0,
        };
        let slot = PairSpec {
            name: "slot".to_owned(),
            on: at(Some(2), [0.0; 2]),
            link: at(Some(1), [0.0; 2]),
            kind: PairKind::Sliding {
                direction: 0.0,
                angle: 0.0,
                corners: [0.01, -0.01],
                half_height: 0.0,
            },
            friction: 0.0,
        };
        let pairs = vec![
            pin("O1", at(None, o1), at(Some(0), [0.0; 2])),
            pin(
                "A",
                at(Some(0), [self.data("l"), 0.0]),
                at(Some(1), [0.0; 2]),
            ),
            slot,
            pin("O2", at(None, o2), at(Some(2), [0.0; 2])),
        ];
        let near = match self.0["branch"].as_f64() {
            Some(branch) if branch < 0.0 => PI,
            _ => 0.0,
        };
        let choice = AssemblyChoice::Angle(near);
        let links = ["crank", "block", "slot"].map(|name| LinkSpec {
            name: name.to_owned(),
            ..LinkSpec::default()
        });
        Linkage::new(LinkageSpec {
            links: links.to_vec(),
            pairs,
            driver: if self.by_block() { 2 } else { 0 },
            start: self.driver(0.0)[0],
            assembly: if self.by_block() {
                vec![AssemblySpec { link: 0, choice }]
            } else {
                Vec::new()
            },
            ..LinkageSpec::default()
        })
        .expect("a linkage")
    }

    /// All quantities of the file at a time, from transfer functions alone.
    fn quantities(&self, linkage: &Linkage, t: f64) -> BTreeMap<&'static str, f64> {
        let [x, v, acceleration] = self.driver(t);
        let mut workspace = linkage.workspace();
        linkage.solve(x, 3, &mut workspace).expect("within reach");
        let motion = |jet: dam::jet::Jet| {
            let second = jet.second * v * v + jet.first * acceleration;
            [jet.value, jet.first * v, second]
        };
        let [phi1, omega1, eps1] = motion(workspace.turning(0));
        let [phi2, omega2, eps2] = motion(workspace.turning(2));
        let [s, vr, ar] = motion(workspace.pair(2));
        let block = workspace.point(PointOf {
            link: Some(1),
            at: [0.0; 2],
        });
        let [[_, vx, ax], [_, vy, ay]] = block.map(motion);
        let (sin, cos) = phi1.sin_cos();
        BTreeMap::from([
            ("phi1", phi1),
            ("omega1", omega1),
            ("eps1", eps1),
            ("S", s),
            ("phi2", phi2),
            ("Vr", vr),
            ("omega2", omega2),
            ("ar", ar),
            ("eps2", eps2),
            ("Ve", s * omega2),
            ("V", vx.hypot(vy)),
            ("ae_n", s * omega2 * omega2),
            ("ae_t", s * eps2),
            ("acor", 2.0 * omega2 * vr),
            ("a_n", -(ax * cos + ay * sin)),
            ("a_t", ay * cos - ax * sin),
            ("a", ax.hypot(ay)),
        ])
    }
}

#[test]
fn every_quantity_of_every_case_is_as_published() {
    let reference = reference();
    let cases = reference["cases"].as_array().expect("cases");
    assert_eq!(cases.len(), 8);
    for case in cases {
        let id = case["id"].as_str().unwrap_or_default();
        let rows = case["results"].as_array().expect("rows");
        let case = Case(case);
        let linkage = case.linkage();
        let o = ["xO1", "xO2", "yO1", "yO2"].map(|key| case.data(key));
        let alpha = (o[0] - o[1]).atan2(o[2] - o[3]);
        for row in rows {
            let found = case.quantities(&linkage, number(row, "t"));
            let near_dead = case.by_block() && (found["phi1"] + alpha).cos().abs() < 0.05;
            let bound = if near_dead { 1e-9 } else { 1e-11 };
            for (&name, &value) in &found {
                let wanted = number(row, name);
                let largest = |column: &str| {
                    let values = rows.iter().map(|row| number(row, column).abs());
                    values.fold(0.0, f64::max)
                };
                // Parts of the acceleration that are zero throughout: of the whole.
                let scale = match largest(name) {
                    0.0 => largest("a"),
                    scale => scale,
                };
                let mut off = value - wanted;
                if name.starts_with("phi") {
                    off -= TAU * (off / TAU).round();
                }
                assert!(
                    off.abs() <= bound * scale,
                    "{id}, t = {}: {name} = {value}, published {wanted}",
                    number(row, "t")
                );
            }
        }
    }
}

#[test]
fn the_block_comes_to_its_dead_positions_at_the_published_times() {
    let reference = reference();
    for (id, what) in [
        ("paper-3a", "paper-3a reaches"),
        ("paper-3b", "paper-3b reaches"),
    ] {
        let cases = reference["cases"].as_array().expect("cases");
        let case = Case(
            cases
                .iter()
                .find(|case| case["id"] == id)
                .expect("the case"),
        );
        let linkage = case.linkage();
        let Reach::Interval { lower, upper } = &linkage.range().reach else {
            panic!("{id}: {:?}", linkage.range());
        };
        assert!(
            (lower.at - 0.2).abs() < 1e-15 && (upper.at - 0.4).abs() < 1e-15,
            "{upper:?}"
        );
        for end in [lower, upper] {
            let Cause::DeadPosition { group } = end.cause else {
                panic!("{id}: {end:?}");
            };
            assert_eq!(linkage.structure().groups[group].kind, GroupKind::Rrr);
        }
        let specials = reference["special"].as_array().expect("special");
        let text = |special: &&Value| special["text"].as_str().is_some_and(|t| t.contains(what));
        let wanted = number(specials.iter().find(text).expect("the time"), "value");
        let [x, v, a] = ["x0", "v0", "a0"].map(|key| case.law(key));
        let way = upper.at - x;
        let time = 2.0 * way / (v + (v * v + 2.0 * a * way).sqrt());
        assert!(
            (time - wanted).abs() < 1e-12 * wanted,
            "{id}: {time}, {wanted}"
        );
        let mut workspace = linkage.workspace();
        let outside = linkage.solve(0.41, 1, &mut workspace).expect_err("outside");
        assert_eq!(outside.end, *upper);
        for beyond in [upper.at, f64::NAN, f64::INFINITY, -1e300] {
            assert!(linkage.solve(beyond, 1, &mut workspace).is_err());
        }
    }
}

#[test]
fn a_crank_as_long_as_the_frame_turns_the_link_half_as_fast_through_its_pivot() {
    let case = serde_json::json!({
        "data": { "xO1": 0.0, "yO1": 0.1, "xO2": 0.0, "yO2": 0.0, "l": 0.1 },
        "law": { "of": "crank", "x0": 0.3, "v0": 1.0, "a0": 0.0 },
    });
    let linkage = Case(&case).linkage();
    let range = linkage.range();
    // The link has turned once after two turns of the crank.
    assert_eq!(range.period.map(|period| period.turns), Some(2));
    assert_eq!(range.changes.len(), 2);
    for (change, turn) in range.changes.iter().zip([0.75, 1.75]) {
        assert!((change.at - turn * TAU).abs() < 1e-12);
    }
    let mut workspace = linkage.workspace();
    for phi in [
        -2.0,
        -PI / 2.0,
        -1.5706,
        -1.5,
        0.3,
        4.711,
        4.712389,
        11.0,
        400.0,
    ] {
        linkage.solve(phi, 3, &mut workspace).expect("everywhere");
        let slot = workspace.turning(2);
        assert!((slot.first - 0.5).abs() < 1e-10, "{phi}: {slot:?}");
        assert!(
            slot.second.abs() < 1e-7 && slot.third.abs() < 1e-4,
            "{phi}: {slot:?}"
        );
        assert!(
            (slot.value - (0.5 * phi + PI / 4.0)).abs() < 1e-12 * (1.0 + phi.abs()),
            "{phi}"
        );
    }
}

#[test]
fn the_position_function_is_the_same_mechanism() {
    let reference = reference();
    for case in reference["cases"].as_array().expect("cases") {
        let id = case["id"].as_str().unwrap_or_default();
        let case = Case(case);
        let (dx, dy) = (
            case.data("xO1") - case.data("xO2"),
            case.data("yO1") - case.data("yO2"),
        );
        // Its angles are measured from the line of the pivots.
        let line = dy.atan2(dx);
        let spec = SlottedLinkSpec {
            crank: case.data("l"),
            frame: dx.hypot(dy),
            driver: if case.by_block() {
                SlottedDriver::Block
            } else {
                SlottedDriver::Crank
            },
            output: SlottedOutput::Link,
            branch: case.0["branch"].as_f64().unwrap_or(1.0),
            phase: if case.by_block() { 0.0 } else { -line },
        };
        let position = Position::new(&PositionSpec::SlottedLink(spec)).expect("a position");
        let linkage = case.linkage();
        let mut workspace = linkage.workspace();
        for row in case.0["results"].as_array().expect("rows") {
            let [x, ..] = case.driver(number(row, "t"));
            linkage.solve(x, 3, &mut workspace).expect("within reach");
            let (general, short) = (workspace.turning(2), position.jet(0, x));
            let off = general.value - short.value - line;
            assert!(
                (off - TAU * (off / TAU).round()).abs() < 1e-12,
                "{id} at {x}"
            );
            for (a, b) in [
                (general.first, short.first),
                (general.second, short.second),
                (general.third, short.third),
            ] {
                let size = short.first.abs() + short.second.abs() + short.third.abs();
                assert!((a - b).abs() <= 1e-9 * size, "{id} at {x}: {a}, {b}");
            }
        }
    }
}
