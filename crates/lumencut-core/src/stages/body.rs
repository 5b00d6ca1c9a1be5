//! The body: its outline behind the context, faint and the same however dark the body is in the transfer function.

use bytemuck::{Pod, Zeroable};
use rayon::prelude::*;

use super::{Image, Work};
use crate::camera::Camera;
use crate::error::Result;
use crate::math::body::Body;
use crate::math::lanes::{larger, smaller};
use crate::math::ray::NONE;
use crate::math::thickness::one_minus_power_of_two;

/// Colour of the body, red, green and blue, 0 to 1.
pub const COLOR: [f32; 3] = [150.0 / 255.0, 160.0 / 255.0, 175.0 / 255.0];
/// Opacities: of the body everywhere, of the glow along its border, and of the border's line.
pub const EVERYWHERE: f32 = 0.05;
pub const GLOW: f32 = 0.13;
pub const LINE: f32 = 0.16;
/// The glow falls to 1/e over this distance (mm).
pub const GLOW_MM: f32 = 8.0;
/// Width of the line (pixels).
const LINE_PIXELS: f64 = 2.5;
/// Towards a face of the volume that cuts the body, the outline fades over this distance (mm).
const CUT_FADE_MM: f32 = 30.0;
/// Beyond this distance (mm) everything is as at this distance.
const FARTHEST_MM: f32 = 60.0;
/// A cell of the body covers this many of its sides around its centre.
const COVERED: f32 = 0.75;
/// Least distance of nodes (pixels); the border between them is interpolated.
const NODE_PIXELS: f64 = 4.0;

/// A coarse grid over the view, with two numbers for each node: the signed distance from the border of the body (mm,
/// positive within) and the share of the outline that is shown.
#[derive(Clone, Debug)]
pub struct Outline {
    pub parameters: BodyParameters,
    pub nodes: Vec<[f32; 2]>,
}

#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct BodyParameters {
    /// Number of columns and rows of nodes.
    pub size: [u32; 2],
    /// Node that the centre of the first pixel meets, and nodes per pixel.
    pub first: f32,
    pub per_pixel: f32,
    /// 1 / width of the line (per mm).
    pub per_line: f32,
    pub padding: f32,
}

impl Outline {
    pub fn new(body: &Body, camera: &Camera) -> Self {
        let spacing = camera.pixel_spacing();
        let side = body.side.max(NODE_PIXELS * spacing);
        // Beyond the view, so that distances in it are right.
        let margin = (f64::from(FARTHEST_MM) / side).ceil();
        let nodes = |n: usize| (n as f64 * spacing / side).ceil() as usize + 1 + 2 * margin as usize;
        let size = camera.size().map(nodes);
        let parameters = BodyParameters {
            size: size.map(|n| n as u32),
            first: (margin + 0.5 * spacing / side) as f32,
            per_pixel: (spacing / side) as f32,
            per_line: (1.0 / (LINE_PIXELS * spacing)) as f32,
            padding: 0.0,
        };
        let raster = Raster { size, side: side as f32 };
        let (covered, is_cut) = raster.cover(body, camera, margin);
        Self { parameters, nodes: raster.nodes(&covered, &is_cut) }
    }
}

struct Raster {
    size: [usize; 2],
    side: f32,
}

impl Raster {
    /// How far each node lies within the nearest cell (mm), and whether a cell there is cut by a face of the volume.
    fn cover(&self, body: &Body, camera: &Camera, margin: f64) -> (Vec<f32>, Vec<bool>) {
        let [columns, rows] = self.size;
        let mut covered = vec![-FARTHEST_MM; columns * rows];
        let mut is_cut = vec![false; columns * rows];
        let half = camera.size().map(|n| n as f64 * camera.pixel_spacing() / 2.0);
        let (per_mm, radius) = (1.0 / f64::from(self.side), COVERED * body.side as f32);
        for cell in &body.cells {
            let place = camera.view_from_world(cell.place);
            let [x, y] = [half[0] + place.x, half[1] - place.y].map(|mm| mm * per_mm + margin);
            if x < 0.0 || y < 0.0 || x >= columns as f64 - 1.0 || y >= rows as f64 - 1.0 {
                continue;
            }
            let (left, top) = (x as usize, y as usize);
            for (j, i) in [(top, left), (top, left + 1), (top + 1, left), (top + 1, left + 1)] {
                let [dx, dy] = [i as f64 - x, j as f64 - y].map(|nodes| nodes as f32 * self.side);
                let inside = radius - (dx * dx + dy * dy).sqrt();
                let node = j * columns + i;
                covered[node] = larger(covered[node], inside);
                is_cut[node] |= cell.is_cut;
            }
        }
        (covered, is_cut)
    }

    fn nodes(&self, covered: &[f32], is_cut: &[bool]) -> Vec<[f32; 2]> {
        let is_border = |node: usize| covered[node] > 0.0 && self.around(node).any(|n| covered[n] <= 0.0);
        let mut outside: Vec<f32> = covered.iter().map(|mm| -mm).collect();
        let mut inside: Vec<f32> =
            covered.iter().map(|mm| if *mm > 0.0 { FARTHEST_MM } else { 0.0 }).collect();
        let mut from_cut = vec![FARTHEST_MM; covered.len()];
        for node in (0..covered.len()).filter(|node| is_border(*node)) {
            inside[node] = covered[node];
            if is_cut[node] {
                from_cut[node] = 0.0;
            }
        }
        [&mut outside, &mut inside, &mut from_cut].into_iter().for_each(|numbers| self.spread(numbers));
        let signed = |n: usize| if covered[n] > 0.0 { inside[n] } else { -outside[n] };
        let smooth = self.smoothed(&(0..covered.len()).map(signed).collect::<Vec<_>>());
        let share = |mm: f32| smaller(larger(mm - 2.0 * self.side, 0.0) / CUT_FADE_MM, 1.0);
        smooth.into_iter().zip(from_cut).map(|(inside, from_cut)| [inside, share(from_cut)]).collect()
    }

    /// Means over 3 × 3 nodes with binomial weights: single cells no longer show in the border.
    fn smoothed(&self, numbers: &[f32]) -> Vec<f32> {
        let along = |numbers: &[f32], stride: usize, is_end: &dyn Fn(usize) -> bool| -> Vec<f32> {
            let mean = |n: usize| {
                let middle = numbers[n];
                if is_end(n) {
                    middle
                } else {
                    0.25 * (numbers[n - stride] + numbers[n + stride]) + 0.5 * middle
                }
            };
            (0..numbers.len()).map(mean).collect()
        };
        let [columns, rows] = self.size;
        let across = along(numbers, 1, &|n| n % columns == 0 || n % columns == columns - 1);
        along(&across, columns, &|n| n / columns == 0 || n / columns == rows - 1)
    }

    /// The nodes to the left and right, above and below.
    fn around(&self, node: usize) -> impl Iterator<Item = usize> {
        let [columns, rows] = self.size;
        let (i, j) = (node % columns, node / columns);
        let all = [
            (i > 0).then(|| node - 1),
            (i + 1 < columns).then(|| node + 1),
            (j > 0).then(|| node - columns),
            (j + 1 < rows).then(|| node + columns),
        ];
        all.into_iter().flatten()
    }

    /// Lowers each number to that of any other node plus their distance (mm), along steps to eight neighbours.
    fn spread(&self, numbers: &mut [f32]) {
        let [columns, rows] = self.size;
        let steps = [(-1isize, 0isize), (-1, -1), (0, -1), (1, -1)];
        for sign in [1, -1] {
            for n in 0..numbers.len() {
                let node = if sign > 0 { n } else { numbers.len() - 1 - n };
                for (di, dj) in steps {
                    let (i, j) =
                        ((node % columns) as isize + sign * di, (node / columns) as isize + sign * dj);
                    if i >= 0 && j >= 0 && i < columns as isize && j < rows as isize {
                        let length = self.side * ((di * di + dj * dj) as f32).sqrt();
                        let from = numbers[j as usize * columns + i as usize] + length;
                        numbers[node] = smaller(numbers[node], from);
                    }
                }
            }
        }
    }
}

/// Puts the outline behind the context, where rays start.
pub fn body(work: &Work, outline: &Outline, start: &[f32], pixels: &mut [[f32; 4]]) -> Result<()> {
    work.expect_whole(Image::Start, start);
    work.expect_whole(Image::Gathered, pixels);
    let (chunk, width) = (work.tile_row(), work.size[0]);
    pixels.par_chunks_mut(chunk).zip(start.par_chunks(chunk)).enumerate().try_for_each(
        |(row, (pixels, start))| {
            work.begin(pixels.len())?;
            for (n, (pixel, start)) in (row * chunk..).zip(pixels.iter_mut().zip(start)) {
                if *start < NONE {
                    let opacity = outline.opacity([n % width, n / width]);
                    let through = (1.0 - pixel[3]) * opacity;
                    for c in 0..3 {
                        pixel[c] += through * COLOR[c];
                    }
                    pixel[3] += through;
                }
            }
            Ok(())
        },
    )
}

impl Outline {
    fn opacity(&self, pixel: [usize; 2]) -> f32 {
        let BodyParameters { first, per_pixel, per_line, .. } = self.parameters;
        let columns = self.parameters.size[0] as usize;
        let place = pixel.map(|n| first + n as f32 * per_pixel);
        let (low, part) = (place.map(|p| p as usize), place.map(|p| p - p.floor()));
        let node = low[1] * columns + low[0];
        let [inside, share] = std::array::from_fn(|c| {
            let row =
                |node: usize| self.nodes[node][c] + part[0] * (self.nodes[node + 1][c] - self.nodes[node][c]);
            row(node) + part[1] * (row(node + columns) - row(node))
        });
        let body = smaller(larger(0.5 + inside * per_line, 0.0), 1.0);
        let glow = 1.0 - one_minus_power_of_two(-larger(inside, 0.0) / GLOW_MM * std::f32::consts::LOG2_E);
        share * (body * (EVERYWHERE + GLOW * glow) + LINE * 4.0 * body * (1.0 - body))
    }
}
