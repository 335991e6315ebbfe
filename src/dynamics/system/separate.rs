//! What the right-hand side has to evaluate: branches of their own taken apart, what is
//! only looked at from outside left out.

use super::frozen::{Branch, Chain, Frozen, Rigid, Step};
use super::multi::direct;
use super::trains::trains;
use super::written::FrozenExpression;

impl Frozen {
    /// Marks the chains that somebody looks at, and those that carry rigid objects.
    pub(super) fn mark_chains(&mut self) {
        let frozen = self;
        let watched = frozen.watched();
        // What a rigid contact holds is carried rigidly too.
        let held = (frozen.chains.iter())
            .filter(|chain| chain.contact.restitution().is_some())
            .map(|chain| frozen.laws[chain.law].driver);
        let carrying: Vec<usize> = (frozen.rigids.iter())
            .map(|rigid| frozen.laws[rigid.law].driver)
            .chain(held)
            .collect();
        for chain in &mut frozen.chains {
            chain.watched = watched.iter().any(|node| chain.nodes().contains(node));
            chain.carries = carrying.iter().any(|node| chain.nodes().contains(node));
        }
    }

    /// Nodes whose displacement or speed somebody asks for.
    fn watched(&self) -> Vec<usize> {
        (self.laws.iter().map(|law| law.driver))
            .chain(self.constraints.iter().flat_map(|one| one.drivers.clone()))
            .chain(self.loads.iter().map(|load| load.node))
            .chain(self.expression_loads().flat_map(FrozenExpression::nodes))
            .chain(self.tracks.iter().filter_map(|track| track.node))
            .collect()
    }

    /// Outputs of linkages that are only looked at from outside: the equations
    /// of motion need not know where they are.
    fn idle_outputs(&self) -> Vec<usize> {
        let frozen = self;
        let watched = frozen.watched();
        let idle = |rigid: &&Rigid| {
            frozen.laws[rigid.law].output.is_some()
                && frozen.constant_force[rigid.node] == 0.0
                && !watched.contains(&rigid.node)
        };
        frozen
            .rigids
            .iter()
            .filter(idle)
            .map(|rigid| rigid.node)
            .collect()
    }

    /// Takes apart what hangs on a prescribed drive alone.
    pub(super) fn separate_driven_parts(&mut self) {
        let idle = self.idle_outputs();
        let frozen = self;
        let needed = frozen
            .rigids
            .iter()
            .filter(|rigid| !idle.contains(&rigid.node));
        frozen.needed_rigids = needed.copied().collect();
        for number in 0..frozen.linkages.len() {
            // Behind a prescribed drive its inertia and forces move nothing.
            if frozen.moves_freely(frozen.linkages[number].node) {
                let asked = frozen.needed_rigids.iter().filter_map(|rigid| {
                    let output = frozen.laws[rigid.law].output?;
                    (output.linkage == number).then_some(output.output)
                });
                let mut asked: Vec<usize> = asked.collect();
                asked.sort_unstable();
                asked.dedup();
                frozen.linkages[number].tabulate(&asked);
            }
        }
        let drive_of = |chain: &Chain| {
            frozen.steps.iter().find_map(|step| match step {
                Step::Prescribed(drive) if drive.node == frozen.laws[chain.law].driver => {
                    Some(drive.clone())
                }
                _ => None,
            })
        };
        let mut branches = Vec::new();
        let mut coupled = Vec::new();
        for step in &frozen.steps {
            let alone = match step {
                Step::Chain(index) => {
                    let chain = frozen.chains[*index];
                    let alone = !chain.watched && chain.contact.restitution().is_none();
                    let drive = drive_of(&chain).filter(|_| alone);
                    drive.map(|drive| Branch {
                        drive,
                        law: frozen.laws[chain.law].clone(),
                        chain,
                        stiffness: frozen.stiffness[chain.coordinates()].into(),
                        damping: frozen.damping[chain.coordinates()].into(),
                        inverse_inertia: frozen.inverse_inertia[chain.coordinates()].into(),
                        constant_force: frozen.constant_force[chain.nodes()].into(),
                    })
                }
                Step::Rigid(index) if idle.contains(&frozen.rigids[*index].node) => continue,
                _ => None,
            };
            match alone {
                Some(branch) => branches.push(branch),
                None => coupled.push(step.clone()),
            }
        }
        // Drives alone need no evaluation, unless their displacement is a signal.
        let drive = |step: &Step| matches!(step, Step::Prescribed(_));
        if frozen.extra.is_empty() && coupled.iter().all(drive) {
            coupled.clear();
        }
        frozen.branches = branches;
        frozen.coupled = coupled;
        frozen.trains = trains(frozen);
        frozen.direct = direct(frozen);
    }
}
