//! Every knob of the method, with its unit and its default.

use crate::error::{Error, ErrorKind, Result};
use crate::math::window::{Opacity, Window};

/// The most levels of detail beyond the finest.
pub const MAX_LEVELS: usize = 15;

/// How the cut surface is made and shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// λ: what one millimetre beyond a vessel's wall costs in millimetres of depth (paper Eq. 2).
    pub cost_weight: f64,
    /// Count the distance from the wall instead of from the centerline.
    pub preserve_lumen: bool,
    /// Let every lumen beat every surrounding, whatever the depth.
    pub lumen_first: bool,
    /// How far beyond the wall `lumen_first` reaches (mm).
    pub lumen_margin: f64,
    /// N: the number of levels of detail beyond the finest.
    pub levels: usize,
    /// σ: how far from the vessels one level of detail reaches (mm per level).
    pub level_distance: f64,
    /// Smooth the depth with the 7×7 Gaussian before it is used.
    pub depth_filter: bool,
    /// Intensities that map to black and white.
    pub window: Window,
    /// Intensities that map to transparent and opaque; `None` is opaque everywhere.
    pub opacity: Option<Opacity>,
    /// Draw silhouettes.
    pub silhouettes: bool,
    /// Slope of the cut surface (mm depth per mm) at which a silhouette has half its strength.
    pub silhouette_slope: f64,
    /// Colour of the silhouettes, RGB.
    pub silhouette_color: [u8; 3],
    /// Colour where there is nothing to show, RGBA.
    pub background: [u8; 4],
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            cost_weight: 10.0,
            preserve_lumen: true,
            lumen_first: false,
            lumen_margin: 0.0,
            levels: 6,
            level_distance: 8.0,
            depth_filter: true,
            window: Window { level: 300.0, width: 900.0 },
            opacity: None,
            silhouettes: true,
            silhouette_slope: 24.0,
            silhouette_color: [255, 220, 0],
            background: [0, 0, 0, 255],
        }
    }
}

impl Settings {
    /// Checks every knob against its range.
    ///
    /// # Errors
    /// [`ErrorKind::Settings`] naming the first knob outside its range.
    pub fn check(&self) -> Result<()> {
        let range = |name: &str, value: f64, low: f64, high: f64, unit: &str| {
            if value >= low && value <= high {
                return Ok(());
            }
            let expected = format!("between {low} and {high} {unit}");
            Err(Error::new(ErrorKind::Settings, name, format!("{value}"), expected))
        };
        range("cost_weight", self.cost_weight, 0.0, 1e4, "mm of depth per mm")?;
        range("lumen_margin", self.lumen_margin, 0.0, 1e4, "mm")?;
        range("levels", self.levels as f64, 0.0, MAX_LEVELS as f64, "levels")?;
        range("level_distance", self.level_distance, 1e-3, 1e6, "mm per level")?;
        range("silhouette_slope", self.silhouette_slope, 1e-3, 1e6, "mm per mm")?;
        range("window level", self.window.level, -1e12, 1e12, "units of intensity")?;
        range("window width", self.window.width, 1e-12, 1e12, "units of intensity")?;
        if let Some(opacity) = self.opacity {
            range("opacity start", opacity.transparent, -1e12, 1e12, "units of intensity")?;
            range("opacity end", opacity.opaque, -1e12, 1e12, "units of intensity")?;
        }
        Ok(())
    }
}
