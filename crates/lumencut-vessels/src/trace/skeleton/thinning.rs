//! Thins a mask by removing simple points, from the wall inwards. Pudney, "Distance-Ordered Homotopic Thinning",
//! Computer Vision and Image Understanding 72(3), 1998, doi:10.1006/cviu.1998.0680. Voxels at about the same distance
//! are removed from the six sides in turn, so that a vessel two voxels wide is thinned before it is shortened. A
//! voxel with only one neighbour stays.

use crate::trace::skeleton::foreground::{BACKGROUND, Foreground, LUMEN};
use crate::trace::skeleton::simple_point::Neighbourhood;
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, go_on};

/// Range of distances (voxel sides) of the voxels that are removed together.
const TURN_RANGE: f64 = 0.5;

/// Thins lumen to lines of voxels (sorted cells); `squares` are squared distances to background (mm²).
pub(crate) fn thin(
    foreground: &mut Foreground,
    lumen: &[u32],
    squares: &[f32],
    stop: Stop,
) -> Result<Vec<u32>> {
    let step = TURN_RANGE * foreground.smallest_side();
    let turn_of = |cell: u32| (f64::from(squares[cell as usize]).sqrt() / step) as u64;
    let mut waiting: Vec<u64> = lumen.iter().map(|&cell| turn_of(cell) << 32 | u64::from(cell)).collect();
    waiting.sort_unstable();
    let mut front: Vec<u32> = Vec::new();
    let mut next = 0;
    while next < waiting.len() {
        let turn = waiting[next] >> 32;
        while next < waiting.len() && waiting[next] >> 32 == turn {
            front.push(waiting[next] as u32);
            next += 1;
        }
        while remove_from_all_sides(foreground, &mut front, stop)? {}
    }
    Ok(front)
}

/// Removes voxels from each side in turn; returns whether any voxel was removed.
fn remove_from_all_sides(foreground: &mut Foreground, front: &mut Vec<u32>, stop: Stop) -> Result<bool> {
    let strides = foreground.strides();
    let mut removed = false;
    for side in 0..6 {
        go_on(stop)?;
        let stride = strides[side / 2];
        let is_bare = |cells: &[u8], cell: usize| {
            let neighbour = if side % 2 == 0 { cell - stride } else { cell + stride };
            cells[neighbour] == BACKGROUND
        };
        let cells = &mut foreground.cells;
        let bare: Vec<u32> = front
            .iter()
            .copied()
            .filter(|&cell| is_bare(cells, cell as usize) && can_go(cells, cell as usize, strides))
            .collect();
        for cell in bare {
            if can_go(cells, cell as usize, strides) {
                cells[cell as usize] = BACKGROUND;
                removed = true;
            }
        }
        front.retain(|&cell| cells[cell as usize] == LUMEN);
    }
    Ok(removed)
}

fn can_go(cells: &[u8], cell: usize, strides: [usize; 3]) -> bool {
    let around = Neighbourhood::of(cells, cell, strides);
    around.count() > 1 && around.is_simple()
}
