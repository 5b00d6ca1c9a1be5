//! Settings shared by tests.

use lumencut_core::settings::{ControlPoint, Settings, TransferFunction, Window};

/// The context window of [`crate::volumes::ball_and_rod`].
pub const WINDOW: Window = Window { level: 300.0, width: 900.0 };

/// Without the depth filter: each depth is the winner's own.
pub fn unfiltered() -> Settings {
    Settings { depth_filter: false, ..Settings::default() }
}

/// As [`unfiltered`], by the paper's rules.
pub fn paper_unfiltered() -> Settings {
    Settings { depth_filter: false, ..Settings::paper() }
}

/// Opaque between 20 and 40 and from 320 on: blocks of voxels below and between can be skipped.
pub fn gaps() -> TransferFunction {
    let point = |(intensity, opacity)| ControlPoint { intensity, color: [250, 120, 30], opacity };
    let points = [(20.0, 0.0), (30.0, 0.05), (40.0, 0.0), (320.0, 0.0), (320.0, 0.2), (950.0, 1.0)];
    TransferFunction { points: points.map(point).to_vec() }
}
