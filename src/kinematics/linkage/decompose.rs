//! Decomposition into Assur groups.
//!
//! Each pair gives two equations, each coupling of wheels one, each body needs
//! three. The equations are
//! handed out to the bodies they join, moving them along chains of bodies where
//! one has too many and another too few (a maximum flow). What cannot be handed
//! out holds a part of the linkage more than once, what is missing leaves a part
//! free. When everything fits, a body depends on the bodies at the other ends of
//! the pairs whose equations it was given; bodies that depend on each other form
//! one Assur group, whichever way the equations were handed out.
//!
//! A part that can be moved as a whole has at most three equations among its own
//! bodies for each of them but one. That is asked for every body in turn, as if it
//! were the one, with the pairs to what is placed left out.

/// What ties bodies together: a pair, or a coupling of wheels.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tie {
    /// The bodies, each once; of what is placed already nothing is said.
    bodies: Vec<usize>,
    /// One of its links is placed already.
    placed: bool,
    /// Equations that it gives.
    equations: usize,
}

impl Tie {
    /// A pair between two bodies; `None`: what is placed already.
    pub(super) fn pair(ends: [Option<usize>; 2]) -> Self {
        Self::new(&ends, 2)
    }

    /// A coupling between these bodies.
    pub(super) fn coupling(ends: [Option<usize>; 3]) -> Self {
        Self::new(&ends, 1)
    }

    fn new(ends: &[Option<usize>], equations: usize) -> Self {
        let mut bodies: Vec<usize> = ends.iter().flatten().copied().collect();
        bodies.sort_unstable();
        bodies.dedup();
        Self {
            bodies,
            placed: ends.contains(&None),
            equations,
        }
    }

    /// True when it belongs to this group: it touches it, and no group after it.
    pub(super) fn belongs_to(&self, group: &[usize], groups: &[Vec<usize>]) -> bool {
        let place = |body: usize| groups.iter().position(|group| group.contains(&body));
        let here = group.first().and_then(|&body| place(body));
        self.bodies.iter().any(|body| group.contains(body))
            && self.bodies.iter().all(|&body| place(body) <= here)
    }
}

/// Equations a body needs.
const NEEDED: usize = 3;

/// Result of the count of equations.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Decomposition {
    /// The groups in order of solution, each a list of bodies, ascending.
    Groups(Vec<Vec<usize>>),
    /// The numbers of equations and unknowns do not fit.
    Unfit {
        /// Bodies that are held more than once (with the ties that hold them).
        held: Vec<Held>,
        /// Bodies that are free to move with the driver standing still.
        free: Vec<usize>,
    },
}

/// Who was given the equations of a tie.
struct TieAssignment<'a> {
    ties: &'a [Tie],
    /// Of every equation of every tie the body that has it.
    owner: Vec<Vec<Option<usize>>>,
    /// Number of equations of every body.
    count: Vec<usize>,
    /// Number of equations that every body needs.
    needed: Vec<usize>,
}

/// Bodies that are held more than once, and the ties that hold them.
pub(super) type Held = (Vec<usize>, Vec<usize>);

/// Splits `bodies` joined by `ties` into groups.
pub(super) fn decompose(bodies: usize, ties: &[Tie]) -> Decomposition {
    let mut handing = TieAssignment::new(ties, vec![NEEDED; bodies]);
    let mut held = handing.hand_out();
    let free = handing.underdetermined_bodies();
    if held.is_empty() && free.is_empty() {
        held.extend(overconstrained_part(bodies, ties));
    }
    if !held.is_empty() || !free.is_empty() {
        held.dedup();
        return Decomposition::Unfit { held, free };
    }
    Decomposition::Groups(dependent_groups(&handing.dependencies()))
}

/// A part with more equations among its own bodies than hold them together.
fn overconstrained_part(bodies: usize, ties: &[Tie]) -> Option<Held> {
    let inner = |tie: &Tie| match tie.placed {
        false => tie.clone(),
        true => Tie::new(&[], tie.equations),
    };
    let ties: Vec<Tie> = ties.iter().map(inner).collect();
    (0..bodies).find_map(|body| {
        let mut needed = vec![NEEDED; bodies];
        needed[body] = 0;
        let held = TieAssignment::new(&ties, needed).hand_out();
        // Nobody takes the equations of the ties that are left out.
        held.into_iter().find(|(bodies, _)| !bodies.is_empty())
    })
}

impl<'a> TieAssignment<'a> {
    fn new(ties: &'a [Tie], needed: Vec<usize>) -> Self {
        Self {
            ties,
            owner: ties.iter().map(|tie| vec![None; tie.equations]).collect(),
            count: vec![0; needed.len()],
            needed,
        }
    }
}

impl TieAssignment<'_> {
    /// Hands out all equations; what holds a part more than once.
    fn hand_out(&mut self) -> Vec<Held> {
        let mut held = Vec::new();
        for (tie, given) in self.ties.iter().enumerate() {
            for unit in 0..given.equations {
                let mut seen = vec![false; self.count.len()];
                let mut ends = given.bodies.iter().copied();
                match ends.find(|&body| self.make_room(body, &mut seen)) {
                    Some(body) => {
                        self.owner[tie][unit] = Some(body);
                        self.count[body] += 1;
                    }
                    None => held.push(self.held_by(&seen, tie)),
                }
            }
        }
        held
    }

    /// Frees one place at `body` by moving an equation on; true when it has one.
    fn make_room(&mut self, body: usize, seen: &mut [bool]) -> bool {
        if seen[body] {
            return false;
        }
        seen[body] = true;
        if self.count[body] < self.needed[body] {
            return true;
        }
        let ties = self.ties;
        for (tie, given) in ties.iter().enumerate() {
            for unit in 0..given.equations {
                if self.owner[tie][unit] != Some(body) {
                    continue;
                }
                let mut others = given.bodies.iter().filter(|&&other| other != body);
                if let Some(&other) = others.find(|&&other| self.make_room(other, seen)) {
                    self.owner[tie][unit] = Some(other);
                    self.count[other] += 1;
                    self.count[body] -= 1;
                    return true;
                }
            }
        }
        false
    }

    /// The bodies that could not make room, and the ties that fill them.
    fn held_by(&self, seen: &[bool], tie: usize) -> Held {
        let bodies: Vec<usize> = (0..seen.len()).filter(|&body| seen[body]).collect();
        let inside = |tie: &Tie| tie.bodies.iter().all(|&body| seen[body]);
        let mut ties: Vec<usize> = (0..self.ties.len())
            .filter(|&index| {
                let given = self.owner[index].iter().any(Option::is_some);
                given && inside(&self.ties[index]) && !self.ties[index].bodies.is_empty()
            })
            .collect();
        if !ties.contains(&tie) {
            ties.push(tie);
        }
        ties.sort_unstable();
        (bodies, ties)
    }

    /// Bodies with too few equations, and those from which they could take one.
    fn underdetermined_bodies(&self) -> Vec<usize> {
        let counts = self.count.iter().zip(&self.needed);
        let mut free: Vec<bool> = counts.map(|(count, needed)| count < needed).collect();
        let mut grew = true;
        while grew {
            grew = false;
            for (tie, owner) in self.ties.iter().zip(&self.owner) {
                if !tie.bodies.iter().any(|&taker| free[taker]) {
                    continue;
                }
                for giver in owner.iter().flatten() {
                    grew |= !std::mem::replace(&mut free[*giver], true);
                }
            }
        }
        (0..free.len()).filter(|&body| free[body]).collect()
    }

    /// For every body the bodies it depends on.
    fn dependencies(&self) -> Vec<Vec<usize>> {
        let mut dependencies = vec![Vec::new(); self.count.len()];
        for (index, owner) in self.owner.iter().enumerate() {
            for body in owner.iter().flatten() {
                let others = self.ties[index].bodies.iter();
                dependencies[*body].extend(others.filter(|other| *other != body));
            }
        }
        dependencies
    }
}

/// Sets of bodies that depend on each other, in an order in which each depends
/// only on those before it; of several possible ones that with the lowest body.
fn dependent_groups(dependencies: &[Vec<usize>]) -> Vec<Vec<usize>> {
    let count = dependencies.len();
    let reach: Vec<Vec<bool>> = (0..count)
        .map(|from| {
            let mut seen = vec![false; count];
            let mut open = vec![from];
            while let Some(body) = open.pop() {
                if !std::mem::replace(&mut seen[body], true) {
                    open.extend(&dependencies[body]);
                }
            }
            seen
        })
        .collect();
    let mut done = vec![false; count];
    let mut groups = Vec::new();
    while let Some(next) = (0..count).find(|&body| {
        let ready = |other: usize| !reach[body][other] || done[other] || reach[other][body];
        !done[body] && (0..count).all(ready)
    }) {
        let group: Vec<usize> = (0..count)
            .filter(|&other| reach[next][other] && reach[other][next])
            .collect();
        for &body in &group {
            done[body] = true;
        }
        groups.push(group);
    }
    groups
}

#[cfg(test)]
mod tests {
    use super::{Decomposition, Tie, decompose};

    const PLACED: Option<usize> = None;

    #[test]
    fn dyads_come_one_after_the_other() {
        // Two dyads, the second (0, 1) standing on the first (2, 3).
        let pairs = [
            [PLACED, Some(2)],
            [Some(2), Some(3)],
            [Some(3), PLACED],
            [Some(3), Some(0)],
            [Some(0), Some(1)],
            [Some(1), PLACED],
        ];
        let wanted = Decomposition::Groups(vec![vec![2, 3], vec![0, 1]]);
        assert_eq!(decompose(4, &pairs.map(Tie::pair)), wanted);
    }

    #[test]
    fn a_triad_stays_together() {
        // One body with three pins, a lever on each.
        let pairs = [
            [PLACED, Some(1)],
            [PLACED, Some(2)],
            [PLACED, Some(3)],
            [Some(0), Some(1)],
            [Some(0), Some(2)],
            [Some(0), Some(3)],
        ];
        let wanted = Decomposition::Groups(vec![vec![0, 1, 2, 3]]);
        assert_eq!(decompose(4, &pairs.map(Tie::pair)), wanted);
    }

    #[test]
    fn a_rigid_part_and_a_loose_part_are_named() {
        // Body 0 is pinned twice to the ground, bodies 1 to 3 form an open chain.
        let pairs = [
            [PLACED, Some(0)],
            [Some(0), PLACED],
            [PLACED, Some(1)],
            [Some(1), Some(2)],
            [Some(2), Some(3)],
            [Some(3), PLACED],
        ];
        let Decomposition::Unfit { held, free } = decompose(4, &pairs.map(Tie::pair)) else {
            panic!("it does not fit");
        };
        assert_eq!(held, [(vec![0], vec![0, 1])]);
        assert_eq!(free, [1, 2, 3]);
    }

    #[test]
    fn a_part_that_is_held_more_than_once_by_itself_is_named() {
        // Bodies 1 and 2 are pinned together twice; the count of all fits.
        let pairs = [
            [PLACED, Some(0)],
            [Some(0), Some(1)],
            [Some(1), Some(2)],
            [Some(2), Some(1)],
            [Some(2), Some(3)],
            [Some(3), PLACED],
        ];
        let wanted = Decomposition::Unfit {
            held: vec![(vec![1, 2], vec![2, 3])],
            free: Vec::new(),
        };
        assert_eq!(decompose(4, &pairs.map(Tie::pair)), wanted);
    }

    #[test]
    fn couplings_order_what_they_tie() {
        // Two wheels on pins of what is placed: 1 meshes with what is placed, 0 with 1.
        let mut ties = [[PLACED, Some(0)], [PLACED, Some(1)]]
            .map(Tie::pair)
            .to_vec();
        ties.push(Tie::coupling([PLACED, Some(1), Some(0)]));
        let loose = Decomposition::Unfit {
            held: Vec::new(),
            free: vec![0, 1],
        };
        assert_eq!(decompose(2, &ties), loose);
        ties.push(Tie::coupling([PLACED, PLACED, Some(1)]));
        let wanted = Decomposition::Groups(vec![vec![1], vec![0]]);
        assert_eq!(decompose(2, &ties), wanted);
        ties.push(Tie::coupling([PLACED, PLACED, Some(0)]));
        let held = Decomposition::Unfit {
            held: vec![(vec![0, 1], vec![0, 1, 2, 3, 4])],
            free: Vec::new(),
        };
        assert_eq!(decompose(2, &ties), held);
    }
}
