//! How far views are, for whoever watches them from another thread.

use std::sync::atomic::{AtomicU64, Ordering};

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

    /// A view of this number of pixels begins, whose stages have these costs for each pixel.
    pub fn begin_view(&self, costs: impl Iterator<Item = usize>, pixels: usize) {
        for number in [&self.ended, &self.running, &self.begun] {
            set(number, 0);
        }
        set(&self.pixels, pixels);
        set(&self.planned, costs.sum());
    }

    /// A stage of this cost for each pixel begins; the one before has ended.
    pub fn begin_stage(&self, cost: usize) {
        self.begun.store(0, Ordering::Relaxed);
        self.ended.fetch_add(self.running.load(Ordering::Relaxed), Ordering::Relaxed);
        set(&self.running, cost);
    }

    /// The stage has begun this number of further pixels.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_share_grows_pixel_by_pixel_stage_by_stage_and_view_by_view() {
        let progress = Progress::default();
        assert_eq!(progress.share(), 0.0);
        progress.expect_views(2);
        let costs = [12, 4, 4];
        let mut shares = Vec::new();
        for _ in 0..2 {
            progress.begin_view(costs.into_iter(), 50);
            for cost in costs {
                progress.begin_stage(cost);
                shares.push(progress.share());
                progress.begin_pixels(25);
                shares.push(progress.share());
                // More pixels than there are, such as those of tiles that reach beyond the view, count as all.
                progress.begin_pixels(30);
            }
            progress.end_view();
        }
        // Of 40 parts for both views.
        let expected = [0.0, 6.0, 12.0, 14.0, 16.0, 18.0, 20.0, 26.0, 32.0, 34.0, 36.0, 38.0];
        assert_eq!(shares, expected.map(|parts| parts / 40.0));
        assert_eq!(progress.share(), 1.0);
    }
}
