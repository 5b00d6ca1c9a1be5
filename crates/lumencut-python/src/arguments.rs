//! Cameras and settings, read from the attributes of their Python classes.

use glam::DVec3;
use lumencut::camera::Camera;
use lumencut::error::Result;
use lumencut::math::window::{Opacity, Window};
use lumencut::settings::Settings;
use pyo3::prelude::*;

use crate::context::{ContextArgument, SlabArgument};
use crate::errors::to_python;

/// The attributes of `lumencut.Camera`.
#[derive(FromPyObject)]
pub struct CameraArgument {
    center: [f64; 3],
    direction: [f64; 3],
    up: [f64; 3],
    size: [usize; 2],
    pixel_spacing: f64,
}

impl CameraArgument {
    /// The camera of the core.
    pub fn camera(&self) -> PyResult<Camera> {
        let [center, direction, up] = [self.center, self.direction, self.up].map(DVec3::from_array);
        Camera::new(center, direction, up, self.size, self.pixel_spacing).map_err(to_python)
    }
}

/// Checks a camera and returns its unit vectors (direction, right, up).
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub fn check_camera(camera: CameraArgument) -> PyResult<[[f64; 3]; 3]> {
    let camera = camera.camera()?;
    Ok([camera.direction(), camera.right(), camera.up()].map(|v| v.to_array()))
}

/// The attributes of `lumencut.Window`.
#[derive(FromPyObject)]
pub struct WindowArgument {
    level: f64,
    width: f64,
}

impl WindowArgument {
    /// The window of the core.
    pub fn window(&self) -> Window {
        Window { level: self.level, width: self.width }
    }
}

#[derive(FromPyObject)]
struct OpacityArgument {
    transparent: f64,
    opaque: f64,
}

/// The attributes of `lumencut.Settings`.
pub struct SettingsArgument {
    surface: SurfaceArgument,
    context: ContextArgument,
}

impl<'py> FromPyObject<'_, 'py> for SettingsArgument {
    type Error = PyErr;

    fn extract(object: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        Ok(Self { surface: object.extract()?, context: object.extract()? })
    }
}

/// The attributes of `lumencut.Settings` that make and show the cut surface.
#[derive(FromPyObject)]
struct SurfaceArgument {
    cost_weight: f64,
    preserve_lumen: bool,
    lumen_first: bool,
    lumen_margin: f64,
    levels: usize,
    level_distance: f64,
    depth_filter: bool,
    window: Option<WindowArgument>,
    opacity: Option<OpacityArgument>,
    silhouettes: bool,
    silhouette_slope: f64,
    silhouette_color: [u8; 3],
    background: [u8; 4],
    slab: Option<SlabArgument>,
}

impl SettingsArgument {
    /// The settings of the core, checked.
    pub fn settings(&self) -> PyResult<Settings> {
        self.checked().map_err(to_python)
    }

    fn checked(&self) -> Result<Settings> {
        let mut settings = Settings { context: Some(self.context.context()?), ..self.surface.settings()? };
        settings.check()?;
        // Checked even where it is not wanted: what is wrong with it shows at once.
        settings.context = settings.context.filter(|_| self.context.is_wanted());
        Ok(settings)
    }
}

impl SurfaceArgument {
    fn settings(&self) -> Result<Settings> {
        let default = Settings::default();
        Ok(Settings {
            cost_weight: self.cost_weight,
            preserve_lumen: self.preserve_lumen,
            lumen_first: self.lumen_first,
            lumen_margin: self.lumen_margin,
            levels: self.levels,
            level_distance: self.level_distance,
            depth_filter: self.depth_filter,
            slab: self.slab.as_ref().map(SlabArgument::slab).transpose()?,
            window: self.window.as_ref().map_or(default.window, WindowArgument::window),
            opacity: self.opacity.as_ref().map(|o| Opacity { transparent: o.transparent, opaque: o.opaque }),
            silhouettes: self.silhouettes,
            silhouette_slope: self.silhouette_slope,
            silhouette_color: self.silhouette_color,
            background: self.background,
            context: None,
        })
    }
}

/// Checks settings against their ranges.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub fn check_settings(settings: SettingsArgument) -> PyResult<()> {
    settings.settings().map(drop)
}
