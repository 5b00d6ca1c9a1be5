//! The branches of a flood: from the farthest voxels back to what is known, as far as each is a tube.

use glam::DVec3;

use super::flood::Flood;
use super::lumen_model::LumenModel;
use super::refine::{Centerline, refined};
use super::seed_ways::{NONE, Ways};
use super::tube::sound;
use super::voxels::Voxels;
use crate::error::Result;
use crate::stop::Stop;

/// A branch holds the voxels within so many of its radii, and at least so many voxels beyond its wall.
const HELD: f64 = 1.25;
const BEYOND: f64 = 1.0;

/// What is shorter beyond the branch that it leaves is a bump of its wall (mm).
const SHORTEST: f64 = 3.0;

/// How far back into the branch that it leaves a new one is looked at (mm).
const LEAD: f64 = 4.0;

/// What became of a voxel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Voxel {
    /// Nothing yet.
    Free,
    /// It lies in a branch.
    Kept,
    /// It lies in a bump of a wall.
    Bump,
    /// It lies behind a place where the flood is no tube.
    Dropped,
}

/// What the search has found.
pub struct Branches {
    /// The numbers of the voxels in branches, rising.
    pub kept: Vec<u32>,
    /// Where the flood goes on but is no tube, and how many voxels lie behind.
    pub leaks: Vec<(DVec3, usize)>,
}

/// The search of branches.
pub struct Search<'a, 'v> {
    /// The volume.
    pub voxels: &'a Voxels<'v>,
    /// What lumen looks like.
    pub model: &'a LumenModel,
    /// The voxels that may be lumen.
    pub flood: &'a Flood,
    /// The ways through them.
    pub ways: &'a Ways,
    /// A branch ends where it is narrower from there on (mm).
    pub smallest_radius: f64,
    /// Asked whether to stop.
    pub stop: Stop<'a>,
}

impl Search<'_, '_> {
    /// The branches, the farthest first. `told` hears how many voxels are done.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Interrupted`].
    pub fn branches(&self, told: &dyn Fn(usize)) -> Result<Branches> {
        let mut state = vec![Voxel::Free; self.flood.count()];
        let mut leaks = Vec::new();
        for &tip in self.ways.order.iter().rev() {
            told(1);
            if state[tip as usize] == Voxel::Free {
                self.follow(&mut state, tip, &mut leaks)?;
            }
        }
        let kept = (0..state.len() as u32).filter(|n| state[*n as usize] == Voxel::Kept).collect();
        Ok(Branches { kept, leaks })
    }

    /// Follows the way to a voxel from where it leaves what is known, as far as it is a tube.
    fn follow(&self, state: &mut [Voxel], tip: u32, leaks: &mut Vec<(DVec3, usize)>) -> Result<()> {
        let mut way = vec![tip];
        while let Some(next) = self.before(way[way.len() - 1]).filter(|n| state[*n as usize] != Voxel::Kept) {
            way.push(next);
        }
        way.reverse();
        let points: Vec<DVec3> = way.iter().map(|n| self.center(*n)).collect();
        if length(&points) < SHORTEST {
            for number in way {
                state[number as usize] = Voxel::Bump;
            }
            return Ok(());
        }
        let whole = [self.lead(way[0]), points.clone()].concat();
        let line = refined(self.voxels, self.model, &whole, self.stop)?;
        let is_known = |place: DVec3| {
            let number = self.voxels.voxel_at(place).and_then(|voxel| self.flood.number_at(voxel));
            number.is_some_and(|number| state[number as usize] == Voxel::Kept)
        };
        let from = line.points.iter().position(|point| !is_known(*point)).unwrap_or(line.points.len());
        let end = sound(&line, from, self.smallest_radius);
        let behind = match end {
            Some(end) => {
                self.keep(state, &line, end);
                // What follows the end of the tube.
                let nearest = points
                    .iter()
                    .enumerate()
                    .min_by(|a, b| {
                        let distance = |p: &DVec3| p.distance_squared(line.points[end]);
                        distance(a.1).total_cmp(&distance(b.1))
                    })
                    .map_or(0, |(n, _)| n);
                for &number in &way[..=nearest] {
                    state[number as usize] = Voxel::Kept;
                }
                way[nearest + 1..].iter().copied().find(|n| state[*n as usize] != Voxel::Kept)
            }
            None => Some(way[0]),
        };
        if let Some(first) = behind {
            let mut count = 0;
            self.ways.behind(first, |number| {
                if state[number as usize] != Voxel::Kept {
                    state[number as usize] = Voxel::Dropped;
                    count += 1;
                }
            });
            leaks.push((self.center(first), count));
        }
        Ok(())
    }

    /// Keeps what lies within a branch up to its point `end`.
    fn keep(&self, state: &mut [Voxel], line: &Centerline, end: usize) {
        let side = self.voxels.smallest_side;
        let mut last: Option<DVec3> = None;
        for (n, point) in line.points[..=end].iter().enumerate() {
            let radius = line.radius[n];
            if n < end && last.is_some_and(|last| last.distance(*point) < 0.25 * radius) {
                continue;
            }
            last = Some(*point);
            let held = (HELD * radius).max(radius + BEYOND * side);
            self.flood.within(self.voxels, *point, held, |number| state[number as usize] = Voxel::Kept);
        }
    }

    /// The last places before a voxel on its way, in the order of the way.
    fn lead(&self, from: u32) -> Vec<DVec3> {
        let mut points = Vec::new();
        let (mut here, mut walked) = (from, 0.0);
        while let Some(next) = self.before(here).filter(|_| walked < LEAD) {
            walked += self.center(here).distance(self.center(next));
            points.push(self.center(next));
            here = next;
        }
        points.reverse();
        points
    }

    fn before(&self, number: u32) -> Option<u32> {
        Some(self.ways.parent[number as usize]).filter(|parent| *parent != NONE)
    }

    fn center(&self, number: u32) -> DVec3 {
        self.voxels.center(self.flood.voxel(number))
    }
}

fn length(points: &[DVec3]) -> f64 {
    points.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
}
