//! From a question about a scene's linkage to a course and its positions.

use super::{
    ActingLoads, Course, ForceSettings, ForceStudy, Instant, PositionSource, loads,
    multi_input_forces, study,
};
use crate::dynamics::model::Model;
use crate::fault::{Fault, with_prefix};
use crate::kinematics::linkage::kinetostatics::{Convention, InputMotion, Kinetostatics, Options};
use crate::kinematics::linkage::{Linkage, Workspace};
use crate::studies::endless::DeadEnd;
use crate::studies::kinematics::{
    AskedSeveral, KinematicsRequest, Over, Question, linkage_of, several_of, whole_travel,
};

/// Positions of a linkage, solved one after another.
#[derive(Debug)]
pub struct LinkagePositions<'a> {
    linkage: &'a Linkage,
    workspace: Workspace,
    acting: Option<ActingLoads<'a>>,
}

impl<'a> LinkagePositions<'a> {
    /// Positions of this linkage.
    pub fn new(linkage: &'a Linkage) -> Self {
        Self {
            linkage,
            workspace: linkage.workspace(),
            acting: None,
        }
    }

    /// With loads on the outputs that follow from the motion of the input.
    pub fn carrying(self, acting: ActingLoads<'a>) -> Self {
        Self {
            acting: Some(acting),
            ..self
        }
    }
}

impl PositionSource for LinkagePositions<'_> {
    type At = Workspace;

    fn at(&mut self, coordinate: f64) -> Result<&Workspace, String> {
        match self.linkage.solve(coordinate, 3, &mut self.workspace) {
            Ok(()) => Ok(&self.workspace),
            Err(reason) => Err(reason.to_string()),
        }
    }

    fn singular(&self) -> (Vec<f64>, Option<f64>) {
        let range = self.linkage.range();
        let changes = range.changes.iter().map(|change| change.at);
        (changes.collect(), range.period.map(|period| period.length))
    }

    fn limits(&self) -> Vec<DeadEnd> {
        let ends = self.linkage.range().dead_ends();
        ends.into_iter().map(DeadEnd::new).collect()
    }

    fn loads(&self, input: InputMotion) -> Vec<f64> {
        let acting = self.acting.as_ref();
        acting.map_or(Vec::new(), |loads| loads.at(input))
    }

    fn load_places(&self, between: [f64; 2], speed: f64) -> Vec<f64> {
        let acting = self.acting.as_ref();
        acting.map_or(Vec::new(), |loads| loads.places(between, speed))
    }

    fn load_names(&self) -> Vec<String> {
        let acting = self.acting.as_ref();
        acting.map_or(Vec::new(), ActingLoads::names)
    }
}

/// Why there are no forces.
#[derive(Debug)]
pub enum NoForces {
    /// The question has no answer.
    Question(String),
    /// Something of the linkage is wrong.
    Linkage(Vec<Fault>),
}

impl From<String> for NoForces {
    fn from(message: String) -> Self {
        Self::Question(message)
    }
}

/// What is asked of the forces besides the course.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ForceChoice {
    /// The output whose load the dynamic transmission ratio refers to, and by name the forces that
    /// are this load: `ram`, or `ram=cutting,drag`. Default the only output with a force on its
    /// link.
    pub load: Option<String>,
    /// Sign of the dynamic transmission ratio.
    pub convention: Convention,
    /// Whether all friction is left out.
    pub frictionless: bool,
    /// Direction (its sign) of sliding where the input rests.
    pub direction: Option<f64>,
}

impl ForceChoice {
    /// Options of the solution of each position.
    pub fn options(&self) -> Options {
        Options {
            friction: !self.frictionless,
            direction: self.direction,
            ..Options::default()
        }
    }

    /// Friction, loads and the convention of χ.
    ///
    /// # Errors
    /// There is no such output or force.
    pub fn settings(&self, solver: &Kinetostatics) -> Result<ForceSettings, String> {
        let (output, loads) = match &self.load {
            None => (only_loaded_output(solver), None),
            Some(text) => load(text, solver)?,
        };
        Ok(ForceSettings {
            options: self.options(),
            output,
            loads,
            convention: self.convention,
        })
    }
}

/// `OUTPUT` or `OUTPUT=FORCE,FORCE`.
fn load(text: &str, solver: &Kinetostatics) -> Result<(Option<usize>, Option<Vec<usize>>), String> {
    let spec = solver.spec();
    let (output, forces) = match text.split_once('=') {
        Some((output, forces)) => (output, Some(forces)),
        None => (text, None),
    };
    let outputs: Vec<&str> = (spec.outputs.iter().map(|one| one.name.as_str())).collect();
    let index = position(output, &outputs, "output")?;
    let names: Vec<&str> = (spec.forces.iter().map(|one| one.name.as_str())).collect();
    let chosen = forces.map(|forces| {
        let list = forces.split(',');
        let list = list.map(|name| position(name.trim(), &names, "force"));
        list.collect::<Result<Vec<usize>, String>>()
    });
    Ok((Some(index), chosen.transpose()?))
}

fn position(name: &str, names: &[&str], what: &str) -> Result<usize, String> {
    let found = names.iter().position(|known| *known == name);
    found.ok_or_else(|| match names {
        [] => format!("load: the linkage has no {what}"),
        _ => {
            let known = names.join(", ");
            format!("load: there is no {what} `{name}`; one of {known}")
        }
    })
}

/// The forces of a linkage with one input or several.
///
/// # Errors
/// See [`AskedSeveral::new`], [`KinematicsRequest::new`], [`course_of`], [`study`].
pub fn forces_of(
    model: &Model,
    question: &Question,
    choice: &ForceChoice,
) -> Result<ForceStudy, NoForces> {
    let object = question.object.as_deref();
    let wrong = |object: usize| {
        let id = &model.objects[object].id;
        |faults| NoForces::Linkage(with_prefix(id, faults))
    };
    if let Some(body) = several_of(model, object) {
        let asked = AskedSeveral::new(model, body, question)?;
        for (given, what) in [
            (choice.load.is_some(), "load"),
            (choice.direction.is_some(), "direction"),
        ] {
            if given {
                let id = &model.objects[body.object].id;
                let message =
                    format!("{what} belongs to a linkage of one input, and `{id}` has several");
                return Err(NoForces::Question(message));
            }
        }
        return multi_input_forces(&asked, choice.options()).map_err(wrong(body.object));
    }
    let body = linkage_of(model, object)?;
    let spec = body.linkage.spec();
    let solver = Kinetostatics::new(spec).map_err(wrong(body.object))?;
    let mut question = question.clone();
    // A speed is meant for the whole travel.
    if question.over.is_none() && question.speed.or(question.acceleration).is_some() {
        question.over = Some(whole_travel(&body.linkage));
    }
    let course = course_of(&KinematicsRequest::new(model, &question)?)?;
    let settings = choice.settings(&solver)?;
    let acting = ActingLoads::loads_along_course(model, body, &course);
    let mut positions = LinkagePositions::new(&body.linkage).carrying(acting);
    study(spec, &mut positions, course, settings).map_err(wrong(body.object))
}

/// Number of positions that lie `intervals` apart: of a range without length a single one.
pub(super) fn count(intervals: usize, [from, to]: [f64; 2], closed: bool) -> usize {
    match from == to {
        true => 1,
        false => intervals + usize::from(!closed),
    }
}

/// The course that a question asks for.
///
/// # Errors
///
/// The speed of the input is not known, in words.
pub fn course_of(asked: &KinematicsRequest<'_>) -> Result<Course, String> {
    let [speed, acceleration] = asked.rate;
    let timed = matches!(asked.over, Over::Time { .. });
    if asked.unit_rate && !timed {
        return Err(format!(
            "the speed of the input of `{}` is not known: give it, as in --speed \"300 rpm\"",
            asked.object
        ));
    }
    let even = |from: f64, to: f64, closed: bool| Course::Even {
        from,
        to,
        count: count(asked.positions, [from, to], closed),
        speed,
        acceleration,
        closed,
    };
    Ok(match asked.over {
        Over::Turn => {
            let period = asked
                .linkage
                .range()
                .period
                .map_or(0.0, |found| found.length);
            let from = asked.first_input();
            // Along the motion, as the rows of the kinematics.
            let sense = if speed < 0.0 { -1.0 } else { 1.0 };
            even(from, from + sense * period, true)
        }
        Over::Range { from, to } => even(from, to, false),
        Over::Time { to } => {
            let step = to / asked.positions as f64;
            let times: Vec<f64> = (0..=asked.positions).map(|k| step * k as f64).collect();
            let motions: Vec<InputMotion> = times.iter().map(|time| motion(asked, *time)).collect();
            let period = asked.linkage.range().period.map(|found| found.length);
            let loads = loads::over_time(asked.model, &asked.object, to, asked.positions);
            let loads = loads.unwrap_or_default();
            let closed = ends_as_it_began(&motions, period) && end_as_they_began(&loads);
            let instant = |(index, motion)| Instant {
                motion,
                loads: loads.get(index).cloned().unwrap_or_default(),
                ..Instant::default()
            };
            Course::Instants {
                instants: motions.into_iter().enumerate().map(instant).collect(),
                times,
                closed,
            }
        }
    })
}

fn motion(asked: &KinematicsRequest<'_>, time: f64) -> InputMotion {
    let jet = asked.input_at(time);
    InputMotion {
        coordinate: jet.value,
        speed: jet.first,
        acceleration: jet.second,
    }
}

/// True when a motion ends as it began, whole periods of the linkage apart.
fn ends_as_it_began(motions: &[InputMotion], period: Option<f64>) -> bool {
    let (Some(first), Some(last)) = (motions.first(), motions.last()) else {
        return false;
    };
    let same = |read: fn(&InputMotion) -> f64, apart: f64| {
        let size = motions
            .iter()
            .fold(0.0, |most: f64, one| most.max(read(one).abs()));
        (read(last) - read(first) - apart).abs() <= 1e-9 * size
    };
    let way = last.coordinate - first.coordinate;
    let turns = period.map_or(0.0, |period| (way / period).round() * period);
    same(|one| one.coordinate, turns)
        && same(|one| one.speed, 0.0)
        && same(|one| one.acceleration, 0.0)
}

/// True when forces over time end as they began.
fn end_as_they_began(loads: &[Vec<f64>]) -> bool {
    let (Some(first), Some(last)) = (loads.first(), loads.last()) else {
        return true;
    };
    let same = |output: usize| {
        let sizes = loads.iter().map(|row| row[output].abs());
        (last[output] - first[output]).abs() <= 1e-9 * sizes.fold(0.0, f64::max)
    };
    (0..first.len()).all(same)
}

/// The output whose link carries a load, if there is exactly one.
pub fn only_loaded_output(kinetostatics: &Kinetostatics) -> Option<usize> {
    let outputs = 0..kinetostatics.spec().outputs.len();
    let mut loaded = outputs.filter(|output| !kinetostatics.loads_of(*output).is_empty());
    let first = loaded.next()?;
    loaded.next().is_none().then_some(first)
}

/// The course of a linkage in the record of a run (the text of `record.csv`):
/// motion of its input, and the forces of what hangs on its outputs.
///
/// # Errors
///
/// The text is no record, or has no motion of this object; in words.
pub fn course_of_record(text: &str, object: &str, outputs: &[&str]) -> Result<Course, String> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let headers = reader.headers().map_err(|error| error.to_string())?.clone();
    let position = |name: &str| {
        headers.iter().position(|header| {
            let bare = header.split_once(" [").map_or(header, |(bare, _)| bare);
            bare == name
        })
    };
    let find = |name: String| position(&name).ok_or(format!("the record has no column `{name}`"));
    let wanted = [
        find("time".to_owned())?,
        find(format!("{object}.displacement"))?,
        find(format!("{object}.speed"))?,
        find(format!("{object}.acceleration"))?,
    ];
    let behind: Vec<Option<usize>> = outputs
        .iter()
        .map(|output| position(&format!("{object}.{output}.reaction")))
        .collect();
    let (mut times, mut instants): (Vec<f64>, Vec<Instant>) = (Vec::new(), Vec::new());
    for (row, record) in reader.records().enumerate() {
        let record = record.map_err(|error| error.to_string())?;
        let read = |column: usize| {
            let text = record.get(column).unwrap_or_default();
            let value = text.parse::<f64>().ok().filter(|value| value.is_finite());
            value.ok_or(format!(
                "row {} of the record: `{text}` is not a number",
                row + 1
            ))
        };
        let time = read(wanted[0])?;
        let motion = InputMotion {
            coordinate: read(wanted[1])?,
            speed: read(wanted[2])?,
            acceleration: read(wanted[3])?,
        };
        let loads = behind.iter().map(|column| column.map_or(Ok(0.0), &read));
        let loads = loads.collect::<Result<Vec<f64>, String>>()?;
        // Of the two rows at a switch the later one counts.
        if times.last().is_some_and(|last| *last == time) {
            times.pop();
            instants.pop();
        }
        if times.last().is_some_and(|last| *last > time) {
            return Err(format!("row {} of the record: time runs back", row + 1));
        }
        times.push(time);
        instants.push(Instant {
            motion,
            loads,
            direction: None,
        });
    }
    if times.is_empty() {
        return Err("the record has no rows".to_owned());
    }
    Ok(Course::Instants {
        times,
        instants,
        closed: false,
    })
}

#[cfg(test)]
mod tests {
    use super::course_of_record;
    use crate::studies::forces::Course;

    #[test]
    fn a_record_is_read_and_what_is_wrong_is_said() {
        let head = "time [s],a.displacement [rad],a.speed [rad/s],a.acceleration [rad/s²],a.ram.reaction [N]\n";
        let text = format!("{head}0,1,2,3,4\n1,2,2,0,0\n1,2,2,5,6\n");
        let course = course_of_record(&text, "a", &["lever", "ram"]).unwrap();
        let Course::Instants {
            times, instants, ..
        } = &course
        else {
            panic!()
        };
        assert_eq!(times, &[0.0, 1.0]);
        assert_eq!(instants[1].motion.acceleration, 5.0);
        assert_eq!(instants[1].loads, [0.0, 6.0]);
        let failure = |text: &str| course_of_record(text, "a", &[]).unwrap_err();
        assert!(failure("time [s]\n0\n").contains("a.displacement"));
        assert!(failure(&format!("{head}0,1,x,3,0\n")).contains("`x` is not a number"));
        assert!(failure(&format!("{head}0,1,NaN,3,0\n")).contains("not a number"));
        assert!(
            failure(&format!("{head}1,1,1,1,0\n2,1,1,1,0\n0.5,1,1,1,0\n")).contains("runs back")
        );
        assert!(failure(head).contains("no rows"));
    }
}
