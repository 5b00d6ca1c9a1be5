//! Arc length of the points of a polyline, and interpolation at an arc length.

use glam::DVec3;

/// Arc length from the first point to each point, in the unit of the points.
pub fn arc_lengths(points: &[DVec3]) -> Vec<f64> {
    let mut lengths = vec![0.0; points.len()];
    for i in 1..points.len() {
        lengths[i] = lengths[i - 1] + points[i].distance(points[i - 1]);
    }
    lengths
}

/// A position on a polyline: at `share` (0 to 1) of the segment from point `segment` to the next one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinePlace {
    /// Index of the point before the position.
    pub segment: usize,
    /// Share of the segment before the position.
    pub share: f64,
}

/// The segment at arc length `at`. A point belongs to the segment after it; beyond the ends, the outermost counts.
pub(crate) fn segment_at(lengths: &[f64], at: f64) -> usize {
    let last = lengths.len() - 1;
    lengths.partition_point(|length| *length <= at).clamp(1, last.max(1)) - 1
}

impl LinePlace {
    /// The position at arc length `at`, clamped to the ends of the line.
    pub fn at(lengths: &[f64], at: f64) -> Self {
        let last = lengths.len() - 1;
        let segment = segment_at(lengths, at);
        let step = lengths[(segment + 1).min(last)] - lengths[segment];
        let share = if step > 0.0 { ((at - lengths[segment]) / step).clamp(0.0, 1.0) } else { 0.0 };
        Self { segment, share }
    }

    /// The interpolated point.
    pub fn point(self, points: &[DVec3]) -> DVec3 {
        let before = points[self.segment];
        points.get(self.segment + 1).map_or(before, |after| before.lerp(*after, self.share))
    }

    /// The interpolated value.
    pub fn value(self, values: &[f64]) -> f64 {
        let before = values[self.segment];
        values.get(self.segment + 1).map_or(before, |after| self.between([before, *after]))
    }

    /// Interpolates two values. At share 0 or 1 the other value may be unknown (NaN).
    pub fn between(self, [before, after]: [f64; 2]) -> f64 {
        match self.share {
            share if share <= 0.0 => before,
            share if share >= 1.0 => after,
            share => before + (after - before) * share,
        }
    }
}

/// The point of a line at an arc length, clamped to the ends of the line.
pub fn point_at(points: &[DVec3], lengths: &[f64], at: f64) -> DVec3 {
    LinePlace::at(lengths, at).point(points)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_lie_on_their_segments_and_beyond_the_ends_at_the_ends() {
        let points = [DVec3::ZERO, DVec3::X * 2.0, DVec3::X * 2.0, DVec3::new(2.0, 4.0, 0.0)];
        let lengths = arc_lengths(&points);
        assert_eq!(lengths, [0.0, 2.0, 2.0, 6.0]);
        for (at, point) in [(-1.0, points[0]), (0.0, points[0]), (0.5, DVec3::X * 0.5), (2.0, points[1])] {
            assert_eq!(point_at(&points, &lengths, at), point);
        }
        for (at, point) in [(3.0, DVec3::new(2.0, 1.0, 0.0)), (6.0, points[3]), (7.0, points[3])] {
            assert_eq!(point_at(&points, &lengths, at), point);
        }
        assert_eq!(LinePlace::at(&lengths, 2.0), LinePlace { segment: 2, share: 0.0 });
        assert_eq!(LinePlace::at(&lengths, 5.0).value(&[0.0, 1.0, 5.0, 9.0]), 8.0);
        assert_eq!(LinePlace::at(&lengths, 2.0).value(&[0.0, 1.0, 5.0, f64::NAN]), 5.0);
        assert_eq!(LinePlace::at(&lengths, 6.0).value(&[0.0, 1.0, f64::NAN, 9.0]), 9.0);
        assert!(LinePlace::at(&lengths, 3.0).value(&[0.0, 1.0, 5.0, f64::NAN]).is_nan());
        for (at, segment) in [(-1.0, 0), (0.0, 0), (1.0, 0), (2.0, 2), (6.0, 2), (7.0, 2)] {
            assert_eq!(segment_at(&lengths, at), segment);
        }
        assert_eq!(point_at(&[DVec3::Y], &[0.0], 3.0), DVec3::Y);
    }
}
