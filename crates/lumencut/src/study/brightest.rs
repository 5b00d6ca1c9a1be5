//! Finds the brightest voxel on the ray of a pixel, or the darkest one where dark lumens are traced. A click into a projection selects this voxel.

use crate::positions::{pixel_from_world, world_from_pixel};
use crate::windows;
use glam::DVec3;
use lumencut_core::camera::Camera;
use lumencut_core::error::{self, Error, ErrorKind};
use lumencut_core::volume::Volume;

use crate::study::failure::Result;
use crate::study::held_volume::no_volume;
use crate::study::open_study::Study;
use crate::study::picking::Pick;
use crate::study::view::View;

/// Distance between samples on a ray, in smallest voxel sides.
const STEP_VOXELS: f64 = 0.5;

/// Depths (mm) of an unlimited ray.
const ALL_DEPTHS: [f64; 2] = [f64::MIN, f64::MAX];

/// The brightest place on the ray of a pixel (column, row) between two depths (mm, away from the viewer); the nearest
/// of several. Fails with [`ErrorKind::Tracing`] if the ray misses the volume or has no voxel between the depths.
pub fn brightest_on_ray(
    volume: &Volume,
    camera: &Camera,
    pixel: [f64; 2],
    within: [f64; 2],
) -> error::Result<DVec3> {
    let from = world_from_pixel(camera, pixel, 0.0);
    let [near, far] = chord(volume, from, camera.direction());
    let (near, far) = (near.max(within[0]), far.min(within[1]));
    let step = STEP_VOXELS * volume.smallest_side();
    let count = if near <= far { ((far - near) / step) as usize + 1 } else { 0 };
    let place = |n: usize| from + camera.direction() * (near + n as f64 * step);
    let places: Vec<DVec3> = (0..count).map(place).collect();
    let values = windows::sample(volume, &places);
    let mut best: Option<(DVec3, f64)> = None;
    let turned = |value: f32| volume.polarity().turned(f64::from(value));
    let values = values.into_iter().map(turned);
    for (place, value) in places.into_iter().zip(values).filter(|(_, value)| value.is_finite()) {
        if best.is_none_or(|(_, most)| value > most) {
            best = Some((place, value));
        }
    }
    best.map(|(place, _)| place).ok_or_else(|| {
        let found = "a ray that meets no voxel";
        let error = Error::new(ErrorKind::Tracing, "place in the projection", found, "a place over the scan");
        error.mend("click where the scan is shown")
    })
}

impl Study {
    /// The brightest place on the ray of a pixel (column, row). If the pixel shows a slab of the cut surface, only within the slab.
    pub(crate) fn brightest(&mut self, view: &View, pixel: [f64; 2]) -> Result<Pick> {
        let within = self.depths_of_slab(view, pixel)?;
        self.brightest_within(view, pixel, within)
    }

    /// As [`Study::brightest`], along the whole ray.
    pub(super) fn brightest_on_whole_ray(&self, view: &View, pixel: [f64; 2]) -> Result<Pick> {
        self.brightest_within(view, pixel, ALL_DEPTHS)
    }

    fn brightest_within(&self, view: &View, pixel: [f64; 2], within: [f64; 2]) -> Result<Pick> {
        let volume = self.content.around().ok_or_else(no_volume)?.volume()?;
        let volume = volume.with_polarity(self.content.polarity);
        let place = brightest_on_ray(&volume, &view.camera, pixel, within)?;
        Ok(self.at(place.to_array()))
    }

    /// Near and far depth (mm) of the slab at a pixel; unlimited if there is no slab or the focus shows the surroundings.
    fn depths_of_slab(&mut self, view: &View, pixel: [f64; 2]) -> Result<[f64; 2]> {
        let Some(slab) = view.settings.slab.filter(|_| self.content.tree().is_some()) else {
            return Ok(ALL_DEPTHS);
        };
        let cut = self.cut_in(view, pixel)?;
        if !cut.is_shown {
            return Ok(ALL_DEPTHS);
        }
        let depth = pixel_from_world(&view.camera, cut.point).depth;
        Ok([depth - slab.thickness / 2.0, depth + slab.thickness / 2.0])
    }
}

/// The range (mm) of a ray between the outermost voxel centres; reversed if the ray misses them.
fn chord(volume: &Volume, from: DVec3, along: DVec3) -> [f64; 2] {
    let to_index = volume.index_from_world();
    let (start, step) = (to_index.transform_point3(from), to_index.transform_vector3(along));
    let mut range = [f64::MIN, f64::MAX];
    for (a, size) in volume.size().into_iter().enumerate() {
        let sides = [0.0, size as f64 - 1.0].map(|side| (side - start[a]) / step[a]);
        if step[a].abs() < 1e-12 {
            let is_inside = (0.0..=size as f64 - 1.0).contains(&start[a]);
            range = if is_inside { range } else { [f64::MAX, f64::MIN] };
        } else {
            range = [range[0].max(sides[0].min(sides[1])), range[1].min(sides[0].max(sides[1]))];
        }
    }
    range
}
