//! The lumen of a mask at a position: distance to the wall, and cross-section.

use std::f64::consts::TAU;

use glam::{DAffine3, DVec3};

use crate::trace::skeleton::foreground::Foreground;
use lumencut_core::math::sampling::interpolate;

const RAYS: usize = 24;

/// Rays are cut at this multiple of their median length, because some escape into branches.
const LONGEST_RAY: f64 = 1.5;

/// Fraction of lumen at the wall. It is below a half, so that rounding does not matter at symmetric points.
const WALL: f64 = 0.499;

pub(crate) struct Lumen<'a> {
    squares: &'a [f32],
    size: [usize; 3],
    world_from_index: DAffine3,
    index_from_world: DAffine3,
    side: f64,
    half_diagonal: f64,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct MaskSection {
    /// Centroid of the section (mm, LPS).
    pub center: DVec3,
    /// Radius of a circle with the area of the section (mm).
    pub radius: f64,
    pub shortest: f64,
}

impl<'a> Lumen<'a> {
    pub(crate) fn new(foreground: &Foreground, squares: &'a [f32]) -> Self {
        let world_from_index = foreground.world_from_index;
        let diagonals = [[1.0, 1.0, 1.0], [-1.0, 1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 1.0, -1.0]]
            .map(|d| world_from_index.transform_vector3(DVec3::from_array(d)).length());
        Self {
            squares,
            size: foreground.size,
            world_from_index,
            index_from_world: world_from_index.inverse(),
            side: foreground.smallest_side(),
            half_diagonal: diagonals.into_iter().fold(0.0, f64::max) / 2.0,
        }
    }

    pub(crate) fn side(&self) -> f64 {
        self.side
    }

    pub(crate) fn positions(&self, cells: &[u32]) -> Vec<DVec3> {
        let [ni, nj, _] = self.size;
        let position = |cell: usize| {
            let index = [cell % ni, cell / ni % nj, cell / (ni * nj)].map(|n| n as f64);
            self.world_from_index.transform_point3(DVec3::from_array(index))
        };
        cells.iter().map(|&cell| position(cell as usize)).collect()
    }

    /// Distance (mm) from the centre of a cell to the wall, which is half a voxel nearer than the background.
    pub(crate) fn radius_at_cell(&self, cell: u32) -> f64 {
        (f64::from(self.squares[cell as usize]).sqrt() - self.side / 2.0).max(0.0)
    }

    pub(crate) fn radius(&self, place: DVec3) -> f64 {
        (self.interpolated(place, |square| f64::from(square).sqrt()) - self.side / 2.0).max(0.0)
    }

    /// Interpolated fraction of lumen at a position, 0 to 1.
    pub(crate) fn share(&self, place: DVec3) -> f64 {
        self.interpolated(place, |square| f64::from(u8::from(square > 0.0)))
    }

    /// Trilinear value; 0 outside the grid.
    fn interpolated(&self, place: DVec3, value: impl Fn(f32) -> f64) -> f64 {
        let index = self.index_from_world.transform_point3(place);
        let base = index.floor();
        let t = index - base;
        if (0..3).any(|a| base[a] < 0.0 || base[a] + 1.0 > self.size[a] as f64 - 1.0) {
            return 0.0;
        }
        let [i, j, k] = base.to_array().map(|n| n as usize);
        let [ni, nj, _] = self.size;
        let first = i + ni * (j + nj * k);
        let rows = [0, ni, ni * nj, ni * nj + ni];
        interpolate(|r| [0, 1].map(|step| value(self.squares[first + rows[r] + step])), t.to_array())
    }

    /// Distance along a unit vector to the wall (mm), at most `most`; 0 outside the lumen.
    pub(crate) fn way_to_wall(&self, place: DVec3, direction: DVec3, most: f64) -> f64 {
        let (mut way, mut before) = (0.0, self.share(place));
        if before < WALL {
            return 0.0;
        }
        let smallest = self.side / 2.0;
        while way < most {
            // A safe step: everything nearer than background is lumen, apart from the interpolation error.
            let free = self.radius(place + way * direction) - 3.0 * self.half_diagonal;
            let step = free.max(smallest);
            let share = self.share(place + (way + step) * direction);
            if share < WALL {
                return way + step * (before - WALL) / (before - share);
            }
            (way, before) = (way + step, share);
        }
        most
    }

    /// Cross-section perpendicular to a direction; None outside the lumen.
    pub(crate) fn cross_section(&self, place: DVec3, direction: DVec3) -> Option<MaskSection> {
        let [u, v] = across(direction);
        let most = 4.0 * (self.radius(place) + self.side);
        let mut ways = [0.0; RAYS];
        let directions: [DVec3; RAYS] = std::array::from_fn(|n| {
            let (sine, cosine) = (TAU * n as f64 / RAYS as f64).sin_cos();
            cosine * u + sine * v
        });
        for (way, direction) in ways.iter_mut().zip(directions) {
            *way = self.way_to_wall(place, direction, most);
        }
        let mut sorted = ways;
        sorted.sort_unstable_by(f64::total_cmp);
        let longest = LONGEST_RAY * sorted[RAYS / 2];
        let corners: [DVec3; RAYS] = std::array::from_fn(|n| ways[n].min(longest) * directions[n]);
        let (mut area, mut moment) = (0.0, DVec3::ZERO);
        for n in 0..RAYS {
            let [a, b] = [corners[n], corners[(n + 1) % RAYS]];
            let triangle = a.length() * b.length() * (TAU / RAYS as f64).sin() / 2.0;
            area += triangle;
            moment += triangle * (a + b) / 3.0;
        }
        // Converts the area of the polygon inscribed in a circle to the area of the circle.
        let circle = area * (TAU / RAYS as f64) / (TAU / RAYS as f64).sin();
        let radius = (2.0 * circle / TAU).sqrt();
        (area > 0.0).then(|| MaskSection { center: place + moment / area, radius, shortest: sorted[0] })
    }
}

fn across(direction: DVec3) -> [DVec3; 2] {
    // The components are rounded, because on grids many directions are equally close to two axes.
    let size = (direction.abs() * 1e6).round();
    let axis = if size.x <= size.y && size.x <= size.z {
        DVec3::X
    } else if size.y <= size.z {
        DVec3::Y
    } else {
        DVec3::Z
    };
    let u = direction.cross(axis).normalize();
    [u, direction.cross(u)]
}
