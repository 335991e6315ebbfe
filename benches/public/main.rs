//! The scoreboard of public cases: what others stored, `dam` at its default tolerance and at
//! 1e-12, each against digits that share no code with it. Prints a table in Markdown:
//! `cargo bench --package dam-benches --bench public -- docs/scoreboard.md` writes it.

// It prints, as a program does.
#![allow(clippy::print_stdout, clippy::print_stderr)]

mod board;

use board::{Case, Figure, Found, cases};
use std::fmt::Write as _;
use std::path::Path;

const TIGHT: f64 = 1e-12;

fn main() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let cases = cases(&here.join("public"));
    let text = document(&cases);
    // Cargo itself adds `--bench`.
    match std::env::args().skip(1).find(|path| !path.starts_with('-')) {
        Some(path) => std::fs::write(here.join("..").join(path), text).expect("a file"),
        None => print!("{text}"),
    }
}

fn document(cases: &[Case]) -> String {
    let mut text = String::from(
        "# Scoreboard of public cases\n\n\
         Cases that others published with figures of other programs, which stand in `benches/public`, a folder a case: the\n\
         scene, the source, the stored figure, and the script or closed form of the true one, which shares no code with\n\
         `dam`. Errors are against those digits. `dam` runs the scene as it stands (tolerance 1e-6 unless the scene says\n\
         otherwise), and at 1e-12; its time is that of a whole run in one process, reading included, on one machine.\n\
         Written by `cargo bench --package dam-benches --bench public -- docs/scoreboard.md`.\n\n\
         | case | program | figure | true | stored, off by | `dam`, off by | steps | ms | `dam` at 1e-12, off by |\n\
         | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
    );
    for case in cases {
        for figure in &case.figures {
            let [own, tight] = [None, Some(TIGHT)].map(|tolerance| best(case, figure, tolerance));
            let off = |value: f64| format!("{:.0e}", (value - figure.truth).abs());
            let truth = format!("{} ± {:.0e}", figure.truth, figure.truth_error);
            let stored = figure.stored.map_or("not stored".to_owned(), |stored| {
                let kind = if figure.reference { "reference, " } else { "" };
                format!(
                    "{} ({kind}last digit {:.0e})",
                    off(stored),
                    figure.last_digit
                )
            });
            let _ = writeln!(
                text,
                "| {} | {} | `{}` at {} s | {truth} | {stored} | {} | {} | {:.1} | {} |",
                case.name,
                case.program,
                figure.figure,
                figure.at,
                off(own.value),
                own.steps,
                1e3 * own.seconds,
                off(tight.value),
            );
        }
    }
    let touching = cases.iter().filter(|case| case.contact_or_friction).count();
    let _ = writeln!(
        text,
        "\n{} cases, {touching} with contact or friction.",
        cases.len()
    );
    text.push_str("\nSources of the stored figures, and of the true ones:\n\n");
    for case in cases {
        let _ = writeln!(
            text,
            "- {}: {}. True: {}.",
            case.name, case.source, case.truth
        );
    }
    text.push_str("\nWhat was learnt of the stored figures:\n\n");
    for case in cases.iter().filter(|case| !case.remark.is_empty()) {
        let _ = writeln!(text, "- {}: {}", case.name, case.remark);
    }
    text.push_str(
        "\n`benches/public/README.md` says which cases were looked at and left out, and why.\n",
    );
    text
}

/// The quickest of five runs.
fn best(case: &Case, figure: &Figure, tolerance: Option<f64>) -> Found {
    let runs = (0..5).map(|_| case.run(figure, tolerance));
    let quickest = runs.min_by(|a, b| a.seconds.total_cmp(&b.seconds));
    quickest.expect("five runs")
}
