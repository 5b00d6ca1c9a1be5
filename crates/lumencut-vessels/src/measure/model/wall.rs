//! The prior of the vessel wall, and the result of its fit. The wall of an artery is mostly surrounded by fat. The
//! value midway between lumen and fat lies in the wall, so without a wall model a lumen of 3 mm is measured as 3.5
//! mm. In CT, walls have about the level of soft tissue.

use glam::DVec2;

use super::ellipse::Ellipse;
use super::parameters::{HARMONICS, SECTORS, THICKNESS as LOG_THICKNESS, WALL, WALLED};
use crate::measure::estimation::Level;
use crate::measure::estimation::least_squares::{Minimum, solved};
use crate::measure::estimation::unit;
use crate::measure::section::scale::Scale;

/// Expected thickness of the wall as a factor of √diameter (mm), and the standard deviation of its logarithm.
const THICKNESS: [f64; 2] = [0.45, 0.5];

/// In lung, the thickness as a fraction of the diameter: there, arteries have the pressure and wall of veins.
const PULMONARY: f64 = 1.0 / 16.0;

/// Range of the expected thickness (mm), because even the walls of very wide arteries have limited thickness.
const MIDDLE: [f64; 2] = [0.4, 1.6];

/// Minimum of the thickness expected in lung (mm).
const LEAST_PULMONARY: f64 = 0.22;

/// Minimum variance of the logarithm of a thickness.
const LEAST_THICKNESS: f64 = 1e-4;

#[derive(Clone, Copy, Debug)]
pub(crate) struct Wall {
    /// Intensity level of the wall, as a fraction of the contrast, and its standard deviation.
    pub level: Level,
    /// Logarithm of the thickness (mm), and its standard deviation.
    pub(crate) log_thickness: Level,
    /// Change of the log thickness per change of the level: a thin, bright wall looks like a thick, dark one.
    pub slope: f64,
    /// Harmonics of the surroundings, as fractions of the contrast; see [`super::ThreeLevels`].
    pub sectors: [f64; HARMONICS],
    /// The point in the plane from which directions are measured (mm).
    pub origin: DVec2,
}

impl Wall {
    pub(crate) fn new(minimum: &Minimum<WALLED>, origin: DVec2) -> Option<Self> {
        let [level, thickness] = [WALL, LOG_THICKNESS];
        let of = |n: usize| solved(&minimum.normal.matrix, &unit(n));
        let (by_level, by_thickness) = (of(level)?, of(thickness)?);
        let at = &minimum.at;
        let deviation = |square: f64| (square >= 0.0 && square.is_finite()).then(|| square.sqrt());
        Some(Self {
            level: [at[level], deviation(by_level[level])?],
            log_thickness: [at[thickness], deviation(by_thickness[thickness])?],
            slope: by_level[thickness] / by_level[level],
            sectors: std::array::from_fn(|h| at[SECTORS + h]),
            origin,
        })
    }

    pub(crate) fn assumed(level: Level, log_thickness: Level, origin: DVec2) -> Self {
        Self { level, log_thickness, slope: 0.0, sectors: [0.0; HARMONICS], origin }
    }

    /// Log thickness that the same voxels imply if the wall level (a fraction of the contrast) is known.
    pub(crate) fn log_thickness_at(&self, level: f64) -> Level {
        let [mean, deviation] = self.log_thickness;
        let square = deviation.powi(2) - (self.slope * self.level[1]).powi(2);
        [mean + self.slope * (level - self.level[0]), square.max(LEAST_THICKNESS).sqrt()]
    }

    pub(crate) fn thickness(&self) -> f64 {
        self.log_thickness[0].exp()
    }
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct KnownWall {
    pub level: Level,
    /// Log thickness and its standard deviation; None if only the lumen width predicts it.
    pub(crate) log_thickness: Option<Level>,
    /// See [`Wall::slope`]; `log_thickness` applies to a wall of level `level`.
    pub slope: f64,
    /// Whether the wall may be as thin as that of pulmonary vessels.
    pub(crate) is_in_lung: bool,
    /// Whether the wall surrounds air: both lumen and surroundings are darker than the wall.
    pub(crate) is_airway: bool,
}

impl KnownWall {
    pub(crate) fn of(level: Level, scale: &Scale) -> Self {
        let share = [scale.share(level[0]), level[1] / scale.contrast.abs()];
        Self { level: share, log_thickness: None, slope: 0.0, is_in_lung: false, is_airway: false }
    }

    pub(crate) fn log_thickness(&self, lumen: &Ellipse) -> Level {
        self.log_thickness.unwrap_or_else(|| self.beforehand(lumen))
    }

    /// Log thickness that the width of the lumen predicts. In lung, it lies between those of pulmonary vessels and of
    /// other arteries, such as bronchial grafts and fistulas, and its standard deviation includes both.
    pub(crate) fn beforehand(&self, lumen: &Ellipse) -> Level {
        let [share, deviation] = THICKNESS;
        let diameter = 2.0 * lumen.mean;
        let artery = (share * diameter.sqrt()).clamp(MIDDLE[0], MIDDLE[1]).ln();
        if !self.is_in_lung {
            return [artery, deviation];
        }
        let pulmonary = (PULMONARY * diameter).clamp(LEAST_PULMONARY, MIDDLE[1]).ln();
        [f64::midpoint(artery, pulmonary), deviation.hypot(0.5 * (artery - pulmonary))]
    }
}
