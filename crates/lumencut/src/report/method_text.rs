//! Describes how vessels were measured and shown.

use lumencut_core::math::statistics::median;
use lumencut_core::named::Named;
use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::stenosis::Method;
use lumencut_vessels::measure::wall::WallSource;
use serde::Deserialize;

use super::chart::{FlagRow, flag_rows};
use super::{Shown, VesselPage};
use crate::measure_words::{of_method, of_source, of_wall};
use crate::text::{fixed, rounded, shortest};

pub(super) const EXPLAINED: &str = "All diameters are of the lumen: thrombus and plaque are not lumen, so an aneurysm may be wider. \
    Diameter means the diameter of a circle of the same area. ± is one standard deviation from noise, blur, wall, levels and \
    surroundings. A stenosis is compared with the median diameter within 1.5 mm of each reference. Suggested places are not \
    findings: a reader must check them. A cyan contour counts for the narrowest and the widest place; an orange one is excluded \
    by its flags; a dashed green one was drawn by hand; a dashed pink one is the outer wall around thrombus or plaque. At a \
    flap, a green one is the lumen of the line and a violet one the other lumen next to it.";

pub(super) const UNITLESS: &str = "The scan has no voxel spacing: 1 mm is assumed, and lengths have no unit.";

/// What is known about the scan's grid, from its file or by an assumption of the reader.
#[derive(Clone, Copy, Debug, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Stated {
    /// Whether the voxel spacing is known; otherwise lengths have no unit.
    pub has_units: bool,
    /// Whether the orientation is known; otherwise C-arm angles are omitted.
    pub has_orientation: bool,
}

impl Stated {
    /// The unit after a number; empty if unknown.
    pub(super) fn unit(&self) -> &'static str {
        if self.has_units { " mm" } else { "" }
    }

    /// A length (mm) in words, without unit if the unit is unknown.
    pub(super) fn length(&self, value: f64, decimals: usize) -> String {
        format!("{}{}", fixed(value, decimals), self.unit())
    }

    /// A sentence of the engine; its units are removed if they are unknown.
    pub(super) fn with_units(&self, words: &str) -> String {
        if self.has_units { words.to_owned() } else { words.replace(" mm²", "").replace(" mm", "") }
    }
}

pub(super) fn method_text(shown: &Shown, vessel: &VesselPage) -> String {
    let profile = vessel.measured.profile;
    let counted = (0..profile.len()).filter(|n| profile.counts(*n)).count();
    format!(
        "Measured by Lumencut {}. Imaging: {}. Settings: {}. FWHM of the point spread {}, {}. Walls: {}. {} sections, of which {counted} count; \
         flags: {}. {}",
        env!("CARGO_PKG_VERSION"),
        vessel.measured.scan.words(),
        settings(shown),
        shown.stated.length(profile.fwhm, 2),
        shown.stated.with_units(&of_source(&profile.fwhm_source)),
        of_wall(&profile.wall_source),
        profile.len(),
        flags(profile),
        contrast(profile),
    )
}

fn settings(shown: &Shown) -> String {
    let asked = &shown.asked;
    let length = |mm: &f64| format!("{}{}", shortest(*mm), shown.stated.unit());
    let place = |mm: &f64| shown.stated.length(*mm, 1);
    let lengths = |places: &Vec<f64>| places.iter().map(place).collect::<Vec<_>>().join(" and ");
    let [level, width] = shown.window.map(intensity);
    let named = [
        ("step", Some(length(&asked.step_mm))),
        ("FWHM", asked.fwhm_mm.as_ref().map(length)),
        ("window", Some(format!("W {width} L {level}"))),
        ("at", asked.at_mm.as_ref().map(place)),
        ("reference", asked.reference_mm.as_ref().map(lengths)),
        ("method", asked.method.as_deref().map(method_word)),
        ("original", asked.original_mm.as_ref().map(length)),
        ("comparison", asked.comparison_mm.as_ref().map(length)),
        ("group", asked.group.clone()),
    ];
    let stated = named.into_iter().filter_map(|(name, value)| Some(format!("{name} {}", value?)));
    let shown = shown.settings.iter().map(|[name, value]| format!("{name} {value}"));
    stated.chain(shown).collect::<Vec<_>>().join("; ")
}

fn method_word(name: &str) -> String {
    Method::named("method", name).map_or_else(|_| name.to_owned(), of_method)
}

fn intensity(value: f64) -> String {
    if (100.0..1e7).contains(&value.abs()) { fixed(value, 0) } else { rounded(value, 3) }
}

fn flags(profile: &Profile) -> String {
    let count = |bit: u32| profile.flags.iter().filter(|bits| *bits & bit > 0).count();
    let told = |FlagRow { look, .. }: &FlagRow| format!("{} {}", look.word, count(look.bit));
    let words: Vec<String> = flag_rows(profile).iter().map(told).collect();
    if words.is_empty() { "none".to_owned() } else { words.join(", ") }
}

fn contrast(profile: &Profile) -> String {
    let mut contrasts: Vec<f64> =
        profile.levels.iter().map(|[lumen, around]| (lumen - around).abs()).collect();
    contrasts.retain(|value| value.is_finite());
    let Some(contrast) = median(&mut contrasts) else { return "No contrast is known.".to_owned() };
    let ratio = if profile.noise > 0.0 { contrast / profile.noise } else { f64::INFINITY };
    let is_in_hu = matches!(
        profile.wall_source,
        WallSource::Hounsfield
            | WallSource::Pooled { given: None, .. }
            | WallSource::Bright
            | WallSource::PerhapsBright
    );
    format!(
        "Contrast to noise {}, contrast {} {}.",
        fixed(ratio, 0),
        rounded(contrast, 4),
        if is_in_hu { "HU" } else { "in the unit of the volume" }
    )
}
