//! Tests whether a section meets the lumen of another vessel.

use glam::DVec3;

use crate::measure::section::SectionPlane;
use lumencut_core::vessel_tree::Vessel;

/// Points at most this far apart (mm) count as the same point.
const SAME_PLACE: f64 = 1e-3;

/// Distance between sampled points of a centerline (mm).
const STEP: f64 = 0.5;

/// Whether a disc of `radius` mm around `center` meets the lumen of another vessel.
pub(crate) fn meets(place: &SectionPlane, center: DVec3, radius: f64, others: &[Lumen]) -> bool {
    others.iter().any(|other| other.meets(place, center, radius))
}

/// The lumen of another vessel: balls along its centerline, and one ball `around` them all.
#[derive(Clone, Debug)]
pub(crate) struct Lumen {
    balls: Vec<(DVec3, f64)>,
    around: (DVec3, f64),
}

impl Lumen {
    /// Lumens of all vessels of `tree` that are not part of `measured`.
    pub(crate) fn of_others(tree: &[Vessel], measured: &Vessel) -> Vec<Self> {
        tree.iter().filter(|vessel| !is_part(vessel, measured)).map(Self::new).collect()
    }

    fn new(vessel: &Vessel) -> Self {
        let points = vessel.points();
        let mut balls = vec![(points[0], vessel.radius_or_zero(0))];
        for n in 1..points.len() {
            let parts = (points[n].distance(points[n - 1]) / STEP).ceil().clamp(1.0, 1e4);
            let [from, to] = [n - 1, n].map(|i| vessel.radius_or_zero(i));
            for part in 1..=parts as usize {
                let share = part as f64 / parts;
                balls.push((points[n - 1].lerp(points[n], share), from + (to - from) * share));
            }
        }
        let middle = balls.iter().map(|(center, _)| *center).sum::<DVec3>() / balls.len() as f64;
        let reach = balls.iter().map(|(center, radius)| center.distance(middle) + radius).fold(0.0, f64::max);
        Self { balls, around: (middle, reach) }
    }

    fn meets(&self, place: &SectionPlane, center: DVec3, radius: f64) -> bool {
        if self.around.0.distance(center) > self.around.1 + radius {
            return false;
        }
        self.balls.iter().any(|(ball, wide)| {
            let [x, y, along] = place.coordinates(*ball - center);
            let beside = (x.hypot(y) - radius).max(0.0);
            along * along + beside * beside < wide * wide
                || (*wide == 0.0 && beside == 0.0 && along.abs() < STEP)
        })
    }
}

pub(crate) fn shares_line(one: &Vessel, other: &Vessel) -> bool {
    let is_there = |point: &&DVec3| other.points().iter().any(|there| there.distance(**point) < SAME_PLACE);
    one.points().iter().filter(is_there).nth(1).is_some()
}

fn is_part(vessel: &Vessel, whole: &Vessel) -> bool {
    let is_there = |point: &DVec3| whole.points().iter().any(|other| other.distance(*point) < SAME_PLACE);
    vessel.points().iter().all(is_there)
}
