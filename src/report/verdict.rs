//! The one-line verdict of a run: what became of the mechanism, and whether
//! the numbers can be trusted. The two are never mixed up.

use crate::dynamics::record::{EnergyAudit, Figures, ObjectFigures, PairFigures, Units};
use crate::report::quantity::{significant, units};
use crate::report::sentence::Sentence;

/// Sort of a verdict: good news, bad news, or neither.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sort {
    /// The mechanism works as asked.
    Good,
    /// The mechanism itself fails or cannot be judged: lift-off, a dead position.
    Mechanism,
    /// The computation failed or is not to be trusted.
    Numerical,
    /// The run was ended from outside or by a limit of the user's.
    Unfinished,
    /// No judgement: what to take.
    Recommended,
}

/// The verdict.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// Sort of news.
    pub sort: Sort,
    /// Two or three words: `In working order`.
    pub headline: Sentence,
    /// The sentence that follows.
    pub text: Sentence,
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
            headline: headline.into(),
            text: text.into(),
        }
    }
}

/// Judges a run by its figures.
pub fn verdict(figures: &Figures) -> Verdict {
    let run = &figures.run;
    if !run.complete {
        return stopped(figures);
    }
    let finite = figures.objects.values().all(is_finite);
    // Written so that an energy error that is not a number counts as too large.
    let audited = run.energy_error <= EnergyAudit::bound(run.tolerance);
    let kept = run.equations.is_kept();
    if !finite || !audited || !kept {
        let reason = if finite && audited {
            format!(
                "{} of {} at {} s leaves {} of its terms open, more than {}",
                run.equations.what,
                run.equations.object,
                significant(run.equations.time, 7),
                significant(run.equations.defect, 2),
                significant(run.equations.bound, 2)
            )
        } else if finite {
            format!(
                "the energy audit is out by {} of the energy turned over",
                significant(run.energy_error, 2)
            )
        } else {
            "a figure is not a finite number".into()
        };
        return Verdict {
            sort: Sort::Numerical,
            headline: "Not to be trusted".into(),
            text: format!("The computation failed its own check: {reason}.").into(),
        };
    }
    pairs(figures)
}

fn is_finite(object: &ObjectFigures) -> bool {
    [
        object.delta_abs,
        object.delta_max,
        object.delta_min,
        object.sigma,
        object.peak_speed,
        object.peak_acceleration,
        object.peak_reaction,
        object.end.displacement,
        object.end.speed,
    ]
    .iter()
    .all(|value| value.is_finite())
}

/// A run that did not reach its end.
fn stopped(figures: &Figures) -> Verdict {
    let name = figures.run.stopped.as_deref().unwrap_or("");
    let reason = figures.run.stopped_because.as_deref().unwrap_or("");
    let ended = Sentence::from("The run ended at t = ").quantity(figures.run.time, "s", 6);
    let text = match reason.trim_end() {
        "" => ended.words("."),
        reason => ended.words(". ").sentence(Sentence::read(reason)),
    };
    let (sort, headline) = match name {
        "interrupted" | "wall_clock" | "too_many_steps" | "not_explored" => {
            (Sort::Unfinished, "Not finished")
        }
        "not_finite" | "step_floor" | "too_many_switches" | "method" | "" => {
            (Sort::Numerical, "The computation stopped")
        }
        _ => (Sort::Mechanism, "The mechanism stops"),
    };
    Verdict {
        sort,
        headline: headline.into(),
        text,
    }
}

/// A complete, trustworthy run: what the pairs did.
fn pairs(figures: &Figures) -> Verdict {
    let pairs: Vec<(&String, &PairFigures)> = figures
        .objects
        .iter()
        .filter_map(|(id, object)| Some((id, object.pair.as_ref()?)))
        .collect();
    let failing: Vec<Sentence> = pairs
        .iter()
        .filter_map(|(id, pair)| complaint(id, pair, units(figures, id)))
        .collect();
    if !failing.is_empty() {
        return Verdict {
            sort: Sort::Mechanism,
            headline: "Pair opens".into(),
            text: sentence(failing),
        };
    }
    let passing: u64 = pairs.iter().map(|(_, pair)| pair.separations).sum();
    let text = match (pairs.is_empty(), passing) {
        (true, _) => "No pair of this scene can open.".to_owned(),
        (false, 0) => "No pair opens during the run.".to_owned(),
        (false, count) => format!(
            "Pairs open {} while the start dies away, none in the steady window.",
            times(count)
        ),
    };
    Verdict {
        sort: Sort::Good,
        headline: "In working order".into(),
        text: text.into(),
    }
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
        Sentence::from(format!("{id} separates {}, ", times(pair.separations)))
            .quantity(pair.separated_time, "s", 4)
            .words(" in all, the longest ")
            .quantity(pair.longest_separation, "s", 4)
    })
}

fn times(count: u64) -> String {
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

/// A text that begins with a capital.
pub(in crate::report) fn capitalised(text: &str) -> String {
    let mut rest = text.chars();
    let first = rest.next().into_iter().flat_map(char::to_uppercase);
    first.chain(rest).collect()
}

#[cfg(test)]
mod tests {
    use super::{Sort, verdict};
    use crate::report::fixture;

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
        figures.run.stopped = Some("not_explored".into());
        assert_eq!(verdict(&figures).sort, Sort::Unfinished);
        figures.run.stopped = Some("step_floor".into());
        assert_eq!(verdict(&figures).sort, Sort::Numerical);
        figures.run.stopped = Some("interrupted".into());
        assert_eq!(verdict(&figures).sort, Sort::Unfinished);
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
        assert_eq!(verdict(&figures).sort, Sort::Mechanism);
    }
}
