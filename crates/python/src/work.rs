//! Long work without the interpreter's lock: Ctrl-C stops it, so does the limit of memory, and a panic becomes an
//! exception.

use crate::failure::Failure;
use crate::given::count;
use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;
use std::any::Any;
use std::cell::{Cell, RefCell};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};
use wavestep::limits::{count_nothing_here, memory, resident, set_memory as allow};

/// How often signals and memory are looked at.
const TICK: Duration = Duration::from_millis(50);

/// What work takes beside the waves.
const BESIDE: u64 = 64_000_000;

/// What a thread that works knows of it.
#[derive(Clone, Copy)]
struct Watch {
    looked: Instant,
    /// What the process held when it was first looked at.
    held: Option<u64>,
}

thread_local! {
    static WATCH: Cell<Option<Watch>> = const { Cell::new(None) };

    /// Of a thread that helps another: whether all of them are to stop.
    static HELPS: RefCell<Option<Arc<AtomicBool>>> = const { RefCell::new(None) };
}

/// Why work was stopped.
struct Stopped(PyErr);

/// Does work without the interpreter's lock.
pub fn released<T: Send>(
    py: Python<'_>,
    work: impl FnOnce() -> Result<T, Failure> + Send,
) -> PyResult<T> {
    let done = py.detach(|| {
        WATCH.set(Some(Watch { looked: Instant::now(), held: None }));
        let done = catch_unwind(AssertUnwindSafe(work));
        WATCH.set(None);
        done
    });
    match done {
        Ok(result) => result.map_err(|failure| failure.raised(py)),
        Err(reason) => Err(unwound(py, reason)),
    }
}

fn unwound(py: Python<'_>, reason: Box<dyn Any + Send>) -> PyErr {
    let reason = match reason.downcast::<Stopped>() {
        Ok(stopped) => return stopped.0,
        Err(reason) => reason,
    };
    let told = reason.downcast_ref::<&str>().map(|told| (*told).to_owned());
    let told = told.or_else(|| reason.downcast_ref::<String>().cloned()).unwrap_or_default();
    Failure::Internal(told).raised(py)
}

/// Stops work with an exception.
pub fn stop(error: PyErr) -> ! {
    resume_unwind(Box::new(Stopped(error)))
}

/// Tells helping threads to stop where this one unwinds.
struct StopTogether(Arc<AtomicBool>);

impl Drop for StopTogether {
    fn drop(&mut self) {
        if thread::panicking() {
            self.0.store(true, Ordering::Relaxed);
        }
    }
}

/// Works on so many helping threads, and hands what they find to `each` on this one, in the order in which it is found.
/// They stop where this thread does, or where one of them panics.
pub fn on_threads<T: Send>(
    indices: impl Iterator<Item = usize> + Send,
    threads: usize,
    work: impl Fn(usize) -> T + Sync,
    mut each: impl FnMut(usize, T),
) {
    let indices = &Mutex::new(indices);
    let work = &work;
    let ending = Arc::new(AtomicBool::new(false));
    let (to, found) = channel();
    thread::scope(|scope| {
        let help = |_| {
            let (to, ending) = (to.clone(), StopTogether(Arc::clone(&ending)));
            scope.spawn(move || {
                count_nothing_here();
                HELPS.set(Some(Arc::clone(&ending.0)));
                let next = || indices.lock().unwrap_or_else(PoisonError::into_inner).next();
                while let Some(index) = next().filter(|_| !ending.0.load(Ordering::Relaxed)) {
                    let _ = to.send((index, work(index)));
                }
            })
        };
        let helpers: Vec<_> = (0..threads.max(1)).map(help).collect();
        drop(to);
        let _ending = StopTogether(ending);
        loop {
            match found.recv_timeout(TICK) {
                Ok((index, found)) => each(index, found),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => break,
            }
            pause();
        }
        for helper in helpers {
            helper.join().unwrap_or_else(|reason| resume_unwind(reason));
        }
    });
}

/// Looks at signals and memory between two steps of work, now and then.
pub fn pause() {
    let ending = |helps: &RefCell<Option<Arc<AtomicBool>>>| {
        helps.borrow().as_ref().is_some_and(|ending| ending.load(Ordering::Relaxed))
    };
    if HELPS.with(ending) {
        resume_unwind(Box::new("stopped"));
    }
    let Some(mut watch) = WATCH.get().filter(|watch| watch.looked.elapsed() >= TICK) else {
        return;
    };
    if let Err(stopped) = Python::attach(|py| py.check_signals()) {
        stop(stopped);
    }
    let now = resident();
    watch.held = watch.held.or(now);
    watch.looked = Instant::now();
    WATCH.set(Some(watch));
    let grown = now.zip(watch.held).map_or(0, |(now, before)| now.saturating_sub(before));
    if grown > memory().saturating_add(BESIDE) {
        let told = format!(
            "the answer takes more than {} MB of memory; ask for an earlier time, a shorter window or fewer digits, \
             or allow more with wavestep.set_memory",
            memory() / 1_000_000
        );
        stop(PyMemoryError::new_err(told));
    }
}

/// Allows so many bytes of memory for waves from now on; the default is a quarter of the machine's.
///
/// >>> import wavestep as ws
/// >>> ws.set_memory(2_000_000_000)
#[pyfunction]
pub fn set_memory(#[pyo3(from_py_with = count)] bytes: usize) {
    allow(bytes as u64);
}

/// Panics, for the test that a panic becomes an exception.
#[pyfunction]
#[pyo3(name = "_fail")]
pub fn fail(py: Python<'_>) -> PyResult<()> {
    released(py, || panic!("on purpose"))
}
