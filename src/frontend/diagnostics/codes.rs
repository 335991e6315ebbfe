//! The codes of messages, each with its cause and its remedy.
//!
//! `dam schema --of codes` prints them. `tests/program/reference.rs` holds this table to the
//! codes that the sources use.

/// Code of messages.
pub struct Code {
    /// The code: `unknown-property`.
    pub name: &'static str,
    /// Cause of the message, in a sentence.
    pub cause: &'static str,
    /// Remedy, in a sentence.
    pub remedy: &'static str,
}

const fn code(name: &'static str, cause: &'static str, remedy: &'static str) -> Code {
    Code {
        name,
        cause,
        remedy,
    }
}

/// All codes, in alphabetical order.
#[rustfmt::skip]
pub const CODES: &[Code] = &[
    code("ambiguous-unit", "A product after a quotient in a unit can be read in two ways.", "Write products first, and a `/` before every divisor: `N s/m`."),
    code("bad-expression", "An expression cannot be read, or uses a name that it does not have here.", "Correct it at the place that is marked; the message lists the names."),
    code("bad-formula", "A formula of parameters cannot be read, or uses a name that is no parameter.", "Correct it at the place that is marked."),
    code("bad-id", "The name of an object, link, joint or load is not allowed.", "Use letters, digits, `_` and `-`, begin with a letter, and avoid reserved names."),
    code("bad-name", "The name of a condition or parameter is not allowed.", "Use letters, digits, `_` and `-`, and begin with a letter."),
    code("bad-override", "A change by `--set` cannot be applied.", "Write `PATH=VALUE` with the address of a property, as in `run.duration=1`."),
    code("bad-table", "A table in a file cannot be read: a header, a column or a number is wrong.", "Correct the line that the message names."),
    code("contradiction", "Two properties, or a property and its object, contradict each other.", "Remove or change one of them; the message names both."),
    code("cycle", "Objects drive each other, or parameters refer to each other, in a circle.", "Let one of them be independent of the others; the message lists the circle."),
    code("duplicate", "A property or name is given twice in the text.", "Remove one of them."),
    code("duplicate-property", "An object made in code has a property twice.", "Set it once."),
    code("empty", "The text holds no scene.", "Begin with a template: `dam new cam`."),
    code("file", "The file of the scene cannot be read.", "Check path and permissions."),
    code("implausible", "Warning: a number was likely meant in another unit.", "Write the unit that is meant; the message proposes one."),
    code("input", "The command cannot be carried out: an option does not fit the scene.", "Follow the message; `dam COMMAND --help` lists the options."),
    code("missing", "One of several inputs has no ratio.", "Give every input a `ratio`, or describe a `planetary` set or a `lever`."),
    code("missing-file", "There is no file of this name, or it cannot be read.", "Correct the name; it is relative to the folder of the scene."),
    code("missing-property", "A required property is absent.", "Add it; the message names it."),
    code("missing-unit", "A text has a number without a unit.", "Write the number without quotes (SI), or add a unit."),
    code("model", "The parts of the model do not fit together, or its start state cannot be found.", "Follow the message; it names the property and what would be right."),
    code("never-closes", "Warning: no load closes the force-closed contact.", "Add a spring or another closing force, or set `closure` to `form`."),
    code("no-drive", "No object drives the machine.", "Add a drive, or let an object follow one."),
    code("no-effect", "Warning: a property has no effect here.", "Remove it, or add what it needs; the message names it."),
    code("no-folder", "A scene that was not read from a file refers to a file.", "Read the scene from its file, or write the table into it."),
    code("no-value", "The result exists but has no value in this run.", "Choose another result, or a run in which it occurs."),
    code("not-a-number", "A text that should be a number with a unit does not begin with a number.", "Write a number, with a point and not a comma."),
    code("not-ascending", "The points of a table are not in ascending order.", "Sort them by the \
                                                                                first column; no \
                                                                                value may occur \
                                                                                there twice."),
    code("not-finite", "A number is too large, infinite or not a number.", "Write a finite number."),
    code("not-json", "The text is not JSON.", "Correct it at the place that is marked."),
    code("not-trusted", "The checks of the steady motion disagree, so a result of it cannot be used.", "Look at the checks by `dam steady`; a smaller tolerance may help."),
    code("not-utf8", "The file is not UTF-8 text.", "Save it as UTF-8."),
    code("not-whole", "A property that counts has another value than a whole number.", "Write a whole number; the message states the bounds."),
    code("open-period", "Warning: a periodic table ends one step before a whole turn; its last point counts as the first of the next period.", "Give the table a `period`; the message proposes one."),
    code("out-of-range", "A number is outside its bounds.", "Write a number within the bounds that the message states."),
    code("output", "A result could not be written.", "Check the folder, its permissions and the free space."),
    code("outside-folder", "A file lies outside the folder of the scene.", "Put the file into the folder of the scene."),
    code("parameters", "More parameters are wrong than messages are shown.", "Correct those that are shown first."),
    code("question", "A value or name that the command needs is missing or not understood.", "Follow the message."),
    code("rough-table", "Warning: the points of a table scatter, by rounding or measurement, so that its second derivative is partly noise.", "Give the displacements with more digits, leave out points, or smooth them first."),
    code("too-deep", "Objects and lists in the text are nested too deeply.", "Remove levels of nesting."),
    code("too-large", "A text or file is larger than a scene may be.", "Shorten its tables."),
    code("two-ways", "The same thing is given in two ways.", "Keep one of the two properties."),
    code("unknown-catalogue-object", "`from` names no object of the catalogue.", "Choose a name of the catalogue; the message proposes a similar one."),
    code("unknown-choice", "The value is none of those that the property offers.", "Choose one of the values that the message lists."),
    code("unknown-dimension", "`dimensions` declares a name to which nothing refers.", "Correct its name, or remove it."),
    code("unknown-figure", "There is no result of this name.", "Choose a name of the page of results."),
    code("unknown-name", "There is no object or result of this name in what was computed.", "Correct the name; the message proposes similar ones."),
    code("unknown-object", "There is no object of this id.", "Correct the id, or add the object."),
    code("unknown-parameter", "The scene has no parameter of this name.", "Correct the name, or add it to `parameters`."),
    code("unknown-part", "An object has no link, joint or coupling of this name.", "Correct the name, or add the part."),
    code("unknown-point", "A link has no point of this name.", "Correct the name, or add the point to the link."),
    code("unknown-property", "The object has no property of this name.", "Correct the name; the message proposes a similar one or lists all."),
    code("unknown-unit", "The unit is not known or not complete.", "Write a unit of the page of units."),
    code("unused-parameter", "Warning: nothing refers to a parameter.", "Remove it, or use it in a number or expression."),
    code("wrong-length", "A list has too few or too many entries.", "Give as many as the message states."),
    code("wrong-type", "The value is of another type than the property: a text in place of a list, for example.", "Write the type that the message states."),
    code("wrong-unit", "The unit measures another quantity.", "Write a unit of the quantity that the message states."),
    code("zero-byte", "The text contains a zero byte.", "Save it as plain UTF-8 text."),
];
