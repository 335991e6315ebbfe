//! All memory that solving needs.

use super::dyad::Margin;
use super::elements::Body;

use super::elements::Frame;
use super::vector::Vector;
use super::vector::nearest_turn;
use crate::math::series::Series;

/// The frame of a link as power series.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion {
    /// Origin (m).
    pub(super) at: [[f64; 4]; 2],
    /// (cos θ, sin θ).
    pub(super) direction: [[f64; 4]; 2],
}

impl Motion {
    /// At rest in the frame of the ground.
    pub(super) const GROUND: Self = Self {
        at: [[0.0; 4]; 2],
        direction: [[1.0, 0.0, 0.0, 0.0], [0.0; 4]],
    };

    #[inline(always)]
    pub(super) fn frame<const N: usize>(&self) -> Frame<N> {
        Frame {
            at: Vector::load(&self.at),
            direction: Vector::load(&self.direction),
        }
    }

    #[inline(always)]
    pub(super) fn set<const N: usize>(&mut self, frame: &Frame<N>) {
        frame.at.store(&mut self.at);
        frame.direction.store(&mut self.direction);
    }

    /// Derivatives 1 to 3 of the angle; those above the order solved are those
    /// of whatever was solved before.
    #[inline(always)]
    pub(super) fn turning(&self) -> [f64; 3] {
        let [c, s] = &self.direction;
        let cross = |k: usize, factor: f64| factor * (c[0] * s[k] - s[0] * c[k]);
        let first = cross(1, 1.0);
        // u‴ = (iθ‴ − 3θ′θ″ − iθ′³)u.
        [first, cross(2, 2.0), cross(3, 6.0) + first * first * first]
    }

    /// The angle in (−π, π].
    pub(super) fn angle(&self) -> f64 {
        self.direction[1][0].atan2(self.direction[0][0])
    }
}

/// Positions of everything at one input.
#[derive(Clone, Debug)]
pub(super) struct State {
    /// The links.
    pub(super) links: Vec<Motion>,
    /// The driven link in the frame of the other link of the driver.
    pub(super) relative: Motion,
    /// Margins of the groups: how far each is from a dead-centre position.
    pub(super) margins: Vec<Margin>,
    /// For the groups solved by iteration.
    pub(super) scratch: Scratch,
    /// The input, within the first period.
    pub(super) reduced: f64,
    /// Of every link an angle over whole turns that is near its own: at the start its own,
    /// afterwards that expected, where a coupling needs it (rad).
    pub(super) near: Vec<f64>,
    /// True where the driver turns.
    pub(super) turned: bool,
}

impl State {
    /// The frame of a link or of the ground.
    #[inline(always)]
    pub(super) fn frame<const N: usize>(&self, link: Option<usize>) -> Frame<N> {
        match link {
            Some(link) => self.links[link].frame(),
            None => Frame::ground(),
        }
    }

    /// The frame of the driven link in that of the other.
    #[inline(always)]
    pub(super) fn relative_frame<const N: usize>(&self) -> Frame<N> {
        self.relative.frame()
    }

    /// The angle of a link over whole turns, the one next to [`Self::near`].
    pub(super) fn angle<const N: usize>(&self, link: usize) -> Series<N> {
        let motion = &self.links[link];
        let [first, second, third] = motion.turning();
        let angle = nearest_turn(motion.angle(), self.near[link]);
        Series::load(&[angle, first, second / 2.0, third / 6.0])
    }

    /// The angle of the driven link less that of the other.
    pub(super) fn relative_angle<const N: usize>(&self) -> Series<N> {
        if self.turned {
            Series::variable(self.reduced)
        } else {
            Series::constant(self.relative.angle())
        }
    }

    /// Puts a body, with the driven link if it has one, into its place.
    #[inline(always)]
    pub(super) fn place_body<const N: usize>(&mut self, body: &Body, frame: &Frame<N>) {
        self.links[body.base].set(frame);
        if let Some(driven) = body.driven {
            let relative = self.relative_frame::<N>();
            self.links[driven].set(&frame.then(&relative));
        }
    }
}

/// Memory for groups of a given size.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    /// x, y (m), θ of each body as series.
    pub(super) unknowns: Vec<[f64; 4]>,
    pub(super) matrix: Vec<f64>,
    pub(super) pivots: Vec<usize>,
    pub(super) equations: Vec<[f64; 4]>,
    pub(super) right: Vec<f64>,
}

impl Scratch {
    /// Memory for a group of `bodies`.
    pub(super) fn new(bodies: usize) -> Self {
        let n = 3 * bodies;
        Self {
            unknowns: vec![[0.0; 4]; n],
            matrix: vec![0.0; n * n],
            pivots: vec![0; n],
            equations: vec![[0.0; 4]; n],
            right: vec![0.0; n],
        }
    }
}
