//! The three workloads: size, content and painting.

use glam::DVec3;
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::stop::Stop;

use crate::Phantom;
use crate::anatomy::{self, Anatomy};
use crate::paint::{Grid, Scene};

/// Noise of the workloads (standard deviation, HU).
const NOISE: f32 = 14.0;

/// A workload at scale 1.
pub struct Workload {
    name: &'static str,
    size: [usize; 3],
    spacing: DVec3,
    /// Lowest corner of the first voxel (mm, LPS).
    corner: DVec3,
    segments: usize,
    anatomy: fn(u64, usize) -> Anatomy,
}

/// Abdominal aorta with coeliac, mesenteric, renal and iliac arteries: 512×512×256 voxels of 0.75×0.75×1 mm, about
/// 800 segments. `seed` varies bends, calcifications and noise; `scale` multiplies the voxels along each axis in the
/// same field of view. Fails with [`ErrorKind::Settings`] for a scale outside [0.02, 2].
pub fn aorta(seed: u64, scale: f64) -> Result<Phantom> {
    AORTA.make(seed, scale, &|| false)
}

/// Leg arteries from the abdominal aorta to the feet, with a femoro-femoral bypass around an occlusive left iliac stenosis, which
/// closes a cycle: 512×512×1305 voxels of 0.75×0.75×1 mm, about 2,200 segments. Parameters as for [`aorta`].
pub fn runoff(seed: u64, scale: f64) -> Result<Phantom> {
    RUNOFF.make(seed, scale, &|| false)
}

/// Arteries from the aortic arch to the circle of Willis; both vertebral arteries join in the basilar: 512×512×575 voxels of
/// 0.75×0.75×0.7 mm, about 1,100 segments. Parameters as for [`aorta`].
pub fn cervical(seed: u64, scale: f64) -> Result<Phantom> {
    CERVICAL.make(seed, scale, &|| false)
}

/// The workload of [`aorta`].
pub const AORTA: Workload = Workload {
    name: "aorta",
    size: [512, 512, 256],
    spacing: DVec3::new(0.75, 0.75, 1.0),
    corner: DVec3::new(-192.0, -192.0, -128.0),
    segments: 800,
    anatomy: anatomy::abdomen,
};

/// The workload of [`runoff`].
pub const RUNOFF: Workload = Workload {
    name: "runoff",
    size: [512, 512, 1305],
    spacing: DVec3::new(0.75, 0.75, 1.0),
    corner: DVec3::new(-192.0, -192.0, -1135.0),
    segments: 2200,
    anatomy: anatomy::lower_extremities,
};

/// The workload of [`cervical`].
pub const CERVICAL: Workload = Workload {
    name: "cervical",
    size: [512, 512, 575],
    spacing: DVec3::new(0.75, 0.75, 0.7),
    corner: DVec3::new(-192.0, -192.0, -75.0),
    segments: 1100,
    anatomy: anatomy::neck,
};

impl Workload {
    /// The phantom; `seed` and `scale` as for [`aorta`].
    pub fn make(&self, seed: u64, scale: f64, stop: Stop) -> Result<Phantom> {
        let grid = self.grid(scale)?;
        let Anatomy { vasculature, solids, background } = (self.anatomy)(seed, self.segments);
        let scene = Scene { solids, background, seed, noise: NOISE, ..Scene::default() };
        Phantom::of(self.name, (&grid, &scene), vasculature, stop)
    }

    /// The voxel grid of the same field of view, with `scale` times as many voxels along each axis.
    fn grid(&self, scale: f64) -> Result<Grid> {
        if !(0.02..=2.0).contains(&scale) {
            let found = format!("{scale}");
            return Err(Error::new(ErrorKind::Settings, "scale", found, "between 0.02 and 2"));
        }
        let size = self.size.map(|n| (n as f64 * scale).round().max(1.0) as usize);
        let count = |size: [usize; 3]| DVec3::from_array(size.map(|n| n as f64));
        let spacing = self.spacing * count(self.size) / count(size);
        Ok(Grid { size, spacing, origin: self.corner + spacing / 2.0 })
    }
}
