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
