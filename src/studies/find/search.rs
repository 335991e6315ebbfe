//! The search: places, edges, extremes.

use super::found::{Best, ConditionEnd, FindResult, Limit, Range};
use super::goal::{Aim, Goal};
use super::sample::{Sample, State};
use super::span::Span;
use crate::math::optimise::{Peak, brent};
use crate::math::roots::bracketed_within;
use crate::studies::condition::Condition;

/// Width to which edges are narrowed down, as a share of the range.
const NARROW: f64 = 1e-7;
/// Width to which extremes of a figure are located, as a part of two distances of places.
const LOCATED: f64 = 1e-5;
/// A value that is passed by a jump is not taken: the least difference that is left, over the
/// greatest in the range, is more than this.
const JUMP: f64 = 1e-4;
/// Rounds in which vertices of parabolas are looked at.
const ROUNDS: u32 = 2;
/// Distance from an extreme, over that of its neighbours, at which a smooth figure has changed by no
/// more than this part of how much it changes up to them: by the square of it.
const BESIDE: f64 = 1e-3;
const SMOOTH: f64 = 0.02;
/// Most extremes of a figure that are followed.
const EXTREMES: usize = 3;
/// Places about the answer that are looked at, as shares of the range.
const AROUND: [f64; 4] = [-0.05, -0.01, 0.01, 0.05];
/// Most rounds in which what is found about the answer may change it.
const SETTLING: u32 = 5;

/// Evaluation of the scene at shares of the range; fewer samples than shares where it was ended from
/// outside.
pub type Evaluate<'e> = dyn Fn(&[f64]) -> Vec<Sample> + 'e;

/// Searches a range for the places that meet conditions, and for the best of them.
pub fn search(
    span: &Span,
    conditions: &[Condition],
    goal: Option<&Goal>,
    evaluate: &Evaluate<'_>,
) -> FindResult {
    let mut search = RangeSearch {
        span,
        conditions: conditions.to_vec(),
        goal,
        evaluate,
        samples: Vec::new(),
        complete: true,
    };
    search.evaluate_places(span.shares());
    search.keep_values();
    if !span.whole {
        for _ in 0..ROUNDS {
            search.evaluate_places(search.near_limits());
        }
    }
    let (mut ranges, mut best) = search.ranges_and_best();
    for _ in 0..SETTLING {
        let Some(found) = &best else { break };
        let around = search.unknown_places_around(found.sample.share);
        if around.is_empty() || !search.complete {
            break;
        }
        search.evaluate_places(around);
        (ranges, best) = search.ranges_and_best();
    }
    let certain = search.is_certain(best.as_ref());
    FindResult {
        best,
        ranges,
        certain,
        complete: search.complete,
        samples: search.samples,
    }
}

struct RangeSearch<'s> {
    span: &'s Span,
    conditions: Vec<Condition>,
    goal: Option<&'s Goal>,
    evaluate: &'s Evaluate<'s>,
    /// What is known, in the order of the parameter.
    samples: Vec<Sample>,
    complete: bool,
}

impl RangeSearch<'_> {
    /// Looks at places that are not known yet.
    fn evaluate_places(&mut self, shares: Vec<f64>) {
        let shares: Vec<f64> = (shares.into_iter())
            .filter(|&share| self.known_sample(share).is_none())
            .collect();
        if shares.is_empty() || !self.complete {
            return;
        }
        let found = (self.evaluate)(&shares);
        self.complete = found.len() == shares.len();
        self.samples.extend(found);
        self.samples.sort_by(|a, b| a.share.total_cmp(&b.share));
    }

    /// An equality that two neighbours meet alike is met over a range.
    fn keep_values(&mut self) {
        for index in 0..self.conditions.len() {
            let met = |one: &Sample| one.margin(&self.conditions, index) == Some(0.0);
            let flat = self.samples.windows(2).any(|pair| pair.iter().all(met));
            self.conditions[index].kept |= flat && self.conditions[index].is_equality();
        }
    }

    fn known_sample(&self, share: f64) -> Option<&Sample> {
        let found = self
            .samples
            .binary_search_by(|one| one.share.total_cmp(&share));
        found.ok().map(|at| &self.samples[at])
    }

    /// What is known at a place; `None`: ended from outside.
    fn sample(&mut self, share: f64) -> Option<Sample> {
        self.evaluate_places(vec![share]);
        self.known_sample(share).cloned()
    }

    /// Places between three neighbours at which a parabola through a figure comes to its limit or
    /// beyond, or near it.
    fn near_limits(&self) -> Vec<f64> {
        let mut found = Vec::new();
        for index in 0..self.conditions.len() {
            for three in self.samples.windows(3) {
                let margins: Option<Vec<f64>> = three
                    .iter()
                    .map(|one| one.margin(&self.conditions, index))
                    .collect();
                let Some(margins) = margins else { continue };
                let shares = [three[0].share, three[1].share, three[2].share];
                found.extend(vertex(shares, [margins[0], margins[1], margins[2]]));
            }
        }
        found
    }

    fn ranges_and_best(&mut self) -> (Vec<Range>, Option<Best>) {
        let equality = self.conditions.iter().position(Condition::is_equality);
        let mut ranges = match equality {
            Some(index) => self.roots(index),
            None => self.ranges(),
        };
        let best = self.best_place(&ranges, equality.is_some());
        if equality.is_none() {
            // Extremes were looked at meanwhile.
            ranges = self.ranges();
        }
        (ranges, best)
    }

    /// The places at which an equality is met and all else holds.
    fn roots(&mut self, index: usize) -> Vec<Range> {
        let conditions = self.conditions.clone();
        let conditions = conditions.as_slice();
        let value = |one: &Sample| one.margin(conditions, index);
        let known: Vec<(Sample, f64)> = (self.samples.iter())
            .filter_map(|one| Some((one.clone(), value(one)?)))
            .collect();
        let mut found: Vec<(Sample, f64)> = (known.iter())
            .filter(|(_, miss)| *miss == 0.0)
            .map(|(one, _)| (one.clone(), 0.0))
            .collect();
        let neighbours = |a: &Sample, b: &Sample| {
            let between = |one: &&Sample| a.share < one.share && one.share < b.share;
            !self.samples.iter().any(|one| between(&one))
        };
        let brackets: Vec<[(Sample, f64); 2]> = (known.windows(2))
            .filter(|_| !self.span.whole)
            .filter(|pair| pair[0].1 * pair[1].1 < 0.0 && neighbours(&pair[0].0, &pair[1].0))
            .map(|pair| [pair[0].clone(), pair[1].clone()])
            .collect();
        let scale = self.scales()[index];
        for [before, after] in brackets {
            let ends = [before.0.share, after.0.share];
            let mut miss = |share: f64| {
                let sample = self.sample(share);
                sample.and_then(|one| value(&one)).unwrap_or(f64::NAN)
            };
            let root = bracketed_within(&mut miss, ends, 1e-12 * scale, NARROW);
            if let Some(sample) = self.sample(root.at)
                && root.miss.abs() <= JUMP * scale
            {
                // As far as a straight line to the neighbours says.
                let apart = before.1.abs() + after.1.abs();
                let width = self.width(ends) * (root.miss.abs() / apart);
                found.push((sample, width.max(NARROW * self.width([0.0, 1.0]))));
            }
        }
        found.retain(|(sample, _)| sample.holds(conditions) == Some(true));
        found.sort_by(|a, b| a.0.share.total_cmp(&b.0.share));
        found.dedup_by(|a, b| (a.0.share - b.0.share).abs() <= 2.0 * NARROW);
        let end = |(sample, within): &(Sample, f64)| ConditionEnd {
            sample: sample.clone(),
            limit: Limit::Equality(index),
            within: *within,
            beyond: None,
        };
        found
            .iter()
            .map(|one| Range {
                from: end(one),
                to: end(one),
            })
            .collect()
    }

    fn width(&self, [from, to]: [f64; 2]) -> f64 {
        (self.span.value(to) - self.span.value(from)).abs()
    }

    /// The ranges in which all conditions hold.
    fn ranges(&mut self) -> Vec<Range> {
        let samples = self.samples.clone();
        let mut found = Vec::new();
        let mut open: Option<ConditionEnd> = None;
        for (at, sample) in samples.iter().enumerate() {
            if sample.holds(&self.conditions) != Some(true) {
                continue;
            }
            if open.is_none() {
                open = Some(self.edge(sample, at.checked_sub(1).map(|at| &samples[at])));
            }
            let next = samples.get(at + 1);
            if next.is_some_and(|next| next.holds(&self.conditions) == Some(true)) {
                continue;
            }
            let to = self.edge(sample, next);
            found.extend(open.take().map(|from| Range { from, to }));
        }
        found
    }

    /// The end of a range between its last place and the next one, which does not hold.
    fn edge(&mut self, inside: &Sample, outside: Option<&Sample>) -> ConditionEnd {
        let Some(outside) = outside else {
            let limit = match inside.share {
                0.0 | 1.0 => Limit::Range,
                // Ended from outside before what comes next.
                _ => Limit::State(State::NotTrusted("no place was examined".to_owned())),
            };
            return ConditionEnd {
                sample: inside.clone(),
                limit,
                within: 0.0,
                beyond: None,
            };
        };
        let (mut good, mut bad) = (inside.clone(), outside.clone());
        let ends = [inside.share, outside.share];
        let is_known = outside.holds(&self.conditions).is_some();
        if is_known && !self.span.whole && (ends[1] - ends[0]).abs() > NARROW {
            let scales = self.scales();
            let mut measure = |share: f64| {
                let Some(sample) = self.sample(share) else {
                    return f64::NAN;
                };
                let holds = sample.holds(&self.conditions);
                let measure = self.measure(&sample, &scales);
                match holds {
                    Some(true) => good = sample,
                    Some(false) | None => bad = sample,
                }
                measure
            };
            bracketed_within(&mut measure, ends, 0.0, NARROW);
        }
        let limit = match &bad.state {
            State::Computed => Limit::Conditions(bad.violated(&self.conditions)),
            other => Limit::State(other.clone()),
        };
        ConditionEnd {
            within: self.width([good.share, bad.share]),
            sample: good,
            limit,
            beyond: Some(bad),
        }
    }

    /// The greatest size of the margin of each condition.
    fn scales(&self) -> Vec<f64> {
        let scale = |index: usize| {
            let margins = self
                .samples
                .iter()
                .filter_map(|one| one.margin(&self.conditions, index));
            margins.fold(f64::MIN_POSITIVE, |most, margin| most.max(margin.abs()))
        };
        (0..self.conditions.len()).map(scale).collect()
    }

    /// A number that is negative where a condition does not hold, and passes zero where it ceases
    /// to; none where nothing is known.
    fn measure(&self, sample: &Sample, scales: &[f64]) -> f64 {
        match sample.state {
            State::NotTrusted(_) => return f64::NAN,
            State::Refused(_) | State::Stopped(_) => return -1.0,
            State::Computed => {}
        }
        let margin = |(index, scale): (usize, &f64)| {
            let margin = sample.margin(&self.conditions, index);
            margin.map_or(-1.0, |margin| margin / scale)
        };
        let least = scales.iter().enumerate().map(margin).fold(1.0, f64::min);
        // (A count that is just right has no margin.)
        match least >= 0.0 {
            true => least.max(f64::EPSILON),
            false => least,
        }
    }

    fn best_place(&mut self, ranges: &[Range], only_roots: bool) -> Option<Best> {
        let goal = self.goal?;
        let ends = ranges.iter().flat_map(|range| [&range.from, &range.to]);
        let of_end = |end: &ConditionEnd| Best {
            sample: end.sample.clone(),
            limit: Some(end.limit.clone()),
            within: end.within,
            beyond: end.beyond.clone(),
        };
        let worth = |best: &Best| Some(goal.aim.rank_of_value(best.sample.goal?));
        let mut all: Vec<Best> = ends.map(of_end).collect();
        if !goal.is_parameter && !only_roots {
            all.extend(self.extremes(goal.aim));
        }
        all.retain(|one| worth(one).is_some_and(f64::is_finite));
        // Of equals the first: an end says more than an extreme beside it.
        all.into_iter()
            .reduce(|best, other| match worth(&other) > worth(&best) {
                true => other,
                false => best,
            })
    }

    /// The places within the ranges at which the goal has an extreme of its own.
    fn extremes(&mut self, aim: Aim) -> Vec<Best> {
        let worth = |one: &Sample, conditions: &[Condition]| match one.holds(conditions) {
            Some(true) => one
                .goal
                .map_or(f64::NEG_INFINITY, |goal| aim.rank_of_value(goal)),
            Some(false) | None => f64::NEG_INFINITY,
        };
        let known: Vec<(f64, f64)> = (self.samples.iter())
            .map(|one| (one.share, worth(one, &self.conditions)))
            .collect();
        let finite = |at: usize| known.get(at).is_some_and(|one| one.1.is_finite());
        let is_peak = |&at: &usize| {
            let before = at
                .checked_sub(1)
                .map_or(f64::NEG_INFINITY, |before| known[before].1);
            let after = known.get(at + 1).map_or(f64::NEG_INFINITY, |after| after.1);
            finite(at) && known[at].1 >= before && known[at].1 >= after
        };
        let mut peaks: Vec<usize> = (0..known.len()).filter(is_peak).collect();
        peaks.sort_by(|&a, &b| known[b].1.total_cmp(&known[a].1));
        peaks.truncate(EXTREMES);
        let mut found = Vec::new();
        for at in peaks {
            let (low, high) = (at.saturating_sub(1), (at + 1).min(known.len() - 1));
            let low = if finite(low) { low } else { at };
            let high = if finite(high) { high } else { at };
            let ends = [known[low].0, known[high].0];
            let mut start = known[at];
            let wide = ends[1] - ends[0] > 2.0 * NARROW;
            if wide && !self.span.whole && self.complete {
                let mut value = |share: f64| {
                    let sample = self.sample(share);
                    sample.map_or(f64::NEG_INFINITY, |one| worth(&one, &self.conditions))
                };
                if low == at || high == at {
                    // The best place is an end: is it better a little inside?
                    let inside = start.0 + 0.02 * (ends[0] + ends[1] - 2.0 * start.0);
                    let beside = value(inside);
                    start = if beside > start.1 {
                        (inside, beside)
                    } else {
                        start
                    };
                }
                if start.0 != ends[0] && start.0 != ends[1] {
                    let peak = Peak {
                        at: start.0,
                        value: start.1,
                    };
                    let peak = brent(peak, ends, LOCATED, &mut value);
                    start = (peak.at, peak.value);
                }
            }
            let within = LOCATED * self.width(ends);
            let limit = (wide && self.is_abrupt(start, ends, &worth)).then_some(Limit::Abrupt);
            found.extend(self.known_sample(start.0).map(|sample| Best {
                sample: sample.clone(),
                limit,
                within,
                beyond: None,
            }));
        }
        found
    }

    /// Whether a figure still changes by much beside its extreme: it jumps there, or has no bound.
    fn is_abrupt(
        &mut self,
        (share, best): (f64, f64),
        ends: [f64; 2],
        worth: &dyn Fn(&Sample, &[Condition]) -> f64,
    ) -> bool {
        if self.span.whole || share == ends[0] || share == ends[1] {
            return false;
        }
        let step = BESIDE * (ends[1] - ends[0]);
        let mut value = |share: f64| {
            let sample = self.sample(share.clamp(ends[0], ends[1]))?;
            let worth = worth(&sample, &self.conditions);
            worth.is_finite().then_some(worth)
        };
        let far = ends
            .map(&mut value)
            .into_iter()
            .flatten()
            .fold(best, f64::min);
        let near = [share - step, share + step].map(value);
        let near = near.into_iter().flatten().fold(best, f64::min);
        best - near > SMOOTH * (best - far)
    }

    /// Places about another that are not known yet.
    fn unknown_places_around(&self, share: f64) -> Vec<f64> {
        if self.span.whole {
            return Vec::new();
        }
        let places = AROUND.map(|step| share + step).into_iter();
        let places = places.filter(|place| (0.0..=1.0).contains(place));
        let apart = |place: &f64| {
            let close = |one: &Sample| (one.share - place).abs() < 0.2 * AROUND[2];
            !self.samples.iter().any(close)
        };
        places.filter(apart).collect()
    }

    fn is_certain(&self, best: Option<&Best>) -> bool {
        if best.is_some_and(|best| best.limit == Some(Limit::Abrupt)) {
            return false;
        }
        let unknown = |one: &&Sample| matches!(one.state, State::NotTrusted(_));
        let mut unknown = self.samples.iter().filter(unknown);
        match (self.goal, best) {
            (Some(goal), Some(best)) if goal.is_parameter => {
                let worth = |one: &Sample| goal.aim.rank_of_value(one.value);
                !unknown.any(|one| worth(one) > worth(&best.sample))
            }
            _ => unknown.next().is_none(),
        }
    }
}

/// The vertex of a parabola through three points, where it lies between them and comes to zero or
/// beyond, or as near as a tenth of how much the three differ, from the side of all three.
fn vertex(x: [f64; 3], y: [f64; 3]) -> Option<f64> {
    let side = y[1].signum();
    if y.iter()
        .any(|value| value.signum() != side || *value == 0.0)
    {
        return None;
    }
    let [before, after] = [(y[1] - y[0]) / (x[1] - x[0]), (y[2] - y[1]) / (x[2] - x[1])];
    let curvature = (after - before) / (x[2] - x[0]);
    if !(curvature * side > 0.0) {
        return None;
    }
    // Newton's form: y₀ + before (x − x₀) + curvature (x − x₀)(x − x₁).
    let at = 0.5 * (x[0] + x[1]) - 0.5 * before / curvature;
    let value = y[0] + before * (at - x[0]) + curvature * (at - x[0]) * (at - x[1]);
    let spread =
        y.iter().copied().fold(f64::MIN, f64::max) - y.iter().copied().fold(f64::MAX, f64::min);
    let near = x[0] < at && at < x[2] && at != x[1] && value * side <= 0.1 * spread;
    near.then_some(at)
}
