//! Values along rays from the centre of a section. They show the edge of the lumen, and obstacles.

use std::f64::consts::TAU;
use std::sync::LazyLock;

use glam::{DVec2, DVec3};

use super::SectionPlane;
use super::scale::Scale;
use crate::voxels::Voxels;
use lumencut_core::math::lanes::FAN;

/// Number of rays of a section, and of points of a contour.
pub(crate) const RAYS: usize = 64;

/// Sampling distance along a ray, in units of [`Voxels::sampling_side`].
const SAMPLE: f64 = 0.4;

/// What a ray meets. Distances are measured from its start (mm).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray {
    /// Edge of the lumen; None if the ray does not reach it.
    pub edge: Option<f64>,
    /// Distance at which a neighbour, calcium or metal starts; infinite if there is none.
    pub limit: f64,
    /// Distance at which material too bright for lumen starts, if any.
    pub(crate) bright_at: Option<f64>,
    /// Largest value in the millimetre after `bright_at` (fraction of the contrast); 0 if nothing is too bright.
    pub brightest: f64,
    /// Distances at which the values rise above, and fall below, the mean of lumen level and `brightest`.
    pub rim: [f64; 2],
    /// Distance at which the ray leaves the volume, if it does.
    pub(crate) outside_at: Option<f64>,
}

impl Ray {
    pub(crate) fn end(&self) -> Option<f64> {
        self.edge.or(self.bright_at)
    }
}

/// Parameters of a search along a ray; levels are fractions of the contrast.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Look {
    /// Intensity levels of the lumen and of the surroundings.
    pub levels: [f64; 2],
    /// Values above this are too bright for lumen.
    pub bright: f64,
    /// Values that rise by this amount mark the start of a neighbour.
    pub rise: f64,
    /// Maximum distance at which the edge is searched (mm).
    pub reach: f64,
    /// Maximum distance beyond the edge at which obstacles are searched (mm).
    pub beyond: f64,
}

pub(crate) fn direction(ray: usize) -> DVec2 {
    static ALL: LazyLock<[DVec2; RAYS]> =
        LazyLock::new(|| std::array::from_fn(|n| DVec2::from_angle(TAU * n as f64 / RAYS as f64)));
    ALL[ray]
}

pub(crate) struct Rays<'a, 'v> {
    pub voxels: &'a Voxels<'v>,
    pub scale: Scale,
}

impl Rays<'_, '_> {
    /// Value at a point of a plane, as a fraction of the contrast; NaN outside the volume.
    pub(crate) fn at(&self, place: &SectionPlane, point: DVec2) -> f64 {
        self.scale.share(f64::from(self.voxels.at(place.point(point))))
    }

    pub(crate) fn step(&self) -> f64 {
        SAMPLE * self.voxels.sampling_side
    }

    pub(crate) fn ray(&self, place: &SectionPlane, center: DVec2, direction: DVec2, look: &Look) -> Ray {
        let mut samples = Samples::new(self, place, center, direction);
        let half = f64::midpoint(look.levels[0], look.levels[1]);
        let mut ray = Ray {
            edge: None,
            limit: f64::INFINITY,
            bright_at: None,
            brightest: 0.0,
            rim: [0.0; 2],
            outside_at: None,
        };
        let (mut lowest, mut valley, mut before) = (f64::INFINITY, 0, f64::NAN);
        for n in 0.. {
            let here = n as f64 * self.step();
            if here > ray.edge.map_or(look.reach, |edge| edge + look.beyond) {
                break;
            }
            let value = samples.at(n);
            if value.is_nan() {
                ray.outside_at = Some(here);
                break;
            }
            // Two consecutive samples must be bright, because noise rarely exceeds the limit twice in a row.
            if value > look.bright && samples.at(n + 1) > look.bright {
                ray.bright_at = Some(here);
                let last = n + (1.0 / self.step()).ceil() as usize;
                ray.brightest = (n..=last).map(|m| samples.at(m)).fold(value, f64::max);
                ray.rim = rim(&mut samples, n, f64::midpoint(look.levels[0], ray.brightest));
                ray.limit = if ray.edge.is_some() { valley as f64 * self.step() } else { here };
                break;
            }
            if ray.edge.is_none() && value < half {
                let share = if n > 0 { (value - half) / (value - before) } else { 0.0 };
                ray.edge = Some((here - share.clamp(0.0, 1.0) * self.step()).max(0.0));
            }
            if ray.edge.is_some() {
                if value < lowest {
                    (lowest, valley) = (value, n);
                } else if value > lowest + look.rise {
                    ray.limit = valley as f64 * self.step();
                    break;
                }
            }
            before = value;
        }
        ray
    }

    pub(crate) fn all(&self, place: &SectionPlane, center: DVec2, look: &Look) -> Vec<Ray> {
        (0..RAYS).map(|n| self.ray(place, center, direction(n), look)).collect()
    }
}

/// Distances (mm) at which a ray rises above `level` and falls below it again, searched from sample `first`.
fn rim(samples: &mut Samples, first: usize, level: f64) -> [f64; 2] {
    const FAR: usize = 24;
    let mut crossing = |from: usize, rises: bool| {
        let is_beyond = |value: f64| (value > level) == rises;
        let n = (from..from + FAR).find(|n| is_beyond(samples.at(*n))).unwrap_or(from + FAR);
        let [before, here] = [n.saturating_sub(1), n].map(|m| samples.at(m));
        let share = if is_beyond(before) { 1.0 } else { (level - before) / (here - before) };
        (n, (n as f64 - 1.0 + share.clamp(0.0, 1.0)) * samples.rays.step())
    };
    let (inner, begins) = crossing(first, true);
    [begins.max(0.0), crossing(inner, false).1]
}

/// Samples of a ray as fractions of the contrast, read on demand; NaN outside the volume.
struct Samples<'a, 'v> {
    rays: &'a Rays<'a, 'v>,
    start: DVec3,
    stride: DVec3,
    values: Vec<f32>,
}

impl<'a, 'v> Samples<'a, 'v> {
    fn new(rays: &'a Rays<'a, 'v>, place: &SectionPlane, center: DVec2, direction: DVec2) -> Self {
        let index = &rays.voxels.index_from_world;
        let start = index.transform_point3(place.point(center));
        let stride = index.transform_vector3(place.point(direction) - place.origin) * rays.step();
        Self { rays, start, stride, values: Vec::with_capacity(2 * FAN) }
    }

    fn at(&mut self, n: usize) -> f64 {
        while n >= self.values.len() {
            self.rays.voxels.along(self.start, self.stride, &mut self.values);
        }
        self.rays.scale.share(f64::from(self.values[n]))
    }
}
