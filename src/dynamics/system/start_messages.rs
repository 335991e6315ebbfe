//! What the user is told of a start that cannot be, or that begins with a jolt.

use super::System;
use super::balance::{Balance, BalanceState};
use super::passes::{Extent, Work};
use super::placing::Side;
use crate::fault::Fault;
use crate::units::shown;

/// A static start that leaves out more than this share of the static load is
/// warned of.
const LEFT_OUT: f64 = 0.01;

impl System {
    /// The loads of a force-closed pair pull it open.
    pub(super) fn pulled_open(&self, kind: Balance, chain: usize, reaction: f64) -> Fault {
        let part = self.part_of_chain(chain);
        let id = self.model.objects[part].id.clone();
        let state = self.frozen.law_state();
        let mut modes = self.frozen.no_modes();
        self.frozen.locate_tracks(&state, &mut modes);
        let culprit = self
            .resting_loads(part, &state, &modes)
            .into_iter()
            .filter(|(_, force)| force * reaction > 0.0)
            .max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
        let static_force = self.frozen.link_forces(Balance::Static, &state, &modes)[chain];
        let by_inertia = kind == Balance::Kinetostatic && static_force * reaction <= 0.0;
        match culprit {
            _ if by_inertia => Fault::new(
                format!("{id}.pair"),
                format!(
                    "no quiet start: at t = 0 the inertia load separates the contact of `{id}` \
                     with {reaction}",
                    reaction = shown(reaction, 7)
                ),
                "a greater closing force, another position at t = 0, or \"start\": \"on_law\"",
            ),
            Some((name, force)) => Fault::new(
                name.clone(),
                format!(
                    "no static balance: `{name}` ({force}) separates the force-closed contact of \
                     `{id}`",
                    force = shown(force, 7)
                ),
                "a load that closes the pair, \"opens\" turned round, or \"start\": \"on_law\"",
            ),
            None => Fault::new(
                format!("{id}.pair"),
                format!(
                    "no static balance: the reactions of its followers separate the force-closed \
                     contact of `{id}` with {reaction}",
                    reaction = shown(reaction, 7)
                ),
                "a load that closes the pair, or \"start\": \"on_law\"",
            ),
        }
    }

    /// Name and force of the loads of an object that a body at rest feels.
    fn resting_loads(&self, part: usize, state: &[f64], modes: &[i64]) -> Vec<(String, f64)> {
        let mut work = Work::new(&self.frozen);
        self.frozen
            .motion(0.0, state, modes, Extent::Full, &mut work);
        let mut varying = 0;
        let mut forces = Vec::new();
        for load in &self.model.loads {
            let constant = load.law.as_constant();
            let force = constant.unwrap_or_else(|| self.frozen.load(varying, 0.0, modes, &work));
            varying += usize::from(constant.is_none());
            let own = self.model.objects[part].nodes.contains(&load.node);
            if own && !load.law.needs_speed() {
                forces.push((load.name.clone(), force));
            }
        }
        forces
    }

    pub(super) fn warn_of_inertia(
        &self,
        balanced: &BalanceState,
        modes: &[i64],
        warnings: &mut Vec<String>,
    ) {
        // Out of a dwell nothing is left out: what comes next has not acted yet.
        let law = self.frozen.law_state();
        let mut behind = modes.to_vec();
        self.frozen
            .locate_tracks_on(Side::Before, &law, &mut behind);
        let modes = behind.as_slice();
        let with = self
            .frozen
            .link_forces(Balance::Kinetostatic, &balanced.state, modes);
        for (chain, &force) in balanced.reactions.iter().enumerate() {
            let left_out = with[chain] - force;
            if left_out.abs() > LEFT_OUT * force.abs() {
                let part = &self.model.objects[self.part_of_chain(chain)];
                let [_, unit] = part.coordinate.units();
                warnings.push(format!(
                    "{}: the static start leaves out an inertia load of {left_out} {unit} \
                     (static load {force} {unit}), so the run begins with a vibration; \
                     \"start\": \"kinetostatic\" includes it",
                    part.id,
                    left_out = shown(left_out, 5),
                    force = shown(force, 5)
                ));
            }
        }
    }
}
