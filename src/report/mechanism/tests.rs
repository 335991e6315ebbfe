//! A slider-crank drawn in three positions.

use super::view::View;
use super::{Arrow, ArrowSet, Axis, Drawing, Path, Placement, guides, names, shape};
use crate::kinematics::linkage::spec::{
    LinkSpec, LinkageSpec, NamedPoint, PairKind, PairSpec, PointOf,
};

fn named(name: &str, at: [f64; 2]) -> NamedPoint {
    NamedPoint {
        name: name.to_owned(),
        at,
    }
}

fn end(link: Option<usize>, at: [f64; 2]) -> PointOf {
    PointOf { link, at }
}

fn pair(name: &str, on: PointOf, link: PointOf, kind: PairKind) -> PairSpec {
    PairSpec {
        name: name.to_owned(),
        on,
        link,
        kind,
        friction: 0.0,
    }
}

pub(super) fn slider_crank() -> LinkageSpec {
    let link = |name: &str, points: Vec<NamedPoint>| LinkSpec {
        name: name.to_owned(),
        points,
        ..LinkSpec::default()
    };
    let pin = PairKind::Revolute { diameter: 0.0 };
    let guide = PairKind::Sliding {
        direction: 0.0,
        angle: 0.0,
        corners: [0.0, 0.0],
        half_height: 0.0,
    };
    LinkageSpec {
        links: vec![
            link("crank", vec![named("A", [0.06, 0.0])]),
            link("rod", vec![named("P", [0.1, 0.05]), named("B", [0.2, 0.0])]),
            link("slider", Vec::new()),
        ],
        ground: vec![named("O", [0.0, 0.0])],
        pairs: vec![
            pair("O", end(None, [0.0; 2]), end(Some(0), [0.0; 2]), pin),
            pair("A", end(Some(0), [0.06, 0.0]), end(Some(1), [0.0; 2]), pin),
            pair("B", end(Some(1), [0.2, 0.0]), end(Some(2), [0.0; 2]), pin),
            pair("C", end(None, [0.0; 2]), end(Some(2), [0.0; 2]), guide),
        ],
        ..LinkageSpec::default()
    }
}

/// Placements at a crank angle.
fn frame(angle: f64) -> Vec<Placement> {
    let turn = [angle.cos(), angle.sin()];
    let a = [0.06 * turn[0], 0.06 * turn[1]];
    let sin = -a[1] / 0.2;
    let cos = (1.0 - sin * sin).sqrt();
    let at = |at: [f64; 2], turn: [f64; 2]| Placement { at, turn };
    vec![
        at([0.0; 2], turn),
        at(a, [cos, sin]),
        at([a[0] + 0.2 * cos, 0.0], [1.0, 0.0]),
    ]
}

fn drawing(spec: &LinkageSpec) -> Drawing<'_> {
    let angles: Vec<f64> = (0..36).map(|k| f64::from(k) * 10.0).collect();
    let frames: Vec<_> = angles.iter().map(|deg| frame(deg.to_radians())).collect();
    let points: Vec<_> = frames.iter().map(|f| f[1].point([0.1, 0.05])).collect();
    let turned = |[x, y]: [f64; 2]| [-y, x];
    let speed = frames.iter().map(|f| turned(f[1].at)).collect();
    let at = frames.iter().map(|f| f[1].at).collect();
    Drawing {
        spec,
        axis: Axis {
            name: "crank angle".into(),
            unit: "deg".into(),
            times: angles.clone(),
            values: angles,
            closed: true,
        },
        frames,
        paths: vec![Path {
            name: "rod.P".into(),
            points,
        }],
        arrows: vec![ArrowSet {
            name: "speed".into(),
            unit: "m/s".into(),
            shown: true,
            arrows: vec![Arrow {
                name: "crank.A".into(),
                at,
                vector: speed,
            }],
        }],
    }
}

/// Numbers of the first attribute of this name in the first tag after a mark.
fn numbers(text: &str, mark: &str, attribute: &str) -> Vec<f64> {
    let after = &text[text.find(mark).unwrap()..];
    let start = after.find(attribute).unwrap() + attribute.len();
    let value = &after[start..start + after[start..].find('"').unwrap()];
    let parts = value.split(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-'));
    parts.filter_map(|part| part.parse().ok()).collect()
}

#[test]
fn pins_lie_where_the_links_are_and_all_is_to_one_scale() {
    let spec = slider_crank();
    let drawing = drawing(&spec);
    for (index, deg) in [(0usize, 0.0f64), (9, 90.0), (20, 200.0)] {
        let picture = drawing.svg(index);
        assert!(!picture.contains("NaN") && !picture.contains("inf"));
        let pin = |name: &str| {
            let end = picture.find(&format!(">{name}</text>")).unwrap();
            let from = picture[..end].rfind("<g class=\"pin\"").unwrap();
            numbers(&picture[from..end], "<g", "translate(")[..].to_vec()
        };
        let placed = frame(deg.to_radians());
        let (o, b) = (numbers_of(pin("O")), numbers_of(pin("B")));
        // Pixels a metre from the greatest distance there is.
        let scale = (b[0] - o[0]).hypot(b[1] - o[1]) / placed[2].at[0];
        let a = numbers_of(pin("A"));
        let expected = [
            o[0] + scale * placed[1].at[0],
            o[1] - scale * placed[1].at[1],
        ];
        assert!((a[0] - expected[0]).abs() < 0.05 && (a[1] - expected[1]).abs() < 0.05);
        // The link's transform puts its frame there too.
        let link = numbers(&picture, "data-link=\"1\"", "matrix(");
        assert!((link[4] - a[0]).abs() < 0.02 && (link[5] - a[1]).abs() < 0.02);
        assert!((link[0] - placed[1].turn[0]).abs() < 1e-5);
        assert!((link[1] + placed[1].turn[1]).abs() < 1e-5);
    }
}

fn numbers_of(list: Vec<f64>) -> [f64; 2] {
    [list[0], list[1]]
}

#[test]
fn what_cannot_be_drawn_is_left_out_and_nothing_is_printed_that_is_no_number() {
    let spec = slider_crank();
    let mut drawing = drawing(&spec);
    drawing.frames[3][1].at = [f64::NAN, 0.0];
    drawing.arrows[0].arrows[0].vector[0] = [f64::INFINITY, 0.0];
    drawing.paths[0].points[5] = [f64::NAN; 2];
    let section = drawing.section("press");
    assert!(!section.contains("NaN") && !section.contains("inf\""));
    assert!(section.contains("id=\"press-data\""));
    drawing.frames.clear();
    assert!(!drawing.svg(0).contains("NaN,"));
}

/// Crank about (0, 0.3), block, slotted link about the origin, and a second link
/// on the crank's pin.
fn slotted() -> (LinkageSpec, Vec<Vec<Placement>>) {
    let link = |name: &str| LinkSpec {
        name: name.to_owned(),
        ..LinkSpec::default()
    };
    let pin = PairKind::Revolute { diameter: 0.0 };
    let guide = PairKind::Sliding {
        direction: 0.0,
        angle: 0.0,
        corners: [0.01, -0.01],
        half_height: 0.0,
    };
    let tip = end(Some(0), [0.1, 0.0]);
    let spec = LinkageSpec {
        links: ["crank", "block", "slot", "rod"].map(link).to_vec(),
        pairs: vec![
            pair("O1", end(None, [0.0, 0.3]), end(Some(0), [0.0; 2]), pin),
            pair("A", tip, end(Some(1), [0.0; 2]), pin),
            pair(
                "slide",
                end(Some(2), [0.0; 2]),
                end(Some(1), [0.0; 2]),
                guide,
            ),
            pair("O2", end(None, [0.0; 2]), end(Some(2), [0.0; 2]), pin),
            pair("B", tip, end(Some(3), [0.0; 2]), pin),
        ],
        ..LinkageSpec::default()
    };
    let frame = |deg: u32| {
        let (sin, cos) = f64::from(deg).to_radians().sin_cos();
        let a = [0.1 * cos, 0.3 + 0.1 * sin];
        let along = a[0].hypot(a[1]);
        let turn = [a[0] / along, a[1] / along];
        let at = |at: [f64; 2], turn: [f64; 2]| Placement { at, turn };
        vec![
            at([0.0, 0.3], [cos, sin]),
            at(a, turn),
            at([0.0; 2], turn),
            at(a, [1.0, 0.0]),
        ]
    };
    (spec, (0..36).map(|k| frame(10 * k)).collect())
}

#[test]
fn a_moving_guide_hangs_on_its_pivot_and_pins_in_one_place_share_a_label() {
    let (spec, frames) = slotted();
    let mut drawing = drawing(&spec);
    drawing.frames = frames;
    drawing.paths.clear();
    drawing.arrows.clear();
    for index in [0, 9, 27] {
        let picture = drawing.svg(index);
        assert!(picture.contains(">A, B</text>") && !picture.contains(">B</text>"));
        let slot = &picture[picture.find("data-link=\"2\"").unwrap()..];
        let slot = &slot[..slot.find("</g></g>").unwrap()];
        assert!(slot.contains("class=\"body\" d=\"M0 0L"), "{slot}");
        // Both ends of the rails are in the picture at every position.
        let size = numbers(&picture, "<svg", "viewBox=\"");
        let [c, _, s, _, x, y] = numbers(slot, "data-link", "matrix(")[..] else {
            panic!("{slot}")
        };
        let rail = &slot[slot.find("class=\"rail\"").unwrap()..];
        let path = numbers(rail, "<path", "d=\"");
        for along in [path[0], path[2]] {
            let end = [x + c * along, y - s * along];
            assert!(0.0 < end[0] && end[0] < size[2], "{end:?} {size:?}");
            assert!(0.0 < end[1] && end[1] < size[3], "{end:?} {size:?}");
        }
    }
}

/// Blocks, rails, and the names of pins stay within the picture in every position.
#[test]
fn nothing_is_cut_on_the_way() {
    let mut spec = slider_crank();
    spec.pairs[2].name = "gudgeon pin of the slider".to_owned();
    let plain = View::of(&drawing(&spec)).width;
    let PairKind::Sliding {
        corners,
        half_height,
        ..
    } = &mut spec.pairs[3].kind
    else {
        panic!("the fourth pair is the guide");
    };
    (*corners, *half_height) = ([0.3, -0.05], 0.2);
    let drawing = drawing(&spec);
    let view = View::of(&drawing);
    let most = [860.0, 560.0].map(|size| size + 1e-9);
    assert!(plain <= most[0] && view.width <= most[0] && view.height <= most[1]);
    let inside = |at: [f64; 2], room: f64| {
        let [x, y] = view.pixel(at);
        let within = x > 0.0 && x + room < view.width && y > 0.0 && y < view.height;
        assert!(
            within,
            "{x} + {room}, {y}: {} x {}",
            view.width, view.height
        );
    };
    let block = shape::block(&spec.pairs[3], view.extent).unwrap();
    for frame in &drawing.frames {
        for corner in block.outline() {
            inside(frame[2].point(corner), 0.0);
        }
    }
    for end in guides::travel(&drawing, 3, view.extent) {
        // The hatches of the ground reach six pixels beyond.
        inside([end, 0.2 + 8.0 / view.scale], 5.0);
        inside([end, -0.2 - 8.0 / view.scale], 5.0);
    }
    let names: Vec<_> = names::named_pins(&drawing).collect();
    assert_eq!(names.len(), 3 * drawing.frames.len());
    for (at, room) in names {
        inside(at, room);
    }
}
