//! The reference for tests and benches: every pixel is compared with every piece, without the hierarchy.

use crate::error::Result;
use crate::math::cost::Rule;
use crate::math::decision::Part;
use crate::math::hierarchy::{Hierarchy, NO_SLOT};
use crate::math::lanes::{ABSENT, FAN, PIXELS};
use crate::math::nearest::lower_distance;
use crate::math::own_pieces::{NearestPieces, OwnPieces};
use crate::math::pieces::Envelope;
use crate::math::tile::Tile;
use crate::stages::Work;
use crate::stages::depth::{CutSurface, DepthImages, Search, depth_by};
use crate::stages::distance::{Measure, distance_by};

/// Computes the same as [`crate::stages::distance::distance`] by comparing every pixel with every segment.
pub fn distance(work: &Work, surface: &CutSurface, distance: &mut [f32]) -> Result<()> {
    distance_by(work, surface, distance, || EverySegment(surface.finest()))
}

struct EverySegment<'a>(&'a Hierarchy);

impl Measure for EverySegment<'_> {
    #[inline(always)]
    fn lower(&mut self, tile: &Tile, squared: &mut [f32; PIXELS]) {
        for bundle in &self.0.bundles {
            for s in (0..FAN).filter(|s| bundle.slot[*s] != NO_SLOT) {
                lower_distance(tile, squared, bundle, s);
            }
        }
    }
}

struct EveryPiece<'a>(&'a CutSurface<'a>);

impl Search for EveryPiece<'_> {
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

    #[inline(always)]
    fn own<const SHEET: bool>(&mut self, pieces: OwnPieces, part: &Part, nearest: &mut NearestPieces) {
        pieces.offer_all::<SHEET>(part, nearest);
    }
}

/// Computes the same as [`crate::stages::depth::depth`] by comparing every pixel with every piece.
pub fn depth(work: &Work, surface: &CutSurface, distance: &[f32], images: DepthImages) -> Result<()> {
    depth_by(work, surface, distance, images, || EveryPiece(surface))
}
