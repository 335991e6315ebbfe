//! Numbers by a seed, and units in which a scene is written.

/// Draws numbers; the same ones for the same seed (SplitMix64).
pub(crate) struct Draw(u64);

impl Draw {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x5851_f42d_4c95_7f2d)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    }

    /// Evenly in [low, high).
    pub(crate) fn even(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Evenly over the powers of ten.
    pub(crate) fn decades(&mut self, low: f64, high: f64) -> f64 {
        self.even(low.ln(), high.ln()).exp()
    }

    /// A whole number in [low, high].
    pub(crate) fn whole(&mut self, low: u64, high: u64) -> u64 {
        low + self.next() % (high - low + 1)
    }

    pub(crate) fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.whole(0, all.len() as u64 - 1) as usize]
    }
}

/// Units of time and of inertia, in s and in kg or kg m²: powers of two, so that the same
/// motion is written with the same digits. Lengths are in m.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Units {
    pub(crate) time: f64,
    pub(crate) inertia: f64,
}

impl Units {
    pub(crate) const SI: Self = Self {
        time: 1.0,
        inertia: 1.0,
    };

    pub(crate) fn time(&self, value: f64) -> f64 {
        value * self.time
    }

    /// Speeds, angular frequencies.
    pub(crate) fn rate(&self, value: f64) -> f64 {
        value / self.time
    }

    pub(crate) fn acceleration(&self, value: f64) -> f64 {
        value / (self.time * self.time)
    }

    pub(crate) fn inertia(&self, value: f64) -> f64 {
        value * self.inertia
    }

    pub(crate) fn damping(&self, value: f64) -> f64 {
        value * self.inertia / self.time
    }

    /// Forces, moments, stiffnesses.
    pub(crate) fn force(&self, value: f64) -> f64 {
        value * self.inertia / (self.time * self.time)
    }
}
