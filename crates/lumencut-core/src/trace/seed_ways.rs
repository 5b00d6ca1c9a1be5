//! The cheapest way from a seed to every voxel of a flood, and what lies behind each voxel on these ways.

use glam::DVec3;

use super::flood::Flood;
use super::region::{FORBIDDEN, Region, costs};
use super::voxels::Voxels;
use crate::error::Result;
use crate::stop::{Stop, go_on};

/// Buckets have this width (mm of the cheapest way).
const BUCKET: f32 = 0.25;

/// How many voxels are settled before the caller is asked whether to stop.
const BETWEEN_STOPS: usize = 1 << 14;

/// No voxel: before the seed, or behind the last one.
pub const NONE: u32 = u32::MAX;

/// The cheapest ways as a tree of voxels whose root is the seed.
pub struct Ways {
    /// The voxel before each on its way.
    pub parent: Vec<u32>,
    /// The voxels that a way leads to, the nearest first.
    pub order: Vec<u32>,
    first_child: Vec<u32>,
    next_child: Vec<u32>,
}

impl Ways {
    /// The ways through a flood, cheap in the middle of lumen and dear at walls.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Interrupted`].
    pub fn through(flood: &Flood, voxels: &Voxels, region: &mut Region, stop: Stop) -> Result<Self> {
        let count = flood.count();
        let mut cost = vec![f32::INFINITY; count];
        let table = costs();
        for number in 0..count as u32 {
            let (block, inside) = flood.block_of(number);
            let code = region.costs_of(voxels, block)[inside];
            cost[number as usize] = if code == FORBIDDEN { f32::INFINITY } else { table[usize::from(code)] };
        }
        let (way, parent) = settled(flood, voxels, &cost, stop)?;
        drop(cost);
        let mut order: Vec<u32> = (0..count as u32).filter(|n| way[*n as usize].is_finite()).collect();
        order.sort_unstable_by(|a, b| way[*a as usize].total_cmp(&way[*b as usize]).then(a.cmp(b)));
        let (mut first_child, mut next_child) = (vec![NONE; count], vec![NONE; count]);
        for &number in order.iter().rev() {
            let before = parent[number as usize];
            if before != NONE {
                next_child[number as usize] = first_child[before as usize];
                first_child[before as usize] = number;
            }
        }
        Ok(Self { parent, order, first_child, next_child })
    }

    /// Tells of each voxel whose way leads over `from`, and of that voxel itself.
    pub fn behind(&self, from: u32, mut found: impl FnMut(u32)) {
        let mut waiting = vec![from];
        while let Some(number) = waiting.pop() {
            found(number);
            let mut child = self.first_child[number as usize];
            while child != NONE {
                waiting.push(child);
                child = self.next_child[child as usize];
            }
        }
    }
}

/// Dijkstra's algorithm with buckets: the cheapest way to each voxel, and the voxel before it.
fn settled(flood: &Flood, voxels: &Voxels, cost: &[f32], stop: Stop) -> Result<(Vec<f32>, Vec<u32>)> {
    let steps = steps(voxels);
    let mut way = vec![f32::INFINITY; cost.len()];
    let mut parent = vec![NONE; cost.len()];
    let mut buckets: Vec<Vec<(u32, f32)>> = vec![vec![(0, 0.0)]];
    way[0] = 0.0;
    let (mut first, mut count) = (0, 0);
    while first < buckets.len() {
        let Some((number, known)) = buckets[first].pop() else {
            buckets[first] = Vec::new();
            first += 1;
            continue;
        };
        if way[number as usize] < known {
            continue;
        }
        if count % BETWEEN_STOPS == 0 {
            go_on(stop)?;
        }
        count += 1;
        let [i, j, k] = flood.voxel(number);
        let here = cost[number as usize];
        for ([di, dj, dk], length) in &steps {
            let Some(next) = flood.number_at([i + di, j + dj, k + dk]) else { continue };
            let longer = known + 0.5 * (here + cost[next as usize]) * length;
            if longer < way[next as usize] {
                way[next as usize] = longer;
                parent[next as usize] = number;
                let bucket = (longer / BUCKET) as usize;
                if bucket >= buckets.len() {
                    buckets.resize_with(bucket + 1, Vec::new);
                }
                buckets[bucket].push((next, longer));
            }
        }
    }
    Ok((way, parent))
}

/// The steps to the 26 neighbours, and their lengths in the world (mm).
fn steps(voxels: &Voxels) -> Vec<([i32; 3], f32)> {
    (0..27)
        .filter(|n| *n != 13)
        .map(|n| {
            let step = [n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1];
            let across = voxels.world_from_index.transform_vector3(DVec3::from_array(step.map(f64::from)));
            (step, across.length() as f32)
        })
        .collect()
}
