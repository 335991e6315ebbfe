//! One tree in the system's coordinates.

use crate::exact::from_model::Part;
use crate::exact::{Cursor, ExactTree, MOST_ORDERS, Refusal};
use crate::integrate::Modes;

/// Radians of a mode of some size that a step may span: five-point quadrature
/// of its power is then exact to about 1e-12.
const POWER_RADIANS: f64 = 0.7;

/// Relative size of a mode's speed above which its power matters.
const POWER_SHARE: f64 = 1e-4;

/// 16!·4⁸·1e-15: the error of the polynomial of degree 15 with eight
/// derivatives given at either end is size·(|λ|h)¹⁶/(16!·4⁸).
const HERMITE: f64 = 1371.0;

/// A tree on its way.
pub(super) struct Branch<'a> {
    pub(super) part: &'a Part,
    pub(super) cursor: Cursor<'a>,
    /// q and its derivatives at the instant looked at.
    q: Vec<f64>,
}

impl<'a> Branch<'a> {
    pub(super) fn new(part: &'a Part, tree: &'a ExactTree, end: f64) -> Result<Self, Refusal> {
        Ok(Self {
            part,
            cursor: Cursor::new(tree, end)?,
            q: vec![0.0; part.masses.len() * MOST_ORDERS],
        })
    }

    /// Sets the modes of its pairs as they are over the present phase.
    pub(super) fn take_modes(&self, modes: &mut Modes) {
        for &(mass, component) in &self.part.pairs {
            modes.0[component] = self.part.mode(mass, self.cursor.states()[mass]);
        }
    }

    /// The component and the mode after the switch that ended the present phase.
    pub(super) fn switched(&self) -> Option<(usize, i64)> {
        let switch = self.cursor.switch()?;
        let own = |&&(mass, _): &&(usize, usize)| mass == switch.mass;
        let &(mass, component) = self.part.pairs.iter().find(own)?;
        Some((component, self.part.mode(mass, switch.after)))
    }

    /// Evaluates the present phase at an instant.
    pub(super) fn look_at(&mut self, time: f64) {
        let s = self.cursor.local(time).clamp(0.0, self.cursor.length());
        self.cursor.derivatives(s, MOST_ORDERS, &mut self.q);
    }

    /// The `order`-th derivative of u of a mass.
    pub(super) fn deviation(&self, mass: usize, order: usize) -> f64 {
        let own = self.q[mass * MOST_ORDERS + order];
        match self.part.masses[mass].base {
            Some((base, ratio)) => own - ratio * self.q[base * MOST_ORDERS + order],
            None => own,
        }
    }

    /// Puts the state and its derivative into the system's.
    pub(super) fn put(&self, y: &mut [f64], dy: &mut [f64]) {
        let n = y.len() / 2;
        for (mass, place) in self.part.masses.iter().enumerate() {
            let (u, v) = (place.coordinate, n + place.coordinate);
            y[u] = self.deviation(mass, 0);
            y[v] = self.deviation(mass, 1);
            dy[u] = y[v];
            dy[v] = self.deviation(mass, 2);
        }
    }

    /// Longest step (s) from `time` on, the state there having been looked at.
    pub(super) fn longest(&self, time: f64) -> f64 {
        let s = self.cursor.local(time).clamp(0.0, self.cursor.length());
        let places = self.q.chunks_exact(MOST_ORDERS).map(|q| q[0].abs());
        let mut size = places.fold(0.0, f64::max);
        let speeds = self.q.chunks_exact(MOST_ORDERS).map(|q| q[1].abs());
        let mut speed = speeds.fold(0.0, f64::max);
        self.cursor.lanes(s, |rate, own| {
            size = size.max(own);
            speed = speed.max(rate * own);
        });
        let mut longest = self.cursor.pace();
        self.cursor.lanes(s, |rate, own| {
            if rate == 0.0 || own == 0.0 {
                return;
            }
            let mut radians = (HERMITE * size / own).powf(1.0 / 16.0);
            if rate * own >= POWER_SHARE * speed {
                radians = radians.min(POWER_RADIANS);
            }
            longest = longest.min(radians / rate);
        });
        longest
    }
}
