//! The counterweight on the input link that reduces the shaking force most.

use super::row::Row;
use crate::kinematics::linkage::spec::LinkageSpec;

/// A counterweight on the input link, found by least squares of the shaking
/// force over the course.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Counterweight {
    /// Index of the link that carries it.
    pub link: usize,
    /// Mass times distance from the pivot (kg·m).
    pub mass_radius: f64,
    /// Direction from the pivot, in the frame of the link (rad).
    pub angle: f64,
    /// Root mean square of the shaking force without and with it (N).
    pub rms: [f64; 2],
    /// Greatest shaking force without and with it, at the positions (N).
    pub greatest: [f64; 2],
}

/// Fits the counterweight; `None` unless the input link turns about a point of
/// the ground, all positions have forces and any of them shakes.
pub(super) fn fit_counterweight(linkage: &LinkageSpec, rows: &[Row]) -> Option<Counterweight> {
    let driver = &linkage.pairs[linkage.driver];
    if driver.slides() {
        return None;
    }
    let link = match (driver.on.link, driver.link.link) {
        (None, Some(link)) | (Some(link), None) => link,
        _ => return None,
    };
    // Where the input link is joined to the ground as its first link, the
    // angle of its frame runs against the coordinate; squares do not care.
    let mut weights = [0.0; 3];
    let mut samples = Vec::with_capacity(rows.len());
    for row in rows {
        let forces = row.forces.as_ref().ok()?;
        let turning = if driver.link.link == Some(link) {
            1.0
        } else {
            -1.0
        };
        let (speed, acceleration) = (row.motion.speed, turning * row.motion.acceleration);
        let [cos, sin] = forces.links[link].direction;
        let centripetal = speed * speed;
        // Force of a unit mass at a unit distance along the frame's axes.
        let along = |x: f64, y: f64| {
            let (x, y) = (cos * x - sin * y, sin * x + cos * y);
            [
                centripetal * x + acceleration * y,
                centripetal * y - acceleration * x,
            ]
        };
        let columns = [along(1.0, 0.0), along(0.0, 1.0)];
        let force = [forces.shaking[0], forces.shaking[1]];
        for k in 0..2 {
            weights[k] -= columns[k][0] * force[0] + columns[k][1] * force[1];
        }
        weights[2] += centripetal * centripetal + acceleration * acceleration;
        samples.push((force, columns));
    }
    if weights[2] <= 0.0 {
        return None;
    }
    let best = [weights[0] / weights[2], weights[1] / weights[2]];
    let size = best[0].hypot(best[1]);
    // A component that is rounding must not turn straight back into −180°.
    let best = best.map(|part| if part.abs() > 1e-12 * size { part } else { 0.0 });
    let mut result = Counterweight {
        link,
        mass_radius: size,
        angle: best[1].atan2(best[0]),
        rms: [0.0; 2],
        greatest: [0.0; 2],
    };
    for (force, columns) in &samples {
        let left = [0, 1]
            .map(|axis| force[axis] + best[0] * columns[0][axis] + best[1] * columns[1][axis]);
        for (which, [x, y]) in [*force, left].into_iter().enumerate() {
            let size = x.hypot(y);
            result.rms[which] += size * size / samples.len() as f64;
            result.greatest[which] = result.greatest[which].max(size);
        }
    }
    result.rms = result.rms.map(f64::sqrt);
    (result.rms[0] > 0.0).then_some(result)
}
