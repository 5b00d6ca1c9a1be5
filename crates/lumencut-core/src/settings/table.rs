//! The table of settings: the source of checks, the Python class, command-line options and documents; and the
//! settings that select the paper's rules.

use super::context::{Context, ContextFrom, ContextName};
use super::field::Field;
use super::focus::Focus;
use super::rules::{DistanceRule, LevelChoice, RimValue, SilhouetteRule, TreeShown};
use super::setting::{Setting, settings};
use super::slab::Slab;
use super::value::{Transfer, Value};
use super::window::{Opacity, Window};
use crate::error::{Error, ErrorKind, Result};
use crate::limits::Limits;

/// Largest number of levels of detail beyond the finest.
pub const MAX_LEVELS: usize = 15;

/// All settings, in the order to show them to users.
pub fn table() -> impl Iterator<Item = &'static Setting> {
    Settings::ROWS.iter().chain(ContextChoices::ROWS)
}

settings! {
    /// How the cut surface is made and shown.
    pub struct Settings {
        /// λ of Eq. 2: the cost of one mm beyond the wall of a vessel (mm of depth per mm).
        cost_weight: f64 = 10.0, range(0.0, 1e4, "mm of depth per mm");

        /// Distance that the cost counts (name): to the piece of the vessel that a pixel could show (`local`), or to the
        /// entire vessel as in Eq. 2 (`whole curve`).
        ///
        /// With `whole curve`, a vessel that crosses itself hides its farther part. Slow; not with `lumen_first`.
        distance_rule: DistanceRule = DistanceRule::Local;

        /// Measure distances from the vessel wall instead of the centerline.
        ///
        /// When off, every vessel counts as having no radius; `lumen_first` then uses `unknown_radius`.
        preserve_lumen: bool = true;

        /// Order pixels by lumen, wall and surroundings at any depth; only a nearer lumen hides a lumen.
        lumen_first: bool = true;

        /// Assumed thickness of the wall around a lumen (mm).
        ///
        /// With `lumen_first`, the wall ranks after every lumen and before all surroundings. With the level choice
        /// `own`, the levels of detail start at its outside.
        lumen_margin: f64 = 1.0, range(0.0, 1e4, "mm");

        /// Radius that `lumen_first` uses for vessels whose radius is missing or 0 (mm).
        unknown_radius: f64 = 1.0, range(0.0, 1e4, "mm");

        /// Vessel whose levels of detail a pixel uses (name): the winner at the finest level (`own`), or the winner
        /// at each level as in the paper (`nearest`).
        level_choice: LevelChoice = LevelChoice::Own;

        /// Standard deviation of the Gaussian that smooths each centerline along its length (radii, 0 to 10).
        ///
        /// Jitter of a centerline folds the cut where a vessel runs towards the viewer. Ends, junctions and vessels
        /// without radius do not change.
        centerline_smoothing: f64 = 0.0, range(0.0, 10.0, "radii");

        /// Number of levels of detail beyond the finest (count, 0 to 15).
        ///
        /// N in the paper.
        levels: usize = 6, range(0.0, MAX_LEVELS as f64, "levels");

        /// Width of one level of detail, as distance from the vessels (mm per level).
        ///
        /// σ in the paper.
        level_distance: f64 = 8.0, range(1e-3, 1e6, "mm per level");

        /// Smooth the depth with a Gaussian of 7 × 7 pixels.
        depth_filter: bool = true;

        /// Restrict the depth filter to depths of one vessel on a smooth surface.
        zone_filter: bool = true;

        /// Largest deviation of a pair of neighbours from a straight line that `zone_filter` accepts (mm).
        depth_leap: f64 = 1.0, range(0.0, 1e6, "mm");

        /// Largest change of depth outside lumen and wall while a view turns (mm per degree).
        ///
        /// Only turntables and the turning view of the viewer use it. The surroundings then lag behind those of the
        /// still picture, by at most half of `cost_weight` times their distance from the wall.
        turning_limit: Option<f64> = None, range(0.1, 1e3, "mm per degree"), open("no limit");

        /// Average N × N samples per pixel (count, 1 to 4).
        ///
        /// Edges become smoother, and the picture takes N² times as long. All other images keep one sample at the
        /// centre of each pixel.
        samples: usize = 1, range(1.0, 4.0, "samples");

        /// Average N × N samples per pixel at silhouettes of the rule `leap`, unless `samples` exceeds 1 (count, 1 to 4).
        edge_samples: usize = 3, range(1.0, 4.0, "samples");

        /// Intensities of the cut surface from black to white, LEVEL ± WIDTH/2 (unit of the volume, HU for CT).
        window: Window = Window::default(), open("from the data");

        /// Intensities between which the cut surface changes from transparent to opaque (unit of the volume, HU for
        /// CT).
        opacity: Option<Opacity> = None, open("all opaque");

        /// Draw lines where the depth of the cut surface jumps.
        silhouettes: bool = true;

        /// Rule that places silhouettes (name): where the surface jumps (`leap`), or where the depth is steep as in
        /// the paper (`gradient`).
        silhouette_rule: SilhouetteRule = SilhouetteRule::Leap;

        /// Slope at which the rule `gradient` draws a silhouette at half strength (mm of depth per mm).
        silhouette_slope: f64 = 24.0, range(1e-3, 1e6, "mm per mm");

        /// Distance from the nearest wall up to which silhouettes have full strength (mm); they fade over the same
        /// distance again.
        ///
        /// Distances are measured in the picture. `None` draws silhouettes everywhere, as in the paper; far from
        /// vessels they only mark borders of zones.
        silhouette_reach: Option<f64> = Some(10.0), range(0.0, 1e6, "mm");

        /// Darken the farther side of a depth jump where `silhouette_reach` hides its line (number, 0 to 1).
        far_rim: f64 = 0.3, range(0.0, 1.0, "of its brightness");

        /// Darken the cut where it lies deeper than around it (number, 0 to 1), but not lumen and wall.
        occlusion: f64 = 0.0, range(0.0, 1.0, "of its brightness");

        /// Colour of the silhouettes.
        ///
        /// Red, green and blue.
        silhouette_color: [u8; 3] = [255, 220, 0];

        /// Colour a rim around the vessels by values along them (name): `diameter` (mm), `narrowing` of graded stenoses
        /// (%), `deviation` from their reference (mm) or `uncertainty` of the diameter (mm).
        ///
        /// Lumen, wall, calcium and metal keep their grey. Diameters come from profiles, otherwise from radii; all
        /// else needs profiles. Labels of the picture explain the colours.
        rim: Option<RimValue> = None, open("no rim");

        /// Value of the first colour of the `rim` (mm, or % for `narrowing`).
        rim_low: Option<f64> = None, range(-1e4, 1e4, "mm or %"), open("from the values");

        /// Value of the last colour of the `rim` (mm, or % for `narrowing`).
        rim_high: Option<f64> = None, range(-1e4, 1e4, "mm or %"), open("from the values");

        /// Vessel walls over the picture (name): `hidden`, or `wireframe` for rings across and lines along the vessels.
        ///
        /// Wires show the radii of the centerlines, `unknown_radius` where there is none; only the picture has them.
        tree: TreeShown = TreeShown::Hidden;

        /// Colour of pixels that show nothing else.
        ///
        /// Red, green, blue and opacity.
        background: [u8; 4] = [0, 0, 0, 255];

        /// Show the largest, mean or smallest value in a slab (mm) centred on the cut surface.
        slab: Option<Slab> = None, open("no slab");

        /// Show the cut surface only near the vessels, surrounded by the context (mm).
        ///
        /// It fades over FADE mm, starting MARGIN mm beyond the nearest wall; both are measured in the picture. A
        /// negative margin lets lumens fade too. A fade of 0 is a hard edge; any other is at least two pixels wide.
        /// Needs centerlines.
        focus: Option<Focus> = None, open("the cut surface everywhere");

        /// Show lumen and wall of these vessels in front of all others at any depth (names or ids).
        ///
        /// Needs `lumen_first`. Silhouettes are then drawn even if `silhouettes` is off: without outlines, a
        /// farther vessel in front looks wrong. All vessels or none: no vessel is highlighted.
        focus_vessels: Vec<usize> = Vec::new();

        /// Share of the other vessels that a `focus` keeps when `focus_vessels` are chosen (number, 0 to 1).
        ///
        /// At 0 the context replaces them; at 1 they look like the chosen ones.
        others_strength: f64 = 0.5, range(0.0, 1.0, "of their share");
    }
    beside them {
        /// The context; `None` shows the background.
        context: Option<Context> = Some(Context::default());
    }
}

settings! {
    /// The context as users set it; [`ContextChoices::context`] converts it for the rays.
    pub struct ContextChoices {
        /// What to show where the cut surface is outside the volume or transparent (name): `mida`, `dvr`, `mip`,
        /// `minip`, `average`, or only the background (`None`).
        ///
        /// `mida` is maximum intensity difference accumulation, `dvr` direct volume rendering; `mip`, `minip` and
        /// `average` are the largest, smallest and mean value along each ray.
        context: Option<ContextName> = Some(ContextName::Mida);

        /// Blend for `mida` (number, -1 to 1): -1 is `dvr`, 0 `mida`, 1 `mip`.
        context_gamma: f64 = 0.0, range(-1.0, 1.0, "(DVR to MIP)");

        /// Intensities that the context maps to 0 to 1, LEVEL ± WIDTH/2 (unit of the volume, HU for CT).
        ///
        /// `mida` scales its differences by it; `minip` and `average` show it from black to white; named transfer
        /// functions lie within it. If not given, it comes from the data whatever `window` is: `Window.whole` for
        /// `minip` and `average`, `Window.for_mip` for `mip` without centerlines, otherwise `Window.from_data`.
        context_window: Window = Window::default(), open("from the data");

        /// Colours and opacities of `mida`, `dvr` and `mip`: grey, angio, bone, soft-tissue, or control points of
        /// intensity (unit of the volume, HU for CT), colour and opacity per mm (0 to 1).
        context_transfer: Option<Transfer> = None, open("grey for mip, otherwise angio");

        /// Longest distance between samples of `mida` and `dvr` along a ray (mm).
        context_step: Option<f64> = None, range(1e-3, 1e3, "mm"),
            open("half the smallest voxel side, two sides in a preview");

        /// Shade `mida` and `dvr` by the gradient, with light from the viewer.
        context_shading: bool = false;

        /// Start of the context rays around a `focus` (name): at the cut surface, or in front of the volume.
        ///
        /// Within the focus they always start at the cut surface.
        context_from: Option<ContextFrom> = None, open("cut for mida and dvr, otherwise whole");

        /// Brightness of the context: factor of its colours (number, 0 to 1).
        context_strength: f64 = 1.0, range(0.0, 1.0, "of its brightness");

        /// Darken the context around a `focus` (number, 0 to 1).
        context_halo: f64 = 0.0, range(0.0, 1.0, "of its brightness");

        /// Outline the body if the scan shows air around it; not in previews.
        context_body: bool = false;

        /// Trace one ray per 6 × 6 pixels: faster and coarser.
        context_preview: bool = false;
    }
}

fn unknown(name: &str) -> Error {
    let known: Vec<_> = table().map(|setting| setting.name).collect();
    Error::new(ErrorKind::Settings, "name of a setting", format!("'{name}'"), known.join(", "))
}

impl Settings {
    /// The paper's rules, with the defaults of all other settings.
    pub fn paper() -> Self {
        Self {
            lumen_first: false,
            lumen_margin: 0.0,
            level_choice: LevelChoice::Nearest,
            zone_filter: false,
            silhouette_rule: SilhouetteRule::Gradient,
            silhouette_reach: None,
            edge_samples: 1,
            far_rim: 0.0,
            ..Self::default()
        }
    }

    /// The settings in which [`Settings::paper`] differs from the defaults, with the paper's values.
    pub fn paper_values() -> Vec<(&'static str, Value)> {
        let defaults = Self::default().values();
        Self::paper()
            .values()
            .into_iter()
            .zip(defaults)
            .filter(|(paper, own)| paper != own)
            .map(|(paper, _)| paper)
            .collect()
    }
}
