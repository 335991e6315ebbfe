//! What is asked of a linkage of several inputs.

use super::{quantity, range_of};
use crate::cli::args::CourseArgs;
use crate::cli::failure::Failure;
use crate::cli::input::Ready;
use crate::dynamics::model::Coordinate;
use crate::frontend::object::Measures;
use crate::frontend::object::law::read_argument;
use crate::frontend::read::{Bounds, Wanted};
use crate::kinematics::linkage::multi::MultiLinkage;
use crate::studies::kinematics::{InputCourse, InputOver, Over, Question};
use crate::units::quantities as q;

/// What is said of the inputs of a linkage.
pub(in crate::cli) struct Said<'a> {
    pub(in crate::cli) inputs: &'a [String],
    pub(in crate::cli) speed: &'a [String],
    pub(in crate::cli) acceleration: &'a [String],
    pub(in crate::cli) course: &'a CourseArgs,
    pub(in crate::cli) positions: u32,
}

impl Said<'_> {
    /// Refuses what belongs to several inputs; speed and acceleration of the one input.
    pub(in crate::cli) fn of_one(&self, own: Measures) -> Result<[Option<f64>; 2], Failure> {
        if let Some(input) = self.inputs.first() {
            return Err(Failure::Other(format!(
                "--input {input}: the linkage has one input; give --range, --turn or --time"
            )));
        }
        let read = |name: &str, texts: &[String], wanted: Wanted| match texts {
            [] => Ok(None),
            [text] => quantity(name, text, wanted).map(Some),
            [_, again, ..] => {
                let message = format!("{name} {again}: given twice, and the linkage has one input");
                Err(Failure::Other(message))
            }
        };
        Ok([
            read("--speed", self.speed, own.speed())?,
            read("--acceleration", self.acceleration, own.acceleration())?,
        ])
    }
}

/// The question as it is put on the command line.
pub(in crate::cli) fn question(
    args: &Said<'_>,
    ready: &Ready,
    linkage: &MultiLinkage,
) -> Result<Question, Failure> {
    let mut inputs: Vec<InputCourse> = Vec::new();
    for text in args.inputs {
        let (name, over) = match text.split_once('=') {
            Some((name, value)) => (name, Some(value)),
            None => (text.as_str(), None),
        };
        let own = measures(linkage, "--input", name)?;
        if inputs.iter().any(|input| input.name == name) {
            return Err(Failure::Other(format!(
                "--input {text}: `{name}` is given twice"
            )));
        }
        let course = course(&mut inputs, name);
        course.over = Some(match over {
            None => InputOver::Free,
            Some(value) if value.contains(':') => match range_of(value, own)? {
                Over::Range { from, to } => InputOver::Range { from, to },
                Over::Turn | Over::Time { .. } => InputOver::Free,
            },
            Some(value) => InputOver::At(quantity("--input", value, own.displacement())?),
        });
    }
    for text in args.speed {
        let (name, value) = of_input(linkage, "--speed", text, Measures::speed)?;
        course(&mut inputs, &name).speed = Some(value);
    }
    for text in args.acceleration {
        let (name, value) = of_input(linkage, "--acceleration", text, Measures::acceleration)?;
        course(&mut inputs, &name).acceleration = Some(value);
    }
    let over = match (args.course.range.as_deref(), &args.course.time) {
        (Some(range), _) => {
            let message = format!(
                "--range {range}: say whose it is, as --input {}={range}",
                linkage.inputs()[0].name
            );
            return Err(Failure::Other(message));
        }
        (None, Some(time)) => Some(Over::Time {
            to: match time.as_str() {
                "" => ready.settings.duration,
                time => quantity("--time", time, q::TIME.into())?,
            },
        }),
        (None, None) => None,
    };
    if args.course.turn && inputs.iter().all(|input| input.over.is_none()) {
        let first = linkage.inputs()[0].name.clone();
        course(&mut inputs, &first).over = Some(InputOver::Free);
    }
    Ok(Question {
        object: args.course.object.clone(),
        over,
        positions: args.positions as usize,
        duration: ready.settings.duration,
        inputs,
        ..Question::default()
    })
}

/// What is said of an input, or nothing yet.
fn course<'c>(inputs: &'c mut Vec<InputCourse>, name: &str) -> &'c mut InputCourse {
    let at = inputs.iter().position(|input| input.name == name);
    let at = at.unwrap_or_else(|| {
        inputs.push(InputCourse {
            name: name.to_owned(),
            over: None,
            speed: None,
            acceleration: None,
        });
        inputs.len() - 1
    });
    &mut inputs[at]
}

/// `INPUT=VALUE`.
fn of_input(
    linkage: &MultiLinkage,
    option: &str,
    text: &str,
    wanted: fn(Measures) -> Wanted,
) -> Result<(String, f64), Failure> {
    let Some((name, value)) = text.split_once('=') else {
        let first = &linkage.inputs()[0].name;
        let message = format!("{option} {text}: say whose it is, as {option} {first}={text}");
        return Err(Failure::Other(message));
    };
    let own = measures(linkage, option, name)?;
    Ok((name.to_owned(), quantity(option, value, wanted(own))?))
}

/// What an input measures.
fn measures(linkage: &MultiLinkage, option: &str, name: &str) -> Result<Measures, Failure> {
    let mut inputs = linkage.inputs().iter();
    let Some(input) = inputs.find(|input| input.name == name) else {
        let names: Vec<&str> = linkage
            .inputs()
            .iter()
            .map(|input| input.name.as_str())
            .collect();
        let message = format!(
            "{option}: there is no input `{name}`; one of {}",
            names.join(", ")
        );
        return Err(Failure::Other(message));
    };
    Ok(Measures(Some(
        match input.coordinate.slides(&linkage.spec().linkage) {
            true => Coordinate::Sliding,
            false => Coordinate::Turning,
        },
    )))
}

/// The place of the picture: a time, the coordinate of the one input that moves, or of several
/// the share of their way.
pub(super) fn place(
    question: &Question,
    text: &str,
    linkage: &MultiLinkage,
) -> Result<f64, Failure> {
    let moving = question
        .inputs
        .iter()
        .filter(|input| matches!(input.over, Some(InputOver::Range { .. } | InputOver::Free)));
    let moving: Vec<&str> = moving.map(|input| input.name.as_str()).collect();
    let over_time = matches!(question.over, Some(Over::Time { .. }));
    match (moving.as_slice(), over_time) {
        (_, true) => quantity("--svg", text, q::TIME.into()),
        ([only], _) => {
            let own = measures(linkage, "--svg", only)?;
            quantity("--svg", text, own.displacement())
        }
        ([], _) => {
            // By the unit: over time, or of the first input.
            let own = measures(linkage, "--svg", &linkage.inputs()[0].name)?.displacement();
            let own_unit = read_argument("--svg", text, |slot| slot.quantity(own, Bounds::ANY));
            match own_unit {
                Ok(value) => Ok(value),
                Err(_) => quantity("--svg", text, q::TIME.into()),
            }
        }
        _ => quantity("--svg", text, q::NUMBER.into()),
    }
}
