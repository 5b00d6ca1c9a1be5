//! Settings shared by tests.

use lumencut_core::settings::{ControlPoint, Settings, TransferFunction, Window};

/// The context window of [`crate::volumes::ball_and_rod`].
pub const WINDOW: Window = Window { level: 300.0, width: 900.0 };

/// Settings without the depth filter: each pixel has the depth of the piece that it shows.
pub fn unfiltered() -> Settings {
    Settings { depth_filter: false, ..Settings::default() }
}

/// As [`unfiltered`], with the rules of the paper.
pub fn paper_unfiltered() -> Settings {
    Settings { depth_filter: false, ..Settings::paper() }
}

/// A transfer function that is opaque between 20 and 40 and from 320 on; other blocks of voxels can be skipped.
pub fn gaps() -> TransferFunction {
    let point = |(intensity, opacity)| ControlPoint { intensity, color: [250, 120, 30], opacity };
    let points = [(20.0, 0.0), (30.0, 0.05), (40.0, 0.0), (320.0, 0.0), (320.0, 0.2), (950.0, 1.0)];
    TransferFunction { points: points.map(point).to_vec() }
}
