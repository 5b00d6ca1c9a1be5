//! Closes gaps of a set of voxels: it is spread by a box, and then its complement.

use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, filled};

/// Closes gaps narrower than about twice `reach` voxels along each axis. Beyond the volume everything counts as part of the set.
pub(super) fn closed(set: &mut [bool], size: [usize; 3], reach: [usize; 3], stop: Stop) -> Result<()> {
    spread(set, size, reach, stop)?;
    set.iter_mut().for_each(|one| *one = !*one);
    spread(set, size, reach, stop)?;
    set.iter_mut().for_each(|one| *one = !*one);
    Ok(())
}

/// Adds all voxels of the boxes of `reach` voxels around the voxels of the set.
pub(super) fn spread(
    set: &mut [bool],
    [ni, nj, nk]: [usize; 3],
    reach: [usize; 3],
    stop: Stop,
) -> Result<()> {
    let rows = [(1, ni), (ni, nj), (ni * nj, nk)];
    for ((stride, count), reach) in rows.into_iter().zip(reach) {
        for part in set.chunks_mut((stride * count).max(1)) {
            let mut before = filled(part.len(), false, stop)?;
            before.copy_from_slice(part);
            spread_along(part, &before, stride, reach);
        }
    }
    Ok(())
}

/// Spreads rows of `stride` voxels along the axis on which they follow each other: once forwards, once backwards. `left` counts
/// for each voxel of a row how far the set still reaches.
fn spread_along(part: &mut [bool], before: &[bool], stride: usize, reach: usize) {
    let count = part.len() / stride;
    let mut pass = |rows: &mut dyn Iterator<Item = usize>| {
        let mut left = vec![0; stride];
        for row in rows {
            for (n, left) in left.iter_mut().enumerate() {
                let at = row * stride + n;
                if before[at] {
                    *left = reach;
                } else if *left > 0 {
                    *left -= 1;
                    part[at] = true;
                }
            }
        }
    };
    pass(&mut (0..count));
    pass(&mut (0..count).rev());
}

#[cfg(test)]
#[path = "tests/closing.rs"]
mod tests;
