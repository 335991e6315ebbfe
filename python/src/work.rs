//! Computing without the interpreter: a question is worked out on a thread of its own
//! while the calling one, without the interpreter's lock, waits for it, hears signals and
//! tells how far it is. A run is often shorter than threads take to tell one another, and
//! goes on the calling thread, which listens whenever the run looks whether it may go on.
//!
//! The calling thread looks at signals and progress every 20 ms, and ends a computation by its
//! budget. One that does not end in time is abandoned; its question is its own. A run on the
//! calling thread is heard as often (`budget::Listener`). A run copies nothing of the scene,
//! and results and columns are made when they are read. A forked process starts a thread anew.
//! Panics become `dam.InternalError`.

use crate::fault;
use dam::budget::{Budget, Listener};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::any::Any;
use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::ThreadId;
use std::time::{Duration, Instant};

/// Time between two looks at signals and progress.
const LOOK: Duration = Duration::from_millis(20);

/// How long a computation that is to end may take to do so; after that it is left to
/// itself.
const GRACE: Duration = Duration::from_millis(40);

/// Stack of the thread that computes: as much as a program's first thread has.
const STACK: usize = 8 << 20;

/// Who is told how far a computation is, and how long it may take: `(progress, seconds)`.
#[derive(Debug, Default)]
pub(crate) struct Terms {
    progress: Option<Py<PyAny>>,
    limit: Option<Duration>,
}

impl<'py> FromPyObject<'_, 'py> for Terms {
    type Error = PyErr;

    fn extract(terms: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        let (progress, seconds): (Option<Py<PyAny>>, Option<f64>) = terms.extract()?;
        let limit = seconds.map(|seconds| {
            let limit = Duration::try_from_secs_f64(seconds).ok();
            limit
                .filter(|limit| !limit.is_zero())
                .ok_or_else(|| PyValueError::new_err("time_limit is a positive number of seconds"))
        });
        Ok(Self {
            progress,
            limit: limit.transpose()?,
        })
    }
}

/// How far a computation is, whether it is to end, and what a Python function that it
/// calls has raised.
#[derive(Debug, Default)]
pub(crate) struct Watch {
    stop: AtomicBool,
    share: AtomicU64,
    raised: Mutex<Option<PyErr>>,
    /// The time that there is.
    time: Budget<'static>,
    /// Of what is computed on the calling thread.
    ear: Option<Ear>,
}

/// What the calling thread hears while it computes.
#[derive(Debug)]
struct Ear {
    thread: ThreadId,
    progress: Option<Py<PyAny>>,
    /// When it last listened, and the share that it told then.
    last: Mutex<(Instant, f64)>,
}

impl Listener for Watch {
    fn listen(&self) {
        let Some(ear) = &self.ear else {
            return;
        };
        if ear.thread != std::thread::current().id() {
            return;
        }
        let told = {
            let mut last = ear.last.lock().unwrap_or_else(PoisonError::into_inner);
            if last.0.elapsed() < LOOK {
                return;
            }
            let share = self.share();
            let before = std::mem::replace(&mut *last, (Instant::now(), share));
            (share > before.1).then_some(share)
        };
        let heard = Python::attach(|py| hear(py, ear.progress.as_ref(), told));
        if let Err(error) = heard {
            self.raise(error);
        }
    }
}

/// Hears signals, and tells a share that is done.
fn hear(py: Python<'_>, progress: Option<&Py<PyAny>>, share: Option<f64>) -> PyResult<()> {
    py.check_signals()?;
    if let (Some(progress), Some(share)) = (progress, share) {
        progress.call1(py, (share,))?;
    }
    Ok(())
}

impl Watch {
    /// Of a computation that may take so long.
    fn within(limit: Option<Duration>) -> Self {
        Self {
            time: limit.map_or(Budget::FREE, |limit| Budget::FREE.within(limit)),
            ..Self::default()
        }
    }

    /// Of a computation on this thread.
    fn here(py: Python<'_>, terms: &Terms) -> Self {
        let ear = Ear {
            thread: std::thread::current().id(),
            progress: terms
                .progress
                .as_ref()
                .map(|progress| progress.clone_ref(py)),
            last: Mutex::new((Instant::now(), 0.0)),
        };
        Self {
            ear: Some(ear),
            ..Self::within(terms.limit)
        }
    }

    /// The budget that ends with it.
    pub(crate) fn budget(&self) -> Budget<'_> {
        self.time.or_interrupted_by(&self.stop).with_listener(self)
    }

    /// Says which share is done.
    pub(crate) fn at(&self, share: f64) {
        self.share.store(share.to_bits(), Ordering::Relaxed);
    }

    fn share(&self) -> f64 {
        f64::from_bits(self.share.load(Ordering::Relaxed))
    }

    pub(crate) fn end(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }

    /// A Python function has raised: the computation ends. The first exception stays.
    pub(crate) fn raise(&self, error: PyErr) {
        let mut raised = self.raised.lock().unwrap_or_else(PoisonError::into_inner);
        raised.get_or_insert(error);
        self.end();
    }

    /// What a question that has no answer is told as.
    fn error(&self, py: Python<'_>, error: &dam::Error) -> PyErr {
        match self.time.spent() {
            Some(spent) => fault::time_is_over(py, &spent.to_string()),
            None => fault::scene_error(py, error),
        }
    }

    fn raised(&self) -> Option<PyErr> {
        let mut raised = self.raised.lock().unwrap_or_else(PoisonError::into_inner);
        raised.take()
    }
}

thread_local! {
    /// What is computed on this thread, for the Python functions that it calls.
    static WATCHED: RefCell<Option<Arc<Watch>>> = const { RefCell::new(None) };
    /// The thread that computes for this one.
    static WORKER: RefCell<Option<Worker>> = const { RefCell::new(None) };
}

/// The computation that this thread is at, if it is.
pub(crate) fn watched() -> Option<Arc<Watch>> {
    WATCHED.with_borrow(Clone::clone)
}

/// For as long as it lives, this thread is at a computation.
pub(crate) struct At(Option<Arc<Watch>>);

impl At {
    pub(crate) fn new(watch: &Arc<Watch>) -> Self {
        Self(WATCHED.replace(Some(Arc::clone(watch))))
    }
}

impl Drop for At {
    fn drop(&mut self) {
        WATCHED.set(self.0.take());
    }
}

type Job = Box<dyn FnOnce() + Send>;

/// A thread that waits for work; it ends when nobody holds this.
struct Worker {
    jobs: Sender<Job>,
    /// A child of `fork` has none of the threads of its parent.
    process: u32,
}

impl Worker {
    fn start() -> std::io::Result<Self> {
        let (jobs, work) = channel::<Job>();
        std::thread::Builder::new()
            .name("dam".to_owned())
            .stack_size(STACK)
            .spawn(move || {
                while let Ok(job) = work.recv() {
                    job();
                }
            })?;
        Ok(Self {
            jobs,
            process: std::process::id(),
        })
    }
}

/// Gives work to the thread of the calling one, a new one where there is none.
fn hand_over(job: Job) -> std::io::Result<Worker> {
    let known = WORKER.take();
    let worker = match known {
        Some(worker) if worker.process == std::process::id() => worker,
        Some(foreign) => {
            // Its channel may have been in use when the process was forked.
            std::mem::forget(foreign);
            Worker::start()?
        }
        None => Worker::start()?,
    };
    match worker.jobs.send(job) {
        Ok(()) => Ok(worker),
        Err(_) => Err(std::io::Error::other("the thread that computes has ended")),
    }
}

/// Works a question out. The progress of its terms is called now and then, and at the end, with
/// the share that is done.
///
/// # Errors
/// What the question says is wrong, what a signal handler or the progress raises,
/// `TimeLimitError` without an answer in time, `InternalError` for a panic.
pub(crate) fn compute<T: Send + 'static>(
    py: Python<'_>,
    terms: &Terms,
    question: impl FnOnce(&Watch) -> Result<T, dam::Error> + Send + 'static,
) -> PyResult<T> {
    let progress = terms.progress.as_ref();
    let watch = Arc::new(Watch::within(terms.limit));
    let (answer, found) = channel();
    let watched = Arc::clone(&watch);
    let job = move || {
        let at = At::new(&watched);
        let outcome = catch_unwind(AssertUnwindSafe(|| question(&watched)));
        drop(at);
        // Boxed, since a channel makes room for many of what it carries, zeroed, and answers are
        // large. Nobody may be waiting any more.
        let _ = answer.send(Box::new(outcome));
    };
    let worker = hand_over(Box::new(job))?;
    let outcome = wait(py, &watch, found, progress);
    if let Some(outcome) = outcome? {
        // A thread that is still at work for nobody is not given more.
        WORKER.set(Some(worker));
        if let Some(error) = watch.raised() {
            return Err(error);
        }
        return match *outcome {
            Ok(found) => {
                if let Some(progress) = progress {
                    progress.call1(py, (1.0,))?;
                }
                found.map_err(|error| watch.error(py, &error))
            }
            Err(panic) => Err(fault::internal(py, &words(&*panic))),
        };
    }
    Err(fault::internal(py, "the thread that computes has ended"))
}

type Outcome<T> = std::thread::Result<Result<T, dam::Error>>;

/// Waits for the answer, with an ear for signals.
fn wait<T: Send>(
    py: Python<'_>,
    watch: &Watch,
    found: Receiver<Box<Outcome<T>>>,
    progress: Option<&Py<PyAny>>,
) -> PyResult<Option<Box<Outcome<T>>>> {
    let found = Mutex::new(found);
    let receive = |time: Duration| {
        let found = found.lock().unwrap_or_else(PoisonError::into_inner);
        found.recv_timeout(time)
    };
    let mut told = 0.0;
    loop {
        match py.detach(|| receive(LOOK)) {
            Ok(outcome) => return Ok(Some(outcome)),
            Err(RecvTimeoutError::Disconnected) => return Ok(None),
            Err(RecvTimeoutError::Timeout) => {}
        }
        let share = watch.share();
        let more = (share > told).then_some(share);
        told = share;
        if let Err(error) = hear(py, progress, more) {
            watch.end();
            let begun = Instant::now();
            py.detach(|| {
                while begun.elapsed() < GRACE {
                    if !matches!(receive(LOOK), Err(RecvTimeoutError::Timeout)) {
                        break;
                    }
                }
            });
            return Err(error);
        }
    }
}

/// What a panic says.
fn words(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
    text.unwrap_or_else(|| "an unknown panic".to_owned())
}

/// Works a question out on the calling thread. The progress is called as in [`compute`].
///
/// # Errors
/// As of [`compute`].
pub(crate) fn compute_here<T: Send>(
    py: Python<'_>,
    terms: &Terms,
    question: impl FnOnce(&Watch) -> Result<T, dam::Error> + Send,
) -> PyResult<T> {
    let found = watched_here(py, &Arc::new(Watch::here(py, terms)), question)?;
    if let Some(progress) = &terms.progress {
        progress.call1(py, (1.0,))?;
    }
    Ok(found)
}

/// What needs no look at signals: short.
///
/// # Errors
/// As of [`compute`].
pub(crate) fn directly<T: Send>(
    py: Python<'_>,
    question: impl FnOnce() -> Result<T, dam::Error> + Send,
) -> PyResult<T> {
    watched_here(py, &Arc::default(), |_| question())
}

fn watched_here<T: Send>(
    py: Python<'_>,
    watch: &Arc<Watch>,
    question: impl FnOnce(&Watch) -> Result<T, dam::Error> + Send,
) -> PyResult<T> {
    let outcome = py.detach(|| {
        let _at = At::new(watch);
        catch_unwind(AssertUnwindSafe(|| question(watch)))
    });
    if let Some(error) = watch.raised() {
        return Err(error);
    }
    match outcome {
        Ok(found) => found.map_err(|error| watch.error(py, &error)),
        Err(panic) => Err(fault::internal(py, &words(&*panic))),
    }
}
