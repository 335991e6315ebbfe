//! Positions of a linkage over each of its inputs, the others held.

use crate::kinematics::linkage::Linkage;
use crate::kinematics::linkage::Pose;
use crate::kinematics::linkage::multi::spec::InputSpec;
use crate::kinematics::linkage::multi::{MultiLinkage, MultiMotion};
use crate::math::jet::Jet;
use serde_json::{Value, json};
use std::f64::consts::PI;

/// Positions over the reach of an input.
const PLACES: usize = 181;

/// What the positions of a course are of.
struct Course {
    name: String,
    turning: bool,
    /// The input's reach, in words.
    range: String,
    values: Vec<f64>,
    /// The place among them that the course goes from.
    start: usize,
    poses: Vec<Option<Vec<f64>>>,
}

impl Course {
    fn into_json(self) -> Value {
        json!({
            "name": self.name,
            "unit": if self.turning { "rad" } else { "m" },
            "range": self.range,
            "values": self.values,
            "start": self.start,
            "poses": self.poses,
        })
    }
}

/// The course of a linkage of one input over its reach; positions that cannot be are left out,
/// `null`.
pub(super) fn course_of_one(linkage: &Linkage, turning: bool) -> Value {
    let range = linkage.range();
    let size = linkage.typical_length().max(f64::MIN_POSITIVE);
    let ends = match (range.period, range.ends()) {
        (Some(period), _) => [range.start, range.start + period.length],
        (None, [from, to]) => [
            if from.is_finite() {
                from
            } else {
                range.start - size
            },
            if to.is_finite() {
                to
            } else {
                range.start + size
            },
        ],
    };
    let (values, start) = values(range.start, ends);
    let mut work = linkage.workspace();
    let links = linkage.spec().links.len();
    let mut place = |&input: &f64| {
        linkage.solve(input, 0, &mut work).ok()?;
        frames((0..links).map(|link| work.pose(link)))
    };
    let poses = values.iter().map(&mut place).collect();
    let course = Course {
        name: String::new(),
        turning,
        range: range.describe(linkage.structure(), turning),
        values,
        start,
        poses,
    };
    course.into_json()
}

/// The courses of a linkage of several inputs through one position, each over one input.
pub(super) fn multi_input_courses(linkage: &MultiLinkage, at: Option<&[f64]>) -> Vec<Value> {
    let inputs = linkage.inputs();
    let start = || inputs.iter().map(|input| input.start).collect::<Vec<f64>>();
    // What is asked for may be of a text with other inputs.
    let fits = |at: &&[f64]| at.len() == inputs.len() && at.iter().all(|one| one.is_finite());
    let at = at.filter(fits).map_or_else(start, <[f64]>::to_vec);
    let courses = inputs.iter().enumerate();
    courses
        .map(|(k, input)| course_of_input(linkage, &at, k, input).into_json())
        .collect()
}

fn course_of_input(linkage: &MultiLinkage, at: &[f64], input: usize, own: &InputSpec) -> Course {
    let turning = !own.coordinate.slides(&linkage.spec().linkage);
    let reach = match turning {
        true => PI,
        false => linkage.typical_length().max(f64::MIN_POSITIVE),
    };
    let (values, start) = values(at[input], [at[input] - reach, at[input] + reach]);
    let mut poses = vec![None; values.len()];
    let links = linkage.spec().linkage.links.len();
    let mut go = |places: &mut dyn Iterator<Item = usize>| {
        let mut motion = MultiMotion::new(linkage);
        for place in places {
            let inputs = at.iter().enumerate();
            let inputs = inputs
                .map(|(k, &value)| constant_jet(if k == input { values[place] } else { value }));
            if motion.set_inputs(&inputs.collect::<Vec<Jet>>()).is_ok() {
                poses[place] = frames((0..links).map(|link| motion.pose(link)));
            }
        }
    };
    // From the middle outwards, so that the way to each position is short.
    go(&mut (start..values.len()));
    go(&mut (0..=start).rev());
    let range = reached(&values, start, &poses, turning);
    Course {
        name: own.name.clone(),
        turning,
        range,
        values,
        start,
        poses,
    }
}

/// How far an input goes while the others are held, to the positions that are drawn.
fn reached(values: &[f64], start: usize, poses: &[Option<Vec<f64>>], turning: bool) -> String {
    let number = |at: f64| match turning {
        true => format!("{} deg", at.to_degrees().round()),
        false => format!("{} m", (at * 1e4).round() / 1e4),
    };
    if poses[start].is_none() {
        return "cannot be put together here".to_owned();
    }
    let first = poses[..start].iter().rposition(Option::is_none);
    let last = poses[start..].iter().position(Option::is_none);
    match (first, last) {
        (None, None) if turning => "turns fully while the others are held".to_owned(),
        (None, None) => "goes as far as is drawn while the others are held".to_owned(),
        (first, last) => {
            let end = |place: Option<f64>, word: &str| match place {
                Some(value) => format!(" {word} about {}", number(value)),
                None => String::new(),
            };
            let lower = end(first.map(|place| values[place + 1]), "from");
            let upper = end(last.map(|place| values[start + place - 1]), "to");
            format!("goes{lower}{upper} while the others are held")
        }
    }
}

/// Values of an input over its reach, and the place of the start among them.
fn values(start: f64, [from, to]: [f64; 2]) -> (Vec<f64>, usize) {
    let last = (PLACES - 1) as f64;
    let share = ((start - from) / (to - from)).clamp(0.0, 1.0);
    let at = if share.is_finite() {
        (share * last).round() as usize
    } else {
        0
    };
    let value = |place: usize| match place == at {
        // Itself, not what is near it.
        true => start,
        false => from + (to - from) * place as f64 / last,
    };
    ((0..PLACES).map(value).collect(), at)
}

/// Frames of links: x, y, cosine and sine of the angle, one after the other.
fn frames(poses: impl Iterator<Item = Pose>) -> Option<Vec<f64>> {
    let numbers = poses.flat_map(|pose| [pose.x, pose.y, pose.cos, pose.sin]);
    let numbers: Vec<f64> = numbers.collect();
    let finite = numbers.iter().all(|number| number.is_finite());
    finite.then_some(numbers)
}

fn constant_jet(value: f64) -> Jet {
    Jet {
        value,
        ..Jet::default()
    }
}

#[cfg(test)]
mod tests {
    use crate::Scene;
    use crate::report::mechanism::sketch::sketches;
    use serde_json::Value;
    use std::collections::BTreeMap;

    fn of(scene: &str, at: &BTreeMap<String, Vec<f64>>) -> Value {
        let scene = Scene::read(scene).unwrap();
        let mechanism = scene.prepare().unwrap();
        sketches(mechanism.system.model(), at)[0].clone()
    }

    /// Where a point of a link is.
    fn point(pose: &Value, link: usize, [x, y]: [f64; 2]) -> [f64; 2] {
        let [u, v, c, s] = [0, 1, 2, 3].map(|k| pose[4 * link + k].as_f64().unwrap());
        [u + c * x - s * y, v + s * x + c * y]
    }

    #[test]
    fn a_five_bar_has_a_course_for_each_input_through_the_place_that_is_asked_for() {
        let none = BTreeMap::new();
        let bar = of("scenarios/linkages/five_bar.json", &none);
        let courses = bar["courses"].as_array().unwrap();
        let names: Vec<&str> = courses
            .iter()
            .map(|one| one["name"].as_str().unwrap())
            .collect();
        assert_eq!(names, ["left", "right"]);
        assert!(
            bar["told"][0]
                .as_str()
                .unwrap()
                .contains("2 degrees of freedom"),
            "{}",
            bar["told"]
        );
        let driven: Vec<bool> = bar["pairs"]
            .as_array()
            .unwrap()
            .iter()
            .map(|pair| pair["driven"].as_bool().unwrap())
            .collect();
        assert_eq!(driven.iter().filter(|one| **one).count(), 2);
        // Both go through the same position.
        let at =
            |course: &Value| course["poses"][course["start"].as_u64().unwrap() as usize].clone();
        assert_eq!(at(&courses[0]), at(&courses[1]));
        let asked = BTreeMap::from([("bar".to_owned(), vec![1.4, 0.3])]);
        let other = of("scenarios/linkages/five_bar.json", &asked);
        for (course, (input, value)) in other["courses"]
            .as_array()
            .unwrap()
            .iter()
            .zip([(0, 1.4), (1, 0.3)])
        {
            let place = course["start"].as_u64().unwrap() as usize;
            assert_eq!(course["values"][place], value, "input {input}");
        }
        // Where it can be, the rods meet and the cranks stand at their inputs.
        let spec = ["crank", "rod", "coupler", "servo"];
        let index = |name: &str| {
            bar["links"]
                .as_array()
                .unwrap()
                .iter()
                .position(|link| link["name"] == name)
                .unwrap()
        };
        let [crank, rod, coupler, servo] = spec.map(index);
        let mut met = 0;
        for pose in other["courses"][0]["poses"]
            .as_array()
            .unwrap()
            .iter()
            .filter(|pose| !pose.is_null())
        {
            let ([ax, ay], [bx, by]) = (
                point(pose, rod, [0.7, 0.0]),
                point(pose, coupler, [0.7, 0.0]),
            );
            assert!((ax - bx).hypot(ay - by) < 1e-12);
            let ([cx, cy], [dx, dy]) = (point(pose, crank, [0.2, 0.0]), point(pose, rod, [0.0; 2]));
            assert!((cx - dx).hypot(cy - dy) < 1e-12);
            assert!((pose[4 * servo + 2].as_f64().unwrap() - f64::cos(0.3)).abs() < 1e-12);
            met += 1;
        }
        assert!(met > 20, "{met}");
    }

    #[test]
    fn a_frame_that_floats_has_courses_of_lengths_and_angles() {
        let scene = "scenarios/linkages/floating_slider_crank.json";
        // What is of no linkage, or of other inputs, is left.
        let strange = BTreeMap::from([("machine".to_owned(), vec![f64::NAN, 0.0])]);
        let machine = of(scene, &strange);
        let units: Vec<&str> = machine["courses"]
            .as_array()
            .unwrap()
            .iter()
            .map(|one| one["unit"].as_str().unwrap())
            .collect();
        assert_eq!(units, ["rad", "rad", "m", "m"]);
        let floating = machine["floating"][0].as_u64().unwrap() as usize;
        assert_eq!(machine["links"][floating]["name"], "frame");
        for course in machine["courses"].as_array().unwrap() {
            assert!(
                course["poses"]
                    .as_array()
                    .unwrap()
                    .iter()
                    .all(|pose| !pose.is_null())
            );
            assert!(
                course["range"]
                    .as_str()
                    .unwrap()
                    .contains("while the others are held")
            );
        }
    }

    #[test]
    fn a_linkage_of_one_input_has_one_course_over_its_reach() {
        let scene = "scenarios/kinetostatics/slotted_lever.json";
        let lever = of(scene, &BTreeMap::new());
        let courses = lever["courses"].as_array().unwrap();
        assert_eq!(
            (courses.len(), &courses[0]["range"]),
            (1, &serde_json::json!("turns fully"))
        );
        assert!(
            courses[0]["poses"]
                .as_array()
                .unwrap()
                .iter()
                .all(|pose| !pose.is_null())
        );
    }
}
