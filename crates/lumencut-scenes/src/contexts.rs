//! Pictures of the context of small volumes.

use lumencut_core::camera::Camera;
use lumencut_core::settings::{Context, ContextMode, ControlPoint, Settings, TransferFunction, Window};
use lumencut_core::volume::Volume;

use crate::pictures::context_alone;

pub const DVR: ContextMode = ContextMode::Blend { gamma: -1.0 };
pub const MIDA: ContextMode = ContextMode::Blend { gamma: 0.0 };
pub const MIP: ContextMode = ContextMode::Blend { gamma: 1.0 };

/// A window for values from 10 to 230.
pub const LOW_WINDOW: Window = Window { level: 120.0, width: 220.0 };

/// Intensity, colour and opacity of one millimetre of each control point.
pub type Points<'a> = &'a [(f64, [u8; 3], f64)];

/// Colours of values from 0 to 250, transparent below 60.
pub const COLOURS: Points<'static> = &[
    (60.0, [20, 200, 90], 0.0),
    (110.0, [250, 40, 10], 0.15),
    (170.0, [30, 60, 220], 0.05),
    (240.0, [255, 250, 200], 0.7),
];

pub fn transfer(points: Points) -> TransferFunction {
    let point = |&(intensity, color, opacity)| ControlPoint { intensity, color, opacity };
    TransferFunction { points: points.iter().map(point).collect() }
}

/// A context with the given points in [`LOW_WINDOW`], sampled at every millimetre if its mode has samples.
pub fn coloured(mode: ContextMode, points: Points) -> Context {
    let is_sampled = matches!(mode, ContextMode::Blend { gamma } if gamma < 1.0);
    Context {
        mode,
        window: LOW_WINDOW,
        transfer: transfer(points),
        step: is_sampled.then_some(1.0),
        ..Context::default()
    }
}

/// Colours with straight alpha.
pub fn drawn(volume: Volume, camera: &Camera, context: Context) -> Vec<[u8; 4]> {
    let settings = Settings { context: Some(context), ..Settings::default() };
    context_alone(volume, camera, &settings, &|| false).unwrap().context
}

/// The largest difference of a channel among pixels whose opacity is above `least`.
pub fn apart(one: &[[u8; 4]], other: &[[u8; 4]], least: u8) -> u8 {
    let both = one.iter().zip(other).filter(|(one, _)| one[3] > least);
    both.flat_map(|(one, other)| (0..4).map(|c| one[c].abs_diff(other[c]))).max().unwrap_or(0)
}
