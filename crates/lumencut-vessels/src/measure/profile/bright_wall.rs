//! A wall that looks far brighter than walls are: plaque nearly as bright as the lumen on all of its length. What it hides
//! depends on its level, so the vessel is measured again with the level that its own sections show.

use super::PointSpread;
use super::prepared::PreparedVessel;
use super::unsure_spread::is_same_lumen;
use crate::measure::estimation::Level;
use crate::measure::fit::sections::Section;
use crate::measure::section::flags::PLAQUE;
use crate::measure::wall::tree::PooledWall;
use crate::voxels::Voxels;
use lumencut_core::error::{ErrorKind, Result};
use lumencut_core::stop::Stop;

/// A wall is too bright if its level less its standard deviation exceeds what is expected by this many of the expectation's.
const TOO_BRIGHT: f64 = 2.0;

/// Plaque of a part of the vessel only is found section by section: the level alone must exceed this at both ends.
const BRIGHT_AT_ENDS: f64 = 1.0;

/// The ends of a vessel, as fractions of its sections.
const ENDS: [[f64; 2]; 2] = [[0.0, 1.0 / 3.0], [2.0 / 3.0, 1.0]];

impl PreparedVessel {
    /// Flags the sections of a vessel with such a wall, and includes the change by its level in the uncertainty.
    pub(super) fn include_bright_wall(
        &self,
        voxels: &Voxels,
        sections: &mut [Section],
        spread: &PointSpread,
        stop: Stop,
    ) -> Result<()> {
        let Some(level) = self.bright_wall(voxels, spread.fwhm, stop)? else { return Ok(()) };
        let shown = Some(PooledWall { level, vessels: 0 });
        let other = match self.read(voxels, [spread.fwhm, spread.deviation], shown, stop) {
            Ok(other) => other.sections,
            Err(error) if error.kind == ErrorKind::Interrupted => return Err(error),
            Err(_) => Vec::new(),
        };
        for (n, section) in sections.iter_mut().enumerate() {
            let Some(fit) = &mut section.fit else { continue };
            section.flags |= PLAQUE;
            let before = fit.ellipse.equivalent_diameter();
            let after = other.get(n).and_then(|section| section.fit.as_ref());
            let Some(after) = after.map(|fit| fit.ellipse.equivalent_diameter()) else { continue };
            if is_same_lumen(before, after) {
                fit.parts.wall = fit.parts.wall.hypot(after - before);
                fit.uncertainty = fit.parts.total();
            }
        }
        Ok(())
    }

    /// Level of the wall (that of the volume) if it is too bright all along.
    fn bright_wall(&self, voxels: &Voxels, fwhm: f64, stop: Stop) -> Result<Option<Level>> {
        let expected = self.wall_source.expected().filter(|_| self.wall.is_some_and(|wall| !wall.is_in_lung));
        let Some([expected, unsure]) = expected else { return Ok(None) };
        let least = |deviations: f64| expected + deviations * unsure;
        let level = self.wall_level(voxels, fwhm, stop)?;
        if level.is_none_or(|[level, deviation]| level - deviation < least(TOO_BRIGHT)) {
            return Ok(None);
        }
        for part in ENDS {
            let there = self.wall_level_within(part, voxels, fwhm, stop)?;
            if there.is_none_or(|[level, _]| level < least(BRIGHT_AT_ENDS)) {
                return Ok(None);
            }
        }
        Ok(level)
    }
}
