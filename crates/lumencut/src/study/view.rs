//! The 3D view as the page requests it: camera, method and settings.

use crate::flight::flight;
use crate::method::Method;
use glam::DVec3;
use lumencut_core::camera::Camera;
use lumencut_core::reformations::cr::CrParameters;
use lumencut_core::settings::Settings;
use lumencut_core::stages::rim::RimColors;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value as Json};

use crate::study::failure::{Failure, Result};
use crate::study::measure_messages::VesselMessage;
use crate::study::settings::settings;

/// An orthographic camera, with unit vectors as axes.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Camera"))]
pub struct CameraMessage {
    center: [f64; 3],
    direction: [f64; 3],
    up: [f64; 3],
    size: [usize; 2],
    /// Pixel side (mm).
    pixel_spacing: f64,
}

impl CameraMessage {
    /// The camera as the type of the core.
    pub fn camera(&self) -> Result<Camera> {
        let [center, direction, up] = [self.center, self.direction, self.up].map(DVec3::from_array);
        Ok(Camera::new(center, direction, up, self.size, self.pixel_spacing)?)
    }
}

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

/// The methods of a view: name in files and label, in display order.
pub const METHODS: [[&str; 2]; 4] =
    [["csr", "CSR"], ["csr-paper", "CSR (paper)"], ["cr", "CR"], ["mpcpr", "mpCPR"]];

pub(crate) fn method_word(name: &str) -> &str {
    METHODS.iter().find(|[known, _]| *known == name).map_or(name, |[_, word]| word)
}

/// A requested view.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "View"))]
pub struct ViewMessage {
    /// The camera.
    pub camera: CameraMessage,
    /// One of the names of [`METHODS`].
    #[cfg_attr(test, ts(type = "Method"))]
    pub method: String,
    /// Settings by name.
    #[cfg_attr(test, ts(type = "Settings"))]
    pub settings: Map<String, Json>,
    /// The measured vessels with a reader's marks, for a rim.
    #[serde(default)]
    #[cfg_attr(test, ts(optional, as = "Option<Vec<VesselMessage>>"))]
    pub(crate) vessels: Vec<VesselMessage>,
}

/// A checked view.
#[derive(Clone, Debug)]
pub struct View {
    /// The camera.
    pub camera: Camera,
    /// The method.
    pub method: Method,
    /// The settings.
    pub settings: Settings,
    /// Colours along the vessels, if the settings have a rim.
    pub rim: Option<RimColors>,
}

impl ViewMessage {
    /// Parses a view. Fails with an error of kind `settings` for an invalid text.
    pub fn read(text: &str) -> Result<Self> {
        serde_json::from_str(text).map_err(|error| Failure::of_message("view", &error, "a view as JSON"))
    }

    /// Checks the view.
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
            // The viewer may use the same settings for several methods, but only the cut surface supports a focus or a rim.
            settings.focus = None;
            settings.focus_vessels.clear();
            settings.rim = None;
        }
        Ok(View { camera: self.camera.camera()?, method, settings, rim: None })
    }
}
