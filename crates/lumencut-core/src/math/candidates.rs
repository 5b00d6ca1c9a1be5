//! Excludes pieces of a bundle that no pixel in a part of a tile can show.

use super::cost::Rule;
use super::lanes::{ABSENT, FAN, PARTS, larger, smaller};
use super::pieces::Bundle;
use super::tile::{Area, Tile};

/// A set of pairs of a tile's part and a bundle's slot: the pair has bit 16·part + slot.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Candidates {
    pub stripes: u32,
    pub wedges: u32,
}

/// The pieces of `bundle` whose smallest key is within the limit of some part; no pixel there can show another.
#[inline(always)]
pub(crate) fn candidates<const LUMEN_FIRST: bool>(
    tile: &Tile,
    bundle: &Bundle,
    rule: &Rule,
    limits: &[f32; PARTS],
) -> Candidates {
    let mut found = Candidates::default();
    for p in 0..PARTS {
        let (stripe, wedge) = smallest_keys::<LUMEN_FIRST>(&tile.parts[p], bundle, rule);
        found.stripes |= tile.bits.within(&stripe, limits[p]) << (FAN * p);
        found.wedges |= tile.bits.within(&wedge, limits[p]) << (FAN * p);
    }
    found
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Cover {
    pub in_stripe: bool,
    pub in_wedge: bool,
    /// (q − p)·e for the middle q of the area; p and e are a slot's point and edge, as in pieces.rs.
    start: f32,
    /// The most by which (q − p)·e differs from `start` for other points q of the area.
    along: f32,
    /// Half the sides of the area, plus a bound on the rounding of all products.
    sides: [f32; 2],
}

impl Cover {
    #[inline(always)]
    pub(crate) fn new(area: &Area, ends: [[f32; 2]; 2], [ex, ey]: [f32; 2], [fx, fy]: [f32; 2]) -> Self {
        let ([cx, cy], [hx, hy]) = (area.center, area.half);
        let (ux, uy) = (cx - ends[0][0], cy - ends[0][1]);
        let (wx, wy) = (cx - ends[1][0], cy - ends[1][1]);
        let sx = hx + 1e-5 * larger(ux.abs(), wx.abs());
        let sy = hy + 1e-5 * larger(uy.abs(), wy.abs());
        let (start, end, before) = (ux * ex + uy * ey, wx * ex + wy * ey, ux * fx + uy * fy);
        let along = sx * ex.abs() + sy * ey.abs();
        let in_stripe = (start + along >= 0.0) & (end - along <= 0.0);
        let in_wedge = (before + sx * fx.abs() + sy * fy.abs() >= 0.0) & (start - along <= 0.0);
        Self { in_stripe, in_wedge, start, along, sides: [sx, sy] }
    }
}

/// Lower bounds on the keys of stripes and wedges in an area; [`ABSENT`] if a piece covers none of it.
#[inline(always)]
fn smallest_keys<const LUMEN_FIRST: bool>(
    area: &Area,
    bundle: &Bundle,
    rule: &Rule,
) -> ([f32; FAN], [f32; FAN]) {
    let (mut stripe, mut wedge) = ([ABSENT; FAN], [ABSENT; FAN]);
    let ([cx, cy], [hx, hy]) = (area.center, area.half);
    for s in 0..FAN {
        let (ux, uy) = (cx - bundle.x[s], cy - bundle.y[s]);
        let (ex, ey) = (bundle.edge_x[s], bundle.edge_y[s]);
        let ends = [[bundle.x[s], bundle.y[s]], [bundle.next_x[s], bundle.next_y[s]]];
        let cover = Cover::new(area, ends, [ex, ey], [bundle.before_x[s], bundle.before_y[s]]);
        let Cover { in_stripe, in_wedge, start, along, sides: [sx, sy] } = cover;

        let inverse = bundle.inverse_length[s];
        let (z0, dz, r0) = (bundle.stripe_z[s], bundle.stripe_dz[s], bundle.radius[s]);
        let change = inverse * inverse * dz;
        let near = larger(z0 + start * change - along * change.abs(), smaller(z0, z0 + dz));
        let across = ((ux * ey - uy * ex).abs() - (sx * ey.abs() + sy * ex.abs())) * inverse;
        let widest = larger(r0, r0 + bundle.radius_change[s]);
        let stripe_key = rule.bound::<LUMEN_FIRST>(near, across, widest, bundle.tiers[s]);
        stripe[s] = if in_stripe { stripe_key } else { ABSENT };

        // `away` is a lower bound on the distance of all pixels of the area from the slot's point.
        let (gx, gy) = (larger(ux.abs() - hx, 0.0), larger(uy.abs() - hy, 0.0));
        let away = larger(across, (gx * gx + gy * gy).sqrt());
        let wedge_key = rule.bound::<LUMEN_FIRST>(bundle.wedge_z[s], away, r0, bundle.tiers[s]);
        wedge[s] = if in_wedge { wedge_key } else { ABSENT };
    }
    (stripe, wedge)
}
