//! All methods that take a scene tell the same of it, or say that they are not to be trusted.

use super::draw::Units;
use super::scene::{BODIES, MOTIONS, draw};
use dam::integrate::Method;
use dam::lower::lower;
use dam::scene::{BuiltIn, Document, Overrides};
use dam::studies::run::{RunResult, run};
use dam::studies::{Control, RunSettings};
use dam::system::System;
use serde_json::Value;
use std::collections::BTreeMap;

/// Methods that are put beside each other; the first leaves the choice to the program.
const METHODS: [Option<Method>; 7] = [
    None,
    Some(Method::Exact),
    Some(Method::Taylor),
    Some(Method::Dop853),
    Some(Method::Dopri5),
    Some(Method::Radau),
    Some(Method::Rodas5p),
];

/// Steps after which a method is given up as too dear for the scene.
const MOST_STEPS: u64 = 400_000;

/// A difference of certified figures, as a share of their scale, that is none.
const SAME: f64 = 1e-6;

/// … and the one from which one of them is wrong.
const WRONG: f64 = 1e-4;

/// What a method makes of a scene.
pub(crate) enum Answer {
    /// It cannot take it.
    Refused,
    /// It gave up, or is not to be trusted.
    Doubted(String),
    /// A result that is certified.
    Certified(Box<RunResult>),
}

/// The answer of a method to a scene.
///
/// # Errors
/// The scene itself is refused.
pub(crate) fn answer(scene: &Value, method: Option<Method>) -> Result<Answer, String> {
    let text = scene.to_string();
    let document = Document::parse("drawn.json", text.as_bytes());
    let reading = document
        .and_then(|document| document.scene(&BuiltIn, &Overrides::none()))
        .map_err(|wrong| wrong.to_string())?;
    let told = |faults: Vec<dam::fault::Fault>| reading.places.diagnose(&faults).to_string();
    let settings = RunSettings {
        method,
        max_steps: MOST_STEPS,
        ..RunSettings::of(&reading.scene).map_err(|fault| told(vec![fault]))?
    };
    let system = lower(&reading.scene).and_then(System::new).map_err(told)?;
    match run(&system, &settings, &Control::FREE, &mut []) {
        Err(faults) if method.is_none() => Err(told(faults)),
        Err(_) => Ok(Answer::Refused),
        Ok(result) if result.is_trusted() && result.is_complete() => {
            Ok(Answer::Certified(Box::new(result)))
        }
        Ok(result) => {
            let stopped = result.figures.run.stopped_because.clone();
            let mut spoilt = result.warnings.iter().filter(|own| own.spoils_figures());
            let doubt = spoilt.next().map(ToString::to_string);
            Ok(Answer::Doubted(stopped.or(doubt).unwrap_or_default()))
        }
    }
}

/// The figures that are compared.
fn is_compared(address: &str) -> bool {
    let ends = [
        "final.displacement",
        "final.speed",
        "delta_abs",
        "peak_reaction",
    ];
    ends.iter().any(|end| address.ends_with(end))
}

/// The greatest difference of two results as a share of a figure's scale, and whose it is.
pub(crate) fn difference(one: &RunResult, other: &RunResult) -> (f64, String) {
    let mut greatest = (0.0, String::new());
    for (address, value) in one.figures.addresses() {
        let (Some(value), true) = (value, is_compared(&address)) else {
            continue;
        };
        let Ok(beside) = other.figures.value(&address) else {
            return (f64::INFINITY, address);
        };
        let figures = [&one.figures, &other.figures].into_iter();
        let scale = figures
            .map(|own| own.scale(&address).max(1e3 * own.resolution(&address)))
            .fold(0.0, f64::max);
        let share = (value - beside).abs() / scale;
        // (0/0: nothing moves in either.)
        if !(share <= greatest.0) && value != beside {
            greatest = (share, address);
        }
    }
    greatest
}

/// Counts of a family of scenes.
#[derive(Clone, Copy, Debug, Default)]
struct Family {
    scenes: u32,
    /// Certified by the program's own choice, and of these with all methods the same.
    certified: u32,
    same: u32,
    /// Answers of single methods: all, and those that are not to be trusted.
    answers: u32,
    doubted: u32,
}

/// What became of all scenes.
#[derive(Default)]
struct Tally {
    families: BTreeMap<(bool, usize), Family>,
    refused: Vec<String>,
    /// Scenes whose model does not hold for their motion, as is told.
    declined: u32,
    wrong: Vec<String>,
    loose: Vec<String>,
    doubted: Vec<String>,
}

impl Tally {
    fn take(&mut self, number: u64) {
        let drawn = draw(number, Units::SI, false);
        if let Some(folder) = std::env::var_os("DAM_WRITE") {
            let path = std::path::Path::new(&folder).join(format!("{number}.json"));
            std::fs::write(path, drawn.scene.to_string()).expect("the scene is written");
        }
        let kinds = format!("{} before {}", MOTIONS[drawn.motion], BODIES[drawn.body]);
        let places = [(false, drawn.motion), (true, drawn.body)];
        let mut found: Vec<(&str, Box<RunResult>)> = Vec::new();
        let (mut answers, mut doubted, mut certified) = (0, 0, false);
        for method in METHODS {
            let name = method.map_or("auto", Method::name);
            match answer(&drawn.scene, method) {
                // (Static flexibility wants a motion that is known, with a continuous
                // acceleration; a pair that is pulled open from the start has no quiet one, nor
                // has a load that grows faster with the deflection than the link's force.)
                Err(words)
                    if ["static flex", "no quiet start", "no balance of loads"]
                        .iter()
                        .any(|own| words.contains(own)) =>
                {
                    self.declined += 1;
                    return;
                }
                Err(words) => {
                    self.refused.push(format!("{number}, {kinds}: {words}"));
                    return;
                }
                Ok(Answer::Refused) => {}
                Ok(Answer::Doubted(why)) => {
                    (answers, doubted) = (answers + 1, doubted + 1);
                    self.doubted
                        .push(format!("{number}, {kinds}, {name}: {why}"));
                }
                Ok(Answer::Certified(result)) => {
                    answers += 1;
                    certified |= method.is_none();
                    found.push((name, result));
                }
            }
        }
        let mut greatest = (0.0, String::new());
        for (k, (name, one)) in found.iter().enumerate() {
            for (beside, other) in &found[k + 1..] {
                let (share, address) = difference(one, other);
                if !(share <= greatest.0) {
                    greatest = (share, format!("{address} of {name} and {beside}"));
                }
            }
        }
        let line = format!("{number}, {kinds}: {:.1e} in {}", greatest.0, greatest.1);
        if !(greatest.0 <= WRONG) {
            self.wrong.push(line);
        } else if greatest.0 > SAME {
            self.loose.push(line);
        }
        for place in places {
            let family = self.families.entry(place).or_default();
            family.scenes += 1;
            family.certified += u32::from(certified);
            family.same += u32::from(certified && greatest.0 <= SAME);
            family.answers += answers;
            family.doubted += doubted;
        }
    }

    fn add(&mut self, other: Self) {
        for (place, own) in other.families {
            let family = self.families.entry(place).or_default();
            family.scenes += own.scenes;
            family.certified += own.certified;
            family.same += own.same;
            family.answers += own.answers;
            family.doubted += own.doubted;
        }
        self.declined += other.declined;
        self.refused.extend(other.refused);
        self.wrong.extend(other.wrong);
        self.loose.extend(other.loose);
        self.doubted.extend(other.doubted);
    }

    fn tell(&self) {
        println!(
            "family | scenes | certified by auto | all methods within {SAME:.0e} | doubted answers"
        );
        for ((driven, kind), family) in &self.families {
            let name = if *driven {
                BODIES[*kind]
            } else {
                MOTIONS[*kind]
            };
            println!(
                "{name} | {} | {} | {} | {} of {}",
                family.scenes, family.certified, family.same, family.doubted, family.answers
            );
        }
        println!("declined: {}", self.declined);
        for (name, list) in [
            ("refused", &self.refused),
            ("wrong", &self.wrong),
            ("loose", &self.loose),
            ("not to be trusted", &self.doubted),
        ] {
            println!("{name}: {}", list.len());
            list.iter()
                .for_each(|line| println!("  {}", line.replace('\n', " ")));
        }
    }
}

/// Answers of the first scenes that are not to be trusted, by family: no more than were.
const DOUBTED: &str = include_str!("doubted.tsv");

/// Scenes that these are counted of.
const USUAL: u64 = 200;

/// The lines of `doubted.tsv`.
fn doubted(tally: &Tally) -> String {
    let families = tally.families.iter().map(|((driven, kind), family)| {
        let name = if *driven {
            BODIES[*kind]
        } else {
            MOTIONS[*kind]
        };
        format!("{name}\t{}\n", family.doubted)
    });
    families.collect()
}

/// Families of which more answers are doubted than were, by more than one: rounding may turn
/// one on another processor.
fn more_doubted(tally: &Tally) -> Vec<String> {
    let count = |line: &str| {
        let (name, count) = line.split_once('\t')?;
        Some((name.to_owned(), count.parse::<u32>().ok()?))
    };
    let known: BTreeMap<String, u32> = DOUBTED.lines().filter_map(count).collect();
    let now = doubted(tally);
    let more = now.lines().filter_map(count).filter_map(|(name, now)| {
        let before = known.get(&name).copied().unwrap_or(0);
        (now > before + 1).then(|| format!("{name}: {now}, {before} before"))
    });
    more.collect()
}

/// Numbers of the scenes that are asked for.
pub(crate) fn numbers(usual: u64) -> std::ops::Range<u64> {
    let asked = |name: &str| std::env::var(name).ok()?.parse::<u64>().ok();
    let first = asked("DAM_FIRST").unwrap_or(0);
    first..first + asked("DAM_SCENES").unwrap_or(usual)
}

#[test]
fn methods_agree_or_are_not_to_be_trusted() {
    let numbers = numbers(USUAL);
    let count = numbers.end - numbers.start;
    let threads = std::thread::available_parallelism().map_or(1, usize::from) as u64;
    let mut tally = Tally::default();
    std::thread::scope(|scope| {
        let parts: Vec<_> = (0..threads)
            .map(|part| {
                let own = numbers
                    .clone()
                    .filter(move |number| number % threads == part);
                scope.spawn(|| {
                    let mut tally = Tally::default();
                    own.for_each(|number| tally.take(number));
                    tally
                })
            })
            .collect();
        for part in parts {
            tally.add(part.join().expect("no scene panics"));
        }
    });
    tally.tell();
    if numbers == (0..USUAL) {
        match std::env::var_os("DAM_BLESS") {
            Some(_) => {
                let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/generated/doubted.tsv");
                std::fs::write(path, doubted(&tally)).expect("the list is written");
            }
            None => assert_eq!(more_doubted(&tally), Vec::<String>::new()),
        }
    }
    assert!(tally.refused.is_empty(), "scenes that cannot be run");
    assert!(tally.wrong.is_empty(), "certified results that differ");
    let motions = tally.families.iter().filter(|((driven, _), _)| !driven);
    let same: u32 = motions.map(|(_, family)| family.same).sum();
    let count = count as u32 - tally.declined;
    assert!(
        f64::from(same) >= 0.95 * f64::from(count),
        "{same} of {count} scenes are certified and the same by all methods"
    );
}
