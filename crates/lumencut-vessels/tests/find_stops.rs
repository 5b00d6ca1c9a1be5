//! Tests that finding vessels stops on request in each of its stages.
#![allow(clippy::unwrap_used)]

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use lumencut_core::error::ErrorKind;
use lumencut_core::progress::Progress;
use lumencut_core::stop::Stop;
use lumencut_core::volume::{Volume, Voxels};
use lumencut_phantom::y_junction;
use lumencut_vessels::trace::find::found::Trees;
use lumencut_vessels::trace::find::{FindRequest, find_vessels};

/// Fraction of the work after which each stage begins.
const BEGIN: [f64; 7] = [0.0, 0.04, 0.22, 0.50, 0.88, 0.95, 0.97];

/// Maximum number of calls of `stop` that may follow until all threads have stopped.
const IN_HAND: usize = 100;

fn found(stop: Stop, progress: &Progress) -> lumencut_core::error::Result<Trees> {
    let made = y_junction().unwrap();
    let strides = [1, made.size[0], made.size[0] * made.size[1]];
    let volume = Volume::new(Voxels::I16(&made.voxels), made.size, strides, made.world_from_index).unwrap();
    find_vessels(&volume, &FindRequest { smallest_radius: None, stop, progress: Some(progress) })
}

/// The progress (0 to 1) at each call of `stop`.
fn shares() -> Vec<f64> {
    let (told, progress) = (Mutex::new(Vec::new()), Progress::default());
    let stop = || {
        told.lock().unwrap().push(progress.share());
        false
    };
    found(&stop, &progress).unwrap();
    told.into_inner().unwrap()
}

#[test]
fn each_stage_asks_whether_to_stop_and_soon_ends_once_it_is_told_to() {
    let shares = shares();
    for (stage, begin) in BEGIN.into_iter().enumerate() {
        let end = BEGIN.get(stage + 1).copied().unwrap_or(1.0);
        let within: Vec<usize> = (0..shares.len()).filter(|n| (begin..end).contains(&shares[*n])).collect();
        assert!(!within.is_empty(), "no question in stage {stage}");
        for last in [within[0], within[within.len() / 2], within[within.len() - 1]] {
            let asked = AtomicUsize::new(0);
            let stop = || asked.fetch_add(1, Ordering::Relaxed) >= last;
            let kind = found(&stop, &Progress::default()).err().map(|error| error.kind);
            assert_eq!(kind, Some(ErrorKind::Interrupted), "question {last} in stage {stage}");
            let after = asked.load(Ordering::Relaxed) - last;
            assert!(after < IN_HAND, "{after} questions after question {last} in stage {stage}");
        }
    }
}

#[test]
fn every_question_is_heard_to_the_last_one() {
    let count = shares().len();
    for last in [count - 3, count - 2, count - 1] {
        let asked = AtomicUsize::new(0);
        let stop = || asked.fetch_add(1, Ordering::Relaxed) >= last;
        let kind = found(&stop, &Progress::default()).err().map(|error| error.kind);
        assert_eq!(kind, Some(ErrorKind::Interrupted), "question {last} of {count}");
    }
}
