//! The cells of a study, worked out side by side.

use super::cell::{Cell, evaluate};
use super::scenes::Scenes;
use super::study::Study;
use crate::analysis::Control;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::sync::Mutex;
use std::sync::atomic::AtomicBool;
use std::sync::atomic::Ordering::Relaxed;

/// Listens to a map while it is worked out; called from any thread.
pub trait Listener: Sync {
    /// A cell is done.
    fn cell(&self) {}

    /// A row is done: all its cells, in order. Rows come in any order.
    ///
    /// # Errors
    /// Why the map cannot go on (a full disk).
    fn row(&self, _row: usize, _cells: &[Cell]) -> Result<(), String> {
        Ok(())
    }
}

/// Listens to nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Listener for Silent {}

/// What is known of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct MapResult {
    /// Cells of every panel; `None` where an interrupt came first.
    pub panels: Vec<Vec<Option<Cell>>>,
    /// True when every cell is known.
    pub complete: bool,
}

/// Works out a study on `threads` threads (`None`: one for every processor
/// core). Rows that are `known` already are taken over and not announced.
///
/// An interrupt ends the map after the cells at hand, with the rows done so far.
///
/// # Errors
/// The threads cannot be started, or the listener's.
pub fn map(
    study: &Study<'_>,
    known: BTreeMap<usize, Vec<Cell>>,
    threads: Option<usize>,
    control: &Control<'_>,
    listener: &dyn Listener,
) -> Result<MapResult, String> {
    let open: Vec<usize> = (0..study.rows())
        .filter(|row| !known.contains_key(row))
        .collect();
    let rows = Mutex::new(known);
    let trouble = Mutex::new(None);
    let stop = AtomicBool::new(false);
    let scenes = Scenes::new(study);
    let work = |&row: &usize| {
        let one = |panel, cell| {
            let interrupted = control.interrupt.is_some_and(|flag| flag.load(Relaxed));
            if interrupted || stop.load(Relaxed) {
                return None;
            }
            let found = evaluate(study, &scenes, (panel, cell), control)?;
            listener.cell();
            Some(found)
        };
        let (panel, cells) = study.row(row);
        let cells = match threads {
            Some(1) => cells.map(|cell| one(panel, cell)).collect(),
            // Cells of a row are shared out too: the last rows are then done by
            // all threads together.
            _ => cells
                .into_par_iter()
                .map(|cell| one(panel, cell))
                .collect::<Option<Vec<Cell>>>(),
        };
        let Some(cells) = cells else {
            return;
        };
        if let Err(message) = listener.row(row, &cells) {
            stop.store(true, Relaxed);
            *lock(&trouble) = Some(message);
        }
        lock(&rows).insert(row, cells);
    };
    if threads == Some(1) {
        open.iter().for_each(work);
    } else {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads.unwrap_or(0))
            .build()
            .map_err(|error| format!("cannot start the threads of the map: {error}"))?;
        pool.install(|| open.par_iter().with_max_len(1).for_each(work));
    }
    match trouble.into_inner() {
        Ok(Some(message)) => Err(message),
        _ => Ok(assemble(study, lock(&rows).split_off(&0))),
    }
}

/// A lock that a panic elsewhere does not take away: the data are whole rows.
fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex
        .lock()
        .unwrap_or_else(std::sync::PoisonError::into_inner)
}

fn assemble(study: &Study<'_>, mut rows: BTreeMap<usize, Vec<Cell>>) -> MapResult {
    let complete = rows.len() == study.rows();
    let panels = study.panels.panels.iter().enumerate().map(|(panel, _)| {
        let first = panel * study.rows_in_panel();
        let mut cells = Vec::with_capacity(study.cells_in_panel());
        for row in first..first + study.rows_in_panel() {
            let wanted = study.row(row).1.len();
            match rows.remove(&row) {
                Some(row) => cells.extend(row.into_iter().map(Some)),
                None => cells.resize(cells.len() + wanted, None),
            }
        }
        cells
    });
    MapResult {
        panels: panels.collect(),
        complete,
    }
}

#[cfg(test)]
mod tests {
    use super::{Silent, map};
    use crate::analysis::Control;
    use crate::analysis::axis::Axis;
    use crate::analysis::map::{Panels, Question, Study};
    use crate::scene::{BuiltIn, Document};
    use std::collections::BTreeMap;
    use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
    use std::time::{Duration, Instant};

    const TWO_MASSES: &[u8] = include_bytes!("../../../scenarios/rocker/two_masses.json");

    fn question(overrides: &[&str]) -> Question {
        Question {
            overrides: overrides.iter().map(|&text| text.to_owned()).collect(),
            x: Axis::parse("rocker.inertia=0.05:1:4").unwrap(),
            y: Some(Axis::parse("rocker.stiffness=0.25e7:5e7:3").unwrap()),
            panels: Panels::default(),
            figure: None,
            check_determined: true,
        }
    }

    #[test]
    fn cells_without_end_stop_at_once_when_interrupted() {
        let document = Document::parse("two_masses.json", TWO_MASSES).unwrap();
        let endless = ["run.duration=1e9", "run.max_switches=1000000000"];
        let study = Study::new(&document, &BuiltIn, question(&endless)).unwrap();
        for threads in [1, 2] {
            let told = AtomicBool::new(false);
            let control = Control {
                interrupt: Some(&told),
                ..Control::default()
            };
            let begun = Instant::now();
            let found = std::thread::scope(|scope| {
                scope.spawn(|| {
                    std::thread::sleep(Duration::from_millis(50));
                    told.store(true, Relaxed);
                });
                map(&study, BTreeMap::new(), Some(threads), &control, &Silent).unwrap()
            });
            assert!(!found.complete && found.panels[0].iter().all(Option::is_none));
            // It would take hours; a second is for machines with other work.
            assert!(
                begun.elapsed() < Duration::from_secs(5),
                "{:?}",
                begun.elapsed()
            );
        }
    }

    #[test]
    fn cells_do_not_depend_on_who_worked_out_the_one_before() {
        let document = Document::parse("two_masses.json", TWO_MASSES).unwrap();
        let study = Study::new(&document, &BuiltIn, question(&["run.duration=0.2"])).unwrap();
        let control = Control::default();
        let all = |known, threads| map(&study, known, Some(threads), &control, &Silent).unwrap();
        let whole = all(BTreeMap::new(), 1);
        assert!(whole.complete);
        assert_eq!(all(BTreeMap::new(), 3), whole);
        // The last row alone, by a scene that has seen no other.
        let known = (0..study.rows() - 1).map(|row| {
            let (panel, cells) = study.row(row);
            let cells = cells.map(|cell| whole.panels[panel][cell].clone().unwrap());
            (row, cells.collect())
        });
        assert_eq!(all(known.collect(), 1), whole);
    }
}
