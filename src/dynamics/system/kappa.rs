//! The constant of pairs that leave it to the loads.

use super::System;
use super::balance::{Balance, resting_mode};
use crate::dynamics::model::{Closure, LinkBase, Loss};
use crate::fault::Fault;

impl System {
    /// κ of pairs that leave it open: b₁/(c₁·p*) = b₁/|F| with F
    /// the static force of the pair.
    pub(super) fn find_kappas(&mut self) -> Result<(), Vec<Fault>> {
        let open = |link: &crate::dynamics::model::Link| {
            matches!(&link.base, LinkBase::Law { pair }
                if pair.closure != Closure::Bilateral
                    && pair.form.loss() == Some(Loss::FactorOfDamper))
        };
        let links: Vec<usize> = (0..self.model.links.len())
            .filter(|&link| open(&self.model.links[link]))
            .collect();
        if links.is_empty() {
            return Ok(());
        }
        let mut modes = self.frozen.no_modes();
        let balanced = self.frozen.balance_from_law(Balance::Static, &mut modes);
        let mut faults = Vec::new();
        for link in links {
            let link = &self.model.links[link];
            let node = self.frozen.internal[link.mass];
            let Some(index) =
                (self.frozen.chains.iter()).position(|chain| chain.first_node == node)
            else {
                continue;
            };
            let force = balanced
                .as_ref()
                .map_or(0.0, |balanced| balanced.reactions[index]);
            let chain = &mut self.frozen.chains[index];
            if resting_mode(chain, force) == super::pairs::OPEN {
                let object = super::check::object_of(&self.model, link.mass);
                faults.push(Fault::new(
                    format!("{object}.pair.kappa"),
                    "κ cannot be found from the static penetration: no load presses the pair at t = 0",
                    "give \"kappa\" in seconds per unit of penetration",
                ));
                continue;
            }
            let kappa = Some(link.damping / force.abs());
            chain.contact.kappa = kappa;
            let mut branches = self.frozen.branches.iter_mut();
            if let Some(branch) = branches.find(|branch| branch.chain.first_node == node) {
                branch.chain.contact.kappa = kappa;
            }
        }
        if faults.is_empty() {
            Ok(())
        } else {
            Err(faults)
        }
    }
}
