//! The law of a tree over the angle of its drive, and its Fourier coefficients.

use crate::dynamics::model::{Model, NodeIndex, NodeMotion};
use crate::kinematics::motion::DriveMotion;
use crate::kinematics::position::Position;
use crate::math::fourier::{TermsOnInterval, coefficient};
use crate::math::quadrature::integrate;
use nalgebra::Complex;
use std::f64::consts::TAU;

type C = Complex<f64>;

/// Parts of a period that are integrated by themselves where a law has no closed form.
const PANELS: usize = 64;

/// Error of such an integral, in units of the law.
const TOLERANCE: f64 = 1e-15;

/// A law over the angle of its drive: U = outer·P(inner·φ + shift) + …, P periodic.
#[derive(Clone, Debug)]
pub(super) struct OrderedLaw {
    /// The node of the drive.
    pub(super) drive: NodeIndex,
    /// Speed of the drive (rad/s).
    pub(super) speed: f64,
    /// Angle of the drive at t = 0 (rad).
    pub(super) angle: f64,
    position: Position,
    inner: [f64; 2],
    outer: f64,
    /// Period of P over its argument, and its gain in it.
    period: (f64, f64),
    pieces: Option<Vec<TermsOnInterval>>,
}

impl OrderedLaw {
    /// The law that a node follows.
    ///
    /// # Errors
    /// Why it has no orders, in a sentence.
    pub(super) fn of(model: &Model, node: NodeIndex) -> Result<Self, String> {
        let mut laws = Vec::new();
        let mut at = node;
        let ([speed, angle], drive) = loop {
            match &model.nodes[at].motion {
                NodeMotion::Mass { law } | NodeMotion::Rigid { law } => {
                    laws.push(law);
                    at = law.driver;
                }
                NodeMotion::Prescribed { motion, .. } => match motion {
                    DriveMotion::Constant { speed, angle } => break ([*speed, *angle], at),
                    _ => return Err("its drive does not turn at constant speed".to_owned()),
                },
                NodeMotion::Rotor { .. } => return Err("a motor turns it".to_owned()),
                NodeMotion::Constrained { .. } => {
                    return Err("its motion is the sum of several drives".to_owned());
                }
            }
        };
        let (mut inner, mut outer) = ([1.0, 0.0], 1.0);
        let mut found: Option<&Position> = None;
        for law in laws.iter().rev() {
            match (law.position.straight_line(), found) {
                (Some([ratio, offset]), None) => {
                    inner =
                        [ratio * inner[0], ratio * inner[1] + offset].map(|own| law.lever * own);
                }
                (Some([ratio, _]), Some(_)) => outer *= law.lever * ratio,
                (None, None) => {
                    found = Some(&law.position);
                    outer = law.lever;
                }
                (None, Some(_)) => {
                    let why = "two functions that are no straight lines lead to it";
                    return Err(why.to_owned());
                }
            }
        }
        let Some(position) = found else {
            return Err("its law is a straight line, which has no orders".to_owned());
        };
        let Some(period) = position.period() else {
            return Err("its law does not repeat".to_owned());
        };
        Ok(Self {
            drive,
            speed,
            angle,
            pieces: position.closed_form(),
            position: position.clone(),
            inner,
            outer,
            period,
        })
    }

    /// Orders of the drive between two coefficients: 1 of a function that repeats once in a turn.
    pub(super) fn spacing(&self) -> f64 {
        TAU * self.inner[0].abs() / self.period.0
    }

    /// Whether coefficients follow in closed form.
    pub(super) fn is_closed(&self) -> bool {
        self.pieces.is_some()
    }

    /// The coefficient u of e^{i·number·spacing·φ}; number from 1.
    pub(super) fn coefficient(&self, number: usize) -> C {
        let (period, gain) = self.period;
        let number = number as f64;
        let own = match &self.pieces {
            Some(pieces) => coefficient(pieces, period, number),
            None => self.integral(number),
        };
        // What it gains in each period is a ramp, x·gain/period: its part of a period from the
        // first place on goes.
        let start = match &self.pieces {
            Some(pieces) => pieces
                .first()
                .map_or(0.0, |piece| piece.middle - piece.half),
            None => 0.0,
        };
        let ramp = C::new(0.0, gain / (TAU * number)) * wave(-TAU * number * start / period);
        let own = (own - ramp) * wave(TAU * number * self.inner[1] / period) * self.outer;
        // Backwards the order of the drive is the conjugate.
        match self.inner[0] < 0.0 {
            true => own.conj(),
            false => own,
        }
    }

    /// (1/period)·∫P·e^{−iκx} dx from 0 on, by quadrature.
    fn integral(&self, number: f64) -> C {
        let period = self.period.0;
        let kappa = TAU * number / period;
        let breaks = self.position.breaks();
        let value = |x: f64| self.position.jet(breaks.segment_at(x, 1.0), x).value;
        let size = (0..PANELS).map(|i| value(period * i as f64 / PANELS as f64).abs());
        let tolerance = TOLERANCE * period * size.fold(0.0, f64::max) / PANELS as f64;
        let part = |of: fn(f64) -> f64| {
            let panel = |i: usize| {
                let at = |i: usize| period * i as f64 / PANELS as f64;
                integrate(&|x| value(x) * of(kappa * x), at(i), at(i + 1), tolerance).value
            };
            (0..PANELS).map(panel).sum::<f64>() / period
        };
        C::new(part(f64::cos), -part(f64::sin))
    }
}

/// e^{ix}.
fn wave(x: f64) -> C {
    C::from_polar(1.0, x)
}
