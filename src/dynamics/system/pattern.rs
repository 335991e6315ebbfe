//! Which acceleration depends on which coordinate: the pattern of the Jacobian.
//!
//! Found from how things hang together, not from numbers, so that it holds in
//! all modes and at every state. Laws of constant ratio hand on nothing: U′ is a
//! number and U″ is zero.

use super::constraints::ConstrainedNode;
use super::dry_friction;
use super::frozen::{Chain, Frozen, Rigid, Step};
use super::written::FrozenExpression;
use std::collections::BTreeSet;

/// Coordinates that something depends on.
type Set = BTreeSet<usize>;

/// Dependences of every node (k).
struct Dependences {
    /// Of φ and φ̇.
    place: Vec<Set>,
    /// Of the loads, reactions and rigid followers on it.
    force: Vec<Set>,
    /// Of its inertia with that of its rigid followers.
    mass: Vec<Set>,
    /// Of φ̈.
    acceleration: Vec<Set>,
}

impl Frozen {
    /// For every coordinate, those that its u¨ may depend on, ascending.
    pub(super) fn pattern(&self) -> Vec<Vec<usize>> {
        let nodes = self.inertia.len();
        let mut of = Dependences {
            place: self.places(),
            force: vec![Set::new(); nodes],
            mass: vec![Set::new(); nodes],
            acceleration: vec![Set::new(); nodes],
        };
        self.collect_loads(&mut of);
        self.collect_reactions(&mut of);
        self.collect_rigids(&mut of);
        self.couple_sets(&mut of);
        self.couple_dry_contacts(&mut of);
        let mut rows = vec![Set::new(); self.coordinates];
        for step in &self.steps {
            match step {
                Step::Prescribed(_) => {}
                Step::Rotor(rotor) => {
                    let node = rotor.node;
                    rows[rotor.coordinate] = &of.force[node] | &of.mass[node];
                    of.acceleration[node] = rows[rotor.coordinate].clone();
                }
                Step::Rigid(index) => {
                    let rigid = self.rigids[*index];
                    of.acceleration[rigid.node] = self.law_acceleration_set(rigid.law, &of);
                }
                Step::Chain(index) => {
                    self.chain_rows(&self.chains[*index], &mut of, &mut rows);
                }
                Step::Constrained(index) => {
                    let one = &self.constraints[*index];
                    let mut set = self.gradient(one, &of.place);
                    for &driver in &one.drivers {
                        set.extend(&of.acceleration[driver]);
                    }
                    of.acceleration[one.node] = set;
                }
            }
        }
        rows.into_iter()
            .map(|row| row.into_iter().collect())
            .collect()
    }

    /// Coordinates that U′ and U″φ̇² of a law depend on.
    fn slope(&self, law: usize, place: &[Set]) -> Set {
        if self.laws[law].has_variable_ratio() {
            place[self.laws[law].driver].clone()
        } else {
            Set::new()
        }
    }

    fn places(&self) -> Vec<Set> {
        let mut place = vec![Set::new(); self.inertia.len()];
        for step in &self.steps {
            match step {
                Step::Prescribed(_) => {}
                Step::Rotor(rotor) => place[rotor.node] = Set::from([rotor.coordinate]),
                Step::Rigid(index) => {
                    let rigid = self.rigids[*index];
                    place[rigid.node] = place[self.laws[rigid.law].driver].clone();
                }
                Step::Chain(index) => {
                    let chain = &self.chains[*index];
                    let base = place[self.laws[chain.law].driver].clone();
                    for (node, coordinate) in chain.nodes().zip(chain.coordinates()) {
                        place[node] = base.clone();
                        place[node].insert(coordinate);
                    }
                }
                Step::Constrained(index) => {
                    let one = &self.constraints[*index];
                    let all = one.drivers.iter().flat_map(|&driver| place[driver].clone());
                    place[one.node] = all.collect();
                }
            }
        }
        place
    }

    fn collect_loads(&self, of: &mut Dependences) {
        for load in &self.loads {
            let mut set = match load.law.needs_own_motion() {
                true => of.place[load.node].clone(),
                false => Set::new(),
            };
            if let Some(node) = load.argument.as_ref().and_then(|axis| axis.node) {
                set.extend(&of.place[node]);
            }
            for node in load.written.iter().flat_map(FrozenExpression::nodes) {
                set.extend(&of.place[node]);
            }
            of.force[load.node].extend(set);
        }
    }

    fn collect_reactions(&self, of: &mut Dependences) {
        for chain in &self.chains {
            let mut set = self.slope(chain.law, &of.place);
            set.insert(chain.first_coordinate);
            of.force[self.laws[chain.law].driver].extend(set);
        }
    }

    fn collect_rigids(&self, of: &mut Dependences) {
        // J and the forces of a linkage change with its input coordinate.
        for linkage in &self.linkages {
            let place = of.place[linkage.node].clone();
            of.force[linkage.node].extend(&place);
            of.mass[linkage.node].extend(place);
        }
        for step in self.steps.iter().rev() {
            let rigid = match *step {
                Step::Rigid(index) => self.rigids[index],
                // A rigid contact may hold it.
                Step::Chain(index) if self.chains[index].contact.restitution().is_some() => {
                    let chain = &self.chains[index];
                    Rigid {
                        node: chain.first_node,
                        law: chain.law,
                    }
                }
                Step::Constrained(index) => {
                    let one = &self.constraints[index];
                    let force = &self.gradient(one, &of.place) | &of.force[one.node];
                    for &driver in &one.drivers {
                        of.force[driver].extend(&force);
                    }
                    continue;
                }
                _ => continue,
            };
            let driver = self.laws[rigid.law].driver;
            let slope = self.slope(rigid.law, &of.place);
            let mass = &slope | &of.mass[rigid.node];
            // U″·φ̇² is multiplied by the mass; without it the mass is not felt.
            let force = &slope | &of.force[rigid.node];
            let force = if self.laws[rigid.law].has_variable_ratio() {
                &force | &mass
            } else {
                force
            };
            of.mass[driver].extend(mass);
            of.force[driver].extend(force);
        }
    }

    /// Coordinates that the gradient of a constraint and its bias depend on.
    fn gradient(&self, one: &ConstrainedNode, place: &[Set]) -> Set {
        match one.constraint.is_linear() {
            true => Set::new(),
            false => place[one.node].clone(),
        }
    }

    /// The inertia forces of constrained nodes depend on all that moves their roots, and
    /// act on all of these.
    fn couple_sets(&self, of: &mut Dependences) {
        let mut all = Set::new();
        let mut roots = Set::new();
        for &node in self.multi.iter().flat_map(|multi| &multi.nodes) {
            all.extend(&of.place[node]);
            all.extend(&of.force[node]);
            roots.extend(self.root_nodes(node));
        }
        for &index in &self.heavy {
            let node = self.constraints[index].node;
            all.extend(&of.place[node]);
            all.extend(&of.mass[node]);
            all.extend(&of.force[node]);
            roots.extend(self.root_nodes(node));
        }
        for &root in &roots {
            self.collect_root(root, of, &mut all);
        }
        for root in roots {
            of.force[root].extend(&all);
        }
    }

    /// All that the acceleration of a root depends on.
    fn collect_root(&self, root: usize, of: &Dependences, all: &mut Set) {
        all.extend(&of.force[root]);
        all.extend(&of.mass[root]);
        // The links of a chain's mass pull at it too.
        let around = |chain: &&Chain| chain.nodes().contains(&root);
        for chain in self.chains.iter().filter(around) {
            all.extend(chain.coordinates());
        }
    }

    /// The forces of dry contacts at rest depend on all that moves the roots of their set, and act
    /// on all of these.
    fn couple_dry_contacts(&self, of: &mut Dependences) {
        for roots in dry_friction::roots_of_sets(self) {
            let mut all = Set::new();
            for &root in &roots {
                self.collect_root(root, of, &mut all);
            }
            for contact in self.dry.iter().filter(|own| own.is_moved_by(&roots)) {
                all.extend(&of.place[contact.node]);
            }
            for root in roots {
                of.force[root].extend(&all);
            }
        }
    }

    fn law_acceleration_set(&self, law: usize, of: &Dependences) -> Set {
        let slope = self.slope(law, &of.place);
        &slope | &of.acceleration[self.laws[law].driver]
    }

    fn chain_rows(&self, chain: &Chain, of: &mut Dependences, rows: &mut [Set]) {
        let base = self.law_acceleration_set(chain.law, of);
        let coordinates = chain.coordinates();
        for (node, coordinate) in chain.nodes().zip(chain.coordinates()) {
            // Forces on the mass; its own acceleration is theirs alone.
            let mut own = &of.force[node] | &of.mass[node];
            let before = coordinate.saturating_sub(1).max(coordinates.start);
            own.extend(before..(coordinate + 2).min(coordinates.end));
            rows[coordinate] = &own | &base;
            of.acceleration[node] = own;
        }
        if chain.point {
            // The balance of its forces, differentiated: what moves mass 1, and itself.
            let first = coordinates.start;
            rows[first] = &rows[first + 1] | &Set::from([first, first + 1]);
            of.acceleration[chain.first_node] = &rows[first] | &base;
        }
    }
}
