//! The equations of motion, in passes over flat arrays.
//!
//! Forward: displacements and speeds of all nodes, each law evaluated once.
//! Forces: loads, and the links with the reaction of link 1 on its driver.
//! Backward: rigid nodes hand their inertia and forces to their drivers.
//! Forward: accelerations, a driver's before those of what it drives.
//!
//! Written once for every kind of number.

use super::frozen::{Chain, Frozen, Step, segment};
use super::quantity::Quantity;

/// A law at an instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct LawValues<N> {
    /// U.
    pub(super) value: N,
    /// U′.
    pub(super) first: N,
    /// U′·φ̇_driver.
    pub(super) speed: N,
    /// U″·φ̇²_driver, the part of the acceleration that needs no φ̈.
    pub(super) bias: N,
}

/// Working arrays of one evaluation (k: nodes).
#[derive(Clone, Debug)]
pub(super) struct Work<N> {
    /// φ (k); of masses only where somebody looks, see [`Chain::watched`].
    pub(super) displacement: Vec<N>,
    /// φ̇ (k), likewise.
    pub(super) speed: Vec<N>,
    /// φ̈ (k), likewise.
    pub(super) acceleration: Vec<N>,
    /// Q: sum of the forces on each node, rigid followers' included (k).
    pub(super) force: Vec<N>,
    /// M: inertia of each node with that of its rigid followers (k).
    pub(super) mass: Vec<N>,
    /// The laws (one for each chain and rigid node).
    pub(super) laws: Vec<LawValues<N>>,
    /// F of link 1 (one for each chain).
    pub(super) reaction: Vec<N>,
}

impl<N: Quantity> Work<N> {
    /// Arrays of the size that `frozen` needs.
    pub(super) fn new(frozen: &Frozen) -> Self {
        let zero = N::from(0.0);
        let nodes = frozen.inertia.len();
        let law = LawValues {
            value: zero,
            first: zero,
            speed: zero,
            bias: zero,
        };
        Self {
            displacement: vec![zero; nodes],
            speed: vec![zero; nodes],
            acceleration: vec![zero; nodes],
            force: vec![zero; nodes],
            mass: vec![zero; nodes],
            laws: vec![law; frozen.laws.len()],
            reaction: vec![zero; frozen.chains.len()],
        }
    }
}

/// Which nodes an evaluation has to fill in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Extent {
    /// Those that the right-hand side needs.
    Needed,
    /// All of them.
    Full,
}

impl Frozen {
    /// u¨ of every coordinate, and everything in `work` on the way to it.
    pub(super) fn evaluate<N: Quantity>(
        &self,
        time: N,
        state: &[N],
        modes: &[i64],
        extent: Extent,
        work: &mut Work<N>,
        out: &mut [N],
    ) {
        self.motion(time, state, modes, extent, work);
        self.apply_loads(time, modes, work);
        self.apply_links(state, modes, work);
        self.reduce_rigid(extent, work);
        self.accelerate(extent, work, out);
    }

    /// Displacements and speeds; the acceleration of prescribed nodes.
    pub(super) fn motion<N: Quantity>(
        &self,
        time: N,
        state: &[N],
        modes: &[i64],
        extent: Extent,
        work: &mut Work<N>,
    ) {
        let (u, v) = state.split_at(self.coordinates);
        for step in &self.steps {
            match step {
                Step::Prescribed(drive) => {
                    let piece = segment(modes, drive.component);
                    let [value, first, second] = time.lift(|time| drive.motion.jet(piece, time));
                    work.displacement[drive.node] = value;
                    work.speed[drive.node] = first;
                    work.acceleration[drive.node] = second;
                }
                Step::Rotor(rotor) => {
                    work.displacement[rotor.node] = u[rotor.coordinate];
                    work.speed[rotor.node] = v[rotor.coordinate];
                }
                Step::Rigid(index) => {
                    let rigid = self.rigids[*index];
                    let law = self.law(rigid.law, modes, work);
                    work.displacement[rigid.node] = law.value;
                    work.speed[rigid.node] = law.speed;
                }
                Step::Chain(index) => {
                    let chain = &self.chains[*index];
                    let law = self.law(chain.law, modes, work);
                    if chain.watched || extent == Extent::Full {
                        for (node, coordinate) in chain.nodes().zip(chain.coordinates()) {
                            work.displacement[node] = law.value + u[coordinate];
                            work.speed[node] = law.speed + v[coordinate];
                        }
                    }
                }
            }
        }
    }

    /// A law at its driver's displacement and speed; kept in `work`.
    #[inline(always)]
    fn law<N: Quantity>(&self, index: usize, modes: &[i64], work: &mut Work<N>) -> LawValues<N> {
        let law = &self.laws[index];
        let displacement = work.displacement[law.driver];
        let speed = work.speed[law.driver];
        let [value, first, second] = displacement.lift(|phi| law.jet(modes, phi));
        let values = LawValues {
            value,
            first,
            speed: first * speed,
            bias: second * speed * speed,
        };
        work.laws[index] = values;
        values
    }

    /// Sets every node's force to its loads.
    pub(super) fn apply_loads<N: Quantity>(&self, time: N, modes: &[i64], work: &mut Work<N>) {
        for (force, &constant) in work.force.iter_mut().zip(&self.constant_force) {
            *force = N::from(constant);
        }
        for index in 0..self.loads.len() {
            let force = self.load(index, time, modes, work);
            work.force[self.loads[index].node] += force;
        }
    }

    /// The force of one of the loads that are not constant.
    #[inline]
    pub(super) fn load<N: Quantity>(
        &self,
        index: usize,
        time: N,
        modes: &[i64],
        work: &Work<N>,
    ) -> N {
        let load = &self.loads[index];
        let (displacement, speed) = (work.displacement[load.node], work.speed[load.node]);
        load.force(displacement, speed, |axis| {
            let place = axis.node.map_or(time, |node| work.displacement[node]);
            (place, modes[axis.component])
        })
    }

    /// Adds the forces of the links.
    fn apply_links<N: Quantity>(&self, state: &[N], modes: &[i64], work: &mut Work<N>) {
        for (index, chain) in self.chains.iter().enumerate() {
            let (u, v) = self.deviations(chain, state);
            let reaction = chain
                .contact
                .force(self.pair_mode(chain, modes), u[0], v[0]);
            work.reaction[index] = reaction;
            let law = work.laws[chain.law];
            work.force[self.laws[chain.law].driver] += reaction * law.first;
            let stiffness = &self.stiffness[chain.coordinates()];
            let damping = &self.damping[chain.coordinates()];
            let force = &mut work.force[chain.nodes()];
            apply_chain(u, v, stiffness, damping, reaction, force);
        }
    }

    /// Deviations u and their rates of a chain.
    #[inline(always)]
    pub(super) fn deviations<'a, N>(&self, chain: &Chain, state: &'a [N]) -> (&'a [N], &'a [N]) {
        let (u, v) = state.split_at(self.coordinates);
        (&u[chain.coordinates()], &v[chain.coordinates()])
    }

    /// Hands the inertia and the forces of rigid nodes to their drivers, the
    /// last driven first.
    pub(super) fn reduce_rigid<N: Quantity>(&self, extent: Extent, work: &mut Work<N>) {
        if self.rigids.is_empty() && extent == Extent::Needed {
            return;
        }
        for (mass, &inertia) in work.mass.iter_mut().zip(&self.inertia) {
            *mass = N::from(inertia);
        }
        for rigid in self.rigids.iter().rev() {
            self.reduce_node(rigid.law, rigid.node, work);
        }
    }

    /// Hands the inertia and the force of a node that follows a law exactly to
    /// the law's driver.
    #[inline(always)]
    pub(super) fn reduce_node<N: Quantity>(&self, law: usize, node: usize, work: &mut Work<N>) {
        let values = work.laws[law];
        let driver = self.laws[law].driver;
        let (mass, force) = (work.mass[node], work.force[node]);
        work.mass[driver] += values.first * values.first * mass;
        work.force[driver] += values.first * (force - mass * values.bias);
    }

    /// Accelerations, drivers before driven; u¨ into `out` (n).
    pub(super) fn accelerate<N: Quantity>(
        &self,
        extent: Extent,
        work: &mut Work<N>,
        out: &mut [N],
    ) {
        for step in &self.steps {
            match step {
                Step::Prescribed(_) => {}
                Step::Rotor(rotor) => {
                    let mass = if self.rigids.is_empty() {
                        N::from(self.inertia[rotor.node])
                    } else {
                        work.mass[rotor.node]
                    };
                    let acceleration = work.force[rotor.node] / mass;
                    work.acceleration[rotor.node] = acceleration;
                    out[rotor.coordinate] = acceleration;
                }
                Step::Rigid(index) => {
                    let rigid = self.rigids[*index];
                    work.acceleration[rigid.node] = self.law_acceleration(rigid.law, work);
                }
                Step::Chain(index) => {
                    let chain = &self.chains[*index];
                    let base = self.law_acceleration(chain.law, work);
                    self.accelerate_chain(chain, base, extent, work, out);
                }
            }
        }
    }

    /// Accelerations of the nodes from u¨ of the coordinates, as far as
    /// somebody looks at them; needs [`Frozen::motion`] done.
    pub(super) fn known_accelerations<N: Quantity>(&self, deviations: &[N], work: &mut Work<N>) {
        for step in &self.steps {
            match step {
                Step::Prescribed(_) => {}
                Step::Rotor(rotor) => {
                    work.acceleration[rotor.node] = deviations[rotor.coordinate];
                }
                Step::Rigid(index) => {
                    let rigid = self.rigids[*index];
                    work.acceleration[rigid.node] = self.law_acceleration(rigid.law, work);
                }
                Step::Chain(index) => {
                    let chain = &self.chains[*index];
                    let base = self.law_acceleration(chain.law, work);
                    for (node, coordinate) in chain.nodes().zip(chain.coordinates()) {
                        work.acceleration[node] = deviations[coordinate] + base;
                    }
                }
            }
        }
    }

    /// U′·φ̈ + U″·φ̇² of a law, its driver's acceleration known.
    #[inline(always)]
    pub(super) fn law_acceleration<N: Quantity>(&self, law: usize, work: &Work<N>) -> N {
        let values = &work.laws[law];
        values.first * work.acceleration[self.laws[law].driver] + values.bias
    }

    #[inline(always)]
    fn accelerate_chain<N: Quantity>(
        &self,
        chain: &Chain,
        base: N,
        extent: Extent,
        work: &mut Work<N>,
        out: &mut [N],
    ) {
        let out = &mut out[chain.coordinates()];
        let force = &work.force[chain.nodes()];
        if chain.carries {
            let mass = &work.mass[chain.nodes()];
            for ((out, &force), &mass) in out.iter_mut().zip(force).zip(mass) {
                *out = force / mass - base;
            }
        } else {
            let inverse = &self.inverse_inertia[chain.coordinates()];
            for ((out, &force), &inverse) in out.iter_mut().zip(force).zip(inverse) {
                *out = force.scale(inverse) - base;
            }
        }
        if chain.watched || extent == Extent::Full {
            let acceleration = &mut work.acceleration[chain.nodes()];
            for (acceleration, &deviation) in acceleration.iter_mut().zip(out.iter()) {
                *acceleration = deviation + base;
            }
        }
    }
}

/// Adds the forces of a chain's links to its masses; `reaction` is F of link 1.
#[inline(always)]
fn apply_chain<N: Quantity>(
    u: &[N],
    v: &[N],
    stiffness: &[f64],
    damping: &[f64],
    reaction: N,
    force: &mut [N],
) {
    let masses = force.len();
    let (u, v) = (&u[..masses], &v[..masses]);
    let (stiffness, damping) = (&stiffness[..masses], &damping[..masses]);
    let mut below = reaction;
    for m in 1..masses {
        let above = (u[m] - u[m - 1]).scale(stiffness[m]) + (v[m] - v[m - 1]).scale(damping[m]);
        force[m - 1] += above - below;
        below = above;
    }
    force[masses - 1] -= below;
}
