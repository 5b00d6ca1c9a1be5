//! Finds the lumens under the pointer, each with the section across it.

use glam::DVec3;
use lumencut_vessels::trace::lumen::on_ray::lumens_on_ray;
use lumencut_vessels::trace::lumen::seen::{SeenLumen, lumen_at};
use serde::{Deserialize, Serialize};

use crate::study::document::WorldPoint;
use crate::study::failure::Result;
use crate::study::open_study::Study;

#[derive(Clone, Copy, Debug, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "PointedAt"))]
pub(crate) struct PointedMessage {
    /// The pointed place (LPS, mm).
    pub point: WorldPoint,
    /// Unit vector of the ray, away from the viewer; none if only the place counts.
    pub along: Option<WorldPoint>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct PointedLumen {
    /// The pointed place in the lumen; on a ray, the place nearest to the lumen's centre.
    pub point: WorldPoint,
    pub center: WorldPoint,
    /// Diameter of the lumen (mm).
    pub diameter: f64,
    /// The median value at the centre of the lumen.
    pub value: f64,
    /// Unit vector to the right in the section.
    pub right: WorldPoint,
    pub(crate) down: WorldPoint,
}

impl Study {
    pub(crate) fn lumens(&self, pointed: &PointedMessage) -> Result<Vec<PointedLumen>> {
        let volume = self.content.traced()?;
        let point = DVec3::from_array(pointed.point);
        let seen: Vec<(SeenLumen, DVec3)> = match pointed.along.map(DVec3::from_array) {
            Some(along) => {
                let met = lumens_on_ray(&volume, point, along);
                met.into_iter().map(|one| (one, one.on_ray(point, along))).collect()
            }
            None => lumen_at(&volume, point).map(|one| (one, point)).into_iter().collect(),
        };
        Ok(seen.into_iter().map(|(one, place)| with_section(&one, place)).collect())
    }
}

/// A lumen with its section, in which anterior is up, or the head if the lumen runs anteriorly.
fn with_section(seen: &SeenLumen, place: DVec3) -> PointedLumen {
    let upright = |to: DVec3| (-to).reject_from_normalized(seen.along);
    let (front, head) = (upright(DVec3::NEG_Y), upright(DVec3::Z));
    let down = if front.length() > 0.3 { front } else { head }.normalize();
    let right = down.cross(seen.along);
    PointedLumen {
        point: place.to_array(),
        center: seen.center.to_array(),
        diameter: 2.0 * seen.radius,
        value: seen.value,
        right: right.to_array(),
        down: down.to_array(),
    }
}
