//! Tolerances between two computations of the same quantity, each with its reason.

/// A largest difference, and the fraction of values that may exceed it.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// The largest difference that counts as rounding, in the values' unit.
    pub apart: f32,
    /// The fraction of values that may differ more, 0 to 1.
    pub share: f64,
}

impl Tolerance {
    const fn new(apart: f32, share: f64) -> Self {
        Self { apart, share }
    }

    /// Whether two numbers are equal up to rounding; NaN never is.
    pub fn is_same(self, a: f32, b: f32) -> bool {
        (a - b).abs() <= self.apart
    }

    /// Whether `further` of `all` numbers may differ by more than `apart`.
    pub fn allows(self, further: usize, all: usize) -> bool {
        further as f64 <= self.share * all as f64
    }

    /// Asserts that images are equal within the tolerance; returns the largest difference (infinite for NaN).
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

/// Shares of a focus, 0 to 1. Wall distances are rounded by a few 10⁻⁶ mm, fades are at least 1 mm wide; a grey
/// step is 4·10⁻³.
pub const SHARE: Tolerance = Tolerance::new(1e-4, 0.0);

/// Side of a neighbourhood (pixels).
pub const NEIGHBOURHOOD: usize = 8;

/// The most pixels of a neighbourhood that may differ in depth or by [`COLOR_LEAP`]; the smallest vessel covers more.
pub const MOST_TOGETHER: usize = 16;

/// Depths of frames (mm), and vessel ids: far below a voxel; on borders between zones, two pieces may be equally near.
pub const DEPTH: Tolerance = Tolerance::new(1e-3, 1e-3);

/// Costs (mm): as [`DEPTH`], plus ten times the rounding of a distance of up to 100 mm.
pub const COST: Tolerance = Tolerance::new(3e-3, 1e-3);

/// Levels: near distance 0 the square root amplifies rounding.
pub const LEVEL: Tolerance = Tolerance::new(1e-2, 1e-3);

/// Pixels around joints where pieces tie: a 5 mm lumen at the only joint of small pictures covers 1.6 %; the filter adds some.
pub const TIED: Tolerance = Tolerance::new(0.0, 0.02);

/// Colours of frames, in steps of 255. Rounding changes a channel by one step, and by more only if a depth differs.
pub const COLOR: Tolerance = Tolerance::new(1.0, 5e-4);

/// Clearly different colours, in steps of 255. Four steps are visible, so only single pixels may differ as much.
pub const COLOR_LEAP: Tolerance = Tolerance::new(4.0, 1e-4);

/// Distances of frames (mm). They are computed directly; rounding cannot change a decision.
pub const DISTANCE: Tolerance = Tolerance::new(1e-4, 0.0);

/// The context of frames, in steps of 255. Rounding of a depth can move a ray beyond an edge.
pub const CONTEXT_OF_FRAME: Tolerance = Tolerance::new(4.0, 1e-3);

/// Channels of the context without vessels, 0 to 1: at most one step of 255, except on rays that graze visible edges.
pub const CONTEXT: Tolerance = Tolerance::new(1.0 / 255.0, 5e-4);

/// As [`CONTEXT`], for small pictures: on at most one ray in a hundred, more than four steps of 255.
pub const CONTEXT_LEAP: Tolerance = Tolerance::new(4.0 / 255.0, 1e-2);

/// Bytes composed from identical layers. A value midway between two bytes may be rounded up or down.
pub const BYTE: Tolerance = Tolerance::new(1.0, 0.0);

/// The fraction of composed bytes that may be rounded differently.
pub const OTHER_BYTE: Tolerance = Tolerance::new(0.0, 1e-3);

/// Surface values, as a fraction of the range. Sample positions are exact to 10⁻⁴ voxel; border pixels may lie outside.
pub const SURFACE: Tolerance = Tolerance::new(1e-5, 5e-4);

/// Silhouette strengths, 0 to 1: sums of 49 products in single precision.
pub const SILHOUETTE: Tolerance = Tolerance::new(1e-5, 0.0);

/// Filtered depths of up to 300 mm: two units in the last place of f32, 2 · 2⁻¹⁵ mm.
pub const FILTERED_DEPTH: Tolerance = Tolerance::new(2.0 * 256.0 * f32::EPSILON, 0.0);

/// Zone-filtered depths of a plane of up to 300 mm: a pair differs by two units in the last place; each axis adds a quarter.
pub const PLANE: Tolerance = Tolerance::new(2.0 * 256.0 * f32::EPSILON, 0.0);

/// Zone-filtered depths on two machines: as [`FILTERED_DEPTH`], except for pairs whose difference equals the jump limit.
pub const FILTERED_IN_ZONES: Tolerance = Tolerance::new(FILTERED_DEPTH.apart, 1e-4);

/// Depths and distances of up to 60 mm (mm), compared with their formula: a few units in the last place of f32.
pub const CLOSED_FORM: Tolerance = Tolerance::new(1e-4, 0.0);

/// Depths in a lumen, compared with the reference (mm): f32 against f64.
pub const LUMEN: Tolerance = Tolerance::new(1e-3, 0.0);

/// Zone-filtered depths in a lumen, compared with the reference (mm): half of a jump, except at sharp bends towards the viewer.
pub const FILTERED_LUMEN: Tolerance = Tolerance::new(0.5, 1e-3);

/// Depths of a random tree rotated with its camera (mm). Coordinates are rounded again; border pixels may change zones.
pub const TURNED: Tolerance = Tolerance::new(1e-2, 2e-3);

/// Depths of the trefoil rotated onto itself (mm). Its corners then lie elsewhere within pixels, so more zone borders move.
pub const SYMMETRIC: Tolerance = Tolerance::new(1e-2, 9.9e-3);

/// Depths after reordering vessels. Around shared end points vessels tie, and the first one wins.
pub const REORDERED_DEPTH: Tolerance = Tolerance::new(0.0, 5e-3);

/// Vessel ids after reordering. Where vessels tie around shared end points, another vessel may win.
pub const REORDERED_VESSEL: Tolerance = Tolerance::new(0.0, 5e-2);

/// Slopes of sheets on two machines (mm per mm): rounding on 2 mm segments; more only if pieces tie, as in [`DEPTH`].
pub const SHEET_SLOPE: Tolerance = Tolerance::new(1e-4, 1e-3);

/// Radii of sheets on two machines (mm): the position on a segment times radius changes of up to 6 mm.
pub const SHEET_RADIUS: Tolerance = Tolerance::new(1e-5, 1e-3);

/// Gaps of sheets on two machines (mm): differences of arc lengths of up to 300 mm.
pub const SHEET_GAP: Tolerance = Tolerance::new(2e-4, 1e-3);

/// Volume values of up to 700, compared with their formula or with f64: a few units in the last place of f32.
pub const VALUE: Tolerance = Tolerance::new(1e-3, 0.0);

/// Filter weights (at most 1), compared with the Gaussian: a few units in the last place.
pub const WEIGHT: Tolerance = Tolerance::new(1e-6, 0.0);

/// A filtered constant of 7.5. The 49 weights sum to 1 up to a few units in the last place.
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
