//! The hierarchy over the slots of one level: bundles of sixteen slots that lie close together in space, boxes around
//! sixteen bundles, and so on to one root. Bundles are chosen once per tree in world space. A view only projects the
//! slots ([`super::projection`]) and recomputes the boxes.

use glam::DVec3;

use super::cost::Rule;
use super::lanes::{ABSENT, FAN, FAR, gap};
use super::pieces::Bundle;
use super::tile::{Area, Tile};

/// Marks an entry of the order that holds no slot.
pub const NO_SLOT: u32 = u32::MAX;

/// Sixteen nodes of one height, each with its box in the view plane, smallest depth and largest radius (mm),
/// and largest number of tiers (`Rule::key`).
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct Boxes {
    low_x: [f32; FAN],
    high_x: [f32; FAN],
    low_y: [f32; FAN],
    high_y: [f32; FAN],
    z: [f32; FAN],
    radius: [f32; FAN],
    tiers: [f32; FAN],
}

impl Boxes {
    pub const EMPTY: Self = Self {
        low_x: [FAR; FAN],
        high_x: [FAR; FAN],
        low_y: [FAR; FAN],
        high_y: [FAR; FAN],
        z: [ABSENT; FAN],
        radius: [0.0; FAN],
        tiers: [0.0; FAN],
    };

    fn enclose_bundle(&mut self, n: usize, bundle: &Bundle) {
        let mut one = Node::NOTHING;
        for s in (0..FAN).filter(|s| bundle.slot[*s] != NO_SLOT) {
            let end_z = bundle.stripe_z[s] + bundle.stripe_dz[s];
            one.low_x = one.low_x.min(bundle.x[s]).min(bundle.next_x[s]);
            one.high_x = one.high_x.max(bundle.x[s]).max(bundle.next_x[s]);
            one.low_y = one.low_y.min(bundle.y[s]).min(bundle.next_y[s]);
            one.high_y = one.high_y.max(bundle.y[s]).max(bundle.next_y[s]);
            one.z = one.z.min(bundle.stripe_z[s]).min(end_z).min(bundle.wedge_z[s]);
            one.radius = one.radius.max(bundle.radius[s]).max(bundle.radius[s] + bundle.radius_change[s]);
            one.tiers = one.tiers.max(bundle.tiers[s]);
        }
        self.set(n, one);
    }

    fn enclose_boxes(&mut self, n: usize, inner: &Boxes) {
        let mut one = Node::NOTHING;
        for s in (0..FAN).filter(|s| inner.low_x[*s] < FAR) {
            one.low_x = one.low_x.min(inner.low_x[s]);
            one.high_x = one.high_x.max(inner.high_x[s]);
            one.low_y = one.low_y.min(inner.low_y[s]);
            one.high_y = one.high_y.max(inner.high_y[s]);
            one.z = one.z.min(inner.z[s]);
            one.radius = one.radius.max(inner.radius[s]);
            one.tiers = one.tiers.max(inner.tiers[s]);
        }
        self.set(n, one);
    }

    fn set(&mut self, n: usize, node: Node) {
        (self.low_x[n], self.high_x[n]) = (node.low_x, node.high_x);
        (self.low_y[n], self.high_y[n]) = (node.low_y, node.high_y);
        (self.z[n], self.radius[n], self.tiers[n]) = (node.z, node.radius, node.tiers);
    }

    /// The squared distance (mm²) between the area and each node's box.
    #[inline(always)]
    pub fn squared_distances(&self, area: &Area) -> [f32; FAN] {
        let mut squared = [0.0; FAN];
        let ([cx, cy], [hx, hy]) = (area.center, area.half);
        for n in 0..FAN {
            let gx = gap(self.low_x[n], self.high_x[n], cx, hx);
            let gy = gap(self.low_y[n], self.high_y[n], cy, hy);
            squared[n] = gx * gx + gy * gy;
        }
        squared
    }

    #[inline(always)]
    pub(crate) fn largest_radii(&self) -> &[f32; FAN] {
        &self.radius
    }

    #[inline(always)]
    pub(crate) fn has_first(&self, n: usize) -> bool {
        self.tiers[n] > 0.0
    }

    #[inline(always)]
    pub(crate) fn key_bounds<const LUMEN_FIRST: bool>(&self, tile: &Tile, rule: &Rule) -> [f32; FAN] {
        let mut bounds = self.squared_distances(&tile.area);
        for n in 0..FAN {
            bounds[n] = rule.bound::<LUMEN_FIRST>(self.z[n], bounds[n].sqrt(), self.radius[n], self.tiers[n]);
        }
        bounds
    }
}

#[derive(Clone, Copy)]
struct Node {
    low_x: f32,
    high_x: f32,
    low_y: f32,
    high_y: f32,
    z: f32,
    radius: f32,
    tiers: f32,
}

impl Node {
    const NOTHING: Self =
        Self { low_x: FAR, high_x: -FAR, low_y: FAR, high_y: -FAR, z: ABSENT, radius: 0.0, tiers: 0.0 };
}

/// Slots in bundles, and the boxes above them: `heights[0]` encloses the bundles, the last one is the root.
#[derive(Clone, Debug)]
pub struct Hierarchy {
    pub(crate) bundles: Vec<Bundle>,
    pub heights: Vec<Vec<Boxes>>,
}

impl Hierarchy {
    pub fn new(bundles: usize) -> Self {
        let mut heights = Vec::new();
        let mut nodes = bundles;
        loop {
            nodes = nodes.div_ceil(FAN);
            heights.push(vec![Boxes::EMPTY; nodes]);
            if nodes <= 1 {
                return Self { bundles: vec![Bundle::EMPTY; bundles], heights };
            }
        }
    }

    /// Removes depths and radii from all pieces, so that only their positions in the image count.
    pub fn flatten(&mut self) {
        for bundle in &mut self.bundles {
            for s in 0..FAN {
                let flat = |z: f32| if z < ABSENT { 0.0 } else { ABSENT };
                bundle.stripe_z[s] = flat(bundle.stripe_z[s]);
                bundle.wedge_z[s] = flat(bundle.wedge_z[s]);
            }
            (bundle.stripe_dz, bundle.radius, bundle.radius_change) = ([0.0; FAN], [0.0; FAN], [0.0; FAN]);
        }
        self.enclose();
    }

    pub fn widen(&mut self, by: f32) {
        for bundle in &mut self.bundles {
            for s in 0..FAN {
                bundle.radius[s] += by;
            }
        }
        self.enclose();
    }

    pub fn enclose(&mut self) {
        for (n, bundle) in self.bundles.iter().enumerate() {
            self.heights[0][n / FAN].enclose_bundle(n % FAN, bundle);
        }
        for height in 1..self.heights.len() {
            let (below, above) = self.heights.split_at_mut(height);
            for (n, inner) in below[height - 1].iter().enumerate() {
                above[0][n / FAN].enclose_boxes(n % FAN, inner);
            }
        }
    }
}

/// The order of slots in bundles: entry `16·b + s` is slot `s` of bundle `b`, or [`NO_SLOT`]. Recursive
/// median splits along the longest side keep bundles and boxes compact.
pub(crate) fn spatial_order(centers: &[DVec3]) -> Vec<u32> {
    let mut order: Vec<u32> = (0..centers.len() as u32).collect();
    split(&mut order, centers);
    order.resize(centers.len().div_ceil(FAN) * FAN, NO_SLOT);
    order
}

fn split(order: &mut [u32], centers: &[DVec3]) {
    if order.len() <= FAN {
        return;
    }
    let points = order.iter().map(|s| centers[*s as usize]);
    let (low, high) = points.fold((DVec3::MAX, DVec3::MIN), |(l, h), p| (l.min(p), h.max(p)));
    let side = high - low;
    let axis = if side.x >= side.y && side.x >= side.z { 0 } else { 1 + usize::from(side.z > side.y) };
    // The lower side gets only complete nodes, of the largest height that leaves the other side some slots.
    let mut node = FAN;
    while node * FAN < order.len() {
        node *= FAN;
    }
    let middle = (order.len() / 2).div_ceil(node) * node;
    let middle = if middle < order.len() { middle } else { middle - node };
    order.select_nth_unstable_by(middle, |a, b| {
        let (p, q) = (centers[*a as usize][axis], centers[*b as usize][axis]);
        p.total_cmp(&q).then(a.cmp(b))
    });
    let (lower, upper) = order.split_at_mut(middle);
    split(lower, centers);
    split(upper, centers);
}
