//! `dam response`: gains and phases over the frequency.

use super::answer::{Answer, AnswerForm, Content, PAGE, files};
use super::args::ResponseArgs;
use super::asker::Asker;
use super::failure::Failure;
use super::kinematics::quantity;
use super::output::OutputFolder;
use super::quantity::option;
use super::status::Status;
use crate::frontend::read::Bounds;
use crate::report::findings::Source;
use crate::report::linear::{response_document, response_findings, response_rows};
use crate::studies::axis::Axis;
use crate::studies::linear::ResponseQuestion;
use crate::units::quantities as q;
use crate::units::with_common_unit;

const FILES: [&str; 3] = ["response.json", "response.csv", PAGE];

/// Frequencies between two ends where no number is given.
const USUAL: usize = 400;

/// Runs the command.
pub(crate) fn command(args: &ResponseArgs, asker: &dyn Asker) -> Result<Status, Failure> {
    let input = asker.input(&args.scene)?;
    let mut ready = input.prepare_and_warn(args.scene.quiet)?;
    let (name, hash) = (ready.scene().name.clone(), ready.scene().hash.clone());
    let folder = OutputFolder::from_args(&args.out, &name, &FILES)?;
    let found = ready.response(&question(args)?)?;
    let document = response_document(&name, &hash, &found).map_err(|error| error.to_string())?;
    let answer = Answer {
        command: "response",
        findings: &response_findings(&name, &found, Source::scene(input.text(), &hash)),
        document: document.into(),
        files: files(
            FILES,
            [
                Content::Document,
                Content::made(|| response_rows(&found).csv()),
                Content::Page,
            ],
        ),
        quiet: args.scene.quiet,
    };
    let shown = AnswerForm::json_or(args.scene.json, AnswerForm::Text);
    asker.deliver(&answer, folder.as_ref(), shown)?;
    Ok(match found.warnings.is_empty() {
        true => Status::Answered,
        false => Status::NotTrusted,
    })
}

fn question(args: &ResponseArgs) -> Result<ResponseQuestion, Failure> {
    let given = args.frequencies.as_deref();
    let frequencies = given.map(frequencies).transpose()?;
    let accuracy = option("--accuracy", &args.accuracy, q::NUMBER, Bounds::POSITIVE)?;
    Ok(ResponseQuestion {
        frequencies: frequencies.unwrap_or_default(),
        inputs: args.input.clone(),
        outputs: args.output.clone(),
        accuracy,
    })
}

/// `10:4000 Hz`, `10:4000 Hz:200`, `10:4000 Hz:200:linear`, or `10,500,1500 Hz`, in hertz.
fn frequencies(text: &str) -> Result<Vec<f64>, Failure> {
    let wrong = |what: &str| {
        let message = format!(
            "--frequencies {text}: {what}; give LOW:HIGH, as 10:4000 Hz, LOW:HIGH:COUNT[:linear] or \
             a list, as 10,500,1500 Hz"
        );
        Failure::Other(message)
    };
    let parts: Vec<&str> = text.split(':').map(str::trim).collect();
    let in_hertz = |parts: &[&str]| -> Result<Vec<f64>, Failure> {
        let parts = with_common_unit(parts).map_err(|what| wrong(&what))?;
        let one = |part: &String| quantity("--frequencies", part, q::FREQUENCY.into());
        parts.iter().map(one).collect()
    };
    let count_of = |text: &str| {
        let count: Result<usize, _> = text.parse();
        count.map_err(|_| wrong("the number of frequencies is no whole number"))
    };
    let (ends, count, linear) = match parts[..] {
        [list] => return in_hertz(&list.split(',').collect::<Vec<_>>()),
        [low, high] => ([low, high], USUAL, false),
        [low, high, "linear"] => ([low, high], USUAL, true),
        [low, high, count] => ([low, high], count_of(count)?, false),
        [low, high, count, "linear"] => ([low, high], count_of(count)?, true),
        _ => return Err(wrong("the fourth part can only be `linear`")),
    };
    let ends = in_hertz(&ends)?;
    let [low, high] = [ends[0], ends[1]];
    if !(low < high) {
        return Err(wrong("the first frequency is not below the last"));
    }
    if !linear && low <= 0.0 {
        return Err(wrong(
            "equal ratios need a first frequency above 0; give :linear or a higher one",
        ));
    }
    let axis = match linear {
        true => Axis::linear("", low, high, count),
        false => Axis::log("", low, high, count),
    };
    axis.check().map_err(|what| wrong(&what))?;
    Ok(axis.values())
}

#[cfg(test)]
mod tests {
    use super::frequencies;

    #[test]
    fn ranges_and_lists_are_read_in_hertz() {
        let list = frequencies("10,500,1.5e3 Hz").ok();
        assert_eq!(list, Some(vec![10.0, 500.0, 1500.0]));
        assert_eq!(frequencies("1,2 kHz").ok(), Some(vec![1000.0, 2000.0]));
        assert_eq!(
            frequencies("0:20:3:linear").ok(),
            Some(vec![0.0, 10.0, 20.0])
        );
        assert_eq!(
            frequencies("10:1000 Hz:3").ok(),
            Some(vec![10.0, 100.0, 1000.0])
        );
        assert_eq!(frequencies("10:1000").map(|all| all.len()).ok(), Some(400));
        for (wrong, words) in [
            ("0:10", "equal ratios"),
            ("10:5", "not below"),
            ("1:2:3:4", "fourth part"),
            ("1:2:x", "no whole number"),
            ("1:2:1", "2 to"),
            ("-5:5:9", "equal ratios"),
        ] {
            let said = frequencies(wrong).map_err(|one| one.message()).unwrap_err();
            assert!(said.contains(words), "{wrong}: {said}");
        }
        assert!(frequencies("10 m").is_err());
    }
}
