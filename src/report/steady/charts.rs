//! Diagrams of a steady motion.

use super::SteadyReport;
use crate::dynamics::steady::Row;
use crate::report::plot::{Axis, LineStyle, Plot, Series};

fn curve(label: &str, rows: &[Row], of: impl Fn(&Row) -> f64) -> Series {
    let points = rows.iter().map(|row| (row.position.to_degrees(), of(row)));
    Series::line(label, points.collect())
}

fn level(label: &str, cycle: f64, value: f64) -> Series {
    Series {
        look: LineStyle::Theory,
        ..Series::line(label, vec![(0.0, value), (cycle.to_degrees(), value)])
    }
}

/// ω(φ), ε(φ), the moment, work and energy, the inertia.
pub(super) fn charts(shown: &SteadyReport<'_>) -> Vec<Plot> {
    let (rows, cycle) = (shown.rows, shown.cycle);
    let chart = |title: &str, unit: &str, curves: Vec<Series>| Plot {
        title: title.to_owned(),
        y: Axis::of(unit),
        series: curves,
        x: Axis::new("φ", "deg"),
        ..Plot::default()
    };
    let f = shown.figures;
    vec![
        chart(
            "Angular speed ω",
            "rad/s",
            vec![
                curve("ω", rows, |row| row.speed),
                level("mean", cycle, f.mean_speed),
            ],
        ),
        chart(
            "Angular acceleration ε",
            "rad/s²",
            vec![curve("", rows, |row| row.acceleration)],
        ),
        chart(
            "Reduced moment M",
            "N m",
            vec![curve("", rows, |row| row.moment)],
        ),
        chart(
            "Work A since φ = 0 and kinetic energy T",
            "J",
            vec![
                curve("A", rows, |row| row.work),
                curve("T", rows, |row| row.energy),
            ],
        ),
        chart(
            "Reduced moment of inertia J",
            "kg m²",
            vec![curve("", rows, |row| row.inertia)],
        ),
    ]
}

/// Wittenbauer's diagram: work over reduced inertia, with its two tangents, that
/// touch where ω is greatest and least, and the origin O₂ in which they meet.
pub fn wittenbauer(shown: &SteadyReport<'_>) -> Plot {
    let f = shown.figures;
    let origin = -f.energy_at_start;
    let inertias = shown.rows.iter().map(|row| row.inertia);
    let [inertia, work] = frame(shown, origin).map_or([None; 2], |ends| ends.map(Some));
    let end = inertia.map_or(1.06 * inertias.fold(0.0, f64::max), |ends| ends[1]);
    let line = |label: &str, speed: f64| {
        let far = origin + 0.5 * speed * speed * end;
        Series::line(label, vec![(0.0, origin), (end, far)])
    };
    let least = shown
        .rows
        .iter()
        .map(|row| row.inertia)
        .fold(f64::INFINITY, f64::min);
    let reference = (2.0 * f.reference_energy / least).max(0.0).sqrt();
    Plot {
        title: "Energy-mass diagram (Wittenbauer): work A over reduced inertia J".to_owned(),
        y: Axis {
            range: work,
            ..Axis::of("J")
        },
        series: vec![
            Series::line(
                "A(J)",
                shown
                    .rows
                    .iter()
                    .map(|row| (row.inertia, row.work))
                    .collect(),
            ),
            line("O₂, ω_max", f.greatest_speed.value),
            line("O₂, ω_min", f.least_speed.value),
            line("O₂, ω_av", f.mean_speed),
            Series::line(
                "O₂O₁, ω₀ at the least J",
                vec![
                    (0.0, origin),
                    (least, origin + 0.5 * reference * reference * least),
                ],
            ),
        ],
        x: Axis {
            range: inertia,
            ..Axis::new("J", "kg m²")
        },
        ..Plot::default()
    }
}

/// Share of the frame that the curve takes at least, in width times height.
const SHARE: f64 = 0.3;
/// Room about the curve on each side, of its own size.
const ROOM: f64 = 0.2;

/// True where O₂ lies in the frame of the diagram: the curve is large enough beside it.
pub(super) fn origin_is_shown(shown: &SteadyReport<'_>) -> bool {
    frame(shown, -shown.figures.energy_at_start).is_none()
}

/// The ends of both axes about the curve alone, where it would be small in a frame that holds O₂
/// too: inertia, then work. A curve without width or height keeps O₂.
fn frame(shown: &SteadyReport<'_>, origin: f64) -> Option<[[f64; 2]; 2]> {
    let ends = |of: &dyn Fn(&Row) -> f64| {
        let values = || shown.rows.iter().map(of);
        [
            values().fold(f64::INFINITY, f64::min),
            values().fold(f64::NEG_INFINITY, f64::max),
        ]
    };
    let [inertia, work] = [ends(&|row| row.inertia), ends(&|row| row.work)];
    let share = |[low, high]: [f64; 2], far: f64| (high - low) / (high.max(far) - low.min(far));
    let taken = share(inertia, 0.0) * share(work, origin);
    let widened = |[low, high]: [f64; 2]| [low - ROOM * (high - low), high + ROOM * (high - low)];
    (taken > 1e-9 && taken < SHARE).then(|| [inertia, work].map(widened))
}
