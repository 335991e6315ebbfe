//! A stretch of the cycle on which J and M are polynomials.

use super::given::FunctionKind;
use crate::math::chebyshev::{self, Nodes};
use std::sync::LazyLock;

/// Coefficients of a polynomial: degree 19 and below.
pub(super) const COUNT: usize = 20;

/// A polynomial on a panel, in Chebyshev's polynomials.
pub(super) type Series = [f64; COUNT];

/// The places at which functions on panels are fitted.
pub(super) static NODES: LazyLock<Nodes<COUNT>> = LazyLock::new(Nodes::new);

/// A stretch of the cycle.
#[derive(Clone, Debug)]
pub(super) struct Panel {
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) inertia: Series,
    /// dJ/dφ.
    pub(super) inertia_slope: Series,
    pub(super) moment: Series,
    /// Work since the least, less `base`.
    pub(super) rise: Series,
    pub(super) base: f64,
}

/// The machine at a position.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point {
    /// J (kg·m²).
    pub inertia: f64,
    /// dJ/dφ.
    pub inertia_slope: f64,
    /// M (N·m).
    pub moment: f64,
    /// Work since the position of the least (J), ≥ 0.
    pub rise: f64,
}

/// As [`Point`], the work with its sign.
#[derive(Clone, Copy, Debug)]
pub(super) struct SignedPoint {
    pub(super) inertia: f64,
    pub(super) inertia_slope: f64,
    pub(super) moment: f64,
    pub(super) rise_signed: f64,
}

impl Panel {
    fn half(&self) -> f64 {
        0.5 * (self.to - self.from)
    }

    fn x(&self, position: f64) -> f64 {
        ((position - self.from) - (self.to - position)) / (self.to - self.from)
    }

    /// The machine at a position of the panel.
    pub(super) fn at(&self, position: f64) -> Point {
        let x = self.x(position);
        Point {
            inertia: chebyshev::value(&self.inertia, x),
            inertia_slope: chebyshev::value(&self.inertia_slope, x),
            moment: chebyshev::value(&self.moment, x),
            rise: (self.base + chebyshev::value(&self.rise, x)).max(0.0),
        }
    }

    /// Length of the panel (rad).
    pub(super) fn length(&self) -> f64 {
        self.to - self.from
    }

    /// J and the work since the least, what a speed needs, at a distance from
    /// the panel's start: finer than positions are.
    #[inline]
    pub(super) fn masses(&self, distance: f64) -> (f64, f64) {
        let x = (distance - (self.length() - distance)) / self.length();
        (
            chebyshev::value(&self.inertia, x),
            (self.base + chebyshev::value(&self.rise, x)).max(0.0),
        )
    }

    /// The panel's polynomials on a part of it.
    pub(super) fn part_between(&self, from: f64, to: f64) -> Self {
        let places = NODES
            .places
            .map(|x| 0.5 * (from + to) + 0.5 * (to - from) * x);
        let refit = |series: &Series| {
            NODES.polynomial_through(&places.map(|place| chebyshev::value(series, self.x(place))))
        };
        Self {
            from,
            to,
            inertia: refit(&self.inertia),
            // Not differentiated anew: that would raise rounding in short panels.
            inertia_slope: refit(&self.inertia_slope),
            moment: refit(&self.moment),
            rise: [0.0; COUNT],
            base: 0.0,
        }
    }

    fn new(from: f64, to: f64, inertia: Series, moment: Series) -> Self {
        let half = 0.5 * (to - from);
        Self {
            from,
            to,
            inertia,
            inertia_slope: chebyshev::derivative(&inertia).map(|c| c / half),
            moment,
            rise: [0.0; COUNT],
            base: 0.0,
        }
    }

    pub(super) fn work_over_panel(&self) -> f64 {
        self.half() * chebyshev::definite_integral(&self.moment)
    }

    /// Counts the work from an end of the panel at which it is `base`.
    pub(super) fn count(&mut self, base: f64, from_right: bool) {
        let half = self.half();
        self.rise = chebyshev::integral(&self.moment).map(|c| half * c);
        if from_right {
            self.rise[0] -= chebyshev::value(&self.rise, 1.0);
        }
        self.base = base;
    }
}

impl Panel {
    pub(super) fn signed(&self, position: f64) -> SignedPoint {
        let x = self.x(position);
        SignedPoint {
            inertia: chebyshev::value(&self.inertia, x),
            inertia_slope: chebyshev::value(&self.inertia_slope, x),
            moment: chebyshev::value(&self.moment, x),
            rise_signed: self.base + chebyshev::value(&self.rise, x),
        }
    }
}

/// A fitted panel with its moment.
pub(super) fn panel(fitted: FittedPanel, given: FunctionKind) -> Panel {
    let half = 0.5 * (fitted.to - fitted.from);
    let moment = match given {
        FunctionKind::Moment => fitted.other,
        FunctionKind::Work => chebyshev::derivative(&fitted.other).map(|c| c / half),
    };
    Panel::new(fitted.from, fitted.to, fitted.inertia, moment)
}

/// A panel: J and what is given, the moment or the work.
pub(super) struct FittedPanel {
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) inertia: Series,
    pub(super) other: Series,
}
