//! The distance of every pixel to the nearest vessel of the finest level, in the view plane; it selects the
//! levels of detail (the paper's "LOD estimation", section 3.3.1).

use rayon::prelude::*;

use super::View;
use crate::error::Result;
use crate::math::hierarchy::Hierarchy;
use crate::math::lanes::{COLUMNS, Kernel, PIXELS, ROWS, UNSET, dispatch};
use crate::math::nearest::NearestPoint;
use crate::math::tile::{Tile, scatter};
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
        let mut nearest = NearestPoint::unknown();
        for column in (0..width).step_by(COLUMNS) {
            let tile = Tile::new(camera, column, self.row * ROWS);
            let mut squared = [UNSET; PIXELS];
            smallest_distances(self.finest, &tile, &mut nearest, &mut squared);
            squared = squared.map(f32::sqrt);
            scatter(&squared, self.pixels, width, column);
        }
    }
}
