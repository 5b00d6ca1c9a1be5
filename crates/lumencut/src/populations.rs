//! Estimates padding, tissue and lumen from the distribution of a volume's voxels.

use lumencut_core::volume::{Volume, Voxel};
use lumencut_core::with_voxels;
use rayon::prelude::*;

use lumencut_core::math::statistics::{median, quantile, rising_median, rising_quantile, two_groups};

/// Lumen and tissue are separated by the maxima of cubes with this side (voxels), at most this number of cubes.
const CUBE_SIDE: usize = 4;
const MAX_CUBES: f64 = 32768.0;

/// A dark value is padding if at least the first fraction of voxels has it and at most the second fraction is darker.
const MIN_PADDING_FRACTION: f64 = 0.05;
const MAX_DARKER_FRACTION: f64 = 0.01;

/// The quantile that stands for the brightest voxels.
const PEAK_QUANTILE: f64 = 0.999;

/// Voxels are air if they lie within this fraction of the range above the darkest voxel.
const AIR_FRACTION: f64 = 0.25;

/// The darkest value is clipped air if the next value is nearer than this fraction of the range.
const MAX_GAP_FRACTION: f64 = 0.05;

/// If less than this fraction of voxels remains, the volume shows only vessels.
const VESSELS_ONLY_FRACTION: f64 = 0.08;

/// The quantile, among voxels brighter than air, of the darkest tissue.
const DARKEST_TISSUE_QUANTILE: f64 = 0.1;

/// Splitting stops once at most this fraction of cubes is brighter than tissue, or after this number of splits.
const MAX_BRIGHTER_FRACTION: f64 = 1.0 / 3.0;
const MAX_SPLITS: usize = 8;

/// The quantile of the darker cubes at which tissue ends, and the quantile of the brighter cubes that is the lumen.
const BRIGHTEST_TISSUE_QUANTILE: f64 = 0.95;
const EDGES: f64 = 0.2;

/// If a volume shows only vessels: the quantiles of voxels for edges and lumen.
const ALONE_EDGES: f64 = 0.05;
const ALONE_LUMEN: f64 = 0.75;
/// If a volume shows only vessels, tissue is darker than lumen by at least this fraction of the range from darkest voxel to lumen.
const ALONE_DIFFERENCE: f64 = 0.25;
/// Edges are usable if they are darker than the lumen by more than this fraction of the range from darkest voxel to lumen.
const EDGE: f64 = 0.1;

pub(crate) struct VoxelSample {
    /// The finite voxels of the cubes, in rising order.
    pub voxels: Vec<f64>,
    /// The maximum of each cube.
    pub largest: Vec<f64>,
    /// The number of voxels, including non-finite ones.
    pub count: usize,
}

impl VoxelSample {
    #[allow(clippy::cast_lossless, clippy::unnecessary_cast)]
    pub(crate) fn at(volume: &Volume) -> Self {
        let (size, strides) = (volume.size(), volume.strides());
        let cubes = size.map(|n| n.div_ceil(CUBE_SIDE));
        let all = cubes.iter().product::<usize>() as f64;
        let step = ((all / MAX_CUBES).cbrt().ceil() as usize).max(1) * CUBE_SIDE;
        let starts = |axis: usize| (0..size[axis]).step_by(step);
        let places = |axis: usize, start: usize| {
            (start..(start + CUBE_SIDE).min(size[axis])).map(move |n| n * strides[axis])
        };
        let mut sampled = Self { voxels: Vec::new(), largest: Vec::new(), count: 0 };
        with_voxels!(volume.voxels(), voxels => {
            for (k, j, i) in starts(2).flat_map(|k| starts(1).flat_map(move |j| starts(0).map(move |i| (k, j, i)))) {
                let before = sampled.voxels.len();
                for (z, y) in places(2, k).flat_map(|z| places(1, j).map(move |y| (z, y))) {
                    sampled.count += places(0, i).len();
                    let row = places(0, i).map(|x| voxels[x + y + z] as f64);
                    sampled.voxels.extend(row.filter(|value| value.is_finite()));
                }
                sampled.largest.extend(sampled.voxels[before..].iter().copied().reduce(f64::max));
            }
        });
        sampled.voxels.par_sort_unstable_by(f64::total_cmp);
        sampled
    }
}

/// The smallest and largest finite voxel; reversed if there is none.
#[allow(clippy::cast_lossless, clippy::unnecessary_cast)]
pub(crate) fn range(volume: &Volume) -> [f64; 2] {
    with_voxels!(volume.voxels(), voxels => range_of(volume, voxels).map(|end| end as f64))
}

fn range_of<T: Voxel>(volume: &Volume, voxels: &[T]) -> [T; 2] {
    let (size, strides) = (volume.size(), volume.strides());
    let [row, column, slice] = {
        let mut axes = [0, 1, 2];
        axes.sort_by_key(|axis| strides[*axis]);
        axes
    };
    let of_row = |start: usize| {
        let length = (size[row] - 1) * strides[row] + 1;
        let values = &voxels[start..start + length];
        // Without steps, the compiler uses vectors.
        if strides[row] == 1 { ends(values.iter()) } else { ends(values.iter().step_by(strides[row])) }
    };
    let of_slice = |k: usize| {
        (0..size[column]).map(|j| of_row(j * strides[column] + k * strides[slice])).fold(none(), wider)
    };
    (0..size[slice]).into_par_iter().map(of_slice).reduce(none, wider)
}

fn ends<'a, T: Voxel>(values: impl Iterator<Item = &'a T>) -> [T; 2] {
    // Comparisons leave out NaN, and infinity lies beyond the largest value.
    values.fold(none(), |[low, high], value| {
        let is_finite = *value >= T::SMALLEST && *value <= T::LARGEST;
        [
            if is_finite && *value < low { *value } else { low },
            if is_finite && *value > high { *value } else { high },
        ]
    })
}

fn none<T: Voxel>() -> [T; 2] {
    [T::LARGEST, T::SMALLEST]
}

fn wider<T: Voxel>([low, high]: [T; 2], [least, most]: [T; 2]) -> [T; 2] {
    [if least < low { least } else { low }, if most > high { most } else { high }]
}

/// The padding: a dark value that many, but not all, of the rising voxels have.
pub(crate) fn padding(voxels: &[f64]) -> Option<f64> {
    let darkest = *voxels.get((voxels.len() as f64 * MAX_DARKER_FRACTION) as usize)?;
    let start = voxels.partition_point(|value| *value < darkest);
    let end = voxels.partition_point(|value| *value <= darkest);
    let is_padding = (end - start) as f64 >= MIN_PADDING_FRACTION * voxels.len() as f64 && end < voxels.len();
    is_padding.then_some(darkest)
}

pub(crate) fn without_padding(voxels: &[f64]) -> &[f64] {
    padding(voxels).map_or(voxels, |padding| above(voxels, padding))
}

/// The rising voxels brighter than `limit`.
fn above(voxels: &[f64], limit: f64) -> &[f64] {
    &voxels[voxels.partition_point(|value| *value <= limit)..]
}

/// Levels of tissue and lumen, for a volume without centerlines.
///
/// Padding (a dark value of at least 5 % of voxels) and air (below a quarter of the range from the 1st to the 99th percentile) are
/// excluded. If less than 8 % of voxels remains, the volume shows only vessels. Their edges then stand for the tissue, and three
/// quarters of their voxels lie below the lumen level.
///
/// Otherwise cubes of 4 × 4 × 4 voxels are classified by their maximum, which noise hardly changes and to which thin vessels
/// contribute more. Cubes above the median are split into two groups on an asinh scale, so that bone does not outweigh lumen. The
/// brighter group is split again until it is below a third of all cubes. The brightest tissue is the 95th percentile of the darker
/// cubes. The lumen is the 20th percentile of the brighter cubes, because most of these show bone and metal.
pub(crate) struct Populations {
    /// The smallest sampled voxel.
    pub smallest: f64,
    /// The 1st percentile.
    pub(crate) darkest: f64,
    pub(crate) tissue: f64,
    /// A level that rays through tissue rarely exceed.
    pub(crate) brightest_tissue: f64,
    pub lumen: f64,
    /// The 99th percentile without padding.
    pub brightest: f64,
    /// The 99.9th percentile without padding.
    pub(crate) peak: f64,
    /// Whether the volume shows only vessels, with edges darker than the lumen.
    pub(crate) has_edges: bool,
}

impl Populations {
    /// None if there are no voxels.
    pub(crate) fn of(sampled: &VoxelSample) -> Option<Self> {
        let Air { smallest, darkest, ends, at: air, .. } = Air::of(sampled)?;
        let enough = VESSELS_ONLY_FRACTION * sampled.count as f64;
        let shown = without_padding(&sampled.voxels);
        let peak = rising_quantile(shown, PEAK_QUANTILE)?;
        let body = above(shown, air);
        let is_body = body.len() as f64 >= enough && !body.is_empty();
        // In a constant volume, or with few voxels besides padding, all voxels count.
        let is_few = (shown.len() as f64) < enough || body.is_empty();
        let vessels = if is_few { shown } else { body };
        let [edges, bright] =
            [rising_quantile(vessels, ALONE_EDGES)?, rising_quantile(vessels, ALONE_LUMEN)?];
        let [tissue, brightest_tissue, lumen] = if is_body {
            let cubes = sampled.largest.iter().copied().filter(|value| *value > air).collect();
            of_body(rising_median(vessels)?, cubes)?
        } else {
            let tissue = bright - (bright - edges).max(ALONE_DIFFERENCE * (bright - darkest));
            [tissue, tissue, bright]
        };
        let has_edges = !is_body && bright - edges > EDGE * (bright - darkest);
        Some(Self { smallest, darkest, tissue, brightest_tissue, lumen, brightest: ends[1], peak, has_edges })
    }
}

struct Air {
    smallest: f64,
    darkest: f64,
    /// The 1st and 99th percentile without padding.
    ends: [f64; 2],
    at: f64,
    /// Whether air was clipped: many voxels have the darkest value, and other values follow without a gap.
    is_cut_off: bool,
}

impl Air {
    fn of(sampled: &VoxelSample) -> Option<Self> {
        let darkest = rising_quantile(&sampled.voxels, MAX_DARKER_FRACTION)?;
        let has_padding = padding(&sampled.voxels).is_some();
        let smallest = *sampled.voxels.first()?;
        let shown = without_padding(&sampled.voxels);
        let first = *shown.first()?;
        let ends = [MAX_DARKER_FRACTION, 1.0 - MAX_DARKER_FRACTION].map(|part| rising_quantile(shown, part));
        let ends = [ends[0]?, ends[1]?];
        // If other values follow the padding without a gap, it is clipped air.
        let is_air = first - darkest < MAX_GAP_FRACTION * (ends[1] - darkest);
        let low = if is_air { darkest } else { ends[0] };
        let at = low + AIR_FRACTION * (ends[1] - low);
        Some(Self { smallest, darkest, ends, at, is_cut_off: has_padding && is_air })
    }
}

/// The darkest tissue (fat in CT): the 10th percentile of voxels above air. If air was clipped at a value of at least `cut_off`,
/// that value, since tissue may be darker than the limit of air. None if the volume shows hardly anything but vessels.
pub(crate) fn darkest_tissue(sampled: &VoxelSample, cut_off: f64) -> Option<f64> {
    let air = Air::of(sampled)?;
    if air.is_cut_off && air.darkest >= cut_off {
        return Some(air.darkest);
    }
    let enough = VESSELS_ONLY_FRACTION * sampled.count as f64;
    let body = above(&sampled.voxels, air.at);
    if (body.len() as f64) < enough { None } else { rising_quantile(body, DARKEST_TISSUE_QUANTILE) }
}

fn of_body(tissue: f64, mut cubes: Vec<f64>) -> Option<[f64; 3]> {
    let middle = median(&mut cubes)?;
    let scale = quantile(&mut cubes, 0.75)? - quantile(&mut cubes, 0.25)?;
    cubes.sort_unstable_by(f64::total_cmp);
    let scale = if scale > 0.0 { scale } else { f64::MIN_POSITIVE.max(1e-9 * middle.abs()) };
    let above: Vec<f64> = cubes.iter().map(|value| ((value - middle).max(0.0) / scale).asinh()).collect();
    let mut start = 0;
    for _ in 0..MAX_SPLITS {
        let Some(larger) = two_groups(&above[start..]) else { break };
        start += larger;
        if (above.len() - start) as f64 <= MAX_BRIGHTER_FRACTION * above.len() as f64 {
            break;
        }
    }
    let (darker, brighter) = cubes.split_at_mut(start);
    let lumen = quantile(brighter, EDGES)?;
    Some([tissue, quantile(darker, BRIGHTEST_TISSUE_QUANTILE).unwrap_or(lumen), lumen])
}

#[cfg(test)]
#[path = "tests/populations.rs"]
mod tests;
