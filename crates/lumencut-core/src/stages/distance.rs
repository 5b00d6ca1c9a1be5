//! The distance of every pixel to the nearest vessel of the finest level, in the view plane; it selects the
//! levels of detail (the paper's "LOD estimation", section 3.3.1).

use rayon::prelude::*;

use super::View;
use crate::error::Result;
use crate::math::hierarchy::Hierarchy;
use crate::math::lanes::{COLUMNS, FAR, Kernel, PIXELS, ROWS, UNSET, dispatch, largest};
use crate::math::tile::{Tile, lane};
use crate::math::walk::smallest_distances;

/// Writes the distance (mm) of each pixel of the view to the nearest segment of the finest level.
///
/// # Errors
/// [`crate::error::ErrorKind::Interrupted`].
pub fn distance(view: &View, finest: &Hierarchy, distance: &mut [f32]) -> Result<()> {
    distance.par_chunks_mut(view.tile_row()).enumerate().try_for_each(|(row, pixels)| {
        view.go_on()?;
        dispatch(view.isa, DistanceRow { view, finest, row, pixels });
        Ok(())
    })
}

/// One row of tiles.
struct DistanceRow<'a> {
    view: &'a View<'a>,
    finest: &'a Hierarchy,
    row: usize,
    pixels: &'a mut [f32],
}

impl Kernel for DistanceRow<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let camera = self.view.camera;
        let width = camera.size()[0];
        let step = camera.pixel_spacing() as f32 * COLUMNS as f32;
        let mut limit = FAR;
        for column in (0..width).step_by(COLUMNS) {
            let tile = Tile::new(camera, column, self.row * ROWS);
            let mut squared = [UNSET; PIXELS];
            smallest_distances(self.finest, &tile, limit, &mut squared);
            squared = squared.map(f32::sqrt);
            let worst = largest(&squared);
            // No pixel of the next tile is farther than its counterpart in this one, and one tile's width.
            limit = (worst + step) * 1.000_1;
            for (r, row) in self.pixels.chunks_mut(width).enumerate() {
                for (c, pixel) in row[column..].iter_mut().take(COLUMNS).enumerate() {
                    *pixel = squared[lane(r, c)];
                }
            }
        }
    }
}
