//! A front of voxels that grows by Dijkstra's algorithm with buckets. The straight distance to the target is the
//! lower bound (A*). Each voxel has 26 neighbours. Their distances are taken in world space, so any affine grid
//! works.

use std::sync::Arc;

use glam::DVec3;

use crate::trace::ways::barrier::{change_per_level, cost_of_change};
use crate::trace::ways::blocks::{BLOCK, Blocks, SIDE, index_in, index_of, meets, voxel_of};
use crate::trace::ways::buckets::Buckets;
use crate::trace::ways::region::{BlockCosts, FORBIDDEN, Region, WEAK, costs};
use crate::voxels::Voxels;
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, go_on};

/// Codes used instead of a parent: for the start voxel, and for voxels that were not reached.
const START: u8 = 26;
const NONE: u8 = 255;

const BETWEEN_STOPS: usize = 1 << 10;

/// Unit (mm) in which the lengths of gaps without lumen are stored.
const GAP_UNIT_MM: f64 = 0.1;

/// Data of a front for one block of voxels: six bytes per voxel, and the costs.
#[derive(Clone, Debug)]
struct Block {
    costs: Arc<BlockCosts>,
    corner: [i32; 3],
    way: Box<[f32; BLOCK]>,
    /// One bit per voxel, set once its neighbours have been updated.
    offered: Box<[u64; BLOCK / 64]>,
    parent: Box<[u8; BLOCK]>,
    run: Box<[u8; BLOCK]>,
}

impl Block {
    fn is_offered(&self, voxel: usize) -> bool {
        self.offered[voxel / 64] >> (voxel % 64) & 1 != 0
    }
}

#[derive(Clone, Copy, Debug)]
struct Waiting {
    place: u32,
    way: f32,
}

/// How far a front may grow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// Longest allowed gap without lumen (mm), at most 25; None if it is not limited.
    pub longest_gap: Option<f64>,
    /// Maximum number of voxels of the front.
    pub most_voxels: usize,
    /// Weight of the straight distance. With 1 the cheapest path is found; more is faster, but the path may
    /// cost up to that factor more.
    pub pull: f32,
}

/// Result of a search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Found {
    /// The target was reached.
    Target,
    /// There is no path.
    NoWay,
    /// The front reached its maximum number of voxels.
    TooFar,
}

/// A front, with all voxels that it reached.
#[derive(Clone, Debug)]
pub struct Front {
    source: [i32; 3],
    reach: Reach,
    known: Blocks<Block>,
    waiting: Buckets<Waiting>,
    settled: usize,
    /// Steps to the neighbours along (i, j, k), with their lengths in world space (mm).
    steps: [([i32; 3], f32); 26],
    per_level: [f32; 26],
    costs: [f32; 256],
    weak: u8,
}

impl Front {
    /// A front that starts at the voxel `source`.
    pub fn new(voxels: &Voxels, region: &mut Region, source: [i32; 3], reach: Reach) -> Self {
        let mut front = Self {
            source,
            reach,
            known: Blocks::new(voxels.size),
            waiting: Buckets::default(),
            settled: 0,
            steps: steps(voxels),
            per_level: steps(voxels).map(|(_, length)| change_per_level(length)),
            costs: costs(),
            weak: region.code_below(WEAK),
        };
        let (block, voxel) = front.locate(voxels, region, source);
        front.known[block].way[voxel] = 0.0;
        front.known[block].parent[voxel] = START;
        front.waiting.put(0.0, Waiting { place: place_of(block, voxel), way: 0.0 });
        front
    }

    /// The voxel at which the front started.
    pub fn source(&self) -> [i32; 3] {
        self.source
    }

    /// Grows the front until the path to `target` is known. `report` receives the remaining distance (mm).
    pub fn grow(
        &mut self,
        voxels: &Voxels,
        region: &mut Region,
        target: [i32; 3],
        stop: Stop,
        report: &dyn Fn(f64),
    ) -> Result<Found> {
        let (block, voxel) = self.locate(voxels, region, target);
        let goal = voxels.center(target);
        self.aim(voxels, goal);
        let mut nearest = f64::MAX;
        let mut until_stop = 0;
        loop {
            let way = self.known[block].way[voxel];
            // A cheaper path would have been in an earlier bucket.
            if way.is_finite() && self.waiting.have_passed(way) {
                return Ok(Found::Target);
            }
            if until_stop == 0 {
                go_on(stop)?;
                until_stop = BETWEEN_STOPS;
                report(nearest);
            }
            until_stop -= 1;
            let Some(waiting) = self.waiting.pop() else {
                return Ok(if way.is_finite() { Found::Target } else { Found::NoWay });
            };
            if let Some(distance) = self.settle(voxels, region, waiting, goal) {
                nearest = nearest.min(distance);
                if self.settled > self.reach.most_voxels {
                    return Ok(Found::TooFar);
                }
            }
        }
    }

    pub(crate) fn cost_between(&self, from: [i32; 3], to: [i32; 3]) -> f64 {
        let [from, to] = [from, to].map(|voxel| {
            self.find(voxel).map_or(f32::INFINITY, |(block, voxel)| self.known[block].way[voxel])
        });
        f64::from(to - from)
    }

    pub(crate) fn has_come_to(&self, target: [i32; 3]) -> bool {
        self.find(target).is_some_and(|(block, voxel)| self.known[block].way[voxel].is_finite())
    }

    /// Voxels of the path from the start to `target`, which must have been reached.
    pub fn way_to(&self, target: [i32; 3]) -> Vec<[i32; 3]> {
        let mut way = vec![target];
        let mut here = target;
        while let Some((block, voxel)) = self.find(here) {
            let parent = self.known[block].parent[voxel];
            if parent >= START {
                break;
            }
            let step = self.steps[usize::from(parent)].0;
            here = std::array::from_fn(|a| here[a] - step[a]);
            way.push(here);
        }
        way.reverse();
        way
    }

    /// Whether the front has reached blocks that intersect a ball.
    pub fn touches(&self, voxels: &Voxels, center: DVec3, radius: f64) -> bool {
        let ball = voxels.around(center, radius);
        self.known.places().any(|place| meets(self.known.corner(place), ball))
    }

    fn aim(&mut self, voxels: &Voxels, goal: DVec3) {
        for waiting in self.waiting.drain() {
            let (block, voxel) = parts_of(waiting.place);
            if self.known[block].way[voxel] >= waiting.way {
                let left = voxels.center(voxel_of(self.known[block].corner, voxel)).distance(goal);
                self.waiting.put(waiting.way + self.reach.pull * left as f32, waiting);
            }
        }
    }

    /// Updates the neighbours of a voxel. Returns its distance to the goal (mm), or None for an outdated entry.
    fn settle(&mut self, voxels: &Voxels, region: &mut Region, waiting: Waiting, goal: DVec3) -> Option<f64> {
        let (block, voxel) = parts_of(waiting.place);
        if self.known[block].way[voxel] < waiting.way {
            return None;
        }
        self.settled += 1;
        self.known[block].offered[voxel / 64] |= 1 << (voxel % 64);
        let here = voxel_of(self.known[block].corner, voxel);
        let cost = self.costs[usize::from(self.known[block].costs.codes[voxel])];
        let level = self.known[block].costs.levels.as_ref().map(|levels| levels[voxel]);
        let run = self.known[block].run[voxel];
        // If the pull is above 1, cheaper paths are often found late, so voxels are not updated again.
        let is_pulled = self.reach.pull > 1.0;
        for n in 0..26 {
            let (step, length) = self.steps[n];
            let next: [i32; 3] = std::array::from_fn(|a| here[a] + step[a]);
            let Some((to, at)) = self.neighbour(voxels, region, block, next) else { continue };
            let costs = &self.known[to].costs;
            let code = costs.codes[at];
            if code == FORBIDDEN {
                continue;
            }
            let change = match (level, &costs.levels) {
                (Some(level), Some(levels)) => cost_of_change(level, levels[at], self.per_level[n]),
                _ => 1.0,
            };
            let way = waiting.way + 0.5 * (cost + self.costs[usize::from(code)]) * length * change;
            if way >= self.known[to].way[at] || (is_pulled && self.known[to].is_offered(at)) {
                continue;
            }
            let stretch = if code >= self.weak {
                run.saturating_add((f64::from(length) / GAP_UNIT_MM) as u8)
            } else {
                0
            };
            if self.reach.longest_gap.is_some_and(|longest| f64::from(stretch) * GAP_UNIT_MM > longest) {
                continue;
            }
            let known = &mut self.known[to];
            (known.way[at], known.parent[at], known.run[at]) = (way, n as u8, stretch);
            let left = voxels.center(next).distance(goal);
            self.waiting.put(way + self.reach.pull * left as f32, Waiting { place: place_of(to, at), way });
        }
        Some(voxels.center(here).distance(goal))
    }

    /// Block and index of a voxel that is next to the block `near`; None outside the volume.
    fn neighbour(
        &mut self,
        voxels: &Voxels,
        region: &mut Region,
        near: usize,
        voxel: [i32; 3],
    ) -> Option<(usize, usize)> {
        let corner = self.known[near].corner;
        let inside: [i32; 3] = std::array::from_fn(|a| voxel[a] - corner[a]);
        if inside.iter().all(|c| (0..SIDE as i32).contains(c)) {
            return Some((near, index_in(inside)));
        }
        let is_outside = (0..3).any(|a| voxel[a] < 0 || voxel[a] as usize >= voxels.size[a]);
        (!is_outside).then(|| self.locate(voxels, region, voxel))
    }

    fn locate(&mut self, voxels: &Voxels, region: &mut Region, voxel: [i32; 3]) -> (usize, usize) {
        let block = self.known.find_or_make(self.known.place_of(voxel), |known| {
            let place = known.place_of(voxel);
            Block {
                costs: region.costs_of(voxels, place),
                corner: known.corner(place),
                way: Box::new([f32::INFINITY; BLOCK]),
                offered: Box::new([0; BLOCK / 64]),
                parent: Box::new([NONE; BLOCK]),
                run: Box::new([0; BLOCK]),
            }
        });
        (block, index_of(voxel))
    }

    fn find(&self, voxel: [i32; 3]) -> Option<(usize, usize)> {
        Some((self.known.find(self.known.place_of(voxel))?, index_of(voxel)))
    }
}

fn place_of(block: usize, voxel: usize) -> u32 {
    (block * BLOCK + voxel) as u32
}

fn parts_of(place: u32) -> (usize, usize) {
    (place as usize / BLOCK, place as usize % BLOCK)
}

/// Steps to the 26 neighbours, with their lengths in world space (mm).
pub(crate) fn steps(voxels: &Voxels) -> [([i32; 3], f32); 26] {
    std::array::from_fn(|n| {
        // Skips the centre, which is the 14th of the 27 positions.
        let n = if n < 13 { n } else { n + 1 };
        let step = [n % 3, n / 3 % 3, n / 9].map(|c| c as i32 - 1);
        let across = voxels.world_from_index.transform_vector3(DVec3::from_array(step.map(f64::from)));
        (step, across.length() as f32)
    })
}
