//! Accelerations of one order, from the forces of that order.

use super::super::frozen::{Frozen, Step};
use super::Taylor;
use crate::math::polynomial::convolution_term;

impl Frozen {
    /// Accelerations of an order, drivers before driven, and the displacements
    /// two orders on.
    pub(super) fn accelerations_of(&self, order: usize, taylor: &mut Taylor) {
        for step in &self.steps {
            match step {
                Step::Prescribed(_) => {}
                Step::Rotor(rotor) => {
                    let acceleration =
                        self.acceleration_coefficient(rotor.node, 0.0, order, taylor);
                    let place = taylor.integration_factor(order) * acceleration;
                    taylor.acceleration[rotor.node][order] = acceleration;
                    taylor.set_coefficient(rotor.node, order + 2, place);
                    taylor.u[rotor.coordinate][order + 2] = place;
                    taylor.v[rotor.coordinate][order + 1] = taylor.speed[rotor.node][order + 1];
                }
                Step::Rigid(index) => {
                    let rigid = self.rigids[*index];
                    let place = self.advance_law(rigid.law, order, taylor);
                    taylor.set_coefficient(rigid.node, order + 2, place);
                    taylor.acceleration[rigid.node][order] =
                        place / taylor.integration_factor(order);
                }
                Step::Chain(index) => self.accelerate_of(*index, order, taylor),
                Step::Constrained(index) => {
                    let own = &self.constraints[*index];
                    let place = own.sum(|driver| taylor.displacement[driver][order + 2]);
                    taylor.set_coefficient(own.node, order + 2, place);
                    taylor.acceleration[own.node][order] = place / taylor.integration_factor(order);
                }
            }
        }
    }

    /// True of a mass that a rigid stop holds.
    fn grounded_of(&self, node: usize, taylor: &Taylor) -> bool {
        let mut stops = self.stops.iter().zip(&taylor.stop_modes);
        stops.any(|(stop, &mode)| stop.node == node && stop.contact.contact_holds(mode))
    }

    /// Coefficient `order` of φ̈ of a node from its forces and the links'.
    fn acceleration_coefficient(
        &self,
        node: usize,
        links: f64,
        order: usize,
        taylor: &Taylor,
    ) -> f64 {
        let force = taylor.force[node][order] + links;
        if self.rigids.is_empty() && self.constraints.is_empty() && !self.impacts {
            return force / self.inertia[node];
        }
        let (mass, known) = (&taylor.mass[node], &taylor.acceleration[node]);
        let carried = convolution_term(&mass[1..=order], &known[..order]);
        (force - carried) / mass[0]
    }

    /// The law's next coefficient of U, its driver's being known.
    fn advance_law(&self, law: usize, order: usize, taylor: &mut Taylor) -> f64 {
        let phi = taylor.displacement[self.laws[law].driver][order + 2];
        taylor.laws[law].next_coefficients(order + 2, phi);
        taylor.laws[law].value[order + 2]
    }

    fn accelerate_of(&self, index: usize, order: usize, taylor: &mut Taylor) {
        let chain = &self.chains[index];
        let base = self.advance_law(chain.law, order, taylor);
        let twice = taylor.integration_factor(order);
        let rate = (order + 2) as f64 / taylor.length;
        if chain.contact.contact_holds(taylor.modes[index]) {
            let (node, own) = (chain.first_node, chain.first_coordinate);
            taylor.acceleration[node][order] = base / twice;
            taylor.set_coefficient(node, order + 2, base);
            taylor.u[own][order + 2] = 0.0;
            taylor.v[own][order + 1] = 0.0;
            return;
        }
        let mut below = taylor.reaction[index][order];
        let last = chain.coordinates().end - 1;
        let masses = chain.nodes().zip(chain.coordinates()).skip(chain.points());
        for (node, m) in masses {
            let above = if m < last {
                let (u, v) = (&taylor.u, &taylor.v);
                self.stiffness[m + 1] * (u[m + 1][order] - u[m][order])
                    + self.damping[m + 1] * (v[m + 1][order] - v[m][order])
            } else {
                0.0
            };
            let acceleration = match self.impacts && self.grounded_of(node, taylor) {
                true => 0.0,
                false => self.acceleration_coefficient(node, above - below, order, taylor),
            };
            below = above;
            let place = twice * acceleration;
            taylor.acceleration[node][order] = acceleration;
            taylor.set_coefficient(node, order + 2, place);
            taylor.u[m][order + 2] = place - base;
            taylor.v[m][order + 1] = rate * (place - base);
        }
        if chain.point {
            let place = twice * self.point_of(index, order, taylor);
            let first = chain.first_coordinate;
            taylor.u[first][order + 2] = place;
            taylor.v[first][order + 1] = rate * place;
            taylor.set_coefficient(chain.first_node, order + 2, place + base);
            taylor.acceleration[chain.first_node][order] = (place + base) / twice;
        }
    }
}
