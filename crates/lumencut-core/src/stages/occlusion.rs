//! Occlusion: how much deeper the cut surface lies than the depth around it, blurred at two scales. It darkens the
//! surface outside lumens and walls. After the unsharp masking of depth by Luft, Colditz and Deussen 2006.

use bytemuck::{Pod, Zeroable};
use rayon::prelude::*;

use super::depth_filter::gaussian;
use super::focus::{SHADE, Shares};
use super::{Image, Work};
use crate::camera::Camera;
use crate::error::Result;
use crate::math::lanes::{larger, smaller};

/// Standard deviations of the blurs (mm).
const SIGMAS_MM: [f64; 2] = [1.5, 6.0];
/// A blurred image is reduced until its standard deviation is below twice this (pixels).
const SIGMA_PIXELS: f64 = 2.0;
/// The largest number of weights on one side of a Gaussian, with the middle one.
const MAX_WEIGHTS: usize = 16;
/// A smaller difference of depth (mm) darkens nothing; this much more is the full scale (mm).
pub const FIRST_MM: f32 = 0.5;
pub const FULL_MM: f32 = 10.0;
/// Factor on the mean of both scales.
pub const GAIN: f32 = 1.6;

/// A blur of the depth, on a reduced image.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct Blur {
    /// The weights of a Gaussian from the middle outwards; with both sides they sum to 1.
    pub weights: [f32; MAX_WEIGHTS],
    /// Each pixel of the reduced image is the mean of a square of this side (pixels).
    pub side: u32,
    /// Number of weights on one side, without the middle one.
    pub reach: u32,
    pub padding: [u32; 2],
}

impl Blur {
    fn new(sigma: f64) -> Self {
        let side = (sigma / SIGMA_PIXELS).floor().max(1.0);
        let sigma = (sigma / side).max(1e-3);
        let reach = ((3.0 * sigma).ceil() as usize).min(MAX_WEIGHTS - 1);
        let bell = |n: usize| if n > reach { 0.0 } else { (-0.5 * (n as f64 / sigma).powi(2)).exp() };
        let sum = bell(0) + 2.0 * (1..=reach).map(bell).sum::<f64>();
        let weights = std::array::from_fn(|n| (bell(n) / sum) as f32);
        Self { weights, side: side as u32, reach: reach as u32, padding: [0; 2] }
    }

    /// Width and height of the reduced image.
    pub fn reduced(&self, size: [usize; 2]) -> [usize; 2] {
        size.map(|n| n.div_ceil(self.side as usize))
    }
}

#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct OcclusionParameters {
    pub blurs: [Blur; 2],
}

impl OcclusionParameters {
    pub fn new(camera: &Camera) -> Self {
        Self { blurs: SIGMAS_MM.map(|sigma| Blur::new(sigma / camera.pixel_spacing())) }
    }
}

/// Multiplies the share by which each pixel may be darkened by its occlusion, 0 to 1.
pub fn occlusion(
    work: &Work,
    parameters: &OcclusionParameters,
    depth: &[f32],
    shares: &mut [Shares],
) -> Result<()> {
    work.expect_whole(Image::Depth, depth);
    work.expect_whole(Image::Focus, shares);
    let [near, far] = parameters.blurs.each_ref().map(|blur| Blurred::new(work, blur, depth));
    let (near, far, width) = (near?, far?, work.size[0]);
    shares.par_chunks_mut(work.tile_row()).enumerate().try_for_each(|(row, shares)| {
        work.begin(shares.len())?;
        let first = row * work.tile_row();
        for (n, share) in (first..).zip(shares) {
            let behind = |around: &Blurred| {
                let deeper = depth[n] - around.at([n % width, n / width]) - FIRST_MM;
                smaller(larger(deeper / FULL_MM, 0.0), 1.0)
            };
            share[SHADE] *= smaller(GAIN * 0.5 * (behind(&near) + behind(&far)), 1.0);
        }
        Ok(())
    })
}

struct Blurred {
    side: f32,
    size: [usize; 2],
    depth: Vec<f32>,
}

impl Blurred {
    fn new(work: &Work, blur: &Blur, depth: &[f32]) -> Result<Self> {
        let (side, size) = (blur.side as usize, blur.reduced(work.size));
        let small = if side == 1 { None } else { Some(reduced(depth, work.size, side)) };
        let mut blurred = vec![0.0; size[0] * size[1]];
        let weights = &blur.weights[..=blur.reach as usize];
        let small_work = Work { size, progress: None, ..*work };
        gaussian(&small_work, weights, small.as_deref().unwrap_or(depth), &mut blurred)?;
        Ok(Self { side: side as f32, size, depth: blurred })
    }

    /// The depth at a pixel of the view, interpolated between four pixels.
    #[inline(always)]
    fn at(&self, pixel: [usize; 2]) -> f32 {
        let (mut ends, mut parts) = ([[0; 2]; 2], [0.0; 2]);
        for a in 0..2 {
            let last = self.size[a] as f32 - 1.0;
            let place = smaller(larger((pixel[a] as f32 + 0.5) / self.side - 0.5, 0.0), last);
            let low = place as usize;
            (ends[a], parts[a]) = ([low, (low + 1).min(self.size[a] - 1)], place - low as f32);
        }
        let row = |j: usize| {
            let [one, other] = ends[0].map(|i| self.depth[j * self.size[0] + i]);
            one + parts[0] * (other - one)
        };
        let [one, other] = ends[1].map(row);
        one + parts[1] * (other - one)
    }
}

/// The means of squares of pixels; those at the right and lower border may be smaller.
fn reduced(depth: &[f32], [width, height]: [usize; 2], side: usize) -> Vec<f32> {
    let (columns, rows) = (width.div_ceil(side), height.div_ceil(side));
    let mean = |square: usize| {
        let [i, j] = [square % columns * side, square / columns * side];
        let (right, bottom) = ((i + side).min(width), (j + side).min(height));
        let sum: f32 = (j..bottom).map(|j| depth[j * width + i..j * width + right].iter().sum::<f32>()).sum();
        sum / ((right - i) * (bottom - j)) as f32
    };
    (0..columns * rows).into_par_iter().map(mean).collect()
}
