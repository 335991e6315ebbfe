//! Motions between stations, and the derivatives where smooth ones join.

use super::spec::{CycleSpec, Motion, Station};
use super::{Segment, Shape};
use crate::fault::Faults;
use crate::kinematics::motion::law::{EndPolynomial, Law, PolynomialSpec};
use nalgebra::{DMatrix, DVector};

/// A derivative at a station.
#[derive(Clone, Copy, Debug)]
enum Derivative {
    Known(f64),
    /// Number of the unknown.
    Unknown(usize),
}

/// The segments of a plan, smooth ones included.
pub(super) fn segments(
    spec: &CycleSpec,
    stations: &[Station],
    faults: &mut Faults,
) -> Vec<Segment> {
    let mut all = plain_segments(spec, stations, faults);
    let plan = Plan {
        stations,
        segments: &all,
        periodic: spec.period.is_some(),
    };
    plan.check_prescribed(faults);
    let derivatives = plan.derivatives();
    let unknowns = plan.solve(&derivatives);
    let Some(unknowns) = unknowns else {
        let message = "the smooth motions do not determine each other";
        faults.add(
            "stations",
            message,
            "prescribe a speed at one of the stations",
        );
        return all;
    };
    let value = |derivative: &Derivative| match *derivative {
        Derivative::Known(value) => value,
        Derivative::Unknown(index) => unknowns[index],
    };
    let data: Vec<Vec<f64>> = derivatives
        .iter()
        .map(|station| station.iter().map(value).collect())
        .collect();
    for (index, segment) in all.iter_mut().enumerate() {
        if stations[index].motion == Motion::Smooth {
            let next = (index + 1) % data.len();
            let polynomial = smooth(segment, &data[index], &data[next]);
            segment.shape = Shape::Smooth(Box::new(polynomial));
        }
    }
    all
}

/// All segments; smooth ones as straight lines for the time being.
fn plain_segments(spec: &CycleSpec, stations: &[Station], faults: &mut Faults) -> Vec<Segment> {
    let count = match spec.period {
        Some(_) => stations.len(),
        None => stations.len() - 1,
    };
    let mut all = Vec::with_capacity(count);
    for index in 0..count {
        let station = &stations[index];
        let (to, end) = match stations.get(index + 1) {
            Some(next) => (next.at, next.displacement),
            None => (
                stations[0].at + spec.period.unwrap_or(0.0),
                stations[0].displacement + spec.advance,
            ),
        };
        let path = format!("stations[{index}].motion");
        let ends = [station.displacement, end];
        let shape = match &station.motion {
            Motion::Dwell => {
                if ends[0] != ends[1] {
                    let message = format!("a dwell cannot lead from {} to {}", ends[0], ends[1]);
                    faults.add(path, message, "give both stations the same displacement");
                }
                Shape::Dwell
            }
            Motion::Uniform | Motion::Smooth => Shape::Uniform,
            Motion::Law(law) => match Law::of_stroke(law) {
                Ok(law) => Shape::Law(Box::new(law)),
                Err(found) => {
                    faults.absorb(&path, found);
                    Shape::Uniform
                }
            },
        };
        all.push(Segment {
            from: station.at - spec.phase,
            span: to - station.at,
            ends,
            shape,
        });
    }
    all
}

/// The polynomial with derivatives (first, second, …) given at both ends.
fn smooth(segment: &Segment, start: &[f64], end: &[f64]) -> EndPolynomial {
    let scaled = |value: f64, derivatives: &[f64]| {
        let mut factor = 1.0;
        let mut all = vec![value];
        for derivative in derivatives {
            factor *= segment.span;
            all.push(derivative * factor);
        }
        all
    };
    EndPolynomial::new(&PolynomialSpec {
        start: scaled(segment.ends[0], start),
        end: scaled(segment.ends[1], end),
        through: Vec::new(),
    })
}

struct Plan<'a> {
    stations: &'a [Station],
    segments: &'a [Segment],
    periodic: bool,
}

impl Plan<'_> {
    /// Segments before and after a station; `None`: rest outside the plan.
    fn adjacent_segments(&self, station: usize) -> [Option<usize>; 2] {
        let count = self.segments.len();
        let before = match station {
            0 if self.periodic => Some(count - 1),
            0 => None,
            station => Some(station - 1),
        };
        [before, (station < count).then_some(station)]
    }

    fn is_smooth(&self, segment: Option<usize>) -> bool {
        segment.is_some_and(|segment| self.stations[segment].motion == Motion::Smooth)
    }

    /// Derivatives beyond what is smooth are of no use to anybody.
    fn check_prescribed(&self, faults: &mut Faults) {
        for (index, station) in self.stations.iter().enumerate() {
            let taken = self
                .adjacent_segments(index)
                .iter()
                .any(|&side| self.is_smooth(side));
            let given = [
                ("speed", station.speed),
                ("acceleration", station.acceleration),
            ];
            for (name, _) in given.iter().filter(|(_, value)| value.is_some() && !taken) {
                let message = format!("no smooth motion meets here to take this {name}");
                let hint = "make the motion before or after it `smooth`";
                faults.add(format!("stations[{index}].{name}"), message, hint);
            }
        }
    }

    /// First, second, … derivative at each station, as far as smooth motions match there.
    fn derivatives(&self) -> Vec<Vec<Derivative>> {
        let mut unknowns = 0;
        let mut all = Vec::with_capacity(self.stations.len());
        for (index, station) in self.stations.iter().enumerate() {
            let sides = self.adjacent_segments(index);
            let prescribed = [station.speed, station.acceleration, None];
            let orders = match station.acceleration {
                Some(_) => station.order.max(2),
                None => station.order,
            };
            let both = sides.iter().all(|&side| self.is_smooth(side));
            let row = (1..=orders).map(|order| match prescribed[order - 1] {
                Some(value) => Derivative::Known(value),
                None if both => {
                    unknowns += 1;
                    Derivative::Unknown(unknowns - 1)
                }
                None => Derivative::Known(self.fixed(sides, order)),
            });
            all.push(row.collect());
        }
        all
    }

    /// The derivative that the neighbour which is not smooth has at a station.
    fn fixed(&self, sides: [Option<usize>; 2], order: usize) -> f64 {
        let [before, after] = sides;
        let jet = match (before, after) {
            (Some(before), _) if !self.is_smooth(Some(before)) => {
                let segment = &self.segments[before];
                segment.jet(segment.joints().len(), segment.from + segment.span)
            }
            (_, Some(after)) if !self.is_smooth(Some(after)) => {
                let segment = &self.segments[after];
                segment.jet(0, segment.from)
            }
            // Rest outside the plan.
            _ => return 0.0,
        };
        [jet.first, jet.second, jet.third][order - 1]
    }

    /// The unknown derivatives: at every station as many of the next higher
    /// derivatives are continuous as there are unknowns. `None`: not determined.
    fn solve(&self, derivatives: &[Vec<Derivative>]) -> Option<Vec<f64>> {
        let is_unknown = |d: &&Derivative| matches!(d, Derivative::Unknown(_));
        let count: usize = derivatives.iter().flatten().filter(is_unknown).count();
        let mut matrix = DMatrix::zeros(count, count);
        let mut right = DVector::zeros(count);
        let mut row = 0;
        for (index, station) in derivatives.iter().enumerate() {
            let unknown = station.iter().filter(is_unknown).count();
            for order in station.len() + 1..=station.len() + unknown {
                let [before, after] = self.adjacent_segments(index);
                for (segment, end, sign) in [(before?, 1.0, 1.0), (after?, 0.0, -1.0)] {
                    self.add_terms(derivatives, segment, end, order, sign, |column, value| {
                        match column {
                            Some(column) => matrix[(row, column)] += value,
                            None => right[row] -= value,
                        }
                    });
                }
                row += 1;
            }
        }
        if count == 0 {
            return Some(Vec::new());
        }
        scale_rows(&mut matrix, &mut right);
        let solution = matrix.lu().solve(&right)?;
        let sound = solution.iter().all(|value| value.is_finite());
        sound.then(|| solution.iter().copied().collect())
    }

    /// The derivative of the given order at an end of a smooth segment, as a
    /// linear function of what is given and unknown at its two stations.
    fn add_terms(
        &self,
        derivatives: &[Vec<Derivative>],
        segment: usize,
        end: f64,
        order: usize,
        sign: f64,
        mut add: impl FnMut(Option<usize>, f64),
    ) {
        let span = self.segments[segment].span;
        let next = (segment + 1) % derivatives.len();
        let stations = [&derivatives[segment], &derivatives[next]];
        for (side, station) in stations.iter().enumerate() {
            for k in 0..=station.len() {
                let mut data = [
                    vec![0.0; stations[0].len() + 1],
                    vec![0.0; stations[1].len() + 1],
                ];
                data[side][k] = 1.0;
                let [start, finish] = data;
                let unit = EndPolynomial::new(&PolynomialSpec {
                    start,
                    end: finish,
                    through: Vec::new(),
                });
                let found = unit.derivatives(end, order + 1)[order];
                let factor = sign * found * span.powi(k as i32 - order as i32);
                match k.checked_sub(1).map(|k| station[k]) {
                    None => add(None, factor * self.segments[segment].ends[side]),
                    Some(Derivative::Known(value)) => add(None, factor * value),
                    Some(Derivative::Unknown(column)) => add(Some(column), factor),
                }
            }
        }
    }
}

/// Makes the greatest entry of every row 1.
fn scale_rows(matrix: &mut DMatrix<f64>, right: &mut DVector<f64>) {
    for row in 0..matrix.nrows() {
        let greatest = matrix.row(row).amax();
        if greatest > 0.0 {
            matrix.row_mut(row).scale_mut(1.0 / greatest);
            right[row] /= greatest;
        }
    }
}
