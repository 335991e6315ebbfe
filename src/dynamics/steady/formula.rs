//! Expressions of the position.

use super::refusal::Refusal;
use crate::math::expression::{Expression, Repetition};

/// A function of φ written as an [`Expression`]: `1.5 + 0.2*cos(phi)`.
///
/// The position is `phi` or `φ`, in radians.
#[derive(Clone, Debug)]
pub struct Formula(Expression);

impl Formula {
    /// Reads an expression; `field` is its name in messages.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn new(field: &str, text: &str) -> Result<Self, Refusal> {
        Expression::new(text, &["phi", "φ"])
            .map(Self)
            .map_err(|mistake| {
                let hint = match mistake.hint.is_empty() {
                    true => "for example \"1.5 + 0.2*cos(phi)\", phi in radians",
                    false => &mistake.hint,
                };
                Refusal::field(field, mistake.message, hint)
            })
    }

    /// The value at φ (rad); NaN where there is none.
    pub fn at(&self, position: f64) -> f64 {
        self.0.at(&[position, position])
    }

    /// How it repeats, where its operations prove it.
    pub(super) fn repetition(&self) -> Option<Repetition> {
        Repetition::repetition_of_program(self.0.program(), &|_| Some(Repetition::Line(1.0)))
    }

    /// True where it is written in pieces of one cycle: `phi < pi ? sin(phi) : 0`.
    pub(super) fn is_in_pieces(&self) -> bool {
        Repetition::ends_a_piece_once(self.0.program())
    }

    /// As it was written.
    pub fn text(&self) -> &str {
        self.0.text()
    }
}

#[cfg(test)]
mod tests {
    use super::Formula;

    #[test]
    fn the_position_is_phi_and_mistakes_name_the_field() {
        let formula = Formula::new("inertia", "1.5e0 + 0.2*cos(phi) - 2^φ/PI").unwrap();
        let exact = 1.5 + 0.2 * 0.7f64.cos() - 2f64.powf(0.7) / std::f64::consts::PI;
        approx::assert_relative_eq!(formula.at(0.7), exact, max_relative = 1e-15);
        assert_eq!(Formula::new("inertia", "3").unwrap().at(1.0), 3.0);
        for bad in ["", "1 +", "psi", "sin(", "foo(phi)"] {
            let refusal = Formula::new("inertia", bad).unwrap_err();
            assert!(refusal.message().starts_with("inertia: "), "{bad}");
        }
    }
}
