//! Windows taken from the data: which intensities (in the volume's unit, HU for CT) tell lumen from its surroundings.

use glam::DVec3;
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::math::sampling::Grid;
use lumencut_core::settings::Window;
use lumencut_core::vessel_tree::VesselTree;
use lumencut_core::volume::Volume;
use lumencut_core::with_voxels;

use crate::statistics::{deviation, median, quantile};
use crate::text::rounded;

/// How far beyond the wall a window's tissue is looked for, and the radius where it is unknown (mm).
const BESIDE: f64 = 10.0;
const UNKNOWN_RADIUS: f64 = 10.0;

/// The largest level and width that a window can have.
const LARGEST: f64 = 1e12;

/// How many voxels are looked at where there is no tree.
const MOST_VOXELS: f64 = 1e6;

/// Which parts of the voxels lie below air and below lumen; how far from the one to the other tissue begins.
const AIR: f64 = 0.01;
const LUMEN: f64 = 0.99;
const TISSUE: f64 = 0.25;

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

/// A window that shows lumen as middle grey, tissue darker, calcifications and stents brighter.
///
/// The median along the centerlines stands for the lumen, the median 10 mm beyond the vessels' walls for the tissue
/// around it; the window is centred on the lumen, three times as wide as their difference, and no narrower than four
/// standard deviations of the lumen.
///
/// # Errors
/// [`ErrorKind::Volume`] for values beyond all windows.
pub fn along(volume: &Volume, tree: &VesselTree) -> Result<Window> {
    let points: Vec<DVec3> = tree.vessels().iter().flat_map(|vessel| vessel.points()).copied().collect();
    let mut lumen = finite(&sample(volume, &points));
    let mut around = finite(&sample(volume, &beside(tree)));
    let spread = deviation(&lumen);
    let (Some(level), Some(beyond)) = (median(&mut lumen), median(&mut around)) else {
        return Ok(OF_NOTHING);
    };
    let width = (3.0 * (level - beyond).abs()).max(4.0 * spread);
    within(level, width, || {
        format!("values around {} along the centerlines, {} beside", rounded(level, 3), rounded(beyond, 3))
    })
}

/// Six points around each point of the tree, beyond the wall (mm, LPS).
fn beside(tree: &VesselTree) -> Vec<DVec3> {
    let sides = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
    let of_vessel = tree.vessels().iter().flat_map(|vessel| {
        vessel.points().iter().enumerate().flat_map(move |(i, point)| {
            let radius = vessel.radius().map_or(UNKNOWN_RADIUS, |radii| radii[i]);
            sides.map(|side| *point + (radius + BESIDE) * side)
        })
    });
    of_vessel.collect()
}

/// A window that shows lumen as middle grey where there are no centerlines.
///
/// The 99th percentile of the volume stands for the lumen, and for the tissue the median of the voxels above a quarter
/// of the way to it from the 1st percentile; of at most about a million voxels, evenly spread.
///
/// # Errors
/// [`ErrorKind::Volume`] for values beyond all windows.
pub fn of_volume(volume: &Volume) -> Result<Window> {
    let mut values = spread_voxels(volume);
    let (Some(air), Some(lumen)) = (quantile(&mut values, AIR), quantile(&mut values, LUMEN)) else {
        return Ok(OF_NOTHING);
    };
    let threshold = air + TISSUE * (lumen - air);
    let mut brighter: Vec<f64> = values.into_iter().filter(|value| *value > threshold).collect();
    let tissue = median(&mut brighter).unwrap_or(air);
    within(lumen, 3.0 * (lumen - tissue).abs(), || from_to(air, lumen))
}

/// A window that shows air to lumen: from the 1st percentile of the volume to the 99th.
///
/// # Errors
/// [`ErrorKind::Volume`] for values beyond all windows.
pub fn whole(volume: &Volume) -> Result<Window> {
    let mut values = spread_voxels(volume);
    let (Some(black), Some(white)) = (quantile(&mut values, AIR), quantile(&mut values, LUMEN)) else {
        return Ok(OF_NOTHING);
    };
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
    Err(error.mend("scale the voxels, or give window= and context_window= where they stand for nothing"))
}

/// About as many finite voxels as are looked at, evenly spread.
// Of the ten types of voxels some fit into f64 as they are, others only by a cast.
#[allow(clippy::cast_lossless, clippy::unnecessary_cast)]
fn spread_voxels(volume: &Volume) -> Vec<f64> {
    let (size, strides) = (volume.size(), volume.strides());
    let count = size.iter().product::<usize>() as f64;
    let step = ((count / MOST_VOXELS).powf(1.0 / 3.0).ceil() as usize).max(1);
    let along = |axis: usize| (0..size[axis]).step_by(step).map(move |n| n * strides[axis]);
    let mut values = Vec::new();
    with_voxels!(volume.voxels(), voxels => {
        for k in along(2) {
            for j in along(1) {
                values.extend(along(0).map(|i| voxels[i + j + k] as f64).filter(|value| value.is_finite()));
            }
        }
    });
    values
}

fn finite(values: &[f32]) -> Vec<f64> {
    values.iter().map(|value| f64::from(*value)).filter(|value| value.is_finite()).collect()
}

#[cfg(test)]
#[path = "tests/windows.rs"]
mod tests;
