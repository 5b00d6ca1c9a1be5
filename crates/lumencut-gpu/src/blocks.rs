//! The ranges of a volume's blocks on the GPU.

use lumencut_core::error::Result;
use lumencut_core::math::blocks::{Blocks, Range};
use lumencut_core::math::context_parameters::BlockLayout;
use wgpu::Buffer;

use crate::device::Device;

#[derive(Debug)]
pub(crate) struct DeviceBlocks {
    pub ranges: Buffer,
    pub places: BlockLayout,
}

impl DeviceBlocks {
    /// Sends the blocks to the GPU, without the smallest ones if all together exceed the size of a binding.
    pub(crate) fn new(device: &Device, blocks: &Blocks) -> Result<Self> {
        let room = device.limits.max_storage_buffer_binding_size.min(device.limits.max_buffer_size);
        let all: Vec<_> = blocks.levels().collect();
        let finest = first_that_fits(&all, room as usize / size_of::<[f32; 2]>());
        let mut ranges: Vec<[f32; 2]> = Vec::with_capacity(length(&all[finest..]));
        let mut places = BlockLayout { finest: finest as u32, ..BlockLayout::default() };
        for ((size, level), place) in all[finest..].iter().zip(&mut places.levels) {
            let [i, j, k] = size.map(|n| n as u32);
            *place = [i, j, k, ranges.len() as u32];
            places.level_count += 1;
            ranges.extend(level.iter().map(|Range { low, high }| [*low, *high]));
        }
        let ranges = device.upload("blocks", &ranges);
        device.check()?;
        Ok(Self { ranges, places })
    }
}

/// The first level that, together with all coarser ones, fits in a buffer for `most` blocks.
pub(crate) fn first_that_fits(levels: &[([usize; 3], &[Range])], most: usize) -> usize {
    (0..levels.len()).find(|first| length(&levels[*first..]) <= most).unwrap_or(levels.len() - 1)
}

fn length(levels: &[([usize; 3], &[Range])]) -> usize {
    levels.iter().map(|(_, ranges)| ranges.len()).sum()
}
