//! Diagrams of a steady motion.

use super::Shown;
use crate::report::svg::chart::{Axis, Chart, Curve};
use crate::steady::Row;

/// φ in degrees: plain numbers, so that no prefix is put before the unit.
pub(super) fn angle() -> Axis {
    Axis {
        symbol: "φ, degrees".to_owned(),
        unit: String::new(),
    }
}

fn curve(label: &str, rows: &[Row], of: impl Fn(&Row) -> f64) -> Curve {
    Curve {
        label: label.to_owned(),
        points: rows
            .iter()
            .map(|row| (row.position.to_degrees(), of(row)))
            .collect(),
    }
}

fn level(label: &str, cycle: f64, value: f64) -> Curve {
    Curve {
        label: label.to_owned(),
        points: vec![(0.0, value), (cycle.to_degrees(), value)],
    }
}

/// ω(φ), ε(φ), the moment, work and energy, the inertia.
pub fn charts(shown: &Shown<'_>) -> Vec<Chart> {
    let (rows, cycle) = (shown.rows, shown.cycle);
    let chart = |title: &str, unit: &str, curves: Vec<Curve>| Chart {
        title: title.to_owned(),
        unit: unit.to_owned(),
        curves,
        horizontal: angle(),
        ..Chart::default()
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
            "Angular acceleration ε, rad/s²",
            "",
            vec![curve("", rows, |row| row.acceleration)],
        ),
        chart(
            "Reduced moment M",
            "N·m",
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
            "Reduced moment of inertia J, kg·m²",
            "",
            vec![curve("", rows, |row| row.inertia)],
        ),
    ]
}

/// Wittenbauer's diagram: work over reduced inertia, with its two tangents, that
/// touch where ω is greatest and least, and the origin O₂ in which they meet.
pub fn wittenbauer(shown: &Shown<'_>) -> Chart {
    let f = shown.figures;
    let origin = -f.energy_at_start;
    let inertias = shown.rows.iter().map(|row| row.inertia);
    let end = 1.06 * inertias.fold(0.0, f64::max);
    let line = |label: &str, speed: f64| Curve {
        label: label.to_owned(),
        points: vec![(0.0, origin), (end, origin + 0.5 * speed * speed * end)],
    };
    let least = shown
        .rows
        .iter()
        .map(|row| row.inertia)
        .fold(f64::INFINITY, f64::min);
    let reference = (2.0 * f.reference_energy / least).max(0.0).sqrt();
    Chart {
        title: "Energy-mass diagram (Wittenbauer): work A over reduced inertia J".to_owned(),
        unit: "J".to_owned(),
        curves: vec![
            Curve {
                label: "A(J)".to_owned(),
                points: shown
                    .rows
                    .iter()
                    .map(|row| (row.inertia, row.work))
                    .collect(),
            },
            line("O₂, ω_max", f.greatest_speed.value),
            line("O₂, ω_min", f.least_speed.value),
            line("O₂, ω_av", f.mean_speed),
            Curve {
                label: "O₂O₁, ω₀ at the least J".to_owned(),
                points: vec![
                    (0.0, origin),
                    (least, origin + 0.5 * reference * reference * least),
                ],
            },
        ],
        horizontal: Axis {
            symbol: "J, kg·m²".to_owned(),
            unit: String::new(),
        },
        ..Chart::default()
    }
}
