//! Walls that look far brighter than walls are: plaque nearly as bright as the lumen. The fit takes half of it for lumen, and a
//! point spread estimated on such a wall is too wide. So the vessel is measured again with the level of plaque.

use super::lung::{better, include};
use super::measuring::own_spread;
use super::prepared::PreparedVessel;
use super::unsure_spread::{diameter, is_same_lumen};
use super::{PointSpread, Source};
use crate::measure::fit::Fit;
use crate::measure::fit::sections::Section;
use crate::measure::wall::tree::PooledWall;
use crate::measure::wall::{BRIGHT_WALL, CT_WALL, WallSource, is_below_lumen};
use crate::voxels::Voxels;
use lumencut_core::error::{ErrorKind, Result};
use lumencut_core::stop::Stop;

/// The second reading is shown, or refuted, if its squared residuals differ by this many standard errors.
const SHOWN: f64 = 2.0;

pub(super) enum BrightWall {
    Shown(Box<PreparedVessel>, PointSpread),
    Possible(Vec<Section>),
}

impl PreparedVessel {
    pub(super) fn bright_wall(
        &self,
        voxels: &Voxels,
        sections: &[Section],
        spread: &PointSpread,
        stop: Stop,
    ) -> Result<Option<BrightWall>> {
        if !self.looks_bright(voxels, spread.fwhm, stop)? {
            return Ok(None);
        }
        let bright = self.with_bright_wall();
        let spread = match spread.source {
            Source::Given => spread.clone(),
            _ => own_spread(&bright, voxels, stop)?,
        };
        let read = match bright.read(voxels, [spread.fwhm, spread.deviation], None, stop) {
            Ok(read) => read,
            Err(error) if error.kind == ErrorKind::Interrupted => return Err(error),
            Err(_) => return Ok(None),
        };
        let free = |one: &Section| one.fit.filter(|_| one.flags == 0);
        let pairs: Vec<Option<(Fit, Fit)>> =
            read.sections.iter().zip(sections).map(|(one, other)| free(one).zip(free(other))).collect();
        let better = better(&pairs, read.every);
        // A wide blur looks like a bright wall.
        let is_sure = !matches!(spread.source, Source::Assumed { .. });
        Ok(match better {
            better if better > SHOWN => Some(BrightWall::Shown(Box::new(bright), spread)),
            better if is_sure && better > -SHOWN => Some(BrightWall::Possible(read.sections)),
            _ => None,
        })
    }

    fn looks_bright(&self, voxels: &Voxels, fwhm: f64, stop: Stop) -> Result<bool> {
        let plaque = PooledWall { level: BRIGHT_WALL, vessels: 0 };
        let [expected, unsure] = match self.wall_source {
            WallSource::Hounsfield if is_below_lumen(&plaque, &self.scale) && !self.is_in_lung() => CT_WALL,
            _ => return Ok(false),
        };
        let level = self.wall_level(voxels, fwhm, stop)?;
        Ok(level.is_some_and(|[level, deviation]| level - deviation > expected + unsure))
    }
}

pub(super) fn include_bright(sections: &mut [Section], bright: &[Section]) {
    for (section, bright) in sections.iter_mut().zip(bright) {
        let (Some(own), Some(other)) = (&section.fit, &bright.fit) else { continue };
        if is_same_lumen(diameter(own), diameter(other)) {
            include(section, other);
        }
    }
}
