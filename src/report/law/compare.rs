//! Laws compared by constants and by response, as findings and rows.

use crate::report::addresses::parameter_words;
use crate::report::csv::{Field, Rows};
use crate::report::findings::{Cell, Findings, Item, Layout, Section, Source, Table, Value};
use crate::report::plot::{Axis, Mark, Plot, Series, Shape};
use crate::report::quantity::with_unit;
use crate::report::verdict::{Sort, Verdict};
use crate::studies::law::{ComparedLaw, Figure, LiftOff};

/// Laws side by side, every figure with its place, best first by `by`. `trusted`: every run
/// withstood its own check; `at`: the property that was exchanged.
pub fn comparison_findings<'a>(
    scene: &str,
    at: &str,
    laws: &[ComparedLaw],
    by: Figure,
    trusted: bool,
    source: Source<'a>,
) -> Findings<'a> {
    let (sort, doubt) = match trusted {
        true => (Sort::Good, ""),
        false => (
            Sort::Mechanism,
            " Some runs failed their own check: see the results.",
        ),
    };
    let best = match best_laws(laws, by).as_slice() {
        [] => "none".to_owned(),
        best => names_in_words(&best.join(", ")),
    };
    let headline = format!("Best by {}: {best}, of {} laws.", by.words(), laws.len());
    let text = doubt.trim_start();
    Findings {
        title: scene.to_owned(),
        subtitle: format!("laws compared for the {}", parameter_words(at)),
        answer: Some(Verdict::answer(sort, headline, text)),
        warnings: Vec::new(),
        sections: vec![
            Section::new("Diagrams").charts(Layout::Wide(440.0), "law", vec![chart(laws)]),
            Section::new("Results, and places among the laws")
                .table(table(laws, by))
                .item(Item::Notes(other_criteria(laws, by))),
        ],
        source,
    }
}

/// Names of laws as words: `modified_sine` as modified sine.
fn names_in_words(names: &str) -> String {
    names.replace('_', " ")
}

fn table(laws: &[ComparedLaw], by: Figure) -> Table {
    let places = by.ranks(laws);
    let mut order: Vec<usize> = (0..laws.len()).collect();
    order.sort_by_cached_key(|&index| (places[index].unwrap_or(usize::MAX), index));
    let shown: Vec<Figure> = Figure::ALL
        .into_iter()
        .filter(|figure| laws.iter().any(|law| figure.of(law).is_some()))
        .collect();
    let names: Vec<String> = shown
        .iter()
        .map(|one| format!(">{}", one.words()))
        .collect();
    let rows = order.iter().map(|&index| {
        let cells = shown.iter().map(|figure| cell(*figure, laws, index));
        let name = Cell::from(names_in_words(&laws[index].name));
        std::iter::once(name).chain(cells).collect::<Vec<Cell>>()
    });
    Table::new(std::iter::once("law").chain(names.iter().map(String::as_str))).rows(rows)
}

/// Value and place: `4.888 (2)`.
fn cell(figure: Figure, laws: &[ComparedLaw], index: usize) -> Cell {
    let law = &laws[index];
    let value = Value::new(figure.of(law).unwrap_or(f64::NAN), figure.unit(law), 5);
    let value = match (figure, law.response.lift_off) {
        (Figure::LiftOff, Some(LiftOff::Above(_))) => format!("> {}", value.words()).into(),
        (Figure::LiftOff, Some(LiftOff::Below(_))) => format!("< {}", value.words()).into(),
        _ => value,
    };
    let place = figure.ranks(laws)[index];
    Cell::with_note(
        value,
        place.map_or(String::new(), |place| format!("({place})")),
    )
}

/// The laws with the first place by a figure.
fn best_laws(laws: &[ComparedLaw], figure: Figure) -> Vec<&str> {
    let places = figure.ranks(laws);
    let winners = laws.iter().zip(&places);
    let winners = winners.filter(|(_, place)| **place == Some(1));
    winners.map(|(law, _)| law.name.as_str()).collect()
}

/// The constants that would have chosen another law.
fn other_criteria(laws: &[ComparedLaw], by: Figure) -> Vec<String> {
    let chosen = best_laws(laws, by);
    let constants = Figure::ALL.into_iter().filter(|one| one.is_constant());
    let misleading = constants.filter_map(|figure| {
        let named = best_laws(laws, figure);
        let other = !named.is_empty() && !named.iter().any(|name| chosen.contains(name));
        let list = names_in_words(&named.join(", "));
        other.then(|| format!("by {} alone it would have been: {list}", figure.words()))
    });
    misleading.collect()
}

/// The comparison: one row a law, every figure with its place.
pub fn comparison_rows(laws: &[ComparedLaw]) -> Rows {
    let names = Figure::ALL.into_iter().flat_map(|figure| {
        let name = figure.name();
        [name.to_owned(), format!("{name} place")]
    });
    let rows = laws.iter().enumerate().map(|(index, law)| {
        let cells = Figure::ALL.into_iter().flat_map(|figure| {
            let place = figure.ranks(laws)[index];
            let place = place.map(|place| place.to_string());
            [figure.of(law).into(), place.unwrap_or_default().into()]
        });
        let name = Field::from(law.name.as_str());
        std::iter::once(name).chain(cells).collect::<Vec<Field>>()
    });
    Rows::new(std::iter::once("law".to_owned()).chain(names), rows)
}

/// Laws compared: every figure as a multiple of the best law's, one row a law.
fn chart(laws: &[ComparedLaw]) -> Plot {
    let figures = Figure::ALL.into_iter().filter_map(|figure| {
        let places = figure.ranks(laws);
        let best = laws
            .iter()
            .zip(&places)
            .find(|(_, place)| **place == Some(1));
        let best = figure.of(best?.0)?;
        let mut points = Vec::new();
        let mut marks = Vec::new();
        for (row, law) in laws.iter().enumerate() {
            let Some(value) = figure.of(law).filter(|_| best != 0.0) else {
                continue;
            };
            points.push((value / best, row as f64 + 0.5));
            let value = with_unit(value, figure.unit(law), 6);
            let note = format!("{}: {} = {value}", law.name, figure.words());
            marks.push(Mark::new(Shape::Good, note));
        }
        let series = Series::marked(figure.words(), points, marks);
        (!series.points.is_empty()).then_some(series)
    });
    Plot {
        title: "Every result as a multiple of the best law's".to_owned(),
        x: Axis::logarithmic("multiple of the best", ""),
        y: Axis {
            rows: laws.iter().map(|law| names_in_words(&law.name)).collect(),
            ..Axis::default()
        },
        series: figures.collect(),
        ..Plot::default()
    }
}

#[cfg(test)]
mod tests {
    use super::{comparison_findings, comparison_rows};
    use crate::kinematics::motion::{Law, LawName};
    use crate::report::findings::Source;
    use crate::studies::law::{ComparedLaw, Figure, LawResponse};

    fn law(name: LawName, residual: f64) -> ComparedLaw {
        ComparedLaw {
            name: name.name().to_owned(),
            constants: Law::of_stroke(&name.into()).unwrap().constants(),
            response: LawResponse {
                residual: Some(residual),
                ..LawResponse::default()
            },
        }
    }

    #[test]
    fn the_best_stands_first_and_misleading_constants_are_named() {
        let laws = [law(LawName::Parabolic, 2e-3), law(LawName::Cycloidal, 1e-4)];
        let text = comparison_findings(
            "scene",
            "at",
            &laws,
            Figure::Residual,
            true,
            Source::default(),
        );
        let text = text.text(None);
        let place = |name: &str| text.find(&format!("\n  {name}")).unwrap();
        assert!(place("cycloidal") < place("parabolic"), "{text}");
        assert!(text.contains("Best by residual vibration: cycloidal"));
        assert!(text.contains("by C_a alone it would have been: parabolic"));
        let csv = comparison_rows(&laws).csv();
        assert!(csv.starts_with("law,C_v,C_v place"), "{csv}");
        assert!(csv.contains("\nparabolic,2,1,4,1,0,1,8,1,2e-3,2,"), "{csv}");
    }
}
