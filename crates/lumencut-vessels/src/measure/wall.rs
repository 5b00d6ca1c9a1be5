//! The wall of a vessel: what is known of it beforehand, and what the sections of a vessel tell of it together.
//!
//! An artery is lumen, wall and, mostly, fat. Half of the way from the lumen to the fat lies in the wall, so that without a
//! wall a lumen of 3 mm is measured as 3.5 mm. The level of walls in CT is about that of soft tissue.

use glam::DVec2;

use super::ellipse::Ellipse;
use super::least_squares::{Minimum, solved};
use super::parameters::{HARMONICS, SECTORS, THICKNESS as LOG_THICKNESS, WALL, WALLED};
use super::pooled::Level;
use super::scale::Scale;
use super::terms::unit;

/// Walls are thicker the wider the vessel: this times the square root of its diameter (mm), by and large, and the standard
/// deviation of the logarithm of that. So they are from 0.3 to 3 mm thick.
const THICKNESS: [f64; 2] = [0.45, 0.5];

/// What that is at least and at most (mm): the wall of an aorta is no thicker by its width.
const MIDDLE: [f64; 2] = [0.4, 1.6];

/// The least variance of the logarithm of a thickness.
const LEAST_THICKNESS: f64 = 1e-4;

/// A wall as it was fitted, or as it is expected.
#[derive(Clone, Copy, Debug)]
pub struct Wall {
    /// Its level, as a share, and the standard deviation of that.
    pub level: Level,
    /// The logarithm of its thickness (mm), and the standard deviation of that.
    pub log_thickness: Level,
    /// By how much the logarithm of the thickness is another one where the level is another share: a thin wall that is brighter
    /// looks like a thicker one.
    pub slope: f64,
    /// By how much the surroundings differ from side to side, as shares: see [`super::model::ThreeLevels`].
    pub sectors: [f64; HARMONICS],
    /// Where directions are taken from (mm in the plane).
    pub origin: DVec2,
}

impl Wall {
    /// The wall of a fit whose directions are those from `origin` (mm in the plane).
    pub fn new(minimum: &Minimum<WALLED>, origin: DVec2) -> Option<Self> {
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

    /// A wall that nothing was fitted to.
    pub fn assumed(level: Level, log_thickness: Level, origin: DVec2) -> Self {
        Self { level, log_thickness, slope: 0.0, sectors: [0.0; HARMONICS], origin }
    }

    /// The logarithm of the thickness that the same voxels tell if the level of the wall is known, as a share.
    pub fn log_thickness_at(&self, level: f64) -> Level {
        let [mean, deviation] = self.log_thickness;
        let square = deviation.powi(2) - (self.slope * self.level[1]).powi(2);
        [mean + self.slope * (level - self.level[0]), square.max(LEAST_THICKNESS).sqrt()]
    }

    /// Its thickness (mm).
    pub fn thickness(&self) -> f64 {
        self.log_thickness[0].exp()
    }
}

/// What is known of a wall beforehand: its level and the logarithm of its thickness (mm).
#[derive(Clone, Copy, Debug)]
pub struct KnownWall {
    /// The level, as a share.
    pub level: Level,
    /// The logarithm of the thickness; None where only the width of the vessel tells it.
    pub log_thickness: Option<Level>,
    /// [`Wall::slope`]; the thickness above is that at the level.
    pub slope: f64,
}

impl KnownWall {
    /// The wall of a level in the volume's unit.
    pub fn of(level: Level, scale: &Scale) -> Self {
        let share = [scale.share(level[0]), level[1] / scale.contrast.abs()];
        Self { level: share, log_thickness: None, slope: 0.0 }
    }

    /// The logarithm of the thickness (mm) around a lumen.
    pub fn log_thickness(&self, lumen: &Ellipse) -> Level {
        self.log_thickness.unwrap_or_else(|| beforehand(lumen))
    }
}

/// The logarithm of the thickness of a wall (mm) by the width of its lumen alone.
pub fn beforehand(lumen: &Ellipse) -> Level {
    let [share, deviation] = THICKNESS;
    [(share * (2.0 * lumen.mean).sqrt()).clamp(MIDDLE[0], MIDDLE[1]).ln(), deviation]
}
