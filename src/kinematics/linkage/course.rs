//! The course of a linkage along its input: where it exists, the branch of every
//! dyad from place to place, and a table of all links.

use super::change::Change;
use super::plan::Driver;
use super::state::State;
use super::vector::nearest_turn;

/// The branch of one dyad along the course.
#[derive(Clone, Debug)]
pub(super) struct Branch {
    /// Sign of its root at the start.
    pub(super) sign: f64,
    /// Change points on the course, in no order.
    pub(super) changes: Vec<Change>,
}

/// All that was found along the input.
#[derive(Clone, Debug)]
pub(super) struct Course {
    /// Start of the interval where the approximate positions hold.
    pub(super) start: f64,
    /// The open interval that can be reached; infinite when it repeats.
    pub(super) ends: [f64; 2],
    /// After this much of the input everything repeats.
    pub(super) period: Option<f64>,
    /// Branches, one for each group after the driver.
    pub(super) branches: Vec<Branch>,
    /// Positions from place to place.
    pub(super) table: Table,
    /// Positions below the start, away from it, until they are joined on.
    pub(super) below: Table,
}

impl Course {
    /// The input within the first period, and the number of periods left out.
    #[inline(always)]
    pub(super) fn reduce(&self, input: f64) -> (f64, f64) {
        match self.period {
            Some(period) => {
                let turns = ((input - self.start) / period).floor();
                (input - turns * period, turns)
            }
            None => (input, 0.0),
        }
    }

    /// Distance of a reduced input from a change point, the nearest of all turns.
    #[inline(always)]
    pub(super) fn distance_from_change(&self, reduced: f64, at: f64) -> f64 {
        let distance = reduced - at;
        match self.period {
            Some(period) => distance - period * (distance / period).round(),
            None => distance,
        }
    }

    /// The sign of a group's root, and the change point to interpolate at.
    #[inline(always)]
    pub(super) fn branch(&self, group: usize, reduced: f64) -> (f64, Option<(&Change, f64)>) {
        let branch = &self.branches[group];
        let mut sign = branch.sign;
        let mut near = None;
        for change in &branch.changes {
            let distance = self.distance_from_change(reduced, change.at);
            if change.is_in_force_at(distance) {
                near = Some((change, distance));
            }
            let passed = (self.start < change.at) == (change.at < reduced);
            if change.flips && passed {
                sign = -sign;
            }
        }
        (sign, near)
    }
}

impl Course {
    /// The table is complete: turns the driven link so that the angle of the
    /// driver's pair is the input, and notes what every link gains in a period.
    pub(super) fn finish(&mut self, driver: &Driver) {
        let below = std::mem::take(&mut self.below);
        if !below.inputs.is_empty() {
            self.table.append_table(below);
        }
        let links = self.table.links;
        let start = self
            .table
            .inputs
            .partition_point(|&place| place < self.start);
        let angle = |link: Option<usize>| match link {
            Some(link) => self.table.rows[start * links + link][2],
            None => 0.0,
        };
        let (i, j) = (driver.on.link, driver.link.link);
        if driver.sliding.is_none()
            && let Some((moved, sign)) = j.map(|j| (j, 1.0)).or(i.map(|i| (i, -1.0)))
        {
            let missing = self.start - (angle(j) - angle(i));
            let shift = nearest_turn(0.0, sign * missing);
            for row in self.table.rows.chunks_exact_mut(links) {
                row[moved][2] += shift;
            }
        }
        if self.period.is_some() {
            let rows = &self.table.rows;
            let last = &rows[rows.len() - links..];
            let gained = last
                .iter()
                .zip(rows)
                .map(|(last, first)| last[2] - first[2]);
            self.table.gains = gained.map(|gain| nearest_turn(0.0, gain)).collect();
        }
    }
}

/// Positions of all links from place to place along the input.
#[derive(Clone, Debug, Default)]
pub(super) struct Table {
    /// Ascending.
    pub(super) inputs: Vec<f64>,
    /// Of every place and every link x, y, θ (continuous) and their derivatives.
    pub(super) rows: Vec<[f64; 6]>,
    /// Number of links.
    pub(super) links: usize,
    /// Angle that each link gains in a period.
    pub(super) gains: Vec<f64>,
    /// True where the angles go on beyond both ends as evenly as between them.
    pub(super) goes_on: bool,
}

impl Table {
    /// Index of the place before the reduced input.
    pub(super) fn index_before(&self, reduced: f64) -> usize {
        let after = self.inputs.partition_point(|&place| place <= reduced);
        after.clamp(1, self.inputs.len().max(2) - 1) - 1
    }

    /// x, y, θ of a link about the reduced input, between the places `index` and
    /// the next.
    pub(super) fn pose_near(&self, index: usize, link: usize, reduced: f64) -> [f64; 3] {
        let before = &self.rows[index * self.links + link];
        let Some(&to) = self.inputs.get(index + 1) else {
            return [before[0], before[1], before[2]];
        };
        let after = &self.rows[(index + 1) * self.links + link];
        let step = to - self.inputs[index];
        // Beside the ends derivatives grow without bound: no further out than
        // the last place.
        let x = ((reduced - self.inputs[index]) / step).clamp(0.0, 1.0);
        let mut near = std::array::from_fn(|k| {
            hermite(x, step, [before[k], before[k + 3], after[k], after[k + 3]])
        });
        if self.goes_on {
            near[2] += before[5] * (reduced - self.inputs[index] - x * step);
        }
        near
    }

    /// Takes the present position in as the last place; the angles continue
    /// those of the place before, at the first those that the state expects.
    pub(super) fn push(&mut self, input: f64, state: &State) {
        self.links = state.links.len();
        let before = self.rows.len().checked_sub(self.links);
        for (link, motion) in state.links.iter().enumerate() {
            let angle = motion.angle();
            let near = before.map_or(state.near[link], |first| self.rows[first + link][2]);
            let [x, y] = motion.at;
            let (angle, turning) = (nearest_turn(angle, near), motion.turning()[0]);
            self.rows.push([x[0], y[0], angle, x[1], y[1], turning]);
        }
        self.inputs.push(input);
    }

    /// The angle of a link at the last place.
    pub(super) fn last_angle(&self, link: usize) -> f64 {
        let last = self.rows.len().saturating_sub(self.links) + link;
        self.rows.get(last).map_or(0.0, |row| row[2])
    }

    /// Puts the places of a table that begins with the same place and goes the
    /// other way in front.
    fn append_table(&mut self, below: Table) {
        let links = self.links.max(1);
        let inputs = below.inputs[1..].iter().rev().copied();
        let rows = below.rows[links..]
            .chunks_exact(links)
            .rev()
            .flatten()
            .copied();
        self.inputs = inputs.chain(self.inputs.iter().copied()).collect();
        self.rows = rows.chain(self.rows.iter().copied()).collect();
    }
}

/// The cubic with given values and slopes at both ends of a step.
#[inline]
pub(super) fn hermite(x: f64, step: f64, [f, df, g, dg]: [f64; 4]) -> f64 {
    let y = 1.0 - x;
    y * y * (1.0 + 2.0 * x) * f + x * x * (1.0 + 2.0 * y) * g + step * x * y * (y * df - x * dg)
}
