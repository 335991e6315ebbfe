//! One tree in the system's coordinates.

use crate::dynamics::energy::EnergyAudit;
use crate::dynamics::integrate::{Impact, Modes};
use crate::dynamics::segment::{Peak, Segment, SegmentSignal, Signal};
use crate::exact::from_model::Part;
use crate::exact::{Ahead, Cursor, End, ExactTree, Refusal, Request};

/// An impact, and the coordinate whose speed jumps.
pub(super) type Struck = (Impact, usize);

/// A tree on its way: its present phase is a segment, whose objects are those of the
/// tree.
pub(crate) struct Branch<'a> {
    pub(crate) part: &'a Part,
    pub(crate) cursor: Cursor<'a>,
    /// q and q̇ at the instant looked at.
    q: Vec<f64>,
    v: Vec<f64>,
    /// ∫|δ| dt of every object, as far as it has been asked for.
    areas: Vec<f64>,
    /// Works, as far as they have been asked for.
    works: EnergyAudit,
}

impl<'a> Branch<'a> {
    pub(super) fn new(
        part: &'a Part,
        tree: &'a ExactTree,
        request: &Request,
        goes_on: &'a dyn Fn() -> bool,
    ) -> Result<Self, Refusal> {
        let masses = part.masses.len();
        Ok(Self {
            part,
            cursor: Cursor::of(tree, request, goes_on)?,
            q: vec![0.0; masses],
            v: vec![0.0; masses],
            areas: vec![0.0; part.objects.len()],
            works: EnergyAudit::default(),
        })
    }

    /// Sets the modes of its pairs as they are over the present phase.
    pub(super) fn take_modes(&self, modes: &mut Modes) {
        for &(mass, component) in &self.part.pairs {
            modes.0[component] = self.part.mode(mass, self.cursor.states()[mass]);
        }
    }

    /// The component and the mode after the switch that ended the present phase, and the
    /// impact that it is, with the coordinate that jumps.
    pub(super) fn switched(&self) -> Option<(usize, i64, Option<Struck>)> {
        let switch = self.cursor.switch()?;
        let own = |&&(mass, _): &&(usize, usize)| mass == switch.mass;
        let &(mass, component) = self.part.pairs.iter().find(own)?;
        let impact = switch.impact.map(|impact| {
            let impact = Impact {
                component,
                ..impact
            };
            (impact, self.part.masses[mass].coordinate)
        });
        Some((component, self.part.mode(mass, switch.after), impact))
    }

    /// Puts the tree's part of the state at the end of the present phase.
    pub(super) fn end_state(&self, y: &mut [f64]) {
        let (q, v) = self.cursor.end_state();
        self.part.put_state(q, v, y);
    }

    /// Bounds of the force of link 1 of its first object, which is all that the tree does
    /// to its law, between two instants of the present phase.
    pub(crate) fn force_ahead(&self, span: [f64; 2]) -> Ahead {
        let span = span.map(|time| self.cursor.local(time));
        self.cursor.force_ahead(0, span)
    }

    /// Force of link 1 of its first object and its slope at an instant of the present
    /// phase, by local time.
    pub(crate) fn force(&mut self, time: f64) -> End {
        let s = self.cursor.local(time);
        self.cursor.link_force(0, s)
    }

    /// Greatest rate of anything that matters between two instants of the present phase
    /// (rad/s).
    pub(crate) fn rate_ahead(&self, span: [f64; 2]) -> f64 {
        let span = span.map(|time| self.cursor.local(time));
        let objects = 0..self.part.objects.len();
        let rate = |object| self.cursor.acceleration_ahead(object, span).rate;
        objects.map(rate).fold(0.0, f64::max)
    }
}

impl Segment for Branch<'_> {
    fn state(&mut self, time: f64, y: &mut [f64]) {
        let s = self.cursor.local(time);
        self.cursor.state(s, &mut self.q, &mut self.v);
        self.part.put_state(&self.q, &self.v, y);
    }

    fn raise(&mut self, asked: SegmentSignal, peak: &mut Peak) {
        let figures = self.cursor.figures(asked.object);
        let times = &figures.times;
        let first = self.part.problem().objects[asked.object].first;
        let opens = self.part.problem().masses[first].pair.flanks().1 > 0;
        let (time, value) = match asked.signal {
            Signal::Deviation if asked.sign > 0.0 => (times.delta_max, figures.delta_max),
            Signal::Deviation => (times.delta_min, -figures.delta_min),
            // Found of either sign at once.
            Signal::Speed => (times.peak_speed, figures.peak_speed),
            Signal::Acceleration => (times.peak_acceleration, figures.peak_acceleration),
            Signal::Reaction => (times.peak_reaction, figures.peak_reaction),
            Signal::ContactForce if opens => (times.peak_reaction, figures.peak_reaction),
            Signal::Clearance => (times.max_lift, figures.max_lift),
            // (No tree has a massless point, and no pressure is linear.)
            Signal::ContactForce | Signal::Indentation | Signal::Pressure => return,
        };
        peak.include(time, value);
    }

    /// Found of either sign at once.
    fn raise_magnitude(&mut self, object: usize, signal: Signal, peak: &mut Peak) {
        let asked = SegmentSignal {
            object,
            signal,
            sign: 1.0,
        };
        self.raise(asked, peak);
    }

    fn area(&mut self, object: usize) -> f64 {
        let area = self.cursor.area(object);
        area - std::mem::replace(&mut self.areas[object], area)
    }

    fn works(&mut self) -> EnergyAudit {
        let Some(now) = self.cursor.audit() else {
            return EnergyAudit::default();
        };
        let before = std::mem::replace(&mut self.works, now);
        now.difference_from(&before)
    }
}
