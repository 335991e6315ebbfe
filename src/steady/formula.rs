//! Expressions of the position.

use super::refusal::Refusal;
use exmex::{Express, FlatEx};

/// A function of φ written as an expression: `1.5 + 0.2*cos(phi)`.
///
/// Numbers, `+ - * / ^`, parentheses, `phi` (radians), `PI`, `E`, and the
/// functions `sin cos tan asin acos atan sinh cosh tanh exp ln log10 log2 sqrt
/// cbrt abs signum floor ceil round`.
#[derive(Clone, Debug)]
pub struct Formula {
    text: String,
    expression: FlatEx<f64>,
    /// True when φ occurs in it.
    varies: bool,
}

/// Longest expression that is read.
const LONGEST: usize = 2000;

impl Formula {
    /// Reads an expression; `field` is its name in messages.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn new(field: &str, text: &str) -> Result<Self, Refusal> {
        let hint = "for example \"1.5 + 0.2*cos(phi)\", phi in radians";
        let refuse = |message: String| Refusal::field(field, message, hint);
        if text.len() > LONGEST {
            return Err(refuse(format!("longer than {LONGEST} characters")));
        }
        let expression = exmex::parse::<f64>(text)
            .map_err(|error| refuse(format!("cannot read \"{text}\": {error}")))?;
        let names = expression.var_names();
        if let Some(name) = names
            .iter()
            .find(|name| !matches!(name.as_str(), "phi" | "φ"))
        {
            return Err(refuse(format!("\"{text}\": `{name}` is not known")));
        }
        if names.len() > 1 {
            return Err(refuse(format!("\"{text}\": write either phi or φ")));
        }
        let varies = !names.is_empty();
        Ok(Self {
            text: text.to_owned(),
            varies,
            expression,
        })
    }

    /// The value at φ (rad); NaN where there is none.
    pub fn at(&self, position: f64) -> f64 {
        let found = match self.varies {
            true => self.expression.eval(&[position]),
            false => self.expression.eval(&[]),
        };
        found.unwrap_or(f64::NAN)
    }

    /// As it was written.
    pub fn text(&self) -> &str {
        &self.text
    }
}

#[cfg(test)]
mod tests {
    use super::Formula;

    #[test]
    fn expressions_are_read_and_faulty_ones_named() {
        let formula = Formula::new("inertia", "1.5 + 0.2*cos(phi) - 2^phi/PI").unwrap();
        let exact = 1.5 + 0.2 * 0.7f64.cos() - 2f64.powf(0.7) / std::f64::consts::PI;
        approx::assert_relative_eq!(formula.at(0.7), exact, max_relative = 1e-15);
        assert_eq!(Formula::new("inertia", "3").unwrap().at(1.0), 3.0);
        for bad in [
            "",
            "1 +",
            "psi",
            "phi + φ",
            "sin(",
            "foo(phi)",
            &"1+".repeat(2000),
        ] {
            let refusal = Formula::new("inertia", bad).unwrap_err();
            assert!(refusal.message().starts_with("inertia: "), "{bad}");
        }
        let deep = format!("{}phi{}", "(".repeat(900), ")".repeat(900));
        let _ = Formula::new("inertia", &deep);
    }
}
