//! Known figures.

use super::examples::{andrews, four_bar};
use crate::linkage::{Linkage, Reach};

#[test]
fn a_four_bar_is_found() {
    let linkage = Linkage::new(four_bar([0.1, 0.4, 0.3, 0.45]).0).unwrap();
    println!("{}", linkage.structure());
    println!("{:?}", linkage.range());
    assert_eq!(linkage.range().reach, Reach::Everywhere);
}

#[test]
fn the_squeezing_mechanism_starts_as_published() {
    let linkage = Linkage::new(andrews().0).unwrap();
    println!("{}", linkage.structure());
    println!("{:?}", linkage.range());
    let mut workspace = linkage.workspace();
    linkage
        .solve(linkage.range().start, 2, &mut workspace)
        .unwrap();
    let reduced = linkage.reduced(&workspace);
    let acceleration = (reduced.force[0] - reduced.potential[1]) / reduced.inertia[0];
    approx::assert_relative_eq!(acceleration, 14222.4439199541, max_relative = 1e-9);
    let theta = (workspace.transfer(1, 1)[2] - 1.0) * acceleration;
    approx::assert_relative_eq!(theta, -10666.8329399656, max_relative = 1e-9);
}
