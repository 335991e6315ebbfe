//! Diagrams of a steady motion.

use super::SteadyReport;
use crate::dynamics::steady::Row;
use crate::report::plot::{Axis, Plot, Series};

/// ω(φ), ε(φ), the moment, work and energy, the inertia.
pub(super) fn charts(shown: &SteadyReport<'_>) -> Vec<Plot> {
    let curve = |label: &str, of: fn(&Row) -> f64| {
        let points = (shown.rows.iter()).map(|row| (row.position.to_degrees(), of(row)));
        Series::line(label, points.collect())
    };
    let one = |title: &str, unit: &str, of: fn(&Row) -> f64| {
        Plot::over_angle(title, unit, vec![curve("", of)])
    };
    let mean = shown.figures.mean_speed;
    let mean = vec![(0.0, mean), (shown.cycle.to_degrees(), mean)];
    let speed = vec![curve("ω", |row| row.speed), Series::theory("mean", mean)];
    let energies = vec![curve("A", |row| row.work), curve("T", |row| row.energy)];
    vec![
        Plot::over_angle("Angular speed ω", "rad/s", speed),
        one("Angular acceleration ε", "rad/s²", |row| row.acceleration),
        one("Reduced moment M", "N m", |row| row.moment),
        Plot::over_angle("Work A since φ = 0 and kinetic energy T", "J", energies),
        one("Reduced moment of inertia J", "kg m²", |row| row.inertia),
    ]
}

/// Wittenbauer's diagram: work over reduced inertia, with its two tangents, that
/// touch where ω is greatest and least, and the origin O₂ in which they meet.
pub fn wittenbauer(shown: &SteadyReport<'_>) -> Plot {
    let (f, rows) = (shown.figures, shown.rows);
    let origin = -f.energy_at_start;
    let inertias = || rows.iter().map(|row| row.inertia);
    let [inertia, height] = frame(shown, origin).map_or([None; 2], |ends| ends.map(Some));
    let end = inertia.map_or(1.06 * inertias().fold(0.0, f64::max), |ends| ends[1]);
    let line = |label: &str, speed: f64, end: f64| {
        let far = origin + 0.5 * speed * speed * end;
        Series::line(label, vec![(0.0, origin), (end, far)])
    };
    let least = inertias().fold(f64::INFINITY, f64::min);
    let reference = (2.0 * f.reference_energy / least).max(0.0).sqrt();
    let work = rows.iter().map(|row| (row.inertia, row.work));
    let mut plot = Plot::new(
        "Energy-mass diagram (Wittenbauer): work A over reduced inertia J",
        Axis {
            range: inertia,
            ..Axis::new("J", "kg m²")
        },
        "J",
        vec![
            Series::line("A(J)", work.collect()),
            line("O₂, ω_max", f.greatest_speed.value, end),
            line("O₂, ω_min", f.least_speed.value, end),
            line("O₂, ω_av", f.mean_speed, end),
            line("O₂O₁, ω₀ at the least J", reference, least),
        ],
    );
    plot.y.range = height;
    plot
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
