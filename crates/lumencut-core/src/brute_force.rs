//! The reference: every pixel against every piece of every level it needs. Vectorised and parallel like the
//! product, without its hierarchy; for tests and benches only.

use rayon::prelude::*;

use crate::camera::Camera;
use crate::error::Result;
use crate::math::cost::Rule;
use crate::math::hierarchy::{Hierarchy, NO_SLOT};
use crate::math::lanes::{ABSENT, COLUMNS, FAN, Kernel, PIXELS, ROWS, UNSET, dispatch};
use crate::math::nearest::lower_distance;
use crate::math::pieces::Envelope;
use crate::math::tile::{Tile, scatter};
use crate::stages::View;
use crate::stages::depth::{CutSurface, Search, depth_by};

/// [`crate::stages::distance::distance`] against every segment.
///
/// # Errors
/// [`crate::error::ErrorKind::Interrupted`].
pub fn distance(view: &View, finest: &Hierarchy, distance: &mut [f32]) -> Result<()> {
    distance.par_chunks_mut(view.tile_row()).enumerate().try_for_each(|(row, pixels)| {
        view.go_on()?;
        dispatch(view.isa, DistanceRow { camera: view.camera, finest, row, pixels });
        Ok(())
    })
}

struct DistanceRow<'a> {
    camera: &'a Camera,
    finest: &'a Hierarchy,
    row: usize,
    pixels: &'a mut [f32],
}

impl Kernel for DistanceRow<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let width = self.camera.size()[0];
        for column in (0..width).step_by(COLUMNS) {
            let tile = Tile::new(self.camera, column, self.row * ROWS);
            let mut squared = [UNSET; PIXELS];
            for bundle in &self.finest.bundles {
                for s in (0..FAN).filter(|s| bundle.slot[*s] != NO_SLOT) {
                    lower_distance(&tile, &mut squared, bundle, s);
                }
            }
            scatter(&squared.map(f32::sqrt), self.pixels, width, column);
        }
    }
}

struct Exhaustive<'a>(&'a CutSurface<'a>);

impl Search for Exhaustive<'_> {
    #[inline(always)]
    fn lowest<const LUMEN_FIRST: bool>(
        &mut self,
        level: usize,
        tile: &Tile,
        rule: &Rule,
        envelope: &mut Envelope,
    ) {
        let mut pixels = envelope.whole(tile);
        for bundle in &self.0.hierarchy(level).bundles {
            for s in 0..FAN {
                if bundle.wedge_z[s] < ABSENT {
                    pixels.offer_wedge::<LUMEN_FIRST>(bundle, s, rule);
                }
                if bundle.stripe_z[s] < ABSENT {
                    pixels.offer_stripe::<LUMEN_FIRST>(bundle, s, rule);
                }
            }
        }
    }
}

/// [`crate::stages::depth::depth`] against every piece.
///
/// # Errors
/// [`crate::error::ErrorKind::Interrupted`].
pub fn depth(
    view: &View,
    surface: &CutSurface,
    distance: &[f32],
    depth: &mut [f32],
    vessel: &mut [i32],
) -> Result<()> {
    depth_by(view, surface, distance, depth, vessel, || Exhaustive(surface))
}
