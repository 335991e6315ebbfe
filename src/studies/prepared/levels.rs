//! The level of the elastic objects that leave theirs open: one for all points of a study.

use crate::dynamics::builder::spec::Level;
use crate::frontend::scene::{Accuracy, AccuracySpec, Elastic, Levels, Reading, TypedScene};
use crate::studies::order::{USUAL, choose, finer};
use crate::studies::{Control, RunSettings};

/// More masses than so many are not tried for points that modes serve.
const MOST_MASSES: usize = 256;

/// The finest levels that the figures need at any of some points of a study; what is no
/// mechanism there is left out.
pub(crate) fn finest_levels(points: impl Iterator<Item = Reading>, figures: &[String]) -> Levels {
    let mut points: Vec<Point> = points
        .filter_map(|reading| Point::new(reading, figures))
        .collect();
    let mut found = Levels::new();
    for point in &points {
        for (id, &level) in &point.own {
            let common = found.entry(id.clone()).or_insert(level);
            *common = finer(*common, level);
        }
    }
    // How many masses do what few modes did is known at the points that chose modes alone.
    for point in points.iter_mut().filter(|point| point.holds) {
        while point.differs(&found) && !point.is_served(&found) {
            if !refine(&mut found) {
                break;
            }
        }
    }
    found
}

/// What is wrong with a figure that does not hold the accuracy that a scene asks for.
/// `None`: nothing, or none is asked for.
pub(crate) fn shortfall(mut scene: TypedScene, figure: &str) -> Option<String> {
    let accuracy = match scene.run.accuracy.as_ref()? {
        AccuracySpec::Share(share) => Accuracy::Share(*share),
        AccuracySpec::Figures(figures) => figures.iter().find(|(asked, _)| asked == figure)?.1,
    };
    let asked = AccuracySpec::Figures(vec![(figure.to_owned(), accuracy)]);
    scene.run.accuracy = Some(asked);
    // Its points are integrated as the scene says.
    scene.run.tolerance_given = true;
    let settings = RunSettings::of(&scene).ok()?;
    let chosen = choose(&mut scene, &settings, &Control::default()).ok()?;
    chosen.certificate.accuracy.get(figure)?.shortfall(figure)
}

/// Twice the masses of every object that has masses; false where that is too many.
fn refine(levels: &mut Levels) -> bool {
    let mut refined = false;
    for level in levels.values_mut() {
        let masses = matches!(level, Level::Masses { count, .. } if 2 * *count <= MOST_MASSES);
        if let Some(twice) = level.refined(2).filter(|_| masses) {
            (*level, refined) = (twice, true);
        }
    }
    refined
}

/// A point of the study at which levels were chosen.
struct Point {
    scene: TypedScene,
    settings: RunSettings,
    /// Its elastic objects with those that are open.
    elastic: Elastic,
    /// The levels chosen there.
    own: Levels,
    /// True when the figure is accurate enough by them.
    holds: bool,
}

impl Point {
    /// `None`: nothing is open, or it cannot be run.
    fn new(reading: Reading, figures: &[String]) -> Option<Self> {
        let mut scene = reading.scene;
        let elastic = scene.elastic();
        elastic.open_levels().next()?;
        let asked = figures.iter().map(|figure| (figure.clone(), USUAL));
        let asked = AccuracySpec::Figures(asked.collect());
        scene.run.accuracy.get_or_insert(asked);
        // Its points are integrated as the scene says.
        scene.run.tolerance_given = true;
        let settings = RunSettings::of(&scene).ok()?;
        let mut point = Self {
            scene,
            settings,
            elastic,
            own: Levels::new(),
            holds: false,
        };
        point.holds = point.choose()?;
        Some(point)
    }

    /// Chooses what is open; whether all figures are accurate enough then.
    fn choose(&mut self) -> Option<bool> {
        let chosen = choose(&mut self.scene, &self.settings, &Control::default()).ok()?;
        if !chosen.levels.is_empty() {
            self.own = chosen.levels;
        }
        let mut accuracy = chosen.certificate.accuracy.values();
        Some(accuracy.all(|found| found.holds))
    }

    /// True when an object has masses where modes or static flexibility were chosen here.
    fn differs(&self, levels: &Levels) -> bool {
        let masses = |id: &String| matches!(levels.get(id), Some(Level::Masses { .. }));
        let gives_way = |level: &Level| matches!(level, Level::Modes { .. } | Level::Static);
        let mut own = self.own.iter();
        own.any(|(id, level)| gives_way(level) && masses(id))
    }

    /// True when the figures are accurate enough by these levels.
    fn is_served(&mut self, levels: &Levels) -> bool {
        self.elastic.set(&mut self.scene, levels);
        self.choose().unwrap_or(false)
    }
}

#[cfg(test)]
mod tests {
    use super::{Point, finest_levels};
    use crate::dynamics::builder::spec::Level;
    use crate::frontend::scene::{BuiltIn, Document, Overrides, Reading};

    fn figures() -> [String; 1] {
        ["body.pair.max_contact_force".to_owned()]
    }

    /// A rod that strikes a wall of so much stiffness, its level open.
    fn rod(wall: f64) -> Reading {
        let text = format!(
            r#"{{ "dam": 1, "name": "Rod", "objects": {{
                "wall": {{ "kind": "drive", "coordinate": "sliding", "motion": {{ "fixed": 0 }} }},
                "body": {{ "kind": "slider", "input": "wall", "position": {{ "ratio": 1 }},
                    "inertia": 1, "stiffness": 1, "masses": "auto", "damping_capacity": 0.3,
                    "pair": {{ "closure": "force", "contact": {{ "stiffness": {wall} }} }} }} }},
                "run": {{ "duration": 6, "start": {{ "body": {{ "displacement": [0], "speed": [-1] }} }} }} }}"#
        );
        let document = Document::parse("rod.json", text.as_bytes()).unwrap();
        document.scene(&BuiltIn, &Overrides::none()).unwrap()
    }

    #[test]
    fn masses_that_one_point_needs_serve_the_points_that_chose_modes() {
        let walls = [0.1, 1.0, 3.0, 10.0];
        let own = |wall: f64| {
            let point = Point::new(rod(wall), &figures()).unwrap();
            assert!(point.holds, "{wall}");
            point.own["body"]
        };
        assert!(matches!(own(3.0), Level::Modes { .. }));
        assert!(matches!(own(10.0), Level::Masses { .. }));
        let common = finest_levels(walls.into_iter().map(rod), &figures());
        assert!(matches!(common["body"], Level::Masses { .. }), "{common:?}");
        for wall in walls {
            let mut point = Point::new(rod(wall), &figures()).unwrap();
            assert!(point.is_served(&common), "{wall}: {common:?}");
        }
    }
}
