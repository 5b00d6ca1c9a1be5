//! Silhouettes: lines where the cut surface leaps, strongest between influence zones (paper section 3.4,
//! "Silhouettes").

use rayon::prelude::*;

use super::View;
use super::depth_filter::depth_filter;
use crate::error::Result;
use crate::math::lanes::{Kernel, ROWS, dispatch};

/// How much a leap between the influence zones of two vessels counts beside one within a zone.
const ZONE_BORDER: f32 = 4.0;

/// Writes the strength of the silhouette, 0 to 1, at each pixel: the slope of the depth (Sobel, mm per mm, so
/// that zooming changes nothing), raised at borders of influence zones, smoothed, and mapped by
/// s / (s + `half_slope`) after the square of both.
///
/// # Errors
/// [`crate::error::ErrorKind::Interrupted`].
pub fn silhouette(
    view: &View,
    depth: &[f32],
    vessel: &[i32],
    half_slope: f64,
    strength: &mut [f32],
) -> Result<()> {
    let width = view.size()[0];
    let per_slope = (1.0 / (8.0 * view.camera.pixel_spacing())) as f32;
    let mut raised = vec![0.0; depth.len()];
    raised.par_chunks_mut(view.tile_row()).enumerate().try_for_each(|(row, raised)| {
        view.go_on()?;
        dispatch(view.isa, SlopeRows { depth, vessel, width, first: row * ROWS, per_slope, raised });
        Ok(())
    })?;
    depth_filter(view, &raised, strength)?;
    let half = (half_slope * half_slope) as f32;
    strength.par_chunks_mut(view.tile_row()).for_each(|row| {
        for s in row {
            let square = (*s * *s).min(1e12);
            *s = square / (square + half);
        }
    });
    Ok(())
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
            let [z0, z1, z2] = rows.map(|j| &self.depth[j * width..(j + 1) * width]);
            let [v0, v1, v2] = rows.map(|j| &self.vessel[j * width..(j + 1) * width]);
            let slope = |left: usize, i: usize, right: usize| {
                let dx = z0[right] - z0[left] + 2.0 * (z1[right] - z1[left]) + z2[right] - z2[left];
                let dy = z2[left] - z0[left] + 2.0 * (z2[i] - z0[i]) + z2[right] - z0[right];
                let here = v1[i];
                let border = (v0[i] != here) | (v2[i] != here) | (v1[left] != here) | (v1[right] != here);
                let raise = if border { ZONE_BORDER } else { 1.0 };
                (dx * dx + dy * dy).sqrt() * self.per_slope * raise
            };
            for i in 1..width.saturating_sub(1) {
                raised[i] = slope(i - 1, i, i + 1);
            }
            raised[0] = slope(0, 0, 1.min(width - 1));
            raised[width - 1] = slope(width.saturating_sub(2), width - 1, width - 1);
        }
    }
}
