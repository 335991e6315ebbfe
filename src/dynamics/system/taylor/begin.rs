//! The lowest orders of a series: the state, and the laws along the way expected.

use super::law::{excess_in_time, polynomial};
use super::{HIGHEST, Start, Taylor, ZERO};
use crate::dynamics::system::frozen::{Chain, Frozen, Step, segment};
use crate::dynamics::system::passes::{Extent, Work};

/// Share by which the polynomial of a law reaches beyond the way expected.
const MARGIN: f64 = 1.25;
/// Least reach of the polynomial of a law, against 1 + |φ|: far above rounding.
const LEAST_REACH: f64 = 1e-12;

impl Frozen {
    /// Orders 0 and 1 of all displacements; all orders of drives.
    pub(super) fn set_first_orders(
        &self,
        start: &Start<'_>,
        work: &mut Work<f64>,
        taylor: &mut Taylor,
    ) {
        let Start { time, y, dy, modes } = *start;
        self.motion(time, y, modes, Extent::Full, work);
        self.known_accelerations(&dy[self.coordinates..], work);
        taylor.excess = 0.0;
        let (u, v) = y.split_at(self.coordinates);
        for (coordinate, series) in taylor.u.iter_mut().enumerate() {
            series[0] = u[coordinate];
            series[1] = v[coordinate] * taylor.length;
            taylor.v[coordinate][0] = v[coordinate];
        }
        for step in &self.steps {
            match step {
                Step::Prescribed(drive) => {
                    taylor.displacement[drive.node] = ZERO;
                    taylor.speed[drive.node] = ZERO;
                    let (piece, length) = (segment(modes, drive.component), taylor.length);
                    let jet = |shift: f64| drive.motion.jet(piece, time + shift);
                    let middle = jet(0.0);
                    let speeds = polynomial(middle, jet(-length), jet(length), length);
                    let own = excess_in_time(&speeds, middle, time, length, taylor.last);
                    if own > taylor.excess || own.is_nan() {
                        taylor.excess = own;
                    }
                    taylor.set_coefficient(drive.node, 0, middle.value);
                    for (j, c) in speeds.iter().enumerate() {
                        taylor.set_coefficient(drive.node, j + 1, length * c / (j + 1) as f64);
                    }
                    for order in 0..HIGHEST - 1 {
                        taylor.acceleration[drive.node][order] = (order + 1) as f64
                            * taylor.speed[drive.node][order + 1]
                            / taylor.length;
                    }
                }
                Step::Rotor(rotor) => {
                    taylor.set_coefficient(rotor.node, 0, u[rotor.coordinate]);
                    taylor.set_coefficient(rotor.node, 1, v[rotor.coordinate] * taylor.length);
                }
                Step::Rigid(index) => {
                    let rigid = self.rigids[*index];
                    self.begin_law(rigid.law, modes, work, taylor);
                    for order in 0..2 {
                        taylor.set_coefficient(
                            rigid.node,
                            order,
                            taylor.laws[rigid.law].value[order],
                        );
                    }
                }
                Step::Chain(index) => self.begin_chain(&self.chains[*index], modes, work, taylor),
                Step::Constrained(index) => {
                    let own = &self.constraints[*index];
                    for order in 0..2 {
                        let sum = own.sum(|driver| taylor.displacement[driver][order]);
                        let offset = if order == 0 { own.offset() } else { 0.0 };
                        taylor.set_coefficient(own.node, order, sum + offset);
                    }
                }
            }
        }
    }

    fn begin_chain(&self, chain: &Chain, modes: &[i64], work: &Work<f64>, taylor: &mut Taylor) {
        self.begin_law(chain.law, modes, work, taylor);
        for (node, coordinate) in chain.nodes().zip(chain.coordinates()) {
            for order in 0..2 {
                let law = taylor.laws[chain.law].value[order];
                taylor.set_coefficient(node, order, law + taylor.u[coordinate][order]);
            }
        }
    }

    fn begin_law(&self, index: usize, modes: &[i64], work: &Work<f64>, taylor: &mut Taylor) {
        let law = &self.laws[index];
        let (driver, length) = (law.driver, taylor.length);
        let phi = taylor.displacement[driver][0];
        if law.has_variable_ratio() {
            let (speed, acceleration) = (work.speed[driver], work.acceleration[driver]);
            let way = length * (speed.abs() + 0.5 * length * acceleration.abs());
            let radius = (MARGIN * way).max(LEAST_REACH * (1.0 + phi.abs()));
            taylor.laws[index].begin_around(phi, radius, taylor.last, |phi| law.jet(modes, phi));
        } else {
            taylor.laws[index].begin_straight(law.jet(modes, phi));
        }
        taylor.laws[index].next_coefficients(1, taylor.displacement[driver][1]);
    }
}
