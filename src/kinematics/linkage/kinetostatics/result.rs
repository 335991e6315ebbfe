//! What a workspace holds after a position has been solved.

use super::Kinetostatics;
use super::couplings::add_on_frame;
use super::friction::Law;
use super::workspace::ForceWorkspace;
use crate::kinematics::linkage::joints::Act;
use crate::kinematics::linkage::multi::spec::InputCoordinate;
use crate::kinematics::linkage::spec::PairKind;

/// Reaction of a pair: on link j from link i.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reaction {
    /// Force in a pin, in the frame of the ground (N).
    Pin([f64; 2]),
    /// Normal forces at the two corners of a block (N), positive along +n, to
    /// the left of the guide's direction. Where the corners were left open,
    /// only their sum and [`Kinetostatics::couple`] mean something.
    Guide([f64; 2]),
}

/// Friction of a pair on link j from link i.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlidingFriction {
    /// Couple in a pin (N·m), or the sum of both corners' forces along the
    /// guide (N).
    pub size: f64,
    /// Power that it takes (W), ≥ 0.
    pub loss: f64,
}

/// Power balance of the links: `drive` + `weights` + `forces` − `inertia` = `loss`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Balance {
    /// Power of the driver (W).
    pub drive: f64,
    /// Power of the weights (W).
    pub weights: f64,
    /// Power of springs, dampers, forces, couples and loads on outputs (W).
    pub forces: f64,
    /// Power that accelerates the links (W).
    pub inertia: f64,
    /// Power lost to friction, from the reactions (W), ≥ 0.
    pub loss: f64,
    /// Part of the power that flows in which reaches something else than
    /// friction: 1 − loss/(sum of all that is positive); `None` if no power flows.
    pub efficiency: Option<f64>,
    /// Residual of the power balance, relative to its greatest part (at least to a
    /// millionth of the greatest reaction times the speed of the links).
    pub residual: f64,
}

impl ForceWorkspace {
    /// The driver's force (N·m or N), positive along the input coordinate.
    pub fn driver_force(&self) -> f64 {
        self.drive
    }

    /// The force of every driver (N·m or N), positive along its coordinate: of several inputs
    /// in their order.
    pub fn driver_forces(&self) -> &[f64] {
        &self.drives
    }

    /// Driver's forces of further solutions at the same position.
    pub fn other_drives(&self) -> &[f64] {
        &self.others
    }

    /// Sign of the sliding of a pair just after the position; 0: at rest.
    pub fn sliding_sign(&self, pair: usize) -> f64 {
        self.pairs[pair].sense
    }

    /// Point of a pair: the pin, or the block's reference point (m).
    pub fn pair_point(&self, pair: usize) -> [f64; 2] {
        self.pairs[pair].point
    }

    /// Generalised force of one of the linkage's forces, along the input
    /// coordinate (N·m or N).
    pub fn generalised(&self, force: usize) -> f64 {
        self.forces[force]
    }
}

impl Kinetostatics {
    /// Reaction of a pair.
    pub fn reaction(&self, pair: usize, w: &ForceWorkspace) -> Reaction {
        let two = [w.unknowns[2 * pair], w.unknowns[2 * pair + 1]];
        match self.spec.pairs[pair].slides() {
            false => Reaction::Pin(two),
            true => Reaction::Guide(two),
        }
    }

    /// Friction of a pair.
    pub fn friction(&self, pair: usize, w: &ForceWorkspace) -> SlidingFriction {
        let term = w.terms.iter().find(|term| term.unknown == 2 * pair);
        let size = term.map_or(0.0, |term| {
            let unit = match term.law {
                Law::Pin(_) | Law::HeldGuide { .. } => self.length,
                Law::Guide(_) => 1.0,
            };
            unit * w.friction[term.column]
        });
        SlidingFriction {
            size,
            // −0 would be printed as such.
            loss: 0.0 - size * w.pairs[pair].rates[0] * w.speed,
        }
    }

    /// Total force of a pair on link j from link i, friction included, in the
    /// frame of the ground (N).
    pub fn force(&self, pair: usize, w: &ForceWorkspace) -> [f64; 2] {
        match self.reaction(pair, w) {
            Reaction::Pin(force) => force,
            Reaction::Guide([a, b]) => {
                let [tx, ty] = w.pairs[pair].tangent;
                let along = self.friction(pair, w).size;
                let (normal, along) = (a + b, along);
                [along * tx - normal * ty, along * ty + normal * tx]
            }
        }
    }

    /// Corners' places of a sliding pair on the guide's axis, in the frame of
    /// the ground (m), and the direction +n of their forces.
    pub fn corners(&self, pair: usize, w: &ForceWorkspace) -> Option<([[f64; 2]; 2], [f64; 2])> {
        let PairKind::Sliding { .. } = self.spec.pairs[pair].kind else {
            return None;
        };
        let corners = self.corners[pair];
        let ([x, y], [tx, ty]) = (w.pairs[pair].point, w.pairs[pair].tangent);
        Some((corners.map(|b| [x + b * tx, y + b * ty]), [-ty, tx]))
    }

    /// Generalised force that accelerates the links, along the input coordinate.
    pub fn generalised_inertia(&self, w: &ForceWorkspace) -> f64 {
        let v2 = w.speed * w.speed;
        (0..self.spec.links.len())
            .map(|link| {
                let (body, centre, frame) =
                    (&self.spec.links[link], &w.centres[link], &w.links[link]);
                let along = |k: usize| {
                    centre.first[k] * (centre.first[k] * w.acceleration + centre.second[k] * v2)
                };
                let turning =
                    frame.first[2] * (frame.first[2] * w.acceleration + frame.second[2] * v2);
                body.mass * (along(0) + along(1)) + body.moment * turning
            })
            .sum()
    }

    /// Power balance at the position solved last.
    pub fn balance(&self, w: &ForceWorkspace) -> Balance {
        let q = w.speed;
        let parts = [
            w.drive * q,
            w.weights.iter().sum::<f64>() * q,
            (w.forces.iter().sum::<f64>() + w.output_forces.iter().sum::<f64>()) * q,
            -self.generalised_inertia(w) * q,
        ];
        let loss: f64 = (0..self.spec.pairs.len())
            .map(|pair| self.friction(pair, w).loss)
            .sum();
        let each = w.forces.iter().chain(&w.output_forces);
        let each = each.map(|force| force * q);
        let flows = [parts[0], parts[1], parts[3]].into_iter().chain(each);
        let (inflow, greatest) = flows.fold((0.0, loss.abs()), |(sum, most): (f64, f64), flow| {
            (sum + flow.max(0.0), most.max(flow.abs()))
        });
        let missing = parts.iter().sum::<f64>() - loss;
        // Power that the greatest force would have at the speed of the links:
        // where all parts vanish, they are rounding of this.
        let pace = match self.over_time {
            true => w.pace,
            false => self.drive_unit() * q.abs(),
        };
        let size = w.greatest_magnitude() * pace;
        let scale = greatest.max(1e-6 * size);
        Balance {
            drive: parts[0],
            weights: parts[1],
            forces: parts[2],
            inertia: 0.0 - parts[3],
            loss,
            efficiency: (inflow > 1e-12 * size).then(|| (1.0 - loss / inflow).clamp(0.0, 1.0)),
            residual: if scale > 0.0 {
                missing.abs() / scale
            } else {
                0.0
            },
        }
    }

    /// Force (N) and moment about the ground's origin (N·m) that the inertia
    /// of the links exerts on the frame: shaking force and moment.
    pub fn shaking(&self, w: &ForceWorkspace) -> [f64; 3] {
        let v2 = w.speed * w.speed;
        let mut sum = [0.0; 3];
        for (index, body) in self.spec.links.iter().enumerate() {
            let (centre, link) = (&w.centres[index], &w.links[index]);
            let force = [0, 1]
                .map(|k| -body.mass * (centre.first[k] * w.acceleration + centre.second[k] * v2));
            let turning = link.first[2] * w.acceleration + link.second[2] * v2;
            sum[0] += force[0];
            sum[1] += force[1];
            sum[2] +=
                centre.place[0] * force[1] - centre.place[1] * force[0] - body.moment * turning;
        }
        sum
    }

    /// Force (N) and moment about the ground's origin (N·m) of weights and
    /// external forces on the links.
    pub fn applied(&self, w: &ForceWorkspace) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (rows, centre) in w.applied.chunks_exact(3).zip(&w.centres) {
            sum[0] += rows[0];
            sum[1] += rows[1];
            sum[2] += centre.place[0] * rows[1] - centre.place[1] * rows[0] + rows[2] * self.length;
        }
        sum
    }

    /// Force (N) and moment about the ground's origin (N·m) of all pairs on the
    /// frame, friction and the driver included.
    pub fn on_frame(&self, w: &ForceWorkspace) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (index, pair) in self.spec.pairs.iter().enumerate() {
            let sign = match (pair.on.link, pair.link.link) {
                (None, Some(_)) => -1.0,
                (Some(_), None) => 1.0,
                _ => continue,
            };
            let act = Act {
                at: w.pairs[index].point,
                force: self.force(index, w),
                couple: self.couple(index, w),
            };
            add_on_frame(&act, sign, &mut sum);
            let here = InputCoordinate::Pair(index);
            let mut drives = self.drivers.iter().zip(&w.drives);
            if let Some((_, &drive)) = drives.find(|(driver, _)| **driver == here) {
                self.add_drive(index, sign * drive, w, &mut sum);
            }
        }
        self.add_floating_drives(w, &mut sum);
        self.add_couplings_on_frame(w, &mut sum);
        self.add_welds_on_frame(w, &mut sum);
        sum
    }

    /// Couple of a pair on link j about its point (N·m): of pin friction, or of
    /// the corners' forces and their friction.
    pub fn couple(&self, pair: usize, w: &ForceWorkspace) -> f64 {
        let term = w.terms.iter().find(|term| term.unknown == 2 * pair);
        let rubbing = term.map_or(0.0, |term| match term.law {
            Law::Pin(_) | Law::HeldGuide { .. } => self.length * w.friction[term.column],
            Law::Guide(_) => self.length * w.friction[term.column + 1],
        });
        let pressing = match self.reaction(pair, w) {
            Reaction::Guide([a, b]) => self.corners[pair][0] * a + self.corners[pair][1] * b,
            Reaction::Pin(_) => 0.0,
        };
        rubbing + pressing
    }

    /// A driver's force or couple, as a part of what acts on the frame.
    fn add_drive(&self, pair: usize, drive: f64, w: &ForceWorkspace, sum: &mut [f64; 3]) {
        match self.spec.pairs[pair].slides() {
            false => sum[2] += drive,
            true => {
                let act = Act::force(w.pairs[pair].point, w.pairs[pair].tangent);
                add_on_frame(&act, drive, sum);
            }
        }
    }

    /// The forces that hold links that float, from the ground on their origins: on the frame
    /// they act in the other sense.
    fn add_floating_drives(&self, w: &ForceWorkspace, sum: &mut [f64; 3]) {
        for (driver, drive) in self.drivers.iter().zip(&w.drives) {
            match *driver {
                InputCoordinate::Pair(_) => {}
                InputCoordinate::X(link) => {
                    add_on_frame(&Act::force(w.links[link].origin, [1.0, 0.0]), -drive, sum);
                }
                InputCoordinate::Y(link) => {
                    add_on_frame(&Act::force(w.links[link].origin, [0.0, 1.0]), -drive, sum);
                }
                InputCoordinate::Angle(_) => sum[2] -= drive,
            }
        }
    }
}
