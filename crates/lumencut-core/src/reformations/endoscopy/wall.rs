//! Wall: the distance at which the ray of each pixel meets the wall of a vessel, seen from inside. The wall is that of a
//! [`Tube`]. Through its openings a ray goes on in the volume, until the values fall halfway from lumen to surroundings, or rise
//! to calcium.

use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec3};
use rayon::prelude::*;

use crate::error::Result;
use crate::geometry::Rays;
use crate::math::tube::{Met, Tube};
use crate::stages::Work;
use crate::stop::filled;
use crate::volume::Volume;

/// The eye and the grid of the volume in the space of a tube. Has the layout of `WallParameters` in `math/tube.wgsl`.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
#[allow(missing_docs)]
pub struct WallParameters {
    pub eye: [f32; 4],
    pub origin: [f32; 4],
    pub x: [f32; 4],
    pub y: [f32; 4],
    pub z: [f32; 4],
    pub size: [u32; 2],
    pub rows: u32,
    pub near: u32,
}

impl WallParameters {
    /// For samples `step` mm apart beyond openings; `near` is the row of the tube next to the eye.
    pub fn new(rays: &Rays, (tube, near): (&Tube, usize), volume: &Volume, step: f32) -> Self {
        let (origin, row_step) = tube.origin_and_step();
        let index = volume.index_from_world();
        let with = |vector: DVec3, last: f32| vector.as_vec3().extend(last).to_array();
        let [x, y, z] = DVec3::AXES.map(|axis| with(index.transform_vector3(axis), 0.0));
        Self {
            eye: with(rays.origin() - origin, row_step),
            origin: with(index.transform_point3(origin), step),
            x,
            y,
            z,
            size: rays.size().map(|n| n as u32),
            rows: tube.tables().0.len() as u32,
            near: near as u32,
        }
    }
}

/// The volume beyond openings.
pub struct Beyond<'a> {
    /// The value at a world point; NaN outside the volume.
    pub value: &'a (dyn Fn(DVec3) -> f32 + Sync),
    /// Distance between samples (mm).
    pub step: f32,
}

/// For each pixel, the distance (mm) at which its ray meets the wall; below 0 if it has passed an opening, NaN if it meets none.
/// `near` is the row of the tube next to the origin of the rays.
pub fn wall(work: &Work, rays: &Rays, (tube, near): (&Tube, usize), beyond: &Beyond) -> Result<Vec<f32>> {
    let [width, height] = work.size;
    let mut image = filled(width * height, f32::NAN, work.stop)?;
    let eye = (rays.origin() - tube.origin_and_step().0).as_vec3();
    image.par_chunks_mut(width).enumerate().try_for_each(|(row, pixels)| {
        work.begin(width)?;
        for (i, pixel) in pixels.iter_mut().enumerate() {
            let n = row * width + i;
            let (direction, span) = (rays.direction()[n], rays.span()[n]);
            *pixel = match tube.met(eye, direction, span, near) {
                Met::Nothing => f32::NAN,
                Met::Wall(away) => away,
                Met::Opening(away, row) => -followed(tube, [eye, direction], ([away, span[1]], row), beyond),
            };
        }
        Ok(())
    })?;
    Ok(image)
}

/// The distance (mm) at which a ray that has passed an opening next to `row` leaves the lumen.
fn followed(
    tube: &Tube,
    [eye, ray]: [Vec3; 2],
    ([start, end], row): ([f32; 2], usize),
    beyond: &Beyond,
) -> f32 {
    let row = &tube.tables().0[row];
    let ([_, _, _, level], [_, _, _, calcium], [_, _, _, sign]) = (row.middle, row.tangent, row.across);
    let origin = tube.origin_and_step().0;
    // Above 0 within the lumen.
    let inside = |away: f32| {
        let value = (beyond.value)(origin + (eye + ray * away).as_dvec3());
        let above = sign * (value - level);
        let below = sign * (calcium - value);
        if above < below { above } else { below }
    };
    let mut before = inside(start);
    if before <= 0.0 {
        return start;
    }
    let mut n = 0.0;
    loop {
        let (last, away) = (start + n * beyond.step, start + (n + 1.0) * beyond.step);
        if away > end {
            return f32::NAN;
        }
        let here = inside(away);
        if here.is_nan() {
            return f32::NAN;
        }
        if here <= 0.0 {
            return last + beyond.step * before / (before - here);
        }
        before = here;
        n += 1.0;
    }
}
