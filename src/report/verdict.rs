//! The one-line verdict of a run: what became of the mechanism, and whether
//! the numbers can be trusted. The two are never mixed up.

use crate::dynamics::record::{CreepFigures, Figures, PairFigures, Units};
pub(in crate::report) use crate::report::quantity::capitalised;
use crate::report::quantity::{significant, units};
use crate::report::sentence::Sentence;
use crate::studies::judgement::{Judgement, RunEnd, checks, ending, is_unchecked};

/// Sort of a verdict: good news, bad news, or neither.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sort {
    /// The mechanism works as asked.
    Good,
    /// The mechanism itself fails: lift-off, a dead-centre position.
    Mechanism,
    /// The computation failed or is not to be trusted.
    Numerical,
    /// The run was ended from outside, or was too short to be judged.
    Unfinished,
    /// No judgement: what to take.
    Recommended,
}

/// The verdict.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// Sort of news.
    pub sort: Sort,
    /// One of four, where a mechanism or its computation is judged.
    pub judgement: Option<Judgement>,
    /// Two or three words: `In working order`.
    pub headline: Sentence,
    /// The sentence that follows.
    pub text: Sentence,
}

impl From<Judgement> for Sort {
    fn from(judgement: Judgement) -> Self {
        match judgement {
            Judgement::InWorkingOrder => Self::Good,
            Judgement::NotInWorkingOrder => Self::Mechanism,
            Judgement::NotJudged => Self::Unfinished,
            Judgement::NotToBeTrusted => Self::Numerical,
        }
    }
}

impl Verdict {
    /// An answer in a sentence: what it comes to, and what is to be added.
    pub(in crate::report) fn answer(
        sort: Sort,
        headline: impl Into<Sentence>,
        text: impl Into<Sentence>,
    ) -> Self {
        Self {
            sort,
            judgement: None,
            headline: headline.into(),
            text: text.into(),
        }
    }

    /// An answer that judges, in a sentence, and what is to be added.
    pub(in crate::report) fn of_judgement(
        judgement: Judgement,
        headline: impl Into<Sentence>,
        text: impl Into<Sentence>,
    ) -> Self {
        Self {
            judgement: Some(judgement),
            ..Self::answer(judgement.into(), headline, text)
        }
    }

    /// Takes back what is certified although something is left out.
    pub(in crate::report) fn uncertify(&mut self) {
        if let Some(judgement) = &mut self.judgement {
            *judgement = judgement.uncertified();
            self.sort = (*judgement).into();
        }
    }

    /// The sentence that follows the headline, with the verdict in words where neither states
    /// it.
    pub fn following_sentence(&self) -> Sentence {
        let words = self.judgement.map_or("", Judgement::words);
        let text = self.text.to_string();
        let stated = format!("{} {text}", self.headline).to_lowercase();
        if stated.contains(&words.to_lowercase()) {
            return self.text.clone();
        }
        let before = match text.trim_end() {
            "" => "",
            ended if ended.ends_with('.') => " ",
            _ => ". ",
        };
        self.text.clone().words(format!("{before}{words}."))
    }
}

/// The verdict of a run in words, and the sentence that follows.
pub fn verdict(figures: &Figures) -> Verdict {
    let judgement = Judgement::of(figures);
    let ending = ending(figures);
    let failed_check = judgement == Judgement::NotToBeTrusted && ending != RunEnd::OfComputation;
    let text = match judgement {
        _ if ending != RunEnd::Complete && !failed_check => two_sentences(stopped(figures, ending)),
        Judgement::NotToBeTrusted if ending == RunEnd::OfScene => {
            let ended = two_sentences(stopped(figures, ending));
            ended.words(". ").sentence(first_failed_check(figures))
        }
        Judgement::NotToBeTrusted => first_failed_check(figures),
        Judgement::InWorkingOrder | Judgement::NotInWorkingOrder | Judgement::NotJudged => {
            let course = pairs(figures, judgement);
            two_sentences([course.said, course.missing])
        }
    };
    Verdict::of_judgement(judgement, judgement.words(), text)
}

/// The verdict of a run as its answer: first what became of the mechanism, or `result` where
/// nothing did, then the verdict in words.
pub(in crate::report) fn run_answer(figures: &Figures, result: Option<Sentence>) -> Verdict {
    let judgement = Judgement::of(figures);
    let ending = ending(figures);
    let [headline, text] = match (judgement, ending) {
        (Judgement::NotToBeTrusted, RunEnd::OfScene) => [
            first_failed_check(figures),
            two_sentences(stopped(figures, ending)),
        ],
        (Judgement::NotToBeTrusted, _) if ending != RunEnd::OfComputation => {
            [first_failed_check(figures), Sentence::default()]
        }
        (_, RunEnd::Complete) => {
            let course = pairs(figures, judgement);
            match result.filter(|_| !course.fails) {
                Some(result) => [result, two_sentences([course.said, course.missing])],
                None => [course.said, course.missing],
            }
        }
        _ => stopped(figures, ending),
    };
    Verdict::of_judgement(judgement, headline, text)
}

/// Two sentences behind each other.
fn two_sentences([first, second]: [Sentence; 2]) -> Sentence {
    match first.is_empty() || second.is_empty() {
        true => first.sentence(second),
        false => first.words(" ").sentence(second),
    }
}

/// The first check that a run failed.
fn first_failed_check(figures: &Figures) -> Sentence {
    let run = &figures.run;
    let failed = checks(figures).into_iter().find(|check| !check.passed());
    let reason = match failed {
        Some(check) if check.name == "equations of motion" => format!(
            "{} of {} at {} s leaves {} of its terms open, more than {}",
            run.equations.what,
            run.equations.object,
            significant(run.equations.time, 7),
            significant(check.value, 2),
            significant(check.bound, 2)
        ),
        Some(check) => format!(
            "{}: {}, more than {}",
            check.name,
            significant(check.value, 2),
            significant(check.bound, 2)
        ),
        None => String::new(),
    };
    format!("The computation failed its own check: {reason}.").into()
}

/// A run that did not reach its end: where it ended, and why.
fn stopped(figures: &Figures, ending: RunEnd) -> [Sentence; 2] {
    let reason = figures.run.stopped_because.as_deref().unwrap_or("");
    let what = match ending {
        RunEnd::FromOutside | RunEnd::Complete => "The run is not finished: it ended",
        RunEnd::OfComputation => "The computation stopped",
        RunEnd::OfScene => "The run ends",
        RunEnd::OfMechanism => "The mechanism stops",
    };
    let ended = Sentence::from(format!("{what} at t = ")).quantity(figures.run.time, "s", 6);
    [
        ended.words("."),
        Sentence::read(&as_sentence(figures, reason)),
    ]
}

/// A reason as a sentence of its own. Names of objects stay as they are.
fn as_sentence(figures: &Figures, reason: &str) -> String {
    let reason = reason.trim_end();
    let first = reason.split([' ', ',', ':']).next().unwrap_or_default();
    match figures.objects.contains_key(first) {
        true => reason.to_owned(),
        false => capitalised(reason),
    }
}

/// What contacts did in a run.
struct Course {
    said: Sentence,
    /// Why the steady motion is not judged.
    missing: Sentence,
    /// True where a contact separates or an object creeps.
    fails: bool,
}

/// A complete run that passed its checks: what the pairs did.
fn pairs(figures: &Figures, judgement: Judgement) -> Course {
    let pairs: Vec<(&String, &PairFigures)> = figures
        .objects
        .iter()
        .filter_map(|(id, object)| Some((id, object.pair.as_ref()?)))
        .collect();
    let failing: Vec<Sentence> = pairs
        .iter()
        .filter_map(|(id, pair)| complaint(id, pair, units(figures, id)))
        .collect();
    let missing = match (judgement, &figures.run.window_missing) {
        (Judgement::NotJudged, _) if is_unchecked(figures) => {
            "The tolerance is too coarse to check the equations of motion.".to_owned()
        }
        (Judgement::NotJudged, Some(why)) => format!("No steady window: {why}."),
        _ => String::new(),
    };
    let course = |said: Sentence, fails| Course {
        said,
        missing: missing.clone().into(),
        fails,
    };
    if !failing.is_empty() {
        return course(sentence(failing), true);
    }
    let creeping: Vec<Sentence> = figures
        .objects
        .iter()
        .filter_map(|(id, object)| Some(creep_sentence(id, object.creep?, units(figures, id))))
        .collect();
    if !creeping.is_empty() {
        return Course {
            missing: Sentence::default(),
            ..course(sentence(creeping), true)
        };
    }
    let passing: u64 = pairs.iter().map(|(_, pair)| pair.separations).sum();
    let text = match (pairs.is_empty(), passing) {
        (true, _) => "No contact of this scene can separate.".to_owned(),
        (false, 0) => "No loss of contact during the run.".to_owned(),
        (false, count) => format!(
            "Contacts separate {} while the start dies away, none in the steady window.",
            times_in_words(count)
        ),
    };
    course(text.into(), false)
}

/// Complaint about one pair; `None` when nothing is wrong. Without a window every
/// separation of the run counts.
fn complaint(id: &str, pair: &PairFigures, units: Units) -> Option<Sentence> {
    if let Some(margin) = pair.margin {
        return (margin < 0.0).then(|| {
            let lifts = Sentence::from(format!("{id} would lift off (least contact force "));
            lifts.quantity(margin, units.force, 4).words(")")
        });
    }
    let fails = match pair.in_working_order {
        Some(in_order) => !in_order,
        None => pair.separations > 0,
    };
    fails.then(|| {
        Sentence::from(format!(
            "{id} separates {}, ",
            times_in_words(pair.separations)
        ))
        .quantity(pair.separated_time, "s", 4)
        .words(" in all, the longest ")
        .quantity(pair.longest_separation, "s", 4)
    })
}

/// An object that regularised friction does not hold at rest.
fn creep_sentence(id: &str, creep: CreepFigures, units: Units) -> Sentence {
    Sentence::from(format!("{id} creeps at "))
        .quantity(creep.speed, &format!("{}/s", units.displacement), 4)
        .words(" under ")
        .quantity(creep.force, units.force, 4)
        .words(" of friction; it would rest")
}

fn times_in_words(count: u64) -> String {
    match count {
        1 => "once".into(),
        2 => "twice".into(),
        more => format!("{more} times"),
    }
}

/// Parts joined to a sentence, at most three of them spelt out.
fn sentence(parts: Vec<Sentence>) -> Sentence {
    let count = parts.len();
    let shown = Sentence::joined(parts.into_iter().take(3), "; ");
    match count {
        0..=3 => shown.words("."),
        more => shown.words(format!("; and {} more.", more - 3)),
    }
}

#[cfg(test)]
mod tests {
    use super::{Sort, run_answer, verdict};
    use crate::report::fixture;
    use crate::report::sentence::Sentence;

    #[test]
    fn mechanism_and_computation_are_judged_apart() {
        let (mut figures, _) = fixture::run(2, 0.03, 50);
        let judged = verdict(&figures);
        assert_eq!(judged.sort, Sort::Mechanism);
        assert!(
            judged.text.to_string().starts_with("rocker separates"),
            "{}",
            judged.text
        );

        figures.run.energy_error = f64::NAN;
        assert_eq!(verdict(&figures).sort, Sort::Numerical);
        figures.run.energy_error = 1e-12;
        figures.objects.get_mut("rocker").unwrap().sigma = f64::INFINITY;
        assert_eq!(verdict(&figures).sort, Sort::Numerical);

        figures.run.complete = false;
        figures.run.stopped = Some("dead_position".into());
        assert_eq!(verdict(&figures).sort, Sort::Mechanism);
        figures.run.stopped = Some("end_of_travel".into());
        assert_eq!(verdict(&figures).sort, Sort::Mechanism);
        figures.objects.get_mut("rocker").unwrap().sigma = 0.01;
        figures.run.stopped = Some("not_explored".into());
        assert_eq!(verdict(&figures).sort, Sort::Unfinished);
        figures.run.stopped = Some("step_floor".into());
        assert_eq!(verdict(&figures).sort, Sort::Numerical);
        figures.run.stopped = Some("interrupted".into());
        assert_eq!(verdict(&figures).sort, Sort::Unfinished);
    }

    #[test]
    fn an_answer_begins_with_what_became_of_the_mechanism() {
        let (mut figures, _) = fixture::run(2, 0.03, 50);
        let answer = |figures: &_| {
            let found = run_answer(figures, Some(Sentence::from("Greatest |δ|: 1 mm.")));
            format!("{} | {}", found.headline, found.following_sentence())
        };
        let said = answer(&figures);
        assert!(said.starts_with("rocker separates"), "{said}");
        assert!(said.ends_with(" | Not in working order."), "{said}");
        let pair = figures.objects.get_mut("rocker").unwrap();
        let pair = pair.pair.as_mut().unwrap();
        (pair.in_working_order, pair.separations) = (Some(true), 0);
        assert_eq!(
            answer(&figures),
            "Greatest |δ|: 1 mm. | No loss of contact during the run. In working order."
        );
        figures.run.complete = false;
        figures.run.stopped = Some("dead_position".into());
        for (reason, rest) in [
            (
                "the rod cannot be assembled beyond 90 deg",
                "s. | The rod cannot be assembled beyond 90 deg. Not in working order.",
            ),
            (
                "rocker cannot be assembled beyond 90 deg",
                "s. | rocker cannot be assembled beyond 90 deg. Not in working order.",
            ),
        ] {
            figures.run.stopped_because = Some(reason.into());
            let said = answer(&figures);
            assert!(said.starts_with("The mechanism stops at t = "), "{said}");
            assert!(said.ends_with(rest), "{said}");
        }
        figures.run.energy_error = f64::NAN;
        let said = answer(&figures);
        assert!(said.starts_with("The computation failed"), "{said}");
    }

    #[test]
    fn a_quiet_pair_is_in_working_order() {
        let (mut figures, _) = fixture::run(2, 0.03, 50);
        let pair = figures
            .objects
            .get_mut("rocker")
            .unwrap()
            .pair
            .as_mut()
            .unwrap();
        pair.in_working_order = Some(true);
        assert_eq!(verdict(&figures).sort, Sort::Good);
        let pair = figures
            .objects
            .get_mut("rocker")
            .unwrap()
            .pair
            .as_mut()
            .unwrap();
        pair.in_working_order = None;
        let judged = verdict(&figures);
        assert_eq!(judged.sort, Sort::Unfinished);
        assert_eq!(judged.headline.to_string(), "Not judged");
    }
}
