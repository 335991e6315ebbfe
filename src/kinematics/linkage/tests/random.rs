//! Random linkages of dyads: loop closure, transfer functions against
//! differences, reduced inertia against kinetic energy.

use super::examples::{Builder, GROUND};
use super::support::{close, closure_error, compare_with_differences, interior};
use crate::kinematics::linkage::spec::{AssemblyChoice, ForceLaw, PointOf};
use crate::kinematics::linkage::{Cause, GroupKind, Linkage, Reach};
use proptest::prelude::*;

/// A small generator, so that a case is one number.
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.next()
    }

    fn below(&mut self, count: usize) -> usize {
        ((self.next() * count as f64) as usize).min(count - 1)
    }

    fn place(&mut self) -> [f64; 2] {
        [self.between(-1.0, 1.0), self.between(-1.0, 1.0)]
    }
}

/// Poses (x, y, θ) of all links at the start, chosen before anything else.
struct Drawing {
    poses: Vec<[f64; 3]>,
    dice: Dice,
}

impl Drawing {
    fn pose(&self, link: Option<usize>) -> [f64; 3] {
        link.map_or([0.0; 3], |link| self.poses[link])
    }

    /// A place seen from a link.
    fn local(&self, link: Option<usize>, at: [f64; 2]) -> (Option<usize>, [f64; 2]) {
        let [x, y, angle] = self.pose(link);
        let (sin, cos) = angle.sin_cos();
        let (dx, dy) = (at[0] - x, at[1] - y);
        (link, [cos * dx + sin * dy, cos * dy - sin * dx])
    }

    fn pin(&mut self, builder: Builder, i: Option<usize>, j: Option<usize>) -> Builder {
        let at = self.dice.place();
        builder.pin(self.local(i, at), self.local(j, at))
    }

    fn slide(&mut self, builder: Builder, i: Option<usize>, j: Option<usize>) -> (Builder, f64) {
        let (at, psi) = (self.dice.place(), self.dice.between(-3.0, 3.0));
        let ahead = self.dice.between(-0.5, 0.5);
        let block = [at[0] + ahead * psi.cos(), at[1] + ahead * psi.sin()];
        let (direction, angle) = (psi - self.pose(i)[2], self.pose(j)[2] - psi);
        let builder = builder.slide(self.local(i, at), self.local(j, block), direction, angle);
        (builder, ahead)
    }

    fn any(
        &mut self,
        builder: Builder,
        i: Option<usize>,
        j: Option<usize>,
        slides: bool,
    ) -> Builder {
        let (i, j) = if self.dice.next() < 0.5 {
            (i, j)
        } else {
            (j, i)
        };
        if slides {
            self.slide(builder, i, j).0
        } else {
            self.pin(builder, i, j)
        }
    }
}

/// Slides of outer, inner, outer pair.
pub(super) const FORMS: [[bool; 3]; 7] = [
    [false, false, false],
    [false, false, true],
    [true, false, false],
    [false, true, false],
    [true, false, true],
    [false, true, true],
    [true, true, false],
];

/// A linkage of `dyads` dyads, driven on the ground or between two moving links.
pub(super) fn linkage(seed: u64, dyads: usize, forms: &[[bool; 3]]) -> Builder {
    let mut dice = Dice(seed);
    let driven_assembly = dice.next() < 0.3;
    let first = if driven_assembly { 2 } else { 1 };
    // An assembly of two links takes the place of one body of the first dyad.
    let links = 2 * dyads + 1;
    let poses: Vec<[f64; 3]> = (0..links)
        .map(|_| {
            let [x, y] = dice.place();
            [x, y, dice.between(-3.0, 3.0)]
        })
        .collect();
    let names: Vec<String> = (0..links).map(|link| format!("l{link}")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let mut builder = Builder::new(&names);
    let mut drawing = Drawing { poses, dice };
    let on = if driven_assembly { Some(0) } else { GROUND };
    let to = Some(first - 1);
    let (on, to) = if drawing.dice.next() < 0.5 {
        (on, to)
    } else {
        (to, on)
    };
    let start;
    if drawing.dice.next() < 0.6 {
        start = drawing.pose(to)[2] - drawing.pose(on)[2];
        builder = drawing.pin(builder, on, to);
    } else {
        (builder, start) = drawing.slide(builder, on, to);
    }
    let mut placed = if driven_assembly { 0 } else { 1 };
    for dyad in 0..dyads {
        let form = forms[drawing.dice.below(forms.len())];
        let known = |drawing: &mut Drawing| {
            let pick = drawing.dice.below(placed + 1);
            if pick == placed { GROUND } else { Some(pick) }
        };
        // The pair of outer bodies must not be one and the same.
        let (mut one, other) = (known(&mut drawing), known(&mut drawing));
        if one == other && placed > 0 {
            one = if other.is_none() {
                Some(placed - 1)
            } else {
                GROUND
            };
        }
        let assembly = driven_assembly && dyad == 0;
        let (first, second) = if assembly {
            ([0, 1], 2)
        } else {
            ([placed; 2], placed + 1)
        };
        let turn = drawing.dice.below(2);
        builder = drawing.any(builder, one, Some(first[turn]), form[0]);
        let inner = first[1 - turn];
        builder = drawing.any(builder, Some(inner), Some(second), form[1]);
        builder = drawing.any(builder, Some(second), other, form[2]);
        placed = second + 1;
    }
    for link in 0..links {
        let angle = drawing.poses[link][2];
        let dice = &mut drawing.dice;
        let (mass, moment) = (dice.between(0.1, 2.0), dice.between(0.01, 0.5));
        let centre = dice.place();
        builder = builder
            .mass(link, mass, centre, moment)
            .choose(link, AssemblyChoice::Angle(angle))
            .force(ForceLaw::Strut {
                from: PointOf {
                    link: GROUND,
                    at: [2.0, -1.5],
                },
                to: PointOf {
                    link: Some(link),
                    at: centre,
                },
                rate: 3.0,
                free_length: 0.7,
                damping: 0.4,
                force: -1.7,
            })
            .force(ForceLaw::Force {
                point: PointOf {
                    link: Some(link),
                    at: [0.3, -0.2],
                },
                force: [0.7, -1.1],
                follows: link % 2 == 0,
            })
            .force(ForceLaw::Couple { link, couple: 0.6 });
    }
    builder.0.gravity = [1.3, -9.81];
    builder.start(start)
}

/// Loops of sliding pairs and dyads that were drawn nearly singular are refused.
fn is_fair(linkage: Result<Linkage, Vec<crate::fault::Fault>>) -> Option<Linkage> {
    linkage.ok()
}

#[test]
fn most_random_linkages_are_assembled_and_every_dyad_occurs() {
    let mut kinds = Vec::new();
    let mut refused = 0;
    for seed in 0..150 {
        match is_fair(Linkage::new(linkage(seed, 3, &FORMS).0)) {
            Some(linkage) => {
                kinds.extend(linkage.structure().groups.iter().map(|group| group.kind));
            }
            None => refused += 1,
        }
    }
    assert!(refused < 90, "{refused} of 150 refused");
    for kind in [
        GroupKind::Rrr,
        GroupKind::Rrp,
        GroupKind::Rpr,
        GroupKind::Prp,
        GroupKind::Rpp,
    ] {
        let count = kinds.iter().filter(|&&other| other == kind).count();
        assert!(count >= 10, "{kind}: {count}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, ..ProptestConfig::default() })]
    #[test]
    fn the_loops_close_and_the_transfer_functions_are_derivatives(
        seed: u64, dyads in 1usize..4, part in 0.02f64..0.98,
    ) {
        let Some(linkage) = is_fair(Linkage::new(linkage(seed, dyads, &FORMS).0)) else {
            return Ok(());
        };
        let q = interior(&linkage, part);
        let mut workspace = linkage.workspace();
        linkage.solve(q, 3, &mut workspace).map_err(|e| TestCaseError::fail(e.to_string()))?;
        let scale = workspace.farthest().max(1.0);
        prop_assert!(closure_error(&linkage, &workspace) < 1e-13 * scale);
        compare_with_differences(&linkage, q)?;
    }

    #[test]
    fn the_reduced_inertia_carries_the_kinetic_energy(seed: u64, part in 0.1f64..0.9) {
        let Some(linkage) = is_fair(Linkage::new(linkage(seed, 2, &FORMS).0)) else {
            return Ok(());
        };
        let q = interior(&linkage, part);
        let h = 1e-4 * linkage.core.plan.size;
        let mut workspace = linkage.workspace();
        let centres = |q: f64, workspace: &mut crate::kinematics::linkage::Workspace| -> Option<Vec<[f64; 3]>> {
            linkage.solve(q, 0, workspace).ok()?;
            let links = linkage.spec().links.iter().enumerate();
            Some(links.map(|(index, link)| {
                let [x, y] = workspace.pose(index).to_ground(link.centre);
                [x, y, workspace.angle(index)]
            }).collect())
        };
        let (Some(before), Some(after)) = (centres(q - h, &mut workspace), centres(q + h, &mut workspace)) else {
            return Ok(());
        };
        let mut energy = 0.0;
        for (index, link) in linkage.spec().links.iter().enumerate() {
            let [vx, vy, turning] = [0, 1, 2].map(|k| (after[index][k] - before[index][k]) / (2.0 * h));
            energy += 0.5 * link.mass * (vx * vx + vy * vy) + 0.5 * link.moment * turning * turning;
        }
        linkage.solve(q, 3, &mut workspace).map_err(|e| TestCaseError::fail(e.to_string()))?;
        let reduced = linkage.reduced_linkage(&workspace);
        // Differences of second order: their error goes with the third derivatives.
        let rough = 1e-6 * (1.0 + workspace.largest().powi(2));
        prop_assert!(close(0.5 * reduced.inertia[0], energy, 1e-6, rough * energy.abs().max(1.0)));
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, ..ProptestConfig::default() })]
    /// The closed forms against Newton's method on the equations of every pair.
    #[test]
    fn iteration_gives_the_same(seed: u64, dyads in 1usize..3, part in 0.05f64..0.95) {
        let spec = linkage(seed, dyads, &FORMS).0;
        let Some(closed) = is_fair(Linkage::new(spec.clone())) else { return Ok(()) };
        let Ok(iterated) = Linkage::with_closed_forms(spec, false) else {
            return Err(TestCaseError::fail("closed forms assemble it, iteration does not"));
        };
        let [one, other] = [&closed, &iterated].map(|linkage| linkage.range().ends());
        let changes = !closed.range().changes.is_empty();
        // Where guides become parallel places go to infinity, and rounding with them.
        let parallel = closed.structure().groups.iter().any(|group| matches!(group.kind, GroupKind::Prp | GroupKind::Rpp));
        let exact = if parallel { 1e-4 } else { 1e-7 };
        let scale = closed.core.plan.size;
        for (a, b) in one.into_iter().zip(other) {
            prop_assert!(changes || a == b || (a - b).abs() < exact * scale, "ends {one:?} {other:?}");
        }
        let q = interior(&iterated, part);
        let (mut w, mut v) = (closed.workspace(), iterated.workspace());
        closed.solve(q, 3, &mut w).map_err(|e| TestCaseError::fail(e.to_string()))?;
        iterated.solve(q, 3, &mut v).map_err(|e| TestCaseError::fail(e.to_string()))?;
        let size = w.largest().max(1.0);
        for link in 0..closed.spec().links.len() {
            let (a, b) = (w.pose(link), v.pose(link));
            let off = (a.x - b.x).hypot(a.y - b.y).max((a.cos - b.cos).hypot(a.sin - b.sin));
            prop_assert!(off <= 1e-10 * size, "pose of {link}: {a:?}, {b:?}");
            for k in 1..=3 {
                for (a, b) in w.transfer(link, k).into_iter().zip(v.transfer(link, k)) {
                    prop_assert!((a - b).abs() <= 1e-9 * size, "{link}, order {k}: {a}, {b}");
                }
            }
        }
    }

    /// From one end to the other nothing jumps, and ends are where it stops.
    #[test]
    fn nothing_is_jumped_over(seed: u64, dyads in 1usize..4) {
        let Some(linkage) = is_fair(Linkage::new(linkage(seed, dyads, &FORMS).0)) else {
            return Ok(());
        };
        let range = linkage.range();
        let (from, to) = match &range.reach {
            Reach::Everywhere => (range.start - 7.0, range.start + 7.0),
            Reach::Interval { lower, upper } => (lower.at, upper.at),
        };
        let mut workspace = linkage.workspace();
        let mut before: Option<Vec<[f64; 4]>> = None;
        let mut speed_before = 0.0;
        for i in 1..2000 {
            // Closer together towards the ends, where speeds grow.
            let x = 0.5 - 0.5 * (std::f64::consts::PI * f64::from(i) / 2000.0).cos();
            let q = from + (to - from) * x;
            let step = (to - from) * 0.5 * std::f64::consts::PI / 2000.0;
            linkage.solve(q, 1, &mut workspace).map_err(|e| TestCaseError::fail(e.to_string()))?;
            let now: Vec<[f64; 4]> = (0..linkage.spec().links.len()).map(|link| {
                let pose = workspace.pose(link);
                [pose.x, pose.y, pose.cos, pose.sin]
            }).collect();
            let speed = workspace.largest();
            if let Some(before) = &before {
                for (a, b) in before.iter().flatten().zip(now.iter().flatten()) {
                    let most = 3.0 * step * f64::max(speed, speed_before) + 1e-9;
                    prop_assert!((a - b).abs() <= most, "jump of {} at {q}", (a - b).abs());
                }
            }
            (before, speed_before) = (Some(now), speed);
        }
        if let Reach::Interval { lower, upper } = &range.reach {
            for (end, inwards) in [(lower, 1.0), (upper, -1.0)] {
                if matches!(end.cause, Cause::DeadPosition { .. }) {
                    let q = end.at + inwards * 1e-9 * (to - from);
                    linkage.solve(q, 1, &mut workspace).map_err(|e| TestCaseError::fail(e.to_string()))?;
                    prop_assert!(workspace.largest() > 30.0, "{end:?}: {}", workspace.largest());
                }
            }
        }
    }
}
