//! Curved Planar Reformation (CPR) of one vessel: projected, stretched and straightened (Kanitsar et al.: CPR
//! - Curved Planar Reformation, IEEE Visualization 2002, doi:10.1109/VISUAL.2002.1183754).
//!
//! Each mode is a surface of straight lines across the vessel, laid out as an image. In it x points to the
//! right from the middle column, and y downwards from the first row (mm). A mode defines the line of each row
//! and the image position of a world point. No picture is mirrored: right × down = into the scene.

mod projected;
mod roll;
mod sections;
mod straightened;
mod stretched;
mod surface;
mod view;

use std::sync::Arc;

use glam::{DVec2, DVec3};

use self::projected::Projected;
pub use self::roll::{Roll, Side};
pub use self::straightened::Straightened;
use self::stretched::Stretched;
use self::surface::{Row, Surface};
pub use self::view::View;
use super::layout::{Layout, by_rows, checked_size, curved_by_rows, whole_pixels};
use crate::camera::MAX_PIXEL_SPACING;
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::Curved;
use crate::math::centerline_path::CenterlinePath;
use crate::named::Named;
use crate::stop::Stop;

const DEFAULT_MARGIN_MM: f64 = 25.0;

/// The layout of the lines across a vessel as an image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CprMode {
    /// As the viewer sees the vessel: each row shows the lines through the vessel's points at one height.
    Projected,
    /// The surface of parallel lines through the vessel, unrolled, so that lengths on it are true.
    Stretched,
    /// Rows follow the arc length, the vessel is straight in the middle; sections do not twist about it.
    Straightened,
}

impl Named for CprMode {
    const NAMES: &'static [(&'static str, Self)] = &[
        ("projected", Self::Projected),
        ("stretched", Self::Stretched),
        ("straightened", Self::Straightened),
    ];
}

/// One vessel laid out as an image. Clones and rotated copies share the data computed for the vessel.
#[derive(Clone)]
pub struct Cpr {
    mode: CprMode,
    view: View,
    path: Arc<CenterlinePath>,
    surface: Arc<dyn Surface>,
    straightened: Option<Straightened>,
    width: Option<f64>,
    pixel_spacing: f64,
    size: [usize; 2],
}

impl Cpr {
    /// The layout of a vessel in pixels with a side of `pixel_spacing` mm and an odd number of columns. The
    /// outermost columns lie at most `width` mm apart; by default the image shows the vessel and 25 mm on
    /// each side of it. Fails with [`ErrorKind::Camera`] for an invalid view, width or spacing, for too many
    /// pixels, and if the whole vessel lies in one row.
    pub fn new(
        path: CenterlinePath,
        mode: CprMode,
        view: View,
        width: Option<f64>,
        pixel_spacing: f64,
    ) -> Result<Self> {
        check_lengths(width, pixel_spacing)?;
        let path = Arc::new(path);
        let straightened = match mode {
            CprMode::Straightened => Some(Straightened::new(Arc::clone(&path), &view)?),
            CprMode::Projected | CprMode::Stretched => None,
        };
        Self::laid_out(mode, view, path, straightened, width, pixel_spacing)
    }

    fn laid_out(
        mode: CprMode,
        view: View,
        path: Arc<CenterlinePath>,
        straightened: Option<Straightened>,
        width: Option<f64>,
        pixel_spacing: f64,
    ) -> Result<Self> {
        let surface: Arc<dyn Surface> = match (&straightened, mode) {
            (Some(straightened), _) => Arc::new(straightened.clone()),
            (None, CprMode::Stretched) => Arc::new(Stretched::new(Arc::clone(&path), view.turned()?)?),
            (None, _) => Arc::new(Projected::new(Arc::clone(&path), view.turned()?, pixel_spacing)?),
        };
        let half = width.map_or(surface.reach() + DEFAULT_MARGIN_MM, |width| width / 2.0);
        let pixels = |length: f64| whole_pixels(length, pixel_spacing);
        let size =
            checked_size("size of the CPR", [2.0 * pixels(half) + 1.0, pixels(surface.height()) + 1.0])?;
        Ok(Self { mode, view, path, surface, straightened, width, pixel_spacing, size })
    }

    /// The same vessel from another angle (radians), reusing its frames. Fails as [`Cpr::new`].
    pub fn rotated(&self, angle: f64) -> Result<Self> {
        let view = View { angle, ..self.view };
        view.checked_angle()?;
        let straightened = self.straightened.as_ref().map(|known| known.rotated(angle));
        Self::laid_out(self.mode, view, Arc::clone(&self.path), straightened, self.width, self.pixel_spacing)
    }

    /// The same straightened vessel with one angle per row; angle 0 is that of [`View`]. Fails with
    /// [`ErrorKind::Camera`] for a CPR of another mode.
    pub fn rolled(&self, roll: Roll) -> Result<Self> {
        let Some(straightened) = self.straightened.as_ref().map(|known| known.rolled(roll)) else {
            let found = "a roll of a CPR of another mode";
            return Err(Error::new(ErrorKind::Camera, "roll of the CPR", found, "mode straightened"));
        };
        let path = Arc::clone(&self.path);
        Self::laid_out(self.mode, self.view, path, Some(straightened), self.width, self.pixel_spacing)
    }

    /// The space around the straightened vessel, in mode [`CprMode::Straightened`].
    pub fn straightened(&self) -> Option<&Straightened> {
        self.straightened.as_ref()
    }

    fn x(&self, column: f64) -> f64 {
        (column - (self.size[0] - 1) as f64 / 2.0) * self.pixel_spacing
    }

    fn columns(&self) -> Vec<f64> {
        (0..self.size[0]).map(|i| self.x(i as f64)).collect()
    }

    fn row(&self, j: usize) -> Row {
        self.surface.row(j as f64 * self.pixel_spacing)
    }
}

impl Layout for Cpr {
    fn size(&self) -> [usize; 2] {
        self.size
    }

    fn pixel_spacing(&self) -> f64 {
        self.pixel_spacing
    }

    fn curved(&self, stop: Stop) -> Result<Curved> {
        let x = self.columns();
        curved_by_rows(self.size, stop, |j, position, direction| {
            let row = self.row(j);
            row.place_all(&x, position);
            direction.fill(row.ahead.as_vec3());
        })
    }

    fn arc_length(&self, stop: Stop) -> Result<Vec<f64>> {
        by_rows([1, self.size[1]], 0.0, stop, |j, row| row.fill(self.row(j).arc_length()))
    }

    fn folded(&self, stop: Stop) -> Result<Vec<bool>> {
        let (x, spacing) = (self.columns(), self.pixel_spacing);
        by_rows(self.size, false, stop, |j, row| {
            row.copy_from_slice(&self.surface.folded(j as f64 * spacing, &x));
        })
    }

    fn world_from_pixel(&self, pixel: DVec2) -> DVec3 {
        self.surface.row(pixel.y * self.pixel_spacing).place(self.x(pixel.x))
    }

    fn pixel_from_world(&self, point: DVec3) -> DVec2 {
        let place = self.surface.image_from_world(point) / self.pixel_spacing;
        DVec2::new(place.x + (self.size[0] - 1) as f64 / 2.0, place.y)
    }
}

fn check_lengths(width: Option<f64>, pixel_spacing: f64) -> Result<()> {
    let wrong = |subject: &str, found: f64, expected: &str| {
        Err(Error::new(ErrorKind::Camera, subject, format!("{found} mm"), expected))
    };
    if !(1e-6..=MAX_PIXEL_SPACING).contains(&pixel_spacing) {
        return wrong("pixel_spacing of the CPR", pixel_spacing, "between 1e-6 and 1e4 mm");
    }
    match width {
        Some(width) if !(width > 0.0 && width.is_finite()) => {
            wrong("width of the CPR", width, "a width above 0 mm")
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
#[path = "tests/cpr.rs"]
mod tests;

#[cfg(test)]
#[path = "tests/cpr_forms.rs"]
mod forms;
