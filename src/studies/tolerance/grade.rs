//! Tolerance classes of lengths: `h7`, `H7`, `js6`.

/// Least nominal sizes of the steps (mm); each ends where the next begins, the last at 500 mm.
const STEPS: [f64; 13] = [
    0.0, 3.0, 6.0, 10.0, 18.0, 30.0, 50.0, 80.0, 120.0, 180.0, 250.0, 315.0, 400.0,
];

/// Greatest nominal size (mm).
const GREATEST: f64 = 500.0;

/// Standard tolerances IT1 to IT18 of the steps (µm): ISO 286-1:2010, table 1.
#[rustfmt::skip]
const TOLERANCES: [[f64; 18]; 13] = [
    [0.8, 1.2, 2.0, 3.0, 4.0, 6.0, 10.0, 14.0, 25.0, 40.0, 60.0, 100.0, 140.0, 250.0, 400.0, 600.0, 1000.0, 1400.0],
    [1.0, 1.5, 2.5, 4.0, 5.0, 8.0, 12.0, 18.0, 30.0, 48.0, 75.0, 120.0, 180.0, 300.0, 480.0, 750.0, 1200.0, 1800.0],
    [1.0, 1.5, 2.5, 4.0, 6.0, 9.0, 15.0, 22.0, 36.0, 58.0, 90.0, 150.0, 220.0, 360.0, 580.0, 900.0, 1500.0, 2200.0],
    [1.2, 2.0, 3.0, 5.0, 8.0, 11.0, 18.0, 27.0, 43.0, 70.0, 110.0, 180.0, 270.0, 430.0, 700.0, 1100.0, 1800.0, 2700.0],
    [1.5, 2.5, 4.0, 6.0, 9.0, 13.0, 21.0, 33.0, 52.0, 84.0, 130.0, 210.0, 330.0, 520.0, 840.0, 1300.0, 2100.0, 3300.0],
    [1.5, 2.5, 4.0, 7.0, 11.0, 16.0, 25.0, 39.0, 62.0, 100.0, 160.0, 250.0, 390.0, 620.0, 1000.0, 1600.0, 2500.0, 3900.0],
    [2.0, 3.0, 5.0, 8.0, 13.0, 19.0, 30.0, 46.0, 74.0, 120.0, 190.0, 300.0, 460.0, 740.0, 1200.0, 1900.0, 3000.0, 4600.0],
    [2.5, 4.0, 6.0, 10.0, 15.0, 22.0, 35.0, 54.0, 87.0, 140.0, 220.0, 350.0, 540.0, 870.0, 1400.0, 2200.0, 3500.0, 5400.0],
    [3.5, 5.0, 8.0, 12.0, 18.0, 25.0, 40.0, 63.0, 100.0, 160.0, 250.0, 400.0, 630.0, 1000.0, 1600.0, 2500.0, 4000.0, 6300.0],
    [4.5, 7.0, 10.0, 14.0, 20.0, 29.0, 46.0, 72.0, 115.0, 185.0, 290.0, 460.0, 720.0, 1150.0, 1850.0, 2900.0, 4600.0, 7200.0],
    [6.0, 8.0, 12.0, 16.0, 23.0, 32.0, 52.0, 81.0, 130.0, 210.0, 320.0, 520.0, 810.0, 1300.0, 2100.0, 3200.0, 5200.0, 8100.0],
    [7.0, 9.0, 13.0, 18.0, 25.0, 36.0, 57.0, 89.0, 140.0, 230.0, 360.0, 570.0, 890.0, 1400.0, 2300.0, 3600.0, 5700.0, 8900.0],
    [8.0, 10.0, 15.0, 20.0, 27.0, 40.0, 63.0, 97.0, 155.0, 250.0, 400.0, 630.0, 970.0, 1550.0, 2500.0, 4000.0, 6300.0, 9700.0],
];

/// Position of a tolerance zone about the nominal size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Position {
    /// `h`: below it.
    Below,
    /// `H`: above it.
    Above,
    /// `js`, `JS`: half on either side.
    Middle,
}

/// Tolerance class of a length: the position of its zone and its grade.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Class {
    position: Position,
    /// Grade, 1 to 18.
    grade: usize,
}

impl Class {
    /// Reads `h7`.
    ///
    /// # Errors
    /// What is wrong, in words.
    pub fn parse(text: &str) -> Result<Self, String> {
        let letters = text.trim_end_matches(|c: char| c.is_ascii_digit());
        let grade = &text[letters.len()..];
        let position = match letters {
            "h" => Position::Below,
            "H" => Position::Above,
            "js" | "JS" => Position::Middle,
            _ => {
                return Err(format!(
                    "`{text}` is no class that is known: they begin with h, js or H; give its \
                     limits instead"
                ));
            }
        };
        let number = grade.parse().ok().filter(|grade| (1..=18).contains(grade));
        let grade = number.ok_or_else(|| format!("`{grade}` is no grade of 1 to 18"))?;
        Ok(Self { position, grade })
    }

    /// Lower and upper deviation of a length (m).
    ///
    /// # Errors
    /// The length has no classes.
    pub fn deviations(&self, length: f64) -> Result<[f64; 2], String> {
        let millimetres = 1e3 * length;
        if !(millimetres > 0.0 && millimetres <= GREATEST) {
            return Err(format!(
                "classes are those of lengths up to {GREATEST} mm, and this one is {} mm",
                crate::units::shown(millimetres, 6)
            ));
        }
        // A step contains its end.
        let step = STEPS.partition_point(|least| *least < millimetres) - 1;
        let width = 1e-6 * TOLERANCES[step][self.grade - 1];
        Ok(match self.position {
            Position::Below => [-width, 0.0],
            Position::Above => [0.0, width],
            Position::Middle => [-0.5 * width, 0.5 * width],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{Class, GREATEST, STEPS, TOLERANCES};

    /// From IT5 on the standard tolerances are multiples of i = 0.45·∛D + 0.001·D (µm, D the
    /// geometric mean of the step in mm), rounded by hand: ISO 286-1:2010, annex A.
    #[test]
    fn the_table_is_that_of_the_formula() {
        let factors = [
            7.0, 10.0, 16.0, 25.0, 40.0, 64.0, 100.0, 160.0, 250.0, 400.0, 640.0, 1000.0, 1600.0,
            2500.0,
        ];
        let ends = STEPS[1..].iter().chain([&GREATEST]);
        for ((start, end), row) in STEPS.iter().zip(ends).zip(TOLERANCES) {
            // (The first step is that of 1 to 3 mm.)
            let size = (start.max(1.0) * end).sqrt();
            let unit = 0.45 * size.cbrt() + 0.001 * size;
            for (factor, tolerance) in factors.iter().zip(&row[4..]) {
                let ratio = tolerance / (factor * unit);
                // (Below 3 mm the standard has rounder numbers.)
                let most = if *start == 0.0 { 1.16 } else { 1.1 };
                let rounded = (tolerance - factor * unit).abs() <= 0.6;
                assert!(
                    (0.92..most).contains(&ratio) || rounded,
                    "{end}: {tolerance} {ratio}"
                );
            }
            assert!(row.is_sorted());
        }
    }

    #[test]
    fn classes_lie_below_above_or_about_the_nominal_size() {
        let of = |text: &str, length: f64| {
            let [lower, upper] = Class::parse(text).unwrap().deviations(length).unwrap();
            [1e6 * lower, 1e6 * upper].map(|one| (one * 1e6).round() / 1e6)
        };
        assert_eq!(of("h7", 0.05), [-25.0, 0.0]);
        assert_eq!(of("h7", 0.0501), [-30.0, 0.0]);
        assert_eq!(of("H8", 0.003), [0.0, 14.0]);
        assert_eq!(of("js6", 0.5), [-20.0, 20.0]);
        for length in [0.0, -0.01, 0.501] {
            let fault = Class::parse("h7").unwrap().deviations(length).unwrap_err();
            assert!(fault.contains("500 mm"), "{fault}");
        }
    }
}
