//! The voxels with values of lumen that are joined with a seed: a flood that is made block by block.

use glam::DVec3;

use crate::trace::lumen::lumen_model::LumenModel;
use crate::trace::ways::blocks::{BLOCK, Blocks, SIDE, index_of, voxel_of};
use crate::voxels::Voxels;
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, go_on};

/// Lumen begins where a value is half way from the tissue around it, as its wall does.
const WALL: f64 = 0.5;

/// How many voxels are looked at before the caller is asked whether to stop.
const BETWEEN_STOPS: usize = 1 << 15;

/// In place of the number of a voxel: no lumen, and lumen that the flood has not come to.
const NO_LUMEN: u32 = u32::MAX;
const DRY: u32 = u32::MAX - 1;

/// The numbers of the voxels of a block.
type Numbers = Box<[u32; BLOCK]>;

/// All voxels of lumen that are joined with a seed by faces. Each has a number, the seed's is 0.
pub struct Flood {
    size: [usize; 3],
    blocks: Blocks<Numbers>,
    /// The block and the place in it of each voxel.
    places: Vec<u32>,
}

impl Flood {
    /// The flood from a voxel, whatever its value is; none where it has more than `most` voxels.
    ///
    /// # Errors
    /// [`lumencut_core::error::ErrorKind::Interrupted`].
    pub fn from(
        voxels: &Voxels,
        model: &LumenModel,
        seed: [i32; 3],
        most: usize,
        stop: Stop,
    ) -> Result<Option<Self>> {
        let mut flood = Self { size: voxels.size, blocks: Blocks::new(voxels.size), places: Vec::new() };
        let bounds = bounds(model).map(|bound| bound as f32);
        flood.reach(voxels, bounds, seed, true);
        let mut next = 0;
        while next < flood.places.len() {
            if next % BETWEEN_STOPS == 0 {
                go_on(stop)?;
            }
            let [i, j, k] = flood.voxel(next as u32);
            for voxel in
                [[i - 1, j, k], [i + 1, j, k], [i, j - 1, k], [i, j + 1, k], [i, j, k - 1], [i, j, k + 1]]
            {
                flood.reach(voxels, bounds, voxel, false);
            }
            if flood.places.len() > most {
                return Ok(None);
            }
            next += 1;
        }
        Ok(Some(flood))
    }

    /// The number of voxels.
    pub fn count(&self) -> usize {
        self.places.len()
    }

    /// The index (i, j, k) of a voxel.
    pub fn voxel(&self, number: u32) -> [i32; 3] {
        let place = self.places[number as usize] as usize;
        voxel_of(self.blocks.corner_of(place / BLOCK), place % BLOCK)
    }

    /// The block of the volume that a voxel lies in, and its place there.
    pub fn block_of(&self, number: u32) -> (usize, usize) {
        let place = self.places[number as usize] as usize;
        (self.blocks.place(place / BLOCK), place % BLOCK)
    }

    /// The number of the voxel at an index, where it belongs to the flood.
    pub fn number_at(&self, voxel: [i32; 3]) -> Option<u32> {
        let (place, inside) = self.locate(voxel)?;
        let number = self.blocks[self.blocks.find(place)?][inside];
        (number < DRY).then_some(number)
    }

    /// The numbers of the voxels whose centres lie within a ball.
    pub fn within(&self, voxels: &Voxels, center: DVec3, radius: f64, mut found: impl FnMut(u32)) {
        let (first, count) = voxels.around(center, radius);
        for k in first[2]..first[2] + count[2] {
            for j in first[1]..first[1] + count[1] {
                for i in first[0]..first[0] + count[0] {
                    let voxel = [i, j, k];
                    let is_inside =
                        |_: &u32| voxels.center(voxel).distance_squared(center) <= radius * radius;
                    if let Some(number) = self.number_at(voxel).filter(is_inside) {
                        found(number);
                    }
                }
            }
        }
    }

    /// Takes a voxel into the flood where it is lumen, or where `always` says so.
    fn reach(&mut self, voxels: &Voxels, bounds: [f32; 2], voxel: [i32; 3], always: bool) {
        let Some((place, inside)) = self.locate(voxel) else { return };
        let block = self.blocks.find_or_make(place, |blocks| dry(voxels, bounds, blocks.corner(place)));
        let number = &mut self.blocks[block][inside];
        if *number == DRY || (always && *number == NO_LUMEN) {
            *number = self.places.len() as u32;
            self.places.push((block * BLOCK + inside) as u32);
        }
    }

    /// The block of a voxel and its place there; none outside the volume.
    fn locate(&self, voxel: [i32; 3]) -> Option<(usize, usize)> {
        // Negative indices are huge without a sign.
        let is_inside = (0..3).all(|a| (voxel[a] as usize) < self.size[a]);
        is_inside.then(|| (self.blocks.place_of(voxel), index_of(voxel)))
    }
}

/// The numbers of a block that the flood has not come to.
fn dry(voxels: &Voxels, [least, most]: [f32; 2], corner: [i32; 3]) -> Numbers {
    let mut values = vec![0.0; BLOCK];
    voxels.cube(corner, SIDE, &mut values);
    let mut numbers = Box::new([NO_LUMEN; BLOCK]);
    for (number, value) in numbers.iter_mut().zip(&values) {
        if *value >= least && *value <= most {
            *number = DRY;
        }
    }
    numbers
}

/// The smallest and the largest value of lumen.
pub fn bounds(model: &LumenModel) -> [f64; 2] {
    [model.tissue + WALL * model.contrast(), model.brightest()]
}
