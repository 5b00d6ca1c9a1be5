//! The depth filter: a 7×7 Gaussian with σ = 2√(2 ln 2)/π pixels that takes the steps of the pixel grid out of
//! the cut surface (paper section 3.3.3).

use bytemuck::{Pod, Zeroable};
use rayon::prelude::*;

use super::{Image, Work};
use crate::error::Result;
use crate::math::lanes::{Kernel, ROWS, dispatch};

/// Pixels to each side of the middle.
const REACH: usize = 3;

/// The parameters of the stage.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct DepthFilterParameters {
    /// The weights of the Gaussian from the middle outwards; with both sides they sum to 1.
    pub weights: [f32; REACH + 1],
}

impl DepthFilterParameters {
    /// The Gaussian of the paper.
    pub fn new() -> Self {
        let sigma = 2.0 * (2.0 * 2f64.ln()).sqrt() / std::f64::consts::PI;
        let bell: [f64; REACH + 1] =
            std::array::from_fn(|n| (-((n * n) as f64) / (2.0 * sigma * sigma)).exp());
        let sum = bell[0] + 2.0 * bell[1..].iter().sum::<f64>();
        Self { weights: bell.map(|w| (w / sum) as f32) }
    }
}

impl Default for DepthFilterParameters {
    fn default() -> Self {
        Self::new()
    }
}

/// Writes the smoothed `image`, continued beyond its border by the border's own pixels.
///
/// # Errors
/// [`crate::error::ErrorKind::Interrupted`].
pub fn depth_filter(
    work: &Work,
    parameters: &DepthFilterParameters,
    image: &[f32],
    smoothed: &mut [f32],
) -> Result<()> {
    work.expect_whole(Image::UnfilteredDepth, image);
    work.expect_whole(Image::Depth, smoothed);
    let (weights, width) = (parameters.weights, work.size[0]);
    smoothed.par_chunks_mut(work.tile_row()).enumerate().try_for_each(|(row, smoothed)| {
        work.go_on()?;
        dispatch(work.isa, FilterRows { image, width, first: row * ROWS, weights, smoothed });
        Ok(())
    })
}

struct FilterRows<'a> {
    image: &'a [f32],
    width: usize,
    first: usize,
    weights: [f32; REACH + 1],
    smoothed: &'a mut [f32],
}

impl Kernel for FilterRows<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let (width, weights) = (self.width, self.weights);
        let height = self.image.len() / width;
        let row = |j: usize| &self.image[j * width..(j + 1) * width];
        let mut padded = vec![0.0; width + 2 * REACH];
        for (j, smoothed) in (self.first..).zip(self.smoothed.chunks_mut(width)) {
            let middle = &mut padded[REACH..REACH + width];
            set(middle, weights[0], row(j));
            for n in 1..=REACH {
                add(middle, weights[n], row(j.saturating_sub(n)), row((j + n).min(height - 1)));
            }
            let (first, last) = (middle[0], middle[width - 1]);
            padded[..REACH].fill(first);
            padded[REACH + width..].fill(last);
            set(smoothed, weights[0], &padded[REACH..]);
            for n in 1..=REACH {
                add(smoothed, weights[n], &padded[REACH - n..], &padded[REACH + n..]);
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
