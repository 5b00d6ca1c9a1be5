//! Progress of finding vessels, in stages.

use std::sync::atomic::{AtomicUsize, Ordering};

use lumencut_core::progress::Progress;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stage {
    /// Computing the pyramid of resolutions.
    Levels,
    /// The first pass, which estimates the vessel level.
    FirstPass,
    Candidates,
    Tracks,
    Judgement,
    Links,
    Vessels,
}

/// Relative durations of the stages.
const COSTS: [usize; 7] = [4, 18, 28, 38, 7, 2, 3];

const PARTS: usize = 1000;

#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Stages<'a>(Option<&'a Progress>);

impl<'a> Stages<'a> {
    pub(crate) fn begin(progress: Option<&'a Progress>) -> Self {
        if let Some(progress) = progress {
            progress.expect_views(1);
            progress.begin_view(COSTS.into_iter(), PARTS);
        }
        Self(progress)
    }

    pub(crate) fn stage(self, stage: Stage, pieces: usize) -> Pieces<'a> {
        if let Some(progress) = self.0 {
            progress.begin_stage(COSTS[stage as usize]);
        }
        Pieces { stages: self, all: pieces.max(1), done: AtomicUsize::new(0) }
    }

    pub(crate) fn end(self) {
        if let Some(progress) = self.0 {
            progress.end_view();
        }
    }
}

#[derive(Debug)]
pub(crate) struct Pieces<'a> {
    stages: Stages<'a>,
    all: usize,
    done: AtomicUsize,
}

impl Pieces<'_> {
    pub(crate) fn done(&self, count: usize) {
        let before = self.done.fetch_add(count, Ordering::Relaxed);
        let parts = |pieces: usize| PARTS * pieces.min(self.all) / self.all;
        if let Some(progress) = self.stages.0 {
            progress.begin_pixels(parts(before + count) - parts(before));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_share_rises_by_the_costs_of_stages_and_the_pieces_of_each() {
        let progress = Progress::default();
        let stages = Stages::begin(Some(&progress));
        stages.stage(Stage::Levels, 1);
        stages.stage(Stage::FirstPass, 1);
        let pieces = stages.stage(Stage::Candidates, 3);
        assert_eq!(progress.share(), 0.22);
        pieces.done(1);
        pieces.done(2);
        assert_eq!(progress.share(), 0.5);
        pieces.done(1);
        assert_eq!(progress.share(), 0.5);
        stages.end();
        assert_eq!(progress.share(), 1.0);
        Stages::begin(None).stage(Stage::Tracks, 0).done(1);
    }
}
