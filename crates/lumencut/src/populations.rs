//! What the distribution of a volume's voxels says of its padding, its tissue and its lumen.

use lumencut_core::volume::Volume;
use lumencut_core::with_voxels;

use lumencut_core::math::statistics::{median, quantile, two_groups};

/// The side of the cubes whose largest values tell lumen from tissue (voxels), and how many of them are looked at.
const SIDE: usize = 4;
const MOST_CUBES: f64 = 32768.0;

/// Which part of all voxels has the same dark value where that is padding, and which part is darker at most.
const PADDING: f64 = 0.05;
const DARKEST: f64 = 0.01;

/// Which part of the voxels is at most as bright as the peak.
const PEAK: f64 = 0.999;

/// Voxels brighter than air are farther from the darkest than this part of the way to the brightest.
const AIR: f64 = 0.25;

/// Padding is air where the darkest other voxel is nearer to it than this part of the way to the brightest.
const GAP: f64 = 0.05;

/// Where fewer voxels than this part are left, they are vessels alone.
const VESSELS_ALONE: f64 = 0.08;

/// Which part of what is brighter than air is darker than what stands for the darkest tissue.
const DARKEST_TISSUE: f64 = 0.1;

/// Which part of all cubes is brighter than tissue at most, and how often the brighter ones are parted for it.
const BRIGHTER: f64 = 1.0 / 3.0;
const PARTINGS: usize = 8;

/// Cubes of tissue alone: up to here it counts as dark. Brighter cubes: up to here are edges, from here on lumen.
const BRIGHTEST_TISSUE: f64 = 0.95;
const EDGES: f64 = 0.2;

/// Vessels alone: which part of them are edges, and where their lumen is.
const ALONE_EDGES: f64 = 0.05;
const ALONE_LUMEN: f64 = 0.75;
/// The least difference of the two, as a part of the way from the darkest voxel to the lumen.
const ALONE_DIFFERENCE: f64 = 0.25;
/// How much darker than the lumen edges are at least, as a part of the same.
const EDGE: f64 = 0.1;

/// Voxels of cubes that are evenly spread over a volume, at most about two million.
pub(crate) struct Looked {
    /// All finite ones.
    pub voxels: Vec<f64>,
    /// The largest of each cube.
    pub largest: Vec<f64>,
    /// How many there are, with those that are not finite.
    pub count: usize,
}

impl Looked {
    /// Looks at a volume.
    // Of the ten types of voxels some fit into f64 as they are, others only by a cast.
    #[allow(clippy::cast_lossless, clippy::unnecessary_cast)]
    pub(crate) fn at(volume: &Volume) -> Self {
        let (size, strides) = (volume.size(), volume.strides());
        let cubes = size.map(|n| n.div_ceil(SIDE));
        let all = cubes.iter().product::<usize>() as f64;
        let step = ((all / MOST_CUBES).cbrt().ceil() as usize).max(1) * SIDE;
        let starts = |axis: usize| (0..size[axis]).step_by(step);
        let places = |axis: usize, start: usize| {
            (start..(start + SIDE).min(size[axis])).map(move |n| n * strides[axis])
        };
        let mut looked = Self { voxels: Vec::new(), largest: Vec::new(), count: 0 };
        with_voxels!(volume.voxels(), voxels => {
            for (k, j, i) in starts(2).flat_map(|k| starts(1).flat_map(move |j| starts(0).map(move |i| (k, j, i)))) {
                let before = looked.voxels.len();
                for (z, y) in places(2, k).flat_map(|z| places(1, j).map(move |y| (z, y))) {
                    looked.count += places(0, i).len();
                    let row = places(0, i).map(|x| voxels[x + y + z] as f64);
                    looked.voxels.extend(row.filter(|value| value.is_finite()));
                }
                looked.largest.extend(looked.voxels[before..].iter().copied().reduce(f64::max));
            }
        });
        looked
    }
}

/// The smallest and the largest finite voxel; the first is the larger one where there is none.
#[allow(clippy::cast_lossless, clippy::unnecessary_cast)]
pub(crate) fn range(volume: &Volume) -> [f64; 2] {
    let (size, strides) = (volume.size(), volume.strides());
    let mut ends = [f64::INFINITY, f64::NEG_INFINITY];
    with_voxels!(volume.voxels(), voxels => {
        for k in 0..size[2] {
            for j in 0..size[1] {
                let row = (0..size[0]).map(|i| voxels[i * strides[0] + j * strides[1] + k * strides[2]] as f64);
                ends = row.filter(|value| value.is_finite()).fold(ends, |[low, high], value| [low.min(value), high.max(value)]);
            }
        }
    });
    ends
}

/// The padding: a dark value that many voxels have, where not all have it. Sorts the voxels.
pub(crate) fn padding(voxels: &mut [f64]) -> Option<f64> {
    voxels.sort_unstable_by(f64::total_cmp);
    let darkest = *voxels.get((voxels.len() as f64 * DARKEST) as usize)?;
    let start = voxels.partition_point(|value| *value < darkest);
    let end = voxels.partition_point(|value| *value <= darkest);
    let is_padding = (end - start) as f64 >= PADDING * voxels.len() as f64 && end < voxels.len();
    is_padding.then_some(darkest)
}

/// The voxels that are brighter than the padding, all where there is none; sorted.
pub(crate) fn without_padding(voxels: &mut [f64]) -> &mut [f64] {
    let start = padding(voxels).map_or(0, |padding| voxels.partition_point(|value| *value <= padding));
    &mut voxels[start..]
}

/// What stands for tissue and lumen in a volume without centerlines.
///
/// Padding, a dark value that a twentieth of all voxels has, is left out, then air: what is darker than a quarter of the
/// way from the 1st to the 99th percentile. Where less than 8 % of the volume is left, it is vessels alone: their edges
/// stand for the tissue, three quarters of them lie below what stands for the lumen.
///
/// Otherwise cubes of 4 × 4 × 4 voxels are told apart by their largest value: noise hardly moves it, and thin vessels
/// have a larger part in it than of the voxels. Above the median the cubes are parted in two groups, on a scale that
/// compresses what is far brighter so that bone does not count more than lumen (asinh), and the brighter group again
/// until it is less than a third of all. The 95th percentile of the darker cubes is the brightest tissue; the lumen is
/// the 20th percentile of the brighter ones, as bone and metal are the larger part of them.
pub(crate) struct Populations {
    /// The smallest voxel that was looked at.
    pub smallest: f64,
    /// The darkest voxels (1st percentile).
    pub(crate) darkest: f64,
    /// The median of the tissue.
    pub(crate) tissue: f64,
    /// What hardly a ray through tissue exceeds.
    pub(crate) brightest_tissue: f64,
    /// The lumen.
    pub lumen: f64,
    /// The brightest voxels (99th percentile of what is no padding).
    pub brightest: f64,
    /// What is brighter than nearly all of them (99.9th percentile of the same).
    pub(crate) peak: f64,
    /// Whether vessels alone are shown, and their edges are darker than their lumen.
    pub(crate) has_edges: bool,
}

impl Populations {
    /// What the voxels are; None of no voxels.
    pub(crate) fn of(looked: &mut Looked) -> Option<Self> {
        let Air { smallest, darkest, ends, at: air, .. } = Air::of(looked)?;
        let enough = VESSELS_ALONE * looked.count as f64;
        let shown = without_padding(&mut looked.voxels);
        let peak = quantile(shown, PEAK)?;
        let mut body: Vec<f64> = shown.iter().copied().filter(|value| *value > air).collect();
        let is_body = body.len() as f64 >= enough && !body.is_empty();
        // Of one value alone, or of few voxels beside padding, all count.
        let is_few = (shown.len() as f64) < enough || body.is_empty();
        let vessels = if is_few { shown } else { &mut body };
        let [edges, bright] = [quantile(vessels, ALONE_EDGES)?, quantile(vessels, ALONE_LUMEN)?];
        let [tissue, brightest_tissue, lumen] = if is_body {
            let cubes = looked.largest.iter().copied().filter(|value| *value > air).collect();
            of_body(median(vessels)?, cubes)?
        } else {
            let tissue = bright - (bright - edges).max(ALONE_DIFFERENCE * (bright - darkest));
            [tissue, tissue, bright]
        };
        let has_edges = !is_body && bright - edges > EDGE * (bright - darkest);
        Some(Self { smallest, darkest, tissue, brightest_tissue, lumen, brightest: ends[1], peak, has_edges })
    }
}

/// Where air ends, and how dark the voxels are.
struct Air {
    /// The smallest voxel that was looked at.
    smallest: f64,
    /// The darkest voxels (1st percentile).
    darkest: f64,
    /// The 1st and the 99th percentile of what is no padding.
    ends: [f64; 2],
    /// What is darker is air.
    at: f64,
    /// Whether air was cut off: many voxels have the darkest value, and the others follow it without a gap.
    is_cut_off: bool,
}

impl Air {
    fn of(looked: &mut Looked) -> Option<Self> {
        let darkest = quantile(&mut looked.voxels, DARKEST)?;
        let has_padding = padding(&mut looked.voxels).is_some();
        let smallest = *looked.voxels.first()?;
        let shown = without_padding(&mut looked.voxels);
        let first = *shown.first()?;
        let ends = [quantile(shown, DARKEST)?, quantile(shown, 1.0 - DARKEST)?];
        // Padding that the other values follow without a gap is air that was cut off.
        let is_air = first - darkest < GAP * (ends[1] - darkest);
        let low = if is_air { darkest } else { ends[0] };
        let at = low + AIR * (ends[1] - low);
        Some(Self { smallest, darkest, ends, at, is_cut_off: has_padding && is_air })
    }
}

/// The darkest tissue of a volume, which is fat in a CT: the 10th percentile of what is brighter than air. Where air was cut
/// off at a value that is at least `cut_off`, that value, as tissue may be darker than what counts as air then. None where
/// little but vessels is shown.
pub(crate) fn darkest_tissue(looked: &mut Looked, cut_off: f64) -> Option<f64> {
    let air = Air::of(looked)?;
    if air.is_cut_off && air.darkest >= cut_off {
        return Some(air.darkest);
    }
    let enough = VESSELS_ALONE * looked.count as f64;
    let mut body: Vec<f64> = looked.voxels.iter().copied().filter(|value| *value > air.at).collect();
    if (body.len() as f64) < enough { None } else { quantile(&mut body, DARKEST_TISSUE) }
}

/// The tissue, the brightest tissue and the lumen of vessels among tissue and bone, by the largest values of cubes.
fn of_body(tissue: f64, mut cubes: Vec<f64>) -> Option<[f64; 3]> {
    let middle = median(&mut cubes)?;
    let scale = quantile(&mut cubes, 0.75)? - quantile(&mut cubes, 0.25)?;
    cubes.sort_unstable_by(f64::total_cmp);
    let scale = if scale > 0.0 { scale } else { f64::MIN_POSITIVE.max(1e-9 * middle.abs()) };
    let above: Vec<f64> = cubes.iter().map(|value| ((value - middle).max(0.0) / scale).asinh()).collect();
    let mut start = 0;
    for _ in 0..PARTINGS {
        let Some(larger) = two_groups(&above[start..]) else { break };
        start += larger;
        if (above.len() - start) as f64 <= BRIGHTER * above.len() as f64 {
            break;
        }
    }
    let (darker, brighter) = cubes.split_at_mut(start);
    let lumen = quantile(brighter, EDGES)?;
    Some([tissue, quantile(darker, BRIGHTEST_TISSUE).unwrap_or(lumen), lumen])
}

#[cfg(test)]
#[path = "tests/populations.rs"]
mod tests;
