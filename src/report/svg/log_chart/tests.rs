use super::{LogChart, LogPoint, Mark, Series};

fn point(x: f64, y: Option<f64>, mark: Mark) -> LogPoint {
    LogPoint {
        x,
        y,
        mark,
        note: "a < b".into(),
    }
}

fn chart(points: Vec<LogPoint>) -> LogChart {
    LogChart {
        title: "work".into(),
        ceiling: Some(10.0),
        lane: "failed".into(),
        series: vec![Series {
            label: "rk4".into(),
            points,
            ..Series::default()
        }],
        ..LogChart::default()
    }
}

#[test]
fn a_decade_takes_the_same_room_everywhere() {
    let picture = chart(vec![
        point(1e-3, Some(1e-2), Mark::Good),
        point(1e-2, Some(1e-4), Mark::Good),
        point(1e-1, Some(1e-6), Mark::Good),
    ])
    .svg(640.0, 400.0);
    let mut curve = picture
        .lines()
        .filter(|line| line.contains("class=\"curve\""));
    let curve = curve.next_back().unwrap();
    let from = curve.find("d=\"M").unwrap() + 4;
    let to = from + curve[from..].find('"').unwrap();
    let numbers: Vec<f64> = curve[from..to]
        .split(['L', ' '])
        .map(|number| number.parse().unwrap())
        .collect();
    assert_eq!(numbers.len(), 6);
    approx::assert_abs_diff_eq!(
        numbers[2] - numbers[0],
        numbers[4] - numbers[2],
        epsilon = 0.02
    );
    approx::assert_abs_diff_eq!(
        numbers[3] - numbers[1],
        numbers[5] - numbers[3],
        epsilon = 0.02
    );
}

#[test]
fn failures_are_no_part_of_the_curve() {
    let good = point(1.0, Some(1e-3), Mark::Good);
    let picture = chart(vec![
        point(0.1, Some(1e9), Mark::Cross),
        point(0.2, None, Mark::Cross),
        good.clone(),
    ])
    .svg(640.0, 400.0);
    assert_eq!(picture.matches("l8 8m0-8l-8 8").count(), 2);
    assert!(picture.contains("class=\"lane\"") && picture.contains("a &lt; b"));
    let curve = picture
        .lines()
        .rfind(|line| line.contains("class=\"curve\""));
    assert!(
        !curve.unwrap().contains('L'),
        "one good point makes no line"
    );
    assert!(
        !chart(vec![good])
            .svg(640.0, 400.0)
            .contains("class=\"lane\"")
    );
}

#[test]
fn odd_data_make_a_picture_too() {
    for points in [
        vec![],
        vec![point(0.0, Some(0.0), Mark::Open)],
        vec![point(f64::NAN, Some(f64::INFINITY), Mark::AtMost)],
    ] {
        for linear_x in [false, true] {
            let chart = LogChart {
                linear_x,
                ..chart(points.clone())
            };
            let picture = chart.svg(300.0, 200.0);
            assert!(
                !picture.contains("NaN") && !picture.contains("inf"),
                "{picture}"
            );
        }
    }
}
