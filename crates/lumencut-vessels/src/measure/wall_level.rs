//! The level that walls are expected to have in a volume, and where that is from.

use super::pooled::Level;
use super::scale::Scale;
use super::tree_walls::PooledWall;
use super::wall::KnownWall;
use crate::voxels::Voxels;
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::limits::Limits;

/// The level of a wall in CT (HU) and its standard deviation: that of soft tissue, in arteries with and without plaque.
pub const CT_WALL: Level = [45.0, 25.0];

/// In HU contrast medium lies above the first of these, and what surrounds a vessel between the other two.
const LUMEN: f64 = 80.0;
const AROUND: [f64; 2] = [-400.0, 400.0];

/// A wall lies this share of the contrast below its lumen, at least.
const BELOW_LUMEN: f64 = 0.1;

const DEVIATION: Limits =
    Limits::new(0.1, 1000.0, "(the standard deviation of the wall's level, in the volume's unit)");
const LEVEL: Limits = Limits::new(-2000.0, 1e5, "(the wall's level, in the volume's unit)");

/// What a caller says of walls.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum WallRequest {
    /// In CT a wall of [`CT_WALL`], elsewhere none.
    #[default]
    Automatic,
    /// None is told apart from what surrounds the vessel.
    Off,
    /// A level and its standard deviation, in the volume's unit.
    Level(Level),
}

impl WallRequest {
    /// Checks what a caller says.
    ///
    /// # Errors
    /// [`ErrorKind::Settings`] for a level or a standard deviation that is invalid.
    pub fn check(&self) -> Result<()> {
        let Self::Level([level, deviation]) = self else { return Ok(()) };
        LEVEL.check("wall", *level)?;
        DEVIATION.check("wall", *deviation)
    }
}

/// Whether walls were told apart, and by which level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WallSource {
    /// The volume is in HU.
    Hounsfield,
    /// The caller gave it.
    Given(Level),
    /// Other vessels of the tree told more of what is expected in HU, or of what the caller gave.
    Pooled {
        /// What the caller gave, if anything.
        given: Option<Level>,
        /// What the others let expect instead.
        by_others: PooledWall,
    },
    /// The caller asked for none.
    NotAsked,
    /// The lumen is darker than what is around it.
    DarkLumen,
    /// Nothing says that the volume is in HU.
    OtherUnit,
    /// What surrounds the vessel is as bright as walls are.
    AsBright,
}

impl WallSource {
    /// The level that is expected beforehand, in the volume's unit, where walls are told apart.
    pub fn expected(&self) -> Option<Level> {
        match self {
            Self::Hounsfield => Some(CT_WALL),
            Self::Given(level) => Some(*level),
            _ => None,
        }
    }

    /// The same where other vessels of the tree told more.
    #[must_use]
    pub fn pooled(self, by_others: PooledWall) -> Self {
        let given = if let Self::Given(level) = self { Some(level) } else { None };
        Self::Pooled { given, by_others }
    }
}

/// Whether a level that others told can be that of a wall in a lumen of this scale.
pub fn is_below_lumen(wall: &PooledWall, scale: &Scale) -> bool {
    scale.share(wall.level[0]) <= 1.0 - BELOW_LUMEN
}

/// The wall of a vessel that is expected, and where that is from.
///
/// # Errors
/// [`ErrorKind::Settings`] for a level that is as bright as the lumen.
pub fn expected(
    voxels: &Voxels,
    scale: &Scale,
    request: WallRequest,
) -> Result<(Option<KnownWall>, WallSource)> {
    match request {
        WallRequest::Off => Ok((None, WallSource::NotAsked)),
        _ if scale.contrast < 0.0 => Ok((None, WallSource::DarkLumen)),
        WallRequest::Level(level) => {
            let wall = KnownWall::of(level, scale);
            if wall.level[0] <= 1.0 - BELOW_LUMEN {
                return Ok((Some(wall), WallSource::Given(level)));
            }
            let found = format!("{} in a lumen of {:.0}", level[0], scale.value(1.0));
            let expected = "a level below that of the lumen";
            Err(Error::new(ErrorKind::Settings, "wall", found, expected))
        }
        WallRequest::Automatic if is_hounsfield(voxels, scale) => {
            Ok((Some(KnownWall::of(CT_WALL, scale)), WallSource::Hounsfield))
        }
        WallRequest::Automatic => Ok((None, WallSource::OtherUnit)),
    }
}

/// Whether the values of a volume are those of HU: only there is anything negative, and contrast medium and tissue are where they
/// are in CT.
fn is_hounsfield(voxels: &Voxels, scale: &Scale) -> bool {
    let around = (AROUND[0]..=AROUND[1]).contains(&scale.outside);
    around
        && scale.value(1.0) > LUMEN
        && scale.share(CT_WALL[0]) <= 1.0 - BELOW_LUMEN
        && voxels.has_negative()
}
