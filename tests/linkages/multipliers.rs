//! A linkage in absolute coordinates with Lagrange multipliers: three
//! coordinates a link, two equations a pair, written from the definitions and
//! integrated by the classical Runge–Kutta method. It shares with the library
//! the description of a linkage and the state at the start, nothing else.

use dam::linkage::Linkage;
use dam::linkage::spec::{ForceLaw, LinkageSpec, PairKind, PointOf};
use nalgebra::{DMatrix, DVector};

pub(crate) type Vector = [f64; 2];

pub(crate) fn turned([x, y]: Vector, angle: f64) -> Vector {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub(crate) fn across([x, y]: Vector) -> Vector {
    [-y, x]
}

pub(crate) fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1]]
}

/// Places and speeds of all links: centre of mass and angle, three each.
#[derive(Clone)]
pub(crate) struct State {
    pub(crate) place: Vec<f64>,
    pub(crate) speed: Vec<f64>,
}

/// A point of a link at an instant: its place and speed, its arm from the
/// centre of mass, and the turning speed.
pub(crate) struct Point {
    pub(crate) link: Option<usize>,
    pub(crate) at: Vector,
    pub(crate) speed: Vector,
    arm: Vector,
    pub(crate) turning: f64,
}

/// The mechanism: a linkage, what its driver does, and a rotor on it.
pub(crate) struct Mechanism<'a> {
    pub(crate) spec: &'a LinkageSpec,
    /// Constant moment or force in the driven pair.
    pub(crate) torque: f64,
    /// Inertia that turns with the driven link, which must be on the ground.
    pub(crate) rotor: f64,
}

impl Mechanism<'_> {
    /// Consistent places and speeds for the input q with the speed `rate`.
    pub(crate) fn start(&self, linkage: &Linkage, q: f64, rate: f64) -> State {
        let mut workspace = linkage.workspace();
        linkage.solve(q, 1, &mut workspace).expect("within reach");
        let mut state = State {
            place: Vec::new(),
            speed: Vec::new(),
        };
        for (index, link) in self.spec.links.iter().enumerate() {
            let pose = workspace.pose(index);
            let angle = pose.sin.atan2(pose.cos);
            let arm = turned(link.centre, angle);
            let [x, y, turning] = workspace.transfer(index, 1).map(|first| first * rate);
            let sideways = across(arm).map(|part| part * turning);
            state
                .place
                .extend([pose.x + arm[0], pose.y + arm[1], angle]);
            state
                .speed
                .extend([x + sideways[0], y + sideways[1], turning]);
        }
        state
    }

    pub(crate) fn point(&self, point: &PointOf, state: &State) -> Point {
        let Some(link) = point.link else {
            return Point {
                link: None,
                at: point.at,
                speed: [0.0; 2],
                arm: [0.0; 2],
                turning: 0.0,
            };
        };
        let (place, speed) = (&state.place[3 * link..], &state.speed[3 * link..]);
        let arm = turned(minus(point.at, self.spec.links[link].centre), place[2]);
        let sideways = across(arm).map(|part| part * speed[2]);
        Point {
            link: Some(link),
            at: [place[0] + arm[0], place[1] + arm[1]],
            speed: [speed[0] + sideways[0], speed[1] + sideways[1]],
            arm,
            turning: speed[2],
        }
    }

    pub(crate) fn angle(&self, link: Option<usize>, values: &[f64]) -> f64 {
        link.map_or(0.0, |link| values[3 * link + 2])
    }

    /// Accelerations of all links.
    fn accelerations(&self, state: &State) -> Vec<f64> {
        let n = 3 * self.spec.links.len();
        let (matrix, right) = self.equations(state);
        let found = matrix.lu().solve(&right).expect("independent pairs");
        found.as_slice()[..n].to_vec()
    }

    /// The equations of motion with the pairs: their matrix and right side. The
    /// unknowns are the accelerations of all links and two multipliers a pair.
    pub(crate) fn equations(&self, state: &State) -> (DMatrix<f64>, DVector<f64>) {
        let n = 3 * self.spec.links.len();
        let size = n + 2 * self.spec.pairs.len();
        let mut matrix = DMatrix::zeros(size, size);
        let mut right = DVector::zeros(size);
        self.forces(state, &mut right);
        for (index, link) in self.spec.links.iter().enumerate() {
            for axis in 0..2 {
                matrix[(3 * index + axis, 3 * index + axis)] = link.mass;
            }
            matrix[(3 * index + 2, 3 * index + 2)] = link.moment;
        }
        if let Some(link) = self.spec.pairs[self.spec.driver].link.link {
            matrix[(3 * link + 2, 3 * link + 2)] += self.rotor;
        }
        for pair in 0..self.spec.pairs.len() {
            self.constrain(pair, state, &mut matrix, &mut right);
        }
        for row in n..size {
            for column in 0..n {
                matrix[(column, row)] = matrix[(row, column)];
            }
        }
        (matrix, right)
    }

    /// The two rows of a pair: accelerations of the links on the left.
    fn constrain(
        &self,
        pair: usize,
        state: &State,
        matrix: &mut DMatrix<f64>,
        right: &mut DVector<f64>,
    ) {
        let row = 3 * self.spec.links.len() + 2 * pair;
        let pair = &self.spec.pairs[pair];
        let ends = [
            (self.point(&pair.on, state), -1.0),
            (self.point(&pair.link, state), 1.0),
        ];
        let [(on, _), (block, _)] = &ends;
        let mut along = |row: usize, direction: Vector, extra: f64| {
            right[row] = extra;
            for (end, sign) in &ends {
                let square = end.turning * end.turning;
                right[row] += sign * square * dot(direction, end.arm);
                if let Some(link) = end.link {
                    matrix[(row, 3 * link)] += sign * direction[0];
                    matrix[(row, 3 * link + 1)] += sign * direction[1];
                    matrix[(row, 3 * link + 2)] += sign * dot(direction, across(end.arm));
                }
            }
        };
        match pair.kind {
            PairKind::Revolute { .. } => {
                along(row, [1.0, 0.0], 0.0);
                along(row + 1, [0.0, 1.0], 0.0);
            }
            PairKind::Sliding { direction, .. } => {
                let t = turned([1.0, 0.0], direction + self.angle(on.link, &state.place));
                let n = across(t);
                let (distance, speed) = (minus(block.at, on.at), minus(block.speed, on.speed));
                let w = on.turning;
                along(row, n, 2.0 * w * dot(t, speed) + w * w * dot(n, distance));
                if let Some(link) = on.link {
                    matrix[(row, 3 * link + 2)] -= dot(t, distance);
                    matrix[(row + 1, 3 * link + 2)] = -1.0;
                }
                if let Some(link) = block.link {
                    matrix[(row + 1, 3 * link + 2)] = 1.0;
                }
            }
        }
    }

    fn forces(&self, state: &State, right: &mut DVector<f64>) {
        let mut act = |point: &Point, force: Vector| {
            if let Some(link) = point.link {
                right[3 * link] += force[0];
                right[3 * link + 1] += force[1];
                right[3 * link + 2] += dot(across(point.arm), force);
            }
        };
        for force in &self.spec.forces {
            match &force.law {
                ForceLaw::Strut {
                    from,
                    to,
                    rate,
                    free_length,
                    damping,
                    force,
                } => {
                    let (from, to) = (self.point(from, state), self.point(to, state));
                    let span = minus(to.at, from.at);
                    let length = dot(span, span).sqrt();
                    let unit = span.map(|part| part / length);
                    let stretching = dot(unit, minus(to.speed, from.speed));
                    let tension = rate * (length - free_length) + damping * stretching + force;
                    act(&from, unit.map(|part| part * tension));
                    act(&to, unit.map(|part| -part * tension));
                }
                ForceLaw::Force {
                    point,
                    force,
                    follows,
                } => {
                    let point = self.point(point, state);
                    let angle = self.angle(point.link, &state.place);
                    let force = if *follows {
                        turned(*force, angle)
                    } else {
                        *force
                    };
                    act(&point, force);
                }
                _ => {}
            }
        }
        for (index, link) in self.spec.links.iter().enumerate() {
            right[3 * index] += link.mass * self.spec.gravity[0];
            right[3 * index + 1] += link.mass * self.spec.gravity[1];
        }
        self.couples(state, right);
    }

    fn couples(&self, state: &State, right: &mut DVector<f64>) {
        let couple = |pair: usize, moment: f64, right: &mut DVector<f64>| {
            let pair = &self.spec.pairs[pair];
            for (end, sign) in [(&pair.on, -1.0), (&pair.link, 1.0)] {
                if let Some(link) = end.link {
                    right[3 * link + 2] += sign * moment;
                }
            }
        };
        couple(self.spec.driver, self.torque, right);
        for force in &self.spec.forces {
            let of_pair = |pair: usize, values: &[f64]| {
                let pair = &self.spec.pairs[pair];
                self.angle(pair.link.link, values) - self.angle(pair.on.link, values)
            };
            match force.law {
                ForceLaw::Torsion {
                    pair,
                    rate,
                    free_angle,
                    damping,
                } => {
                    let twist = of_pair(pair, &state.place) - free_angle;
                    let rate = -rate * twist - damping * of_pair(pair, &state.speed);
                    couple(pair, rate, right);
                }
                ForceLaw::Couple {
                    link,
                    couple: moment,
                } => right[3 * link + 2] += moment,
                _ => {}
            }
        }
    }

    /// The state after `time`, by `steps` steps.
    pub(crate) fn integrate(&self, start: &State, time: f64, steps: usize) -> State {
        let step = time / steps as f64;
        let mut state = start.clone();
        let moved = |state: &State, [speed, acceleration]: [&[f64]; 2], step: f64| State {
            place: add(&state.place, speed, step),
            speed: add(&state.speed, acceleration, step),
        };
        for _ in 0..steps {
            let a1 = self.accelerations(&state);
            let s2 = moved(&state, [&state.speed, &a1], 0.5 * step);
            let a2 = self.accelerations(&s2);
            let s3 = moved(&state, [&s2.speed, &a2], 0.5 * step);
            let a3 = self.accelerations(&s3);
            let s4 = moved(&state, [&s3.speed, &a3], step);
            let a4 = self.accelerations(&s4);
            let mean = |a: &[f64], b: &[f64], c: &[f64], d: &[f64]| -> Vec<f64> {
                (0..a.len())
                    .map(|i| (a[i] + 2.0 * (b[i] + c[i]) + d[i]) / 6.0)
                    .collect()
            };
            let speed = mean(&state.speed, &s2.speed, &s3.speed, &s4.speed);
            let acceleration = mean(&a1, &a2, &a3, &a4);
            state = moved(&state, [&speed, &acceleration], step);
        }
        state
    }
}

pub(crate) fn add(a: &[f64], b: &[f64], factor: f64) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a + factor * b).collect()
}
