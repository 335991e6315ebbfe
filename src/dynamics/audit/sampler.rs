//! Instants and switches of a run that are drawn at random for its check.

use crate::dynamics::integrate::{Impact, Modes, SwitchEvent};

/// The seed of all draws.
pub(crate) const SEED: u64 = 0x00da_5eed;

/// Instants that are drawn in a run.
const INSTANTS: usize = 6;

/// Stretches that are drawn in a run, short and long ones with the same chance: a formula
/// that holds for a short time alone is looked at too.
const STRETCHES: usize = 5;

/// Stretches shorter than this share of the time are not looked at.
const BRIEFEST: f64 = 1e-6;

/// Switches that are kept.
const SWITCHES: usize = 8;

/// Most numbers of states that are kept.
const ROOM: usize = 1 << 20;

/// Places between the ends of a window: Gauss's, for an integral over it.
pub(super) const PLACES: [f64; 6] = [
    0.033_765_242_898_423_99,
    0.169_395_306_766_867_74,
    0.380_690_406_958_401_56,
    0.619_309_593_041_598_5,
    0.830_604_693_233_132_2,
    0.966_234_757_101_576,
];

/// Their weights.
pub(super) const WEIGHTS: [f64; 6] = [
    0.085_662_246_189_585_18,
    0.180_380_786_524_069_3,
    0.233_956_967_286_345_52,
    0.233_956_967_286_345_52,
    0.180_380_786_524_069_3,
    0.085_662_246_189_585_18,
];

/// Lengths of the windows about an instant, in that of the first: where forces change too
/// fast for a long one, a shorter one resolves them.
const LENGTHS: [f64; 2] = [1.0, 0.03125];

/// Share of a step that is looked at.
const PART: f64 = 0.45;

/// States over a short time without switches: at its ends, and at [`PLACES`] between them.
#[derive(Clone, Debug)]
pub(crate) struct Window {
    pub(super) times: Vec<f64>,
    /// y at each of the times.
    pub(super) states: Vec<Vec<f64>>,
}

/// An instant that was drawn, with windows about it, the longest first.
#[derive(Clone, Debug)]
pub(crate) struct DrawnInstant {
    pub(super) modes: Modes,
    pub(super) windows: Vec<Window>,
}

/// Roundings of the instant of a switch.
pub(super) const LATE: f64 = 64.0 * f64::EPSILON;

/// A state at the end of a stretch, the one beside it by roundings of the instant, and how
/// long the stretch is.
#[derive(Clone, Debug)]
pub(crate) struct StretchEnd {
    pub(super) state: Vec<f64>,
    pub(super) beside: Vec<f64>,
    pub(super) length: f64,
}

impl StretchEnd {
    fn new(entries: usize) -> Self {
        Self {
            state: vec![0.0; entries],
            beside: vec![0.0; entries],
            length: 0.0,
        }
    }

    /// Sees the end at a time of the stretch [from, until].
    fn note_end(&mut self, time: f64, span: [f64; 2], state: &mut dyn FnMut(f64, &mut [f64])) {
        let off = LATE * time.abs();
        let beside = if time > span[0] {
            time - off
        } else {
            time + off
        };
        state(time, &mut self.state);
        state(beside.clamp(span[0], span[1]), &mut self.beside);
        self.length = span[1] - span[0];
    }
}

/// A switch that was drawn.
#[derive(Clone, Debug)]
pub(crate) struct Turn {
    pub(super) time: f64,
    /// State before and after it, where the stretch before it ended and where the next one
    /// begins.
    pub(super) before: Vec<f64>,
    pub(super) after: Vec<f64>,
    pub(super) last: Option<StretchEnd>,
    pub(super) next: Option<StretchEnd>,
    pub(super) modes: [Modes; 2],
    pub(super) impact: Option<Impact>,
}

/// Looks at a run that were drawn.
#[derive(Clone, Debug, Default)]
pub(crate) struct DrawnInstants {
    pub(super) looks: Vec<DrawnInstant>,
    pub(super) turns: Vec<Turn>,
    /// Switches met.
    pub(super) switches: usize,
    /// When the run ended, and when it was to end (s).
    pub(super) end: [f64; 2],
}

/// A number drawn by a seed (SplitMix64).
pub(crate) fn draw(seed: u64) -> u64 {
    let mut x = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// Draws instants and switches of a run, and keeps the states there.
#[derive(Debug)]
pub(crate) struct InstantSampler {
    random: u64,
    duration: f64,
    instants: usize,
    /// Number of the next instant, and when it is.
    number: usize,
    due: f64,
    /// Longest window where the motion is known in closed form (s).
    longest: f64,
    entries: usize,
    found: DrawnInstants,
    /// The switch whose next stretch is to come.
    awaits: Option<usize>,
    /// The place that the next switch is kept at, and the end of the stretch before it.
    place: usize,
    last: Option<(f64, StretchEnd)>,
    /// Stretches met, and looks at those that are drawn.
    stretches: usize,
    drawn: Vec<DrawnInstant>,
}

impl InstantSampler {
    /// For a run of `duration` (s) whose states have so many entries and whose fastest rate
    /// is given (1/s); `None`: nothing is drawn.
    pub(crate) fn new(duration: f64, entries: usize, rate: f64) -> Self {
        let each = entries.max(1) * LENGTHS.len() * (PLACES.len() + 2);
        let mut looker = Self {
            random: SEED,
            duration,
            instants: INSTANTS.min(ROOM / each).max(1),
            number: 0,
            due: 0.0,
            longest: if rate > 0.0 {
                1.0 / rate
            } else {
                f64::INFINITY
            },
            entries,
            found: DrawnInstants::default(),
            awaits: None,
            place: 0,
            last: None,
            stretches: 0,
            drawn: Vec::new(),
        };
        looker.draw();
        looker
    }

    /// One that draws nothing.
    pub(crate) fn drawing_nothing() -> Self {
        Self {
            instants: 0,
            due: f64::INFINITY,
            ..Self::new(0.0, 0, 0.0)
        }
    }

    /// A number in [0, 1).
    fn random_share(&mut self) -> f64 {
        self.random = self.random.wrapping_add(1);
        (draw(self.random) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// The next instant, one in each of equal parts of the run.
    fn draw(&mut self) {
        if self.number >= self.instants {
            self.due = f64::INFINITY;
            return;
        }
        let place = (self.number as f64 + self.random_share()) / self.instants as f64;
        self.number += 1;
        self.due = place * self.duration;
    }

    /// A stretch without switches, whose states `state` puts; `closed`: in closed form, to be
    /// looked at in short pieces.
    pub(crate) fn stretch(
        &mut self,
        [from, until]: [f64; 2],
        modes: &Modes,
        closed: bool,
        state: &mut dyn FnMut(f64, &mut [f64]),
    ) {
        self.found.end = [until, self.duration];
        // (Of a stretch that is hardly longer than rounding of the time nothing is known.)
        if self.instants > 0 && until - from > BRIEFEST * until.abs() {
            self.draw_stretch([from, until], modes, closed, state);
        }
        let keeps_end = self.place < SWITCHES && self.instants > 0;
        if until < self.due && self.awaits.is_none() && !keeps_end {
            return;
        }
        if keeps_end {
            let entries = self.entries;
            let (time, end) = self
                .last
                .get_or_insert_with(|| (until, StretchEnd::new(entries)));
            *time = until;
            end.note_end(until, [from, until], state);
        }
        if let Some(turn) = self.awaits.take() {
            let mut end = StretchEnd::new(self.entries);
            end.note_end(from, [from, until], state);
            self.found.turns[turn].next = Some(end);
        }
        while self.due <= until {
            if until > from {
                let longest = self.longest_in([from, until], closed);
                let due = self.due.max(from);
                let window = |share: &f64| {
                    let length = longest * share;
                    let begin = (due - 0.5 * length).min(until - length).max(from);
                    self.window([begin, length], state)
                };
                let windows = LENGTHS.iter().map(window).collect();
                self.found.looks.push(DrawnInstant {
                    modes: modes.clone(),
                    windows,
                });
            }
            self.draw();
        }
    }

    /// The longest window in a stretch.
    fn longest_in(&self, [from, until]: [f64; 2], closed: bool) -> f64 {
        // (A step is balanced at its ends by whatever was integrated: part of it.)
        match closed {
            true => self.longest.min(until - from),
            false => PART * (until - from),
        }
    }

    /// Keeps a look at a stretch: each with the same chance.
    fn draw_stretch(
        &mut self,
        span: [f64; 2],
        modes: &Modes,
        closed: bool,
        state: &mut dyn FnMut(f64, &mut [f64]),
    ) {
        self.stretches += 1;
        let kept = self.drawn.len();
        let place = match kept < STRETCHES {
            true => kept,
            false => (self.random_share() * self.stretches as f64) as usize,
        };
        if place >= STRETCHES {
            return;
        }
        let length = self.longest_in(span, closed);
        let begin = span[0] + self.random_share() * (span[1] - span[0] - length);
        let window = |share: &f64| {
            let short = share * length;
            self.window([begin + 0.5 * (length - short), short], state)
        };
        let windows = LENGTHS.iter().map(window).collect();
        let look = DrawnInstant {
            modes: modes.clone(),
            windows,
        };
        match place == kept {
            true => self.drawn.push(look),
            false => self.drawn[place] = look,
        }
    }

    fn window(&self, [begin, length]: [f64; 2], state: &mut dyn FnMut(f64, &mut [f64])) -> Window {
        let shares = std::iter::once(0.0).chain(PLACES).chain([1.0]);
        let times: Vec<f64> = shares.map(|share| begin + share * length).collect();
        let states = times.iter().map(|&time| {
            let mut y = vec![0.0; self.entries];
            state(time, &mut y);
            y
        });
        let states = states.collect();
        Window { times, states }
    }

    /// A switch: each is kept with the same chance.
    pub(crate) fn switch(&mut self, event: &SwitchEvent<'_>) {
        if self.instants == 0 {
            return;
        }
        self.found.switches += 1;
        let (place, kept) = (self.place, self.found.turns.len());
        self.place = match kept + 1 < SWITCHES {
            true => kept + 1,
            false => (self.random_share() * (self.found.switches + 1) as f64) as usize,
        };
        if place >= SWITCHES {
            return;
        }
        let last = self.last.as_ref().filter(|last| last.0 == event.time);
        let turn = Turn {
            time: event.time,
            before: event.impact.map_or(event.y, |(_, before)| before).to_vec(),
            after: event.y.to_vec(),
            last: last.map(|last| last.1.clone()),
            next: None,
            modes: [event.before.clone(), event.after.clone()],
            impact: event.impact.map(|(impact, _)| *impact),
        };
        match place == kept {
            true => self.found.turns.push(turn),
            false => self.found.turns[place] = turn,
        }
        self.awaits = Some(place);
    }

    /// What was drawn.
    pub(crate) fn finish(mut self) -> DrawnInstants {
        self.found.looks.append(&mut self.drawn);
        self.found
    }
}

#[cfg(test)]
impl DrawnInstants {
    /// The same of a run that ended late by a share of its time.
    pub(crate) fn late(mut self, share: f64) -> Self {
        self.end[0] = self.end[1] * (1.0 + share);
        self
    }

    /// The same of a run in which an entry of the state grows by `rate` (1/s) beside what it was.
    pub(crate) fn moved(mut self, entry: usize, rate: f64) -> Self {
        for window in self.looks.iter_mut().flat_map(|look| &mut look.windows) {
            for (time, state) in window.times.iter().zip(&mut window.states) {
                state[entry] += rate * time;
            }
        }
        self
    }
}
