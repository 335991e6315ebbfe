//! The options of a command as fields of a form: from the declarations that the command line is
//! read by.
//!
//! So an option that is declared is in the form. Options that name files, and those of
//! terminals, are in no form; what is in no form is refused.

use crate::cli::args::Cli;
use clap::{Arg, ArgAction, Command, CommandFactory};
use serde::Serialize;
use std::any::TypeId;
use std::path::PathBuf;

/// Options that say where a scene comes from and where an answer goes, and machines that are no
/// scene: a window has its own ways.
const OF_TERMINALS: [&str; 12] = [
    "scene", "set", "json", "quiet", "csv", "svg", "form", "force", "samples", "inertia", "work",
    "moment",
];

/// How an option is filled in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Sort {
    /// There or not.
    Flag,
    /// One of some words.
    Choice,
    /// A text.
    Text,
    /// There or not, with a text or without.
    Optional,
    /// As many texts as one likes, a line each.
    Lines,
}

/// An option as a field.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Field {
    /// Name of the option: `pressure-angle`.
    pub(crate) name: String,
    /// How it is filled in.
    pub(crate) sort: Sort,
    /// What stands for its value: `SPEED`.
    pub(crate) value: String,
    /// What it means.
    pub(crate) help: String,
    /// What holds where nothing is said; empty: the help tells.
    pub(crate) default: String,
    /// The words to choose from, with what they mean.
    pub(crate) choices: Vec<[String; 2]>,
    /// Whether there must be a value.
    pub(crate) required: bool,
    /// Whether it stands by its place on the command line.
    #[serde(skip)]
    pub(crate) positional: bool,
}

/// What a command takes besides its options.
#[derive(Clone, Copy, Debug)]
pub(super) struct Positionals {
    pub(super) scene: bool,
    pub(super) quiet: bool,
}

/// What the command is for.
pub(super) fn command_purpose(command: &str) -> String {
    with_command(command, |found| {
        found
            .get_about()
            .map(ToString::to_string)
            .unwrap_or_default()
    })
}

/// The fields of a command.
pub(super) fn of(command: &str) -> Vec<Field> {
    with_command(command, |found| {
        found
            .get_arguments()
            .filter(|arg| is_field(arg))
            .map(field)
            .collect()
    })
}

pub(super) fn positionals_of(command: &str) -> Positionals {
    with_command(command, |found| {
        let has = |id: &str| found.get_arguments().any(|arg| arg.get_id() == id);
        Positionals {
            scene: has("scene"),
            quiet: has("quiet"),
        }
    })
}

/// Looks at a command as it is declared; an empty one where there is none of the name.
fn with_command<T>(command: &str, look: impl FnOnce(&Command) -> T) -> T {
    let mut all = Cli::command();
    all.build();
    let mut at = &all;
    for word in command.split(' ') {
        match at.find_subcommand(word) {
            Some(found) => at = found,
            None => return look(&Command::new("none")),
        }
    }
    look(at)
}

fn is_field(arg: &Arg) -> bool {
    let acts = matches!(
        arg.get_action(),
        ArgAction::Set | ArgAction::Append | ArgAction::SetTrue
    );
    // No window names a file.
    let names_file = arg.get_value_parser().type_id() == TypeId::of::<PathBuf>();
    let own = OF_TERMINALS.contains(&arg.get_id().as_str());
    acts && !names_file && !own && !arg.is_global_set()
}

fn field(arg: &Arg) -> Field {
    let values = arg.get_possible_values();
    let may_be_bare = arg
        .get_num_args()
        .is_some_and(|count| count.min_values() == 0);
    let sort = match arg.get_action() {
        ArgAction::SetTrue => Sort::Flag,
        _ if !values.is_empty() => Sort::Choice,
        ArgAction::Append if arg.get_value_delimiter().is_none() => Sort::Lines,
        _ if may_be_bare => Sort::Optional,
        _ => Sort::Text,
    };
    let text = |help: Option<&clap::builder::StyledStr>| help.map(ToString::to_string);
    let names = arg.get_value_names().unwrap_or_default().iter();
    let defaults = arg.get_default_values().iter();
    Field {
        name: arg.get_long().unwrap_or(arg.get_id().as_str()).to_owned(),
        sort,
        value: names.map(ToString::to_string).collect::<Vec<_>>().join(" "),
        help: text(arg.get_help()).unwrap_or_default(),
        default: match sort {
            Sort::Flag => String::new(),
            _ => defaults
                .map(|value| value.to_string_lossy().into_owned())
                .collect::<Vec<_>>()
                .join(","),
        },
        choices: match sort {
            Sort::Choice => (values.iter())
                .map(|value| {
                    let help = text(value.get_help()).unwrap_or_default();
                    [value.get_name().to_owned(), help]
                })
                .collect(),
            _ => Vec::new(),
        },
        required: arg.is_required_set(),
        positional: arg.is_positional(),
    }
}
