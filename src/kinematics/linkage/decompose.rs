//! Decomposition into Assur groups.
//!
//! Each pair gives two equations, each body needs three. The equations are
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

/// A pair between two bodies; `None`: what is placed already.
pub(super) type Edge = [Option<usize>; 2];

/// Equations a body needs.
const NEEDED: usize = 3;

/// Result of the count of equations.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Decomposition {
    /// The groups in order of solution, each a list of bodies, ascending.
    Groups(Vec<Vec<usize>>),
    /// The numbers of equations and unknowns do not fit.
    Unfit {
        /// Bodies that are held more than once (with the pairs that hold them).
        held: Vec<Held>,
        /// Bodies that are free to move with the driver standing still.
        free: Vec<usize>,
    },
}

/// Who was given the equations of a pair.
struct Handing<'a> {
    edges: &'a [Edge],
    /// Two equations of every pair: the body that has it.
    owner: Vec<[Option<usize>; 2]>,
    /// Number of equations of every body.
    count: Vec<usize>,
    /// Number of equations that every body needs.
    needed: Vec<usize>,
}

/// Bodies that are held more than once, and the pairs that hold them.
pub(super) type Held = (Vec<usize>, Vec<usize>);

/// Splits `bodies` joined by `edges` into groups.
pub(super) fn decompose(bodies: usize, edges: &[Edge]) -> Decomposition {
    let mut handing = Handing::new(edges, vec![NEEDED; bodies]);
    let mut held = handing.hand_out();
    let free = handing.free();
    if held.is_empty() && free.is_empty() {
        held.extend(held_among_themselves(bodies, edges));
    }
    if !held.is_empty() || !free.is_empty() {
        held.dedup();
        return Decomposition::Unfit { held, free };
    }
    Decomposition::Groups(groups(&handing.dependencies()))
}

/// A part with more equations among its own bodies than hold them together.
fn held_among_themselves(bodies: usize, edges: &[Edge]) -> Option<Held> {
    let inner = |edge: &Edge| match *edge {
        [Some(_), Some(_)] => *edge,
        _ => [None, None],
    };
    let edges: Vec<Edge> = edges.iter().map(inner).collect();
    (0..bodies).find_map(|body| {
        let mut needed = vec![NEEDED; bodies];
        needed[body] = 0;
        let held = Handing::new(&edges, needed).hand_out();
        // Nobody takes the equations of the pairs that are left out.
        held.into_iter().find(|(bodies, _)| !bodies.is_empty())
    })
}

impl<'a> Handing<'a> {
    fn new(edges: &'a [Edge], needed: Vec<usize>) -> Self {
        Self {
            edges,
            owner: vec![[None; 2]; edges.len()],
            count: vec![0; needed.len()],
            needed,
        }
    }
}

impl Handing<'_> {
    /// Hands out all equations; what holds a part more than once.
    fn hand_out(&mut self) -> Vec<Held> {
        let mut held = Vec::new();
        for edge in 0..self.edges.len() {
            for unit in 0..2 {
                let mut seen = vec![false; self.count.len()];
                let ends = self.edges[edge];
                let mut ends = ends.iter().flatten().copied();
                match ends.find(|&body| self.make_room(body, &mut seen)) {
                    Some(body) => {
                        self.owner[edge][unit] = Some(body);
                        self.count[body] += 1;
                    }
                    None => held.push(self.held_by(&seen, edge)),
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
        for edge in 0..self.edges.len() {
            for unit in 0..2 {
                if self.owner[edge][unit] != Some(body) {
                    continue;
                }
                let Some(other) = self.other(edge, body) else {
                    continue;
                };
                if self.make_room(other, seen) {
                    self.owner[edge][unit] = Some(other);
                    self.count[other] += 1;
                    self.count[body] -= 1;
                    return true;
                }
            }
        }
        false
    }

    fn other(&self, edge: usize, body: usize) -> Option<usize> {
        let [a, b] = self.edges[edge];
        if a == Some(body) { b } else { a }
    }

    /// The bodies that could not make room, and the pairs that fill them.
    fn held_by(&self, seen: &[bool], edge: usize) -> Held {
        let bodies: Vec<usize> = (0..seen.len()).filter(|&body| seen[body]).collect();
        let inside = |edge: &Edge| edge.iter().flatten().all(|&body| seen[body]);
        let mut pairs: Vec<usize> = (0..self.edges.len())
            .filter(|&index| {
                let given = self.owner[index].iter().any(Option::is_some);
                given && inside(&self.edges[index]) && self.edges[index] != [None, None]
            })
            .collect();
        if !pairs.contains(&edge) {
            pairs.push(edge);
        }
        pairs.sort_unstable();
        (bodies, pairs)
    }

    /// Bodies with too few equations, and those from which they could take one.
    fn free(&self) -> Vec<usize> {
        let counts = self.count.iter().zip(&self.needed);
        let mut free: Vec<bool> = counts.map(|(count, needed)| count < needed).collect();
        let mut grew = true;
        while grew {
            grew = false;
            for (edge, owner) in self.edges.iter().zip(&self.owner) {
                let [Some(a), Some(b)] = *edge else { continue };
                for (taker, giver) in [(a, b), (b, a)] {
                    if free[taker] && !free[giver] && owner.contains(&Some(giver)) {
                        free[giver] = true;
                        grew = true;
                    }
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
                dependencies[*body].extend(self.other(index, *body));
            }
        }
        dependencies
    }
}

/// Sets of bodies that depend on each other, in an order in which each depends
/// only on those before it; of several possible ones that with the lowest body.
fn groups(dependencies: &[Vec<usize>]) -> Vec<Vec<usize>> {
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
    use super::{Decomposition, decompose};

    const PLACED: Option<usize> = None;

    #[test]
    fn dyads_come_one_after_the_other() {
        // Two dyads, the second (0, 1) standing on the first (2, 3).
        let edges = [
            [PLACED, Some(2)],
            [Some(2), Some(3)],
            [Some(3), PLACED],
            [Some(3), Some(0)],
            [Some(0), Some(1)],
            [Some(1), PLACED],
        ];
        let wanted = Decomposition::Groups(vec![vec![2, 3], vec![0, 1]]);
        assert_eq!(decompose(4, &edges), wanted);
    }

    #[test]
    fn a_triad_stays_together() {
        // One body with three pins, a lever on each.
        let edges = [
            [PLACED, Some(1)],
            [PLACED, Some(2)],
            [PLACED, Some(3)],
            [Some(0), Some(1)],
            [Some(0), Some(2)],
            [Some(0), Some(3)],
        ];
        let wanted = Decomposition::Groups(vec![vec![0, 1, 2, 3]]);
        assert_eq!(decompose(4, &edges), wanted);
    }

    #[test]
    fn a_rigid_part_and_a_loose_part_are_named() {
        // Body 0 is pinned twice to the ground, bodies 1 to 3 form an open chain.
        let edges = [
            [PLACED, Some(0)],
            [Some(0), PLACED],
            [PLACED, Some(1)],
            [Some(1), Some(2)],
            [Some(2), Some(3)],
            [Some(3), PLACED],
        ];
        let Decomposition::Unfit { held, free } = decompose(4, &edges) else {
            panic!("it does not fit");
        };
        assert_eq!(held, [(vec![0], vec![0, 1])]);
        assert_eq!(free, [1, 2, 3]);
    }

    #[test]
    fn a_part_that_is_held_more_than_once_by_itself_is_named() {
        // Bodies 1 and 2 are pinned together twice; the count of all fits.
        let edges = [
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
        assert_eq!(decompose(4, &edges), wanted);
    }
}
