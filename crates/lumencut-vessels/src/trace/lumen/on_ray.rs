//! The lumens that a ray through a volume meets, the nearest one first.

use glam::DVec3;

use crate::trace::lumen::lumen_model::noise_of;
use crate::trace::lumen::seen::{SeenLumen, lumen_in};
use crate::trace::lumen::surroundings::Surroundings;
use crate::voxels::Voxels;
use lumencut_core::volume::Volume;

/// How far apart the places are that are looked at, in the smallest side of a voxel.
const STEP: f64 = 0.5;

/// A bright stretch stands out by so many times the noise of the ray at least.
const TIMES_NOISE: f64 = 6.0;

/// At most so many bright stretches are looked at, those that stand out most: more are noise or a stent's struts.
const MOST: usize = 16;

/// A bright stretch of a ray: where it begins and ends, as numbers of samples, and how far it stands out.
struct Bright {
    first: usize,
    last: usize,
    height: f32,
}

/// The lumens on the ray from a place (mm, LPS) in the direction of a unit vector and against it, as far as the volume reaches, in the
/// order along it. Ours: each bright stretch of the ray is one if the values around its middle are those of a lumen.
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
    /// The place on a ray that is nearest to the middle.
    pub fn on_ray(&self, from: DVec3, along: DVec3) -> DVec3 {
        from + along * (self.center - from).dot(along)
    }

    fn is_met(&self, from: DVec3, along: DVec3) -> bool {
        self.on_ray(from, along).distance(self.center) <= self.radius
    }

    /// Whether both are one lumen that was met twice, as where a stent or noise parts the ray in it.
    fn is_same(&self, other: &Self) -> bool {
        self.center.distance(other.center) < self.radius.max(other.radius)
    }
}

/// The depths (mm along the ray) between which it runs inside the volume, by the ball around that; none where it misses it.
fn depths(volume: &Volume, from: DVec3, along: DVec3) -> Option<(f64, f64)> {
    let corners = volume.corners();
    let depth = corners.map(|corner| (corner - from).dot(along));
    let (near, far) = depth.iter().fold((f64::MAX, f64::MIN), |(a, b), d| (a.min(*d), b.max(*d)));
    (near < far).then_some((near, far))
}

/// The stretches of a ray that are brighter than what lies before and behind them, those that stand out most, in the order along it.
/// A stretch ends half way down to the lower of both sides' lowest values before something brighter comes.
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
    found.truncate(MOST);
    found.sort_by_key(|one| one.first);
    found
}

/// Whether a sample is no darker than the one before it, and brighter than the one behind it.
fn is_top(values: &[f32], n: usize) -> bool {
    let beside = |n: Option<usize>| n.and_then(|n| values.get(n)).copied().filter(|v| v.is_finite());
    let (before, after) = (beside(n.checked_sub(1)), beside(Some(n + 1)));
    values[n].is_finite()
        && before.is_none_or(|before| before <= values[n])
        && after.is_none_or(|after| after < values[n])
}

/// The lowest value to one side of a top, until something brighter comes; beyond the volume there is nothing lower.
fn lowest_side<'a>(side: impl Iterator<Item = &'a f32>, top: f32) -> f32 {
    side.copied().take_while(|value| *value <= top).fold(top, f32::min)
}
