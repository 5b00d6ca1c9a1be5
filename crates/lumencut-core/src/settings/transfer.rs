//! Transfer functions: colour and opacity for intensities of the context, and named presets.

use super::window::Window;
use crate::error::{Error, ErrorKind, Result};
use crate::limits::Limits;
use crate::named::Named;

const OPACITY: Limits = Limits::new(0.0, 1.0, "per mm");

pub(crate) const MAX_POINTS: usize = 64;

/// Colour and opacity at one intensity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControlPoint {
    /// Intensity (unit of the volume, HU for CT).
    pub intensity: f64,
    /// RGB.
    pub color: [u8; 3],
    /// Opacity of one millimetre, 0 to 1.
    pub opacity: f64,
}

/// Control points by rising intensity. Colour and opacity are linear between them and constant beyond the
/// outermost ones; two points at one intensity make a step.
#[derive(Clone, Debug, PartialEq)]
pub struct TransferFunction {
    /// The points, 1 to 64.
    pub points: Vec<ControlPoint>,
}

impl TransferFunction {
    /// Fails with [`ErrorKind::Settings`] for the first invalid point.
    pub fn check(&self) -> Result<()> {
        let points = &self.points;
        if points.is_empty() || points.len() > MAX_POINTS {
            let (found, expected) =
                (format!("{} control points", points.len()), format!("1 to {MAX_POINTS}"));
            return Err(Error::new(ErrorKind::Settings, "context_transfer", found, expected));
        }
        for (n, point) in points.iter().enumerate() {
            let name = |what: &str| format!("{what} of control point {} of context_transfer", n + 1);
            Limits::INTENSITY.check(&name("intensity"), point.intensity)?;
            OPACITY.check(&name("opacity"), point.opacity)?;
            if n > 0 && point.intensity < points[n - 1].intensity {
                let found = format!("{} after {}", point.intensity, points[n - 1].intensity);
                return Err(Error::new(ErrorKind::Settings, name("intensity"), found, "rising intensities"));
            }
        }
        Ok(())
    }
}

/// Named transfer functions, placed within the context window: 0 is its black end, 1 its white end. A window
/// from the data has the tissue around the vessels at 1/6 and their lumen at 1/2.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Preset {
    /// Grey as in the window; brighter is more opaque.
    Grey,
    /// Vessels red; calcifications, stents and bone ivory; tissue hardly visible.
    Angio,
    /// Everything brighter than contrast medium, ivory.
    Bone,
    /// Skin and muscle as a veil, vessels within.
    SoftTissue,
}

impl Named for Preset {
    const NAMES: &'static [(&'static str, Self)] = &[
        ("grey", Self::Grey),
        ("angio", Self::Angio),
        ("bone", Self::Bone),
        ("soft-tissue", Self::SoftTissue),
    ];
}

impl Preset {
    /// Position in the window, colour and opacity per millimetre of each control point.
    fn points(self) -> &'static [(f64, [u8; 3], f64)] {
        match self {
            Self::Grey => &[(0.0, [0, 0, 0], 0.0), (1.0, [255, 255, 255], 0.3)],
            Self::Angio => &[
                (0.28, [110, 30, 20], 0.0),
                (0.45, [185, 45, 30], 0.12),
                (0.58, [215, 85, 55], 0.25),
                (0.72, [240, 215, 180], 0.4),
                (1.0, [255, 250, 235], 0.7),
            ],
            Self::Bone => {
                &[(0.6, [150, 120, 90], 0.0), (0.8, [225, 205, 170], 0.3), (1.2, [255, 250, 240], 0.7)]
            }
            Self::SoftTissue => &[
                (0.03, [120, 70, 50], 0.0),
                (0.12, [190, 130, 100], 0.001_5),
                (0.25, [200, 110, 90], 0.003),
                (0.33, [200, 90, 70], 0.01),
                (0.5, [220, 80, 60], 0.15),
                (1.0, [255, 245, 225], 0.5),
            ],
        }
    }

    /// The transfer function in a window.
    pub fn transfer_function(self, window: Window) -> TransferFunction {
        let black = window.level - window.width / 2.0;
        let point = |&(place, color, opacity): &(f64, [u8; 3], f64)| ControlPoint {
            // A window may extend beyond the intensities allowed for control points.
            intensity: (black + place * window.width)
                .clamp(-Limits::LARGEST_INTENSITY, Limits::LARGEST_INTENSITY),
            color,
            opacity,
        };
        TransferFunction { points: self.points().iter().map(point).collect() }
    }
}
