//! The progress of views, read from another thread.

use std::sync::atomic::{AtomicU64, Ordering};

/// The progress of the views of one call. The CPU reports it per stage and pixel, a GPU only per view.
#[derive(Debug, Default)]
pub struct Progress {
    views: AtomicU64,
    whole: AtomicU64,
    /// Cost per pixel: of all stages of the view, of those that have ended, and of the running one.
    planned: AtomicU64,
    ended: AtomicU64,
    running: AtomicU64,
    /// Number of pixels of the view, and of those that the running stage has begun.
    pixels: AtomicU64,
    begun: AtomicU64,
}

impl Progress {
    /// Announces the number of views.
    pub fn expect_views(&self, count: usize) {
        set(&self.views, count);
        set(&self.whole, 0);
    }

    /// Begins a view of this number of pixels whose stages have these costs per pixel.
    pub fn begin_view(&self, costs: impl Iterator<Item = usize>, pixels: usize) {
        for number in [&self.ended, &self.running, &self.begun] {
            set(number, 0);
        }
        set(&self.pixels, pixels);
        set(&self.planned, costs.sum());
    }

    /// Ends the last stage and begins one of this cost per pixel.
    pub fn begin_stage(&self, cost: usize) {
        self.begun.store(0, Ordering::Relaxed);
        self.ended.fetch_add(self.running.load(Ordering::Relaxed), Ordering::Relaxed);
        set(&self.running, cost);
    }

    /// Counts further pixels that the stage has begun.
    pub fn begin_pixels(&self, count: usize) {
        self.begun.fetch_add(count as u64, Ordering::Relaxed);
    }

    /// Ends the view.
    pub fn end_view(&self) {
        set(&self.planned, 0);
        self.whole.fetch_add(1, Ordering::Relaxed);
    }

    /// The finished share of all work, 0 to 1, weighted by the usual time of the stages.
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
                // More pixels are counted than the view has, as tiles may exceed it; this must not raise the share.
                progress.begin_pixels(30);
            }
            progress.end_view();
        }
        // The expected finished shares of both views, in parts of 40.
        let expected = [0.0, 6.0, 12.0, 14.0, 16.0, 18.0, 20.0, 26.0, 32.0, 34.0, 36.0, 38.0];
        assert_eq!(shares, expected.map(|parts| parts / 40.0));
        assert_eq!(progress.share(), 1.0);
    }
}
