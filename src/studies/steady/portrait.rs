//! A motion over the angle of its drive, as it is shown.

use super::sink::LEFT_OVER;
use crate::dynamics::integrate::{Dynamics, Modes, Sink, SwitchEvent};
use crate::dynamics::steady::Extreme;
use crate::dynamics::system::{Scratch, System};
use crate::math::optimise::{Peak, brent, golden};
use crate::math::polynomial::Step;
use crate::math::quadrature::rule;
use crate::math::roots::bracketed;

/// The motion where the drive stands at an angle.
#[derive(Clone, Debug)]
pub(super) struct Row {
    /// φ (rad).
    pub(super) position: f64,
    /// t (s).
    pub(super) time: f64,
    /// ω (rad/s).
    pub(super) speed: f64,
    /// ε (rad/s²).
    pub(super) acceleration: f64,
    /// The state [u, u̇].
    pub(super) y: Vec<f64>,
}

/// Listens to a motion from φ = 0 on.
#[derive(Debug)]
pub(super) struct Portrait<'a> {
    system: &'a System,
    scratch: Scratch,
    rotor: usize,
    /// φ of the rows to come lies so far apart (rad).
    spacing: f64,
    count: usize,
    rule: Vec<(f64, f64)>,
    last: (Vec<f64>, Modes),
    /// The rows, both ends included.
    pub(super) rows: Vec<Row>,
    /// Least ω.
    pub(super) least: Extreme,
    /// Greatest ω.
    pub(super) greatest: Extreme,
    /// ∫ω² dt = ∫ω dφ (rad²/s).
    pub(super) speed_by_angle: f64,
}

/// Places of a step at which extremes are looked for.
const LOOKS: usize = 8;
/// Places of Gauss's rule in a step: ω² is known as well as ω.
const PLACES: usize = 12;
/// Part of a look that tells which way a speed changes at the end of a step.
const NUDGE: f64 = 1e-3;
/// Steps of golden section: a speed is as flat as its rounding beyond.
const SECTIONS: u32 = 40;
/// An extreme is found to this part of a look.
const LOCATED: f64 = 1e-9;

impl<'a> Portrait<'a> {
    pub(super) fn new(system: &'a System, rotor: usize, angle: f64, count: usize) -> Self {
        let nowhere = |value| Extreme { value, at: 0.0 };
        Self {
            scratch: system.scratch(),
            system,
            rotor,
            spacing: angle / count as f64,
            count,
            rule: rule(PLACES),
            last: (Vec::new(), Modes::default()),
            rows: Vec::with_capacity(count + 1),
            least: nowhere(f64::INFINITY),
            greatest: nowhere(f64::NEG_INFINITY),
            speed_by_angle: 0.0,
        }
    }

    fn row(&mut self, time: f64, y: &[f64], modes: &Modes) {
        let mut dy = vec![0.0; y.len()];
        self.system
            .derivatives(0.0, y, modes, &mut self.scratch, &mut dy);
        let speed = self.system.coordinates() + self.rotor;
        self.rows.push(Row {
            position: self.spacing * self.rows.len() as f64,
            time,
            speed: y[speed],
            acceleration: dy[speed],
            y: y.to_vec(),
        });
    }

    /// The last row, at the end, where the state is known.
    pub(super) fn finish(&mut self, time: f64, y: &[f64]) {
        let modes = std::mem::take(&mut self.last.1);
        self.rows.truncate(self.count);
        self.row(time, y, &modes);
    }

    fn sample_step(&mut self, step: &Step<'_>) {
        // What a switch next to the end leaves over holds rounding in place of speeds.
        if step.end * step.length < LEFT_OVER * step.end_time() {
            return;
        }
        let speed = |s: f64| step.value(self.rotor, s).1;
        let place = |s: f64| step.value(self.rotor, s).0;
        for sense in [1.0, -1.0] {
            let worth = |i: usize| sense * speed(step.end * i as f64 / LOOKS as f64);
            let best = (0..=LOOKS).max_by(|&a, &b| worth(a).total_cmp(&worth(b)));
            let best = best.unwrap_or(0);
            let at = |i: usize| step.end * i as f64 / LOOKS as f64;
            let mut peak = Peak {
                at: at(best),
                value: worth(best),
            };
            if best > 0 && best < LOOKS {
                let ends = [at(best - 1), at(best + 1)];
                peak = brent(peak, ends, LOCATED, &mut |s| sense * speed(s));
            } else {
                // An extreme may lie just within the end.
                let beside = at(if best == 0 { 1 } else { LOOKS - 1 });
                let inwards = peak.at + NUDGE * (beside - peak.at);
                if sense * speed(inwards) > peak.value {
                    let ends = [peak.at.min(beside), peak.at.max(beside)];
                    peak = golden(&mut |s| sense * speed(s), ends, SECTIONS);
                }
            }
            let found = Extreme {
                value: sense * peak.value,
                at: place(peak.at),
            };
            if sense > 0.0 && found.value > self.greatest.value {
                self.greatest = found;
            }
            if sense < 0.0 && found.value < self.least.value {
                self.least = found;
            }
        }
        let squares = self.rule.iter().map(|&(place, weight)| {
            let speed = speed(step.end * place);
            weight * speed * speed
        });
        self.speed_by_angle += step.end * step.length * squares.sum::<f64>();
    }
}

impl Sink for Portrait<'_> {
    fn start(&mut self, time: f64, y: &[f64], modes: &Modes) {
        self.last = (y.to_vec(), modes.clone());
        self.row(time, y, modes);
    }

    fn step(&mut self, step: &Step<'_>, modes: &Modes) {
        self.sample_step(step);
        let mut y = self.last.0.clone();
        while self.rows.len() < self.count {
            let target = self.spacing * self.rows.len() as f64;
            let beyond = |s: f64| step.value(self.rotor, s).0 - target;
            if beyond(step.end) < 0.0 {
                break;
            }
            let s = bracketed(&mut |s| beyond(s), [0.0, step.end], 0.0).at;
            step.state(s, &mut y);
            self.row(step.time(s), &y, modes);
        }
        step.state(step.end, &mut y);
        self.last = (y, modes.clone());
    }

    fn switch(&mut self, event: &SwitchEvent<'_>) {
        self.last = (event.y.to_vec(), event.after.clone());
    }
}
