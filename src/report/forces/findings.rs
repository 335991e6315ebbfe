//! What the forces of a linkage come to.

use super::changes::{massless_section, sensitivities_section};
use super::charts::{chart_sections, ratio_chart};
use super::reactions::reactions_section;
use super::words::{driving, quantity_words};
use super::{ForcesReport, WIDE, drawing, inputs, value};
use crate::kinematics::linkage::spec::{LinkageSpec, PairSpec};
use crate::report::csv::{Field, Rows, column_heading};
use crate::report::findings::table::check_outcome;
use crate::report::findings::{Cell, Figure, Findings, Layout, Section, Source, Table};
use crate::report::plot::{Plot, page::hodograph};
use crate::report::quantity::{DIGITS, counted, significant};
use crate::report::sentence::{Sentence, in_shown_units};
use crate::report::verdict::{Verdict, capitalised};
use crate::studies::forces::{Extreme, Extremes, ForceStudy};
use crate::studies::judgement::Judgement;
use std::collections::BTreeSet;
use std::fmt::Write as _;

/// Most points of a hodograph.
const MOST_POINTS: usize = 2000;

/// Drawing, zones, the cycle, transmission, charts, sensitivities, extremes.
pub fn findings<'a>(report: &ForcesReport<'a>, source: Source<'a>) -> Findings<'a> {
    let study = report.study;
    let (positions, motion) = match (study.rows.as_slice(), report.is_of_one_position()) {
        ([row], true) => (
            format!("at {}", report.place_text(row.motion.coordinate)),
            report.motion.replace(" at every position", ""),
        ),
        (rows, _) => (counted(rows.len(), "position"), report.motion.to_owned()),
    };
    let mut subtitle = format!(
        "forces of {}, {positions}, {}",
        report.object,
        in_shown_units(&motion)
    );
    if let Some(output) = study.settings.output {
        let (output, convention) = (
            &study.linkage.outputs[output].name,
            study.settings.convention,
        );
        let name = convention.name();
        let _ = write!(subtitle, "; output {output}, sign of χ: convention {name}");
    }
    let drawn = *report;
    let mechanism = match study.solved().next() {
        None => Section::default(),
        Some(_) => Section::new("The mechanism with its forces")
            .drawing(move |_| drawing(&drawn).section("mechanism"))
            .legend(drawn_forces(&study.linkage)),
    };
    let ratio = ratio_chart(report).filter(|_| !report.is_of_one_position());
    let ratio = ratio.into_iter().collect();
    let mut sections = vec![
        mechanism,
        zones_section(report),
        reactions_section(report),
        section_of_indeterminate(study),
        Section::new(course_phrase(report)).figures(figures(report)),
        Section::new("Transmission").charts(WIDE, "", ratio),
        massless_section(report),
    ];
    // (Nothing changes over one position.)
    if report.is_of_one_position() {
        sections.push(sensitivities_section(report));
        sections.push(Section::new("All results").table(at_one_position_table(report)));
    } else {
        let legend = "The tip of each force over the course; the dot is the first position.";
        let hodographs = hodographs(study);
        let section = Section::new("Hodographs").legend(legend);
        sections.push(section.charts(Layout::Round, "", hodographs));
        sections.extend(chart_sections(report));
        sections.push(sensitivities_section(report));
        sections.push(Section::new("Extremes").table(extremes_table(report)));
    }
    Findings {
        title: report.name.to_owned(),
        subtitle,
        answer: Some(answer(report)),
        warnings: report.warnings.to_vec(),
        sections,
        source,
    }
}

/// Between what the driving force lies, and whether the balance of power closes.
fn answer(report: &ForcesReport<'_>) -> Verdict {
    let study = report.study;
    let between = |drive: &Extremes| {
        let end = |end: &Extreme| match end.value.is_finite() {
            true => Sentence::default().quantity(end.value, &drive.unit, DIGITS),
            false => Sentence::from("unbounded"),
        };
        let at = drive.name.strip_prefix("drive.");
        let at = at.map_or(String::new(), |input| format!("at {input} "));
        if [&drive.least, &drive.greatest].map(|end| end.value.is_finite()) == [false; 2] {
            return Sentence::from(format!("{at}without bounds"));
        }
        if report.is_of_one_position() {
            return Sentence::from(at).sentence(end(&drive.least));
        }
        let from = Sentence::from(format!("{at}from ")).sentence(end(&drive.least));
        from.words(" to ").sentence(end(&drive.greatest))
    };
    let drives = (study.extremes.iter())
        .filter(|found| found.name == "drive" || found.name.starts_with("drive."));
    let drives: Vec<&Extremes> = drives.collect();
    let turns = drives.iter().all(|drive| drive.unit == "N m");
    let kind = driving(if turns { "N m" } else { "N" });
    let drives: Vec<Sentence> = drives.into_iter().map(between).collect();
    let headline = match drives.is_empty() {
        false => Sentence::from(format!("{} ", capitalised(kind)))
            .sentence(Sentence::joined(drives, ", "))
            .words("."),
        true if study.indeterminate.drive => Sentence::from(format!(
            "The {} is statically indeterminate.",
            driving(study.drive_unit())
        )),
        true if study.missing() < study.rows.len() => {
            Sentence::from("Forces grow without bound towards the dead-centre position.")
        }
        true => Sentence::from("No position has forces."),
    };
    let (of, solved) = (study.rows.len(), study.solved().count());
    let without = format!("{} of {of} positions have no forces", of - solved);
    let checks = study.checks();
    let closes = checks.first().map_or(String::new(), check_outcome);
    let text = match solved {
        0 => without,
        _ if solved == of => format!("The balance of power closes to {closes}"),
        _ => format!("The balance of power closes to {closes}; {without}"),
    };
    let judgement = study.judgement();
    let headline = match judgement {
        Judgement::NotToBeTrusted => Sentence::from("Not to be trusted. ").sentence(headline),
        Judgement::InWorkingOrder | Judgement::NotInWorkingOrder | Judgement::NotJudged => headline,
    };
    Verdict::of_judgement(judgement, headline, text + ".")
}

fn hodographs(study: &ForceStudy) -> Vec<Plot> {
    let stride = study.rows.len().div_ceil(MOST_POINTS).max(1);
    let pairs = study.linkage.pairs.iter().enumerate();
    let chart = |(index, pair): (usize, &PairSpec)| {
        let vectors = study.rows.iter().step_by(stride).map(|row| {
            let forces = row.forces.as_ref();
            let [x, y] = forces.map_or([f64::NAN; 2], |forces| forces.pairs[index].force);
            (x, y)
        });
        let mut vectors: Vec<(f64, f64)> = vectors.collect();
        if study.course.is_closed() {
            vectors.extend(vectors.first().copied());
        }
        hodograph(&format!("Force in {}", pair.name), "N", vectors)
    };
    let told = pairs.filter(|(index, _)| !study.is_open(*index));
    told.map(chart).collect()
}

fn zones_section<'a>(report: &ForcesReport<'_>) -> Section<'a> {
    let zones = report.study.zones.iter();
    let rows = zones.map(|zone| {
        let [from, to] = [zone.from, zone.to].map(|at| report.place_text(at));
        vec![from, to, report.zone(zone)]
    });
    let table = Table::new([">from", ">to", "what"]).rows(rows);
    match table.rows.is_empty() {
        true => Section::default(),
        false => Section::new("Zones")
            .table(table)
            .legend("Shaded in the plots."),
    }
}

/// What rigid links leave open, and why.
fn section_of_indeterminate<'a>(study: &ForceStudy) -> Section<'a> {
    let names = study.open_names();
    if names.is_empty() {
        return Section::default();
    }
    let redundant = study.linkage.redundant.iter();
    let redundant: Vec<String> = redundant.map(|one| one.describe(&study.linkage)).collect();
    let words = format!(
        "Redundant: {}. How the load is shared out depends on elasticity, clearances and errors \
         of length, so that the forces of {} have no values here.",
        redundant.join("; "),
        names.join(", ")
    );
    Section::new("Statically indeterminate").with_paragraph(words)
}

fn course_phrase(report: &ForcesReport<'_>) -> String {
    match &report.study.cycle {
        Some(cycle) => {
            let over = value(cycle.duration, "s").words();
            match cycle.closed {
                true => format!("Cycle of {over}"),
                false => format!("Whole course of {over}"),
            }
        }
        None => "Results".to_owned(),
    }
}

/// Works and losses, the counterweight, checks.
fn figures(report: &ForcesReport<'_>) -> Vec<Figure> {
    let study = report.study;
    let mut figures = Vec::new();
    let mut add = |name: &str, number: f64, unit: &str| {
        figures.push(Figure::new(name, value(number, unit)));
    };
    if let Some(cycle) = &study.cycle {
        let force = study.several.is_none().then(|| study.drive_unit());
        let drivers = match study.several {
            None => "work of the driver",
            Some(_) => "work of the drivers",
        };
        add(drivers, cycle.drive_work, "J");
        if study.settings.output.is_some() {
            add("work of the load", cycle.load_work, "J");
        }
        add("lost to friction", cycle.loss, "J");
        let pairs = study.linkage.pairs.iter().zip(&cycle.pair_losses);
        for (pair, &loss) in pairs.filter(|(_, loss)| **loss > 0.0) {
            add(&format!("… in {}", pair.name), loss, "J");
        }
        if let Some(efficiency) = cycle.efficiency {
            add("efficiency", 100.0 * efficiency, "%");
        }
        if let Some(force) = force {
            let mean = format!("mean {}", driving(force));
            add(&mean, cycle.mean_drive, force);
            add("its root mean square", cycle.rms_drive, force);
        }
    }
    if let (Some(found), true) = (&study.counterweight, report.is_of_one_position()) {
        let force = value(found.greatest[0], "N");
        figures.push(Figure::new("shaking force", force));
    } else if let Some(found) = &study.counterweight {
        let [before, after] = found.greatest;
        let note = format!("rms {}", value(found.rms[0], "N").words());
        figures.push(Figure::new("greatest shaking force", value(before, "N")).with_note(note));
        let note = format!(
            "rms {}, with a counterweight of {} at {} deg in the frame of `{}`",
            value(found.rms[1], "N").words(),
            value(found.mass_radius, "kg m").words(),
            significant(found.angle.to_degrees(), DIGITS),
            study.linkage.links[found.link].name
        );
        figures.push(Figure::new("… counterweighted", value(after, "N")).with_note(note));
    }
    figures.extend(study.checks().iter().map(Figure::check));
    figures
}

/// The results of a single position.
fn at_one_position_table(report: &ForcesReport<'_>) -> Table {
    let inputs = inputs(report.study);
    let rows = report.study.extremes.iter().map(|found| {
        let known = match found.least.value.is_finite() {
            true => Cell::from(value(found.least.value, &found.unit)),
            false => Cell::from("unbounded"),
        };
        let words = quantity_words(&found.name, &found.unit, &inputs);
        vec![Cell::address(&found.name, words), known]
    });
    Table::new(["quantity", ">value"]).rows(rows)
}

fn extremes_table(report: &ForcesReport<'_>) -> Table {
    let inputs = inputs(report.study);
    let rows = report.study.extremes.iter().map(|found| {
        let cell = |end: &Extreme| {
            let place = report.place_text(end.at);
            match end.value.is_finite() {
                true => Cell::with_note(value(end.value, &found.unit), format!("at {place}")),
                false => Cell::with_note("unbounded", format!("→ {place}")),
            }
        };
        let words = quantity_words(&found.name, &found.unit, &inputs);
        let name = Cell::address(&found.name, words);
        vec![name, cell(&found.least), cell(&found.greatest)]
    });
    Table::new(["quantity", ">least", ">greatest"]).rows(rows)
}

/// A row a position, everything in SI units, angles in radians; empty where a
/// quantity has no value, or is statically indeterminate. χ stands with the name of its convention. The last column says why a
/// position has no forces.
pub fn rows(study: &ForceStudy) -> Rows {
    let columns = study.columns();
    let timed = study.rows.iter().any(|row| row.time.is_some());
    let named = columns.iter().map(|column| {
        let name = match column.name.as_str() {
            // Its sign is a convention.
            "chi" => format!("chi ({})", study.settings.convention.name()),
            name => name.to_owned(),
        };
        let open = match column.indeterminate {
            true => " (statically indeterminate)",
            false => "",
        };
        column_heading(&name, &column.unit) + open
    });
    let time = timed.then(|| "time [s]".to_owned());
    let coordinate = match study.several.as_ref().map(|several| several.axis) {
        Some("time") => "time [s]".to_owned(),
        Some("path") => "path".to_owned(),
        _ => format!("coordinate [{}]", study.coordinate_unit()),
    };
    let header = time.into_iter().chain([coordinate]).chain(named);
    let rows = study.rows.iter().map(|row| {
        let time = timed.then(|| row.time.into());
        let values = columns.iter().map(|column| column.value(row).into());
        let trouble = row.forces.as_ref().err().map(ToString::to_string);
        let trouble = Field::from(trouble.unwrap_or_default());
        let coordinate = row.motion.coordinate.into();
        let fields = time.into_iter().chain([coordinate]).chain(values);
        fields.chain([trouble]).collect::<Vec<Field>>()
    });
    Rows::new(header.chain(["trouble".to_owned()]), rows)
}

/// Which forces the drawing shows, and where.
fn drawn_forces(linkage: &LinkageSpec) -> String {
    let pairs = "Forces act on the second link of their pair, friction included; a block's force is \
                 drawn at its reference point.";
    let kinds = linkage.couplings.iter();
    let told: BTreeSet<&str> = kinds.map(|one| one.kind.words().drawn).collect();
    if told.is_empty() {
        return pairs.to_owned();
    }
    let told: Vec<&str> = told.into_iter().collect();
    format!("{pairs} Of couplings: {}.", told.join("; "))
}
