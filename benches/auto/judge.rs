//! One scenario: every method's verdict, and the times of the likely ones.

use super::Case;
use dam::analysis::methods::{MethodLine, Plan, Point, Study, Verdict, study};
use dam::analysis::run::{RunResult, run};
use dam::analysis::{Control, RunSettings};
use dam::integrate::Method;
use std::fmt;
use std::time::{Duration, Instant};

/// Tolerances at which `auto` is judged; a finer one is for the reference.
const ASKED: [f64; 3] = [1e-4, 1e-7, 1e-10];
const FINEST: f64 = 1e-12;
/// A method that takes so many times as long as `auto` is given up.
const HOPELESS: f64 = 4.0;
/// Longest run that is looked at.
const LONGEST: Duration = Duration::from_secs(4);
/// A method whose motion takes this share more than the fastest one's is not timed again.
const LIKELY: f64 = 1.6;
/// A tolerance bounds the error of a step; an error of δ that grows beyond it by
/// more than this over the run is a failure.
const FAIR: f64 = 100.0;
/// Time for the repetitions of a scenario's runs at a tolerance (s).
const BUDGET: f64 = 0.25;

/// What is told of a scenario at a tolerance.
pub(crate) struct Line {
    scenario: String,
    tolerance: f64,
    told: Told,
}

enum Told {
    Judged(Judged),
    /// There is nothing to compare, and why.
    Nothing(String),
}

struct Judged {
    /// What `auto` took.
    auto: String,
    verdict: Verdict,
    error: Option<f64>,
    run: Pair,
    motion: Option<Pair>,
}

/// `auto` and the best method.
struct Pair {
    auto: f64,
    best: (Method, f64),
}

impl Pair {
    fn ratio(&self) -> f64 {
        self.auto / self.best.1
    }
}

/// All lines of a scenario.
pub(crate) fn judge(case: &Case, chart: bool) -> Vec<Line> {
    let line = |tolerance: f64, told: Told| Line {
        scenario: case.name.clone(),
        tolerance,
        told,
    };
    let found = match prepare(case) {
        Ok(found) => found,
        Err(why) => return vec![line(0.0, Told::Nothing(why))],
    };
    if chart {
        print_chart(&found);
    }
    let lines = ASKED.iter().map(|&tolerance| {
        let told = at(case, &found, tolerance, chart).unwrap_or_else(Told::Nothing);
        line(tolerance, told)
    });
    lines.collect()
}

/// The verdicts on all methods.
fn prepare(case: &Case) -> Result<Study, String> {
    let said = |faults: Vec<dam::fault::Fault>| faults[0].message.clone();
    let begun = Instant::now();
    let finest = once(case, None, FINEST).map_err(said)?;
    if finest.figures.run.method == "kinematic" {
        return Err("the motion follows from the drives".to_owned());
    }
    let mut limit = begun.elapsed().mul_f64(HOPELESS) + Duration::from_millis(5);
    loop {
        let plan = Plan {
            methods: methods(),
            tolerances: ASKED.into_iter().chain([FINEST]).collect(),
            repeats: 5,
            point_limit: limit.min(LONGEST),
            ..Plan::new(1e-7)
        };
        let control = Control::default();
        let found =
            study(&case.system, &case.settings, &plan, &control, &mut |_| ()).map_err(said)?;
        if found.reference.is_some() {
            return Ok(found);
        }
        if limit > LONGEST {
            return Err("no two methods agree: the motion is not determined".to_owned());
        }
        limit *= 4;
    }
}

/// All that take a tolerance, and exact propagation.
fn methods() -> Vec<Method> {
    let all = dam::analysis::methods::all_methods().into_iter();
    all.filter(|&method| !dam::analysis::methods::is_fixed_step(method))
        .collect()
}

fn once(
    case: &Case,
    method: Option<Method>,
    tolerance: f64,
) -> Result<RunResult, Vec<dam::fault::Fault>> {
    let settings = RunSettings {
        method,
        tolerance,
        ..case.settings.clone()
    };
    run(&case.system, &settings, &Control::default(), &mut [])
}

/// One tolerance.
fn at(case: &Case, found: &Study, tolerance: f64, chart: bool) -> Result<Told, String> {
    let auto = once(case, None, tolerance).map_err(|faults| faults[0].message.clone())?;
    let summary = &auto.figures.run;
    if chart {
        println!("  {tolerance:.0e}: {}: {}", summary.method, summary.why);
    }
    let fit = fit(found, tolerance);
    let least =
        |points: &[(Method, f64)]| points.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1));
    let best = least(&fit).ok_or("no method keeps it")?;
    let alone = summary.method == auto.method.name();
    let own = found.methods.iter().find(|line| line.method == auto.method);
    let own = own.and_then(|line| point(line, tolerance));
    let motion = own
        .filter(|_| alone)
        .and_then(|point| point.measured_seconds)
        .map(|auto| Pair { auto, best });
    let mut rivals: Vec<Method> = fit
        .iter()
        .filter(|(_, seconds)| *seconds <= LIKELY * best.1)
        .map(|(method, _)| *method)
        .collect();
    if !rivals.contains(&auto.method) && alone {
        rivals.push(auto.method);
    }
    let (seconds, of_rivals) = timed(case, &rivals, tolerance);
    let of_rivals: Vec<(Method, f64)> = rivals.into_iter().zip(of_rivals).collect();
    // A method that fails is no rival; as `auto`'s own it was only timed.
    let of_rivals: Vec<(Method, f64)> = of_rivals
        .into_iter()
        .filter(|(method, _)| fit.iter().any(|(other, _)| other == method))
        .collect();
    let verdict = match (alone, own) {
        (true, Some(point)) => point.verdict,
        _ => Verdict::NotJudged,
    };
    Ok(Told::Judged(Judged {
        auto: summary.method.clone(),
        verdict,
        error: own.filter(|_| alone).and_then(|point| point.error),
        run: Pair {
            auto: seconds,
            best: least(&of_rivals).ok_or("no method keeps it")?,
        },
        motion,
    }))
}

/// True unless a run with this verdict and error has failed.
fn fair(verdict: Verdict, error: Option<f64>, tolerance: f64) -> bool {
    match verdict {
        Verdict::Converged => true,
        Verdict::Inaccurate => error.is_some_and(|error| error <= FAIR * tolerance),
        _ => false,
    }
}

/// The methods that did not fail at a tolerance, with the times of their motion (s).
fn fit(found: &Study, tolerance: f64) -> Vec<(Method, f64)> {
    let points = found.methods.iter().filter_map(|line| {
        let point = point(line, tolerance)?;
        let fit = fair(point.verdict, point.error, tolerance);
        Some((line.method, point.measured_seconds.filter(|_| fit)?))
    });
    points.collect()
}

/// A method's point at a tolerance; exact propagation has one for all.
fn point(line: &MethodLine, tolerance: f64) -> Option<&Point> {
    let mut points = line.points.iter();
    points.find(|point| {
        point
            .tolerance
            .is_none_or(|own| (own / tolerance - 1.0).abs() < 1e-6)
    })
}

/// The least times of `auto` and its rivals, which take turns (s).
fn timed(case: &Case, rivals: &[Method], tolerance: f64) -> (f64, Vec<f64>) {
    let contenders: Vec<Option<Method>> = std::iter::once(None)
        .chain(rivals.iter().copied().map(Some))
        .collect();
    let mut least = vec![f64::INFINITY; contenders.len()];
    let begun = Instant::now();
    let mut rounds = 0;
    while rounds < 3 || (rounds < 200 && begun.elapsed().as_secs_f64() < BUDGET) {
        for (method, least) in contenders.iter().zip(&mut least) {
            let begun = Instant::now();
            let result = once(case, *method, tolerance);
            let seconds = begun.elapsed().as_secs_f64();
            std::hint::black_box(result.is_ok());
            *least = least.min(seconds);
        }
        rounds += 1;
    }
    (least[0], least.split_off(1))
}

fn print_chart(found: &Study) {
    for line in &found.methods {
        for point in &line.points {
            println!(
                "    {:9} {:8} {:28} error {:8.1e}, motion {:9.3} ms, {:8} evaluations, {:7} steps",
                line.method.name(),
                point.setting(),
                format!("{:?}", point.verdict),
                point.error.unwrap_or(f64::NAN),
                1e3 * point.measured_seconds.unwrap_or(f64::NAN),
                point.evaluations.unwrap_or(0),
                point.steps.unwrap_or(0),
            );
        }
    }
}

impl Line {
    /// The heading of the table.
    pub(crate) fn head(markdown: bool) -> String {
        if markdown {
            return "| scenario | tolerance | `auto` | error | run (ms) | best | ratio | motion (ms) | best | ratio |\n\
                    |---|---|---|---|---:|---|---:|---:|---|---:|"
                .to_owned();
        }
        format!(
            "{:34} {:>9} {:17} {:>7} {:>9} {:>9} {:9} {:>5} {:>9} {:>9} {:9} {:>5}",
            "scenario",
            "tolerance",
            "auto",
            "error",
            "run ms",
            "best",
            "",
            "ratio",
            "motion ms",
            "best",
            "",
            "ratio"
        )
    }

    /// The line itself.
    pub(crate) fn text(&self, markdown: bool) -> String {
        let judged = match &self.told {
            Told::Nothing(why) if markdown => {
                return format!("| {} | | {why} | | | | | | | |", self.scenario);
            }
            Told::Nothing(why) => return format!("{:34} {why}", self.scenario),
            Told::Judged(judged) => judged,
        };
        let error = match (judged.error, judged.verdict) {
            (Some(error), verdict) if fair(verdict, Some(error), self.tolerance) => {
                format!("{error:.0e}")
            }
            (None, Verdict::Converged | Verdict::NotJudged) => "–".to_owned(),
            (_, verdict) => verdict.words().to_owned(),
        };
        let pair = |pair: &Pair| {
            let (method, seconds) = pair.best;
            let [own, best] = [1e3 * pair.auto, 1e3 * seconds];
            match markdown {
                true => format!("{own:.2} | {best:.2} {method} | {:.2}", pair.ratio()),
                false => format!(
                    "{own:9.3} {best:9.3} {:9} {:5.2}",
                    method.name(),
                    pair.ratio()
                ),
            }
        };
        let run = pair(&judged.run);
        let motion = judged.motion.as_ref().map(pair);
        let (name, asked, auto) = (&self.scenario, self.tolerance, &judged.auto);
        match markdown {
            true => {
                let motion = motion.unwrap_or_else(|| "– | – | –".to_owned());
                format!("| {name} | {asked:.0e} | {auto} | {error} | {run} | {motion} |")
            }
            false => {
                let motion = motion.unwrap_or_default();
                format!("{name:34} {asked:9.0e} {auto:17} {error:>7} {run} {motion}")
            }
        }
    }
}

/// The greatest ratios, and what went wrong.
#[derive(Default)]
pub(crate) struct Worst {
    run: f64,
    motion: f64,
    judged: usize,
    failed: usize,
}

impl Worst {
    pub(crate) fn add(&mut self, line: &Line) {
        let Told::Judged(judged) = &line.told else {
            return;
        };
        self.judged += 1;
        let fair = fair(judged.verdict, judged.error, line.tolerance);
        self.failed += usize::from(!fair && judged.verdict != Verdict::NotJudged);
        self.run = self.run.max(judged.run.ratio());
        let motion = judged.motion.as_ref().map_or(0.0, Pair::ratio);
        self.motion = self.motion.max(motion);
    }
}

impl fmt::Display for Worst {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} points; greatest ratio of runs {:.2}, of motions {:.2}; `auto` failed at {}",
            self.judged, self.run, self.motion, self.failed
        )
    }
}
