//! The wall of a vessel: what is known of it beforehand, and what the sections of a vessel tell of it together.
//!
//! An artery is lumen, wall and, mostly, fat. Half of the way from the lumen to the fat lies in the wall, so that a lumen without
//! one is taken for too wide, by 3 mm for 3.5. The level of walls in CT is about that of soft tissue.

use glam::DVec2;

use super::ellipse::Ellipse;
use super::fit::Fit;
use super::least_squares::{Minimum, solved};
use super::model::{HARMONICS, SECTORS, THICKNESS as LOG_THICKNESS, WALL, WALLED};
use super::pooled::Level;
use super::scale::Scale;
use super::terms::unit;

/// Walls are thicker the wider the vessel: this times the square root of its diameter (mm), by and large, and the standard
/// deviation of the logarithm of that. So they are from 0.3 to 3 mm thick.
const THICKNESS: [f64; 2] = [0.45, 0.5];

/// What that is at least and at most (mm): the wall of an aorta is no thicker by its width.
const MIDDLE: [f64; 2] = [0.4, 1.6];

/// Thickness is even along the vessel over about this distance (mm), and differs by this (a logarithm) all the same.
const EVEN: (f64, f64) = (10.0, 0.1);

/// Walls are told apart where they are in this share of the sections.
const APART: f64 = 1.0 / 3.0;

/// The least variance of the logarithm of a thickness.
const LEAST_THICKNESS: f64 = 1e-4;

/// The level differs by this share of the contrast along the vessel, however well it is known.
const LEAST_LEVEL: f64 = 0.01;

/// Sections up to these distances (mm) from each other tell one thing, not several: of the level, as what the model does not know
/// of a wall is alike along a stretch of it, and of the thickness, as they share voxels.
const SHARED: [f64; 2] = [5.0, 2.0];

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
    fn log_thickness_at(&self, level: f64) -> Level {
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

fn beforehand(lumen: &Ellipse) -> Level {
    let [share, deviation] = THICKNESS;
    [(share * (2.0 * lumen.mean).sqrt()).clamp(MIDDLE[0], MIDDLE[1]).ln(), deviation]
}

/// What all sections tell of the wall at each of them, by their arc lengths (mm). What they tell has a variance that is larger
/// by `inflation` than that of independent noise.
pub fn pooled(at: &[f64], fits: &[Option<Fit>], known: &KnownWall, inflation: f64) -> Vec<KnownWall> {
    let [level_apart, apart] = SHARED.map(|length| independent(at, length) / inflation);
    let walls: Vec<(f64, Ellipse, Wall)> = at
        .iter()
        .zip(fits)
        .filter_map(|(at, fit)| fit.and_then(|fit| Some((*at, fit.ellipse, fit.wall?))))
        .collect();
    let mut level = Told::new(known.level);
    for (_, _, wall) in &walls {
        level.add(wall.level, known.level, level_apart);
    }
    let [mean, deviation] = level.level();
    let level = [mean, deviation.max(LEAST_LEVEL)];
    let thickness = |here: f64, lumen: &Ellipse| {
        let first = beforehand(lumen);
        let mut told = Told::new(first);
        let (mut slopes, mut shares) = (0.0, f64::MIN_POSITIVE);
        for (there, other, wall) in &walls {
            let weight = (-(there - here).abs() / EVEN.0).exp() * apart;
            // What is told is by how much the wall is thicker than the width of its own lumen says.
            let [mean, deviation] = wall.log_thickness_at(level[0]);
            told.add([mean - beforehand(other)[0] + first[0], deviation], first, weight);
            let share = weight / deviation.powi(2);
            (slopes, shares) = (slopes + share * wall.slope, shares + share);
        }
        let [mean, deviation] = told.level();
        ([mean, deviation.max(EVEN.1)], slopes / shares)
    };
    at.iter()
        .zip(fits)
        .map(|(at, fit)| {
            let told = fit.map(|fit| thickness(*at, &fit.ellipse));
            let slope = told.map_or(0.0, |(_, slope)| slope);
            KnownWall { level, log_thickness: told.map(|(thickness, _)| thickness), slope }
        })
        .collect()
}

/// Whether a wall is told apart from what surrounds the vessel: where it is as bright, nothing shows where it ends.
pub fn is_apart(known: &KnownWall, pooled: &[KnownWall], fits: &[Option<Fit>]) -> bool {
    let is_apart = |(wall, fit): (&KnownWall, &Option<Fit>)| {
        fit.map(|fit| (wall.level[0] - fit.background).abs() > known.level[1])
    };
    let all: Vec<bool> = pooled.iter().zip(fits).filter_map(is_apart).collect();
    all.iter().filter(|is| **is).count() as f64 >= APART * all.len() as f64
}

/// The share of a section that its neighbours do not tell as well.
fn independent(at: &[f64], shared: f64) -> f64 {
    let length = at.last().zip(at.first()).map_or(0.0, |(last, first)| last - first);
    let step = length / (at.len().max(2) - 1) as f64;
    (step / shared).min(1.0)
}

/// Means and precisions that are added up.
struct Told {
    precision: f64,
    weighted: f64,
}

impl Told {
    fn new([mean, deviation]: Level) -> Self {
        let precision = 1.0 / (deviation * deviation);
        Self { precision, weighted: mean * precision }
    }

    /// Adds what a section told beyond what was known before, as the share `weight`.
    fn add(&mut self, told: Level, before: Level, weight: f64) {
        let [after, prior] = [told, before].map(Self::new);
        let precision = (after.precision - prior.precision).max(0.0);
        if precision > 0.0 {
            self.precision += weight * precision;
            self.weighted += weight * (after.weighted - prior.weighted);
        }
    }

    fn level(&self) -> Level {
        [self.weighted / self.precision, (1.0 / self.precision).sqrt()]
    }
}
