//! The same expressions by another reader, `nanoexpr`.

use super::function::SMOOTH;
use super::{CONSTANTS, Expression};
use nanoexpr::{Context, ErrorKind, Evaluator, Number};
use std::cmp::Ordering;

/// A real number, calculated with as the processor does: what has no value is
/// infinite or NaN.
#[derive(Clone, Copy, Default)]
struct Real(f64);

impl Number for Real {
    fn parse(literal: &str) -> Option<Self> {
        let value: f64 = literal.parse().ok()?;
        value.is_finite().then_some(Self(value))
    }
    fn add(self, other: Self) -> Result<Self, ErrorKind> {
        Ok(Self(self.0 + other.0))
    }
    fn subtract(self, other: Self) -> Result<Self, ErrorKind> {
        Ok(Self(self.0 - other.0))
    }
    fn multiply(self, other: Self) -> Result<Self, ErrorKind> {
        Ok(Self(self.0 * other.0))
    }
    fn divide(self, other: Self) -> Result<Self, ErrorKind> {
        Ok(Self(self.0 / other.0))
    }
    fn remainder(self, other: Self) -> Result<Self, ErrorKind> {
        Ok(Self(self.0 % other.0))
    }
    fn power(self, other: Self) -> Result<Self, ErrorKind> {
        Ok(Self(self.0.powf(other.0)))
    }
    fn negate(self) -> Result<Self, ErrorKind> {
        Ok(Self(-self.0))
    }
    fn compare(self, other: Self) -> Result<Ordering, ErrorKind> {
        self.0.partial_cmp(&other.0).ok_or(ErrorKind::Domain)
    }
}

/// The variables x and y.
struct Known([f64; 2]);

impl Context<Real> for Known {
    fn variable(&self, name: &str) -> Option<Real> {
        let own = ["x", "y"].iter().position(|known| *known == name);
        let own = own.map(|index| self.0[index]);
        let constant = || CONSTANTS.iter().find(|(known, _)| *known == name);
        own.or_else(|| constant().map(|(_, value)| *value))
            .map(Real)
    }

    fn call(&self, name: &str, arguments: &[Real]) -> Option<Result<Real, ErrorKind>> {
        let value = match (name, arguments) {
            ("atan2", &[Real(y), Real(x)]) => y.atan2(x),
            ("min", &[Real(x), Real(y)]) => x.min(y),
            ("max", &[Real(x), Real(y)]) => x.max(y),
            ("abs", &[Real(x)]) => x.abs(),
            ("signum", &[Real(x)]) => x.signum(),
            ("floor", &[Real(x)]) => x.floor(),
            ("ceil", &[Real(x)]) => x.ceil(),
            ("round", &[Real(x)]) => x.round(),
            ("trunc", &[Real(x)]) => x.trunc(),
            ("fract", &[Real(x)]) => x.fract(),
            (_, &[Real(x)]) => SMOOTH.iter().find(|(known, _)| *known == name)?.1.value(x),
            _ => return None,
        };
        Some(Ok(Real(value)))
    }
}

/// A small generator with a fixed seed (xorshift64*).
struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 16) as usize % bound.max(1)
    }
}

const PARTS: [&str; 40] = [
    "x", "y", "x", "y", "1", "2", "0.5", "3e-1", "pi", "e", "+", "-", "*", "/", "^", "%", "<",
    ">=", "&&", "||", "!", "?", ":", "(", ")", "sin(", "abs(", "max(", ",", "floor(", "exp(",
    "round(", "fract(", "==", "!=", "sqrt(", "atan2(", "tanh(", "2", "-",
];

const SEEDS: [&str; 6] = [
    "1.5 + 0.2*cos(x) - 2^y/PI",
    "x > 1 ? y : x > 0.5 ? 2*y : 3 - x % 0.7",
    "-2^2 + 2^3^-x - 7 - 2 - 1 + 12/3/2*5",
    "(x >= y) + !(x < 0.3 && y > 1 || x != 2)*max(x, -y)",
    "floor(3*x)/(1 + abs(y)) - atan2(y, x)*min(x, 2)",
    "ln(1 + x^2)*sqrt(y + 4)^1.5 - cosh(x/2) + fract(5*y)",
];

fn text(random: &mut Random) -> String {
    let mut letters: Vec<char> = SEEDS[random.below(SEEDS.len())].chars().collect();
    for _ in 0..random.below(5) {
        let at = random.below(letters.len() + 1);
        let part: Vec<char> = PARTS[random.below(PARTS.len())].chars().collect();
        match random.below(3) {
            0 if at < letters.len() => {
                letters.remove(at);
            }
            _ => {
                letters.splice(at..at, part);
            }
        }
    }
    letters.into_iter().collect()
}

#[test]
fn another_reader_agrees() {
    let mut random = Random(0x0DDB_1A5E_5BAD_5EED);
    let mut values = 0;
    for _ in 0..20_000 {
        let text = text(&mut random);
        let own = Expression::new(&text, &["x", "y"]);
        for point in [[0.7, -1.3], [-0.4, 2.6]] {
            let known = Known(point);
            let evaluator = Evaluator::<_, 2>::new(&known).max_depth(256);
            let other = evaluator.evaluate::<Real>(&text);
            match (&own, other) {
                (Ok(own), Ok(Real(other))) => {
                    let own = own.at(&point);
                    let same = own == other
                        || own.is_nan() && other.is_nan()
                        || (own - other).abs() <= 1e-9 * own.abs().max(other.abs()).max(1e-3);
                    // (Close to a jump rounding may differ.)
                    let jumps = ["floor", "round", "fract", "%", "=", "<", ">"];
                    let jumps = jumps.iter().any(|word| text.contains(word));
                    assert!(same || jumps && other.is_finite(), "{text}: {own} {other}");
                    values += 1;
                }
                (Ok(own), Err(error)) => {
                    // A value that does not exist is not a number, and no mistake.
                    let kind = error.kind;
                    let of_value = matches!(
                        kind,
                        ErrorKind::Domain | ErrorKind::Overflow | ErrorKind::DivisionByZero
                    );
                    assert!(of_value, "{text}: {kind:?}, {}", own.at(&point));
                }
                // What the other does not look at in a branch that is not taken, and
                // the factorial of what is no number.
                (Err(mistake), Ok(_)) => assert!(
                    ["?", "&&", "||", "!"]
                        .iter()
                        .any(|word| text.contains(word)),
                    "{text}: {mistake:?}"
                ),
                (Err(_), Err(_)) => {}
            }
        }
    }
    assert!(values > 5_000, "{values}");
}
