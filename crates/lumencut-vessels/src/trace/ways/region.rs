//! Path cost per millimetre at each voxel, in blocks that are computed only when needed.

use std::sync::Arc;

use glam::DVec3;

use crate::trace::lumen::lumen_model::LumenModel;
use crate::trace::ways::barrier::Barrier;
use crate::trace::ways::blocks::{BLOCK, Blocks, index_of, meets, voxel_of};
use crate::trace::ways::shape::{HALO, PADDED_SIDE, bends, beside, blurred, padded, raised, wall_between};
use crate::voxels::Voxels;

/// Membership of plain tissue, which keeps its cost finite: for paths in lumen, and for bridges across gaps.
const LEAST_MEMBERSHIP: f64 = 0.05;
const LEAST_OF_BRIDGES: f64 = 0.2;

/// Additional cost far from the middle of a wide vessel, relative to the cost that follows from membership.
const OFF_MIDDLE: f64 = 0.4;

/// Additional cost in the wall between two vessels, relative to the cost that follows from membership.
const WALL: f64 = 15.0;

/// Membership is multiplied by this next to bone, calcium and metal, because their edges have the values of lumen.
const RIM_FACTOR: f64 = 0.5;

/// Fraction of the noise that remains after averaging over neighbours.
const NOISE_LEFT: f64 = 0.23;

/// Maximum cost: that of tissue far from lumen.
const DEAREST: f64 = (1.0 + WALL) * (1.0 + OFF_MIDDLE) / (LEAST_MEMBERSHIP * LEAST_MEMBERSHIP);

/// Code of forbidden voxels. Higher codes mean higher costs.
pub(crate) const FORBIDDEN: u8 = 0;

/// A voxel is not lumen if the mean membership is below this.
pub(crate) const WEAK: f64 = 0.2;
/// Lumen is thin if the mean membership is below this.
pub(crate) const THIN: f64 = 0.75;
/// Membership of a voxel deep inside lumen.
pub(crate) const FULL: f64 = 0.9;

/// How strictly paths must stay in lumen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strictness {
    /// Tissue costs 400 times as much as lumen.
    Lumen,
    /// As [`Strictness::Lumen`], and a flap between two lumens costs up to 60 times as much as lumen.
    Flaps,
    /// Tissue costs 25 times as much as lumen.
    Bridge,
}

impl Strictness {
    fn least_membership(self) -> f64 {
        match self {
            Self::Lumen | Self::Flaps => LEAST_MEMBERSHIP,
            Self::Bridge => LEAST_OF_BRIDGES,
        }
    }
}

/// The path cost per millimetre that each code means.
pub(crate) fn costs() -> [f32; 256] {
    std::array::from_fn(|code| {
        if code == 0 { f32::INFINITY } else { DEAREST.powf((code as f64 - 1.0) / 254.0) as f32 }
    })
}

fn code_of(cost: f64) -> u8 {
    (1.0 + 254.0 * cost.ln() / DEAREST.ln()).round().clamp(1.0, 255.0) as u8
}

/// A ball that no path may enter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stopper {
    /// Centre (mm, LPS).
    pub center: DVec3,
    /// Radius (mm).
    pub radius: f64,
}

#[derive(Clone, Debug)]
pub(crate) struct BlockCosts {
    pub codes: [u8; BLOCK],
    pub levels: Option<Box<[i16; BLOCK]>>,
}

/// Costs of the blocks that were needed so far, with one byte per voxel.
#[derive(Clone, Debug)]
pub struct Region {
    /// The values of lumen and tissue.
    pub model: LumenModel,
    /// Balls that no path may enter.
    pub stoppers: Vec<Stopper>,
    strictness: Strictness,
    made: Blocks<Arc<BlockCosts>>,
}

impl Region {
    /// A region for which no block has been computed yet.
    pub fn new(size: [usize; 3], model: LumenModel, stoppers: Vec<Stopper>, strictness: Strictness) -> Self {
        Self { model, stoppers, strictness, made: Blocks::new(size) }
    }

    pub(crate) fn costs_of(&mut self, voxels: &Voxels, place: usize) -> Arc<BlockCosts> {
        if let Some(number) = self.made.find(place) {
            return Arc::clone(&self.made[number]);
        }
        let costs = Arc::new(self.make(voxels, place));
        self.made.find_or_make(place, |_| Arc::clone(&costs));
        costs
    }

    pub(crate) fn code_of(&mut self, voxels: &Voxels, voxel: [i32; 3]) -> u8 {
        self.costs_of(voxels, self.made.place_of(voxel)).codes[index_of(voxel)]
    }

    pub(crate) fn code_below(&self, limit: f64) -> u8 {
        let least = self.strictness.least_membership();
        let membership = least + (1.0 - least) * limit;
        code_of((1.0 + 0.8 * OFF_MIDDLE) / (membership * membership))
    }

    /// Drops the computed blocks that a ball touches.
    pub fn forget(&mut self, voxels: &Voxels, ball: &Stopper) {
        let near = voxels.around(ball.center, ball.radius + 2.0 * voxels.smallest_side);
        let gone: Vec<usize> =
            self.made.places().filter(|place| meets(self.made.corner(*place), near)).collect();
        self.made.forget(|place| gone.contains(&place));
    }

    fn make(&self, voxels: &Voxels, place: usize) -> BlockCosts {
        let corner = self.made.corner(place);
        let mut shares = vec![0.0; PADDED_SIDE * PADDED_SIDE * PADDED_SIDE];
        voxels.cube(corner.map(|c| c - HALO as i32), PADDED_SIDE, &mut shares);
        let barrier = (self.strictness == Strictness::Flaps).then(|| Barrier::new(&self.model, &shares));
        let beside_bone = beside(&shares, |value| self.model.is_far_above(value));
        for share in &mut shares {
            *share = self.model.membership(*share);
        }
        let near = blurred(&shares, &[0.25, 0.5, 0.25]);
        let noise = self.model.noise_of_membership() * NOISE_LEFT;
        let wide = blurred(&shares, &[1.0 / 7.0; 7]);
        let least = self.strictness.least_membership();
        let levels = barrier.as_ref().map(|barrier| Box::new(barrier.levels));
        let mut costs = BlockCosts { codes: [FORBIDDEN; BLOCK], levels };
        for n in 0..BLOCK {
            let from = padded(n);
            let bends = bends(&near, from);
            let rim = if beside_bone[from] { RIM_FACTOR } else { 1.0 };
            let share = rim * raised(f64::from(near[from]), &bends, noise);
            let membership = least + (1.0 - least) * share;
            let off_middle = OFF_MIDDLE.mul_add(1.0 - f64::from(wide[from]), 1.0);
            let wall = WALL.mul_add(wall_between(f64::from(near[from]), &bends), 1.0);
            let valley = barrier.as_ref().map_or(1.0, |barrier| f64::from(barrier.valleys[n]));
            costs.codes[n] = code_of(wall.max(valley) * off_middle / (membership * membership));
        }
        self.forbid(voxels, corner, &mut costs.codes);
        costs
    }

    fn forbid(&self, voxels: &Voxels, corner: [i32; 3], codes: &mut [u8; BLOCK]) {
        for (n, code) in codes.iter_mut().enumerate() {
            let voxel = voxel_of(corner, n);
            let outside = (0..3).any(|a| voxel[a] as usize >= voxels.size[a]);
            let stopped = || {
                let place = voxels.center(voxel);
                self.stoppers.iter().any(|s| place.distance_squared(s.center) <= s.radius * s.radius)
            };
            if outside || (!self.stoppers.is_empty() && stopped()) {
                *code = FORBIDDEN;
            }
        }
    }
}
