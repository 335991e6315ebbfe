//! The machine reduced to its input link: J(φ), M(φ) and the work over a cycle.

use super::fit::fit_panels;
use super::given::FunctionKind;
use super::panel::COUNT;
use super::panel::{Panel, Point, SignedPoint, panel};
use super::refusal::Refusal;
use crate::math::roots::bracketed;
use std::f64::consts::TAU;

/// J(φ) and M(φ) over one cycle as polynomials on panels, followed to rounding.
///
/// The work is counted from the position where it is least, and panels grow
/// fine towards it: close to standing still nothing is lost by subtraction.
#[derive(Clone, Debug)]
pub struct Profile {
    cycle: f64,
    panels: Vec<Panel>,
    /// A(Φ).
    surplus: f64,
    /// |A(Φ)| up to this is rounding (J).
    rounding: f64,
    /// A at φ = 0, counted from the least.
    start: f64,
    least_work: Extreme,
    greatest_work: Extreme,
    least_inertia: Extreme,
    greatest_inertia: Extreme,
}

/// An extreme and where it is.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Extreme {
    /// The value.
    pub value: f64,
    /// Position (rad).
    pub at: f64,
}

/// Turns in a cycle at most.
pub const MOST_TURNS: f64 = 100.0;

/// A least J of less than this share of the greatest is none.
const NO_INERTIA: f64 = 1e-13;

/// Relative differences that are none between extremes.
const EXTREMES_AGREE: f64 = 64.0 * f64::EPSILON;

/// Halvings of the panels beside the least work.
const HALVINGS: i32 = 16;

impl Profile {
    /// Fits a cycle. `breaks` are the places inside it, ascending, at which a
    /// formula changes; `at` gives J and the moment or the work at a position,
    /// the piece between two breaks by its number.
    ///
    /// # Errors
    /// J is not above zero, a value is no number, or nothing follows the
    /// functions ([`Refusal`]); breaks that are not inside and ascending.
    pub fn new(
        cycle: f64,
        breaks: &[f64],
        given: FunctionKind,
        at: &mut dyn FnMut(usize, f64) -> [f64; 2],
    ) -> Result<Self, Refusal> {
        if !(cycle > 0.0 && cycle <= MOST_TURNS * TAU) {
            let message = format!("{cycle} rad is not above 0 and at most {MOST_TURNS} turns");
            return Err(Refusal::field("cycle", message, "for example 360 deg"));
        }
        let ascending = breaks.windows(2).all(|pair| pair[0] < pair[1]);
        if !ascending || breaks.iter().any(|&at| !(at > 0.0 && at < cycle)) {
            let message = "the breaks do not ascend within the cycle";
            return Err(Refusal::field("breaks", message, ""));
        }
        let panels = fit_panels(cycle, breaks, given, at)?;
        let panels = panels.into_iter().map(|fitted| panel(fitted, given));
        Self::of(cycle, panels.collect())
    }

    fn of(cycle: f64, panels: Vec<Panel>) -> Result<Self, Refusal> {
        let surplus = panels.iter().map(Panel::work_over_panel).sum();
        let mut profile = Self {
            cycle,
            panels,
            surplus,
            rounding: 0.0,
            start: 0.0,
            least_work: NOWHERE,
            greatest_work: NOWHERE,
            least_inertia: NOWHERE,
            greatest_inertia: NOWHERE,
        };
        profile.count_from_start();
        let least = profile.extreme(-1.0, &|point| [point.rise_signed, point.moment]);
        profile.refine(least.at);
        profile.count_work_from(least.at);
        profile.start = profile.at(0.0).rise;
        profile.least_work = Extreme {
            value: -profile.start,
            at: least.at,
        };
        let greatest = profile.extreme(1.0, &|point| [point.rise_signed, point.moment]);
        profile.greatest_work = Extreme {
            value: greatest.value - profile.start,
            at: greatest.at,
        };
        let inertia = |point: &SignedPoint| [point.inertia, point.inertia_slope];
        profile.least_inertia = profile.extreme(-1.0, &inertia);
        profile.greatest_inertia = profile.extreme(1.0, &inertia);
        let Extreme { value, at } = profile.least_inertia;
        if !(value > NO_INERTIA * profile.greatest_inertia.value) {
            return Err(Refusal::Inertia {
                position: at,
                inertia: value,
            });
        }
        Ok(profile)
    }

    /// Work counted from φ = 0 on.
    fn count_from_start(&mut self) {
        let mut base = 0.0;
        for panel in &mut self.panels {
            panel.count(base, false);
            base += panel.work_over_panel();
        }
    }

    /// Cuts the panels at `place`, and finer and finer towards it.
    fn refine(&mut self, place: f64) {
        let mut cuts = Vec::new();
        for panel in &self.panels {
            let (from, to) = (panel.from, panel.to);
            let (before, after) = (place - from, to - place);
            if before < 0.0 || after < 0.0 {
                continue;
            }
            for k in 0..=HALVINGS {
                cuts.push(place - before * 0.5f64.powi(k));
                cuts.push(place + after * 0.5f64.powi(k));
            }
            cuts.push(place);
        }
        cuts.sort_by(f64::total_cmp);
        cuts.dedup();
        let mut panels = Vec::with_capacity(self.panels.len() + cuts.len());
        for panel in &self.panels {
            let inside = cuts.iter().filter(|&&c| c > panel.from && c < panel.to);
            let mut from = panel.from;
            for &cut in inside {
                panels.push(panel.part_between(from, cut));
                from = cut;
            }
            panels.push(if from == panel.from {
                panel.clone()
            } else {
                panel.part_between(from, panel.to)
            });
        }
        self.panels = panels;
    }

    /// Work counted from `place`, an end of panels, to both sides.
    fn count_work_from(&mut self, place: f64) {
        let middle = self.panels.partition_point(|panel| panel.to <= place);
        let mut base = 0.0;
        for panel in &mut self.panels[middle..] {
            panel.count(base, false);
            base += panel.work_over_panel();
        }
        base = 0.0;
        for panel in self.panels[..middle].iter_mut().rev() {
            panel.count(base, true);
            base -= panel.work_over_panel();
        }
    }

    /// The profile where work left over in a cycle is rounding up to `work` (J).
    #[must_use]
    pub fn with_rounding(self, work: f64) -> Self {
        Self {
            rounding: work,
            ..self
        }
    }

    /// The profile with a constant moment added.
    ///
    /// # Errors
    /// As [`Profile::new`].
    pub fn with_moment(&self, moment: f64) -> Result<Self, Refusal> {
        self.with_changed_panels(|panel| panel.moment[0] += moment)
    }

    /// The profile with a constant moment of inertia added.
    ///
    /// # Errors
    /// As [`Profile::new`].
    pub fn with_inertia(&self, inertia: f64) -> Result<Self, Refusal> {
        self.with_changed_panels(|panel| panel.inertia[0] += inertia)
    }

    fn with_changed_panels(&self, change: impl Fn(&mut Panel)) -> Result<Self, Refusal> {
        let mut panels = self.panels.clone();
        panels.iter_mut().for_each(change);
        let changed = Self::of(self.cycle, panels)?;
        Ok(changed.with_rounding(self.rounding))
    }

    /// Φ (rad).
    pub fn cycle(&self) -> f64 {
        self.cycle
    }

    /// A(Φ): the work of all forces in a cycle (J).
    pub fn work_of_cycle(&self) -> f64 {
        self.surplus
    }

    /// |A(Φ)| up to this is rounding (J).
    pub(super) fn rounding(&self) -> f64 {
        self.rounding
    }

    /// The least work since φ = 0 (J), and where.
    pub fn least_work(&self) -> Extreme {
        self.least_work
    }

    /// The greatest work since φ = 0 (J), and where.
    pub fn greatest_work(&self) -> Extreme {
        self.greatest_work
    }

    /// Greatest less least work (J).
    pub fn range(&self) -> f64 {
        self.greatest_work.value - self.least_work.value
    }

    /// The least J, and the first position where it is reached.
    pub fn least_inertia(&self) -> Extreme {
        self.least_inertia
    }

    /// The greatest J, and where.
    pub fn greatest_inertia(&self) -> Extreme {
        self.greatest_inertia
    }

    pub(super) fn panels(&self) -> &[Panel] {
        &self.panels
    }

    /// The panel that a position lies in.
    pub(super) fn panel(&self, position: f64) -> &Panel {
        let index = self.panels.partition_point(|panel| panel.to <= position);
        &self.panels[index.min(self.panels.len() - 1)]
    }

    /// The machine at a position of [0, Φ]; at a break just after it.
    pub fn at(&self, position: f64) -> Point {
        self.panel(position).at(position)
    }

    /// The greatest (`sense` 1) or least (−1) of a function, given with its
    /// derivative in φ; the first position where it is reached.
    pub(super) fn extreme(
        &self,
        sense: f64,
        function: &dyn Fn(&SignedPoint) -> [f64; 2],
    ) -> Extreme {
        let value = |panel: &Panel, place: f64| sense * function(&panel.signed(place))[0];
        let mut best = (f64::NEG_INFINITY, 0, 0.0, [0.0; 2]);
        for (index, panel) in self.panels.iter().enumerate() {
            let count = 2 * COUNT;
            let place = |i: usize| match i {
                0 => panel.from,
                i if i == count => panel.to,
                i => panel.from + (panel.to - panel.from) * i as f64 / count as f64,
            };
            for i in 0..=count {
                let found = value(panel, place(i));
                let rounding = EXTREMES_AGREE * best.0.abs();
                if found > best.0 + rounding || best.0 == f64::NEG_INFINITY {
                    let around = [place(i.saturating_sub(1)), place((i + 1).min(count))];
                    best = (found, index, place(i), around);
                }
            }
        }
        let (found, index, at, around) = best;
        let sample = Extreme {
            value: sense * found,
            at,
        };
        // An extreme at the end of a panel may be the foot of one in the next.
        let (count, panel) = (self.panels.len(), &self.panels[index]);
        let mut places = vec![(panel, around)];
        let share = 0.5 / COUNT as f64;
        if at >= panel.to {
            let next = &self.panels[(index + 1) % count];
            places.push((next, [next.from, next.from + share * (next.to - next.from)]));
        }
        if at <= panel.from {
            let last = &self.panels[(index + count - 1) % count];
            places.push((last, [last.to - share * (last.to - last.from), last.to]));
        }
        let mut top = sample;
        for (panel, [low, high]) in places {
            let mut slope = |place: f64| sense * function(&panel.signed(place))[1];
            if !(slope(low) > 0.0 && slope(high) < 0.0) {
                continue;
            }
            let at = bracketed(&mut slope, [low, high], 0.0).at;
            let found = sense * value(panel, at);
            // Within a panel the slope knows the place better than the values.
            let inside = around[0] < sample.at && sample.at < around[1];
            let rounding = EXTREMES_AGREE * top.value.abs();
            if sense * (found - top.value) > rounding || inside {
                top = Extreme { value: found, at };
            }
        }
        top
    }
}

const NOWHERE: Extreme = Extreme {
    value: 0.0,
    at: 0.0,
};
