//! Where what surrounds a vessel belongs to another part of it.

use glam::DVec3;

use crate::math::centerline_path::CenterlinePath;

/// A place belongs to another part of the vessel where that is nearer by more than this share: the bent vessel is cut a little
/// obliquely where its depth changes, which moves the nearest point.
const NEARER: f64 = 0.05;

/// How many segments are looked at together.
const TOGETHER: usize = 16;

/// The segments of a vessel, in groups with a ball around each.
pub(super) struct Folds<'a> {
    path: &'a CenterlinePath,
    balls: Vec<(DVec3, f64)>,
}

impl<'a> Folds<'a> {
    pub fn new(path: &'a CenterlinePath) -> Self {
        let ball = |points: &[DVec3]| {
            let center = points.iter().sum::<DVec3>() / points.len() as f64;
            (center, points.iter().map(|point| point.distance(center)).fold(0.0, f64::max))
        };
        let last = path.points().len() - 1;
        let groups = (0..last).step_by(TOGETHER).map(|first| first..=(first + TOGETHER).min(last));
        let balls = groups.map(|group| ball(&path.points()[group])).collect();
        Self { path, balls }
    }

    /// Whether a point that is shown beside the vessel at an arc length (mm) is nearer to another part of it.
    pub fn is_folded(&self, point: DVec3, at: f64) -> bool {
        let own = point.distance(self.path.at(at)) * (1.0 - NEARER);
        self.balls.iter().enumerate().any(|(n, (center, radius))| {
            point.distance(*center) < own + radius && self.group_is_nearer(n, point, own)
        })
    }

    fn group_is_nearer(&self, group: usize, point: DVec3, than: f64) -> bool {
        let first = group * TOGETHER;
        let last = (first + TOGETHER).min(self.path.points().len() - 1);
        self.path.points()[first..=last].windows(2).any(|ends| {
            let along = ends[1] - ends[0];
            let share = ((point - ends[0]).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            point.distance_squared(ends[0] + along * share) < than * than
        })
    }
}
