//! The cells of a study, worked out side by side.

use super::cell::Cell;
use super::study::Study;
use crate::studies::Control;
use crate::studies::prepared::{Bench, evaluate, is_checked_cell};
use crate::studies::side_by_side::{side_by_side, threads as number_of_threads};
use std::collections::BTreeMap;
use std::ops::Range;
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

/// Result of a study, as far as it is known.
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
/// The listener's.
pub fn map(
    study: &Study<'_>,
    known: BTreeMap<usize, Vec<Cell>>,
    threads: Option<usize>,
    control: &Control<'_>,
    listener: &dyn Listener,
) -> Result<MapResult, String> {
    let work = Work::new(study, known, 0..study.cells(), control, listener);
    work.run_threads(number_of_threads(threads));
    match work.trouble.into_inner() {
        Ok(Some(message)) => Err(message),
        _ => Ok(assemble(study, lock(&work.rows).split_off(&0))),
    }
}

/// Works out some cells of a study, counted over all its panels from 0 on; `None` when
/// interrupted. They are those of the whole map: a map can be shared out.
///
/// # Errors
/// There are no such cells, or the listener's.
pub fn map_cells(
    study: &Study<'_>,
    cells: Range<usize>,
    threads: Option<usize>,
    control: &Control<'_>,
    listener: &dyn Listener,
) -> Result<Option<Vec<Cell>>, String> {
    if cells.is_empty() || cells.end > study.cells() {
        let Range { start, end } = cells;
        let last = study.cells();
        return Err(format!("cells {start}:{end}: there are the cells 0:{last}"));
    }
    let count = cells.len();
    let work = Work::new(study, BTreeMap::new(), cells, control, listener);
    work.run_threads(number_of_threads(threads));
    if let Ok(Some(message)) = work.trouble.into_inner() {
        return Err(message);
    }
    let rows = lock(&work.rows).split_off(&0);
    let found: Vec<Cell> = rows.into_values().flatten().collect();
    Ok((found.len() == count).then_some(found))
}

/// The cells that are to be done. Threads take them one by one, in order, so that
/// none waits for another at the end for longer than a cell takes; rows are
/// finished one after the other.
struct Work<'w> {
    study: &'w Study<'w>,
    control: &'w Control<'w>,
    listener: &'w dyn Listener,
    /// Rows to be done, with their panels and cells, and what is done of them.
    open: Vec<OpenRow>,
    /// For each open row the number of cells of all rows before it.
    starts: Vec<usize>,
    /// Number of cells to be done.
    count: usize,
    rows: Mutex<BTreeMap<usize, Vec<Cell>>>,
    trouble: Mutex<Option<String>>,
    stop: AtomicBool,
}

/// A row that is being worked out.
struct OpenRow {
    row: usize,
    panel: usize,
    cells: Range<usize>,
    /// Cells, as far as they are done, with how many are missing.
    done: Mutex<(Vec<Option<Cell>>, usize)>,
}

impl<'w> Work<'w> {
    fn new(
        study: &'w Study<'w>,
        known: BTreeMap<usize, Vec<Cell>>,
        wanted: Range<usize>,
        control: &'w Control<'w>,
        listener: &'w dyn Listener,
    ) -> Self {
        let mut starts = Vec::new();
        let mut count = 0;
        let missing = (0..study.rows()).filter(|row| !known.contains_key(row));
        // Of each row the cells that are wanted, as far as there are any.
        let within = missing.filter_map(|row| {
            let (panel, cells) = study.row(row);
            let first = panel * study.cells_in_panel();
            let from = cells.start.max(wanted.start.saturating_sub(first));
            let to = cells.end.min(wanted.end.saturating_sub(first));
            (from < to).then_some((row, panel, from..to))
        });
        let open = within.map(|(row, panel, cells)| {
            starts.push(count);
            count += cells.len();
            OpenRow {
                row,
                panel,
                done: Mutex::new((Vec::new(), cells.len())),
                cells,
            }
        });
        let open: Vec<OpenRow> = open.collect();
        Self {
            open,
            starts,
            study,
            control,
            listener,
            count,
            rows: Mutex::new(known),
            trouble: Mutex::new(None),
            stop: AtomicBool::new(false),
        }
    }

    /// All threads take cells; the calling one is the first of them.
    fn run_threads(&self, threads: usize) {
        let worker = || (0, Bench::default());
        side_by_side(self.count, threads, worker, |bench, number| {
            self.take_cell(bench, number)
        });
    }

    /// Works out a cell, by the scene of its panel that the thread has at hand; false where the
    /// map is stopped.
    fn take_cell(&self, (of, bench): &mut (usize, Bench), number: usize) -> bool {
        if self.control.is_spent() || self.stop.load(Relaxed) {
            return false;
        }
        let starts = self.starts.partition_point(|&start| start <= number);
        let at = starts - 1;
        let row = &self.open[at];
        let place = number - self.starts[at];
        let (panel, cell) = (row.panel, row.cells.start + place);
        if *of != panel {
            (*of, *bench) = (panel, Bench::default());
        }
        let (x, y) = self.study.parameters_at_cell(cell);
        let values = [x, y.unwrap_or_default()];
        let values = &values[..1 + usize::from(y.is_some())];
        let asked = (values, is_checked_cell(panel, cell));
        let question = self.study.question(panel);
        let Some(found) = evaluate(question, bench, asked, self.control) else {
            return false;
        };
        self.listener.cell();
        if let Some(cells) = row.store_cell(place, Cell::of(found)) {
            self.finish(row.row, cells);
        }
        true
    }

    fn finish(&self, row: usize, cells: Vec<Cell>) {
        if let Err(message) = self.listener.row(row, &cells) {
            self.stop.store(true, Relaxed);
            *lock(&self.trouble) = Some(message);
        }
        lock(&self.rows).insert(row, cells);
    }
}

impl OpenRow {
    /// Keeps a cell; the whole row with its last one.
    fn store_cell(&self, place: usize, cell: Cell) -> Option<Vec<Cell>> {
        let mut done = lock(&self.done);
        let (cells, missing) = &mut *done;
        if cells.is_empty() {
            cells.resize(self.cells.len(), None);
        }
        cells[place] = Some(cell);
        *missing -= 1;
        let whole = *missing == 0;
        whole.then(|| std::mem::take(cells).into_iter().flatten().collect())
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
    use crate::frontend::scene::{BuiltIn, Document};
    use crate::studies::Control;
    use crate::studies::axis::Axis;
    use crate::studies::map::{Panels, Question, Study};
    use std::collections::BTreeMap;
    use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
    use std::time::{Duration, Instant};

    const TWO_MASSES: &[u8] = include_bytes!("../../../scenarios/rocker/two_masses.json");

    const SOFT_SHOCK: &[u8] = include_bytes!("../../../scenarios/indexing/soft_shock.json");

    fn question(overrides: &[&str]) -> Question {
        Question {
            overrides: overrides.iter().map(|&text| text.to_owned()).collect(),
            x: Axis::parse("rocker.inertia=0.05:1:4").unwrap(),
            y: Some(Axis::parse("rocker.stiffness=0.25e7:5e7:3").unwrap()),
            panels: Panels::default(),
            figure: None,
            check_determined: true,
            digits: 7,
        }
    }

    #[test]
    fn cells_without_end_stop_at_once_when_interrupted() {
        let document = Document::parse("two_masses.json", TWO_MASSES).unwrap();
        let endless = ["run.duration=1e9", "run.max_switches=1000000000"];
        let study = Study::new(&document, &BuiltIn, question(&endless)).unwrap();
        for threads in [1, 2] {
            let told = AtomicBool::new(false);
            let control = Control::interrupted_by(&told);
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
        each_row_alone(&document, question(&["run.duration=0.2"]));
        // A law that is fitted, kept along a row and another one in the next.
        let document = Document::parse("soft_shock.json", SOFT_SHOCK).unwrap();
        let cam = Question {
            x: Axis::parse("lever.stiffness=9e3:2e4:3").unwrap(),
            y: Some(Axis::parse("cam.motion.speed=60:90 rpm:3").unwrap()),
            ..question(&[])
        };
        each_row_alone(&document, cam);
    }

    fn each_row_alone(document: &Document, question: Question) {
        let study = Study::new(document, &BuiltIn, question).unwrap();
        let control = Control::default();
        let all = |known, threads| map(&study, known, Some(threads), &control, &Silent).unwrap();
        let whole = all(BTreeMap::new(), 1);
        assert!(whole.complete);
        assert!(
            whole.panels[0]
                .iter()
                .flatten()
                .all(|cell| cell.value.is_some())
        );
        assert_eq!(all(BTreeMap::new(), 3), whole);
        // One row alone, by a scene that has seen no other.
        for alone in 0..study.rows() {
            let others = (0..study.rows()).filter(|row| *row != alone).map(|row| {
                let (panel, cells) = study.row(row);
                let cells = cells.map(|cell| whole.panels[panel][cell].clone().unwrap());
                (row, cells.collect())
            });
            assert_eq!(all(others.collect(), 1), whole);
        }
    }
}
