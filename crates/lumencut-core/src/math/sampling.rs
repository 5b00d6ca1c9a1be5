//! Trilinear sampling of the volume at continuous indices, in the volume's own precision.

use glam::DVec3;

use super::lanes::{FAN, larger, smaller};
use crate::volume::{Real, Volume, Voxel};

/// A bound on the rounding of positions (voxels).
pub const POSITION_ROUNDING: f64 = 1e-3;

#[derive(Clone, Copy, Debug)]
pub struct Grid {
    last: [f64; 3],
    /// Along each axis: the last index with a next voxel, and the step to it (elements); both 0 for 1 voxel.
    low: [usize; 3],
    step: [usize; 3],
    strides: [usize; 3],
    wide: bool,
}

/// Sixteen continuous indices, axis by axis, relative to a voxel nearby: `f32` resolves a millionth of a voxel.
pub type Places = [[f32; FAN]; 3];

/// Positions to sample: sixteen per step.
pub trait SampledRun {
    fn places(&self, n: usize) -> Places;
}

/// The positions one voxel before and after given positions, along each axis.
#[derive(Clone, Copy, Debug)]
pub struct Around {
    places: Places,
    shift: [f32; 3],
}

impl Around {
    /// The positions around `places`; the base moves to a voxel `shift` voxels before the present one.
    pub fn new(places: Places, shift: [f32; 3]) -> Self {
        Self { places, shift }
    }
}

impl SampledRun for Around {
    #[inline(always)]
    fn places(&self, n: usize) -> Places {
        let mut places = self.places;
        for a in 0..3 {
            let shift = self.shift[a] + if n / 2 == a { [1.0, -1.0][n % 2] } else { 0.0 };
            for l in 0..FAN {
                places[a][l] += shift;
            }
        }
        places
    }
}

impl Grid {
    pub fn new(volume: &Volume) -> Self {
        let (size, strides) = (volume.size(), volume.strides());
        let farthest: usize = (0..3).map(|a| (size[a] - 1) * strides[a]).sum();
        Self {
            wide: u32::try_from(farthest).is_err(),
            last: size.map(|n| (n - 1) as f64),
            low: size.map(|n| n.saturating_sub(2)),
            step: std::array::from_fn(|a| if size[a] > 1 { strides[a] } else { 0 }),
            strides,
        }
    }

    pub fn last(&self) -> [f64; 3] {
        self.last
    }

    /// The last voxel along (i, j, k) that has a neighbour above it; 0 along an axis with one voxel.
    pub(crate) fn last_cell(&self) -> [i32; 3] {
        self.low.map(|n| n as i32)
    }

    /// The value at continuous index `p`; constant in the outermost half voxel, NaN outside the volume.
    #[inline]
    pub fn trilinear<T: Voxel>(&self, voxels: &[T], p: DVec3) -> f32 {
        self.interpolated(voxels, p, Voxel::real)
    }

    /// [`Grid::trilinear`] in single precision: equal numbers of two voxel types give equal bits.
    #[inline]
    pub fn trilinear_single<T: Voxel>(&self, voxels: &[T], p: DVec3) -> f32 {
        self.interpolated(voxels, p, |voxel| voxel.real().to_f32())
    }

    #[inline]
    fn interpolated<T: Voxel, R: Real>(&self, voxels: &[T], p: DVec3, number: impl Fn(T) -> R) -> f32 {
        let (mut offset, mut weights) = (0, [0.0; 3]);
        for a in 0..3 {
            // NaN counts as outside.
            if !(p[a] >= -0.5 && p[a] <= self.last[a] + 0.5) {
                return f32::NAN;
            }
            let c = p[a].clamp(0.0, self.last[a]);
            let floor = (c as usize).min(self.low[a]);
            weights[a] = c - floor as f64;
            offset += floor * self.strides[a];
        }
        let [si, sj, sk] = self.step;
        let steps = [0, sj, sk, sj + sk];
        let ends = |r: usize| [0, si].map(|step| number(voxels[offset + steps[r] + step]));
        interpolate(ends, weights.map(R::from_weight)).to_f32()
    }

    #[inline(always)]
    pub(crate) fn trilinear_lanes<T: Voxel, const N: usize>(
        &self,
        voxels: &[T],
        p: &[[[f64; FAN]; 3]; N],
    ) -> [[f32; FAN]; N] {
        self.interpolated_lanes(voxels, p, |number| number)
    }

    /// [`Grid::trilinear_single`] at sixteen indices without NaN, given axis by axis.
    #[inline(always)]
    pub fn trilinear_single_lanes<T: Voxel>(&self, voxels: &[T], p: &[[f64; FAN]; 3]) -> [f32; FAN] {
        let [values] = self.interpolated_lanes(voxels, &[*p], Real::to_f32);
        values
    }

    #[inline(always)]
    fn interpolated_lanes<T: Voxel, R: Real, const N: usize>(
        &self,
        voxels: &[T],
        p: &[[[f64; FAN]; 3]; N],
        number: impl Fn(T::Real) -> R,
    ) -> [[f32; FAN]; N] {
        let mut offset = [[0; FAN]; N];
        let mut weight = [[[0.0; FAN]; 3]; N];
        let mut outside = [[false; FAN]; N];
        for n in 0..N {
            for a in 0..3 {
                let (last, low, stride) = (self.last[a], self.low[a] as i32, self.strides[a]);
                for l in 0..FAN {
                    let c = p[n][a][l];
                    outside[n][l] |= (c < -0.5) | (c > last + 0.5);
                    let c = if c > 0.0 { c } else { 0.0 };
                    let c = if c < last { c } else { last };
                    let floor = (c as i32).min(low);
                    weight[n][a][l] = c - f64::from(floor);
                    offset[n][l] += floor as usize * stride;
                }
            }
        }
        let rows = self.rows(voxels, &offset);
        let mut value = [[0.0; FAN]; N];
        for n in 0..N {
            for l in 0..FAN {
                let weights = [0, 1, 2].map(|a| R::from_weight(weight[n][a][l]));
                let ends = |r: usize| <[T::Real; 2]>::from(T::ends(rows[r][n][l])).map(&number);
                let inside = interpolate(ends, weights).to_f32();
                value[n][l] = if outside[n][l] { f32::NAN } else { inside };
            }
        }
        value
    }

    /// The volume at N · 16 positions relative to `base`, extended by the outermost voxels. Loads alternate
    /// with arithmetic, so that the arithmetic vectorises and many loads are in flight.
    #[inline(always)]
    pub fn sample<T: Voxel, const N: usize>(
        &self,
        voxels: &[T],
        base: [i32; 3],
        run: &impl SampledRun,
    ) -> [[f32; FAN]; N] {
        let mut value = [[0.0; FAN]; N];
        if self.wide {
            for n in 0..N {
                [value[n]] = self.trilinear_lanes(voxels, &[self.indices(base, &run.places(n))]);
            }
            return value;
        }
        let mut offset = [[0u32; FAN]; N];
        let mut weight = [[[0.0; FAN]; 3]; N];
        for n in 0..N {
            let places = run.places(n);
            for a in 0..3 {
                let farthest = (self.last[a] - f64::from(base[a])) as f32;
                let low = (self.low[a] as i32 - base[a]) as u32;
                let stride = self.strides[a] as u32;
                for l in 0..FAN {
                    let c = smaller(larger(places[a][l], 0.0), farthest);
                    let floor = whole(c).min(low);
                    weight[n][a][l] = c - floor as i32 as f32;
                    offset[n][l] = offset[n][l].wrapping_add(floor.wrapping_mul(stride));
                }
            }
        }
        let rows = self.rows(&voxels[self.offset_of(base)..], &offset);
        for n in 0..N {
            for l in 0..FAN {
                let weights = [0, 1, 2].map(|a| T::Real::from_f32(weight[n][a][l]));
                value[n][l] = interpolate(|r| T::ends(rows[r][n][l]).into(), weights).to_f32();
            }
        }
        value
    }

    /// Continuous indices, clamped to the outermost centres, of positions relative to the voxel `base`.
    fn indices(&self, base: [i32; 3], places: &Places) -> [[f64; FAN]; 3] {
        std::array::from_fn(|a| {
            places[a].map(|c| (f64::from(base[a]) + f64::from(c)).clamp(0.0, self.last[a]))
        })
    }

    pub fn is_wide(&self) -> bool {
        self.wide
    }

    #[inline(always)]
    pub fn offset_of(&self, voxel: [i32; 3]) -> usize {
        (0..3).map(|a| voxel[a] as usize * self.strides[a]).sum()
    }

    /// The pairs of neighbours along i in the four rows around each position, j fastest.
    #[inline(always)]
    pub fn rows<T: Voxel, O: Offset, const N: usize>(
        &self,
        voxels: &[T],
        offset: &[[O; FAN]; N],
    ) -> [[[T::Pair; FAN]; N]; 4] {
        let [si, sj, sk] = self.step;
        let steps = [0, sj, sk, sj + sk];
        let mut rows = [[[T::pair(T::default(), T::default()); FAN]; N]; 4];
        // One load fetches both neighbours. Clamping to `last` costs less than a bounds check.
        if si == 1
            && let Some(last) = voxels.len().checked_sub(2)
        {
            for n in 0..N {
                for l in 0..FAN {
                    for r in 0..4 {
                        let near = (offset[n][l].elements() + steps[r]).min(last);
                        rows[r][n][l] = T::pair(voxels[near], voxels[near + 1]);
                    }
                }
            }
            return rows;
        }
        for n in 0..N {
            for l in 0..FAN {
                for r in 0..4 {
                    let near = offset[n][l].elements() + steps[r];
                    rows[r][n][l] = T::pair(voxels[near], voxels[near + si]);
                }
            }
        }
        rows
    }
}

pub trait Offset: Copy + Default {
    fn stride(grid: &Grid, axis: usize) -> Self;
    fn plus(self, steps: i32, stride: Self) -> Self;
    fn elements(self) -> usize;
}

impl Offset for u32 {
    #[inline(always)]
    fn stride(grid: &Grid, axis: usize) -> Self {
        grid.strides[axis] as u32
    }
    #[inline(always)]
    fn plus(self, steps: i32, stride: Self) -> Self {
        self.wrapping_add((steps as u32).wrapping_mul(stride))
    }
    #[inline(always)]
    fn elements(self) -> usize {
        self as usize
    }
}

impl Offset for usize {
    #[inline(always)]
    fn stride(grid: &Grid, axis: usize) -> Self {
        grid.strides[axis]
    }
    #[inline(always)]
    fn plus(self, steps: i32, stride: Self) -> Self {
        self + steps as usize * stride
    }
    #[inline(always)]
    fn elements(self) -> usize {
        self
    }
}

/// The integer part of a number from 0 to 2²², read from the last bits of its sum with 2²³.
#[inline(always)]
fn whole(c: f32) -> u32 {
    const ONES: f32 = 8_388_608.0;
    let nearest = c + ONES;
    (nearest.to_bits() & 0x7F_FFFF) - u32::from(nearest - ONES > c)
}

/// The value between four rows of two voxels, j fastest, by the weights of the farther ones along (i, j, k).
#[inline(always)]
pub fn interpolate<R: Real>(ends: impl Fn(usize) -> [R; 2], [wi, wj, wk]: [R; 3]) -> R {
    let line = |r: usize| {
        let [near, far] = ends(r);
        near + (far - near) * wi
    };
    let plane = |r: usize| line(r) + (line(r + 1) - line(r)) * wj;
    let (near, far) = (plane(0), plane(2));
    near + (far - near) * wk
}
