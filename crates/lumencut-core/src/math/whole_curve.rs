//! Keys that count the distance to the entire projected vessel instead of the distance to a piece (paper Eq. 2). Slow: every
//! pixel is compared with every segment.

use super::cost::Rule;
use super::lanes::{FAR, PIXELS, smaller};
use super::pieces::Envelope;
use super::projection::Projected;
use super::tile::Tile;

/// The pieces with the smallest keys of a level at the pixels of a tile; vessels follow each other in `projected`.
pub(crate) fn lowest_keys<const LUMEN_FIRST: bool>(
    projected: &[Projected],
    tile: &Tile,
    rule: &Rule,
    envelope: &mut Envelope,
) {
    let mut first = 0;
    for curve in projected.chunk_by(|here, next| here.vessel == next.vessel) {
        let mut distance = [FAR; PIXELS];
        for l in 0..PIXELS {
            distance[l] = distance_to(curve, tile.x[l], tile.y[l]);
        }
        let mut pixels = envelope.whole(tile);
        for (i, here) in curve.iter().enumerate() {
            let piece = 2 * (first + i) as u32;
            for l in 0..PIXELS {
                let (x, y, d) = (tile.x[l], tile.y[l], distance[l]);
                if here.stands {
                    let (covered, _) = here.wedge().cover(x, y);
                    let key = rule.key::<LUMEN_FIRST>(here.point[2], d, here.radius, 0.0);
                    pixels.offer(l, covered, key, here.point[2], piece);
                }
                if here.has_stripe() {
                    let end = &curve[i + 1];
                    let foot = here.stripe(end).foot(x, y);
                    let z = here.point[2] + foot.t * (end.point[2] - here.point[2]);
                    let radius = here.radius + foot.t * (end.radius - here.radius);
                    let key = rule.key::<LUMEN_FIRST>(z, d, radius, 0.0);
                    pixels.offer(l, foot.covered, key, z, piece + 1);
                }
            }
        }
        first += curve.len();
    }
}

/// The distance (mm) of view (`x`, `y`) from the projection of a vessel.
pub(crate) fn distance_to(curve: &[Projected], x: f32, y: f32) -> f32 {
    let mut nearest = FAR;
    for (i, here) in curve.iter().enumerate() {
        let (_, from_point) = here.wedge().cover(x, y);
        nearest = smaller(nearest, from_point);
        if here.has_stripe() {
            let foot = here.stripe(&curve[i + 1]).foot(x, y);
            nearest = if foot.covered { smaller(nearest, foot.distance) } else { nearest };
        }
    }
    nearest
}
