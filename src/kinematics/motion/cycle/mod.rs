//! Plans of motion: any number of rises, dwells and returns joined on a table
//! of angles or times.
//!
//! Between stations the motion is a dwell, uniform, a law from rest to rest,
//! or *smooth*: the polynomial of least degree that takes speed and
//! acceleration (jerk, where asked) of its neighbours at both ends. Where two
//! smooth motions meet and nothing is prescribed, the derivatives there are
//! those for which the next higher derivatives are continuous too, as in a
//! spline; all of them are found together from one linear system.

mod joints;
mod spec;
#[cfg(test)]
mod tests;

pub(crate) use spec::MOST_STATIONS;
pub use spec::{CycleSpec, Motion, Station, USUAL_ORDER};

use crate::fault::{Fault, Faults};
use crate::kinematics::breaks::Breaks;
use crate::kinematics::motion::law::{EndPolynomial, Jump, Law};
use crate::math::fourier::{Terms, TermsOnInterval};
use crate::math::jet::Jet;

/// A plan of motion, ready to be evaluated.
#[derive(Clone, Debug, PartialEq)]
pub struct Cycle {
    spec: CycleSpec,
    segments: Vec<Segment>,
    pieces: Vec<Piece>,
    breaks: Breaks,
}

/// The motion from one station to the next.
#[derive(Clone, Debug, PartialEq)]
struct Segment {
    /// The driver's displacement where it begins.
    from: f64,
    /// Length of the segment.
    span: f64,
    /// Displacements at both ends.
    ends: [f64; 2],
    shape: Shape,
}

#[derive(Clone, Debug, PartialEq)]
enum Shape {
    Dwell,
    Uniform,
    Law(Box<Law>),
    /// In x = (φ − from)/span; gives the displacement itself.
    Smooth(Box<EndPolynomial>),
}

/// A piece between two break points: a segment and the part of its law.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece {
    segment: usize,
    part: usize,
}

impl Segment {
    fn jet(&self, part: usize, phi: f64) -> Jet {
        let [start, end] = self.ends;
        let (stroke, x) = (end - start, (phi - self.from) / self.span);
        let (base, height, unit) = match &self.shape {
            Shape::Dwell => (start, 0.0, Jet::default()),
            Shape::Uniform => {
                let line = Jet {
                    value: x,
                    first: 1.0,
                    ..Jet::default()
                };
                (start, stroke, line)
            }
            Shape::Law(law) => (start, stroke, law.jet(part, x)),
            Shape::Smooth(polynomial) => (0.0, 1.0, polynomial.jet(x)),
        };
        let rate = 1.0 / self.span;
        Jet {
            value: base + height * unit.value,
            first: height * rate * unit.first,
            second: height * rate * rate * unit.second,
            third: height * rate * rate * rate * unit.third,
        }
    }

    /// The displacement in closed form on the interval about `middle` of half the length `half`.
    fn terms(&self, part: usize, [middle, half]: [f64; 2]) -> Terms {
        let [start, end] = self.ends;
        let place = [(middle - self.from) / self.span, half / self.span];
        match &self.shape {
            Shape::Dwell => Terms::constant(start),
            Shape::Uniform => Terms::of_powers(&[start, end - start], place),
            Shape::Law(law) => law.terms(part, place).scaled(start, end - start),
            Shape::Smooth(polynomial) => polynomial.terms(place),
        }
    }

    fn joints(&self) -> &[f64] {
        match &self.shape {
            Shape::Law(law) => law.joints(),
            _ => &[],
        }
    }
}

impl Cycle {
    /// A plan of motion as described.
    ///
    /// # Errors
    /// Stations out of order or outside the period, a cycle that does not come
    /// back, dwells between different displacements, faulty laws, derivatives
    /// prescribed where no smooth motion takes them; paths relative to the plan.
    pub fn new(spec: &CycleSpec) -> Result<Self, Vec<Fault>> {
        let mut faults = Faults::default();
        spec.check(&mut faults);
        faults.check()?;
        let stations = spec.open_stations(&mut faults);
        faults.check()?;
        let segments = joints::segments(spec, &stations, &mut faults);
        faults.check()?;
        let mut cycle = Self {
            spec: spec.clone(),
            segments,
            pieces: Vec::new(),
            breaks: Breaks {
                points: Vec::new(),
                period: spec.period,
            },
        };
        cycle.lay_out();
        if !cycle.is_finite() {
            let message = "the motions lead to numbers too great to compute with";
            faults.add("stations", message, "space the stations more evenly");
        }
        faults.check()?;
        Ok(cycle)
    }

    fn lay_out(&mut self) {
        for (index, segment) in self.segments.iter().enumerate() {
            let inner = segment.joints().iter();
            let begins = inner.map(|joint| segment.from + segment.span * joint);
            for (part, begin) in std::iter::once(segment.from).chain(begins).enumerate() {
                let segment = index;
                self.breaks.points.push(begin);
                self.pieces.push(Piece { segment, part });
            }
        }
        if let (None, Some(last)) = (self.spec.period, self.segments.last()) {
            self.breaks.points.push(last.from + last.span);
        }
    }

    fn is_finite(&self) -> bool {
        self.pieces.iter().all(|piece| {
            let segment = &self.segments[piece.segment];
            [0.0, 0.5, 1.0].iter().all(|x| {
                let phi = segment.from + x * segment.span;
                segment.jet(piece.part, phi).is_finite()
            })
        })
    }

    /// Displacement and its derivatives at `phi` by the formula of `segment`
    /// of [`Self::breaks`].
    pub fn jet(&self, segment: i64, phi: f64) -> Jet {
        let (piece, turned) = self.breaks.piece(segment);
        match self.spec.period {
            Some(period) => {
                let mut jet = self.piece_jet(piece, phi - turned);
                if self.spec.advance != 0.0 {
                    jet.value += self.spec.advance * (turned / period).round();
                }
                jet
            }
            None if piece == 0 => rest(self.segments[0].ends[0]),
            None if piece > self.pieces.len() => {
                rest(self.segments[self.segments.len() - 1].ends[1])
            }
            None => self.piece_jet(piece - 1, phi),
        }
    }

    /// The displacement over one period in closed form, piece by piece; `None`: it does not
    /// repeat.
    pub(crate) fn closed_form(&self) -> Option<Vec<TermsOnInterval>> {
        self.spec.period?;
        let piece = |(index, own): (usize, &Piece)| {
            let (from, to) = self.breaks.edges(index as i64);
            let place = [0.5 * (from + to), 0.5 * (to - from)];
            TermsOnInterval {
                middle: place[0],
                half: place[1],
                terms: self.segments[own.segment].terms(own.part, place),
            }
        };
        Some(self.pieces.iter().enumerate().map(piece).collect())
    }

    /// Size of a derivative over the cycle, from five samples of each piece.
    fn greatest(&self, order: usize) -> f64 {
        let count = self.pieces.len();
        let first = i64::from(self.spec.period.is_none());
        let sample = |index: usize, share: f64| {
            let segment = first + index as i64;
            let (from, to) = self.breaks.edges(segment);
            let jet = self.jet(segment, from + share * (to - from));
            [jet.first, jet.second, jet.third][order - 1].abs()
        };
        (0..count)
            .flat_map(|index| [0.0, 0.25, 0.5, 0.75, 1.0].map(|share| sample(index, share)))
            .fold(0.0, f64::max)
    }

    fn piece_jet(&self, piece: usize, phi: f64) -> Jet {
        let Piece { segment, part } = self.pieces[piece];
        self.segments[segment].jet(part, phi)
    }

    /// Breaks: where the formula changes.
    pub fn breaks(&self) -> &Breaks {
        &self.breaks
    }

    /// Numbers that it was made from.
    pub fn spec(&self) -> &CycleSpec {
        &self.spec
    }

    /// Jumps of the first three derivatives within one cycle: of the first a
    /// hard shock, of the second a soft one. Jumps below 1e-9 of the
    /// derivative's size are rounding.
    pub fn jumps(&self) -> Vec<Jump> {
        let sides: Vec<(f64, [f64; 3], [f64; 3])> = self
            .breaks
            .points
            .iter()
            .enumerate()
            .map(|(index, &at)| {
                // Segment numbers: with a period edge k begins segment k.
                let after = match self.spec.period {
                    Some(_) => index as i64,
                    None => index as i64 + 1,
                };
                let derivatives = |segment| {
                    let jet = self.jet(segment, at);
                    [jet.first, jet.second, jet.third]
                };
                (at, derivatives(after - 1), derivatives(after))
            })
            .collect();
        let mut jumps = Vec::new();
        for order in 1..=3 {
            let scale = self.greatest(order);
            jumps.extend(sides.iter().filter_map(|(at, a, b)| {
                let (before, after) = (a[order - 1], b[order - 1]);
                let jump = Jump {
                    at: *at,
                    order,
                    before,
                    after,
                };
                ((after - before).abs() > 1e-9 * scale).then_some(jump)
            }));
        }
        jumps
    }
}

fn rest(value: f64) -> Jet {
    Jet {
        value,
        ..Jet::default()
    }
}
