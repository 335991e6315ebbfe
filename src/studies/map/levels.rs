//! The level of the elastic objects of a map that leave theirs open: one for all its points.

use crate::frontend::scene::{AccuracySpec, Levels, Reading};
use crate::studies::order::{USUAL, choose, finer};
use crate::studies::{Control, RunSettings};

/// The finest levels that the figure needs at any of some points of a map; what is no
/// mechanism there is left out.
pub(super) fn levels(points: impl Iterator<Item = Reading>, figure: &str) -> Levels {
    let mut found = Levels::new();
    for reading in points {
        let mut scene = reading.scene;
        if scene.elastic().open().next().is_none() {
            continue;
        }
        let asked = AccuracySpec::Figures(vec![(figure.to_owned(), USUAL)]);
        scene.run.accuracy.get_or_insert(asked);
        // Its cells are integrated as the scene says.
        scene.run.tolerance_given = true;
        let Ok(settings) = RunSettings::of(&scene) else {
            continue;
        };
        if let Ok(chosen) = choose(&mut scene, &settings, &Control::default()) {
            for (id, level) in chosen.levels {
                let own = found.entry(id).or_insert(level);
                *own = finer(*own, level);
            }
        }
    }
    found
}
