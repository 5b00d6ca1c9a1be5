//! The cheapest way from a seed to every voxel of a flood, and what lies behind each voxel on these ways.

use crate::trace::ways::buckets::Buckets;
use crate::trace::ways::flood::Flood;
use crate::trace::ways::front::steps;
use crate::trace::ways::region::{FORBIDDEN, Region, costs};
use crate::voxels::Voxels;
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, go_on};

/// How many voxels are settled before the caller is asked whether to stop.
const BETWEEN_STOPS: usize = 1 << 14;

/// No voxel: before the seed, or behind the last one.
pub const NONE: u32 = u32::MAX;

/// The cheapest ways as trees of voxels, whose roots are known to be lumen.
pub struct Ways {
    /// What a millimetre costs at each voxel.
    cost: Vec<f32>,
    /// The voxel before each on its way.
    pub parent: Vec<u32>,
    /// The voxels that a way leads to, the nearest first.
    pub order: Vec<u32>,
    first_child: Vec<u32>,
    next_child: Vec<u32>,
}

impl Ways {
    /// The voxels of a flood without any way; ways are cheap in the middle of lumen and dear at walls.
    ///
    /// # Errors
    /// [`lumencut_core::error::ErrorKind::Interrupted`].
    pub fn new(flood: &Flood, voxels: &Voxels, region: &mut Region, stop: Stop) -> Result<Self> {
        let table = costs();
        let count = flood.count();
        let mut cost = Vec::with_capacity(count);
        for number in 0..count {
            if number % BETWEEN_STOPS == 0 {
                go_on(stop)?;
            }
            let (block, inside) = flood.block_of(number as u32);
            let code = region.costs_of(voxels, block)[inside];
            cost.push(if code == FORBIDDEN { f32::INFINITY } else { table[usize::from(code)] });
        }
        Ok(Self {
            cost,
            parent: vec![NONE; count],
            order: Vec::new(),
            first_child: vec![NONE; count],
            next_child: vec![NONE; count],
        })
    }

    /// Finds the cheapest ways from any of some voxels, over those that are open. What comes before the first ones stays.
    ///
    /// # Errors
    /// [`lumencut_core::error::ErrorKind::Interrupted`].
    pub fn find(
        &mut self,
        flood: &Flood,
        voxels: &Voxels,
        from: &[u32],
        is_open: &dyn Fn(u32) -> bool,
        stop: Stop,
    ) -> Result<()> {
        let way = self.settled(flood, voxels, from, is_open, stop)?;
        self.order.clear();
        self.order.extend(
            (0..way.len() as u32).filter(|n| (f32::MIN_POSITIVE..f32::INFINITY).contains(&way[*n as usize])),
        );
        self.order.sort_unstable_by(|a, b| way[*a as usize].total_cmp(&way[*b as usize]).then(a.cmp(b)));
        self.first_child.fill(NONE);
        for &number in self.order.iter().rev() {
            let before = self.parent[number as usize] as usize;
            self.next_child[number as usize] = self.first_child[before];
            self.first_child[before] = number;
        }
        Ok(())
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

    /// Dijkstra's algorithm with buckets: the length of the cheapest way to each voxel, and the voxel before it.
    fn settled(
        &mut self,
        flood: &Flood,
        voxels: &Voxels,
        from: &[u32],
        is_open: &dyn Fn(u32) -> bool,
        stop: Stop,
    ) -> Result<Vec<f32>> {
        let steps = steps(voxels);
        let mut way = vec![f32::INFINITY; self.cost.len()];
        for number in from {
            way[*number as usize] = 0.0;
        }
        let mut waiting = Buckets::default();
        for number in from {
            waiting.put(0.0, (*number, 0.0));
        }
        let mut count = 0;
        while let Some((number, known)) = waiting.pop() {
            if way[number as usize] < known {
                continue;
            }
            if count % BETWEEN_STOPS == 0 {
                go_on(stop)?;
            }
            count += 1;
            let [i, j, k] = flood.voxel(number);
            let here = self.cost[number as usize];
            for ([di, dj, dk], length) in &steps {
                let Some(next) = flood.number_at([i + di, j + dj, k + dk]) else { continue };
                let longer = known + 0.5 * (here + self.cost[next as usize]) * length;
                if longer < way[next as usize] && is_open(next) {
                    way[next as usize] = longer;
                    self.parent[next as usize] = number;
                    waiting.put(longer, (next, longer));
                }
            }
        }
        Ok(way)
    }
}
