//! Laws in print.

use super::*;
use crate::kinematics::motion::LawName;

fn row(name: LawName) -> (LawRow, Law) {
    let law = Law::of_stroke(&name.into()).unwrap();
    let row = LawRow {
        name: name.name().to_owned(),
        words: name.words().to_owned(),
        constants: law.constants(),
    };
    (row, law)
}

#[test]
fn a_table_has_a_row_a_law_and_the_published_figures() {
    let rows = LawName::ALL.map(|name| row(name).0);
    let text = constants_table(&rows).text();
    assert_eq!(text.lines().count(), 1 + LawName::ALL.len());
    let sine = text
        .lines()
        .find(|line| line.starts_with("  modified_sine"));
    assert!(sine.unwrap().contains("5.527957"), "{text}");
    let csv = constants_rows(&rows).csv();
    assert!(csv.contains("cycloidal,2,6.28318530717958"), "{csv}");
}

#[test]
fn shocks_are_said() {
    let (harmonic, law) = row(LawName::Harmonic);
    let text = law_findings(&harmonic, &law).text(None);
    assert!(
        text.contains("soft shock at τ = 1: acceleration jumps from -4.9348"),
        "{text}"
    );
    let (smooth, law) = row(LawName::Polynomial4567);
    let text = law_findings(&smooth, &law).text(None);
    assert!(!text.contains("soft shock at"), "{text}");
}

#[test]
fn samples_have_both_sides_of_every_joint() {
    let (_, law) = row(LawName::Parabolic);
    let text = law_rows(&law, 4).csv();
    let rows: Vec<Vec<f64>> = text
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect())
        .collect();
    let taus: Vec<f64> = rows.iter().map(|row| row[0]).collect();
    assert_eq!(taus, [0.0, 0.25, 0.5, 0.5, 0.75, 1.0]);
    assert_eq!((rows[2][3], rows[3][3]), (4.0, -4.0));
    let (row, law) = row(LawName::ModifiedTrapezoid);
    let found = law_findings(&row, &law);
    let picture = found.first_chart().unwrap().svg(640.0, 320.0);
    assert!(
        picture.contains("acceleration θ″ / 4.8881")
            && picture.contains(">share τ of the duration</text>"),
        "{picture}"
    );
}
