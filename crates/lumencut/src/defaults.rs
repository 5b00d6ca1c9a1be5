//! Defaults that the command line, Python and the page share, and the rule for the pixel side of reformations.

use lumencut_vessels::measure::profile::measuring;
pub use lumencut_vessels::trace::find::SMALLEST_RADIUS_WORDS;
use lumencut_vessels::trace::skeleton;

/// A parameter with its default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    /// Function and parameter of the Python package, such as `untangled.width`.
    pub name: &'static str,
    /// Other functions with the same parameter and default.
    pub also: &'static [&'static str],
    /// `mm`, `rad`, `pixels`, `radii`, or empty for counts and fractions.
    pub unit: &'static str,
    /// The smallest and largest accepted number; `ABOVE_0` and infinity if there is no other limit.
    pub range: [f64; 2],
    /// The number if the user gives none.
    pub default: f64,
    /// The meaning of the parameter, in one sentence.
    pub about: &'static str,
}

/// The lower end of a range of numbers that must be above 0.
pub(crate) const ABOVE_0: f64 = f64::MIN_POSITIVE;

const OPEN: f64 = f64::INFINITY;

macro_rules! pixel_sides {
    ($smallest:literal, $largest:literal) => {
        /// Smallest and largest pixel side that a reformation has by default (mm).
        pub(crate) const PIXEL_SIDES: [f64; 2] = [$smallest, $largest];

        /// The rule of [`pixel_side`] in words, for help texts and documentation.
        pub const PIXEL_SIDE_WORDS: &str =
            concat!("the smallest voxel side, at least ", $smallest, " and at most ", $largest, " mm");
    };
}

pixel_sides!(0.05, 0.25);

/// The pixel side (mm) that every reformation along vessels has by default, in a scan with this smallest voxel side
/// (mm). The largest side leaves room for labels, the smallest one bounds the size of pictures of very fine scans.
pub fn pixel_side(smallest_side: f64) -> f64 {
    smallest_side.clamp(PIXEL_SIDES[0], PIXEL_SIDES[1])
}

macro_rules! quantities {
    ($($constant:ident $name:literal $(= $also:literal)*, $default:expr, [$low:expr, $high:expr] $unit:literal, $about:literal;)+) => {
        $(
            #[doc = $about]
            pub const $constant: Quantity = Quantity {
                name: $name,
                also: &[$($also),*],
                unit: $unit,
                range: [$low, $high],
                default: $default,
                about: $about,
            };
        )+
        /// All quantities, in the order of the documentation.
        pub const QUANTITIES: &[Quantity] = &[$($constant),+];
    };
}

quantities! {
    CPR_WIDTH "cpr.width" = "straightened_volume", 50.0, [ABOVE_0, OPEN] "mm",
        "Width of a straightened vessel, half of it on each side; other CPRs show as much beyond the vessel.";
    SMOOTHING "cpr.smoothing" = "straightened_volume" = "cfa" = "lumen_map" = "spiral" = "uncurl", 0.0, [0.0, 1e3] "mm",
        "Standard deviation of the Gaussian that smooths the centerline.";
    CFA_RADIUS "cfa.radius", 10.0, [ABOVE_0, OPEN] "mm", "Radius of the largest circle that a pixel of the CFA summarises.";
    MAP_OVERLAP "lumen_map.overlap", 0.0, [0.0, 3.0] "rad",
        "How much of the other side a lumen map repeats beyond each edge; `lumencut map` repeats 15°.";
    BAND_START "lumen_map.band[0]", -1.0, [-1e3, 1e3] "mm", "Where the band around the wall begins that a lumen map searches.";
    BAND_END "lumen_map.band[1]", 3.0, [-1e3, 1e3] "mm", "Where this band ends.";
    UNCURL_AMOUNT "uncurl.amount", 0.5, [0.0, 1.0] "", "How far a vessel is straightened.";
    UNCURL_FRAMES "uncurling.frames", 48.0, [2.0, 1e4] "", "Frames of a film that uncurls a vessel.";
    UNTANGLED_WIDTH "untangled.width", 25.0, [1e-3, 1e4] "mm",
        "How far from each vessel the untangled CPR shows its surroundings, on each side.";
    HULL_MARGIN "untangled.hull_margin", 2.0, [0.0, 1e3] "mm", "Margin around a lumen that no other vessel may enter.";
    UNTANGLED_SMOOTHING "untangled.smoothing", 4.0, [0.0, 1e3] "mm",
        "Standard deviation of the Gaussian that smooths the directions of untangled vessels.";
    RADIUS_OFFSET "cr.radius_offset", 50.0, [0.0, 1e6] "pixels",
        "How far beyond its radius a vessel hides what lies behind it in Centerline Reformation.";
    ARC_THRESHOLD "cr.arc_threshold", 150.0, [0.0, 1e6] "pixels",
        "Largest distance along the tree at which two places belong to one stretch in Centerline Reformation.";
    FOCUS_MARGIN "Focus.margin", 2.0, [-1e6, 1e6] "mm", "How far beyond the wall the focus shows the cut at full strength.";
    FOCUS_FADE "Focus.fade", 6.0, [0.0, 1e6] "mm", "Distance over which the focus then fades into the context.";
    TURN_FRAMES "turntable.frames", 72.0, [1.0, 1e6] "", "Frames of a full turn.";
    FLIGHT_FRAMES "flight.frames", 36.0, [2.0, 1e6] "", "Frames of a flight between two views.";
    MEASURE_STEP "measure.step" = "VesselTree.measured", measuring::STEP, [ABOVE_0, OPEN] "mm", "Distance of measured sections.";
    STOPPER_RADIUS "trace.stopper_radius", 3.0, [ABOVE_0, OPEN] "mm", "Radius around a stopper that no vessel may enter.";
    SHORTEST_BRANCH "trace_mask.shortest_branch", skeleton::PARENT_RADII, [0.0, OPEN] "radii",
        "Length below which branches of a mask are left out, in radii of their parent.";
}

#[cfg(test)]
#[path = "tests/defaults.rs"]
mod tests;
