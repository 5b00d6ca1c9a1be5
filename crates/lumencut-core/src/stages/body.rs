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
const COLOR: [f32; 3] = [150.0 / 255.0, 160.0 / 255.0, 175.0 / 255.0];
/// Opacities: of the body everywhere, of the glow along its border, and of the border's line.
const EVERYWHERE: f32 = 0.05;
const GLOW: f32 = 0.13;
const LINE: f32 = 0.16;
/// The glow falls to 1/e over this distance (mm).
const GLOW_MM: f32 = 8.0;
/// Width of the line (pixels).
const LINE_PIXELS: f64 = 2.5;
/// Towards a face of the volume that cuts the body, the outline fades over this distance (mm).
const CUT_FADE_MM: f32 = 30.0;
/// Beyond this distance (mm) everything is as at this distance.
const FARTHEST_MM: f32 = 60.0;
/// A cell of the body covers this many of its sides around its centre.
const COVERED: f32 = 0.75;

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
        let side = body.side.max(2.0 * spacing);
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
        let per_mm = 1.0 / f64::from(self.side);
        for cell in &body.cells {
            let place = camera.view_from_world(cell.place);
            let [x, y] = [half[0] + place.x, half[1] - place.y].map(|mm| mm * per_mm + margin);
            if x < 1.0 || y < 1.0 || x >= columns as f64 - 2.0 || y >= rows as f64 - 2.0 {
                continue;
            }
            let (left, top) = (x as usize - 1, y as usize - 1);
            for (j, i) in (top..top + 4).flat_map(|j| (left..left + 4).map(move |i| (j, i))) {
                let (Some(dx), Some(dy)) = (self.within(i, 0, x), self.within(j, 1, y)) else { continue };
                let inside = COVERED * self.side - (dx * dx + dy * dy).sqrt();
                let node = j * columns + i;
                covered[node] = larger(covered[node], inside);
                is_cut[node] |= cell.is_cut && inside > -0.5 * self.side;
            }
        }
        (covered, is_cut)
    }

    /// The distance (mm) of a node from a place along an axis; `None` beyond the grid.
    #[inline(always)]
    fn within(&self, node: usize, axis: usize, place: f64) -> Option<f32> {
        (node < self.size[axis]).then(|| (node as f64 - place) as f32 * self.side)
    }

    fn nodes(&self, covered: &[f32], is_cut: &[bool]) -> Vec<[f32; 2]> {
        let is_border = |node: usize| covered[node] > 0.0 && self.around(node).any(|n| covered[n] <= 0.0);
        let mut depth: Vec<f32> =
            covered.iter().map(|mm| if *mm > 0.0 { FARTHEST_MM } else { 0.0 }).collect();
        let mut from_cut = vec![FARTHEST_MM; covered.len()];
        for node in (0..covered.len()).filter(|node| is_border(*node)) {
            depth[node] = covered[node];
            if is_cut[node] {
                from_cut[node] = 0.0;
            }
        }
        self.spread(&mut depth);
        self.spread(&mut from_cut);
        let node = |n: usize| {
            let distance = if covered[n] > 0.0 { depth[n] } else { covered[n] };
            [distance, smaller(larger(from_cut[n] - 2.0 * self.side, 0.0) / CUT_FADE_MM, 1.0)]
        };
        (0..covered.len()).map(node).collect()
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
