//! Windows computed from the data, which separate lumen from surroundings. Intensities are in the volume's unit (HU in CT).

use std::borrow::Cow;

use glam::DVec3;
use lumencut_core::error::{Error, ErrorKind, Mend, Result};
use lumencut_core::math::sampling::Grid;
use lumencut_core::settings::Window;
use lumencut_core::vessel_tree::VesselTree;
use lumencut_core::volume::Volume;
use lumencut_core::with_voxels;

use crate::populations::{Populations, VoxelSample, darkest_tissue, padding, range, without_padding};
use crate::text::rounded;
use lumencut_core::math::statistics::{median, quantile, rising_median, rising_quantile};

/// Tissue is sampled this far beyond the wall (mm), and a radius that is unknown is taken to be this (mm).
const TISSUE_DISTANCE_MM: f64 = 10.0;
const UNKNOWN_RADIUS_MM: f64 = 10.0;

const MAX_MAGNITUDE: f64 = 1e12;

/// The smallest and largest position of the lumen in a window, from black (0) to white (1).
const LUMEN_POSITION: [f64; 2] = [0.60, 0.72];

/// The multiple of the difference between lumen and tissue by which black lies below the lumen: without noise, and at most.
const BLACK_BELOW_LUMEN: [f64; 2] = [1.5, 2.2];

/// Black lies below the darkest tissue by this share of the difference between lumen and darkest tissue.
const BLACK_BELOW_DARKEST_TISSUE: f64 = 0.1;

/// Quantiles of a normal distribution at ±1 standard deviation.
const ONE_SIGMA_QUANTILES: [f64; 2] = [0.16, 0.84];

/// Without centerlines: the position of the lumen in the window, and how far below it the brightest and the median tissue lie.
const VOLUME_LUMEN_POSITION: f64 = 0.67;
const VOLUME_TISSUE_BELOW: [f64; 2] = [0.4, 0.56];

/// Without centerlines: the smallest width, as a fraction of the range from the darkest to the brightest voxels.
const VOLUME_MIN_WIDTH: f64 = 0.1;

/// The largest factor by which a window is widened for a MIP, so that stents and bone are brighter than the lumen.
const MIP_MAX_WIDENING: f64 = 1.4;

/// At least this fraction of the surroundings must lie inside the volume and not be padding.
const MIN_SHOWN_FRACTION: f64 = 0.5;

/// The quantiles of voxels at the black and the white ends of windows for a whole volume.
const DARKEST_QUANTILE: f64 = 0.01;
const BRIGHT_QUANTILE: f64 = 0.99;
const BRIGHTEST_QUANTILE: f64 = 0.999;

/// The quantile of the lumen that stands for the brightest vessels; small vessels are darker because of blur.
const BRIGHT_LUMEN_QUANTILE: f64 = 0.9;

/// The position of the brightest vessels in a widened window, and the position from which a window must be widened for them.
const BRIGHT_LUMEN_POSITION: [f64; 2] = [0.9, 0.95];

const EMPTY_VOLUME_WINDOW: Window = Window { level: 300.0, width: 900.0 };

/// The values of the volume at world points (mm, LPS), interpolated trilinearly; NaN outside.
pub fn sample(volume: &Volume, points: &[DVec3]) -> Vec<f32> {
    let (grid, to_index) = (Grid::new(volume), volume.index_from_world());
    with_voxels!(volume.voxels(), voxels => points
        .iter()
        .map(|point| grid.trilinear(voxels, to_index.transform_point3(*point)))
        .collect())
}

/// A window that shows lumen light grey, tissue dark, and calcium and stents white.
///
/// The lumen is the median along the centerlines, and the tissue is the median 10 mm beyond the walls. If most of
/// that is padding or outside the volume, the tissue is the vessels' edges, or the rest if darker. Black lies 1.5
/// times the difference between lumen and tissue below the lumen. It lies lower, up to 2.2 times, if the lumen is
/// noisy or the darkest tissue (fat) would be black, but not below the volume's minimum. White is at the brightest
/// voxels, as long as the lumen stays at 60 to 72 % of the range. For a dark lumen everything is mirrored: it lies at
/// 28 to 40 %, or darker if no voxel is as dark as black. Fails with [`ErrorKind::Volume`] for values out of range.
pub(crate) fn along(sampled: &VoxelSample, volume: &Volume, tree: &VesselTree) -> Result<Window> {
    let points: Vec<DVec3> = tree.vessels().iter().flat_map(|vessel| vessel.points()).copied().collect();
    let mut lumen = finite(&sample(volume, &points));
    let Some(level) = median(&mut lumen) else {
        return Ok(EMPTY_VOLUME_WINDOW);
    };
    let Some(beyond) = tissue_around(volume, tree, level, sampled) else {
        return Ok(EMPTY_VOLUME_WINDOW);
    };
    let darkest_tissue = darkest_tissue(sampled, level - BLACK_BELOW_LUMEN[1] * (level - beyond));
    let mut wall = finite(&sample(volume, &beside(tree, 0.0)));
    // A dark lumen is handled like a bright one, with negated values.
    let sign = if level < beyond { -1.0 } else { 1.0 };
    for value in lumen.iter_mut().chain(&mut wall) {
        *value *= sign;
    }
    let rising: Cow<[f64]> = if sign < 0.0 {
        sampled.voxels.iter().rev().map(|value| -value).collect()
    } else {
        (&sampled.voxels).into()
    };
    let [lower, upper] = ONE_SIGMA_QUANTILES.map(|part| quantile(&mut lumen, part).unwrap_or_default());
    let [low, high] =
        [DARKEST_QUANTILE, BRIGHTEST_QUANTILE].map(|part| rising_quantile(&rising, part).unwrap_or_default());
    let high = high.max(quantile(&mut wall, BRIGHT_QUANTILE).unwrap_or(high));
    let tissue = Tissue { middle: sign * beyond, darkest: darkest_tissue.filter(|_| sign > 0.0) };
    let [black, mut white] = around_lumen(sign * level, tissue, (upper - lower) / 2.0, [low, high]);
    if sign < 0.0 {
        // For a dark lumen, this is the black end of the window. It never lies below the volume's minimum.
        white = white.min(rising.last().copied().unwrap_or(white));
    }
    within(sign * (black + white) / 2.0, white - black, || {
        format!("values around {} along the centerlines, {} beside", rounded(level, 3), rounded(beyond, 3))
    })
}

/// The median around the vessels. If most of that is padding or outside, the darker of the visible rest's median and the vessels'
/// edges. In clipped scans most tissue looks like padding, and the visible rest may be only bone.
fn tissue_around(volume: &Volume, tree: &VesselTree, lumen: f64, sampled: &VoxelSample) -> Option<f64> {
    let places = beside(tree, TISSUE_DISTANCE_MM);
    let mut around = finite(&sample(volume, &places));
    let padding = padding(&sampled.voxels).unwrap_or(f64::NEG_INFINITY);
    let mut shown: Vec<f64> = around.iter().copied().filter(|value| *value > padding).collect();
    let middle = median(&mut shown);
    if shown.len() as f64 >= MIN_SHOWN_FRACTION * places.len() as f64 {
        return middle;
    }
    let edges = Populations::of(sampled)
        .filter(|found| found.tissue < lumen && (found.has_edges || around.is_empty()))
        .map(|found| found.tissue);
    edges.map(|edges| middle.map_or(edges, |middle| edges.min(middle))).or_else(|| median(&mut around))
}

#[derive(Clone, Copy)]
struct Tissue {
    middle: f64,
    darkest: Option<f64>,
}

fn around_lumen(lumen: f64, tissue: Tissue, spread: f64, ends: [f64; 2]) -> [f64; 2] {
    let difference = lumen - tissue.middle;
    let mut below = 2.0 * spread;
    // Without contrast, only the noise defines the window.
    if difference > spread / 2.0 {
        let darkest =
            tissue.darkest.map_or(0.0, |darkest| (1.0 + BLACK_BELOW_DARKEST_TISSUE) * (lumen - darkest));
        below =
            below.max(darkest).clamp(BLACK_BELOW_LUMEN[0] * difference, BLACK_BELOW_LUMEN[1] * difference);
    }
    let black = (lumen - below).max(ends[0].min(tissue.middle)).min(lumen);
    let [farthest, nearest] = LUMEN_POSITION.map(|place| lumen + (lumen - black) * (1.0 / place - 1.0));
    [black, ends[1].clamp(nearest, farthest)]
}

/// Six points (mm, LPS) around each centerline point, `beyond` mm outside the wall.
fn beside(tree: &VesselTree, beyond: f64) -> Vec<DVec3> {
    let sides = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
    let of_vessel = tree.vessels().iter().flat_map(|vessel| {
        vessel.points().iter().enumerate().flat_map(move |(i, point)| {
            let radius = vessel.radius().map_or(UNKNOWN_RADIUS_MM, |radii| radii[i]);
            sides.map(|side| *point + (radius + beyond) * side)
        })
    });
    of_vessel.collect()
}

/// A window without centerlines that separates lumen from surroundings, with the levels of [`Populations`].
pub(crate) fn of_volume(sampled: &VoxelSample) -> Result<Window> {
    alone(sampled, |_, _| 1.0)
}

/// A window without centerlines for slices, in which tissue matters. The lumen is at 60 to 72 %, and black as far below it as in
/// [`along`]. The window of [`of_volume`] leaves more tissue black, as projections require.
pub(crate) fn of_slices(sampled: &VoxelSample) -> Result<Window> {
    let Some(found) = Populations::of(sampled) else {
        return Ok(EMPTY_VOLUME_WINDOW);
    };
    let lumen = found.lumen;
    let tissue = cut_off_tissue(sampled, lumen).unwrap_or_else(|| {
        let darkest = darkest_tissue(sampled, lumen - BLACK_BELOW_LUMEN[1] * (lumen - found.tissue));
        Tissue { middle: found.tissue, darkest }
    });
    let [black, white] = around_lumen(lumen, tissue, 0.0, [found.darkest, found.peak]);
    within(f64::midpoint(black, white), white - black, || from_to(found.darkest, found.brightest))
}

/// The tissue of a volume whose dark values were clipped, else None. Most voxels above padding are nearer to it than to the lumen,
/// and many of them would count as air.
fn cut_off_tissue(sampled: &VoxelSample, lumen: f64) -> Option<Tissue> {
    let padding = padding(&sampled.voxels)?;
    let middle = rising_median(without_padding(&sampled.voxels))?;
    (middle - padding < lumen - middle).then_some(Tissue { middle, darkest: Some(padding) })
}

/// The window of [`along`], widened if the brightest vessels would be white.
pub(crate) fn holding_lumen(sampled: &VoxelSample, volume: &Volume, tree: &VesselTree) -> Result<Window> {
    let window = along(sampled, volume, tree)?;
    let black = window.level - window.width / 2.0;
    let needed =
        brightest_lumen(volume, tree).map_or(0.0, |lumen| (lumen - black) / BRIGHT_LUMEN_POSITION[0]);
    let width = window.width.max(needed);
    Ok(Window { level: black + width / 2.0, width })
}

/// Whether a window does not show the brightest vessels white; true without vessels.
pub(crate) fn holds_lumen(window: Window, volume: &Volume, tree: &VesselTree) -> bool {
    let share = |lumen: f64| (lumen - window.level) / window.width + 0.5;
    brightest_lumen(volume, tree).is_none_or(|lumen| share(lumen) <= BRIGHT_LUMEN_POSITION[1])
}

fn brightest_lumen(volume: &Volume, tree: &VesselTree) -> Option<f64> {
    let points: Vec<DVec3> = tree.vessels().iter().flat_map(|vessel| vessel.points()).copied().collect();
    quantile(&mut finite(&sample(volume, &points)), BRIGHT_LUMEN_QUANTILE)
}

/// [`of_volume`] for a MIP, widened at most 1.4 times so that white is at the 99.9th percentile. In a MIP noise makes
/// lumen brighter, so the window must reach brighter values.
pub(crate) fn of_mip(sampled: &VoxelSample) -> Result<Window> {
    alone(sampled, |found, [black, width]| ((found.peak - black) / width).clamp(1.0, MIP_MAX_WIDENING))
}

/// A window from the levels of [`Populations`], widened by the factor `wider(populations, [black, width])`.
fn alone(sampled: &VoxelSample, wider: impl Fn(&Populations, [f64; 2]) -> f64) -> Result<Window> {
    let Some(found) = Populations::of(sampled) else {
        return Ok(EMPTY_VOLUME_WINDOW);
    };
    let above =
        [found.brightest_tissue, found.tissue.min(found.brightest_tissue)].map(|tissue| found.lumen - tissue);
    let least = VOLUME_MIN_WIDTH * (found.brightest - found.darkest);
    let width = (above[0] / VOLUME_TISSUE_BELOW[0]).max(above[1] / VOLUME_TISSUE_BELOW[1]).max(least);
    // Black is not below the minimum, which would then look grey.
    let black = (found.lumen - VOLUME_LUMEN_POSITION * width).max(found.smallest);
    let width = (found.lumen - black) / VOLUME_LUMEN_POSITION;
    let width = width * wider(&found, [black, width]);
    within(black + width / 2.0, width, || from_to(found.darkest, found.brightest))
}

/// A window from the 1st percentile to the 99th, without padding: from air to lumen. Fails with [`ErrorKind::Volume`]
/// for values out of range.
pub(crate) fn whole(sampled: &VoxelSample) -> Result<Window> {
    without_unit(sampled, BRIGHT_QUANTILE)
}

/// As [`whole`] for MR angiography, but up to the 99.9th percentile, so that vessels are not all white.
pub(crate) fn mra(sampled: &VoxelSample) -> Result<Window> {
    without_unit(sampled, BRIGHTEST_QUANTILE)
}

/// A window from the smallest to the largest voxel. Fails with [`ErrorKind::Volume`] for values out of range.
pub(crate) fn full(volume: &Volume) -> Result<Window> {
    let [black, white] = range(volume);
    if black > white {
        return Ok(EMPTY_VOLUME_WINDOW);
    }
    within(black + (white - black) / 2.0, white - black, || from_to(black, white))
}

/// A window from the 1st percentile to the quantile `bright`, without padding.
fn without_unit(sampled: &VoxelSample, bright: f64) -> Result<Window> {
    let Some(black) = rising_quantile(&sampled.voxels, DARKEST_QUANTILE) else {
        return Ok(EMPTY_VOLUME_WINDOW);
    };
    let white = rising_quantile(without_padding(&sampled.voxels), bright).unwrap_or(black);
    within((black + white) / 2.0, white - black, || from_to(black, white))
}

fn from_to(low: f64, high: f64) -> String {
    format!("values from {} to {}", rounded(low, 3), rounded(high, 3))
}

/// The window with a width above 0, or an error that reports `found`.
fn within(level: f64, width: f64, found: impl Fn() -> String) -> Result<Window> {
    let width = width.max(1e-3 * level.abs()).max(1e-6);
    if level.abs() <= MAX_MAGNITUDE && width <= MAX_MAGNITUDE {
        return Ok(Window { level, width });
    }
    let error = Error::new(ErrorKind::Volume, "window from the data", found(), "a window within ±1e+12");
    Err(error.mend("scale the voxels").mended_by(Mend::Windows))
}

fn finite(values: &[f32]) -> Vec<f64> {
    values.iter().map(|value| f64::from(*value)).filter(|value| value.is_finite()).collect()
}

#[cfg(test)]
#[path = "tests/windows.rs"]
mod tests;
