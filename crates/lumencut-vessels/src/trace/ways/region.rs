//! What a millimetre of way costs at each voxel, for the blocks that a front has come to.

use std::sync::Arc;

use glam::DVec3;

use crate::trace::lumen::lumen_model::LumenModel;
use crate::voxels::Voxels;

/// The side of a block, and the number of its voxels.
pub const SIDE: usize = 16;
/// See `SIDE`.
pub const BLOCK: usize = SIDE * SIDE * SIDE;

/// How far beyond a block its costs look (voxels), and the side of what they look at.
const HALO: usize = 3;
const WIDE: usize = SIDE + 2 * HALO;

/// The membership that even tissue has, so that a way through it is long and not endless.
const LEAST_MEMBERSHIP: f64 = 0.05;
const LEAST_OF_BRIDGES: f64 = 0.2;

/// How much longer a way is that has no lumen around it than one in the middle of a wide vessel.
const OFF_MIDDLE: f64 = 0.4;

/// How much longer a way is through the wall between two vessels.
const WALL: f64 = 15.0;

/// What is left of the membership beside bone, calcium and metal: the edge of bone looks like lumen.
const RIM: f64 = 0.5;

/// How much of what is missing to full membership a ridge makes up for.
const RIDGE: f64 = 0.6;

/// A ridge of less membership is none.
const FAINT: f64 = 0.05;

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
    /// The number of blocks along (i, j, k).
    blocks: [usize; 3],
    made: Vec<Option<BlockCosts>>,
}

impl Region {
    /// A region of a volume of which nothing is known yet.
    pub fn new(size: [usize; 3], model: LumenModel, stoppers: Vec<Stopper>, strictness: Strictness) -> Self {
        let blocks = size.map(|n| n.div_ceil(SIDE));
        Self { model, stoppers, strictness, blocks, made: vec![None; blocks.iter().product()] }
    }

    /// The number of blocks along (i, j, k).
    pub fn blocks(&self) -> [usize; 3] {
        self.blocks
    }

    /// The costs of a block, made where they are first needed.
    pub fn costs_of(&mut self, voxels: &Voxels, block: usize) -> BlockCosts {
        if let Some(made) = &self.made[block] {
            return Arc::clone(made);
        }
        let costs = Arc::new(self.make(voxels, block));
        self.made[block] = Some(Arc::clone(&costs));
        costs
    }

    /// The cost of a voxel, as a code.
    pub fn code_of(&mut self, voxels: &Voxels, voxel: [i32; 3]) -> u8 {
        let [i, j, k] = voxel.map(|c| c as usize);
        let block = ((k / SIDE) * self.blocks[1] + j / SIDE) * self.blocks[0] + i / SIDE;
        self.costs_of(voxels, block)[((k % SIDE) * SIDE + j % SIDE) * SIDE + i % SIDE]
    }

    /// From this code on the membership is below `limit`.
    pub fn code_below(&self, limit: f64) -> u8 {
        let least = self.strictness.least_membership();
        let membership = least + (1.0 - least) * limit;
        code_of((1.0 + 0.8 * OFF_MIDDLE) / (membership * membership))
    }

    /// Forgets the costs of the blocks that a ball touches.
    pub fn forget(&mut self, voxels: &Voxels, ball: &Stopper) {
        let (first, count) = voxels.around(ball.center, ball.radius + 2.0 * voxels.smallest_side);
        for block in 0..self.made.len() {
            let corner = self.corner(block);
            let side = SIDE as i32;
            if (0..3).all(|a| corner[a] < first[a] + count[a] && corner[a] + side > first[a]) {
                self.made[block] = None;
            }
        }
    }

    /// The first voxel of a block.
    pub fn corner(&self, block: usize) -> [i32; 3] {
        let [ni, nj, _] = self.blocks;
        [block % ni, block / ni % nj, block / (ni * nj)].map(|c| (c * SIDE) as i32)
    }

    fn make(&self, voxels: &Voxels, block: usize) -> [u8; BLOCK] {
        let corner = self.corner(block);
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

/// Voxel `n` of the block whose first voxel is `corner`.
pub fn voxel_of(corner: [i32; 3], n: usize) -> [i32; 3] {
    [n % SIDE, n / SIDE % SIDE, n / (SIDE * SIDE)]
        .into_iter()
        .zip(corner)
        .fold(([0; 3], 0), |(mut voxel, a), (step, from)| {
            voxel[a] = from + step as i32;
            (voxel, a + 1)
        })
        .0
}

/// How much a voxel lies in a wall between two lumens, 0 to 1: darker than both its neighbours in one direction, and not
/// brighter than those in the two directions across, as the throat of a stenosis is.
fn wall_between(share: f64, bends: &[f64; 3]) -> f64 {
    if !(0.1..0.95).contains(&share) {
        return 0.0;
    }
    let [most, middle, _] = *bends;
    let is_throat = middle < -THROAT * most;
    if most <= 0.0 || is_throat { 0.0 } else { (most / DIP).min(1.0) }
}

/// The membership of a voxel, which counts for more where it is brighter than its neighbours in two directions across each other: a
/// vessel thinner than a voxel, as in a stenosis, is never as bright as its lumen. Noise of this standard deviation does not count.
fn raised(share: f64, bends: &[f64; 3], noise: f64) -> f64 {
    let is_seen = (share / (2.0 * noise).max(FAINT) - 1.0).clamp(0.0, 1.0);
    let ridge = ((-bends[1] - 2.0 * noise) / share.max(1e-6)).clamp(0.0, 1.0);
    share + (1.0 - share) * RIDGE * ridge * is_seen
}

/// How the membership around a voxel bends, falling: positive where neighbours on both sides are brighter.
fn bends(shares: &[f32], at: usize) -> [f64; 3] {
    let share = f64::from(shares[at]);
    if !(0.02..0.98).contains(&share) {
        return [0.0; 3];
    }
    let strides = [1, WIDE, WIDE * WIDE];
    let value = |n: usize| f64::from(shares[n]);
    let mut bends = [[0.0; 3]; 3];
    for a in 0..3 {
        bends[a][a] = value(at + strides[a]) + value(at - strides[a]) - 2.0 * share;
        for b in 0..a {
            let (plus, minus) = (strides[a] + strides[b], strides[a] - strides[b]);
            let across = value(at + plus) + value(at - plus) - value(at + minus) - value(at - minus);
            (bends[a][b], bends[b][a]) = (across / 4.0, across / 4.0);
        }
    }
    eigenvalues(bends)
}

/// Which voxels of a cube of `WIDE` a side, but for those at its border, or their neighbours are marked.
fn beside(values: &[f32], is_marked: impl Fn(f32) -> bool) -> Vec<bool> {
    let mut marked: Vec<bool> = values.iter().map(|value| is_marked(*value)).collect();
    if !marked.contains(&true) {
        return marked;
    }
    for stride in [1, WIDE, WIDE * WIDE] {
        let before = marked.clone();
        for n in stride..marked.len() - stride {
            marked[n] = before[n - stride] || before[n] || before[n + stride];
        }
    }
    marked
}

/// The eigenvalues of a symmetric matrix, falling.
fn eigenvalues(m: [[f64; 3]; 3]) -> [f64; 3] {
    let mean = (m[0][0] + m[1][1] + m[2][2]) / 3.0;
    let mut square = 2.0 * (m[0][1].powi(2) + m[0][2].powi(2) + m[1][2].powi(2));
    square += (0..3).map(|a| (m[a][a] - mean).powi(2)).sum::<f64>();
    let size = (square / 6.0).sqrt();
    if size < 1e-9 {
        return [mean; 3];
    }
    let unit = |a: usize, b: usize| (m[a][b] - if a == b { mean } else { 0.0 }) / size;
    let matrix =
        glam::DMat3::from_cols_array_2d(&std::array::from_fn(|a| std::array::from_fn(|b| unit(a, b))));
    let angle = (matrix.determinant() / 2.0).clamp(-1.0, 1.0).acos() / 3.0;
    let first = mean + 2.0 * size * angle.cos();
    let last = mean + 2.0 * size * (angle + std::f64::consts::TAU / 3.0).cos();
    [first, 3.0 * mean - first - last, last]
}

/// A wall is this much darker than its neighbours on both sides (membership, twice), and its curvature along it at least
/// this part of that across it where it is none but a throat.
const DIP: f64 = 0.1;
const THROAT: f64 = 0.3;

/// A cube of `WIDE` voxels a side, averaged with these weights along each axis; right where all of them lie within it.
fn blurred(shares: &[f32], weights: &[f32]) -> Vec<f32> {
    let reach = weights.len() / 2;
    let mut now = shares.to_vec();
    let mut next = vec![0.0; shares.len()];
    for stride in [1, WIDE, WIDE * WIDE] {
        let from = reach * stride;
        let length = shares.len() - 2 * from;
        next.fill(0.0);
        for (w, weight) in weights.iter().enumerate() {
            let shifted = &now[w * stride..][..length];
            for (sum, share) in next[from..][..length].iter_mut().zip(shifted) {
                *sum += weight * share;
            }
        }
        std::mem::swap(&mut now, &mut next);
    }
    now
}
