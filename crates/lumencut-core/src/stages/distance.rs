//! The distance of every pixel to the nearest vessel of the finest level, in the view plane; it selects the
//! levels of detail (the paper's "LOD estimation", section 3.3.1).

use rayon::prelude::*;

use super::depth::CutSurface;
use super::{Image, Work};
use crate::error::Result;
use crate::math::hierarchy::Hierarchy;
use crate::math::lanes::{COLUMNS, Kernel, PIXELS, ROWS, UNSET, dispatch};
use crate::math::nearest::NearestPoint;
use crate::math::tile::{Tile, scatter};
use crate::math::walk::smallest_distances;

/// Writes the distance (mm) of each pixel of the view to the nearest segment of the finest level.
pub fn distance(work: &Work, surface: &CutSurface, distance: &mut [f32]) -> Result<()> {
    distance_by(work, surface, distance, || NearestSearch {
        finest: surface.finest(),
        nearest: NearestPoint::unknown(),
    })
}

pub(crate) trait Measure {
    fn lower(&mut self, tile: &Tile, squared: &mut [f32; PIXELS]);
}

/// Searches the hierarchy, starting with the point nearest to the previous tile.
struct NearestSearch<'a> {
    finest: &'a Hierarchy,
    nearest: NearestPoint,
}

impl Measure for NearestSearch<'_> {
    #[inline(always)]
    fn lower(&mut self, tile: &Tile, squared: &mut [f32; PIXELS]) {
        smallest_distances(self.finest, tile, &mut self.nearest, squared);
    }
}

/// [`distance`], with a new search for each row of tiles.
pub(crate) fn distance_by<M: Measure>(
    work: &Work,
    surface: &CutSurface,
    distance: &mut [f32],
    measure: impl Fn() -> M + Sync,
) -> Result<()> {
    work.expect_whole(Image::Distance, distance);
    distance.par_chunks_mut(work.tile_row()).enumerate().try_for_each(|(row, pixels)| {
        work.begin(pixels.len())?;
        dispatch(work.isa, DistanceRow { surface, measure: measure(), row, pixels });
        Ok(())
    })
}

struct DistanceRow<'a, M: Measure> {
    surface: &'a CutSurface<'a>,
    measure: M,
    row: usize,
    pixels: &'a mut [f32],
}

impl<M: Measure> Kernel for DistanceRow<'_, M> {
    type Output = ();

    #[inline(always)]
    fn run(mut self) {
        let width = self.surface.width();
        for column in (0..width).step_by(COLUMNS) {
            let tile = self.surface.tile(column, self.row * ROWS);
            let mut squared = [UNSET; PIXELS];
            self.measure.lower(&tile, &mut squared);
            for l in 0..PIXELS {
                squared[l] = squared[l].sqrt();
            }
            scatter(&squared, self.pixels, width, column);
        }
    }
}
