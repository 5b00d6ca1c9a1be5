//! Replaces the radii of the vessels of a tree by measured ones.

use std::f64::consts::PI;

use rayon::prelude::*;

use super::Profile;
use super::measuring::TreeMeasuring;
use super::request::{MeasureRequest, with_progress};
use crate::measure::section::flags::LEFT_OUT;
use lumencut_core::error::{ErrorKind, Result};
use lumencut_core::math::same_place::REPEATED_POINT;
use lumencut_core::progress::Progress;
use lumencut_core::vessel_tree::Vessel;
use lumencut_core::volume::Volume;

/// Maximum gap (mm) between two sections across which radii are interpolated.
const GAP: f64 = 10.0;

/// Sections whose relative standard deviation is this or more are skipped.
const MAX_DEVIATION: f64 = 0.25;

/// The radii of one vessel.
#[derive(Clone, Debug, PartialEq)]
pub struct Radii {
    /// Radius of each point (mm); None if nothing was measured or known.
    pub radius: Option<Vec<f64>>,
    /// Number of points whose radius was measured, or interpolated between two measured sections.
    pub measured: usize,
    /// Number of points that kept their previous radius, or took the radius of the nearest measured section.
    pub kept: usize,
}

/// Measures all radii of a tree. A vessel that cannot be measured keeps its radii. Errors:
/// [`ErrorKind::Settings`] for an invalid step, wall or point spread, [`ErrorKind::Interrupted`].
pub fn measured_radii(
    volume: &Volume,
    request: &MeasureRequest,
    progress: Option<&Progress>,
) -> Result<Vec<Radii>> {
    if let Some(progress) = progress {
        progress.expect_views(1);
    }
    let MeasureRequest { step, tree, stop, .. } = *request;
    let measuring = TreeMeasuring::new(volume, request)?;
    with_progress(progress, (tree, step), stop, |stop| {
        let findings = measuring.findings(stop)?;
        let radii = |(n, vessel): (usize, &Vessel)| match measuring.profile(n, findings.clone(), stop) {
            Ok(profile) => Ok(of_profile(vessel, &profile)),
            Err(error) if matches!(error.kind, ErrorKind::Measuring | ErrorKind::VesselTree) => {
                let kept = vessel.points().len();
                Ok(Radii { radius: vessel.radius().map(<[f64]>::to_vec), measured: 0, kept })
            }
            Err(error) => Err(error),
        };
        tree.par_iter().enumerate().map(radii).collect()
    })
}

fn of_profile(vessel: &Vessel, profile: &Profile) -> Radii {
    let is_measured = |n: &usize| {
        let diameter = 2.0 * (profile.area[*n] / PI).sqrt();
        profile.flags[*n] & LEFT_OUT == 0 && profile.uncertainty[*n] < MAX_DEVIATION * diameter
    };
    let known: Vec<(f64, f64)> = (0..profile.len())
        .filter(is_measured)
        .map(|n| (profile.arc_length[n], (profile.area[n] / PI).sqrt()))
        .collect();
    let (mut measured, mut kept) = (0, 0);
    let mut radius = Vec::with_capacity(vessel.points().len());
    for (n, at) in vessel.arc_length().iter().enumerate() {
        let here = between(&known, *at);
        measured += usize::from(here.is_some());
        kept += usize::from(here.is_none());
        radius.push(
            here.or_else(|| vessel.radius().map(|radii| radii[n])).or_else(|| nearest_radius(&known, *at)),
        );
    }
    Radii { radius: radius.into_iter().collect(), measured, kept }
}

/// Radius interpolated between two sections; None if the sections are too far apart.
fn between(known: &[(f64, f64)], at: f64) -> Option<f64> {
    let after = known.partition_point(|(there, _)| *there < at);
    let next = known.get(after);
    if let Some((there, radius)) = next
        && *there - at <= REPEATED_POINT
    {
        return Some(*radius);
    }
    let (before, next) = (known.get(after.checked_sub(1)?)?, next?);
    let apart = next.0 - before.0;
    (apart <= GAP).then(|| before.1 + (next.1 - before.1) * (at - before.0) / apart)
}

fn nearest_radius(known: &[(f64, f64)], at: f64) -> Option<f64> {
    let away = |one: &&(f64, f64)| (one.0 - at).abs();
    known.iter().min_by(|a, b| away(a).total_cmp(&away(b))).map(|(_, radius)| *radius)
}

#[cfg(test)]
#[path = "tests/radii.rs"]
mod tests;
