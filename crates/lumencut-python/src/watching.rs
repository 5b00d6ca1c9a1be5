//! Runs long work without the GIL, stops it at Ctrl-C, and reports its progress.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc;
use std::time::Duration;

use lumencut::progress::Progress;
use lumencut::stop::Stop;
use pyo3::prelude::*;

use crate::errors::to_python;
use crate::pool;

/// How often a rendering checks for signals, such as that of Ctrl-C.
const SIGNAL_PERIOD: Duration = Duration::from_millis(50);

pub(crate) const SHARES: u32 = 1000;

pub(crate) struct Reporter<'a> {
    pub progress: &'a Progress,
    pub callback: &'a Py<PyAny>,
}

impl Reporter<'_> {
    /// Reports that `done` of `SHARES` equal parts are done.
    pub(crate) fn report(&self, py: Python<'_>, done: u32) -> PyResult<()> {
        self.callback.call1(py, (done, SHARES)).map(drop)
    }

    fn report_so_far(&self, py: Python<'_>) -> PyResult<()> {
        self.report(py, (self.progress.share() * f64::from(SHARES)) as u32)
    }
}

/// Runs `work` on another thread without the GIL; this thread handles signals and progress.
pub(crate) fn interruptible<T: Send>(
    py: Python<'_>,
    reporter: Option<&Reporter<'_>>,
    work: impl FnOnce(Stop<'_>) -> PyResult<T> + Send,
) -> PyResult<T> {
    let stopped = AtomicBool::new(false);
    let stop = || stopped.load(Ordering::Relaxed);
    py.detach(|| {
        let (done, finished) = mpsc::sync_channel(1);
        std::thread::scope(|scope| {
            let stop = &stop;
            let worker = scope.spawn(move || {
                let result = work(stop);
                // Sending cannot fail, since the receiver outlives this thread.
                let _ = done.send(());
                result
            });
            let mut signal = Ok(());
            while !worker.is_finished() && signal.is_ok() {
                if finished.recv_timeout(SIGNAL_PERIOD).is_err() {
                    signal = Python::attach(|py| {
                        py.check_signals()?;
                        reporter.map_or(Ok(()), |reporter| reporter.report_so_far(py))
                    });
                } else {
                    break;
                }
            }
            stopped.store(signal.is_err(), Ordering::Relaxed);
            let result = worker.join();
            signal?;
            match result {
                Ok(result) => result,
                Err(panic) => std::panic::resume_unwind(panic),
            }
        })
    })
}

/// As [`interruptible`], on the thread pool.
pub(crate) fn computed<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(Stop<'_>) -> lumencut::error::Result<T> + Send,
) -> PyResult<T> {
    interruptible(py, None, |stop| pool::install(|| work(stop))?.map_err(to_python))
}

/// As [`interruptible`]; `callback` receives the progress, up to the end.
pub(crate) fn reporting<T: Send>(
    py: Python<'_>,
    callback: Option<&Py<PyAny>>,
    work: impl FnOnce(Stop<'_>, Option<&Progress>) -> PyResult<T> + Send,
) -> PyResult<T> {
    let progress = Progress::default();
    let reporter = callback.map(|callback| Reporter { progress: &progress, callback });
    let done =
        interruptible(py, reporter.as_ref(), |stop| work(stop, callback.is_some().then_some(&progress)))?;
    if let Some(reporter) = reporter {
        reporter.report(py, SHARES)?;
    }
    Ok(done)
}
