//! One scenario: every method's verdict, and the times of the likely ones.

use super::Case;
use dam::integrate::Method;
use dam::studies::methods::{MethodLine, Plan, Point, Study, Verdict, study};
use dam::studies::run::{RunResult, run};
use dam::studies::{Control, RunSettings};
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
/// Time for the repetitions of a scenario's runs at a tolerance (s).
const BUDGET: f64 = 0.6;

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
    /// `None`: it is a combination that no method can be asked for.
    kept: Option<Kept>,
    run: Pair,
    motion: Option<Pair>,
}

/// Whether the method of `auto`, at the tolerance that `auto` gives it, keeps the
/// one asked for.
struct Kept {
    converged: bool,
    verdict: Verdict,
    error: Option<f64>,
}

/// `auto` and the best of the methods that keep the tolerance when given it.
struct Pair {
    auto: f64,
    best: Option<(Method, f64)>,
}

impl Pair {
    fn ratio(&self) -> Option<f64> {
        self.best.map(|(_, seconds)| self.auto / seconds)
    }
}

/// What is known of a scenario before anything is compared.
struct Found {
    study: Study,
    /// What `auto` does at every tolerance of [`ASKED`].
    autos: Vec<RunResult>,
}

/// All lines of a scenario.
pub(crate) fn judge(case: &Case, chart: bool, own: bool) -> Vec<Line> {
    let line = |tolerance: f64, told: Told| Line {
        scenario: case.name.clone(),
        tolerance,
        told,
    };
    let found = match prepare(case, own) {
        Ok(found) => found,
        Err(why) => return vec![line(0.0, Told::Nothing(why))],
    };
    if chart {
        print_chart(&found.study);
    }
    let lines = ASKED.iter().zip(&found.autos).map(|(&tolerance, auto)| {
        let told = at(case, &found.study, tolerance, auto, chart);
        line(tolerance, Told::Judged(told))
    });
    lines.collect()
}

/// The verdicts on all methods.
fn prepare(case: &Case, own: bool) -> Result<Found, String> {
    let said = |faults: Vec<dam::fault::Fault>| faults[0].message.clone();
    let begun = Instant::now();
    let finest = once(case, None, FINEST).map_err(said)?;
    if finest.figures.run.method == "kinematic" {
        return Err("the motion follows from the drives".to_owned());
    }
    let autos = ASKED.iter().map(|&tolerance| once(case, None, tolerance));
    let autos: Vec<RunResult> = autos.collect::<Result<_, _>>().map_err(said)?;
    let mut tolerances: Vec<f64> = ASKED.into_iter().chain([FINEST]).collect();
    tolerances.extend(autos.iter().map(|auto| auto.tolerance));
    tolerances.sort_by(|a, b| b.total_cmp(a));
    tolerances.dedup_by(|a, b| is_same(*a, *b));
    let mut limit = begun.elapsed().mul_f64(HOPELESS) + Duration::from_millis(5);
    loop {
        let plan = Plan {
            methods: methods(own),
            tolerances: tolerances.clone(),
            repeats: 9,
            point_limit: limit.min(LONGEST),
            ..Plan::new(1e-7)
        };
        let control = Control::default();
        let study =
            study(&case.system, &case.settings, &plan, &control, &mut |_| ()).map_err(said)?;
        if study.reference.is_some() {
            return Ok(Found { study, autos });
        }
        if limit > LONGEST {
            return Err("no two methods agree: the motion is not determined".to_owned());
        }
        limit *= 4;
    }
}

/// All that take a tolerance, and exact propagation; those of diffsol, which are
/// slow at fine tolerances, only when wanted.
fn methods(own: bool) -> Vec<Method> {
    let all = dam::studies::methods::all_methods().into_iter();
    let fixed = |method| dam::studies::methods::is_fixed_step(method);
    let foreign = |method| matches!(method, Method::Bdf | Method::TrBdf2 | Method::Esdirk34);
    all.filter(|&method| !(fixed(method) || own && foreign(method)))
        .collect()
}

fn is_same(one: f64, other: f64) -> bool {
    (one / other - 1.0).abs() < 1e-6
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
fn at(case: &Case, found: &Study, tolerance: f64, auto: &RunResult, chart: bool) -> Judged {
    let summary = &auto.figures.run;
    if chart {
        println!("  {tolerance:.0e}: {}: {}", summary.method, summary.why);
    }
    let fit = fit(found, tolerance);
    let least =
        |points: &[(Method, f64)]| points.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1));
    let best = least(&fit);
    let alone = summary.method == auto.method.name();
    let own = found.methods.iter().find(|line| line.method == auto.method);
    let own = own.and_then(|line| point(line, auto.tolerance));
    let own = own.filter(|_| alone);
    let motion = own
        .and_then(|point| point.measured_seconds)
        .map(|auto| Pair { auto, best });
    let fastest = best.map_or(f64::INFINITY, |best| best.1);
    let rivals = fit.iter().filter(|(_, s)| *s <= LIKELY * fastest);
    let rivals: Vec<Method> = rivals.map(|(method, _)| *method).collect();
    let (seconds, of_rivals) = timed(case, &rivals, tolerance);
    let of_rivals: Vec<(Method, f64)> = rivals.into_iter().zip(of_rivals).collect();
    Judged {
        auto: summary.method.clone(),
        kept: own.map(|point| Kept::of(point, found, tolerance)),
        run: Pair {
            auto: seconds,
            best: least(&of_rivals),
        },
        motion,
    }
}

impl Kept {
    /// Of a point that may have been given a finer tolerance.
    fn of(point: &Point, found: &Study, tolerance: f64) -> Self {
        let resolution = found.reference.as_ref().map_or(0.0, |r| r.resolution);
        let ended = matches!(point.verdict, Verdict::Converged | Verdict::Inaccurate);
        let near = |error: f64| error <= tolerance.max(3.0 * resolution);
        let judged = point.verdict == Verdict::NotJudged;
        Self {
            converged: judged || ended && point.error.is_some_and(near),
            verdict: point.verdict,
            error: point.error,
        }
    }
}

/// The methods that keep a tolerance when given it, with the times of their motion (s).
fn fit(found: &Study, tolerance: f64) -> Vec<(Method, f64)> {
    let points = found.methods.iter().filter_map(|line| {
        let point = point(line, tolerance)?;
        let fit = point.verdict == Verdict::Converged;
        Some((line.method, point.measured_seconds.filter(|_| fit)?))
    });
    points.collect()
}

/// A method's point at a tolerance; exact propagation has one for all.
fn point(line: &MethodLine, tolerance: f64) -> Option<&Point> {
    let mut points = line.points.iter();
    points.find(|point| point.tolerance.is_none_or(|own| is_same(own, tolerance)))
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
            if std::hint::black_box(result.is_ok()) {
                *least = least.min(seconds);
            }
        }
        rounds += 1;
    }
    (least[0], least.split_off(1))
}

fn print_chart(found: &Study) {
    for line in &found.methods {
        for point in &line.points {
            println!(
                "    {:9} {:8} {:28} error {:>8}, motion {:>9} ms, {:8} evaluations, {:7} steps",
                line.method.name(),
                point.setting(),
                format!("{:?}", point.verdict),
                told(point.error, |error| format!("{error:.1e}")),
                told(point.measured_seconds, |s| format!("{:.3}", 1e3 * s)),
                point.evaluations.unwrap_or(0),
                point.steps.unwrap_or(0),
            );
        }
    }
}

/// A number in words, or a dash where there is none.
fn told(number: Option<f64>, words: impl Fn(f64) -> String) -> String {
    number.map_or_else(|| "–".to_owned(), words)
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
        let error = match &judged.kept {
            None => "–".to_owned(),
            Some(kept) => match kept.error {
                Some(error) if kept.converged => format!("{error:.0e}"),
                Some(error) => format!("{error:.0e}!"),
                None => kept.verdict.words().to_owned(),
            },
        };
        let pair = |pair: &Pair| {
            let own = 1e3 * pair.auto;
            let Some((best, ratio)) = pair.best.zip(pair.ratio()) else {
                return match markdown {
                    true => format!("{own:.2} | none | –"),
                    false => format!("{own:9.3} {:>9} {:9} {:>5}", "–", "none", "–"),
                };
            };
            let (name, best) = (best.0.name(), 1e3 * best.1);
            match markdown {
                true => format!("{own:.2} | {best:.2} {name} | {ratio:.2}"),
                false => format!("{own:9.3} {best:9.3} {name:9} {ratio:5.2}"),
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
    /// No method keeps the tolerance when given it.
    alone: usize,
}

impl Worst {
    pub(crate) fn add(&mut self, line: &Line) {
        let Told::Judged(judged) = &line.told else {
            return;
        };
        self.judged += 1;
        let kept = judged.kept.as_ref().is_none_or(|kept| kept.converged);
        self.failed += usize::from(!kept);
        self.alone += usize::from(judged.run.best.is_none());
        self.run = self.run.max(judged.run.ratio().unwrap_or(0.0));
        let motion = judged.motion.as_ref().and_then(Pair::ratio);
        self.motion = self.motion.max(motion.unwrap_or(0.0));
    }
}

impl fmt::Display for Worst {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} points; greatest ratio of runs {:.2}, of motions {:.2}; `auto` misses the tolerance \
             at {}; at {} no method keeps it when given it",
            self.judged, self.run, self.motion, self.failed, self.alone
        )
    }
}
