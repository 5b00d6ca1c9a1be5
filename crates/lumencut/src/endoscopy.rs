//! A vessel seen from inside: its eye, its picture, the mouths of branches, and doubts about the place of the eye.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::math::centerline_path::CenterlinePath;
use lumencut_core::math::tube::Tube;
use lumencut_core::reformations::cpr::Straightened;
use lumencut_core::reformations::endoscopy::wall::Beyond;
use lumencut_core::reformations::endoscopy::{Bounds, Endoscopy, Eye, Lens, LensImage, tube};
use lumencut_core::reformations::{Layout, Wall};
use lumencut_core::stop::Stop;
use lumencut_core::vessel_tree::Vessel;
use lumencut_core::volume::Volume;
use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::voxels::Voxels;

use crate::flight::MOST_FRAMES;
use crate::lumen_map::{Ostium, Walls, calcium_level, ostia};
use crate::lumen_wall::{FoundWall, usable_levels};
use crate::rays_across::TOO_BRIGHT;
use crate::text::rounded;

/// The picture shows the volume this far behind the wall (mm).
pub const BEHIND_MM: f64 = 1.0;
/// Distance between samples beyond openings, in units of [`Voxels::sampling_side`].
const SAMPLE_STEP: f64 = 0.5;
/// Number of directions whose mean is the radius at the eye.
const DIRECTIONS: usize = 16;
/// Distance of the places at which a flight is planned (mm).
const FLIGHT_STEP_MM: f64 = 0.25;
/// The fastest turn of a flight (radians per second).
const TURN_PER_S: f64 = std::f64::consts::FRAC_PI_3;
/// The colours of a wall of soft tissue, and of calcium or metal.
const COLOURS: [[f64; 3]; 2] = [[236.0, 150.0, 132.0], [255.0, 250.0, 240.0]];

/// Where the eye is, and how it looks.
#[derive(Clone, Copy, Debug)]
pub struct EndoscopyRequest {
    /// Arc length (mm).
    pub at: f64,
    /// The lens.
    pub lens: Lens,
    /// Field of view across the smaller side (radians); None: the usual one of the lens.
    pub field_of_view: Option<f64>,
    /// Columns and rows.
    pub size: [usize; 2],
    /// Rotation of the picture clockwise (radians).
    pub roll: f64,
    /// Whether the eye looks towards the start of the vessel.
    pub is_backwards: bool,
}

/// The inside of a vessel, for all places of the eye.
pub struct Inside {
    path: Arc<CenterlinePath>,
    smooth: CenterlinePath,
    straightened: Straightened,
    tube: Arc<Tube>,
    wall: Arc<Wall>,
    levels: Option<[f64; 2]>,
}

impl Inside {
    /// The inside of a vessel with this wall, found in the same straightened space.
    pub fn new(
        (path, straightened): (Arc<CenterlinePath>, Straightened),
        found: &FoundWall,
        profile: Option<&Profile>,
    ) -> Result<Self> {
        let line = Vessel::new(path.points().to_vec(), None)?;
        let smooth = CenterlinePath::new(&line, found.mean_radius)?;
        let local = profile.map_or_else(Vec::new, |profile| usable_levels(profile, straightened.length()));
        let bounds = |at: f64| {
            let after = local.partition_point(|(place, _)| *place < at);
            let near = [after.checked_sub(1), Some(after)].into_iter().flatten().filter_map(|n| local.get(n));
            let nearest = near.min_by(|a, b| (a.0 - at).abs().total_cmp(&(b.0 - at).abs()));
            bounds_of(nearest.map(|(_, levels)| *levels).or(found.levels))
        };
        let tube = Arc::new(tube(&straightened, &found.wall, bounds));
        Ok(Self { path, smooth, straightened, tube, wall: Arc::clone(&found.wall), levels: found.levels })
    }

    /// The length of the vessel (mm).
    pub fn length(&self) -> f64 {
        self.path.length()
    }

    /// What an eye in the vessel sees. Fails with [`lumencut_core::error::ErrorKind::Camera`] for an eye beyond the vessel or a
    /// lens that cannot be; [`lumencut_core::error::ErrorKind::Interrupted`].
    pub fn seen(&self, volume: &Volume, request: &EndoscopyRequest, stop: Stop) -> Result<Endoscopy> {
        let EndoscopyRequest { at, lens, field_of_view, size, roll, is_backwards } = *request;
        let image = LensImage::new(lens, size, field_of_view.unwrap_or(lens.usual_field_of_view()))?;
        let paths = [&*self.path, &self.smooth];
        let eye = Eye::new(paths, &self.straightened, [at, self.radius(at), roll], is_backwards)?;
        beyond(volume, |beyond| Endoscopy::new(Arc::clone(&self.tube), eye, image, (beyond, stop)))
    }

    /// The places (mm) of the eye in the frames of a flight between two places, at most `speed` mm/s fast; the eye looks ahead,
    /// and slows down where it would turn by more than `TURN_PER_S`. Fails with [`lumencut_core::error::ErrorKind::Camera`] for
    /// a place beyond the vessel, no way between the places, or too many frames.
    pub fn flight(&self, [from, to]: [f64; 2], speed: f64, fps: f64) -> Result<Vec<f64>> {
        let way = to - from;
        let frames = way.abs() / speed * fps;
        if !(frames > 0.0 && frames < MOST_FRAMES as f64) {
            let found = format!("from {from} to {to} mm at {speed} mm/s and {fps} frames/s");
            let expected = format!("two places and a speed for 1 to {MOST_FRAMES} frames");
            return Err(Error::new(ErrorKind::Camera, "flight through the vessel", found, expected));
        }
        let steps = (way.abs() / FLIGHT_STEP_MM).ceil().max(1.0);
        let place = |n: f64| from + way * n / steps;
        let eye = |at: f64| {
            let paths = [&*self.path, &self.smooth];
            Eye::new(paths, &self.straightened, [at, self.radius(at), 0.0], way < 0.0)
        };
        let (mut places, mut time) = (vec![from], 0.0);
        let mut before = eye(from)?;
        for n in 1..=steps as usize {
            let next = eye(place(n as f64))?;
            let turn = before.axes[2].angle_between(next.axes[2]);
            let lasts = ((next.at - before.at).abs() / speed).max(turn / TURN_PER_S);
            // Within a step the eye moves evenly.
            while places.len() as f64 / fps <= time + lasts + 1e-9 {
                let share = ((places.len() as f64 / fps - time) / lasts).min(1.0);
                places.push(before.at + (next.at - before.at) * share);
            }
            time += lasts;
            before = next;
        }
        Ok(places)
    }

    /// The mean radius of the wall (mm).
    fn radius(&self, at: f64) -> f64 {
        let directions = (0..DIRECTIONS).map(|n| self.wall.radius(at, TAU * n as f64 / DIRECTIONS as f64));
        directions.sum::<f64>() / DIRECTIONS as f64
    }

    /// The picture, from the values [`BEHIND_MM`] behind the wall; transparent without a wall.
    pub fn picture(&self, shades: &[f32], values: &[f32]) -> Vec<[u8; 4]> {
        let white = |value: f32| match self.levels {
            Some(levels) if levels[0] > levels[1] => {
                ((f64::from(value) - levels[0]) / (calcium_level(levels) - levels[0])).clamp(0.0, 1.0)
            }
            _ => 0.0,
        };
        let pixel = |(shade, value): (&f32, &f32)| {
            if !shade.is_finite() {
                return [0; 4];
            }
            let share = if value.is_finite() { white(*value) } else { 0.0 };
            let [r, g, b] = std::array::from_fn(|n| {
                let colour = COLOURS[0][n] + share * (COLOURS[1][n] - COLOURS[0][n]);
                (f64::from(*shade) * colour).round() as u8
            });
            [r, g, b, 255]
        };
        shades.iter().zip(values).map(pixel).collect()
    }

    /// The openings of other vessels into this one.
    pub fn ostia(&self, vessels: &[Vessel]) -> Vec<Ostium> {
        ostia(&self.walls(), vessels)
    }

    fn walls(&self) -> Walls<'_> {
        Walls { straightened: &self.straightened, wall: &self.wall }
    }

    /// Where the mouth of a vessel is seen, if it is.
    pub fn mouth(&self, made: &Endoscopy, ostium: &Ostium) -> Option<DVec2> {
        let place = self.straightened.straightened_from_world(ostium.point);
        let offset = DVec2::from_angle(ostium.around) * self.wall.radius(place.z, ostium.around);
        let pixel = made.pixel_from_world(self.straightened.world_from_straightened(offset.extend(place.z)));
        pixel.is_finite().then_some(pixel)
    }

    /// Why a picture from this place may be wrong.
    pub fn doubts(&self, volume: &Volume, eye: &Eye) -> Vec<String> {
        let value = f64::from(Voxels::new(volume).at(eye.position));
        let place = format!("{} mm along the vessel", rounded(eye.at, 4));
        let mut doubts = Vec::new();
        let row = &self.tube.tables().0[self.tube.row_at(eye.at)];
        let (level, is_bright) = (f64::from(row.middle[3]), row.across[3] > 0.0);
        let is_outside = if is_bright { value < level } else { value > level };
        if self.levels.is_some() && (is_outside || value.is_nan()) {
            let side = if is_bright { "at least" } else { "at most" };
            let found = if value.is_nan() { "no value".to_owned() } else { rounded(value, 4) };
            doubts.push(format!(
                "the eye {place} is outside the lumen: found {found}; expected {side} {}; correct the centerline",
                rounded(level, 4)
            ));
        }
        let (width, side) = (2.0 * eye.radius, volume.smallest_side());
        if width < side {
            doubts.push(format!(
                "the lumen {place} is {} mm wide, narrower than a voxel ({} mm); its wall is uncertain",
                rounded(width, 3),
                rounded(side, 3)
            ));
        }
        doubts
    }
}

/// Brightness of the wall in the light of the eye (0 to 1), NaN without a wall.
pub fn shades(made: &Endoscopy, volume: &Volume, stop: Stop) -> Result<Vec<f32>> {
    beyond(volume, |beyond| made.shades(beyond, stop))
}

fn beyond<T>(volume: &Volume, run: impl FnOnce(&Beyond) -> T) -> T {
    let voxels = Voxels::new(volume);
    let value = |point: DVec3| voxels.at(point);
    run(&Beyond { value: &value, step: (SAMPLE_STEP * voxels.sampling_side) as f32 })
}

/// Without levels, every opening is closed.
fn bounds_of(levels: Option<[f64; 2]>) -> Bounds {
    let never = f64::from(f32::MAX);
    let Some([lumen, around]) = levels else {
        return Bounds { level: never, calcium: never, is_bright: true };
    };
    let is_bright = lumen > around;
    let calcium =
        if is_bright { calcium_level([lumen, around]) } else { lumen + TOO_BRIGHT * (lumen - around) };
    Bounds { level: f64::midpoint(lumen, around), calcium, is_bright }
}

#[cfg(test)]
#[path = "tests/endoscopy.rs"]
mod tests;
