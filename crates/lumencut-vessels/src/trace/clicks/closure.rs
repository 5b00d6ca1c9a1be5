//! Distinguishes dim lumen from other tissue of the same values: a lumen is enclosed, by darker tissue or by brighter lumen.

use glam::DVec3;

use crate::trace::lumen::directions::half_sphere;
use crate::voxels::Voxels;

const RAY: f64 = 15.0;
const PAIRS: u32 = 24;

/// A ray ends at values this many noises below the place, or above it.
const FALL: f64 = 1.0;
const RISE: f64 = 2.0;

/// Minimum fraction of the rays that must end. Of dim false lumen 99 % are enclosed, of muscle 7 %, of organs 27 %.
const LEAST_ENDED: f64 = 0.6;

/// Values of a dim lumen (HU): it has some contrast medium, but less than a clear lumen.
pub(crate) const DIM_HU: [f64; 2] = [65.0, 145.0];

pub(crate) fn is_dim_lumen(voxels: &Voxels, place: DVec3, noise: f64) -> bool {
    let value = mean_around(voxels, place);
    let step = voxels.smallest_side;
    let ends = |way: DVec3| {
        (1..=(RAY / step) as u32).any(|n| {
            let away = mean_around(voxels, place + way * (step * f64::from(n))) - value;
            away < -FALL * noise || away > RISE * noise
        })
    };
    let ended = half_sphere(PAIRS).flat_map(|way| [way, -way]).filter(|way| ends(*way)).count();
    (DIM_HU[0]..=DIM_HU[1]).contains(&value) && ended as f64 >= LEAST_ENDED * f64::from(2 * PAIRS)
}

fn mean_around(voxels: &Voxels, place: DVec3) -> f64 {
    let middle = voxels.index_from_world.transform_point3(place);
    let value = |n: i32| {
        let step = [n % 3, n / 3 % 3, n / 9].map(|c| f64::from(c - 1));
        f64::from(voxels.at_index(middle + DVec3::from_array(step)))
    };
    (0..27).map(value).sum::<f64>() / 27.0
}
