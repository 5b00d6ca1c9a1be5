//! Measures the stages one after the other.

use web_time::Instant;

use crate::frame::Timing;
use crate::stages::Stage;

pub(super) struct Clock {
    last: Instant,
    pub timings: Vec<Timing>,
}

impl Clock {
    pub(super) fn start() -> Self {
        Self { last: Instant::now(), timings: Vec::new() }
    }

    pub(super) fn lap(&mut self, stage: Stage) {
        let now = Instant::now();
        let milliseconds = (now - self.last).as_secs_f64() * 1e3;
        self.timings.push(Timing { stage: stage.name(), milliseconds });
        self.last = now;
    }
}
