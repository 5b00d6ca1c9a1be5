//! Finds the position of a mask in the grid of its volume, of which the mask may cover only a part.

use glam::{DAffine3, DVec3};
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::volume::Volume;

use crate::text::rounded;

/// Maximum deviation of mask voxels from volume voxels (voxels).
const MAX_VOXEL_OFFSET: f64 = 0.1;
/// Maximum deviation between corners of the two grids, in smallest voxel sides.
const MAX_CORNER_OFFSET: f64 = 0.1;
const ADVICE: &str = "take the mask that was made on this scan, or resample it onto the grid of this scan";

/// The grid of a volume or a mask.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// The number of voxels along (i, j, k).
    pub size: [usize; 3],
    /// Affine from voxel indices to world positions (LPS, mm).
    pub world_from_index: DAffine3,
}

/// The position of a mask on the volume's grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MaskPlace {
    /// The volume axis of each mask axis.
    pub axes: [usize; 3],
    /// For each volume axis, whether the mask runs in the same direction.
    pub forward: [bool; 3],
    /// The lowest mask index along each volume axis.
    pub low: [usize; 3],
}

impl From<&Volume<'_>> for Grid {
    fn from(volume: &Volume<'_>) -> Self {
        Self { size: volume.size(), world_from_index: volume.world_from_index() }
    }
}

impl Grid {
    /// Voxel spacing along (i, j, k), mm.
    fn steps(&self) -> [f64; 3] {
        let axes = self.world_from_index.matrix3;
        [axes.x_axis, axes.y_axis, axes.z_axis].map(DVec3::length)
    }

    fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|c| {
            let side = |a: usize| if c >> a & 1 == 0 { -0.5 } else { self.size[a] as f64 - 0.5 };
            self.world_from_index.transform_point3(DVec3::new(side(0), side(1), side(2)))
        })
    }

    fn times(&self) -> String {
        self.size.map(|n| n.to_string()).join(" × ")
    }

    fn millimetres(&self) -> String {
        self.steps().map(|step| rounded(step, 4)).join(" × ")
    }
}

/// The position of a mask on its volume's grid; None if the grids are equal. The mask's axes may be permuted or
/// flipped. Fails with [`ErrorKind::Volume`] if the mask's voxels are not voxels of the volume.
pub fn place_of(mask: &Grid, volume: &Grid) -> Result<Option<MaskPlace>> {
    let sorted = |grid: &Grid| {
        let mut size = grid.size;
        size.sort_unstable();
        size
    };
    if sorted(mask) == sorted(volume) {
        return check_corners(mask, volume).map(|()| None);
    }
    place_within(mask, volume).map(Some)
}

fn check_corners(mask: &Grid, volume: &Grid) -> Result<()> {
    let corners = volume.corners();
    let nearest =
        mask.corners().map(|own| corners.iter().map(|other| own.distance(*other)).fold(f64::MAX, f64::min));
    let apart = nearest.into_iter().fold(0.0, f64::max);
    if apart > MAX_CORNER_OFFSET * volume.steps().into_iter().fold(f64::MAX, f64::min) {
        let found =
            format!("a grid whose corners lie up to {} mm from those of the volume", rounded(apart, 3));
        return Err(refused(found, format!("the same grid, to {MAX_CORNER_OFFSET} of a voxel")));
    }
    Ok(())
}

/// As [`place_of`], but the result exists for equal grids too, and the mask may cover only part of the volume.
pub fn place_within(mask: &Grid, volume: &Grid) -> Result<MaskPlace> {
    let step = volume.world_from_index.inverse() * mask.world_from_index;
    let columns = [step.matrix3.x_axis, step.matrix3.y_axis, step.matrix3.z_axis];
    let axes = axes_of(mask, &columns).ok_or_else(|| {
        let found = format!("a mask with voxels of {} mm", mask.millimetres());
        refused(found, format!("the voxels of the volume, {} mm", volume.millimetres()))
    })?;
    let beside = step.translation - step.translation.round();
    if beside.abs().max_element() > MAX_VOXEL_OFFSET {
        let apart = volume.world_from_index.transform_vector3(beside).length();
        let found = format!("a mask whose voxels lie {} mm away from those of the volume", rounded(apart, 3));
        return Err(refused(found, format!("the same positions, to {MAX_VOXEL_OFFSET} of a voxel")));
    }
    let (first, mut forward, mut low) = (step.translation.round().to_array(), [true; 3], [0; 3]);
    for (axis, column) in columns.iter().enumerate() {
        let own = axes[axis];
        forward[own] = column[own] > 0.0;
        let length = mask.size[axis] as f64;
        let least = if forward[own] { first[own] } else { first[own] - length + 1.0 };
        if least < 0.0 || least + length > volume.size[own] as f64 {
            let found = format!("a mask of {} voxels that extends beyond the volume", mask.times());
            return Err(refused(found, format!("voxels among the {} of the volume", volume.times())));
        }
        low[own] = least as usize;
    }
    Ok(MaskPlace { axes, forward, low })
}

/// The volume axis of each mask axis; None unless all voxels of the mask coincide with voxels of the volume.
fn axes_of(mask: &Grid, columns: &[DVec3; 3]) -> Option<[usize; 3]> {
    let mut axes = [0; 3];
    for (axis, column) in columns.iter().enumerate() {
        let whole = column.round();
        let drift = (*column - whole).abs().max_element() * (mask.size[axis].max(2) - 1) as f64;
        // The comparison also rejects NaN.
        if !(drift <= MAX_VOXEL_OFFSET && whole.abs().element_sum() == 1.0) {
            return None;
        }
        axes[axis] = whole.abs().max_position();
    }
    (axes[0] != axes[1] && axes[1] != axes[2] && axes[0] != axes[2]).then_some(axes)
}

/// The note about a mask that covers only part of the volume.
pub fn placed_note(mask: [usize; 3], volume: [usize; 3]) -> String {
    let [own, every] = [mask, volume].map(|size| size.map(|n| n.to_string()).join(" × "));
    format!("the mask covers {own} of the {every} voxels of the volume: placed by its own grid, 0 elsewhere")
}

fn refused(found: String, expected: String) -> Error {
    Error::new(ErrorKind::Volume, "mask", found, expected).mend(ADVICE)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(size: [usize; 3], world_from_index: DAffine3) -> Grid {
        Grid { size, world_from_index }
    }

    fn spaced() -> DAffine3 {
        DAffine3::from_scale(DVec3::new(0.5, 0.5, 2.0))
    }

    #[test]
    fn a_part_lies_where_its_grid_says() {
        let volume = grid([40, 30, 20], spaced());
        let part = grid([10, 8, 6], spaced() * DAffine3::from_translation(DVec3::new(5.0, 6.0, 7.0)));
        let place = place_of(&part, &volume).expect("a part").expect("a place");
        assert_eq!(place, MaskPlace { axes: [0, 1, 2], forward: [true; 3], low: [5, 6, 7] });
        // The part is stored with the axes k, −i, j.
        let mut turned = part.world_from_index;
        let [i, j, k] = [turned.matrix3.x_axis, turned.matrix3.y_axis, turned.matrix3.z_axis];
        turned.matrix3 = glam::DMat3::from_cols(k, -i, j);
        turned.translation += i * 9.0;
        let place = place_of(&grid([6, 10, 8], turned), &volume).expect("a part").expect("a place");
        assert_eq!(place, MaskPlace { axes: [2, 0, 1], forward: [false, true, true], low: [5, 6, 7] });
        assert_eq!(place_of(&volume, &volume).expect("whole"), None);
    }

    #[test]
    fn what_lies_elsewhere_is_refused_by_name() {
        let volume = grid([40, 30, 20], spaced());
        let moved = |x: f64, y: f64, z: f64| spaced() * DAffine3::from_translation(DVec3::new(x, y, z));
        let found = |mask: Grid| place_of(&mask, &volume).expect_err("elsewhere").to_string();
        let half = found(grid([10, 8, 6], moved(5.5, 6.0, 7.0)));
        assert!(half.contains("lie 0.25 mm away from") && half.contains("resample"), "{half}");
        let beyond = found(grid([10, 8, 6], moved(-1.0, 6.0, 7.0)));
        assert!(beyond.contains("10 × 8 × 6 voxels that extends beyond the volume"), "{beyond}");
        let finer = found(grid([10, 8, 6], DAffine3::from_scale(DVec3::new(0.25, 0.5, 2.0))));
        assert!(finer.contains("voxels of 0.25 × 0.5 × 2 mm; expected the voxels of the volume"), "{finer}");
        let same = found(grid([40, 30, 20], moved(1.0, 0.0, 0.0)));
        assert!(same.contains("corners lie up to 0.5 mm"), "{same}");
    }
}
