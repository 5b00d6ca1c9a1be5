//! A wall that looks far brighter than walls are: plaque nearly as bright as the lumen on all of its length. What it hides
//! depends on its level, so the vessel is measured again with the level that its own sections show.

use super::PointSpread;
use super::prepared::PreparedVessel;
use super::unsure_spread::is_same_lumen;
use crate::measure::fit::sections::Section;
use crate::measure::section::flags::PLAQUE;
use crate::measure::wall::tree::PooledWall;
use crate::voxels::Voxels;
use lumencut_core::error::{ErrorKind, Result};
use lumencut_core::stop::Stop;

/// A wall is too bright if its level less its standard deviation exceeds what is expected by this many of the expectation's.
const TOO_BRIGHT: f64 = 2.0;

impl PreparedVessel {
    /// Flags the sections of a vessel with such a wall, and includes the change by its level in the uncertainty.
    pub(super) fn include_bright_wall(
        &self,
        voxels: &Voxels,
        sections: &mut [Section],
        spread: &PointSpread,
        stop: Stop,
    ) -> Result<()> {
        let Some([expected, unsure]) = self.wall_source.expected() else { return Ok(()) };
        let Some(level) = self.wall_level(voxels, spread.fwhm, stop)? else { return Ok(()) };
        if level[0] - level[1] < expected + TOO_BRIGHT * unsure {
            return Ok(());
        }
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
}
