//! The expected wall level of a volume, and where it comes from.

pub(crate) mod pool;
pub mod tree;

use self::tree::PooledWall;
use crate::kind::AIR;
use crate::measure::estimation::Level;
use crate::measure::model::wall::KnownWall;
use crate::measure::section::scale::Scale;
use crate::voxels::Voxels;
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::limits::Limits;

/// Intensity of walls in CT (HU) and its standard deviation: soft tissue, in arteries with and without plaque.
pub const CT_WALL: Level = [45.0, 25.0];

/// Intensity of plaque that takes up contrast medium or contains fine calcium (HU), and its standard deviation.
pub const BRIGHT_WALL: Level = [150.0, 40.0];

/// A volume may be in HU if its lumen is above `LUMEN` and its surroundings, from air to bone, are within `AROUND`.
const LUMEN: f64 = 80.0;
const AROUND: [f64; 2] = [-1100.0, 400.0];

/// Darker surroundings (HU) are lung; fat is above -150.
pub(crate) const LUNG: f64 = -300.0;

/// A wall is darker than its lumen by at least this fraction of the contrast.
const BELOW_LUMEN: f64 = 0.1;

const DEVIATION: Limits =
    Limits::new(0.1, 1000.0, "(the standard deviation of the wall's level, in the volume's unit)");
const LEVEL: Limits = Limits::new(-2000.0, 1e5, "(the wall's level, in the volume's unit)");

/// How the caller chooses the intensity level of the wall.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum WallRequest {
    /// [`CT_WALL`] in CT; no wall in other volumes.
    #[default]
    Automatic,
    /// Walls are not modelled.
    Off,
    /// This intensity level and standard deviation, in the volume's unit.
    Level(Level),
}

impl WallRequest {
    /// Checks the choice. Errors: [`ErrorKind::Settings`] for an invalid level or standard deviation.
    pub fn check(&self) -> Result<()> {
        let Self::Level([level, deviation]) = self else { return Ok(()) };
        LEVEL.check("wall", *level)?;
        DEVIATION.check("wall", *deviation)
    }
}

/// Whether walls were modelled, and where their level comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WallSource {
    /// The level in CT, because the volume is in HU.
    Hounsfield,
    /// The caller gave this level.
    Given(Level),
    /// The level expected after including other vessels of the tree.
    Pooled {
        /// The level that the caller gave, if any.
        given: Option<Level>,
        /// The level estimated from the other vessels.
        by_others: PooledWall,
    },
    /// [`BRIGHT_WALL`], because the sections show such a wall.
    Bright,
    /// [`CT_WALL`] or [`BRIGHT_WALL`]: diameters are the mean of both, as the sections do not show which it is.
    PerhapsBright,
    /// No walls: the caller turned them off.
    NotAsked,
    /// No walls: the lumen is darker than its surroundings.
    DarkLumen,
    /// No walls: nothing shows that the volume is in HU.
    OtherUnit,
    /// No walls: the surroundings are as bright as walls.
    AsBright,
}

impl WallSource {
    /// The expected level in the volume's unit; None if no walls are modelled.
    pub fn expected(&self) -> Option<Level> {
        match self {
            Self::Hounsfield => Some(CT_WALL),
            Self::Given(level) => Some(*level),
            _ => None,
        }
    }

    #[must_use]
    pub(crate) fn pooled(self, by_others: PooledWall) -> Self {
        let given = if let Self::Given(level) = self { Some(level) } else { None };
        Self::Pooled { given, by_others }
    }
}

/// Whether a wall level from other vessels is plausible for this vessel: clearly darker than the lumen.
pub(crate) fn is_below_lumen(wall: &PooledWall, scale: &Scale) -> bool {
    scale.share(wall.level[0]) <= 1.0 - BELOW_LUMEN
}

pub(crate) fn expected(
    voxels: &Voxels,
    scale: &Scale,
    request: WallRequest,
) -> Result<(Option<KnownWall>, WallSource)> {
    match request {
        WallRequest::Off => Ok((None, WallSource::NotAsked)),
        WallRequest::Level(level) => {
            let wall = in_its_place(voxels, scale, KnownWall::of(level, scale));
            let wall = KnownWall { is_airway: is_airway(voxels, scale), ..wall };
            if wall.level[0] <= 1.0 - BELOW_LUMEN {
                return Ok((Some(wall), WallSource::Given(level)));
            }
            let found = format!("{} in a lumen of {:.0}", level[0], scale.value(1.0));
            let expected = if scale.contrast < 0.0 {
                "a level above that of the dark lumen"
            } else {
                "a level below that of the lumen"
            };
            Err(Error::new(ErrorKind::Settings, "wall", found, expected))
        }
        WallRequest::Automatic if is_hounsfield(voxels, scale) => {
            Ok((Some(in_its_place(voxels, scale, KnownWall::of(CT_WALL, scale))), WallSource::Hounsfield))
        }
        WallRequest::Automatic if is_airway(voxels, scale) => {
            let wall = KnownWall { is_airway: true, ..KnownWall::of(CT_WALL, scale) };
            Ok((Some(wall), WallSource::Hounsfield))
        }
        WallRequest::Automatic if scale.contrast < 0.0 => Ok((None, WallSource::DarkLumen)),
        WallRequest::Automatic => Ok((None, WallSource::OtherUnit)),
    }
}

fn in_its_place(voxels: &Voxels, scale: &Scale, wall: KnownWall) -> KnownWall {
    KnownWall { is_in_lung: scale.outside < LUNG && is_hounsfield(voxels, scale), ..wall }
}

/// Whether a lumen is that of an airway in CT: air that is darker than its surroundings.
pub(crate) fn is_airway(voxels: &Voxels, scale: &Scale) -> bool {
    scale.contrast < 0.0 && AIR.contains(&scale.value(1.0)) && voxels.has_negative()
}

/// Whether a volume is in HU: it has negative values, and its lumen and surroundings have levels typical of CT.
pub(crate) fn is_hounsfield(voxels: &Voxels, scale: &Scale) -> bool {
    let around = (AROUND[0]..=AROUND[1]).contains(&scale.outside);
    around
        && scale.value(1.0) > LUMEN
        && (scale.outside < LUNG || scale.share(CT_WALL[0]) <= 1.0 - BELOW_LUMEN)
        && voxels.has_negative()
}
