//! Formulas as data, written out as Unicode text or as LaTeX.
//!
//! A formula is built once; both notations are renderings of the same tree, so
//! they cannot say different things.
//!
//! MathML is a third rendering of the same tree.

mod latex;
#[cfg(feature = "live")]
mod mathml;
mod of_program;
mod unicode;

pub use latex::escape as latex_text;
pub(crate) use of_program::of_program;
use std::f64::consts::PI;

/// Index: what a symbol's subscript says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Index {
    /// No subscript.
    None,
    /// A mass, counted from 1.
    Mass(usize),
    /// The generic mass m, with an offset: m − 1, m, m + 1.
    Any(i8),
    /// A word: an object's id, a load's name.
    Word(String),
    /// A word and a mass.
    WordMass(String, usize),
}

/// A symbol: letter, time derivatives, primes, subscript.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symbol {
    /// The letter: `φ`, `U`, `J`.
    pub letter: &'static str,
    /// Number of dots, 0 … 2.
    pub dots: u8,
    /// Number of primes, 0 … 2.
    pub primes: u8,
    /// Subscript.
    pub index: Index,
}

/// Relation between two formulas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// =
    Equal,
    /// <
    Less,
    /// ≤
    AtMost,
    /// >
    Greater,
    /// ≠
    Unequal,
}

impl Relation {
    /// Its sign.
    fn sign(self) -> &'static str {
        match self {
            Self::Equal => "=",
            Self::Less => "<",
            Self::AtMost => "≤",
            Self::Greater => ">",
            Self::Unequal => "≠",
        }
    }
}

/// A formula.
#[derive(Clone, Debug, PartialEq)]
pub enum Expr {
    /// A number, to six significant digits.
    Number(f64),
    /// An angle in radians; simple multiples of π are written as such.
    Angle(f64),
    /// A symbol.
    Symbol(Symbol),
    /// Terms added; a negative term is written with its minus.
    Sum(Vec<Expr>),
    /// The opposite.
    Negative(Box<Expr>),
    /// Factors.
    Product(Vec<Expr>),
    /// Numerator over denominator.
    Quotient(Box<Expr>, Box<Expr>),
    /// A whole power.
    Power(Box<Expr>, u32),
    /// √
    Root(Box<Expr>),
    /// A named function of one argument: sin, cos, tanh.
    Function(&'static str, Box<Expr>),
    /// A symbol's value at an argument: U(φ).
    At(Symbol, Box<Expr>),
    /// Values under conditions; the last holds otherwise.
    Cases(Vec<(Expr, Expr)>),
    /// A comparison.
    Compare(Box<Expr>, Relation, Box<Expr>),
    /// Conditions that hold together.
    All(Vec<Expr>),
    /// Absolute value.
    Absolute(Box<Expr>),
    /// The greater of two.
    Greater(Box<Expr>, Box<Expr>),
    /// Plain words.
    Words(String),
}

/// A plain symbol.
pub fn symbol(letter: &'static str, index: Index) -> Symbol {
    Symbol {
        letter,
        dots: 0,
        primes: 0,
        index,
    }
}

impl Symbol {
    /// The symbol's time derivative: one dot more.
    #[must_use]
    pub fn rate(mut self) -> Self {
        self.dots += 1;
        self
    }

    /// The symbol with a prime more.
    #[must_use]
    pub fn prime(mut self) -> Self {
        self.primes += 1;
        self
    }

    /// As a formula.
    pub fn expr(self) -> Expr {
        Expr::Symbol(self)
    }
}

impl From<Symbol> for Expr {
    fn from(symbol: Symbol) -> Self {
        Self::Symbol(symbol)
    }
}

impl Expr {
    /// −self.
    #[must_use]
    pub fn negative(self) -> Self {
        match self {
            Self::Negative(inner) => *inner,
            Self::Number(value) => Self::Number(-value),
            Self::Angle(value) => Self::Angle(-value),
            other => Self::Negative(Box::new(other)),
        }
    }

    /// self with the sign of `factor`.
    #[must_use]
    pub fn signed(self, factor: f64) -> Self {
        if factor < 0.0 { self.negative() } else { self }
    }

    /// self − other.
    #[must_use]
    pub fn minus(self, other: impl Into<Self>) -> Self {
        Self::Sum(vec![self, other.into().negative()])
    }

    /// self + other.
    #[must_use]
    pub fn plus(self, other: impl Into<Self>) -> Self {
        Self::Sum(vec![self, other.into()])
    }

    /// self·other, factors of one kept out.
    #[must_use]
    pub fn times(self, other: impl Into<Self>) -> Self {
        let mut factors = Vec::new();
        for factor in [self, other.into()] {
            match factor {
                Self::Product(inner) => factors.extend(inner),
                Self::Number(1.0) => {}
                single => factors.push(single),
            }
        }
        match factors.len() {
            0 => Self::Number(1.0),
            1 => factors.swap_remove(0),
            _ => Self::Product(factors),
        }
    }

    /// self / other.
    #[must_use]
    pub fn over(self, other: impl Into<Self>) -> Self {
        Self::Quotient(Box::new(self), Box::new(other.into()))
    }

    /// self².
    #[must_use]
    pub fn squared(self) -> Self {
        Self::Power(Box::new(self), 2)
    }

    /// self `relation` other.
    #[must_use]
    pub fn compare(self, relation: Relation, other: impl Into<Self>) -> Self {
        Self::Compare(Box::new(self), relation, Box::new(other.into()))
    }

    /// A sum whose empty form is 0 and whose single form is the term itself;
    /// terms that are the number 0 are left out.
    pub fn sum(terms: Vec<Self>) -> Self {
        let mut flat = Vec::new();
        for term in terms {
            match term {
                Self::Sum(inner) => flat.extend(inner),
                Self::Number(0.0) | Self::Angle(0.0) => {}
                single => flat.push(single),
            }
        }
        match flat.len() {
            0 => Self::Number(0.0),
            1 => flat.swap_remove(0),
            _ => Self::Sum(flat),
        }
    }

    /// As Unicode text on one line (cases take one line each).
    pub fn unicode(&self) -> String {
        unicode::write(self)
    }

    /// As LaTeX for math mode.
    pub fn latex(&self) -> String {
        latex::write(self)
    }

    /// As MathML, for inside of `<math>`.
    #[cfg(feature = "live")]
    pub fn mathml(&self) -> String {
        mathml::write(self)
    }

    /// True when the formula must be bracketed as a factor.
    fn is_additive(&self) -> bool {
        match self {
            Self::Sum(_) | Self::Negative(_) | Self::Compare(..) | Self::All(_) => true,
            Self::Number(value) | Self::Angle(value) => *value < 0.0,
            _ => false,
        }
    }
}

/// `value` as a simple fraction of π: (numerator, denominator), if it is one.
fn fraction_of_pi(value: f64) -> Option<(u32, u32)> {
    let ratio = value.abs() / PI;
    [1u32, 2, 3, 4, 5, 6, 8, 9, 10, 12, 18, 36]
        .into_iter()
        .find_map(|denominator| {
            let numerator = (ratio * f64::from(denominator)).round();
            let exact = (ratio * f64::from(denominator) - numerator).abs() < 1e-12 * numerator;
            (exact && (1.0..=40.0).contains(&numerator)).then_some((numerator as u32, denominator))
        })
}

#[cfg(test)]
mod tests;
