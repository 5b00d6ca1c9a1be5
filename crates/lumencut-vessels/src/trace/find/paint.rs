//! The lumens of the tracks as they are painted into voxels: where a track ends in another one, and what needs no new one.

use std::collections::HashMap;

use glam::DVec3;

/// The side of a block of voxels.
const SIDE: i32 = 16;
const BITS: u32 = 4;

/// What is painted in a voxel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Painted {
    /// Nothing.
    Empty,
    /// The lumen of a track.
    Lumen(u32),
    /// The middle of a track that is no vessel.
    Rejected,
}

/// The number of a voxel that holds nothing, and of one that holds the middle of a rejected track.
const EMPTY: u32 = u32::MAX;
const REJECTED: u32 = u32::MAX - 1;

/// The voxels of the finest level that are painted.
#[derive(Default)]
pub(crate) struct Paint {
    blocks: HashMap<[i32; 3], Box<[u32]>>,
}

impl Paint {
    /// What is painted at a place (voxels of the finest level).
    pub(crate) fn at(&self, place: DVec3) -> Painted {
        let voxel = place.round().to_array().map(|c| c as i32);
        let number = self.blocks.get(&voxel.map(|c| c >> BITS)).map_or(EMPTY, |block| block[inside(voxel)]);
        match number {
            EMPTY => Painted::Empty,
            REJECTED => Painted::Rejected,
            number => Painted::Lumen(number),
        }
    }

    /// Paints the lumen of a track around one of its points, over whatever `gives_way` allows.
    pub(crate) fn lumen(&mut self, track: u32, center: DVec3, radius: f64, gives_way: &dyn Fn(u32) -> bool) {
        self.ball(center, radius, &mut |number| {
            if *number >= REJECTED || (*number != track && gives_way(*number)) {
                *number = track;
            }
        });
    }

    /// Paints the middle of a track that is no vessel.
    pub(crate) fn rejected(&mut self, center: DVec3, radius: f64) {
        self.ball(center, radius, &mut |number| {
            if *number == EMPTY {
                *number = REJECTED;
            }
        });
    }

    /// Changes the voxels of a ball; the one at its centre is always among them.
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

/// The number of a voxel in its block.
fn inside(voxel: [i32; 3]) -> usize {
    let [i, j, k] = voxel.map(|c| (c & (SIDE - 1)) as usize);
    i + (j << BITS) + (k << (2 * BITS))
}

#[cfg(test)]
#[path = "tests/paint.rs"]
mod tests;
