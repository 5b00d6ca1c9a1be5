//! The branches of a flood: from the farthest voxels back to what is known, as far as each is a tube.

use glam::DVec3;

use crate::trace::lines::centerline::Centerline;
use crate::trace::lines::nearest_point::nearest_point;
use crate::trace::lumen::cross_section::Probe;
use crate::trace::lumen::lumen_model::LumenModel;
use crate::trace::lumen::refine::refined;
use crate::trace::lumen::tube::{Sections, Usual, median};
use crate::trace::seed::seed_ways::{NONE, Ways};
use crate::trace::ways::flood::Flood;
use crate::voxels::Voxels;
use lumencut_core::error::Result;
use lumencut_core::stop::Stop;

/// What lies within this many radii of the middle of a branch, or this many voxels beyond its wall, belongs to no other branch.
const NEAR: f64 = 1.25;
const BESIDE: f64 = 1.0;

/// How far beyond its wall a branch has voxels (voxels): its lumen ends between their centres.
const BEYOND: f64 = 0.5;

/// How much of a way is looked at in one go (mm).
const STRETCH: f64 = 80.0;

/// A line has gone astray that is longer than this many times the length of the way that it was made from, plus this length (mm).
const ASTRAY: f64 = 1.25;
const ASTRAY_LENGTH: f64 = 3.0;

/// What is shorter beyond the branch that it leaves is a bump of its wall (mm).
const SHORTEST: f64 = 3.0;

/// How far back into the branch that it leaves a new one is looked at (mm).
const LEAD: f64 = 4.0;

/// Before a way is looked at closely, at least this share of the voxels on its first stretch (mm) has about the values of
/// those before: they differ by no more than this part of the contrast.
const ALIKE: f64 = 0.6;
const FIRST: f64 = 6.0;
const LIKE: f64 = 0.3;

/// How far around the place where it begins a leak is closed (voxels).
const NECK: f64 = 1.1;

/// How often what lies behind leaks is looked at.
const ROUNDS: usize = 3;

/// The number of the seed's voxel.
const SEED: u32 = 0;

/// A line is that of a branch where at least this share of it lies in no other one: others run back into the lumen that
/// their way ran along.
const NEW: f64 = 0.7;

/// A branch has voxels up to this many times its median radius along this many points before.
const WIDER: f64 = 1.25;
const BEFORE: usize = 30;

/// With how many rays a cross-section is looked at.
const RAYS: usize = 24;

/// What became of a voxel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Voxel {
    /// Nothing yet.
    Free,
    /// It lies in a branch.
    Kept,
    /// It lies at the wall of a branch, or beside it.
    Near,
    /// It lies in a bump of a wall.
    Bump,
    /// It lies behind a place where the flood is no tube.
    Dropped,
    /// It lies where such a place begins.
    Leak,
}

/// The search of branches.
pub struct Search<'a, 'v> {
    /// The volume.
    pub voxels: &'a Voxels<'v>,
    /// What lumen looks like.
    pub model: &'a LumenModel,
    /// The voxels that may be lumen.
    pub flood: &'a Flood,
    /// A branch ends where it is narrower from there on (mm).
    pub smallest_radius: f64,
    /// Asked whether to stop.
    pub stop: Stop<'a>,
}

impl Search<'_, '_> {
    /// The numbers of the voxels in branches, rising. `told` hears of each voxel that is done.
    ///
    /// Ways that were found first may lead through bone into a vessel that others reach too. So what lies behind a leak is
    /// looked at again from all that is known by then, until nothing more is found.
    ///
    /// # Errors
    /// [`lumencut_core::error::ErrorKind::Interrupted`].
    pub fn branches(&self, ways: &mut Ways, told: &dyn Fn(usize)) -> Result<Vec<u32>> {
        let mut state = vec![Voxel::Free; self.flood.count()];
        let mut kept = vec![SEED];
        for round in 0..ROUNDS {
            let is_open =
                |number: u32| matches!(state[number as usize], Voxel::Free | Voxel::Near | Voxel::Bump);
            ways.find(self.flood, self.voxels, &kept, &is_open, self.stop)?;
            for &tip in ways.order.iter().rev() {
                told(usize::from(round == 0));
                if state[tip as usize] == Voxel::Free {
                    self.follow(ways, &mut state, tip)?;
                }
            }
            let known = kept.len();
            kept = (0..state.len() as u32).filter(|n| state[*n as usize] == Voxel::Kept).collect();
            if kept.len() == known || kept.is_empty() {
                break;
            }
            for voxel in &mut state {
                if *voxel == Voxel::Dropped {
                    *voxel = Voxel::Free;
                }
            }
        }
        Ok(kept)
    }

    /// Follows the way to a voxel from where it leaves what is known, as far as it is a tube.
    fn follow(&self, ways: &Ways, state: &mut [Voxel], tip: u32) -> Result<()> {
        while state[tip as usize] == Voxel::Free {
            let way = way_to(ways, state, tip);
            let points: Vec<DVec3> = way.iter().map(|n| self.center(*n)).collect();
            if length(&points) < SHORTEST {
                for number in way {
                    state[number as usize] = Voxel::Bump;
                }
            } else if !self.go_on(ways, state, &way, &points)? {
                // What begins at the seed itself may be a tube on another way.
                let first = if way[0] == SEED { way[within(&points, STRETCH) - 1] } else { way[0] };
                self.drop_behind(ways, state, first);
            }
        }
        Ok(())
    }

    /// Keeps a way as far as it is a tube, and tells whether any of it is.
    fn go_on(&self, ways: &Ways, state: &mut [Voxel], way: &[u32], points: &[DVec3]) -> Result<bool> {
        let lead = self.lead(ways, way[0]);
        if !lead.is_empty() && !self.looks_like(&lead, &points[..within(points, FIRST)]) {
            return Ok(false);
        }
        let count = within(points, STRETCH);
        let whole = [&lead, &points[..count]].concat();
        let line = refined(self.voxels, self.model, &whole, self.stop)?;
        let is_inside = |place: DVec3| {
            let number = self.voxels.voxel_at(place).and_then(|voxel| self.flood.number_at(voxel));
            number.is_some_and(|number| is_known(state[number as usize]))
        };
        let from = line.points.iter().position(|point| !is_inside(*point)).unwrap_or(0);
        if from == 0 && !lead.is_empty() {
            return Ok(false);
        }
        let probe = Probe { voxels: self.voxels, model: self.model, rays: RAYS };
        let usual = Usual::of(self.model);
        let is_faithful = |end: usize| {
            let way = length(&points[..=nearest_point(&points[..count], line.points[end])]);
            let new = line.points[from..=end].iter().filter(|point| !is_inside(**point)).count();
            let is_new = new as f64 >= NEW * (end + 1 - from) as f64;
            is_new && length(&line.points[from..=end]) <= ASTRAY * way + ASTRAY_LENGTH
        };
        let sections = Sections::along(&probe, &line);
        let Some(end) = sections.sound(from, self.smallest_radius, &usual, &is_faithful) else {
            return Ok(false);
        };
        let last = nearest_point(&points[..count], line.points[end]);
        self.keep(state, &line, end);
        // The way itself joins what the balls leave open, back to the branch that it leaves.
        let mut here = Some(way[last]);
        let mut is_new = true;
        while let Some(number) = here.filter(|n| is_new || state[*n as usize] != Voxel::Kept) {
            is_new &= number != way[0];
            state[number as usize] = Voxel::Kept;
            here = before(ways, number);
        }
        Ok(true)
    }

    /// Whether most voxels of a way have about the values that those before it have.
    fn looks_like(&self, lead: &[DVec3], points: &[DVec3]) -> bool {
        let mut known: Vec<f32> = lead.iter().map(|place| self.voxels.at(*place)).collect();
        known.sort_unstable_by(f32::total_cmp);
        let level = known[known.len() / 2];
        let most = (LIKE * Usual::of(self.model).contrast).max(3.0 * self.model.noise) as f32;
        let alike = points.iter().filter(|place| (self.voxels.at(**place) - level).abs() <= most).count();
        alike as f64 >= ALIKE * points.len() as f64
    }

    /// Drops what lies behind a voxel, and closes the leak there.
    fn drop_behind(&self, ways: &Ways, state: &mut [Voxel], first: u32) {
        ways.behind(first, |number| {
            if !is_known(state[number as usize]) {
                state[number as usize] = Voxel::Dropped;
            }
        });
        self.flood.within(self.voxels, self.center(first), NECK * self.voxels.smallest_side, |number| {
            let voxel = &mut state[number as usize];
            if !is_known(*voxel) {
                *voxel = Voxel::Leak;
            }
        });
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
            // Where the lumen opens into something else, the line still tells the radius of both.
            let usual = median(&line.radius[n.saturating_sub(BEFORE)..=n]);
            let inside = radius.min(WIDER * usual) + BEYOND * side;
            self.flood.within(self.voxels, *point, (NEAR * radius).max(radius + BESIDE * side), |number| {
                let state = &mut state[number as usize];
                let is_inside = self.center(number).distance_squared(*point) <= inside * inside;
                if is_inside {
                    *state = Voxel::Kept;
                } else if *state != Voxel::Kept {
                    *state = Voxel::Near;
                }
            });
        }
    }

    /// The last places before a voxel on its way, in the order of the way.
    fn lead(&self, ways: &Ways, from: u32) -> Vec<DVec3> {
        let mut points = Vec::new();
        let (mut here, mut walked) = (from, 0.0);
        while let Some(next) = before(ways, here).filter(|_| walked < LEAD) {
            walked += self.center(here).distance(self.center(next));
            points.push(self.center(next));
            here = next;
        }
        points.reverse();
        points
    }

    fn center(&self, number: u32) -> DVec3 {
        self.voxels.center(self.flood.voxel(number))
    }
}

/// The voxels on the way to one, from the first that lies in no branch.
fn way_to(ways: &Ways, state: &[Voxel], tip: u32) -> Vec<u32> {
    let mut way = vec![tip];
    while let Some(next) = before(ways, way[way.len() - 1]).filter(|n| !is_known(state[*n as usize])) {
        way.push(next);
    }
    way.reverse();
    way
}

/// The voxel before another one on its way.
fn before(ways: &Ways, number: u32) -> Option<u32> {
    Some(ways.parent[number as usize]).filter(|parent| *parent != NONE)
}

fn is_known(voxel: Voxel) -> bool {
    matches!(voxel, Voxel::Kept | Voxel::Near)
}

/// How many points lie within a length (mm) from the first one along their line.
fn within(points: &[DVec3], length: f64) -> usize {
    let mut walked = 0.0;
    let is_beyond = |n: &usize| {
        walked += points[*n].distance(points[n - 1]);
        walked > length
    };
    (1..points.len()).find(is_beyond).unwrap_or(points.len())
}

fn length(points: &[DVec3]) -> f64 {
    points.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
}
