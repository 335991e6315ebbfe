//! Names of laws of motion.

/// A named law of a full stroke, from rest to rest.
///
/// θ(0) = 0, θ(1) = 1, θ′(0) = θ′(1) = 0, and θ(1 − τ) = 1 − θ(τ) for all of
/// them. θ″ vanishes at both ends, except for the parabolic and harmonic laws.
/// The normal form (both axes from 0 to 1) is that of the guideline VDI 2143.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LawName {
    /// `parabolic`: constant acceleration, then constant deceleration.
    Parabolic,
    /// `harmonic`: (1 − cos πτ)/2; acceleration jumps at both ends.
    Harmonic,
    /// `cycloidal`: τ − sin(2πτ)/2π.
    Cycloidal,
    /// `modified_trapezoid`: sine, constant, sine, … acceleration in eighths.
    ModifiedTrapezoid,
    /// `modified_sine`: quarter sine over an eighth, then a slower half cosine.
    ModifiedSine,
    /// `modified_constant_velocity`: a modified sine with uniform motion over
    /// the middle half.
    ModifiedConstantVelocity,
    /// `3-4-5`: 10τ³ − 15τ⁴ + 6τ⁵.
    Polynomial345,
    /// `4-5-6-7`: 35τ⁴ − 84τ⁵ + 70τ⁶ − 20τ⁷.
    Polynomial4567,
}

impl LawName {
    /// All laws, in the order they are presented.
    pub const ALL: [Self; 8] = [
        Self::Parabolic,
        Self::Harmonic,
        Self::Cycloidal,
        Self::ModifiedTrapezoid,
        Self::ModifiedSine,
        Self::ModifiedConstantVelocity,
        Self::Polynomial345,
        Self::Polynomial4567,
    ];

    /// What is declared of a law: its name in scenes, that in the guideline VDI 2143, and words.
    #[rustfmt::skip]
    fn declared(self) -> (&'static str, Option<&'static str>, &'static str) {
        match self {
            Self::Parabolic => ("parabolic", Some("Quadratische Parabel"), "constant acceleration and deceleration"),
            Self::Harmonic => ("harmonic", Some("Einfache Sinuslinie"), "(1 − cos πτ)/2"),
            Self::Cycloidal => ("cycloidal", Some("Geneigte Sinuslinie (Sinoide von Bestehorn)"), "τ − sin(2πτ)/2π"),
            Self::ModifiedTrapezoid => ("modified_trapezoid", Some("Modifiziertes Beschleunigungstrapez"), "SCCA with b = 1/4, c = 1/2, d = 1/4"),
            Self::ModifiedSine => ("modified_sine", Some("Modifizierte Sinuslinie"), "SCCA with b = 1/4, c = 0, d = 3/4"),
            Self::ModifiedConstantVelocity => ("modified_constant_velocity", None, "modified sine, uniform over the middle half"),
            Self::Polynomial345 => ("3-4-5", Some("Polynom 5. Grades"), "10τ³ − 15τ⁴ + 6τ⁵"),
            Self::Polynomial4567 => ("4-5-6-7", Some("Polynom 7. Grades"), "35τ⁴ − 84τ⁵ + 70τ⁶ − 20τ⁷"),
        }
    }

    /// Name in scenes.
    pub fn name(self) -> &'static str {
        self.declared().0
    }

    /// Name in the guideline VDI 2143; `None`: it has none there.
    pub fn vdi_name(self) -> Option<&'static str> {
        self.declared().1
    }

    /// Description in a few words.
    pub fn words(self) -> &'static str {
        self.declared().2
    }
}

/// A named run-up law: a special point of the modified trapezoid of general form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunLawName {
    /// `rectangular`: s1 = 0, s2 = 0.
    Rectangular,
    /// `equilateral_trapezoid`: s1 = s2 = 1/4.
    EquilateralTrapezoid,
    /// `sine`: s1 = s2 = 1/2; half of a cycloidal law.
    Sine,
    /// `cosine`: s1 = 0, s2 = 1; half of a harmonic law.
    Cosine,
    /// `reversed_cosine`: s1 = 1, s2 = 0.
    ReversedCosine,
    /// `unequal_trapezoid`: s1 = 1/8, s2 = 1/2.
    UnequalTrapezoid,
    /// `modified_sine`: s1 = 1/4, s2 = 3/4; half of a modified sine.
    ModifiedSine,
}

impl RunLawName {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Rectangular,
        Self::EquilateralTrapezoid,
        Self::Sine,
        Self::Cosine,
        Self::ReversedCosine,
        Self::UnequalTrapezoid,
        Self::ModifiedSine,
    ];

    /// Name in scenes and shares.
    fn declared(self) -> (&'static str, (f64, f64)) {
        match self {
            Self::Rectangular => ("rectangular", (0.0, 0.0)),
            Self::EquilateralTrapezoid => ("equilateral_trapezoid", (0.25, 0.25)),
            Self::Sine => ("sine", (0.5, 0.5)),
            Self::Cosine => ("cosine", (0.0, 1.0)),
            Self::ReversedCosine => ("reversed_cosine", (1.0, 0.0)),
            Self::UnequalTrapezoid => ("unequal_trapezoid", (0.125, 0.5)),
            Self::ModifiedSine => ("modified_sine", (0.25, 0.75)),
        }
    }

    /// Name in scenes.
    pub fn name(self) -> &'static str {
        self.declared().0
    }

    /// Shares (s1, s2) of the trapezoid.
    pub fn shares(self) -> (f64, f64) {
        self.declared().1
    }
}
