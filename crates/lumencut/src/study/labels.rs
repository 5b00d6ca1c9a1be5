//! What stands around a picture of the page: the letters at its edges and its scale bar.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::letters::EdgeLetters;
use crate::scale_bar::ScaleBar;

/// How a picture lies: unit vectors to the right and downwards (LPS), its width in pixels and their side (mm).
#[derive(Clone, Copy, Debug, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct LaidPicture {
    /// To the right.
    right: [f64; 3],
    /// Downwards.
    down: [f64; 3],
    /// Pixels.
    width: f64,
    /// The side of a pixel (mm).
    pixel_spacing: f64,
}

/// What stands around a picture.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct PictureLabels {
    /// The letters at its edges.
    pub(crate) letters: EdgeLetters,
    /// The scale bar; none where the picture has no width.
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
