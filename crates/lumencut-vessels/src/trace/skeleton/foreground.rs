//! The lumen of a mask in its own grid with a border of background. The storage order of the mask has no effect.

use std::ops::Range;

use glam::{DAffine3, DMat3, DVec3};

use crate::trace::skeleton::label_value::LabelValue;
use lumencut_core::error::{Error, ErrorKind, Mend, Result};
use lumencut_core::stop::{Stop, go_on};
use lumencut_core::volume::{Volume, Voxels};

pub(crate) const BACKGROUND: u8 = 0;
/// Value of lumen in [`Foreground::cells`].
pub const LUMEN: u8 = 1;

/// The box of voxels around the lumen of a mask.
pub struct Foreground {
    /// Lumen or background of each voxel; i is fastest, then j, then k.
    pub cells: Vec<u8>,
    /// Number of cells along (i, j, k), including the border.
    pub size: [usize; 3],
    /// Maps a continuous index of this grid to a world position (LPS, mm).
    pub world_from_index: DAffine3,
}

impl Foreground {
    /// The voxels of `mask` whose value is in `labels`; without labels, all voxels except 0.
    ///
    /// Each axis is flipped if necessary, so that the centroid of the lumen lies in its second half (on a
    /// tie: left, back, head). So a mirrored storage order gives the same result. Errors:
    /// [`ErrorKind::Volume`] for fractional values, a single slice, or if no voxel or every voxel is lumen.
    pub fn new(mask: &Volume, labels: Option<&[i64]>, stop: Stop) -> Result<Self> {
        if mask.size().contains(&1) {
            let found = format!("{:?} voxels along i, j, k", mask.size());
            let error = Error::new(ErrorKind::Volume, "mask", found, "at least 2 voxels along each axis");
            return Err(error.mend("a single slice has no centerlines: give the whole mask"));
        }
        match mask.voxels() {
            #[cfg(not(target_arch = "wasm32"))]
            Voxels::I8(voxels) => Self::of(mask, voxels, labels, stop),
            Voxels::U8(voxels) => Self::of(mask, voxels, labels, stop),
            Voxels::I16(voxels) => Self::of(mask, voxels, labels, stop),
            Voxels::U16(voxels) => Self::of(mask, voxels, labels, stop),
            #[cfg(not(target_arch = "wasm32"))]
            Voxels::I32(voxels) => Self::of(mask, voxels, labels, stop),
            #[cfg(not(target_arch = "wasm32"))]
            Voxels::U32(voxels) => Self::of(mask, voxels, labels, stop),
            #[cfg(not(target_arch = "wasm32"))]
            Voxels::I64(voxels) => Self::of(mask, voxels, labels, stop),
            #[cfg(not(target_arch = "wasm32"))]
            Voxels::U64(voxels) => Self::of(mask, voxels, labels, stop),
            Voxels::F32(voxels) => Self::of(mask, voxels, labels, stop),
            #[cfg(not(target_arch = "wasm32"))]
            Voxels::F64(voxels) => Self::of(mask, voxels, labels, stop),
        }
    }

    fn of<T: Copy + Default + PartialEq + LabelValue>(
        mask: &Volume,
        voxels: &[T],
        labels: Option<&[i64]>,
        stop: Stop,
    ) -> Result<Self> {
        let rows = Rows { voxels, size: mask.size(), strides: mask.strides() };
        let is_lumen =
            |value: T| value != T::default() && labels.is_none_or(|labels| labels.contains(&value.label()));
        check_whole(&rows, stop)?;
        let extent = Extent::of(&rows, is_lumen, stop)?;
        let found = match extent.count {
            0 => labels.map_or_else(
                || "only zeros".to_owned(),
                |labels| format!("no voxel with one of the values {labels:?}"),
            ),
            count if count == rows.count() => "lumen in every voxel".to_owned(),
            _ => return Ok(extent.foreground(mask, &rows, is_lumen)),
        };
        let error =
            Error::new(ErrorKind::Volume, "mask", found, "lumen in some voxels and background in the others");
        Err(error.mend("give the values that stand for lumen"))
    }

    /// Distance between neighbours along each axis, in cells.
    pub fn strides(&self) -> [usize; 3] {
        [1, self.size[0], self.size[0] * self.size[1]]
    }

    /// Index (i, j, k) of a cell.
    pub fn index(&self, cell: usize) -> [usize; 3] {
        let [ni, nj, _] = self.size;
        [cell % ni, cell / ni % nj, cell / (ni * nj)]
    }

    /// World position (LPS, mm) of a cell centre.
    pub fn position(&self, cell: usize) -> DVec3 {
        let index = self.index(cell).map(|n| n as f64);
        self.world_from_index.transform_point3(DVec3::from_array(index))
    }

    /// Voxel sides (mm).
    pub fn sides(&self) -> [f64; 3] {
        let DMat3 { x_axis, y_axis, z_axis } = self.world_from_index.matrix3;
        [x_axis.length(), y_axis.length(), z_axis.length()]
    }

    /// Smallest voxel side (mm).
    pub fn smallest_side(&self) -> f64 {
        self.sides().into_iter().fold(f64::INFINITY, f64::min)
    }

    /// Range of the cells of a row along i.
    pub fn row(&self, row: usize) -> Range<usize> {
        row * self.size[0]..(row + 1) * self.size[0]
    }
}

/// Rejects fractional values, because they mean a partial lumen or the values of a scan.
fn check_whole<T: Copy + LabelValue>(rows: &Rows<T>, stop: Stop) -> Result<()> {
    if T::IS_WHOLE {
        return Ok(());
    }
    let along = rows.along();
    for (number, start) in rows.starts(along).enumerate() {
        if number % 4096 == 0 {
            go_on(stop)?;
        }
        if let Some(odd) = rows.values(along, rows.place(start)).find_map(LabelValue::odd) {
            let found = format!("a voxel of {odd}");
            let error = Error::new(ErrorKind::Volume, "mask", found, "whole numbers, 0 for background");
            return Err(error.mended_by(Mend::Threshold));
        }
    }
    Ok(())
}

struct Rows<'a, T> {
    voxels: &'a [T],
    size: [usize; 3],
    strides: [usize; 3],
}

impl<T: Copy> Rows<'_, T> {
    fn count(&self) -> usize {
        self.size.iter().product()
    }

    fn values(&self, along: usize, place: usize) -> impl Iterator<Item = T> {
        let stride = self.strides[along].max(1);
        let end = place + (self.size[along] - 1) * stride + 1;
        self.voxels[place..end].iter().step_by(stride).copied()
    }

    /// Tests whether all values are zero, as in most rows; the code has no branches, for speed.
    fn is_empty(&self, along: usize, place: usize) -> bool
    where
        T: Default + PartialEq,
    {
        let is_filled = |filled: bool, value: &T| filled | (*value != T::default());
        if self.strides[along] == 1 {
            return !self.voxels[place..place + self.size[along]].iter().fold(false, is_filled);
        }
        !self.values(along, place).fold(false, |filled, value| is_filled(filled, &value))
    }

    fn along(&self) -> usize {
        (0..3).min_by_key(|&a| self.strides[a]).unwrap_or(0)
    }

    fn starts(&self, along: usize) -> impl Iterator<Item = [usize; 3]> {
        let [near, far] = [(along + 1) % 3, (along + 2) % 3];
        let size = self.size;
        (0..size[far]).flat_map(move |f| {
            (0..size[near]).map(move |n| {
                let mut index = [0; 3];
                (index[near], index[far]) = (n, f);
                index
            })
        })
    }

    fn place(&self, index: [usize; 3]) -> usize {
        (0..3).map(|a| index[a] * self.strides[a]).sum()
    }
}

struct Extent {
    low: [usize; 3],
    high: [usize; 3],
    count: usize,
    sums: [u128; 3],
}

impl Extent {
    fn of<T: Copy + Default + PartialEq>(
        rows: &Rows<T>,
        is_lumen: impl Fn(T) -> bool,
        stop: Stop,
    ) -> Result<Self> {
        let mut found = Self { low: [usize::MAX; 3], high: [0; 3], count: 0, sums: [0; 3] };
        let along = rows.along();
        for (number, start) in rows.starts(along).enumerate() {
            if number % 4096 == 0 {
                go_on(stop)?;
            }
            let place = rows.place(start);
            if rows.is_empty(along, place) {
                continue;
            }
            for (n, value) in rows.values(along, place).enumerate() {
                if is_lumen(value) {
                    let mut index = start;
                    index[along] = n;
                    found.add(index);
                }
            }
        }
        Ok(found)
    }

    fn add(&mut self, index: [usize; 3]) {
        for a in 0..3 {
            self.low[a] = self.low[a].min(index[a]);
            self.high[a] = self.high[a].max(index[a]);
            self.sums[a] += index[a] as u128;
        }
        self.count += 1;
    }

    fn turned(&self, world_from_index: DAffine3) -> [bool; 3] {
        let axes = world_from_index.matrix3.to_cols_array_2d();
        std::array::from_fn(|a| {
            let twice_mean = 2 * self.sums[a];
            let twice_middle = (self.low[a] + self.high[a]) as u128 * self.count as u128;
            let longest =
                axes[a].iter().fold(0.0_f64, |most, c| if c.abs() > most.abs() { *c } else { most });
            if twice_mean == twice_middle { longest < 0.0 } else { twice_mean < twice_middle }
        })
    }

    fn foreground<T: Copy + Default + PartialEq>(
        &self,
        mask: &Volume,
        rows: &Rows<T>,
        is_lumen: impl Fn(T) -> bool,
    ) -> Foreground {
        let turned = self.turned(mask.world_from_index());
        let size: [usize; 3] = std::array::from_fn(|a| self.high[a] - self.low[a] + 3);
        let mut cells = vec![BACKGROUND; size.iter().product()];
        let place_of = |index: [usize; 3]| {
            let n: [usize; 3] = std::array::from_fn(|a| {
                if turned[a] { self.high[a] - index[a] + 1 } else { index[a] - self.low[a] + 1 }
            });
            n[0] + size[0] * (n[1] + size[1] * n[2])
        };
        let along = rows.along();
        let is_inside = |index: &[usize; 3]| {
            (0..3).all(|a| a == along || (self.low[a]..=self.high[a]).contains(&index[a]))
        };
        for start in rows.starts(along).filter(is_inside) {
            let place = rows.place(start);
            for (n, value) in rows.values(along, place).enumerate() {
                if is_lumen(value) {
                    let mut index = start;
                    index[along] = n;
                    cells[place_of(index)] = LUMEN;
                }
            }
        }
        Foreground { cells, size, world_from_index: self.placed(mask.world_from_index(), turned) }
    }

    fn placed(&self, world_from_index: DAffine3, turned: [bool; 3]) -> DAffine3 {
        let scale = DVec3::from_array(turned.map(|turned| if turned { -1.0 } else { 1.0 }));
        let first = DVec3::from_array(std::array::from_fn(|a| {
            if turned[a] { self.high[a] as f64 + 1.0 } else { self.low[a] as f64 - 1.0 }
        }));
        world_from_index * DAffine3::from_mat3_translation(DMat3::from_diagonal(scale), first)
    }
}
