//! The CT values (HU) of solids.

use glam::Vec2;

use crate::random::{SmoothNoise, hash, smooth_step};
use crate::shape::Shape;

pub(crate) const AIR: f32 = -1000.0;
pub(crate) const FAT: f32 = -100.0;
pub(crate) const MUSCLE: f32 = 55.0;
pub(crate) const LUMEN: f32 = 350.0;
pub(crate) const VESSEL_WALL: f32 = 60.0;
pub(crate) const SOFT_PLAQUE: f32 = 40.0;
pub(crate) const CALCIUM: f32 = 1000.0;
const CORTICAL_BONE: f32 = 900.0;

#[derive(Clone, Copy, Debug)]
pub(crate) enum Tissue {
    Even(f32),
    Mottled(f32, f32),
    Fat,
    Muscle,
    /// Mesenteric fat with bowel loops, some with gas.
    Bowel,
    /// Marrow (HU) inside a cortex (mm thick).
    Bone {
        cortex: f32,
        marrow: f32,
    },
    /// An organ with a rim (mm thick) that takes up more contrast medium.
    Rim {
        width: f32,
        rim: f32,
        core: f32,
    },
    Lung,
}

pub(crate) struct Patterns {
    loops: SmoothNoise,
    seams: SmoothNoise,
    fine: SmoothNoise,
}

impl Patterns {
    /// The patterns at height `z` over the rectangle from `low` to `high` (mm).
    pub(crate) fn new(seed: u64, z: f32, low: Vec2, high: Vec2) -> Self {
        let noise = |n: u64, wavelength: f32, wavelength_z: f32| {
            SmoothNoise::new(hash(seed, n), wavelength, wavelength_z, z, low.to_array(), high.to_array())
        };
        Self { loops: noise(1, 26.0, 22.0), seams: noise(2, 24.0, 90.0), fine: noise(3, 4.5, 6.0) }
    }
}

impl Tissue {
    /// The value (HU) at (x, y); `distance` is the signed distance from the surface of the solid (mm, negative inside).
    #[inline(always)]
    pub(crate) fn hu(self, distance: f32, x: f32, y: f32, patterns: &Patterns) -> f32 {
        match self {
            Tissue::Even(hu) => hu,
            Tissue::Mottled(hu, by) => hu + by * (2.0 * patterns.fine.at(x, y) - 1.0),
            Tissue::Fat => {
                let strand =
                    (patterns.fine.at(x, y) - 0.5).abs() + 3.0 * (patterns.seams.at(x, y) - 0.5).abs();
                mix(FAT - 4.0, FAT + 70.0, smooth_step(1.0 - strand / 0.16))
            }
            Tissue::Muscle => {
                let seam = (patterns.seams.at(x, y) - 0.5).abs() / 0.035;
                let grain = 14.0 * (patterns.fine.at(x, y) - 0.5);
                // The seams in muscle fade in and out, like the planes between real muscles.
                let faded = smooth_step((patterns.loops.at(x, y) - 0.3) / 0.35);
                let seam = 1.0 - faded * (1.0 - smooth_step(seam));
                mix(FAT + 25.0, MUSCLE + grain, seam)
            }
            Tissue::Bowel => bowel(patterns.loops.at(x, y), patterns.fine.at(x, y)),
            Tissue::Bone { cortex, marrow } => {
                let trabeculae = 0.45 * marrow * (patterns.fine.at(x, y) - 0.5);
                mix(CORTICAL_BONE, marrow + trabeculae, smooth_step((-distance - cortex) / 1.2 + 0.5))
            }
            Tissue::Rim { width, rim, core } => {
                let depth = -distance + 5.0 * (patterns.loops.at(x, y) - 0.5);
                mix(rim, core, smooth_step((depth - width) / 2.0))
            }
            Tissue::Lung => {
                let vessel = smooth_step((patterns.fine.at(x, y) - 0.78) / 0.1);
                mix(-860.0, -250.0, vessel)
            }
        }
    }
}

/// The value of bowel (HU): loops are where the pattern `n` is high, and gas is where it is highest.
#[inline(always)]
fn bowel(n: f32, fine: f32) -> f32 {
    let fat = FAT - 5.0 + 10.0 * fine;
    let content = 25.0 + 30.0 * fine;
    let wall = mix(fat, 70.0, smooth_step((n - 0.42) / 0.03));
    let filled = mix(wall, content, smooth_step((n - 0.49) / 0.04));
    mix(filled, AIR, smooth_step((n - 0.84) / 0.03))
}

/// Linear interpolation from `a` (t = 0) to `b` (t = 1).
#[inline(always)]
pub(crate) fn mix(a: f32, b: f32, t: f32) -> f32 {
    a + t * (b - a)
}

/// One organ: shapes that blend softly, shrunk by `inset` mm.
#[derive(Clone, Debug)]
pub(crate) struct Solid {
    pub(crate) shapes: Vec<Shape>,
    pub(crate) inset: f32,
    pub(crate) tissue: Tissue,
}

impl Solid {
    pub(crate) fn new(tissue: Tissue, shapes: Vec<Shape>) -> Self {
        Self { shapes, inset: 0.0, tissue }
    }

    /// The same shapes, shrunk by `inset` mm, with another filling.
    pub(crate) fn within(shapes: &[Shape], inset: f32, tissue: Tissue) -> Self {
        Self { shapes: shapes.to_vec(), inset, tissue }
    }
}
