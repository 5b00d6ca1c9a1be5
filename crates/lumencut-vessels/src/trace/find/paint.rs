//! The lumens of tracks, painted into voxels. They show where a track meets another one, and what is already tracked.

use std::collections::HashMap;

use glam::DVec3;

/// Side of a block (voxels), and the number of bits that count them.
const SIDE: i32 = 16;
const BITS: u32 = 4;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Painted {
    Empty,
    Lumen(u32),
    /// The centerline of a track that was rejected as not being a vessel.
    Rejected,
}

const EMPTY: u32 = u32::MAX;
const REJECTED: u32 = u32::MAX - 1;

/// Painted voxels on the finest level.
#[derive(Default)]
pub(crate) struct Paint {
    blocks: HashMap<[i32; 3], Box<[u32]>>,
}

impl Paint {
    pub(crate) fn at(&self, place: DVec3) -> Painted {
        let voxel = place.round().to_array().map(|c| c as i32);
        let number = self.blocks.get(&voxel.map(|c| c >> BITS)).map_or(EMPTY, |block| block[inside(voxel)]);
        match number {
            EMPTY => Painted::Empty,
            REJECTED => Painted::Rejected,
            number => Painted::Lumen(number),
        }
    }

    /// Paints voxels that are empty or rejected, or belong to lumens that `gives_way` accepts.
    pub(crate) fn lumen(&mut self, track: u32, center: DVec3, radius: f64, gives_way: &dyn Fn(u32) -> bool) {
        self.ball(center, radius, &mut |number| {
            if *number >= REJECTED || (*number != track && gives_way(*number)) {
                *number = track;
            }
        });
    }

    pub(crate) fn rejected(&mut self, center: DVec3, radius: f64) {
        self.ball(center, radius, &mut |number| {
            if *number == EMPTY {
                *number = REJECTED;
            }
        });
    }

    fn ball(&mut self, center: DVec3, radius: f64, change: &mut dyn FnMut(&mut u32)) {
        let low = (center - radius).round().to_array().map(|c| c as i32);
        let high = (center + radius).round().to_array().map(|c| c as i32);
        let middle = center.round().to_array().map(|c| c as i32);
        for k in low[2]..=high[2] {
            for j in low[1]..=high[1] {
                for i in low[0]..=high[0] {
                    let voxel = [i, j, k];
                    let away = DVec3::from_array(voxel.map(f64::from)).distance_squared(center);
                    if away <= radius * radius || voxel == middle {
                        let block = self
                            .blocks
                            .entry(voxel.map(|c| c >> BITS))
                            .or_insert_with(|| vec![EMPTY; (SIDE * SIDE * SIDE) as usize].into_boxed_slice());
                        change(&mut block[inside(voxel)]);
                    }
                }
            }
        }
    }
}

fn inside(voxel: [i32; 3]) -> usize {
    let [i, j, k] = voxel.map(|c| (c & (SIDE - 1)) as usize);
    i + (j << BITS) + (k << (2 * BITS))
}

#[cfg(test)]
#[path = "tests/paint.rs"]
mod tests;
