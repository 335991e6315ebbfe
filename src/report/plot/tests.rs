use super::frame::{Entry, rows};
use super::page::hodograph;
use super::*;

fn line(label: &str, count: usize, f: impl Fn(f64) -> f64) -> Series {
    let point = |i: usize| (i as f64 * 1e-3, f(i as f64 * 1e-3));
    Series::line(label, (0..count).map(point).collect())
}

fn marked(points: Vec<(f64, f64)>, shapes: &[Shape]) -> Series {
    let mark = |&shape: &Shape| Mark {
        shape,
        note: "a < b".into(),
    };
    Series {
        marks: shapes.iter().map(mark).collect(),
        ..Series::line("rk4", points)
    }
}

fn log_chart(series: Series) -> Plot {
    let axis = |name: &str, ceiling| Axis {
        log: true,
        ceiling,
        ..Axis::new(name, "")
    };
    Plot {
        title: "work".into(),
        x: axis("time", None),
        y: axis("error", Some(10.0)),
        series: vec![series],
        lane: "failed".into(),
        ..Plot::default()
    }
}

/// The numbers of the path of a curve.
fn path(picture: &str, series: usize) -> String {
    let start = format!("data-series=\"{series}\" d=\"");
    let from = picture.find(&start).unwrap() + start.len();
    picture[from..from + picture[from..].find('"').unwrap()].to_owned()
}

/// Where numbers are exchanged again and again, the script alone draws curves.
#[cfg(feature = "live")]
#[test]
fn curves_of_a_live_chart_are_numbers_alone() {
    let chart = Plot {
        series: vec![line("a", 20_000, f64::sin)],
        ..Plot::default()
    };
    let [mut page, mut live] = [Plots::default(), Plots::live(0)];
    let [drawn, left] =
        [&mut page, &mut live].map(|plots| plots.figure(&chart, [640.0, 320.0], ""));
    assert!(path(&drawn, 0).starts_with('M') && path(&drawn, 0).len() > 1000);
    assert_eq!(path(&left, 0), "");
    assert_eq!(drawn.replace(&path(&drawn, 0), ""), left);
    let (columns, charts) = live.columns_and_charts();
    assert_eq!(
        (columns.len(), columns[1].len(), charts.len()),
        (2, 20_000, 1)
    );
}

#[test]
fn a_single_peak_among_many_samples_is_kept() {
    let mut one = line("a < b", 20_000, |_| 0.0);
    one.points[12_345].1 = 7e-3;
    let chart = Plot {
        title: "δ".into(),
        y: Axis::of("rad"),
        series: vec![one],
        bands: Band::plain(vec![[1.0, 2.0]]),
        ..Plot::default()
    };
    let picture = chart.svg(640.0, 320.0);
    assert!(picture.len() < 50_000, "{}", picture.len());
    assert!(picture.contains(", mrad"));
    assert!(picture.contains("a &lt; b"));
    assert!(picture.contains("class=\"open\""));
    // The peak stands 6 % below the top of the frame.
    let (frame, _) = chart.layout(640.0, 320.0);
    let y = coordinate(frame.top + frame.height * 0.06 / 1.12);
    assert!(path(&picture, 0).contains(&format!(" {y}L")), "{y}");
}

#[test]
fn odd_data_make_a_picture_too() {
    let mut gap = line("", 100, f64::sin);
    gap.points[50].1 = f64::NAN;
    for series in [vec![], vec![line("", 1, |_| 3.0)], vec![gap]] {
        for plane in [false, true] {
            let chart = Plot {
                series: series.clone(),
                plane,
                start: true,
                ..Plot::default()
            };
            let picture = chart.svg(300.0, 200.0);
            assert!(
                !picture.contains("NaN") && !picture.contains("inf"),
                "{picture}"
            );
        }
    }
    let odd = [
        (vec![], vec![]),
        (vec![(0.0, 0.0)], vec![Shape::Open]),
        (vec![(f64::NAN, f64::INFINITY)], vec![Shape::AtMost]),
    ];
    for (points, shapes) in odd {
        let picture = log_chart(marked(points, &shapes)).svg(300.0, 200.0);
        assert!(
            !picture.contains("NaN") && !picture.contains("inf"),
            "{picture}"
        );
    }
}

#[test]
fn failures_are_no_part_of_the_curve() {
    let points = vec![(0.1, 1e9), (0.2, f64::NAN), (1.0, 1e-3)];
    let picture = log_chart(marked(points, &[Shape::Cross, Shape::Cross, Shape::Good]));
    let picture = picture.svg(640.0, 400.0);
    assert_eq!(picture.matches("l8 8m0-8l-8 8").count(), 2);
    assert!(picture.contains("class=\"lane\"") && picture.contains("a &lt; b"));
    assert!(
        !path(&picture, 0).contains('L'),
        "one good point makes no line"
    );
    let good = log_chart(marked(vec![(1.0, 1e-3)], &[Shape::Good]));
    assert!(!good.svg(640.0, 400.0).contains("class=\"lane\""));
}

#[test]
fn steps_hold_their_value_up_to_the_next_point() {
    let series = Series {
        look: LineStyle::Steps,
        ..Series::line("", vec![(0.0, 0.0), (1.0, 1.0)])
    };
    let chart = Plot {
        series: vec![series],
        ..Plot::default()
    };
    let path = path(&chart.svg(300.0, 200.0), 0);
    let (across, up) = (path.find('H').unwrap(), path.find('V').unwrap());
    assert!(across < up && !path.contains('L'), "{path}");
}

#[test]
fn colours_are_variables_on_pages_and_colours_for_light_and_dark_alone() {
    let twelve = (0..12).map(|k| line(&format!("run {k}"), 10, |t| t * f64::from(k)));
    let chart = Plot {
        series: twelve.collect(),
        ..Plot::default()
    };
    let alone = chart.svg(640.0, 400.0);
    assert!(!alone.contains("var("));
    assert!(alone.contains("@media screen and (prefers-color-scheme:dark)"));
    for (light, dark, dash) in palette::SERIES {
        assert!(alone.contains(light) && alone.contains(dark));
        assert!(alone.contains(&format!("stroke-dasharray=\"{dash}\"")) || dash.is_empty());
    }
    let looks: std::collections::BTreeSet<_> = palette::SERIES.iter().collect();
    assert_eq!(looks.len(), 12);
    let mut plots = Plots::default();
    let figure = plots.figure(&chart, [640.0, 400.0], "");
    assert!(!figure.contains("<style") && !figure.contains("#1d5a9e"));
    for k in 0..12 {
        assert!(figure.contains(&format!("class=\"curve s{k}\"")));
        assert!(palette::STYLE.contains(&format!(".s{k}{{stroke:var(--series-{k})}}")));
        assert!(
            palette::of_page()
                .matches(&format!("--series-{k}:"))
                .count()
                == 2
        );
    }
    let style = palette::standing_alone(".a{fill:var(--ink, #123456);stroke:#fff}.b{fill:none}");
    assert!(
        style.starts_with(".a{fill:#17202a;stroke:#fff}.b{fill:none}@media"),
        "{style}"
    );
    assert!(style.ends_with("{.a{fill:#e6eaee;stroke:#fff}}"), "{style}");
}

#[test]
fn the_values_of_a_series_survive_the_trip() {
    let mut series = line("δ", 50, |t| (40.0 * t).sin() * 1.234_567_890_123e-3);
    series.points[7].1 = f64::NAN;
    let mut plots = Plots::default();
    let chart = Plot {
        id: "rocker.delta".into(),
        series: vec![series.clone(), line("</script>", 50, f64::cos)],
        ..Plot::default()
    };
    plots.figure(&chart, [579.0, 200.0], "rocker");
    plots.figure(&chart, [579.0, 200.0], "rocker");
    let text = plots.json();
    assert!(!text.contains('<'));
    let page: serde_json::Value = serde_json::from_str(&text).unwrap();
    // Times once, both quantities once, however often they are shown.
    assert_eq!(page["columns"].as_array().unwrap().len(), 3);
    let told = &page["plots"][1]["series"][0];
    let column = |name: &str| &page["columns"][told[name].as_u64().unwrap() as usize];
    for (k, &(x, y)) in series.points.iter().enumerate() {
        approx::assert_relative_eq!(column("x")[k].as_f64().unwrap(), x, max_relative = 1e-11);
        match y.is_nan() {
            true => assert!(column("y")[k].is_null()),
            false => approx::assert_relative_eq!(
                column("y")[k].as_f64().unwrap(),
                y,
                max_relative = 1e-8
            ),
        }
    }
    assert_eq!(page["plots"][1]["series"][1]["label"], "</script>");
}

#[test]
fn names_in_the_legend_never_overlap_nor_leave_it() {
    for width in [260.0, 579.0, 1184.0] {
        let lengths = [3, 40, 7, 90, 200, 1, 12, 33, 5, 5, 5, 60];
        let entry = |&length: &usize| Entry::new(String::new(), "m".repeat(length));
        let (text, height) = rows(lengths.iter().map(entry).collect(), [66.0, width], 36.0);
        let mut boxes: Vec<[f64; 3]> = Vec::new();
        for piece in text.split("data-room=\"").skip(1) {
            let room: f64 = piece.split('"').next().unwrap().parse().unwrap();
            let place = piece.split("translate(").nth(1).unwrap();
            let place = place.split(')').next().unwrap().split_once(' ').unwrap();
            let (x, y): (f64, f64) = (place.0.parse().unwrap(), place.1.parse().unwrap());
            assert!(x >= 66.0 && x + room - 12.0 <= width.max(66.0 + room - 12.0) + 1e-9);
            assert!(x + 33.0 + 6.0 * 3.0 <= width, "{x} of {width}");
            assert!(y < 36.0 + height);
            for [left, end, row] in &boxes {
                assert!(*row != y || *end <= x + 0.01 || x + room <= *left + 0.01);
            }
            boxes.push([x, x + room, y]);
        }
        assert_eq!(boxes.len(), lengths.len());
    }
}

#[test]
fn labels_of_rings_keep_off_the_curve() {
    // A curve that goes up: labels along the vertical would stand on it.
    let up = (0..200).map(|k| (0.0, f64::from(k) * 10.0));
    let plot = hodograph("Force in <A>", "N", up.collect());
    let frame = plot.frame([20.0, 28.0, 320.0, 300.0]);
    let angle = plot.free_direction(&frame).to_radians();
    assert!(angle.cos().abs() > 0.2, "{angle}");
    let picture = plot.svg(360.0, 370.0);
    assert!(picture.contains("Force in &lt;A&gt;") && picture.contains(", kN"));
    assert!(picture.contains("class=\"first\""));
}

#[test]
fn planes_have_one_scale() {
    let plot = hodograph("", "N", vec![(3.0, 0.0), (0.0, -2.0)]);
    for size in [[320.0, 300.0], [900.0, 300.0]] {
        let frame = plot.frame([20.0, 28.0, size[0], size[1]]);
        approx::assert_relative_eq!(
            frame.x(1.0) - frame.x(0.0),
            frame.y(0.0) - frame.y(1.0),
            max_relative = 1e-12
        );
    }
}

fn field() -> Field {
    let cells = 36;
    Field {
        x: (0..=6).map(f64::from).collect(),
        y: (0..=6).map(f64::from).collect(),
        fill: (0..cells)
            .map(|k| Some(if k % 2 == 0 { "#4a86bf" } else { "#ddaa33" }))
            .collect(),
        kind: (0..cells).map(|k| Some(usize::from(k > 17))).collect(),
        kinds: vec![
            Kind {
                name: "good".into(),
                colour: "#2f8f5b",
                hatching: "",
            },
            Kind {
                name: "fails".into(),
                colour: "#b3124f",
                hatching: "dam-failed",
            },
        ],
        lines: (1..6)
            .map(|level| Contour {
                label: "12.5 mrad".into(),
                parts: vec![
                    (0..=12)
                        .map(|k| (f64::from(k) / 2.0, f64::from(level)))
                        .collect(),
                ],
                edge: false,
            })
            .collect(),
        rings: vec![14, 15, 20],
        middles: [
            (0..6).map(|k| f64::from(k) + 0.5).collect(),
            (0..6).map(|k| f64::from(k) + 0.5).collect(),
        ],
        borders: true,
        named: true,
        ..Field::default()
    }
}

#[test]
fn neighbouring_cells_of_one_kind_are_one_path_and_regions_have_borders() {
    let plot = Plot {
        field: Some(field()),
        ..Plot::default()
    };
    let picture = plot.svg(500.0, 420.0);
    assert!(picture.contains("url(#dam-failed)") && picture.contains(">fails<"));
    let border = picture.split("class=\"border\" d=\"").nth(1).unwrap();
    let border = border.split('"').next().unwrap();
    // One line from side to side: the rows above differ from those below.
    assert_eq!(border.matches('M').count(), 6);
    assert!(!picture.contains("NaN"));
}

#[test]
fn labels_of_contour_lines_keep_off_rings_and_each_other() {
    let plot = Plot {
        field: Some(field()),
        ..Plot::default()
    };
    let frame = plot.frame([60.0, 30.0, 400.0, 330.0]);
    let (_, over) = plot.field.as_ref().unwrap().draw(&frame);
    let mut boxes: Vec<[f64; 4]> = Vec::new();
    for piece in over.split('<').filter(|piece| piece.contains("translate(")) {
        let place = piece
            .split("translate(")
            .nth(1)
            .unwrap()
            .split(')')
            .next()
            .unwrap();
        let (x, y) = place.split_once(' ').unwrap();
        let (x, y): (f64, f64) = (x.parse().unwrap(), y.parse().unwrap());
        let half = match piece.starts_with("text") {
            // At the ten pixels of such labels.
            true => [0.42 * width_of("12.5 mrad"), 6.0],
            false => [4.5, 4.5],
        };
        let own = [x - half[0], x + half[0], y - half[1], y + half[1]];
        for other in &boxes {
            let apart = own[0] >= other[1]
                || other[0] >= own[1]
                || own[2] >= other[3]
                || other[2] >= own[3];
            assert!(apart, "{own:?} on {other:?}");
        }
        boxes.push(own);
    }
    assert!(boxes.len() >= 6, "{over}");
}
