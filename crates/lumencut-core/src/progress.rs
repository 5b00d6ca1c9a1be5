//! How far views are, for whoever watches them from another thread.

use std::sync::atomic::{AtomicU64, Ordering};

use crate::stages::Stage;

/// How far the views are that one call renders. The CPU tells it stage by stage and pixel by pixel; of a view on a GPU
/// nothing is known before it is whole.
#[derive(Debug, Default)]
pub struct Progress {
    /// How many views there are to render, and how many are whole.
    views: AtomicU64,
    whole: AtomicU64,
    /// The cost of all stages of the view, of those that ended, and of the one that runs, for each pixel.
    planned: AtomicU64,
    ended: AtomicU64,
    running: AtomicU64,
    /// The pixels of the view, and those that the stage has begun.
    pixels: AtomicU64,
    begun: AtomicU64,
}

impl Progress {
    /// So many views follow.
    pub fn expect_views(&self, count: usize) {
        set(&self.views, count);
        set(&self.whole, 0);
    }

    /// A view of so many pixels begins, of these stages.
    pub fn begin_view(&self, stages: &[Stage], pixels: usize) {
        for number in [&self.ended, &self.running, &self.begun] {
            set(number, 0);
        }
        set(&self.pixels, pixels);
        set(&self.planned, stages.iter().map(|stage| cost(*stage)).sum());
    }

    /// A stage begins; the one before has ended.
    pub fn begin_stage(&self, stage: Stage) {
        self.begun.store(0, Ordering::Relaxed);
        self.ended.fetch_add(self.running.load(Ordering::Relaxed), Ordering::Relaxed);
        set(&self.running, cost(stage));
    }

    /// The stage has begun so many pixels more.
    pub fn begin_pixels(&self, count: usize) {
        self.begun.fetch_add(count as u64, Ordering::Relaxed);
    }

    /// The view is whole.
    pub fn end_view(&self) {
        set(&self.planned, 0);
        self.whole.fetch_add(1, Ordering::Relaxed);
    }

    /// The share of all work that is done, 0 to 1. Stages count as much as they usually take, so it is about that of the
    /// time.
    pub fn share(&self) -> f64 {
        let [views, whole, planned, ended, running, pixels, begun] =
            [&self.views, &self.whole, &self.planned, &self.ended, &self.running, &self.pixels, &self.begun]
                .map(|number| number.load(Ordering::Relaxed) as f64);
        let stage = (begun / pixels.max(1.0)).min(1.0);
        let view = (stage.mul_add(running, ended) / planned.max(1.0)).min(1.0);
        let of_view = if planned > 0.0 { view } else { 0.0 };
        ((whole + of_view) / views.max(1.0)).min(1.0)
    }
}

fn set(number: &AtomicU64, value: usize) {
    number.store(value as u64, Ordering::Relaxed);
}

/// How long a stage usually takes for a pixel beside the others. Nothing but the share that is told depends on it.
const fn cost(stage: Stage) -> usize {
    match stage {
        Stage::Levels | Stage::Projection | Stage::Blocks => 0,
        Stage::Distance => 8,
        Stage::Depth => 12,
        Stage::Leap | Stage::Surface => 4,
        Stage::DepthFilter | Stage::Silhouette => 2,
        Stage::Context => 14,
        Stage::Composite => 10,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_share_grows_pixel_by_pixel_stage_by_stage_and_view_by_view() {
        let progress = Progress::default();
        assert_eq!(progress.share(), 0.0);
        progress.expect_views(2);
        let stages = [Stage::Depth, Stage::Surface, Stage::Leap];
        let mut shares = Vec::new();
        for _ in 0..2 {
            progress.begin_view(&stages, 50);
            for stage in stages {
                progress.begin_stage(stage);
                shares.push(progress.share());
                progress.begin_pixels(25);
                shares.push(progress.share());
                // More pixels than there are, such as those of tiles that reach beyond the view, count as all.
                progress.begin_pixels(30);
            }
            progress.end_view();
        }
        // Of 40 parts for both views, 12 are the depth's, 4 those of each other stage.
        let expected = [0.0, 6.0, 12.0, 14.0, 16.0, 18.0, 20.0, 26.0, 32.0, 34.0, 36.0, 38.0];
        assert_eq!(shares, expected.map(|parts| parts / 40.0));
        assert_eq!(progress.share(), 1.0);
    }
}
