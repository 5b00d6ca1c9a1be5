//! Windows taken from the data: which intensities (in the volume's unit, HU for CT) tell lumen from its surroundings.

use glam::DVec3;
use lumencut_core::error::{Error, ErrorKind, Mend, Result};
use lumencut_core::math::sampling::Grid;
use lumencut_core::settings::Window;
use lumencut_core::vessel_tree::VesselTree;
use lumencut_core::volume::Volume;
use lumencut_core::with_voxels;

use crate::populations::{Looked, Populations, darkest_tissue, padding, range, without_padding};
use crate::text::rounded;
use lumencut_core::math::statistics::{median, quantile};

/// How far beyond the wall a window's tissue is looked for, and the radius where it is unknown (mm).
const BESIDE: f64 = 10.0;
const UNKNOWN_RADIUS: f64 = 10.0;

/// The largest level and width that a window can have.
const LARGEST: f64 = 1e12;

/// Where the lumen lies in a window along centerlines: from black to white, at least and at most.
const LUMEN_AT: [f64; 2] = [0.60, 0.72];

/// How far below the lumen such a window begins, in differences of lumen and tissue: without noise, and at most.
const BELOW_LUMEN: [f64; 2] = [1.5, 2.2];

/// How far below the darkest tissue such a window begins, in differences of lumen and darkest tissue.
const BELOW_DARKEST_TISSUE: f64 = 0.1;

/// Which part of a normal distribution lies within a standard deviation below its middle, and within one above.
const SPREAD: [f64; 2] = [0.16, 0.84];

/// Where the lumen of a volume alone lies in its window, and how far below it the brightest tissue and the middle of it.
const ALONE_LUMEN_AT: f64 = 0.67;
const ALONE_BELOW: [f64; 2] = [0.4, 0.56];

/// The least width of such a window, as a part of the way from the darkest to the brightest voxels.
const ALONE_NARROWEST: f64 = 0.1;

/// How much wider the window of a MIP becomes at most, so that stents and bone are not the same white as the lumen.
const MIP_WIDEST: f64 = 1.4;

/// Which part of what is around vessels must be inside the volume, and no padding, to stand for the tissue.
const SHOWN: f64 = 0.5;

/// Which parts of the voxels are darker than a window of the whole volume, and at most as bright as its white end.
const DARKEST: f64 = 0.01;
const BRIGHT: f64 = 0.99;
const BRIGHTEST: f64 = 0.999;

/// This part of a lumen is darker than what stands for its brightest vessels: small ones are darker, as they are blurred.
const BRIGHT_LUMEN: f64 = 0.9;

/// Where these lie at most, from black to white, and from where on nothing is to be seen within them.
const HELD: [f64; 2] = [0.9, 0.95];

/// The window of volumes without a single number.
const OF_NOTHING: Window = Window { level: 300.0, width: 900.0 };

/// The volume at world points (mm, LPS), trilinear, NaN outside.
pub fn sample(volume: &Volume, points: &[DVec3]) -> Vec<f32> {
    let (grid, to_index) = (Grid::new(volume), volume.index_from_world());
    with_voxels!(volume.voxels(), voxels => points
        .iter()
        .map(|point| grid.trilinear(voxels, to_index.transform_point3(*point)))
        .collect())
}

/// A window that shows lumen light grey, tissue dark, calcifications and stents white.
///
/// The median along the centerlines stands for the lumen, the median 10 mm beyond the vessels' walls for the tissue
/// around it; where most of that is padding or outside the volume, the edges of the vessels do, or what is shown if it is
/// darker. Black lies 1.5 times their difference below the lumen, farther for a lumen that is noisy and where the darkest
/// tissue, such as fat, would be black; at most 2.2 times, and not below what the volume holds. White lies where the brightest
/// voxels are, so far as the lumen stays at 60 to 72 % of the range. Where the lumen is the darker of the two, all this is
/// mirrored: it lies at 28 to 40 %, or darker where the volume holds nothing that is as dark as black would be; its
/// surroundings lie above.
///
/// # Errors
/// [`ErrorKind::Volume`] for values beyond all windows.
pub fn along(volume: &Volume, tree: &VesselTree) -> Result<Window> {
    let points: Vec<DVec3> = tree.vessels().iter().flat_map(|vessel| vessel.points()).copied().collect();
    let mut lumen = finite(&sample(volume, &points));
    let Some(level) = median(&mut lumen) else {
        return Ok(OF_NOTHING);
    };
    let mut looked = Looked::at(volume);
    let Some(beyond) = tissue_around(volume, tree, level, &mut looked) else {
        return Ok(OF_NOTHING);
    };
    let darkest_tissue = darkest_tissue(&mut looked, level - BELOW_LUMEN[1] * (level - beyond));
    let mut wall = finite(&sample(volume, &beside(tree, 0.0)));
    // A dark lumen among bright tissue is a bright one of the negated values.
    let sign = if level < beyond { -1.0 } else { 1.0 };
    for value in lumen.iter_mut().chain(&mut wall).chain(&mut looked.voxels) {
        *value *= sign;
    }
    let [lower, upper] = SPREAD.map(|part| quantile(&mut lumen, part).unwrap_or_default());
    let [low, high] = [DARKEST, BRIGHTEST].map(|part| quantile(&mut looked.voxels, part).unwrap_or_default());
    let high = high.max(quantile(&mut wall, BRIGHT).unwrap_or(high));
    let tissue = Tissue { middle: sign * beyond, darkest: darkest_tissue.filter(|_| sign > 0.0) };
    let [black, mut white] = around_lumen(sign * level, tissue, (upper - lower) / 2.0, [low, high]);
    if sign < 0.0 {
        // What is white of the negated values is black, which never lies below all of the volume.
        white = white.min(quantile(&mut looked.voxels, 1.0).unwrap_or(white));
    }
    within(sign * (black + white) / 2.0, white - black, || {
        format!("values around {} along the centerlines, {} beside", rounded(level, 3), rounded(beyond, 3))
    })
}

/// The median around the vessels. Where most of that is padding or outside, the darker of what is shown of it and of the
/// edges of the vessels, if they have any: in a scan whose dark values are cut off, most of the tissue looks like padding, and
/// the only edges that are left may lie between lumens and bone.
fn tissue_around(volume: &Volume, tree: &VesselTree, lumen: f64, looked: &mut Looked) -> Option<f64> {
    let places = beside(tree, BESIDE);
    let mut around = finite(&sample(volume, &places));
    let padding = padding(&mut looked.voxels).unwrap_or(f64::NEG_INFINITY);
    let mut shown: Vec<f64> = around.iter().copied().filter(|value| *value > padding).collect();
    let middle = median(&mut shown);
    if shown.len() as f64 >= SHOWN * places.len() as f64 {
        return middle;
    }
    let edges = Populations::of(looked)
        .filter(|found| found.tissue < lumen && (found.has_edges || around.is_empty()))
        .map(|found| found.tissue);
    edges.map(|edges| middle.map_or(edges, |middle| edges.min(middle))).or_else(|| median(&mut around))
}

/// What lies around a lumen that is brighter.
#[derive(Clone, Copy)]
struct Tissue {
    middle: f64,
    /// Such as fat, where it is known.
    darkest: Option<f64>,
}

/// Black and white around a lumen that is brighter than its tissue, in a volume with these ends.
fn around_lumen(lumen: f64, tissue: Tissue, spread: f64, ends: [f64; 2]) -> [f64; 2] {
    let difference = lumen - tissue.middle;
    let mut below = 2.0 * spread;
    // A lumen that hardly differs from its tissue has no window but that of its noise.
    if difference > spread / 2.0 {
        let darkest = tissue.darkest.map_or(0.0, |darkest| (1.0 + BELOW_DARKEST_TISSUE) * (lumen - darkest));
        below = below.max(darkest).clamp(BELOW_LUMEN[0] * difference, BELOW_LUMEN[1] * difference);
    }
    let black = (lumen - below).max(ends[0].min(tissue.middle)).min(lumen);
    let [farthest, nearest] = LUMEN_AT.map(|place| lumen + (lumen - black) * (1.0 / place - 1.0));
    [black, ends[1].clamp(nearest, farthest)]
}

/// Six points around each point of the tree, so far beyond the wall (mm, LPS).
fn beside(tree: &VesselTree, beyond: f64) -> Vec<DVec3> {
    let sides = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
    let of_vessel = tree.vessels().iter().flat_map(|vessel| {
        vessel.points().iter().enumerate().flat_map(move |(i, point)| {
            let radius = vessel.radius().map_or(UNKNOWN_RADIUS, |radii| radii[i]);
            sides.map(|side| *point + (radius + beyond) * side)
        })
    });
    of_vessel.collect()
}

/// A window that tells lumen from its surroundings in a picture of all of the volume, where there are no centerlines.
///
/// What stands for lumen and tissue is found from the distribution of the voxels, see `populations.rs`.
///
/// # Errors
/// [`ErrorKind::Volume`] for values beyond all windows.
pub(crate) fn of_volume(volume: &Volume) -> Result<Window> {
    alone(volume, |_, _| 1.0)
}

/// A window of a volume without centerlines for pictures in which tissue is looked at too, such as slices: the lumen stays at 60 to
/// 72 % of the range, and black lies as far below it as [`along`] vessels, so that a sac, its thrombus and fat are no black holes.
/// [`of_volume`] leaves more of them black, as pictures that look through the body must.
///
/// # Errors
/// [`ErrorKind::Volume`] for values beyond all windows.
pub(crate) fn of_slices(volume: &Volume) -> Result<Window> {
    let mut looked = Looked::at(volume);
    let Some(found) = Populations::of(&mut looked) else {
        return Ok(OF_NOTHING);
    };
    let lumen = found.lumen;
    let tissue = cut_off_tissue(&mut looked, lumen).unwrap_or_else(|| {
        let darkest = darkest_tissue(&mut looked, lumen - BELOW_LUMEN[1] * (lumen - found.tissue));
        Tissue { middle: found.tissue, darkest }
    });
    let [black, white] = around_lumen(lumen, tissue, 0.0, [found.darkest, found.peak]);
    within(f64::midpoint(black, white), white - black, || from_to(found.darkest, found.brightest))
}

/// The tissue of a volume whose dark values were cut off: most of what is no padding is nearer to it than to the lumen, and much of
/// it would pass for air. None of other volumes.
fn cut_off_tissue(looked: &mut Looked, lumen: f64) -> Option<Tissue> {
    let padding = padding(&mut looked.voxels)?;
    let middle = median(&mut without_padding(&mut looked.voxels).to_vec())?;
    (middle - padding < lumen - middle).then_some(Tissue { middle, darkest: Some(padding) })
}

/// The window [`along`] centerlines, made wider where their brightest vessels would be white in it.
///
/// # Errors
/// [`ErrorKind::Volume`] for values beyond all windows.
pub(crate) fn holding_lumen(volume: &Volume, tree: &VesselTree) -> Result<Window> {
    let window = along(volume, tree)?;
    let black = window.level - window.width / 2.0;
    let needed = brightest_lumen(volume, tree).map_or(0.0, |lumen| (lumen - black) / HELD[0]);
    let width = window.width.max(needed);
    Ok(Window { level: black + width / 2.0, width })
}

/// Whether the brightest vessels of a tree are not white in a window; true where there are none.
pub(crate) fn holds_lumen(window: Window, volume: &Volume, tree: &VesselTree) -> bool {
    let share = |lumen: f64| (lumen - window.level) / window.width + 0.5;
    brightest_lumen(volume, tree).is_none_or(|lumen| share(lumen) <= HELD[1])
}

/// What stands for the lumen of the brightest vessels of a tree.
fn brightest_lumen(volume: &Volume, tree: &VesselTree) -> Option<f64> {
    let points: Vec<DVec3> = tree.vessels().iter().flat_map(|vessel| vessel.points()).copied().collect();
    quantile(&mut finite(&sample(volume, &points)), BRIGHT_LUMEN)
}

/// The window of [`of_volume`] for a MIP: its white end lies where the brightest voxels are (99.9th percentile), where
/// that makes it at most 1.4 times as wide.
///
/// A MIP shows a lumen farther above its tissue than blended contexts do, as noise makes the largest value along a ray
/// larger; so it has range to spare for what is brighter than the lumen.
///
/// # Errors
/// [`ErrorKind::Volume`] for values beyond all windows.
pub(crate) fn of_mip(volume: &Volume) -> Result<Window> {
    alone(volume, |found, [black, width]| ((found.peak - black) / width).clamp(1.0, MIP_WIDEST))
}

/// A window of a volume alone that is widened by the factor `wider`, from its populations, black and width.
fn alone(volume: &Volume, wider: impl Fn(&Populations, [f64; 2]) -> f64) -> Result<Window> {
    let Some(found) = Populations::of(&mut Looked::at(volume)) else {
        return Ok(OF_NOTHING);
    };
    let above =
        [found.brightest_tissue, found.tissue.min(found.brightest_tissue)].map(|tissue| found.lumen - tissue);
    let least = ALONE_NARROWEST * (found.brightest - found.darkest);
    let width = (above[0] / ALONE_BELOW[0]).max(above[1] / ALONE_BELOW[1]).max(least);
    // Nothing is darker than the smallest value: a window that began below would show it grey.
    let black = (found.lumen - ALONE_LUMEN_AT * width).max(found.smallest);
    let width = (found.lumen - black) / ALONE_LUMEN_AT;
    let width = width * wider(&found, [black, width]);
    within(black + width / 2.0, width, || from_to(found.darkest, found.brightest))
}

/// A window that shows air to lumen: from the 1st percentile of the volume to the 99th of all that is no padding.
///
/// # Errors
/// [`ErrorKind::Volume`] for values beyond all windows.
pub fn whole(volume: &Volume) -> Result<Window> {
    without_unit(volume, BRIGHT)
}

/// A window that shows all tissues of an MR angiography, whose values have no unit: as [`whole`], but up to the 99.9th
/// percentile, so that the vessels are not the same white.
///
/// # Errors
/// [`ErrorKind::Volume`] for values beyond all windows.
pub(crate) fn mra(volume: &Volume) -> Result<Window> {
    without_unit(volume, BRIGHTEST)
}

/// A window from the smallest of all voxels to the largest.
///
/// # Errors
/// [`ErrorKind::Volume`] for values beyond all windows.
pub fn full(volume: &Volume) -> Result<Window> {
    let [black, white] = range(volume);
    if black > white {
        return Ok(OF_NOTHING);
    }
    within(black + (white - black) / 2.0, white - black, || from_to(black, white))
}

/// From the 1st percentile to this part of all that is no padding.
fn without_unit(volume: &Volume, bright: f64) -> Result<Window> {
    let mut voxels = Looked::at(volume).voxels;
    let Some(black) = quantile(&mut voxels, DARKEST) else {
        return Ok(OF_NOTHING);
    };
    let white = quantile(without_padding(&mut voxels), bright).unwrap_or(black);
    within((black + white) / 2.0, white - black, || from_to(black, white))
}

fn from_to(low: f64, high: f64) -> String {
    format!("values from {} to {}", rounded(low, 3), rounded(high, 3))
}

/// The window, never of no width; where there is no such window an error that says what was found.
fn within(level: f64, width: f64, found: impl Fn() -> String) -> Result<Window> {
    let width = width.max(1e-3 * level.abs()).max(1e-6);
    if level.abs() <= LARGEST && width <= LARGEST {
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
