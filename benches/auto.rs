//! Does `method: auto` choose well? Every method on every scenario, over a
//! ladder of tolerances: time, evaluations and error of δ relative to max|δ|.
//!
//! `cargo bench --bench auto [-- PART_OF_NAME] [--chart]`: for tolerances 1e-4,
//! 1e-7 and 1e-10 the time of the method that `auto` picks, over the time of
//! the fastest run of any method that is as accurate as asked (or as what `auto`
//! gave, if that is worse), and in the end the greatest of these ratios. `--chart`
//! prints every run as well.
//!
//! Scenes that are propagated exactly take no steps and are told only. A method is
//! given up on a scene where a run takes longer than half a second, or twenty times
//! as long as another's at the same tolerance.
//!
//! Timed are runs with 1000 samples of δ and all switch times, without figures.

#![allow(clippy::print_stdout)] // the table is what it is run for

use dam::analysis::run::run;
use dam::analysis::{Control, RunSettings};
use dam::integrate::{Limits, Method, Modes, Settings, Sink, Stop, SwitchEvent, integrate};
use dam::lower::lower;
use dam::polynomial::Step;
use dam::scene::{BuiltIn, Document, Overrides};
use dam::system::System;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Samples of δ in a run.
const SAMPLES: usize = 1000;
/// Tolerances at which `auto` is judged.
const ASKED: [f64; 3] = [1e-4, 1e-7, 1e-10];
/// Methods that are compared, the likely ones first.
const METHODS: [Method; 8] = [
    Method::Radau,
    Method::Taylor,
    Method::Rodas5p,
    Method::Dop853,
    Method::Dopri5,
    Method::Bdf,
    Method::Esdirk34,
    Method::TrBdf2,
];
/// Longest run that is looked at.
const LONGEST: Duration = Duration::from_millis(500);
/// Longest search for the finest solution.
const FINEST: Duration = Duration::from_secs(5);
/// A method that is so many times slower than the fastest is given up.
const HOPELESS: f64 = 20.0;
/// Time for the repetitions of a run.
const BUDGET: Duration = Duration::from_millis(40);

/// Samples of δ of every elastic object, and the times of the switches.
struct Samples {
    coordinates: Vec<usize>,
    duration: f64,
    next: usize,
    values: Vec<Vec<f64>>,
    switches: Vec<f64>,
}

impl Samples {
    fn new(system: &System, duration: f64) -> Self {
        let objects = 0..system.model().objects.len();
        let elastic = objects.filter(|&object| system.first_coordinate(object).is_some());
        let coordinates: Vec<usize> = elastic
            .filter_map(|object| system.last_coordinate(object))
            .collect();
        Self {
            values: vec![Vec::with_capacity(SAMPLES + 1); coordinates.len()],
            coordinates,
            duration,
            next: 0,
            switches: Vec::new(),
        }
    }

    fn time(&self) -> f64 {
        self.duration * self.next as f64 / SAMPLES as f64
    }

    /// Greatest difference of the switch times (s).
    fn late(&self, exact: &Self) -> f64 {
        if self.switches.len() != exact.switches.len() {
            return f64::INFINITY;
        }
        let pairs = self.switches.iter().zip(&exact.switches);
        pairs.fold(0.0, |a, (x, y)| a.max((x - y).abs()))
    }

    /// Greatest difference of a δ, relative to its greatest value in `exact`.
    fn error(&self, exact: &Self) -> f64 {
        let objects = self.values.iter().zip(&exact.values);
        let errors = objects.map(|(values, exact)| {
            if values.len() != exact.len() {
                return f64::INFINITY;
            }
            let size = exact.iter().fold(0.0f64, |a, b| a.max(b.abs()));
            let pairs = values.iter().zip(exact);
            let error = pairs.fold(0.0f64, |a, (x, y)| a.max((x - y).abs()));
            if size > 0.0 { error / size } else { error }
        });
        errors.fold(0.0, f64::max)
    }
}

impl Sink for Samples {
    fn start(&mut self, _: f64, y: &[f64], _: &Modes) {
        for (values, &coordinate) in self.values.iter_mut().zip(&self.coordinates) {
            values.push(y[coordinate]);
        }
        self.next = 1;
    }

    fn step(&mut self, step: &Step<'_>, _: &Modes) {
        let end = step.end_time() * (1.0 + 1e-14);
        while self.next <= SAMPLES && self.time() <= end {
            let s = ((self.time() - step.start) / step.length).min(step.end);
            for (values, &coordinate) in self.values.iter_mut().zip(&self.coordinates) {
                values.push(step.value(coordinate, s).0);
            }
            self.next += 1;
        }
    }

    fn switch(&mut self, event: &SwitchEvent<'_>) {
        if event.watch.is_some() {
            self.switches.push(event.time);
        }
    }
}

/// A scenario made ready.
struct Case {
    name: String,
    system: System,
    settings: RunSettings,
}

/// One run.
#[derive(Clone, Copy)]
struct Point {
    method: Method,
    tolerance: f64,
    time: f64,
    error: f64,
    /// Greatest difference of a switch time (s); infinite when their number differs.
    late: f64,
    evaluations: u64,
    steps: u64,
}

impl Case {
    fn load(path: &Path, root: &Path) -> Option<Self> {
        let bytes = std::fs::read(path).ok()?;
        let document = Document::parse(&path.display().to_string(), &bytes).ok()?;
        let scene = document.scene(&BuiltIn, &Overrides::none()).ok()?.scene;
        let system = System::new(lower(&scene).ok()?).ok()?;
        let settings = RunSettings::of(&scene).ok()?;
        let name = path.strip_prefix(root).ok()?.with_extension("");
        let elastic = Samples::new(&system, 1.0).coordinates.len();
        (elastic > 0).then(|| Self {
            name: name.display().to_string(),
            system,
            settings,
        })
    }

    fn once(
        &self,
        method: Method,
        tolerance: f64,
        longest: Duration,
    ) -> Option<(Samples, f64, u64, u64)> {
        let start = self.system.initial_state().ok()?;
        let duration = self.settings.duration;
        let mut samples = Samples::new(&self.system, duration);
        let plan = Settings {
            method,
            tolerance,
            step: None,
        };
        let limits = Limits {
            switches: 1_000_000,
            steps: 100_000_000,
            wall_clock: Some(longest),
            interrupt: None,
        };
        let begin = Instant::now();
        let (y, modes) = (&start.y, &start.modes);
        let outcome = integrate(
            &self.system,
            0.0,
            duration,
            y,
            modes,
            &plan,
            &limits,
            &mut samples,
        );
        let time = begin.elapsed().as_secs_f64();
        let counts = outcome.statistics;
        let whole = matches!(outcome.stop, Stop::Complete | Stop::Physical(_));
        whole.then_some((samples, time, counts.evaluations, counts.steps))
    }

    /// The least time of several runs, against the finest.
    fn point(&self, method: Method, tolerance: f64, exact: &Samples) -> Option<Point> {
        let (samples, mut time, evaluations, steps) = self.once(method, tolerance, LONGEST)?;
        let (begin, before) = (Instant::now(), processor_time());
        let mut runs = 0;
        while begin.elapsed() < BUDGET && runs < 50 {
            time = time.min(self.once(method, tolerance, LONGEST)?.1);
            runs += 1;
        }
        // On a busy machine the clock also counts the work of others.
        // Its own count moves in steps of some milliseconds.
        let spent = processor_time()
            .zip(before)
            .map(|(after, before)| after - before);
        if let Some(spent) = spent.filter(|&spent| spent > 0.06) {
            time = time.min(spent / f64::from(runs.max(1)));
        }
        let late = samples.late(exact);
        Some(Point {
            method,
            tolerance,
            time,
            error: samples.error(exact),
            late,
            evaluations,
            steps,
        })
    }

    /// The method that `auto` picks.
    fn chosen(&self, tolerance: f64) -> Option<Method> {
        let settings = RunSettings {
            method: None,
            tolerance,
            samples: 10,
            ..self.settings.clone()
        };
        run(&self.system, &settings, &Control::default(), &mut [])
            .ok()
            .map(|result| result.method)
    }
}

/// Processor time of this thread (s), where the system tells.
fn processor_time() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: f64 = text.split_whitespace().next()?.parse().ok()?;
    Some(1e-9 * nanoseconds)
}

fn scenarios(folder: &Path, out: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else {
        return;
    };
    for entry in entries.flatten() {
        let path = entry.path();
        if path.is_dir() {
            scenarios(&path, out);
        } else if path
            .extension()
            .is_some_and(|extension| extension == "json")
        {
            out.push(path);
        }
    }
    out.sort();
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let chart = arguments.iter().any(|argument| argument == "--chart");
    let part = arguments
        .iter()
        .find(|argument| !argument.starts_with("--"));
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios");
    let mut paths = Vec::new();
    scenarios(&root, &mut paths);
    let mut worst = 1.0f64;
    for path in paths {
        let Some(case) = Case::load(&path, &root) else {
            continue;
        };
        if part.is_none_or(|part| case.name.contains(part.as_str())) {
            worst = worst.max(judge(&case, chart));
        }
    }
    println!("greatest ratio: {worst:.2}");
}

/// The lines of one scenario; returns the greatest ratio.
fn judge(case: &Case, chart: bool) -> f64 {
    let chosen = ASKED.map(|asked| case.chosen(asked));
    if chosen.iter().all(|method| *method == Some(Method::Exact)) {
        println!("{:32} auto exact, which takes no steps", case.name);
        return 1.0;
    }
    let finest = [
        (Method::Radau, 1e-12),
        (Method::Dop853, 1e-12),
        (Method::Rodas5p, 1e-11),
    ];
    let exact = finest
        .iter()
        .find_map(|&(method, tolerance)| case.once(method, tolerance, FINEST));
    let Some((exact, ..)) = exact else {
        println!(
            "{:32} skipped: no fine solution within {FINEST:?}",
            case.name
        );
        return 1.0;
    };
    let points = case.points(&exact, chart);
    let mut worst = 1.0f64;
    for (asked, method) in ASKED.into_iter().zip(chosen) {
        let Some(method) = method else { continue };
        let of_auto =
            |point: &&Point| point.method == method && (point.tolerance / asked - 1.0).abs() < 1e-6;
        let Some(auto) = points.iter().find(of_auto) else {
            println!("{:32} {asked:.0e}: {method} takes too long", case.name);
            continue;
        };
        let bound = asked.max(auto.error);
        let best = points
            .iter()
            .filter(|point| point.error <= bound)
            .min_by(|a, b| a.time.total_cmp(&b.time));
        let best = best.unwrap_or(auto);
        let ratio = auto.time / best.time;
        worst = worst.max(ratio);
        println!(
            "{:32} {asked:.0e}: auto {:9} {:9.3} ms, error {:7.1e}; best {:9} at {:.0e} {:9.3} ms; ratio {ratio:.2}",
            case.name,
            method.name(),
            1e3 * auto.time,
            auto.error,
            best.method.name(),
            best.tolerance,
            1e3 * best.time,
        );
    }
    worst
}

impl Case {
    /// Every method over the ladder of tolerances.
    fn points(&self, exact: &Samples, chart: bool) -> Vec<Point> {
        let mut points: Vec<Point> = Vec::new();
        let mut fastest = [f64::INFINITY; 13];
        for method in METHODS {
            for power in 2..fastest.len() {
                let tolerance = 10f64.powi(-(power as i32));
                let Some(point) = self.point(method, tolerance, exact) else {
                    break;
                };
                if chart {
                    print_point(&point);
                }
                points.push(point);
                if point.time > HOPELESS * fastest[power] {
                    break;
                }
                fastest[power] = fastest[power].min(point.time);
            }
        }
        points
    }
}

fn print_point(point: &Point) {
    println!(
        "    {:9} {:.0e}: error {:8.1e}, {:9.3} ms, {:8} evaluations, {:7} steps, switches {:.1e} s",
        point.method.name(),
        point.tolerance,
        point.error,
        1e3 * point.time,
        point.evaluations,
        point.steps,
        point.late
    );
}
