//! Every knob of the method, with its unit and its default.

use crate::error::{Error, ErrorKind, Result};
use crate::math::transfer::{MAX_POINTS, MOST_INTENSITY, Preset, TransferFunction};
use crate::math::window::{Opacity, Window};

/// The most levels of detail beyond the finest.
pub const MAX_LEVELS: usize = 15;

/// What the rays of the context gather.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContextMode {
    /// Colour and opacity: γ = −1 is direct volume rendering (DVR), 0 maximum intensity difference accumulation
    /// (MIDA), 1 maximum intensity projection (MIP).
    Blend {
        /// γ, from −1 to 1.
        gamma: f64,
    },
    /// The smallest value, grey.
    Minimum,
    /// The mean value, grey.
    Average,
}

/// How the surroundings are rendered where the cut surface shows nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct Context {
    /// What the rays gather.
    pub mode: ContextMode,
    /// The intensities from 0 to 1: for the differences of MIDA, and grey of minimum and average.
    pub window: Window,
    /// Colour and opacity of the intensities.
    pub transfer: TransferFunction,
    /// The longest distance between samples (mm); `None` is the smallest side of a voxel, and half of it for DVR and
    /// MIDA at full resolution, whose opaque borders would show rings otherwise.
    pub step: Option<f64>,
    /// Shade DVR and MIDA by the gradient, with light from the viewer.
    pub shading: bool,
    /// Trace one ray for each square of four pixels only.
    pub preview: bool,
}

impl Default for Context {
    fn default() -> Self {
        let window = Window { level: 300.0, width: 900.0 };
        Self {
            mode: ContextMode::Blend { gamma: 0.0 },
            window,
            transfer: Preset::Angio.transfer_function(window),
            step: None,
            shading: false,
            preview: false,
        }
    }
}

/// What a thick cut surface shows of the values along the view direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SlabMode {
    /// The largest.
    Max,
    /// The mean.
    Mean,
    /// The smallest.
    Min,
}

/// A thick cut surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slab {
    /// From its near to its far side along the view direction, the cut surface in the middle (mm).
    pub thickness: f64,
    /// What it shows.
    pub mode: SlabMode,
}

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
    /// Show more than the cut surface itself; `None` is one point deep.
    pub slab: Option<Slab>,
    /// Intensities that map to black and white.
    pub window: Window,
    /// Intensities that map to transparent and opaque; `None` is opaque everywhere.
    pub opacity: Option<Opacity>,
    /// What is shown where the cut surface is outside the volume or transparent; `None` is the background.
    pub context: Option<Context>,
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
            slab: None,
            window: Window { level: 300.0, width: 900.0 },
            opacity: None,
            context: Some(Context::default()),
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
        range("cost_weight", self.cost_weight, 0.0, 1e4, "mm of depth per mm")?;
        range("lumen_margin", self.lumen_margin, 0.0, 1e4, "mm")?;
        range("levels", self.levels as f64, 0.0, MAX_LEVELS as f64, "levels")?;
        range("level_distance", self.level_distance, 1e-3, 1e6, "mm per level")?;
        range("silhouette_slope", self.silhouette_slope, 1e-3, 1e6, "mm per mm")?;
        check_window("window", self.window)?;
        if let Some(opacity) = self.opacity {
            range("opacity start", opacity.transparent, -1e12, 1e12, INTENSITY)?;
            range("opacity end", opacity.opaque, -1e12, 1e12, INTENSITY)?;
        }
        if let Some(slab) = self.slab {
            range("slab thickness", slab.thickness, 0.0, 1e3, "mm")?;
        }
        self.context.as_ref().map_or(Ok(()), Context::check)
    }
}

const INTENSITY: &str = "units of intensity";

fn range(name: &str, value: f64, low: f64, high: f64, unit: &str) -> Result<()> {
    if value >= low && value <= high {
        return Ok(());
    }
    let expected = format!("between {low} and {high} {unit}").trim_end().to_owned();
    Err(Error::new(ErrorKind::Settings, name, format!("{value}"), expected))
}

fn check_window(name: &str, window: Window) -> Result<()> {
    range(&format!("{name} level"), window.level, -1e12, 1e12, INTENSITY)?;
    range(&format!("{name} width"), window.width, 1e-12, 1e12, INTENSITY)
}

impl Context {
    fn check(&self) -> Result<()> {
        if let ContextMode::Blend { gamma } = self.mode {
            range("context_gamma", gamma, -1.0, 1.0, "(DVR to MIP)")?;
        }
        check_window("context_window", self.window)?;
        if let Some(step) = self.step {
            range("context_step", step, 1e-3, 1e3, "mm")?;
        }
        self.transfer.check()
    }
}

impl TransferFunction {
    fn check(&self) -> Result<()> {
        let points = &self.points;
        if points.is_empty() || points.len() > MAX_POINTS {
            let (found, expected) =
                (format!("{} control points", points.len()), format!("1 to {MAX_POINTS}"));
            return Err(Error::new(ErrorKind::Settings, "context_transfer", found, expected));
        }
        for (n, point) in points.iter().enumerate() {
            let name = |what: &str| format!("{what} of control point {} of context_transfer", n + 1);
            range(&name("intensity"), point.intensity, -MOST_INTENSITY, MOST_INTENSITY, INTENSITY)?;
            range(&name("opacity"), point.opacity, 0.0, 1.0, "per mm")?;
            if n > 0 && point.intensity < points[n - 1].intensity {
                let found = format!("{} after {}", point.intensity, points[n - 1].intensity);
                return Err(Error::new(ErrorKind::Settings, name("intensity"), found, "rising intensities"));
            }
        }
        Ok(())
    }
}
