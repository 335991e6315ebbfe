//! Numbers that a matrix is made of: real ones, and complex ones side by side.

/// An entry of a matrix.
pub(crate) trait Entry: Copy {
    /// 0.
    const ZERO: Self;

    /// `self` + `other`.
    fn plus(self, other: Self) -> Self;

    /// `self`·`other`.
    fn times(self, other: Self) -> Self;

    /// `self` − `one`·`other`.
    fn less_product(self, one: Self, other: Self) -> Self;

    /// 1/`self`.
    fn reciprocal(self) -> Self;

    /// The greater of the size of `self` and a size given before; sizes of
    /// complex numbers are |re| + |im|, and stand in the real part.
    fn greatest(self, size: Self) -> Self;

    /// True when its size is above `share` of a size, and a finite number.
    fn exceeds_share(self, share: f64, size: Self) -> bool;
}

impl Entry for f64 {
    const ZERO: Self = 0.0;

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        self + other
    }

    #[inline(always)]
    fn times(self, other: Self) -> Self {
        self * other
    }

    #[inline(always)]
    fn less_product(self, one: Self, other: Self) -> Self {
        self - one * other
    }

    #[inline(always)]
    fn reciprocal(self) -> Self {
        1.0 / self
    }

    #[inline(always)]
    fn greatest(self, size: Self) -> Self {
        size.max(self.abs())
    }

    #[inline(always)]
    fn exceeds_share(self, share: f64, size: Self) -> bool {
        let own = self.abs();
        own > share * size && own.is_finite()
    }
}

/// Complex numbers of L systems of one pattern, which are eliminated together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lanes<const L: usize> {
    /// Real parts.
    pub(crate) re: [f64; L],
    /// Imaginary parts.
    pub(crate) im: [f64; L],
}

impl<const L: usize> Lanes<L> {
    /// From the real and imaginary part of every lane.
    #[inline(always)]
    pub(crate) fn of(part: impl Fn(usize) -> [f64; 2]) -> Self {
        let mut out = Self::ZERO;
        for lane in 0..L {
            [out.re[lane], out.im[lane]] = part(lane);
        }
        out
    }
}

impl<const L: usize> Entry for Lanes<L> {
    const ZERO: Self = Self {
        re: [0.0; L],
        im: [0.0; L],
    };

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        Self::of(|l| [self.re[l] + other.re[l], self.im[l] + other.im[l]])
    }

    #[inline(always)]
    fn times(self, other: Self) -> Self {
        Self::of(|l| {
            [
                self.re[l] * other.re[l] - self.im[l] * other.im[l],
                self.re[l] * other.im[l] + self.im[l] * other.re[l],
            ]
        })
    }

    #[inline(always)]
    fn less_product(self, one: Self, other: Self) -> Self {
        Self::of(|l| {
            [
                self.re[l] - one.re[l] * other.re[l] + one.im[l] * other.im[l],
                self.im[l] - one.re[l] * other.im[l] - one.im[l] * other.re[l],
            ]
        })
    }

    #[inline(always)]
    fn reciprocal(self) -> Self {
        Self::of(|l| {
            let square = self.re[l] * self.re[l] + self.im[l] * self.im[l];
            [self.re[l] / square, -self.im[l] / square]
        })
    }

    #[inline(always)]
    fn greatest(self, size: Self) -> Self {
        Self::of(|l| [size.re[l].max(self.re[l].abs() + self.im[l].abs()), 0.0])
    }

    #[inline(always)]
    fn exceeds_share(self, share: f64, size: Self) -> bool {
        (0..L).all(|l| (self.re[l].abs() + self.im[l].abs()).exceeds_share(share, size.re[l]))
    }
}
