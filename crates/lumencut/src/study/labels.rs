//! Labels of a picture: the letters at its edges, and the scale bar.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::letters::EdgeLetters;
use crate::scale_bar::ScaleBar;

/// How a picture lies in space: unit vectors right and down (LPS), width in pixels, pixel side (mm).
#[derive(Clone, Copy, Debug, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct LaidPicture {
    right: [f64; 3],
    down: [f64; 3],
    width: f64,
    pixel_spacing: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct PictureLabels {
    pub(crate) letters: EdgeLetters,
    pub(crate) bar: Option<ScaleBar>,
}

impl From<LaidPicture> for PictureLabels {
    fn from(picture: LaidPicture) -> Self {
        Self {
            letters: EdgeLetters::new(DVec3::from_array(picture.right), DVec3::from_array(picture.down)),
            bar: ScaleBar::new(picture.width, picture.pixel_spacing),
        }
    }
}
