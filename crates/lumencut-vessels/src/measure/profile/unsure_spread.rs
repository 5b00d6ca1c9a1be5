//! What an assumed point spread leaves unsure: wall and lumen level depend on it too, so the vessel is measured again.

use super::prepared::PreparedVessel;
use super::{PointSpread, Source};
use crate::measure::along::point_spread::MIN_WIDTH;
use crate::measure::fit::Fit;
use crate::measure::fit::sections::{LIMIT, Section};
use crate::measure::section::flags::AT_LIMIT;
use crate::voxels::Voxels;
use lumencut_core::error::{ErrorKind, Result};
use lumencut_core::math::statistics::median;
use lumencut_core::stop::Stop;

/// A narrow lumen is hardly resolved if an assumed point spread leaves more than this fraction of it unsure.
const UNSURE: f64 = 0.07;

/// A diameter that changes by more than this factor is that of another lumen.
const SAME_LUMEN: f64 = 2.0;

impl PreparedVessel {
    /// Includes the change if the assumed point spread is one standard deviation off, also in the flag of the limit.
    pub(super) fn include_other_spreads(
        &self,
        voxels: &Voxels,
        sections: &mut [Section],
        spread: &PointSpread,
        stop: Stop,
    ) -> Result<()> {
        let diameters = sections.iter().filter_map(|section| section.fit.as_ref().map(diameter));
        let middle = median(&mut diameters.collect::<Vec<f64>>()).unwrap_or(f64::INFINITY);
        // Walls depend on the point spread in vessels of any width, the level of the lumen only in narrow ones.
        let is_narrow = middle < MIN_WIDTH * spread.fwhm;
        if !matches!(spread.source, Source::Assumed { .. }) || self.wall.is_none() && !is_narrow {
            return Ok(());
        }
        let limit = LIMIT * (spread.fwhm + spread.deviation);
        for section in sections.iter_mut() {
            if section.fit.as_ref().is_some_and(|fit| diameter(fit) < limit) {
                section.flags |= AT_LIMIT;
            }
        }
        let signs: &[f64] = if is_narrow { &[-1.0, 1.0] } else { &[1.0] };
        let mut changes = vec![Vec::new(); sections.len()];
        for &sign in signs {
            let other = match self.read(voxels, [spread.fwhm + sign * spread.deviation, 0.0], None, stop) {
                Ok(other) => other,
                Err(error) if error.kind == ErrorKind::Interrupted => return Err(error),
                Err(_) => continue,
            };
            for ((section, other), changes) in sections.iter().zip(&other.sections).zip(&mut changes) {
                let (Some(fit), Some(other)) = (&section.fit, &other.fit) else { continue };
                let [before, after] = [fit, other].map(diameter);
                if is_same_lumen(before, after) {
                    changes.push(sign * (after - before));
                }
            }
        }
        for (section, changes) in sections.iter_mut().zip(changes) {
            let Some(fit) = &mut section.fit else { continue };
            let greater = |a: f64, b: f64| if b.abs() > a.abs() { b } else { a };
            fit.parts.point_spread = changes.into_iter().fold(fit.parts.point_spread, greater);
            fit.uncertainty = fit.parts.total();
            let diameter = diameter(fit);
            if diameter < MIN_WIDTH * spread.fwhm && fit.parts.point_spread.abs() > UNSURE * diameter {
                section.flags |= AT_LIMIT;
            }
        }
        Ok(())
    }
}

pub(super) fn is_same_lumen(before: f64, after: f64) -> bool {
    after < SAME_LUMEN * before && before < SAME_LUMEN * after
}

pub(super) fn diameter(fit: &Fit) -> f64 {
    fit.ellipse.equivalent_diameter()
}
