//! A box hierarchy over segments, to find those near a point.

use glam::DVec3;

const FAN: usize = 8;

#[derive(Clone, Copy, Debug)]
struct Bounds {
    low: DVec3,
    high: DVec3,
}

impl Bounds {
    fn around(&self, other: &Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    fn squared_distance(&self, point: DVec3) -> f64 {
        (point - point.clamp(self.low, self.high)).length_squared()
    }
}

#[derive(Clone, Debug)]
pub(super) struct Segments {
    ends: Vec<[DVec3; 2]>,
    /// Boxes around the segments, then around those boxes, up to the one around all.
    levels: Vec<Vec<Bounds>>,
}

impl Segments {
    pub(super) fn new(ends: Vec<[DVec3; 2]>) -> Self {
        let around = |boxes: &[Bounds]| boxes.iter().skip(1).fold(boxes[0], |all, one| all.around(one));
        let single: Vec<_> = ends.iter().map(|[a, b]| Bounds { low: a.min(*b), high: a.max(*b) }).collect();
        let mut levels: Vec<Vec<Bounds>> = vec![single.chunks(FAN).map(around).collect()];
        while levels[levels.len() - 1].len() > 1 {
            levels.push(levels[levels.len() - 1].chunks(FAN).map(around).collect());
        }
        Self { ends, levels }
    }

    /// Squared distance (mm²) between a segment and a point; the same if two segments share the nearest end.
    pub(super) fn squared_distance(&self, segment: usize, point: DVec3) -> f64 {
        let [start, end] = self.ends[segment];
        let along = end - start;
        let share = (point - start).dot(along) / along.length_squared();
        let nearest = match share {
            share if share >= 1.0 => end,
            share if share > 0.0 => start + along * share,
            _ => start,
        };
        point.distance_squared(nearest)
    }

    /// The nearest segment within `limit` (mm), or the first of equally near ones, with its squared distance.
    pub(super) fn nearest(&self, point: DVec3, limit: f64) -> Option<(usize, f64)> {
        let mut best = (usize::MAX, limit * limit);
        self.visit(
            point,
            &mut |segment, reach: &mut f64| {
                let squared = self.squared_distance(segment, point);
                if squared < best.1 || (squared == best.1 && segment < best.0) {
                    best = (segment, squared);
                    *reach = squared;
                }
            },
            limit * limit,
        );
        (best.0 != usize::MAX).then_some(best)
    }

    pub(super) fn within(&self, point: DVec3, limit: f64) -> Vec<usize> {
        let mut found = Vec::new();
        self.visit(
            point,
            &mut |segment, reach: &mut f64| {
                if self.squared_distance(segment, point) <= *reach {
                    found.push(segment);
                }
            },
            limit * limit,
        );
        found
    }

    pub(super) fn any_within(&self, point: DVec3, limit: f64) -> bool {
        let mut is_any = false;
        self.visit(
            point,
            &mut |segment, reach: &mut f64| {
                if self.squared_distance(segment, point) < *reach {
                    is_any = true;
                    *reach = -1.0;
                }
            },
            limit * limit,
        );
        is_any
    }

    /// Visits the segments, in order, in boxes within the squared distance, which `meet` may reduce.
    fn visit(&self, point: DVec3, meet: &mut impl FnMut(usize, &mut f64), mut squared: f64) {
        let mut waiting = vec![(self.levels.len() - 1, 0)];
        while let Some((level, n)) = waiting.pop() {
            if self.levels[level][n].squared_distance(point) > squared {
                continue;
            }
            let below = if level == 0 { self.ends.len() } else { self.levels[level - 1].len() };
            let inner = n * FAN..below.min((n + 1) * FAN);
            match level {
                0 => inner.for_each(|segment| meet(segment, &mut squared)),
                _ => waiting.extend(inner.rev().map(|n| (level - 1, n))),
            }
        }
    }
}
