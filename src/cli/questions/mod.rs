//! The commands as questions that a window of the studio asks: the same arguments, the same
//! answers, the same files.

mod fields;
mod fits;
#[cfg(test)]
mod tests;

use super::answer::{Answer, AnswerForm};
use super::args::scene::SceneArgs;
use super::args::{Cli, Command};
use super::asker::Asker;
use super::failure::Failure;
use super::input::Input;
use super::output::OutputFolder;
use super::{
    cam, find, forces, kinematics, law, linearise, methods, orders, reduce, response, run, steady,
};
use crate::budget::Budget;
use crate::frontend::diagnostics::Diagnostic;
use crate::frontend::scene::{Catalogue, NamedBytes};
use crate::report::live;
use crate::studio::commands::{CommandScene, Commands, Question};
use clap::Parser;
use serde_json::{Value, json};
use std::borrow::Cow;
use std::cell::RefCell;
use std::ffi::OsString;

/// The commands of this program.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Program;

/// A question: the command, where it stands, and its name among the tabs.
pub(super) struct Tab {
    pub(super) command: &'static str,
    pub(super) name: &'static str,
}

const fn tab(command: &'static str, name: &'static str) -> Tab {
    Tab { command, name }
}

/// The questions in their order; those of one first word stand in one tab.
pub(super) const TABS: [Tab; 14] = [
    tab("find", "Find"),
    tab("kinematics", "Kinematics"),
    tab("forces", "Forces"),
    tab("steady", "Steady motion"),
    tab("cam", "Cam"),
    tab("law cycle", "Laws"),
    tab("law compare", "Laws"),
    tab("law show", "Laws"),
    tab("law synthesize", "Laws"),
    tab("methods", "Methods"),
    tab("reduce", "Reduction"),
    tab("linearise", "Vibration"),
    tab("response", "Vibration"),
    tab("orders", "Vibration"),
];

/// The run has no tab of its own here, but files.
const RUN: &str = "run";

impl Commands for Program {
    fn forms(&self, asked: &CommandScene<'_>) -> Value {
        let found = fits::of(asked);
        let one = |tab: &Tab| {
            let fit = found.iter().find(|fit| fit.command == tab.command);
            json!({
                "command": tab.command,
                "tab": tab.name,
                "about": fields::command_purpose(tab.command),
                "fields": fields::of(tab.command),
                "why": fit.and_then(|fit| fit.why.as_ref()),
                "choices": fit.map(|fit| &fit.choices),
            })
        };
        // A scene with faults fits nothing as yet, and nothing is said of it.
        json!({ "fits": !found.is_empty(), "questions": TABS.iter().map(one).collect::<Vec<_>>() })
    }

    fn answer(&self, question: &Question, asked: &CommandScene<'_>) -> Result<Value, String> {
        let window = Window::new(asked, None);
        window.run_command(question)?;
        Ok(window.shown.into_inner())
    }

    fn file(
        &self,
        question: &Question,
        asked: &CommandScene<'_>,
        name: &str,
    ) -> Result<Option<String>, String> {
        let window = Window::new(asked, Some(name));
        window.run_command(question)?;
        Ok(window.file.into_inner())
    }
}

/// A window that asks: it has the text of the scene, and takes the answer.
struct Window<'a> {
    asked: &'a CommandScene<'a>,
    /// The file that is wanted in place of what is shown.
    wanted: Option<&'a str>,
    shown: RefCell<Value>,
    file: RefCell<Option<String>>,
}

impl<'a> Window<'a> {
    fn new(asked: &'a CommandScene<'a>, wanted: Option<&'a str>) -> Self {
        Self {
            asked,
            wanted,
            shown: RefCell::new(Value::Null),
            file: RefCell::new(None),
        }
    }

    fn run_command(&self, question: &Question) -> Result<(), String> {
        let arguments = arguments(question)?;
        let cli = Cli::try_parse_from(arguments).map_err(|wrong| option_error(&wrong))?;
        modest(&cli.command)?;
        let done = match &cli.command {
            Command::Run(args) => run::command(args, self),
            Command::Law(args) => law::command(args, self),
            Command::Cam(args) => cam::command(args, self),
            Command::Methods(args) => methods::command(args, self),
            Command::Kinematics(args) => kinematics::command(args, self),
            Command::Steady(args) => steady::command(args, self),
            Command::Forces(args) => forces::command(args, self),
            Command::Reduce(args) => reduce::command(args, self),
            Command::Find(args) => find::command(args, self),
            Command::Linearise(args) => linearise::command(args, self),
            Command::Response(args) => response::command(args, self),
            Command::Orders(args) => orders::command(args, self),
            _ => return Err("this is no question".to_owned()),
        };
        // Whether the answer is to be trusted stands in it.
        done.map(|_| ()).map_err(|failure| words(&failure))
    }
}

impl Asker for Window<'_> {
    fn input(&self, _: &SceneArgs) -> Result<Input<'_>, Failure> {
        let CommandScene {
            name,
            text,
            catalogue,
            budget,
            ..
        } = *self.asked;
        Input::of_text((name, text), Lent(catalogue), budget)
    }

    fn budget(&self) -> &Budget<'_> {
        &self.asked.budget
    }

    fn wants_files(&self) -> bool {
        self.wanted.is_some()
    }

    fn report_progress(&self, done: usize, of: usize, now: &str) {
        (self.asked.tell)(done, of, now);
    }

    fn deliver(
        &self,
        answer: &Answer<'_>,
        _: Option<&OutputFolder>,
        _: AnswerForm,
    ) -> Result<(), Failure> {
        match self.wanted {
            Some(name) => *self.file.borrow_mut() = answer.file(name)?,
            None => {
                let mut shown = live::findings(answer.findings);
                shown["files"] = json!(answer.names());
                *self.shown.borrow_mut() = shown;
            }
        }
        Ok(())
    }
}

/// Positions, and values of a list, that are asked for here at most: nothing ends these studies on
/// their way.
const POSITIONS: u32 = 10_000;
const VALUES: usize = 20;

/// Refuses what would take the memory and the time of all.
fn modest(command: &Command) -> Result<(), String> {
    let (positions, values) = match command {
        Command::Kinematics(args) => (args.positions, 0),
        Command::Forces(args) => (args.positions, args.compare_massless.len()),
        _ => return Ok(()),
    };
    if positions > POSITIONS {
        return Err(format!(
            "--positions {positions}: at most {POSITIONS} are taken here; the command line takes more"
        ));
    }
    if values > VALUES {
        return Err(format!(
            "--compare-massless: {values} values; at most {VALUES} are taken here"
        ));
    }
    Ok(())
}

/// A catalogue that belongs to somebody else.
struct Lent<'a>(&'a (dyn Catalogue + Sync));

impl Catalogue for Lent<'_> {
    fn lookup(&self, name: &str) -> Option<(String, Cow<'_, str>)> {
        self.0.lookup(name)
    }

    fn names(&self) -> Vec<String> {
        self.0.names()
    }

    fn table(&self, name: &str) -> Result<NamedBytes, Box<Diagnostic>> {
        self.0.table(name)
    }
}

/// The question as it would be typed. Only options that stand in the form are taken: none that
/// names a file.
fn arguments(question: &Question) -> Result<Vec<OsString>, String> {
    let Question { command, options } = question;
    if command != RUN && !TABS.iter().any(|tab| tab.command == command) {
        return Err(format!("`{command}` is no question"));
    }
    let known = match command.as_str() {
        RUN => Vec::new(),
        _ => fields::of(command),
    };
    let words = std::iter::once("dam").chain(command.split(' '));
    let mut all: Vec<OsString> = words.map(OsString::from).collect();
    let mut last = Vec::new();
    for (name, values) in options {
        let field = known.iter().find(|field| field.name == *name);
        let field = field.ok_or_else(|| format!("`{command}` has no option `{name}`"))?;
        match field.sort {
            fields::Sort::Flag => all.push(format!("--{name}").into()),
            // What has a value is one argument, whatever it begins with.
            _ if field.positional => last.extend(values.iter().map(OsString::from)),
            _ => all.extend(
                values
                    .iter()
                    .map(|value| format!("--{name}={value}").into()),
            ),
        }
    }
    let taken = fields::positionals_of(command);
    if taken.quiet {
        all.push("--quiet".into());
    }
    all.push("--".into());
    if taken.scene {
        all.push("scene".into());
    }
    all.extend(last);
    Ok(all)
}

/// What is wrong with an option, without what belongs to a terminal.
fn option_error(wrong: &clap::Error) -> String {
    let text = wrong.to_string();
    let told = text.split("\n\nUsage:").next().unwrap_or(&text);
    let told = told
        .split("\n\nFor more information")
        .next()
        .unwrap_or(told);
    told.trim_start_matches("error: ").trim().to_owned()
}

fn words(failure: &Failure) -> String {
    match failure {
        Failure::Other(words) | Failure::Output(words) => words.clone(),
        Failure::Scene(faults) => {
            let one = |fault: &crate::frontend::diagnostics::Diagnostic| {
                let place = match fault.path.as_str() {
                    "" => String::new(),
                    path => format!("{path}: "),
                };
                let hints = match fault.hints.is_empty() {
                    true => String::new(),
                    false => format!(" ({})", fault.hints.join("; ")),
                };
                format!("{place}{}{hints}", fault.message)
            };
            let lines: Vec<String> = faults.items.iter().map(one).collect();
            lines.join("\n")
        }
    }
}
