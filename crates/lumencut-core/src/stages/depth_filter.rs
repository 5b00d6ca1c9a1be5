//! The depth filter: a 7×7 Gaussian with σ = 2√(2 ln 2)/π pixels that smooths the steps of the pixel grid in
//! the cut surface (paper section 3.3.3), over the entire image or within influence zones.

use bytemuck::{Pod, Zeroable};
use rayon::prelude::*;

use super::{Image, Work};
use crate::error::Result;
use crate::math::lanes::{Kernel, ROWS, dispatch};
use crate::settings::Settings;

const HALF_WIDTH: usize = 3;
const SPAN: usize = 2 * HALF_WIDTH + 1;
/// The zone of pixels beyond the image, different from that of any vessel.
const OUTSIDE: i32 = i32::MIN;

#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct DepthFilterParameters {
    /// The weights of the Gaussian from the middle outwards; with both sides they sum to 1.
    pub weights: [f32; HALF_WIDTH + 1],
    /// Within zones, the largest accepted deviation of a pair of neighbours from a straight line (mm).
    pub leap: f32,
    pub padding: f32,
    pub more_padding: [f32; 2],
}

impl DepthFilterParameters {
    /// The Gaussian of the paper, over the entire image.
    pub fn new() -> Self {
        let sigma = 2.0 * (2.0 * 2f64.ln()).sqrt() / std::f64::consts::PI;
        let bell: [f64; HALF_WIDTH + 1] =
            std::array::from_fn(|n| (-((n * n) as f64) / (2.0 * sigma * sigma)).exp());
        let sum = bell[0] + 2.0 * bell[1..].iter().sum::<f64>();
        Self { weights: bell.map(|w| (w / sum) as f32), leap: 0.0, ..Self::zeroed() }
    }

    /// The Gaussian, with the `depth_leap` of these settings.
    pub fn of(settings: &Settings) -> Self {
        Self { leap: settings.depth_leap as f32, ..Self::new() }
    }
}

impl Default for DepthFilterParameters {
    fn default() -> Self {
        Self::new()
    }
}

/// Writes the smoothed `image`: extended by its border pixels, or filtered within the zones of `vessel`.
pub fn depth_filter(
    work: &Work,
    parameters: &DepthFilterParameters,
    image: &[f32],
    vessel: Option<&[i32]>,
    smoothed: &mut [f32],
) -> Result<()> {
    work.expect_whole(Image::UnfilteredDepth, image);
    if let Some(vessel) = vessel {
        work.expect_whole(Image::Vessel, vessel);
    }
    work.expect_whole(Image::Depth, smoothed);
    let Some(vessel) = vessel else { return gaussian(work, &parameters.weights, image, smoothed) };
    let width = work.size[0];
    smoothed.par_chunks_mut(work.tile_row()).enumerate().try_for_each(|(row, smoothed)| {
        work.begin(smoothed.len())?;
        dispatch(work.isa, ZoneRows { parameters, image, vessel, width, first: row * ROWS, smoothed });
        Ok(())
    })
}

/// Writes the image smoothed by a Gaussian with these weights, from the middle outwards; border pixels are repeated.
pub(super) fn gaussian(work: &Work, weights: &[f32], image: &[f32], smoothed: &mut [f32]) -> Result<()> {
    let width = work.size[0];
    smoothed.par_chunks_mut(work.tile_row()).enumerate().try_for_each(|(row, smoothed)| {
        work.begin(smoothed.len())?;
        dispatch(work.isa, FilterRows { image, width, first: row * ROWS, weights, smoothed });
        Ok(())
    })
}

struct FilterRows<'a> {
    image: &'a [f32],
    width: usize,
    first: usize,
    weights: &'a [f32],
    smoothed: &'a mut [f32],
}

impl Kernel for FilterRows<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let (width, weights) = (self.width, self.weights);
        let height = self.image.len() / width;
        let row = |j: usize| &self.image[j * width..(j + 1) * width];
        let half = weights.len() - 1;
        let mut padded = vec![0.0; width + 2 * half];
        for (j, smoothed) in (self.first..).zip(self.smoothed.chunks_mut(width)) {
            let middle = &mut padded[half..half + width];
            set(middle, weights[0], row(j));
            for n in 1..=half {
                add(middle, weights[n], row(j.saturating_sub(n)), row((j + n).min(height - 1)));
            }
            let (first, last) = (middle[0], middle[width - 1]);
            padded[..half].fill(first);
            padded[half + width..].fill(last);
            set(smoothed, weights[0], &padded[half..]);
            for n in 1..=half {
                add(smoothed, weights[n], &padded[half - n..], &padded[half + n..]);
            }
        }
    }
}

/// sum ← weight · image
#[inline(always)]
fn set(sum: &mut [f32], weight: f32, image: &[f32]) {
    for (sum, pixel) in sum.iter_mut().zip(image) {
        *sum = weight * pixel;
    }
}

/// sum ← sum + weight · (one + other)
#[inline(always)]
fn add(sum: &mut [f32], weight: f32, one: &[f32], other: &[f32]) {
    for ((sum, one), other) in sum.iter_mut().zip(one).zip(other) {
        *sum += weight * (one + other);
    }
}

struct ZoneRows<'a> {
    parameters: &'a DepthFilterParameters,
    image: &'a [f32],
    vessel: &'a [i32],
    width: usize,
    first: usize,
    smoothed: &'a mut [f32],
}

impl Kernel for ZoneRows<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let width = self.width;
        let height = self.image.len() / width;
        let outside = vec![OUTSIDE; width];
        // A row padded on both sides with pixels that belong to no zone.
        let (mut depths, mut zones) =
            (vec![0.0; width + 2 * HALF_WIDTH], vec![OUTSIDE; width + 2 * HALF_WIDTH]);
        for (j, smoothed) in (self.first..).zip(self.smoothed.chunks_mut(width)) {
            let row = |o: usize| (j + o).checked_sub(HALF_WIDTH).filter(|row| *row < height);
            let pixels = |row: usize| row * width..(row + 1) * width;
            let z = OFFSETS.map(|o| &self.image[pixels(row(o).unwrap_or(j))]);
            let zone = OFFSETS.map(|o| row(o).map_or(&outside[..], |row| &self.vessel[pixels(row)]));
            filter_within_zones(self.parameters, z, zone, &mut depths[HALF_WIDTH..HALF_WIDTH + width]);
            zones[HALF_WIDTH..HALF_WIDTH + width].copy_from_slice(&self.vessel[pixels(j)]);
            let (z, zone) = (OFFSETS.map(|o| &depths[o..]), OFFSETS.map(|o| &zones[o..]));
            filter_within_zones(self.parameters, z, zone, smoothed);
        }
    }
}

const OFFSETS: [usize; SPAN] = [0, 1, 2, 3, 4, 5, 6];

/// Filters a row of pixels along one axis, within zones. Entry n of `z` and `zone` is the row shifted by n −
/// `HALF_WIDTH` along that axis. A pair of neighbours counts if both, and all nearer pairs, are in the zone
/// of the middle pixel, and if the depth does not jump. Each pair adds its deviation from a straight line
/// through the middle. On a plane this is 0 up to the rounding of depths; if no pair counts, the middle is
/// unchanged. Each neighbour is subtracted from the middle separately: close numbers have an exact
/// difference, while a sum loses a digit. The middle always counts, so the sum of weights is never 0.
#[inline(always)]
fn filter_within_zones(
    parameters: &DepthFilterParameters,
    z: [&[f32]; SPAN],
    zone: [&[i32]; SPAN],
    filtered: &mut [f32],
) {
    let &DepthFilterParameters { weights: [w0, w1, w2, w3], leap, .. } = parameters;
    let width = filtered.len();
    // Slices of one length, no indices, and selecting numbers instead of branching let the loop vectorise.
    let [a3, a2, a1, z, b1, b2, b3] = z.map(|z| &z[..width]);
    let [u3, u2, u1, zone, v1, v2, v3] = zone.map(|zone| &zone[..width]);
    for i in 0..width {
        let (middle, own) = (z[i], zone[i]);
        let pairs = [
            (w1, [a1[i], b1[i]], [u1[i], v1[i]]),
            (w2, [a2[i], b2[i]], [u2[i], v2[i]]),
            (w3, [a3[i], b3[i]], [u3[i], v3[i]]),
        ];
        let (mut sum, mut weights, mut other_zone) = (0.0, w0, 0);
        for (weight, [a, b], [u, v]) in pairs {
            other_zone |= (u ^ own) | (v ^ own);
            let bend = (a - middle) + (b - middle);
            let counted = if (other_zone == 0) & (bend.abs() < leap) { weight } else { 0.0 };
            sum += counted * bend;
            weights += 2.0 * counted;
        }
        filtered[i] = middle + sum / weights;
    }
}
