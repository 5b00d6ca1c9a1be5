//! What the page asks for in the turning view: a camera, a method and settings.

use crate::flight::flight;
use crate::method::Method;
use glam::DVec3;
use lumencut_core::camera::Camera;
use lumencut_core::reformations::cr::CrParameters;
use lumencut_core::settings::Settings;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value as Json};

use crate::study::failure::{Failure, Result};
use crate::study::settings::settings;

/// A camera: orthographic, its axes unit vectors.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Camera"))]
pub struct CameraMessage {
    /// What is in the middle of the picture.
    center: [f64; 3],
    /// From the viewer into the scene.
    direction: [f64; 3],
    /// Upwards.
    up: [f64; 3],
    /// Columns and rows.
    size: [usize; 2],
    /// The side of a pixel (mm).
    pixel_spacing: f64,
}

impl CameraMessage {
    /// The camera of the core.
    ///
    /// # Errors
    /// `camera` for one that defines no view.
    pub fn camera(&self) -> Result<Camera> {
        let [center, direction, up] = [self.center, self.direction, self.up].map(DVec3::from_array);
        Ok(Camera::new(center, direction, up, self.size, self.pixel_spacing)?)
    }
}

/// The views of a flight from one camera to another, equal times apart.
///
/// # Errors
/// `camera` for one that defines no view, and for other flights than [`flight`] knows.
pub(crate) fn views_between(
    from: &CameraMessage,
    to: &CameraMessage,
    views: usize,
) -> Result<Vec<CameraMessage>> {
    Ok(flight(&from.camera()?, &to.camera()?, views)?.iter().map(CameraMessage::from).collect())
}

impl From<&Camera> for CameraMessage {
    fn from(camera: &Camera) -> Self {
        Self {
            center: camera.center().to_array(),
            direction: camera.direction().to_array(),
            up: camera.up().to_array(),
            size: camera.size(),
            pixel_spacing: camera.pixel_spacing(),
        }
    }
}

/// The methods of a view by the names that are saved, and how readers call them, in the order to show them.
pub const METHODS: [[&str; 2]; 4] =
    [["csr", "CSR"], ["csr-paper", "CSR (paper)"], ["cr", "CR"], ["mpcpr", "mpCPR"]];

/// How readers call a method of a view.
pub(crate) fn method_word(name: &str) -> &str {
    METHODS.iter().find(|[known, _]| *known == name).map_or(name, |[_, word]| word)
}

/// A view as the page asks for it.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "View"))]
pub struct ViewMessage {
    /// From where.
    pub camera: CameraMessage,
    /// One of the names of [`METHODS`].
    #[cfg_attr(test, ts(type = "Method"))]
    pub method: String,
    /// Settings by name.
    #[cfg_attr(test, ts(type = "Settings"))]
    pub settings: Map<String, Json>,
}

/// A view, checked.
#[derive(Clone, Debug)]
pub struct View {
    /// From where.
    pub camera: Camera,
    /// By which method.
    pub method: Method,
    /// How.
    pub settings: Settings,
}

impl ViewMessage {
    /// The view of a text of JSON.
    ///
    /// # Errors
    /// `settings` for a text that is no view.
    pub fn read(text: &str) -> Result<Self> {
        serde_json::from_str(text).map_err(|error| Failure::of_message("view", &error, "a view as JSON"))
    }

    /// The same, checked.
    ///
    /// # Errors
    /// Those of camera and settings, and `settings` for another name of a method.
    pub fn view(&self) -> Result<View> {
        let method = match self.method.as_str() {
            "csr" | "csr-paper" => Method::CutSurface,
            "mpcpr" => Method::MpCpr,
            "cr" => Method::Cr(CrParameters::default()),
            other => return Err(Failure::of_message("method", &other, "csr, csr-paper, mpcpr or cr")),
        };
        let first = if self.method == "csr-paper" { Settings::paper_values() } else { Vec::new() };
        let mut settings = settings(first, &self.settings)?;
        if method != Method::CutSurface {
            // The viewer shows one picture by several methods, of which the cut surface alone has a focus.
            settings.focus = None;
            settings.focus_vessels.clear();
        }
        Ok(View { camera: self.camera.camera()?, method, settings })
    }
}
