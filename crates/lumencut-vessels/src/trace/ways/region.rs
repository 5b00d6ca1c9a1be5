//! What a millimetre of way costs at each voxel, for the blocks that a front has come to.

use std::sync::Arc;

use glam::DVec3;

use crate::trace::lumen::lumen_model::LumenModel;
use crate::trace::ways::blocks::{BLOCK, Blocks, SIDE, index_of, meets, voxel_of};
use crate::trace::ways::shape::{HALO, WIDE, bends, beside, blurred, raised, wall_between};
use crate::voxels::Voxels;

/// The membership that even tissue has, so that a way through it is long and not endless.
const LEAST_MEMBERSHIP: f64 = 0.05;
const LEAST_OF_BRIDGES: f64 = 0.2;

/// How much longer a way is that has no lumen around it than one in the middle of a wide vessel.
const OFF_MIDDLE: f64 = 0.4;

/// How much longer a way is through the wall between two vessels.
const WALL: f64 = 15.0;

/// What is left of the membership beside bone, calcium and metal: the edge of bone looks like lumen.
const RIM: f64 = 0.5;

/// What the average over the neighbours leaves of the noise.
const NOISE_LEFT: f64 = 0.23;

/// The dearest millimetre: that of tissue far from lumen.
const DEAREST: f64 = (1.0 + WALL) * (1.0 + OFF_MIDDLE) / (LEAST_MEMBERSHIP * LEAST_MEMBERSHIP);

/// The code of a voxel that no way may pass; those of others rise with the cost.
pub const FORBIDDEN: u8 = 0;

/// A voxel shows no lumen whose membership, and that of its neighbours, is below this on average; it is thin below the
/// second one.
pub const WEAK: f64 = 0.2;
/// See `WEAK`.
pub const THIN: f64 = 0.75;
/// From this membership on a voxel lies well within lumen.
pub const FULL: f64 = 0.9;

/// Whether ways keep to the lumen, or may go through tissue where that is much shorter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strictness {
    /// Tissue is 400 times as dear as lumen.
    Lumen,
    /// Tissue is 25 times as dear as lumen.
    Bridge,
}

impl Strictness {
    fn least_membership(self) -> f64 {
        match self {
            Self::Lumen => LEAST_MEMBERSHIP,
            Self::Bridge => LEAST_OF_BRIDGES,
        }
    }
}

/// The costs of millimetres by their codes.
pub fn costs() -> [f32; 256] {
    std::array::from_fn(|code| {
        if code == 0 { f32::INFINITY } else { DEAREST.powf((code as f64 - 1.0) / 254.0) as f32 }
    })
}

/// The code of a cost.
fn code_of(cost: f64) -> u8 {
    (1.0 + 254.0 * cost.ln() / DEAREST.ln()).round().clamp(1.0, 255.0) as u8
}

/// A place that no way may pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stopper {
    /// Its middle (mm, LPS).
    pub center: DVec3,
    /// Its radius (mm).
    pub radius: f64,
}

/// The costs of one block of voxels.
pub type BlockCosts = Arc<[u8; BLOCK]>;

/// The costs of all blocks that were needed so far. A byte per voxel.
#[derive(Clone, Debug)]
pub struct Region {
    /// What lumen looks like.
    pub model: LumenModel,
    /// Where no way may pass.
    pub stoppers: Vec<Stopper>,
    strictness: Strictness,
    made: Blocks<BlockCosts>,
}

impl Region {
    /// A region of a volume of which nothing is known yet.
    pub fn new(size: [usize; 3], model: LumenModel, stoppers: Vec<Stopper>, strictness: Strictness) -> Self {
        Self { model, stoppers, strictness, made: Blocks::new(size) }
    }

    /// The costs of the block at a place among all of the volume, made where they are first needed.
    pub fn costs_of(&mut self, voxels: &Voxels, place: usize) -> BlockCosts {
        if let Some(number) = self.made.find(place) {
            return Arc::clone(&self.made[number]);
        }
        let costs = Arc::new(self.make(voxels, place));
        self.made.find_or_make(place, |_| Arc::clone(&costs));
        costs
    }

    /// The cost of a voxel, as a code.
    pub fn code_of(&mut self, voxels: &Voxels, voxel: [i32; 3]) -> u8 {
        self.costs_of(voxels, self.made.place_of(voxel))[index_of(voxel)]
    }

    /// From this code on the membership is below `limit`.
    pub fn code_below(&self, limit: f64) -> u8 {
        let least = self.strictness.least_membership();
        let membership = least + (1.0 - least) * limit;
        code_of((1.0 + 0.8 * OFF_MIDDLE) / (membership * membership))
    }

    /// Forgets the costs of the blocks that a ball touches.
    pub fn forget(&mut self, voxels: &Voxels, ball: &Stopper) {
        let near = voxels.around(ball.center, ball.radius + 2.0 * voxels.smallest_side);
        let gone: Vec<usize> =
            self.made.places().filter(|place| meets(self.made.corner(*place), near)).collect();
        self.made.forget(|place| gone.contains(&place));
    }

    fn make(&self, voxels: &Voxels, place: usize) -> [u8; BLOCK] {
        let corner = self.made.corner(place);
        let mut shares = vec![0.0; WIDE * WIDE * WIDE];
        voxels.cube(corner.map(|c| c - HALO as i32), WIDE, &mut shares);
        let beside_bone = beside(&shares, |value| self.model.is_far_above(value));
        for share in &mut shares {
            *share = self.model.membership(*share);
        }
        let near = blurred(&shares, &[0.25, 0.5, 0.25]);
        let noise = self.model.noise_of_membership() * NOISE_LEFT;
        let wide = blurred(&shares, &[1.0 / 7.0; 7]);
        let least = self.strictness.least_membership();
        let mut codes = [FORBIDDEN; BLOCK];
        for k in 0..SIDE {
            for j in 0..SIDE {
                for i in 0..SIDE {
                    let from = ((k + HALO) * WIDE + j + HALO) * WIDE + i + HALO;
                    let bends = bends(&near, from);
                    let rim = if beside_bone[from] { RIM } else { 1.0 };
                    let share = rim * raised(f64::from(near[from]), &bends, noise);
                    let membership = least + (1.0 - least) * share;
                    let off_middle = OFF_MIDDLE.mul_add(1.0 - f64::from(wide[from]), 1.0);
                    let wall = WALL.mul_add(wall_between(f64::from(near[from]), &bends), 1.0);
                    codes[(k * SIDE + j) * SIDE + i] = code_of(wall * off_middle / (membership * membership));
                }
            }
        }
        self.forbid(voxels, corner, &mut codes);
        codes
    }

    /// Forbids the voxels of a block that lie outside the volume or within a stopper.
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
