//! Silhouettes: lines where the depth jumps, or where it is steep, as in the paper (section 3.3.5).

use bytemuck::{Pod, Zeroable};
use rayon::prelude::*;

mod lines;

use self::lines::LeapLines;
use super::depth_filter::{DepthFilterParameters, depth_filter};
use super::{Image, Work};
use crate::camera::Camera;
use crate::error::Result;
use crate::math::lanes::{Kernel, ROWS, dispatch, smaller};
use crate::settings::Settings;

/// Weight of depth changes between the zones of two vessels, relative to those within a zone.
pub const ZONE_BORDER: f32 = 4.0;
/// Far larger than any squared slope.
pub const STEEPEST: f32 = 1e12;
/// Width of the line at a depth jump (mm), equal to the default wall around a lumen.
pub(crate) const LINE_WIDTH: f64 = 1.0;
/// Smallest width of the line at a depth jump (pixels); a narrower line would be invisible.
pub(crate) const NARROWEST_LINE: f64 = 0.5;
/// Largest width of the line at a depth jump (pixels), also in the closest view.
pub(crate) const WIDEST_LINE: f64 = 1.5;
/// A line covers no pixel farther than this from its depth jump (pixels): [`WIDEST_LINE`], rounded up.
pub(crate) const FARTHEST_LEAP: usize = 2;
const _: () = assert!(WIDEST_LINE <= FARTHEST_LEAP as f64);

#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct SilhouetteParameters {
    /// Factor from the sum with Sobel weights to a slope in mm per mm.
    pub per_slope: f32,
    /// The square of the slope at which a silhouette has half strength.
    pub half: f32,
    /// Width of the lines at depth jumps (pixels).
    pub line_width: f32,
}

impl SilhouetteParameters {
    /// Parameters for which a smooth surface looks the same at every zoom. The width of lines is constant in
    /// mm, within limits in pixels.
    pub fn new(settings: &Settings, camera: &Camera) -> Self {
        let slope = settings.silhouette_slope;
        let line_width = (LINE_WIDTH / camera.pixel_spacing()).clamp(NARROWEST_LINE, WIDEST_LINE);
        Self {
            per_slope: (1.0 / (8.0 * camera.pixel_spacing())) as f32,
            half: (slope * slope) as f32,
            line_width: line_width as f32,
        }
    }
}

/// Writes the strength of the silhouette, 0 to 1, at each pixel: the slope of the depth (Sobel, mm per mm),
/// raised at borders of influence zones, smoothed, and mapped by s / (s + half) after squaring both.
pub fn silhouette(
    work: &Work,
    parameters: &SilhouetteParameters,
    depth: &[f32],
    vessel: &[i32],
    strength: &mut [f32],
) -> Result<()> {
    work.expect_whole(Image::Depth, depth);
    work.expect_whole(Image::Vessel, vessel);
    work.expect_whole(Image::Strength, strength);
    let &SilhouetteParameters { per_slope, half, .. } = parameters;
    let (chunk, width) = (work.tile_row(), work.size[0]);
    let mut raised = vec![0.0; depth.len()];
    raised.par_chunks_mut(chunk).enumerate().try_for_each(|(row, raised)| {
        work.begin(raised.len())?;
        dispatch(work.isa, SlopeRows { depth, vessel, width, first: row * ROWS, per_slope, raised });
        Ok(())
    })?;
    depth_filter(work, &DepthFilterParameters::new(), &raised, None, strength)?;
    strength.par_chunks_mut(chunk).for_each(|slopes| dispatch(work.isa, Strength { slopes, half }));
    Ok(())
}

/// Writes the strength of the silhouette, 0 to 1, at each pixel: the share that lines of leaps cover. `value`
/// is the volume on the surface, NaN if a pixel shows nothing; a line in such a pixel moves to the other side
/// of its leap, unless that is lumen. Without values, every pixel counts as shown.
pub fn silhouette_of_leaps(
    work: &Work,
    parameters: &SilhouetteParameters,
    leap: &[u32],
    value: &[f32],
    strength: &mut [f32],
) -> Result<()> {
    work.expect_whole(Image::Leap, leap);
    if !value.is_empty() {
        work.expect_whole(Image::Value, value);
    }
    work.expect_whole(Image::Strength, strength);
    let lines = LeapLines::new(leap, value, work.size[0], parameters.line_width);
    strength.par_chunks_mut(work.size[0]).enumerate().try_for_each(|(row, strength)| {
        work.begin(strength.len())?;
        lines.fill_row(row, strength);
        Ok(())
    })
}

/// [`silhouette_of_leaps`] at some `pixels` alone, one strength for each.
pub fn silhouette_at(
    width: usize,
    parameters: &SilhouetteParameters,
    [leap, pixels]: [&[u32]; 2],
    value: &[f32],
    strength: &mut [f32],
) {
    let lines = LeapLines::new(leap, value, width, parameters.line_width);
    strength.par_iter_mut().zip(pixels).for_each(|(strength, pixel)| {
        let pixel = *pixel as usize;
        *strength = lines.cover([pixel % width, pixel / width].map(|n| n as isize));
    });
}

struct Strength<'a> {
    slopes: &'a mut [f32],
    half: f32,
}

impl Kernel for Strength<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        for s in self.slopes {
            let square = smaller(*s * *s, STEEPEST);
            *s = square / (square + self.half);
        }
    }
}

struct SlopeRows<'a> {
    depth: &'a [f32],
    vessel: &'a [i32],
    width: usize,
    first: usize,
    per_slope: f32,
    raised: &'a mut [f32],
}

impl Kernel for SlopeRows<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let width = self.width;
        let height = self.depth.len() / width;
        for (j, raised) in (self.first..).zip(self.raised.chunks_mut(width)) {
            let rows = [j.saturating_sub(1), j, (j + 1).min(height - 1)];
            let z = rows.map(|j| &self.depth[j * width..(j + 1) * width]);
            let v = rows.map(|j| &self.vessel[j * width..(j + 1) * width]);
            let inner = width.saturating_sub(2);
            // Neighbours in slices of one length, so that the loop vectorises.
            let [zl, zm, zr] = [0, 1, 2].map(|o| z.map(|row| row.get(o..o + inner).unwrap_or_default()));
            let [vl, vm, vr] = [0, 1, 2].map(|o| v.map(|row| row.get(o..o + inner).unwrap_or_default()));
            for i in 0..inner {
                let depths = [0, 1, 2].map(|r| [zl[r][i], zm[r][i], zr[r][i]]);
                let border = is_border(vm[1][i], [vl[1][i], vr[1][i], vm[0][i], vm[2][i]]);
                raised[i + 1] = raise(depths, border) * self.per_slope;
            }
            // At the first and the last column, the column itself replaces the missing neighbour.
            for i in [0, width - 1] {
                let (left, right) = (i.saturating_sub(1), (i + 1).min(width - 1));
                let depths = z.map(|row| [row[left], row[i], row[right]]);
                let border = is_border(v[1][i], [v[1][left], v[1][right], v[0][i], v[2][i]]);
                raised[i] = raise(depths, border) * self.per_slope;
            }
        }
    }
}

#[inline(always)]
fn is_border(here: i32, neighbours: [i32; 4]) -> bool {
    let [a, b, c, d] = neighbours.map(|n| n != here);
    (a | b) | (c | d)
}

/// The Sobel magnitude of a 3 × 3 neighbourhood (row by row), raised at borders of zones.
#[inline(always)]
fn raise(z: [[f32; 3]; 3], border: bool) -> f32 {
    let dx = (z[0][2] - z[0][0]) + 2.0 * (z[1][2] - z[1][0]) + (z[2][2] - z[2][0]);
    let dy = (z[2][0] - z[0][0]) + 2.0 * (z[2][1] - z[0][1]) + (z[2][2] - z[0][2]);
    (dx * dx + dy * dy).sqrt() * if border { ZONE_BORDER } else { 1.0 }
}
