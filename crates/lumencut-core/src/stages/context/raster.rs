//! A preview's rays: one for every square of four pixels.

use crate::math::ray::{NONE, WHOLE};

/// Stands for a start in front of the volume: larger than starts at cut surfaces, smaller than `NONE`.
pub const IN_FRONT: f32 = NONE / 2.0;

/// The start of the ray of each square of four pixels: the nearest start behind a cut surface. Only if there
/// is none, it is in front of the volume; else the ray would show what lies before the surface.
pub(super) fn coarse_starts(start: &[f32], [width, height]: [usize; 2]) -> Vec<f32> {
    let (columns, rows) = (width.div_ceil(2), height.div_ceil(2));
    let mut coarse = vec![NONE; columns * rows];
    for (j, row) in start.chunks(width).enumerate() {
        for (i, start) in row.iter().enumerate() {
            let square = &mut coarse[j / 2 * columns + i / 2];
            *square = square.min(if *start <= WHOLE { IN_FRONT } else { *start });
        }
    }
    coarse.into_iter().map(|start| if (IN_FRONT..NONE).contains(&start) { WHOLE } else { start }).collect()
}

pub(super) fn spread(coarse: &[[f32; 4]], start: &[f32], [width, _]: [usize; 2], pixels: &mut [[f32; 4]]) {
    let columns = width.div_ceil(2);
    let rows = pixels.chunks_mut(width).zip(start.chunks(width));
    for (j, (pixels, start)) in rows.enumerate() {
        for (i, (pixel, start)) in pixels.iter_mut().zip(start).enumerate() {
            *pixel = if *start >= NONE { [0.0; 4] } else { coarse[j / 2 * columns + i / 2] };
        }
    }
}
