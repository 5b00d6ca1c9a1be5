//! Paints solids and vessels into voxels, one slice per thread.

use glam::{DAffine3, DVec3, Vec2, Vec3};
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::stop::{Stop, go_on};
use rayon::prelude::*;

use crate::lesion::Rod;
use crate::network::{KnownVessel, Vasculature};
use crate::random::{hash, normal};
use crate::shape::{Cut, distance_to_line};
use crate::tissue::{AIR, CALCIUM, FAT, LUMEN, Patterns, SOFT_PLAQUE, Solid, VESSEL_WALL, mix};

#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    pub(crate) size: [usize; 3],
    pub(crate) spacing: DVec3,
    /// Centre of the first voxel (mm, LPS).
    pub(crate) origin: DVec3,
}

impl Grid {
    /// A grid of cubes that surrounds the walls of vessels by a margin (mm).
    pub(crate) fn around(vessels: &[KnownVessel], spacing: f64, margin: f64) -> Self {
        let (mut low, mut high) = (DVec3::MAX, DVec3::MIN);
        for vessel in vessels {
            for (n, point) in vessel.points.iter().enumerate() {
                let reach = vessel.reference[n] + vessel.wall[n] + margin;
                (low, high) = (low.min(point - reach), high.max(point + reach));
            }
        }
        let size = ((high - low) / spacing).ceil().to_array().map(|n| n as usize + 1);
        // The grid is centred, so that symmetric phantoms stay symmetric.
        let extent = DVec3::from_array(size.map(|n| (n - 1) as f64)) * spacing;
        Self { size, spacing: DVec3::splat(spacing), origin: (low + high - extent) / 2.0 }
    }

    pub(crate) fn world_from_index(&self) -> DAffine3 {
        DAffine3::from_scale_rotation_translation(self.spacing, glam::DQuat::IDENTITY, self.origin)
    }

    fn slice_length(&self) -> usize {
        self.size[0] * self.size[1]
    }
}

#[derive(Default)]
pub(crate) struct Scene {
    /// The solids in painting order: later ones cover earlier ones.
    pub(crate) solids: Vec<Solid>,
    pub(crate) background: f32,
    pub(crate) seed: u64,
    pub(crate) noise: f32,
    pub(crate) materials: Materials,
}

/// The values (HU) of the parts of vessels.
#[derive(Clone, Copy)]
pub(crate) struct Materials {
    pub(crate) wall: f32,
    pub(crate) plaque: f32,
    pub(crate) lumen: f32,
}

impl Default for Materials {
    fn default() -> Self {
        Self { wall: VESSEL_WALL, plaque: SOFT_PLAQUE, lumen: LUMEN }
    }
}

/// Signed distances to lumen, healthy lumen, outer wall and calcium (mm, negative inside).
type Layers = [f32; 4];

struct Stroke {
    ends: [Vec3; 2],
    radius: [Layers; 2],
}

const FAR: f32 = 1e6;

/// Within this distance (mm), the shapes of one solid blend into each other.
const SOFT_UNION: f32 = 3.0;

pub(crate) fn paint(grid: &Grid, scene: &Scene, vasculature: &Vasculature, stop: Stop) -> Result<Vec<i16>> {
    let strokes = strokes(vasculature);
    let painter = Painter::new(grid, scene, &strokes);
    let count = grid.slice_length() * grid.size[2];
    let mut voxels = Vec::new();
    if voxels.try_reserve_exact(count).is_err() {
        let found = format!("{} MB of voxels", (2 * count).div_ceil(1_000_000));
        let error =
            Error::new(ErrorKind::Volume, "size of the phantom", found, "no more than there is memory for");
        return Err(error.mend("make it at a smaller scale"));
    }
    for slices in 1..=grid.size[2] {
        go_on(stop)?;
        voxels.resize(slices * grid.slice_length(), 0i16);
    }
    voxels.par_chunks_mut(grid.slice_length()).enumerate().try_for_each_init(
        || Scratch::new(grid.slice_length()),
        |scratch, (k, slice)| {
            go_on(stop)?;
            painter.paint_slice(k, slice, scratch);
            Ok(())
        },
    )?;
    Ok(voxels)
}

struct Scratch {
    hu: Vec<f32>,
    distance: Vec<f32>,
    layers: Vec<Layers>,
}

impl Scratch {
    fn new(length: usize) -> Self {
        Self { hu: vec![0.0; length], distance: vec![FAR; length], layers: vec![[FAR; 4]; length] }
    }
}

struct Painter<'a> {
    grid: &'a Grid,
    scene: &'a Scene,
    strokes: &'a [Stroke],
    by_slice: Vec<Vec<u32>>,
    /// Width of the soft edge that imitates the partial volume effect (mm).
    edge: f32,
}

impl<'a> Painter<'a> {
    fn new(grid: &'a Grid, scene: &'a Scene, strokes: &'a [Stroke]) -> Self {
        let edge = grid.spacing.element_product().cbrt() as f32;
        let mut by_slice = vec![Vec::new(); grid.size[2]];
        for (n, stroke) in strokes.iter().enumerate() {
            let (low, high) = stroke.bounds(edge);
            let slice = |z: f32| (f64::from(z) - grid.origin.z) / grid.spacing.z;
            let first = slice(low.z).ceil().max(0.0) as usize;
            let end = (slice(high.z).floor() + 1.0).clamp(0.0, grid.size[2] as f64) as usize;
            for slice in by_slice.iter_mut().take(end).skip(first) {
                slice.push(n as u32);
            }
        }
        Self { grid, scene, strokes, by_slice, edge }
    }

    fn paint_slice(&self, k: usize, slice: &mut [i16], scratch: &mut Scratch) {
        let z = (self.grid.origin.z + self.grid.spacing.z * k as f64) as f32;
        let patterns = Patterns::new(self.scene.seed, z, self.place(0, 0), {
            self.place(self.grid.size[0] - 1, self.grid.size[1] - 1)
        });
        scratch.hu.fill(self.scene.background);
        for solid in &self.scene.solids {
            self.paint_solid(solid, z, &patterns, scratch);
        }
        self.paint_vessels(k, z, scratch);
        self.write(k, slice, &scratch.hu);
    }

    /// World x, y of the pixel (i, j) (mm).
    #[inline(always)]
    fn place(&self, i: usize, j: usize) -> Vec2 {
        let Grid { origin, spacing, .. } = self.grid;
        Vec2::new((origin.x + spacing.x * i as f64) as f32, (origin.y + spacing.y * j as f64) as f32)
    }

    /// Calls `visit` with the number and the world position of each pixel in a rectangle (mm).
    #[inline(always)]
    fn each_pixel(&self, [low, high]: [Vec2; 2], z: f32, mut visit: impl FnMut(usize, Vec3)) {
        let range = |axis: usize| {
            let index = |mm: f32| (f64::from(mm) - self.grid.origin[axis]) / self.grid.spacing[axis];
            let end = (index(high[axis]).floor() + 1.0).clamp(0.0, self.grid.size[axis] as f64) as usize;
            (index(low[axis]).ceil().max(0.0) as usize).min(end)..end
        };
        let columns = range(0);
        for j in range(1) {
            for i in columns.clone() {
                visit(j * self.grid.size[0] + i, self.place(i, j).extend(z));
            }
        }
    }

    fn paint_solid(&self, solid: &Solid, z: f32, patterns: &Patterns, scratch: &mut Scratch) {
        let reach = self.edge - solid.inset.min(0.0);
        let cuts: Vec<(Cut<'_>, [Vec2; 2])> = solid.shapes.iter().filter_map(|s| s.cut(z, reach)).collect();
        for (cut, rectangle) in &cuts {
            self.each_pixel(*rectangle, z, |n, p| {
                let known = scratch.distance[n];
                scratch.distance[n] = soft_minimum(known, cut.distance(p));
            });
        }
        for (_, rectangle) in &cuts {
            self.each_pixel(*rectangle, z, |n, p| {
                // Resets the distance, so that a pixel in several rectangles is painted only once.
                let distance = std::mem::replace(&mut scratch.distance[n], FAR) + solid.inset;
                let cover = self.cover(distance);
                if cover > 0.0 {
                    let hu = solid.tissue.hu(distance, p.x, p.y, patterns);
                    scratch.hu[n] = mix(scratch.hu[n], hu, cover);
                }
            });
        }
    }

    /// The fraction of a voxel inside a surface at signed distance `distance`.
    #[inline(always)]
    fn cover(&self, distance: f32) -> f32 {
        (0.5 - distance / self.edge).clamp(0.0, 1.0)
    }

    fn paint_vessels(&self, k: usize, z: f32, scratch: &mut Scratch) {
        let mine = || self.by_slice[k].iter().map(|n| &self.strokes[*n as usize]);
        let rectangle = |stroke: &Stroke| {
            let (low, high) = stroke.bounds(self.edge);
            [low.truncate(), high.truncate()]
        };
        for stroke in mine() {
            self.each_pixel(rectangle(stroke), z, |n, p| stroke.draw(p, &mut scratch.layers[n]));
        }
        for stroke in mine() {
            self.each_pixel(rectangle(stroke), z, |n, _| {
                let [lumen, healthy, outer, calcium] = std::mem::replace(&mut scratch.layers[n], [FAR; 4]);
                let Materials { wall, plaque, lumen: inside } = self.scene.materials;
                let layers = [(outer, wall), (healthy, plaque), (lumen, inside), (calcium, CALCIUM)];
                for (distance, hu) in layers {
                    scratch.hu[n] = mix(scratch.hu[n], hu, self.cover(distance));
                }
            });
        }
    }

    fn write(&self, k: usize, slice: &mut [i16], hu: &[f32]) {
        let seed = hash(self.scene.seed, 0xC0_FFEE + k as u64);
        for (n, (voxel, hu)) in slice.iter_mut().zip(hu).enumerate() {
            // In air, which absorbs little, CT images have less noise.
            let noise = if *hu < 5.0 * FAT { 0.6 * self.scene.noise } else { self.scene.noise };
            let noisy = hu + noise * normal(seed, n as u64);
            *voxel = noisy.round().clamp(AIR - 24.0, 3071.0) as i16;
        }
    }
}

impl Stroke {
    /// The bounding box of the stroke, enlarged by `reach` mm on all sides.
    fn bounds(&self, reach: f32) -> (Vec3, Vec3) {
        let radius = self.radius.as_flattened().iter().copied().fold(0.0, f32::max) + reach;
        let [a, b] = self.ends;
        (a.min(b) - radius, a.max(b) + radius)
    }

    #[inline(always)]
    fn draw(&self, p: Vec3, layers: &mut Layers) {
        let (d, t) = distance_to_line(p, self.ends[0], self.ends[1]);
        for (n, layer) in layers.iter_mut().enumerate() {
            *layer = layer.min(d - mix(self.radius[0][n], self.radius[1][n], t));
        }
    }
}

#[inline(always)]
fn soft_minimum(a: f32, b: f32) -> f32 {
    let overlap = (SOFT_UNION - (a - b).abs()).max(0.0) / SOFT_UNION;
    a.min(b) - 0.25 * SOFT_UNION * overlap * overlap
}

fn strokes(vasculature: &Vasculature) -> Vec<Stroke> {
    let segment = |vessel: &KnownVessel, i: usize| {
        let layers = |i: usize| {
            let [lumen, healthy] = [vessel.lumen[i], vessel.reference[i]];
            [lumen as f32, healthy as f32, (healthy + vessel.wall[i]) as f32, -FAR]
        };
        let ends = [vessel.points[i], vessel.points[i + 1]].map(|p| p.as_vec3());
        Stroke { ends, radius: [layers(i), layers(i + 1)] }
    };
    let vessels = &vasculature.vessels;
    let segments = vessels.iter().flat_map(|v| (0..v.points.len() - 1).map(move |i| segment(v, i)));
    let rod = |rod: &Rod| Stroke {
        ends: rod.ends.map(|p| p.as_vec3()),
        radius: rod.radius.map(|r| [-FAR, -FAR, -FAR, r as f32]),
    };
    segments.chain(vasculature.calcium.iter().map(rod)).collect()
}
