//! Cases A … E: `dam` and all solvers, side by side.

use crate::case::{Case, SAMPLES};
use crate::cvode_peer::Cvode;
use crate::exact_peer;
use crate::ladder::{Climb, Point, Reached, climb};
use crate::peer::{OnCase, Peer};
use crate::process;
use crate::solution::Timing;
use crate::table::{milliseconds, power, reached, table};
use dam::exact::Request;
use std::time::Duration;

/// Errors to be reached; the demand on `dam` is stated at the middle one.
const TARGETS: [f64; 3] = [1e-4, 1e-7, 1e-10];

/// The target of the comparison.
const COMPARED: usize = 1;

/// Error that `dam` must not exceed while it is compared.
pub(crate) const EXACT: f64 = 1e-10;

/// What stands above the tables.
const ABOUT: &str = "\
From the model ready to 1000 samples of δ and all switch times (ode_solvers locates no
switches), medians of repeated runs. Errors are the greatest of δ over the samples against
a Taylor series of order 34 in quadruple precision, relative to max|δ|. Every solver has
the loosest tolerance, in half decades from 1e-2 to 3e-13, that reaches the error; the
ratio is its time over `dam`'s: of medians, of least times, and in brackets what is aimed at.
";

/// What `dam` needs for a case.
struct Own {
    error: f64,
    switches: usize,
    plain: Timing,
    /// With all figures and the energy audit.
    full: Timing,
    /// `dam run` as a process, from a file to all figures and the audit.
    process: Timing,
}

/// Runs all cases named in `names` and returns the tables.
///
/// # Errors
/// `dam` refuses a case, or misses its error or a switch.
pub(crate) fn cases(names: &str, cvode: Option<&Cvode>, quick: bool) -> Result<String, String> {
    let mut ratios = Vec::new();
    let mut details = String::new();
    for case in Case::all() {
        if !names.contains(case.name) {
            continue;
        }
        let own = own(&case)?;
        let points = peers(&case, cvode, quick);
        ratios.push(ratio_row(&case, &own, &points));
        details += &detail(&case, &own, &points);
    }
    let head = [
        "case",
        "`dam`, ms",
        "its error",
        "switches",
        "with figures and audit, ms",
        "`dam run`, whole process, ms",
        "fastest other at 1e-7",
        "ms",
        "ratio (aim)",
        "CVODE at 1e-7, ms",
        "ratio (aim)",
    ];
    Ok(format!(
        "## Cases\n\n{ABOUT}\n{}{details}",
        table(&head.map(str::to_owned), &ratios)
    ))
}

/// `dam`'s own figures, checked.
fn own(case: &Case) -> Result<Own, String> {
    let tree = exact_peer::tree(&case.chain);
    let plain = Request::new(case.chain.duration, SAMPLES);
    let full = Request {
        figures: true,
        audit: true,
        ..plain.clone()
    };
    let solution = exact_peer::solve(&case.chain, SAMPLES)?;
    let error = case.error(&solution.samples);
    let switches = solution.switches.unwrap_or_default();
    if error > EXACT || switches != case.switches {
        return Err(format!(
            "case {}: dam has an error of {error:.1e} and {switches} switches of {}",
            case.name, case.switches
        ));
    }
    let balance = exact_peer::run(&tree, &full)?.audit.map(|a| a.error());
    if !balance.is_some_and(|error| error <= EXACT) {
        return Err(format!(
            "case {}: the energy audit is off: {balance:?}",
            case.name
        ));
    }
    let budget = Duration::from_millis(400);
    let time = |request: &Request| Timing::measure(budget, || tree.run(request));
    Ok(Own {
        error,
        switches,
        plain: time(&plain),
        full: time(&full),
        process: process::timing(&case.chain, case.switches)?,
    })
}

/// Every peer with what it reaches. A climb is given up when a single run takes
/// eight times as long as the fastest so far needs for the compared error.
fn peers(case: &Case, cvode: Option<&Cvode>, quick: bool) -> Vec<(Peer, Vec<Reached>)> {
    let budget = Duration::from_millis(if quick { 50 } else { 300 });
    let targets = &TARGETS[..if quick { 2 } else { 3 }];
    let mut done: Vec<(Peer, Vec<Reached>)> = Vec::new();
    for peer in Peer::all(cvode) {
        let first = fastest(&done, |_| true).map_or(f64::INFINITY, |f| f.1.timing.median);
        let longest = (8.0 * first).max(if quick { 0.1 } else { 0.5 });
        let runner = OnCase { peer: &peer, case };
        let points = climb(&runner, targets, Climb { budget, longest });
        done.push((peer, points));
    }
    done
}

/// The fastest point at the compared error among the peers that qualify.
fn fastest(
    points: &[(Peer, Vec<Reached>)],
    qualifies: impl Fn(&Peer) -> bool,
) -> Option<(&Peer, Point)> {
    let reached = points
        .iter()
        .filter(|(peer, _)| qualifies(peer))
        .filter_map(|(peer, points)| Some((peer, points[COMPARED].ok()?)));
    reached.min_by(|a, b| a.1.timing.median.total_cmp(&b.1.timing.median))
}

fn ratio_row(case: &Case, own: &Own, points: &[(Peer, Vec<Reached>)]) -> Vec<String> {
    let ratio = |point: Option<Point>, aim: Option<f64>| {
        let Some(point) = point else {
            return "-".to_owned();
        };
        let ratio = point.timing.median / own.plain.median;
        let aim = aim.map_or(String::new(), |aim| format!(" ({aim})"));
        let least = point.timing.least / own.plain.least;
        format!("{ratio:.0}, {least:.0}{aim}")
    };
    let time = |point: Option<Point>| {
        point.map_or("-".to_owned(), |point| milliseconds(point.timing.median))
    };
    let other = fastest(points, |_| true);
    let cvode = fastest(points, Peer::is_cvode).map(|found| found.1);
    vec![
        case.name.to_string(),
        milliseconds(own.plain.median),
        power(own.error),
        own.switches.to_string(),
        milliseconds(own.full.median),
        milliseconds(own.process.median),
        other.map_or("-".to_owned(), |found| found.0.name()),
        time(other.map(|found| found.1)),
        ratio(other.map(|found| found.1), case.aim[0]),
        time(cvode),
        ratio(cvode, case.aim[1]),
    ]
}

/// The table of one case.
fn detail(case: &Case, own: &Own, points: &[(Peer, Vec<Reached>)]) -> String {
    let head = [
        "solver",
        "error asked",
        "tolerance",
        "error reached",
        "switches",
        "median, ms",
        "least, ms",
        "runs",
    ];
    let own_row = |name: &str, timing: &Timing| {
        vec![
            name.to_owned(),
            String::new(),
            "none".to_owned(),
            power(own.error),
            own.switches.to_string(),
            milliseconds(timing.median),
            milliseconds(timing.least),
            timing.runs.to_string(),
        ]
    };
    let mut rows = vec![
        own_row("`dam` exact", &own.plain),
        own_row("`dam` exact, with figures and audit", &own.full),
        own_row("`dam run`, whole process", &own.process),
    ];
    for (peer, points) in points {
        for (target, point) in TARGETS.iter().zip(points) {
            rows.push(peer_row(peer, *target, point));
        }
    }
    format!(
        "\n### Case {}\n\n{}",
        case.name,
        table(&head.map(str::to_owned), &rows)
    )
}

fn peer_row(peer: &Peer, target: f64, point: &Reached) -> Vec<String> {
    let mut row = vec![peer.name(), power(target)];
    row.extend(reached(point));
    row
}
