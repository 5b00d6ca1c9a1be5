//! The table of settings. Checks, the Python class, the options of the command line and the documents come from it.

use super::context::{Context, ContextFrom, ContextName};
use super::field::Field;
use super::focus::Focus;
use super::rules::{LevelChoice, SilhouetteRule};
use super::setting::{Setting, settings};
use super::slab::Slab;
use super::value::{Transfer, Value};
use super::window::{Opacity, Window};
use crate::error::{Error, ErrorKind, Result};
use crate::limits::Limits;

/// The most levels of detail beyond the finest.
pub const MAX_LEVELS: usize = 15;

/// All settings, in the order to show them to users.
pub fn table() -> impl Iterator<Item = &'static Setting> {
    Settings::ROWS.iter().chain(ContextChoices::ROWS)
}

settings! {
    /// How the cut surface is made and shown.
    pub struct Settings {
        /// λ of Eq. 2: what one mm beyond a vessel's wall costs (mm of depth per mm).
        cost_weight: f64 = 10.0, range(0.0, 1e4, "mm of depth per mm");

        /// Measure distance from the wall, or from the centerline.
        ///
        /// From the centerline it is measured as if no vessel had a radius: under `lumen_first` each then has the
        /// `unknown_radius`.
        preserve_lumen: bool = true;

        /// Show every lumen unless a nearer lumen hides it: lumen before wall before surroundings, whatever the depth.
        lumen_first: bool = true;

        /// How thick the wall around a lumen is taken to be (mm).
        ///
        /// With `lumen_first` the wall comes after every lumen and before all surroundings. With the level choice `own`
        /// the levels of detail are counted from its outside.
        lumen_margin: f64 = 1.0, range(0.0, 1e4, "mm");

        /// Radius that `lumen_first` takes for vessels without radius, or where it is 0 (mm).
        unknown_radius: f64 = 1.0, range(0.0, 1e4, "mm");

        /// Which vessel the levels of detail of a pixel belong to (name): the one that wins the pixel at the finest level,
        /// or whichever wins at each level, as in the paper.
        level_choice: LevelChoice = LevelChoice::Own;

        /// Smooth each centerline along its length by a Gaussian of this many radii (radii, 0 to 10).
        ///
        /// Jitter of the centerline folds the cut where a vessel runs towards the viewer. Ends, places where vessels meet
        /// and vessels without radius stay as they are.
        centerline_smoothing: f64 = 0.0, range(0.0, 10.0, "radii");

        /// Levels of detail beyond the finest (count, 0 to 15).
        levels: usize = 6, range(0.0, MAX_LEVELS as f64, "levels");

        /// How far from the vessels one level of detail reaches (mm per level).
        ///
        /// σ in the paper, as `levels` is N.
        level_distance: f64 = 8.0, range(1e-3, 1e6, "mm per level");

        /// Smooth the depth with a Gaussian of 7 × 7 pixels.
        depth_filter: bool = true;

        /// Let the depth filter mix only depths of one vessel that lie on an even surface.
        zone_filter: bool = true;

        /// How far a pair of neighbours may lie off a straight line before `zone_filter` leaves it out (mm).
        depth_leap: f64 = 1.0, range(0.0, 1e6, "mm");

        /// N × N samples in each pixel, averaged in the picture (count, 1 to 4).
        ///
        /// Edges become smoother, and the picture takes N² times as long. All other images stay those of one sample in the
        /// middle of each pixel.
        samples: usize = 1, range(1.0, 4.0, "samples");

        /// Intensities of the cut surface from black to white, LEVEL ± WIDTH/2 (unit of the volume, HU for CT).
        window: Window = Window::default(), open("from the data");

        /// Ramp of opacity of the cut surface over intensities (unit of the volume, HU for CT).
        opacity: Option<Opacity> = None, open("all opaque");

        /// Draw lines where the cut surface leaps.
        silhouettes: bool = true;

        /// Where silhouettes are drawn (name): where the surface leaps, or where the depth is steep, as in the paper.
        silhouette_rule: SilhouetteRule = SilhouetteRule::Leap;

        /// Slope at which a silhouette of the rule `gradient` has half its strength (mm of depth per mm).
        silhouette_slope: f64 = 24.0, range(1e-3, 1e6, "mm per mm");

        /// How far from the nearest wall silhouettes are drawn in full (mm); from there they fade over the same length again.
        ///
        /// Far from all vessels the lines follow borders of zones that mean nothing to a reader. Measured in the picture.
        /// `None` draws them everywhere, as in the paper.
        silhouette_reach: Option<f64> = Some(10.0), range(0.0, 1e6, "mm");

        /// Colour of the silhouettes.
        ///
        /// Red, green and blue.
        silhouette_color: [u8; 3] = [255, 220, 0];

        /// Colour behind it all.
        ///
        /// Red, green, blue and opacity, where there is nothing to show.
        background: [u8; 4] = [0, 0, 0, 255];

        /// Show the largest, mean or smallest value of a slab around the cut surface (mm, from its near to its far
        /// side).
        slab: Option<Slab> = None, open("one point deep");

        /// Show the cut surface around the vessels alone, amid the context (mm).
        ///
        /// From MARGIN mm beyond the nearest wall it fades over FADE mm; both are measured in the picture. A negative
        /// margin lets lumens fade too. A fade of 0 is a hard edge, any other is at least two pixels wide. It needs
        /// centerlines.
        focus: Option<Focus> = None, open("the cut surface everywhere");

        /// Show lumen and wall of these vessels before all others, whatever the depth (names or ids).
        ///
        /// It needs `lumen_first`. Silhouettes are drawn then even where `silhouettes` leaves them out: a vessel that is
        /// shown before one nearer to the viewer looks wrong without its outline. All vessels, or none, set none apart.
        focus_vessels: Vec<usize> = Vec::new();

        /// How much of the other vessels a `focus` leaves where `focus_vessels` are chosen (number, 0 to 1).
        ///
        /// With 0 the context takes their place, with 1 they are shown as the chosen ones are.
        others_strength: f64 = 0.5, range(0.0, 1.0, "of their share");
    }
    beside them {
        /// What is shown where the cut surface is outside the volume or transparent; `None` is the background.
        context: Option<Context> = Some(Context::default());
    }
}

settings! {
    /// The context as hosts choose it; [`ContextChoices::context`] is what rays need of it.
    pub struct ContextChoices {
        /// What is shown where the cut surface is outside the volume or transparent (name): maximum intensity
        /// difference accumulation, direct volume rendering, largest, smallest or mean value, or the background
        /// alone.
        context: Option<ContextName> = Some(ContextName::Mida);

        /// For mida: -1 is dvr, 0 mida, 1 mip, between them a blend (number, -1 to 1).
        context_gamma: f64 = 0.0, range(-1.0, 1.0, "(DVR to MIP)");

        /// Intensities that the context takes as 0 to 1, LEVEL ± WIDTH/2 (unit of the volume, HU for CT).
        ///
        /// They are 0 to 1 for the differences of mida, and black to white for minip and average; the named transfer
        /// functions lie within them. From the data they are taken whatever `window` is: as `Window.whole` does for
        /// minip and average, as `Window.for_mip` does for mip where there are no centerlines, as `Window.from_data` does for
        /// the others.
        context_window: Window = Window::default(), open("from the data");

        /// Colours and opacities of mida, dvr and mip: grey, angio, bone, soft-tissue, or control points of intensity
        /// (unit of the volume, HU for CT), colour and opacity of one mm (0 to 1).
        context_transfer: Option<Transfer> = None, open("grey for mip, else angio");

        /// Longest distance between the samples of mida and dvr along a ray (mm).
        context_step: Option<f64> = None, range(1e-3, 1e3, "mm"),
            open("half the smallest side of a voxel, all of it in a preview");

        /// Shade mida and dvr by the gradient, with light from the viewer.
        context_shading: bool = false;

        /// Where the rays of the context start around a `focus` (name): at the cut surface, or in front of the volume.
        ///
        /// Within the focus they start at the cut surface, wherever they start around it.
        context_from: Option<ContextFrom> = None, open("cut for mida and dvr, else whole");

        /// How bright the context is in the picture: what its colours are multiplied by (number, 0 to 1).
        context_strength: f64 = 1.0, range(0.0, 1.0, "of its brightness");

        /// Trace one ray for each square of four pixels: quicker and coarser.
        context_preview: bool = false;
    }
}

fn unknown(name: &str) -> Error {
    let known: Vec<_> = table().map(|setting| setting.name).collect();
    Error::new(ErrorKind::Settings, "name of a setting", format!("'{name}'"), known.join(", "))
}
