//! How far two computations of the same thing may lie apart, each with the reason for its size.

/// How far apart two numbers may lie, and which share of all of them may lie further apart.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// The largest difference that counts as rounding, in the unit of the numbers.
    pub apart: f32,
    /// The share of the numbers that may lie further apart, from 0 to 1.
    pub share: f64,
}

impl Tolerance {
    const fn new(apart: f32, share: f64) -> Self {
        Self { apart, share }
    }

    /// Whether two numbers are the same but for rounding; what is not a number is never the same.
    pub fn is_same(self, a: f32, b: f32) -> bool {
        (a - b).abs() <= self.apart
    }

    /// Whether this count of `all` numbers may lie further apart.
    pub fn allows(self, further: usize, all: usize) -> bool {
        further as f64 <= self.share * all as f64
    }

    /// Refuses images of numbers that differ by more; says how far the farthest pair lies apart (infinity where either
    /// is not a number).
    ///
    /// # Panics
    /// For what differs by more, and for images of different sizes.
    pub fn assert_same(self, found: &[f32], expected: &[f32], what: &str) -> f32 {
        assert_eq!(found.len(), expected.len(), "{what}: different sizes");
        let pairs = || found.iter().zip(expected);
        let apart = |(a, b): (&f32, &f32)| if (a - b).is_nan() { f32::INFINITY } else { (a - b).abs() };
        let most = pairs().map(apart).fold(0.0, f32::max);
        let further = pairs().filter(|(a, b)| !self.is_same(**a, **b)).count();
        assert!(
            self.allows(further, found.len()),
            "{what}: {further} of {} are further apart than {}, at most {most}",
            found.len(),
            self.apart
        );
        most
    }
}

/// Shares of a focus, 0 to 1: a distance from a wall is rounded by a few 10⁻⁶ mm, and a fade is at least 1 mm in the tests. A
/// step of 255 is 4·10⁻³.
pub const SHARE: Tolerance = Tolerance::new(1e-4, 0.0);

/// The side of a neighbourhood (pixels).
pub const NEIGHBOURHOOD: usize = 8;

/// The most pixels of a neighbourhood with another depth, or with colours as far apart as [`COLOR_LEAP`] says: fewer
/// than the smallest vessel covers.
pub const MOST_TOGETHER: usize = 16;

/// Depths of whole frames (mm), and vessels: a thousandth of a mm is far below a voxel, and where two pieces cost the
/// same the last digit decides, which happens along the thin lines where zones meet.
pub const DEPTH: Tolerance = Tolerance::new(1e-3, 1e-3);

/// Pixels around joints that may belong to any of the vessels that end there: a lumen of 5 mm around the one joint of the
/// small pictures covers 1.6 % of them. In most of them not one pixel ties; in a picture of the paper's zones each that
/// does changes what the filter makes of its neighbours.
pub const TIED: Tolerance = Tolerance::new(0.0, 0.02);

/// Colours of whole frames, in steps of 255: rounding moves a channel by one step, more only where a depth is another.
pub const COLOR: Tolerance = Tolerance::new(1.0, 5e-4);

/// Colours of whole frames far apart, in steps of 255: an eye sees four steps, and so they stay single pixels.
pub const COLOR_LEAP: Tolerance = Tolerance::new(4.0, 1e-4);

/// Distances of whole frames (mm): they are computed directly, without a choice that rounding could turn.
pub const DISTANCE: Tolerance = Tolerance::new(1e-4, 0.0);

/// The context in whole frames, in steps of 255: a ray starts where the depth says, and at steep places another digit of
/// the depth moves it past an edge.
pub const CONTEXT_OF_FRAME: Tolerance = Tolerance::new(4.0, 1e-3);

/// Channels of the context alone, from 0 to 1: one step of 255, but for rays that touch the edge of what is visible.
pub const CONTEXT: Tolerance = Tolerance::new(1.0 / 255.0, 5e-4);

/// Channels of the context alone, from 0 to 1: four steps of 255 only for one ray in a hundred of the small pictures.
pub const CONTEXT_LEAP: Tolerance = Tolerance::new(4.0 / 255.0, 1e-2);

/// Bytes of a composed picture from the same layers: a value in the middle between two bytes may be rounded to either.
pub const BYTE: Tolerance = Tolerance::new(1.0, 0.0);

/// How many bytes of a composed picture may be the other of two neighbours.
pub const OTHER_BYTE: Tolerance = Tolerance::new(0.0, 1e-3);

/// Values of the surface, as a share of the difference between a volume's extremes: the place of a sample is known to a
/// 10,000th of a voxel, and some pixels on the border of the volume lie outside on one side only.
pub const SURFACE: Tolerance = Tolerance::new(1e-5, 5e-4);

/// Strengths of silhouettes, from 0 to 1: sums of 49 products in single precision.
pub const SILHOUETTE: Tolerance = Tolerance::new(1e-5, 0.0);

/// Filtered depths of up to 300 mm: two units of the last place of the largest, 2 · 2⁻¹⁵ mm.
pub const FILTERED_DEPTH: Tolerance = Tolerance::new(2.0 * 256.0 * f32::EPSILON, 0.0);

/// Depths of a plane of up to 300 mm, filtered within zones: each is rounded by half a unit of the last place, and so a
/// pair lies off the straight line by two units at most, a quarter of which is added along each axis and rounded.
pub const PLANE: Tolerance = Tolerance::new(2.0 * 256.0 * f32::EPSILON, 0.0);

/// Depths filtered within zones on two machines: as [`FILTERED_DEPTH`], but for single pixels whose pair lies off a
/// straight line by just the leap, so that the last digit of the first pass decides whether it counts.
pub const FILTERED_IN_ZONES: Tolerance = Tolerance::new(FILTERED_DEPTH.apart, 1e-4);

/// Depths and distances of up to 60 mm against their closed form (mm): some units of the last place of f32.
pub const CLOSED_FORM: Tolerance = Tolerance::new(1e-4, 0.0);

/// Depths inside a lumen against the nearest lumen (mm): the depths are of f32, the test's own of f64.
pub const LUMEN: Tolerance = Tolerance::new(1e-3, 0.0);

/// Depths inside a lumen, filtered within zones, against the nearest lumen (mm): half of what is a leap at most, but for
/// single pixels where a vessel bends sharply towards the viewer.
pub const FILTERED_LUMEN: Tolerance = Tolerance::new(0.5, 1e-3);

/// Depths of a random tree turned together with its camera (mm): all coordinates are rounded anew, and a pixel between
/// two zones may fall into the other.
pub const TURNED: Tolerance = Tolerance::new(1e-2, 2e-3);

/// Depths of the trefoil turned onto itself (mm): its corners come to lie elsewhere within pixels, so that more of the
/// borders between zones move than in [`TURNED`].
pub const SYMMETRIC: Tolerance = Tolerance::new(1e-2, 9.9e-3);

/// Depths of the same vessels in another order: vessels that share an end point tie around it, and the first one wins.
pub const REORDERED_DEPTH: Tolerance = Tolerance::new(0.0, 5e-3);

/// Vessels of the same vessels in another order: of those that tie around a shared end point another one is named.
pub const REORDERED_VESSEL: Tolerance = Tolerance::new(0.0, 5e-2);

/// Slopes of sheets on two machines (mm per mm): a segment of 2 mm is known to some units of the last place of its ends;
/// further apart only where two pieces cost the same, as in [`DEPTH`].
pub const SHEET_SLOPE: Tolerance = Tolerance::new(1e-4, 1e-3);

/// Radii of sheets on two machines (mm): places along a segment times the change of radii of up to 6 mm.
pub const SHEET_RADIUS: Tolerance = Tolerance::new(1e-5, 1e-3);

/// Gaps of sheets on two machines (mm): differences of arc lengths of up to 300 mm, each known to some units of the last
/// place.
pub const SHEET_GAP: Tolerance = Tolerance::new(2e-4, 1e-3);

/// Values of a volume of up to 700 against their closed form, and those of wider types of voxels, which are computed in
/// f64 instead of f32: some units of the last place of f32.
pub const VALUE: Tolerance = Tolerance::new(1e-3, 0.0);

/// Weights of the depth filter, each at most 1, against the Gaussian: some units of the last place.
pub const WEIGHT: Tolerance = Tolerance::new(1e-6, 0.0);

/// A filtered constant of 7.5: the 49 weights add up to 1 but for some units of the last place.
pub const CONSTANT: Tolerance = Tolerance::new(1e-5, 0.0);

#[cfg(test)]
mod tests {
    use super::*;

    const FEW: Tolerance = Tolerance::new(0.5, 0.25);

    fn refuses(found: &[f32], expected: &[f32]) -> bool {
        std::panic::catch_unwind(|| FEW.assert_same(found, expected, "numbers")).is_err()
    }

    #[test]
    fn numbers_too_far_apart_are_refused_where_they_are_too_many() {
        assert_eq!(FEW.assert_same(&[1.0, 2.0, 3.0, 4.0], &[1.5, 2.0, 3.0, 9.0], "numbers"), 5.0);
        assert!(refuses(&[1.0, 2.0, 3.0, 4.0], &[1.6, 2.0, 3.0, 9.0]));
        assert!(refuses(&[1.0, 2.0, 3.0, 4.0], &[1.0, 2.0, 3.0]));
    }

    #[test]
    fn what_is_not_a_number_is_another_number() {
        assert_eq!(FEW.assert_same(&[1.0, 2.0, 3.0, f32::NAN], &[1.0, 2.0, 3.0, 4.0], "one"), f32::INFINITY);
        assert!(refuses(&[1.0, 2.0, f32::NAN, f32::NAN], &[1.0, 2.0, f32::NAN, f32::NAN]));
    }
}
