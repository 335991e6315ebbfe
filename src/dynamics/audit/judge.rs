//! The equations of motion put to the test.

use super::check::EquationCheck;
use super::mechanics::{At, Mechanics};
use super::sampler::{DrawnInstant, DrawnInstants, PLACES, SEED, WEIGHTS, Window};
use crate::dynamics::integrate::Dynamics;
use crate::dynamics::model::{LinkBase, Model, NodeMotion, ObjectPart};
use crate::dynamics::system::{ObjectState, Scratch, System};

/// Defect that is allowed in tolerances, as a share of the terms.
const TOLERANCES: f64 = 500.0;

/// … and where none is given, by the rounding of laws and of their tables.
const LEAST: f64 = 1e-7;

/// Errors of a state over a step, in tolerances of its size.
const OF_STATE: f64 = 10.0;

/// Roundings of a term.
pub(super) const ROUNDINGS: f64 = 256.0 * f64::EPSILON;

/// Keeps the defect that is less against its bound; one that is no number gives way.
pub(super) fn keep_smaller_defect(best: &mut Option<(f64, f64)>, (defect, bound): (f64, f64)) {
    if best.is_none_or(|(d, b)| !(d * bound <= defect * b)) {
        *best = Some((defect, bound));
    }
}

/// The fastest rate of what is elastic (1/s).
pub(crate) fn fastest_rate(model: &Model) -> f64 {
    let mut stiff = vec![[0.0; 2]; model.nodes.len()];
    for link in &model.links {
        let base = match link.base {
            LinkBase::Mass(base) => Some(base),
            LinkBase::Law { .. } => None,
        };
        for node in std::iter::once(link.mass).chain(base) {
            stiff[node][0] += link.stiffness;
            stiff[node][1] += link.damping;
        }
    }
    let rate = |(node, own): (&crate::dynamics::model::Node, &[f64; 2])| match node.inertia > 0.0 {
        true => (2.0 * own[0] / node.inertia).sqrt() + own[1] / node.inertia,
        false => 0.0,
    };
    model.nodes.iter().zip(&stiff).map(rate).fold(0.0, f64::max)
}

/// What a node does over a window.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Balance {
    /// Gain of momentum, and the momentum itself.
    gain: f64,
    momentum: f64,
    /// Means of forces, with and without those of links, and of their magnitudes.
    force: f64,
    outer: f64,
    size: f64,
    stiff: f64,
    /// Gain of speed.
    speeds: [f64; 2],
}

/// Greatest magnitudes over the looks of a run.
#[derive(Clone, Debug, Default)]
pub(super) struct Scales {
    /// Of every node: terms of its equation, momentum, links before they cancel.
    size: Vec<f64>,
    momentum: Vec<f64>,
    stiff: Vec<f64>,
    /// Displacement, speed and acceleration.
    pub(super) motion: Vec<[f64; 3]>,
    /// Of every object part: depth and force of its contact.
    pub(super) contact: Vec<[f64; 2]>,
    /// Of every state entry.
    pub(super) entries: Vec<f64>,
}

/// A check in the making.
pub(super) struct Judge<'s> {
    pub(super) system: &'s System,
    pub(super) mechanics: Mechanics<'s>,
    pub(super) scratch: Scratch,
    pub(super) asked: AuditScope,
    pub(super) scales: Scales,
    pub(super) found: EquationCheck,
    /// Names of nodes.
    pub(super) names: Vec<String>,
}

/// What is to be checked of a run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AuditScope {
    /// Tolerance of the run.
    pub(crate) tolerance: f64,
    /// True: what the records show of motions and forces, too.
    pub(crate) recorded: bool,
    /// True of a motion that is known in closed form, to rounding.
    pub(crate) closed: bool,
}

impl AuditScope {
    /// A bound on a share of terms.
    pub(crate) fn bound(&self) -> f64 {
        TOLERANCES * self.tolerance + LEAST
    }
}

impl<'s> Judge<'s> {
    pub(super) fn new(system: &'s System, asked: AuditScope) -> Self {
        let model = system.model();
        let count = model.nodes.len();
        let mut names = vec![String::new(); count];
        for part in model.objects.iter().rev() {
            for &node in part.nodes.iter().chain(&part.combination) {
                names[node].clone_from(&part.id);
            }
            if let Some(point) = part.contact.and_then(|contact| contact.point) {
                names[point].clone_from(&part.id);
            }
        }
        for load in &model.loads {
            if let Some([own, _]) = model.rubbing_nodes(load.node) {
                names[load.node] = names[own].clone();
            }
        }
        Self {
            system,
            mechanics: Mechanics::new(system),
            scratch: system.scratch(),
            asked,
            scales: Scales {
                size: vec![0.0; count],
                momentum: vec![0.0; count],
                stiff: vec![0.0; count],
                motion: vec![[0.0; 3]; count],
                contact: vec![[0.0; 2]; model.objects.len()],
                entries: vec![0.0; 2 * system.coordinates()],
            },
            found: EquationCheck {
                seed: SEED,
                ..EquationCheck::default()
            },
            names,
        }
    }

    /// Puts the states that were kept at drawn instants to the test.
    pub(super) fn judge_instants(&mut self, looks: &DrawnInstants, resolved: bool) {
        let longest: Vec<Vec<Balance>> = (looks.looks.iter())
            .map(|look| self.balance(look, &look.windows[0]))
            .collect();
        self.include_turns(looks);
        if resolved {
            self.include_resolution();
        }
        for (look, balance) in looks.looks.iter().zip(&longest) {
            self.judge(look, balance);
        }
    }

    /// Takes the greatest values of the run into the scales.
    pub(super) fn see_peaks(&mut self, peaks: &[[f64; 3]]) {
        let model = self.system.model();
        let scales = &mut self.scales;
        for (index, (part, [speed, acceleration, reaction])) in
            model.objects.iter().zip(peaks).enumerate()
        {
            for &node in &part.nodes {
                scales.size[node] = scales.size[node].max(*reaction);
            }
            scales.contact[index][1] = scales.contact[index][1].max(*reaction);
            if let Some(&node) = part.nodes.last() {
                let motion = &mut scales.motion[node];
                (motion[1], motion[2]) = (motion[1].max(*speed), motion[2].max(*acceleration));
            }
        }
    }

    /// A bound on a share of terms.
    pub(super) fn bound(&self) -> f64 {
        self.asked.bound()
    }

    /// Looks at a state, and takes it into the scales.
    pub(super) fn take_state(&mut self, time: f64, y: &[f64], modes: &[i64]) {
        self.mechanics.take_state(time, y, modes);
        for (greatest, at) in self.scales.motion.iter_mut().zip(&self.mechanics.nodes) {
            for (greatest, value) in greatest.iter_mut().zip(at.motion) {
                *greatest = greatest.max(value.abs());
            }
        }
        for pressed in &self.mechanics.pressed {
            let [depth, force] = &mut self.scales.contact[pressed.object];
            *depth = depth.max(pressed.size);
            *force = force.max(pressed.normal.abs());
        }
        for (greatest, value) in self.scales.entries.iter_mut().zip(y) {
            *greatest = greatest.max(value.abs());
        }
    }

    fn include_turns(&mut self, looks: &DrawnInstants) {
        for turn in &looks.turns {
            for (y, modes) in [
                (&turn.before, &turn.modes[0]),
                (&turn.after, &turn.modes[1]),
            ] {
                self.take_state(turn.time, y, &modes.0);
            }
        }
    }

    /// Takes into the scales what errors of a run are measured by: of bounces that die away
    /// no more is left than it resolves.
    fn include_resolution(&mut self) {
        let count = self.system.coordinates();
        let resolved = self.system.scales();
        for (coordinate, motion) in self.mechanics.coordinate.iter().zip(&self.scales.motion) {
            let Some(own) = *coordinate else {
                continue;
            };
            for (order, greatest) in motion.iter().take(2).enumerate() {
                let entry = &mut self.scales.entries[own + order * count];
                *entry = entry.max(resolved[own + order * count].min(*greatest));
            }
        }
        for (object, part) in self.system.model().objects.iter().enumerate() {
            let first = part
                .nodes
                .first()
                .and_then(|&node| self.mechanics.coordinate[node]);
            if let Some(own) = first.filter(|_| self.system.is_rigid_contact(object)) {
                let [depth, _] = &mut self.scales.contact[object];
                *depth = depth.max(self.scales.entries[own]);
            }
        }
    }

    /// Gains of momenta and integrals of forces over a window.
    fn balance(&mut self, look: &DrawnInstant, window: &Window) -> Vec<Balance> {
        let mut found = vec![Balance::default(); self.mechanics.nodes.len()];
        let last = window.times.len() - 1;
        for (k, (&time, y)) in window.times.iter().zip(&window.states).enumerate() {
            self.take_state(time, y, &look.modes.0);
            for (balance, at) in found.iter_mut().zip(&self.mechanics.nodes) {
                match k {
                    0 => balance.start_judging(at),
                    k if k == last => balance.end(at),
                    k => balance.add(at, WEIGHTS[k - 1]),
                }
            }
        }
        let length = window.length();
        for (node, balance) in found.iter().enumerate() {
            let size = balance.size + (balance.gain / length).abs();
            let scales = &mut self.scales;
            scales.size[node] = scales.size[node].max(size);
            scales.momentum[node] = scales.momentum[node].max(balance.momentum);
            scales.stiff[node] = scales.stiff[node].max(balance.stiff);
            if let Some(coordinate) = self.mechanics.coordinate[node] {
                let speed = self.scales.entries[self.system.coordinates() + coordinate];
                let own = self.system.model().nodes[node].inertia * speed;
                self.scales.momentum[node] = self.scales.momentum[node].max(own);
            }
        }
        found
    }

    /// What may be left open of a balance over a length, as a share of its terms.
    fn allowed_imbalance(&self, node: usize, length: f64) -> f64 {
        let scales = &self.scales;
        // (A closed form is known to rounding, whatever the tolerance.)
        let of_state = if self.asked.closed { 0.0 } else { OF_STATE };
        let of_state =
            of_state * self.asked.tolerance * (scales.momentum[node] / length + scales.stiff[node]);
        let rounding = ROUNDINGS * (scales.momentum[node] / length + scales.stiff[node]);
        self.bound() + (of_state + rounding) / scales.size[node]
    }

    fn judge(&mut self, look: &DrawnInstant, longest: &[Balance]) {
        if self.asked.recorded {
            self.judge_motions(look);
        }
        let mut best: Vec<Option<(f64, f64)>> = vec![None; longest.len()];
        for (k, window) in look.windows.iter().enumerate() {
            let own;
            let balances = match k {
                0 => longest,
                _ => {
                    own = self.balance(look, window);
                    &own
                }
            };
            let moments = self.moments(look, window);
            let mut open = false;
            for (node, best) in best.iter_mut().enumerate() {
                let length = window.length();
                let balance = (&balances[node], length);
                let Some(defect) = self.defect(node, balance, moments[node], look) else {
                    continue;
                };
                let bound = self.allowed_imbalance(node, length);
                keep_smaller_defect(best, (defect, bound));
                open |= best.is_some_and(|(d, b)| !(d <= b));
            }
            if !open {
                break;
            }
        }
        self.judge_contacts(look);
        self.judge_sums(look);
        let time = look.windows[0].middle();
        for (node, best) in best.iter().enumerate() {
            let on_driver = self.mechanics.coordinate[node].is_none();
            if self.is_sum_of_modes(node) || (on_driver && self.has_rigid_contacts()) {
                continue;
            }
            if let Some((defect, mut bound)) = *best {
                if !(defect <= bound) {
                    bound += self.sensitivity(node, look) / self.scales.size[node];
                }
                let what = match self.mechanics.coordinate[node] {
                    Some(_) => "equation of motion",
                    None => "force on the driver",
                };
                self.found
                    .include(defect, bound, (time, &self.names[node]), what);
            }
        }
    }

    /// What the force on a coordinate changes by when its state is off by as much as the
    /// tolerance allows: much, where friction is steep.
    fn sensitivity(&mut self, node: usize, look: &DrawnInstant) -> f64 {
        let Some(own) = self.mechanics.coordinate[node].filter(|_| !self.asked.closed) else {
            return 0.0;
        };
        let window = &look.windows[0];
        let entries = [own, self.system.coordinates() + own];
        let mut mean = 0.0;
        let inner = window.times.iter().zip(&window.states).skip(1);
        for ((&time, y), weight) in inner.zip(WEIGHTS) {
            let mut force = |y: &[f64]| {
                self.mechanics.take_state(time, y, &look.modes.0);
                self.mechanics.nodes[node].force + self.mechanics.nodes[node].link
            };
            let here = force(y);
            for entry in entries {
                let off = OF_STATE * self.asked.tolerance * self.system.error_size(entry, y[entry]);
                for sign in [1.0, -1.0] {
                    let mut moved = y.clone();
                    moved[entry] += sign * off;
                    mean += 0.5 * weight * (force(&moved) - here).abs();
                }
            }
        }
        mean
    }

    /// The force that moves each prescribed node, and that with which each rigid node pulls at
    /// its law, as records have them: means over a window.
    fn moments(&mut self, look: &DrawnInstant, window: &Window) -> Vec<Option<f64>> {
        let model = self.system.model();
        let mut found = vec![None; model.nodes.len()];
        if !self.asked.recorded {
            return found;
        }
        let mut states = vec![ObjectState::default(); model.objects.len()];
        let inner = window.times.iter().zip(&window.states).skip(1);
        for ((&time, y), weight) in inner.zip(WEIGHTS) {
            (self.system).observe(time, y, &look.modes, &mut self.scratch, &mut states);
            for (part, state) in model.objects.iter().zip(&states) {
                let Some(&node) = part.nodes.last() else {
                    continue;
                };
                let sign = match model.nodes[node].motion {
                    NodeMotion::Prescribed { .. } => 1.0,
                    NodeMotion::Rigid { .. } => -1.0,
                    NodeMotion::Rotor { .. }
                    | NodeMotion::Mass { .. }
                    | NodeMotion::Constrained { .. } => continue,
                };
                *found[node].get_or_insert(0.0) += sign * weight * state.reaction;
            }
        }
        found
    }

    /// Defect of the equation of a coordinate, as a share of its terms; `None` where there
    /// is none, or nothing acts.
    fn defect(
        &self,
        node: usize,
        (balance, length): (&Balance, f64),
        moment: Option<f64>,
        look: &DrawnInstant,
    ) -> Option<f64> {
        if self.mechanics.no_force[node].is_some() {
            return None;
        }
        let size = self.scales.size[node];
        let open = match (self.mechanics.coordinate[node], moment) {
            (Some(_), _) if self.is_held(node, look) => return None,
            (Some(_), _) => balance.gain / length - balance.force,
            (None, Some(moment)) => balance.gain / length - balance.outer - moment,
            (None, None) => return None,
        };
        (size > 0.0).then(|| open.abs() / size)
    }

    /// True of a mass whose rigid contact holds, of its pair or of one of its stops.
    fn is_held(&self, node: usize, look: &DrawnInstant) -> bool {
        let model = self.system.model();
        let holds = |part: usize| {
            let rigid = self.system.is_rigid_contact(part);
            let component = self.system.pair_component(part);
            rigid && component.is_some_and(|component| look.modes.0[component] != 0)
        };
        let parts = 0..model.objects.len();
        let mut own = parts.filter(|&part| model.objects[part].nodes.contains(&node));
        own.any(holds)
    }

    /// Contacts press where they are engaged, and are clear of their flanks where they are
    /// open.
    fn judge_contacts(&mut self, look: &DrawnInstant) {
        let window = &look.windows[0];
        for (&time, y) in window.times.iter().zip(&window.states).skip(1).step_by(3) {
            self.take_state(time, y, &look.modes.0);
            for k in 0..self.mechanics.pressed.len() {
                let pressed = self.mechanics.pressed[k];
                if pressed.component.is_none() {
                    continue;
                }
                let [depth, force] = self.scales.contact[pressed.object];
                let share = |value: f64, of: f64| if of > 0.0 { value / of } else { 0.0 };
                let held_off = share(pressed.held_off[0], depth).min(match pressed.restitution {
                    Some(_) => f64::INFINITY,
                    None => share(pressed.held_off[1], force),
                });
                let place = (time, &*self.system.model().objects[pressed.object].id);
                let bound = self.bound();
                let found = &mut self.found;
                found.include(held_off, bound, place, "clearance of the open contact");
                if !pressed.holds && pressed.mode != 0 {
                    let pulled = share(-pressed.normal, force).max(0.0);
                    found.include(pulled, bound, place, "pressure of the closed contact");
                    let hollow = share(-pressed.depth, depth).max(0.0);
                    found.include(hollow, bound, place, "depth of the closed contact");
                }
                if pressed.holds {
                    let apart = share(pressed.depth.abs(), depth);
                    found.include(apart, bound, place, "depth of the contact that is held");
                }
            }
        }
    }

    /// Motions and forces as the records have them, against those of the scene.
    fn judge_motions(&mut self, look: &DrawnInstant) {
        let model = self.system.model();
        let window = &look.windows[0];
        let middle = PLACES.len() / 2;
        let (time, y) = (window.times[middle], &window.states[middle]);
        let mut states = vec![ObjectState::default(); model.objects.len()];
        (self.system).observe(time, y, &look.modes, &mut self.scratch, &mut states);
        self.take_state(time, y, &look.modes.0);
        for (part, state) in model.objects.iter().zip(&states) {
            let Some(&node) = part.nodes.last() else {
                continue;
            };
            if self.is_sum_of_modes(node) {
                continue;
            }
            let shown = model.multi_linkages.iter().any(|multi| multi.node == node);
            if shown || self.mechanics.no_motion[node].is_some() {
                continue;
            }
            self.judge_force(part, state, time);
            let (own, greatest) = (self.mechanics.nodes[node].motion, self.scales.motion[node]);
            let given = self.is_given(node);
            let pairs = [
                (state.displacement, "displacement"),
                (state.speed, "speed"),
                (state.acceleration, "acceleration"),
            ];
            for (k, (shown, what)) in pairs.into_iter().enumerate() {
                if (k == 2 && !given) || greatest[k] == 0.0 {
                    continue;
                }
                let unsure = k
                    .checked_sub(1)
                    .map_or(0.0, |k| self.mechanics.nodes[node].unsure[k]);
                let bound = LEAST + unsure / greatest[k];
                let defect = (shown - own[k]).abs() / greatest[k];
                self.found.include(defect, bound, (time, &part.id), what);
            }
        }
    }

    /// The force of link 1 of an object, or of its stop, as the records have it.
    fn judge_force(&mut self, part: &ObjectPart, state: &ObjectState, time: f64) {
        let model = self.system.model();
        // (Behind a massless point forces are taken from the balance there.)
        let point = part.contact.is_some_and(|contact| contact.point.is_some());
        if point || part.driven_end.is_some() {
            return;
        }
        let own = |object: usize| std::ptr::eq(part, &raw const model.objects[object]);
        let mut all = self.mechanics.pressed.iter();
        let Some(pressed) = all.find(|pressed| own(pressed.object) && !pressed.holds) else {
            return;
        };
        let greatest = self.scales.contact[pressed.object][1];
        let is_stop = model.stops.iter().any(|stop| stop.part == pressed.object);
        let shown = match is_stop {
            true => state.contact_force - pressed.normal.max(0.0),
            false => state.reaction - pressed.force,
        };
        if greatest > 0.0 {
            let bound = LEAST + self.asked.tolerance;
            let defect = shown.abs() / greatest;
            self.found.include(
                defect,
                bound,
                (time, &part.id),
                "force of the driving contact",
            );
        }
    }

    /// True where a contact is rigid: what it bears while it holds is no function of the
    /// state, and the forces on drivers are not known from it.
    fn has_rigid_contacts(&self) -> bool {
        let mut parts = 0..self.system.model().objects.len();
        parts.any(|part| self.system.is_rigid_contact(part))
    }

    /// True of the output of an object that is reduced to modes: it is their sum with a rest
    /// that no law of the scene states.
    fn is_sum_of_modes(&self, node: usize) -> bool {
        let model = self.system.model();
        let mut all = model.reduced.iter();
        all.any(|reduced| model.objects[reduced.object].nodes.contains(&node))
    }

    /// True where the motion of a node is prescribed.
    fn is_given(&self, node: usize) -> bool {
        match &self.system.model().nodes[node].motion {
            NodeMotion::Prescribed { .. } => true,
            NodeMotion::Rotor { .. } | NodeMotion::Mass { .. } => false,
            NodeMotion::Rigid { law } => self.is_given(law.driver),
            NodeMotion::Constrained { drivers, .. } => {
                drivers.iter().all(|&driver| self.is_given(driver))
            }
        }
    }

    pub(super) fn finish(self, looks: &DrawnInstants) -> EquationCheck {
        let rigid = self.has_rigid_contacts();
        let mut found = self.found;
        found.instants = looks.looks.len();
        found.switches = looks.turns.len();
        let unknown = |node: usize| {
            let own = &self.mechanics;
            own.no_force[node].or(own.no_motion[node])
        };
        for (node, name) in self.names.iter().enumerate() {
            if let Some(why) = unknown(node) {
                found.unchecked.push(format!("{name}: {why}"));
            }
        }
        if rigid {
            let what = "forces on drivers: no state shows the force of a rigid contact";
            found.unchecked.push(what.to_owned());
        }
        for reduced in &self.system.model().reduced {
            let id = &self.system.model().objects[reduced.object].id;
            found.unchecked.push(format!(
                "{id}: the displacement of its output, the sum of its modes"
            ));
        }
        found.unchecked.dedup();
        found
    }
}

impl Window {
    pub(super) fn length(&self) -> f64 {
        self.times[self.times.len() - 1] - self.times[0]
    }

    pub(super) fn middle(&self) -> f64 {
        0.5 * (self.times[self.times.len() - 1] + self.times[0])
    }
}

impl Balance {
    fn start_judging(&mut self, at: &At) {
        (self.gain, self.momentum) = (-at.momentum, at.momentum.abs());
        self.speeds[0] = at.motion[1];
    }

    fn add(&mut self, at: &At, weight: f64) {
        self.force += weight * (at.force + at.link);
        self.outer += weight * at.force;
        self.size += weight * at.size;
        self.stiff += weight * at.stiff;
    }

    fn end(&mut self, at: &At) {
        self.gain += at.momentum;
        self.momentum = self.momentum.max(at.momentum.abs());
        self.speeds[1] = at.motion[1];
    }
}
