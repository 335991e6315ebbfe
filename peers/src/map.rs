//! The map of max|δ| over inertia and stiffness, two masses, 20 by 20 cells.

use crate::chain::Chain;
use crate::cvode_peer::Cvode;
use crate::diffsol_peer;
use crate::exact_peer;
use crate::solution::Timing;
use crate::table::table;
use dam::exact::{Request, RequestedFigures};
use dam::scene::{BuiltIn, Document};
use dam::studies::Control;
use dam::studies::axis::Axis;
use dam::studies::map::{Panels, Question, Silent, Study, map as work_out};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::time::{Duration, Instant};

/// Cells along each side.
const CELLS: usize = 20;

/// Closing moment (N·m).
const LOAD: f64 = 600.0;

/// Tolerance of the other solvers.
const TOLERANCE: f64 = 1e-8;

/// Error that a determined cell of `dam` may have.
const ALLOWED: f64 = 1e-6;

/// Relative change of the load, and the relative change of max|δ| beyond which
/// a cell is not determined.
const CHANGE: [f64; 2] = [1e-10, 1e-7];

const ABOUT: &str = "\
max|δ| in each of 20 × 20 cells: two masses, J = 0.05 … 1 kg m², c = 0.25e7 … 5e7 N m/rad,
10 Hz, M = 600 N m, ψ = 0.4, T = 1 s. Errors are relative, over the cells that are
determined: those where 1e-10 more load moves max|δ| by less than 1e-7, against a Taylor
series in 80-bit arithmetic; `dam` is limited to 1e-6. `dam map` decodes, lowers, runs and judges every
cell (value, verdict and cause); the rows above it are the runs alone.
";

fn cell(index: usize, load: f64) -> Chain {
    let share = |k: usize| k as f64 / (CELLS - 1) as f64;
    let inertia = 0.05 + 0.95 * share(index / CELLS);
    let stiffness = 0.25e7 + 4.75e7 * share(index % CELLS);
    Chain::new(2, [inertia, stiffness], load, 0.4, 1.0)
}

/// max|δ| of a cell by exact propagation; NaN where it refuses.
fn peak(index: usize, load: f64) -> f64 {
    let chain = cell(index, load);
    let request = Request {
        figures: true,
        asked: RequestedFigures::DEVIATION,
        ..Request::new(chain.duration, 0)
    };
    let run = exact_peer::run(&exact_peer::tree(&chain), &request);
    run.map_or(f64::NAN, |run| {
        run.figures[0].delta_max.max(-run.figures[0].delta_min)
    })
}

/// The reference.
fn reference() -> Vec<f64> {
    let lines = include_str!("../reference/map.txt").lines();
    let values: Vec<f64> = lines
        .filter(|line| !line.starts_with('#'))
        .map(|line| line.parse().expect("a number"))
        .collect();
    assert_eq!(values.len(), CELLS * CELLS);
    values
}

/// Median and greatest relative error over the cells chosen.
fn errors(values: &[f64], reference: &[f64], chosen: &[bool]) -> [f64; 2] {
    let pairs = values.iter().zip(reference).zip(chosen);
    let mut errors: Vec<f64> = pairs
        .filter(|(_, chosen)| **chosen)
        .map(|((value, reference), _)| (value / reference - 1.0).abs())
        .map(|error| if error.is_nan() { f64::INFINITY } else { error })
        .collect();
    errors.sort_by(f64::total_cmp);
    [errors[errors.len() / 2], errors[errors.len() - 1]]
}

/// Cells in which max|δ| is determined, and `dam`'s values.
fn determined() -> (Vec<bool>, Vec<f64>) {
    let all = 0..CELLS * CELLS;
    let values: Vec<f64> = all.clone().into_par_iter().map(|k| peak(k, LOAD)).collect();
    let changed = LOAD * (1.0 + CHANGE[0]);
    let moved: Vec<f64> = all.into_par_iter().map(|k| peak(k, changed)).collect();
    let still = values.iter().zip(&moved);
    let chosen = still
        .map(|(value, moved)| (moved / value - 1.0).abs() <= CHANGE[1])
        .collect();
    (chosen, values)
}

/// Wall times of the map on a number of threads.
fn timed(threads: usize, budget: Duration) -> Result<Timing, String> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|error| error.to_string())?;
    let map = || -> Vec<f64> {
        // Cells differ in cost: threads take them one by one.
        let cells = (0..CELLS * CELLS).into_par_iter().with_max_len(1);
        cells.map(|k| peak(k, LOAD)).collect()
    };
    Ok(Timing::measure(budget, || pool.install(map)))
}

/// Wall times of the same map by the command.
fn commanded(threads: usize, budget: Duration) -> Result<Timing, String> {
    let text = include_bytes!("../../scenarios/rocker/two_masses.json");
    let document = Document::parse("two_masses.json", text).map_err(|d| d.to_string())?;
    let settings = ["run.duration=1", "run.start=\"on_law\""];
    let question = Question {
        overrides: settings.map(str::to_owned).to_vec(),
        x: Axis::parse(&format!("rocker.inertia=0.05:1:{CELLS}"))?,
        y: Some(Axis::parse(&format!(
            "rocker.stiffness=0.25e7:5e7:{CELLS}"
        ))?),
        panels: Panels::default(),
        figure: Some("rocker.delta_max".to_owned()),
        check_determined: false,
        digits: 7,
    };
    let study = Study::new(&document, &BuiltIn, question).map_err(|fault| format!("{fault:?}"))?;
    let run = || {
        let control = Control::default();
        work_out(&study, BTreeMap::new(), Some(threads), &control, &Silent)
    };
    run()?;
    Ok(Timing::measure(budget, run))
}

/// Median and greatest error of `dam`'s values over the determined cells, and
/// which cells these are.
pub(crate) fn own_errors() -> ([f64; 2], Vec<bool>) {
    let (chosen, values) = determined();
    (errors(&values, &reference(), &chosen), chosen)
}

/// Runs the map by `dam`, diffsol and CVODE and returns the table.
///
/// # Errors
/// A determined cell of `dam` is wrong by more than 1e-6, or a peer fails.
pub(crate) fn map(cvode: Option<&Cvode>, quick: bool) -> Result<String, String> {
    let (own, chosen) = own_errors();
    let reference = reference();
    let count = chosen.iter().filter(|chosen| **chosen).count();
    if own[1] > ALLOWED {
        return Err(format!(
            "a determined cell of dam is wrong by {:.1e}",
            own[1]
        ));
    }
    let budget = Duration::from_millis(if quick { 300 } else { 1500 });
    let [one, two] = [timed(1, budget)?, timed(2, budget)?];
    let row = |name: &str, time: f64, ratio: &str, [median, worst]: [f64; 2]| {
        vec![
            name.to_owned(),
            format!("{time:.4}"),
            ratio.to_owned(),
            format!("{median:.1e}"),
            format!("{worst:.1e}"),
        ]
    };
    let whole = [commanded(1, budget)?, commanded(2, budget)?];
    let gain = |[one, two]: [Timing; 2]| format!("{:.2} of one thread", one.median / two.median);
    let mut rows = vec![
        row("`dam` exact, one thread", one.median, "", own),
        row(
            "`dam` exact, two threads",
            two.median,
            &gain([one, two]),
            own,
        ),
        row("`dam map`, one thread", whole[0].median, "", own),
        row("`dam map`, two threads", whole[1].median, &gain(whole), own),
    ];
    let mut peer = |name: &str, time: f64, values: &[f64], aim: &str| {
        let ratio = format!(
            "{:.0}, {:.0}{aim}",
            time / one.median,
            time / whole[0].median
        );
        let errors = errors(values, &reference, &chosen);
        rows.push(row(name, time, &ratio, errors));
    };
    let begin = Instant::now();
    let peaks = (0..CELLS * CELLS)
        .map(|k| diffsol_peer::solve(&cell(k, LOAD), "tsit45", TOLERANCE, 0))
        .map(|solved| solved.map(|solution| solution.delta_max))
        .collect::<Result<Vec<f64>, String>>()?;
    let time = begin.elapsed().as_secs_f64();
    peer("diffsol tsit45 at 1e-8", time, &peaks, " (80)");
    if let Some(cvode) = cvode.filter(|_| !quick) {
        let (time, peaks) = cvode.map("bdf", TOLERANCE, CELLS)?;
        peer("CVODE bdf at 1e-8", time, &peaks, "");
    }
    let head = [
        "solver",
        "s",
        "times slower than the runs, than `dam map` (aim)",
        "median error",
        "greatest error",
    ];
    Ok(format!(
        "## Map\n\n{ABOUT}\n{count} of {} cells are determined.\n\n{}",
        CELLS * CELLS,
        table(&head.map(str::to_owned), &rows)
    ))
}
