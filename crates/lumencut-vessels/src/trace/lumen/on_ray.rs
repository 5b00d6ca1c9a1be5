//! Finds the lumens along a ray through a volume.

use glam::DVec3;

use crate::trace::lumen::lumen_model::noise_of;
use crate::trace::lumen::seen::{SeenLumen, lumen_in};
use crate::trace::lumen::surroundings::Surroundings;
use crate::voxels::Voxels;
use lumencut_core::volume::Volume;

/// Distance between samples, in smallest voxel sides.
const STEP: f64 = 0.5;

/// Minimum height of a bright interval above the values around it, in multiples of the noise.
const TIMES_NOISE: f64 = 6.0;

/// Maximum number of bright intervals that are tested, highest first. More would be noise or stent struts.
const MAX_STRETCHES: usize = 16;

struct Bright {
    first: usize,
    last: usize,
    height: f32,
}

/// Lumens on the line through a position (mm, LPS) along a unit vector, in order along it. The method is our
/// own: the middle of each bright interval is tested for lumen.
pub fn lumens_on_ray(volume: &Volume, from: DVec3, along: DVec3) -> Vec<SeenLumen> {
    let voxels = &Voxels::new(volume);
    let step = STEP * voxels.smallest_side;
    let Some((near, far)) = depths(volume, from, along) else { return Vec::new() };
    let count = ((far - near) / step) as usize + 1;
    let place = |n: usize| from + along * (near + n as f64 * step);
    let values: Vec<f32> = (0..count).map(|n| voxels.at(place(n))).collect();
    let middles: Vec<DVec3> =
        bright(&values).iter().map(|one| place(usize::midpoint(one.first, one.last))).collect();
    if middles.is_empty() {
        return Vec::new();
    }
    let surroundings = Surroundings::of(voxels, &middles);
    let mut seen: Vec<SeenLumen> = Vec::new();
    for middle in middles {
        let found = lumen_in(voxels, &surroundings, middle).filter(|one| one.is_met(from, along));
        seen.extend(found.filter(|one| seen.iter().all(|other| !other.is_same(one))));
    }
    seen.sort_by(|a, b| (a.center - from).dot(along).total_cmp(&(b.center - from).dot(along)));
    seen
}

impl SeenLumen {
    /// The point of a ray that is nearest to the centre of the lumen.
    pub fn on_ray(&self, from: DVec3, along: DVec3) -> DVec3 {
        from + along * (self.center - from).dot(along)
    }

    fn is_met(&self, from: DVec3, along: DVec3) -> bool {
        self.on_ray(from, along).distance(self.center) <= self.radius
    }

    fn is_same(&self, other: &Self) -> bool {
        self.center.distance(other.center) < self.radius.max(other.radius)
    }
}

/// The range along the ray (mm) that may be inside the volume; None if the ray misses the volume.
fn depths(volume: &Volume, from: DVec3, along: DVec3) -> Option<(f64, f64)> {
    let corners = volume.corners();
    let depth = corners.map(|corner| (corner - from).dot(along));
    let (near, far) = depth.iter().fold((f64::MAX, f64::MIN), |(a, b), d| (a.min(*d), b.max(*d)));
    (near < far).then_some((near, far))
}

/// The highest bright intervals of a ray, in order; each extends down to half of its height.
fn bright(values: &[f32]) -> Vec<Bright> {
    let least = (TIMES_NOISE * noise_of(values)) as f32;
    let mut found: Vec<Bright> = (0..values.len())
        .filter(|n| is_top(values, *n))
        .map(|n| {
            let before = lowest_side(values[..n].iter().rev(), values[n]);
            let after = lowest_side(values[n + 1..].iter(), values[n]);
            let height = values[n] - before.max(after);
            let is_out = |value: &f32| value.is_nan() || *value < values[n] - 0.5 * height;
            Bright {
                first: values[..n].iter().rposition(is_out).map_or(0, |out| out + 1),
                last: values[n..].iter().position(is_out).map_or(values.len(), |out| n + out) - 1,
                height,
            }
        })
        .filter(|one| one.height > least)
        .collect();
    found.sort_by(|a, b| b.height.total_cmp(&a.height));
    found.truncate(MAX_STRETCHES);
    found.sort_by_key(|one| one.first);
    found
}

fn is_top(values: &[f32], n: usize) -> bool {
    let beside = |n: Option<usize>| n.and_then(|n| values.get(n)).copied().filter(|v| v.is_finite());
    let (before, after) = (beside(n.checked_sub(1)), beside(Some(n + 1)));
    values[n].is_finite()
        && before.is_none_or(|before| before <= values[n])
        && after.is_none_or(|after| after < values[n])
}

fn lowest_side<'a>(side: impl Iterator<Item = &'a f32>, top: f32) -> f32 {
    side.copied().take_while(|value| *value <= top).fold(top, f32::min)
}
