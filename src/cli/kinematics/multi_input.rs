//! What is asked of a linkage of several inputs.

use super::{quantity, range_of, time};
use crate::cli::args::CourseArgs;
use crate::cli::failure::Failure;
use crate::cli::input::Ready;
use crate::dynamics::model::Coordinate;
use crate::frontend::object::Measures;
use crate::frontend::object::law::read_argument;
use crate::frontend::read::{Bounds, QuantityChoice};
use crate::kinematics::linkage::multi::MultiLinkage;
use crate::studies::kinematics::{InputCourse, InputOver, Over, Question};
use crate::units::quantities as q;

/// The question as it is put on the command line.
pub(in crate::cli) fn question(
    args: &CourseArgs,
    positions: u32,
    ready: &Ready,
    linkage: &MultiLinkage,
) -> Result<Question, Failure> {
    let mut inputs: Vec<InputCourse> = Vec::new();
    for text in &args.inputs {
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
        let course = course_of_input(&mut inputs, name);
        course.over = Some(match over {
            None => InputOver::Free,
            Some(value) if value.contains(':') => match range_of(value, own)? {
                Over::Range { from, to } => InputOver::Range { from, to },
                Over::Turn | Over::Time { .. } => InputOver::Free,
            },
            Some(value) => InputOver::At(quantity("--input", value, own.displacement())?),
        });
    }
    for text in &args.speed {
        let (name, value) = of_input(linkage, "--speed", text, Measures::speed)?;
        course_of_input(&mut inputs, &name).speed = Some(value);
    }
    for text in &args.acceleration {
        let (name, value) = of_input(linkage, "--acceleration", text, Measures::acceleration)?;
        course_of_input(&mut inputs, &name).acceleration = Some(value);
    }
    if let Some(range) = &args.range {
        let message = format!(
            "--range {range}: say whose it is, as --input {}={range}",
            linkage.inputs()[0].name
        );
        return Err(Failure::Other(message));
    }
    if args.turn && inputs.iter().all(|input| input.over.is_none()) {
        let first = linkage.inputs()[0].name.clone();
        course_of_input(&mut inputs, &first).over = Some(InputOver::Free);
    }
    Ok(Question {
        object: args.object.clone(),
        over: time(args, ready)?,
        positions: positions as usize,
        duration: ready.settings.duration,
        inputs,
        ..Question::default()
    })
}

/// What is said of an input, or nothing yet.
fn course_of_input<'c>(inputs: &'c mut Vec<InputCourse>, name: &str) -> &'c mut InputCourse {
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
    wanted: fn(Measures) -> QuantityChoice,
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
        let names = linkage.input_names().join(", ");
        let message = format!("{option}: there is no input `{name}`; one of {names}");
        return Err(Failure::Other(message));
    };
    let slides = input.coordinate.slides(&linkage.spec().linkage);
    Ok(Measures(Some(Coordinate::sliding(slides))))
}

/// The place of the picture: a time, the coordinate of the one input that moves, or of several
/// the share of their way.
pub(super) fn read_picture_place(
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
