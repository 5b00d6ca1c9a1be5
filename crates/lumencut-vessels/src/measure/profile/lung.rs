//! Vessels in lung. A thin wall with a wide blur looks like a thicker wall with a narrow blur, or none. So such a vessel is
//! measured with and without a wall. If the voxels cannot tell which is true, the result includes both.

use super::PointSpread;
use super::Source;
use super::prepared::PreparedVessel;
use crate::measure::along::point_spread::SpreadEstimate;
use crate::measure::fit::Fit;
use crate::measure::fit::sections::Section;
use crate::measure::section::scale::Scale;
use crate::measure::wall::LUNG;
use crate::voxels::Voxels;
use lumencut_core::error::{ErrorKind, Result};
use lumencut_core::stop::Stop;

/// Sections in lung show the point spread from this width on (widths of the point spread), as their contrast is high.
const MIN_WIDTH: f64 = 1.5;

/// No wall is refuted if its squared residuals are greater by this many standard errors.
const REFUTED: f64 = 3.0;

/// Minimum standard deviation of the log thickness of a wall that may not exist; it is not reported.
const UNSEEN: f64 = 1.0;

impl PreparedVessel {
    pub(super) fn is_in_lung(&self) -> bool {
        self.wall.is_some_and(|wall| wall.is_in_lung)
    }

    /// FWHM (mm) if the wall is too thin to be seen; None outside the lung, and if the vessel does not show it.
    pub(super) fn spread_without_wall(&self, voxels: &Voxels, stop: Stop) -> Result<Option<f64>> {
        if !self.is_in_lung() {
            return Ok(None);
        }
        let found = self.bare().shown_spread(voxels, MIN_WIDTH, stop)?;
        Ok(if let SpreadEstimate::Width(edges) = found { Some(edges.fwhm) } else { None })
    }

    /// Includes in sections in lung that their wall may be too thin to be seen.
    pub(super) fn include_thin_walls(
        &self,
        voxels: &Voxels,
        sections: &mut [Section],
        spread: &PointSpread,
        stop: Stop,
    ) -> Result<()> {
        if !self.is_in_lung() {
            return Ok(());
        }
        let shown = match &spread.source {
            Source::Assumed { .. } => self.spread_without_wall(voxels, stop)?,
            _ => spread.without_wall,
        };
        let fwhm = shown.unwrap_or(spread.fwhm);
        let bare = match self.bare().read(voxels, [fwhm, spread.deviation], None, stop) {
            Ok(bare) => bare,
            Err(error) if error.kind == ErrorKind::Interrupted => return Err(error),
            Err(_) => return Ok(()),
        };
        let two = |n: usize| Some((sections[n].fit?, bare.sections[n].fit?));
        let pairs: Vec<Option<(Fit, Fit)>> =
            (0..sections.len()).map(|n| two(n).filter(|(fit, _)| is_in_lung(&self.scale, fit))).collect();
        if better(&pairs, bare.every) > REFUTED {
            return Ok(());
        }
        for (section, pair) in sections.iter_mut().zip(pairs) {
            if let Some((_, bare)) = pair {
                include(section, &bare);
            }
        }
        Ok(())
    }
}

fn is_in_lung(scale: &Scale, fit: &Fit) -> bool {
    scale.value(fit.background) < LUNG
}

/// How much better the first fits of sections are than the second ones, in standard errors; `every` sections share voxels.
pub(super) fn better(pairs: &[Option<(Fit, Fit)>], every: usize) -> f64 {
    let excess: Vec<f64> = pairs
        .iter()
        .flatten()
        .map(|(first, second)| second.missed.powi(2) - first.missed.powi(2))
        .filter(|excess| excess.is_finite())
        .collect();
    let count = excess.len() as f64;
    let mean = excess.iter().sum::<f64>() / count;
    let variance = excess.iter().map(|one| (one - mean).powi(2)).sum::<f64>() / count;
    let apart = (count / every as f64).max(1.0);
    mean / (variance / apart).sqrt()
}

/// Takes the mean of both diameters, and half of their difference into the uncertainty.
pub(super) fn include(section: &mut Section, other: &Fit) {
    let Some(fit) = &section.fit else { return };
    let [own, its] = [fit, other].map(|fit| fit.ellipse.equivalent_diameter());
    section.scale(f64::midpoint(own, its) / own);
    let Some(fit) = &mut section.fit else { return };
    let half = 0.5 * (its - own).abs();
    fit.parts.wall = fit.parts.wall.hypot(half);
    fit.parts.point_spread = fit.parts.point_spread.clamp(-half, half);
    fit.uncertainty = fit.parts.total();
    if let Some(wall) = &mut fit.wall {
        wall.log_thickness[1] = wall.log_thickness[1].max(UNSEEN);
    }
}
