//! Measures times for benches: medians and minima of repeated runs, as Markdown tables.

use std::collections::BTreeMap;
use std::time::Instant;

use lumencut_core::error::Result;
use lumencut_core::frame::Frame;
use lumencut_core::math::statistics::median;

/// Durations of repeated runs (ms).
#[derive(Clone, Copy, Debug)]
pub struct Times {
    pub median: f64,
    pub minimum: f64,
}

/// Median duration (ms) of each stage; "frame" is the total that the caller measures.
pub type StageTimes = BTreeMap<&'static str, f64>;

/// The duration of `work` (ms), and its result.
pub fn once<T>(work: impl FnOnce() -> T) -> (f64, T) {
    let start = Instant::now();
    let result = work();
    (start.elapsed().as_secs_f64() * 1e3, result)
}

/// Runs `work` once to warm up, then `runs` times.
pub fn time(runs: usize, mut work: impl FnMut()) -> Times {
    work();
    let mut times: Vec<f64> = (0..runs).map(|_| once(&mut work).0).collect();
    let minimum = times.iter().copied().fold(f64::INFINITY, f64::min);
    Times { median: median(&mut times).unwrap_or(f64::NAN), minimum }
}

/// The median time of each stage over `frames` frames, after a warm-up frame.
pub fn stage_medians(frames: usize, mut render: impl FnMut() -> Result<Frame>) -> Result<StageTimes> {
    render()?;
    let mut all: BTreeMap<&'static str, Vec<f64>> = BTreeMap::new();
    for _ in 0..frames {
        let (milliseconds, frame) = once(&mut render);
        let mut of_frame = StageTimes::from([("frame", milliseconds)]);
        // A stage may run several times per frame.
        frame?.timings.iter().for_each(|t| *of_frame.entry(t.stage).or_default() += t.milliseconds);
        of_frame.into_iter().for_each(|(stage, time)| all.entry(stage).or_default().push(time));
    }
    let usual = |mut times: Vec<f64>| median(&mut times).unwrap_or(f64::NAN);
    Ok(all.into_iter().map(|(stage, times)| (stage, usual(times))).collect())
}

pub fn row<S: AsRef<str>>(cells: impl IntoIterator<Item = S>) {
    let cells: Vec<_> = cells.into_iter().map(|c| c.as_ref().to_owned()).collect();
    println!("| {} |", cells.join(" | "));
}

pub fn head(title: &str, cells: &[&str]) {
    println!("\n{title}\n");
    row(cells);
    row(cells.iter().map(|_| "---"));
}
