//! Samples of a machine from a CSV file.

use crate::dynamics::steady::{Refusal, Table};
use crate::units::{Quantity, parse, quantities as q};

/// Largest table that is read (bytes).
const LARGEST: usize = 64 << 20;

/// Content of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Column {
    Position,
    Inertia,
    Work,
    Moment,
}

impl Column {
    const ALL: [Self; 4] = [Self::Position, Self::Inertia, Self::Work, Self::Moment];

    fn names(self) -> [&'static str; 3] {
        match self {
            Self::Position => ["position", "phi", "φ"],
            Self::Inertia => ["inertia", "J", "j"],
            Self::Work => ["work", "A", "a"],
            Self::Moment => ["moment", "M", "m"],
        }
    }

    fn quantity(self) -> Quantity {
        match self {
            Self::Position => q::ANGLE,
            Self::Inertia => q::INERTIA,
            Self::Work | Self::Moment => q::MOMENT,
        }
    }
}

const FORM: &str = "the first line names the columns: phi [deg],J [kg m^2],A [N m]; the third is \
                    the work A or the moment M; without a unit they are SI";

/// Reads a table of position, inertia and work or moment over a cycle (rad).
///
/// # Errors
/// What is wrong, with its line; everything that [`Table::new`] refuses.
pub fn table(text: &str, cycle: f64) -> Result<Table, Refusal> {
    let wrong = |message: String| Refusal::field("table", message, FORM);
    if text.len() > LARGEST {
        return Err(wrong("the file is larger than 64 MiB".to_owned()));
    }
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .comment(Some(b'#'))
        .from_reader(text.trim_start_matches('\u{feff}').as_bytes());
    let header = reader
        .headers()
        .map_err(|error| wrong(error.to_string()))?
        .clone();
    let columns: Vec<(Column, f64)> = header
        .iter()
        .map(|name| column(name).map_err(wrong))
        .collect::<Result<_, _>>()?;
    let place = |wanted: Column| columns.iter().position(|column| column.0 == wanted);
    for column in Column::ALL {
        if columns.iter().filter(|other| other.0 == column).count() > 1 {
            return Err(wrong(format!(
                "two columns are named {}",
                column.names()[1]
            )));
        }
    }
    let (work, moment) = (place(Column::Work), place(Column::Moment));
    let (Some(position), Some(inertia)) = (place(Column::Position), place(Column::Inertia)) else {
        return Err(wrong("a column is missing: phi or J".to_owned()));
    };
    let other = match (work, moment) {
        (Some(one), None) | (None, Some(one)) => one,
        (None, None) => return Err(wrong("a column is missing: A or M".to_owned())),
        _ => return Err(wrong("there is both a work A and a moment M".to_owned())),
    };
    let mut values = [Vec::new(), Vec::new(), Vec::new()];
    for record in reader.records() {
        let record = record.map_err(|error| wrong(error.to_string()))?;
        let line = record.position().map_or(0, csv::Position::line);
        for (list, index) in values.iter_mut().zip([position, inertia, other]) {
            let text = record.get(index).unwrap_or("");
            let number: f64 = text
                .parse()
                .map_err(|_| wrong(format!("line {line}: \"{text}\" is not a number")))?;
            list.push(number * columns[index].1);
        }
    }
    let [positions, inertia, other] = values;
    match moment {
        Some(_) => Table::of_moments(cycle, &positions, &inertia, &other),
        None => Table::new(cycle, &positions, &inertia, &other),
    }
}

/// `phi [deg]`: what it is, and the factor to SI.
fn column(name: &str) -> Result<(Column, f64), String> {
    let (symbol, unit) = match name.split_once('[') {
        Some((symbol, rest)) => (symbol.trim(), rest.trim_end().trim_end_matches(']').trim()),
        None => (name.trim(), ""),
    };
    let found = Column::ALL
        .into_iter()
        .find(|column| column.names().contains(&symbol));
    let column = found.ok_or_else(|| format!("a column \"{name}\" is not known"))?;
    if unit.is_empty() || matches!((column, unit), (Column::Work, "J")) {
        return Ok((column, 1.0));
    }
    let measure = parse(&format!("1 {unit}")).map_err(|_| format!("unknown unit in \"{name}\""))?;
    let factor = column.quantity().accept(measure);
    let units = column.quantity().units.join(", ");
    Ok((
        column,
        factor.map_err(|_| format!("\"{name}\": the unit must be one of {units}"))?,
    ))
}

#[cfg(test)]
mod tests {
    use super::table;
    use crate::dynamics::steady::Question;
    use std::f64::consts::TAU;

    #[test]
    fn tables_are_read_with_their_units_and_both_kinds_agree() {
        let rows = |other: &dyn Fn(f64) -> f64| -> String {
            (0..=72)
                .map(|k| {
                    let phi = 5.0 * f64::from(k);
                    format!("{phi},2000,{}\n", other(phi.to_radians()))
                })
                .collect()
        };
        let works = format!("phi [deg],J [kg mm^2],A\n{}", rows(&|phi| 0.03 * phi.sin()));
        let moments = format!(
            "# measured\nphi [deg],J [kg mm^2],M [N mm]\n{}",
            rows(&|phi| 30.0 * phi.cos())
        );
        let [one, other] = [works, moments].map(|text| {
            let table = table(&text, TAU).unwrap();
            table
                .find_steady_motion(&Question::new(10.0))
                .unwrap()
                .figures
                .steady
        });
        approx::assert_relative_eq!(
            one.energy_at_start,
            0.103_342_352_430_8,
            max_relative = 1e-9
        );
        approx::assert_relative_eq!(
            other.energy_at_start,
            one.energy_at_start,
            max_relative = 1e-6
        );
    }

    #[test]
    fn faulty_tables_are_refused_with_their_line() {
        for (text, word) in [
            ("", "missing"),
            ("phi,J\n0,1\n", "A or M"),
            ("phi,J,A,M\n", "both"),
            ("phi,J,A,A\n", "two columns"),
            ("phi,J,B\n", "not known"),
            ("phi [kg],J,A\n", "unit"),
            ("phi,J,A\n0,1,0\n1,x,0\n", "line 3"),
            ("phi,J,A\n0,1,0\n1,1\n", "record"),
            ("phi,J,A\n0,1,0\n1,1,1\n", "too few"),
        ] {
            let refusal = table(text, TAU).unwrap_err();
            assert!(
                refusal.message().contains(word),
                "{text:?}: {}",
                refusal.message()
            );
        }
    }
}
